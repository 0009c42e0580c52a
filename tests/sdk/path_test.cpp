#include "geometry_samples.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <numbers>

namespace jet {
namespace {

using std::numbers::pi;
using test::awkwardCubics;
using test::Random;

double distance(const Vec2& a, const Vec2& b) { return std::hypot(a.x() - b.x(), a.y() - b.y()); }

Path circle(double radius = 1) { return Path::ellipse(Box({-radius, -radius}, {radius, radius})); }

/// A closed contour of random curves; corners and zero-length handles among them.
Contour randomContour(Random& random, std::size_t count, double size = 100)
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

Path single(const Cubic& c)
{
    Path path;
    path.moveTo(c.p[0]);
    path.cubicTo(c.p[1], c.p[2], c.p[3]);
    return path;
}

/// Points of the contour at `n` even steps of each curve, for comparison by brute force.
std::vector<Vec2> sampled(const Contour& contour, int n)
{
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < contour.curveCount(); ++i)
        for (int k = 0; k < n; ++k) points.push_back(contour.curve(i).at(static_cast<double>(k) / n));
    if (!contour.closed) points.push_back(contour.segments.back().point);
    return points;
}

double distanceToSegment(const Vec2& q, const Vec2& a, const Vec2& b)
{
    const Vec2 ab = b - a;
    const double square = ab.squaredNorm();
    const double share = square > 0 ? std::clamp((q - a).dot(ab) / square, 0.0, 1.0) : 0;
    return distance(q, a + share * ab);
}

double distanceToPolyline(const Vec2& q, const Polyline& line)
{
    double best = distance(q, line.points.front());
    for (std::size_t i = 1; i < line.points.size(); ++i)
        best = std::min(best, distanceToSegment(q, line.points[i - 1], line.points[i]));
    if (line.closed) best = std::min(best, distanceToSegment(q, line.points.back(), line.points.front()));
    return best;
}

/// The angle the points go round q, in turns: an independent winding number.
int windingByAngle(const std::vector<Vec2>& points, const Vec2& q)
{
    double angle = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2 a = points[i] - q, b = points[(i + 1) % points.size()] - q;
        angle += std::atan2(cross(a, b), a.dot(b));
    }
    return static_cast<int>(std::lround(angle / (2 * pi)));
}

bool sameBits(const Vec2& a, const Vec2& b)
{
    return std::bit_cast<std::uint64_t>(a.x()) == std::bit_cast<std::uint64_t>(b.x()) &&
           std::bit_cast<std::uint64_t>(a.y()) == std::bit_cast<std::uint64_t>(b.y());
}

::testing::AssertionResult sameBits(const Path& a, const Path& b)
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

Path parsed(std::string_view text)
{
    Result<Path> path = Path::parse(text);
    EXPECT_TRUE(path) << text << ": " << (path ? "" : path.error().message);
    return path ? *path : Path();
}

// --- making paths

TEST(PathTest, ARectangleRunsClockwiseOnScreenFromItsTopLeftCorner)
{
    const Path path = Path::rectangle(Box({1, 2}, {4, 6}));
    EXPECT_EQ(path.text(), "M 1 2 L 4 2 L 4 6 L 1 6 Z");
    EXPECT_EQ(path.area(), 12);
    EXPECT_EQ(path.length(), 14);
}

TEST(PathTest, AnEllipseHasFourSegmentsFromTheRightClockwise)
{
    const Path path = Path::ellipse(Box({0, 0}, {20, 10}));
    ASSERT_EQ(path.segmentCount(), 4u);
    EXPECT_EQ(path.segment(0).point, Vec2(20, 5));
    EXPECT_EQ(path.segment(1).point, Vec2(10, 10));
    EXPECT_EQ(path.segment(2).point, Vec2(0, 5));
    EXPECT_EQ(path.segment(3).point, Vec2(10, 0));
    EXPECT_EQ(path.bounds(), Box({0, 0}, {20, 10}));
}

TEST(PathTest, ACircleOfFourKappaArcsIsRoundToTwentySevenParts)
{
    // The radius is between 1 and 1.000273 (Goldapp 1991), so area and length are between those circles'.
    const double most = 1.000273;
    for (const Vec2& p : sampled(circle().contours()[0], 1000)) {
        EXPECT_GE(p.norm(), 1 - 1e-15);
        EXPECT_LE(p.norm(), most);
    }
    EXPECT_GT(circle().length(), 2 * pi);
    EXPECT_LT(circle().length(), 2 * pi * most);
    EXPECT_GT(circle().area(), pi);
    EXPECT_LT(circle().area(), pi * most * most);
}

TEST(PathTest, FactoriesOfNothingMakeAnEmptyPath)
{
    EXPECT_TRUE(Path::rectangle(Box()).isEmpty());
    EXPECT_TRUE(Path::ellipse(Box()).isEmpty());
    EXPECT_TRUE(Path::polygon({}).isEmpty());
    EXPECT_TRUE(Path().bounds().isNull());
    EXPECT_EQ(Path().length(), 0);
    EXPECT_FALSE(Path().contains({0, 0}));
    EXPECT_EQ(Path().nearest({0, 0}).distance, std::numeric_limits<double>::infinity());
}

TEST(PathTest, ACurveWithoutACurrentPointIsRefused)
{
    Path path;
    EXPECT_THROW(path.lineTo({1, 1}), Failure);
    EXPECT_THROW(path.quadTo({1, 1}, {2, 2}), Failure);
    EXPECT_THROW(path.cubicTo({1, 1}, {2, 2}, {3, 3}), Failure);
    EXPECT_THROW(path.arcTo({1, 1}, 0, false, true, {2, 0}), Failure);
    EXPECT_THROW(path.close(), Failure);
}

TEST(PathTest, ClosingMergesALastPointOnTheFirst)
{
    Path path;
    path.moveTo({0, 0});
    path.lineTo({10, 0});
    path.cubicTo({12, 4}, {3, 5}, {0, 0});
    path.close();
    ASSERT_EQ(path.segmentCount(), 2u);
    EXPECT_EQ(path.segment(0).in, Vec2(3, 5));
    EXPECT_EQ(path.segment(1).out, Vec2(12, 4));
}

TEST(PathTest, ACurveAfterClosingBeginsWhereTheClosedContourBegan)
{
    Path path;
    path.moveTo({3, 4});
    path.lineTo({10, 0});
    path.close();
    path.lineTo({1, 1});
    EXPECT_EQ(path.text(), "M 3 4 L 10 0 Z M 3 4 L 1 1");
}

// --- arcs

TEST(PathTest, AnArcOfACircleStaysOnTheCircle)
{
    struct Case {
        bool large, sweep;
        Vec2 center;
        double turns;
    };
    // From (1, 0) to (0, 1) with radius 1: the centre is (0, 0) or (1, 1).
    for (const Case& c : {Case{false, true, {0, 0}, 0.25}, Case{true, true, {1, 1}, 0.75},
                          Case{false, false, {1, 1}, 0.25}, Case{true, false, {0, 0}, 0.75}}) {
        Path path;
        path.moveTo({1, 0});
        path.arcTo({1, 1}, 0, c.large, c.sweep, {0, 1});
        EXPECT_EQ(path.contours()[0].curveCount(), c.large ? 3u : 1u);
        EXPECT_EQ(path.contours()[0].segments.back().point, Vec2(0, 1));
        EXPECT_NEAR(path.length(), 2 * pi * c.turns, 3e-4 * 2 * pi * c.turns);
        for (const Vec2& p : sampled(path.contours()[0], 50)) EXPECT_NEAR(distance(p, c.center), 1, 3e-4);
    }
}

TEST(PathTest, ATurnedEllipseArcStaysOnTheTurnedEllipse)
{
    Random random(20);
    for (int i = 0; i < 200; ++i) {
        const Vec2 radii(random.real(1, 50), random.real(1, 50)), center = random.point();
        const double rotation = random.real(-7, 7), from = random.real(0, 6), turn = random.real(-6, 6);
        const Affine map = Affine::translation(center) * Affine::rotation(rotation) * Affine::scaling(radii);
        const auto on = [&](double a) -> Vec2 { return map * Vec2(std::cos(a), std::sin(a)); };
        Path path;
        path.moveTo(on(from));
        path.arcTo(radii, rotation, std::abs(turn) > pi, turn > 0, on(from + turn));
        const Affine back = map.inverse();
        for (const Vec2& p : sampled(path.contours()[0], 20)) EXPECT_NEAR((back * p).norm(), 1, 3e-4);
        EXPECT_LT(distance(path.nearest(on(from + 0.5 * turn)).point, on(from + 0.5 * turn)), 3e-4 * radii.maxCoeff());
    }
}

TEST(PathTest, ArcsWithUnusableRadiiFollowTheSvgRules)
{
    EXPECT_EQ(parsed("M 0 0 A 0 5 0 0 1 10 0").text(), "M 0 0 L 10 0");
    EXPECT_EQ(parsed("M 0 0 A 5 0 0 0 1 10 0").text(), "M 0 0 L 10 0");
    EXPECT_EQ(parsed("M 0 0 A 5 5 0 0 1 0 0").text(), "M 0 0");
    EXPECT_EQ(parsed("M 0 0 A 1e-300 1e-300 0 0 1 1e300 0").contours()[0].curveCount(), 1u);  // arithmetic overflows
    // A radius of 1 cannot span 10: it becomes 5, a half circle.
    const Path scaled = parsed("M 0 0 A 1 1 0 0 1 10 0");
    EXPECT_NEAR(scaled.length(), 5 * pi, 5 * pi * 3e-4);
    EXPECT_NEAR(scaled.bounds().min.y(), -5, 1e-12);
    // The sign of a radius does not count.
    EXPECT_EQ(parsed("M 0 0 A -7 -7 0 0 1 10 0"), parsed("M 0 0 A 7 7 0 0 1 10 0"));
}

// --- measuring

TEST(PathTest, BoundsAreThoseOfTheCurvesNotOfTheControlPoints)
{
    const Path arch = single({{Vec2(0, 0), Vec2(0, 4), Vec2(4, 4), Vec2(4, 0)}});
    EXPECT_EQ(arch.bounds(), Box({0, 0}, {4, 3}));
    Path withPoint = arch;
    withPoint.moveTo({-9, 8});
    EXPECT_EQ(withPoint.bounds(), Box({-9, 0}, {4, 8}));
}

TEST(PathTest, AreaIsThatOfAFinePolygon)
{
    Random random(30);
    for (int i = 0; i < 50; ++i) {
        const Path path({randomContour(random, 2 + random.index(6))});
        const auto shoelace = [&](int n) {
            const std::vector<Vec2> p = sampled(path.contours()[0], n);
            double sum = 0;
            for (std::size_t k = 0; k < p.size(); ++k) sum += 0.5 * cross(p[k], p[(k + 1) % p.size()]);
            return sum;
        };
        const double coarse = shoelace(500), fine = shoelace(1000);
        EXPECT_NEAR(path.area(), fine + (fine - coarse) / 3, 1e-4);
        EXPECT_NEAR(path.reversed().area(), -path.area(), 1e-9);
    }
}

TEST(PathTest, AreaKeepsItsDigitsFarFromTheOrigin)
{
    Path path = circle();
    const double area = path.area();
    path.transform(Affine::translation({1e8, -1e8}));
    EXPECT_NEAR(path.area(), area, 1e-6);
}

TEST(PathTest, OpenContoursEncloseNoArea)
{
    EXPECT_EQ(Path::polygon(std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}}, false).area(), 0);
}

TEST(PathTest, InsideAgreesWithTheAngleAFinePolygonTurnsThrough)
{
    Random random(40);
    int inside = 0, compared = 0;
    for (int i = 0; i < 60; ++i) {
        const Path path({randomContour(random, 1 + random.index(6))});
        const std::vector<Vec2> polygon = sampled(path.contours()[0], 400);
        const Polyline border{polygon, true};
        for (int k = 0; k < 40; ++k) {
            const Vec2 q = random.point(60);
            if (distanceToPolyline(q, border) < 0.05) continue;
            const int winding = windingByAngle(polygon, q);
            EXPECT_EQ(path.contains(q), winding != 0);
            EXPECT_EQ(path.contains(q, FillRule::EvenOdd), winding % 2 != 0);
            inside += winding != 0;
            ++compared;
        }
    }
    EXPECT_GT(compared, 2000);
    EXPECT_GT(inside, 300);
}

TEST(PathTest, InsideIsRightOnTheHeightOfCornersAndExtrema)
{
    // Rays through corners, along horizontal edges and touching extrema, where naive crossing counts go wrong.
    const Path diamond = Path::polygon(std::vector<Vec2>{{0, -10}, {10, 0}, {0, 10}, {-10, 0}});
    EXPECT_TRUE(diamond.contains({0, 0}));
    EXPECT_FALSE(diamond.contains({-11, 0}));
    EXPECT_FALSE(diamond.contains({-5, -10}));
    EXPECT_FALSE(diamond.contains({-5, 10}));
    const Path round = circle(10);
    for (const double y : {-10.0, 0.0, 10.0}) {
        EXPECT_FALSE(round.contains({-20, y}));
        EXPECT_FALSE(round.contains({20, y}));
    }
    EXPECT_TRUE(round.contains({0, 0}));
    const Path step = Path::polygon(std::vector<Vec2>{{0, 0}, {4, 0}, {4, 2}, {8, 2}, {8, 4}, {0, 4}});
    EXPECT_TRUE(step.contains({2, 2}));
    EXPECT_FALSE(step.contains({-2, 2}));
    EXPECT_FALSE(step.contains({-2, 4}));
    EXPECT_FALSE(step.contains({5, 1}));
    // Two arches that only touch the ray with their tops.
    const Path arches = parsed("M 0 10 C 0 -10 10 -10 10 10 Z M 20 10 C 20 -10 30 -10 30 10 Z");
    EXPECT_FALSE(arches.contains({-5, arches.bounds().min.y()}));
    EXPECT_TRUE(arches.contains({5, 5}));
    EXPECT_FALSE(arches.contains({15, 5}));
}

TEST(PathTest, AHoleIsInsideOrNotByTheFillRule)
{
    Path ring = circle(10);
    ring.contours().push_back(circle(5).contours()[0]);
    EXPECT_TRUE(ring.contains({0, 0}, FillRule::NonZero));
    EXPECT_FALSE(ring.contains({0, 0}, FillRule::EvenOdd));
    EXPECT_TRUE(ring.contains({7, 0}, FillRule::EvenOdd));
    ring.contours()[1] = circle(5).reversed().contours()[0];
    EXPECT_FALSE(ring.contains({0, 0}, FillRule::NonZero));
}

TEST(PathTest, OpenContoursAreFilledAsIfClosed)
{
    const Path open = Path::polygon(std::vector<Vec2>{{0, 0}, {10, 0}, {10, 10}}, false);
    EXPECT_TRUE(open.contains({8, 2}));
    EXPECT_FALSE(open.contains({2, 8}));
}

TEST(PathTest, NothingContainsANaN)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(circle().contains({nan, 0}));
    EXPECT_FALSE(circle().contains({0, nan}));
}

TEST(PathTest, TheNearestPlaceIsOnTheNearestOfAllCurves)
{
    Random random(50);
    for (int i = 0; i < 40; ++i) {
        const Path path({randomContour(random, 5), randomContour(random, 3)});
        const Vec2 q = random.point(200);
        double best = std::numeric_limits<double>::infinity();
        for (const Contour& contour : path.contours())
            for (const Vec2& p : sampled(contour, 2000)) best = std::min(best, distance(p, q));
        const PathPosition place = path.nearest(q);
        EXPECT_LE(place.distance, best + 1e-12);
        EXPECT_EQ(place.point, path.contours()[place.contour].curve(place.curve).at(place.t));
        EXPECT_NEAR(place.distance, distance(place.point, q), 1e-12);
    }
    EXPECT_EQ(parsed("M 3 4").nearest({0, 0}).distance, 5);
}

TEST(PathTest, ANaNOrInfinityMakesAPathNotFinite)
{
    EXPECT_TRUE(circle().isFinite());
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Path path = circle();
        path.segment(2).in.y() = bad;
        EXPECT_FALSE(path.isFinite());
    }
}

// --- editing

TEST(PathTest, SplittingACurveKeepsTheShape)
{
    Random random(60);
    for (int i = 0; i < 50; ++i) {
        Path path({randomContour(random, 4)});
        const Path before = path;
        const std::size_t curve = random.index(4);
        const double t = random.real(0, 1);
        path.split(0, curve, t);
        ASSERT_EQ(path.segmentCount(), 5u);
        EXPECT_NEAR(path.area(), before.area(), 1e-9);
        EXPECT_NEAR(path.length(), before.length(), 1e-7);
        for (const Vec2& p : sampled(before.contours()[0], 10)) EXPECT_LT(path.nearest(p).distance, 1e-10);
    }
}

TEST(PathTest, SplittingASideGivesACorner)
{
    Path path = Path::rectangle(Box({0, 0}, {8, 8}));
    path.split(0, 3, 0.5);
    EXPECT_EQ(path.text(), "M 0 0 L 8 0 L 8 8 L 0 8 L 0 4 Z");
}

TEST(PathTest, SplittingSharesOutTheIntermediatePoints)
{
    struct Case {
        double t;
        int left, right;
    };
    // Four points at 0.2, 0.4, 0.6, 0.8; the one at t itself becomes the segment.
    for (const Case& c : {Case{0, 0, 4}, Case{0.1, 0, 4}, Case{0.5, 2, 2}, Case{0.4, 1, 2}, Case{1, 4, 0}}) {
        Path path = Path::line({0, 0}, {10, 0});
        path.setIntermediate(4);
        path.split(0, 0, c.t);
        EXPECT_EQ(path.segment(0).intermediate, c.left) << c.t;
        EXPECT_EQ(path.segment(1).intermediate, c.right) << c.t;
    }
}

TEST(PathTest, ReversingTwiceIsTheSamePath)
{
    Random random(70);
    for (const bool closed : {false, true}) {
        Contour contour = randomContour(random, 5);
        contour.closed = closed;
        for (int i = 0; i < 5; ++i) contour.segments[static_cast<std::size_t>(i)].intermediate = i + 1;
        const Path path({contour});
        EXPECT_TRUE(sameBits(path.reversed().reversed(), path));
        std::vector<Vec2> forward = path.polygonized()[0].points, backward = path.reversed().polygonized()[0].points;
        ASSERT_EQ(forward.size(), backward.size());
        std::reverse(forward.begin() + closed, forward.end());
        for (std::size_t i = 0; i < forward.size(); ++i) EXPECT_LT(distance(forward[i], backward[i]), 1e-12);
    }
}

TEST(PathTest, TransformingSomeSegmentsMovesOnlyThemAndEachOnce)
{
    Path path = circle(10);
    path.contours().push_back(Path::rectangle(Box({0, 0}, {1, 1})).contours()[0]);
    const Path before = path;
    path.transform(Affine::translation({5, 7}), std::vector<std::size_t>{6, 1, 6});
    for (std::size_t i = 0; i < path.segmentCount(); ++i) {
        const Vec2 by = i == 1 || i == 6 ? Vec2(5, 7) : Vec2(0, 0);
        EXPECT_EQ(path.segment(i).point, before.segment(i).point + by) << i;
        EXPECT_EQ(path.segment(i).in, before.segment(i).in + by) << i;
        EXPECT_EQ(path.segment(i).out, before.segment(i).out + by) << i;
    }
}

TEST(PathTest, TransformingScalesAreaByTheDeterminant)
{
    Random random(80);
    const Path path({randomContour(random, 5)});
    const Affine map = Affine::fromSvg(1.5, 0.5, -0.25, 2, 30, -10);
    EXPECT_NEAR(path.transformed(map).area(), path.area() * map.linear().determinant(), 1e-8);
}

// --- polylines

TEST(PathTest, FlatteningStaysWithinTheTolerance)
{
    Random random(90);
    std::vector<Cubic> curves;
    for (int i = 0; i < 40; ++i) curves.push_back(random.cubic());
    for (const auto& [name, c] : awkwardCubics())
        if (name != "huge") curves.push_back(c);
    for (const Cubic& c : curves)
        for (const double tolerance : {1.0, 0.05}) {
            const Path path = single(c);
            const std::vector<Polyline> lines = path.flatten(tolerance);
            ASSERT_EQ(lines.size(), 1u);
            for (int k = 0; k <= 500; ++k)
                EXPECT_LE(distanceToPolyline(c.at(k / 500.0), lines[0]), tolerance * (1 + 1e-9));
            const auto& points = lines[0].points;
            for (std::size_t i = 0; i + 1 < points.size(); ++i)
                for (const double share : {0.25, 0.5, 0.75}) {
                    const Vec2 q = (1 - share) * points[i] + share * points[i + 1];
                    EXPECT_LE(distance(c.at(c.nearest(q)), q), tolerance * (1 + 1e-9));
                }
        }
}

TEST(PathTest, FlatteningACircleTakesHardlyMorePointsThanItMust)
{
    for (const double tolerance : {1.0, 0.1, 0.01, 0.001}) {
        const double fewest = pi / std::acos(1 - tolerance / 100);  // chords with a sagitta of the tolerance
        const std::vector<Polyline> lines = circle(100).flatten(tolerance);
        EXPECT_LE(static_cast<double>(lines[0].points.size()), 1.12 * fewest + 4) << tolerance;
    }
}

TEST(PathTest, FlatteningALineTakesItsEnds)
{
    EXPECT_EQ(Path::line({0, 0}, {1e9, 1}).flatten(1e-9)[0].points.size(), 2u);
    EXPECT_EQ(Path::rectangle(Box({0, 0}, {1, 1})).flatten(1e-9)[0].points.size(), 4u);
    EXPECT_EQ(parsed("M 5 5 L 5 5 L 5 5").flatten(0.1)[0].points.size(), 1u);
}

TEST(PathTest, FlatteningAHugeOrBrokenCurveGivesALimitedNumberOfPoints)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), big = 1e300;
    for (const Cubic& c : {Cubic{{Vec2(0, 0), Vec2(big, 3 * big), Vec2(-big, big), Vec2(big, 0)}},
                           Cubic{{Vec2(0, 0), Vec2(1e9, 3e9), Vec2(-2e9, 1e9), Vec2(1e9, 0)}},
                           Cubic{{Vec2(0, 0), Vec2(nan, 1), Vec2(2, 2), Vec2(3, 0)}}}) {
        EXPECT_LE(single(c).flatten(1e-6)[0].points.size(), 4097u);
    }
}

TEST(PathTest, APolygonGoesThroughSegmentsAndIntermediatePointsEvenlyInT)
{
    Path path = circle();
    path.setIntermediate(3);
    const Polyline polygon = path.polygonized()[0];
    EXPECT_TRUE(polygon.closed);
    ASSERT_EQ(polygon.points.size(), 16u);
    for (std::size_t i = 0; i < 16; ++i)
        EXPECT_EQ(polygon.points[i], path.contours()[0].curve(i / 4).at(static_cast<double>(i % 4) / 4));

    Path open = Path::line({0, 0}, {4, 0});
    open.setIntermediate(1);
    EXPECT_EQ(open.polygonized()[0].points.size(), 3u);  // no curve starts at the last segment
    open.setIntermediate(2'000'000'000);
    EXPECT_EQ(open.segment(0).intermediate, kMaxIntermediate);
}

// --- text

TEST(PathTest, TextIsSvgPathDataWithTheIntermediateCountsAfterIt)
{
    Path path = Path::polygon(std::vector<Vec2>{{0, 0}, {10, 0}, {10, 5.5}});
    EXPECT_EQ(path.text(), "M 0 0 L 10 0 L 10 5.5 Z");
    path.setIntermediate(2);
    EXPECT_EQ(path.text(), "M 0 0 L 10 0 L 10 5.5 Z n 2 2 2");
    EXPECT_EQ(Path().text(), "");
}

TEST(PathTest, TextReadsBackBitForBit)
{
    Random random(100);
    for (int i = 0; i < 500; ++i) {
        Path path;
        const std::size_t contours = random.index(4);
        for (std::size_t c = 0; c < contours; ++c) {
            Contour contour = randomContour(random, 1 + random.index(5));
            contour.closed = random.index(2) == 0;  // open ones have control points no curve uses
            for (Segment& s : contour.segments) {
                if (random.index(5) == 0) s.intermediate = static_cast<int>(random.index(kMaxIntermediate + 1));
                if (random.index(6) == 0) s.point = s.in = s.out = contour.segments.front().point;
                if (random.index(6) == 0) s = Segment(Vec2(-0.0, 0.0), s.in, Vec2(0.0, -0.0));
                if (random.index(9) == 0) s.out = Vec2(5e-324, -1.7976931348623157e308);
            }
            path.contours().push_back(contour);
        }
        EXPECT_TRUE(sameBits(parsed(path.text()), path)) << path.text();
    }
}

TEST(PathTest, AnyFiniteBitsReadBackUnchanged)
{
    Random random(110);
    const auto any = [&] {
        double value = 0;
        do value = std::bit_cast<double>(random.bits());
        while (!std::isfinite(value));
        return value;
    };
    for (int i = 0; i < 2000; ++i) {
        Path path;
        path.moveTo({any(), any()});
        path.cubicTo({any(), any()}, {any(), any()}, {any(), any()});
        EXPECT_TRUE(sameBits(parsed(path.text()), path)) << path.text();
    }
}

TEST(PathTest, EverySvgCommandIsRead)
{
    const std::vector<std::pair<std::string, std::string>> cases{
        {"m 1 2 3 4 l 1 1", "M 1 2 L 4 6 L 5 7"},
        {"M 1 2 3 4", "M 1 2 L 3 4"},
        {"M1 2H5V7h-1v-2", "M 1 2 L 5 2 L 5 7 L 4 7 L 4 5"},
        {"M0 0H1 2 3", "M 0 0 L 1 0 L 2 0 L 3 0"},
        {"M0 0c1 2 3 4 5 6", "M 0 0 C 1 2 3 4 5 6"},
        {"M0 0C0 5 5 5 5 0S10-5 10 0", "M 0 0 C 0 5 5 5 5 0 C 5 -5 10 -5 10 0"},
        {"M0 0 5 0s1 1 2 2", "M 0 0 L 5 0 C 5 0 6 1 7 2"},
        {"M0 0Q3 3 6 0t6 0", "M 0 0 C 2 2 4 2 6 0 C 8 -2 10 -2 12 0"},
        {"M0 0T6 0", "M 0 0 C 0 0 2 0 6 0"},
        {"M0 0Q3 3 6 0L7 0T10 0", "M 0 0 C 2 2 4 2 6 0 L 7 0 C 7 0 8 0 10 0"},
        {"M1 1L2 2zl1 0z", "M 1 1 L 2 2 Z M 1 1 L 2 1 Z"},
        {"M1 1L2 2zm1 0l1 0", "M 1 1 L 2 2 Z M 2 1 L 3 1"},
        {"M1 1zz", "M 1 1 Z"},
        {"M1.5.5-1-2", "M 1.5 0.5 L -1 -2"},
        {"M1e2,1E-1+3.e0,.5", "M 100 0.1 L 3 0.5"},
        {" \t\r\nM\n1,\n2 ", "M 1 2"},
        {"M0,0L1,1,2,2", "M 0 0 L 1 1 L 2 2"},
        {"", ""},
        {"  ", ""},
    };
    for (const auto& [source, expected] : cases) EXPECT_EQ(parsed(source).text(), expected) << source;
}

TEST(PathTest, ArcFlagsNeedNoSeparators)
{
    const Path spaced = parsed("M 0 0 a 1 1 0 0 1 0.5 0.5");
    EXPECT_EQ(parsed("M0,0a1,1 0 01.5.5"), spaced);
    EXPECT_EQ(parsed("M0 0a1 1 0 0,1,.5,.5"), spaced);
    EXPECT_EQ(parsed("M0 0a1 1 0 01.5.5 1 1 0 10-1-1").contours()[0].curveCount(), 4u);
    EXPECT_NEAR(spaced.contours()[0].segments.back().point.x(), 0.5, 0);
}

TEST(PathTest, AnArcRotationIsInDegreesInText)
{
    Path path;
    path.moveTo({0, 0});
    path.arcTo({4, 2}, pi / 6, false, true, {3, 3});
    EXPECT_LT(distance(parsed("M 0 0 A 4 2 30 0 1 3 3").segment(1).in, path.segment(1).in), 1e-14);
}

TEST(PathTest, AnErrorSaysWhatWasExpectedAndWhere)
{
    struct Case {
        std::string text, word;
        int column;
        std::string prefix;  ///< what SVG wants drawn all the same
    };
    const std::vector<Case> cases{
        {"L 1 1", "M or m", 1, ""},
        {"M 1", "a number", 4, ""},
        {"M 0 0 L 1 x", "a number", 11, "M 0 0"},
        {"M 0 0 L 1 1 2", "a number", 14, "M 0 0 L 1 1"},
        {"M 0 0 L 1 1,", "a number", 13, "M 0 0 L 1 1"},
        {"M 0 0,,1 1", "a number", 7, "M 0 0"},
        {"M ,0 0", "a number", 3, ""},
        {"M 0 0 X 1 1", "a command", 7, "M 0 0"},
        {"M 0 0 L 1 1 Z 5", "a command", 15, "M 0 0 L 1 1 Z"},
        {"M 0 0 A 1 1 0 2 1 5 5", "arc flag", 15, "M 0 0"},
        {"M 0 0 L nan 0", "a number", 9, "M 0 0"},
        {"M 0 0 L inf 0", "a number", 9, "M 0 0"},
        {"M 0 0 L 1e999 0", "below 1.8e308", 9, "M 0 0"},
        {"M 0 0 L - 0", "complete", 9, "M 0 0"},
        {"M 1e308 0 l 1 1 1e308 0", "add up", 17, "M 1e+308 0 L 1e+308 1"},
        {"M -1e308 0 Q 1e308 0 1e308 1", "differences", 14, "M -1e+308 0"},
        {"M 0 0 L 1 1 n 1", "a count", 16, "M 0 0 L 1 1 n 1 0"},
        {"M 0 0 n 1001", "a count", 9, "M 0 0"},
        {"M 0 0 n -1", "a count", 9, "M 0 0"},
        {"M 0 0 n 1 L 1 1", "its end", 11, "M 0 0 n 1"},
        {"M 0 0 i 1 5 5", "open contour", 9, "M 0 0"},
        {"M 0 0 Z o 0 5 5", "open contour", 11, "M 0 0 Z"},
        {"M 0 0 i 0 5 5 L 1 1", "its end", 15, "M 0 0 i 0 5 5"},
        {"M 0 0 \x01", "unprintable", 7, "M 0 0"},
        {std::string("M 0 0\0L 1 1", 11), "unprintable", 6, "M 0 0"},
    };
    for (const Case& c : cases) {
        const Result<Path> path = Path::parse(c.text);
        ASSERT_FALSE(path) << c.text;
        EXPECT_NE(path.error().message.find(c.word), std::string::npos) << c.text << ": " << path.error().message;
        EXPECT_EQ(path.error().where.column, c.column) << c.text << ": " << path.error().message;
        Error problem;
        EXPECT_EQ(Path::parsePrefix(c.text, &problem).text(), c.prefix) << c.text;
        EXPECT_EQ(problem.message, path.error().message);
    }
}

TEST(PathTest, APrefixWithoutErrorLeavesNoMessage)
{
    Error problem("old");
    EXPECT_EQ(Path::parsePrefix("M 1 2", &problem).text(), "M 1 2");
    EXPECT_EQ(problem.message, "");
    EXPECT_EQ(Path::parsePrefix("M 1 2 #").text(), "M 1 2");
}

TEST(PathTest, RandomBytesAreReadOrRefusedAndWhatIsReadIsFinite)
{
    const std::string_view alphabet = "MmLlHhVvCcSsQqTtAaZznio0123456789.,-+eE \n\t\"x";
    Random random(120);
    for (int i = 0; i < 20000; ++i) {
        std::string text = "M 1 1";
        for (std::size_t n = random.index(40); n > 0; --n) text += alphabet[random.index(alphabet.size())];
        const Path path = Path::parsePrefix(text);
        EXPECT_TRUE(path.isFinite()) << text;
        EXPECT_TRUE(sameBits(parsed(path.text()), path)) << text;
    }
}

TEST(PathTest, AHundredThousandShapesAreWrittenAndReadQuickly)
{
    Random random(130);
    std::vector<Path> shapes;
    for (int i = 0; i < 100'000; ++i) shapes.push_back(Path::ellipse(Box(random.point(), random.point())));
    const auto start = std::chrono::steady_clock::now();
    std::size_t equal = 0, bytes = 0;
    for (const Path& shape : shapes) {
        const std::string text = shape.text();
        bytes += text.size();
        const Result<Path> read = Path::parse(text);
        equal += read && *read == shape;
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(equal, shapes.size());
    RecordProperty("seconds", std::to_string(seconds.count()));
    RecordProperty("megabytes", std::to_string(static_cast<double>(bytes) / 1e6));
}

}  // namespace
}  // namespace jet
