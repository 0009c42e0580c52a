// Live vectors: body.position, body.velocity and ctx.gravity are Vec2d objects whose x and y are the world's own
// values, as they are in the thesis's Java. `body.velocity.x = 5` and `body.position.add(v)` act at once; `new
// Vec2d(v)` makes a copy.
#include "native.hpp"

#include <jet/simulation.hpp>

namespace jet::duktape {

namespace {

// The magic of the accessors tells the coordinate: 0 is x, 1 is y.
int coordinate(const Native& call) { return duk_get_current_magic(call.ctx); }
BodyHandle bodyOf(const Native& call)
{
    const BodyHandle body = call.self(DUK_HIDDEN_SYMBOL("vector"), "the vector of a body").body;
    if (body == kNoHandle) throw Complaint{"must be called on the vector of a body"};
    return body;
}
PhysicsWorld& world(const Native& call) { return call.play.simulation.world(); }

duk_ret_t position(Native& call) { return call.give(world(call).bodies().position[bodyOf(call)][coordinate(call)]); }
duk_ret_t velocity(Native& call) { return call.give(world(call).bodies().velocity[bodyOf(call)][coordinate(call)]); }
duk_ret_t gravity(Native& call) { return call.give(call.play.gravity[coordinate(call)]); }

duk_ret_t setPosition(Native& call)
{
    const BodyHandle body = bodyOf(call);
    Vec2 v = world(call).bodies().position[body];
    v[coordinate(call)] = call.number(0);
    world(call).setPosition(body, v);
    return 0;
}

duk_ret_t setVelocity(Native& call)
{
    const BodyHandle body = bodyOf(call);
    Vec2 v = world(call).bodies().velocity[body];
    v[coordinate(call)] = call.number(0);
    world(call).setVelocity(body, v);
    return 0;
}

duk_ret_t setGravity(Native& call)
{
    call.play.gravity[coordinate(call)] = call.number(0);
    world(call).setGravity(call.play.gravity);
    return 0;
}

template <NativeFunction Get, NativeFunction Set>
void bindCoordinates(duk_context* ctx, duk_idx_t kit, const char* prototype)
{
    duk_get_prop_string(ctx, kit, prototype);
    accessor<Get, Set>(ctx, "x", 0);
    accessor<Get, Set>(ctx, "y", 1);
    duk_pop(ctx);
}

}  // namespace

void bindVectors(duk_context* ctx, duk_idx_t kit)
{
    bindCoordinates<position, setPosition>(ctx, kit, "Position");
    bindCoordinates<velocity, setVelocity>(ctx, kit, "Velocity");
    bindCoordinates<gravity, setGravity>(ctx, kit, "Gravity");
}

}  // namespace jet::duktape
