// Scene-level springs, angular springs, torques and forces, anchored to every kind of thing.
#include "lattices.hpp"

#include <random>

namespace jet::physics::test {

namespace {

TEST(Actuators, ASpringToTheBackgroundHoldsAWeightAtItsStretch)
{
    auto world = makeWorld({0, 200});
    world->addRigidBody(box({0, 50}, 10, 10, 2));
    SpringActuatorDef def;
    def.a = {kNoHandle, {0, 0}};
    def.b = {0, {0, 50}};
    def.ks = 40;
    def.kd = 4;
    world->addSpring(def);
    run(*world, 15);
    EXPECT_NEAR(world->bodies().position[0].y(), 50 + 2 * 200 / 40.0, 0.01);
}

TEST(Actuators, ASpringToACornerTurnsTheBody)
{
    // Hung by a corner, a box comes to hang with its diagonal upright: turned by 45 degrees.
    WorldSettings settings;
    settings.gravity = {0, 300};
    settings.linearDamping = settings.angularDamping = 0.5;
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(box({0, 30}, 20, 20, 1));
    SpringActuatorDef def;
    def.a = {kNoHandle, {-10, 0}};
    def.b = {0, {-10, 20}};
    def.ks = 300;
    def.kd = 3;
    world->addSpring(def);
    run(*world, 30);
    EXPECT_NEAR(std::abs(world->bodies().angle[0]), 3.14159265 / 4, 0.15);
}

TEST(Actuators, SpringsJoinSoftAndRigidBodiesWithoutGainingMomentum)
{
    auto world = makeWorld({0, 0});
    world->addSoftBody(softBall({0, 0}, 30, 400, 1));
    world->addRigidBody(box({100, 0}, 20, 20, 0.5));
    SpringActuatorDef def;
    def.a = {0, {13, 7}};  // between particles
    def.b = {1, {95, -5}};
    def.restLength = 60;
    def.ks = 50;
    def.kd = 0.5;
    world->addSpring(def);
    run(*world, 10);
    const Vec2 momentum = world->bodies().velocity[0] + 0.5 * world->bodies().velocity[1];
    EXPECT_NEAR(momentum.norm(), 0, 1e-8);
    EXPECT_GT(world->bodies().position[0].x(), 5) << "it pulled them together";
}

TEST(Actuators, ATornSpringLetsGo)
{
    auto world = makeWorld({0, 100});
    world->addRigidBody(box({0, 20}, 10, 10, 1));
    SpringActuatorDef def;
    def.a = {kNoHandle, {0, 0}};
    def.b = {0, {0, 20}};
    def.ks = 1;
    def.tearRatio = 2;
    world->addSpring(def);
    run(*world, 3);
    EXPECT_GT(world->bodies().position[0].y(), 300);
}

TEST(Actuators, AnAngularSpringBetweenBodiesHoldsItsAngle)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(box({0, 0}, 40, 10));
    world->addRigidBody(box({60, 0}, 40, 10));
    // Arms from the left body's far end over a background hinge to the right body: released 0.6 rad off.
    AngularSpringActuatorDef def;
    def.a = {0, {-20, 0}};
    def.centre = {kNoHandle, {30, 0}};
    def.b = {1, {80, 0}};
    def.restFromPose = false;
    def.restAngle = 3.14159265 + 0.6;
    def.ks = 4000;
    def.kd = 2000;
    world->addAngularSpring(def);
    run(*world, 4);
    // Points move; the angle between the arms must have become the rest angle.
    const auto anchored = [&](BodyHandle body, const Vec2& local) {
        return Vec2(world->bodies().position[body] + Affine::rotation(world->bodies().angle[body]).linear() * local);
    };
    const Vec2 a = anchored(0, {-20, 0}) - Vec2(30, 0), b = anchored(1, {20, 0}) - Vec2(30, 0);
    double angle = std::atan2(cross(a, b), a.dot(b));
    if (angle < 0) angle += 2 * 3.14159265358979;
    EXPECT_NEAR(angle, def.restAngle, 0.02);
}

/// Kinetic, of rigid boxes of one size.
double motionOf(const PhysicsWorld& world, const std::vector<double>& masses, double side)
{
    double sum = 0;
    const BodyStates all = world.bodies();
    for (std::size_t i = 0; i < masses.size(); ++i)
        sum += masses[i] / 2 * (all.velocity[i].squaredNorm() + side * side / 6 * all.omega[i] * all.omega[i]);
    return sum;
}

TEST(Actuators, AnAngularSpringGivesNoMoreThanItHeldWhereAnArmPassesItsCentre)
{
    for (unsigned seed = 1; seed <= 60; ++seed) {
        std::mt19937 random(seed);
        const auto between = [&](double low, double high) {
            return low + (high - low) * std::generate_canonical<double, 32>(random);
        };
        WorldSettings settings;
        settings.gravity = {0, 0};
        settings.findCollisions = false;
        auto world = JetPhysics().createWorld(settings);
        const double side = 10;
        std::vector<double> masses;
        for (int i = 0; i < 3; ++i) masses.push_back(std::pow(10, between(-1, 1)));
        const Vec2 places[] = {{between(-90, -40), between(-20, 20)}, {0, 0}, {between(40, 90), between(-60, 60)}};
        for (int i = 0; i < 3; ++i) world->addRigidBody(box(places[i], side, side, masses[i]));
        AngularSpringActuatorDef def;
        const auto near = [&](const Vec2& place) { return Vec2(place + Vec2(between(-4, 4), between(-4, 4))); };
        def.a = {0, near(places[0])}, def.centre = {1, near(places[1])}, def.b = {2, near(places[2])};
        def.ks = std::pow(10, between(2, 6)), def.kd = 0;
        const Vec2 armA = def.a.point - def.centre.point, armB = def.b.point - def.centre.point;
        const double strain = between(-2, 2);
        def.restFromPose = false, def.restAngle = std::atan2(cross(armA, armB), armA.dot(armB)) - strain;
        world->addAngularSpring(def);
        world->setVelocity(0, -between(50, 300) / armA.norm() * armA);  // through the centre, or close by
        const double held = motionOf(*world, masses, side) + def.ks / 2 * strain * strain;
        double most = 0;
        for (int i = 0; i < 300; ++i) {
            world->step(kStep);
            most = std::max(most, motionOf(*world, masses, side));
        }
        EXPECT_LT(most, 1.05 * held) << "seed " << seed;
    }
}

TEST(Actuators, ForcesActAtTheirAnchors)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(box({0, 0}, 20, 20, 2));
    const ActuatorHandle force = world->addForce({{0, {0, -10}}, {8, 0}});
    world->step(kStep);
    EXPECT_NEAR(world->bodies().velocity[0].x(), 8 * kStep / 2, 1e-9);
    EXPECT_GT(world->bodies().omega[0], 0) << "pushed right above its centre, it turns clockwise";
    world->setForce(force, {0, 0});
    const Vec2 before = world->bodies().velocity[0];
    world->step(kStep);
    EXPECT_EQ(world->bodies().velocity[0], before);
}

TEST(Actuators, ATorqueTurnsASoftBodyAsARigidOne)
{
    auto world = makeWorld({0, 0});
    const SoftBodyDef def = softBall({0, 0}, 30, 2000, 5);
    world->addSoftBody(def);
    const ActuatorHandle torque = world->addTorque({{0, {30, 0}}, 100});
    double inertia = 0;
    for (std::size_t i = 0; i < def.particles.size(); ++i) inertia += def.masses[i] * def.particles[i].squaredNorm();
    run(*world, 0.5);
    EXPECT_NEAR(world->bodies().omega[0], 0.5 * 100 / inertia, 0.01);
    EXPECT_NEAR(world->bodies().velocity[0].norm(), 0, 1e-9) << "a couple does not push";
    world->setTorque(torque, 0);
}

TEST(Actuators, ACompositeBodyRegainsItsShape)
{
    // A ring too soft to stand alone, each particle sprung to an invisible twin that collides with nothing (SPEC PH6).
    WorldSettings settings;
    settings.gravity = {0, 200};
    settings.materialCount = 2;
    settings.materials.assign(4, MaterialPair{0.5, 0, true});
    for (int i : {1, 2, 3}) settings.materials[i].collides = false;
    auto world = JetPhysics().createWorld(settings);
    SoftBodyDef ring;
    ring.particles = circleRing({0, -60}, 40, 32);
    ring.masses.assign(32, 1.0 / 32);
    ring.borders.emplace_back();
    for (std::uint32_t i = 0; i < 32; ++i) {
        ring.springs.push_back({i, (i + 1) % 32, (ring.particles[1] - ring.particles[0]).norm(), 50, 0.5, 0});
        ring.borders[0].push_back(i);
    }
    world->addSoftBody(ring);
    RigidBodyDef twin = rigid({ring.particles}, 1);
    twin.common.material = 1;
    world->addRigidBody(twin);
    for (const Vec2& at : ring.particles) {
        SpringActuatorDef bond;
        bond.a = {0, at};
        bond.b = {1, at};
        bond.restLength = 0;
        bond.ks = 60;
        bond.kd = 1;
        world->addSpring(bond);
    }
    world->addRigidBody(ground(0));
    run(*world, 6);
    EXPECT_GT(areaRatio(*world, 0, ring), 0.85);
    EXPECT_LT(world->bodies().bounds[0].max.y(), 1);
    EXPECT_NEAR((world->bodies().position[0] - world->bodies().position[1]).norm(), 0, 5);
}

TEST(Actuators, StrongDampersDoNotDrawAStiffBodyOut)
{
    // Two dampers one after the other gave a pinned lattice what it held, and more in each substep.
    for (unsigned seed = 1; seed <= 40; ++seed) {
        std::mt19937 random(seed);
        const auto between = [&](double low, double high) {
            return low + (high - low) * std::generate_canonical<double, 32>(random);
        };
        auto world = makeWorld({0, 100});
        SpringDef stiff;
        stiff.ks = 4e8, stiff.kd = 1;
        SoftBodyDef net = sheet(3, 3, 10, stiff);
        net.borders = {{0, 1, 2, 5, 8, 7, 6, 3}};
        for (double& mass : net.masses) mass = std::pow(10, between(-3, 0));
        net.movable.assign(net.particles.size(), 1);
        net.movable[4] = 0;
        world->addSoftBody(net);
        for (int i = 0; i < 2; ++i) {
            SpringActuatorDef def;
            def.b = {0, {between(0, 20), between(0, 20)}};
            def.a = {kNoHandle, def.b.point + Vec2(between(-20, 20), between(-20, 20))};
            def.ks = std::pow(10, between(2, 6)), def.kd = std::pow(10, between(5, 8));
            world->addSpring(def);
        }
        double widest = 0;
        for (int i = 0; i < 120; ++i) {
            world->step(1.0 / 30);
            const auto points = world->bodies().points;
            widest = std::max({widest, (points[0] - points[8]).norm(), (points[2] - points[6]).norm()});
        }
        EXPECT_LT(widest, 1.05 * std::hypot(20, 20)) << "seed " << seed;
    }
}

TEST(Actuators, HundredsOfStiffSpringsOnOneBodyStayCalm)
{
    WorldSettings settings;
    settings.gravity = {0, 300};
    settings.findCollisions = false;
    auto world = JetPhysics().createWorld(settings);
    const SoftBodyDef soft = softBall({0, 0}, 40, 1000, 1);
    world->addSoftBody(soft);
    world->addRigidBody(box({0, 0}, 10, 10, 0.01));
    for (int repeat = 0; repeat < 5; ++repeat) {
        for (const Vec2& at : soft.particles) {
            SpringActuatorDef bond;
            bond.a = {0, at};
            bond.b = {1, 0.1 * at};
            bond.ks = 1e5;
            bond.kd = 10;
            world->addSpring(bond);
        }
    }
    run(*world, 2);
    EXPECT_TRUE(allFinite(*world));
    EXPECT_NEAR(world->bodies().position[0].y(), 600, 10) << "it falls as one";
    EXPECT_GT(areaRatio(*world, 0, soft), 0.9);
}

}  // namespace

}  // namespace jet::physics::test
