// What follows from the looks at contacts: constraints come and go, pairs are forgotten. The nodes of the tree of
// domains have no constraint in common, and no body on the same level of it, so each takes in and gives up its own
// while others do; what they would share is done beside them, in the order of the looks.
#include "solver.hpp"

namespace jet::physics {

namespace {

constexpr std::size_t kPrefetched = 4, kBlocksAhead = 8;
constexpr std::size_t kFewOutcomes = 24;  // one thread is as quick as two with so few
// Which node comes where, so that the halves of the list are those of the tree; 0: what they share.
constexpr std::uint8_t kOrder[][std::size_t{2} << Domains::kMostDepth] = {
    {1, 0}, {2, 0, 1, 3}, {2, 4, 5, 0, 1, 3, 6, 7}};

}  // namespace

template <class Real>
void Solver<Real>::settleBlocks(Collider& collider, std::size_t count, bool resolve)
{
    std::size_t outcomes = 0;
    bool bounces = false;
    for (std::size_t i = 0; i < count; ++i) {
        if (i + kBlocksAhead < count) __builtin_prefetch(&blocks_[i + kBlocksAhead]);
        const Block& block = blocks_[i];
        hardest_ = std::max(hardest_, block.hardest);
        foresees_ |= block.foresees;
        bounces |= block.bounces;
        outcomes += block.outcomes.size();
    }
    if (outcomes == 0) return;
    if (bounces && !bounces_) {
        bounces_ = true;
        for (Colour& each : colours_) each.bounces.resize(each.contacts.size(), BounceLanes<Real>{});
    }
    const auto work = [&](std::size_t node) {
        if (node == 0) {
            forgetPairs(collider, count);
        } else {
            settleNode(collider, count, static_cast<Node>(node), resolve);
        }
    };
    const std::size_t nodes = 2 * domains_.leaves();
    if (outcomes <= kFewOutcomes || domains_.depth() == 0) {
        for (std::size_t node = 0; node < nodes; ++node) work(node);
    } else {
        pool_->run(nodes, [&](std::size_t i) { work(kOrder[domains_.depth()][i]); });
    }
    for (std::size_t node = 1; node < nodes; ++node) hardest_ = std::max(hardest_, settling_[node].hardest);
    noteChanges();
}

/// What is not up to one node alone: pairs are no longer known, sleeping bodies are to be woken.
template <class Real>
void Solver<Real>::forgetPairs(Collider& collider, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<Outcome>& outcomes = blocks_[i].outcomes;
        for (std::size_t k = 0; k < outcomes.size(); ++k) {
            if (k + kPrefetched < outcomes.size() && !outcomes[k + kPrefetched].kept)
                collider.prefetchKnown(outcomes[k + kPrefetched].contact);
            if (!outcomes[k].kept) collider.forgetPair(outcomes[k].contact);
            if (outcomes[k].rouses) collider.rouse(outcomes[k].contact);
        }
    }
}

template <class Real>
void Solver<Real>::settleNode(Collider& collider, std::size_t count, Node node, bool resolve)
{
    Settling& settling = settling_[node];
    settling.changes.clear();
    settling.hardest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<Outcome>& outcomes = blocks_[i].outcomes;
        if (i + kBlocksAhead < count) __builtin_prefetch(&blocks_[i + kBlocksAhead]);
        for (std::size_t k = 0; k < outcomes.size(); ++k) {
            if (k + kPrefetched < outcomes.size() && outcomes[k + kPrefetched].node == node)
                collider.prefetchWhole(outcomes[k + kPrefetched].contact);
            if (outcomes[k].node == node && !outcomes[k].rouses) settle(collider, outcomes[k], resolve, settling);
        }
    }
}

template <class Real>
void Solver<Real>::settle(Collider& collider, const Outcome& outcome, bool resolve, Settling& settling)
{
    RigidContact& c = collider.contacts()[outcome.contact];
    Place& place = collider.places()[outcome.contact];
    if (outcome.kept && c.count > 0 && c.resolve && resolve) {
        if (!isPlaced(place)) admit(collider, outcome.contact, settling);
        return;
    }
    if (isPlaced(place)) remove(collider, outcome.contact);
    c.stepImpulse = 0;
    change(c, outcome.kept && c.nearest() <= c.slop, settling.changes);
    if (!outcome.kept) place = kFree;
}

template <class Real>
void Solver<Real>::change(RigidContact& c, bool touching, std::vector<TouchChange>& changes)
{
    if (c.touching == touching) return;
    c.touching = touching;
    changes.push_back({c.bodyA, c.bodyB, touching, c.stepImpulse});
}

template <class Real>
void Solver<Real>::admit(Collider& collider, Index contact, Settling& settling)
{
    const RigidContact& c = collider.contacts()[contact];
    const auto& bodies = collider.bodies();
    const std::size_t which = colourOf(c.bodyA, bodies[c.bodyA].moves, c.bodyB, bodies[c.bodyB].moves, taken_);
    Colour& colour = colours_[which];
    addLane(colour, isLast(which));
    const std::size_t at = colour.count - 1;
    colour.index[at] = contact;
    if (c.touching) colour.touched[at / kWidth] |= 1U << (at % kWidth);
    const Place place = placeOf(which, at);
    collider.places()[contact] = place;
    write(collider, c, place);
    settling.hardest = std::max(settling.hardest, collider.hitSpeed(c));
}

/// The last lane takes its place, and is wiped out where it was.
template <class Real>
void Solver<Real>::remove(Collider& collider, Index contact)
{
    const Place place = collider.places()[contact];
    const std::size_t which = place >> kLaneBits;
    Colour& colour = colourAt(place);
    const RigidContact& c = collider.contacts()[contact];
    fetch(collider.contacts()[contact], place);
    // What does not move is in none, and others' too.
    for (const Index body : {c.bodyA, c.bodyB})
        if (!isLast(which) && collider.bodies()[body].moves)
            takenOf(taken_, body, nodeOf(which)) &= ~(1U << which % kColours);
    const std::size_t last = colour.count - 1, at = laneAt(place);
    if (at != last) moveLane(collider, colour, last, at);
    collider.places()[contact] = kIdle;
    const bool alone = isLast(which);
    if (last % kWidth == 0) {
        colour.contacts.pop_back(), colour.frictions.pop_back(), colour.touched.pop_back(), colour.touches.pop_back();
        if (bounces_) colour.bounces.pop_back();
        colour.index.resize(colour.contacts.size() * kWidth);
        colour.count = alone && last > 0 ? last - kWidth + 1 : last;
        return;
    }
    --colour.count;
    colour.index[last] = kNone;
    colour.touched[last / kWidth] &= ~(1U << (last % kWidth));
    const std::size_t lane = last % kWidth;
    const auto clear = [lane](Lanes<Real>& lanes) { lanes[lane] = 0; };
    ContactLanes<Real>& g = colour.contacts[last / kWidth];
    FrictionLanes<Real>& f = colour.frictions[last / kWidth];
    g.a[lane] = g.b[lane] = 0;
    clear(g.normalX), clear(g.normalY), clear(g.mostPush), clear(f.friction);
    for (int k = 0; k < 2; ++k) {
        clear(g.points[k].leverA), clear(g.points[k].leverB), clear(g.points[k].separation);
        clear(g.points[k].now), clear(g.points[k].mass), clear(g.points[k].impulse);
        clear(f.points[k].leverA), clear(f.points[k].leverB), clear(f.points[k].mass), clear(f.points[k].impulse);
        clear(f.points[k].total);
    }
    if (!bounces_) return;
    BounceLanes<Real>& r = colour.bounces[last / kWidth];
    clear(r.restitution);
}

template <class Real>
void Solver<Real>::suspend(Collider& collider, Index contact)
{
    if (isPlaced(collider.places()[contact])) remove(collider, contact);
    collider.places()[contact] = kAsleep;
}

template class Solver<float>;
template class Solver<double>;

}  // namespace jet::physics
