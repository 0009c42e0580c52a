// Angular springs of soft bodies (soft_springs.hpp).
#include "soft_springs.hpp"

#include <algorithm>
#include <utility>

namespace jet::physics {

namespace {

// Collapsing arms make an angular spring ever stiffer (as 1 / length²). Up to this multiple of the stiffness at rest is
// inside the step's reserve; beyond it the torque is held back.
constexpr double kStiffeningReserve = 2.0;

double angleBetween(const Vec2& armA, const Vec2& armB) { return angleOf(cross(armA, armB), armA.dot(armB)); }

/// The gradient of the angle from arm a to arm b; that of the centre is minus the sum, so forces and torques sum to
/// zero.
struct AngleGradient {
    Vec2 a, b;
    bool valid;

    AngleGradient(const Vec2& armA, const Vec2& armB)
    {
        const double lengthA = armA.squaredNorm(), lengthB = armB.squaredNorm();
        valid = lengthA > 1e-24 && lengthB > 1e-24;
        if (valid) a = -perpendicular(armA) / lengthA, b = perpendicular(armB) / lengthB;
    }
    Vec2 centre() const { return -(a + b); }
};

}  // namespace

/// The ends of an angular spring as they are.
struct SoftSprings::Corner {
    Vec2 armA, armB;
    AngleGradient gradient;
    double invA, invCentre, invB;
    double compliance = 0;

    Corner(const State& state, const Angular& spring)
        : armA(state.nodes.position[spring.a] - state.nodes.position[spring.centre]),
          armB(state.nodes.position[spring.b] - state.nodes.position[spring.centre]), gradient(armA, armB),
          invA(state.nodes.invMass[spring.a]), invCentre(state.nodes.invMass[spring.centre]),
          invB(state.nodes.invMass[spring.b])
    {
        if (gradient.valid) compliance = give(gradient.a, gradient.b);
    }
    /// What forces on the ends, and against both on the centre, change velocities along themselves by.
    double give(const Vec2& onA, const Vec2& onB) const
    {
        return invA * onA.squaredNorm() + invCentre * (onA + onB).squaredNorm() + invB * onB.squaredNorm();
    }
    double angle() const { return angleBetween(armA, armB); }
    /// The part of its stiffness that the spring keeps.
    double hold(const Angular& spring) const
    {
        return compliance > 0 ? std::min(1.0, kStiffeningReserve * spring.restCompliance / compliance) : 0;
    }
    /// How the compliance grows as the ends move.
    std::pair<Vec2, Vec2> slope() const
    {
        const double lengthA = armA.squaredNorm(), lengthB = armB.squaredNorm(), both = gradient.a.dot(gradient.b);
        const Vec2 turningA = invCentre * (perpendicular(gradient.b) - 2 * both * armA);
        const Vec2 turningB = -invCentre * (perpendicular(gradient.a) + 2 * both * armB);
        return {2 / lengthA * (turningA - (invA + invCentre) / lengthA * armA),
                2 / lengthB * (turningB - (invB + invCentre) / lengthB * armB)};
    }
    double rate(const Nodes& nodes, const Angular& spring, const Vec2& alongA, const Vec2& alongB) const
    {
        return alongA.dot(nodes.velocity[spring.a]) - (alongA + alongB).dot(nodes.velocity[spring.centre]) +
               alongB.dot(nodes.velocity[spring.b]);
    }
    void push(Nodes& nodes, const Angular& spring, double impulse, const Vec2& alongA, const Vec2& alongB) const
    {
        nodes.velocity[spring.a] += invA * impulse * alongA;
        nodes.velocity[spring.centre] -= invCentre * impulse * (alongA + alongB);
        nodes.velocity[spring.b] += invB * impulse * alongB;
    }
};

void SoftSprings::addAngular(const State& state, const AngularSpringDef& def, std::span<const Index> nodeOf, Index body,
                             Index place)
{
    Angular spring;
    spring.body = body;
    spring.a = nodeOf[def.a], spring.centre = nodeOf[def.centre], spring.b = nodeOf[def.b];
    spring.restAngle = def.restAngle, spring.ks = def.ks, spring.kd = def.kd;
    const Corner corner(state, spring);
    spring.angle = def.restAngle + wrapped(corner.angle() - def.restAngle);
    spring.restCompliance = corner.compliance;
    if (place == angular_.size()) angular_.emplace_back();
    angular_[place] = spring, ++turning_;
}

double SoftSprings::energy(const State& state, const Angular& spring, double h)
{
    const Nodes& nodes = state.nodes;
    const Corner corner(state, spring);
    const auto strain = [&](const Vec2& armA, const Vec2& armB) {
        return spring.angle + wrapped(angleBetween(armA, armB) - spring.angle) - spring.restAngle;
    };
    const Vec2& carried = nodes.velocity[spring.centre];
    const double before = strain(corner.armA - h * (nodes.velocity[spring.a] - carried),
                                 corner.armB - h * (nodes.velocity[spring.b] - carried));
    return 0.5 * spring.stiffness * corner.hold(spring) * strain(corner.armA, corner.armB) * before;
}

void SoftSprings::applyAngular(State& state, double h, bool backwards)
{
    for (std::size_t i = 0; i < angular_.size(); ++i) {
        Angular& spring = angular_[backwards ? angular_.size() - 1 - i : i];
        if (spring.a != kNone && !state.bodies[spring.body].asleep) applyAngularSpring(state, spring, h);
    }
}

void SoftSprings::addAngularForces(State& state)
{
    Nodes& nodes = state.nodes;
    for (Angular& spring : angular_) {
        if (spring.a == kNone) continue;
        const Vec2 armA = nodes.position[spring.a] - nodes.position[spring.centre];
        const Vec2 armB = nodes.position[spring.b] - nodes.position[spring.centre];
        const AngleGradient gradient(armA, armB);
        if (!gradient.valid) continue;
        spring.angle += wrapped(angleBetween(armA, armB) - spring.angle);
        const double rate = nodes.velocity[spring.a].dot(gradient.a) +
                            nodes.velocity[spring.centre].dot(gradient.centre()) +
                            nodes.velocity[spring.b].dot(gradient.b);
        const double torque = -spring.ks * (spring.angle - spring.restAngle) - spring.kd * rate;
        nodes.force.add(spring.a, torque * gradient.a);
        nodes.force.add(spring.centre, torque * gradient.centre());
        nodes.force.add(spring.b, torque * gradient.b);
    }
}

/// With arms so short that its torque is held back by a part p, a spring holds ½ p ks φ², and nothing where an arm
/// passes the centre, which turns it by half a turn at once. So it draws its arms in, or they would bring what they
/// then hold from nowhere when they grow again: by the gradient of p, implicitly, as that may be stiff. Nor is it wound
/// there.
void SoftSprings::applyAngularSpring(State& state, Angular& spring, double h)
{
    if (spring.a == kNone) return;
    Nodes& nodes = state.nodes;
    const Corner corner(state, spring);
    const AngleGradient& gradient = corner.gradient;
    if (!gradient.valid) return;
    spring.angle += wrapped(corner.angle() - spring.angle);
    if (!(corner.compliance > 0)) return;
    const double hold = corner.hold(spring);
    if (hold < 1) spring.angle = spring.restAngle + wrapped(spring.angle - spring.restAngle);
    const double strain = spring.angle - spring.restAngle, elastic = -h * spring.stiffness * hold * strain;
    const double rate = corner.rate(nodes, spring, gradient.a, gradient.b) + corner.compliance * elastic;
    const double braked = h * spring.damping / (1 + h * spring.damping * corner.compliance) * rate;
    corner.push(nodes, spring, elastic - braked, gradient.a, gradient.b);

    const double twice = spring.stiffness * hold * strain * strain;  // what it holds
    if (!(hold < 1 && twice > 0)) return;
    const auto [slopeA, slopeB] = corner.slope();
    const Vec2 drawA = 0.5 * twice / corner.compliance * slopeA, drawB = 0.5 * twice / corner.compliance * slopeB;
    const double power = corner.rate(nodes, spring, drawA, drawB), give = corner.give(drawA, drawB);
    corner.push(nodes, spring, h * (1 - h * power / twice) / (1 + h * h * give / twice), drawA, drawB);
}

}  // namespace jet::physics
