// Damped springs between bodies beside joints, against their formulas: what they bear at rest, damped and overdamped
// swinging about a hinge, several at once, sleep, momenta, and no energy from nowhere.
#include "formulas.hpp"

#include <complex>
#include <random>

namespace jet::physics::test {

namespace {

constexpr double kLength = 40, kWidth = 2, kMass = 1.5, kGravity = 98.1;
/// Of a rod about its middle and about its end.
constexpr double kAcross = kMass * (kLength * kLength + kWidth * kWidth) / 12;
constexpr double kAboutEnd = kMass * (kLength * kLength / 3 + kWidth * kWidth / 12);

Anchor on(BodyHandle body, const Vec2& at) { return {body, at, 0}; }

WorldSettings undamped(double gravity)
{
    WorldSettings settings;
    settings.gravity = {0, gravity};
    settings.linearDamping = settings.angularDamping = 0;
    return settings;
}

BodyHandle addBox(PhysicsWorld& world, const Vec2& middle, double width, double height, double mass)
{
    RigidBodyDef rod = simple(box(middle, width, height, mass));
    rod.common.mask = 0;
    return world.addRigidBody(rod);
}

/// From the origin to the right.
BodyHandle addRod(PhysicsWorld& world) { return addBox(world, {kLength / 2, 0}, kLength, kWidth, kMass); }

/// Soft, and all its particles are pinned.
BodyHandle addPatch(PhysicsWorld& world, const Vec2& at)
{
    SoftBodyDef patch = softBall(at, 5);
    patch.movable.assign(patch.particles.size(), 0);
    patch.common.mask = 0;
    return world.addSoftBody(patch);
}

void addHinge(PhysicsWorld& world, BodyHandle a, BodyHandle b, const Vec2& at)
{
    JointDef joint;
    joint.a = on(a, at), joint.b = on(b, at);
    world.addJoint(joint);
}

constexpr double kAbove = 100;

/// Where the rod rests on a spring that holds it `reach` from its hinge and is at rest there, hung up above: the root
/// of the sum of torques.
double restOf(double reach, double ks)
{
    double low = 0, high = 0.5;
    for (int i = 0; i < 60; ++i) {
        const double angle = (low + high) / 2;
        const Vec2 end = reach * Vec2(std::cos(angle), std::sin(angle)), line = Vec2(reach, -kAbove) - end;
        const double pull = ks * (line.norm() - kAbove);
        const double torque = kMass * kGravity * kLength / 2 * std::cos(angle) + cross(end, pull / line.norm() * line);
        (torque > 0 ? low : high) = angle;
    }
    return low;
}

enum class Held { ByBackground, BySoft, ByRigid };

/// A rod on a hinge at the origin, and a spring that holds it.
std::unique_ptr<PhysicsWorld> lever(Held held, double reach, double ks, double kd, BodyHandle& rod)
{
    auto world = JetPhysics().createWorld(undamped(kGravity));
    rod = addRod(*world);
    BodyHandle base = kNoHandle, hook = kNoHandle;
    const Vec2 above(reach, -kAbove);
    if (held == Held::BySoft) base = addPatch(*world, {-6, 0}), hook = addPatch(*world, above);
    if (held == Held::ByRigid) {  // welded to the background
        hook = addBox(*world, {0, -kAbove}, 100, 4, kMass);
        JointDef weld;
        weld.kind = JointDef::Kind::Weld;
        weld.a = on(kNoHandle, {-20, -kAbove}), weld.b = on(hook, {-20, -kAbove});
        world->addJoint(weld);
    }
    addHinge(*world, base, rod, {0, 0});
    world->addSpring({on(hook, above), on(rod, {reach, 0}), kAbove, ks, kd, 0});
    return world;
}

TEST(LeverFormulas, ALeverRestsWhereItsSpringBearsItWhateverTheDamping)
{
    // Hinge and weld give way by themselves where the lever is short.
    for (const Held held : {Held::ByBackground, Held::BySoft, Held::ByRigid}) {
        for (const double reach : {kLength, kLength / 4}) {
            const double ks = 60 * std::pow(kLength / reach, 2);
            double low = 1, high = -1;
            for (const double damping : {0.05, 0.3, 2.0}) {  // of ks, seconds
                BodyHandle rod = 0;
                auto world = lever(held, reach, ks, damping * ks, rod);
                run(*world, 8 + 20 * damping);
                const double angle = world->bodies().angle[rod];
                low = std::min(low, angle), high = std::max(high, angle);
                if (reach == kLength && held != Held::ByRigid) {
                    EXPECT_NEAR(angle, restOf(reach, ks), 1e-4) << static_cast<int>(held) << " " << damping;
                }
            }
            EXPECT_LT(high - low, 1e-4) << static_cast<int>(held) << " " << reach;
        }
    }
}

TEST(LeverFormulas, WhatCreepsDoesNotSleepAndSleepsOnceItHasCome)
{
    BodyHandle rod = 0;
    auto world = lever(Held::ByBackground, kLength, 60, 4 * 60, rod);
    while (world->awake(rod) && world->bodies().angle[rod] < 1) world->step(kStep);
    EXPECT_NEAR(world->bodies().angle[rod], restOf(kLength, 60), 1e-4);
}

TEST(LeverFormulas, ADampedRodOnAHingeSwingsAndCreepsAsItsFormulaSays)
{
    // I φ'' + kd a² φ' + ks a² φ = 0 from φ0 at rest, a the lever: φ = φ0 (s1 e^(s2 t) − s2 e^(s1 t)) / (s1 − s2).
    // Looked at is how far it has come, as overdamped that is little.
    constexpr double kStart = 0.01, kFar = 2000, kRoot = 12;
    for (const double reach : {kLength, kLength / 4}) {
        for (const double ratio : {0.0, 0.05, 0.3, 3.0, 30.0, 300.0}) {
            const double ks = kRoot * kRoot * kAboutEnd / (reach * reach);
            const double kd = 2 * ratio * kRoot * kAboutEnd / (reach * reach);
            auto world = JetPhysics().createWorld(undamped(0));
            const BodyHandle rod = addRod(*world);
            addHinge(*world, kNoHandle, rod, {0, 0});
            world->addSpring({on(kNoHandle, {reach, -kFar}), on(rod, {reach, 0}), kFar - kStart * reach, ks, kd, 0});
            const std::complex<double> half = kRoot * std::sqrt(std::complex<double>(ratio * ratio - 1));
            const std::complex<double> s1 = -ratio * kRoot + half, s2 = -ratio * kRoot - half;
            double worst = 0, most = 0;
            for (int i = 1; i <= 240; ++i) {
                world->step(kStep / 2);
                const double t = i * kStep / 2;
                const double come =
                    -kStart * (1.0 - (s1 * std::exp(s2 * t) - s2 * std::exp(s1 * t)) / (s1 - s2)).real();
                most = std::max(most, std::abs(come));
                worst = std::max(worst, std::abs(world->bodies().angle[rod] - come));
            }
            EXPECT_LT(worst, 0.025 * most) << "reach " << reach << ", damping ratio " << ratio;
        }
    }
}

TEST(LeverFormulas, SeveralOverdampedSpringsCreepAsTheirSumsSay)
{
    // Side by side on one box: x' = −Σ ks / Σ kd x.
    for (const int count : {1, 2, 5}) {
        for (const double kd : {100.0, 1e3, 1e5}) {
            auto world = JetPhysics().createWorld(undamped(0));
            const BodyHandle body = addBox(*world, {0, 0}, 10, 10, 1);
            double stiffness = 0, damping = 0;
            for (int i = 0; i < count; ++i) {
                const double ks = kd * (0.5 + 0.1 * i);
                world->addSpring({on(kNoHandle, {0, -100}), on(body, {0, 0}), 99, ks, kd, 0});
                stiffness += ks, damping += kd;
            }
            run(*world, 1);
            const double come = 1 - std::exp(-stiffness / damping);
            EXPECT_NEAR(world->bodies().position[body].y(), -come, 0.02 * come) << count << " " << kd;
        }
    }
}

TEST(LeverFormulas, DampedSpringsBetweenFreeBodiesPushAndTurnNothing)
{
    for (const double kd : {10.0, 1e3, 1e5, 1e7}) {
        auto world = JetPhysics().createWorld(undamped(0));
        const std::vector<double> masses = {1, 7, 0.3};
        const Vec2 places[] = {{-40, 3}, {0, 0}, {25, 30}};
        for (int i = 0; i < 3; ++i) addBox(*world, places[i], 10, 10, masses[i]);
        for (BodyHandle i = 0; i < 3; ++i) {
            const BodyHandle next = (i + 1) % 3;
            world->addSpring({on(i, places[i] + Vec2(3, 4)), on(next, places[next] - Vec2(4, 1)), 20, 50, kd, 0});
        }
        world->setVelocity(0, {0, 20}), world->setOmega(1, 3), world->setVelocity(2, {-15, 4});
        const auto momenta = [&] {
            std::pair<Vec2, double> all{Vec2(0, 0), 0};
            const BodyStates bodies = world->bodies();
            for (std::size_t i = 0; i < masses.size(); ++i) {
                all.first += masses[i] * bodies.velocity[i];
                all.second += masses[i] * (cross(bodies.position[i], bodies.velocity[i]) + 100.0 / 6 * bodies.omega[i]);
            }
            return all;
        };
        const auto before = momenta();
        for (int i = 0; i < 300; ++i) {
            world->step(kStep);
            ASSERT_LT((momenta().first - before.first).norm(), 1e-9) << kd << " " << i;
            ASSERT_NEAR(momenta().second, before.second, 1e-7) << kd << " " << i;
        }
    }
}

/// Boxes on hinges, with springs between them and to the background.
struct Net {
    std::unique_ptr<PhysicsWorld> world;
    std::vector<double> masses, inertias;
    std::vector<SpringActuatorDef> springs;
    std::vector<std::pair<Vec2, Vec2>> locals;  // of their ends, in the bodies' frames

    double kinetic() const
    {
        double sum = 0;
        const BodyStates all = world->bodies();
        for (std::size_t i = 0; i < masses.size(); ++i)
            sum += masses[i] / 2 * all.velocity[i].squaredNorm() + inertias[i] / 2 * all.omega[i] * all.omega[i];
        return sum;
    }
    Vec2 at(const Anchor& anchor, const Vec2& local) const
    {
        if (anchor.body == kNoHandle) return anchor.point;
        const double angle = world->bodies().angle[anchor.body];
        return world->bodies().position[anchor.body] + Affine::rotation(angle).linear() * local;
    }
    double held() const
    {
        double sum = 0;
        for (std::size_t i = 0; i < springs.size(); ++i) {
            const double length = (at(springs[i].a, locals[i].first) - at(springs[i].b, locals[i].second)).norm();
            sum += springs[i].ks / 2 * std::pow(length - springs[i].restLength, 2);
        }
        return sum;
    }
};

Net netOf(unsigned seed, int threads = 1)
{
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 32>(random);
    };
    Net net;
    WorldSettings settings = undamped(0);
    settings.threads = threads;
    net.world = JetPhysics().createWorld(settings);
    std::vector<Vec2> places;
    for (int i = 0; i < 5; ++i) {
        const double mass = std::pow(10, between(-0.5, 0.5));
        places.emplace_back(30 * i, between(-10, 10));
        addBox(*net.world, places.back(), 20, 6, mass);
        net.masses.push_back(mass), net.inertias.push_back(mass * (400 + 36) / 12);
        const auto body = static_cast<BodyHandle>(i);
        if (i > 0 && between(0, 1) < 0.7) addHinge(*net.world, body - 1, body, (places[i] + places[i - 1]) / 2);
    }
    if (between(0, 1) < 0.5) addHinge(*net.world, kNoHandle, 0, places[0] - Vec2(8, 0));
    for (int i = 0; i < 6; ++i) {
        const auto a = static_cast<BodyHandle>(between(0, 4.999)), other = static_cast<BodyHandle>(between(0, 5.999));
        if (a == other) continue;
        const BodyHandle b = other == 5 ? kNoHandle : other;
        const Vec2 localA(between(-10, 10), between(-3, 3)), localB(between(-10, 10), between(-3, 3));
        SpringActuatorDef spring;
        spring.a = on(a, places[a] + localA);
        spring.b = b == kNoHandle ? on(b, Vec2(between(-50, 170), between(-80, 80))) : on(b, places[b] + localB);
        const double length = (spring.a.point - spring.b.point).norm();
        spring.restLength = length * between(0.7, 1.3);
        // Less damped, ½ ks e² rises and falls with the phase, as symplectic Euler does.
        spring.ks = std::pow(10, between(0, 4));
        spring.kd = spring.ks * std::pow(10, between(-2.5, 1.5));
        net.world->addSpring(spring);
        net.springs.push_back(spring), net.locals.emplace_back(localA, localB);
    }
    return net;
}

TEST(LeverFormulas, NetsOfJointsAndDampedSpringsHaveNoMoreThanTheirSpringsHeld)
{
    for (unsigned seed = 1; seed <= 40; ++seed) {
        const Net net = netOf(seed);
        const double held = net.held();
        double most = 0;
        for (int i = 0; i < 300; ++i) {
            net.world->step(kStep);
            most = std::max(most, net.kinetic() + net.held());
        }
        EXPECT_LT(most, 1.02 * held) << "seed " << seed;
    }
}

TEST(LeverFormulas, TheFutureOfASavedNetIsTheSameOnAllThreads)
{
    for (const unsigned seed : {3U, 7U}) {
        const Net net = netOf(seed), other = netOf(seed, 2);
        for (int i = 0; i < 40; ++i) net.world->step(kStep);
        other.world->restore(net.world->save());
        for (int i = 0; i < 100; ++i) {
            net.world->step(kStep), other.world->step(kStep);
            ASSERT_EQ(net.world->hash(), other.world->hash()) << seed << " " << i;
        }
    }
}

TEST(LeverFormulas, NoStiffnessNoDampingNoMassAndNoStepMakesALeverExplode)
{
    // A rod on a hinge, another on its end, and a spring between them that is drawn.
    for (const bool soft : {false, true}) {
        for (double ks = 1e-3; ks < 2e9; ks *= 100) {
            for (const double damping : {0.0, 1e-4, 1e-2, 1.0, 1e4}) {  // of ks, seconds
                for (const double ratio : {1e-4, 1.0, 1e4}) {
                    for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 1000}) {
                        auto world = JetPhysics().createWorld(undamped(0));
                        addRod(*world);
                        addBox(*world, {kLength, kLength / 2}, kWidth, kLength, kMass * ratio);
                        addHinge(*world, soft ? addPatch(*world, {-6, 0}) : kNoHandle, 0, {0, 0});
                        addHinge(*world, 0, 1, {kLength, 0});
                        world->addSpring({on(0, {0, 0}), on(1, {kLength, kLength}), 50, ks, damping * ks, 0});
                        const double start = ks / 2 * std::pow(std::sqrt(2) * kLength - 50, 2);
                        double most = 0;
                        for (int i = 0; i < 120; ++i) {
                            world->step(step);
                            double energy = 0;
                            for (const BodyHandle body : {0U, 1U})
                                energy += (body == 0 ? 1 : ratio) *
                                          (kMass / 2 * world->bodies().velocity[body].squaredNorm() +
                                           kAcross / 2 * std::pow(world->bodies().omega[body], 2));
                            most = std::max(most, energy);
                        }
                        ASSERT_TRUE(allFinite(*world));
                        EXPECT_LE(most, 1.2 * start)
                            << soft << " " << ks << " " << damping << " " << ratio << " " << step;
                    }
                }
            }
        }
    }
}

}  // namespace

}  // namespace jet::physics::test
