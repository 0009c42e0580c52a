// item.joint: what a joint did in the last step, and what moves it. Its motor is properties of its item (prelude.js).
#include "native.hpp"

#include <jet/simulation.hpp>

namespace jet::duktape {

namespace {

JointHandle self(const Native& call)
{
    const JointHandle joint = call.self(DUK_HIDDEN_SYMBOL("joint"), "a joint").joint;
    if (joint == kNoHandle) throw Complaint{"must be called on a joint"};
    return joint;
}
PhysicsWorld& world(const Native& call) { return call.play.simulation.world(); }
JointState state(const Native& call) { return world(call).joint(self(call)); }

duk_ret_t value(Native& call) { return call.give(state(call).value); }
duk_ret_t force(Native& call) { return call.give(state(call).force); }
duk_ret_t torque(Native& call) { return call.give(state(call).torque); }
duk_ret_t broken(Native& call) { return call.give(state(call).broken); }
duk_ret_t pointA(Native& call) { return call.give(state(call).pointA); }
duk_ret_t pointB(Native& call) { return call.give(state(call).pointB); }
duk_ret_t setMeasured(Native&) { throw Complaint{"this is measured, not set"}; }

duk_ret_t setTarget(Native& call) { return world(call).setJointTarget(self(call), call.vector(0)), 0; }
duk_ret_t remove(Native& call) { return world(call).removeJoint(self(call)), 0; }

}  // namespace

void bindJoints(duk_context* ctx, duk_idx_t kit)
{
    duk_get_prop_string(ctx, kit, "Joint");
    accessor<value, setMeasured>(ctx, "value");
    accessor<force, setMeasured>(ctx, "force");
    accessor<torque, setMeasured>(ctx, "torque");
    accessor<broken, setMeasured>(ctx, "broken");
    accessor<pointA, setMeasured>(ctx, "pointA");
    accessor<pointB, setMeasured>(ctx, "pointB");
    method<setTarget>(ctx, "setTarget", 2);
    method<remove>(ctx, "remove", 0);
    duk_pop(ctx);
}

}  // namespace jet::duktape
