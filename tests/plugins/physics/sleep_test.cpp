// Groups of bodies that rest are left out until something wakes them; what is only slow for a moment is not.
#include "shape_worlds.hpp"

#include <functional>

namespace jet::physics::test {

namespace {

WorldSettings sleepy(int threads = 1, Simd simd = Simd::Automatic)
{
    WorldSettings settings = shapeSettings(threads, simd);
    settings.allowSleep = true;
    return settings;
}

/// Steps until nothing is awake; false: something still is after `seconds`.
bool settles(PhysicsWorld& world, double seconds = 20)
{
    for (int i = 0; i < static_cast<int>(seconds / kStep); ++i) {
        world.step(kStep);
        if (world.stats().awakeBodies == 0) return true;
    }
    return false;
}

/// Ground and one box on it; body 1 is the box.
std::unique_ptr<PhysicsWorld> boxOnGround(const WorldSettings& settings = sleepy())
{
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(simple(ground(0)));
    world->addRigidBody(simple(box({0, -5}, 10, 10)));
    return world;
}

Vec2 at(const PhysicsWorld& world, BodyHandle body) { return world.bodies().position[body]; }

TEST(Sleep, ABoxThatRestsSleepsWhereItIsAndStillTouches)
{
    auto world = boxOnGround();
    ASSERT_TRUE(settles(*world, 5));
    EXPECT_FALSE(world->awake(1));
    EXPECT_EQ(world->bodies().velocity[1], Vec2(0, 0));
    EXPECT_NEAR(at(*world, 1).y(), -5, 0.05);
    const Vec2 before = at(*world, 1);
    world->step(kStep);
    const std::uint64_t hash = world->hash();
    for (int i = 0; i < 300; ++i) {
        world->step(kStep);
        EXPECT_TRUE(world->contactEvents().empty());
    }
    EXPECT_EQ(at(*world, 1), before);
    EXPECT_EQ(world->hash(), hash) << "a step in which all sleep changes nothing";
    EXPECT_TRUE(world->touching(0, 1));
    ASSERT_EQ(world->contacts().size(), 2U);
    EXPECT_EQ(world->stats().contacts, 2U);
    EXPECT_GT(world->contacts()[0].impulse, 0) << "what bears it is still told";
}

TEST(Sleep, NothingSleepsWhereItIsNotAllowed)
{
    WorldSettings settings = sleepy();
    settings.allowSleep = false;
    auto world = boxOnGround(settings);
    EXPECT_FALSE(settles(*world, 5));
    settings.allowSleep = true;
    world->setSettings(settings);
    EXPECT_TRUE(settles(*world, 5));
    settings.allowSleep = false;
    world->setSettings(settings);
    EXPECT_TRUE(world->awake(1));
    EXPECT_FALSE(settles(*world, 5));
}

TEST(Sleep, OneThatMayNotSleepKeepsItsGroupAwakeAndNoOther)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0)));
    const BodyHandle below = world->addRigidBody(simple(box({0, -5}, 10, 10)));
    RigidBodyDef sleepless = simple(box({0, -15}, 10, 10));
    sleepless.common.allowSleep = false;
    const BodyHandle above = world->addRigidBody(sleepless);
    const BodyHandle aside = world->addRigidBody(simple(box({100, -5}, 10, 10)));
    run(*world, 5);
    EXPECT_TRUE(world->awake(below) && world->awake(above));
    EXPECT_FALSE(world->awake(aside));
    EXPECT_EQ(world->stats().awakeBodies, 2U);
    EXPECT_EQ(world->stats().islands, 1U);
    EXPECT_EQ(world->island(below), 0U);
    EXPECT_EQ(world->island(above), 0U);
    EXPECT_EQ(world->island(aside), kNoHandle) << "asleep";
    EXPECT_EQ(world->island(0), kNoHandle) << "stands";
}

TEST(Sleep, IslandsAreWhatTouchesOrIsJoined)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0)));
    const BodyHandle a = world->addRigidBody(simple(box({0, -5}, 10, 10)));
    const BodyHandle b = world->addRigidBody(simple(box({50, -5}, 10, 10)));
    const BodyHandle onB = world->addRigidBody(simple(box({50, -15}, 10, 10)));
    const BodyHandle c = world->addRigidBody(simple(box({100, -5}, 10, 10)));
    JointDef rope;
    rope.kind = JointDef::Kind::Rope;
    rope.a = {a, {0, -5}}, rope.b = {c, {100, -5}};
    world->addJoint(rope);
    run(*world, 0.1);
    EXPECT_EQ(world->island(a), 0U);
    EXPECT_EQ(world->island(c), 0U) << "ground joins nothing, ropes do";
    EXPECT_EQ(world->island(b), 1U);
    EXPECT_EQ(world->island(onB), 1U);
    EXPECT_EQ(world->stats().islands, 2U);
    EXPECT_EQ(world->stats().awakeBodies, 4U);
}

// Every way to wake.

struct Way {
    const char* name;
    std::function<void(PhysicsWorld&)> wake;
};

TEST(Sleep, EveryChangeOfABodyWakesIt)
{
    WorldSettings heavier = sleepy();
    heavier.linearDamping = 1;
    ForceFieldDef wind;
    wind.vector = {500, 0};
    SpringActuatorDef spring;
    spring.a = {kNoHandle, {0, -50}}, spring.b = {1, {0, -5}};
    TorqueActuatorDef torque;
    torque.at = {1, {0, -5}}, torque.value = 5;
    ForceActuatorDef force;
    force.at = {1, {0, -5}}, force.force = {200, 0};
    JointDef mouse;
    mouse.kind = JointDef::Kind::Mouse;
    mouse.a = {kNoHandle, {0, -40}}, mouse.b = {1, {0, -5}};
    const std::vector<Way> ways = {
        {"wake", [](PhysicsWorld& w) { w.wake(1); }},
        {"applyForce",
         [](PhysicsWorld& w) {
             w.applyForce(1, {1, 0});
         }},
        {"applyImpulse",
         [](PhysicsWorld& w) {
             w.applyImpulse(1, {1, 0});
         }},
        {"setVelocity",
         [](PhysicsWorld& w) {
             w.setVelocity(1, {1, 0});
         }},
        {"setOmega", [](PhysicsWorld& w) { w.setOmega(1, 0.1); }},
        {"setPosition",
         [](PhysicsWorld& w) {
             w.setPosition(1, {0, -30});
         }},
        {"setGravity",
         [](PhysicsWorld& w) {
             w.setGravity({0, -10});
         }},
        {"setMass", [](PhysicsWorld& w) { w.setMass(1, 3); }},
        {"setSettings", [&](PhysicsWorld& w) { w.setSettings(heavier); }},
        {"a new field", [&](PhysicsWorld& w) { w.addForceField(wind); }},
        {"a new spring", [&](PhysicsWorld& w) { w.addSpring(spring); }},
        {"a new torque", [&](PhysicsWorld& w) { w.addTorque(torque); }},
        {"a new force", [&](PhysicsWorld& w) { w.addForce(force); }},
        {"a new joint", [&](PhysicsWorld& w) { w.addJoint(mouse); }},
    };
    for (const Way& way : ways) {
        SCOPED_TRACE(way.name);
        auto world = boxOnGround();
        ASSERT_TRUE(settles(*world));
        way.wake(*world);
        EXPECT_TRUE(world->awake(1));
        world->step(kStep);
        EXPECT_TRUE(world->awake(1));
        EXPECT_EQ(world->stats().awakeBodies, 1U);
    }
}

TEST(Sleep, ActuatorsAndJointsWakeWhatTheyHoldWhenTheyChangeAndNotOtherwise)
{
    auto world = boxOnGround();
    TorqueActuatorDef torqueDef;
    torqueDef.at = {1, {0, -5}}, torqueDef.value = 1;
    ForceActuatorDef forceDef;
    forceDef.at = {1, {0, -5}}, forceDef.force = {1, 0};
    SpringActuatorDef springDef;
    springDef.a = {kNoHandle, {0, -50}}, springDef.b = {1, {0, -5}}, springDef.ks = 0.1;
    ForceFieldDef wind;
    wind.vector = {1, 0};
    JointDef mouseDef;
    mouseDef.kind = JointDef::Kind::Mouse;
    mouseDef.a = {kNoHandle, {0, -5}}, mouseDef.b = {1, {0, -5}}, mouseDef.maxForce = 10, mouseDef.hertz = 1;
    JointDef wheelDef;
    wheelDef.kind = JointDef::Kind::Revolute;
    wheelDef.a = {kNoHandle, {0, -5}}, wheelDef.b = {1, {0, -5}};
    const ActuatorHandle torque = world->addTorque(torqueDef), force = world->addForce(forceDef),
                         spring = world->addSpring(springDef), field = world->addForceField(wind);
    const JointHandle mouse = world->addJoint(mouseDef), wheel = world->addJoint(wheelDef);
    const auto asleep = [&] { return settles(*world) && !world->awake(1); };
    ASSERT_TRUE(asleep());
    world->setTorque(torque, 1), world->setForce(force, {1, 0}), world->setMotor(wheel, false, 0);
    world->setJointTarget(mouse, {0, -5}), world->applyForce(1, {0, 0}), world->setGravity({0, 98.1});
    world->setVelocity(1, {0, 0}), world->setMass(1, 1), world->setEnabled(1, true), world->setBody(1, {});
    world->setSpring(spring, -1, springDef.ks, springDef.kd, 0), world->setForceField(field, wind);
    world->setJoint(wheel, wheelDef), world->setJoint(mouse, mouseDef), world->setSettings(sleepy());
    EXPECT_FALSE(world->awake(1)) << "nothing has changed";
    world->rayCast({-100, -5}, {100, -5}), world->nearest({0, -20}, 100), world->save();
    EXPECT_FALSE(world->awake(1)) << "looking wakes nobody";
    const std::vector<Way> ways = {
        {"torque", [&](PhysicsWorld& w) { w.setTorque(torque, 2); }},
        {"force",
         [&](PhysicsWorld& w) {
             w.setForce(force, {2, 0});
         }},
        {"spring", [&](PhysicsWorld& w) { w.setSpring(spring, 30, 0.2, 0.1, 0); }},
        {"field",
         [&](PhysicsWorld& w) {
             wind.vector = {2, 0};
             w.setForceField(field, wind);
         }},
        {"target",
         [&](PhysicsWorld& w) {
             w.setJointTarget(mouse, {0, -6});
         }},
        {"motor", [&](PhysicsWorld& w) { w.setMotor(wheel, true, 0.1); }},
        {"joint",
         [&](PhysicsWorld& w) {
             wheelDef.breakForce = 1e6;
             w.setJoint(wheel, wheelDef);
         }},
        {"settings",
         [&](PhysicsWorld& w) {
             WorldSettings damped = sleepy();
             damped.linearDamping = 0.1;
             w.setSettings(damped);
         }},
        {"removed", [&](PhysicsWorld& w) { w.removeJoint(wheel); }},
    };
    for (const Way& way : ways) {
        SCOPED_TRACE(way.name);
        ASSERT_TRUE(asleep());
        way.wake(*world);
        EXPECT_TRUE(world->awake(1));
    }
}

TEST(Sleep, AStackThatIsHitWakesInTheSameStep)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0, 40000)));
    for (int i = 0; i < 6; ++i) world->addRigidBody(simple(box({0, -5.0 - 10 * i}, 10, 10)));
    ASSERT_TRUE(settles(*world));
    const BodyHandle ball = world->addRigidBody([] {
        RigidBodyDef def;
        def.shapes.push_back({ShapeDef::Kind::Circle, {{-200, -45}}, 4});
        def.mass = 2;
        def.common.velocity = {600, -50};
        return def;
    }());
    int hit = -1;
    for (int i = 0; i < 60 && hit < 0; ++i) {
        world->step(kStep);
        if (world->awake(5)) hit = i;
        if (hit < 0) {
            EXPECT_EQ(world->stats().awakeBodies, 1U);
            EXPECT_NEAR(world->bodies().velocity[ball].x(), 600, 1e-3) << "it had not touched";
        }
    }
    ASSERT_GT(hit, 0);
    EXPECT_TRUE(world->awake(1)) << "all of its group";
    run(*world, 0.2);
    EXPECT_GT(at(*world, 5).x(), 5) << "it was pushed like one that is awake";
    EXPECT_LT(world->bodies().velocity[ball].x(), 590);
    run(*world, 20);
    for (BodyHandle box = 1; box <= 6; ++box) EXPECT_FALSE(world->awake(box)) << box;
}

TEST(Sleep, WhatIsHitMovesAsIfItHadNotSlept)
{
    const auto play = [](bool sleeps) {
        WorldSettings settings = sleepy();
        settings.allowSleep = sleeps;
        settings.gravity = {0, 0};
        auto world = JetPhysics().createWorld(settings);
        RigidBodyDef disc;
        disc.shapes.push_back({ShapeDef::Kind::Circle, {{0, 0}}, 5});
        world->addRigidBody(disc);
        disc.shapes[0].points[0] = {-300, 2};
        disc.common.velocity = {100, 0};
        world->addRigidBody(disc);
        run(*world, 2);
        EXPECT_EQ(world->awake(0), !sleeps);
        run(*world, 3);
        return std::pair(world->bodies().velocity[0], world->bodies().velocity[1]);
    };
    const auto [hit, ball] = play(true);
    const auto [hitAwake, ballAwake] = play(false);
    EXPECT_NEAR((hit - hitAwake).norm(), 0, 1e-9);
    EXPECT_NEAR((ball - ballAwake).norm(), 0, 1e-9);
    EXPECT_GT(hit.x(), 10);
}

TEST(Sleep, WhatLosesItsSupportFalls)
{
    auto world = JetPhysics().createWorld(sleepy());
    const BodyHandle shelf = world->addRigidBody(simple(fixed({boxRing({0, 5}, 100, 10)})));
    const BodyHandle box1 = world->addRigidBody(simple(box({0, -5}, 10, 10)));
    const BodyHandle box2 = world->addRigidBody(simple(box({0, -15}, 10, 10)));
    const BodyHandle other = world->addRigidBody(simple(fixed({boxRing({300, 5}, 100, 10)})));
    ASSERT_TRUE(settles(*world));
    world->setPosition(other, {300, 100});
    run(*world, 0.1);
    EXPECT_FALSE(world->awake(box1)) << "what it does not touch is none of its business";
    world->setPosition(shelf, {0, 200});
    run(*world, 0.5);
    EXPECT_GT(at(*world, box1).y(), 0);
    EXPECT_GT(at(*world, box2).y(), -10);
}

TEST(Sleep, ABodyThatIsPutIntoASleeperPushesItOut)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0)));
    const BodyHandle sleeper = world->addRigidBody(simple(box({0, -5}, 10, 10)));
    const BodyHandle block = world->addRigidBody(simple(fixed({boxRing({200, -5}, 10, 10)})));
    ASSERT_TRUE(settles(*world));
    world->setPosition(block, {-8, -5});
    run(*world, 1);
    EXPECT_GT(at(*world, sleeper).x(), 1.5);
}

TEST(Sleep, APlatformThatBeginsToMoveTakesAlongWhatSleepsOnIt)
{
    auto world = JetPhysics().createWorld(sleepy());
    RigidBodyDef platformDef = simple(box({0, 5}, 100, 10));
    platformDef.common.kinematic = true;
    const BodyHandle platform = world->addRigidBody(platformDef);
    const BodyHandle rider = world->addRigidBody(simple(box({0, -5}, 10, 10)));
    ASSERT_TRUE(settles(*world)) << "a platform that stands lets sleep what is on it";
    world->setVelocity(platform, {20, 0});
    run(*world, 2);
    EXPECT_TRUE(world->awake(rider)) << "nobody sleeps on what moves";
    EXPECT_NEAR(at(*world, rider).x(), 40 - 20 * 20 / (2 * 0.6 * 98.1), 0.3) << "friction takes a while";
    world->setVelocity(platform, {0, 0});
    EXPECT_TRUE(settles(*world));
}

TEST(Sleep, AMovingWallWakesTheSleeperItComesTo)
{
    auto world = boxOnGround();
    RigidBodyDef wallDef = simple(box({200, -5}, 10, 9));
    wallDef.common.kinematic = true;
    wallDef.common.velocity = {-50, 0};
    const BodyHandle wall = world->addRigidBody(wallDef);
    run(*world, 2);
    EXPECT_FALSE(world->awake(1));
    run(*world, 4);
    EXPECT_NEAR(at(*world, 1).x(), at(*world, wall).x() - 10, 0.5);
}

TEST(Sleep, AWeightThatHangsAsleepFallsWhenItsJointGoes)
{
    auto world = JetPhysics().createWorld(sleepy());
    const BodyHandle upper = world->addRigidBody(simple(box({0, 20}, 10, 10)));
    const BodyHandle lower = world->addRigidBody(simple(box({0, 40}, 10, 10)));
    JointDef joint;
    joint.a = {kNoHandle, {0, 10}}, joint.b = {upper, {0, 10}};
    world->addJoint(joint);
    joint.a = {upper, {0, 30}}, joint.b = {lower, {0, 30}};
    const JointHandle link = world->addJoint(joint);
    ASSERT_TRUE(settles(*world));
    run(*world, 1);
    EXPECT_NEAR(world->joint(link).force.norm(), 98.1, 1) << "the joint still tells what it bears";
    world->removeJoint(link);
    run(*world, 0.5);
    EXPECT_GT(at(*world, lower).y(), 45);
    EXPECT_NEAR(at(*world, upper).y(), 20, 0.5);
}

TEST(Sleep, AHeavySlowPendulumDoesNotFallAsleep)
{
    // Period 20 s, swinging by 5 units on 1,000: never faster than 1.6 units / s, nearly still for seconds at its ends.
    for (const bool onSpring : {false, true}) {
        SCOPED_TRACE(onSpring ? "on a spring" : "on a joint");
        auto world = JetPhysics().createWorld(sleepy());
        const double length = 1000, swing = 5;
        RigidBodyDef bob;
        bob.shapes.push_back({ShapeDef::Kind::Circle, {{swing, length}}, 40});
        bob.mass = 1e4;
        const BodyHandle body = world->addRigidBody(bob);
        if (onSpring) {
            SpringActuatorDef cord;
            cord.a = {kNoHandle, {0, 0}}, cord.b = {body, {swing, length}};
            cord.ks = 1e7, cord.kd = 1e5;
            world->addSpring(cord);
        } else {
            JointDef rod;
            rod.a = {kNoHandle, {0, 0}}, rod.b = {body, {0, 0}};
            world->addJoint(rod);
        }
        double least = 0, most = 0;
        for (int i = 0; i < 60 * 60; ++i) {
            world->step(kStep);
            ASSERT_TRUE(world->awake(body)) << i * kStep;
            if (i < 40 * 60) continue;
            least = std::min(least, at(*world, body).x()), most = std::max(most, at(*world, body).x());
        }
        EXPECT_LT(least, -0.9 * swing);
        EXPECT_GT(most, 0.9 * swing);
    }
}

TEST(Sleep, AThrownBodyDoesNotSleepAtItsHighestPoint)
{
    auto world = JetPhysics().createWorld(sleepy());
    RigidBodyDef ball = simple(box({0, 0}, 1000, 1000));
    ball.common.gravityScale = 0.002;
    ball.common.velocity = {0, -0.5};
    const BodyHandle body = world->addRigidBody(ball);
    run(*world, 10);
    EXPECT_NEAR(at(*world, body).y(), -0.5 * 10 + 0.5 * 0.1962 * 100, 0.1);
}

TEST(Sleep, WhatDriftsSlowlyThroughEmptySpaceDriftsOn)
{
    WorldSettings settings = sleepy();
    settings.gravity = {0, 0};
    auto world = JetPhysics().createWorld(settings);
    RigidBodyDef rock = simple(box({0, 0}, 100, 100));
    rock.common.velocity = {0.5, 0};
    world->addRigidBody(rock);
    run(*world, 20);
    EXPECT_NEAR(at(*world, 0).x(), 10, 1e-6);
}

TEST(Sleep, WhatLiesOnASoftBodyThatMayNotSleepStaysAwakeWithIt)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0)));
    SoftBodyDef sleepless = softBall({0, -20}, 20, 2000, 5);
    sleepless.common.allowSleep = false;
    const BodyHandle cushion = world->addSoftBody(sleepless);
    const BodyHandle rider = world->addRigidBody(simple(box({0, -46}, 10, 10, 0.1)));
    const BodyHandle aside = world->addRigidBody(simple(box({200, -5}, 10, 10)));
    const BodyHandle onIt = world->addRigidBody(simple(box({200, -15}, 10, 10)));
    run(*world, 8);
    EXPECT_TRUE(world->awake(cushion));
    EXPECT_TRUE(world->awake(rider));
    EXPECT_EQ(world->island(rider), world->island(cushion));
    EXPECT_FALSE(world->awake(aside) || world->awake(onIt));
    const Vec2 place = at(*world, onIt);
    run(*world, 5);
    EXPECT_EQ(at(*world, onIt), place);
    // A soft body that comes wakes them.
    const BodyHandle falling = world->addSoftBody(softBall({205, -120}, 15, 2000, 5));
    for (int i = 0; i < 180 && !world->awake(onIt); ++i) world->step(kStep);
    EXPECT_TRUE(world->awake(onIt) && world->awake(aside));
    bool touched = false;
    for (int i = 0; i < 30; ++i) world->step(kStep), touched |= world->touching(falling, onIt);
    EXPECT_TRUE(touched);
    EXPECT_NE(at(*world, onIt), place);
}

TEST(Sleep, WhatASoftBodyHoldsThatMayNotSleepStaysAwake)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0)));
    SoftBodyDef sleepless = softBall({0, -20}, 20, 2000, 5);
    sleepless.common.allowSleep = false;
    const BodyHandle soft = world->addSoftBody(sleepless);
    const BodyHandle tied = world->addRigidBody(simple(box({100, -5}, 10, 10)));
    const BodyHandle sprung = world->addRigidBody(simple(box({-100, -5}, 10, 10)));
    const BodyHandle onTied = world->addRigidBody(simple(box({100, -15}, 10, 10)));
    JointDef rope;
    rope.kind = JointDef::Kind::Rope;
    rope.a = {soft, {0, -20}, 5}, rope.b = {tied, {100, -5}};
    world->addJoint(rope);
    SpringActuatorDef spring;
    spring.a = {soft, {0, -20}}, spring.b = {sprung, {-100, -5}}, spring.ks = 0.01;
    world->addSpring(spring);
    run(*world, 8);
    EXPECT_TRUE(world->awake(tied) && world->awake(sprung) && world->awake(onTied));
}

TEST(Sleep, SpringsHoldGroupsTogether)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0)));
    const BodyHandle a = world->addRigidBody(simple(box({0, -5}, 10, 10)));
    const BodyHandle b = world->addRigidBody(simple(box({60, -5}, 10, 10)));
    SpringActuatorDef spring;
    spring.a = {a, {0, -5}}, spring.b = {b, {60, -5}}, spring.ks = 1;
    world->addSpring(spring);
    ASSERT_TRUE(settles(*world));
    run(*world, 1);
    EXPECT_EQ(world->bodies().velocity[a], Vec2(0, 0));
    world->applyImpulse(b, {100, 0});
    EXPECT_TRUE(world->awake(a));
}

// The same bits, whoever computes them and wherever they begin.

/// A pyramid of 666 boxes that sleeps and is hit.
std::unique_ptr<PhysicsWorld> hitPyramid(const WorldSettings& settings)
{
    auto world = pyramidWorld(settings);
    RigidBodyDef ball;
    ball.shapes.push_back({ShapeDef::Kind::Circle, {{-2000, -60}}, 8});
    ball.mass = 5, ball.common.velocity = {200, 0}, ball.common.gravityScale = 0;
    world->addRigidBody(ball);
    return world;
}

TEST(Sleep, ThreadsAndInstructionsDoNotChangeWhoSleepsWhen)
{
    std::vector<std::pair<std::uint64_t, std::uint32_t>> first;
    for (const auto& [threads, simd] : {std::pair{1, Simd::Sse2}, {2, Simd::Automatic}, {4, Simd::Automatic}}) {
        auto world = hitPyramid(sleepy(threads, simd));
        std::vector<std::pair<std::uint64_t, std::uint32_t>> now;
        for (int i = 0; i < 720; ++i) {
            world->step(kStep);
            if (i % 10 == 0) now.emplace_back(world->hash(), world->stats().awakeBodies);
        }
        if (first.empty()) first = now;
        EXPECT_EQ(now, first);
    }
    EXPECT_EQ(first[500 / 10].second, 1U) << "all but the ball sleep";
    EXPECT_EQ(first.back().second, 667U) << "all are awake";
}

TEST(Sleep, SnapshotsKeepWhoSleeps)
{
    auto world = hitPyramid(sleepy());
    std::vector<std::vector<std::byte>> saved;
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < 720; ++i) {
        if (i == 60 || i == 200 || i == 400 || i == 500) saved.push_back(world->save());
        world->step(kStep);
        hashes.push_back(world->hash());
    }
    const int begins[] = {60, 200, 400, 500};
    for (std::size_t k = 0; k < saved.size(); ++k) {
        SCOPED_TRACE(begins[k]);
        auto fresh = hitPyramid(sleepy());
        for (PhysicsWorld* into : {fresh.get(), world.get()}) {
            into->restore(saved[k]);
            for (int i = begins[k]; i < 720; ++i) {
                into->step(kStep);
                if (i % 5 != 0 && i > begins[k] + 3) continue;
                ASSERT_EQ(into->hash(), hashes[static_cast<std::size_t>(i)]) << i;
            }
        }
    }
}

TEST(Sleep, SnapshotsOfASleepingWorldAreRestoredAsleep)
{
    auto world = boxOnGround();
    ASSERT_TRUE(settles(*world));
    const std::vector<std::byte> saved = world->save();
    auto fresh = boxOnGround();
    fresh->restore(saved);
    EXPECT_FALSE(fresh->awake(1));
    run(*fresh, 1), run(*world, 1);
    EXPECT_EQ(fresh->hash(), world->hash());
    for (PhysicsWorld* w : {fresh.get(), world.get()}) w->applyImpulse(1, {50, 0}), run(*w, 1);
    EXPECT_EQ(fresh->hash(), world->hash());
    EXPECT_GT(at(*world, 1).x(), 1);
}

TEST(Sleep, SleepersWokenUnderAnotherSubstepStillBearEachOther)
{
    auto world = JetPhysics().createWorld(sleepy());
    world->addRigidBody(simple(ground(0)));
    for (int i = 0; i < 10; ++i) world->addRigidBody(simple(box({0, -5.0 - 10 * i}, 10, 10)));
    ASSERT_TRUE(settles(*world));
    const double top = at(*world, 10).y();
    WorldSettings settings = sleepy();
    settings.substeps = 32;
    world->setSettings(settings);
    double hop = 0;
    for (int i = 0; i < 60; ++i) world->step(kStep), hop = std::max(hop, std::abs(at(*world, 10).y() - top));
    EXPECT_LT(hop, 0.3);
}

}  // namespace

}  // namespace jet::physics::test
