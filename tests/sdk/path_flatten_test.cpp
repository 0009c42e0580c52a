#include "geometry_samples.hpp"

#include <numbers>

namespace jet {
namespace {

using std::numbers::pi;
using test::awkwardCubics;
using test::circle;
using test::distance;
using test::distanceToPolyline;
using test::parsed;
using test::Random;
using test::single;

TEST(PathFlattenTest, FlatteningStaysWithinTheTolerance)
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

TEST(PathFlattenTest, FlatteningACircleTakesHardlyMorePointsThanItMust)
{
    for (const double tolerance : {1.0, 0.1, 0.01, 0.001}) {
        const double fewest = pi / std::acos(1 - tolerance / 100);  // chords with a sagitta of the tolerance
        const std::vector<Polyline> lines = circle(100).flatten(tolerance);
        EXPECT_LE(static_cast<double>(lines[0].points.size()), 1.12 * fewest + 4) << tolerance;
    }
}

TEST(PathFlattenTest, FlatteningALineTakesItsEnds)
{
    EXPECT_EQ(Path::line({0, 0}, {1e9, 1}).flatten(1e-9)[0].points.size(), 2u);
    EXPECT_EQ(Path::rectangle(Box({0, 0}, {1, 1})).flatten(1e-9)[0].points.size(), 4u);
    EXPECT_EQ(parsed("M 5 5 L 5 5 L 5 5").flatten(0.1)[0].points.size(), 1u);
}

TEST(PathFlattenTest, FlatteningAHugeOrBrokenCurveGivesALimitedNumberOfPoints)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), big = 1e300;
    for (const Cubic& c : {Cubic{{Vec2(0, 0), Vec2(big, 3 * big), Vec2(-big, big), Vec2(big, 0)}},
                           Cubic{{Vec2(0, 0), Vec2(1e9, 3e9), Vec2(-2e9, 1e9), Vec2(1e9, 0)}}}) {
        EXPECT_LE(single(c).flatten(1e-6)[0].points.size(), 4097u);
    }
    const Cubic broken{{Vec2(0, 0), Vec2(nan, 1), Vec2(2, 2), Vec2(3, 0)}};
    EXPECT_EQ(single(broken).flatten(1e-6)[0].points.size(), 2u);
}

TEST(PathFlattenTest, APolygonGoesThroughSegmentsAndIntermediatePointsEvenlyInT)
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

TEST(PathFlattenTest, IntermediatePointsOfAStraightSideAreEvenAlongIt)
{
    Path path = Path::rectangle(Box({0, 0}, {100, 40}));
    path.setIntermediate(3);
    const auto points = path.polygonized()[0].points;
    ASSERT_EQ(points.size(), 16u);
    for (std::size_t i = 0; i < 16; ++i)
        EXPECT_DOUBLE_EQ(distance(points[i], points[(i + 1) % 16]), i / 4 % 2 == 0 ? 25 : 10) << i;
}

TEST(PathFlattenTest, SplittingAStraightSideKeepsItsIntermediatePointsOnTheirSides)
{
    for (const double t : {0.1, 0.3, 0.5, 0.77}) {
        Path path = Path::line({0, 0}, {100, 0});
        path.segment(0).intermediate = 9;  // every 10
        const double at = path.contours()[0].curve(0).at(t).x();
        path.split(0, 0, t);
        EXPECT_EQ(path.segment(0).intermediate, static_cast<int>(std::ceil(at / 10)) - 1) << t;
        EXPECT_EQ(path.segment(1).intermediate, 9 - static_cast<int>(std::floor(at / 10))) << t;
    }
}

}  // namespace
}  // namespace jet
