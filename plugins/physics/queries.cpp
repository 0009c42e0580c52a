#include "queries.hpp"

#include "border.hpp"
#include "room.hpp"

#include <algorithm>
#include <cmath>

namespace jet::physics {

namespace {

constexpr Index kManyWalls = 24;  // beyond, walls are looked up in the body's grid
constexpr int kMostPieces = 32;   // of a ray through a large outline

}  // namespace

void Queries::addSoft(Index body)
{
    makeRoom(1, firstItem_, items_);
    firstItem_.push_back(static_cast<Index>(items_.size()));
    Item item;
    item.body = body;
    items_.push_back(item);
    outdated_ = true;
}

void Queries::addRigid(const State& state, Index handle, const RigidBodyDef& def)
{
    makeRoom(1, firstItem_, items_);
    firstItem_.push_back(static_cast<Index>(items_.size()));
    outdated_ = true;
    const BodyRecord& body = state.bodies[handle];
    Item item;
    item.body = handle;
    if (def.shapes.empty() || !def.borders.empty()) {
        items_.push_back(item);
        return;
    }
    // Each shape has its own ring of points and walls, in order.
    Index wall = body.walls.first;
    const Vec2& centre = state.nodes.position[body.nodes.first];
    for (const ShapeDef& shape : def.shapes) {
        Index ring = wall;
        while (ring < body.walls.end() && (ring == wall || state.walls.previous[ring] == ring - 1)) ++ring;
        item.walls = {wall, ring - wall};
        wall = ring;
        item.round = kNone;
        if (shape.kind == ShapeDef::Kind::Circle || shape.kind == ShapeDef::Kind::Capsule) {
            item.round = static_cast<Index>(rounds_.size());
            makeRoom(1, rounds_);
            rounds_.push_back({shape.points.front() - centre, shape.points.back() - centre, shape.radius});
        }
        if (shape.kind == ShapeDef::Kind::Chain) item.walls.count = static_cast<Index>(shape.points.size() - 1);
        makeRoom(1, items_);
        items_.push_back(item);
    }
}

Queries::Frame Queries::frameOf(const State& state, const Item& item)
{
    const BodyRecord& body = state.bodies[item.body];
    if (!body.rigid) return {};
    return {state.nodes.position[body.nodes.first], state.nodes.rotation[body.nodes.first]};
}

Range Queries::wallsOf(const State& state, const Item& item)
{
    return item.whole() ? state.bodies[item.body].walls : item.walls;
}

Box Queries::boxOf(const State& state, const Item& item) const
{
    Box box;
    if (const Round* round = roundOf(item)) {
        const Frame frame = frameOf(state, item);
        box.extend(frame.out(round->a)), box.extend(frame.out(round->b));
        return box.inflated(round->radius);
    }
    if (item.whole()) return state.readings.bounds[item.body];
    for (Index w = item.walls.first; w < item.walls.end(); ++w)
        box.extend(state.points.position[state.walls.first[w]]),
            box.extend(state.points.position[state.walls.second[w]]);
    return box;
}

void Queries::update(const State& state)
{
    if (!outdated_) return;
    outdated_ = false;
    boxes_.resize(items_.size());
    for (std::size_t i = 0; i < items_.size(); ++i)
        boxes_[i] = state.bodies[items_[i].body].enabled ? boxOf(state, items_[i]) : Box();
    tree_.update(boxes_);
}

bool Queries::seen(const State& state, Index handle, const QueryFilter& filter)
{
    const BodyRecord& body = state.bodies[handle];
    return body.enabled && handle != filter.except && (body.layer & filter.mask) != 0 &&
           (!body.sensor || filter.sensors);
}

template <class Visit>
void Queries::eachEdge(const State& state, const Item& item, const Box& region, Visit&& visit)
{
    const BodyRecord& body = state.bodies[item.body];
    const std::vector<Vec2>& at = state.gridFrame(body);
    const Range walls = wallsOf(state, item);
    const auto edge = [&](Index w) {
        if (state.walls.outward[w] != 0)
            visit(QueryEdge{at[state.walls.first[w]], at[state.walls.second[w]], state.walls.outward[w]});
    };
    if (item.whole() && body.rigid && walls.count > kManyWalls) {
        gridOf(state, body).visit(region, [&](Index e) { edge(walls.first + e); });
        return;
    }
    for (Index w = walls.first; w < walls.end(); ++w) edge(w);
}

bool Queries::inside(const State& state, const Item& item, const Vec2& at) const
{
    if (const Round* round = roundOf(item))
        return (at - nearestOnSegment(at, round->a, round->b)).norm() <= round->radius;
    const BodyRecord& body = state.bodies[item.body];
    if (item.whole() && body.rigid) return gridOf(state, body).inside(at);
    const Range walls = wallsOf(state, item);
    const std::vector<Vec2>& points = state.gridFrame(body);
    std::vector<EdgeGrid::Edge> edges;
    for (Index w = walls.first; w < walls.end(); ++w)
        edges.push_back({points[state.walls.first[w]], points[state.walls.second[w]]});
    // The sides of a chain do not close.
    if (edges.empty() || state.walls.next[walls.end() - 1] != walls.first) return false;
    return insideOdd(edges, at);
}

std::optional<QueryHit> Queries::castRay(const State& state, const Item& item, const Vec2& from, const Vec2& way,
                                         double most) const
{
    const Frame frame = frameOf(state, item);
    const Vec2 start = frame.in(from), along = unrotated(frame.turn, way);
    std::optional<QueryHit> best;
    if (const Round* round = roundOf(item)) {
        best = meetSegment(start, along, round->a, round->b, round->radius);
    } else {
        const int pieces = static_cast<int>(std::clamp<Index>(wallsOf(state, item).count / kManyWalls, 1, kMostPieces));
        for (int i = 0; i < pieces; ++i) {
            const double first = most * i / pieces, last = most * (i + 1) / pieces;
            const Box region(start + first * along, start + last * along);
            eachEdge(state, item, region, [&](const QueryEdge& edge) {
                // What comes from within passes.
                if (edge.outward * perpendicular(edge.b - edge.a).dot(along) > 0) return;
                const auto hit = meetSegment(start, along, edge.a, edge.b, 0);
                if (hit && (!best || hit->at < best->at)) best = hit;
            });
            if (best && best->at <= last) break;
        }
    }
    if (best) best->point = frame.out(best->point), best->normal = rotated(frame.turn, best->normal);
    return best;
}

std::optional<CastHit> Queries::rayCast(const State& state, const Vec2& from, const Vec2& way,
                                        const QueryFilter& filter) const
{
    std::optional<CastHit> best;
    tree_.along(
        from, way, 0, [&] { return best ? best->fraction : 1.0; },
        [&](std::uint32_t index) {
            const Item& item = items_[index];
            if (!seen(state, item.body, filter)) return;
            const auto hit = castRay(state, item, from, way, best ? best->fraction : 1.0);
            if (!hit || (best && (hit->at > best->fraction || (hit->at == best->fraction && item.body >= best->body))))
                return;
            best = CastHit{item.body, hit->point, hit->normal, hit->at};
        });
    return best;
}

/// In the item's frame.
bool Queries::overlaps(const State& state, const Item& item, const CastShape& shape) const
{
    const auto within = [&](const Vec2& a, const Vec2& b, double radius) {
        const double all = (shape.radius + radius) * (1 - 1e-9);
        for (std::size_t i = 0; i < std::max<std::size_t>(shape.sides(), 1); ++i) {
            const Vec2 &p = shape.points[i], &q = shape.points[(i + 1) % shape.points.size()];
            if (all > 0 && segmentDistance(p, q, a, b) < all) return true;
            const Vec2 side = q - p, edge = b - a;
            const double across = cross(side, edge);
            if (across == 0) continue;
            const double s = cross(a - p, edge) / across, t = cross(a - p, side) / across;
            if (s > 1e-9 && s < 1 - 1e-9 && t > 1e-9 && t < 1 - 1e-9) return true;
        }
        return shape.contains(0.5 * (a + b));
    };
    if (const Round* round = roundOf(item))
        return within(round->a, round->b, round->radius) || (shape.closed && shape.contains(round->a));
    bool meets = false;
    eachEdge(state, item, shape.bounds(), [&](const QueryEdge& edge) { meets |= within(edge.a, edge.b, 0); });
    Vec2 middle(0, 0);
    for (const Vec2& at : shape.points) middle += at / static_cast<double>(shape.points.size());
    return meets || inside(state, item, middle);
}

std::optional<QueryHit> Queries::castShape(const State& state, const Item& item, const CastShape& moved,
                                           const Vec2& way) const
{
    const Frame frame = frameOf(state, item);
    CastShape shape = moved;
    for (Vec2& at : shape.points) at = frame.in(at);
    const Vec2 along = unrotated(frame.turn, way);
    if (overlaps(state, item, shape)) {
        Vec2 middle(0, 0);
        for (const Vec2& at : moved.points) middle += at / static_cast<double>(moved.points.size());
        return QueryHit{0, middle, way.squaredNorm() > 0 ? Vec2(-way.normalized()) : Vec2(0, 0)};
    }
    std::optional<QueryHit> best;
    if (const Round* round = roundOf(item)) {
        best = castAt(shape, along, round->a, round->b, round->radius);
    } else {
        Box region = shape.bounds();
        region.extend(Vec2(region.min + along)), region.extend(Vec2(region.max + along));
        eachEdge(state, item, region, [&](const QueryEdge& edge) {
            const auto hit = castAt(shape, along, edge.a, edge.b, 0);
            if (hit && (!best || hit->at < best->at)) best = hit;
        });
    }
    if (best) best->point = frame.out(best->point), best->normal = rotated(frame.turn, best->normal);
    return best;
}

std::optional<CastHit> Queries::shapeCast(const State& state, const ShapeDef& def, const Vec2& way,
                                          const QueryFilter& filter) const
{
    CastShape shape;
    shape.points = def.points;
    shape.closed = def.kind == ShapeDef::Kind::Polygon;
    if (def.kind == ShapeDef::Kind::Circle || def.kind == ShapeDef::Kind::Capsule) shape.radius = def.radius;
    const Box bounds = shape.bounds();
    std::optional<CastHit> best;
    tree_.along(
        bounds.center(), way, 0.5 * bounds.size().maxCoeff(), [&] { return best ? best->fraction : 1.0; },
        [&](std::uint32_t index) {
            const Item& item = items_[index];
            if (!seen(state, item.body, filter)) return;
            const auto hit = castShape(state, item, shape, way);
            if (!hit || (best && (hit->at > best->fraction || (hit->at == best->fraction && item.body >= best->body))))
                return;
            best = CastHit{item.body, hit->point, hit->normal, hit->at};
        });
    return best;
}

bool Queries::meetsBox(const State& state, const Item& item, const Box& box) const
{
    const Frame frame = frameOf(state, item);
    if (const Round* round = roundOf(item))
        return boxDistance(box, frame.out(round->a), frame.out(round->b)) <= round->radius;
    Box local;
    for (const Vec2& corner : {box.min, box.max, Vec2(box.min.x(), box.max.y()), Vec2(box.max.x(), box.min.y())})
        local.extend(frame.in(corner));
    bool meets = false;
    eachEdge(state, item, local, [&](const QueryEdge& edge) {
        meets = meets || boxDistance(box, frame.out(edge.a), frame.out(edge.b)) <= 0;
    });
    return meets || inside(state, item, frame.in(box.center()));
}

std::vector<BodyHandle> Queries::overlapping(const State& state, const Box& box, const QueryFilter& filter) const
{
    std::vector<BodyHandle> found;
    tree_.visit(box, [&](std::uint32_t index) {
        const Item& item = items_[index];
        if (seen(state, item.body, filter) && meetsBox(state, item, box)) found.push_back(item.body);
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

std::optional<QueryHit> Queries::nearestOf(const State& state, const Item& item, const Vec2& scene, double reach) const
{
    const Frame frame = frameOf(state, item);
    const Vec2 point = frame.in(scene);
    std::optional<QueryHit> best;
    if (const Round* round = roundOf(item)) {
        const Vec2 axis = nearestOnSegment(point, round->a, round->b);
        const Vec2 off = point - axis;
        const double away = off.norm();
        const Vec2 normal = away > 0 ? Vec2(off / away) : Vec2(0, -1);
        best = QueryHit{std::abs(away - round->radius), axis + round->radius * normal, normal};
        if (best->at > reach) return std::nullopt;
    } else {
        const Vec2 span(reach, reach);
        eachEdge(state, item, Box(point - span, point + span), [&](const QueryEdge& edge) {
            const Vec2 at = nearestOnSegment(point, edge.a, edge.b);
            const double away = (point - at).norm();
            if (away > reach || (best && away >= best->at)) return;
            best = QueryHit{away, at, edge.outward * perpendicular(edge.b - edge.a).normalized()};
        });
    }
    if (best) best->point = frame.out(best->point), best->normal = rotated(frame.turn, best->normal);
    return best;
}

std::optional<CastHit> Queries::nearest(const State& state, const Vec2& point, double reach,
                                        const QueryFilter& filter) const
{
    std::optional<CastHit> best;
    double least = reach;
    tree_.around(
        point, [&] { return least; },
        [&](std::uint32_t index) {
            const Item& item = items_[index];
            if (!seen(state, item.body, filter)) return;
            const auto hit = nearestOf(state, item, point, least);
            if (!hit || (best && (hit->at > least || (hit->at == least && item.body >= best->body)))) return;
            least = hit->at;
            best = CastHit{item.body, hit->point, hit->normal, reach > 0 ? hit->at / reach : 0};
        });
    return best;
}

bool Queries::contains(const State& state, Index body, const Vec2& point) const
{
    if (!state.bodies[body].enabled) return false;
    for (Index i = firstItem_[body]; i < items_.size() && items_[i].body == body; ++i)
        if (inside(state, items_[i], frameOf(state, items_[i]).in(point))) return true;
    return false;
}

}  // namespace jet::physics
