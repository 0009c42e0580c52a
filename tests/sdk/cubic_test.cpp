#include "geometry_samples.hpp"

namespace jet {
namespace {

using test::awkwardCubics;
using test::cpuSeconds;
using test::cuspCubic;
using test::distance;
using test::Random;

constexpr int kRandomCurves = 300;

double extent(const Cubic& c)
{
    double size = 0;
    for (const Vec2& p : c.p) size = std::max(size, distance(p, c.p[0]));
    return size;
}

TEST(CubicTest, StartsAndEndsExactlyAtItsEnds)
{
    Random random(1);
    for (int i = 0; i < kRandomCurves; ++i) {
        const Cubic c = random.cubic();
        EXPECT_EQ(c.at(0), c.p[0]);
        EXPECT_EQ(c.at(1), c.p[3]);
    }
}

TEST(CubicTest, DerivativeIsTheLimitOfTheDifferenceQuotient)
{
    Random random(2);
    const double h = 1e-5;
    for (int i = 0; i < kRandomCurves; ++i) {
        const Cubic c = random.cubic();
        const double t = random.real(h, 1 - h);
        const Vec2 quotient = (c.at(t + h) - c.at(t - h)) / (2 * h);
        EXPECT_LT(distance(c.derivative(t), quotient), 1e-6);
    }
}

TEST(CubicTest, ARaisedQuadraticHasThePointsOfTheQuadratic)
{
    const Vec2 a(1, 2), b(7, -3), control(4, 11);
    const Cubic c = Cubic::quadratic(a, control, b);
    for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
        const Vec2 quadratic = (1 - t) * (1 - t) * a + 2 * t * (1 - t) * control + t * t * b;
        EXPECT_LT(distance(c.at(t), quadratic), 1e-14);
    }
}

TEST(CubicTest, BoundsAreTheTightBoxOfTheCurve)
{
    Random random(3);
    for (int i = 0; i < kRandomCurves; ++i) {
        const Cubic c = random.cubic();
        Box sampled;
        for (int k = 0; k <= 4000; ++k) sampled.extend(c.at(k / 4000.0));
        const Box box = c.bounds();
        EXPECT_TRUE(box.inflated(1e-12).contains(sampled));
        EXPECT_TRUE(sampled.inflated(1e-4).contains(box));  // samples miss an extremum by h²/8 |P''|
    }
}

TEST(CubicTest, SplittingGivesTwoCurvesWithTheSamePoints)
{
    Random random(4);
    for (int i = 0; i < kRandomCurves; ++i) {
        const Cubic c = random.cubic();
        const double t = random.real(0, 1);
        const auto [left, right] = c.split(t);
        EXPECT_EQ(left.p[0], c.p[0]);
        EXPECT_EQ(left.p[3], right.p[0]);
        EXPECT_EQ(right.p[3], c.p[3]);
        for (const double s : {0.2, 0.5, 0.9}) {
            EXPECT_LT(distance(left.at(s), c.at(s * t)), 1e-12);
            EXPECT_LT(distance(right.at(s), c.at(t + s * (1 - t))), 1e-12);
        }
    }
}

TEST(CubicTest, LengthOfAParabolaIsItsClosedForm)
{
    // y = x² for x in [0, 1]: sqrt(5)/2 + asinh(2)/4.
    const Cubic parabola = Cubic::quadratic({0, 0}, {0.5, 0}, {1, 1});
    EXPECT_NEAR(parabola.length(), std::sqrt(5.0) / 2 + std::asinh(2.0) / 4, 1e-11);
}

TEST(CubicTest, LengthGoesThroughACuspToFullPrecision)
{
    const double exact = 2 * (std::pow(13, 1.5) - 8) / 27;
    EXPECT_NEAR(cuspCubic().length(), exact, 1e-10 * exact);
    EXPECT_NEAR(cuspCubic().length(0, 0.3) + cuspCubic().length(0.3, 1), exact, 1e-10 * exact);
}

TEST(CubicTest, LengthOfAPieceSmallerThanTheRoundingAtACuspTakesNoLonger)
{
    const Cubic c = cuspCubic().split(0.37)[1];  // the speed near its cusp, at t = 0.13/0.63, is all rounding error
    const double start = cpuSeconds();
    double sum = 0;
    for (int i = 0; i < 1000; ++i) sum += c.length(0.13 / 0.63 - 1e-12, 0.13 / 0.63 + 1e-12);
    EXPECT_LT(cpuSeconds() - start, 2.0);                           // it took over 20 without the guard
    EXPECT_NEAR(sum / 1000, 2 * std::pow(2 * 0.63e-12, 2), 1e-26);  // x = s², to the tip and back
}

TEST(CubicTest, LengthOfALineThereAndBackCountsBothWays)
{
    // Control values 0, 40, -20, 20: x turns where 4 - 20 t + 20 t² = 0, at t = (5 ∓ √5)/10.
    const Cubic c{{Vec2(0, 0), Vec2(40, 0), Vec2(-20, 0), Vec2(20, 0)}};
    const double t1 = (5 - std::sqrt(5.0)) / 10, t2 = (5 + std::sqrt(5.0)) / 10;
    ASSERT_NEAR(c.derivative(t1).x(), 0, 1e-12);
    ASSERT_NEAR(c.derivative(t2).x(), 0, 1e-12);
    const double exact = c.at(t1).x() + (c.at(t1).x() - c.at(t2).x()) + (20 - c.at(t2).x());
    EXPECT_NEAR(c.length(), exact, 1e-10 * exact);
}

TEST(CubicTest, LengthAgreesWithAFinePolygon)
{
    Random random(5);
    for (int i = 0; i < 50; ++i) {
        const Cubic c = random.cubic();
        const auto polygon = [&](int n) {
            double sum = 0;
            for (int k = 0; k < n; ++k) sum += distance(c.at(static_cast<double>(k) / n), c.at((k + 1.0) / n));
            return sum;
        };
        const double coarse = polygon(4000), fine = polygon(8000);
        const double extrapolated = fine + (fine - coarse) / 3;  // the error falls with the square of the step
        EXPECT_NEAR(c.length(), extrapolated, 1e-6 * extrapolated);
    }
}

TEST(CubicTest, LengthsOfPartsAddUp)
{
    Random random(6);
    std::vector<Cubic> curves;
    for (int i = 0; i < kRandomCurves; ++i) curves.push_back(random.cubic());
    for (const auto& [name, c] : awkwardCubics()) curves.push_back(c);
    for (const Cubic& c : curves) {
        const double t = random.real(0, 1), whole = c.length();
        EXPECT_NEAR(c.length(0, t) + c.length(t, 1), whole, 2e-10 * whole);
        EXPECT_EQ(c.length(1, 0), whole);
    }
}

TEST(CubicTest, LengthNeitherOverflowsNorVanishes)
{
    const auto curves = awkwardCubics();
    const Cubic &huge = curves[curves.size() - 2].second, &tiny = curves.back().second;
    EXPECT_TRUE(std::isfinite(huge.length()));
    EXPECT_NEAR(huge.length() / 1e200, tiny.length() / 1e-200, 1e-9);
}

TEST(CubicTest, NearestIsNoFartherThanAnyOfManySamples)
{
    Random random(7);
    std::vector<Cubic> curves;
    for (int i = 0; i < kRandomCurves; ++i) curves.push_back(random.cubic());
    for (const auto& [name, c] : awkwardCubics())
        if (name != "tiny") curves.push_back(c);
    for (const Cubic& c : curves) {
        const double size = std::max(extent(c), 1.0);
        for (int k = 0; k < 10; ++k) {
            const Vec2 q = c.p[0] + random.point(2 * size);
            double sampled = std::numeric_limits<double>::infinity();
            for (int s = 0; s <= 2000; ++s) sampled = std::min(sampled, distance(c.at(s / 2000.0), q));
            const double t = c.nearest(q);
            EXPECT_TRUE(t >= 0 && t <= 1);
            EXPECT_LE(distance(c.at(t), q), sampled + 1e-13 * size);
        }
    }
}

TEST(CubicTest, NearestToAPointOnTheCurveIsThatPoint)
{
    Random random(8);
    for (int i = 0; i < kRandomCurves; ++i) {
        const Cubic c = random.cubic();
        const Vec2 q = c.at(random.real(0, 1));
        EXPECT_LT(distance(c.at(c.nearest(q)), q), 1e-11);
    }
}

TEST(CubicTest, NearestFindsTheTipOfACuspToFullPrecision)
{
    // Where both P - q and P' vanish, the quintic has a triple root. The cuts put it at parameters no halving hits.
    for (const double cut : {0.0, 0.1, 0.3, 0.37, 0.41}) {
        const Cubic c = cuspCubic().split(cut)[1];
        EXPECT_LT(distance(c.at(c.nearest({0, 0})), Vec2(0, 0)), 1e-14) << cut;
        EXPECT_NEAR(c.nearest({-5, 0}), (0.5 - cut) / (1 - cut), 1e-12) << cut;
    }
}

TEST(CubicTest, NearestSeesTheFarSideOfANarrowLoop)
{
    // Five extrema of the distance: Newton's method from a coarse sample ends in the wrong one.
    const Cubic c{{Vec2(0, 0), Vec2(100, 60), Vec2(-90, 60), Vec2(10, 0)}};
    for (int i = 0; i <= 100; ++i) {
        const Vec2 q(-5 + 0.2 * i, 8 + 0.3 * i);
        double sampled = std::numeric_limits<double>::infinity();
        for (int s = 0; s <= 20000; ++s) sampled = std::min(sampled, distance(c.at(s / 20000.0), q));
        EXPECT_LE(distance(c.at(c.nearest(q)), q), sampled + 1e-12);
    }
}

TEST(CubicTest, NearestToTheCentreOfACircularArcIsAtTheRadius)
{
    // All of the arc is nearly equally far: the quintic is close to zero everywhere.
    const double k = kEllipseKappa;
    const Cubic quarter{{Vec2(1, 0), Vec2(1, k), Vec2(k, 1), Vec2(0, 1)}};
    EXPECT_NEAR(distance(quarter.at(quarter.nearest({0, 0})), Vec2(0, 0)), 1, 1e-14);
}

TEST(CubicTest, OnlyCurvesThatCoverTheirChordAreLines)
{
    const std::vector<std::string> lines{"corner line", "even line", "point"};
    for (const auto& [name, c] : awkwardCubics())
        EXPECT_EQ(c.isLine(), std::ranges::find(lines, name) != lines.end()) << name;
    EXPECT_TRUE((Cubic{{Vec2(0, 0), Vec2(0.3, 0.1), Vec2(0.6, 0.2), Vec2(3, 1)}}.isLine()));
    EXPECT_FALSE((Cubic{{Vec2(0, 0), Vec2(1, 1e-9), Vec2(2, 0), Vec2(3, 0)}}.isLine()));
}

}  // namespace
}  // namespace jet
