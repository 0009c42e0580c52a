// Contacts over concave borders, holes, materials and sensors; what the contact records say.
#include "scenes.hpp"

namespace jet::physics::test {

namespace {

/// A valley between two hills, closed below.
RigidBodyDef valley()
{
    std::vector<Vec2> ring;
    for (int i = 0; i <= 200; ++i) {
        const double x = -400 + 4.0 * i;
        ring.push_back({x, -200 * (x / 400) * (x / 400)});
    }
    ring.push_back({400, 300});
    ring.push_back({-400, 300});
    return fixed({ring});
}

TEST(Collision, AParticleRestsInTheBottomOfAPit)
{
    auto world = makeWorld({0, 300}, 0.3);
    world->addRigidBody(fixed({{{-100, 0}, {0, 60}, {100, 0}, {100, 200}, {-100, 200}}}));
    SoftBodyDef point;
    point.particles = {{-20, 0}};
    point.masses = {1};
    world->addSoftBody(point);
    run(*world, 6);
    EXPECT_NEAR(world->bodies().position[1].x(), 0, 0.3);
    EXPECT_NEAR(world->bodies().position[1].y(), 60, 0.3);
    EXPECT_LT(world->bodies().velocity[1].norm(), 0.1);
    EXPECT_GE(world->contacts().size(), 2u) << "both walls of the pit hold it";
}

TEST(Collision, BallsComeToRestOnConcaveGround)
{
    auto world = makeWorld({0, 400}, 0.4);
    world->addRigidBody(valley());
    const SoftBodyDef soft = softBall({-250, -250}, 40, 400, 3);
    world->addSoftBody(soft);
    world->addRigidBody(rigid({circleRing({200, -200}, 20, 24)}, 0.5));
    world->addRigidBody(box({50, -200}, 30, 30, 0.5, 0.3));
    double least = 1;
    for (int i = 0; i < 900; ++i) {
        world->step(kStep);
        least = std::min(least, areaRatio(*world, 1, soft));
    }
    EXPECT_GT(least, 0.7);
    for (BodyHandle body = 1; body <= 3; ++body) {
        const Vec2 at = world->bodies().position[body];
        EXPECT_FALSE(world->contains(0, at)) << body;
        EXPECT_LT(std::abs(at.x()), 200) << body;
        EXPECT_LT(world->bodies().velocity[body].norm(), 15) << body;
    }
}

TEST(Collision, ABallInARingStaysInTheRing)
{
    for (const bool soft : {false, true}) {
        auto world = makeWorld({0, 200}, 0.2, 0.9);
        world->addRigidBody(fixed({circleRing({0, 0}, 110, 60), circleRing({0, 0}, 100, 60)}));
        if (soft) {
            SoftBodyDef ball = softBall({0, 30}, 20, 300, 0.5);
            ball.common.velocity = {300, -100};
            world->addSoftBody(ball);
        } else {
            RigidBodyDef ball = rigid({circleRing({0, 30}, 12, 16)});
            ball.common.velocity = {400, -100};
            world->addRigidBody(ball);
        }
        for (int i = 0; i < 600; ++i) {
            world->step(kStep);
            for (const Vec2& p : pointsOf(*world, 1))
                ASSERT_LT(p.norm(), 101.5) << (soft ? "soft" : "rigid") << " step " << i;
        }
        EXPECT_FALSE(world->contains(0, {0, 0}));
        EXPECT_TRUE(world->contains(0, {105, 0}));
    }
}

TEST(Collision, ABoxSlidesOverSeamsWithoutCatching)
{
    // Twenty flush tiles and one polyline of equal length: the box must get as far on both.
    double reached[2];
    for (const bool tiles : {false, true}) {
        auto world = makeWorld({0, 400}, 0);
        RigidBodyDef sliding = box({0, -10}, 20, 20);
        sliding.common.velocity = {120, 0};
        world->addRigidBody(sliding);
        if (tiles) {
            for (int i = 0; i < 20; ++i) world->addRigidBody(fixed({boxRing({i * 40.0, 20}, 40, 40)}));
        } else {
            std::vector<Vec2> ring;
            for (int i = 0; i <= 20; ++i) ring.push_back({i * 40.0 - 20, 0});
            ring.push_back({780, 40});
            ring.push_back({-20, 40});
            world->addRigidBody(fixed({ring}));
        }
        run(*world, 5);
        reached[tiles] = world->bodies().position[0].x();
    }
    EXPECT_NEAR(reached[0], 600, 1);
    EXPECT_NEAR(reached[1], 600, 1);
}

TEST(Collision, MaterialsDecideWhatCollides)
{
    WorldSettings settings;
    settings.gravity = {0, 300};
    settings.materialCount = 2;
    settings.materials.assign(4, MaterialPair{0.5, 0, true});
    settings.materials[1].collides = settings.materials[2].collides = false;
    auto world = JetPhysics().createWorld(settings);
    RigidBodyDef solid = box({0, -50}, 20, 20), ghost = box({100, -50}, 20, 20);
    ghost.common.material = 1;
    world->addRigidBody(solid);
    world->addRigidBody(ghost);
    world->addRigidBody(ground(0));
    run(*world, 2);
    EXPECT_NEAR(world->bodies().position[0].y(), -10, 0.2);
    EXPECT_GT(world->bodies().position[1].y(), 300);
    EXPECT_FALSE(world->touching(1, 2));
}

TEST(Collision, ASensorReportsAndDoesNotResolve)
{
    auto world = makeWorld({0, 0});
    RigidBodyDef zone = fixed({boxRing({100, 0}, 80, 80)});
    zone.common.sensor = true;
    world->addRigidBody(zone);
    RigidBodyDef visitor = box({0, 0}, 10, 10);
    visitor.common.velocity = {100, 0};
    world->addRigidBody(visitor);
    SoftBodyDef soft = softBall({0, 20}, 10, 100, 1, 12, 2);
    soft.common.velocity = {100, 0};
    world->addSoftBody(soft);
    for (int i = 0; i < 180; ++i) {
        world->step(kStep);
        const double x = world->bodies().position[1].x();
        if (x > 70 && x < 130) {
            EXPECT_TRUE(world->touching(0, 1)) << "x " << x;
            EXPECT_TRUE(world->touching(0, 2)) << "x " << x;
        }
        if (x < 50 || x > 150) {
            EXPECT_FALSE(world->touching(0, 1)) << "x " << x;
        }
    }
    EXPECT_NEAR(world->bodies().position[1].x(), 300, 1e-6);
}

TEST(Collision, AContactRecordExplainsItself)
{
    auto world = makeWorld({0, 400});
    world->addRigidBody(ground(0, 200));
    world->addRigidBody(box({30, -10.05}, 20, 20, 2));
    run(*world, 1);
    ASSERT_EQ(world->contacts().size(), 2u);
    double weight = 0;
    for (const Contact& contact : world->contacts()) {
        EXPECT_EQ(contact.bodyA, 1u);
        EXPECT_EQ(contact.bodyB, 0u);
        EXPECT_NEAR((contact.point - pointsOf(*world, 1)[contact.particle]).norm(), 0, 1e-9);
        const auto walls = pointsOf(*world, 0);
        const Vec2 a = walls[contact.wall], b = walls[(contact.wall + 1) % walls.size()];
        const Vec2 hit = a + contact.edgeParameter * (b - a);
        EXPECT_NEAR((hit - contact.point).norm(), std::abs(contact.penetration), 1e-6);
        EXPECT_NEAR((contact.normal - Vec2(0, -1)).norm(), 0, 1e-9);
        weight += contact.impulse;
    }
    EXPECT_NEAR(weight, 2 * 400 * kStep, 0.02 * weight) << "the ground bears the box's weight";
    EXPECT_EQ(world->stats().contacts, 2u);
}

TEST(Collision, ContactsPushBothBodiesEqually)
{
    auto world = makeWorld({0, 0}, 0.5, 0.4);
    SoftBodyDef soft = softBall({-60, 3}, 30, 300, 1);
    soft.common.velocity = {120, 0};
    RigidBodyDef hard = box({40, 0}, 40, 40, 1.5, 0.2);
    hard.common.velocity = {-40, 0};
    world->addSoftBody(soft);
    world->addRigidBody(hard);
    const Vec2 before = 1.0 * Vec2(120, 0) + 1.5 * Vec2(-40, 0);
    run(*world, 2);
    const Vec2 after = world->bodies().velocity[0] + 1.5 * world->bodies().velocity[1];
    EXPECT_NEAR((after - before).norm(), 0, 1e-8);
    EXPECT_GT(world->bodies().velocity[1].x(), -40);
}

TEST(Collision, ContainsAnswersForEveryKindOfBody)
{
    auto world = makeWorld({0, 0});
    RigidBodyDef frame = box({0, 0}, 60, 60);
    frame.borders.push_back(boxRing({0, 0}, 40, 40));
    frame.common.omega = 1;
    world->addRigidBody(frame);
    world->addSoftBody(softBall({200, 0}, 30));
    run(*world, 0.5);
    EXPECT_FALSE(world->contains(0, {0, 0}));
    EXPECT_TRUE(world->contains(0, {25, 0}));
    EXPECT_FALSE(world->contains(0, {45, 0}));
    EXPECT_TRUE(world->contains(1, {200, 0}));
    EXPECT_FALSE(world->contains(1, {231, 0}));
}

}  // namespace

}  // namespace jet::physics::test
