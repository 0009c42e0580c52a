// Method::SemiImplicitEuler: the scheme of the thesis (§2.4.3.1) as it stands, with its errors.
#include "lattices.hpp"

#include <jet/result.hpp>

#include <limits>

namespace jet::physics::test {

namespace {

std::unique_ptr<PhysicsWorld> teachingWorld(const Vec2& gravity)
{
    WorldSettings settings;
    settings.gravity = gravity;
    settings.method = Method::SemiImplicitEuler;
    return JetPhysics().createWorld(settings);
}

/// Two particles on a spring, one of them fixed.
SoftBodyDef oscillator(double ks, double kd)
{
    SoftBodyDef def;
    def.particles = {{0, 0}, {12, 0}};
    def.masses = {1, 2};
    def.movable = {0, 1};
    def.springs = {{0, 1, 10, ks, kd, 0}};
    return def;
}

}  // namespace

TEST(Teaching, FreeFallIsLateByHalfAStepOfGravity)
{
    // v first, then x: x_n = g h² n (n + 1) / 2, which is g t h / 2 beyond the truth: an error of first order.
    for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
        auto world = teachingWorld({0, 98});
        world->addSoftBody(oscillator(0, 0));
        world->addRigidBody(box({500, 0}, 10, 10));
        const int count = static_cast<int>(std::lround(2 / h));
        for (int i = 0; i < count; ++i) world->step(h);
        const double beyond = 0.5 * 98 * 2 * h;
        EXPECT_NEAR(pointsOf(*world, 0)[1].y(), 0.5 * 98 * 4 + beyond, 1e-9);
        EXPECT_NEAR(world->bodies().position[1].y(), 0.5 * 98 * 4 + beyond, 1e-9);
        EXPECT_EQ(world->stats().substeps, 1u);

        auto rigidOnly = teachingWorld({0, 98});
        rigidOnly->addRigidBody(box({500, 0}, 10, 10));
        for (int i = 0; i < count; ++i) rigidOnly->step(h);
        EXPECT_NEAR(rigidOnly->bodies().position[0].y(), 0.5 * 98 * 4 + beyond, 1e-9);
    }
}

TEST(Teaching, ASpringsErrorHalvesWithTheStep)
{
    // x(t) = 10 + 2 cos(w t), w = sqrt(ks / m); a quarter period in, where the phase shows.
    double error[3];
    int k = 0;
    for (const int count : {100, 200, 400}) {
        auto world = teachingWorld({0, 0});
        world->addSoftBody(oscillator(50, 0));
        const double time = 3.14159265358979 / 2 / std::sqrt(50.0 / 2);
        for (int i = 0; i < count; ++i) world->step(time / count);
        error[k++] = std::abs(pointsOf(*world, 0)[1].x() - 10);
    }
    EXPECT_NEAR(error[0] / error[1], 2, 0.05);
    EXPECT_NEAR(error[1] / error[2], 2, 0.05);
}

TEST(Teaching, EachStepIsTheOneOfTheThesis)
{
    // F = -ks (d - d0) - kd v + m g, v += h F / m, x += h v: written out for a spring hanging along its axis.
    auto world = teachingWorld({30, 0});
    world->addSoftBody(oscillator(80, 1.5));
    double x = 12, v = 0;
    for (int i = 0; i < 200; ++i) {
        world->step(kStep);
        const double force = -80 * (x - 10) - 1.5 * v + 2 * 30;
        v += kStep * force / 2;
        x += kStep * v;
        ASSERT_NEAR(pointsOf(*world, 0)[1].x(), x, 1e-9) << i;
    }
}

TEST(Teaching, WhatExplodesIsStoppedByNameAndWithAdvice)
{
    auto world = teachingWorld({0, 98});
    world->addRigidBody(box({0, 0}, 10, 10));
    SoftBodyDef ball = defaultBall({100, 0}, 20, 1e7);
    ball.particles[3] += Vec2(0.5, 0);
    world->addSoftBody(ball);
    std::string said;
    try {
        for (int i = 0; i < 600; ++i) world->step(kStep);
    } catch (const Failure& failure) {
        said = failure.what();
    }
    EXPECT_NE(said.find("body 1"), std::string::npos) << said;
    EXPECT_NE(said.find("automatic"), std::string::npos) << said;
    EXPECT_TRUE(allFinite(*world));
    for (const Vec2& v : world->bodies().velocity) EXPECT_TRUE(isFinite(v));

    auto calm = makeWorld({0, 98});
    calm->addSoftBody(ball);
    EXPECT_NO_THROW(run(*calm, 10));
}

}  // namespace jet::physics::test
