// Questions about a path's geometry: bounds, length, area, inside, nearest. All are answered on the cubics themselves.
#include <jet/path.hpp>

#include "roots.hpp"

namespace jet {

Box Path::bounds() const
{
    Box box;
    for (const Contour& contour : contours()) {
        for (const Segment& s : contour.segments) box.extend(s.point);
        for (std::size_t i = 0; i < contour.curveCount(); ++i) {
            const Cubic curve = contour.curve(i);
            if (!box.contains(curve.p[1]) || !box.contains(curve.p[2])) box.extend(curve.bounds());
        }
    }
    return box;
}

double Path::length() const
{
    double sum = 0;
    for (const Contour& contour : contours())
        for (std::size_t i = 0; i < contour.curveCount(); ++i) sum += contour.curve(i).length();
    return sum;
}

namespace {

/// Half the integral of P × P' along the curve, seen from `origin`: the products of the Bernstein polynomials
/// integrated.
double sweptArea(const Cubic& curve, const Vec2& origin)
{
    const Vec2 a = curve.p[0] - origin, b = curve.p[1] - origin, c = curve.p[2] - origin, d = curve.p[3] - origin;
    return (6 * (cross(a, b) + cross(c, d)) + 3 * (cross(a, c) + cross(b, c) + cross(b, d)) + cross(a, d)) / 20;
}

}  // namespace

double Path::area() const
{
    double sum = 0;
    for (const Contour& contour : contours()) {
        if (!contour.closed) continue;
        for (std::size_t i = 0; i < contour.curveCount(); ++i)
            sum += sweptArea(contour.curve(i), contour.segments.front().point);  // near: far origins cost digits
    }
    return sum;
}

namespace {

/// Counts the crossings of curves with the ray from q towards +x. A curve counts in pieces monotone in y, and a piece
/// counts where exactly one of its ends is at or above q (in y): neighbours share the end's y, so that a ray through an
/// end, or touching an extremum, counts right whatever the rounding.
class RayCrossings {
public:
    explicit RayCrossings(const Vec2& q) : q_(q) {}

    void addLine(const Vec2& a, const Vec2& b)
    {
        const double side = cross(b - a, q_ - a);
        if (b.y() > a.y() ? side > 0 : side < 0) count(a.y(), b.y());
    }

    void add(const Cubic& curve)
    {
        const auto& p = curve.p;
        const Vec2 low = p[0].cwiseMin(p[1]).cwiseMin(p[2].cwiseMin(p[3]));
        const Vec2 high = p[0].cwiseMax(p[1]).cwiseMax(p[2].cwiseMax(p[3]));
        if (q_.y() < low.y() || q_.y() > high.y() || q_.x() >= high.x()) return;
        if (q_.x() < low.x()) return count(p[0].y(), p[3].y());  // what goes up and comes down cancels
        if (curve.isCornerLine()) return addLine(p[0], p[3]);

        double t = 0, y = p[0].y();
        for (const double end : cubicExtrema(p[0].y(), p[1].y(), p[2].y(), p[3].y())) {
            const double endY = curve.at(end).y();
            addMonotone(curve, t, end, y, endY);
            t = end, y = endY;
        }
        addMonotone(curve, t, 1, y, p[3].y());
    }

    bool inside(FillRule rule) const { return rule == FillRule::NonZero ? winding_ != 0 : crossings_ % 2 != 0; }

private:
    void addMonotone(const Cubic& curve, double from, double to, double fromY, double toY)
    {
        if ((fromY <= q_.y()) == (toY <= q_.y())) return;
        const auto height = [&](double t) { return std::pair(curve.at(t).y() - q_.y(), curve.derivative(t).y()); };
        const double t = bracketedRoot(height, from, to, fromY > q_.y());
        if (curve.at(t).x() > q_.x()) count(fromY, toY);
    }

    void count(double fromY, double toY)
    {
        if ((fromY <= q_.y()) == (toY <= q_.y())) return;
        winding_ += toY > fromY ? 1 : -1;
        ++crossings_;
    }

    Vec2 q_;
    int winding_ = 0;
    int crossings_ = 0;
};

}  // namespace

bool Path::contains(const Vec2& p, FillRule rule) const
{
    RayCrossings crossings(p);
    for (const Contour& contour : contours()) {
        for (std::size_t i = 0; i < contour.curveCount(); ++i) crossings.add(contour.curve(i));
        if (!contour.closed && contour.segments.size() > 1)
            crossings.addLine(contour.segments.back().point, contour.segments.front().point);
    }
    return crossings.inside(rule);
}

namespace {

/// From p to the box of the control points: nothing on the curve is nearer.
double distanceToHull(const Cubic& curve, const Vec2& p)
{
    const auto& c = curve.p;
    const Vec2 low = c[0].cwiseMin(c[1]).cwiseMin(c[2].cwiseMin(c[3]));
    const Vec2 high = c[0].cwiseMax(c[1]).cwiseMax(c[2].cwiseMax(c[3]));
    const Vec2 outside = (low - p).cwiseMax(p - high).cwiseMax(Vec2::Zero());
    return std::max(outside.x(), outside.y());
}

}  // namespace

PathPosition Path::nearest(const Vec2& p) const
{
    PathPosition best;
    best.distance = std::numeric_limits<double>::infinity();
    const auto offer = [&](std::size_t contour, std::size_t curve, double t, const Vec2& point) {
        const double distance = std::hypot(point.x() - p.x(), point.y() - p.y());
        if (distance < best.distance) best = {contour, curve, t, point, distance};
    };
    const std::vector<Contour>& all = contours();
    for (std::size_t c = 0; c < all.size(); ++c) {
        const Contour& contour = all[c];
        if (!contour.segments.empty()) offer(c, 0, 0, contour.segments.front().point);
        for (std::size_t i = 0; i < contour.curveCount(); ++i) {
            const Cubic curve = contour.curve(i);
            if (distanceToHull(curve, p) > best.distance) continue;
            const double t = curve.nearest(p);
            offer(c, i, t, curve.at(t));
        }
    }
    return best;
}

}  // namespace jet
