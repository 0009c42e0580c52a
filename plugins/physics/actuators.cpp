#include "actuators.hpp"

namespace jet::physics {

namespace {

constexpr double kStiffeningReserve = 2.0;  // see soft_springs.cpp
/// Radians a substep up to which a spring turns a body: whirled about faster, its lever is another one before the force
/// has acted, and the spring would give more than it holds.
constexpr double kMostTurn = 0.5;

double angleBetween(const Vec2& armA, const Vec2& armB) { return angleOf(cross(armA, armB), armA.dot(armB)); }

/// Then all that the spring holds sleeps, or stands; or one of them is switched off, and it holds nothing.
bool sleeps(const State& state, const AnchorPoint& anchor)
{
    return anchor.body != kNone && (state.bodies[anchor.body].asleep || !state.bodies[anchor.body].enabled);
}

/// The constraint "angle from a to b about the centre"; empty when an arm has no length.
bool angleJacobian(const State& state, const AnchorPoint& a, const AnchorPoint& centre, const AnchorPoint& b,
                   AnchorJacobian& jacobian)
{
    const Vec2 armA = a.position(state) - centre.position(state), armB = b.position(state) - centre.position(state);
    const double lengthA = armA.squaredNorm(), lengthB = armB.squaredNorm();
    if (!(lengthA > 1e-24) || !(lengthB > 1e-24)) return false;
    const Vec2 gradientA = -perpendicular(armA) / lengthA, gradientB = perpendicular(armB) / lengthB;
    jacobian.add(state, a, gradientA);
    jacobian.add(state, centre, -(gradientA + gradientB));
    jacobian.add(state, b, gradientB);
    return true;
}

double angleNow(const State& state, const AnchorPoint& a, const AnchorPoint& centre, const AnchorPoint& b)
{
    const Vec2 middle = centre.position(state);
    return angleBetween(a.position(state) - middle, b.position(state) - middle);
}

/// A pure couple: on a soft body spread as a rigid turning about its centre of mass, so that it does not bend it.
void addCouple(State& state, const BodyRecord& body, double torque)
{
    Nodes& nodes = state.nodes;
    if (body.rigid) {
        nodes.torque[body.nodes.first] += torque;
        return;
    }
    double mass = 0, inertia = 0;
    Vec2 centre(0, 0);
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
        centre += nodes.mass[n] * nodes.position[n], mass += nodes.mass[n];
    if (!(mass > 0)) return;
    centre /= mass;
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
        inertia += nodes.mass[n] * (nodes.position[n] - centre).squaredNorm();
    if (!(inertia > 1e-12 * mass * body.length * body.length)) return;
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
        nodes.force[n] += torque * nodes.mass[n] / inertia * perpendicular(nodes.position[n] - centre);
}

}  // namespace

ActuatorHandle Actuators::add(const State& state, const SpringActuatorDef& def)
{
    Spring spring{resolveAnchor(state, def.a), resolveAnchor(state, def.b), def.restLength, def.ks, def.kd, 0};
    if (spring.restLength < 0) spring.restLength = (spring.a.position(state) - spring.b.position(state)).norm();
    if (def.tearRatio > 0) spring.tearLength = spring.restLength * def.tearRatio;
    springs_.push_back(spring);
    return static_cast<ActuatorHandle>(springs_.size() - 1);
}

ActuatorHandle Actuators::add(const State& state, const AngularSpringActuatorDef& def)
{
    AngularSpring spring{resolveAnchor(state, def.a),
                         resolveAnchor(state, def.centre),
                         resolveAnchor(state, def.b),
                         def.restAngle,
                         def.ks,
                         def.kd,
                         0,
                         0};
    const double angle = angleNow(state, spring.a, spring.centre, spring.b);
    if (def.restFromPose) spring.restAngle = angle;
    spring.angle = spring.restAngle + wrapped(angle - spring.restAngle);
    AnchorJacobian jacobian;
    if (angleJacobian(state, spring.a, spring.centre, spring.b, jacobian))
        spring.restCompliance = jacobian.compliance(state);
    angularSprings_.push_back(spring);
    return static_cast<ActuatorHandle>(angularSprings_.size() - 1);
}

ActuatorHandle Actuators::add(const State& state, const TorqueActuatorDef& def)
{
    torques_.push_back({resolveAnchor(state, def.at), def.value});
    return static_cast<ActuatorHandle>(torques_.size() - 1);
}

ActuatorHandle Actuators::add(const State& state, const ForceActuatorDef& def)
{
    forces_.push_back({resolveAnchor(state, def.at), def.force});
    return static_cast<ActuatorHandle>(forces_.size() - 1);
}

void Actuators::setSpring(ActuatorHandle handle, double restLength, double ks, double kd, double tearRatio)
{
    Spring& spring = springs_[handle];
    if (restLength >= 0) spring.restLength = restLength;
    spring.ks = ks, spring.kd = kd;
    spring.tearLength = tearRatio > 0 ? spring.restLength * tearRatio : 0;
}

bool Actuators::isSet(ActuatorHandle handle, double restLength, double ks, double kd, double tearRatio) const
{
    const Spring& spring = springs_[handle];
    const double tearLength = tearRatio > 0 ? spring.restLength * tearRatio : 0;
    return (restLength < 0 || restLength == spring.restLength) && ks == spring.ks && kd == spring.kd &&
           tearLength == spring.tearLength;
}

/// Torn springs count as if they were whole: what a restored world computes must not depend on when they tore.
void Actuators::addTo(StiffnessBounds& bounds, const State& state) const
{
    for (const Spring& spring : springs_) {
        spring.a.addTo(bounds, state, spring.ks);
        spring.b.addTo(bounds, state, spring.ks);
    }
    for (const AngularSpring& spring : angularSprings_)
        for (const AnchorPoint* anchor : {&spring.a, &spring.centre, &spring.b})
            for (int i = 0; i < anchor->count; ++i) bounds.add(anchor->node[i], spring.ks * spring.restCompliance);
}

void Actuators::prepare(const StiffnessBounds& bounds, double h, bool plain)
{
    if (plain) {
        for (Spring& spring : springs_) spring.stiffness = spring.ks, spring.damping = spring.kd;
        for (AngularSpring& spring : angularSprings_) spring.stiffness = spring.ks, spring.damping = spring.kd;
        return;
    }
    const auto soften = [h](auto& spring, double share) {
        spring.stiffness = spring.ks * share;
        spring.damping = spring.kd + h * (spring.ks - spring.stiffness);
    };
    for (Spring& spring : springs_) soften(spring, std::min(spring.a.share(bounds, h), spring.b.share(bounds, h)));
    for (AngularSpring& spring : angularSprings_)
        soften(spring,
               std::min({spring.a.share(bounds, h), spring.centre.share(bounds, h), spring.b.share(bounds, h)}));
}

void Actuators::addForces(State& state) const
{
    for (const Torque& torque : torques_)
        if (torque.at.count > 0 && torque.value != 0 && !state.bodies[torque.at.body].asleep)
            addCouple(state, state.bodies[torque.at.body], torque.value);
    for (const Force& force : forces_)
        if (!sleeps(state, force.at)) force.at.addForce(state, force.force);
}

void Actuators::applySprings(State& state, double h, bool backwards)
{
    for (std::size_t i = 0; i < springs_.size(); ++i)
        apply(state, springs_[backwards ? springs_.size() - 1 - i : i], h);
    for (std::size_t i = 0; i < angularSprings_.size(); ++i)
        apply(state, angularSprings_[backwards ? angularSprings_.size() - 1 - i : i], h);
}

void Actuators::addSpringForces(State& state)
{
    for (Spring& spring : springs_) {
        if (!spring.alive || sleeps(state, spring.a) || sleeps(state, spring.b)) continue;
        const Vec2 apart = spring.a.position(state) - spring.b.position(state);
        const double length = apart.norm();
        if (spring.tearLength > 0 && length > spring.tearLength) spring.alive = 0;
        if (!spring.alive || !(length > 1e-12)) continue;
        AnchorJacobian jacobian;
        jacobian.add(state, spring.a, apart / length);
        jacobian.add(state, spring.b, -apart / length);
        jacobian.addForce(state, -spring.ks * (length - spring.restLength) - spring.kd * jacobian.rate(state));
    }
    for (AngularSpring& spring : angularSprings_) {
        if (sleeps(state, spring.a) || sleeps(state, spring.centre) || sleeps(state, spring.b)) continue;
        AnchorJacobian jacobian;
        if (!angleJacobian(state, spring.a, spring.centre, spring.b, jacobian)) continue;
        spring.angle += wrapped(angleNow(state, spring.a, spring.centre, spring.b) - spring.angle);
        jacobian.addForce(state, -spring.ks * (spring.angle - spring.restAngle) - spring.kd * jacobian.rate(state));
    }
}

double Actuators::energy(const State& state, const Spring& spring, double h)
{
    if (sleeps(state, spring.a) || sleeps(state, spring.b)) return 0;
    const Vec2 apart = spring.a.position(state) - spring.b.position(state);
    const Vec2 before = apart - h * (spring.a.velocity(state) - spring.b.velocity(state));
    return 0.5 * spring.stiffness * (apart.norm() - spring.restLength) * (before.norm() - spring.restLength);
}

double Actuators::energy(const State& state, const AngularSpring& spring, double h)
{
    if (sleeps(state, spring.a) || sleeps(state, spring.centre) || sleeps(state, spring.b)) return 0;
    const auto strain = [&](double back) {
        const auto at = [&](const AnchorPoint& anchor) {
            return Vec2(anchor.position(state) - back * anchor.velocity(state));
        };
        const Vec2 middle = at(spring.centre);
        const double angle = angleBetween(at(spring.a) - middle, at(spring.b) - middle);
        return spring.angle + wrapped(angle - spring.angle) - spring.restAngle;
    };
    return 0.5 * spring.stiffness * strain(0) * strain(h);
}

void Actuators::apply(State& state, Spring& spring, double h)
{
    if (!spring.alive || sleeps(state, spring.a) || sleeps(state, spring.b)) return;
    const Vec2 apart = spring.a.position(state) - spring.b.position(state);
    const double length = std::sqrt(apart.squaredNorm());
    if (spring.tearLength > 0 && length > spring.tearLength) {
        spring.alive = 0;
        return;
    }
    if (!(length > 1e-12)) return;
    const Vec2 along = apart / length;
    AnchorJacobian jacobian;
    jacobian.add(state, spring.a, along);
    jacobian.add(state, spring.b, -along);
    const double compliance = jacobian.compliance(state);
    if (!(compliance > 0)) return;
    const double elastic = -h * spring.stiffness * (length - spring.restLength);
    const double speed = jacobian.rate(state) + compliance * elastic;
    jacobian.applyTurning(state, elastic - h * spring.damping / (1 + h * spring.damping * compliance) * speed,
                          kMostTurn / h);
}

void Actuators::apply(State& state, AngularSpring& spring, double h)
{
    if (sleeps(state, spring.a) || sleeps(state, spring.centre) || sleeps(state, spring.b)) return;
    AnchorJacobian jacobian;
    if (!angleJacobian(state, spring.a, spring.centre, spring.b, jacobian)) return;
    spring.angle += wrapped(angleNow(state, spring.a, spring.centre, spring.b) - spring.angle);
    const double compliance = jacobian.compliance(state);
    if (!(compliance > 0)) return;
    const double hold = std::min(1.0, kStiffeningReserve * spring.restCompliance / compliance);
    const double elastic = -h * spring.stiffness * hold * (spring.angle - spring.restAngle);
    const double rate = jacobian.rate(state) + compliance * elastic;
    jacobian.apply(state, elastic - h * spring.damping / (1 + h * spring.damping * compliance) * rate);
}

}  // namespace jet::physics
