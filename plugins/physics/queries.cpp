#include "queries.hpp"

#include "border.hpp"
#include "outline.hpp"
#include "query_union.hpp"
#include "room.hpp"

#include <algorithm>
#include <cmath>

namespace jet::physics {

namespace {

constexpr Index kManyWalls = 24;  // beyond, walls are looked up in the body's grid
constexpr int kMostPieces = 32;   // of a ray through a large outline

Vec2 cornerOf(const Part& part, int i) { return {part.corners[i].x, part.corners[i].y}; }

/// On which side of a polygon's or chain's walls the outside is; 0: it bounds nothing.
int outwardOf(const ShapeDef& shape)
{
    if (shape.kind == ShapeDef::Kind::Chain) return -1;
    double area = 0;
    const Vec2& origin = shape.points.front();
    for (std::size_t i = 0; i < shape.points.size(); ++i)
        area += cross(shape.points[i] - origin, shape.points[(i + 1) % shape.points.size()] - origin);
    return area > 0 ? -1 : area < 0 ? 1 : 0;
}

/// Out of the body.
Vec2 outOf(const QueryEdge& edge) { return edge.outward * perpendicular(edge.b - edge.a); }

bool isBefore(const QueryEdge& edge, const Vec2& at) { return outOf(edge).dot(at - edge.a) >= 0; }

}  // namespace

void Queries::addSoft(Index body)
{
    Kept item;
    item.body = body;
    keep(item);
    outdated_ = true;
}

/// Behind others of its body.
void Queries::keep(const Kept& item)
{
    makeRoom(1, items_);
    const auto place = std::upper_bound(items_.begin(), items_.end(), item.body,
                                        [](Index body, const Kept& other) { return body < other.body; });
    items_.insert(place, item);
}

void Queries::remove(Index body)
{
    outdated_ = true;
    const auto first = std::lower_bound(items_.begin(), items_.end(), body,
                                        [](const Kept& item, Index handle) { return item.body < handle; });
    auto end = first;
    for (; end != items_.end() && end->body == body; ++end) {
        if (end->round == kNone) continue;
        // The last one fills the gap.
        const auto last = static_cast<Index>(rounds_.size() - 1);
        for (Kept& other : items_)
            if (other.round == last) other.round = end->round;
        rounds_[end->round] = rounds_[last];
        rounds_.pop_back();
    }
    items_.erase(first, end);
}

void Queries::addRigid(const State& state, Index handle, const RigidBodyDef& def)
{
    outdated_ = true;
    const BodyRecord& body = state.bodies[handle];
    anySingle_ |= body.single;
    if (body.single) return;
    Kept item;
    item.body = handle;
    if (def.shapes.empty() || !def.borders.empty()) {
        keep(item);
        return;
    }
    // Each shape has its own ring of points and walls, in order.
    Index wall = body.walls.first;
    const Vec2& centre = state.nodes.position[body.nodes.first];
    for (const ShapeDef& shape : def.shapes) {
        if (outlineOf(shape).size() < 3) continue;  // a chain all at one point
        Index ring = wall;
        while (ring < body.walls.end() && (ring == wall || state.walls.previous[ring] == ring - 1)) ++ring;
        item.walls = {wall - body.walls.first, ring - wall};
        wall = ring;
        item.round = kNone;
        item.outward = outwardOf(shape);
        if (shape.kind == ShapeDef::Kind::Circle || shape.kind == ShapeDef::Kind::Capsule) {
            item.round = static_cast<Index>(rounds_.size());
            makeRoom(1, rounds_);
            rounds_.push_back({shape.points.front() - centre, shape.points.back() - centre, shape.radius});
        }
        item.open = shape.kind == ShapeDef::Kind::Chain;
        if (item.open) item.walls.count = static_cast<Index>(shape.points.size() - 1);
        keep(item);
    }
}

Queries::Item Queries::itemAt(std::size_t index) const
{
    if (index >= items_.size()) return itemOf(static_cast<Index>(index - items_.size()));
    const Kept& kept = items_[index];
    Item item;
    item.body = kept.body, item.walls = kept.walls, item.outward = kept.outward, item.open = kept.open;
    item.isRound = kept.round != kNone;
    if (item.isRound) item.round = rounds_[kept.round];
    return item;
}

/// Of a body of one shape.
Queries::Item Queries::itemOf(Index body) const
{
    Item item;
    item.body = body;
    const Part& part = rigid_->onlyPart(body);
    item.isRound = part.count < 3;
    if (item.isRound) {
        const Vec2f &a = part.corners[0], &b = part.corners[part.count - 1];
        item.round = {{a.x, a.y}, {b.x, b.y}, static_cast<double>(part.radius)};
    } else {
        item.part = &part;
    }
    return item;
}

Queries::Frame Queries::frameOf(const State& state, const Item& item)
{
    const BodyRecord& body = state.bodies[item.body];
    if (!body.rigid) return {};
    return {state.nodes.position[body.nodes.first], state.nodes.rotation[body.nodes.first]};
}

Range Queries::wallsOf(const State& state, const Item& item)
{
    const Range& walls = state.bodies[item.body].walls;
    return item.whole() ? walls : Range{walls.first + item.walls.first, item.walls.count};
}

Box Queries::boxOf(const State& state, const Item& item) const
{
    Box box;
    const Frame frame = frameOf(state, item);
    if (item.isRound) {
        box.extend(frame.out(item.round.a)), box.extend(frame.out(item.round.b));
        return box.inflated(item.round.radius);
    }
    if (item.part != nullptr) {
        for (int i = 0; i < item.part->count; ++i) box.extend(frame.out(cornerOf(*item.part, i)));
        return box;
    }
    if (item.whole()) {
        const Range& points = state.bodies[item.body].points;
        for (Index p = points.first; p < points.end(); ++p) box.extend(state.points.position[p]);
        return box;
    }
    const Range walls = wallsOf(state, item);
    for (Index w = walls.first; w < walls.end(); ++w)
        box.extend(state.points.position[state.walls.first[w]]),
            box.extend(state.points.position[state.walls.second[w]]);
    return box;
}

void Queries::update(const State& state)
{
    if (!outdated_) return;
    outdated_ = false;
    const std::size_t kept = items_.size();
    boxes_.assign(kept + (anySingle_ ? state.bodies.size() : 0), Box());
    const auto take = [&](std::size_t index, Index body) {
        if (state.bodies[body].enabled) boxes_[index] = boxOf(state, itemAt(index));
    };
    for (std::size_t i = 0; i < kept; ++i) take(i, items_[i].body);
    for (Index body = 0; anySingle_ && body < state.bodies.size(); ++body)
        if (state.bodies[body].single) take(kept + body, body);
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
    if (item.part != nullptr) {
        const int count = item.part->count;
        for (int i = 0; i < count; ++i)
            visit(QueryEdge{cornerOf(*item.part, i), cornerOf(*item.part, (i + 1) % count), -1});
        return;
    }
    const BodyRecord& body = state.bodies[item.body];
    const std::vector<Vec2>& at = state.gridFrame(body);
    const Range walls = wallsOf(state, item);
    const auto edge = [&](Index w) {
        const int outward = item.whole() ? state.walls.outward[w] : item.outward;
        if (outward != 0) visit(QueryEdge{at[state.walls.first[w]], at[state.walls.second[w]], outward});
    };
    if (item.whole() && body.rigid && walls.count > kManyWalls) {
        gridOf(state, body).visit(region, [&](Index e) { edge(walls.first + e); });
        return;
    }
    for (Index w = walls.first; w < walls.end(); ++w) edge(w);
}

bool Queries::inside(const State& state, const Item& item, const Vec2& at) const
{
    if (item.isRound) return (at - nearestOnSegment(at, item.round.a, item.round.b)).norm() <= item.round.radius;
    if (item.open) return false;
    if (item.part != nullptr) {
        bool behindAll = true;
        eachEdge(state, item, Box(),
                 [&](const QueryEdge& edge) { behindAll &= cross(edge.b - edge.a, at - edge.a) >= 0; });
        return behindAll;
    }
    const BodyRecord& body = state.bodies[item.body];
    if (item.whole() && body.rigid) return gridOf(state, body).inside(at);
    const Range walls = wallsOf(state, item);
    const std::vector<Vec2>& points = state.gridFrame(body);
    std::vector<EdgeGrid::Edge> edges;
    for (Index w = walls.first; w < walls.end(); ++w)
        edges.push_back({points[state.walls.first[w]], points[state.walls.second[w]]});
    return insideOdd(edges, at);
}

std::optional<QueryHit> Queries::castRay(const State& state, const Item& item, const Vec2& from, const Vec2& way,
                                         double most) const
{
    const Frame frame = frameOf(state, item);
    const Vec2 start = frame.in(from), along = unrotated(frame.turn, way);
    std::optional<QueryHit> best;
    if (item.isRound) {
        best = meetSegment(start, along, item.round.a, item.round.b, item.round.radius);
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

template <class Visit>
void Queries::eachItem(Index body, Visit&& visit) const
{
    auto i = std::lower_bound(items_.begin(), items_.end(), body,
                              [](const Kept& item, Index handle) { return item.body < handle; });
    for (; i != items_.end() && i->body == body; ++i) visit(itemAt(static_cast<std::size_t>(i - items_.begin())));
}

double Queries::within(const State& state, Index body, const Vec2& from, const Vec2& way) const
{
    constexpr double kSeam = 1e-9;  // of the way, between shapes that lie side by side
    struct Span {
        double enters, leaves;
    };
    std::vector<Span> spans;
    bool starts = false;
    eachItem(body, [&](const Item& item) {
        const Frame frame = frameOf(state, item);
        const bool first = inside(state, item, frame.in(from)), last = inside(state, item, frame.in(from + way));
        const auto enter = first ? std::nullopt : castRay(state, item, from, way, 1);
        if (!first && !enter) return;
        const auto leave = last ? std::nullopt : castRay(state, item, from + way, -way, 1);
        starts |= first;
        spans.push_back({enter ? enter->at : 0, leave ? 1 - leave->at : 1});
    });
    if (!starts) return -1;
    double reached = 0;
    for (bool farther = true; farther;) {
        farther = false;
        for (const Span& span : spans)
            if (span.enters <= reached + kSeam && span.leaves > reached) reached = span.leaves, farther = true;
    }
    return reached + kSeam;
}

std::optional<CastHit> Queries::rayCast(const State& state, const Vec2& from, const Vec2& way,
                                        const QueryFilter& filter) const
{
    std::optional<CastHit> best;
    Index begun = kNone;  // the body of several shapes that was looked at last,
    double passed = -1;   // and where the ray leaves it
    tree_.along(
        from, way, 0, [&] { return best ? best->fraction : 1.0; },
        [&](std::uint32_t index) {
            const Item item = itemAt(index);
            if (!seen(state, item.body, filter)) return;
            const auto hit = castRay(state, item, from, way, best ? best->fraction : 1.0);
            const bool several = index < items_.size() && !item.whole();
            if (hit && several && begun != item.body) begun = item.body, passed = within(state, item.body, from, way);
            if (hit && several && hit->at <= passed) return;
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
    if (item.isRound)
        return within(item.round.a, item.round.b, item.round.radius) || (shape.closed && shape.contains(item.round.a));
    bool meets = false;
    const Vec2 middle = shape.middle();
    eachEdge(state, item, shape.bounds(), [&](const QueryEdge& edge) {
        meets |= (!item.open || isBefore(edge, middle)) && within(edge.a, edge.b, 0);
    });
    return meets || inside(state, item, shape.within());
}

std::optional<QueryHit> Queries::castShape(const State& state, const Item& item, const CastShape& moved,
                                           const Vec2& way) const
{
    const Frame frame = frameOf(state, item);
    CastShape shape = moved;
    for (Vec2& at : shape.points) at = frame.in(at);
    const Vec2 along = unrotated(frame.turn, way);
    if (overlaps(state, item, shape)) {
        const Vec2 middle = moved.middle();
        // Without a way, what leads out of the body is as good a guess as any.
        Vec2 out = way.squaredNorm() > 0 ? Vec2(-way) : Vec2(middle - boxOf(state, item).center());
        if (!(out.squaredNorm() > 0)) out = Vec2(0, -1);
        return QueryHit{0, middle, out.stableNormalized()};
    }
    std::optional<QueryHit> best;
    if (item.isRound) {
        best = castAt(shape, along, item.round.a, item.round.b, item.round.radius);
    } else {
        Box region = shape.bounds();
        region.extend(Vec2(region.min + along)), region.extend(Vec2(region.max + along));
        const Vec2 middle = shape.middle();
        eachEdge(state, item, region, [&](const QueryEdge& edge) {
            // A chain is solid from its front: what starts behind a side of it, or leaves it, passes.
            if (item.open && (!isBefore(edge, middle) || outOf(edge).dot(along) > 0)) return;
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
            const Item item = itemAt(index);
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
    if (item.isRound) return boxDistance(box, frame.out(item.round.a), frame.out(item.round.b)) <= item.round.radius;
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
        const Item item = itemAt(index);
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
    if (item.isRound) {
        const Vec2 axis = nearestOnSegment(point, item.round.a, item.round.b);
        const Vec2 off = point - axis;
        const double away = off.norm();
        const Vec2 normal = away > 0 ? Vec2(off / away) : Vec2(0, -1);
        best = QueryHit{std::abs(away - item.round.radius), axis + item.round.radius * normal, normal};
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

std::optional<QueryHit> Queries::nearestFromWithin(const State& state, Index body, const Vec2& scene) const
{
    std::vector<CastShape> shapes;
    Frame frame;
    eachItem(body, [&](const Item& item) {
        frame = frameOf(state, item);
        CastShape& shape = shapes.emplace_back();
        if (item.isRound) {
            shape.points = {item.round.a, item.round.b}, shape.radius = item.round.radius;
            return;
        }
        shape.closed = !item.open;
        eachEdge(state, item, Box(), [&](const QueryEdge& edge) {
            shape.points.push_back(edge.a);
            if (item.open) shape.points.push_back(edge.b);
        });
    });
    if (shapes.size() < 2) return std::nullopt;
    const Vec2 point = frame.in(scene);
    const ShapeUnion together(std::move(shapes));
    if (!together.covers(point)) return std::nullopt;
    auto hit = together.nearest(point);
    if (hit) hit->point = frame.out(hit->point), hit->normal = rotated(frame.turn, hit->normal);
    return hit;
}

std::optional<CastHit> Queries::nearest(const State& state, const Vec2& point, double reach,
                                        const QueryFilter& filter) const
{
    std::optional<CastHit> best;
    double least = reach;
    // Bodies of several shapes that were looked at, and what they are from within.
    std::vector<std::pair<Index, std::optional<QueryHit>>> several;
    const auto fromWithin = [&](Index body) {
        const auto known =
            std::find_if(several.begin(), several.end(), [&](const auto& is) { return is.first == body; });
        if (known != several.end()) return known->second;
        return several.emplace_back(body, nearestFromWithin(state, body, point)).second;
    };
    tree_.around(
        point, [&] { return least; },
        [&](std::uint32_t index) {
            const Item item = itemAt(index);
            if (!seen(state, item.body, filter)) return;
            const bool alone = index >= items_.size() || item.whole();
            std::optional<QueryHit> hit = alone ? std::nullopt : fromWithin(item.body);
            if (!hit) hit = nearestOf(state, item, point, least);
            if (!hit || hit->at > reach || (best && (hit->at > least || (hit->at == least && item.body >= best->body))))
                return;
            least = hit->at;
            best = CastHit{item.body, hit->point, hit->normal, reach > 0 ? hit->at / reach : 0};
        });
    return best;
}

bool Queries::contains(const State& state, Index body, const Vec2& point) const
{
    if (!state.bodies[body].enabled) return false;
    const auto within = [&](const Item& item) { return inside(state, item, frameOf(state, item).in(point)); };
    if (state.bodies[body].single) return within(itemOf(body));
    bool any = false;
    eachItem(body, [&](const Item& item) { any = any || within(item); });
    return any;
}

}  // namespace jet::physics
