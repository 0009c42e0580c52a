// Free motion, pendulums, slopes, moments of inertia and torques against the formulas of mechanics.
#include "formulas.hpp"

#include "lattices.hpp"

namespace jet::physics::test {

namespace {

std::unique_ptr<PhysicsWorld> worldOf(const Vec2& gravity, int substeps, double friction = 0.6)
{
    WorldSettings settings;
    settings.gravity = gravity;
    settings.substeps = substeps;
    settings.materials = {MaterialPair{friction, 0, true}};
    return JetPhysics().createWorld(settings);
}

TEST(MotionFormulas, AProjectilesErrorIsHalfASubstepOfGravityAndSoOfFirstOrder)
{
    // x = v t to the last bits; y = v t + g t² / 2 + g t h / 2: velocity first, then position, is early by half of h.
    const double g = 100, t = 2;
    const Vec2 throwing(80, -120);
    double error[4];
    int k = 0;
    for (const int substeps : {1, 2, 4, 8}) {
        auto world = worldOf({0, g}, substeps);
        RigidBodyDef def = simple(box({3, 5}, 10, 10));
        def.common.velocity = throwing;
        def.common.omega = 2;
        world->addRigidBody(def);
        run(*world, t);
        const double h = kStep / substeps;
        const Vec2 at = world->bodies().position[0];
        EXPECT_NEAR(at.x(), 3 + throwing.x() * t, 1e-9);
        error[k] = at.y() - (5 + throwing.y() * t + 0.5 * g * t * t);
        EXPECT_NEAR(error[k++], 0.5 * g * t * h, 1e-9) << substeps;
        EXPECT_NEAR(world->bodies().angle[0], 2 * t, 1e-9);
        EXPECT_NEAR(world->bodies().velocity[0].y(), throwing.y() + g * t, 1e-9);
    }
    for (int i = 1; i < 4; ++i) EXPECT_NEAR(error[i - 1] / error[i], 2, 1e-6) << "half the step, half the error";
}

TEST(MotionFormulas, AStepTwiceAsLongIsNoLessExact)
{
    // Substeps count by the second, so the error of a fall does not depend on the step that was asked for.
    double error[3];
    int k = 0;
    for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
        auto world = makeWorld({0, 100});
        world->addRigidBody(box({0, 0}, 10, 10));
        for (int i = 0; i < static_cast<int>(std::lround(2 / step)); ++i) world->step(step);
        error[k++] = world->bodies().position[0].y() - 200;
    }
    EXPECT_LT(error[0], 0.25);
    EXPECT_NEAR(error[1], error[0], 1e-9);
    EXPECT_NEAR(error[2], error[0], 1e-9);
}

double pendulumPeriod(double start, double step)
{
    const double g = 100, l = 50, r = 5;
    auto world = makeWorld({0, g});
    RigidBodyDef bob;
    bob.shapes = {{ShapeDef::Kind::Circle, {{l * std::sin(start), l * std::cos(start)}}, r}};
    world->addRigidBody(bob);
    JointDef pin;
    pin.b = {0, {0, 0}};
    world->addJoint(pin);
    return swingOf(*world, step, 1,
                   [&] {
                       const Vec2 at = world->bodies().position[0];
                       return std::atan2(at.x(), at.y());
                   })
        .period;
}

TEST(MotionFormulas, ARigidPendulumsPeriodIsTheEllipticIntegralAtEveryAmplitude)
{
    // T = 4 sqrt((I + m l²) / (m g l)) K(sin(start / 2)).
    const double g = 100, l = 50, r = 5;
    for (const double degrees : {1.0, 10.0, 45.0, 90.0, 135.0, 160.0}) {
        const double start = degrees * kPi / 180;
        const double period = 4 * std::sqrt((r * r / 2 + l * l) / (g * l)) * std::comp_ellint_1(std::sin(start / 2));
        EXPECT_NEAR(pendulumPeriod(start, kStep), period, 2e-5 * period) << degrees << " degrees";
    }
}

TEST(MotionFormulas, ASoftPendulumSwingsAsAPointMassOnARodAtEveryAmplitude)
{
    // A particle on a spring so stiff that it is a rod: T = 4 sqrt(l / g) K(sin(start / 2)).
    const double g = 100, l = 50;
    for (const double degrees : {1.0, 45.0, 90.0, 135.0}) {
        const double start = degrees * kPi / 180;
        SoftBodyDef def;
        def.particles = {{0, 0}, {l * std::sin(start), l * std::cos(start)}};
        def.masses = {1, 2};
        def.movable = {0, 1};
        def.springs = {{0, 1, l, 1e6, 10, 0}};
        auto world = makeWorld({0, g});
        world->addSoftBody(def);
        const Swing swing = swingOf(*world, kStep, 2,
                                    [&] { return std::atan2(pointsOf(*world, 0)[1].x(), pointsOf(*world, 0)[1].y()); });
        const double period = 4 * std::sqrt(l / g) * std::comp_ellint_1(std::sin(start / 2));
        EXPECT_NEAR(swing.period, period, 4e-3 * period) << degrees << " degrees";
    }
}

/// What two seconds on a slope add to the speed of a box that rested before; gravity is turned instead of the ground.
double slidingSpeed(double slope, double friction, bool drawn, double gravity)
{
    auto world = worldOf({0, gravity}, 0, friction);
    const RigidBodyDef sliding = box({0, -10}, 40, 20), below = ground(0, 20000);
    world->addRigidBody(drawn ? sliding : simple(sliding));
    world->addRigidBody(drawn ? below : simple(below));
    run(*world, 1);
    world->setGravity(gravity * Vec2(std::sin(slope), std::cos(slope)));
    run(*world, 2);
    return world->bodies().velocity[0].x();
}

TEST(MotionFormulas, ABoxSlidesExactlyAboveTheFrictionAngle)
{
    const double gravity = 300;
    for (const bool drawn : {false, true}) {
        for (const double friction : {0.1, 0.3, 0.6, 1.0}) {
            const double angle = std::atan(friction);
            EXPECT_NEAR(slidingSpeed(0.998 * angle, friction, drawn, gravity), 0, 1e-2) << friction << " " << drawn;
            for (const double part : {1.002, 1.1, 1.3}) {
                const double slope = part * angle;
                const double speed = 2 * gravity * (std::sin(slope) - friction * std::cos(slope));
                const double late = gravity * std::sin(slope) * kStep / 8;  // friction answers a substep later
                EXPECT_NEAR(slidingSpeed(slope, friction, drawn, gravity), speed, 0.01 * speed + late)
                    << friction << " " << part << " " << drawn;
            }
        }
    }
}

/// Area, centre and second moment about the centre of closed rings, outer ones and holes by their direction.
struct Moments {
    double area = 0, second = 0;
    Vec2 centre{0, 0};
};

Moments momentsOf(const std::vector<std::vector<Vec2>>& rings)
{
    Moments sum;
    double about = 0;
    for (const auto& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 &p = ring[i], &q = ring[(i + 1) % ring.size()];
            sum.area += cross(p, q) / 2;
            sum.centre += cross(p, q) / 6 * (p + q);
            about += cross(p, q) * (p.squaredNorm() + p.dot(q) + q.squaredNorm()) / 12;
        }
    }
    sum.centre /= sum.area;
    sum.second = about - sum.area * sum.centre.squaredNorm();
    return sum;
}

std::vector<Vec2> reversed(std::vector<Vec2> ring)
{
    std::reverse(ring.begin(), ring.end());
    return ring;
}

TEST(MotionFormulas, EveryOutlinesInertiaIsItsSecondMomentOfArea)
{
    const std::vector<Vec2> triangle = {{0, 0}, {30, 5}, {7, 40}};
    const std::vector<Vec2> ell = {{0, 0}, {60, 0}, {60, 20}, {20, 20}, {20, 80}, {0, 80}};
    std::vector<Vec2> star;
    for (int i = 0; i < 14; ++i)
        star.push_back(Vec2(100, -50) + (i % 2 ? 15.0 : 40.0) * Vec2(std::cos(kPi * i / 7), std::sin(kPi * i / 7)));
    const std::vector<std::vector<std::vector<Vec2>>> outlines = {
        {triangle},
        {ell},
        {star},
        {circleRing({-20, 10}, 30, 7)},
        {ell, reversed(boxRing({10, 10}, 8, 6)), reversed(boxRing({10, 60}, 12, 12, 0.3))},
        {circleRing({5, 5}, 50, 48), reversed(circleRing({20, 5}, 20, 24)), boxRing({20, 5}, 10, 10)},
    };
    const double mass = 2.5, torque = 1000;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const Moments moments = momentsOf(outlines[i]);
        auto world = makeWorld({0, 0});
        world->addRigidBody(rigid(outlines[i], mass));
        EXPECT_NEAR((world->bodies().position[0] - moments.centre).norm(), 0, 1e-9) << "outline " << i;
        world->addTorque({{0, outlines[i][0][0]}, torque});
        world->step(kStep);
        const double inertia = mass * moments.second / moments.area;
        EXPECT_NEAR(torque * kStep / world->bodies().omega[0], inertia, 1e-9 * inertia) << "outline " << i;
        EXPECT_NEAR(world->bodies().velocity[0].norm(), 0, 1e-12) << "a torque does not push";
    }
}

TEST(MotionFormulas, ATorqueAddsItsAngularMomentumToSoftAndRigidBodiesAlike)
{
    // L = torque t whatever the shape does meanwhile; energy of a rigid body: torque times angle.
    const double torque = 50;
    auto world = makeWorld({0, 0});
    const SoftBodyDef ball = softBall({0, 0}, 30, 500, 2);
    world->addSoftBody(ball);
    world->addRigidBody(box({200, 0}, 30, 30, 3));
    world->addTorque({{0, {30, 0}}, torque});
    world->addTorque({{1, {200, 0}}, torque});
    for (int second = 1; second <= 3; ++second) {
        run(*world, 1);
        double inertia = 0;
        const auto points = pointsOf(*world, 0);
        for (std::size_t i = 0; i < points.size(); ++i)
            inertia += ball.masses[i] * (points[i] - world->bodies().position[0]).squaredNorm();
        EXPECT_NEAR(world->bodies().omega[0] * inertia, torque * second, 1e-4 * torque * second);
        EXPECT_NEAR(world->bodies().omega[1] * 3 * 1800 / 12, torque * second, 1e-9 * torque * second);
        EXPECT_NEAR(world->bodies().velocity[0].norm() + world->bodies().velocity[1].norm(), 0, 1e-9);
    }
}

TEST(MotionFormulas, AForceOffTheCentreTurnsASoftBodyByItsLever)
{
    const double force = 20;
    auto world = makeWorld({0, 0});
    const SoftBodyDef ball = softBall({0, 0}, 30, 2000, 5);
    world->addSoftBody(ball);
    // At the hub's height the lever is nothing; at the topmost particle it is the radius.
    world->addForce({{0, {30, 0}}, {0, force}});
    world->step(kStep);
    double inertia = 0, mass = 0;
    const auto points = pointsOf(*world, 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        inertia += ball.masses[i] * (points[i] - world->bodies().position[0]).squaredNorm();
        mass += ball.masses[i];
    }
    EXPECT_NEAR(world->bodies().velocity[0].y(), force * kStep / mass, 1e-9);
    EXPECT_NEAR(world->bodies().omega[0] * inertia, force * 30 * kStep, 0.02 * force * 30 * kStep);
}

TEST(MotionFormulas, ACompositeBodyComesBackToItsShapeToAThousandth)
{
    // A ring of particles sprung to an invisible rigid twin (SPEC PH6), let go from a squashed and twisted state.
    WorldSettings settings;
    settings.gravity = {0, 0};
    settings.materialCount = 2;
    settings.materials.assign(4, MaterialPair{0.5, 0, true});
    for (const int i : {1, 2, 3}) settings.materials[i].collides = false;
    auto world = JetPhysics().createWorld(settings);
    const std::vector<Vec2> shape = circleRing({0, 0}, 40, 32);
    SoftBodyDef ring;
    for (const Vec2& p : shape)
        ring.particles.push_back(Affine::rotation(0.2).linear() * Vec2(1.5 * p.x(), 0.5 * p.y()));
    ring.masses.assign(32, 1.0 / 32);
    ring.borders.emplace_back();
    for (std::uint32_t i = 0; i < 32; ++i) {
        ring.springs.push_back({i, (i + 1) % 32, (shape[1] - shape[0]).norm(), 50, 0.5, 0});
        ring.borders[0].push_back(i);
    }
    world->addSoftBody(ring);
    RigidBodyDef twin = rigid({shape}, 1);
    twin.common.material = 1;
    world->addRigidBody(twin);
    for (std::size_t i = 0; i < 32; ++i) {
        SpringActuatorDef bond;
        bond.a = {0, ring.particles[i]}, bond.b = {1, shape[i]};
        bond.restLength = 0, bond.ks = 60, bond.kd = 1;
        world->addSpring(bond);
    }
    run(*world, 8);
    const Vec2 centre = world->bodies().position[1];
    const Affine turn = Affine::rotation(world->bodies().angle[1]);
    for (std::size_t i = 0; i < 32; ++i)
        EXPECT_NEAR((pointsOf(*world, 0)[i] - centre - Vec2(turn.linear() * shape[i])).norm(), 0, 0.04) << i;
    EXPECT_NEAR((0.5 * (world->bodies().position[0] + world->bodies().position[1])).norm(), 0, 1e-6)
        << "their common centre stays";
}

}  // namespace

}  // namespace jet::physics::test
