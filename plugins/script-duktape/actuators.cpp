// item.torque (thesis §4.3). Springs are properties of their items, and need no C++ (prelude.js).
#include "native.hpp"

#include <jet/simulation.hpp>

namespace jet::duktape {

namespace {

ItemId self(const Native& call) { return call.self(DUK_HIDDEN_SYMBOL("torque"), "a torque").item->id(); }

duk_ret_t value(Native& call) { return call.give(call.play.simulation.torque(self(call))); }
duk_ret_t setValue(Native& call) { return call.play.simulation.setTorque(self(call), call.number(0)), 0; }

}  // namespace

void bindActuators(duk_context* ctx, duk_idx_t kit)
{
    duk_get_prop_string(ctx, kit, "Torque");
    accessor<value, setValue>(ctx, "value");
    method<value>(ctx, "getValue", 0);
    method<setValue>(ctx, "setValue", 1);
    duk_pop(ctx);
}

}  // namespace jet::duktape
