// Fitting fewer curves to a path: Schneider, "An Algorithm for Automatically Fitting Digitized Curves", Graphics Gems,
// 1990.
#include <jet/path_operations.hpp>

#include <algorithm>

namespace jet {

namespace {

constexpr int kSamples = 16;  // a curve, of the path to be simplified
constexpr int kReparametrisations = 8;

using Points = std::span<const Vec2>;

Vec2 unit(const Vec2& v)
{
    const double length = v.norm();
    return length > 0 ? Vec2(v / length) : Vec2(0, 0);
}

/// Chord-length parameters of the points, 0..1.
std::vector<double> chordLengths(Points points)
{
    std::vector<double> at{0};
    for (std::size_t i = 1; i < points.size(); ++i) at.push_back(at.back() + (points[i] - points[i - 1]).norm());
    const double whole = at.back();
    for (double& t : at) t = whole > 0 ? t / whole : 0;
    return at;
}

/// The cubic with the given end tangents that is nearest to the points in the least-squares sense (eq. 1-4 of the
/// paper).
Cubic leastSquares(Points points, const std::vector<double>& at, const Vec2& startTangent, const Vec2& endTangent)
{
    const Vec2 first = points.front(), last = points.back();
    double c00 = 0, c01 = 0, c11 = 0, x0 = 0, x1 = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double t = at[i], u = 1 - t;
        const Vec2 a0 = startTangent * (3 * u * u * t), a1 = endTangent * (3 * u * t * t);
        const Vec2 rest = points[i] - (first * (u * u * u + 3 * u * u * t) + last * (3 * u * t * t + t * t * t));
        c00 += a0.dot(a0), c01 += a0.dot(a1), c11 += a1.dot(a1);
        x0 += a0.dot(rest), x1 += a1.dot(rest);
    }
    const double det = c00 * c11 - c01 * c01, chord = (last - first).norm();
    double alpha0 = det != 0 ? (x0 * c11 - x1 * c01) / det : 0, alpha1 = det != 0 ? (c00 * x1 - c01 * x0) / det : 0;
    // Wu & Barsky's heuristic where the solution is degenerate.
    if (alpha0 < 1e-6 * chord || alpha1 < 1e-6 * chord) alpha0 = alpha1 = chord / 3;
    return {{first, first + startTangent * alpha0, last + endTangent * alpha1, last}};
}

struct Deviation {
    double most = 0;  // squared
    std::size_t where = 0;
};

Deviation deviation(const Cubic& curve, Points points, const std::vector<double>& at)
{
    Deviation found;
    found.where = points.size() / 2;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const double d = (curve.at(at[i]) - points[i]).squaredNorm();
        if (d > found.most) found = {d, i};
    }
    return found;
}

/// One Newton step for each parameter towards the nearest point of the curve (eq. 5 of the paper).
void reparametrise(const Cubic& curve, Points points, std::vector<double>& at)
{
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const Vec2 gap = curve.at(at[i]) - points[i], d1 = curve.derivative(at[i]);
        const Vec2 d2 = 6 * ((curve.p[2] - 2 * curve.p[1] + curve.p[0]) * (1 - at[i]) +
                             (curve.p[3] - 2 * curve.p[2] + curve.p[1]) * at[i]);
        const double slope = d1.dot(d1) + gap.dot(d2);
        if (slope != 0) at[i] = std::clamp(at[i] - gap.dot(d1) / slope, 0.0, 1.0);
    }
}

bool isStraight(Points points, double tolerance)
{
    const Vec2 along = unit(points.back() - points.front());
    if (along == Vec2(0, 0)) return false;  // a loop
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec2& p) { return std::abs(cross(along, p - points.front())) <= tolerance; });
}

class Fitter {
public:
    explicit Fitter(double tolerance) : tolerance_(tolerance) {}

    void fit(Points points, const Vec2& startTangent, const Vec2& endTangent)
    {
        if (points.size() < 3 || isStraight(points, 0.01 * tolerance_)) return line(points);
        std::vector<double> at = chordLengths(points);
        Cubic curve = leastSquares(points, at, startTangent, endTangent);
        Deviation off = deviation(curve, points, at);
        for (int i = 0; i < kReparametrisations && off.most > tolerance_ * tolerance_; ++i) {
            reparametrise(curve, points, at);
            curve = leastSquares(points, at, startTangent, endTangent);
            off = deviation(curve, points, at);
        }
        if (off.most <= tolerance_ * tolerance_) return curves.push_back(curve);
        const std::size_t middle = std::clamp<std::size_t>(off.where, 1, points.size() - 2);
        const Vec2 tangent = unit(points[middle - 1] - points[middle + 1]);
        fit(points.subspan(0, middle + 1), startTangent, tangent);
        fit(points.subspan(middle), -tangent, endTangent);
    }

    std::vector<Cubic> curves;

private:
    void line(Points points) { curves.push_back({{points.front(), points.front(), points.back(), points.back()}}); }

    double tolerance_;
};

/// Tangents of a curve at its ends, also where a control point lies on its end.
Vec2 startTangent(const Cubic& c)
{
    for (std::size_t i = 1; i < 4; ++i) {
        if (c.p[i] != c.p[0]) return unit(c.p[i] - c.p[0]);
    }
    return {0, 0};
}
Vec2 endTangent(const Cubic& c)
{
    for (std::size_t i = 3; i-- > 0;) {
        if (c.p[i] != c.p[3]) return unit(c.p[i] - c.p[3]);
    }
    return {0, 0};
}

bool isCorner(const Cubic& before, const Cubic& after, double angle)
{
    return -endTangent(before).dot(startTangent(after)) < std::cos(angle);
}

/// Runs of curves between corners: indices of first curves; a closed contour starts its first run at a corner if it has
/// one.
std::vector<std::vector<Cubic>> runsOf(const Contour& contour, double cornerAngle)
{
    std::vector<Cubic> curves;
    for (std::size_t i = 0; i < contour.curveCount(); ++i) {
        const Cubic curve = contour.curve(i);
        if (curve.p[0] != curve.p[3] || curve.p[1] != curve.p[0] || curve.p[2] != curve.p[3]) curves.push_back(curve);
    }
    if (curves.empty()) return {};
    if (contour.closed) {
        for (std::size_t i = 0; i < curves.size(); ++i) {
            const Cubic& before = curves[(i + curves.size() - 1) % curves.size()];
            if (!isCorner(before, curves[i], cornerAngle)) continue;
            std::rotate(curves.begin(), curves.begin() + static_cast<std::ptrdiff_t>(i), curves.end());
            break;
        }
    }
    std::vector<std::vector<Cubic>> runs{{curves.front()}};
    for (std::size_t i = 1; i < curves.size(); ++i) {
        if (isCorner(curves[i - 1], curves[i], cornerAngle)) runs.emplace_back();
        runs.back().push_back(curves[i]);
    }
    return runs;
}

std::vector<Cubic> fitted(const std::vector<Cubic>& run, double tolerance)
{
    std::vector<Vec2> points{run.front().p[0]};
    for (const Cubic& curve : run) {
        const int samples = curve.isLine() ? 1 : kSamples;
        for (int i = 1; i <= samples; ++i) points.push_back(curve.at(static_cast<double>(i) / samples));
    }
    Fitter fitter(tolerance);
    fitter.fit(points, startTangent(run.front()), endTangent(run.back()));
    return fitter.curves.size() < run.size() ? fitter.curves : run;  // never more than there were
}

Contour contourOf(const std::vector<Cubic>& curves, bool closed)
{
    Contour contour;
    contour.closed = closed;
    contour.segments.emplace_back(curves.front().p[0]);
    for (const Cubic& curve : curves) {
        contour.segments.back().out = curve.p[1];
        contour.segments.emplace_back(curve.p[3], curve.p[2], curve.p[3]);
    }
    if (closed) {
        contour.segments.front().in = contour.segments.back().in;
        contour.segments.pop_back();
    }
    return contour;
}

}  // namespace

Path simplifyPath(const Path& path, double tolerance, double cornerAngle)
{
    std::vector<Contour> contours;
    for (const Contour& contour : path.contours()) {
        std::vector<Cubic> curves;
        for (const std::vector<Cubic>& run : runsOf(contour, cornerAngle)) {
            const std::vector<Cubic> simple = fitted(run, tolerance);
            curves.insert(curves.end(), simple.begin(), simple.end());
        }
        if (curves.empty() || curves.size() >= contour.curveCount()) {
            contours.push_back(contour);  // nothing to win: not touched at all
        } else {
            contours.push_back(contourOf(curves, contour.closed));
            int most = 0;
            for (const Segment& segment : contour.segments) most = std::max(most, segment.intermediate);
            for (Segment& segment : contours.back().segments) segment.intermediate = most;
        }
    }
    return Path(std::move(contours));
}

}  // namespace jet
