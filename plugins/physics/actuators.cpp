#include "actuators.hpp"

namespace jet::physics {

namespace {

constexpr double kStiffeningReserve = 2.0;  // see soft_angular.cpp
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

/// The part of its stiffness that an angular spring keeps, by the lengths of its arms: short ones would make it ever
/// stiffer (as 1 / length²), so from where that is the reserve on it fades, and with it what the spring holds.
struct Fading {
    Vec2 armA, armB;
    double perA, perB;  // 1 / units²: up to 1 / them the arms' squared lengths are short
    double keptA, keptB;

    Fading(const Vec2& a, const Vec2& b, double restA, double restB)
        : armA(a), armB(b), perA(kStiffeningReserve / restA), perB(kStiffeningReserve / restB),
          keptA(std::min(1.0, perA * a.squaredNorm())), keptB(std::min(1.0, perB * b.squaredNorm()))
    {
    }
    double kept() const { return keptA * keptB; }
    /// How it changes as the ends move.
    Vec2 slopeA() const { return keptA < 1 ? Vec2(2 * keptB * perA * armA) : Vec2(0, 0); }
    Vec2 slopeB() const { return keptB < 1 ? Vec2(2 * keptA * perB * armB) : Vec2(0, 0); }
};

/// A pure couple: on a soft body spread as a rigid turning about its centre of mass, so that it does not bend it.
void addCouple(State& state, const BodyRecord& body, double torque)
{
    Nodes& nodes = state.nodes;
    if (body.rigid) {
        nodes.torque.add(body.nodes.first, torque);
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
        nodes.force.add(n, torque * nodes.mass[n] / inertia * perpendicular(nodes.position[n] - centre));
}

}  // namespace

ActuatorHandle Actuators::add(const State& state, const SpringActuatorDef& def)
{
    Spring spring;
    spring.a = resolveAnchor(state, def.a), spring.b = resolveAnchor(state, def.b);
    spring.restLength = def.restLength, spring.ks = def.ks, spring.kd = def.kd;
    if (spring.restLength < 0) spring.restLength = (spring.a.position(state) - spring.b.position(state)).norm();
    if (def.tearRatio > 0) spring.tearLength = spring.restLength * def.tearRatio;
    return springs_.put(spring);
}

ActuatorHandle Actuators::add(const State& state, const AngularSpringActuatorDef& def)
{
    AngularSpring spring;
    spring.a = resolveAnchor(state, def.a), spring.centre = resolveAnchor(state, def.centre);
    spring.b = resolveAnchor(state, def.b);
    spring.restAngle = def.restAngle, spring.ks = def.ks, spring.kd = def.kd;
    const Vec2 middle = spring.centre.position(state);
    spring.restA = (spring.a.position(state) - middle).squaredNorm();
    spring.restB = (spring.b.position(state) - middle).squaredNorm();
    const double angle = angleNow(state, spring.a, spring.centre, spring.b);
    if (def.restFromPose) spring.restAngle = angle;
    spring.angle = spring.restAngle + wrapped(angle - spring.restAngle);
    AnchorJacobian jacobian;
    if (angleJacobian(state, spring.a, spring.centre, spring.b, jacobian))
        spring.restCompliance = jacobian.compliance(state);
    return angularSprings_.put(spring);
}

ActuatorHandle Actuators::add(const State& state, const TorqueActuatorDef& def)
{
    return torques_.put({resolveAnchor(state, def.at), def.value});
}

ActuatorHandle Actuators::add(const State& state, const ForceActuatorDef& def)
{
    return forces_.put({resolveAnchor(state, def.at), def.force});
}

Index Actuators::count(ActuatorKind kind) const
{
    switch (kind) {
    case ActuatorKind::Spring: return static_cast<Index>(springs_.size());
    case ActuatorKind::AngularSpring: return static_cast<Index>(angularSprings_.size());
    case ActuatorKind::Torque: return static_cast<Index>(torques_.size());
    case ActuatorKind::Force: return static_cast<Index>(forces_.size());
    case ActuatorKind::ForceField: break;
    }
    return 0;
}

bool Actuators::exists(ActuatorKind kind, ActuatorHandle handle) const
{
    if (handle >= count(kind)) return false;
    switch (kind) {
    case ActuatorKind::Spring: return !springs_[handle].removed;
    case ActuatorKind::AngularSpring: return !angularSprings_[handle].removed;
    case ActuatorKind::Torque: return !torques_[handle].removed;
    case ActuatorKind::Force: return !forces_[handle].removed;
    case ActuatorKind::ForceField: break;
    }
    return false;
}

void Actuators::remove(ActuatorKind kind, ActuatorHandle handle)
{
    switch (kind) {
    case ActuatorKind::Spring: springs_.remove(handle).alive = 0; return;
    case ActuatorKind::AngularSpring: angularSprings_.remove(handle); return;
    case ActuatorKind::Torque: torques_.remove(handle); return;
    case ActuatorKind::Force: forces_.remove(handle); return;
    case ActuatorKind::ForceField: return;
    }
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

void Actuators::setAngularSpring(ActuatorHandle handle, std::optional<double> restAngle, double ks, double kd)
{
    AngularSpring& spring = angularSprings_[handle];
    spring.ks = ks, spring.kd = kd;
    if (!restAngle || *restAngle == spring.restAngle) return;
    spring.restAngle = *restAngle;
    spring.angle = spring.restAngle + wrapped(spring.angle - spring.restAngle);
}

bool Actuators::isSet(ActuatorHandle handle, std::optional<double> restAngle, double ks, double kd) const
{
    const AngularSpring& spring = angularSprings_[handle];
    return restAngle.value_or(spring.restAngle) == spring.restAngle && ks == spring.ks && kd == spring.kd;
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
    eachOf(springs_, backwards, [&](Spring& spring) { apply(state, spring, h); });
    eachOf(angularSprings_, backwards, [&](AngularSpring& spring) { apply(state, spring, h); });
}

/// Dampers one after the other are together no damper of what a stiff body that they share does; those and back again
/// are (docs/decisions/0086).
void Actuators::brake(State& state, double h, bool backwards)
{
    const auto linear = [&] { eachOf(springs_, backwards, [&](Spring& spring) { brake(state, spring, h); }); };
    if (!backwards) linear();
    eachOf(angularSprings_, backwards, [&](AngularSpring& spring) { brake(state, spring, h); });
    if (backwards) linear();
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
        if (spring.removed || sleeps(state, spring.a) || sleeps(state, spring.centre) || sleeps(state, spring.b))
            continue;
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
    double kept[2] = {};
    const auto strain = [&](double back, double& hold) {
        const auto at = [&](const AnchorPoint& anchor) {
            return Vec2(anchor.position(state) - back * anchor.velocity(state));
        };
        const Vec2 middle = at(spring.centre), armA = at(spring.a) - middle, armB = at(spring.b) - middle;
        hold = Fading(armA, armB, spring.restA, spring.restB).kept();
        return spring.angle + wrapped(angleBetween(armA, armB) - spring.angle) - spring.restAngle;
    };
    const double now = strain(0, kept[0]), before = strain(h, kept[1]);
    return 0.5 * spring.stiffness * std::sqrt(kept[0] * kept[1]) * now * before;
}

/// The line of a whole spring as it lies; false where it has none.
bool Actuators::lineOf(const State& state, const Spring& spring, Line& line)
{
    if (!spring.alive || sleeps(state, spring.a) || sleeps(state, spring.b)) return false;
    const Vec2 apart = spring.a.position(state) - spring.b.position(state);
    line.length = std::sqrt(apart.squaredNorm());
    if (!(line.length > 1e-12)) return false;
    line.along = apart / line.length;
    line.jacobian.add(state, spring.a, line.along);
    line.jacobian.add(state, spring.b, -line.along);
    line.compliance = line.jacobian.compliance(state);
    return true;
}

/// What a damper gave in the substep before along another line is not given along this one.
void Actuators::apply(State& state, Spring& spring, double h)
{
    Line line;
    if (!lineOf(state, spring, line)) return;
    if (spring.tearLength > 0 && line.length > spring.tearLength) {
        spring.alive = 0;
        return;
    }
    if (!(line.compliance > 0)) return;
    const double elastic = -h * spring.stiffness * (line.length - spring.restLength);
    double braking = spring.braking.dot(line.along);
    if (line.jacobian.turns(state, elastic + braking) > kMostTurn / h) {
        // What it would turn too fast it may not once it is damped.
        const double damping = h * spring.damping;
        braking = -(line.jacobian.rate(state) + line.compliance * elastic) / (1 / damping + line.compliance);
    }
    spring.braking = braking * line.along;
    line.jacobian.applyTurning(state, elastic + braking, kMostTurn / h);
}

/// Where an arm is so short that the spring holds less, it draws that arm in by the slope of what it holds, implicitly,
/// as that may be stiff, and nothing is left where the arm passes the centre, which turns it by half a turn at once: as
/// within soft bodies (soft_angular.cpp). Nor is it wound there.
void Actuators::apply(State& state, AngularSpring& spring, double h)
{
    if (spring.removed || sleeps(state, spring.a) || sleeps(state, spring.centre) || sleeps(state, spring.b)) return;
    AnchorJacobian jacobian;
    if (!angleJacobian(state, spring.a, spring.centre, spring.b, jacobian)) return;
    const Vec2 middle = spring.centre.position(state);
    const Fading fading(spring.a.position(state) - middle, spring.b.position(state) - middle, spring.restA,
                        spring.restB);
    spring.angle += wrapped(angleBetween(fading.armA, fading.armB) - spring.angle);
    if (fading.kept() < 1) spring.angle = spring.restAngle + wrapped(spring.angle - spring.restAngle);
    const double compliance = jacobian.compliance(state);
    if (!(compliance > 0)) return;
    const double strain = spring.angle - spring.restAngle;
    const double hold = std::min(fading.kept(), kStiffeningReserve * spring.restCompliance / compliance);
    jacobian.apply(state, spring.braking - h * spring.stiffness * hold * strain);

    const double twice = spring.stiffness * fading.kept() * strain * strain;  // what it holds
    if (!(fading.kept() < 1 && twice > 0)) return;
    const double each = -0.5 * spring.stiffness * strain * strain;
    const Vec2 drawA = each * fading.slopeA(), drawB = each * fading.slopeB();
    AnchorJacobian draw;
    draw.add(state, spring.a, drawA);
    draw.add(state, spring.centre, -(drawA + drawB));
    draw.add(state, spring.b, drawB);
    const double power = draw.rate(state), give = draw.compliance(state);
    draw.apply(state, h * (1 - h * power / twice) / (1 + h * h * give / twice));
}

/// A soft row, as joints and contacts have: its impulse starts as that of the substep before, so that at rest joints
/// bear what they bear, and comes to −h kd times the rate by what is missing. Damped once, before joints have their
/// say, it would take from what gravity gives in free fall.
double Actuators::change(const State& state, const AnchorJacobian& jacobian, double damping, double braking)
{
    return -(jacobian.rate(state) + braking / damping) / (1 / damping + jacobian.compliance(state));
}

void Actuators::brake(State& state, Spring& spring, double h)
{
    const double damping = h * spring.damping;
    if (!(damping > 0)) {
        spring.braking = Vec2(0, 0);
        return;
    }
    Line line;
    if (!lineOf(state, spring, line)) return;
    const double was = spring.braking.dot(line.along), more = change(state, line.jacobian, damping, was);
    spring.braking = (was + more) * line.along;
    if (isFinite(spring.braking)) return line.jacobian.applyTurning(state, more, kMostTurn / h);
    spring.braking = Vec2(0, 0);  // what ran away starts from nothing
}

void Actuators::brake(State& state, AngularSpring& spring, double h)
{
    if (spring.removed || sleeps(state, spring.a) || sleeps(state, spring.centre) || sleeps(state, spring.b)) return;
    AnchorJacobian jacobian;
    const double damping = h * spring.damping;
    if (!(damping > 0) || !angleJacobian(state, spring.a, spring.centre, spring.b, jacobian)) {
        spring.braking = 0;
        return;
    }
    const double more = change(state, jacobian, damping, spring.braking);
    spring.braking += more;
    if (std::isfinite(spring.braking)) return jacobian.apply(state, more);
    spring.braking = 0;
}

}  // namespace jet::physics
