// Outlines cut into convex parts cover the same region: areas add up, and points are in a part or not as before.
#include "convex_parts.hpp"

#include <gtest/gtest.h>

namespace jet::box2d {

namespace {

double areaOf(const std::vector<Ring>& parts)
{
    double sum = 0;
    for (const Ring& part : parts) sum += 0.5 * std::abs(twiceArea(part));
    return sum;
}

Ring circle(const Vec2& centre, double radius, int corners)
{
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        const double angle = 6.283185307179586 * i / corners;
        ring.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return ring;
}

bool turnsOneWay(const Ring& ring)
{
    const double side = twiceArea(ring);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[(i + 1) % ring.size()] - ring[i];
        const Vec2 b = ring[(i + 2) % ring.size()] - ring[(i + 1) % ring.size()];
        if (side * cross(a, b) < -1e-6) return false;
    }
    return true;
}

class ConvexParts : public testing::TestWithParam<Rings> {};

TEST_P(ConvexParts, CoverTheRegionAndNothingElse)
{
    const Rings& rings = GetParam();
    const std::vector<Ring> parts = convexParts(rings);
    for (const Ring& part : parts) {
        EXPECT_GE(part.size(), 3u);
        EXPECT_LE(part.size(), 8u);
        EXPECT_TRUE(turnsOneWay(part));
    }
    int inside = 0;
    for (double x = -49.7; x < 50; x += 1.9)
        for (double y = -49.3; y < 50; y += 1.7) {
            int covered = 0;
            for (const Ring& part : parts) covered += contains({part}, {x, y});
            // Within the tolerance of the cuts a point may fall to either side.
            const bool near = contains(rings, {x + 0.1, y}) != contains(rings, {x - 0.1, y}) ||
                              contains(rings, {x, y + 0.1}) != contains(rings, {x, y - 0.1});
            if (near) continue;
            EXPECT_EQ(covered, contains(rings, {x, y}) ? 1 : 0) << x << ", " << y;
            inside += covered;
        }
    EXPECT_GT(inside, 20);
    EXPECT_NEAR(areaOf(parts), inside * 1.9 * 1.7, 0.25 * areaOf(parts));
}

INSTANTIATE_TEST_SUITE_P(
    Outlines, ConvexParts,
    testing::Values(Rings{{{-20, -20}, {20, -20}, {20, 20}, {-20, 20}}},                      // convex
                    Rings{{{-30, -30}, {30, -30}, {30, 30}, {-10, 30}, {-10, 0}, {-30, 0}}},  // an L
                    Rings{circle({0, 0}, 30, 40)},                                            // more than 8 corners
                    Rings{circle({0, 0}, 40, 24), circle({3, 2}, 20, 12)},                    // with a hole
                    Rings{circle({0, 0}, 45, 24), circle({0, 0}, 30, 12), circle({0, 0}, 15, 8)},  // an island in it
                    Rings{{{-30, -30}, {30, 30}, {30, -30}, {-30, 30}}},                           // a figure eight
                    Rings{{{0, -40}, {24, 32}, {-38, -12}, {38, -12}, {-24, 32}}}));  // a star, drawn in one go

TEST(ConvexPart, ATurnedSquareIsOnePart)
{
    EXPECT_EQ(convexParts({{{0, -20}, {20, 0}, {0, 20}, {-20, 0}}}).size(), 1u);
    EXPECT_EQ(convexParts({{{-30, -30}, {30, -30}, {30, 30}, {-10, 30}, {-10, 0}, {-30, 0}}}).size(), 2u)
        << "an L is two";
}

TEST(ConvexPart, NothingIsLeftOfWhatIsTooThinToCompute)
{
    EXPECT_TRUE(convexParts({{{0, 0}, {100, 0}, {100, 0.01}, {0, 0.01}}}).empty());
    EXPECT_TRUE(convexParts({{{0, 0}, {0.01, 0}, {0, 0.01}}}).empty());
}

TEST(Outline, MomentsOfARingWithAHoleAreThoseOfTheDifference)
{
    const Rings rings{{{0, 0}, {40, 0}, {40, 20}, {0, 20}}, {{5, 5}, {5, 15}, {15, 15}, {15, 5}}};
    const Moments m = momentsOf(rings);
    EXPECT_NEAR(m.area, 700, 1e-9);
    EXPECT_NEAR(m.centroid.x(), (800 * 20 - 100 * 10) / 700.0, 1e-9);
    EXPECT_NEAR(m.centroid.y(), 10, 1e-9);
    const double whole = 800 * (1600 + 400) / 12.0 + 800 * std::pow(20 - m.centroid.x(), 2);
    const double hole = 100 * (100 + 100) / 12.0 + 100 * std::pow(10 - m.centroid.x(), 2);
    EXPECT_NEAR(m.second, (whole - hole) / 700, 1e-9);
}

}  // namespace

}  // namespace jet::box2d
