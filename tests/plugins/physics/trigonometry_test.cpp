// The portable functions agree with the C library's to the last few bits.
#include "rigid/solver_data.hpp"
#include "trigonometry.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace jet::physics::test {

namespace {

TEST(Trigonometry, ManyDirectionsAtOnceAreThoseOfOneByOneToTheLastBit)
{
    std::vector<double> angles = {0.0, -0.0, 0.25 * kPi, -0.25 * kPi, 1e-300, 9.99e8, -9.99e8};
    for (int i = -4000; i <= 4000; ++i) angles.push_back(0.0371 * i * (1 + i % 7)), angles.push_back(0.5 * kPi * i);
    for (const KernelChoice choice : {KernelChoice::Sse2, KernelChoice::Best}) {
        // Of every count that fills no whole register at the end, too.
        for (std::size_t count = angles.size() - 4; count <= angles.size(); ++count) {
            std::vector<Vec2> found(angles.size());
            ASSERT_TRUE(kernels<float>(choice).turnBodies(angles.data(), found[0].data(), count));
            for (std::size_t i = 0; i < count; ++i) {
                const Vec2 one = direction(angles[i]);
                ASSERT_EQ(std::memcmp(&one, &found[i], sizeof one), 0) << angles[i];
            }
        }
        Vec2 far[3];
        for (const double angle : {1e9, -1e9, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
            const double some[] = {0, angle, 1};
            EXPECT_FALSE(kernels<double>(choice).turnBodies(some, far[0].data(), 3)) << angle;
        }
    }
}

TEST(Trigonometry, DirectionIsCosineAndSine)
{
    for (double angle = -50; angle < 50; angle += 0.0137) {
        EXPECT_NEAR(direction(angle).x(), std::cos(angle), 2e-15);
        EXPECT_NEAR(direction(angle).y(), std::sin(angle), 2e-15);
    }
    EXPECT_NEAR(direction(123456.789).x(), std::cos(123456.789), 1e-12);
    EXPECT_EQ(direction(0), Vec2(1, 0));
    for (const double angle : {1e9 - 1, 1e9 + 1, -3e12, 1e19, -1e300})
        EXPECT_TRUE(direction(angle).allFinite()) << angle;
    EXPECT_NEAR((direction(-1e9 - 1) - Vec2(std::cos(-1e9 - 1), std::sin(-1e9 - 1))).norm(), 0, 1e-6);
}

TEST(Trigonometry, AngleOfIsTheArcTangentInAllQuadrants)
{
    for (double angle = -3.14; angle < 3.14; angle += 0.00731)
        EXPECT_NEAR(angleOf(std::sin(angle), std::cos(angle)), angle, 2e-15);
    EXPECT_EQ(angleOf(0, 0), 0);
    EXPECT_NEAR(angleOf(0, -1), kPi, 1e-15);
    EXPECT_NEAR(angleOf(1e-300, 1), 1e-300, 1e-315);
}

TEST(Trigonometry, DecayIsTheExponential)
{
    for (double x = 0; x < 30; x += 0.0931) EXPECT_NEAR(decay(x), std::exp(-x), 1e-14 + 4e-13 * std::exp(-x));
    EXPECT_EQ(decay(0), 1);
    EXPECT_EQ(decay(-1), 1);
    EXPECT_EQ(decay(1e9), 0);
}

TEST(Trigonometry, WrappedAnglesLieWithinHalfATurn)
{
    EXPECT_NEAR(wrapped(3.5), 3.5 - 2 * kPi, 1e-15);
    EXPECT_NEAR(wrapped(-3.5), 2 * kPi - 3.5, 1e-15);
    EXPECT_EQ(wrapped(0.25), 0.25);
}

}  // namespace

}  // namespace jet::physics::test
