#include "contact_solver.hpp"

namespace jet::physics {

namespace {

// Units / s: what runs away, or is not a number, is stopped when it is moved, and takes nothing along before.
constexpr double kAbsurdSpeed = 1e30, kAbsurdImpulse = 1e80;
constexpr double kHertz = 60, kHertzPerSubstepRate = 0.25, kDampingRatio = 10;
constexpr double kPushLengthsPerSecond = 4;  // overlaps are pushed out no faster than this many body lengths a second
// What pushes overlaps out, and what is carried over, moves no particle more times faster than what passes at the
// contact: a wall that is pinned or heavy at one end, and pushed beside it, would throw the other.
constexpr double kMostLever = 2;
constexpr double kSharpInset = 2, kBluntOverhang = 2;  // in slops
constexpr int kRestitutionPasses = 4, kHitPasses = 12;
constexpr double kHitSlops = 40;  // contacts closing faster than this many slops a substep are hits

}  // namespace

void ContactSet::begin(const State& state)
{
    heads.assign(points.size(), ContactHead());
    for (ContactPoint& c : points) {
        c.nodeA = state.points.node[c.point];
        c.nodeB0 = state.points.node[state.walls.first[c.wall]];
        c.nodeB1 = state.points.node[state.walls.second[c.wall]];
        c.plain = !state.bodies[c.bodyA].rigid && !state.bodies[c.bodyB].rigid;
        c.lone = !state.bodies[c.bodyA].rigid && state.bodies[c.bodyB].fixed;
        c.active = false;
        if (!c.lone) continue;
        c.first = state.pointNow(state.walls.first[c.wall]);
        c.edge = state.pointNow(state.walls.second[c.wall]) - c.first;
    }
}

ContactSolver::ContactSolver(State& state, ContactSet& contacts, double h, double gravity)
    : state_(state), contacts_(contacts), h_(h), restSpeed_(4 * gravity * h),
      moving_(softness(std::min(kHertz, kHertzPerSubstepRate / h), kDampingRatio, h)),
      fixed_(softness(2 * std::min(kHertz, kHertzPerSubstepRate / h), kDampingRatio, h))
{
}

/// A damped spring of that frequency, integrated implicitly over h, as a bias rate and two scales of the impulse.
ContactSolver::Softness ContactSolver::softness(double hertz, double dampingRatio, double h)
{
    const double omega = 2 * kPi * hertz;
    const double a1 = 2 * dampingRatio + h * omega, a2 = h * omega * a1, a3 = 1 / (1 + a2);
    return {omega / a1, a2 * a3, a3};
}

Vec2 ContactSolver::relativeVelocity(const ContactPoint& c) const
{
    const Nodes& nodes = state_.nodes;
    if (c.lone) return nodes.velocity[c.nodeA];
    if (c.plain)
        return nodes.velocity[c.nodeA] - c.weightB0 * nodes.velocity[c.nodeB0] - c.weightB1 * nodes.velocity[c.nodeB1];
    return nodes.velocityAt(c.nodeA, c.armA) - c.weightB0 * nodes.velocityAt(c.nodeB0, c.armB) -
           c.weightB1 * nodes.velocityAt(c.nodeB1, c.armB);
}

void ContactSolver::applyImpulse(const ContactPoint& c, const Vec2& impulse)
{
    // Not even what is fixed would stay a number.
    if (!(std::abs(impulse.x()) + std::abs(impulse.y()) < kAbsurdImpulse)) return;
    if (c.lone) {
        state_.nodes.velocity[c.nodeA] += state_.nodes.invMass[c.nodeA] * impulse;
        return;
    }
    if (c.plain) {
        Nodes& nodes = state_.nodes;
        nodes.velocity[c.nodeA] += nodes.invMass[c.nodeA] * impulse;
        nodes.velocity[c.nodeB0] -= (nodes.invMass[c.nodeB0] * c.weightB0) * impulse;
        nodes.velocity[c.nodeB1] -= (nodes.invMass[c.nodeB1] * c.weightB1) * impulse;
        return;
    }
    state_.nodes.applyImpulse(c.nodeA, c.armA, impulse);
    state_.nodes.applyImpulse(c.nodeB0, c.armB, -c.weightB0 * impulse);
    if (c.weightB1 != 0) state_.nodes.applyImpulse(c.nodeB1, c.armB, -c.weightB1 * impulse);
}

double ContactSolver::effectiveMass(const ContactPoint& c, const Vec2& direction) const
{
    const Nodes& nodes = state_.nodes;
    if (c.lone) return nodes.invMass[c.nodeA] > 0 ? 1 / nodes.invMass[c.nodeA] : 0;
    const double leverA = cross(c.armA, direction), leverB = cross(c.armB, direction);
    const double inverse =
        nodes.invMass[c.nodeA] + nodes.invInertia[c.nodeA] * leverA * leverA +
        c.weightB0 * c.weightB0 * (nodes.invMass[c.nodeB0] + nodes.invInertia[c.nodeB0] * leverB * leverB) +
        c.weightB1 * c.weightB1 * nodes.invMass[c.nodeB1];
    return inverse > 0 ? 1 / inverse : 0;
}

/// What an impulse changes the velocity of one of its nodes by at most, 1 / mass. The wall's ends may differ in mass.
double ContactSolver::reaction(const ContactPoint& c) const
{
    const auto& inverse = state_.nodes.invMass;
    const double along = std::clamp(c.along, 0.0, 1.0);
    return std::max({inverse[c.nodeA], (1 - along) * inverse[c.nodeB0], along * inverse[c.nodeB1]});
}

bool ContactSolver::uneven(const ContactPoint& c) const
{
    return state_.nodes.invMass[c.nodeB0] != state_.nodes.invMass[c.nodeB1];
}

double ContactSolver::pushSpeed(const ContactPoint& c) const
{
    const double speed = kPushLengthsPerSecond * c.slop / kSlopPerLength;
    return uneven(c) ? speed * std::min(1.0, kMostLever / (c.normalMass * reaction(c))) : speed;
}

/// Geometry as the nodes stand now. Returns for how many substeps it need not be looked at again.
std::uint8_t ContactSolver::refresh(ContactPoint& c)
{
    const Nodes& nodes = state_.nodes;
    c.active = false;
    const Vec2 at = c.plain || c.lone ? nodes.position[c.nodeA] : state_.pointNow(c.point);
    Vec2 first = c.first, edge = c.edge;
    if (c.plain && !c.lone) {
        first = nodes.position[c.nodeB0];
        edge = nodes.position[c.nodeB1] - first;
    } else if (!c.lone) {
        first = state_.pointNow(state_.walls.first[c.wall]);
        edge = state_.pointNow(state_.walls.second[c.wall]) - first;
    }
    const double squared = edge.squaredNorm();
    if (!(squared > 1e-24)) return 0;
    const double length = std::sqrt(squared);
    c.normal = perpendicular(edge) * (state_.walls.outward[c.wall] / length);
    c.separation = (at - first).dot(c.normal) - c.thickness;
    c.along = (at - first).dot(edge) / squared;
    // A thick border is round where two of its walls meet: there the corner itself is what is touched.
    const bool beyond = c.thickness > 0 && c.along < 0 && c.separation > -c.thickness && !c.inside;
    const double away = beyond ? (at - first).norm() : 0;
    c.round = away > 1e-12;
    if (c.round) c.normal = (at - first) / away, c.separation = away - c.thickness;

    c.armA = at - nodes.position[c.nodeA];
    c.armB = Vec2(0, 0);
    const double along = std::clamp(c.along, 0.0, 1.0);
    if (c.nodeB0 == c.nodeB1) {
        c.weightB0 = 1, c.weightB1 = 0;
        c.armB = first + along * edge - nodes.position[c.nodeB0];
    } else {
        c.weightB0 = 1 - along, c.weightB1 = along;
    }
    const Vec2 velocity = relativeVelocity(c);
    c.approachSpeed = velocity.dot(c.normal);
    c.active = decideActive(c, length, velocity.dot(edge) / squared);
    return c.active ? 0 : idleFor(c);
}

/// Contacts that are several times farther than they come in a substep may wait. The room they need before they can
/// act, and four times their speed, are left.
std::uint8_t ContactSolver::idleFor(const ContactPoint& c) const
{
    const double room = c.separation - 8 * c.slop - c.surprise;
    const double pace = 4 * std::abs(c.approachSpeed) * h_ + c.slop;
    return room > pace ? static_cast<std::uint8_t>(std::min(room / pace, 8.0)) : 0;
}

/// Is the point at the wall, or about to come to it in this substep? `slide`: change of `along` per second.
bool ContactSolver::decideActive(ContactPoint& c, double wallLength, double slide) const
{
    const auto overhang = [&](bool inset) {
        return inset ? -std::min(kSharpInset * c.slop, 0.25 * wallLength) : kBluntOverhang * c.slop;
    };
    if (c.inside) return true;
    double along = c.along;
    if (c.separation > 0) {
        const double distance = -c.approachSpeed * h_;
        // What cannot arrive in this substep is left out of the solving; the margin is for what the solving adds.
        if (c.separation > 2 * distance + 4 * c.slop + c.surprise) return false;
        if (distance > 0) along += slide * h_ * std::min(1.0, c.separation / distance);
    }
    const double fromFirst = along * wallLength, fromSecond = (1 - along) * wallLength;
    const bool thick = c.thickness > 0;
    const double firstReach = thick ? 0 : overhang(c.firstInset), secondReach = thick ? 0 : overhang(c.secondInset);
    if ((fromFirst < -firstReach && !c.round) || fromSecond < -secondReach) return false;
    // A point that is behind the wall without having come to it went round its end: it is not to be pulled through.
    if (c.separation + c.thickness < -kTouchDepth * c.slop && !c.engaged) return false;
    c.engaged = true;
    return true;
}

/// Nothing weighs on what sleeps, so a contact would push it away from what stands; there each substep is like the
/// last.
bool ContactSolver::rests(const ContactPoint& c) const { return state_.atRest(c.bodyA, c.bodyB); }

void ContactSolver::prepare()
{
    contacts_.active.clear();
    const Nodes& nodes = state_.nodes;
    for (Index i = 0; i < contacts_.points.size(); ++i) {
        ContactHead& head = contacts_.heads[i];
        if (head.idle > 0) {
            --head.idle;
            continue;
        }
        ContactPoint& c = contacts_.points[i];
        if (!c.resolve) continue;
        if (rests(c)) {
            c.stepImpulse += c.normalImpulse;
            continue;
        }
        const bool uneven = this->uneven(c);
        const double before = uneven ? reaction(c) : 0;
        head.idle = refresh(c);
        if (!c.active) {
            c.normalImpulse = c.tangentImpulse = 0;
            continue;
        }
        if (uneven) {
            const double share = std::min(1.0, kMostLever * before / std::max(reaction(c), 1e-300));
            c.normalImpulse *= share, c.tangentImpulse *= share;
        }
        contacts_.active.push_back(i);
        c.keptImpulse = c.normalImpulse;
        hit_ |= -c.approachSpeed * h_ > kHitSlops * c.slop;
        c.normalMass = effectiveMass(c, c.normal);
        c.tangentMass = c.plain || c.lone ? c.normalMass : effectiveMass(c, perpendicular(c.normal));
        c.againstFixed =
            c.lone || nodes.invMass[c.nodeA] == 0 || (nodes.invMass[c.nodeB0] == 0 && nodes.invMass[c.nodeB1] == 0);
    }
    each([&](ContactPoint& c) {
        applyImpulse(c, c.normalImpulse * c.normal + c.tangentImpulse * perpendicular(c.normal));
    });
}

/// Solves a contact with what it acts on: relative() is the velocity at the contact, act(impulse) changes it.
template <class Relative, class Act>
void ContactSolver::solveWith(ContactPoint& c, Pass pass, Relative&& relative, Act&& act) const
{
    // Normal: the separation at the end of the substep shall not be negative.
    const Softness& soft = c.againstFixed ? fixed_ : moving_;
    double bias = 0, massScale = 1, impulseScale = 0;
    if (c.separation > 0) {
        bias = c.separation / h_;
    } else if (pass == Pass::Push) {
        bias = std::max(soft.biasRate * std::min(0.0, c.separation + c.slop), -pushSpeed(c));
        const double deep = -(c.separation + c.slop) / (kYieldSlops * c.slop);
        const double yields = c.engaged ? std::clamp(2 - deep, 0.0, 1.0) : 1;
        massScale = soft.massScale + (1 - yields) * (1 - soft.massScale);
        impulseScale = yields * soft.impulseScale;
    }
    const double normalSpeed = relative().dot(c.normal);
    if (!(std::abs(normalSpeed) < kAbsurdSpeed)) return;
    const double wanted = -c.normalMass * massScale * (normalSpeed + bias) - impulseScale * c.normalImpulse;
    const double normalImpulse = std::max(c.normalImpulse + wanted, 0.0);
    act((normalImpulse - c.normalImpulse) * c.normal);
    c.normalImpulse = normalImpulse;

    const Vec2 tangent = perpendicular(c.normal);
    const double most = c.friction * c.normalImpulse;
    const double slide = relative().dot(tangent);
    if (!(std::abs(slide) < kAbsurdSpeed)) return;
    const double tangentImpulse = std::clamp(c.tangentImpulse - c.tangentMass * slide, -most, most);
    act((tangentImpulse - c.tangentImpulse) * tangent);
    c.tangentImpulse = tangentImpulse;
}

void ContactSolver::solveOne(ContactPoint& c, Pass pass)
{
    if (c.lone) {
        Vec2& velocity = state_.nodes.velocity[c.nodeA];
        const double inverse = state_.nodes.invMass[c.nodeA];
        Vec2 now = velocity;
        solveWith(
            c, pass, [&] { return now; }, [&](const Vec2& impulse) { now += inverse * impulse; });
        velocity = now;
        return;
    }
    solveWith(
        c, pass, [&] { return relativeVelocity(c); }, [&](const Vec2& impulse) { applyImpulse(c, impulse); });
}

void ContactSolver::solve()
{
    // One pass a substep suffices for what rests. A hit must go through all it pushes together before anything moves.
    for (int pass = 0; pass < (hit_ ? kHitPasses : 1); ++pass) each([&](ContactPoint& c) { solveOne(c, Pass::Push); });
}

void ContactSolver::relax()
{
    // The nodes have moved by h times their velocities, and the separations with them.
    each([&](ContactPoint& c) { c.separation += h_ * relativeVelocity(c).dot(c.normal); });
    for (int pass = 0; pass < (hit_ ? kHitPasses : 1); ++pass) each([&](ContactPoint& c) { solveOne(c, Pass::Relax); });
    each([&](ContactPoint& c) { c.stepImpulse += c.normalImpulse; });
}

void ContactSolver::restitute()
{
    const auto bounces = [&](const ContactPoint& c) {
        return c.restitution > 0 && c.approachSpeed < -restSpeed_ && c.normalImpulse > 0;
    };
    bool any = false;
    each([&](const ContactPoint& c) { any |= bounces(c); });
    if (!any) return;
    for (int pass = 0; pass < kRestitutionPasses; ++pass) {
        each([&](ContactPoint& c) {
            if (!bounces(c)) return;
            const double missing = relativeVelocity(c).dot(c.normal) + c.restitution * c.approachSpeed;
            if (!(std::abs(missing) < kAbsurdSpeed)) return;
            const double impulse = std::max(c.normalImpulse - c.normalMass * missing, 0.0);
            applyImpulse(c, (impulse - c.normalImpulse) * c.normal);
            c.stepImpulse += impulse - c.normalImpulse;
            c.normalImpulse = impulse;
        });
    }
}

void ContactSolver::finish()
{
    restitute();
    if (!hit_) return;
    // The impulse of a hit is over with the hit: warm-starting from it would throw the bodies back.
    each([&](ContactPoint& c) {
        c.normalImpulse = std::min(c.normalImpulse, c.keptImpulse);
        const double most = c.friction * c.normalImpulse;
        c.tangentImpulse = std::clamp(c.tangentImpulse, -most, most);
    });
}

}  // namespace jet::physics
