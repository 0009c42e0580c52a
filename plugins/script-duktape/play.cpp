#include "play.hpp"

#include <cmath>

namespace jet::duktape {

Play::Play(Simulation& runningSimulation, const Limits& limits)
    : simulation(runningSimulation), budget(limits), items(runningSimulation), properties(runningSimulation.scene()),
      gravity(runningSimulation.scene().setting("gravity").as<Vec2>())
{
    budget.heapData()->play = this;
}

Play& Play::of(duk_context* ctx)
{
    duk_memory_functions functions;
    duk_get_memory_functions(ctx, &functions);
    return *static_cast<HeapData*>(functions.udata)->play;
}

// The small addition keeps 60 steps of 1/60 s a whole second.
double Play::milliseconds() const { return std::floor(simulation.time() * 1000 + 1e-6); }

void* Play::keep(duk_context* ctx)
{
    void* pointer = duk_get_heapptr(ctx, -1);
    duk_push_heap_stash(ctx);
    duk_get_prop_literal(ctx, -1, "kept");
    duk_dup(ctx, -3);
    duk_put_prop_index(ctx, -2, static_cast<duk_uarridx_t>(duk_get_length(ctx, -2)));
    duk_pop_3(ctx);
    return pointer;
}

void Play::pushVector(duk_context* ctx, const Vec2& vector) const
{
    duk_push_object(ctx);
    duk_push_number(ctx, vector.x());
    duk_put_prop_literal(ctx, -2, "x");
    duk_push_number(ctx, vector.y());
    duk_put_prop_literal(ctx, -2, "y");
    duk_push_heapptr(ctx, prototypes.vector);
    duk_set_prototype(ctx, -2);
}

void Play::pushArea(duk_context* ctx, const Box& box) const
{
    const bool none = box.isNull();
    const auto put = [&](const char* name, double value) {
        duk_push_number(ctx, value);
        duk_put_prop_string(ctx, -2, name);
    };
    duk_push_object(ctx);
    put("x", none ? 0 : box.min.x());
    put("y", none ? 0 : box.min.y());
    put("width", box.width());
    put("height", box.height());
    duk_push_heapptr(ctx, prototypes.area);
    duk_set_prototype(ctx, -2);
}

void Play::warn(duk_context* ctx, const std::string& text)
{
    constexpr std::size_t kMostWarnings = 200;  // a script may make up a new text each step
    const Place place = currentPlace(ctx, files);
    std::string message = prefixed(place, simulation.scene(), "warning", text);
    if (warned_.size() >= kMostWarnings || !warned_.insert(message).second) return;
    simulation.print({OutputLine::Kind::Warning, std::move(message), place.script, place.line});
}

}  // namespace jet::duktape
