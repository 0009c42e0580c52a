#include "border.hpp"

#include "room.hpp"

#include <algorithm>
#include <cmath>

namespace jet::physics {

namespace {

constexpr double kBluntSine = 0.35;  // corners that turn away by less than 20 degrees count as one smooth wall

Vec2 wallVector(const State& state, const BodyRecord& body, Index wall)
{
    const auto& at = state.gridFrame(body);
    return at[state.walls.second[wall]] - at[state.walls.first[wall]];
}

void addRing(State& state, std::span<const Index> ring)
{
    Walls& walls = state.walls;
    const auto start = static_cast<Index>(walls.size());
    const auto count = static_cast<Index>(ring.size());
    makeRoom(count, walls.first, walls.second, walls.previous, walls.next, walls.outward, walls.firstEnd,
             walls.secondEnd);
    for (Index i = 0; i < count; ++i) {
        walls.first.push_back(ring[i]);
        walls.second.push_back(ring[(i + 1) % count]);
        walls.previous.push_back(start + (i + count - 1) % count);
        walls.next.push_back(start + (i + 1) % count);
        walls.outward.push_back(0);
        walls.firstEnd.push_back(WallEnd::Blunt);
        walls.secondEnd.push_back(WallEnd::Blunt);
    }
}

/// To one side of a wall, far enough to be on it.
Vec2 stepAside(const State& state, const BodyRecord& body, const Vec2& along)
{
    return perpendicular(along) * (1e-7 * gridOf(state, body).bounds().size().maxCoeff() / along.norm());
}

/// A step off the middle of the wall to either side: one must be inside and the other outside, else it bounds nothing
/// (walls that lie on each other, borders without area). Inside is what `grid` says.
std::int8_t outerSide(const State& state, const BodyRecord& body, Index wall, const EdgeGrid& grid)
{
    const Vec2 along = wallVector(state, body, wall);
    if (!(along.norm() > 1e-9 * gridOf(state, body).bounds().size().maxCoeff())) return 0;
    const Vec2 middle = state.gridFrame(body)[state.walls.first[wall]] + 0.4931 * along;
    const Vec2 aside = stepAside(state, body, along);
    const bool plus = grid.inside(middle + aside), minus = grid.inside(middle - aside);
    if (plus == minus) return 0;
    return plus ? -1 : 1;
}

/// Rings that may lie over each other, of a body that is all that is inside any of them.
class UnitedRings {
public:
    UnitedRings(const State& state, const BodyRecord& body)
        : state_(state), body_(body), at_(state.gridFrame(body)), ringOf_(body.walls.count)
    {
        const Walls& walls = state.walls;
        for (Index w = body.walls.first; w < body.walls.end();) {
            std::vector<EdgeGrid::Edge> edges;
            const Index start = w;
            do {
                ringOf_[w - body.walls.first] = grids_.size();
                edges.push_back({at_[walls.first[w]], at_[walls.second[w]]});
            } while (walls.next[w++] != start);
            grids_.emplace_back().build(edges);
        }
    }

    /// Of a wall; 0 where other rings cover all of it.
    std::int8_t outerSide(Index wall) const
    {
        const std::size_t ring = ringOf_[wall - body_.walls.first];
        const std::int8_t side = physics::outerSide(state_, body_, wall, grids_[ring]);
        return side != 0 && grids_.size() > 1 && !isBare(wall, ring, side) ? std::int8_t{0} : side;
    }

private:
    /// Is any part of the wall outside all other rings?
    bool isBare(Index wall, std::size_t ring, int side) const
    {
        constexpr double kLeastPart = 1e-6;
        const Vec2 along = wallVector(state_, body_, wall);
        const Vec2 from = at_[state_.walls.first[wall]] + side * stepAside(state_, body_, along), to = from + along;
        // Where the sides of other rings may cross it.
        std::vector<double> cuts{0, 1};
        Box reach;
        reach.extend(from), reach.extend(to);
        gridOf(state_, body_).visit(reach, [&](std::uint32_t index) {
            if (ringOf_[index] == ring) return;
            const Index other = body_.walls.first + index;
            const Vec2 start = at_[state_.walls.first[other]] - from, edge = wallVector(state_, body_, other);
            const double turn = cross(along, edge);
            if (std::abs(turn) > 1e-12 * along.norm() * edge.norm()) cuts.push_back(cross(start, edge) / turn);
            for (const Vec2& end : {start, Vec2(start + edge)}) cuts.push_back(end.dot(along) / along.squaredNorm());
        });
        std::erase_if(cuts, [](double t) { return !(t >= 0 && t <= 1); });
        std::sort(cuts.begin(), cuts.end());
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            if (cuts[i + 1] - cuts[i] < kLeastPart) continue;
            const Vec2 middle = from + 0.5 * (cuts[i] + cuts[i + 1]) * along;
            const auto covers = [&](const EdgeGrid& other) {
                return &other != &grids_[ring] && other.bounds().contains(middle) && other.inside(middle);
            };
            if (std::none_of(grids_.begin(), grids_.end(), covers)) return true;
        }
        return false;
    }

    const State& state_;
    const BodyRecord& body_;
    const std::vector<Vec2>& at_;
    std::vector<std::size_t> ringOf_;  // [walls]
    std::vector<EdgeGrid> grids_;      // [rings]
};

/// Every particle collides, those inside its body too: hardly ever does one meet anything, but when a body is squashed
/// flat they keep it from being pressed through a wall. Vertices of rigid borders collide where they end a wall.
void markCollidable(State& state, const BodyRecord& body)
{
    for (Index p = body.points.first; p < body.points.end(); ++p) state.points.collidable[p] = !body.rigid;
    for (Index w = body.walls.first; w < body.walls.end(); ++w) {
        state.points.collidable[state.walls.first[w]] = 1;
        state.points.collidable[state.walls.second[w]] = 1;
    }
}

}  // namespace

void rebuildGrid(const State& state, const BodyRecord& body)
{
    const auto& at = state.gridFrame(body);
    std::vector<EdgeGrid::Edge>& edges = state.scratch.edges;
    edges.clear();
    for (Index w = body.walls.first; w < body.walls.end(); ++w)
        edges.push_back({at[state.walls.first[w]], at[state.walls.second[w]]});
    if (!body.grid) body.grid = std::make_unique<EdgeGrid>();
    body.grid->build(edges);
}

const EdgeGrid& gridOf(const State& state, const BodyRecord& body)
{
    if (!body.grid) rebuildGrid(state, body);
    return *body.grid;
}

void updateCorners(State& state, const BodyRecord& body)
{
    Walls& walls = state.walls;
    std::vector<Vec2>& normals = state.points.normal;
    const bool known = !normals.empty();
    if (known) std::fill_n(normals.begin() + body.points.first, body.points.count, Vec2(0, 0));
    for (Index w = body.walls.first; w < body.walls.end(); ++w) {
        const Vec2 along = wallVector(state, body, w);
        const double length = along.norm();
        if (walls.outward[w] == 0 || !(length > 0)) continue;
        const Vec2 normal = perpendicular(along) * (walls.outward[w] / length);
        if (known) normals[walls.first[w]] += normal, normals[walls.second[w]] += normal;
        const auto end = [&](const Vec2& away) {
            return away.dot(normal) < -kBluntSine * away.norm() ? WallEnd::Sharp : WallEnd::Blunt;
        };
        walls.firstEnd[w] = end(-wallVector(state, body, walls.previous[w]));
        walls.secondEnd[w] = end(wallVector(state, body, walls.next[w]));
    }
    for (Index p = body.points.first; known && p < body.points.end(); ++p) {
        Vec2& normal = normals[p];
        const double length = normal.norm();
        normal = length > 1e-6 ? Vec2(normal / length) : Vec2(0, 0);
    }
}

void addPoint(State& state, const BodyRecord& body, Index node, const Vec2& local, const Vec2& position)
{
    Points& points = state.points;
    points.node.push_back(node);
    points.position.push_back(position);
    if (body.rigid) points.local.cover(points.size()), points.local.edit(points.size() - 1) = local;
    points.collidable.push_back(0);
    if (!points.normal.empty()) points.normal.push_back(Vec2(0, 0));
}

void addBorders(State& state, BodyRecord& body, std::span<const std::vector<Index>> rings, Inside inside)
{
    body.walls.first = static_cast<Index>(state.walls.size());
    for (const auto& ring : rings)
        if (ring.size() >= 3) addRing(state, ring);
    body.walls.count = static_cast<Index>(state.walls.size()) - body.walls.first;
    rebuildGrid(state, body);
    Walls& walls = state.walls;
    if (inside == Inside::AnyRing && rings.size() > 1) {
        const UnitedRings united(state, body);
        for (Index w = body.walls.first; w < body.walls.end(); ++w) walls.outward[w] = united.outerSide(w);
    } else {
        const EdgeGrid& grid = gridOf(state, body);
        for (Index w = body.walls.first; w < body.walls.end(); ++w) walls.outward[w] = outerSide(state, body, w, grid);
    }
    markCollidable(state, body);
    updateCorners(state, body);
}

Region measureRegion(const State& state, const BodyRecord& body)
{
    // Green's theorem over the walls, each walked with the inside on the same hand, from a nearby origin.
    Region region;
    if (body.walls.count == 0) return region;
    const auto& at = state.gridFrame(body);
    const EdgeGrid& grid = gridOf(state, body);
    const Vec2 origin = grid.bounds().center();
    Vec2 moment(0, 0);
    double second = 0;
    for (Index w = body.walls.first; w < body.walls.end(); ++w) {
        if (state.walls.outward[w] == 0) continue;
        Vec2 a = at[state.walls.first[w]] - origin, b = at[state.walls.second[w]] - origin;
        if (state.walls.outward[w] > 0) std::swap(a, b);
        const double twice = cross(a, b);
        region.area += 0.5 * twice;
        moment += (twice / 6) * (a + b);
        second += twice / 12 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
    }
    const Vec2 size = grid.bounds().size();
    if (!(region.area > 1e-9 * size.squaredNorm())) return Region();
    const Vec2 centre = moment / region.area;
    region.centroid = origin + centre;
    region.inertia = second / region.area - centre.squaredNorm();
    return region;
}

}  // namespace jet::physics
