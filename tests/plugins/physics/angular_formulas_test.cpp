// Angular springs between bodies on hinges, against their formulas: what they bear at rest, damped and overdamped
// swinging, and the modes of a double pendulum of rods.
#include "formulas.hpp"

#include <Eigen/Eigenvalues>

#include <complex>
#include <random>

namespace jet::physics::test {

namespace {

constexpr double kLength = 40, kWidth = 2, kMass = 1.5;
/// Of a rod about its middle and about its end.
constexpr double kInertia = kMass * (kLength * kLength + kWidth * kWidth) / 12;
constexpr double kAboutEnd = kInertia + kMass * kLength * kLength / 4;

Anchor on(BodyHandle body, const Vec2& at) { return {body, at, 0}; }

/// Rods hang one on the other, straight down from the origin; a hinge and an angular spring at the upper end of each,
/// which is at rest when the rod has turned by that angle against the one above.
std::unique_ptr<PhysicsWorld> rods(const std::vector<double>& rest, double gravity, double ks, double kd)
{
    auto world = makeWorld({0, gravity});
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const Vec2 hinge(0, kLength * static_cast<double>(i)), middle = hinge + Vec2(0, kLength / 2);
        RigidBodyDef rod = simple(box(middle, kWidth, kLength, kMass));
        rod.common.mask = 0;
        const BodyHandle body = world->addRigidBody(rod), above = i > 0 ? body - 1 : kNoHandle;
        JointDef joint;
        joint.a = on(above, hinge), joint.b = on(body, hinge);
        world->addJoint(joint);
        AngularSpringActuatorDef spring;
        spring.a = on(above, hinge - Vec2(0, kLength / 2)), spring.centre = on(above, hinge);
        spring.b = on(body, middle);
        spring.restFromPose = false, spring.restAngle = kPi + rest[i];
        spring.ks = ks, spring.kd = kd;
        world->addAngularSpring(spring);
    }
    return world;
}

/// Turning rates of the rods, as hinges allow them; small angles.
void turn(PhysicsWorld& world, const std::vector<double>& rates)
{
    double carried = 0;  // of the hinge, to the right
    for (BodyHandle rod = 0; rod < rates.size(); ++rod) {
        world.setVelocity(rod, {carried - rates[rod] * kLength / 2, 0});
        world.setOmega(rod, rates[rod]);
        carried -= rates[rod] * kLength;
    }
}

TEST(AngularFormulas, ALeverRestsWhereItsSpringBearsItWhateverTheDamping)
{
    // A rod that stands out to the right: ks φ = m g l / 2 cos φ.
    constexpr double kGravity = 98.1, kStiffness = 1e5;
    double angle = 0;
    for (int i = 0; i < 50; ++i) angle = kMass * kGravity * kLength / 2 * std::cos(angle) / kStiffness;
    for (const bool soft : {false, true}) {
        for (const double damping : {0.02, 0.05, 0.3}) {  // of ks, seconds
            WorldSettings settings;
            settings.gravity = {0, kGravity};
            settings.linearDamping = settings.angularDamping = 0;
            auto world = JetPhysics().createWorld(settings);
            RigidBodyDef rod = simple(box({kLength / 2, 0}, kLength, kWidth, kMass));
            rod.common.mask = 0;
            const BodyHandle body = world->addRigidBody(rod);
            BodyHandle base = kNoHandle;
            if (soft) {  // what holds the hinge is soft, and pinned
                SoftBodyDef patch = softBall({-6, 0}, 5);
                patch.movable.assign(patch.particles.size(), 0);
                patch.common.mask = 0;
                base = world->addSoftBody(patch);
            }
            JointDef joint;
            joint.a = on(base, {0, 0}), joint.b = on(body, {0, 0});
            world->addJoint(joint);
            world->addAngularSpring({on(base, {-5, 0}), on(base, {0, 0}), on(body, {kLength / 2, 0}), 0, true,
                                     kStiffness, damping * kStiffness});
            run(*world, 8);
            EXPECT_NEAR(world->bodies().angle[body], angle, 1e-4) << soft << " " << damping;
        }
    }
}

TEST(AngularFormulas, ADampedRodOnAHingeSwingsAndCreepsAsItsFormulaSays)
{
    // I φ'' + kd φ' + ks φ = 0 from φ0 at rest: φ = φ0 (s1 e^(s2 t) − s2 e^(s1 t)) / (s1 − s2). Looked at is how far it
    // has come, as overdamped that is little.
    constexpr double kStiffness = 4e4, kStart = 0.2;
    for (const double ratio : {0.0, 0.05, 0.3, 3.0, 30.0, 300.0}) {
        const double root = std::sqrt(kStiffness / kAboutEnd), kd = 2 * ratio * std::sqrt(kStiffness * kAboutEnd);
        auto world = rods({kStart}, 0, kStiffness, kd);
        const std::complex<double> half = root * std::sqrt(std::complex<double>(ratio * ratio - 1));
        const std::complex<double> s1 = -ratio * root + half, s2 = -ratio * root - half;
        double worst = 0, most = 0;
        for (int i = 1; i <= 240; ++i) {
            world->step(kStep / 2);
            const double t = i * kStep / 2;
            const double come = kStart * (1.0 - (s1 * std::exp(s2 * t) - s2 * std::exp(s1 * t)) / (s1 - s2)).real();
            most = std::max(most, std::abs(come));
            worst = std::max(worst, std::abs(world->bodies().angle[0] - come));
        }
        EXPECT_LT(worst, 0.02 * most) << "damping ratio " << ratio;
    }
}

TEST(AngularFormulas, ADoublePendulumSwingsInItsNormalModes)
{
    // M q'' + b K q' + K q = 0, with damping in proportion to the stiffness: in the mode K v = w² M v its part is
    // y'' + b w² y' + w² y = 0.
    constexpr double kStiffness = 5e4;
    Eigen::Matrix2d mass, stiffness;
    const double swung = kMass * kLength * kLength;
    mass << kAboutEnd + swung, swung / 2, swung / 2, kAboutEnd;
    stiffness << 2 * kStiffness, -kStiffness, -kStiffness, kStiffness;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> modes(stiffness, mass);
    for (const int mode : {0, 1}) {
        const double root = std::sqrt(modes.eigenvalues()[mode]);
        for (const double ratio : {0.0, 0.05, 0.3, 2.0}) {
            auto world = rods({0, 0}, 0, kStiffness, 2 * ratio / root * kStiffness);
            const Eigen::Vector2d shape = modes.eigenvectors().col(mode).normalized();
            const double start = 0.03 * root;
            turn(*world, {start * shape[0], start * shape[1]});
            const std::complex<double> half = root * std::sqrt(std::complex<double>(ratio * ratio - 1));
            double worst = 0, most = 0;
            const int steps = static_cast<int>(2 * 2 * kPi / root / (kStep / 4));
            for (int i = 1; i <= steps; ++i) {
                world->step(kStep / 4);
                const std::complex<double> t = i * kStep / 4;
                const double part =
                    (start * (std::exp((-ratio * root + half) * t) - std::exp((-ratio * root - half) * t)) /
                     (2.0 * half))
                        .real();
                most = std::max(most, std::abs(part));
                for (const int rod : {0, 1})
                    worst = std::max(worst, std::abs(world->bodies().angle[rod] - part * shape[rod]));
            }
            EXPECT_LT(worst, 0.03 * most) << "mode " << mode << ", damping ratio " << ratio;
        }
    }
}

TEST(AngularFormulas, ADoublePendulumUnderItsWeightFollowsItsEquations)
{
    // The same with gravity, which is not damped, from rest and straight, with springs that are bent. The equations are
    // solved by Runge-Kutta in a hundredth of the step. V = m g l / 2 (3 q1² + q2²) / 2 + ks / 2 ((q1 - r1)² +
    // (q2 - q1 - r2)²)
    constexpr double kStiffness = 5e4, kGravity = 98.1, kRestA = 0.006, kRestB = -0.01;
    const double swung = kMass * kLength * kLength, weight = kMass * kGravity * kLength / 2;
    Eigen::Matrix2d mass, stiffness, damping;
    mass << kAboutEnd + swung, swung / 2, swung / 2, kAboutEnd;
    damping << 2, -1, -1, 1;
    stiffness << 2 * kStiffness + 3 * weight, -kStiffness, -kStiffness, kStiffness + weight;
    const Eigen::Matrix2d inverse = mass.inverse();
    const Eigen::Vector2d bent = kStiffness * Eigen::Vector2d(kRestA - kRestB, kRestB);
    for (const double kd : {0.0, 2e3, 2e4, 2e5, 2e6}) {  // the last ones creep so slowly that they seem to rest
        auto world = rods({kRestA, kRestB}, kGravity, kStiffness, kd);
        Eigen::Vector4d now = Eigen::Vector4d::Zero();
        const auto slope = [&](const Eigen::Vector4d& at) {
            Eigen::Vector4d out;
            out << at.tail<2>(), inverse * (bent - stiffness * at.head<2>() - kd * damping * at.tail<2>());
            return out;
        };
        double worst = 0, most = 0;
        for (int i = 0; i < 480; ++i) {
            world->step(kStep / 4);
            constexpr int kParts = 1000;
            constexpr double kFine = kStep / 4 / kParts;
            for (int k = 0; k < kParts; ++k) {
                const Eigen::Vector4d a = slope(now), b = slope(now + kFine / 2 * a), c = slope(now + kFine / 2 * b);
                now += kFine / 6 * (a + 2 * b + 2 * c + slope(now + kFine * c));
            }
            most = std::max(most, now.head<2>().cwiseAbs().maxCoeff());
            for (const int rod : {0, 1}) worst = std::max(worst, std::abs(world->bodies().angle[rod] - now[rod]));
        }
        EXPECT_LT(worst, 0.03 * most) << "kd " << kd;
    }
}

/// What boxes move with, about the origin; motion within joints and springs included.
struct Motion {
    Vec2 momentum{0, 0};
    double spin = 0, energy = 0;
};

Motion motionOf(const PhysicsWorld& world, const std::vector<double>& masses, double inertiaAMass)
{
    Motion all;
    const BodyStates bodies = world.bodies();
    for (std::size_t i = 0; i < masses.size(); ++i) {
        const Vec2 &at = bodies.position[i], &velocity = bodies.velocity[i];
        const double inertia = masses[i] * inertiaAMass, omega = bodies.omega[i];
        all.momentum += masses[i] * velocity;
        all.spin += masses[i] * cross(at, velocity) + inertia * omega;
        all.energy += masses[i] / 2 * velocity.squaredNorm() + inertia / 2 * omega * omega;
    }
    return all;
}

TEST(AngularFormulas, DampedSpringsBetweenFreeBodiesPushAndTurnNothing)
{
    // Arms on three bodies of their own.
    for (const double kd : {10.0, 1e3, 1e5, 1e7}) {
        auto world = makeWorld({0, 0});
        const std::vector<double> masses = {1, 7, 0.3};
        const Vec2 places[] = {{-40, 3}, {0, 0}, {25, 30}};
        for (int i = 0; i < 3; ++i) {
            RigidBodyDef body = simple(box(places[i], 10, 10, masses[i]));
            body.common.mask = 0;
            world->addRigidBody(body);
        }
        AngularSpringActuatorDef spring;
        spring.a = on(0, {-38, 5}), spring.centre = on(1, {2, -1}), spring.b = on(2, {27, 31});
        spring.restFromPose = false, spring.restAngle = 1, spring.ks = 1e4, spring.kd = kd;
        world->addAngularSpring(spring);
        world->setVelocity(0, {0, 20}), world->setOmega(1, 3), world->setVelocity(2, {-15, 4});
        const Motion before = motionOf(*world, masses, 100.0 / 6);
        for (int i = 0; i < 300; ++i) {
            world->step(kStep);
            const Motion now = motionOf(*world, masses, 100.0 / 6);
            ASSERT_LT((now.momentum - before.momentum).norm(), 1e-9) << kd << " " << i;
            ASSERT_NEAR(now.spin, before.spin, 1e-7) << kd << " " << i;
        }
    }
}

TEST(AngularFormulas, RodsOnDampedSpringsHaveNoMoreThanTheirSpringsHeld)
{
    for (unsigned seed = 1; seed <= 40; ++seed) {
        std::mt19937 random(seed);
        const auto between = [&](double low, double high) {
            return low + (high - low) * std::generate_canonical<double, 32>(random);
        };
        const std::vector<double> rest = {between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)};
        // Less damped, ½ ks φ² rises and falls with the phase, as symplectic Euler does.
        const double ks = std::pow(10, between(3, 6)), kd = ks * std::pow(10, between(-2.5, 1.5));
        auto world = rods(rest, 0, ks, kd);
        double held = 0;
        for (const double each : rest) held += ks / 2 * each * each;
        double most = 0;
        for (int i = 0; i < 300; ++i) {
            world->step(kStep);
            double now = motionOf(*world, {kMass, kMass, kMass, kMass}, kInertia / kMass).energy, above = 0;
            for (std::size_t rod = 0; rod < rest.size(); ++rod) {
                const double bent = world->bodies().angle[rod] - above - rest[rod];
                above = world->bodies().angle[rod];
                now += ks / 2 * bent * bent;
            }
            most = std::max(most, now);
        }
        EXPECT_LT(most, 1.02 * held) << "seed " << seed;
    }
}

}  // namespace

}  // namespace jet::physics::test
