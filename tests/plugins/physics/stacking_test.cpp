// Rigid bodies at rest on each other: friction, restitution, stacks.
#include "scenes.hpp"

namespace jet::physics::test {

namespace {

TEST(Stacking, ABoxComesToRestOnTheGround)
{
    auto world = makeWorld({0, 400});
    world->addRigidBody(box({0, -40}, 30, 30));
    world->addRigidBody(ground(0));
    run(*world, 2);
    EXPECT_NEAR(world->bodies().position[0].y(), -15, 0.15);
    EXPECT_NEAR(world->bodies().angle[0], 0, 1e-3);
    EXPECT_LT(world->bodies().velocity[0].norm(), 0.01);
    EXPECT_TRUE(world->touching(0, 1));
    EXPECT_TRUE(world->touching(1, 0));
    EXPECT_FALSE(world->touching(0, 0));
}

TEST(Stacking, TenBoxesStandForTenSeconds)
{
    for (const double gravity : {100.0, 500.0, 1000.0}) {
        auto world = makeWorld({0, gravity});
        for (int i = 0; i < 10; ++i) world->addRigidBody(box({0, -15.0 - 30 * i}, 30, 30));
        world->addRigidBody(ground(0));
        run(*world, 10);
        for (int i = 0; i < 10; ++i) {
            const Vec2 at = world->bodies().position[i];
            EXPECT_NEAR(at.x(), 0, 0.5) << "box " << i << " at gravity " << gravity;
            EXPECT_NEAR(at.y(), -15.0 - 30 * i, 0.15 * (i + 1)) << "box " << i << " at gravity " << gravity;
            EXPECT_LT(world->bodies().velocity[i].norm(), 0.5);
        }
    }
}

TEST(Stacking, APyramidKeepsItsShape)
{
    auto world = makeWorld({0, 500});
    std::vector<Vec2> placed;
    const int rows = 12;
    for (int row = 0; row < rows; ++row) {
        for (int i = 0; i < rows - row; ++i) {
            placed.push_back({(i - (rows - row - 1) / 2.0) * 32, -15.0 - 30 * row});
            world->addRigidBody(box(placed.back(), 30, 30));
        }
    }
    world->addRigidBody(ground(0));
    run(*world, 8);
    for (std::size_t i = 0; i < placed.size(); ++i)
        EXPECT_NEAR((world->bodies().position[i] - placed[i]).norm(), 0, 2) << "box " << i;
}

/// Slides a box down a slope of `slope` radians for two seconds; how far does it get along it?
double slide(double slope, double friction, double gravity)
{
    auto world = makeWorld(gravity * Vec2(std::sin(slope), std::cos(slope)), friction);
    world->addRigidBody(box({0, -10}, 40, 20));
    world->addRigidBody(ground(0, 20000));
    run(*world, 0.5);
    const double start = world->bodies().position[0].x(), speed = world->bodies().velocity[0].x();
    run(*world, 2);
    return world->bodies().position[0].x() - start - 2 * speed;
}

TEST(Stacking, ABoxSticksBelowTheFrictionAngleAndSlidesAboveIt)
{
    const double gravity = 300;
    for (const double friction : {0.2, 0.6, 1.0}) {
        const double angle = std::atan(friction);
        EXPECT_NEAR(slide(angle * 0.97, friction, gravity), 0, 0.05) << "friction " << friction;
        const double steep = angle * 1.1;
        const double expected = 0.5 * gravity * (std::sin(steep) - friction * std::cos(steep)) * 4;
        EXPECT_NEAR(slide(steep, friction, gravity), expected, 0.03 * expected) << "friction " << friction;
    }
}

TEST(Stacking, ABallBouncesToTheSquareOfItsRestitution)
{
    for (const double restitution : {0.0, 0.3, 0.5, 0.8, 1.0}) {
        auto world = makeWorld({0, 400}, 0, restitution);
        const double drop = 100;
        world->addRigidBody(rigid({circleRing({0, -drop - 10}, 10, 32)}));
        world->addRigidBody(ground(0));
        double highest = 0;
        bool bounced = false;
        for (int i = 0; i < 150; ++i) {
            world->step(kStep);
            bounced |= world->touching(0, 1);
            const double height = -world->bodies().position[0].y() - 10;
            if (bounced && world->bodies().velocity[0].y() < 0) highest = std::max(highest, height);
        }
        EXPECT_TRUE(bounced);
        EXPECT_NEAR(highest, restitution * restitution * drop, 0.03 * drop) << "restitution " << restitution;
    }
}

TEST(Stacking, AHeavyBoxStandsOnALightOne)
{
    auto world = makeWorld({0, 300});
    world->addRigidBody(box({0, -15}, 30, 30, 1));
    world->addRigidBody(box({0, -45}, 30, 30, 50));
    world->addRigidBody(ground(0));
    run(*world, 5);
    EXPECT_NEAR(world->bodies().position[0].y(), -15, 1.5);
    EXPECT_NEAR(world->bodies().position[1].y(), -45, 2.5);
}

TEST(Stacking, OverlappingBodiesPartWithoutAPop)
{
    auto world = makeWorld({0, 0}, 0.3);
    world->addRigidBody(box({0, 0}, 30, 30));
    world->addRigidBody(box({20, 3}, 30, 30));
    double fastest = 0;
    for (int i = 0; i < 120; ++i) {
        world->step(kStep);
        fastest = std::max({fastest, world->bodies().velocity[0].norm(), world->bodies().velocity[1].norm()});
    }
    for (const Contact& contact : world->contacts()) EXPECT_LT(contact.penetration, 0.3);
    EXPECT_LT(fastest, 150);
    EXPECT_LT(world->bodies().velocity[0].norm(), 5) << "the push does not become speed";
}

}  // namespace

}  // namespace jet::physics::test
