// Soft bodies that are slow, but not at rest, do not sleep; and what sleeps is the same bits everywhere.
#include "jellies.hpp"

#include <string>

namespace jet::physics::test {

namespace {

/// Steps; is body `body` ever asleep?
bool everSleeps(PhysicsWorld& world, BodyHandle body, double seconds)
{
    for (int i = 0; i < static_cast<int>(seconds / kStep); ++i) {
        world.step(kStep);
        if (!world.awake(body)) return true;
    }
    return false;
}

TEST(SoftRestless, AHeavySlowPendulumOfASoftBodyDoesNotSleepWhereItTurns)
{
    // As the thesis has it; so slow that at its turning points it is still for a quarter of a second by any measure.
    for (const double swing : {0.3, 0.02}) {
        WorldSettings settings = sleepy();
        settings.gravity = {0, 5};
        auto world = JetPhysics().createWorld(settings);
        const double length = 400;
        const Vec2 at = length * Vec2(std::sin(swing), std::cos(swing));
        SoftBodyDef bob = jelly(at, 1e5, 10);
        for (double& mass : bob.masses) mass *= 1000;
        const BodyHandle body = world->addSoftBody(bob);
        JointDef rope;
        rope.kind = JointDef::Kind::Distance;
        rope.a = {kNoHandle, {0, 0}, 0}, rope.b = {body, at, 4};
        world->addJoint(rope);
        EXPECT_FALSE(everSleeps(*world, body, 120)) << swing;
    }
}

TEST(SoftRestless, WhatBouncesSlowlyOnASpringDoesNotSleep)
{
    // 12 seconds a period, 1 unit up and down.
    WorldSettings settings = sleepy();
    settings.gravity = {0, 1};
    auto world = JetPhysics().createWorld(settings);
    const BodyHandle body = world->addSoftBody(jelly({0, 0}, 1000, 5));
    const double ks = 4 * 9.8696 / (12 * 12), stretch = 1 / ks;
    world->addSpring({{body, {0, 0}, 0}, {kNoHandle, {0, -50}, 0}, 50 - stretch + 1, ks, 0, 0});
    EXPECT_FALSE(everSleeps(*world, body, 100));
}

/// A bar of two by nine particles that floats and is bent or stretched: nothing but its own springs moves it.
double wobble(double ks, double kd, double amplitude, double seconds, bool& slept)
{
    WorldSettings settings = sleepy();
    settings.gravity = {0, 0};
    auto world = JetPhysics().createWorld(settings);
    SoftBodyDef def = sheet(9, 9, 1, {0, 0, 1, ks, kd, 0});
    for (Vec2& p : def.particles) p *= 1 + amplitude;  // it breathes: its centre stays where it is
    const BodyHandle body = world->addSoftBody(def);
    slept = everSleeps(*world, body, seconds);
    return world->bodies().bounds[body].size().x();
}

TEST(SoftRestless, WhatWobblesDoesNotSleepHoweverSoftItIs)
{
    for (const double ks : {1e-3, 1e-1, 1e1, 1e3}) {
        bool slept = false;
        wobble(ks, 0, 0.02, 60, slept);
        EXPECT_FALSE(slept) << ks;
    }
}

TEST(SoftRestless, WhatCreepsBackAgainstAStrongDamperIsNearItsPlaceWhenItSleeps)
{
    for (const double kd : {10.0, 100.0, 1000.0}) {
        bool slept = false;
        const double width = wobble(1, kd, 0.1, 60, slept);
        if (slept) {
            EXPECT_NEAR(width, 8, 0.03 * 8) << kd;
        } else {
            EXPECT_GT(width, 8) << kd;
        }
    }
    bool slept = false;
    wobble(1, 1000, 0.1, 60, slept);
    EXPECT_FALSE(slept) << "it takes a quarter of an hour";
}

TEST(SoftRestless, WhatIsDampedFarBeyondCriticallySleepsNearItsPlace)
{
    // Its substeps bear a damping of some 10: what is beyond that holds it back no longer.
    for (const double kd : {1e2, 1e3, 1e5, 1e9}) {
        WorldSettings settings = sleepy();
        settings.gravity = {0, 0};
        auto world = JetPhysics().createWorld(settings);
        SoftBodyDef def = jelly({0, 0}, 1, kd);
        for (Vec2& p : def.particles) p.x() *= 1.1;
        const BodyHandle body = world->addSoftBody(def);
        EXPECT_TRUE(everSleeps(*world, body, 35)) << kd;
        EXPECT_NEAR(world->bodies().bounds[body].size().x(), 10, 0.004) << kd;
    }
}

TEST(SoftRestless, WhatFlowsDoesNotSleepAndSleepsOnceItHasFlowed)
{
    for (const double creep : {1e-3, 0.05, 10.0}) {
        auto world = JetPhysics().createWorld(sleepy());
        world->addRigidBody(simple(ground(0)));
        SoftBodyDef def = jelly({0, -6}, 300, 5);
        def.matter.yield = 0.02, def.matter.creep = creep;
        const BodyHandle body = world->addSoftBody(def);
        const BodyHandle load = world->addRigidBody(simple(box({0, -15}, 8, 6)));
        const bool slept = everSleeps(*world, body, 40);
        EXPECT_EQ(slept, creep > 1) << creep;
        EXPECT_EQ(world->awake(load), !slept) << creep;
    }
}

TEST(SoftRestless, WhatComesBackBetweenTheLooksIsSeen)
{
    // Four periods a second: the looks, a quarter of a second apart, find it where it was.
    WorldSettings settings = sleepy();
    settings.gravity = {0, 0};
    auto world = JetPhysics().createWorld(settings);
    const BodyHandle body = world->addSoftBody(jelly({0, 0}, 1e5, 50));
    const double omega = 8 * 3.14159265358979;
    world->addSpring({{body, {0, 0}, 0}, {kNoHandle, {0, -100}, 0}, 100.3, omega * omega, 0, 0});
    EXPECT_FALSE(everSleeps(*world, body, 20));
}

/// A bit of everything: jellies with a box across, a plastic one, a torn one, a pinned one, and a ball that comes late.
std::unique_ptr<PhysicsWorld> mixedWorld(int threads = 1, Simd simd = Simd::Automatic)
{
    auto world = JetPhysics().createWorld(sleepy(threads, simd));
    world->addRigidBody(simple(ground(0)));
    for (int i = 0; i < 2; ++i) world->addSoftBody(jelly({12.0 * i, -6}));
    world->addRigidBody(simple(box({6, -16}, 24, 6)));
    for (int i = 0; i < 4; ++i) world->addSoftBody(jelly({60 + 0.5 * i, -6.0 - 11 * i}, 500, 10));
    SoftBodyDef pinned = jelly({120, -40});
    pinned.movable.assign(pinned.particles.size(), 1);
    pinned.movable[0] = pinned.movable[5] = 0;
    world->addSoftBody(pinned);
    SoftBodyDef twin = jelly({160, -8}, 5, 1);
    twin.matter.shapeStiffness = 20, twin.matter.shapeDamping = 2, twin.matter.pressure = 1;
    world->addSoftBody(twin);
    SoftBodyDef held = jelly({200, -8});
    const BodyHandle body = world->addSoftBody(held);
    JointDef weld;
    weld.kind = JointDef::Kind::Weld;
    weld.a = {body, {205, -8}, 3}, weld.b = {world->addRigidBody(simple(box({212, -6}, 10, 10))), {205, -8}, 0};
    world->addJoint(weld);
    RigidBodyDef ball = simple(box({-1300, -6}, 6, 6));
    ball.common.velocity = {150, 0}, ball.common.gravityScale = 0;
    world->addRigidBody(ball);
    return world;
}

TEST(SoftRestless, TheBitsAreThoseOfAllThreadsAndInstructionsAsleepAndWoken)
{
    auto world = mixedWorld(), threads = mixedWorld(2), sse = mixedWorld(1, Simd::Sse2);
    bool slept = false, woke = false;
    for (int i = 0; i < 720; ++i) {
        for (PhysicsWorld* each : {world.get(), threads.get(), sse.get()}) each->step(kStep);
        slept |= !world->awake(1), woke |= slept && world->awake(1);
        if (i % 10 != 0) continue;
        ASSERT_EQ(world->hash(), threads->hash()) << i;
        ASSERT_EQ(world->hash(), sse->hash()) << i;
    }
    EXPECT_TRUE(slept);
    EXPECT_TRUE(woke) << "the ball has come";
}

TEST(SoftRestless, AStateSavedAtAnyTimeHasTheSameFuture)
{
    auto world = mixedWorld();
    std::vector<std::vector<std::byte>> states;
    std::vector<std::uint64_t> hashes;
    std::vector<std::uint32_t> awake;
    for (int i = 0; i < 720; ++i) {
        if (i % 15 == 7) states.push_back(world->save());
        world->step(kStep);
        hashes.push_back(world->hash());
        awake.push_back(world->stats().awakeBodies);
    }
    EXPECT_NE(*std::min_element(awake.begin(), awake.end()), *std::max_element(awake.begin(), awake.end()));
    auto again = mixedWorld();
    for (std::size_t k = states.size(); k-- > 0;) {
        PhysicsWorld& into = k % 2 == 0 ? *world : *again;
        into.restore(states[k]);
        for (std::size_t i = 15 * k + 7; i < std::min<std::size_t>(720, 15 * k + 7 + 25); ++i) {
            into.step(kStep);
            ASSERT_EQ(into.hash(), hashes[i]) << "saved before step " << 15 * k + 7 << ", step " << i;
            ASSERT_EQ(into.stats().awakeBodies, awake[i]);
        }
    }
}

TEST(SoftRestless, AStateSavedAsleepWakesAsItWouldHave)
{
    auto world = mixedWorld();
    for (int i = 0; i < 420; ++i) world->step(kStep);
    ASSERT_FALSE(world->awake(4)) << "sleeps";
    for (const int way : {0, 1, 2}) {
        auto other = mixedWorld();
        other->restore(world->save());
        for (PhysicsWorld* each : {world.get(), other.get()}) {
            if (way == 0) each->setPosition(0, {0, 50.5});
            if (way == 1) each->applyImpulse(5, {1, -20});
            if (way == 2) each->setGravity({20, 90});
        }
        EXPECT_TRUE(other->awake(4)) << way;
        for (int i = 0; i < 60; ++i) {
            world->step(kStep), other->step(kStep);
            ASSERT_EQ(world->hash(), other->hash()) << way << " " << i;
        }
    }
}

TEST(SoftRestless, ATornBodySleepsWhenAllItsPiecesRest)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0)));
    // One piece lies, the other hangs on a spring and swings.
    SoftBodyDef def = sheet(9, 3, 2, {0, 0, 2, 2000, 20, 0});
    for (Vec2& p : def.particles) p += Vec2(-8, -5);
    for (SpringDef& spring : def.springs)
        if ((spring.a % 9 < 4) != (spring.b % 9 < 4)) spring.tearRatio = 0.5;  // tears at once
    std::vector<std::uint32_t> ring;
    for (std::uint32_t x = 0; x < 9; ++x) ring.push_back(x);
    ring.push_back(17);
    for (std::uint32_t x = 9; x-- > 0;) ring.push_back(18 + x);
    ring.push_back(9);
    def.borders = {ring};
    const BodyHandle body = world->addSoftBody(def);
    const ActuatorHandle spring = world->addSpring({{body, {8, -5}, 0}, {kNoHandle, {8, -60}, 0}, 40, 300, 0, 0});
    EXPECT_FALSE(everSleeps(*world, body, 20)) << "one piece swings";
    ASSERT_FALSE(world->pieces(body).empty()) << "it tore";
    world->setSpring(spring, 40, 0, 0, 0);
    EXPECT_TRUE(everSleeps(*world, body, 60));
}

}  // namespace

}  // namespace jet::physics::test
