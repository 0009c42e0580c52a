// Joints do no work: no net of them may gather energy it was not given, whatever is held by what; and what it was given
// stays.
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace jet::physics::test {

namespace {

using Kind = JointDef::Kind;

struct Mechanism {
    std::unique_ptr<PhysicsWorld> world;
    std::vector<double> mass, inertia;

    BodyHandle add(const Vec2& at, double width, double height, double m, const Vec2& velocity, double omega)
    {
        RigidBodyDef def = simple(box(at, width, height));
        def.mass = m, def.common.velocity = velocity, def.common.omega = omega;
        mass.push_back(m), inertia.push_back(m * (width * width + height * height) / 12);
        return world->addRigidBody(def);
    }
    double kineticEnergy() const
    {
        const BodyStates states = world->bodies();
        double sum = 0;
        for (std::size_t i = 0; i < mass.size(); ++i)
            sum += mass[i] / 2 * states.velocity[i].squaredNorm() + inertia[i] / 2 * std::pow(states.omega[i], 2);
        return sum;
    }
    Vec2 momentum() const
    {
        Vec2 sum(0, 0);
        for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * world->bodies().velocity[i];
        return sum;
    }
    double angularMomentum() const
    {
        const BodyStates states = world->bodies();
        double sum = 0;
        for (std::size_t i = 0; i < mass.size(); ++i)
            sum += mass[i] * cross(states.position[i], states.velocity[i]) + inertia[i] * states.omega[i];
        return sum;
    }
};

Mechanism weightless(Precision precision)
{
    WorldSettings settings;
    settings.gravity = {0, 0}, settings.precision = precision;
    settings.allowSleep = false, settings.findCollisions = false;
    Mechanism made;
    made.world = JetPhysics().createWorld(settings);
    return made;
}

/// Boxes of any masses that fly and turn at random, and joints of any kind between any of them and the background.
Mechanism randomMechanism(unsigned seed, double massRatio, double spin, double& step)
{
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) { return random() % n; };
    const auto between = [&](double a, double b) { return a + (b - a) * (random() / 4294967296.0); };
    Mechanism made = weightless(seed % 2 ? Precision::Single : Precision::Double);
    const std::size_t bodies = 2 + below(8), joints = 1 + below(bodies);
    std::vector<Vec2> at;
    for (std::size_t i = 0; i < bodies; ++i) {
        at.emplace_back(between(-50, 50), between(-50, 50));
        const double width = between(2, 30), height = between(2, 30), m = std::exp(between(0, std::log(massRatio)));
        made.add(at[i], width, height, m, {between(-50, 50), between(-50, 50)}, between(-spin, spin));
    }
    constexpr Kind kKinds[] = {Kind::Revolute, Kind::Prismatic, Kind::Weld,  Kind::Distance,
                               Kind::Rope,     Kind::Wheel,     Kind::Pulley};
    for (std::size_t i = 0; i < joints; ++i) {
        JointDef joint;
        joint.kind = kKinds[below(7)];
        const std::size_t a = below(bodies), b = (a + 1 + below(bodies - 1)) % bodies;
        const bool pulley = joint.kind == Kind::Pulley, fixed = below(4) == 0 && !pulley;
        const Vec2 middle = 0.5 * (at[a] + at[b]) + Vec2(between(-10, 10), between(-10, 10));
        joint.a = {fixed ? kNoHandle : static_cast<BodyHandle>(a), middle};
        joint.b = {static_cast<BodyHandle>(b), middle};
        if (pulley || joint.kind == Kind::Distance || joint.kind == Kind::Rope) {
            joint.a.point = at[a] + Vec2(between(-5, 5), between(-5, 5));
            joint.b.point = at[b] + Vec2(between(-5, 5), between(-5, 5));
        }
        joint.groundA = {between(-80, 80), -100}, joint.groundB = {between(-80, 80), -100};
        const double turn = between(0, 2 * std::numbers::pi);
        joint.axis = {std::cos(turn), std::sin(turn)};
        const bool limits = below(3) == 0;
        if (limits && (joint.kind == Kind::Revolute || joint.kind == Kind::Prismatic || joint.kind == Kind::Wheel))
            joint.limited = true, joint.lower = -between(0, 3), joint.upper = between(0, 3);
        made.world->addJoint(joint);
    }
    constexpr double kSteps[] = {1 / 30.0, 1 / 60.0, 1 / 240.0};
    step = kSteps[below(3)];
    return made;
}

struct Spread {
    double massRatio, spin;
};

class RandomNets : public testing::TestWithParam<Spread> {};

TEST_P(RandomNets, NeverGatherEnergy)
{
    for (unsigned seed = 0; seed < 150; ++seed) {
        double step = 0;
        Mechanism made = randomMechanism(seed, GetParam().massRatio, GetParam().spin, step);
        const double before = made.kineticEnergy();
        double most = 0;
        for (int i = 0; i * step < 3; ++i) {
            made.world->step(step);
            most = std::max(most, made.kineticEnergy());
        }
        ASSERT_LT(most, 1.1 * before) << "seed " << seed;
    }
}
INSTANTIATE_TEST_SUITE_P(Masses, RandomNets,
                         testing::Values(Spread{1, 20}, Spread{100, 20}, Spread{1e4, 20}, Spread{1e4, 200},
                                         Spread{1e6, 20}));

/// Heavy plates held by a light triangle, with velocities that do not go together; it flies free.
Mechanism strainedTriangle(Precision precision)
{
    Mechanism made = weightless(precision);
    made.add({0, 0}, 20, 4, 1e4, {30, -10}, 8);
    made.add({30, 0}, 20, 4, 1e4, {-20, 25}, -9);
    made.add({15, 25}, 4, 20, 1, {40, 10}, 15);
    for (const auto& [a, b, at] : {std::tuple(0, 1, Vec2(15, 0)), std::tuple(1, 2, Vec2(25, 12)),
                                   std::tuple(2, 0, Vec2(5, 12)), std::tuple(0, 1, Vec2(15, 9))}) {
        JointDef joint;
        joint.kind = Kind::Revolute;
        joint.a = {static_cast<BodyHandle>(a), at}, joint.b = {static_cast<BodyHandle>(b), at};
        made.world->addJoint(joint);
    }
    return made;
}

TEST(Nets, WhatIsTakenFromThemLeavesMomentumAlone)
{
    Mechanism made = strainedTriangle(Precision::Double);
    const Vec2 momentum = made.momentum();
    const double turning = made.angularMomentum(), energy = made.kineticEnergy();
    for (int i = 0; i < 300; ++i) {
        made.world->step(1 / 60.0);
        ASSERT_LT((made.momentum() - momentum).norm(), 1e-9 * momentum.norm()) << i;
        ASSERT_LT(made.kineticEnergy(), 1.06 * energy) << i;
    }
    EXPECT_NEAR(made.angularMomentum(), turning, 0.01 * std::abs(turning));
}

TEST(Nets, AStateTakenWhileTheyAreStrainedGoesOnBitEqual)
{
    for (const Precision precision : {Precision::Single, Precision::Double}) {
        Mechanism one = strainedTriangle(precision), other = strainedTriangle(precision);
        for (int i = 0; i < 20; ++i) one.world->step(1 / 60.0);
        other.world->restore(one.world->save());
        for (int i = 0; i < 60; ++i) one.world->step(1 / 60.0), other.world->step(1 / 60.0);
        EXPECT_EQ(one.world->save(), other.world->save());
    }
}

TEST(Nets, SpringsMotorsAndCarriersStillDriveThem)
{
    // A spring that was pulled: all its energy comes back.
    Mechanism sprung = weightless(Precision::Double);
    sprung.add({0, 0}, 2, 2, 1, {0, 0}, 0);
    JointDef spring;
    spring.kind = Kind::Distance, spring.hertz = 1, spring.dampingRatio = 0, spring.length = 10;
    spring.a.point = {-20, 0}, spring.b = {0, {0, 0}};
    sprung.world->addJoint(spring);
    double fastest = 0;
    for (int i = 0; i < 120; ++i) sprung.world->step(1 / 120.0), fastest = std::max(fastest, sprung.kineticEnergy());
    EXPECT_NEAR(fastest, 0.5 * std::pow(10 * 2 * std::numbers::pi, 2), 0.05 * fastest);

    // A motor brings a wheel to its speed as its torque says.
    Mechanism driven = weightless(Precision::Double);
    driven.add({0, 0}, 2, 2, 3, {0, 0}, 0);
    JointDef motor;
    motor.kind = Kind::Revolute, motor.b.body = 0, motor.driven = true, motor.motorSpeed = 100, motor.maxTorque = 20;
    driven.world->addJoint(motor);
    for (int i = 0; i < 60; ++i) driven.world->step(1 / 60.0);
    EXPECT_NEAR(driven.world->bodies().omega[0], 20 / driven.inertia[0], 1e-6);

    // What hangs on a carrier goes with it.
    Mechanism carried = weightless(Precision::Double);
    RigidBodyDef carrier = simple(box({0, 0}, 2, 2));
    carrier.common.kinematic = true, carrier.common.velocity = {30, 0};
    const BodyHandle hub = carried.world->addRigidBody(carrier);
    RigidBodyDef load = simple(box({0, 10}, 2, 2));
    load.mass = 5;
    const BodyHandle held = carried.world->addRigidBody(load);
    JointDef rod;
    rod.kind = Kind::Weld, rod.a = {hub, {0, 0}}, rod.b = {held, {0, 0}};
    carried.world->addJoint(rod);
    for (int i = 0; i < 120; ++i) carried.world->step(1 / 60.0);
    EXPECT_NEAR(carried.world->bodies().velocity[held].x(), 30, 0.3);
}

TEST(Nets, ThatAreHitTakeWhatTheyAreGiven)
{
    WorldSettings settings;
    settings.gravity = {0, 0}, settings.precision = Precision::Double, settings.allowSleep = false;
    Mechanism made;
    made.world = JetPhysics().createWorld(settings);
    made.add({0, 0}, 4, 4, 1, {0, 0}, 0);
    made.add({5, 0}, 4, 4, 1, {0, 0}, 0);
    made.add({-20, 0}, 4, 4, 2, {60, 0}, 0);
    JointDef weld;
    weld.kind = Kind::Weld, weld.a = {0, {2.5, 0}}, weld.b = {1, {2.5, 0}};
    made.world->addJoint(weld);
    const Vec2 momentum = made.momentum();
    for (int i = 0; i < 60; ++i) made.world->step(1 / 60.0);
    EXPECT_LT((made.momentum() - momentum).norm(), 1e-9 * momentum.norm());
    for (BodyHandle body = 0; body < 3; ++body) EXPECT_NEAR(made.world->bodies().velocity[body].x(), 30, 0.5) << body;
}

}  // namespace

}  // namespace jet::physics::test
