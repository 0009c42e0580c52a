#include "narrow_phase.hpp"

#include "border.hpp"

namespace jet::physics {

namespace {

constexpr Index kManyPoints = 48;  // above this the points near the other body are looked up in the grid
// How far a rigid corner's own outside may lean with a wall's and still be thought to hit it; corners point away from
// walls they cannot hit. The points of a soft body are not asked: where it is crushed its border may be folded.
constexpr double kLean = 0.3;
constexpr double kFacing = 0.2;       // how far outsides must oppose for a border to meet itself
constexpr double kHeldBonus = 0.5;    // a wall that held the point counts as half as far
constexpr double kFoldedPenalty = 2;  // soft bodies: a wall whose outside does not oppose the point's counts as farther
constexpr std::size_t kMostWalls = 4;  // a point may meet in one step
constexpr double kShallow = 0.5;  // of the body's length: deeper inside, the nearest wall is taken whatever its side

}  // namespace

NarrowPhase::NarrowPhase(const State& state, const std::vector<Motion>& motions, std::span<const ContactPoint> previous,
                         double dt)
    : state_(state), motions_(motions), previous_(previous), dt_(dt), candidates_(state.scratch.candidates)
{
}

void NarrowPhase::collide(Index bodyA, Index bodyB, const ContactPoint& pattern, std::vector<ContactPoint>& found)
{
    a_ = &state_.bodies[bodyA];
    b_ = &state_.bodies[bodyB];
    if (b_->walls.count == 0) return;
    grid_ = &gridOf(state_, *b_);
    frame_ = &state_.gridFrame(*b_);
    const Motion& motionA = motions_[bodyA];
    const Motion& motionB = motions_[bodyB];
    const Index nodeB = b_->nodes.first;
    ContactPoint contact = pattern;
    contact.bodyA = bodyA;
    contact.bodyB = bodyB;
    contact.surprise = motionA.surprise + motionB.surprise;

    gatherPoints(*a_, motionB.reach.inflated(motionA.range + pattern.thickness));
    for (Index p : candidates_) {
        const Vec2& at = state_.points.position[p];
        const Index node = state_.points.node[p];
        const Vec2 own = state_.nodes.velocityAt(node, at - state_.nodes.position[node]);
        const Vec2 carried = motionB.velocity + motionB.omega * perpendicular(at - motionB.centre);
        Approach approach;
        approach.point = p;
        approach.reach =
            (own - carried).norm() * dt_ + motionA.stray + motionB.stray + 4 * pattern.slop + pattern.thickness;
        approach.at = at;
        approach.normal = state_.points.normal[p];
        if (a_->rigid) approach.normal = rotated(state_.nodes.rotation[a_->nodes.first], approach.normal);
        if (b_->rigid) {
            approach.at = unrotated(state_.nodes.rotation[nodeB], at - state_.nodes.position[nodeB]);
            approach.normal = unrotated(state_.nodes.rotation[nodeB], approach.normal);
        }
        if (grid_->bounds().inflated(approach.reach).contains(approach.at)) touch(approach, contact, found);
    }
}

void NarrowPhase::collideSelf(Index body, const ContactPoint& pattern, std::vector<ContactPoint>& found)
{
    a_ = b_ = &state_.bodies[body];
    grid_ = &gridOf(state_, *b_);
    frame_ = &state_.gridFrame(*b_);
    const Motion& motion = motions_[body];
    ContactPoint contact = pattern;
    contact.bodyA = contact.bodyB = body;
    contact.surprise = 2 * motion.surprise;
    for (Index p = a_->points.first; p < a_->points.end(); ++p) {
        const Vec2& normal = state_.points.normal[p];
        if (normal.isZero()) continue;  // not on the border
        const Vec2& at = state_.points.position[p];
        const Vec2& own = state_.nodes.velocity[state_.points.node[p]];
        const double reach = (own - motion.velocity).norm() * dt_ + motion.stray + 4 * pattern.slop + pattern.thickness;
        contact.point = p;
        const Vec2 span(reach, reach);
        grid_->visit(Box(at - span, at + span), [&](Index edge) {
            WallView seen;
            contact.wall = b_->walls.first + edge;
            if (state_.walls.first[contact.wall] == p || state_.walls.second[contact.wall] == p) return;
            // The skin of a smooth border overlaps its own neighbours: only walls that look the other way count.
            if (!view(contact.wall, at, seen) || normal.dot(seen.normal) > -kFacing || seen.distance > reach) return;
            if (seen.separation < -kTouchDepth * pattern.slop && !heldBefore(p, contact.wall)) return;
            found.push_back(contact);
        });
    }
}

void NarrowPhase::gatherPoints(const BodyRecord& a, const Box& near)
{
    candidates_.clear();
    const auto take = [&](Index p) {
        if (state_.points.collidable[p] && near.contains(state_.points.position[p])) candidates_.push_back(p);
    };
    if (a.points.count <= kManyPoints || !a.rigid || a.walls.count == 0) {
        for (Index p = a.points.first; p < a.points.end(); ++p) take(p);
        return;
    }
    // B's reach as a box in A's frame.
    const Index node = a.nodes.first;
    Box local;
    for (const Vec2& corner : {near.min, near.max, Vec2(near.min.x(), near.max.y()), Vec2(near.max.x(), near.min.y())})
        local.extend(unrotated(state_.nodes.rotation[node], corner - state_.nodes.position[node]));
    gridOf(state_, a).visit(local, [&](Index edge) {
        take(state_.walls.first[a.walls.first + edge]);
        take(state_.walls.second[a.walls.first + edge]);
    });
    std::sort(candidates_.begin(), candidates_.end());
    candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
}

bool NarrowPhase::view(Index wall, const Vec2& at, WallView& seen) const
{
    if (state_.walls.outward[wall] == 0) return false;
    const Vec2& first = (*frame_)[state_.walls.first[wall]];
    const Vec2 edge = (*frame_)[state_.walls.second[wall]] - first, offset = at - first;
    const double squared = edge.squaredNorm();
    if (!(squared > 1e-24)) return false;
    seen.length = std::sqrt(squared);
    seen.normal = perpendicular(edge) * (state_.walls.outward[wall] / seen.length);
    seen.separation = offset.dot(seen.normal);
    seen.along = offset.dot(edge) / squared;
    seen.distance = (offset - std::clamp(seen.along, 0.0, 1.0) * edge).norm();
    return true;
}

bool NarrowPhase::heldBefore(Index point, Index wall) const
{
    const std::uint64_t key = (static_cast<std::uint64_t>(point) << 32) | wall;
    const auto at = std::lower_bound(previous_.begin(), previous_.end(), key,
                                     [](const ContactPoint& c, std::uint64_t k) { return c.key() < k; });
    return at != previous_.end() && at->key() == key && at->stepImpulse > 0;
}

void NarrowPhase::touch(const Approach& approach, const ContactPoint& pattern, std::vector<ContactPoint>& found)
{
    ContactPoint contact = pattern;
    contact.point = approach.point;
    bool onSurface = false;
    const std::size_t before = found.size();
    const Vec2 span(approach.reach, approach.reach);
    grid_->visit(Box(approach.at - span, approach.at + span), [&](Index edge) {
        WallView seen;
        contact.wall = b_->walls.first + edge;
        if (!view(contact.wall, approach.at, seen) || seen.separation < -kTouchDepth * pattern.slop ||
            seen.distance > approach.reach)
            return;
        if (a_->rigid && approach.normal.dot(seen.normal) > kLean) return;
        onSurface |= seen.distance <= kTouchDepth * pattern.slop;
        contact.firstInset = yields(contact.wall, state_.walls.firstEnd, state_.walls.previous, approach);
        contact.secondInset = yields(contact.wall, state_.walls.secondEnd, state_.walls.next, approach);
        found.push_back(contact);
    });
    // What moves very fast has all walls in reach; the nearest come first on its way.
    if (found.size() > before + kMostWalls) {
        const auto distance = [&](const ContactPoint& c) {
            WallView seen;
            return view(c.wall, approach.at, seen) ? seen.distance : approach.reach;
        };
        std::stable_sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end(),
                         [&](const ContactPoint& c, const ContactPoint& d) { return distance(c) < distance(d); });
        found.resize(before + kMostWalls);
    }
    // On the border "inside" is a matter of rounding; the walls found in front of the point answer for it.
    if (onSurface || !grid_->inside(approach.at)) return;
    contact.wall = wallToLeaveThrough(approach);
    if (contact.wall == kNone) return;
    contact.inside = true;
    found.push_back(contact);
}

bool NarrowPhase::yields(Index wall, const std::vector<WallEnd>& ends, const std::vector<Index>& neighbours,
                         const Approach& approach) const
{
    WallView seen;
    return ends[wall] == WallEnd::Sharp && view(neighbours[wall], approach.at, seen) &&
           approach.normal.dot(seen.normal) <= kLean;
}

Index NarrowPhase::wallToLeaveThrough(const Approach& approach) const
{
    const double extent = grid_->bounds().size().maxCoeff();
    for (double radius = approach.reach;; radius *= 2) {
        Index nearest = kNone, opposed = kNone;
        double nearestScore = radius, opposedScore = radius;
        const Vec2 span(radius, radius);
        grid_->visit(Box(approach.at - span, approach.at + span), [&](Index edge) {
            WallView seen;
            const Index wall = b_->walls.first + edge;
            if (!view(wall, approach.at, seen) || seen.separation >= 0 || seen.distance > radius) return;
            const bool opposes = approach.normal.dot(seen.normal) <= 0;
            const double score = seen.distance * (heldBefore(approach.point, wall) ? kHeldBonus : 1) *
                                 (opposes || a_->rigid ? 1 : kFoldedPenalty);
            if (score < nearestScore) nearest = wall, nearestScore = score;
            if (score < opposedScore && opposes) opposed = wall, opposedScore = score;
        });
        if (!a_->rigid && nearest != kNone) return nearest;
        if (opposed != kNone && opposedScore <= kShallow * a_->length) return opposed;
        if (nearest != kNone && (opposed != kNone || nearestScore > kShallow * a_->length || radius > extent))
            return nearest;
        if (radius > 2 * extent) return kNone;
    }
}

}  // namespace jet::physics
