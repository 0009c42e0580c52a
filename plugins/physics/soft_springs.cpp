#include "soft_springs.hpp"

namespace jet::physics {

namespace {

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
    double compliance(double invA, double invCentre, double invB) const
    {
        return invA * a.squaredNorm() + invCentre * centre().squaredNorm() + invB * b.squaredNorm();
    }
};

double angleBetween(const Vec2& armA, const Vec2& armB) { return angleOf(cross(armA, armB), armA.dot(armB)); }

// Collapsing arms make an angular spring ever stiffer (as 1 / length²). Up to this multiple of the stiffness at rest is
// inside the step's reserve; beyond it the torque is held back.
constexpr double kStiffeningReserve = 2.0;

}  // namespace

void SoftSprings::add(const SpringDef& def, Index firstNode)
{
    a_.push_back(firstNode + def.a);
    b_.push_back(firstNode + def.b);
    rest_.push_back(def.restLength);
    ks_.push_back(def.ks);
    kd_.push_back(def.kd);
    tear_.push_back(def.tearRatio > 0 ? def.restLength * def.tearRatio : 0);
    alive_.push_back(def.a != def.b);
    stiffness_.push_back(0);
    dampingShare_.push_back(0);
}

void SoftSprings::add(const State& state, const AngularSpringDef& def, Index firstNode)
{
    Angular spring{firstNode + def.a, firstNode + def.centre, firstNode + def.b, def.restAngle, def.ks, def.kd, 0, 0};
    const Nodes& nodes = state.nodes;
    const Vec2 armA = nodes.position[spring.a] - nodes.position[spring.centre];
    const Vec2 armB = nodes.position[spring.b] - nodes.position[spring.centre];
    spring.angle = def.restAngle + wrapped(angleBetween(armA, armB) - def.restAngle);
    const AngleGradient gradient(armA, armB);
    if (gradient.valid)
        spring.restCompliance =
            gradient.compliance(nodes.invMass[spring.a], nodes.invMass[spring.centre], nodes.invMass[spring.b]);
    angular_.push_back(spring);
}

void SoftSprings::addTo(StiffnessBounds& bounds, const State& state) const
{
    for (Index i = 0; i < springCount(); ++i) {
        if (!alive_[i]) continue;
        bounds.add(a_[i], ks_[i] * state.nodes.invMass[a_[i]]);
        bounds.add(b_[i], ks_[i] * state.nodes.invMass[b_[i]]);
    }
    for (const Angular& spring : angular_) {
        const double rate = spring.ks * spring.restCompliance;
        for (Index node : {spring.a, spring.centre, spring.b}) bounds.add(node, rate);
    }
}

void SoftSprings::prepare(const State& state, const StiffnessBounds& bounds, double h)
{
    for (Index i = 0; i < springCount(); ++i) {
        const double inverse = state.nodes.invMass[a_[i]] + state.nodes.invMass[b_[i]];
        stiffness_[i] = ks_[i] * std::min(bounds.share(a_[i], h), bounds.share(b_[i], h));
        // The stiffness taken away acts on through its implicit part, h ks v: as damping, which costs no stability.
        const double damping = kd_[i] + h * (ks_[i] - stiffness_[i]);
        dampingShare_[i] = inverse > 0 ? h * damping / (1 + h * damping * inverse) : 0;
    }
    for (Angular& spring : angular_) {
        const double share =
            std::min({bounds.share(spring.a, h), bounds.share(spring.centre, h), bounds.share(spring.b, h)});
        spring.stiffness = spring.ks * share;
        spring.damping = spring.kd + h * (spring.ks - spring.stiffness);
    }
}

void SoftSprings::apply(State& state, double h, bool backwards)
{
    if (backwards) {
        for (Index i = springCount(); i-- > 0;) applySpring(state, i, h);
        for (std::size_t i = angular_.size(); i-- > 0;) applyAngular(state, angular_[i], h);
    } else {
        for (Index i = 0; i < springCount(); ++i) applySpring(state, i, h);
        for (Angular& spring : angular_) applyAngular(state, spring, h);
    }
}

bool SoftSprings::anyTorn(Range springs) const
{
    for (Index i = springs.first; i < springs.end(); ++i)
        if (!alive_[i] && a_[i] != b_[i]) return true;
    return false;
}

void SoftSprings::applySpring(State& state, Index i, double h)
{
    if (!alive_[i]) return;
    Nodes& nodes = state.nodes;
    const Index a = a_[i], b = b_[i];
    const Vec2 apart = nodes.position[a] - nodes.position[b];
    const double length = std::sqrt(apart.squaredNorm());
    if (tear_[i] > 0 && length > tear_[i]) {
        alive_[i] = 0;
        return;
    }
    if (!(length > 1e-12)) return;
    const Vec2 along = apart / length;
    const double invA = nodes.invMass[a], invB = nodes.invMass[b];
    const double elastic = h * stiffness_[i] * (length - rest_[i]);
    const double speed = (nodes.velocity[a] - nodes.velocity[b]).dot(along) - (invA + invB) * elastic;
    const Vec2 impulse = (elastic + dampingShare_[i] * speed) * along;
    nodes.velocity[a] -= invA * impulse;
    nodes.velocity[b] += invB * impulse;
}

void SoftSprings::applyAngular(State& state, Angular& spring, double h)
{
    Nodes& nodes = state.nodes;
    const Vec2 armA = nodes.position[spring.a] - nodes.position[spring.centre];
    const Vec2 armB = nodes.position[spring.b] - nodes.position[spring.centre];
    const AngleGradient gradient(armA, armB);
    if (!gradient.valid) return;
    spring.angle += wrapped(angleBetween(armA, armB) - spring.angle);
    const double invA = nodes.invMass[spring.a], invC = nodes.invMass[spring.centre], invB = nodes.invMass[spring.b];
    const double compliance = gradient.compliance(invA, invC, invB);
    if (!(compliance > 0)) return;
    const double hold = std::min(1.0, kStiffeningReserve * spring.restCompliance / compliance);
    const double elastic = -h * spring.stiffness * hold * (spring.angle - spring.restAngle);
    const Vec2 atCentre = gradient.centre();
    const double rate = nodes.velocity[spring.a].dot(gradient.a) + nodes.velocity[spring.centre].dot(atCentre) +
                        nodes.velocity[spring.b].dot(gradient.b) + compliance * elastic;
    const double impulse = elastic - h * spring.damping / (1 + h * spring.damping * compliance) * rate;
    nodes.velocity[spring.a] += invA * impulse * gradient.a;
    nodes.velocity[spring.centre] += invC * impulse * atCentre;
    nodes.velocity[spring.b] += invB * impulse * gradient.b;
}

}  // namespace jet::physics
