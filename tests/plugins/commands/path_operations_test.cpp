#include "clipper.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace jet::path_operations {
namespace {

constexpr double kPi = std::numbers::pi;
const Path kSquare = Path::rectangle(Box({0, 0}, {10, 10}));
const Path kShifted = Path::rectangle(Box({5, 5}, {15, 15}));
const Path kCircle = Path::ellipse(Box({0, 0}, {20, 20}));

double area(const Path& path) { return path.area(); }

TEST(Combine, TwoSquaresGiveTheAreasOfTheFormulas)
{
    const std::array both{kSquare, kShifted};
    EXPECT_NEAR(area(combine(both, Boolean::Union)), 175, 1e-6);
    EXPECT_NEAR(area(combine(both, Boolean::Difference)), 75, 1e-6);
    EXPECT_NEAR(area(combine(both, Boolean::Intersection)), 25, 1e-6);
    EXPECT_NEAR(area(combine(both, Boolean::Exclusion)), 150, 1e-6);
}

TEST(Combine, CurvesStayCurves)
{
    // A circle of radius 10 without its right half: a half circle.
    const Path half = combine(std::array{kCircle, Path::rectangle(Box({10, -5}, {25, 25}))}, Boolean::Difference);
    ASSERT_EQ(half.contours().size(), 1u);
    EXPECT_LE(half.segmentCount(), 6u);
    EXPECT_NEAR(area(half), area(kCircle) / 2, 1e-2);
    EXPECT_NEAR(area(half), kPi * 50, 0.1);  // the four-segment circle is that good
}

TEST(Combine, NeighboursThatShareASideBecomeOneOutline)
{
    const std::array tiles{kSquare, Path::rectangle(Box({10, 0}, {20, 10}))};
    const Path both = combine(tiles, Boolean::Union);
    EXPECT_EQ(both.contours().size(), 1u);
    EXPECT_NEAR(area(both), 200, 1e-2);
    EXPECT_TRUE(combine(tiles, Boolean::Intersection).isEmpty());
    EXPECT_NEAR(area(combine(tiles, Boolean::Difference)), 100, 1e-2);
    EXPECT_TRUE(combine(std::array{kCircle, kCircle}, Boolean::Difference).isEmpty());
    EXPECT_NEAR(area(combine(std::array{kCircle, kCircle}, Boolean::Union)), area(kCircle), 1e-2);
}

TEST(Combine, AnOutlineThatCrossesItselfIsTakenAsItIsFilled)
{
    const Path bow = Path::polygon(std::array{Vec2(0, 0), Vec2(20, 20), Vec2(20, 0), Vec2(0, 20)});
    const Path half = combine(std::array{bow, Path::rectangle(Box({-1, -1}, {10, 21}))}, Boolean::Intersection);
    EXPECT_NEAR(std::abs(area(half)), 100, 0.5);
}

TEST(Combine, AHoleRunsTheOtherWayAndBothFillRulesAgree)
{
    const Path ring = combine(std::array{kCircle, Path::ellipse(Box({5, 5}, {15, 15}))}, Boolean::Difference);
    ASSERT_EQ(ring.contours().size(), 2u);
    EXPECT_FALSE(ring.contains({10, 10}, FillRule::NonZero));
    EXPECT_FALSE(ring.contains({10, 10}, FillRule::EvenOdd));
    EXPECT_TRUE(ring.contains({2, 10}));
}

TEST(Combine, MoreThanTwoPathsAreTakenOneAfterTheOther)
{
    const Path third = Path::rectangle(Box({-5, -5}, {2, 2}));
    EXPECT_NEAR(area(combine(std::array{kSquare, kShifted, third}, Boolean::Difference)), 75 - 4, 1e-6);
    EXPECT_NEAR(area(combine(std::array{kSquare, kShifted, third}, Boolean::Union)), 175 + 49 - 4, 1e-6);
}

TEST(Combine, ApartPathsKeepBothOrNothing)
{
    const std::array apart{kSquare, Path::rectangle(Box({100, 100}, {110, 110}))};
    EXPECT_EQ(combine(apart, Boolean::Union).contours().size(), 2u);
    EXPECT_TRUE(combine(apart, Boolean::Intersection).isEmpty());
}

TEST(Combine, WorksAtEverySizeAndPlace)
{
    for (const double size : {1e-4, 1.0, 1e6}) {
        for (const Vec2& place : {Vec2(0, 0), Vec2(1e4, -1e4)}) {
            const Affine m = Affine::translation(place * size) * Affine::scaling(Vec2::Constant(size));
            const Path result =
                combine(std::array{kSquare.transformed(m), kCircle.transformed(m)}, Boolean::Intersection);
            const double expected = 100 - (400 - area(kCircle)) / 4;  // the square's corner at 0,0 is cut by the circle
            EXPECT_NEAR(area(result) / (size * size), expected, 1e-3 * expected) << size;
        }
    }
}

// Any result must obey |A ∪ B| + |A ∩ B| = |A| + |B|, or be refused with a sentence.
TEST(Combine, RandomCurvesObeyTheLawOfAreas)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0, 100);
    int refused = 0;
    for (int round = 0; round < 100; ++round) {
        const auto blob = [&] {
            const Vec2 corner(place(random), place(random));
            return Path::ellipse(Box(corner, corner + Vec2(20 + place(random), 20 + place(random))))
                .transformed(Affine::rotation(place(random), corner));
        };
        const std::array both{blob(), blob()};
        try {
            const double sum = area(combine(both, Boolean::Union)) + area(combine(both, Boolean::Intersection));
            EXPECT_NEAR(sum, area(both[0]) + area(both[1]), 1e-3 * sum) << "round " << round;
        } catch (const Failure& failure) {
            EXPECT_NE(failure.error().message.find("Move one of them"), std::string::npos);
            ++refused;
        }
    }
    EXPECT_LE(refused, 2);
}

TEST(Offset, OfASquareIsAsTheFormulaSays)
{
    // Minkowski sum with a disc of radius 2; and what is left 2 inside.
    EXPECT_NEAR(area(offset(kSquare, 2)), 100 + 4 * 10 * 2 + kPi * 4, 0.1);
    EXPECT_NEAR(area(offset(kSquare, -2)), 36, 0.05);
}

TEST(Offset, OfACircleIsACircle)
{
    EXPECT_NEAR(area(offset(kCircle, 3)), kPi * 169, 0.5);
    EXPECT_NEAR(area(offset(kCircle, -3)), kPi * 49, 0.5);
    EXPECT_LE(offset(kCircle, 3).segmentCount(), 16u);
}

TEST(Offset, InwardsByMoreThanThereIsLeavesNothing) { EXPECT_TRUE(offset(kSquare, -6).isEmpty()); }

}  // namespace
}  // namespace jet::path_operations
