#include "contacts.hpp"

#include <cmath>
#include <utility>

namespace jet::physics::soft {

namespace {

constexpr double kHertz = 60, kHertzPerSubstepRate = 0.25, kDampingRatio = 10;  // as in contact_solver.cpp
constexpr double kBluntOverhang = 2;                                            // in slops
constexpr int kBouncePasses = 4;
// Pairs that move less than so many lengths in a step are looked at again only once they have moved that much further.
constexpr double kSlowLengths = 0.1, kRoomLengths = 0.06;
// Contacts that act get new seats once they are spread over this many times the lanes they need, and so many more.
constexpr double kMostSpread = 1.25, kLeastSpread = 32;
constexpr std::size_t kSlack = 256;  // touches that are over, and are kept for a while
constexpr double kLeastSingle = 1e-15, kMostSingle = 1e15;

Softness softness(double hertz, double h)
{
    const double omega = 2 * kPi * hertz;
    const double a1 = 2 * kDampingRatio + h * omega, a2 = h * omega * a1, a3 = 1 / (1 + a2);
    return {static_cast<float>(omega / a1), static_cast<float>(a2 * a3), static_cast<float>(a3)};
}

Particles particlesOf(State& state)
{
    Nodes& nodes = state.nodes;
    return {nodes.position[0].data(), nodes.velocity[0].data(), nodes.invMass.data()};
}

bool isEmpty(const ContactBlock& block)
{
    for (int lane = 0; lane < kWide; ++lane)
        if (block.side[lane] != 0) return false;
    return true;
}

}  // namespace

bool fitsContacts(const State& state, const BodyRecord& body)
{
    constexpr Index kMostWalls = 4096;  // above, a grid finds walls faster
    if (body.rigid || body.points.count == 0 || body.walls.count > kMostWalls) return false;
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
        if (!(state.nodes.mass[n] >= kLeastSingle && state.nodes.mass[n] <= kMostSingle)) return false;
    return body.length >= kLeastSingle && body.length <= kMostSingle;
}

void Contacts::find(State& state, const WorldSettings& settings, const std::vector<Motion>& motions,
                    std::span<const BodyPair> bodies, double dt, bool first)
{
    if (first) ended_.clear();
    path_.resize(state.bodies.size(), 0.0);
    if (refill_ || blocks_.empty()) {
        rebuild(state);
    } else if (roused_ && lacksSeats(state)) {
        unseated_ = true;
    }
    roused_ = false;
    std::size_t used = blocks_.size();
    while (used > 0 && isEmpty(blocks_[used - 1])) --used;
    resize(used);
    pairs_.swap(pairsBefore_);
    plan(state, settings, motions, bodies);
    look(state, motions, dt, first);
    for (ContactHead& head : heads_) head.idle = 0;
    for (ContactBlock& block : blocks_)
        if (first) block.stepImpulse = Floats{};
    if (first) kept_ = false;
    if (unseated_ || !wellSeated()) {
        keep();
        compact();
        seat(state);
    } else if (touches_.size() > 2 * live() + kSlack) {
        compact();
    }
}

/// Surveys the pairs that must be, and moves what they keep over.
void Contacts::look(State& state, const std::vector<Motion>& motions, double dt, bool first)
{
    walls_.clear();
    skins_.resize(state.bodies.size());
    skinned_.assign(state.bodies.size(), 0);
    auto before = pairsBefore_.begin();
    const auto leave = [&](Pair& pair) {
        keep(pair);
        for (Index i = pair.first; i < pair.end; ++i) {
            if (!first && touches_[i].stepImpulse > 0) ended_.push_back(asContact(state, pair, touches_[i]));
            vacate(touches_[i]);
        }
    };
    for (Pair& pair : pairs_) {
        while (before != pairsBefore_.end() && comesBefore(*before, pair)) leave(*before++);
        before_ = before != pairsBefore_.end() && !comesBefore(pair, *before) ? &*before++ : nullptr;
        if (state.atRest(pair.a, pair.b)) {
            keep(pair);
            for (Index i = pair.first; i < pair.end; ++i) vacate(touches_[i]);
        }
        if (pair.kept != 0) continue;
        if (before_) keep(*before_);
        pair.first = static_cast<Index>(touches_.size());
        survey(state, motions, pair, dt);
        pair.end = static_cast<Index>(touches_.size());
        if (before_) carryOver(state, *before_, pair, first);
        if (pair.resolve == 0) {
            for (Index i = pair.first; i < pair.end; ++i) {
                Touch& touch = touches_[i];
                vacate(touch);
                touch.normalImpulse = touch.tangentImpulse = touch.stepImpulse = 0;
            }
        }
        if (!isSolved(state, pair) || unseated_) continue;
        for (Index i = pair.first; i < pair.end; ++i) {
            if (touches_[i].seat == kNone) touches_[i].seat = seatAmong(state, touches_[i]);
            fill(state, pair, touches_[i]);
        }
    }
    while (before != pairsBefore_.end()) leave(*before++);
}

/// What the pairs of this step are, and which of them need not be looked at again.
void Contacts::plan(const State& state, const WorldSettings& settings, const std::vector<Motion>& motions,
                    std::span<const BodyPair> bodies)
{
    pairs_.clear();
    auto before = pairsBefore_.begin();
    for (const BodyPair& met : bodies) {
        const BodyRecord &a = state.bodies[met.a], &b = state.bodies[met.b];
        const MaterialPair& material =
            settings.materials[static_cast<std::size_t>(a.material) * settings.materialCount + b.material];
        if (!material.collides) continue;
        Pair pair{met.a, met.b};
        const double lengthA = a.fixed ? b.length : a.length, lengthB = b.fixed ? a.length : b.length;
        const double length = std::min(lengthA, lengthB);
        pair.slop = static_cast<float>(kSlopPerLength * length);
        pair.thickness = static_cast<float>(a.thickness() + b.thickness());
        pair.friction = static_cast<float>(material.friction),
        pair.restitution = static_cast<float>(material.restitution);
        pair.resolve = settings.resolveCollisions && !a.sensor && !b.sensor;
        while (before != pairsBefore_.end() && comesBefore(*before, pair)) ++before;
        const bool known = before != pairsBefore_.end() && !comesBefore(pair, *before);
        const double reach = motions[met.a].range + motions[met.b].range, path = path_[met.a] + path_[met.b];
        const bool roomy = known && path - before->seenAt + reach <= static_cast<double>(before->room);
        if (known && pair.isLike(*before) && (roomy || state.atRest(met.a, met.b))) {
            pair = *before;
            pair.kept = 1;
        } else {
            pair.seenAt = path;
            if (met.a != met.b && reach <= kSlowLengths * length)
                pair.room = static_cast<float>(reach + kRoomLengths * length);
        }
        if (known) ++before;
        pairs_.push_back(pair);
    }
}

void Contacts::survey(State& state, const std::vector<Motion>& motions, Pair& pair, double dt)
{
    for (const Index body : {pair.a, pair.b}) skin(state, body);
    if (pair.a == pair.b) {
        meetItself(state, motions[pair.a], pair, dt);
    } else {
        meet(state, motions, pair, true, dt);
        meet(state, motions, pair, false, dt);
    }
}

/// Are the contacts that act in few blocks?
bool Contacts::wellSeated() const
{
    std::size_t acting = 0, blocks = 0;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
        if (!heads_[k].any) continue;
        ++blocks;
        for (Index lane = 0; lane < kWide; ++lane) acting += blocks_[k].active[lane] != 0;
    }
    return static_cast<double>(blocks * kWide) <= kMostSpread * static_cast<double>(acting) + kLeastSpread;
}

void Contacts::resize(std::size_t blocks)
{
    blocks_.resize(blocks), heads_.resize(blocks), acting_.resize(blocks);
    actingCount_ = 0;
}

ContactBlocks Contacts::blocks()
{
    return {blocks_.data(), heads_.data(), blocks_.size(), acting_.data(), actingCount_};
}

/// The blocks as the touches' seats say.
void Contacts::rebuild(const State& state)
{
    keep();
    refill_ = false;
    resize(0);
    unseated_ = false;
    for (const Pair& pair : pairs_) {
        for (Index i = pair.first; i < pair.end && pair.resolve != 0; ++i) {
            const Touch& touch = touches_[i];
            if (touch.seat == kNone) {
                unseated_ |= isSolved(state, pair);
                continue;
            }
            if (touch.seat / kWide >= blocks_.size()) resize(touch.seat / kWide + std::size_t{1});
            fill(state, pair, touch);
        }
    }
}

bool Contacts::lacksSeats(const State& state) const
{
    for (const Pair& pair : pairs_)
        for (Index i = pair.first; i < pair.end && isSolved(state, pair); ++i)
            if (touches_[i].seat == kNone) return true;
    return false;
}

/// A lane that is free, in one of the last blocks in which none holds one of the touch's nodes; else in a new one.
Index Contacts::seatAmong(const State& state, const Touch& touch)
{
    constexpr std::size_t kTried = 24;
    const auto point = static_cast<std::int32_t>(state.points.node[touch.point]);
    const auto first = static_cast<std::int32_t>(state.points.node[state.walls.first[touch.wall]]);
    const auto second = static_cast<std::int32_t>(state.points.node[state.walls.second[touch.wall]]);
    const std::size_t oldest = blocks_.size() > kTried ? blocks_.size() - kTried : 0;
    for (std::size_t k = blocks_.size(); k-- > oldest;) {
        const ContactBlock& block = blocks_[k];
        Index free = kNone;
        bool held = false;
        for (Index lane = 0; lane < kWide; ++lane) {
            if (block.side[lane] == 0) {
                free = std::min(free, lane);
                continue;
            }
            for (const std::int32_t node : {point, first, second})
                held |= block.point[lane] == node || block.first[lane] == node || block.second[lane] == node;
        }
        if (free != kNone && !held) return static_cast<Index>(k) * kWide + free;
    }
    resize(blocks_.size() + 1);
    return (static_cast<Index>(blocks_.size()) - 1) * kWide;
}

void Contacts::vacate(Touch& touch)
{
    if (touch.seat == kNone) return;
    ContactBlock& block = blocks_[touch.seat / kWide];
    const Index lane = touch.seat % kWide;
    block.side[lane] = 0;
    block.inside[lane] = block.engaged[lane] = block.active[lane] = 0;
    block.normalImpulse[lane] = block.tangentImpulse[lane] = block.stepImpulse[lane] = 0;
    block.invPoint[lane] = block.invFirst[lane] = block.invSecond[lane] = 0;
    touch.seat = kNone;
}

std::size_t Contacts::live() const
{
    std::size_t count = 0;
    for (const Pair& pair : pairs_) count += pair.end - pair.first;
    return count;
}

/// Leaves out the touches of surveys that are over.
void Contacts::compact()
{
    compacted_.clear();
    for (Pair& pair : pairs_) {
        const auto first = static_cast<Index>(compacted_.size());
        compacted_.insert(compacted_.end(), touches_.begin() + pair.first, touches_.begin() + pair.end);
        pair.first = first, pair.end = static_cast<Index>(compacted_.size());
    }
    touches_.swap(compacted_);
}

void Contacts::travel(const State& state, std::span<const Vec2> from)
{
    if (from.size() != state.nodes.size()) return;
    path_.resize(state.bodies.size(), 0.0);
    for (Index handle = 0; handle < state.bodies.size(); ++handle) {
        const BodyRecord& body = state.bodies[handle];
        if (!body.wide || body.fixed || body.asleep) continue;
        const Index first = body.nodes.first;
        path_[handle] += std::sqrt(state.clouds->farthest(state.nodes.position[first].data(), from[first].data(),
                                                          nullptr, 0, body.nodes.count));
    }
}

void Contacts::carry(Index body, double way)
{
    if (path_.size() <= body) path_.resize(body + std::size_t{1}, 0.0);
    path_[body] += way;
}

const Contacts::Touch* Contacts::heldBefore(Index point, Index wall) const
{
    if (!before_) return nullptr;
    for (Index i = before_->first; i < before_->end; ++i)
        if (touches_[i].point == point && touches_[i].wall == wall) return &touches_[i];
    return nullptr;
}

/// Impulses go to the same point at the same wall, else, where a point slid on, to the neighbouring wall. What is over
/// is kept for the report. Points come in the same order in both lists.
void Contacts::carryOver(const State& state, const Pair& before, const Pair& now, bool first)
{
    Index from = before.first;
    const auto isA = [&](Index point) {
        return state.bodies[now.a].points.end() > point && point >= state.bodies[now.a].points.first;
    };
    const auto comesBefore = [&](Index p, Index q) { return isA(p) != isA(q) ? isA(p) : p < q; };
    const auto over = [&](Touch& touch) {
        if (!first && touch.stepImpulse > 0) ended_.push_back(asContact(state, before, touch));
        vacate(touch);
    };
    for (Index i = now.first; i < now.end;) {
        const Index point = touches_[i].point;
        while (from < before.end && comesBefore(touches_[from].point, point)) over(touches_[from++]);
        Index until = from;
        while (until < before.end && touches_[until].point == point) ++until;
        for (; i < now.end && touches_[i].point == point; ++i) {
            Touch& touch = touches_[i];
            Touch* source = nullptr;
            for (Index k = from; k < until; ++k) {
                Touch& old = touches_[k];
                if (old.wall == touch.wall) {
                    source = &old;
                    break;
                }
                const bool neighbour =
                    old.wall == state.walls.previous[touch.wall] || old.wall == state.walls.next[touch.wall];
                // Only a point that leaves the neighbouring wall brings its impulse along.
                if (neighbour && old.active != 0 && old.normalImpulse > 0 && !(old.along > 0 && old.along < 1))
                    source = &old;
            }
            if (!source) continue;
            touch.normalImpulse = source->normalImpulse, touch.tangentImpulse = source->tangentImpulse;
            touch.along = source->wall == state.walls.next[touch.wall] ? 1 : 0;  // the corner it went round
            if (source->wall != touch.wall) continue;
            touch.along = source->along;
            touch.seat = std::exchange(source->seat, kNone);
            touch.stepImpulse = source->stepImpulse;
            touch.engaged = source->engaged & source->active, touch.active = source->active, touch.far = source->far;
            source->stepImpulse = 0;
        }
        for (; from < until; ++from) over(touches_[from]);
    }
    for (; from < before.end; ++from) over(touches_[from]);
}

/// Gives each touch a lane in a block: first those that acted, so that their blocks are full; then those that are near,
/// so that the blocks of the others can wait.
void Contacts::seat(const State& state)
{
    resize(0);
    unseated_ = false;
    const auto rankOf = [](const Touch& touch) {
        return touch.active != 0 || touch.inside != 0 ? 0 : touch.far == 0 ? 1 : 2;
    };
    for (const int rank : {0, 1, 2}) {
        seated_.assign(state.nodes.size(), 0);
        filled_.fill(0);
        for (const Pair& pair : pairs_) {
            if (!isSolved(state, pair)) continue;
            for (Index i = pair.first; i < pair.end; ++i) {
                Touch& touch = touches_[i];
                if (rankOf(touch) != rank) continue;
                touch.seat = freeSeat(state.points.node[touch.point], state.points.node[state.walls.first[touch.wall]],
                                      state.points.node[state.walls.second[touch.wall]]);
                fill(state, pair, touch);
            }
        }
    }
}

/// A lane of a block none of whose contacts holds one of the three nodes. Up to 64 blocks are open at a time.
Index Contacts::freeSeat(Index point, Index first, Index second)
{
    const std::uint64_t free = ~(seated_[point] | seated_[first] | seated_[second]);
    if (free == 0) {  // a block of its own
        resize(blocks_.size() + 1);
        return (static_cast<Index>(blocks_.size()) - 1) * kWide;
    }
    const int slot = __builtin_ctzll(free);
    const std::uint64_t bit = std::uint64_t{1} << slot;
    if (filled_[slot] == 0) {
        open_[slot] = static_cast<Index>(blocks_.size());
        resize(blocks_.size() + 1);
    }
    const Index seat = open_[slot] * kWide + filled_[slot]++;
    seated_[point] |= bit, seated_[first] |= bit, seated_[second] |= bit;
    if (filled_[slot] < kWide) return seat;
    // Full: the slot goes to a new block, which holds none of these nodes.
    filled_[slot] = 0;
    const ContactBlock& full = blocks_[open_[slot]];
    for (int lane = 0; lane < kWide - 1; ++lane)
        for (const std::int32_t node : {full.point[lane], full.first[lane], full.second[lane]})
            seated_[static_cast<Index>(node)] &= ~bit;
    seated_[point] &= ~bit, seated_[first] &= ~bit, seated_[second] &= ~bit;
    return seat;
}

/// Into the lane of its seat.
void Contacts::fill(const State& state, const Pair& pair, const Touch& touch)
{
    const Nodes& nodes = state.nodes;
    const Index point = state.points.node[touch.point];
    const Index first = state.points.node[state.walls.first[touch.wall]];
    const Index second = state.points.node[state.walls.second[touch.wall]];
    ContactBlock& block = blocks_[touch.seat / kWide];
    const Index lane = touch.seat % kWide;
    block.point[lane] = static_cast<std::int32_t>(point);
    block.first[lane] = static_cast<std::int32_t>(first), block.second[lane] = static_cast<std::int32_t>(second);
    block.side[lane] = static_cast<float>(state.walls.outward[touch.wall]);
    block.thickness[lane] = pair.thickness, block.slop[lane] = pair.slop;
    block.friction[lane] = pair.friction, block.restitution[lane] = pair.restitution;
    const auto reach = [&](bool inset) {
        return inset ? -touch.inset : static_cast<float>(kBluntOverhang * static_cast<double>(pair.slop));
    };
    block.firstReach[lane] = reach((touch.insets & 1) != 0), block.secondReach[lane] = reach((touch.insets & 2) != 0);
    block.invPoint[lane] = static_cast<float>(nodes.invMass[point]);
    block.invFirst[lane] = static_cast<float>(nodes.invMass[first]);
    block.invSecond[lane] = static_cast<float>(nodes.invMass[second]);
    block.inside[lane] = touch.inside != 0 ? -1 : 0, block.engaged[lane] = touch.engaged != 0 ? -1 : 0;
    const bool still = nodes.invMass[point] == 0 || (nodes.invMass[first] == 0 && nodes.invMass[second] == 0);
    block.still[lane] = still ? -1 : 0;
    block.normalImpulse[lane] = touch.normalImpulse, block.tangentImpulse[lane] = touch.tangentImpulse;
    block.stepImpulse[lane] = touch.stepImpulse;
    block.active[lane] = touch.active != 0 ? -1 : 0;
    block.far[lane] = touch.far != 0 ? -1 : 0;
    block.along[lane] = touch.along;
    heads_[touch.seat / kWide].any |= touch.active != 0;
    heads_[touch.seat / kWide].uneven |= block.invFirst[lane] != block.invSecond[lane];
}

void Contacts::refresh(State& state, double h, double gravity)
{
    if (blocks_.empty()) return;
    const double hertz = std::min(kHertz, kHertzPerSubstepRate / h);
    kept_ = false;
    step_ = {static_cast<float>(h), static_cast<float>(1 / h), static_cast<float>(4 * gravity * h), softness(hertz, h),
             softness(2 * hertz, h)};
    actingCount_ = kernels_->refresh(blocks(), particlesOf(state), step_);
}

void Contacts::push(State& state)
{
    const Particles particles = particlesOf(state);
    kernels_->meet(blocks(), particles, step_.restSpeed);
    kernels_->warm(blocks(), particles);
    kernels_->solve(blocks(), particles, step_, true);
}

void Contacts::relax(State& state)
{
    const Particles particles = particlesOf(state);
    kernels_->solve(blocks(), particles, step_, false);
    if (std::none_of(heads_.begin(), heads_.end(), [](const ContactHead& head) { return head.bounces; })) return;
    for (int pass = 0; pass < kBouncePasses; ++pass) kernels_->bounce(blocks(), particles, step_.restSpeed);
}

void Contacts::keep()
{
    if (kept_) return;
    kept_ = true;
    for (const Pair& pair : pairs_) keep(pair);
}

/// Takes the state of a pair's touches out of the blocks.
void Contacts::keep(const Pair& pair)
{
    for (Index i = pair.first; i < pair.end; ++i) {
        Touch& touch = touches_[i];
        if (touch.seat == kNone || touch.seat / kWide >= blocks_.size()) continue;
        const ContactBlock& block = blocks_[touch.seat / kWide];
        const Index lane = touch.seat % kWide;
        touch.active = block.active[lane] != 0 && heads_[touch.seat / kWide].any;
        touch.engaged = block.engaged[lane] != 0;
        touch.far = block.far[lane] != 0;
        touch.along = block.along[lane];
        touch.normalImpulse = block.normalImpulse[lane], touch.tangentImpulse = block.tangentImpulse[lane];
        touch.stepImpulse = block.stepImpulse[lane];
    }
}

void Contacts::scale(double ratio)
{
    const auto by = static_cast<float>(ratio);
    keep();
    for (Touch& touch : touches_) touch.normalImpulse *= by, touch.tangentImpulse *= by;
    refill_ = true;
}

void Contacts::clear()
{
    pairs_.clear(), touches_.clear(), ended_.clear(), resize(0);
    kept_ = true;
}

void Contacts::forget(const State& state, const std::function<bool(Index)>& body)
{
    keep();
    std::vector<Touch> kept;
    for (Pair& pair : pairs_) {
        const Range& points = state.bodies[pair.a].points;
        const auto first = static_cast<Index>(kept.size());
        for (Index i = pair.first; i < pair.end; ++i) {
            const Touch& touch = touches_[i];
            const bool aOnB = touch.point >= points.first && touch.point < points.end();
            if (!body(aOnB ? pair.b : pair.a)) kept.push_back(touch);
        }
        pair.first = first, pair.end = static_cast<Index>(kept.size());
        pair.room = 0;
    }
    touches_.swap(kept);
    ended_.clear();
    resize(0);
    for (Touch& touch : touches_) touch.seat = kNone;
}

void Contacts::remove(Index body)
{
    const auto has = [body](const auto& pair) { return pair.a == body || pair.b == body; };
    std::erase_if(ended_, [body](const ContactPoint& c) { return c.bodyA == body || c.bodyB == body; });
    if (body < path_.size()) path_[body] = 0;
    if (std::none_of(pairs_.begin(), pairs_.end(), has)) return;
    keep();
    std::erase_if(pairs_, has);
    std::vector<Touch> kept;
    for (Pair& pair : pairs_) {
        const auto first = static_cast<Index>(kept.size());
        kept.insert(kept.end(), touches_.begin() + pair.first, touches_.begin() + pair.end);
        pair.first = first, pair.end = static_cast<Index>(kept.size());
    }
    touches_.swap(kept);
    resize(0);
    for (Touch& touch : touches_) touch.seat = kNone;
}

bool Contacts::fits(const State& state) const
{
    for (const Pair& pair : pairs_)
        if (pair.a >= state.bodies.size() || pair.b >= state.bodies.size() || pair.first > pair.end ||
            pair.end > touches_.size())
            return false;
    const auto known = [&](Index point, Index wall) {
        return point < state.points.size() && wall < state.walls.size();
    };
    for (const Touch& touch : touches_)
        if (!known(touch.point, touch.wall)) return false;
    for (const ContactPoint& c : ended_)
        if (!known(c.point, c.wall) || c.bodyA >= state.bodies.size() || c.bodyB >= state.bodies.size()) return false;
    return true;
}

ContactPoint Contacts::asContact(const State& state, const Pair& pair, const Touch& touch) const
{
    const Range& points = state.bodies[pair.a].points;
    const bool aOnB = touch.point >= points.first && touch.point < points.end();
    ContactPoint c;
    c.point = touch.point, c.wall = touch.wall;
    c.bodyA = aOnB ? pair.a : pair.b, c.bodyB = aOnB ? pair.b : pair.a;
    c.slop = static_cast<double>(pair.slop), c.thickness = static_cast<double>(pair.thickness);
    c.inside = touch.inside != 0, c.engaged = touch.engaged != 0;
    c.stepImpulse = static_cast<double>(touch.stepImpulse);
    return c;
}

std::size_t Contacts::bytes() const
{
    return (pairs_.capacity() + pairsBefore_.capacity()) * sizeof(Pair) +
           (touches_.capacity() + compacted_.capacity()) * sizeof(Touch) + blocks_.capacity() * sizeof(ContactBlock) +
           heads_.capacity() * sizeof(ContactHead) + acting_.capacity() * sizeof(std::uint32_t) +
           walls_.capacity() * sizeof(WallBlock) + seated_.capacity() * sizeof(std::uint64_t) +
           skins_.capacity() * sizeof(Skin) + ended_.capacity() * sizeof(ContactPoint) +
           path_.capacity() * sizeof(double);
}

}  // namespace jet::physics::soft
