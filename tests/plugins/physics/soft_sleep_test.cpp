// Soft bodies that rest fall asleep, together with what lies on them; what swings, sags or flows does not.
#include "jellies.hpp"

#include <jet/physics_removal.hpp>

#include <functional>
#include <string>

namespace jet::physics::test {

namespace {

/// Steps until nothing is awake; false: something still is after `seconds`.
bool settles(PhysicsWorld& world, double seconds = 20)
{
    for (int i = 0; i < static_cast<int>(seconds / kStep); ++i) {
        world.step(kStep);
        if (world.stats().awakeBodies == 0) return true;
    }
    return false;
}

std::vector<Vec2> pointsOf(const PhysicsWorld& world)
{
    const BodyStates states = world.bodies();
    return {states.points.begin(), states.points.end()};
}

double borneBy(const PhysicsWorld& world, BodyHandle body)
{
    double impulse = 0;
    for (const Contact& contact : world.contacts())
        if (contact.bodyA == body || contact.bodyB == body) impulse += contact.impulse;
    return impulse / kStep;
}

double highest(const PhysicsWorld& world, BodyHandle body) { return world.bodies().bounds[body].min.y(); }

constexpr BodyHandle kGround = 0, kJelly = 1, kBox = 2;

/// Ground, a jelly block on it, and a box on that.
std::unique_ptr<PhysicsWorld> boxOnJelly(const WorldSettings& settings = sleepy())
{
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(simple(ground(0)));
    world->addSoftBody(jelly({0, -6}));
    world->addRigidBody(simple(box({0, -15}, 8, 6)));
    return world;
}

TEST(SoftSleep, AJellyBlockThatRestsSleepsWhereItIsAndIsStillBorne)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0)));
    world->addSoftBody(jelly({0, -6}));
    ASSERT_TRUE(settles(*world, 3));
    EXPECT_FALSE(world->awake(kJelly));
    EXPECT_EQ(world->island(kJelly), kNoHandle);
    EXPECT_EQ(world->stats().islands, 0U);
    EXPECT_EQ(world->bodies().velocity[kJelly], Vec2(0, 0));
    EXPECT_EQ(world->bodies().omega[kJelly], 0);
    world->step(kStep);
    EXPECT_TRUE(world->touching(kGround, kJelly));
    EXPECT_NEAR(borneBy(*world, kJelly), 98.1, 0.5) << "its weight";
    world->contactEvents();  // the first time all that touch begin
    world->step(kStep);
    const std::vector<Vec2> before = pointsOf(*world);
    const std::uint64_t hash = world->hash();
    for (int i = 0; i < 10000; ++i) {
        world->step(kStep);
        ASSERT_TRUE(world->contactEvents().empty());
    }
    EXPECT_EQ(pointsOf(*world), before);
    EXPECT_EQ(world->hash(), hash) << "a step in which all sleep changes nothing";
    EXPECT_NEAR(borneBy(*world, kJelly), 98.1, 0.5);
}

TEST(SoftSleep, StacksAndHeapsOfSoftBodiesSleep)
{
    auto stack = JetPhysics().createWorld(sleepy());
    stack->addRigidBody(simple(ground(0)));
    for (int i = 0; i < 3; ++i) stack->addSoftBody(jelly({0, -6 - 11.0 * i}));
    EXPECT_TRUE(settles(*stack, 40));
    EXPECT_LT(stack->bodies().position[3].y(), -20) << "one on the other";

    auto heap = JetPhysics().createWorld(sleepy());
    heap->addRigidBody(simple(ground(0)));
    for (const double x : {-45.0, 45.0}) heap->addRigidBody(fixed({boxRing({x, -50}, 10, 100)}));
    for (int i = 0; i < 24; ++i)
        heap->addSoftBody(defaultBall({-30.0 + 12 * (i % 6) + 0.3 * (i / 6), -6 - 11.0 * (i / 6)}, 5, 300));
    ASSERT_TRUE(settles(*heap, 60));
    const std::vector<Vec2> before = pointsOf(*heap);
    run(*heap, 10);
    EXPECT_EQ(pointsOf(*heap), before);
}

TEST(SoftSleep, WhatIsRemovedUnderASleeperWakesItAndItsPlaceStartsAwake)
{
    std::uint64_t hashes[2] = {};
    for (const int threads : {1, 2}) {
        auto world = boxOnJelly(sleepy(threads));
        ASSERT_TRUE(settles(*world));
        const double slept = world->bodies().position[kBox].y();
        removal(*world).removeBody(kJelly);
        EXPECT_TRUE(world->awake(kBox));
        for (int i = 0; i < 60; ++i) world->step(kStep);
        EXPECT_GT(world->bodies().position[kBox].y(), slept + 5) << "it falls on the ground";
        const BodyHandle next = world->addSoftBody(jelly({40, -30}));
        EXPECT_EQ(next, kJelly);
        EXPECT_TRUE(world->awake(next));
        for (int i = 0; i < 30; ++i) world->step(kStep);
        EXPECT_GT(world->bodies().position[next].y(), -25) << "it falls, too";
        EXPECT_TRUE(settles(*world));
        EXPECT_FALSE(world->awake(next));
        hashes[threads - 1] = world->hash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(SoftSleep, AJellyBlockAndTheBoxOnItSleepTogetherAndWakeTogether)
{
    auto world = boxOnJelly();
    for (int i = 0; i < 1200; ++i) {
        world->step(kStep);
        ASSERT_EQ(world->awake(kJelly), world->awake(kBox)) << i;
        if (!world->awake(kBox)) break;
    }
    ASSERT_FALSE(world->awake(kBox));
    for (const BodyHandle woken : {kJelly, kBox}) {
        world->wake(woken);
        EXPECT_TRUE(world->awake(kJelly)) << woken;
        EXPECT_TRUE(world->awake(kBox)) << woken;
        ASSERT_TRUE(settles(*world)) << woken;
    }
}

TEST(SoftSleep, IslandsThatRestSleepBesideOthersThatDoNot)
{
    auto world = boxOnJelly();
    world->addSoftBody(jelly({40, -6}));
    const BodyHandle swinging = world->addSoftBody(jelly({90, -60}));
    world->addSpring({{swinging, {90, -65}, 0}, {kNoHandle, {60, -100}, 0}, 20, 100, 0, 0});
    run(*world, 12);
    for (const BodyHandle body : {kJelly, kBox, BodyHandle{3}}) EXPECT_FALSE(world->awake(body)) << body;
    EXPECT_TRUE(world->awake(swinging));
    EXPECT_EQ(world->stats().awakeBodies, 1U);
    const std::vector<Vec2> all = pointsOf(*world);
    const std::uint32_t first = world->bodies().firstPoint[swinging];
    const std::vector<Vec2> before(all.begin(), all.begin() + first);
    EXPECT_NEAR(borneBy(*world, 3), 98.1, 0.5) << "what bears it is still told";
    run(*world, 10);
    const std::vector<Vec2> now = pointsOf(*world);
    EXPECT_EQ(std::vector<Vec2>(now.begin(), now.begin() + first), before);
    EXPECT_NEAR(borneBy(*world, 3), 98.1, 0.5);
}

TEST(SoftSleep, WhatIsHitWakesBeforeItIsHitAndTakesTheMomentum)
{
    for (const bool soft : {false, true}) {
        WorldSettings settings = sleepy();
        settings.materials = {MaterialPair{0, 0, true}};
        auto world = JetPhysics().createWorld(settings);
        world->addRigidBody(simple(ground(0)));
        world->addSoftBody(jelly({0, -6}));
        world->addRigidBody(simple(box({300, -5}, 10, 10)));
        ASSERT_TRUE(settles(*world));
        const double mass = 3, speed = 60;
        BodyHandle ball = 0;
        if (soft) {
            SoftBodyDef def = jelly({-40, -6});
            for (double& particle : def.masses) particle *= mass;
            def.common.velocity = {speed, 0};
            ball = world->addSoftBody(def);
        } else {
            RigidBodyDef def = simple(box({-40, -5}, 8, 8));
            def.mass = mass, def.common.velocity = {speed, 0};
            ball = world->addRigidBody(def);
        }
        double momentum = 0;
        for (int i = 0; i < 120; ++i) {
            world->step(kStep);
            momentum = mass * world->bodies().velocity[ball].x() + world->bodies().velocity[kJelly].x();
            ASSERT_NEAR(momentum, mass * speed, 0.01 * mass * speed) << soft << " " << i;
        }
        EXPECT_TRUE(world->awake(kJelly)) << soft;
        EXPECT_GT(world->bodies().velocity[kJelly].x(), 20) << soft;
    }
}

TEST(SoftSleep, WhatOnlyPassesAtADistanceWakesNobody)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0)));
    world->addSoftBody(jelly({0, -6}));
    world->addRigidBody(simple(box({300, -5}, 10, 10)));
    ASSERT_TRUE(settles(*world));
    RigidBodyDef ball = simple(box({-100, -60}, 8, 8));
    ball.common.velocity = {200, 0}, ball.common.gravityScale = 0;
    world->addRigidBody(ball);
    for (int i = 0; i < 60; ++i) {
        world->step(kStep);
        ASSERT_FALSE(world->awake(kJelly)) << i;
    }
    EXPECT_NEAR(borneBy(*world, kJelly), 98.1, 0.5);
}

TEST(SoftSleep, NothingComesOfWaking)
{
    auto world = boxOnJelly();
    for (int round = 0; round < 10; ++round) {
        ASSERT_TRUE(settles(*world)) << round;
        const double jelly = highest(*world, kJelly), box = highest(*world, kBox);
        world->wake(kJelly);
        for (int i = 0; i < 60; ++i) {
            world->step(kStep);
            ASSERT_GT(highest(*world, kJelly), 1.01 * jelly) << round << " " << i;
            ASSERT_GT(highest(*world, kBox), 1.01 * box) << round << " " << i;
        }
    }
}

struct Change {
    const char* name;
    std::function<void(PhysicsWorld&)> make;
};

std::vector<Change> changes()
{
    return {
        {"soft matter",
         [](PhysicsWorld& w) {
             w.setSoftMatter(kJelly, {0, 5});
         }},
        {"springs", [](PhysicsWorld& w) { w.setSprings(kJelly, 500, 5, 0); }},
        {"a pin", [](PhysicsWorld& w) { w.setPinned(kJelly, 3, true); }},
        {"a force",
         [](PhysicsWorld& w) {
             w.applyForce(kJelly, {0, -1});
         }},
        {"an impulse",
         [](PhysicsWorld& w) {
             w.applyImpulse(kJelly, {0, -1});
         }},
        {"a velocity",
         [](PhysicsWorld& w) {
             w.setVelocity(kJelly, {1, 0});
         }},
        {"a turning rate", [](PhysicsWorld& w) { w.setOmega(kJelly, 0.1); }},
        {"a place",
         [](PhysicsWorld& w) {
             w.setPosition(kJelly, {0, -7});
         }},
        {"a mass", [](PhysicsWorld& w) { w.setMass(kJelly, 2); }},
        {"a body's properties",
         [](PhysicsWorld& w) {
             BodyCommon common;
             common.gravityScale = 0.5;
             w.setBody(kJelly, common);
         }},
        {"sleep that is not allowed",
         [](PhysicsWorld& w) {
             BodyCommon common;
             common.allowSleep = false;
             w.setBody(kJelly, common);
         }},
        {"gravity",
         [](PhysicsWorld& w) {
             w.setGravity({0, 50});
         }},
        {"settings",
         [](PhysicsWorld& w) {
             WorldSettings settings = sleepy();
             settings.linearDamping = 0.1;
             w.setSettings(settings);
         }},
        {"materials",
         [](PhysicsWorld& w) {
             WorldSettings settings = sleepy();
             settings.materials = {MaterialPair{0.1, 0, true}};
             w.setSettings(settings);
         }},
        {"a field of force", [](PhysicsWorld& w) { w.addForceField({}); }},
        {"a spring to it",
         [](PhysicsWorld& w) {
             w.addSpring({{kJelly, {0, -9}, 0}, {kNoHandle, {0, -30}, 0}});
         }},
        {"a joint to it",
         [](PhysicsWorld& w) {
             JointDef joint;
             joint.a = {kJelly, {0, -9}, 0}, joint.b = {kNoHandle, {0, -9}, 0};
             w.addJoint(joint);
         }},
        {"a force on it",
         [](PhysicsWorld& w) {
             w.addForce({{kJelly, {0, -9}, 0}, {0, -5}});
         }},
        {"switching it off", [](PhysicsWorld& w) { w.setEnabled(kJelly, false); }},
        {"the box above pushed",
         [](PhysicsWorld& w) {
             w.applyImpulse(kBox, {0.1, 0});
         }},
        {"the box above taken away",
         [](PhysicsWorld& w) {
             w.setPosition(kBox, {100, -20});
         }},
        {"the box above switched off", [](PhysicsWorld& w) { w.setEnabled(kBox, false); }},
        {"the ground moved",
         [](PhysicsWorld& w) {
             w.setPosition(kGround, {0, 55});
         }},
        {"the ground switched off", [](PhysicsWorld& w) { w.setEnabled(kGround, false); }},
        {"the ground's properties",
         [](PhysicsWorld& w) {
             BodyCommon common;
             common.fixed = true, common.sensor = true;
             w.setBody(kGround, common);
         }},
    };
}

TEST(SoftSleep, EveryChangeWakes)
{
    for (const Change& change : changes()) {
        auto world = boxOnJelly();
        ASSERT_TRUE(settles(*world)) << change.name;
        run(*world, 0.5);
        change.make(*world);
        EXPECT_TRUE(world->awake(kBox)) << change.name;
        EXPECT_TRUE(world->awake(kJelly)) << change.name;
    }
}

TEST(SoftSleep, ChangesOfWhatHoldsItWake)
{
    auto world = boxOnJelly();
    JointDef joint;
    joint.kind = JointDef::Kind::Mouse;
    joint.a = {kNoHandle, {0, -6}, 0}, joint.b = {kJelly, {0, -6}, 0};
    joint.maxForce = 10, joint.hertz = 5;
    const JointHandle mouse = world->addJoint(joint);
    const ActuatorHandle force = world->addForce({{kJelly, {0, -6}, 0}, {0, 1}});
    const ActuatorHandle spring = world->addSpring({{kJelly, {0, -9}, 0}, {kNoHandle, {0, -30}, 0}, 20, 1, 1, 0});
    const std::vector<Change> all = {
        {"target",
         [&](PhysicsWorld& w) {
             w.setJointTarget(mouse, {1, -6});
         }},
        {"joint", [&](PhysicsWorld& w) { joint.maxForce = 20, w.setJoint(mouse, joint); }},
        {"removed", [&](PhysicsWorld& w) { w.removeJoint(mouse); }},
        {"force",
         [&](PhysicsWorld& w) {
             w.setForce(force, {0, 2});
         }},
        {"spring", [&](PhysicsWorld& w) { w.setSpring(spring, 20, 2, 1, 0); }},
    };
    for (const Change& change : all) {
        ASSERT_TRUE(settles(*world, 60)) << change.name;
        change.make(*world);
        EXPECT_TRUE(world->awake(kJelly)) << change.name;
        EXPECT_TRUE(world->awake(kBox)) << change.name;
    }
}

TEST(SoftSleep, WhatIsSetAsItIsWakesNobodyAndNeitherDoQueries)
{
    auto world = boxOnJelly();
    world->setSprings(kJelly, 1000, 5, 0);
    ASSERT_TRUE(settles(*world));
    world->setSprings(kJelly, 1000, 5, 0);
    world->setSoftMatter(kJelly, {});
    world->setPinned(kJelly, 3, false);
    world->setBody(kJelly, {});
    world->setGravity({0, 98.1});
    world->setSettings(sleepy());
    world->applyForce(kJelly, {0, 0});
    world->rayCast({-50, -5}, {50, -5}, {});
    world->step(kStep);
    EXPECT_EQ(world->stats().awakeBodies, 0U);
}

TEST(SoftSleep, ASupportThatMovesWakesAndAPlatformUnderWayKeepsAwake)
{
    auto world = JetPhysics().createWorld(sleepy());
    RigidBodyDef platform = simple(box({0, 5}, 60, 10));
    platform.common.kinematic = true;
    world->addRigidBody(platform);
    world->addSoftBody(jelly({0, -6}));
    ASSERT_TRUE(settles(*world));
    world->setVelocity(0, {0, -2});
    EXPECT_TRUE(world->awake(kJelly));
    const double before = world->bodies().position[kJelly].y();
    for (int i = 0; i < 300; ++i) {
        world->step(kStep);
        ASSERT_TRUE(world->awake(kJelly)) << i;
    }
    EXPECT_NEAR(world->bodies().position[kJelly].y(), before - 10, 0.3);
    world->setVelocity(0, {0, 0});
    EXPECT_TRUE(settles(*world));
}

TEST(SoftSleep, AWallThatIsMovedIntoWhatSleepsWakesIt)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0)));
    world->addSoftBody(jelly({0, -6}));
    RigidBodyDef wall = simple(box({40, -10}, 6, 20));
    wall.common.fixed = true;
    const BodyHandle moved = world->addRigidBody(wall);
    ASSERT_TRUE(settles(*world));
    world->setPosition(moved, {7, -10});
    world->step(kStep);
    EXPECT_TRUE(world->awake(kJelly));
}

TEST(SoftSleep, WhatMayNotSleepDoesNotAndKeepsAwakeWhatItTouches)
{
    for (int way = 0; way < 3; ++way) {
        WorldSettings settings = sleepy();
        if (way == 0) settings.allowSleep = false;
        auto world = JetPhysics().createWorld(settings);
        world->addRigidBody(simple(ground(0)));
        SoftBodyDef block = jelly({0, -6});
        block.common.allowSleep = way != 1;
        world->addSoftBody(block);
        RigidBodyDef above = simple(box({0, -15}, 8, 6));
        above.common.allowSleep = way != 2;
        world->addRigidBody(above);
        for (int i = 0; i < 900; ++i) world->step(kStep);
        EXPECT_TRUE(world->awake(kJelly)) << way;
        EXPECT_TRUE(world->awake(kBox)) << way;
    }
    WorldSettings plain = sleepy();
    plain.method = Method::SemiImplicitEuler;
    auto world = JetPhysics().createWorld(plain);
    world->addRigidBody(simple(ground(0)));
    SoftBodyDef heavy = jelly({0, -6}, 100, 10);
    for (double& mass : heavy.masses) mass *= 100;
    world->addSoftBody(heavy);
    EXPECT_FALSE(settles(*world, 20)) << "teaching";
}

}  // namespace

}  // namespace jet::physics::test
