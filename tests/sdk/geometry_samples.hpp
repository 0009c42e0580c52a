// What the geometry tests share: random curves from a fixed seed, those on which curve code usually breaks, and brute
// force to compare with.
#pragma once

#include <jet/path.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <ctime>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace jet::test {

/// Repeatable on every standard library: the engine is specified exactly, the distributions are not, so they are ours.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    double real(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }
    Vec2 point(double size = 100) { return {real(-size, size), real(-size, size)}; }
    Cubic cubic(double size = 100) { return {{point(size), point(size), point(size), point(size)}}; }
    std::size_t index(std::size_t count) { return engine_() % count; }
    std::uint64_t bits() { return engine_(); }

private:
    std::mt19937_64 engine_;
};

/// Processor time of this process, in seconds: what a test may limit on a busy machine.
inline double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// (s², s³) for s in [-1, 1]: a cusp at t = 1/2. Its length is 2 (13^1.5 - 8) / 27.
inline Cubic cuspCubic() { return {{Vec2(1, -1), Vec2(-1.0 / 3, 1), Vec2(-1.0 / 3, -1), Vec2(1, 1)}}; }

/// Cusp, loop, S, hairpin, there-and-back on a line, corners, coincident points, nothing at all.
inline std::vector<std::pair<std::string, Cubic>> awkwardCubics()
{
    return {{"cusp", cuspCubic()},
            {"loop", {{Vec2(0, 0), Vec2(30, 20), Vec2(-20, 20), Vec2(10, 0)}}},
            {"closed loop", {{Vec2(0, 0), Vec2(30, 20), Vec2(-20, 20), Vec2(0, 0)}}},
            {"inflection", {{Vec2(0, 0), Vec2(10, 20), Vec2(10, -20), Vec2(20, 0)}}},
            {"hairpin", {{Vec2(0, 0), Vec2(100, 1e-9), Vec2(100, 2e-9), Vec2(0, 3e-9)}}},
            {"there and back", {{Vec2(0, 0), Vec2(80, 40), Vec2(-60, -30), Vec2(20, 10)}}},
            {"corner line", {{Vec2(1, 2), Vec2(1, 2), Vec2(9, -4), Vec2(9, -4)}}},
            {"even line", {{Vec2(0, 0), Vec2(1, 1), Vec2(2, 2), Vec2(3, 3)}}},
            {"handle at the start", {{Vec2(0, 0), Vec2(0, 0), Vec2(10, 10), Vec2(20, 0)}}},
            {"handle at the end", {{Vec2(0, 0), Vec2(10, 10), Vec2(20, 0), Vec2(20, 0)}}},
            {"point", {{Vec2(5, 5), Vec2(5, 5), Vec2(5, 5), Vec2(5, 5)}}},
            {"huge", {{Vec2(0, 0), Vec2(1e200, 3e200), Vec2(-2e200, 1e200), Vec2(1e200, 0)}}},
            {"tiny", {{Vec2(0, 0), Vec2(1e-200, 3e-200), Vec2(-2e-200, 1e-200), Vec2(1e-200, 0)}}}};
}

inline double distance(const Vec2& a, const Vec2& b) { return std::hypot(a.x() - b.x(), a.y() - b.y()); }

inline Path circle(double radius = 1) { return Path::ellipse(Box({-radius, -radius}, {radius, radius})); }

/// A closed contour of random curves; corners and zero-length handles among them.
inline Contour randomContour(Random& random, std::size_t count, double size = 100)
{
    Contour contour;
    contour.closed = true;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 p = random.point(size);
        if (random.index(4) == 0)
            contour.segments.emplace_back(p);
        else
            contour.segments.emplace_back(p, p + random.point(size / 2), p + random.point(size / 2));
    }
    return contour;
}

/// A path of one curve.
inline Path single(const Cubic& c)
{
    Path path;
    path.moveTo(c.p[0]);
    path.cubicTo(c.p[1], c.p[2], c.p[3]);
    return path;
}

/// Points of the contour at `n` even steps of each curve, for comparison by brute force.
inline std::vector<Vec2> sampled(const Contour& contour, int n)
{
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < contour.curveCount(); ++i)
        for (int k = 0; k < n; ++k) points.push_back(contour.curve(i).at(static_cast<double>(k) / n));
    if (!contour.closed) points.push_back(contour.segments.back().point);
    return points;
}

inline double distanceToSegment(const Vec2& q, const Vec2& a, const Vec2& b)
{
    const Vec2 ab = b - a;
    const double square = ab.squaredNorm();
    const double share = square > 0 ? std::clamp((q - a).dot(ab) / square, 0.0, 1.0) : 0;
    return distance(q, a + share * ab);
}

inline double distanceToPolyline(const Vec2& q, const Polyline& line)
{
    double best = distance(q, line.points.front());
    for (std::size_t i = 1; i < line.points.size(); ++i)
        best = std::min(best, distanceToSegment(q, line.points[i - 1], line.points[i]));
    if (line.closed) best = std::min(best, distanceToSegment(q, line.points.back(), line.points.front()));
    return best;
}

inline bool sameBits(const Vec2& a, const Vec2& b)
{
    return std::bit_cast<std::uint64_t>(a.x()) == std::bit_cast<std::uint64_t>(b.x()) &&
           std::bit_cast<std::uint64_t>(a.y()) == std::bit_cast<std::uint64_t>(b.y());
}

inline ::testing::AssertionResult sameBits(const Path& a, const Path& b)
{
    if (a.contours().size() != b.contours().size()) return ::testing::AssertionFailure() << "other contour count";
    for (std::size_t c = 0; c < a.contours().size(); ++c) {
        const Contour &x = a.contours()[c], &y = b.contours()[c];
        if (x.closed != y.closed || x.segments.size() != y.segments.size())
            return ::testing::AssertionFailure() << "contour " << c << " is of another form";
        for (std::size_t i = 0; i < x.segments.size(); ++i) {
            const Segment &s = x.segments[i], &t = y.segments[i];
            if (!sameBits(s.point, t.point) || !sameBits(s.in, t.in) || !sameBits(s.out, t.out) ||
                s.intermediate != t.intermediate)
                return ::testing::AssertionFailure() << "contour " << c << ", segment " << i << " differs";
        }
    }
    return ::testing::AssertionSuccess();
}

/// The path the text stands for; a test fails where it stands for none.
inline Path parsed(std::string_view text)
{
    Result<Path> path = Path::parse(text);
    EXPECT_TRUE(path) << text << ": " << (path ? "" : path.error().message);
    return path ? *path : Path();
}

}  // namespace jet::test
