#include "query_union.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace jet::physics {

namespace {

// Parts of the size of all shapes: what lies on a border; how far beside a point is looked whether shapes cover it.
constexpr double kOn = 1e-9, kBeside = 1e-6;

}  // namespace

ShapeUnion::ShapeUnion(std::vector<CastShape> shapes) : shapes_(std::move(shapes))
{
    Box all;
    for (std::size_t s = 0; s < shapes_.size(); ++s) {
        const CastShape& shape = shapes_[s];
        const Box own = shape.bounds();
        all.extend(own.min), all.extend(own.max);
        for (std::size_t i = 0; i < shape.sides(); ++i) {
            const Vec2 &a = shape.points[i], &b = shape.points[(i + 1) % shape.points.size()];
            if (a == b) continue;
            const Vec2 aside = shape.radius * perpendicular(b - a).stableNormalized();
            pieces_.push_back({s, a + aside, b + aside});
            if (shape.radius > 0) pieces_.push_back({s, a - aside, b - aside});
        }
        // Whole circles: what of them lies within their own shape is covered by it.
        for (const Vec2& at : shape.points)
            if (shape.radius > 0) pieces_.push_back({s, at, at, shape.radius});
    }
    size_ = all.isNull() ? 0 : all.size().maxCoeff();
}

bool ShapeUnion::contains(const Vec2& at) const
{
    return std::any_of(shapes_.begin(), shapes_.end(), [&](const CastShape& shape) {
        if (shape.radius > 0)
            return (at - nearestOnSegment(at, shape.points.front(), shape.points.back())).norm() < shape.radius;
        return shape.contains(at);
    });
}

Vec2 ShapeUnion::Piece::foot(const Vec2& point) const
{
    if (!round()) return nearestOnSegment(point, a, b);
    const Vec2 off = point - a;
    return a + radius * (off.squaredNorm() > 0 ? Vec2(off.stableNormalized()) : Vec2(0, -1));
}

/// The borders that pass the point part its surroundings into sectors, each of which is covered, or is not.
bool ShapeUnion::covers(const Vec2& point) const
{
    std::vector<double> angles = {0};
    for (const Piece& piece : pieces_) {
        if ((piece.foot(point) - point).norm() > kOn * size_) continue;
        const Vec2 along = piece.round() ? perpendicular(point - piece.a) : Vec2(piece.b - piece.a);
        const double angle = std::atan2(along.y(), along.x());
        for (const double each : {angle, angle > 0 ? angle - std::numbers::pi : angle + std::numbers::pi})
            angles.push_back(each);
    }
    std::sort(angles.begin(), angles.end());
    angles.push_back(angles.front() + 2 * std::numbers::pi);
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
        if (angles[i + 1] - angles[i] < kBeside) continue;
        const double middle = 0.5 * (angles[i] + angles[i + 1]);
        if (!contains(point + kBeside * size_ * Vec2(std::cos(middle), std::sin(middle)))) return false;
    }
    return true;
}

void ShapeUnion::cross(const Piece& p, const Piece& q, std::vector<Vec2>& found)
{
    if (p.round() && q.round()) {
        const Vec2 apart = q.a - p.a;
        const double length = apart.norm();
        if (!(length > 0)) return;
        const double along = (length * length + p.radius * p.radius - q.radius * q.radius) / (2 * length);
        const double squared = p.radius * p.radius - along * along;
        if (squared < 0) return;
        const Vec2 way = apart / length, foot = p.a + along * way, aside = std::sqrt(squared) * perpendicular(way);
        found.push_back(foot + aside), found.push_back(foot - aside);
        return;
    }
    if (p.round()) return cross(q, p, found);
    const Vec2 edge = p.b - p.a;
    const auto take = [&](double t) {
        if (t >= -kOn && t <= 1 + kOn) found.push_back(p.a + t * edge);
    };
    if (!q.round()) {
        const Vec2 other = q.b - q.a;
        const double across = jet::cross(edge, other);
        if (across == 0) return;
        const double u = jet::cross(q.a - p.a, edge) / across;
        if (u >= -kOn && u <= 1 + kOn) take(jet::cross(q.a - p.a, other) / across);
        return;
    }
    const Vec2 off = p.a - q.a;
    const double a = edge.squaredNorm(), b = off.dot(edge), c = off.squaredNorm() - q.radius * q.radius;
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return;
    take((-b - std::sqrt(discriminant)) / a), take((-b + std::sqrt(discriminant)) / a);
}

/// It is the foot on a piece, or where two pieces cross.
std::optional<QueryHit> ShapeUnion::nearest(const Vec2& point) const
{
    const auto nearer = [](const Candidate& p, const Candidate& q) { return p.away < q.away; };
    std::optional<Candidate> best;
    const auto look = [&](std::vector<Candidate>& candidates) {
        std::sort(candidates.begin(), candidates.end(), nearer);
        for (const Candidate& one : candidates) {
            if (best && one.away >= best->away) return;
            if (!covers(one.at)) best = one;
        }
    };
    std::vector<Candidate> candidates;
    for (const Piece& piece : pieces_) {
        const Vec2 foot = piece.foot(point);
        candidates.push_back({(foot - point).norm(), foot});
    }
    look(candidates);
    candidates.clear();
    std::vector<Vec2> crossings;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        if (best && (pieces_[i].foot(point) - point).norm() >= best->away) continue;
        for (std::size_t k = 0; k < i; ++k)
            if (pieces_[k].shape != pieces_[i].shape) cross(pieces_[i], pieces_[k], crossings);
    }
    for (const Vec2& at : crossings) candidates.push_back({(at - point).norm(), at});
    look(candidates);
    if (!best) return std::nullopt;
    const Vec2 out = best->at - point;
    return QueryHit{best->away, best->at, best->away > 0 ? Vec2(out.stableNormalized()) : Vec2(0, -1)};
}

}  // namespace jet::physics
