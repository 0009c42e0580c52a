// Constraints written eight at a time are those that the formulas of solver_data.hpp give one by one, to the last bit.
#include "rigid/contact.hpp"
#include "rigid/solver_data.hpp"

#include <gtest/gtest.h>

#include <random>

namespace jet::physics::test {

namespace {

struct Eight {
    RigidContact contacts[8];
    Pose poses[17];
    BodyState<float> states[17];
    ContactLanes<float> groups[3] = {};
    FrictionLanes<float> frictions[3] = {};
    LaneOfContact lanes[8];

    /// Contacts of one point and of two, near and far, with what moves and what does not, in lanes of three groups.
    explicit Eight(unsigned seed)
    {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> any(-1, 1);
        for (int i = 1; i < 17; ++i) {
            const Vec2 turn = direction(static_cast<double>(9 * any(random)));
            poses[i].turn = {static_cast<float>(turn.x()), static_cast<float>(turn.y())};
            states[i].invMass = i % 5 == 0 ? 0 : 1 + any(random) / 2;
            states[i].perGyration = i % 7 == 0 ? 0 : 2 + any(random);
        }
        for (std::uint32_t i = 0; i < 8; ++i) {
            RigidContact& c = contacts[i];
            c.bodyA = 1 + 2 * i, c.bodyB = 2 + 2 * i;
            c.slop = 0.01F, c.friction = 0.5F + any(random) / 4, c.count = i % 3 == 0 ? 1 : 2;
            c.normal = poses[16 - i].turn;
            for (int k = 0; k < 2; ++k) {
                c.onA[k] = {any(random), any(random)}, c.onB[k] = {any(random), any(random)};
                c.separation[k] = 0.3F * any(random), c.impulse[k] = 1 + any(random), c.tangentImpulse[k] = any(random);
            }
            lanes[i] = {&c, &groups[i % 3], &frictions[i % 3], (3 * i) % 8};
            lanes[i].group->a[lanes[i].lane] = farOf<float>(c.bodyA);
            lanes[i].group->b[lanes[i].lane] = farOf<float>(c.bodyB);
            lanes[i].friction->points[1].total[lanes[i].lane] = 3;
        }
    }
};

float massOf(const BodyState<float>& a, const BodyState<float>& b, float leverA, float leverB)
{
    const float inverse = a.invMass + b.invMass + a.invMass * leverA * leverA + b.invMass * leverB * leverB;
    return inverse > 0 ? 1 / inverse : 0;
}

void compare(const Eight& e, std::size_t i)
{
    const RigidContact& c = e.contacts[i];
    const std::size_t lane = e.lanes[i].lane;
    const ContactLanes<float>& g = *e.lanes[i].group;
    const FrictionLanes<float>& f = *e.lanes[i].friction;
    const BodyState<float>&a = e.states[c.bodyA], &b = e.states[c.bodyB];
    const Vec2f turnA = e.poses[c.bodyA].turn, turnB = e.poses[c.bodyB].turn, n = turned(turnA, c.normal);
    EXPECT_EQ(g.normalX[lane], n.x);
    EXPECT_EQ(g.normalY[lane], n.y);
    EXPECT_EQ(f.friction[lane], c.friction);
    for (int k = 0; k < 2; ++k) {
        const auto& p = g.points[k];
        const auto& q = f.points[k];
        const bool there = k < c.count;
        const Vec2f half = (c.separation[k] < 20 * c.slop ? 0.5F * c.separation[k] : 0.0F) * n;
        const Vec2f armA = turned(turnA, c.onA[k]) + half, armB = turned(turnB, c.onB[k]) - half;
        const float leverA = cross(armA, n) * a.perGyration, leverB = cross(armB, n) * b.perGyration;
        const float slideA = dot(armA, n) * a.perGyration, slideB = dot(armB, n) * b.perGyration;
        EXPECT_EQ(p.leverA[lane], there ? leverA : 0);
        EXPECT_EQ(p.leverB[lane], there ? leverB : 0);
        EXPECT_EQ(p.separation[lane], there ? c.separation[k] + c.slop : 0);
        EXPECT_EQ(p.now[lane], p.separation[lane]);
        EXPECT_EQ(p.mass[lane], there ? massOf(a, b, leverA, leverB) : 0);
        EXPECT_EQ(p.impulse[lane], there ? c.impulse[k] : 0);
        EXPECT_EQ(q.leverA[lane], there ? slideA : 0);
        EXPECT_EQ(q.leverB[lane], there ? slideB : 0);
        EXPECT_EQ(q.mass[lane], there ? massOf(a, b, slideA, slideB) : 0);
        EXPECT_EQ(q.impulse[lane], there ? c.tangentImpulse[k] : 0);
    }
    EXPECT_EQ(f.points[1].total[lane], c.count < 2 ? 0 : 3) << "what is there keeps what it was given";
}

TEST(Rows, EightAtOnceAreThoseOfOneByOneToTheLastBit)
{
    for (const KernelChoice choice : {KernelChoice::Sse2, KernelChoice::Best})
        for (unsigned seed = 1; seed <= 20; ++seed) {
            Eight e(seed);
            kernels<float>(choice).writeContacts(e.lanes, e.poses, e.states);
            for (std::size_t i = 0; i < 8; ++i) compare(e, i);
        }
}

}  // namespace

}  // namespace jet::physics::test
