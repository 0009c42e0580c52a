#include "geometry_samples.hpp"

#include <numbers>

namespace jet {
namespace {

using std::numbers::pi;
using test::circle;
using test::distance;
using test::distanceToPolyline;
using test::parsed;
using test::Random;
using test::randomContour;
using test::sampled;
using test::single;

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

TEST(PathQueryTest, BoundsAreThoseOfTheCurvesNotOfTheControlPoints)
{
    const Path arch = single({{Vec2(0, 0), Vec2(0, 4), Vec2(4, 4), Vec2(4, 0)}});
    EXPECT_EQ(arch.bounds(), Box({0, 0}, {4, 3}));
    Path withPoint = arch;
    withPoint.moveTo({-9, 8});
    EXPECT_EQ(withPoint.bounds(), Box({-9, 0}, {4, 8}));
}

TEST(PathQueryTest, AreaIsThatOfAFinePolygon)
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

TEST(PathQueryTest, AreaKeepsItsDigitsFarFromTheOrigin)
{
    Path path = circle();
    const double area = path.area();
    path.transform(Affine::translation({1e8, -1e8}));
    EXPECT_NEAR(path.area(), area, 1e-6);
}

TEST(PathQueryTest, OpenContoursEncloseNoArea)
{
    EXPECT_EQ(Path::polygon(std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}}, false).area(), 0);
}

TEST(PathQueryTest, InsideAgreesWithTheAngleAFinePolygonTurnsThrough)
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

TEST(PathQueryTest, InsideIsRightOnTheHeightOfCornersAndExtrema)
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

TEST(PathQueryTest, AHoleIsInsideOrNotByTheFillRule)
{
    Path ring = circle(10);
    ring.contours().push_back(circle(5).contours()[0]);
    EXPECT_TRUE(ring.contains({0, 0}, FillRule::NonZero));
    EXPECT_FALSE(ring.contains({0, 0}, FillRule::EvenOdd));
    EXPECT_TRUE(ring.contains({7, 0}, FillRule::EvenOdd));
    ring.contours()[1] = circle(5).reversed().contours()[0];
    EXPECT_FALSE(ring.contains({0, 0}, FillRule::NonZero));
}

TEST(PathQueryTest, OpenContoursAreFilledAsIfClosed)
{
    const Path open = Path::polygon(std::vector<Vec2>{{0, 0}, {10, 0}, {10, 10}}, false);
    EXPECT_TRUE(open.contains({8, 2}));
    EXPECT_FALSE(open.contains({2, 8}));
}

TEST(PathQueryTest, NothingContainsANaN)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(circle().contains({nan, 0}));
    EXPECT_FALSE(circle().contains({0, nan}));
}

TEST(PathQueryTest, TheNearestPlaceIsOnTheNearestOfAllCurves)
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

TEST(PathQueryTest, ANaNOrInfinityMakesAPathNotFinite)
{
    EXPECT_TRUE(circle().isFinite());
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Path path = circle();
        path.segment(2).in.y() = bad;
        EXPECT_FALSE(path.isFinite());
    }
}

}  // namespace
}  // namespace jet
