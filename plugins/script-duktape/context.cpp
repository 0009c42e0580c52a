// ctx: the physical context of the running simulation (the thesis's JETContext).
#include "bindings.hpp"
#include "native.hpp"

#include <jet/simulation.hpp>

namespace jet::duktape {

namespace {

duk_ret_t time(Native& call) { return call.give(call.play.simulation.time()); }
duk_ret_t step(Native& call) { return call.give(static_cast<double>(call.play.simulation.stepCount())); }
duk_ret_t timeStep(Native& call) { return call.give(call.play.simulation.timeStep()); }
duk_ret_t setFixed(Native&) { throw Complaint{"this cannot be set by a script"}; }

duk_ret_t gravity(Native& call) { return duk_push_heapptr(call.ctx, call.play.prototypes.gravity), 1; }

duk_ret_t setGravity(Native& call)
{
    call.play.gravity = call.vector(0);
    call.play.simulation.world().setGravity(call.play.gravity);
    return 0;
}

}  // namespace

void bindContext(duk_context* ctx, duk_idx_t kit)
{
    duk_get_prop_string(ctx, kit, "ctx");
    accessor<time, setFixed>(ctx, "time");
    accessor<step, setFixed>(ctx, "step");
    accessor<timeStep, setFixed>(ctx, "timeStep");
    accessor<gravity, setGravity>(ctx, "gravity");
    duk_pop(ctx);
}

}  // namespace jet::duktape
