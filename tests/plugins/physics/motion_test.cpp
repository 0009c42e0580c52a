// Free motion against the formulas of semi-implicit Euler and of mechanics.
#include "scenes.hpp"

namespace jet::physics::test {

namespace {

/// Substeps of a step of 1/60 s where no spring asks for more.
constexpr int kSubsteps = 8;

TEST(Motion, FreeFallIsSemiImplicitEulerOverTheSubsteps)
{
    const double g = 100, h = kStep / kSubsteps;
    auto world = makeWorld({0, g});
    RigidBodyDef def = box({3, 5}, 10, 10);
    def.common.velocity = {7, -20};
    world->addRigidBody(def);
    run(*world, 1);
    const double n = 60 * kSubsteps;
    EXPECT_NEAR(world->bodies().position[0].x(), 3 + 7 * 1.0, 1e-9);
    EXPECT_NEAR(world->bodies().position[0].y(), 5 - 20 + g * h * h * n * (n + 1) / 2, 1e-9);
    EXPECT_NEAR(world->bodies().velocity[0].y(), -20 + g, 1e-9);
}

TEST(Motion, AStepTellsItsSubstepsAndThoseOfItsParts)
{
    auto hard = makeWorld({0, 100});
    hard->addRigidBody(box({0, 0}, 10, 10));
    hard->step(kStep);
    EXPECT_EQ(hard->stats().substeps, 8U) << "480 a second";
    hard->step(0.1);
    EXPECT_EQ(hard->stats().substeps, 48U) << "two parts";
    auto soft = makeWorld({0, 100});
    soft->addSoftBody(softBall({200, 0}, 30, 5));
    soft->step(kStep);
    const auto few = soft->stats().substeps;
    soft->step(0.1);
    EXPECT_GT(soft->stats().substeps, 5 * few) << "two parts";
    WorldSettings settings;
    settings.substeps = 3;
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(box({0, 0}, 10, 10));
    world->step(kStep);
    EXPECT_EQ(world->stats().substeps, 3U);
}

TEST(Motion, SoftAndRigidBodiesFallAlike)
{
    auto world = makeWorld({0, 300});
    world->addRigidBody(box({0, 0}, 10, 10, 5));
    world->addSoftBody(softBall({200, 0}, 30, 5));
    run(*world, 1);
    EXPECT_NEAR(world->bodies().position[0].y(), world->bodies().position[1].y(), 1e-9);
}

TEST(Motion, GravityScaleAndFixedAreRespected)
{
    auto world = makeWorld({0, 100});
    RigidBodyDef floating = box({0, 0}, 10, 10);
    floating.common.gravityScale = 0;
    world->addRigidBody(floating);
    RigidBodyDef still = box({50, 0}, 10, 10);
    still.common.fixed = true;
    still.common.velocity = {10, 0};
    world->addRigidBody(still);
    SoftBodyDef stuck = softBall({200, 0}, 30);
    stuck.common.fixed = true;
    world->addSoftBody(stuck);
    run(*world, 1);
    EXPECT_EQ(world->bodies().position[0], Vec2(0, 0));
    EXPECT_NEAR(world->bodies().position[1].x(), 50, 1e-12);
    for (std::size_t i = 0; i < stuck.particles.size(); ++i) EXPECT_EQ(pointsOf(*world, 2)[i], stuck.particles[i]);
}

TEST(Motion, DampingIsExponential)
{
    WorldSettings settings;
    settings.gravity = {0, 0};
    settings.linearDamping = 0.7;
    settings.angularDamping = 1.3;
    auto world = JetPhysics().createWorld(settings);
    RigidBodyDef def = box({0, 0}, 10, 10);
    def.common.velocity = {100, 0};
    def.common.omega = 5;
    world->addRigidBody(def);
    SoftBodyDef soft = softBall({0, 500}, 50, 400, 1);
    soft.common.omega = 0.5;
    world->addSoftBody(soft);
    run(*world, 2);
    EXPECT_NEAR(world->bodies().velocity[0].x(), 100 * std::exp(-1.4), 1e-9);
    EXPECT_NEAR(world->bodies().omega[0], 5 * std::exp(-2.6), 1e-9);
    EXPECT_NEAR(world->bodies().omega[1], 0.5 * std::exp(-2.6 - 1.4), 0.01);
}

TEST(Motion, TheFourSwitchesWork)
{
    WorldSettings settings;
    settings.gravity = {0, 100};
    settings.linearDamping = 5;
    settings.applyGravity = settings.applyDamping = false;
    auto world = JetPhysics().createWorld(settings);
    RigidBodyDef def = box({0, 0}, 10, 10);
    def.common.velocity = {3, 0};
    world->addRigidBody(def);
    run(*world, 1);
    EXPECT_NEAR(world->bodies().position[0].x(), 3, 1e-9);
    EXPECT_EQ(world->bodies().position[0].y(), 0);

    for (const bool find : {true, false}) {
        WorldSettings passing = settings;
        passing.gravity = {0, 500};
        passing.applyGravity = true;
        passing.findCollisions = find;
        passing.resolveCollisions = false;
        auto ghost = JetPhysics().createWorld(passing);
        ghost->addRigidBody(box({0, -12}, 10, 10));
        ghost->addRigidBody(ground(0));
        bool touched = false;
        for (int i = 0; i < 60; ++i) {
            ghost->step(kStep);
            touched |= ghost->touching(0, 1);
        }
        EXPECT_GT(ghost->bodies().position[0].y(), 100) << "resolving is off";
        EXPECT_EQ(touched, find);
    }
}

TEST(Motion, APolygonsInertiaFollowsFromItsArea)
{
    // alpha = torque * t / I; I of a box is m (w² + h²) / 12, of a frame the difference of the two boxes.
    const auto inertiaOf = [](const RigidBodyDef& def) {
        auto world = makeWorld({0, 0});
        const BodyHandle body = world->addRigidBody(def);
        world->addTorque({{body, def.borders[0][0]}, 1000});
        world->step(kStep);
        return 1000 * kStep / world->bodies().omega[body];
    };
    EXPECT_NEAR(inertiaOf(box({100, 50}, 30, 40, 3)), 3 * (900 + 1600) / 12.0, 1e-6);

    RigidBodyDef frame = box({-70, 20}, 60, 60, 2);
    frame.borders.push_back(boxRing({-70, 20}, 40, 40));
    const double outer = 3600, inner = 1600;
    EXPECT_NEAR(inertiaOf(frame), 2 / (outer - inner) * (outer * 7200 - inner * 3200) / 12, 1e-6);

    std::swap(frame.borders[0], frame.borders[1]);
    std::reverse(frame.borders[0].begin(), frame.borders[0].end());
    EXPECT_NEAR(inertiaOf(frame), 2 / (outer - inner) * (outer * 7200 - inner * 3200) / 12, 1e-6)
        << "neither the order of the borders nor their direction matters";
}

TEST(Motion, AnOffCentreHoleMovesTheCentreOfMass)
{
    auto world = makeWorld({0, 0});
    RigidBodyDef def = box({0, 0}, 40, 40);
    def.borders.push_back(boxRing({10, 0}, 10, 10));
    world->addRigidBody(def);
    EXPECT_NEAR(world->bodies().position[0].x(), -10 * 100.0 / 1500, 1e-9);
}

TEST(Motion, TorqueForceAndImpulseActAtTheCentre)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(box({0, 0}, 12, 12, 2));
    world->addSoftBody(softBall({100, 0}, 20));
    world->applyForce(0, {60, 0});
    world->applyImpulse(1, {0, 4});
    world->step(kStep);
    EXPECT_NEAR(world->bodies().velocity[0].x(), 60 * kStep / 2, 1e-12);
    EXPECT_NEAR(world->bodies().velocity[1].y(), 4, 1e-9);
    world->step(kStep);
    EXPECT_NEAR(world->bodies().velocity[0].x(), 60 * kStep / 2, 1e-12) << "applyForce holds for one step only";
    world->setVelocity(1, {1, 2});
    world->setOmega(1, 0.25);
    EXPECT_NEAR((world->bodies().velocity[1] - Vec2(1, 2)).norm(), 0, 1e-9);
    EXPECT_NEAR(world->bodies().omega[1], 0.25, 1e-9);
    world->setPosition(1, {-5, -6});
    EXPECT_NEAR((world->bodies().position[1] - Vec2(-5, -6)).norm(), 0, 1e-9);
}

TEST(Motion, TheAngleOfATurningSoftBodyGoesOnBeyondAFullTurn)
{
    auto world = makeWorld({0, 0});
    SoftBodyDef def = softBall({0, 0}, 30, 500, 1);
    def.common.omega = 3;
    world->addSoftBody(def);
    run(*world, 6);
    EXPECT_NEAR(world->bodies().angle[0], 18, 1.0);  // it widens a little, so turns a little slower
    EXPECT_GT(world->bodies().angle[0], 2 * 3.1416);
}

}  // namespace

}  // namespace jet::physics::test
