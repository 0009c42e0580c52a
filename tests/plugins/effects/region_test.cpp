#include "region.hpp"

#include <gtest/gtest.h>

namespace {

using jet::Box;
using jet::Vec2;
using jet::lattice::Region;
using jet::lattice::Ring;

Ring boxRing(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

// A square with a square hole; and an L, whose inner corner is at (10, 10).
const Region kFrame({boxRing(0, 0, 30, 30), boxRing(10, 10, 20, 20)});
const Region kEll({{{0, 0}, {10, 0}, {10, 10}, {30, 10}, {30, 30}, {0, 30}}});

TEST(Region, ARingWithinARingIsAHole)
{
    EXPECT_TRUE(kFrame.contains({5, 15}));
    EXPECT_FALSE(kFrame.contains({15, 15}));
    EXPECT_FALSE(kFrame.contains({31, 15}));
    EXPECT_NEAR(kFrame.area(), 30 * 30 - 10 * 10, 1);
}

TEST(Region, ARayThroughCornersCountsEachOnce)
{
    const Region diamond({{{10, 0}, {20, 10}, {10, 20}, {0, 10}}});
    EXPECT_TRUE(diamond.contains({10, 10}));  // level with two corners
    EXPECT_FALSE(diamond.contains({-5, 10}));
    EXPECT_FALSE(diamond.contains({25, 10}));
    EXPECT_FALSE(diamond.contains({-5, 0}));
}

TEST(Region, ASegmentAcrossAHoleLeavesTheRegion)
{
    EXPECT_FALSE(kFrame.holds({5, 15}, {25, 15}));
    EXPECT_TRUE(kFrame.holds({5, 5}, {25, 5}));
    EXPECT_FALSE(kFrame.holds({5, 15}, {15, 15})) << "ends in the hole";
}

TEST(Region, ASegmentMayRunAlongWallsAndTouchThem)
{
    EXPECT_TRUE(kFrame.holds({0, 0}, {30, 0}));
    EXPECT_TRUE(kFrame.holds({10, 10}, {20, 10})) << "along the hole";
    EXPECT_TRUE(kFrame.holds({0, 0}, {10, 10})) << "up to the hole's corner";
    EXPECT_TRUE(kEll.holds({0, 20}, {20, 10}));
}

TEST(Region, ASegmentThroughACornerIntoTheOpenLeavesTheRegion)
{
    // Both pass through (10, 10) without properly crossing either of its walls.
    EXPECT_FALSE(kEll.holds({0, 20}, {20, 0}));
    EXPECT_FALSE(kFrame.holds({0, 0}, {15, 15}));
    EXPECT_FALSE(kFrame.holds({0, 0}, {30, 30}));
    EXPECT_FALSE(kEll.holds({10, 0}, {30, 10})) << "over the L's open corner";
}

TEST(Region, AllIsTheSameFarFromTheOriginAndAtOtherScales)
{
    for (const double scale : {1e-3, 1.0, 1e4}) {
        const Vec2 shift = scale * Vec2(1000, -2000);
        Ring ring;
        for (const Vec2& p : {Vec2(0, 0), Vec2(10, 0), Vec2(10, 10), Vec2(30, 10), Vec2(30, 30), Vec2(0, 30)})
            ring.push_back(scale * p + shift);
        const Region region({ring});
        const auto holds = [&](Vec2 a, Vec2 b) { return region.holds(scale * a + shift, scale * b + shift); };
        EXPECT_TRUE(holds({0, 30}, {10, 10})) << scale;
        EXPECT_TRUE(holds({10, 10}, {30, 10})) << scale;
        EXPECT_FALSE(holds({10, 0}, {30, 10})) << scale;
        EXPECT_FALSE(holds({0, 20}, {20, 0})) << scale;
    }
}

TEST(Region, DistanceToWallsIsMeasuredAsAnEllipse)
{
    EXPECT_TRUE(kFrame.hasWallWithin({5, 5}, {6, 1}));
    EXPECT_FALSE(kFrame.hasWallWithin({5, 5}, {4, 4}));
    EXPECT_TRUE(kFrame.hasWallWithin({5, 5}, {1, 6}));
    EXPECT_FALSE(kFrame.hasWallWithin({8, 8}, {2.5, 2.5})) << "the hole's corner is 2√2 away";
}

}  // namespace
