// Fast bodies against thin walls at default settings: none may pass.
#include "scenes.hpp"

namespace jet::physics::test {

namespace {

// Scaled from 0.1 m balls at 10..390 m/s against 0.1 m walls, 20 units a metre.
constexpr double kScale = 20;

enum class Kind { Disc, Box, Soft };

/// Twenty bodies of speeds 10..390 m/s fly right at a plate that moves left at `wallSpeed`; how many get through it?
int passed(Kind kind, bool wallFixed, double wallSpeed, double turning = 0)
{
    int through = 0;
    for (int i = 0; i < 20; ++i) {
        const double speed = kScale * (10 + 20.0 * i);
        auto world = makeWorld({0, 0}, 0.3, 0.2);
        RigidBodyDef wall = box({200.3, 0}, 0.1 * kScale, 400, 1e5);
        wall.common.fixed = wallFixed;
        wall.common.velocity = {-wallSpeed, 0};
        world->addRigidBody(wall);
        const double radius = 0.1 * kScale;
        if (kind == Kind::Soft) {
            SoftBodyDef ball = softBall({0, 0.37 * i}, 3 * radius, 2000, 2, 12, 2);
            ball.common.velocity = {speed, 0};
            world->addSoftBody(ball);
        } else {
            RigidBodyDef ball = kind == Kind::Disc ? rigid({circleRing({0, 0.37 * i}, radius, 12)})
                                                   : box({0, 0.37 * i}, 2 * radius, 2 * radius, 1, 0.2 * i);
            ball.common.velocity = {speed, 0};
            ball.common.omega = turning;
            world->addRigidBody(ball);
        }
        const double seconds = 400 / std::max(speed, 200.0);
        for (double t = 0; t < seconds; t += kStep) world->step(kStep);
        if (world->bodies().position[1].x() > world->bodies().position[0].x() - 0.05 * kScale) ++through;
        if (world->bodies().bounds[1].max.x() > world->bodies().position[0].x() + 0.05 * kScale) ++through;
    }
    return through;
}

TEST(Tunnelling, NoDiscPassesAFixedWall) { EXPECT_EQ(passed(Kind::Disc, true, 0), 0); }
TEST(Tunnelling, NoDiscPassesAMovingWall)
{
    for (const double speed : {0.0, 100.0, 1000.0, 4000.0}) EXPECT_EQ(passed(Kind::Disc, false, speed), 0) << speed;
}
TEST(Tunnelling, NoDiscPassesAThinPlateThatRestsInFreeSpace)
{
    // What is hit is not held back by where it was expected: the two go on together, or the disc were through.
    for (const double speed : {60.0, 150.0, 390.0, 2000.0}) {
        for (const double offset : {0.0, 0.2, -0.4}) {
            auto world = makeWorld({0, 0});
            RigidBodyDef disc;
            disc.shapes = {{ShapeDef::Kind::Circle, {{-5, offset}}, 0.1}};
            disc.mass = 0.03;
            disc.common.velocity = {speed, 0};
            world->addRigidBody(disc);
            RigidBodyDef plate = simple(box({2, 0}, 0.1, 0.9, 0.09));
            plate.common.fixedRotation = true;  // else what hits its end would get round it
            world->addRigidBody(plate);
            for (int i = 0; i < 30; ++i) {
                world->step(kStep);
                ASSERT_LT(world->bodies().position[0].x(), world->bodies().position[1].x() + 0.2)
                    << speed << " " << offset << " step " << i;
            }
            EXPECT_GT(world->bodies().velocity[1].norm(), 0) << "it was hit";
        }
    }
}

TEST(Tunnelling, NoSpinningBoxPassesEither)
{
    EXPECT_EQ(passed(Kind::Box, true, 0, 30), 0);
    EXPECT_EQ(passed(Kind::Box, false, 1000, -30), 0);
}
TEST(Tunnelling, NoSoftBallPassesEither)
{
    EXPECT_EQ(passed(Kind::Soft, true, 0), 0);
    EXPECT_EQ(passed(Kind::Soft, false, 1000), 0);
}

TEST(Tunnelling, ADiscHitByAFastBodyDoesNotJumpTheWallBehindIt)
{
    // Nothing but the hit makes the disc fast, within the very step in which it must also be stopped.
    auto world = makeWorld({0, 0}, 0.3, 0);
    world->addRigidBody(fixed({boxRing({100.5, 0}, 1, 400)}));
    world->addRigidBody(rigid({circleRing({90, 0}, 5, 16)}, 0.1));
    RigidBodyDef hammer = box({0, 0}, 40, 40, 1);
    hammer.common.velocity = {5000, 0};
    world->addRigidBody(hammer);
    for (int i = 0; i < 60; ++i) {
        world->step(kStep);
        ASSERT_LT(world->bodies().position[1].x(), 100) << i;
        ASSERT_LT(world->bodies().position[2].x(), 100) << i;
    }
}

TEST(Tunnelling, ARainOfFastDiscsStaysInAThinBox)
{
    auto world = makeWorld({0, 1000}, 0.2, 0.5);
    world->addRigidBody(fixed({boxRing({0, 0}, 302, 302), boxRing({0, 0}, 300, 300)}));
    for (int i = 0; i < 36; ++i) {
        RigidBodyDef ball = rigid({circleRing({-125.0 + 50 * (i % 6), -125.0 + 50 * (i / 6)}, 4 + i % 5, 12)});
        ball.common.velocity = 2000.0 * Vec2(std::cos(i * 1.7), std::sin(i * 1.7));
        world->addRigidBody(ball);
    }
    run(*world, 5);
    const Box inner({-151, -151}, {151, 151});
    for (std::size_t body = 1; body < world->bodyCount(); ++body)
        EXPECT_TRUE(inner.contains(world->bodies().position[body]));
}

/// As long as it is alone, the ground is no long part of the world; when something small comes, it is one.
TEST(Tunnelling, AGroundThatWasAloneHoldsWhatComesLater)
{
    for (const double size : {1.0, 10.0, 300.0}) {
        auto world = makeWorld({0, 100});
        world->addRigidBody(simple(ground(0)));
        run(*world, 0.5);
        const BodyHandle body = world->addRigidBody(simple(box({0, -size - 5}, size, size)));
        run(*world, 2);
        EXPECT_NEAR(world->bodies().position[body].y(), -size / 2, 0.01 * size) << size;
    }
}

}  // namespace

}  // namespace jet::physics::test
