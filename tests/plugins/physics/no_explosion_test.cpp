// No setting explodes: stiffness from 1e-3 to 1e9, masses 1 : 10,000, steps from 1/30 to 1/1000 s. Nothing becomes NaN,
// and energy does not grow.
#include "formulas.hpp"

#include <sstream>

namespace jet::physics::test {

namespace {

constexpr double kSteps[] = {1.0 / 30, 1.0 / 60, 1.0 / 240, 1.0 / 1000};

/// Above it, springs of heavy and light particles are too stiff for the substeps and are softened: the energy of those
/// asked for tells too much then.
constexpr double kSoftened = 2e6;

std::string describe(double ks, double kd, double ratio, double step)
{
    std::ostringstream text;
    text << "ks " << ks << ", kd " << kd << ", masses 1 : " << ratio << ", step " << step << ", ";
    return text.str();
}

/// A net whose particles' masses alternate between 1 and `ratio`, drawn apart sideways.
SoftBodyDef netOf(int side, double ks, double kd, double ratio)
{
    SoftBodyDef def;
    for (int i = 0; i < side * side; ++i) {
        def.particles.emplace_back(10.0 * (i % side), 10.0 * (i / side));
        def.masses.push_back((i + i / side) % 2 == 0 ? 1 : ratio);
    }
    const auto join = [&](int a, int b) {
        const auto from = static_cast<std::uint32_t>(a), to = static_cast<std::uint32_t>(b);
        def.springs.push_back({from, to, (def.particles[from] - def.particles[to]).norm(), ks, kd, 0});
    };
    for (int i = 0; i < side * side; ++i) {
        const bool right = i % side + 1 < side, below = i / side + 1 < side;
        if (right) join(i, i + 1);
        if (below) join(i, i + side);
        if (right && below) join(i, i + side + 1), join(i + 1, i + side);
    }
    return def;
}

double springEnergy(const PhysicsWorld& world, const SoftBodyDef& def)
{
    const auto now = pointsOf(world, 0);
    double sum = 0;
    for (const SpringDef& s : def.springs) sum += 0.5 * s.ks * std::pow((now[s.a] - now[s.b]).norm() - s.restLength, 2);
    return sum;
}

/// Of the mean velocities over a step: never more than the particles really have.
double motionEnergy(const PhysicsWorld& world, const SoftBodyDef& def, const std::vector<Vec2>& before, double step)
{
    const auto now = pointsOf(world, 0);
    double sum = 0;
    for (std::size_t i = 0; i < now.size(); ++i)
        sum += 0.5 * def.masses[i] * ((now[i] - before[i]) / step).squaredNorm();
    return sum;
}

TEST(NoExplosion, AStretchedNetNeverHoldsMoreEnergyThanWasPutIn)
{
    for (const int side : {2, 6}) {
        for (const double ratio : {1.0, 1e4}) {
            for (double ks = 1e-3; ks < 2e9; ks *= 10) {
                for (const double kd : {0.0, 1.0}) {
                    for (const double step : kSteps) {
                        const SoftBodyDef rest = netOf(side, ks, kd, ratio);
                        SoftBodyDef def = rest;
                        for (Vec2& p : def.particles) p.x() *= 1.1, p.y() += 0.3 * std::sin(p.x());
                        auto world = makeWorld({0, 0});
                        world->addSoftBody(def);
                        const double start = springEnergy(*world, def);
                        for (int i = 0; i < 240; ++i) {
                            const auto points = pointsOf(*world, 0);
                            const std::vector<Vec2> before(points.begin(), points.end());
                            world->step(step);
                            const std::string what = describe(ks, kd, ratio, step) + std::to_string(i);
                            ASSERT_TRUE(allFinite(*world)) << what;
                            ASSERT_LE(motionEnergy(*world, def, before, step), 1.2 * start) << what;
                            ASSERT_LT(world->bodies().bounds[0].size().norm(), 3 * 15.0 * side) << what;
                            if (ks < kSoftened) {
                                ASSERT_LE(springEnergy(*world, def), 1.6 * start) << what;
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Every particle joined to every other: what bounds a node by the sum of its springs says twice what such nets can do.
TEST(NoExplosion, ADenseNetNeverHoldsMoreEnergyThanWasPutIn)
{
    for (double ks = 1; ks < 1e6; ks *= 3) {
        for (const double kd : {0.0, 0.1, 3.0}) {
            SoftBodyDef def;
            for (int i = 0; i < 24; ++i) {
                def.particles.push_back(20 * Vec2(std::cos(0.2618 * i), std::sin(0.2618 * i)));
                def.masses.push_back(1 + i % 3);
            }
            for (std::uint32_t a = 0; a < 24; ++a)
                for (std::uint32_t b = a + 1; b < 24; ++b)
                    def.springs.push_back({a, b, (def.particles[a] - def.particles[b]).norm(), ks, kd, 0});
            for (Vec2& p : def.particles) p.x() *= 1.2, p.y() += 0.5 * std::sin(p.x());
            auto world = makeWorld({0, 0});
            world->addSoftBody(def);
            const double start = springEnergy(*world, def);
            for (int i = 0; i < 600; ++i) {
                world->step(kStep);
                ASSERT_TRUE(allFinite(*world)) << ks << " " << kd;
                ASSERT_LE(springEnergy(*world, def), 1.1 * start) << ks << " " << kd << " step " << i;
            }
        }
    }
}

/// Where the ends of a spring pass each other, its force turns round within a substep: what that adds must not pile up.
TEST(NoExplosion, UndampedBodiesThatAreCrushedDoNotGainEnergyInTheLongRun)
{
    for (double ks = 10; ks < 1e8; ks *= 10) {
        for (const double stretch : {0.2, 0.5, 1.5, 2.0}) {
            SoftBodyDef def = softBall({0, 0}, 10, ks, 0, 12, 2);
            for (Vec2& p : def.particles) p = Vec2(stretch * p.x(), p.y() + 0.1 * std::sin(p.x()));
            auto world = makeWorld({0, 0});
            world->addSoftBody(def);
            const double start = springEnergy(*world, def);
            for (int i = 0; i < 1500; ++i) {
                world->step(kStep);
                ASSERT_LE(springEnergy(*world, def), 1.1 * start) << ks << " " << stretch << " step " << i;
            }
        }
    }
}

/// Of so many particles that substeps are chosen by how fast they swing at rest.
TEST(NoExplosion, UndampedBodiesOfManyParticlesThatAreCrushedDoNotGainEnergyEither)
{
    for (const double ks : {7e4, 2e5}) {
        for (const double stretch : {0.2, 0.5, 1.5, 2.0}) {
            SoftBodyDef def = netOf(18, ks, 0, 1);
            for (Vec2& p : def.particles) p = Vec2(stretch * p.x(), p.y() + std::sin(p.x()));
            auto world = makeWorld({0, 0});
            world->addSoftBody(def);
            const double start = springEnergy(*world, def);
            for (int i = 0; i < 400; ++i) {
                world->step(kStep);
                ASSERT_LE(springEnergy(*world, def), start) << ks << " " << stretch << " step " << i;
            }
        }
    }
}

TEST(NoExplosion, UndampedNetsDoNotGainEnergyInTheLongRun)
{
    for (const double ks : {1e4, 1e6, 1e7, 1e8, 1e9}) {
        for (const double ratio : {1.0, 1e4}) {
            for (const double step : kSteps) {
                SoftBodyDef def = netOf(6, ks, 0, ratio);
                for (Vec2& p : def.particles) p.x() *= 1.1, p.y() += 0.3 * std::sin(p.x());
                auto world = makeWorld({0, 0});
                world->addSoftBody(def);
                double most[4] = {};
                for (int i = 0; i < 4000; ++i) {
                    const auto points = pointsOf(*world, 0);
                    const std::vector<Vec2> before(points.begin(), points.end());
                    world->step(step);
                    const double held = ks < kSoftened ? springEnergy(*world, def) : 0;
                    most[i / 1000] = std::max({most[i / 1000], held, motionEnergy(*world, def, before, step)});
                }
                EXPECT_LE(most[3], 1.1 * std::max(most[0], most[1])) << ks << " " << ratio << " " << step;
            }
        }
    }
}

TEST(NoExplosion, AngularSpringsOfEveryStiffnessStayCalm)
{
    for (double ks = 1e-3; ks < 2e9; ks *= 10) {
        for (const double ratio : {1e-4, 1.0, 1e4}) {
            for (const double step : kSteps) {
                SoftBodyDef def;
                for (int i = 0; i < 8; ++i) {
                    def.particles.emplace_back(10.0 * i, i % 2 ? 2.0 : 0.0);
                    def.masses.push_back(i % 2 ? 1 : ratio);
                    const auto at = static_cast<std::uint32_t>(i);
                    if (i > 0) def.springs.push_back({at - 1, at, 10.2, std::max(500.0, ks / 10), 1, 0});
                    if (i > 1) def.angularSprings.push_back({at - 2, at - 1, at, kPi, ks, 0});
                }
                auto world = makeWorld({0, 0});
                world->addSoftBody(def);
                for (int i = 0; i < 240; ++i) world->step(step);
                ASSERT_TRUE(allFinite(*world)) << ks << " " << ratio << " " << step;
                EXPECT_LT(world->bodies().bounds[0].size().norm(), 120) << ks << " " << ratio << " " << step;
                EXPECT_NEAR(world->bodies().velocity[0].norm(), 0, 1e-6) << ks << " " << ratio << " " << step;
            }
        }
    }
}

TEST(NoExplosion, SpringsBetweenBodiesOfTenThousandfoldMassGiveBackNoMoreThanTheyHeld)
{
    for (double ks = 1e-3; ks < 2e9; ks *= 10) {
        for (const double ratio : {1e-4, 1.0, 1e4}) {
            for (const double step : kSteps) {
                auto world = makeWorld({0, 0});
                world->addRigidBody(box({0, 0}, 10, 10, 1));
                world->addRigidBody(box({100, 0}, 10, 10, ratio));
                SpringActuatorDef spring;
                spring.a = {0, {3, 5}}, spring.b = {1, {97, -5}};
                spring.restLength = 80, spring.ks = ks, spring.kd = 0;
                world->addSpring(spring);
                const double length = std::hypot(94, 10), start = 0.5 * ks * (length - 80) * (length - 80);
                double most = 0;
                for (int i = 0; i < 240; ++i) {
                    world->step(step);
                    double energy = 0;
                    for (BodyHandle b = 0; b < 2; ++b) {
                        const double mass = b == 0 ? 1 : ratio;
                        energy += 0.5 * mass * world->bodies().velocity[b].squaredNorm() +
                                  0.5 * mass * 200 / 12 * std::pow(world->bodies().omega[b], 2);
                    }
                    most = std::max(most, energy);
                }
                ASSERT_TRUE(allFinite(*world));
                EXPECT_LE(most, 2.5 * start) << ks << " " << ratio << " " << step;
            }
        }
    }
}

TEST(NoExplosion, AHeavyBodyOnALightOneComesToRest)
{
    for (const double ratio : {100.0, 1e4}) {
        for (const double step : kSteps) {
            auto world = makeWorld({0, 98.1});
            world->addRigidBody(simple(ground(0)));
            const BodyHandle light = world->addRigidBody(simple(box({0, -10}, 20, 20, 1)));
            const BodyHandle heavy = world->addRigidBody(simple(box({0, -30}, 20, 20, ratio)));
            for (int i = 0; i < static_cast<int>(std::lround(4 / step)); ++i) world->step(step);
            ASSERT_TRUE(allFinite(*world)) << ratio << " " << step;
            EXPECT_LT(world->bodies().velocity[light].norm(), 5) << ratio << " " << step;
            if (ratio < 1000) {
                EXPECT_LT(world->bodies().position[heavy].y(), -25) << "it did not sink through: " << step;
            }
        }
    }
}

TEST(NoExplosion, AHeavyBallSwingsOnALightChain)
{
    for (const double ratio : {100.0, 1e3, 1e4}) {
        for (const double step : kSteps) {
            auto world = makeWorld({0, 98.1});
            BodyHandle before = kNoHandle;
            for (int i = 0; i < 10; ++i) {
                RigidBodyDef link;
                link.shapes = {{ShapeDef::Kind::Circle, {{200, -300.0 + 10 * i}}, i == 9 ? 8.0 : 3.0}};
                link.mass = i == 9 ? ratio : 1;
                const BodyHandle body = world->addRigidBody(link);
                JointDef joint;
                joint.a = {before, {200, -305.0 + 10 * i}}, joint.b = {body, {200, -305.0 + 10 * i}};
                world->addJoint(joint);
                before = body;
            }
            world->setVelocity(before, {20, 0});
            const double heavyTop = 0.5 * 20 * 20 / 98.1;  // it can rise no higher than its speed tells
            const Vec2 hook(200, -305);
            double fastest = 0, longest = 0;
            for (int i = 0; i < static_cast<int>(std::lround(4 / step)); ++i) {
                world->step(step);
                fastest = std::max(fastest, world->bodies().velocity[before].norm());
                longest = std::max(longest, (world->bodies().position[before] - hook).norm());
                ASSERT_GT(world->bodies().position[before].y(), -210 - 2 * heavyTop - 100) << ratio << " " << step;
            }
            ASSERT_TRUE(allFinite(*world)) << ratio << " " << step;
            EXPECT_LT(fastest, 400) << ratio << " " << step;
            if (ratio < 5000) {
                EXPECT_LT(longest, 1.2 * 95) << "the chain holds: " << ratio << " " << step;
            }
        }
    }
}

/// Plastic bodies of light and heavy particles, which joints hang up by a patch that gives way.
TEST(NoExplosion, PlasticBodiesOfTenThousandfoldMassesGainNoEnergyFromJointsTheyHangOn)
{
    struct Case {
        JointDef::Kind kind;
        double ks, hertz, radius;
        Vec2 at;
    };
    using Kind = JointDef::Kind;
    const Case cases[] = {
        // What they came to, in falls by the body's width, without an account of their energy:
        {Kind::Prismatic, 300, 0, 12, {6, -8}},    // 2e7
        {Kind::Prismatic, 1e4, 0, 12, {-11, 3}},   // 9e7
        {Kind::Prismatic, 1e6, 10, 12, {-11, 3}},  // 6e7
        {Kind::Prismatic, 1e6, 0, 20, {-11, 3}},   // 1e8
        {Kind::Prismatic, 1e9, 0, 12, {-11, 3}},   // 197
    };
    for (const Case& c : cases) {
        SoftBodyDef def = softBall({0, 0}, 20, c.ks, 1, 12, 2);
        for (std::size_t i = 0; i < def.masses.size(); ++i) def.masses[i] *= i % 2 == 0 ? 1e4 : 1;
        def.matter.yield = 0.01, def.matter.creep = 30, def.matter.mostFlow = 0.9;
        auto world = makeWorld({0, 98.1});
        world->addSoftBody(def);
        JointDef joint;
        joint.kind = c.kind, joint.hertz = c.hertz, joint.axis = {1, 0.2};
        joint.a.point = joint.b.point = c.at;
        joint.b.body = 0, joint.b.radius = c.radius;
        world->addJoint(joint);
        double weight = 0, start = 0, most = 0;
        for (std::size_t i = 0; i < def.masses.size(); ++i)
            weight += 98.1 * def.masses[i], start -= 98.1 * def.masses[i] * def.particles[i].y();
        for (int i = 0; i < 600; ++i) {
            const auto points = pointsOf(*world, 0);
            const std::vector<Vec2> before(points.begin(), points.end());
            world->step(1.0 / 60);
            double energy = motionEnergy(*world, def, before, 1.0 / 60) - start;
            for (std::size_t k = 0; k < def.masses.size(); ++k)
                energy -= 98.1 * def.masses[k] * 0.5 * (before[k].y() + pointsOf(*world, 0)[k].y());
            most = std::max(most, energy);
        }
        EXPECT_LT(most, weight * 40) << "joint " << static_cast<int>(c.kind) << ", ks " << c.ks << ", " << c.hertz
                                     << " Hz, radius " << c.radius;
    }
}

TEST(NoExplosion, JointsThatNoSubstepCanFollowKeepToTheGreatestSpeed)
{
    // Hinges of a body of 0.016 units swing at 80 rad/s: nearly half a turn a substep of 1/30 s, and two do not agree.
    for (const bool amongSoft : {false, true}) {
        WorldSettings settings;
        settings.gravity = {0, 98.1};
        settings.substeps = 1;
        auto world = JetPhysics().createWorld(settings);
        std::vector<BodyHandle> bodies;
        for (int i = 0; i < 2; ++i) bodies.push_back(world->addRigidBody(simple(box({0.01 * i, 0}, 0.016, 0.01))));
        if (amongSoft) world->addSoftBody(softBall({1000, 0}, 40));
        for (int i = 0; i < 3; ++i) {
            JointDef hinge;
            hinge.a = {i == 0 ? kNoHandle : bodies[0], {0.004 * i, 0.002}},
            hinge.b = {bodies[i == 0 ? 0 : 1], {0.004 * i, 0.002}};
            world->addJoint(hinge);
        }
        for (int i = 1; i <= 300; ++i) {
            world->step(1.0 / 30);
            ASSERT_TRUE(allFinite(*world)) << "step " << i;
            for (const BodyHandle body : bodies) ASSERT_LE(world->bodies().position[body].norm(), 1.01e6 * i / 30);
        }
    }
}

TEST(NoExplosion, ABallOnSpringsOfEveryStiffnessRestsOnTheGround)
{
    for (double ks = 1e-3; ks < 2e9; ks *= 1000) {
        for (const double step : kSteps) {
            auto world = makeWorld({0, 98});
            world->addSoftBody(softBall({0, -60}, 40, ks, 0.1, 16, 2));
            world->addRigidBody(ground(0));
            double highest = 0;
            for (int i = 0; i < static_cast<int>(std::lround(3 / step)); ++i) {
                world->step(step);
                highest = std::min(highest, world->bodies().position[0].y());
            }
            ASSERT_TRUE(allFinite(*world)) << ks << " " << step;
            EXPECT_GT(highest, -62) << "it never rises above where it fell from: " << ks << " " << step;
            EXPECT_LT(world->bodies().bounds[0].max.y(), 2) << ks << " " << step;
        }
    }
}

}  // namespace

}  // namespace jet::physics::test
