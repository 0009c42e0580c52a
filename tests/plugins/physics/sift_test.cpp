// The sieve of eight pairs says what the rule for one says, to the bit, with either instruction set.
#include "rigid/sift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace jet::physics::test {

namespace {

/// Collider::update() up to where it knows that a pair without points stays apart.
float gapOf(const SiftInput& in, const RigidContact& c, bool& apart)
{
    const Pose &a = in.poses[c.bodyA], &b = in.poses[c.bodyB];
    const Vec2f apartBy{static_cast<float>(b.x - a.x), static_cast<float>(b.y - a.y)};
    const Vec2f moved = turnedBack(a.turn, apartBy) - c.at.move, turn = turnedBack(a.turn, b.turn) - c.at.turn;
    const bool fromA = a.reach <= b.reach;
    const float omega = fromA ? b.omega : a.omega;
    const float dx = b.velocityX - a.velocityX + omega * apartBy.y, dy = b.velocityY - a.velocityY - omega * apartBy.x;
    const float travel =
        (std::sqrt(dx * dx + dy * dy) + std::abs(b.omega - a.omega) * (fromA ? a.reach : b.reach)) * in.dt;
    const float gap = c.separation[0] - std::sqrt(dot(moved, moved)) - std::sqrt(dot(turn, turn)) * b.reach;
    apart = c.count == 0 && !c.touching && !c.passing && gap > in.speculative * c.slop + travel &&
            in.boxes[c.partA].meets(in.boxes[c.partB]);
    return gap - in.speculative * c.slop;
}

struct World {
    std::vector<RigidContact> contacts;
    std::vector<Pose> poses;
    std::vector<FatBox> boxes;
};

/// Bodies that move hardly, wildly or not at all, some far out, some in one place; gaps about as large as their ways.
World anyWorld(unsigned seed)
{
    std::mt19937 random(seed);
    const auto in = [&](double from, double to) {
        return static_cast<float>(std::uniform_real_distribution<double>(from, to)(random));
    };
    World world;
    for (int i = 0; i < 400; ++i) {
        Pose& pose = world.poses.emplace_back();
        const double far = i % 7 == 0 ? 1e6 : 0;
        pose.x = i % 11 == 0 ? 1 : far + in(-5, 5), pose.y = i % 11 == 0 ? 2 : far + in(-5, 5);
        const float angle = in(-4, 4), speed = i % 5 == 0 ? 0 : std::pow(10.0F, in(-4, 3));
        pose.turn = {std::cos(angle), std::sin(angle)};
        pose.velocityX = in(-1, 1) * speed, pose.velocityY = in(-1, 1) * speed, pose.omega = in(-1, 1) * speed;
        pose.reach = i % 13 == 0 ? 0 : in(0, 3);
        const auto x = static_cast<float>(pose.x), y = static_cast<float>(pose.y), half = in(0.5, 5);
        world.boxes.push_back({x - half, y - half, x + half, y + half});
    }
    for (int i = 0; i < 4000; ++i) {
        RigidContact& c = world.contacts.emplace_back();
        c.partA = c.bodyA = random() % 400, c.partB = c.bodyB = random() % 400;
        c.slop = in(0, 0.01), c.separation[0] = in(-0.1, 10);
        const Pose &a = world.poses[c.bodyA], &b = world.poses[c.bodyB];
        c.at.move = turnedBack(a.turn, {static_cast<float>(b.x - a.x), static_cast<float>(b.y - a.y)});
        c.at.turn = turnedBack(a.turn, b.turn);
        if (i % 3 != 0) c.at.move.x += in(-0.1, 0.1), c.at.turn.y += in(-0.01, 0.01);
        c.count = i % 17 == 0, c.touching = i % 19 == 0, c.passing = i % 23 == 0;
    }
    return world;
}

TEST(Sift, WhereNothingIsWrittenForAvx512Avx2IsTaken)
{
    const auto choice = [](Simd simd) {
        WorldSettings settings;
        settings.simd = simd;
        return choiceOf(settings);
    };
    EXPECT_EQ(choice(Simd::Avx512), choice(Simd::Avx2));
    EXPECT_EQ(&sieve(choice(Simd::Avx512)), &sieve(choice(Simd::Automatic)));
    if (hasAvx2()) {
        EXPECT_NE(&sieve(choice(Simd::Avx512)), &sieve(choice(Simd::Sse2)));
    }
}

TEST(Sift, EightPairsAreSeenAsEachOfThemIs)
{
    std::size_t apartCount = 0, count = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const World world = anyWorld(seed);
        const SiftInput in{world.contacts.data(), world.poses.data(), world.boxes.data(), 1.0F / 60, 6};
        for (const KernelChoice choice : {KernelChoice::Sse2, KernelChoice::Best}) {
            for (Index first = 0; first + 8 <= world.contacts.size(); first += 8) {
                Index which[8];
                float until[8];
                for (Index i = 0; i < 8; ++i) which[i] = first + i;
                if (first % 64 == 0) which[7] = which[6];  // as where fewer than eight are left
                const std::uint32_t bits = sieve(choice).stayApart(in, which, until);
                for (Index i = 0; i < 8; ++i, ++count) {
                    bool apart = false;
                    const float gap = gapOf(in, world.contacts[which[i]], apart);
                    ASSERT_EQ(until[i], gap) << "seed " << seed << ", pair " << which[i];
                    ASSERT_EQ((bits >> i & 1U) != 0, apart) << "seed " << seed << ", pair " << which[i];
                    apartCount += apart;
                }
            }
        }
    }
    EXPECT_GT(apartCount, count / 10);
    EXPECT_LT(apartCount, count - count / 10);
}

}  // namespace

}  // namespace jet::physics::test
