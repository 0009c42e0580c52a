// item.body: the thesis's body of a BodyItem, soft or rigid alike.
#include "native.hpp"

#include <jet/simulation.hpp>

namespace jet::duktape {

namespace {

const ItemSlot& slot(const Native& call)
{
    const ItemSlot& slot = call.self(DUK_HIDDEN_SYMBOL("body"), "a body");
    if (slot.body == kNoHandle) throw Complaint{"must be called on a body"};  // a Proxy answers any key with any number
    return slot;
}
BodyHandle self(const Native& call) { return slot(call).body; }
PhysicsWorld& world(const Native& call) { return call.play.simulation.world(); }

duk_ret_t position(Native& call) { return call.play.items.pushLive(call.ctx, slot(call), false), 1; }
duk_ret_t velocity(Native& call) { return call.play.items.pushLive(call.ctx, slot(call), true), 1; }
duk_ret_t angle(Native& call) { return call.give(world(call).bodies().angle[self(call)]); }
duk_ret_t omega(Native& call) { return call.give(world(call).bodies().omega[self(call)]); }

duk_ret_t setPosition(Native& call) { return world(call).setPosition(self(call), call.vector(0)), 0; }
duk_ret_t setVelocity(Native& call) { return world(call).setVelocity(self(call), call.vector(0)), 0; }
duk_ret_t setOmega(Native& call) { return world(call).setOmega(self(call), call.number(0)), 0; }
duk_ret_t setAngle(Native&) { throw Complaint{"a body turns by its omega; its angle cannot be set"}; }
duk_ret_t applyForce(Native& call) { return world(call).applyForce(self(call), call.vector(0)), 0; }
duk_ret_t applyImpulse(Native& call) { return world(call).applyImpulse(self(call), call.vector(0)), 0; }

duk_ret_t boundingArea(Native& call)
{
    call.play.pushArea(call.ctx, world(call).bodies().bounds[self(call)]);
    return 1;
}

duk_ret_t contains(Native& call) { return call.give(world(call).contains(self(call), call.vector(0))); }

// Of another body, or of an item by its body.
duk_ret_t isTouching(Native& call)
{
    const ItemSlot* other = call.play.items.slotOf(call.ctx, 0, DUK_HIDDEN_SYMBOL("body"));
    if (!other) other = call.play.items.slotOf(call.ctx, 0, DUK_HIDDEN_SYMBOL("item"));
    if (!other) throw Complaint{"expected a body or an item, got " + call.describe(0)};
    const BodyHandle body = self(call);
    return call.give(other->body != kNoHandle && other->body != body && world(call).touching(body, other->body));
}

}  // namespace

void bindBodies(duk_context* ctx, duk_idx_t kit)
{
    duk_get_prop_string(ctx, kit, "Body");
    accessor<position, setPosition>(ctx, "position");
    accessor<velocity, setVelocity>(ctx, "velocity");
    accessor<angle, setAngle>(ctx, "angle");
    accessor<omega, setOmega>(ctx, "omega");
    method<setPosition>(ctx, "setPosition", 2);
    method<setVelocity>(ctx, "setVelocity", 2);
    method<setOmega>(ctx, "setOmega", 1);
    method<applyForce>(ctx, "applyForce", 2);
    method<applyImpulse>(ctx, "applyImpulse", 2);
    method<boundingArea>(ctx, "getBoundingArea", 0);
    method<contains>(ctx, "contains", 2);
    method<isTouching>(ctx, "isTouching", 1);
    duk_pop(ctx);
}

}  // namespace jet::duktape
