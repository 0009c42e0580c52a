// The camera, scene.GC.swingSimulationGP (thesis §4.4), and the look-up of scenes.
#include "bindings.hpp"
#include "native.hpp"
#include "text.hpp"

#include <jet/simulation.hpp>

namespace jet::duktape {

namespace {

GameView& view(Native& call) { return call.play.simulation.view(); }

duk_ret_t width(Native& call) { return call.give(view(call).size.x()); }
duk_ret_t height(Native& call) { return call.give(view(call).size.y()); }
duk_ret_t viewScale(Native& call) { return call.give(view(call).view.scale); }
duk_ret_t viewAnchor(Native& call) { return call.give(Vec2(view(call).view.anchor)); }

duk_ret_t setViewScale(Native& call)
{
    const double scale = call.number(0);
    if (!(scale > 0)) throw Complaint{"the scale must be above 0, got " + call.describe(0), DUK_ERR_RANGE_ERROR};
    view(call).view.scale = scale;
    return 0;
}

duk_ret_t setViewAnchor(Native& call) { return view(call).view.anchor = call.vector(0), 0; }

duk_ret_t topGroupOfScene(Native& call) { return call.give(&call.play.simulation.scene().root()); }

// Another scene is only looked up, never kept: its project may change while this one plays.
duk_ret_t findScene(Native& call)
{
    const std::string name = call.text(0);
    const char* found = "other";
    if (name == call.play.simulation.scene().name()) {
        found = "running";
    } else if (!call.play.simulation.sceneByName(name)) {
        call.play.warn(call.ctx, "there is no scene \"" + shortened(name, 80) + "\"; the running one is \"" +
                                     call.play.simulation.scene().name() + '"');
        found = "none";
    }
    duk_push_string(call.ctx, found);
    return 1;
}

}  // namespace

void bindView(duk_context* ctx, duk_idx_t kit)
{
    duk_dup(ctx, kit);
    method<topGroupOfScene>(ctx, "topGroup", 0);
    method<findScene>(ctx, "findScene", 1);
    duk_pop(ctx);

    duk_get_prop_string(ctx, kit, "View");
    method<width>(ctx, "getWidth", 0);
    method<height>(ctx, "getHeight", 0);
    method<viewScale>(ctx, "getViewScale", 0);
    method<setViewScale>(ctx, "setViewScale", 1);
    method<viewAnchor>(ctx, "getViewAnchor", 0);
    method<setViewAnchor>(ctx, "setViewAnchor", 2);
    duk_pop(ctx);
}

}  // namespace jet::duktape
