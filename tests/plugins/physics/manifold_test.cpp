// Touching points of convex parts: four sides are looked at at once, and the axis is the one that each alone would
// give.
#include "rigid/part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace jet::physics::test {

namespace {

struct Sides {
    int count = 0;
    Vec2f corners[kMostCorners], normals[kMostCorners];
};

Sides sidesOf(const Part& part, const Relative& at)
{
    Sides sides;
    sides.count = part.count;
    for (int i = 0; i < part.count; ++i) {
        sides.corners[i] = at.move + turned(at.turn, part.corners[i]);
        sides.normals[i] = turned(at.turn, part.normals[i]);
    }
    return sides;
}

/// How far the other's corners lie out of the side that they lie farthest out of.
float apart(const Sides& a, const Sides& b, int& side)
{
    float most = -3e38F;
    for (int i = 0; i < a.count; ++i) {
        float least = 3e38F;
        for (int j = 0; j < b.count; ++j) least = std::min(least, dot(a.normals[i], b.corners[j]));
        const float separation = least - dot(a.normals[i], a.corners[i]);
        if (separation > most) most = separation, side = i;
    }
    return most;
}

class AnyPair {
public:
    explicit AnyPair(unsigned seed) : random_(seed) {}

    /// 3 to 8 corners, thin ones and boxes among them, or a capsule.
    Part part()
    {
        const int count = static_cast<int>(random_() % 7) + 2;
        const double a = in(0.2, 2), b = in(0, 1) < 0.2 ? 0.01 * a : in(0.2, 2);
        std::vector<Vec2> corners;
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * 3.14159265358979 * i / count + (count == 4 ? 3.14159265358979 / 4 : 0);
            corners.push_back({a * std::cos(angle), b * std::sin(angle)});
        }
        return makePart(corners.data(), count, count == 2 ? in(0.1, 0.5) : 0);
    }
    Relative pose()
    {
        const double turns[] = {0, 0.7853981633974483, 1.5707963267948966, in(-3, 3)};
        const double angle = turns[random_() % 4];
        Relative at;
        at.move = {static_cast<float>(in(-3, 3)), random_() % 5 == 0 ? 0.0F : static_cast<float>(in(-3, 3))};
        if (random_() % 50 == 0) at.move = {};
        at.turn = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
        return at;
    }

private:
    double in(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
    std::mt19937 random_;
};

TEST(Manifold, TheAxisIsThatOfTheSideThatSeparatesMost)
{
    constexpr float kReach = 0.05F;
    AnyPair any(3);
    int separated = 0, overlapping = 0;
    for (int i = 0; i < 60000; ++i) {
        const Part a = any.part(), b = any.part();
        const Relative at = any.pose();
        const Sides sidesA = sidesOf(a, Relative()), sidesB = sidesOf(b, at);
        int sideA = 0, sideB = 0;
        const float apartA = apart(sidesA, sidesB, sideA), apartB = apart(sidesB, sidesA, sideB);
        const float radius = a.radius + b.radius;
        const Manifold m = collide(a, b, at, kReach);
        if (std::max(apartA, apartB) > kReach + radius) {
            ++separated;
            ASSERT_EQ(m.count, 0) << i;
            ASSERT_EQ(m.gap, (apartA > kReach + radius ? apartA : apartB) - radius) << i;
        } else if (std::max(apartA, apartB) < 0) {
            ++overlapping;
            const bool byB = apartB > apartA + 1e-3F * a.length;
            const Vec2f normal = byB ? -sidesB.normals[sideB] : sidesA.normals[sideA];
            ASSERT_GT(m.count, 0) << i;
            ASSERT_EQ(m.normal.x, normal.x) << i;
            ASSERT_EQ(m.normal.y, normal.y) << i;
        }
    }
    EXPECT_GT(separated, 10000);
    EXPECT_GT(overlapping, 10000);
}

}  // namespace

}  // namespace jet::physics::test
