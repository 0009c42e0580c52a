// Springs and angular springs against their formulas, and soft bodies in play.
#include "scenes.hpp"

namespace jet::physics::test {

namespace {

/// Two particles joined by one spring along x, `stretch` longer than at rest.
SoftBodyDef pairOf(double ks, double kd, double rest, double stretch, double massA = 1, double massB = 1)
{
    SoftBodyDef def;
    def.particles = {{0, 0}, {rest + stretch, 0}};
    def.masses = {massA, massB};
    def.springs = {{0, 1, rest, ks, kd, 0}};
    return def;
}

double lengthOf(const PhysicsWorld& world) { return (pointsOf(world, 0)[1] - pointsOf(world, 0)[0]).norm(); }

TEST(SoftBody, ASpringSwingsAtTheSquareRootOfStiffnessOverReducedMass)
{
    for (const double ks : {10.0, 200.0, 4000.0}) {
        auto world = makeWorld({0, 0});
        world->addSoftBody(pairOf(ks, 0, 100, 5, 1, 3));
        const double omega = std::sqrt(ks / (3.0 / 4));
        // Zero crossings of the stretch are half a period apart.
        int crossings = 0;
        double first = 0, last = 0, before = 5;
        for (int i = 1; i <= 60 * 20; ++i) {
            world->step(kStep / 8);
            const double now = lengthOf(*world) - 100;
            if (before > 0 && now <= 0) {
                last = (i - now / (now - before)) * kStep / 8;
                if (crossings++ == 0) first = last;
            }
            before = now;
        }
        ASSERT_GT(crossings, 1);
        const double measured = 2 * 3.14159265358979 * (crossings - 1) / (last - first);
        EXPECT_NEAR(measured, omega, 0.011 * omega) << "ks " << ks;
    }
}

TEST(SoftBody, DampingRatioIsAsTheFormulaSays)
{
    // Amplitude decays as exp(-zeta omega t), zeta omega = kd / (2 mu).
    const double ks = 100, kd = 1.5, mu = 0.5;
    auto world = makeWorld({0, 0});
    world->addSoftBody(pairOf(ks, kd, 100, 10));
    const double omega = std::sqrt(ks / mu - std::pow(kd / (2 * mu), 2));
    const double period = 2 * 3.14159265358979 / omega;
    double highest = 0;
    for (double t = 0; t < 2.4 * period; t += kStep / 8) {
        world->step(kStep / 8);
        if (t > 1.6 * period) highest = std::max(highest, lengthOf(*world) - 100);
    }
    const double expected = 10 * std::exp(-kd / (2 * mu) * 2 * period);
    EXPECT_NEAR(highest, expected, 0.05 * expected);
}

TEST(SoftBody, ASpringKeepsMomentumAndAngularMomentum)
{
    auto world = makeWorld({0, 0});
    SoftBodyDef def = pairOf(300, 20, 40, 15, 0.2, 5);
    def.common.velocity = {3, -2};
    def.common.omega = 1.5;
    world->addSoftBody(def);
    const auto spin = [&] {
        const auto p = pointsOf(*world, 0);
        const Vec2 apart = p[1] - p[0];
        return apart.squaredNorm() * world->bodies().omega[0];
    };
    const double before = spin();
    run(*world, 2);
    EXPECT_NEAR((world->bodies().velocity[0] - Vec2(3, -2)).norm(), 0, 1e-10);
    EXPECT_NEAR(spin(), before, 1e-8 * before);
}

double springEnergy(const PhysicsWorld& world, const SoftBodyDef& def, std::span<const Vec2> previous, double dt)
{
    const auto now = pointsOf(world, 0);
    double energy = 0;
    for (std::size_t i = 0; i < now.size(); ++i)
        energy += 0.5 * def.masses[i] * ((now[i] - previous[i]) / dt).squaredNorm();
    for (const SpringDef& spring : def.springs) {
        const double stretch = (now[spring.a] - now[spring.b]).norm() - spring.restLength;
        energy += 0.5 * spring.ks * stretch * stretch;
    }
    return energy;
}

TEST(SoftBody, EnergyNeverGrowsWhateverTheStiffnessAndDamping)
{
    for (const double ks : {1.0, 100.0, 1e4, 1e6, 1e9}) {
        for (const double kd : {0.0, 0.01, 1.0, 100.0, 1e5}) {
            auto world = makeWorld({0, 0});
            SoftBodyDef def = softBall({0, 0}, 50, ks, kd, 12, 2);
            const SoftBodyDef rest = def;
            for (Vec2& p : def.particles) p.x() *= 1.05;  // released from a stretch
            for (std::size_t i = 0; i < def.springs.size(); ++i) def.springs[i].restLength = rest.springs[i].restLength;
            world->addSoftBody(def);
            const double start = springEnergy(*world, def, def.particles, 1);
            for (int i = 0; i < 240; ++i) {
                world->step(kStep);
                ASSERT_TRUE(allFinite(*world)) << "ks " << ks << " kd " << kd;
                double stored = 0;
                const auto now = pointsOf(*world, 0);
                for (const SpringDef& spring : def.springs)
                    stored += 0.5 * ks * std::pow((now[spring.a] - now[spring.b]).norm() - spring.restLength, 2);
                ASSERT_LE(stored, 1.1 * start) << "ks " << ks << " kd " << kd << " step " << i;
            }
        }
    }
}

TEST(SoftBody, ASpringTearsBeyondItsRatioAndActsNoMore)
{
    auto world = makeWorld({0, 0});
    SoftBodyDef def = pairOf(1, 0, 10, 0);
    def.springs[0].tearRatio = 2;
    def.common.velocity = {0, 0};
    world->addSoftBody(def);
    EXPECT_TRUE(world->springAlive(0, 0));
    // A force that pulls only one end: the anchor is the second particle.
    world->addForce({{0, def.particles[1]}, {100, 0}});
    for (int i = 0; i < 200 && world->springAlive(0, 0); ++i) world->step(kStep);
    EXPECT_FALSE(world->springAlive(0, 0));
    world->setForce(0, {0, 0});
    const double x = pointsOf(*world, 0)[0].x();
    run(*world, 0.5);
    const double v = (pointsOf(*world, 0)[0].x() - x) / 0.5;
    run(*world, 0.5);
    EXPECT_NEAR((pointsOf(*world, 0)[0].x() - x) / 1.0, v, 1e-9) << "a torn spring pulls no more";
}

SoftBodyDef hinge(double angle, double restAngle, double ks, double kd)
{
    SoftBodyDef def;
    def.particles = {{10, 0}, {0, 0}, {10 * std::cos(angle), 10 * std::sin(angle)}};
    def.masses = {1, 1, 1};
    def.springs = {{0, 1, 10, 400, 2, 0}, {1, 2, 10, 400, 2, 0}};
    def.angularSprings = {{0, 1, 2, restAngle, ks, kd}};
    return def;
}

double angleIn(const PhysicsWorld& world)
{
    const auto p = pointsOf(world, 0);
    const Vec2 a = p[0] - p[1], b = p[2] - p[1];
    return std::atan2(cross(a, b), a.dot(b));
}

TEST(SoftBody, AnAngularSpringHasNoNetForceAndNoNetTorque)
{
    auto world = makeWorld({0, 0});
    SoftBodyDef def = hinge(0.4, 1.9, 500, 3);
    def.masses = {1, 7, 0.3};
    def.springs.clear();
    world->addSoftBody(def);
    for (int i = 0; i < 100; ++i) world->step(kStep / 16);
    EXPECT_NEAR(world->bodies().velocity[0].norm(), 0, 1e-11);
    EXPECT_NEAR(world->bodies().omega[0], 0, 1e-11);
    EXPECT_GT(angleIn(*world), 0.45) << "it acts";
}

TEST(SoftBody, AnAngularSpringComesToItsRestAngle)
{
    auto world = makeWorld({0, 0});
    world->addSoftBody(hinge(0.5, 1.2, 2000, 400));
    run(*world, 6);
    EXPECT_NEAR(angleIn(*world), 1.2, 1e-3);
}

TEST(SoftBody, AnAngularSpringPassesThroughAHalfTurn)
{
    // At rest at +3.1 rad, released at 3.5: that is, -2.78 as atan2 sees it. The short way back leads through pi.
    auto world = makeWorld({0, 0});
    world->addSoftBody(hinge(3.5, 3.1, 2000, 400));
    double most = 0;
    for (int i = 0; i < 360; ++i) {
        world->step(kStep);
        double angle = angleIn(*world);
        if (angle < 0) angle += 2 * 3.14159265358979;
        most = std::max(most, std::abs(angle - 3.1));
    }
    EXPECT_LT(most, 0.45);
    EXPECT_NEAR(angleIn(*world), 3.1, 1e-3);
}

TEST(SoftBody, ABallDropsOnTheGroundWithoutCollapsing)
{
    auto world = makeWorld({0, 300});
    const SoftBodyDef def = softBall({0, -120}, 50, 300, 1);
    world->addSoftBody(def);
    world->addRigidBody(ground(0));
    double least = 1;
    for (int i = 0; i < 360; ++i) {
        world->step(kStep);
        least = std::min(least, areaRatio(*world, 0, def));
        ASSERT_LT(world->bodies().bounds[0].max.y(), 0.5);
    }
    EXPECT_GT(least, 0.8);
    EXPECT_NEAR(world->bodies().position[0].y(), -48, 4);
    EXPECT_LT(world->bodies().velocity[0].norm(), 10);
    EXPECT_TRUE(world->touching(0, 1));
}

TEST(SoftBody, ASoftBallLandsOnASoftBall)
{
    auto world = makeWorld({0, 300});
    const SoftBodyDef def = softBall({0, -51}, 50, 400, 2), above = softBall({4, -160}, 50, 400, 2);
    world->addSoftBody(def);
    world->addSoftBody(above);
    world->addRigidBody(fixed(
        {{{-80, 0}, {-80, -100}, {-60, -100}, {-60, -1}, {60, -1}, {60, -100}, {80, -100}, {80, 20}, {-80, 20}}}));
    double least = 1;
    bool touched = false;
    for (int i = 0; i < 300; ++i) {
        world->step(kStep);
        least = std::min({least, areaRatio(*world, 0, def), areaRatio(*world, 1, above)});
        touched |= world->touching(0, 1);
    }
    EXPECT_TRUE(touched);
    EXPECT_GT(least, 0.75);
    EXPECT_TRUE(allFinite(*world));
}

TEST(SoftBody, ARigidBoxRestsOnASoftBallInAPit)
{
    auto world = makeWorld({0, 300});
    const SoftBodyDef def = softBall({0, -51}, 50, 500, 2);
    world->addSoftBody(def);
    world->addRigidBody(box({0, -140}, 80, 20, 0.5));
    world->addRigidBody(
        fixed({{{-60, 20}, {-60, -180}, {-52, -180}, {-52, 0}, {52, 0}, {52, -180}, {60, -180}, {60, 20}}}));
    run(*world, 6);
    EXPECT_GT(areaRatio(*world, 0, def), 0.7);
    EXPECT_TRUE(world->touching(0, 1));
    EXPECT_LT(world->bodies().velocity[1].norm(), 8);
    EXPECT_LT(world->bodies().position[1].y(), -80);
}

TEST(SoftBody, AClockwiseTorqueRollsABallToTheRight)
{
    auto world = makeWorld({0, 300}, 0.9);
    const SoftBodyDef def = softBall({0, -50.5}, 50, 300, 1);
    world->addSoftBody(def);
    world->addRigidBody(ground(0, 20000));
    world->addTorque({{0, {0, -50.5}}, 1500});
    run(*world, 3);
    EXPECT_GT(world->bodies().position[0].x(), 70);
    EXPECT_GT(world->bodies().omega[0], 0);
    EXPECT_NEAR(world->bodies().velocity[0].x(), world->bodies().omega[0] * 48, 0.15 * world->bodies().velocity[0].x())
        << "it rolls, it does not slide";
    EXPECT_GT(areaRatio(*world, 0, def), 0.7);
}

}  // namespace

/// `side` * `side` particles a unit apart, joined to their eight neighbours.
SoftBodyDef largeSheet(std::uint32_t side, double tearRatio)
{
    SoftBodyDef def;
    for (std::uint32_t i = 0; i < side * side; ++i) def.particles.emplace_back(i % side, i / side);
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        def.springs.push_back({a, b, (def.particles[a] - def.particles[b]).norm(), 2000, 2, tearRatio});
    };
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const bool right = i % side + 1 < side, below = i / side + 1 < side;
        if (right) join(i, i + 1);
        if (below) join(i, i + side);
        if (right && below) join(i, i + side + 1), join(i + 1, i + side);
    }
    def.masses.assign(side * side, 0.5);
    def.movable.assign(side * side, 1);
    return def;
}

TEST(LargeSoftBodies, HaveTheSameBitsOnAnyCountOfThreadsWhilePushedAndTorn)
{
    const auto run = [](int threads) {
        WorldSettings settings;
        settings.threads = threads;
        const auto world = JetPhysics().createWorld(settings);
        SoftBodyDef def = largeSheet(100, 1.05);
        for (std::uint32_t i = 0; i < 100; i += 33) def.movable[i] = 0;
        const BodyHandle sheet = world->addSoftBody(def);
        std::uint32_t torn = 0;
        for (int i = 0; i < 30; ++i) {
            world->applyForce(sheet, {3000, 0});
            world->step(1.0 / 60);
        }
        for (std::uint32_t k = 0; k < def.springs.size(); ++k) torn += !world->springAlive(sheet, k);
        EXPECT_GT(torn, 10U);
        return world->hash();
    };
    const std::uint64_t one = run(1);
    EXPECT_EQ(run(2), one);
    EXPECT_EQ(run(4), one);
}

TEST(LargeSoftBodies, KeepTheirMomentumThoughTheyAreComputedInParts)
{
    WorldSettings settings;
    settings.gravity = {0, 0};
    settings.threads = 2;
    const auto world = JetPhysics().createWorld(settings);
    SoftBodyDef def = largeSheet(100, 0);
    for (Vec2& at : def.particles) at *= 1 + 0.02 * std::sin(0.1 * at.x());  // strained
    def.common.velocity = {3, -2};
    const BodyHandle sheet = world->addSoftBody(def);
    for (int i = 0; i < 60; ++i) world->step(1.0 / 60);
    const Vec2 velocity = world->bodies().velocity[sheet];
    EXPECT_NEAR(velocity.x(), 3, 1e-9);
    EXPECT_NEAR(velocity.y(), -2, 1e-9);
}

}  // namespace jet::physics::test
