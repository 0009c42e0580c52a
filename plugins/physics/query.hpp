// What a single outline or round shape answers to a query, in double precision and in its own frame.
#pragma once

#include <jet/geometry.hpp>

#include <optional>
#include <span>
#include <vector>

namespace jet::physics {

struct QueryEdge {
    Vec2 a, b;
    int outward = 0;  // +1: outside at perpendicular(b - a), -1: opposite, 0: none
};

/// Where something comes to touch: `at` is the part of the way.
struct QueryHit {
    double at = 0;
    Vec2 point, normal;
};

/// When a point that moves along `way` comes within `radius` of the segment a b, from outside; radius 0: meets it.
std::optional<QueryHit> meetSegment(const Vec2& from, const Vec2& way, const Vec2& a, const Vec2& b, double radius);

Vec2 nearestOnSegment(const Vec2& point, const Vec2& a, const Vec2& b);
double segmentDistance(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);
double boxDistance(const Box&, const Vec2& a, const Vec2& b);

/// A shape that is moved without turning: a point, segment or closed polygon rounded by a radius.
struct CastShape {
    std::vector<Vec2> points;
    double radius = 0;
    bool closed = false;

    std::size_t sides() const { return points.size() < 2 ? 0 : closed ? points.size() : points.size() - 1; }
    bool contains(const Vec2& point) const;
    /// The mean of its points, which of a line need not be on it.
    Vec2 middle() const;
    /// A point that is not on its border, unless it is a line.
    Vec2 within() const { return closed || points.size() < 3 ? middle() : Vec2(0.5 * (points[0] + points[1])); }
    Box bounds() const;
};

/// When the moving shape meets the segment rounded by `radius`. Exact: shapes that do not turn touch first where a
/// corner of one meets a side of the other.
std::optional<QueryHit> castAt(const CastShape&, const Vec2& way, const Vec2& a, const Vec2& b, double radius);

}  // namespace jet::physics
