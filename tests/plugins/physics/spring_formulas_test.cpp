// Springs against their formulas over six decades of stiffness: period, damping ratio, angles through a half turn,
// forces and torques that sum to zero, tearing at exactly kt.
#include "formulas.hpp"

#include <utility>

namespace jet::physics::test {

namespace {

constexpr double kMassA = 1, kMassB = 3, kReduced = kMassA * kMassB / (kMassA + kMassB), kRest = 100;

/// `count` pairs, each on one spring of its own: one pair is computed in double, many in the wide kernels.
SoftBodyDef pairs(int count, double ks, double kd, double stretch)
{
    SoftBodyDef def;
    for (int i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(def.particles.size());
        def.particles.emplace_back(0, 20 * i);
        def.particles.emplace_back(kRest + stretch, 20 * i);
        def.masses.insert(def.masses.end(), {kMassA, kMassB});
        def.springs.push_back({first, first + 1, kRest, ks, kd, 0});
    }
    return def;
}

double stretchOf(const PhysicsWorld& world, int pair)
{
    const auto points = pointsOf(world, 0);
    return (points[2 * pair + 1] - points[2 * pair]).norm() - kRest;
}

TEST(SpringFormulas, ThePeriodIsTwoPiRootOfMassOverStiffnessOverSixDecades)
{
    for (const int count : {1, 24}) {
        for (double ks = 0.1; ks < 2e5; ks *= 10) {
            const double period = 2 * kPi * std::sqrt(kReduced / ks), step = std::min(kStep, period / 40);
            auto world = makeWorld({0, 0});
            world->addSoftBody(pairs(count, ks, 0, 5));
            const Swing swing = swingOf(*world, step, 3, [&] { return stretchOf(*world, count / 2); });
            EXPECT_NEAR(swing.period, period, 2e-3 * period) << "ks " << ks << ", pairs " << count;
            EXPECT_NEAR(swing.decrement, 0, 2e-3) << "ks " << ks << ", pairs " << count;
        }
    }
}

TEST(SpringFormulas, ALongBarSwingsInTimeThoughItsFastestMotionsMayNot)
{
    // n masses on a line, the first tied to one that is pinned: w_k = 2 sqrt(ks / m) sin((2k - 1) pi / (2 (2n + 1))),
    // and the k-th motion is sin((2k - 1) pi i / (2n + 1)). Stiff enough to decide about the substeps.
    constexpr int kCount = 400;
    constexpr double kStiffness = 3e5;
    for (const int k : {1, 2, 5}) {
        SoftBodyDef def;
        const double turn = (2 * k - 1) * kPi / (2 * kCount + 1);
        for (int i = 0; i <= kCount; ++i) {
            def.particles.emplace_back(10 * i + 0.3 * std::sin(turn * i), 0);
            if (i > 0)
                def.springs.push_back(
                    {static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i), 10, kStiffness, 0, 0});
        }
        def.masses.assign(def.particles.size(), 1);
        def.movable.assign(def.particles.size(), 1);
        def.movable[0] = 0;
        auto world = makeWorld({0, 0});
        world->addSoftBody(def);
        const double period = kPi / (std::sqrt(kStiffness) * std::sin(turn / 2));
        const Swing swing = swingOf(*world, std::min(kStep, period / 40), 3,
                                    [&] { return pointsOf(*world, 0)[kCount].x() - 10 * kCount; });
        EXPECT_LT(world->stats().substeps, 20U);
        EXPECT_NEAR(swing.period, period, 1e-3 * period) << k;
    }
}

TEST(SpringFormulas, TheDampingRatioIsAsAskedOverSixDecades)
{
    // x = exp(-zeta w t) cos(w sqrt(1 - zeta²) t), zeta = kd / (2 sqrt(ks m)): from one maximum to the next
    // ln(x1 / x2) = 2 pi zeta / sqrt(1 - zeta²).
    for (const int count : {1, 24}) {
        for (double ks = 0.1; ks < 2e5; ks *= 10) {
            for (const double zeta : {0.02, 0.1, 0.3}) {
                const double damped = 2 * kPi * std::sqrt(kReduced / ks / (1 - zeta * zeta));
                auto world = makeWorld({0, 0});
                world->addSoftBody(pairs(count, ks, 2 * zeta * std::sqrt(ks * kReduced), 5));
                const Swing swing =
                    swingOf(*world, std::min(kStep, damped / 60), 3, [&] { return stretchOf(*world, 0); });
                const double expected = 2 * kPi * zeta / std::sqrt(1 - zeta * zeta);
                EXPECT_NEAR(swing.decrement, expected, 0.02 * expected + 1e-3) << ks << " " << zeta << " " << count;
                EXPECT_NEAR(swing.period, damped, 0.02 * damped) << ks << " " << zeta << " " << count;
            }
        }
    }
}

TEST(SpringFormulas, AtTheDefaultStepEachSubstepTurnsAnUndampedSpringByTwiceTheArcsineOfHalfItsPhase)
{
    // x' = 2 cos(turn) x - x'' from step to step, turn = n 2 asin(w h / 2): also of what swings faster than is seen.
    for (const int count : {1, 24}) {
        for (double ks = 0.1; ks < 3.5e6; ks *= 5) {
            auto world = makeWorld({0, 0});
            world->addSoftBody(pairs(count, ks, 0, 5));
            double before = 5, now = 0, most = 0;
            world->step(kStep);
            now = stretchOf(*world, 0);
            const double substeps = world->stats().substeps, h = kStep / substeps;
            const double phase = std::sqrt(ks / kReduced) * h, turn = substeps * 2 * std::asin(phase / 2);
            for (int i = 0; i < 120; ++i) {
                world->step(kStep);
                const double next = stretchOf(*world, 0);
                EXPECT_NEAR(next, 2 * std::cos(turn) * now - before, 2e-3) << ks << " " << count << " " << i;
                before = std::exchange(now, next);
                most = std::max(most, std::abs(now));
            }
            EXPECT_LT(most, 6.5) << ks;  // none is gained, whatever of it is seen
            EXPECT_LT(2 * std::asin(phase / 2) / phase, phase <= 0.5 ? 1.011 : 1.073) << ks;
        }
    }
}

/// Symplectic Euler swings 1 / sqrt(1 - (w h)² / 4) times as wide as it was drawn, but no spring more than sqrt(2)
/// times for it; whatever of it is seen, and no spring is softer at rest for it.
TEST(SpringFormulas, NothingSwingsMuchWiderThanItWasDrawn)
{
    constexpr double kDrawn = 0.1;
    for (const double step : {1.0 / 30, kStep, 1.0 / 1000}) {
        for (const int count : {1, 24}) {
            for (double rate = 2300; rate < 4200; rate += 100) {
                auto world = makeWorld({0, 0});
                world->addSoftBody(pairs(count, rate * rate * kReduced, 0, kDrawn));
                double most = 0;
                for (int i = 0; i < 600; ++i) {
                    world->step(step);
                    most = std::max(most, std::abs(stretchOf(*world, count / 2)));
                }
                EXPECT_LT(most, 1.43 * kDrawn) << rate << " rad/s, step " << step << ", pairs " << count;
            }
        }
    }
}

TEST(SpringFormulas, ASpringThatSwingsInShorterSubstepsIsAsStiffAtRest)
{
    // Hung at 0, so that what its mean is longer than at rest is m g / ks.
    constexpr double kGravity = 1000;
    for (const double rate : {2000.0, 2300.0, 2600.0, 2700.0}) {
        auto world = makeWorld({0, kGravity});
        SoftBodyDef def;
        def.particles = {{0, 0}, {0, kRest}};
        def.masses = {1, 1}, def.movable = {0, 1};
        def.springs.push_back({0, 1, kRest, rate * rate, 0, 0});
        world->addSoftBody(def);
        double sum = 0;
        constexpr int kSteps = 2000;
        for (int i = 0; i < kSteps; ++i) {
            world->step(kStep);
            sum += (pointsOf(*world, 0)[1] - pointsOf(*world, 0)[0]).norm() - kRest;
        }
        const double sag = kGravity / (rate * rate);
        EXPECT_NEAR(sum / kSteps, sag, 0.05 * sag) << rate;
    }
}

TEST(SpringFormulas, AtTheDefaultStepSpringsTooStiffForItsSubstepsComeToRestWithinTwoSteps)
{
    for (const int count : {1, 24}) {
        for (double ks = count == 1 ? 1e7 : 1e8; ks < 2e10; ks *= 10) {
            auto world = makeWorld({0, 0});
            world->addSoftBody(pairs(count, ks, 0, 5));
            world->step(kStep), world->step(kStep);
            for (int i = 0; i < 60; ++i) {
                EXPECT_LT(std::abs(stretchOf(*world, 0)), 0.05) << ks << " " << count << " " << i;
                world->step(kStep);
            }
        }
    }
}

TEST(SpringFormulas, BeyondTheCriticalRatioNothingSwings)
{
    for (double ks = 0.1; ks < 2e5; ks *= 10) {
        for (const double zeta : {1.0, 3.0}) {
            auto world = makeWorld({0, 0});
            world->addSoftBody(pairs(1, ks, 2 * zeta * std::sqrt(ks * kReduced), 5));
            double least = 5;
            for (int i = 0; i < 600; ++i) {
                world->step(kStep);
                least = std::min(least, stretchOf(*world, 0));
            }
            EXPECT_GT(least, -0.005 * 5) << ks << " " << zeta;
        }
    }
}

/// b on an arm of 10 about the fixed centre; a is fixed on the x axis. The angle from a to b is `angle`.
SoftBodyDef arm(double angle, double restAngle, double ks, double mass)
{
    SoftBodyDef def;
    def.particles = {{10, 0}, {0, 0}, {10 * std::cos(angle), 10 * std::sin(angle)}};
    def.masses = {1, 1, mass};
    def.movable = {0, 0, 1};
    def.springs = {{1, 2, 10, ks / 2, 0, 0}};  // fifty times stiffer than what turns it, ks / r²
    def.angularSprings = {{0, 1, 2, restAngle, ks, 0}};
    return def;
}

TEST(SpringFormulas, AnAngularSpringSwingsInItsPeriodWhereverItsRestIs)
{
    // T = 2 pi sqrt(I / ks), I = m r²: at rest at a right angle, and at a half turn, where atan2 jumps.
    const double mass = 2;
    for (const double rest : {0.0, kPi / 2, kPi - 0.01, kPi, kPi + 0.01, -kPi / 2}) {
        for (double ks = 1; ks < 2e6; ks *= 10) {
            const double period = 2 * kPi * std::sqrt(mass * 100 / ks), step = std::min(kStep, period / 40);
            auto world = makeWorld({0, 0});
            world->addSoftBody(arm(rest + 0.1, rest, ks, mass));
            const Vec2 along(std::cos(rest), std::sin(rest));
            const Swing swing = swingOf(*world, step, 3, [&] { return cross(along, pointsOf(*world, 0)[2]); });
            EXPECT_NEAR(swing.period, period, 3e-3 * period) << "ks " << ks << ", rest " << rest;
        }
    }
}

TEST(SpringFormulas, AnAngularSpringIsUnwrappedBeyondAHalfTurn)
{
    // Thrown so that it swings by 4 rad to both sides of its rest, more than a half turn: still the same period. Taken
    // as atan2 sees it the angle would jump to -2.28 there, and the spring would pull on.
    const double ks = 200, mass = 2, omega = std::sqrt(ks / (mass * 100));
    SoftBodyDef def = arm(0, 0, ks, mass);
    def.particles[0] = {20, 0};
    def.springs[0].ks = 1e5;
    def.common.velocity = {0, 10 * 4 * omega};
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    double angle = 0, before = 0, most = 0, least = 0;
    const Swing swing = swingOf(*world, kStep, 3, [&] {
        const Vec2 at = pointsOf(*world, 0)[2];
        const double now = std::atan2(at.y(), at.x());
        angle += std::remainder(now - before, 2 * kPi), before = now;
        most = std::max(most, angle), least = std::min(least, angle);
        return angle;
    });
    EXPECT_NEAR(most, 4, 0.04);
    EXPECT_NEAR(least, -4, 0.04);
    EXPECT_NEAR(swing.period, 2 * kPi / omega, 0.01 * 2 * kPi / omega);
}

TEST(SpringFormulas, AngularSpringsPushAndTurnNothingAsTheyPassAHalfTurn)
{
    // Free in space, unequal masses and arms, swinging to and fro over a half turn.
    auto world = makeWorld({0, 0});
    SoftBodyDef def;
    def.particles = {{10, 0}, {0, 0}, {17 * std::cos(3.5), 17 * std::sin(3.5)}};
    def.masses = {1, 7, 0.3};
    def.angularSprings = {{0, 1, 2, 3.1, 500, 0.5}};
    world->addSoftBody(def);
    Vec2 centre(0, 0);
    for (std::size_t i = 0; i < 3; ++i) centre += def.masses[i] * def.particles[i];
    centre /= 8.3;
    double least = 10, most = 0;
    for (int i = 0; i < 600; ++i) {
        world->step(kStep / 4);
        const auto p = pointsOf(*world, 0);
        const Vec2 a = p[0] - p[1], b = p[2] - p[1];
        double angle = std::atan2(cross(a, b), a.dot(b));
        if (angle < 0) angle += 2 * kPi;
        least = std::min(least, angle), most = std::max(most, angle);
        ASSERT_NEAR(world->bodies().velocity[0].norm(), 0, 1e-11) << i;
        ASSERT_NEAR(world->bodies().omega[0], 0, 1e-11) << i;
        ASSERT_NEAR((world->bodies().position[0] - centre).norm(), 0, 1e-9) << i;
    }
    EXPECT_LT(least, kPi - 0.1) << "it passed the half turn";
    EXPECT_GT(most, kPi + 0.1);
}

TEST(SpringFormulas, AngularSpringsBetweenBodiesUnwrapToo)
{
    // Two plates on one pin; the upper one is thrown by 4 rad. T = 2 pi sqrt(I / ks) about the pin.
    const double ks = 4000, mass = 2, omega = std::sqrt(ks / (mass * (100 + 100) / 12));
    auto world = makeWorld({0, 0});
    RigidBodyDef still = fixed({boxRing({0, 0}, 10, 10)});
    still.common.mask = 0;
    const BodyHandle base = world->addRigidBody(still);
    RigidBodyDef turning = box({0, 0}, 10, 10, mass);
    turning.common.mask = 0;
    turning.common.omega = 4 * omega;
    const BodyHandle plate = world->addRigidBody(turning);
    JointDef pin;
    pin.a = {base, {0, 0}}, pin.b = {plate, {0, 0}};
    world->addJoint(pin);
    AngularSpringActuatorDef spring;
    spring.a = {base, {4, 0}}, spring.centre = {base, {0, 0}}, spring.b = {plate, {4, 0}};
    spring.ks = ks, spring.kd = 0;
    world->addAngularSpring(spring);
    double most = 0;
    const Swing swing = swingOf(*world, kStep, 3, [&] {
        most = std::max(most, world->bodies().angle[plate]);
        return world->bodies().angle[plate];
    });
    EXPECT_NEAR(most, 4, 0.08);
    EXPECT_NEAR(swing.period, 2 * kPi / omega, 0.01 * 2 * kPi / omega);
}

TEST(SpringFormulas, SpringsBetweenBodiesSwingInTheirPeriodOverSixDecades)
{
    for (double ks = 0.1; ks < 2e5; ks *= 10) {
        const double period = 2 * kPi * std::sqrt(kReduced / ks);
        auto world = makeWorld({0, 0});
        world->addRigidBody(box({0, 0}, 10, 10, kMassA));
        world->addRigidBody(box({105, 0}, 10, 10, kMassB));
        SpringActuatorDef spring;
        spring.a = {0, {0, 0}}, spring.b = {1, {105, 0}};
        spring.restLength = 100, spring.ks = ks, spring.kd = 0;
        world->addSpring(spring);
        const Swing swing = swingOf(*world, std::min(kStep, period / 40), 3, [&] {
            return world->bodies().position[1].x() - world->bodies().position[0].x() - 100;
        });
        EXPECT_NEAR(swing.period, period, 3e-3 * period) << ks;
        const Vec2 momentum = kMassA * world->bodies().velocity[0] + kMassB * world->bodies().velocity[1];
        EXPECT_NEAR(momentum.norm(), 0, 1e-9 * std::sqrt(ks)) << ks;
    }
}

TEST(SpringFormulas, ASpringBetweenBodiesTearsAtExactlyItsRatio)
{
    // Let go a billionth below the length it holds, and a billionth above: it pulls, or it never did.
    for (const double part : {1 - 1e-9, 1 + 1e-9}) {
        auto world = makeWorld({0, 0});
        world->addRigidBody(fixed({boxRing({0, 0}, 10, 10)}));
        world->addRigidBody(box({130, 0}, 10, 10));
        SpringActuatorDef spring;
        spring.a = {0, {0, 0}}, spring.b = {1, {130, 0}};
        spring.tearRatio = 1.3, spring.restLength = 100 / part;
        world->addSpring(spring);
        world->step(kStep);
        EXPECT_EQ(world->bodies().velocity[1].x() < 0, part < 1) << part;
        EXPECT_LE(world->bodies().velocity[1].x(), 0) << part;
    }
}

}  // namespace

}  // namespace jet::physics::test
