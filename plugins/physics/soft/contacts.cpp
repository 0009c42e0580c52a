#include "contacts.hpp"

#include "border.hpp"

#include <limits>
#include <tuple>

namespace jet::physics::soft {

namespace {

constexpr double kHertz = 60, kHertzPerSubstepRate = 0.25, kDampingRatio = 10;      // as in contact_solver.cpp
constexpr double kSharpInset = 2, kBluntOverhang = 2;                               // in slops
constexpr double kLean = 0.3, kFacing = 0.2, kHeldBonus = 0.5, kFoldedPenalty = 2;  // as in narrow_phase.cpp
constexpr int kBouncePasses = 4;
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

struct View {
    double height, along, distance, length;
    Vec2 normal;
    bool valid;
};

View view(const State& state, Index wall, const Vec2& at)
{
    const Vec2& first = state.points.position[state.walls.first[wall]];
    const Vec2 edge = state.points.position[state.walls.second[wall]] - first, off = at - first;
    const double squared = edge.squaredNorm();
    View seen{};
    seen.valid = squared > 1e-24 && state.walls.outward[wall] != 0;
    if (!seen.valid) return seen;
    seen.length = std::sqrt(squared);
    seen.normal = perpendicular(edge) * (state.walls.outward[wall] / seen.length);
    seen.height = off.dot(seen.normal);
    seen.along = off.dot(edge) / squared;
    seen.distance = (off - std::clamp(seen.along, 0.0, 1.0) * edge).norm();
    return seen;
}

bool insidePiece(const State& state, const BodyRecord& body, Index piece, const Vec2& at)
{
    bool in = false;
    for (Index w = body.walls.first; w < body.walls.end(); ++w) {
        if (body.pieces[state.walls.first[w] - body.points.first] != piece) continue;
        const Vec2 &p = state.points.position[state.walls.first[w]], &q = state.points.position[state.walls.second[w]];
        if ((p.y() > at.y()) != (q.y() > at.y()) &&
            at.x() < p.x() + (at.y() - p.y()) / (q.y() - p.y()) * (q.x() - p.x()))
            in = !in;
    }
    return in;
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
    pairs_.swap(pairsBefore_), touches_.swap(touchesBefore_);
    pairs_.clear(), touches_.clear();
    walls_.clear();
    skins_.resize(state.bodies.size());
    skinned_.assign(state.bodies.size(), 0);
    auto before = pairsBefore_.begin();
    for (const BodyPair& met : bodies) {
        const BodyRecord &a = state.bodies[met.a], &b = state.bodies[met.b];
        const MaterialPair& material =
            settings.materials[static_cast<std::size_t>(a.material) * settings.materialCount + b.material];
        if (!material.collides) continue;
        Pair pair{met.a, met.b};
        const double lengthA = a.fixed ? b.length : a.length, lengthB = b.fixed ? a.length : b.length;
        pair.slop = static_cast<float>(kSlopPerLength * std::min(lengthA, lengthB));
        pair.thickness = static_cast<float>(a.matter.thickness + b.matter.thickness);
        pair.friction = static_cast<float>(material.friction),
        pair.restitution = static_cast<float>(material.restitution);
        pair.resolve = settings.resolveCollisions && !a.sensor && !b.sensor;
        pair.first = static_cast<Index>(touches_.size());
        while (before != pairsBefore_.end() && std::tie(before->a, before->b) < std::tie(pair.a, pair.b)) ++before;
        const bool known = before != pairsBefore_.end() && before->a == pair.a && before->b == pair.b;
        before_ = known ? &*before : nullptr;
        for (const Index body : {met.a, met.b}) skin(state, body);
        if (met.a == met.b) {
            meetItself(state, motions[met.a], pair, dt);
        } else {
            meet(state, motions, pair, true, dt);
            meet(state, motions, pair, false, dt);
        }
        pair.end = static_cast<Index>(touches_.size());
        if (known) carryOver(state, *before, pair, first);
        if (pair.end > pair.first) pairs_.push_back(pair);
    }
    if (first)
        for (Touch& touch : touches_) touch.stepImpulse = 0;
    seat(state);
}

/// The walls of the body, eight in a block, and the corners of its border.
void Contacts::skin(State& state, Index handle)
{
    if (skinned_[handle] != 0) return;
    skinned_[handle] = 1;
    const BodyRecord& body = state.bodies[handle];
    Skin& skin = skins_[handle];
    skin.first = static_cast<Index>(walls_.size());
    skin.count = (body.walls.count + kWide - 1) / kWide;
    if (body.walls.count == 0) return;
    skin.origin = state.points.position[state.walls.first[body.walls.first]];
    updateCorners(state, body);
    walls_.resize(walls_.size() + skin.count);
    const float nowhere = std::numeric_limits<float>::quiet_NaN();
    for (Index k = 0; k < skin.count; ++k) {
        WallBlock& block = walls_[skin.first + k];
        block = WallBlock();
        block.left = block.top = std::numeric_limits<float>::max();
        block.right = block.bottom = std::numeric_limits<float>::lowest();
        for (Index lane = 0; lane < kWide; ++lane) {
            const Index i = kWide * k + lane, wall = body.walls.first + i;
            if (i >= body.walls.count) {
                block.x[lane] = block.y[lane] = 1e30F;
                continue;
            }
            const Vec2 first = state.points.position[state.walls.first[wall]] - skin.origin;
            const Vec2 second = state.points.position[state.walls.second[wall]] - skin.origin;
            const auto x = static_cast<float>(first.x()), y = static_cast<float>(first.y());
            const float edgeX = static_cast<float>(second.x()) - x, edgeY = static_cast<float>(second.y()) - y;
            const float squared = edgeX * edgeX + edgeY * edgeY;
            const bool valid = squared > 1e-24F && state.walls.outward[wall] != 0;
            const float side = valid ? static_cast<float>(state.walls.outward[wall]) / std::sqrt(squared) : nowhere;
            block.x[lane] = x, block.y[lane] = y, block.edgeX[lane] = edgeX, block.edgeY[lane] = edgeY;
            block.normalX[lane] = -edgeY * side, block.normalY[lane] = edgeX * side;
            block.inverseSquare[lane] = valid ? 1 / squared : 0;
            block.slope[lane] = edgeY != 0 ? edgeX / edgeY : 0;
            block.left = std::min({block.left, x, x + edgeX}), block.right = std::max({block.right, x, x + edgeX});
            block.top = std::min({block.top, y, y + edgeY}), block.bottom = std::max({block.bottom, y, y + edgeY});
        }
    }
}

/// The points of one body at the walls of the other.
void Contacts::meet(State& state, const std::vector<Motion>& motions, const Pair& pair, bool aOnB, double dt)
{
    const Index from = aOnB ? pair.a : pair.b, onto = aOnB ? pair.b : pair.a;
    const BodyRecord &a = state.bodies[from], &b = state.bodies[onto];
    const Skin& skin = skins_[onto];
    if (skin.count == 0) return;
    const Motion &motionA = motions[from], &motionB = motions[onto];
    near_.resize(std::max<std::size_t>(near_.size(), skin.count));
    const double margin =
        motionA.stray + motionB.stray + 4 * static_cast<double>(pair.slop) + static_cast<double>(pair.thickness);
    const Box around = motionB.reach.inflated(motionA.range + static_cast<double>(pair.thickness));
    for (Index p = a.points.first; p < a.points.end(); ++p) {
        const Vec2& at = state.points.position[p];
        if (!around.contains(at)) continue;
        const Vec2 carried = motionB.velocity + motionB.omega * perpendicular(at - motionB.centre);
        const double reach = (state.nodes.velocity[state.points.node[p]] - carried).norm() * dt + margin;
        const Vec2 local = at - skin.origin;
        // The second end of a thick wall is its neighbour's.
        const double slide = pair.thickness > 0 ? reach - static_cast<double>(pair.thickness) : reach;
        const NearQuery query{static_cast<float>(local.x()), static_cast<float>(local.y()), static_cast<float>(reach),
                              static_cast<float>(slide), static_cast<float>(kTouchDepth) * pair.slop};
        const NearResult seen = kernels_->survey(&walls_[skin.first], skin.count, query, near_.data());
        for (Index k = 0; k < skin.count; ++k)
            for (unsigned rest = near_[k]; rest != 0; rest &= rest - 1)
                add(state, pair, p, b.walls.first + kWide * k + static_cast<Index>(__builtin_ctz(rest)), false);
        // On the border "inside" is a matter of rounding; the walls found in front of the point answer for it.
        if (!seen.inside || seen.onSurface) continue;
        const Index wall = wallToLeaveThrough(state, b, p, kNone);
        if (wall != kNone) add(state, pair, p, wall, true);
    }
}

/// The points of a body at its own walls: those of other pieces of it hold as those of other bodies; of its own, where
/// it collides with itself, only walls that face the point: the skin of a smooth border overlaps its neighbours.
void Contacts::meetItself(State& state, const Motion& motion, const Pair& pair, double dt)
{
    const BodyRecord& body = state.bodies[pair.a];
    const Skin& skin = skins_[pair.a];
    near_.resize(std::max<std::size_t>(near_.size(), skin.count));
    const double behind = kTouchDepth * static_cast<double>(pair.slop);
    const bool torn = body.pieceCount > 1;
    const auto pieceOf = [&](Index p) { return torn ? body.pieces[p - body.points.first] : 0; };
    for (Index p = body.points.first; p < body.points.end(); ++p) {
        const Vec2& normal = state.points.normal[p];
        if (normal.isZero() && !torn) continue;  // not on the border
        const Vec2& at = state.points.position[p];
        const Vec2& own = state.nodes.velocity[state.points.node[p]];
        const double reach = (own - motion.velocity).norm() * dt + motion.stray + 4 * static_cast<double>(pair.slop) +
                             static_cast<double>(pair.thickness);
        const Vec2 local = at - skin.origin;
        // Walls it has come through before hold it too; wide enough to see them.
        const auto wide = static_cast<float>(reach);
        const NearQuery query{static_cast<float>(local.x()), static_cast<float>(local.y()), wide, wide, wide};
        kernels_->survey(&walls_[skin.first], skin.count, query, near_.data());
        Index deepIn = kNone;  // wall of another piece it is behind
        bool onSurface = false;
        for (Index k = 0; k < skin.count; ++k) {
            for (unsigned rest = near_[k]; rest != 0; rest &= rest - 1) {
                const Index wall = body.walls.first + kWide * k + static_cast<Index>(__builtin_ctz(rest));
                if (state.walls.first[wall] == p || state.walls.second[wall] == p) continue;
                const View seen = view(state, wall, at);
                if (!seen.valid) continue;
                const bool other = pieceOf(p) != pieceOf(state.walls.first[wall]);
                if (!other && (!body.matter.selfCollision || normal.isZero() || normal.dot(seen.normal) > -kFacing))
                    continue;
                const Touch* held = heldBefore(p, wall);
                if (seen.height < -behind && other) deepIn = wall;
                if (seen.height < -behind && (other || !(held && held->stepImpulse > 0))) continue;
                onSurface |= other && seen.distance <= behind;
                add(state, pair, p, wall, false);
            }
        }
        if (deepIn == kNone || onSurface || !insidePiece(state, body, pieceOf(state.walls.first[deepIn]), at)) continue;
        const Index wall = wallToLeaveThrough(state, body, p, pieceOf(state.walls.first[deepIn]));
        if (wall != kNone) add(state, pair, p, wall, true);
    }
}

void Contacts::add(const State& state, const Pair& pair, Index point, Index wall, bool inside)
{
    // A point inside may be found twice at one wall: at its front, and to be pushed out; the latter counts.
    if (inside) {
        for (std::size_t i = touches_.size(); i > pair.first && touches_[i - 1].point == point; --i) {
            if (touches_[i - 1].wall != wall) continue;
            touches_[i - 1].inside = 1;
            return;
        }
    }
    Touch touch;
    touch.point = point, touch.wall = wall, touch.inside = inside;
    touch.seat = kNone;
    if (!inside && !(pair.thickness > 0)) touch.insets = insetsAt(state, point, wall);
    touches_.push_back(touch);
}

/// Near sharp ends of the wall, is the point rather its neighbour's? Then neither catches what slides over the corner.
std::uint8_t Contacts::insetsAt(const State& state, Index point, Index wall) const
{
    const Walls& walls = state.walls;
    const auto yields = [&](WallEnd end, Index neighbour) {
        if (end != WallEnd::Sharp) return false;
        const View seen = view(state, neighbour, state.points.position[point]);
        return seen.valid && state.points.normal[point].dot(seen.normal) <= kLean;
    };
    return static_cast<std::uint8_t>((yields(walls.firstEnd[wall], walls.previous[wall]) ? 1 : 0) |
                                     (yields(walls.secondEnd[wall], walls.next[wall]) ? 2 : 0));
}

Index Contacts::wallToLeaveThrough(const State& state, const BodyRecord& body, Index point, Index piece) const
{
    const Vec2 &at = state.points.position[point], &normal = state.points.normal[point];
    Index best = kNone;
    double score = std::numeric_limits<double>::infinity();
    for (Index wall = body.walls.first; wall < body.walls.end(); ++wall) {
        if (piece != kNone && body.pieces[state.walls.first[wall] - body.points.first] != piece) continue;
        const View seen = view(state, wall, at);
        if (!seen.valid || seen.height >= 0) continue;
        const Touch* held = heldBefore(point, wall);
        const double own = seen.distance * (held && held->stepImpulse > 0 ? kHeldBonus : 1) *
                           (normal.dot(seen.normal) <= 0 ? 1 : kFoldedPenalty);
        if (own < score) score = own, best = wall;
    }
    return best;
}

const Contacts::Touch* Contacts::heldBefore(Index point, Index wall) const
{
    if (!before_) return nullptr;
    for (Index i = before_->first; i < before_->end; ++i)
        if (touchesBefore_[i].point == point && touchesBefore_[i].wall == wall) return &touchesBefore_[i];
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
    const auto over = [&](const Touch& touch) {
        if (!first && touch.stepImpulse > 0) ended_.push_back(asContact(state, before, touch));
    };
    for (Index i = now.first; i < now.end;) {
        const Index point = touches_[i].point;
        while (from < before.end && comesBefore(touchesBefore_[from].point, point)) over(touchesBefore_[from++]);
        Index until = from;
        while (until < before.end && touchesBefore_[until].point == point) ++until;
        for (; i < now.end && touches_[i].point == point; ++i) {
            Touch& touch = touches_[i];
            Touch* source = nullptr;
            for (Index k = from; k < until; ++k) {
                Touch& old = touchesBefore_[k];
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
            if (source->wall != touch.wall) continue;
            touch.stepImpulse = source->stepImpulse;
            touch.engaged = source->engaged & source->active, touch.active = source->active;
            source->stepImpulse = 0;
        }
        for (; from < until; ++from) over(touchesBefore_[from]);
    }
    for (; from < before.end; ++from) over(touchesBefore_[from]);
}

/// Gives each touch a lane in a block: first those that acted, so that their blocks are full.
void Contacts::seat(const State& state)
{
    blocks_.clear();
    for (const bool acted : {true, false}) {
        seated_.assign(state.nodes.size(), 0);
        filled_.fill(0);
        for (const Pair& pair : pairs_) {
            if (pair.resolve == 0) continue;
            for (Index i = pair.first; i < pair.end; ++i) {
                Touch& touch = touches_[i];
                if ((touch.active != 0 || touch.inside != 0) == acted) fill(state, pair, touch);
            }
        }
    }
}

/// A lane of a block none of whose contacts holds one of the three nodes. Up to 64 blocks are open at a time.
Index Contacts::freeSeat(Index point, Index first, Index second)
{
    const std::uint64_t free = ~(seated_[point] | seated_[first] | seated_[second]);
    if (free == 0) {  // a block of its own
        blocks_.emplace_back();
        return (static_cast<Index>(blocks_.size()) - 1) * kWide;
    }
    const int slot = __builtin_ctzll(free);
    const std::uint64_t bit = std::uint64_t{1} << slot;
    if (filled_[slot] == 0) {
        open_[slot] = static_cast<Index>(blocks_.size());
        blocks_.emplace_back();
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

void Contacts::fill(const State& state, const Pair& pair, Touch& touch)
{
    const Nodes& nodes = state.nodes;
    const Index point = state.points.node[touch.point];
    const Index first = state.points.node[state.walls.first[touch.wall]];
    const Index second = state.points.node[state.walls.second[touch.wall]];
    touch.seat = freeSeat(point, first, second);
    ContactBlock& block = blocks_[touch.seat / kWide];
    const Index lane = touch.seat % kWide;
    block.point[lane] = static_cast<std::int32_t>(point);
    block.first[lane] = static_cast<std::int32_t>(first), block.second[lane] = static_cast<std::int32_t>(second);
    block.side[lane] = static_cast<float>(state.walls.outward[touch.wall]);
    block.thickness[lane] = pair.thickness, block.slop[lane] = pair.slop;
    block.friction[lane] = pair.friction, block.restitution[lane] = pair.restitution;
    const double length =
        (state.points.position[state.walls.second[touch.wall]] - state.points.position[state.walls.first[touch.wall]])
            .norm();
    const auto reach = [&](bool inset) {
        const double slop = static_cast<double>(pair.slop);
        return static_cast<float>(inset ? -std::min(kSharpInset * slop, 0.25 * length) : kBluntOverhang * slop);
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
}

void Contacts::push(State& state, double h, double gravity)
{
    if (blocks_.empty()) return;
    const double hertz = std::min(kHertz, kHertzPerSubstepRate / h);
    step_ = {static_cast<float>(h), static_cast<float>(1 / h), static_cast<float>(4 * gravity * h), softness(hertz, h),
             softness(2 * hertz, h)};
    const Particles particles = particlesOf(state);
    kernels_->refresh(blocks_.data(), blocks_.size(), particles, step_);
    kernels_->warm(blocks_.data(), blocks_.size(), particles);
    kernels_->solve(blocks_.data(), blocks_.size(), particles, step_, true);
}

void Contacts::relax(State& state)
{
    if (blocks_.empty()) return;
    const Particles particles = particlesOf(state);
    kernels_->solve(blocks_.data(), blocks_.size(), particles, step_, false);
    if (std::none_of(blocks_.begin(), blocks_.end(), [](const ContactBlock& block) { return block.bounces; })) return;
    for (int pass = 0; pass < kBouncePasses; ++pass)
        kernels_->bounce(blocks_.data(), blocks_.size(), particles, step_.restSpeed);
}

void Contacts::keep()
{
    for (Touch& touch : touches_) {
        if (touch.seat == kNone) continue;
        const ContactBlock& block = blocks_[touch.seat / kWide];
        const Index lane = touch.seat % kWide;
        touch.active = block.active[lane] != 0 && block.any;
        touch.engaged = block.engaged[lane] != 0;
        touch.along = block.along[lane];
        touch.normalImpulse = block.normalImpulse[lane], touch.tangentImpulse = block.tangentImpulse[lane];
        touch.stepImpulse = block.stepImpulse[lane];
    }
}

void Contacts::scale(double ratio)
{
    const auto by = static_cast<float>(ratio);
    for (Touch& touch : touches_) touch.normalImpulse *= by, touch.tangentImpulse *= by;
}

void Contacts::clear() { pairs_.clear(), touches_.clear(), ended_.clear(), blocks_.clear(); }

void Contacts::forget(const State& state, const std::function<bool(Index)>& body)
{
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
    }
    touches_.swap(kept);
    ended_.clear();
    restored();
}

void Contacts::restored()
{
    blocks_.clear();
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
           (touches_.capacity() + touchesBefore_.capacity()) * sizeof(Touch) +
           blocks_.capacity() * sizeof(ContactBlock) + walls_.capacity() * sizeof(WallBlock) +
           seated_.capacity() * sizeof(std::uint64_t) + skins_.capacity() * sizeof(Skin) +
           ended_.capacity() * sizeof(ContactPoint);
}

}  // namespace jet::physics::soft
