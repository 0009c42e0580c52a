#include "wholes.hpp"

#include "speed_limit.hpp"
#include "trigonometry.hpp"

namespace jet::physics::soft {

namespace {

/// (cos, sin) of the angle by which the shape at rest fits best; null where none fits better than others.
Vec2 bestTurn(const State& state, const BodyRecord& body)
{
    const MassSums sums = massSums(state.nodes, body.nodes, body.soft->restArms.data());
    return body.soft->bestTurn({sums.along, sums.across});
}

/// As of one rigid body.
void setMotion(State& state, const BodyRecord& body, const Vec2& velocity, double omega)
{
    Nodes& nodes = state.nodes;
    const Vec2 centre = massSums(nodes, body.nodes).centre;
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
        nodes.velocity[n] = velocity + omega * perpendicular(nodes.position[n] - centre);
}

}  // namespace

void stiffen(State& state, const BodyRecord& body)
{
    const MassSums sums = massSums(state.nodes, body.nodes);
    setMotion(state, body, sums.velocity, sums.omega());
}

void Wholes::gather(const State& state)
{
    kinematic_.clear(), upright_.clear(), free_.clear();
    for (Index handle = 0; handle < state.bodies.size(); ++handle) {
        const BodyRecord& body = state.bodies[handle];
        if (!body.soft || body.fixed || !body.enabled || body.asleep || body.nodes.count == 0) continue;
        if (body.kinematic) {
            const MassSums sums = massSums(state.nodes, body.nodes);
            Kinematic& own = kinematic_.emplace_back(Kinematic{handle, sums.velocity, sums.omega()});
            limitSpeed(own.velocity, own.omega);
            continue;
        }
        if (!body.fixedRotation || body.soft->pieceCount > 1) continue;
        Upright& own = upright_.emplace_back();
        own.handle = handle, own.free.first = static_cast<Index>(free_.size());
        for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
            if (state.nodes.invMass[n] > 0) free_.push_back(n);
        own.free.count = static_cast<Index>(free_.size()) - own.free.first;
        own.pinned = own.free.count < body.nodes.count;
    }
}

MassSums Wholes::sums(const State& state, const Upright& body) const
{
    const std::span<const Index> free = freeOf(body);
    return massSums(
        state.nodes, free.size(), [&](std::size_t i) { return free[i]; }, nullptr);
}

void Wholes::keep(State& state) const
{
    Nodes& nodes = state.nodes;
    for (const Kinematic& is : kinematic_) setMotion(state, state.bodies[is.handle], is.velocity, is.omega);
    for (const Upright& body : upright_) {
        const MassSums moving = sums(state, body);
        const double omega = moving.omega();
        for (const Index n : freeOf(body))
            nodes.velocity[n] -= omega * perpendicular(nodes.position[n] - moving.centre);
    }
}

void Wholes::begin(const State& state)
{
    for (Upright& body : upright_)
        if (!body.pinned) body.turn = bestTurn(state, state.bodies[body.handle]);
}

void Wholes::end(State& state, double h) const
{
    Nodes& nodes = state.nodes;
    for (const Kinematic& is : kinematic_) {
        const Range& own = state.bodies[is.handle].nodes;
        const Vec2 centre = massSums(nodes, own).centre, turn = direction(h * is.omega);
        for (Index n = own.first; n < own.end(); ++n) {
            const Vec2 arm = rotated(turn, nodes.position[n] - centre);
            nodes.position[n] = centre + h * is.velocity + arm;
            nodes.velocity[n] = is.velocity + is.omega * perpendicular(arm);
        }
    }
    for (const Upright& body : upright_) {
        if (body.pinned || body.turn.isZero()) continue;
        const Vec2 now = bestTurn(state, state.bodies[body.handle]);
        if (now.isZero()) continue;
        const Vec2 back(now.dot(body.turn), cross(now, body.turn));
        const MassSums moving = sums(state, body);
        for (const Index n : freeOf(body)) {
            nodes.position[n] = moving.centre + rotated(back, nodes.position[n] - moving.centre);
            nodes.velocity[n] = moving.velocity + rotated(back, nodes.velocity[n] - moving.velocity);
        }
    }
}

}  // namespace jet::physics::soft
