#include "nets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace jet::physics {

namespace {

constexpr double kReserve = 0.05;  // of the kinetic energy
constexpr double kAttention = 1;   // seconds
constexpr std::size_t kFew = 512;

bool movesNow(const RigidBody& body) { return body.moves && !body.asleep; }

}  // namespace

bool Nets::due(std::size_t joints, bool strained, double dt)
{
    attention_ = strained || joints <= kFew ? kAttention : std::max(0.0, attention_ - dt);
    if (attention_ == 0) ledgers_.clear();
    return attention_ > 0;
}

Index Nets::rootOf(Index body)
{
    while (group_[body] != body) body = group_[body] = group_[group_[body]];
    return body;
}

void Nets::unite(Index a, Index b)
{
    a = rootOf(a), b = rootOf(b);
    group_[std::max(a, b)] = std::min(a, b);
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

/// Nets in the order of their first joints.
void Nets::gather(const std::vector<Joint>& joints, const std::vector<RigidBody>& bodies)
{
    group_.resize(bodies.size());
    std::iota(group_.begin(), group_.end(), Index{0});
    netAt_.assign(bodies.size(), kNone);
    nets_.clear();
    for (const Joint& joint : joints)
        if (takesPart(joint, bodies) && movesNow(bodies[joint.a]) && movesNow(bodies[joint.b])) unite(joint.a, joint.b);
    for (Index index = 0; index < joints.size(); ++index) {
        const Joint& joint = joints[index];
        if (!takesPart(joint, bodies)) continue;
        const bool movesA = movesNow(bodies[joint.a]), movesB = movesNow(bodies[joint.b]);
        const Index root = rootOf(movesA ? joint.a : joint.b);
        if (netAt_[root] == kNone) {
            netAt_[root] = static_cast<Index>(nets_.size());
            nets_.emplace_back().joint = index;
            nets_.back().body = root;
        }
        nets_[netAt_[root]].anchored |= !movesA || !movesB || joint.def.kind == JointDef::Kind::Pulley;
        if (movesA) netAt_[joint.a] = netAt_[root];
        if (movesB) netAt_[joint.b] = netAt_[root];
    }
}

/// Of springs and motors.
template <class Real>
void Nets::addWork(const Solver<Real>& solver, const std::vector<Joint>& joints, const std::vector<RigidBody>& bodies)
{
    solver.eachRow([&](const JointRow<Real>& row, Real error) {
        if (!row.soft && !row.velocityOnly) return;
        const Index net = netOf(joints[row.joint], bodies);
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
void Nets::allowExchange(const Solver<Real>& solver, const Collider& collider, std::span<const Budget> budgets)
{
    const std::vector<RigidBody>& bodies = collider.bodies();
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
    eachPush([&](const RigidContact& c, double) {
        any = true;
        if (movesNow(bodies[c.bodyA]) && movesNow(bodies[c.bodyB])) unite(c.bodyA, c.bodyB);
    });
    if (!any) return;
    gained_.assign(bodies.size(), 0);
    for (Index i = 1; i < bodies.size(); ++i)
        if (movesNow(bodies[i]) && bodies[i].enabled && netAt_[i] == kNone)
            gained_[rootOf(i)] += kineticEnergy(solver.body(i)) - budgets[i].energy;
    for (const Net& net : nets_) gained_[rootOf(net.body)] += net.after - net.allowed;
    eachPush([&](const RigidContact& c, double impulse) {
        for (const auto& [driver, other] : {std::pair(c.bodyA, c.bodyB), std::pair(c.bodyB, c.bodyA)}) {
            if (!bodies[driver].kinematic || !movesNow(bodies[other])) continue;
            const BodyState<Real>& s = solver.body(driver);
            const double speed = std::hypot(static_cast<double>(s.velocityX), static_cast<double>(s.velocityY)) +
                                 std::abs(static_cast<double>(s.omega())) * static_cast<double>(bodies[driver].reach);
            gained_[rootOf(other)] -= speed * impulse * (1 + static_cast<double>(c.friction));
        }
    });
    for (Net& net : nets_) net.excess = std::clamp(net.excess, 0.0, std::max(0.0, gained_[rootOf(net.body)]));
}

template void Nets::addWork(const Solver<float>&, const std::vector<Joint>&, const std::vector<RigidBody>&);
template void Nets::addWork(const Solver<double>&, const std::vector<Joint>&, const std::vector<RigidBody>&);
template void Nets::allowExchange(const Solver<float>&, const Collider&, std::span<const Budget>);
template void Nets::allowExchange(const Solver<double>&, const Collider&, std::span<const Budget>);

}  // namespace jet::physics
