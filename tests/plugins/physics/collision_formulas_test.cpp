// Elastic and inelastic collisions against conservation of momentum and the law of restitution.
#include "formulas.hpp"

namespace jet::physics::test {

namespace {

std::unique_ptr<PhysicsWorld> spaceWorld(double restitution, double friction = 0,
                                         Precision precision = Precision::Double)
{
    WorldSettings settings;
    settings.gravity = {0, 0};
    settings.precision = precision;
    settings.materials = {MaterialPair{friction, restitution, true}};
    return JetPhysics().createWorld(settings);
}

enum class Form { Disc, Box, Drawn };

RigidBodyDef bodyOf(Form form, const Vec2& centre, double mass)
{
    if (form == Form::Drawn) return box(centre, 20, 20, mass);
    if (form == Form::Box) return simple(box(centre, 20, 20, mass));
    RigidBodyDef def;
    def.shapes = {{ShapeDef::Kind::Circle, {centre}, 10}};
    def.mass = mass;
    return def;
}

TEST(CollisionFormulas, HeadOnVelocitiesFollowFromMassesAndRestitution)
{
    // v1' = (m1 v1 + m2 v2 - m2 e (v1 - v2)) / (m1 + m2), and the energy lost is (1 - e²) mu (v1 - v2)² / 2.
    for (const Form form : {Form::Disc, Form::Box, Form::Drawn}) {
        for (const double e : {0.0, 0.3, 0.5, 0.9, 1.0}) {
            for (const double m2 : {1.0, 3.0, 1000.0, 1e-3}) {
                const double m1 = 1, v1 = 90, v2 = -30;
                auto world = spaceWorld(e);
                RigidBodyDef left = bodyOf(form, {0, 0}, m1), right = bodyOf(form, {60.7, 0}, m2);
                left.common.velocity = {v1, 0}, right.common.velocity = {v2, 0};
                world->addRigidBody(left), world->addRigidBody(right);
                const double momentum = m1 * v1 + m2 * v2, energy = 0.5 * (m1 * v1 * v1 + m2 * v2 * v2);
                run(*world, 1);
                const double now1 = world->bodies().velocity[0].x(), now2 = world->bodies().velocity[1].x();
                const std::string what = "form " + std::to_string(static_cast<int>(form)) + " e " + std::to_string(e) +
                                         " m2 " + std::to_string(m2);
                EXPECT_NEAR(m1 * now1 + m2 * now2, momentum, 1e-12 * (m1 * v1 - m2 * v2)) << what;
                EXPECT_NEAR(now1, (momentum - m2 * e * (v1 - v2)) / (m1 + m2), 1e-6 * v1) << what;
                EXPECT_NEAR(now2, (momentum + m1 * e * (v1 - v2)) / (m1 + m2), 1e-6 * v1) << what;
                const double lost = (1 - e * e) * m1 * m2 / (m1 + m2) * (v1 - v2) * (v1 - v2) / 2;
                EXPECT_NEAR(0.5 * (m1 * now1 * now1 + m2 * now2 * now2), energy - lost, 1e-6 * energy) << what;
            }
        }
    }
}

TEST(CollisionFormulas, AnObliqueHitWithoutFrictionKeepsTheTangentAndTurnsTheNormal)
{
    for (const double e : {0.0, 0.6, 1.0}) {
        auto world = spaceWorld(e);
        RigidBodyDef moving = bodyOf(Form::Disc, {-60, -10}, 1);
        moving.common.velocity = {120, 0};
        world->addRigidBody(moving), world->addRigidBody(bodyOf(Form::Disc, {0, 0}, 2));
        run(*world, 1.5);
        // They met where the centres were 20 apart: the normal is inclined by asin(10 / 20), give or take the way of a
        // substep, 1/80 of that distance.
        const Vec2 normal(std::cos(kPi / 6), std::sin(kPi / 6)), tangent(-normal.y(), normal.x());
        const Vec2 first = world->bodies().velocity[0], second = world->bodies().velocity[1];
        const double before = 120 * normal.x();
        EXPECT_NEAR((first + 2 * second - Vec2(120, 0)).norm(), 0, 1e-12 * 120);
        EXPECT_NEAR(first.dot(tangent), 120 * tangent.x(), 2.5) << e;
        EXPECT_NEAR(second.dot(tangent), 0, 2.5) << e;
        EXPECT_NEAR((second - first).dot(normal), e * before, 2.5) << e;
        EXPECT_NEAR(world->bodies().omega[0], 0, 1e-5);
    }
}

TEST(CollisionFormulas, AHitOffTheCentreTurnsByTheEffectiveMass)
{
    // A disc hits a free rod near its end: j = (1 + e) v / (1/m1 + 1/m2 + r² / I), then v' and omega' follow from j.
    for (const double e : {0.0, 0.5, 1.0}) {
        const double m1 = 1, m2 = 4, half = 40, v = 100, lever = 35;
        auto world = spaceWorld(e);
        RigidBodyDef disc;
        disc.shapes = {{ShapeDef::Kind::Circle, {{lever, -40}}, 5}};
        disc.mass = m1;
        disc.common.velocity = {0, v};
        world->addRigidBody(disc);
        world->addRigidBody(simple(box({0, 0}, 2 * half, 10, m2)));
        const double inertia = m2 * (4 * half * half + 100) / 12;
        const double j = (1 + e) * v / (1 / m1 + 1 / m2 + lever * lever / inertia);
        // Until just after the first touch, before they meet again; without a bounce they part by and by.
        for (int i = 0; i < 60 && world->bodies().velocity[1].norm() == 0; ++i) world->step(kStep);
        world->step(kStep);
        EXPECT_NEAR(world->bodies().velocity[1].y(), j / m2, 0.02 * j / m2) << e;
        EXPECT_NEAR(world->bodies().omega[1], j * lever / inertia, 0.02 * j * lever / inertia) << e;
        EXPECT_NEAR(world->bodies().velocity[0].y(), v - j / m1, 0.02 * v) << e;
        const Vec2 momentum = m1 * world->bodies().velocity[0] + m2 * world->bodies().velocity[1];
        EXPECT_NEAR((momentum - Vec2(0, m1 * v)).norm(), 0, 1e-12 * m1 * v);
    }
}

TEST(CollisionFormulas, MomentumAndAngularMomentumAreKeptInACrowdWithFriction)
{
    for (const Form form : {Form::Disc, Form::Box, Form::Drawn}) {
        auto world = spaceWorld(0.5, 0.7);
        Vec2 momentum(0, 0);
        double spin = 0, scale = 0;
        std::vector<double> masses, inertias;
        for (int i = 0; i < 16; ++i) {
            RigidBodyDef def = bodyOf(form, {25.0 * (i % 4), 25.0 * (i / 4)}, 1 + i % 3);
            def.common.velocity = {-40.0 * (i % 4 - 1.5) + i, -40.0 * (i / 4 - 1.5) - i};
            def.common.omega = 0.3 * i;
            world->addRigidBody(def);
            masses.push_back(def.mass);
            inertias.push_back(form == Form::Disc ? def.mass * 100 / 2 : def.mass * 800 / 12);
        }
        const auto add = [&](double sign) {
            const BodyStates states = world->bodies();
            for (std::size_t i = 0; i < masses.size(); ++i) {
                momentum += sign * masses[i] * states.velocity[i];
                spin +=
                    sign * (masses[i] * cross(states.position[i], states.velocity[i]) + inertias[i] * states.omega[i]);
                scale += masses[i] * states.velocity[i].norm();
            }
        };
        add(1);
        const double whole = scale;
        bool touched = false;
        for (int i = 0; i < 180; ++i) {
            world->step(kStep);
            touched = touched || !world->contacts().empty();
        }
        add(-1);
        EXPECT_TRUE(touched);
        EXPECT_NEAR(momentum.norm(), 0, 1e-12 * whole) << static_cast<int>(form);
        EXPECT_NEAR(spin, 0, 2e-3 * whole * 50) << static_cast<int>(form);
    }
}

TEST(CollisionFormulas, ANewtonsCradleHandsItsMomentumOn)
{
    // Five equal discs that do not quite touch: the last flies off with the speed of the first, the others stand.
    auto world = spaceWorld(1);
    for (int i = 0; i < 5; ++i) world->addRigidBody(bodyOf(Form::Disc, {i == 0 ? -60.0 : 25.0 * i, 0}, 2));
    world->setVelocity(0, {100, 0});
    run(*world, 2);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(world->bodies().velocity[i].norm(), 0, 1e-6) << i;
    EXPECT_NEAR(world->bodies().velocity[4].x(), 100, 1e-6);
}

TEST(CollisionFormulas, SoftBallsKeepMomentumToTwelveDigitsAndGainNoEnergy)
{
    for (const double ratio : {1.0, 100.0}) {
        auto world = makeWorld({0, 0}, 0.4, 0.2);
        SoftBodyDef left = softBall({-60, 0}, 40, 200, 1), right = softBall({60, 10}, 40, 200, 1);
        for (double& mass : right.masses) mass *= ratio;
        left.common.velocity = {80, 0};
        world->addSoftBody(left), world->addSoftBody(right);
        const double energy = 0.5 * 80 * 80;
        bool touched = false;
        for (int i = 0; i < 240; ++i) {
            world->step(kStep);
            touched = touched || world->touching(0, 1);
            const Vec2 a = world->bodies().velocity[0], b = world->bodies().velocity[1];
            ASSERT_NEAR((a + ratio * b - Vec2(80, 0)).norm(), 0, 1e-12 * 80 * 10) << i;
            ASSERT_LE(0.5 * a.squaredNorm() + 0.5 * ratio * b.squaredNorm(), energy * (1 + 1e-9)) << i;
        }
        EXPECT_TRUE(touched);
        EXPECT_GT(world->bodies().velocity[1].x(), 0.5 * 80 / (1 + ratio));
    }
}

}  // namespace

}  // namespace jet::physics::test
