// Polylines of a path: within a tolerance of its curves, or through its segments and intermediate points.
#include <jet/path.hpp>

#include "roots.hpp"

#include <bit>
#include <cassert>

namespace jet {

namespace {

constexpr int kMostChords = 4096;  // for a curve of any size

bool isFinite(const Cubic& curve)
{
    return std::ranges::all_of(curve.p, [](const Vec2& p) { return jet::isFinite(p); });
}

/// Does the chord stay within `tolerance` of the curve, and the curve of the chord?
bool isFlat(const Cubic& curve, double tolerance)
{
    const auto& p = curve.p;
    const Vec2 chord = p[3] - p[0];
    const double length = std::hypot(chord.x(), chord.y());
    const Vec2 first = p[1] - p[0], second = p[2] - p[0];

    // From the chord run through evenly, the curve is away by at most 3/4 of what its control points are.
    const Vec2 awayFirst = first - chord / 3, awaySecond = second - chord * (2.0 / 3.0);
    const double away = std::max(std::hypot(awayFirst.x(), awayFirst.y()), std::hypot(awaySecond.x(), awaySecond.y()));
    if (0.75 * away <= tolerance) return true;

    // Where it cannot run past the chord's ends, only the distance across counts.
    if (!(length > 0)) return false;
    const Vec2 along = chord / length;
    const auto beside = [&](const Vec2& v) { return v.dot(along) >= 0 && v.dot(along) <= length; };
    if (!beside(first) || !beside(second)) return false;

    // It is the cubic 3 t (1-t) ((1-t) d1 + t d2), and largest at a root of its derivative.
    const double d1 = cross(along, first), d2 = cross(along, second);
    if (0.75 * std::max(std::abs(d1), std::abs(d2)) <= tolerance) return true;
    double largest = 0;
    for (const double t : cubicExtrema(0, d1, d2, 0))
        largest = std::max(largest, std::abs(3 * t * (1 - t) * ((1 - t) * d1 + t * d2)));
    return largest <= tolerance;
}

void appendHalved(std::vector<Vec2>& points, const Cubic& curve, double tolerance, int depth)
{
    if (depth == 0 || isFlat(curve, tolerance)) {
        if (points.back() != curve.p[3]) points.push_back(curve.p[3]);
        return;
    }
    const auto [left, right] = curve.split(0.5);
    appendHalved(points, left, tolerance, depth - 1);
    appendHalved(points, right, tolerance, depth - 1);
}

/// How many chords a curve needs, and where they meet. A chord over a small step h of t is off by h² |P' × P''| /
/// 8|P'|, so chords of equal error are those over equal parts of the integral of the root of |P' × P''| / 8|P'|.
/// Halving alone gives up to twice as many points.
class ChordDensity {
public:
    ChordDensity(const Cubic& curve, double tolerance)
    {
        const auto& p = curve.p;
        for (std::size_t i = 0; i < kBins; ++i) {
            const double t = (static_cast<double>(i) + 0.5) / kBins;
            const Vec2 first = curve.derivative(t);
            const Vec2 second = 6 * ((1 - t) * (p[2] - 2 * p[1] + p[0]) + t * (p[3] - 2 * p[2] + p[1]));
            const double speed = first.norm();
            const double bend = speed > 0 ? std::abs(cross(first, second)) / speed : 0;
            sum_[i + 1] = sum_[i] + std::sqrt(bend / (8 * tolerance)) / kBins;
        }
    }

    /// A little more than the integral: within a bin the density is taken as constant.
    int chords(int most) const
    {
        const double chords = std::ceil(1.05 * sum_.back());
        return chords < most ? std::max(1, static_cast<int>(chords)) : most;  // also where arithmetic overflowed
    }

    /// The t at which `share` of the integral is reached.
    double at(double share) const
    {
        const double target = share * sum_.back();
        std::size_t bin = 0;
        while (bin + 1 < kBins && sum_[bin + 1] < target) ++bin;
        const double inBin = (target - sum_[bin]) / (sum_[bin + 1] - sum_[bin]);
        return (static_cast<double>(bin) + (inBin > 0 ? std::min(inBin, 1.0) : 0.0)) / kBins;
    }

private:
    static constexpr std::size_t kBins = 32;
    std::array<double, kBins + 1> sum_{};
};

void appendFlattened(std::vector<Vec2>& points, const Cubic& curve, double tolerance)
{
    if (curve.isLine() || !isFinite(curve)) return appendHalved(points, curve, tolerance, 0);
    const ChordDensity density(curve, tolerance);
    const int chords = density.chords(kMostChords);
    const int depth = std::bit_width(static_cast<unsigned>(kMostChords / chords)) - 1;
    Cubic rest = curve;
    double begin = 0;
    for (int i = 1; i < chords; ++i) {
        const double end = density.at(static_cast<double>(i) / chords);
        const auto [part, remaining] = rest.split((end - begin) / (1 - begin));
        appendHalved(points, part, tolerance, depth);  // what the density missed, such as a sharp turn
        rest = remaining;
        begin = end;
    }
    appendHalved(points, rest, tolerance, depth);
}

}  // namespace

std::vector<Polyline> Path::flatten(double tolerance) const
{
    assert(tolerance > 0);
    std::vector<Polyline> polylines;
    for (const Contour& contour : contours()) {
        if (contour.segments.empty()) continue;
        Polyline& line = polylines.emplace_back();
        line.closed = contour.closed;
        line.points.push_back(contour.segments.front().point);
        for (std::size_t i = 0; i < contour.curveCount(); ++i)
            appendFlattened(line.points, contour.curve(i), tolerance);
        if (line.closed && line.points.size() > 1 && line.points.back() == line.points.front()) line.points.pop_back();
    }
    return polylines;
}

std::vector<Polyline> Path::polygonized() const
{
    std::vector<Polyline> polylines;
    for (const Contour& contour : contours()) {
        if (contour.segments.empty()) continue;
        Polyline& line = polylines.emplace_back();
        line.closed = contour.closed;
        for (std::size_t i = 0; i < contour.segments.size(); ++i) {
            line.points.push_back(contour.segments[i].point);
            if (i >= contour.curveCount()) break;  // no curve starts at the end of an open contour
            const Cubic curve = contour.curve(i);
            const int count = std::min(contour.segments[i].intermediate, kMaxIntermediate);
            const bool straight = curve.isCornerLine();  // evenly in t they would crowd at its ends
            for (int k = 1; k <= count; ++k) {
                const double share = static_cast<double>(k) / (count + 1);
                line.points.push_back(straight ? Vec2(curve.p[0] + share * (curve.p[3] - curve.p[0]))
                                               : curve.at(share));
            }
        }
    }
    return polylines;
}

}  // namespace jet
