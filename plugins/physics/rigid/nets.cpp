#include "nets.hpp"

#include "disjoint_sets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace jet::physics {

namespace {

constexpr double kReserve = 0.05;  // of the kinetic energy
constexpr double kAttention = 1;   // seconds
constexpr std::size_t kFew = 512;
constexpr Index kPiece = 128;       // bodies
constexpr std::size_t kShared = 8;  // pieces: fewer are not worth a second thread

template <class Real>
Vec2 velocityOf(const BodyState<Real>& s)
{
    return {static_cast<double>(s.velocityX), static_cast<double>(s.velocityY)};
}

bool movesNow(const RigidBody& body) { return body.moves && !body.asleep; }

}  // namespace

bool Nets::due(std::size_t joints, bool strained, double dt)
{
    attention_ = strained || joints <= kFew ? kAttention : std::max(0.0, attention_ - dt);
    if (attention_ == 0) ledgers_.clear();
    return attention_ > 0;
}

bool Nets::takesPart(const Joint& joint, const std::vector<RigidBody>& bodies)
{
    return joint.lives() && bodies[joint.a].takesPart() && bodies[joint.b].takesPart() &&
           (movesNow(bodies[joint.a]) || movesNow(bodies[joint.b]));
}

Index Nets::netOf(const Joint& joint, const std::vector<RigidBody>& bodies) const
{
    return takesPart(joint, bodies) ? netAt_[movesNow(bodies[joint.a]) ? joint.a : joint.b] : kNone;
}

/// Nets in the order of their first joints. Which there are follows from the joints and from what takes part.
void Nets::gather(const std::vector<Joint>& joints, const std::vector<RigidBody>& bodies, std::uint64_t version)
{
    if (version_ == version && netAt_.size() == bodies.size()) {
        for (Net& net : nets_) net = Net{net.joint, net.body, net.anchored};
        return;
    }
    version_ = version;
    group_.resize(bodies.size());
    std::iota(group_.begin(), group_.end(), Index{0});
    netAt_.assign(bodies.size(), kNone);
    nets_.clear();
    for (const Joint& joint : joints)
        if (takesPart(joint, bodies) && movesNow(bodies[joint.a]) && movesNow(bodies[joint.b]))
            unite(group_, joint.a, joint.b);
    for (Index index = 0; index < joints.size(); ++index) {
        const Joint& joint = joints[index];
        if (!takesPart(joint, bodies)) continue;
        const bool movesA = movesNow(bodies[joint.a]), movesB = movesNow(bodies[joint.b]);
        const Index root = rootOf(group_, movesA ? joint.a : joint.b);
        if (netAt_[root] == kNone) {
            netAt_[root] = static_cast<Index>(nets_.size());
            nets_.emplace_back().joint = index;
            nets_.back().body = root;
        }
        nets_[netAt_[root]].anchored |= !movesA || !movesB || joint.def.kind == JointDef::Kind::Pulley;
        if (movesA) netAt_[joint.a] = netAt_[root];
        if (movesB) netAt_[joint.b] = netAt_[root];
    }
    cut();
}

/// Their bodies, net by net, in pieces.
void Nets::cut()
{
    std::vector<Index> first(nets_.size() + 1, 0);
    for (const Index net : netAt_)
        if (net != kNone) ++first[net + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    members_.resize(first.back()), pieces_.clear();
    std::vector<Index> next = first;
    for (Index body = 0; body < netAt_.size(); ++body)
        if (netAt_[body] != kNone) members_[next[netAt_[body]]++] = body;
    for (Index net = 0; net < nets_.size(); ++net)
        for (Index at = first[net]; at < first[net + 1]; at += kPiece)
            pieces_.push_back({net, at, std::min(at + kPiece, first[net + 1])});
}

/// Sums of pieces are added in the order of the pieces, whoever found them.
template <class Real>
void Nets::addEnergies(const Step<Real>& step)
{
    auto find = [&](std::size_t i) {
        Piece& piece = pieces_[i];
        piece.after = piece.allowed = piece.jolt = 0;
        for (Index at = piece.first; at < piece.last; ++at) {
            const Budget& budget = step.budgets[members_[at]];
            piece.after += kineticEnergy(step.solver.body(members_[at]));
            piece.allowed += budget.energy, piece.jolt += budget.jolt;
        }
    };
    if (pieces_.size() < kShared) {
        for (std::size_t i = 0; i < pieces_.size(); ++i) find(i);
    } else {
        step.pool.run(pieces_.size(), find);
    }
    for (const Piece& piece : pieces_) {
        Net& net = nets_[piece.net];
        net.after += piece.after, net.allowed += piece.allowed, net.jolt += piece.jolt;
    }
}

/// Of nets: work(body, net, state).
template <class Real, class Work>
void Nets::eachBody(const Step<Real>& step, Work&& work)
{
    for (Index i = 1; i < netAt_.size(); ++i)
        if (netAt_[i] != kNone) work(i, nets_[netAt_[i]], step.solver.body(i));
}

/// Of springs and motors.
template <class Real>
void Nets::addWork(const Step<Real>& step)
{
    step.solver.eachRow([&](const JointRow<Real>& row, Real error) {
        if (!row.soft && !row.velocityOnly) return;
        const Index net = netOf(step.joints[row.joint], step.bodies());
        if (net == kNone) return;
        if (row.velocityOnly) nets_[net].allowed += static_cast<double>(row.given);
        nets_[net].allowed += static_cast<double>(row.stored - row.springEnergy(error));
    });
}

/// Brings the ledgers up to date; says whether any net has too much.
bool Nets::settle()
{
    bool any = false;
    std::swap(ledgers_, former_);
    ledgers_.clear();
    auto old = former_.begin();
    for (Net& net : nets_) {
        while (old != former_.end() && old->joint < net.joint) ++old;
        Ledger& ledger = ledgers_.emplace_back();
        const bool known = old != former_.end() && old->joint == net.joint;
        if (known) ledger = *old;
        ledger.joint = net.joint;
        if (!known) ledger.reserve = net.jolt;
        ledger.reserve += kReserve * std::max(0.0, net.allowed - ledger.peak);
        ledger.peak = std::max(net.allowed, ledger.peak);
        const double left = ledger.reserve + net.allowed - net.after;
        ledger.reserve = std::clamp(left, 0.0, kReserve * ledger.peak + net.jolt);
        net.excess = std::max(0.0, -left);
        any |= net.excess > 0;
    }
    return any;
}

/// A net that others pushed has no more than its island has too much.
template <class Real>
void Nets::allowExchange(const Step<Real>& step)
{
    const std::vector<RigidBody>& bodies = step.bodies();
    const Collider& collider = step.collider;
    const Solver<Real>& solver = step.solver;
    const auto eachPush = [&](auto&& work) {
        for (std::size_t i = 0; i < collider.places().size(); ++i) {
            const Place at = collider.places()[i];
            if (!isPlaced(at)) continue;
            const RigidContact& c = collider.contacts()[i];
            double impulse = 0;
            for (int k = 0; k < c.count; ++k) impulse += static_cast<double>(solver.total(at, k));
            if (impulse > 0) work(c, impulse);
        }
    };
    bool any = false;
    islands_ = group_;
    eachPush([&](const RigidContact& c, double) {
        any = true;
        if (movesNow(bodies[c.bodyA]) && movesNow(bodies[c.bodyB])) unite(islands_, c.bodyA, c.bodyB);
    });
    if (!any) return;
    gained_.assign(bodies.size(), 0);
    for (Index i = 1; i < bodies.size(); ++i)
        if (movesNow(bodies[i]) && bodies[i].enabled && netAt_[i] == kNone)
            gained_[rootOf(islands_, i)] += kineticEnergy(solver.body(i)) - step.budgets[i].energy;
    for (const Net& net : nets_) gained_[rootOf(islands_, net.body)] += net.after - net.allowed;
    eachPush([&](const RigidContact& c, double impulse) {
        for (const auto& [driver, other] : {std::pair(c.bodyA, c.bodyB), std::pair(c.bodyB, c.bodyA)}) {
            if (!bodies[driver].kinematic || !movesNow(bodies[other])) continue;
            const BodyState<Real>& s = solver.body(driver);
            const double speed = std::hypot(static_cast<double>(s.velocityX), static_cast<double>(s.velocityY)) +
                                 std::abs(static_cast<double>(s.omega())) * static_cast<double>(bodies[driver].reach);
            gained_[rootOf(islands_, other)] -= speed * impulse * (1 + static_cast<double>(c.friction));
        }
    });
    for (Net& net : nets_) net.excess = std::clamp(net.excess, 0.0, std::max(0.0, gained_[rootOf(islands_, net.body)]));
}

/// What is held by something that moves by itself may be thrown at twice its speed.
template <class Real>
void Nets::allowCarriers(const Step<Real>& step)
{
    for (const Joint& joint : step.joints)
        for (const Index driver : {joint.a, joint.b}) {
            const Index carried = netOf(joint, step.bodies());
            if (!step.bodies()[driver].kinematic || carried == kNone) continue;
            const BodyState<Real>& s = step.solver.body(driver);
            const double straight = velocityOf(s).norm(), omega = std::abs(static_cast<double>(s.omega()));
            eachBody(step, [&](Index i, Net& net, const BodyState<Real>& held) {
                if (&net != &nets_[carried]) return;
                const double arm = (step.budgets[i].place - step.budgets[driver].place).norm();
                net.carried += 2 * std::pow(straight + omega * arm, 2) / static_cast<double>(held.invMass);
            });
        }
    for (Net& net : nets_) net.excess = std::clamp(net.excess, 0.0, std::max(0.0, net.after - net.carried));
}

/// How those nets move as a whole that have too much. Anchors hold the whole as well: all motion is within then.
template <class Real>
void Nets::findWhole(const Step<Real>& step)
{
    eachBody(step, [&](Index i, Net& net, const BodyState<Real>& s) {
        if (!(net.excess > 0)) return;
        const double mass = 1 / static_cast<double>(s.invMass);
        net.mass += mass, net.centre += mass * step.budgets[i].place, net.velocity += mass * velocityOf(s);
    });
    for (Net& net : nets_)
        if (net.mass > 0) net.centre /= net.mass, net.velocity /= net.mass;
    eachBody(step, [&](Index i, Net& net, const BodyState<Real>& s) {
        if (!(net.excess > 0)) return;
        const double mass = 1 / static_cast<double>(s.invMass), k = s.perGyration > 0 ? step.bodies()[i].gyration : 0;
        const Vec2 arm = step.budgets[i].place - net.centre;
        net.spin += mass * (cross(arm, Vec2(velocityOf(s) - net.velocity)) + k * static_cast<double>(s.spin));
        net.inertia += mass * (arm.squaredNorm() + k * k);
    });
    for (Net& net : nets_) {
        net.omega = net.inertia > 0 ? net.spin / net.inertia : 0;
        if (net.anchored) net.velocity = Vec2(0, 0), net.omega = 0;
    }
}

/// The velocities a body would have if its net were rigid.
template <class Real>
BodyState<Real> Nets::ofWhole(const Step<Real>& step, Index body, const Net& net)
{
    BodyState<Real> s = step.solver.body(body);
    const Vec2 velocity = net.velocity + net.omega * perpendicular(step.budgets[body].place - net.centre);
    s.velocityX = static_cast<Real>(velocity.x()), s.velocityY = static_cast<Real>(velocity.y());
    s.spin = static_cast<Real>(s.perGyration > 0 ? net.omega * step.bodies()[body].gyration : 0);
    return s;
}

template <class Real>
void Nets::takeExcess(const Step<Real>& step)
{
    eachBody(step, [&](Index i, Net& net, const BodyState<Real>& s) {
        if (!(net.excess > 0)) return;
        const BodyState<Real> whole = ofWhole(step, i, net);
        BodyState<Real> apart = s;
        apart.velocityX -= whole.velocityX, apart.velocityY -= whole.velocityY, apart.spin -= whole.spin;
        net.within += kineticEnergy(apart);
    });
    for (Net& net : nets_)
        if (net.excess > 0) net.kept = net.within > net.excess ? std::sqrt((net.within - net.excess) / net.within) : 0;
    eachBody(step, [&](Index i, Net& net, BodyState<Real>& s) {
        if (!(net.excess > 0)) return;
        const BodyState<Real> whole = ofWhole(step, i, net);
        // Energy beyond that within came with momentum, of joints torn far apart.
        const double outer = net.after - net.within, rest = net.excess - net.within;
        const bool torn = rest > 0 && outer > 0;
        const auto moves = static_cast<Real>(torn ? std::sqrt(std::max(0.0, outer - rest) / outer) : 1);
        const auto kept = static_cast<Real>(net.kept);
        s.velocityX = moves * whole.velocityX + kept * (s.velocityX - whole.velocityX);
        s.velocityY = moves * whole.velocityY + kept * (s.velocityY - whole.velocityY);
        s.spin = moves * whole.spin + kept * (s.spin - whole.spin);
    });
    // Impulses that forces alone may explain bear them in the next step as well.
    step.solver.scaleJoints(step.joints, [&](const Joint& joint) {
        const Index net = netOf(joint, step.bodies());
        return net == kNone || nets_[net].excess < nets_[net].jolt ? 1 : nets_[net].kept;
    });
}

template <class Real>
void Nets::restrain(const Step<Real>& step)
{
    gather(step.joints, step.bodies(), step.version);
    addEnergies(step);
    addWork(step);
    if (!settle()) return;
    allowExchange(step);
    allowCarriers(step);
    findWhole(step);
    takeExcess(step);
}

template void Nets::restrain(const Step<float>&);
template void Nets::restrain(const Step<double>&);

}  // namespace jet::physics
