#include "query.hpp"

#include <algorithm>
#include <cmath>

namespace jet::physics {

Vec2 nearestOnSegment(const Vec2& point, const Vec2& a, const Vec2& b)
{
    const Vec2 edge = b - a;
    const double squared = edge.squaredNorm();
    return squared > 0 ? Vec2(a + std::clamp((point - a).dot(edge) / squared, 0.0, 1.0) * edge) : a;
}

double segmentDistance(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const Vec2 p = b - a, q = d - c;
    const double across = cross(p, q);
    if (across != 0) {
        const double s = cross(c - a, q) / across, t = cross(c - a, p) / across;
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1) return 0;
    }
    const auto to = [](const Vec2& x, const Vec2& u, const Vec2& v) { return (x - nearestOnSegment(x, u, v)).norm(); };
    return std::min({to(a, c, d), to(b, c, d), to(c, a, b), to(d, a, b)});
}

double boxDistance(const Box& box, const Vec2& a, const Vec2& b)
{
    if (box.contains(a) || box.contains(b)) return 0;
    const Vec2 corners[4] = {box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}};
    double least = 1e300;
    for (int i = 0; i < 4; ++i) least = std::min(least, segmentDistance(a, b, corners[i], corners[(i + 1) % 4]));
    return least;
}

namespace {

void take(std::optional<QueryHit>& best, const std::optional<QueryHit>& hit)
{
    if (hit && (!best || hit->at < best->at)) best = hit;
}

std::optional<QueryHit> meetLine(const Vec2& from, const Vec2& way, const Vec2& a, const Vec2& b)
{
    const Vec2 edge = b - a;
    const double across = cross(way, edge);
    if (across == 0) return std::nullopt;
    const double at = cross(a - from, edge) / across, along = cross(a - from, way) / across;
    if (!(at >= 0 && at <= 1 && along >= 0 && along <= 1)) return std::nullopt;
    Vec2 normal = perpendicular(edge).normalized();
    if (normal.dot(way) > 0) normal = -normal;
    return QueryHit{at, from + at * way, normal};
}

std::optional<QueryHit> meetCircle(const Vec2& from, const Vec2& way, const Vec2& centre, double radius)
{
    const Vec2 off = from - centre;
    const double a = way.squaredNorm(), b = off.dot(way), c = off.squaredNorm() - radius * radius;
    if (!(a > 0) || b >= 0) return std::nullopt;
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return std::nullopt;
    const double at = c / (-b + std::sqrt(discriminant));  // the smaller root, without cancellation
    if (!(at >= 0 && at <= 1)) return std::nullopt;
    const Vec2 point = from + at * way;
    return QueryHit{at, point, (point - centre).stableNormalized()};
}

}  // namespace

std::optional<QueryHit> meetSegment(const Vec2& from, const Vec2& way, const Vec2& a, const Vec2& b, double radius)
{
    if (radius <= 0) return meetLine(from, way, a, b);
    if ((from - nearestOnSegment(from, a, b)).norm() < radius) return std::nullopt;
    std::optional<QueryHit> best;
    take(best, meetCircle(from, way, a, radius));
    if (a == b) return best;
    take(best, meetCircle(from, way, b, radius));
    const Vec2 aside = radius * perpendicular(b - a).normalized();
    // What begins at the rim and leaves it does not come to it.
    if (way.dot(aside) < 0) take(best, meetLine(from, way, a + aside, b + aside));
    if (way.dot(aside) > 0) take(best, meetLine(from, way, a - aside, b - aside));
    return best;
}

bool CastShape::contains(const Vec2& at) const
{
    bool inside = false;
    if (!closed) return false;
    for (std::size_t i = 0, k = points.size() - 1; i < points.size(); k = i++)
        if ((points[i].y() > at.y()) != (points[k].y() > at.y()) &&
            at.x() < (points[k].x() - points[i].x()) * (at.y() - points[i].y()) / (points[k].y() - points[i].y()) +
                         points[i].x())
            inside = !inside;
    return inside;
}

Vec2 CastShape::middle() const
{
    Vec2 sum(0, 0);
    for (const Vec2& at : points) sum += at / static_cast<double>(points.size());
    return sum;
}

Box CastShape::bounds() const
{
    Box box;
    for (const Vec2& at : points) box.extend(at);
    return box.inflated(radius);
}

std::optional<QueryHit> castAt(const CastShape& shape, const Vec2& way, const Vec2& a, const Vec2& b, double radius)
{
    const double all = shape.radius + radius;
    std::optional<QueryHit> best;
    // Corners of the shape come to the segment ...
    for (const Vec2& corner : shape.points) {
        auto hit = meetSegment(corner, way, a, b, all);
        if (!hit) continue;
        hit->point -= shape.radius * hit->normal;
        take(best, hit);
    }
    // ... or its sides to the segment's ends.
    for (std::size_t i = 0; i < shape.sides(); ++i) {
        const Vec2 &p = shape.points[i], &q = shape.points[(i + 1) % shape.points.size()];
        for (const Vec2& end : {a, b}) {
            const auto back = meetSegment(end, -way, p, q, all);
            if (!back) continue;
            const Vec2 normal = -back->normal;
            take(best, QueryHit{back->at, end + radius * normal, normal});
            if (a == b) break;
        }
    }
    return best;
}

}  // namespace jet::physics
