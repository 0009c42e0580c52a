// One-sided platforms and soft bodies: from below they pass, from above they are held.
#include "scenes.hpp"

namespace jet::physics::test {

namespace {

constexpr double kRadius = 12;

struct Jump {
    std::unique_ptr<PhysicsWorld> world;
    int begins = 0, ends = 0;
    double highest = 1e9;

    Jump(double thickness, const Vec2& at, double speed, double ks = 3000)
    {
        world = makeWorld({0, 300}, 0.3);
        RigidBodyDef platform = simple(fixed({boxRing({0, 0.5 * thickness}, 200, thickness)}));
        platform.common.oneSided = {0, -1};
        world->addRigidBody(platform);
        SoftBodyDef ball = softBall(at, kRadius, ks, 2, 14, 2);
        ball.common.velocity = {0, -speed};
        world->addSoftBody(ball);
    }
    void run(double seconds, double step)
    {
        for (int i = 0; i < static_cast<int>(seconds / step + 0.5); ++i) {
            world->step(step);
            highest = std::min(highest, y());
            for (const ContactEvent& event : world->contactEvents()) (event.begins ? begins : ends) += 1;
        }
    }
    double y() const { return world->bodies().position[1].y(); }
};

TEST(SoftPlatform, ASoftBallJumpsThroughItFromBelowAndLandsOnIt)
{
    for (const double thickness : {1.0, 10.0}) {
        for (const double speed : {260.0, 450.0, 1500.0}) {
            for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
                Jump jump(thickness, {10, 60}, speed);
                jump.run(2 * speed / 300 + 3, step);
                const auto what = std::to_string(thickness) + " thick, speed " + std::to_string(speed) + ", step " +
                                  std::to_string(step);
                const double height = speed * speed / 600;
                EXPECT_NEAR(jump.highest, 60 - height, 0.03 * height + 2 * speed * step)
                    << "nothing slowed it; " << what;
                EXPECT_LT(jump.y(), -0.7 * kRadius) << "it came down on top, or still bounces there; " << what;
                EXPECT_GE(jump.begins, 1) << what;
                EXPECT_NEAR(jump.begins - jump.ends, 0.5, 0.5) << what;
            }
        }
    }
}

TEST(SoftPlatform, WhatDoesNotComeThroughFallsBackFreely)
{
    for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
        Jump jump(10, {10, 60}, 190);
        jump.run(2, step);
        EXPECT_LT(jump.highest, 4) << "its upper half was above";
        EXPECT_GT(jump.y(), 150) << "its lower half was not, so it is not held";
        EXPECT_EQ(jump.begins, 0) << "it never touched";
    }
}

TEST(SoftPlatform, AFastSoftBallFromAboveDoesNotPass)
{
    for (const double thickness : {1.0, 10.0}) {
        for (const double speed : {100.0, 1000.0, 5000.0}) {
            for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
                Jump jump(thickness, {10, -100}, -speed);
                jump.run(6, step);
                EXPECT_LT(jump.y(), -0.7 * kRadius) << thickness << " thick, speed " << speed << ", step " << step;
            }
        }
    }
}

TEST(SoftPlatform, ItHoldsASoftBallForGood)
{
    for (const double ks : {200.0, 3000.0, 1e6}) {
        Jump jump(1, {10, -20}, 0, ks);
        jump.run(20, kStep);
        EXPECT_NEAR(jump.y(), -kRadius, 6) << "stiffness " << ks;
        EXPECT_EQ(jump.begins, jump.ends + 1);
    }
}

TEST(SoftPlatform, ARestoredJumpHasTheSameFuture)
{
    for (const int saveAt : {10, 20, 60, 200}) {  // below it, within it, above it, on it
        Jump jump(10, {10, 60}, 450);
        for (int i = 0; i < saveAt; ++i) jump.world->step(kStep);
        const auto saved = jump.world->save();
        std::vector<std::uint64_t> future;
        for (int i = 0; i < 200; ++i) jump.world->step(kStep), future.push_back(jump.world->hash());
        Jump equal(10, {10, 60}, 450);
        equal.world->restore(saved);
        for (int i = 0; i < 200; ++i) {
            equal.world->step(kStep);
            ASSERT_EQ(equal.world->hash(), future[static_cast<std::size_t>(i)]) << saveAt << " + " << i;
        }
    }
}

TEST(SoftPlatform, ItsSideCanBeChangedWhileTheWorldRuns)
{
    Jump jump(10, {10, 60}, 450);
    BodyCommon common;
    common.fixed = true;
    jump.world->setBody(0, common);
    jump.run(1, kStep);
    EXPECT_GT(jump.highest, 10) << "now it is solid from below";
}

}  // namespace

}  // namespace jet::physics::test
