#include "outlines.hpp"

#include "outline.hpp"
#include "room.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace jet::physics {

void Outlines::add(BodyRecord& body, const std::vector<std::vector<Vec2>>& outlines, Inside inside)
{
    body.points.first = static_cast<Index>(state_.points.size());
    Points& points = state_.points;
    std::vector<std::vector<Index>> rings;
    for (const auto& outline : outlines) {
        makeRoom(outline.size(), points.node, points.position, points.collidable);
        auto& ring = rings.emplace_back(outline.size());
        std::iota(ring.begin(), ring.end(), static_cast<Index>(points.size()));
        for (const Vec2& at : outline) addPoint(state_, body, body.nodes.first, at, at);
    }
    body.points.count = static_cast<Index>(points.size()) - body.points.first;
    addBorders(state_, body, rings, inside);
}

bool Outlines::addAll()
{
    if (!lean_) return false;
    lean_ = false;
    const Points points = std::move(state_.points);
    const Walls walls = std::move(state_.walls);
    state_.points = {}, state_.walls = {};
    for (BodyRecord& body : state_.bodies) {
        if (body.isLean()) {
            const PartRing ring = ringOf(rigid_.onlyPart(static_cast<Index>(&body - state_.bodies.data())));
            add(body, {{ring.points.begin(), ring.points.begin() + ring.count}}, Inside::AnyRing);
            body.grid.reset();
        } else {
            copy(body, points, walls);
        }
    }
    state_.readings = {};
    return true;
}

void Outlines::copy(BodyRecord& body, const Points& points, const Walls& walls)
{
    const Range oldPoints = body.points, oldWalls = body.walls;
    body.points.first = static_cast<Index>(state_.points.size());
    body.walls.first = static_cast<Index>(state_.walls.size());
    for (Index p = oldPoints.first; p < oldPoints.end(); ++p) {
        addPoint(state_, body, points.node[p], points.local[p], points.position[p]);
        state_.points.collidable.back() = points.collidable[p];
    }
    Walls& to = state_.walls;
    for (Index w = oldWalls.first; w < oldWalls.end(); ++w) {
        const auto point = [&](Index old) { return old - oldPoints.first + body.points.first; };
        const auto wall = [&](Index old) { return old - oldWalls.first + body.walls.first; };
        to.first.push_back(point(walls.first[w])), to.second.push_back(point(walls.second[w]));
        to.previous.push_back(wall(walls.previous[w])), to.next.push_back(wall(walls.next[w]));
        to.outward.push_back(walls.outward[w]);
        to.firstEnd.push_back(walls.firstEnd[w]), to.secondEnd.push_back(walls.secondEnd[w]);
    }
}

BodyStates Outlines::tell()
{
    std::vector<Index>& first = state_.readings.firstPoint;
    const std::size_t count = state_.bodies.size();
    makeRoom(count + 1 - first.size(), first);
    for (auto handle = static_cast<Index>(first.size() - 1); handle < count; ++handle) {
        const BodyRecord& body = state_.bodies[handle];
        first.push_back(first.back() + (body.isLean() ? ringSizeOf(rigid_.onlyPart(handle)) : body.points.count));
    }
    if (told_ == 0 || count > bounds_.size() || first.back() > points_.size()) {
        // Who looks after each body that is added is not told all of them each time.
        const auto room = [&](std::size_t needed) { return told_ == 0 ? needed : needed + needed / 2; };
        const std::size_t bounds = room(count), points = room(first.back());
        rigid_.arena().reset(Arena::sizeOf<Box>(bounds) + Arena::sizeOf<Vec2>(points));
        bounds_ = rigid_.arena().take<Box>(bounds), points_ = rigid_.arena().take<Vec2>(points);
        told_ = 0;
    }
    while (told_ < count) retell(told_++);
    const Nodes& nodes = state_.nodes;
    return {nodes.position, nodes.angle.values(),       nodes.velocity, nodes.omega.values(), bounds_.first(count),
            first,          points_.first(first.back())};
}

void Outlines::retell(Index handle)
{
    if (handle >= told_) return;
    if (state_.bodies[handle].removed) {
        bounds_[handle] = Box();
        return;
    }
    Vec2* points = points_.data() + state_.readings.firstPoint[handle];
    Box bounds;
    eachPoint(handle, [&](Index i, const Vec2& at) {
        points[i] = at;
        bounds.extend(at);
    });
    if (bounds.isNull()) bounds.extend(state_.nodes.position[state_.bodies[handle].nodes.first]);
    bounds_[handle] = bounds;
}

/// Calls visit(index, at) for the points of the body's outline, where they are now.
template <class Visit>
void Outlines::eachPoint(Index handle, Visit&& visit) const
{
    const BodyRecord& body = state_.bodies[handle];
    if (!body.isLean()) {
        for (Index i = 0; i < body.points.count; ++i) visit(i, state_.pointNow(body.points.first + i));
        return;
    }
    const PartRing ring = ringOf(rigid_.onlyPart(handle));
    const Vec2 &centre = state_.nodes.position[body.nodes.first], &turn = state_.nodes.rotation[body.nodes.first];
    for (Index i = 0; i < ring.count; ++i) visit(i, Vec2(centre + rotated(turn, ring.points[i])));
}

/// Calls visit(index of its first point, from, to, outward) for the walls of the body.
template <class Visit>
void Outlines::eachWall(Index handle, Visit&& visit) const
{
    const BodyRecord& body = state_.bodies[handle];
    if (!body.isLean()) {
        const auto at = [&](Index point) { return state_.pointNow(point); };
        for (Index w = body.walls.first; w < body.walls.end(); ++w)
            visit(state_.walls.first[w] - body.points.first, at(state_.walls.first[w]), at(state_.walls.second[w]),
                  state_.walls.outward[w]);
        return;
    }
    const PartRing ring = ringOf(rigid_.onlyPart(handle));
    const Vec2 &centre = state_.nodes.position[body.nodes.first], &turn = state_.nodes.rotation[body.nodes.first];
    const auto at = [&](Index i) { return Vec2(centre + rotated(turn, ring.points[i])); };
    for (Index i = 0; i < ring.count; ++i) visit(i, at(i), at((i + 1) % ring.count), ring.outward);
}

void Outlines::nameFeatures(Contact& contact) const
{
    double nearest = std::numeric_limits<double>::infinity();
    Vec2 corner(0, 0);
    eachPoint(contact.bodyA, [&](Index i, const Vec2& at) {
        const double away = (at - contact.point).squaredNorm();
        if (away < nearest) nearest = away, contact.particle = i, corner = at;
    });
    // Where a corner touches, the corner is the point; its place is known more exactly.
    const double length = state_.bodies[contact.bodyA].length;
    if (nearest < 1e-4 * length * length) contact.point = corner;
    nearest = std::numeric_limits<double>::infinity();
    eachWall(contact.bodyB, [&](Index first, const Vec2& from, const Vec2& to, int outward) {
        const Vec2 edge = to - from, off = contact.point - from;
        const double squared = edge.squaredNorm();
        if (!(squared > 0)) return;
        const double along = std::clamp(off.dot(edge) / squared, 0.0, 1.0), away = (off - along * edge).squaredNorm();
        if (away >= nearest) return;
        nearest = away;
        contact.wall = first;
        contact.edgeParameter = along;
        const Vec2 normal = perpendicular(edge) * (outward / std::sqrt(squared));
        contact.penetration = normal.dot(contact.normal) > 0.999 ? -off.dot(normal) : contact.penetration;
    });
}

}  // namespace jet::physics
