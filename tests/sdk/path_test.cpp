#include "geometry_samples.hpp"

#include <numbers>

namespace jet {
namespace {

using std::numbers::pi;
using test::circle;
using test::distance;
using test::parsed;
using test::Random;
using test::randomContour;
using test::sameBits;
using test::sampled;

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
        Path path;
        path.moveTo({0, 0});
        path.cubicTo({3, 5}, {7, 5}, {10, 0});
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

}  // namespace
}  // namespace jet
