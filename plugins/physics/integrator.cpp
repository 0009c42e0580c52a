#include "integrator.hpp"

#include "soft/mass_sums.hpp"
#include "speed_limit.hpp"

#include <algorithm>

namespace jet::physics {

namespace {

using soft::kMostSpeed;
constexpr double kMostTurningRate = 1e4;  // rad / s

/// Slows the turning of a soft body about its centre of mass, leaving its oscillations alone.
void dampTurning(Nodes& nodes, const BodyRecord& body, double kept)
{
    const soft::MassSums sums = soft::massSums(nodes, body.nodes);
    const double change = (kept - 1) * sums.omega();
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
        if (nodes.invMass[n] > 0) nodes.velocity[n] += change * perpendicular(nodes.position[n] - sums.centre);
}

}  // namespace

void integrateVelocities(State& state, const WorldSettings& settings, SoftSprings& springs, double h, bool pushed)
{
    Nodes& nodes = state.nodes;
    const double linear = settings.applyDamping ? decay(settings.linearDamping * h) : 1;
    const double angular = settings.applyDamping ? decay(settings.angularDamping * h) : 1;
    springs.accelerate(state, h, settings.applyGravity ? settings.gravity : Vec2(0, 0), linear, pushed);
    const bool anyForces = nodes.force.size() == nodes.size();
    for (Index handle = 0; handle < state.bodies.size(); ++handle) {
        const BodyRecord& body = state.bodies[handle];
        const Vec2 gravity = settings.applyGravity ? Vec2(body.gravityScale * settings.gravity) : Vec2(0, 0);
        const Index first = body.nodes.first;
        if (body.nodes.count == 0) continue;
        if (!body.rigid) {
            if (body.asleep) {  // one of several that are computed together may have been accelerated
                std::fill_n(nodes.velocity.begin() + first, body.nodes.count, Vec2(0, 0));
                continue;
            }
            if (!springs.isWide(handle))
                springs.kernels().accelerate(
                    nodes.velocity[first].data(), anyForces ? nodes.force.edit(first).data() : nullptr,
                    &nodes.invMass[first], body.nodes.count, {h, gravity.x(), gravity.y(), linear});
            if (angular != 1 && !body.fixed && !body.kinematic) dampTurning(nodes, body, angular);
            continue;
        }
        if (nodes.invMass[first] > 0 && !body.asleep) {
            nodes.velocity[first] =
                linear * (nodes.velocity[first] + h * (gravity + nodes.invMass[first] * nodes.force[first]));
            nodes.omega.edit(first) =
                angular * (nodes.omega[first] + h * nodes.invInertia[first] * nodes.torque[first]);
        }
        nodes.force.set(first, Vec2(0, 0));
        nodes.torque.set(first, 0);
    }
}

void limitSpeed(Vec2& velocity, double& omega)
{
    const double squared = velocity.squaredNorm();
    if (!(squared <= kMostSpeed * kMostSpeed)) {
        velocity = std::isfinite(squared) ? Vec2(velocity * (kMostSpeed / std::sqrt(squared))) : Vec2(0, 0);
    }
    if (!(std::abs(omega) <= kMostTurningRate)) omega = std::isnan(omega) ? 0 : std::copysign(kMostTurningRate, omega);
}

void limitMove(Vec2& move, double& turn, double dt)
{
    const double most = kMostSpeed * dt;
    if (move.squaredNorm() <= most * most && std::abs(turn) <= kMostTurningRate * dt) return;
    move /= dt, turn /= dt;
    limitSpeed(move, turn);
    move *= dt, turn *= dt;
}

void integratePositions(State& state, const SoftSprings& springs, double h)
{
    Nodes& nodes = state.nodes;
    for (Index handle = 0; handle < state.bodies.size(); ++handle) {
        const BodyRecord& body = state.bodies[handle];
        const Index first = body.nodes.first;
        if (body.nodes.count == 0 || body.fixed || body.kinematic || body.flown || (body.asleep && body.soft)) continue;
        if (!body.rigid) {
            springs.advance(state, handle, h);
            continue;
        }
        if (nodes.invMass[first] == 0) continue;
        limitSpeed(nodes.velocity[first], nodes.omega.edit(first));
        nodes.position[first] += h * nodes.velocity[first];
        if (nodes.invInertia[first] == 0) continue;
        nodes.angle.edit(first) += h * nodes.omega[first];
        nodes.rotation.edit(first) = direction(nodes.angle[first]);
    }
}

}  // namespace jet::physics
