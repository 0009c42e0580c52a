#include "integrator.hpp"

namespace jet::physics {

namespace {

// Far above any sensible scene; keeps absurd forces from reaching infinity, where nothing would come back from.
constexpr double kMostSpeed = 1e6;        // units / s
constexpr double kMostTurningRate = 1e4;  // rad / s

void limit(Vec2& velocity, double& omega)
{
    const double squared = velocity.squaredNorm();
    if (!(squared <= kMostSpeed * kMostSpeed)) {
        velocity = std::isfinite(squared) ? Vec2(velocity * (kMostSpeed / std::sqrt(squared))) : Vec2(0, 0);
    }
    if (!(std::abs(omega) <= kMostTurningRate)) omega = std::isnan(omega) ? 0 : std::copysign(kMostTurningRate, omega);
}

/// Slows the turning of a soft body about its centre of mass, leaving its oscillations alone.
void dampTurning(Nodes& nodes, const BodyRecord& body, double kept)
{
    Vec2 centre(0, 0), velocity(0, 0);
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n) {
        centre += nodes.mass[n] * nodes.position[n];
        velocity += nodes.mass[n] * nodes.velocity[n];
    }
    centre /= body.mass;
    velocity /= body.mass;
    double inertia = 0, momentum = 0;
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n) {
        const Vec2 arm = nodes.position[n] - centre;
        inertia += nodes.mass[n] * arm.squaredNorm();
        momentum += nodes.mass[n] * cross(arm, nodes.velocity[n] - velocity);
    }
    if (!(inertia > 0)) return;
    const double change = (kept - 1) * momentum / inertia;
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
        if (nodes.invMass[n] > 0) nodes.velocity[n] += change * perpendicular(nodes.position[n] - centre);
}

}  // namespace

void integrateVelocities(State& state, const WorldSettings& settings, double h)
{
    Nodes& nodes = state.nodes;
    const double linear = settings.applyDamping ? decay(settings.linearDamping * h) : 1;
    const double angular = settings.applyDamping ? decay(settings.angularDamping * h) : 1;
    for (const BodyRecord& body : state.bodies) {
        if (body.fixed) continue;
        const Vec2 gravity = settings.applyGravity ? Vec2(body.gravityScale * settings.gravity) : Vec2(0, 0);
        for (Index n = body.nodes.first; n < body.nodes.end(); ++n) {
            if (nodes.invMass[n] == 0) continue;
            nodes.velocity[n] = linear * (nodes.velocity[n] + h * (gravity + nodes.invMass[n] * nodes.force[n]));
            nodes.omega[n] = angular * (nodes.omega[n] + h * nodes.invInertia[n] * nodes.torque[n]);
        }
        if (!body.rigid && angular != 1 && body.nodes.count > 0) dampTurning(nodes, body, angular);
    }
}

void integratePositions(State& state, double h)
{
    Nodes& nodes = state.nodes;
    for (Index n = 0; n < nodes.size(); ++n) {
        if (nodes.invMass[n] == 0) continue;
        limit(nodes.velocity[n], nodes.omega[n]);
        nodes.position[n] += h * nodes.velocity[n];
        if (nodes.invInertia[n] == 0) continue;
        nodes.angle[n] += h * nodes.omega[n];
        nodes.rotation[n] = direction(nodes.angle[n]);
    }
}

}  // namespace jet::physics
