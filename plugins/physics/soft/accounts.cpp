#include "soft/accounts.hpp"

#include "disjoint_sets.hpp"
#include "soft/enclosed_area.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace jet::physics::soft {

namespace {

constexpr double kReserve = 0.05;  // of the kinetic energy
constexpr double kForgiven = 0.6;  // of a debt, a second
constexpr double kRest = 0.01;     // lengths of a body a second: slower is at rest
constexpr Index kMostParticles = 1024;

// Marks of bodies.
constexpr std::uint8_t kHeld = 1, kAnchored = 2, kDriven = 4;

bool moves(const State& state, Index body)
{
    const BodyRecord& is = state.bodies[body];
    return is.enabled && !is.fixed && !is.kinematic && !is.asleep && is.nodes.count > 0;
}

}  // namespace

/// Nets in the order of their first bodies.
void Accounts::gather(const Scene& scene)
{
    const State& state = scene.state;
    const std::size_t count = state.bodies.size();
    group_.resize(count), netAt_.assign(count, kNone), marks_.assign(count, 0);
    std::iota(group_.begin(), group_.end(), Index{0});
    nets_.clear(), bodies_.clear();
    const auto join = [&](Index a, Index b, std::uint8_t marks) {
        const bool movesA = a != kNone && moves(state, a), movesB = b != kNone && moves(state, b);
        for (const auto& [body, other] : {std::pair(a, b), std::pair(b, a)}) {
            if (body == kNone || !moves(state, body)) continue;
            const bool free = other != kNone && moves(state, other);
            const bool carried = other != kNone && state.bodies[other].kinematic && state.bodies[other].enabled;
            marks_[body] |= kHeld | marks | (free ? 0 : kAnchored) | (carried ? kDriven : 0);
        }
        if (movesA && movesB) unite(group_, a, b);
    };
    scene.joints.eachHeld(state, [&](Index a, Index b, bool pulley) { join(a, b, pulley ? kAnchored : 0); });
    scene.actuators.eachBond([&](Index a, Index b) { join(a, b, 0); });
    for (Index body = 0; body < count; ++body)
        if (marks_[body] != 0) marks_[rootOf(group_, body)] |= marks_[body];
    for (Index body = 0; body < count; ++body) {
        const Index root = rootOf(group_, body);
        if ((marks_[root] & kHeld) == 0 || (marks_[root] & kDriven) != 0) continue;
        if (netAt_[root] == kNone) {
            netAt_[root] = static_cast<Index>(nets_.size());
            Net& net = nets_.emplace_back();
            net.body = root, net.anchored = (marks_[root] & kAnchored) != 0;
        }
        netAt_[body] = netAt_[root];
        Net& net = nets_[netAt_[body]];
        ++net.end;
        if (!state.bodies[body].rigid) net.particles += state.bodies[body].nodes.count;
    }
    Index kept = 0, first = 0;
    for (Net& net : nets_) net.first = net.particles > 0 && net.particles <= kMostParticles ? kept++ : kNone;
    for (Index& net : netAt_)
        if (net != kNone) net = nets_[net].first;
    std::erase_if(nets_, [](const Net& net) { return net.first == kNone; });
    for (Net& net : nets_) first += std::exchange(net.end, net.first = first);
    bodies_.resize(first);
    for (Index body = 0; body < count; ++body)
        if (netAt_[body] != kNone) bodies_[nets_[netAt_[body]].end++] = body;
}

/// visit(node, mass, inertia) for what of a net may move.
template <class Visit>
void Accounts::eachNode(const State& state, const Net& net, Visit&& visit) const
{
    const Nodes& nodes = state.nodes;
    for (Index i = net.first; i < net.end; ++i) {
        const BodyRecord& body = state.bodies[bodies_[i]];
        for (Index n = body.nodes.first; n < body.nodes.end(); ++n) {
            if (!(nodes.invMass[n] > 0)) continue;
            const double turning = body.rigid ? nodes.invInertia[n] : 0;
            visit(n, 1 / nodes.invMass[n], turning > 0 ? 1 / turning : 0.0, body);
        }
    }
}

double Accounts::kinetic(const State& state, const Net& net, const Whole& from) const
{
    const Nodes& nodes = state.nodes;
    double twice = 0;
    eachNode(state, net, [&](Index n, double mass, double inertia, const BodyRecord&) {
        const Vec2 carried = from.velocity + from.omega * perpendicular(nodes.position[n] - from.centre);
        twice += mass * (nodes.velocity[n] - carried).squaredNorm();
        if (inertia > 0) twice += inertia * std::pow(nodes.omega[n] - from.omega, 2);
    });
    return 0.5 * twice;
}

void Accounts::change(const State& state, double sign)
{
    for (Net& net : nets_) net.gained += sign * kinetic(state, net, Whole());
}

void Accounts::addHeld(const Scene& scene, double sign)
{
    for (Net& net : nets_) {
        double held = 0;
        eachNode(scene.state, net, [&](Index n, double mass, double, const BodyRecord& body) {
            held -= mass * body.gravityScale * scene.gravity.dot(scene.state.nodes.position[n]);
        });
        for (Index i = net.first; i < net.end; ++i)
            if (!scene.state.bodies[bodies_[i]].rigid)
                held += scene.springs.energy(scene.state, bodies_[i], scene.h) +
                        gasEnergy(scene.state, scene.state.bodies[bodies_[i]], scene.h);
        net.held = held;
    }
    const auto add = [&](Index a, Index b, double energy) {
        const Index net = netOf(a) != kNone ? netOf(a) : netOf(b);
        if (net != kNone) nets_[net].held += energy;
    };
    scene.actuators.eachEnergy(scene.state, scene.h, add);
    scene.joints.eachEnergy(scene.state, scene.h, add);
    const auto counts = [&](Index body) { return netOf(body) != kNone; };
    const auto addOf = [&](Index body, double energy) { nets_[netOf(body)].held += energy; };
    scene.shapes.eachEnergy(scene.state, scene.springs, scene.h, counts, addOf);
    scene.twins.eachEnergy(scene.state, scene.springs, scene.h, counts, addOf);
    for (Net& net : nets_) net.gained += sign * net.held;
}

void Accounts::takeGiven(const Scene& scene)
{
    scene.joints.takeGiven([&](Index a, Index b, double energy) {
        const Index net = netOf(a) != kNone ? netOf(a) : netOf(b);
        if (net != kNone) nets_[net].gained -= energy;
    });
}

void Accounts::open(const Scene& scene)
{
    nets_.clear();
    if (scene.joints.empty() && !scene.actuators.anySpring()) {
        ledgers_.clear();
        return;
    }
    gather(scene);
    restrain(scene);
    if (!any()) return ledgers_.clear();
    scene.joints.takeGiven([](Index, Index, double) {});
    addHeld(scene, -1);
    for (Net& net : nets_) net.heldBefore = net.held;
}

/// What forces give the net while it is at rest, until its account is settled.
double Accounts::jolt(const Scene& scene, const Net& net) const
{
    double jolt = 0;
    const double dt = kSubsteps * scene.h;
    eachNode(scene.state, net, [&](Index, double mass, double, const BodyRecord& body) {
        jolt += 0.5 * mass * (body.gravityScale * dt * scene.gravity).squaredNorm();
    });
    return jolt;
}

/// What is in debt pushes out errors less: pushes that strain springs or lift what hangs are what it is owed for.
void Accounts::restrain(const Scene& scene)
{
    auto ledger = ledgers_.begin();
    for (Net& net : nets_) {
        while (ledger != ledgers_.end() && ledger->body < net.body) ++ledger;
        if (ledger == ledgers_.end() || ledger->body != net.body || !(ledger->reserve < 0)) continue;
        double rest = 0;
        eachNode(scene.state, net, [&](Index, double mass, double, const BodyRecord& body) {
            rest += 0.5 * mass * std::pow(kRest * body.length, 2);
        });
        const double free = rest + jolt(scene, net) + kReserve * ledger->peak;
        net.part = free / (free - ledger->reserve);
    }
    scene.joints.allow([&](Index a, Index b) {
        const Index net = netOf(a) != kNone ? netOf(a) : netOf(b);
        return net != kNone ? nets_[net].part : 1.0;
    });
}

void Accounts::force(const Scene& scene)
{
    const Nodes& nodes = scene.state.nodes;
    for (Net& net : nets_)
        eachNode(scene.state, net, [&](Index n, double mass, double inertia, const BodyRecord&) {
            const Vec2 push = scene.h * nodes.force[n];
            net.gained -= push.dot(nodes.velocity[n]) + 0.5 * push.squaredNorm() / mass;
            if (!(inertia > 0)) return;
            const double turn = scene.h * nodes.torque[n];
            net.gained -= turn * nodes.omega[n] + 0.5 * turn * turn / inertia;
        });
}

/// Brings the ledger of the net, the last, up to date; what the net has too much.
double Accounts::settle(Net& net, double kinetic, double jolt)
{
    Ledger& ledger = ledgers_.back();
    // Of what it has and may have: what springs lost as their patch turned over was never motion.
    const double had = std::clamp(kinetic - net.gained, 0.0, kinetic);
    ledger.reserve += kReserve * std::max(0.0, had - ledger.peak);
    ledger.peak = std::max(ledger.peak, had);
    const double left = ledger.reserve - net.gained;
    ledger.reserve = std::clamp(left, 0.0, kReserve * ledger.peak + jolt);
    return std::max(0.0, -left);
}

void Accounts::close(const Scene& scene, int substeps)
{
    if (!any()) return;
    const double owed = decay(kForgiven * substeps * scene.h);
    addHeld(scene, 1);
    takeGiven(scene);
    std::swap(ledgers_, former_);
    ledgers_.clear();
    auto old = former_.begin();
    for (Net& net : nets_) {
        const double jolt = this->jolt(scene, net);
        while (old != former_.end() && old->body < net.body) ++old;
        Ledger& ledger = ledgers_.emplace_back();
        if (old != former_.end() && old->body == net.body) {
            ledger = *old;
        } else {
            ledger.reserve = jolt;
        }
        ledger.body = net.body;
        // What went elsewhere, as into flow, is owed no more; what cannot be found is forgotten.
        if (ledger.reserve < 0)
            ledger.reserve = owed * std::min(0.0, ledger.reserve + std::max(0.0, ledger.held - net.heldBefore));
        const double excess = settle(net, kinetic(scene.state, net, Whole()), jolt);
        if (excess > 0) ledger.reserve = -std::max(0.0, excess - take(scene, net, excess, jolt));
        ledger.held = net.held;
    }
    nets_.clear();
}

/// Anchors hold the whole as well: all motion is within then.
Accounts::Whole Accounts::whole(const State& state, const Net& net) const
{
    Whole whole;
    bool pinned = net.anchored;
    for (Index i = net.first; i < net.end; ++i) {
        const Range& own = state.bodies[bodies_[i]].nodes;
        for (Index n = own.first; n < own.end(); ++n) pinned |= state.nodes.invMass[n] == 0;
    }
    if (pinned) return whole;
    const Nodes& nodes = state.nodes;
    double total = 0, spin = 0, all = 0;
    eachNode(state, net, [&](Index n, double mass, double, const BodyRecord&) {
        total += mass, whole.centre += mass * nodes.position[n], whole.velocity += mass * nodes.velocity[n];
    });
    if (!(total > 0)) return Whole();
    whole.centre /= total, whole.velocity /= total;
    eachNode(state, net, [&](Index n, double mass, double inertia, const BodyRecord&) {
        const Vec2 arm = nodes.position[n] - whole.centre;
        spin += mass * cross(arm, Vec2(nodes.velocity[n] - whole.velocity));
        all += mass * arm.squaredNorm();
        if (inertia > 0) spin += inertia * nodes.omega[n], all += inertia;
    });
    whole.omega = all > 0 ? spin / all : 0;
    return whole;
}

/// Returns what there was to take.
double Accounts::take(const Scene& scene, const Net& net, double excess, double jolt)
{
    Nodes& nodes = scene.state.nodes;
    const Whole whole = this->whole(scene.state, net);
    const double within = kinetic(scene.state, net, whole);
    const double kept = within > excess ? std::sqrt((within - excess) / within) : 0;
    // Impulses that forces alone may explain bear them in the next substep as well; the others had run away.
    if (excess > jolt)
        scene.joints.scale(kept, [&](Index body) { return netOf(body) != kNone && &nets_[netOf(body)] == &net; });
    eachNode(scene.state, net, [&](Index n, double, double inertia, const BodyRecord&) {
        const Vec2 carried = whole.velocity + whole.omega * perpendicular(nodes.position[n] - whole.centre);
        nodes.velocity[n] = carried + kept * (nodes.velocity[n] - carried);
        if (inertia > 0) nodes.omega.edit(n) = whole.omega + kept * (nodes.omega[n] - whole.omega);
    });
    return std::min(within, excess);
}

std::size_t Accounts::bytes() const
{
    return (ledgers_.capacity() + former_.capacity()) * sizeof(Ledger) + nets_.capacity() * sizeof(Net) +
           (group_.capacity() + netAt_.capacity() + bodies_.capacity()) * sizeof(Index) + marks_.capacity();
}

}  // namespace jet::physics::soft
