// Constraints of contacts: where they lie, and how they are kept up with the contacts.
#include "solver.hpp"

#include <cmath>

namespace jet::physics {

namespace {

constexpr float kPushLengths = 4;  // overlaps are pushed out no faster than this many lengths a second
constexpr float kSlopsPerLength = 500;
constexpr float kPushPerSlop = kPushLengths * kSlopsPerLength;
constexpr std::uint32_t kGroupsABlock = 16;
constexpr std::size_t kGroupsAhead = 3;
constexpr std::size_t kIdleABlock = 512;

void prefetch(const Part& part)
{
    for (std::size_t at = 0; at < sizeof part; at += 64) __builtin_prefetch(reinterpret_cast<const char*>(&part) + at);
}

}  // namespace

template <class Real>
typename Solver<Real>::Node Solver<Real>::nodeOf(Index a, bool movesA, Index b, bool movesB) const
{
    if (!movesA) return domains_.nodeOf(b);
    return movesB ? Domains::meet(domains_.nodeOf(a), domains_.nodeOf(b)) : domains_.nodeOf(a);
}

template <class Real>
std::size_t Solver<Real>::colourOf(Index a, bool movesA, Index b, bool movesB, Taken& taken) const
{
    const Node node = nodeOf(a, movesA, b, movesB);
    const std::uint32_t both = (movesA ? takenOf(taken, a, node) : 0) | (movesB ? takenOf(taken, b, node) : 0);
    const auto colour = static_cast<std::size_t>(__builtin_ctz(~both | 1U << (kColours - 1)));
    if (colour < kColours - 1) {
        if (movesA) takenOf(taken, a, node) |= 1U << colour;
        if (movesB) takenOf(taken, b, node) |= 1U << colour;
    }
    return firstColourOf(node) + colour;
}

template <class Real>
void Solver<Real>::addLane(Colour& colour, bool alone)
{
    if (alone) colour.count = groups(colour.count) * kWidth;
    if (colour.count++ % kWidth != 0) return;
    colour.contacts.emplace_back(ContactLanes<Real>{});
    colour.frictions.emplace_back(FrictionLanes<Real>{});
    if (bounces_) colour.bounces.emplace_back(BounceLanes<Real>{});
    colour.touched.push_back(0), colour.touches.push_back(0);
    colour.index.resize(colour.contacts.size() * kWidth, kNone);
}

template <class Real>
void Solver<Real>::refresh(Collider& collider, double dt, bool resolve)
{
    if (drifts_.empty()) drifts_ = arena_->take<float>(domains_.slotCount());
    drifts_[0] = collider.drifts()[0];
    domains_.eachBody(
        *pool_, [&](Index body, Index slot) { drifts_[slot] = collider.drifts()[body]; },
        [&](Index, Index slot) { prefetchToWrite(&drifts_[slot]); });
    const std::size_t placed = listPlaced(), size = collider.contacts().size();
    const std::size_t idle = (size + kIdleABlock - 1) / kIdleABlock;
    for (std::size_t i = placed; i < placed + idle; ++i) blockAt(i);
    pool_->both(
        placed, [&](std::size_t i) { refreshPlaced(collider, dt, resolve, blocks_[inTurn_[i]]); }, idle,
        [&](std::size_t i) {
            const std::size_t first = i * kIdleABlock, last = std::min(size, first + kIdleABlock);
            refreshIdle(collider, dt, resolve, first, last, blocks_[placed + i]);
        });
    settleBlocks(collider, placed + idle, resolve);
}

template <class Real>
typename Solver<Real>::Block& Solver<Real>::blockAt(std::size_t index)
{
    if (index >= blocks_.size()) blocks_.resize(index + 1);
    Block& block = blocks_[index];
    block.outcomes.clear();
    block.hardest = 0;
    block.foresees = block.bounces = false;
    return block;
}

/// Blocks of all that have constraints, in the order of the tree; how many there are. Threads take them in another, so
/// that each has those of the domains that it solves: a block is 500 lines of memory.
template <class Real>
std::size_t Solver<Real>::listPlaced()
{
    std::uint32_t firstOf[Domains::kNodes + 1] = {}, lastOf[Domains::kNodes + 1] = {}, count = 0;
    domains_.below(Domains::kRoot, [&](Node node) {
        firstOf[node] = count;
        for (std::size_t which = firstColourOf(node); which < firstColourOf(node) + kColours; ++which) {
            const auto size = static_cast<std::uint32_t>(colours_[which].contacts.size());
            for (std::uint32_t first = 0; first < size; first += kGroupsABlock) {
                Block& block = blockAt(count++);
                block.colour = static_cast<std::uint32_t>(which);
                block.first = first, block.last = std::min(first + kGroupsABlock, size);
            }
        }
        lastOf[node] = count;
    });
    inTurn_.clear();
    domains_.across(Domains::kRoot, [&](Node node) {
        for (std::uint32_t i = firstOf[node]; i < lastOf[node]; ++i) inTurn_.push_back(i);
    });
    return count;
}

/// Writes constraints anew, those of single precision eight at a time.
template <class Real>
class Solver<Real>::Rewriter {
public:
    Rewriter(Solver& solver, const Collider& collider) : solver_(solver), collider_(collider) {}

    void add(const RigidContact& c, Place place)
    {
        if constexpr (!std::is_same_v<Real, float>) {
            solver_.write(collider_, c, place);
        } else {
            Colour& colour = solver_.colourAt(place);
            const std::size_t group = laneAt(place) / kWidth, lane = laneAt(place) % kWidth;
            if (solver_.bounces_) colour.bounces[group].restitution[lane] = c.restitution;
            waiting_[count_++] = {&c, &colour.contacts[group], &colour.frictions[group], lane};
            if (count_ == kWidth) write();
        }
    }
    void finish()
    {
        if (count_ == 0) return;
        std::fill(waiting_ + count_, waiting_ + kWidth, waiting_[0]);
        write();
    }

private:
    void write()
    {
        if constexpr (std::is_same_v<Real, float>)
            solver_.kernels_->writeContacts(waiting_, collider_.poses().data(), solver_.states_.data());
        count_ = 0;
    }

    Solver& solver_;
    const Collider& collider_;
    LaneOfContact waiting_[kWidth];
    std::size_t count_ = 0;
};

/// Lanes whose bodies may have moved, as bits; none is jumped over, as they follow no pattern.
template <class Real>
std::uint32_t Solver<Real>::dueLanes(const Colour& colour, std::size_t group, bool all) const
{
    const ContactLanes<Real>& g = colour.contacts[group];
    std::uint32_t due = 0;
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
        const float drift = drifts_[slotAt<Real>(g.a[lane])] + drifts_[slotAt<Real>(g.b[lane])];
        due |= static_cast<std::uint32_t>(kPushPerSlop * drift > static_cast<float>(g.mostPush[lane])) << lane;
    }
    if (!all) return due;
    for (std::size_t lane = 0; lane < kWidth; ++lane)
        due |= static_cast<std::uint32_t>(colour.index[group * kWidth + lane] != kNone) << lane;
    return due;
}

/// Lists what of a block is due, and fetches the impulses. What it reads of contacts lies anywhere in memory: it is
/// asked for some groups ahead.
template <class Real>
void Solver<Real>::listDue(Collider& collider, Block& block)
{
    auto& contacts = collider.contacts();
    const Pose* poses = collider.poses().data();
    const Colour& colour = colours_[block.colour];
    std::uint32_t due[kGroupsABlock] = {};
    const auto ask = [&](std::size_t group) {
        if (group >= block.last) return;
        const ContactLanes<Real>& g = colour.contacts[group];
        due[group - block.first] = dueLanes(colour, group, collider.anyDisturbed());
        for (std::uint32_t rest = due[group - block.first]; rest != 0; rest &= rest - 1) {
            const auto lane = static_cast<std::size_t>(__builtin_ctz(rest));
            const RigidContact* contact = &contacts[colour.index[group * kWidth + lane]];
            prefetchToWrite(contact), prefetchToWrite(reinterpret_cast<const char*>(contact) + 64);
            for (const std::int32_t far : {g.a[lane], g.b[lane]})
                if (far != 0) __builtin_prefetch(&poses[domains_.bodyAt(slotAt<Real>(far))]);
        }
    };
    block.due.clear();
    for (std::size_t group = block.first; group < block.first + kGroupsAhead; ++group) ask(group);
    for (std::size_t group = block.first; group < block.last; ++group) {
        ask(group + kGroupsAhead);
        for (std::uint32_t rest = due[group - block.first]; rest != 0; rest &= rest - 1) {
            const std::size_t at = group * kWidth + static_cast<std::size_t>(__builtin_ctz(rest));
            RigidContact& c = contacts[colour.index[at]];
            if (!collider.due(c)) continue;
            for (const Index part : {c.partA, c.partB}) prefetch(collider.parts()[part]);
            fetch(c, placeOf(block.colour, at));
            block.due.push_back(colour.index[at]);
        }
    }
}

template <class Real>
void Solver<Real>::refreshPlaced(Collider& collider, double dt, bool resolve, Block& block)
{
    listDue(collider, block);
    collider.update(block.due, block.looks, dt);
    Rewriter rewriter(*this, collider);
    for (std::size_t i = 0; i < block.due.size(); ++i) {
        const Collider::Look& look = block.looks[i];
        const RigidContact& c = collider.contacts()[block.due[i]];
        block.foresees |= look.hits;
        if (look.kept && c.count > 0 && c.resolve && resolve) {
            rewriter.add(c, collider.places()[block.due[i]]);
            block.hardest = std::max(block.hardest, look.speed);
        } else {
            block.outcomes.push_back({block.due[i], nodeOf(block.colour), look.kept, false});
        }
    }
    rewriter.finish();
}

template <class Real>
void Solver<Real>::refreshIdle(Collider& collider, double dt, bool resolve, std::size_t first, std::size_t last,
                               Block& block)
{
    // Which are idle, and which of them due, follows no pattern: none is jumped over. Nothing is read of the others, as
    // they are looked at beside this.
    block.due.resize(last - first);
    Index* const list = block.due.data();
    const Place* const places = collider.places().data();
    std::size_t idle = 0, due = 0;
    for (auto contact = static_cast<Index>(first); contact < last; ++contact) {
        list[idle] = contact;
        idle += static_cast<std::size_t>(places[contact] == kIdle);
    }
    for (std::size_t i = 0; i < idle; ++i) {
        const Index contact = list[i];
        list[due] = contact;
        due += static_cast<std::size_t>(collider.nears(contact));
    }
    std::size_t left = 0;
    for (std::size_t at = 0; at < due; at += Sieve::kPairs) {
        const std::size_t count = std::min<std::size_t>(Sieve::kPairs, due - at);
        for (std::size_t i = at + Sieve::kPairs; i < std::min(at + 2 * Sieve::kPairs, due); ++i)
            collider.prefetch(block.due[i]);
        std::uint32_t near = ~collider.sift(&block.due[at], count, dt) & ((1U << count) - 1);
        for (; near != 0; near &= near - 1, ++left) {
            block.due[left] = block.due[at + static_cast<std::size_t>(__builtin_ctz(near))];
            const RigidContact& c = collider.contacts()[block.due[left]];
            prefetchToWrite(&c.normal);
            for (const Index part : {c.partA, c.partB}) prefetch(collider.parts()[part]);
        }
    }
    block.due.resize(left);
    collider.update(block.due, block.looks, dt);
    for (std::size_t i = 0; i < left; ++i) {
        const Collider::Look& look = block.looks[i];
        const RigidContact& c = collider.contacts()[block.due[i]];
        block.foresees |= look.hits;
        if (look.kept && !c.touching && c.count == 0) continue;
        const RigidBody &a = collider.bodies()[c.bodyA], &b = collider.bodies()[c.bodyB];
        const bool pushes = look.kept && c.count > 0 && c.resolve && resolve;
        block.bounces |= pushes && c.restitution > 0;
        block.outcomes.push_back(
            {block.due[i], nodeOf(c.bodyA, a.moves, c.bodyB, b.moves), look.kept, pushes && (a.asleep || b.asleep)});
    }
}

template <class Real>
void Solver<Real>::copyLane(const Colour& from, std::size_t source, Colour& to, std::size_t target, bool bounces)
{
    const std::size_t a = source % kWidth, b = target % kWidth;
    const auto copy = [&](const Lanes<Real>& old, Lanes<Real>& lanes) { lanes[b] = old[a]; };
    const ContactLanes<Real>& g = from.contacts[source / kWidth];
    const FrictionLanes<Real>& f = from.frictions[source / kWidth];
    ContactLanes<Real>& h = to.contacts[target / kWidth];
    FrictionLanes<Real>& e = to.frictions[target / kWidth];
    h.a[b] = g.a[a], h.b[b] = g.b[a];
    copy(g.normalX, h.normalX), copy(g.normalY, h.normalY), copy(g.mostPush, h.mostPush), copy(f.friction, e.friction);
    for (int k = 0; k < 2; ++k) {
        const auto& p = g.points[k];
        auto& q = h.points[k];
        copy(p.leverA, q.leverA), copy(p.leverB, q.leverB), copy(p.separation, q.separation), copy(p.now, q.now);
        copy(p.mass, q.mass), copy(p.impulse, q.impulse);
        const auto& s = f.points[k];
        auto& t = e.points[k];
        copy(s.leverA, t.leverA), copy(s.leverB, t.leverB), copy(s.mass, t.mass), copy(s.impulse, t.impulse);
        copy(s.total, t.total);
    }
    if (bounces) {
        const BounceLanes<Real>& r = from.bounces[source / kWidth];
        BounceLanes<Real>& s = to.bounces[target / kWidth];
        copy(r.restitution, s.restitution);
    }
    const std::uint32_t bit = from.touched[source / kWidth] >> a & 1U;
    to.touched[target / kWidth] &= ~(1U << b);
    to.touched[target / kWidth] |= bit << b;
    to.index[target] = from.index[source];
}

template <class Real>
void Solver<Real>::moveLane(Collider& collider, Colour& colour, std::size_t from, std::size_t to)
{
    copyLane(colour, from, colour, to, bounces_);
    const auto which = static_cast<std::size_t>(&colour - colours_.data());
    if (colour.index[to] != kNone) collider.places()[colour.index[to]] = placeOf(which, to);
}

/// Frozen until the contact is looked at again: normal, levers and masses.
template <class Real>
void Solver<Real>::write(const Collider& collider, const RigidContact& c, Place place)
{
    const Pose &poseA = collider.poses()[c.bodyA], &poseB = collider.poses()[c.bodyB];
    Colour& colour = colourAt(place);
    const std::size_t group = laneAt(place) / kWidth, lane = laneAt(place) % kWidth;
    ContactLanes<Real>& g = colour.contacts[group];
    FrictionLanes<Real>& f = colour.frictions[group];
    const auto shown = [&](Index index) {
        const RigidBody& is = collider.bodies()[index];
        return is.moves || is.kinematic ? farOf<Real>(domains_.slotOf(index)) : 0;
    };
    g.a[lane] = shown(c.bodyA), g.b[lane] = shown(c.bodyB);
    const BodyState<Real>&a = states_[slotAt<Real>(g.a[lane])], &b = states_[slotAt<Real>(g.b[lane])];
    const Vec2f n = turned(poseA.turn, c.normal);
    const Real nx = n.x, ny = n.y;
    g.normalX[lane] = nx, g.normalY[lane] = ny;
    g.mostPush[lane] = kPushPerSlop * c.slop;
    f.friction[lane] = c.friction;
    if (bounces_) colour.bounces[group].restitution[lane] = c.restitution;
    const Real inverse = a.invMass + b.invMass;
    for (int k = 0; k < 2; ++k) {
        auto& p = g.points[k];
        auto& q = f.points[k];
        if (k >= c.count) {
            p.leverA[lane] = p.leverB[lane] = q.leverA[lane] = q.leverB[lane] = 0;
            p.separation[lane] = p.now[lane] = p.mass[lane] = p.impulse[lane] = 0;
            q.mass[lane] = q.impulse[lane] = q.total[lane] = 0;
            continue;
        }
        // Both arms end in one place, half way between the surfaces.
        // Far ones, of foreseen hits, act on the surfaces.
        const Vec2f half = (c.separation[k] < 20 * c.slop ? 0.5F * c.separation[k] : 0.0F) * n;
        const Vec2f armA = turned(poseA.turn, c.onA[k]) + half, armB = turned(poseB.turn, c.onB[k]) - half;
        const Real leverA = (armA.x * ny - armA.y * nx) * a.perGyration,
                   leverB = (armB.x * ny - armB.y * nx) * b.perGyration;
        const Real slideA = (armA.x * nx + armA.y * ny) * a.perGyration,
                   slideB = (armB.x * nx + armB.y * ny) * b.perGyration;
        p.leverA[lane] = leverA, p.leverB[lane] = leverB;
        q.leverA[lane] = slideA, q.leverB[lane] = slideB;
        p.separation[lane] = p.now[lane] = c.separation[k] + c.slop;
        const Real k1 = inverse + a.invMass * leverA * leverA + b.invMass * leverB * leverB;
        const Real k2 = inverse + a.invMass * slideA * slideA + b.invMass * slideB * slideB;
        p.mass[lane] = k1 > 0 ? 1 / k1 : 0, q.mass[lane] = k2 > 0 ? 1 / k2 : 0;
        p.impulse[lane] = c.impulse[k], q.impulse[lane] = c.tangentImpulse[k];
    }
}

template <class Real>
void Solver<Real>::fetch(RigidContact& c, Place place) const
{
    const Colour& colour = colourAt(place);
    const std::size_t group = laneAt(place) / kWidth, lane = laneAt(place) % kWidth;
    const ContactLanes<Real>& g = colour.contacts[group];
    c.stepImpulse = 0;
    for (int k = 0; k < c.count; ++k) {
        c.separation[k] = static_cast<float>(g.points[k].separation[lane]) - c.slop;
        c.impulse[k] = static_cast<float>(g.points[k].impulse[lane]);
        c.tangentImpulse[k] = static_cast<float>(colour.frictions[group].points[k].impulse[lane]);
        c.stepImpulse += static_cast<float>(total(place, k));
    }
}

template <class Real>
void Solver<Real>::clear(Colour& colour)
{
    colour.contacts.clear(), colour.frictions.clear(), colour.bounces.clear(), colour.index.clear();
    colour.touched.clear(), colour.touches.clear();
    colour.count = 0;
}

template <class Real>
void Solver<Real>::release(Collider& collider)
{
    auto& places = collider.places();
    for (Index contact = 0; contact < places.size(); ++contact) {
        if (!isPlaced(places[contact])) continue;
        RigidContact& c = collider.contacts()[contact];
        fetch(c, places[contact]);
        collider.markDue(contact);
        places[contact] = kIdle;
    }
    for (Colour& colour : colours_) clear(colour);
    taken_.clear();
    bounces_ = false;
}

template <class Real>
bool Solver<Real>::holdsContacts() const
{
    for (const Colour& colour : colours_)
        if (colour.count > 0) return true;
    return false;
}

/// Makes room as the places of restored contacts say.
template <class Real>
void Solver<Real>::place(const Collider& collider)
{
    const bool bounces = bounces_;
    if (colours_.empty()) colours_.resize(kColours * Domains::kNodes), jointColours_.resize(kColours * Domains::kNodes);
    for (Colour& colour : colours_) clear(colour);
    bounces_ = bounces;
    taken_.clear();
    taken_.resize(collider.bodies().size(), domains_.depth());
    const auto& places = collider.places();
    for (Index contact = 0; contact < places.size(); ++contact) {
        if (!isPlaced(places[contact])) continue;
        const std::size_t which = places[contact] >> kLaneBits, at = laneAt(places[contact]);
        if (which >= colours_.size() || at > 2 * kWidth * places.size()) RestoreArchive::fail();
        Colour& colour = colours_[which];
        const RigidContact& c = collider.contacts()[contact];
        colour.count = std::max(colour.count, at + 1);
        const std::size_t size = groups(colour.count);
        if (colour.contacts.size() < size) {
            colour.contacts.resize(size, ContactLanes<Real>{}), colour.frictions.resize(size, FrictionLanes<Real>{});
            if (bounces_) colour.bounces.resize(size, BounceLanes<Real>{});
            colour.touched.resize(size, 0), colour.touches.resize(size, 0), colour.index.resize(size * kWidth, kNone);
        }
        if (c.touching) colour.touched[at / kWidth] |= 1U << (at % kWidth);
        if (isLast(which)) continue;
        for (const Index body : {c.bodyA, c.bodyB})
            if (collider.bodies()[body].moves) takenOf(taken_, body, nodeOf(which)) |= 1U << which % kColours;
    }
}

template class Solver<float>;
template class Solver<double>;

}  // namespace jet::physics
