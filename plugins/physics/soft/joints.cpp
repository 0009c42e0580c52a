#include "joints.hpp"

#include "mass_sums.hpp"

#include <jet/result.hpp>

#include <numeric>
#include <tuple>

namespace jet::physics::soft {

namespace {

// As of the rigid solver: joints are stiffer than contacts, and chains of them carry forces far.
constexpr double kHertz = 120, kHertzPerSubstepRate = 0.25, kDampingRatio = 2;
constexpr int kPasses = 2;
// Errors beyond so many lengths of the body, or radians, are not pushed out at once: a patch that gives way is not
// thrown.
constexpr double kFarLengths = 0.03, kFarTurn = 0.06;
constexpr double kTurn = 0.5;      // radians that a push turns a patch by at most
constexpr double kSettling = 0.5;  // seconds
// How a patch that is not like its shape at rest, or was not, turns to the best fit of that: rad / s.
constexpr double kFollow = 2, kRecover = 0.2;
constexpr int kNearest = 6;  // particles that hold a point which is none

std::string nameOf(JointDef::Kind kind)
{
    switch (kind) {
    case JointDef::Kind::Revolute: return "a revolute joint with a limit or a motor";
    case JointDef::Kind::Prismatic: return "a prismatic joint";
    case JointDef::Kind::Weld: return "a weld";
    case JointDef::Kind::Wheel: return "a wheel joint";
    case JointDef::Kind::Motor: return "a motor joint with a torque";
    default: return "a joint";
    }
}

/// By node, from the body's first; empty while it is whole.
std::vector<Index> piecesOf(const State& state, const BodyRecord& body)
{
    const std::vector<Index>& byPoint = body.soft->pieces;
    std::vector<Index> pieces(byPoint.empty() ? 0 : body.nodes.count);
    for (std::size_t p = 0; p < byPoint.size(); ++p)
        pieces[state.points.node[body.points.first + p] - body.nodes.first] = byPoint[p];
    return pieces;
}

/// Those within the radius; without one the particle at the point, or those nearest to it. All of one piece: that of
/// the nearest.
std::vector<Index> particlesAt(const State& state, const BodyRecord& body, const Anchor& anchor)
{
    std::vector<Index> nodes(body.nodes.count);
    std::iota(nodes.begin(), nodes.end(), body.nodes.first);
    const auto away = [&](Index n) { return (state.nodes.position[n] - anchor.point).squaredNorm(); };
    if (const std::vector<Index> pieces = piecesOf(state, body); !pieces.empty()) {
        const auto pieceOf = [&](Index n) { return pieces[n - body.nodes.first]; };
        const Index nearest =
            *std::min_element(nodes.begin(), nodes.end(), [&](Index p, Index q) { return away(p) < away(q); });
        nodes.erase(std::remove_if(nodes.begin(), nodes.end(), [&](Index n) { return pieceOf(n) != pieceOf(nearest); }),
                    nodes.end());
    }
    if (anchor.radius > 0) {
        nodes.erase(std::remove_if(nodes.begin(), nodes.end(),
                                   [&](Index n) { return away(n) > anchor.radius * anchor.radius; }),
                    nodes.end());
        return nodes;
    }
    std::sort(nodes.begin(), nodes.end(),
              [&](Index p, Index q) { return std::pair(away(p), p) < std::pair(away(q), q); });
    const bool atParticle = !nodes.empty() && away(nodes[0]) <= 1e-12 * body.length * body.length;
    nodes.resize(std::min<std::size_t>(nodes.size(), atParticle ? 1 : kNearest));
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

}  // namespace

Joints::Hold Joints::hold(const State& state, const Anchor& anchor)
{
    Hold hold;
    hold.local = anchor.point;
    if (anchor.body == kNoHandle) return hold;
    const BodyRecord& body = state.bodies[anchor.body];
    hold.rigid = body.rigid;
    hold.nodes = body.rigid ? std::vector<Index>{body.nodes.first} : particlesAt(state, body, anchor);
    if (hold.nodes.empty())
        throw Failure(Error("Physics: no particle of body " + std::to_string(anchor.body) +
                            " is within the radius of the joint's anchor; enlarge the radius or move the anchor."));
    if (!hold.rigid) {
        const MassSums sums = massSums(
            state.nodes, hold.nodes.size(), [&](std::size_t i) { return hold.nodes[i]; }, nullptr);
        for (const Index n : hold.nodes) hold.rest.push_back(state.nodes.position[n] - sums.centre);
        hold.gyration = sums.mass > 0 ? sums.inertia / sums.mass : 0;
    }
    const Pose pose = poseOf(state, hold);
    hold.angle = pose.angle;
    hold.local = unrotated(pose.rotation, anchor.point - pose.centre);
    return hold;
}

void Joints::keepPieces(const State& state)
{
    for (Held& held : joints_) {
        Joint& joint = held.joint;
        if (!isPull(joint.def) || !joint.lives()) continue;
        Hold& end = held.a.background() ? held.b : held.a;
        if (!end.rigid)
            keepPiece(state, joint, end, state.bodies[(held.a.background() ? joint.def.b : joint.def.a).body]);
    }
}

/// That of the particle which was nearest to the point when it was taken hold of. Pieces only fall into smaller ones,
/// so what was let go is never held again; of the larger part of a patch that would not be so.
void Joints::keepPiece(const State& state, Joint& joint, Hold& hold, const BodyRecord& body)
{
    const std::vector<Index> pieces = piecesOf(state, body);
    if (pieces.empty()) return;
    const auto pieceOf = [&](std::size_t i) { return pieces[hold.nodes[i] - body.nodes.first]; };
    const auto away = [&](std::size_t i) { return (hold.rest[i] - hold.local).squaredNorm(); };
    std::size_t grip = 0;
    for (std::size_t i = 1; i < hold.nodes.size(); ++i)
        if (away(i) < away(grip)) grip = i;
    Hold kept = hold;
    kept.nodes.clear(), kept.rest.clear();
    double whole = 0, mass = 0, inertia = 0;
    Vec2 centre(0, 0);
    for (std::size_t i = 0; i < hold.nodes.size(); ++i) {
        const double own = state.nodes.mass[hold.nodes[i]];
        whole += own;
        if (pieceOf(i) != pieceOf(grip)) continue;
        kept.nodes.push_back(hold.nodes[i]), kept.rest.push_back(hold.rest[i]);
        mass += own, centre += own * hold.rest[i];
    }
    if (kept.nodes.size() == hold.nodes.size()) return;
    centre /= mass;
    for (std::size_t i = 0; i < kept.nodes.size(); ++i) {
        kept.rest[i] -= centre;
        inertia += state.nodes.mass[kept.nodes[i]] * kept.rest[i].squaredNorm();
    }
    kept.gyration = inertia / mass;
    // A single particle does not turn, and so has no place beside it.
    kept.local = kept.turns() ? Vec2(hold.local - centre) : Vec2(0, 0);
    for (double& impulse : joint.impulse) impulse *= mass / whole;
    hold = std::move(kept);
}

void Joints::requireDirection(const JointDef& def, const Hold& a, const Hold& b)
{
    using Kind = JointDef::Kind;
    const bool turning = def.kind == Kind::Weld || def.kind == Kind::Prismatic ||
                         (def.kind == Kind::Revolute && (def.limited || def.driven)) ||
                         (def.kind == Kind::Motor && def.maxTorque > 0) || (def.kind == Kind::Wheel && def.driven);
    for (const Hold* end : {&a, &b}) {
        if (end->turns() || (!turning && !(def.kind == Kind::Wheel && end == &a))) continue;
        const BodyHandle body = end == &a ? def.a.body : def.b.body;
        throw Failure(Error("Physics: " + nameOf(def.kind) + " holds soft body " + std::to_string(body) +
                            " at a single particle, which has no direction; give the anchor a radius that holds two "
                            "particles or more."));
    }
}

Index Joints::add(const State& state, const JointDef& def, Index place)
{
    Held held;
    held.a = hold(state, def.a), held.b = hold(state, def.b);
    requireDirection(def, held.a, held.b);
    Joint& joint = held.joint;
    joint.def = def;
    joint.a = held.a.background() ? 0 : 1, joint.b = held.b.background() ? 0 : 2;
    for (const Anchor* anchor : {&def.a, &def.b})
        if (anchor->body != kNoHandle && !state.bodies[anchor->body].rigid)
            held.far = std::max(held.far, kFarLengths * state.bodies[anchor->body].length);
    const Pose a = poseOf(state, held.a), b = poseOf(state, held.b);
    joint.restAngle = b.angle - a.angle;
    const double axisLength = def.axis.norm();
    joint.localAxis = unrotated(a.rotation, axisLength > 0 ? Vec2(def.axis / axisLength) : Vec2(1, 0));
    joint.length = def.length;
    if (def.kind == JointDef::Kind::Pulley) {
        joint.length = pulleyLength(def, def.a.point, def.b.point);
    } else if (def.length < 0) {
        joint.length = (def.b.point - def.a.point).norm();
    }
    held.joint.def.hertz = 1;
    makeRows(held, a, b, 1);
    for (const JointRow<double>& row : rows_)
        if (row.soft) held.springMass = row.mass;
    held.joint.def.hertz = def.hertz;
    held.settling = kSettling;
    if (place != kNone) {
        joints_[place] = std::move(held);
        return place;
    }
    joints_.push_back(std::move(held));
    return static_cast<Index>(joints_.size() - 1);
}

/// Is a pull that was read back one of the state's?
bool Joints::fits(const State& state, const Held& held)
{
    if (held.a.background() == held.b.background()) return false;
    for (const auto& [end, anchor, number] :
         {std::tuple(&held.a, &held.joint.def.a, held.joint.a), std::tuple(&held.b, &held.joint.def.b, held.joint.b)}) {
        const Index wanted = end == &held.a ? 1 : 2;
        if (end->background() != (anchor->body == kNoHandle) || number != (end->background() ? 0 : wanted))
            return false;
        if (end->background()) continue;
        if (anchor->body >= state.bodies.size() || end->rest.size() != (end->rigid ? 0 : end->nodes.size()))
            return false;
        if (std::any_of(end->nodes.begin(), end->nodes.end(), [&](Index n) { return n >= state.nodes.size(); }))
            return false;
    }
    return true;
}

Joints::Pose Joints::poseOf(const State& state, const Hold& hold, double moved)
{
    const Nodes& nodes = state.nodes;
    Pose pose;
    if (hold.background()) return pose;
    if (hold.rigid) {
        const Index n = hold.nodes[0];
        return {nodes.position[n], nodes.velocity[n], nodes.rotation[n],  nodes.angle[n],
                nodes.omega[n],    nodes.invMass[n],  nodes.invInertia[n]};
    }
    const MassSums sums = massSums(
        nodes, hold.nodes.size(), [&](std::size_t i) { return hold.nodes[i]; },
        hold.rest.empty() ? nullptr : hold.rest.data());
    pose.centre = sums.centre, pose.velocity = sums.velocity;
    const bool held = std::any_of(hold.nodes.begin(), hold.nodes.end(), [&](Index n) { return nodes.invMass[n] == 0; });
    if (!held) pose.invMass = 1 / sums.mass;
    const double fit = std::sqrt(sums.along * sums.along + sums.across * sums.across);
    if (hold.nodes.size() < 2) return pose;
    if (!(sums.inertia > 0) || !(fit > 0)) {
        pose.angle = hold.angle, pose.lag = hold.lag, pose.rotation = direction(hold.angle);
        return pose;
    }
    pose.rotation = Vec2(sums.along, sums.across) / fit;
    pose.angle = hold.angle + wrapped(angleOf(sums.across, sums.along) - hold.angle);
    pose.omega = sums.omega();
    follow(hold, fit * fit / (sums.inertia * sums.mass * hold.gyration), moved, pose);
    if (!held) pose.invInertia = 1 / sums.inertia;
    return pose;
}

/// The best fit of a patch that is crushed turns over at once, though nothing in it turns: joints and their springs
/// would do work that nobody paid for. So an angle goes on by the angular velocity of the patch, the one that joints
/// work against, and by what else the fit turned only as far as the patch is like its shape at rest (`likeness`: the
/// squared coefficient of correlation of the two). What it lags behind it makes up for slowly.
void Joints::follow(const Hold& hold, double likeness, double moved, Pose& pose)
{
    // Of a rigid patch over the move, as its moment of inertia grows with it: tan = omega h before, sin 2x after.
    const double sine = std::clamp(2 * moved * pose.omega, -1.0, 1.0);
    const double turned = 0.5 * angleOf(sine, std::sqrt(1 - sine * sine));
    const double off = wrapped(pose.angle - hold.lag - hold.angle - turned);
    const double most = moved * kFollow * likeness / std::max(1 - likeness, 1e-9);
    if (hold.lag == 0 && (moved == 0 || std::abs(off) <= most)) return;
    const double followed = std::clamp(off, -most, most);
    pose.lag = wrapped(hold.lag + off - followed);
    const double recovered = std::clamp(pose.lag, -kRecover * moved, kRecover * moved);
    pose.lag -= recovered;
    pose.angle = hold.angle + turned + followed + recovered;
    pose.rotation = direction(pose.angle);
}

/// Spreads what changed of the patch's motion over its particles, as of a rigid body.
void Joints::give(State& state, const Hold& hold, const Pose& before, const BodyState<double>& after)
{
    if (hold.background() || before.invMass == 0) return;
    const Vec2 change = Vec2(after.velocityX, after.velocityY) - before.velocity;
    const double turn = after.perGyration > 0 ? after.omega() - before.omega : 0;
    for (const Index n : hold.nodes) {
        state.nodes.velocity[n] += change;
        if (hold.rigid) {
            state.nodes.omega.edit(n) += turn;
        } else {
            state.nodes.velocity[n] += turn * perpendicular(state.nodes.position[n] - before.centre);
        }
    }
}

JointFrame Joints::frame(const Held& held, const Pose& a, const Pose& b)
{
    JointFrame f;
    const auto place = [](const Hold& hold, const Pose& pose, Vec2& arm, Vec2& point) {
        arm = hold.background() ? Vec2(0, 0) : rotated(pose.rotation, hold.local);
        point = hold.background() ? hold.local : Vec2(pose.centre + arm);
    };
    place(held.a, a, f.armA, f.pointA);
    place(held.b, b, f.armB, f.pointB);
    f.angle = b.angle - a.angle - held.joint.restAngle;
    f.axis = rotated(a.rotation, held.joint.localAxis);
    return f;
}

/// The joint's rows, and the states of its ends, for substeps of h.
void Joints::makeRows(const Held& held, const Pose& a, const Pose& b, double h)
{
    const Joint& joint = held.joint;
    const JointFrame f = frame(held, a, b);
    ends_.assign(3, BodyState<double>{});
    for (const auto& [pose, end] : {std::pair(&a, &ends_[1]), std::pair(&b, &ends_[2])}) {
        end->velocityX = pose->velocity.x(), end->velocityY = pose->velocity.y();
        end->invMass = pose->invMass;
        end->perGyration = pose->invMass > 0 ? std::sqrt(pose->invInertia / pose->invMass) : 1;
        end->spin = end->perGyration > 0 ? pose->omega / end->perGyration : 0;
    }
    rows_.clear();
    addRows(joint, 0, f, ends_.data(), joint.a, joint.b, h, rows_);
    if (joint.hasPoint()) addPoint(joint, f);
    for (JointRow<double>& row : rows_) {
        const bool turns = row.ax == 0 && row.ay == 0 && row.bx == 0 && row.by == 0;
        row.far = held.part * std::min(row.far, turns ? kFarTurn : held.far);
        if (row.soft) keepStiffness(held, row, h);
    }
}

/// The spring of a joint is as stiff as it was for the patch as it was joined. If it became stiffer as the patch
/// spreads, and softer as it shrinks, the patch would get out of it what nobody put in.
void Joints::keepStiffness(const Held& held, JointRow<double>& row, double h) const
{
    const JointDef& def = held.joint.def;
    if (def.kind == JointDef::Kind::Mouse || !(held.springMass > 0) || !(row.mass > 0)) return;
    // k = m w² and d = 2 zeta m w stay.
    const double change = std::sqrt(held.springMass / row.mass);
    row.spring = softnessOf(change * def.hertz, change * def.dampingRatio, h);
    row.frequency *= change;
}

void Joints::addPoint(const Joint& joint, const JointFrame& f)
{
    const Vec2 apart = f.pointB - f.pointA;
    // Both impulses act half way between the points: those of points far apart would turn the whole.
    const bool both = ends_[joint.a].invMass > 0 && ends_[joint.b].invMass > 0;
    const Vec2 armA = f.armA + (both ? 0.5 : 0.0) * apart, armB = f.armB - (both ? 0.5 : 0.0) * apart;
    for (int axis = 0; axis < 2; ++axis) {
        const Vec2 along = axis == 0 ? Vec2(1, 0) : Vec2(0, 1);
        JointRow<double> row;
        row.a = joint.a, row.b = joint.b, row.slot = static_cast<Index>(axis);
        const BodyState<double>&endA = ends_[joint.a], &endB = ends_[joint.b];
        row.ax = -along.x(), row.ay = -along.y(), row.angularA = -cross(armA, along) * endA.perGyration;
        row.bx = along.x(), row.by = along.y(), row.angularB = cross(armB, along) * endB.perGyration;
        const double give =
            endA.invMass * (1 + row.angularA * row.angularA) + endB.invMass * (1 + row.angularB * row.angularB);
        row.mass = give > 0 ? 1 / give : 0;
        const double turn = row.mass * std::max(endA.invMass * endA.perGyration * std::abs(row.angularA),
                                                endB.invMass * endB.perGyration * std::abs(row.angularB));
        row.far = turn * 1e30 > kTurn ? kTurn / turn : 1e30;
        row.error = apart[axis];
        row.impulse = joint.impulse[axis];
        row.least = -1e30, row.most = 1e30;
        rows_.push_back(row);
    }
}

double Joints::energy(const State& state, Held& held, double h)
{
    makeRows(held, poseOf(state, held.a), poseOf(state, held.b), h);
    double sum = 0;
    for (const JointRow<double>& row : rows_) sum += row.springEnergy(row.error);
    return sum;
}

/// The work of an impulse is that along the mean of the velocities before and after.
void Joints::solveRows(Held& held, Act what)
{
    const Softness<double> standard = softnessOf(std::min(kHertz, kHertzPerSubstepRate / h_), kDampingRatio, h_);
    const bool mouse = held.joint.def.kind == JointDef::Kind::Mouse;
    const auto act = [&](JointRow<double>& row, double had, auto&& change) {
        const double before = row.moving(ends_.data());
        change();
        if (row.velocityOnly || mouse) held.given += (row.impulse - had) * 0.5 * (before + row.moving(ends_.data()));
    };
    if (begins(what))
        for (JointRow<double>& row : rows_) act(row, 0, [&] { row.warm(ends_.data()); });
    for (int pass = 0; what != Act::Warm && pass < kPasses; ++pass)
        for (JointRow<double>& row : rows_)
            act(row, row.impulse, [&] { row.solve(ends_.data(), standard, 1 / h_, what != Act::Relax); });
}

void Joints::solve(State& state, Held& held, Act what)
{
    Joint& joint = held.joint;
    const bool relax = what == Act::Relax;
    const double moved = relax ? h_ : 0;
    const Pose a = poseOf(state, held.a, moved), b = poseOf(state, held.b, moved);
    held.a.angle = a.angle, held.b.angle = b.angle;
    held.a.lag = a.lag, held.b.lag = b.lag;
    joint.substep = h_;  // they have been scaled
    makeRows(held, a, b, h_);
    const auto energy = [&] { return kineticEnergy(ends_[1]) + kineticEnergy(ends_[2]); };
    if (begins(what)) held.work = held.stored = 0;
    for (const JointRow<double>& row : rows_)
        if (what != Act::Push) (relax ? held.work : held.stored) += row.springEnergy(row.error);
    held.work -= energy();
    solveRows(held, what);
    held.work += energy();
    if (relax) takeGain(held);
    give(state, held.a, a, ends_[1]);
    give(state, held.b, b, ends_[2]);
    for (const JointRow<double>& row : rows_) {
        joint.impulse[row.slot] = row.impulse;
        if (!relax) continue;
        held.pushed += row.impulse * Vec2(row.bx, row.by);
        if (row.bx == 0 && row.by == 0) held.turned += row.torqueOfB();
    }
}

/// A joint to what does not move does no work, beside that of its spring. A push that led elsewhere than it was meant
/// to, as the patch gave way, may have done some.
void Joints::takeGain(Held& held)
{
    const double gain = held.work - held.stored;
    if (held.joint.def.driven || held.joint.def.kind == JointDef::Kind::Motor || !(gain > 0)) return;
    for (BodyState<double>* end : {&ends_[1], &ends_[2]}) {
        const BodyState<double>& other = ends_[end == &ends_[1] ? 2 : 1];
        const double has = kineticEnergy(*end);
        if (!(has > 0) || other.invMass > 0 || other.velocityX != 0 || other.velocityY != 0 || other.spin != 0)
            continue;
        const double kept = std::sqrt(std::max(0.0, has - gain) / has);
        end->velocityX *= kept, end->velocityY *= kept, end->spin *= kept;
    }
}

/// Not what is gone, nor what holds a body that is switched off.
bool Joints::pulls(const State& state, const Held& held)
{
    const auto takesPart = [&](const Anchor& anchor) {
        return anchor.body == kNoHandle || state.bodies[anchor.body].enabled;
    };
    return held.joint.lives() && takesPart(held.joint.def.a) && takesPart(held.joint.def.b);
}

bool Joints::rests(const State& state, const Held& held)
{
    const Index a = bodyOf(held.joint.def.a), b = bodyOf(held.joint.def.b);
    if (a == kNone || b == kNone) return state.bodies[a == kNone ? b : a].asleep;
    return state.atRest(a, b);
}

void Joints::warm(State& state, double h)
{
    h_ = h;
    for (Held& held : joints_)
        if (pulls(state, held) && !rests(state, held)) solve(state, held, Act::Warm);
}

void Joints::push(State& state, double h, bool warmed)
{
    h_ = h;
    for (Held& held : joints_)
        if (pulls(state, held) && !rests(state, held)) solve(state, held, warmed ? Act::Push : Act::WarmAndPush);
}

void Joints::relax(State& state)
{
    for (std::size_t i = joints_.size(); i-- > 0;)
        if (pulls(state, joints_[i]) && !rests(state, joints_[i])) solve(state, joints_[i], Act::Relax);
}

bool Joints::settle(Held& held, double dt)
{
    Joint& joint = held.joint;
    held.settling = std::max(0.0, held.settling - dt);
    joint.state.force = held.pushed / dt, joint.state.torque = held.turned / dt;
    held.pushed = Vec2(0, 0), held.turned = 0;
    if (!joint.lives() || !(joint.def.breakForce > 0) || joint.state.force.norm() <= joint.def.breakForce) return false;
    joint.broken = true;
    return true;
}

bool Joints::finish(const State& state, double dt)
{
    bool broke = false;
    for (Held& held : joints_) broke |= !rests(state, held) && settle(held, dt);
    return broke;
}

std::vector<std::pair<Index, Index>> Joints::excluded() const
{
    std::vector<std::pair<Index, Index>> pairs;
    for (const Held& held : joints_) {
        const JointDef& def = held.joint.def;
        if (!held.joint.lives() || def.collide || held.a.background() || held.b.background()) continue;
        pairs.emplace_back(std::min(def.a.body, def.b.body), std::max(def.a.body, def.b.body));
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

void Joints::scale(double ratio)
{
    for (Held& held : joints_)
        for (double& impulse : held.joint.impulse) impulse *= ratio;
}

JointState Joints::state(const State& state, Index index) const
{
    const Held& held = joints_[index];
    const JointFrame f = frame(held, poseOf(state, held.a), poseOf(state, held.b));
    JointState now = held.joint.state;
    now.broken = held.joint.broken;
    now.pointA = f.pointA, now.pointB = f.pointB;
    const Vec2 apart = f.pointB - f.pointA;
    switch (held.joint.def.kind) {
    case JointDef::Kind::Prismatic:
    case JointDef::Kind::Wheel: now.value = apart.dot(f.axis); break;
    case JointDef::Kind::Distance:
    case JointDef::Kind::Rope:
    case JointDef::Kind::Mouse: now.value = apart.norm(); break;
    default: now.value = f.angle;
    }
    return now;
}

void Joints::setMotor(Index joint, bool driven, double speed)
{
    Held& held = joints_[joint];
    JointDef def = held.joint.def;
    def.driven = driven, def.motorSpeed = speed;
    requireDirection(def, held.a, held.b);
    held.joint.def = def;
}

void Joints::set(const State& state, Index index, const JointDef& wanted)
{
    Held& held = joints_[index];
    Joint& joint = held.joint;
    const JointDef old = joint.def, def = liveDef(wanted, old);
    requireDirection(def, held.a, held.b);
    joint.def = def;
    held.settling = kSettling;
    if (wanted.length >= 0 && def.kind != JointDef::Kind::Pulley) joint.length = wanted.length;
    const Pose a = poseOf(state, held.a), b = poseOf(state, held.b);
    const JointFrame f = frame(held, a, b);
    if (def.ratio != old.ratio && def.kind == JointDef::Kind::Pulley)
        joint.length = pulleyLength(def, f.pointA, f.pointB);
    const double axisLength = def.axis.norm();
    if (axisLength > 0 && def.axis != old.axis) joint.localAxis = unrotated(a.rotation, def.axis / axisLength);
}

bool Joints::setTarget(Index joint, const Vec2& target)
{
    Held& held = joints_[joint];
    Hold* end = held.a.background() ? &held.a : held.b.background() ? &held.b : nullptr;
    if (end) end->local = target, held.settling = kSettling;
    return end != nullptr;
}

std::size_t Joints::bytes() const
{
    std::size_t sum = joints_.capacity() * sizeof(Held);
    for (const Held& held : joints_)
        for (const Hold* end : {&held.a, &held.b})
            sum += end->nodes.capacity() * sizeof(Index) + end->rest.capacity() * sizeof(Vec2);
    return sum;
}

}  // namespace jet::physics::soft
