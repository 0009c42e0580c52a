// Joints that hold soft bodies.
#include "lattices.hpp"

#include <jet/result.hpp>

namespace jet::physics::test {

namespace {

JointDef jointOf(JointDef::Kind kind, Anchor a, Anchor b)
{
    JointDef def;
    def.kind = kind;
    def.a = a, def.b = b;
    return def;
}

Vec2 momentum(const PhysicsWorld& world, std::initializer_list<double> masses)
{
    Vec2 sum(0, 0);
    std::size_t body = 0;
    for (const double mass : masses) sum += mass * world.bodies().velocity[body++];
    return sum;
}

}  // namespace

TEST(SoftJoints, APinHangsABallByARegionAndBearsItsWeight)
{
    auto world = makeWorld({0, 98});
    world->addSoftBody(softBall({0, 0}, 20, 2000, 4));
    const JointHandle pin = world->addJoint(jointOf(JointDef::Kind::Revolute, {kNoHandle, {0, -16}}, {0, {0, -16}, 8}));
    run(*world, 20);
    const JointState state = world->joint(pin);
    EXPECT_LT((state.pointA - state.pointB).norm(), 0.05);
    EXPECT_NEAR(state.force.y(), -98, 1);  // mass 1
    EXPECT_NEAR(world->bodies().position[0].x(), 0, 0.1);
    EXPECT_GT(world->bodies().position[0].y(), 0);
}

TEST(SoftJoints, APinToASingleParticleHoldsThatParticle)
{
    auto world = makeWorld({0, 98});
    const SoftBodyDef ball = softBall({0, 0}, 20, 2000, 4);
    world->addSoftBody(ball);
    const std::uint32_t particle = ball.borders[0][18];
    world->addJoint(
        jointOf(JointDef::Kind::Revolute, {kNoHandle, ball.particles[particle]}, {0, ball.particles[particle]}));
    run(*world, 10);
    EXPECT_LT((pointsOf(*world, 0)[particle] - ball.particles[particle]).norm(), 0.05);
    EXPECT_LT((world->bodies().position[0] - ball.particles[particle]).norm(), 30);
}

TEST(SoftJoints, AWeldKeepsAngleAndMomentumOfWhatItJoins)
{
    auto world = makeWorld({0, 0});
    world->addSoftBody(softBall({0, 0}, 20, 2000, 4));
    world->addRigidBody(box({50, 0}, 20, 20, 2));
    world->addJoint(jointOf(JointDef::Kind::Weld, {0, {15, 0}, 10}, {1, {40, 0}}));
    world->setVelocity(1, {0, 40});
    world->setOmega(0, 0.5);
    const Vec2 before = momentum(*world, {1, 2});
    run(*world, 5);
    EXPECT_LT((momentum(*world, {1, 2}) - before).norm(), 1e-9);
    EXPECT_NEAR(world->bodies().angle[0], world->bodies().angle[1], 0.2);
    EXPECT_GT(std::abs(world->bodies().angle[1]), 1);  // they turn about each other
}

TEST(SoftJoints, ARopeHoldsAtItsLengthAndDoesNotPush)
{
    auto world = makeWorld({0, 98});
    world->addSoftBody(softBall({0, 0}, 10, 2000, 4));
    JointDef def = jointOf(JointDef::Kind::Rope, {kNoHandle, {0, -20}}, {0, {0, 0}, 5});
    def.length = 60;
    const JointHandle rope = world->addJoint(def);
    run(*world, 0.3);
    EXPECT_NEAR(world->bodies().position[0].y(), 0.5 * 98 * 0.09, 0.4);  // free as yet
    run(*world, 10);
    EXPECT_NEAR(world->joint(rope).value, 60, 0.1);
}

TEST(SoftJoints, ADistanceJointKeepsTwoSoftBallsApart)
{
    auto world = makeWorld({0, 0});
    world->addSoftBody(softBall({0, 0}, 10, 2000, 4));
    world->addSoftBody(softBall({40, 0}, 10, 2000, 4));
    const JointHandle rod = world->addJoint(jointOf(JointDef::Kind::Distance, {0, {0, 0}, 4}, {1, {40, 0}, 4}));
    world->setVelocity(1, {-30, 20});
    run(*world, 5);
    EXPECT_NEAR(world->joint(rod).value, 40, 0.2);
}

TEST(SoftJoints, AMouseDragsABallToItsTarget)
{
    auto world = makeWorld({0, 98});
    world->addSoftBody(softBall({0, 0}, 20, 500, 2));
    JointDef def = jointOf(JointDef::Kind::Mouse, {kNoHandle, {0, 0}}, {0, {0, 0}, 8});
    def.maxForce = 5000;
    def.hertz = 4;
    const JointHandle mouse = world->addJoint(def);
    world->setJointTarget(mouse, {150, -80});
    run(*world, 5);
    EXPECT_LT((world->bodies().position[0] - Vec2(150, -80)).norm(), 1.5);  // it sags by g / (2 pi 4)²
    world->removeJoint(mouse);
    run(*world, 1);
    EXPECT_GT(world->bodies().position[0].y(), -50);
}

TEST(SoftJoints, AMotorTurnsASoftWheel)
{
    auto world = makeWorld({0, 0});
    world->addSoftBody(softBall({0, 0}, 20, 5000, 10));
    JointDef def = jointOf(JointDef::Kind::Revolute, {kNoHandle, {0, 0}}, {0, {0, 0}, 12});
    def.driven = true;
    def.motorSpeed = 2;
    def.maxTorque = 1e4;
    world->addJoint(def);
    run(*world, 5);
    EXPECT_NEAR(world->bodies().omega[0], 2, 0.05);
    EXPECT_LT(world->bodies().position[0].norm(), 0.5);
}

TEST(SoftJoints, APrismaticJointSlidesAlongItsAxisAndAWheelCarriesItsSpring)
{
    for (const auto kind : {JointDef::Kind::Prismatic, JointDef::Kind::Wheel}) {
        auto world = makeWorld({30, 98});
        world->addSoftBody(softBall({0, 0}, 20, 5000, 10));
        JointDef def = jointOf(kind, {kNoHandle, {0, 0}}, {0, {0, 0}, 12});
        def.axis = {1, 0};
        def.limited = true;
        def.lower = -50, def.upper = 50;
        world->addJoint(def);
        run(*world, 10);
        EXPECT_NEAR(world->bodies().position[0].x(), 50, 1.5);
        EXPECT_NEAR(world->bodies().position[0].y(), 0, 2);
    }
}

TEST(SoftJoints, AJointBreaksAboveItsForceAndLetsTheTwoCollide)
{
    for (const double strength : {60.0, 300.0}) {
        auto world = makeWorld({0, 98});
        world->addSoftBody(softBall({0, 0}, 20, 2000, 4));
        JointDef def = jointOf(JointDef::Kind::Revolute, {kNoHandle, {0, -16}}, {0, {0, -16}, 8});
        def.breakForce = strength;
        const JointHandle pin = world->addJoint(def);
        run(*world, 3);
        EXPECT_EQ(world->joint(pin).broken, strength < 98);
        EXPECT_EQ(world->bodies().position[0].y() > 100, strength < 98);
    }
}

TEST(SoftJoints, JoinedBodiesPassEachOtherUnlessAsked)
{
    for (const bool collide : {false, true}) {
        auto world = makeWorld({0, 0});
        world->addSoftBody(softBall({0, 0}, 20, 2000, 4));
        world->addSoftBody(softBall({60, 0}, 20, 2000, 4));
        JointDef def = jointOf(JointDef::Kind::Rope, {0, {0, 0}, 8}, {1, {60, 0}, 8});
        def.length = 100;
        def.collide = collide;
        world->addJoint(def);
        world->setVelocity(1, {-60, 0});
        bool touched = false;
        for (int i = 0; i < 60; ++i) {
            world->step(kStep);
            touched |= world->touching(0, 1);
        }
        EXPECT_EQ(touched, collide);
    }
}

TEST(SoftJoints, WhatNeedsADirectionIsRefusedAtASingleParticle)
{
    auto world = makeWorld({0, 98});
    const SoftBodyDef ball = softBall({0, 0}, 20);
    world->addSoftBody(ball);
    const Vec2 at = ball.particles[0];
    for (const auto kind : {JointDef::Kind::Weld, JointDef::Kind::Prismatic}) {
        try {
            world->addJoint(jointOf(kind, {kNoHandle, at}, {0, at}));
            FAIL() << "was not refused";
        } catch (const Failure& failure) {
            EXPECT_NE(std::string(failure.what()).find("single particle"), std::string::npos);
        }
    }
    EXPECT_THROW(world->addJoint(jointOf(JointDef::Kind::Revolute, {kNoHandle, at}, {0, {200, 0}, 5})), Failure);
    EXPECT_THROW(world->addJoint(jointOf(JointDef::Kind::Revolute, {0, at}, {0, at})), Failure);
    EXPECT_EQ(world->jointCount(), 0u);
}

TEST(SoftJoints, ARestoredJointHasTheSameFuture)
{
    auto world = makeWorld({0, 98});
    world->addSoftBody(softBall({0, 0}, 20, 2000, 4));
    world->addRigidBody(box({50, 0}, 20, 20, 2));
    world->addJoint(jointOf(JointDef::Kind::Revolute, {kNoHandle, {0, -16}}, {0, {0, -16}, 8}));
    JointDef weak = jointOf(JointDef::Kind::Weld, {0, {15, 0}, 10}, {1, {40, 0}});
    weak.breakForce = 150;
    world->addJoint(weak);
    run(*world, 0.5);
    const auto saved = world->save();
    run(*world, 3);
    const auto expected = world->hash();
    world->restore(saved);
    run(*world, 3);
    EXPECT_EQ(world->hash(), expected);
}

}  // namespace jet::physics::test
