// Rigid bodies that sleep against soft ones that never move.
#include "shape_worlds.hpp"

namespace jet::physics::test {

namespace {

/// A ground that is a soft body without any freedom, a rigid wall that leans over it, and what the two hold.
struct Wedge {
    explicit Wedge(double turn)
    {
        WorldSettings settings = shapeSettings();
        settings.allowSleep = true;
        world = JetPhysics().createWorld(settings);
        SoftBodyDef floor = softBall({-30, 30}, 40, 2000, 5);
        floor.common.fixed = true;
        world->addSoftBody(floor);
        RigidBodyDef wall = simple(box({35, 10}, 40, 80, 1, turn));
        wall.common.fixed = true;
        world->addRigidBody(wall);
        held = world->addRigidBody(simple(box({5, -30}, 14, 14, 1, 0.3)));
    }
    bool settles()
    {
        for (int i = 0; i < 1200 && world->awake(held); ++i) world->step(kStep);
        return !world->awake(held);
    }

    std::unique_ptr<PhysicsWorld> world;
    BodyHandle held = 0;
};

TEST(SleepBesideSoft, WhatIsHeldBySoftBodiesThatAreFixedStaysWhereItSleeps)
{
    for (const double turn : {0.0, 0.15, 0.3, 0.45}) {
        Wedge wedge(turn);
        ASSERT_TRUE(wedge.settles()) << turn;
        PhysicsWorld& world = *wedge.world;
        const Vec2 at = world.bodies().position[wedge.held];
        const double angle = world.bodies().angle[wedge.held];
        EXPECT_TRUE(world.touching(0, wedge.held)) << turn;
        run(world, 5);
        EXPECT_FALSE(world.awake(wedge.held)) << turn;
        EXPECT_EQ(world.bodies().position[wedge.held], at) << turn;
        EXPECT_EQ(world.bodies().angle[wedge.held], angle) << turn;
        EXPECT_EQ(world.bodies().velocity[wedge.held], Vec2(0, 0)) << turn;
        double borne = 0;
        for (const Contact& contact : world.contacts())
            if (contact.bodyA == 0 || contact.bodyB == 0) borne += contact.impulse;
        EXPECT_GT(borne, 0) << turn << ": what bears it is still told";
    }
}

TEST(SleepBesideSoft, AStateThatIsRestoredIntoANewWorldGoesOnAsItWould)
{
    Wedge wedge(0.3), other(0.3);
    ASSERT_TRUE(wedge.settles());
    run(*wedge.world, 0.5);
    other.world->restore(wedge.world->save());
    for (int i = 0; i < 20; ++i) {
        wedge.world->step(kStep), other.world->step(kStep);
        ASSERT_EQ(wedge.world->hash(), other.world->hash()) << i;
    }
    wedge.world->setGravity({0, 50}), other.world->setGravity({0, 50});
    for (int i = 0; i < 60; ++i) wedge.world->step(kStep), other.world->step(kStep);
    EXPECT_EQ(wedge.world->hash(), other.world->hash()) << "woken";
}

}  // namespace

}  // namespace jet::physics::test
