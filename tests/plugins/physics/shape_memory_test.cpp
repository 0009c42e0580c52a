// Soft bodies come back to their shape, whatever crushed them, and by nothing but inner forces.
#include "lattices.hpp"
#include "snapshot.hpp"
#include "soft/cloud_kernels.hpp"
#include "soft/layout.hpp"

#include <array>
#include <cstring>
#include <functional>
#include <numeric>

namespace jet::physics::test {

namespace {

constexpr double kGravity = 98;
constexpr double kFarthest = 0.2;  // from the goal, as a part of the radius of gyration; the pull begins at 0.18

double massOf(const SoftBodyDef& def) { return std::accumulate(def.masses.begin(), def.masses.end(), 0.0); }

std::vector<Vec2> arms(std::span<const Vec2> points, const SoftBodyDef& def)
{
    Vec2 centre(0, 0);
    for (std::size_t i = 0; i < points.size(); ++i) centre += def.masses[i] / massOf(def) * points[i];
    std::vector<Vec2> all(points.begin(), points.end());
    for (Vec2& p : all) p -= centre;
    return all;
}

/// How far the farthest particle is from its goal, as a part of the radius of gyration.
double farthest(std::span<const Vec2> points, const SoftBodyDef& def)
{
    const auto rest = arms(def.particles, def), now = arms(points, def);
    double along = 0, across = 0, inertia = 0, most = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        along += def.masses[i] * rest[i].dot(now[i]);
        across += def.masses[i] * cross(rest[i], now[i]);
        inertia += def.masses[i] * rest[i].squaredNorm();
    }
    const Affine turn = Affine::rotation(std::atan2(across, along));
    for (std::size_t i = 0; i < rest.size(); ++i) most = std::max(most, (turn.linear() * rest[i] - now[i]).norm());
    return most / std::sqrt(inertia / massOf(def));
}

/// The soft body of a world that was added first. The dynamic part of a snapshot begins with the positions and
/// velocities of all nodes, in the order their springs like best.
struct Particles {
    std::vector<Vec2> position, velocity;

    Particles(const PhysicsWorld& world, const SoftBodyDef& def)
        : position(def.particles.size()), velocity(def.particles.size()), order_(soft::orderOf(def))
    {
        exchange(world.save(),
                 [](Vec2& ours, const std::byte* theirs) { std::memcpy(ours.data(), theirs, sizeof(Vec2)); });
    }
    void putInto(PhysicsWorld& world)
    {
        auto bytes = world.save();
        exchange(bytes, [](const Vec2& ours, std::byte* theirs) { std::memcpy(theirs, ours.data(), sizeof(Vec2)); });
        seal(bytes);
        world.restore(bytes);
    }

private:
    template <class Bytes, class Copy>
    void exchange(Bytes&& bytes, Copy&& copy)
    {
        std::uint64_t nodes = 0;
        auto* const first = bytes.data() + kStateHead;
        std::memcpy(&nodes, first, sizeof nodes);
        for (std::size_t k = 0; k < order_.size(); ++k) {
            copy(position[order_[k]], first + sizeof nodes + k * sizeof(Vec2));
            copy(velocity[order_[k]], first + 2 * sizeof nodes + (nodes + k) * sizeof(Vec2));
        }
    }

    std::vector<std::uint32_t> order_;
};

/// Changes where the particles are, as a function of where they are.
template <class Map>
void deform(PhysicsWorld& world, const SoftBodyDef& def, Map&& map)
{
    Particles particles(world, def);
    for (Vec2& p : particles.position) p = map(p);
    particles.putInto(world);
}

/// Of motion, springs and height; what the memory of the shape stores would come on top.
double energy(const PhysicsWorld& world, const SoftBodyDef& def, double gravity)
{
    const Particles now(world, def);
    double sum = 0;
    for (std::size_t i = 0; i < def.particles.size(); ++i)
        sum += def.masses[i] * (0.5 * now.velocity[i].squaredNorm() - gravity * now.position[i].y());
    for (const SpringDef& spring : def.springs)
        sum +=
            0.5 * spring.ks * std::pow((now.position[spring.a] - now.position[spring.b]).norm() - spring.restLength, 2);
    return sum;
}

struct Drop {
    const char* name;
    SoftBodyDef def;
    std::vector<RigidBodyDef> scenery;
};

std::vector<Drop> drops()
{
    std::vector<Drop> all;
    for (const double radius : {20.0, 30.0, 60.0})
        for (const double height : {100.0, 300.0, 600.0})
            all.push_back({"ball", defaultBall({0, -height}, radius), {ground(0)}});
    for (const double size : {40.0, 60.0}) {
        all.push_back({"square", square({0, -300}, size), {ground(0)}});
        all.push_back({"banana", banana({0, -300}, size), {ground(0)}});
        all.push_back({"banana from high up", banana({0, -600}, size), {ground(0)}});
    }
    const RigidBodyDef blunt = fixed({{{0, -100}, {60, 0}, {-60, 0}}}), sharp = fixed({{{0, -100}, {15, 0}, {-15, 0}}});
    const RigidBodyDef slot = fixed({{{-100, -150}, {0, 0}, {100, -150}, {100, 50}, {-100, 50}}});
    for (const double radius : {20.0, 30.0, 60.0}) {
        all.push_back({"ball on an apex", defaultBall({0, -400}, radius), {blunt, ground(0, 20000)}});
        all.push_back({"ball on a spike", defaultBall({3, -400}, radius), {sharp, ground(0, 20000)}});
        all.push_back({"ball into a slot", defaultBall({0, -400}, radius), {slot}});
    }
    return all;
}

TEST(ShapeMemory, DroppedBodiesEndInTheirShape)
{
    for (const Drop& drop : drops()) {
        auto world = makeWorld({0, kGravity});
        world->addSoftBody(drop.def);
        for (const RigidBodyDef& body : drop.scenery) world->addRigidBody(body);
        run(*world, 15);
        EXPECT_GT(areaRatio(*world, 0, drop.def), 0.85) << drop.name;
        EXPECT_LT(farthest(pointsOf(*world, 0), drop.def), kFarthest) << drop.name;
    }
}

TEST(ShapeMemory, ABallPressedFlatPopsOutInHalfASecond)
{
    for (const double radius : {20.0, 30.0, 60.0}) {
        const SoftBodyDef def = defaultBall({0, -radius}, radius);
        auto world = makeWorld({0, kGravity});
        world->addSoftBody(def);
        world->addRigidBody(ground(0));
        // All below the upper third is pushed up, through the middle.
        const double fold = -1.3 * radius;
        deform(*world, def, [&](const Vec2& p) { return Vec2(p.x(), std::min(p.y(), fold - 0.3 * (p.y() - fold))); });
        ASSERT_LT(areaRatio(*world, 0, def), 0.25);
        run(*world, 0.5);
        EXPECT_GT(areaRatio(*world, 0, def), 0.85) << "radius " << radius;
        run(*world, 10);
        EXPECT_GT(areaRatio(*world, 0, def), 0.95) << "radius " << radius;
    }
}

TEST(ShapeMemory, BodiesUnfoldEvenWhereNoRotationFitsBest)
{
    const auto mirrored = [](const Vec2& p) { return Vec2(p.x(), -p.y()); };
    const auto flat = [](const Vec2& p) { return Vec2(p.x(), 0); };
    const auto point = [](const Vec2&) { return Vec2(0, 0); };
    for (const SoftBodyDef& def : {defaultBall({0, 0}, 30), square({0, 0}, 50), banana({0, 0}, 40)}) {
        for (const std::function<Vec2(const Vec2&)>& map :
             {std::function<Vec2(const Vec2&)>(mirrored), {flat}, {point}}) {
            auto world = makeWorld({0, 0});
            world->addSoftBody(def);
            deform(*world, def, map);
            run(*world, 5);
            EXPECT_GT(areaRatio(*world, 0, def), 0.95);
            EXPECT_LT(farthest(pointsOf(*world, 0), def), kFarthest);
        }
    }
}

/// Alone, a step is looked at as a whole; in company, each substep: what is left out there had nothing to be pulled at.
TEST(ShapeMemory, ABodyUnfoldsInCompanyAsItDoesAlone)
{
    for (const SoftBodyDef& def : {defaultBall({0, 0}, 30), square({0, 0}, 50), banana({0, 0}, 40)}) {
        std::vector<Vec2> ends[2];
        for (const bool inCompany : {false, true}) {
            auto world = makeWorld({0, 0});
            world->addSoftBody(def);
            if (inCompany) world->addRigidBody(ground(100000));
            deform(*world, def, [](const Vec2& p) { return Vec2(1.2 * p.x(), 0.4 * p.y()); });
            world->setOmega(0, 6);
            run(*world, 3);
            const auto points = pointsOf(*world, 0);
            ends[inCompany ? 1 : 0].assign(points.begin(), points.end());
        }
        for (std::size_t i = 0; i < def.particles.size(); ++i)
            EXPECT_LT((ends[0][i] - ends[1][i]).norm(), 1e-9) << "particle " << i;
    }
}

TEST(ShapeMemory, AnUndeformedBodyIsNotTouched)
{
    const SoftBodyDef def = defaultBall({5, -70}, 30);
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    run(*world, 20);
    for (std::size_t i = 0; i < def.particles.size(); ++i) EXPECT_EQ(pointsOf(*world, 0)[i], def.particles[i]);
}

TEST(ShapeMemory, MomentumAndAngularMomentumAreKept)
{
    for (const double fold : {1.0, 0.3, -0.2, -1.0}) {
        auto world = makeWorld({0, 0});
        SoftBodyDef def = defaultBall({0, 0}, 30);
        def.common.velocity = {12, -7};
        def.common.omega = 3;
        for (std::size_t i = 0; i < def.masses.size(); ++i) def.masses[i] *= 1 + 0.1 * static_cast<double>(i % 5);
        world->addSoftBody(def);
        deform(*world, def, [&](const Vec2& p) { return Vec2(p.x() * 1.2, p.y() > 5 ? fold * p.y() : p.y()); });
        const auto momenta = [&] {
            const Particles now(*world, def);
            const auto arm = arms(now.position, def);
            Vec2 linear(0, 0);
            double angular = 0;
            for (std::size_t i = 0; i < arm.size(); ++i) {
                linear += def.masses[i] * now.velocity[i];
                angular += def.masses[i] * cross(arm[i], now.velocity[i]);
            }
            return std::pair(linear, angular);
        };
        const auto [linear, angular] = momenta();
        for (int i = 0; i < 120; ++i) {
            world->step(kStep);
            const auto [nowLinear, nowAngular] = momenta();
            ASSERT_LT((nowLinear - linear).norm(), 1e-9 * linear.norm()) << "fold " << fold << " step " << i;
            // The direction of a spring's force is single; that both ends get the same force is not.
            ASSERT_NEAR(nowAngular, angular, 1e-6 * std::abs(angular)) << "fold " << fold << " step " << i;
        }
    }
}

TEST(ShapeMemory, EnergyNeverGrowsInTwentySecondsOfBouncing)
{
    for (const double kd : {0.0, 0.3}) {
        for (const double radius : {20.0, 30.0, 60.0}) {
            SoftBodyDef def = defaultBall({0, -600}, radius);
            for (SpringDef& spring : def.springs) spring.kd = kd;
            auto world = makeWorld({0, kGravity}, 0.6, 0);
            world->addSoftBody(def);
            world->addRigidBody(ground(0));
            // Symplectic Euler's energy sways by a part of what swings in the springs; a second's highest shows the
            // trend.
            double before = energy(*world, def, kGravity);
            for (int second = 0; second < 20; ++second) {
                double most = 0;
                for (int i = 0; i < 60; ++i) {
                    world->step(kStep);
                    most = std::max(most, energy(*world, def, kGravity));
                }
                EXPECT_LE(most, 1.002 * before) << "radius " << radius << " kd " << kd << " second " << second;
                before = most;
            }
        }
    }
}

/// What unfolds has its motion from what folding stored. Where energy is kept account of, as between ropes, that is no
/// gain, and nothing is taken.
TEST(ShapeMemory, ABodyOnASlackRopeUnfoldsAsItDoesWithoutOne)
{
    SoftBodyDef def = defaultBall({0, 0}, 30);
    for (SpringDef& spring : def.springs) spring.kd = 0;
    double fastest[2] = {0, 0};
    for (const bool roped : {false, true}) {
        auto world = makeWorld({0, 0});
        world->addSoftBody(def);
        if (roped) {
            JointDef rope;
            rope.kind = JointDef::Kind::Rope;
            rope.a.point = {0, -500}, rope.b = {0, {0, 0}, 0};
            rope.length = 1000;
            world->addJoint(rope);
        }
        deform(*world, def, [&](const Vec2& p) { return Vec2(p.x(), -p.y()); });
        world->step(kStep);
        for (int i = 1; i < 120; ++i) {
            const auto before = pointsOf(*world, 0);
            const std::vector<Vec2> places(before.begin(), before.end());
            world->step(kStep);
            const auto now = pointsOf(*world, 0);
            for (std::size_t k = 0; k < now.size(); ++k)
                fastest[roped ? 1 : 0] = std::max(fastest[roped ? 1 : 0], (now[k] - places[k]).norm() / kStep);
        }
        EXPECT_GT(areaRatio(*world, 0, def), 0.5) << roped;
    }
    EXPECT_NEAR(fastest[1], fastest[0], 0.01 * fastest[0]);
}

TEST(ShapeMemory, WhatUnfoldingSetsFreeIsWhatFoldingStored)
{
    // Without damping in the springs, a mirrored ball swings for long; it must not swing ever wider.
    SoftBodyDef def = defaultBall({0, 0}, 30);
    for (SpringDef& spring : def.springs) spring.kd = 0;
    for (const double turn : {0.0, 1.0, 2.5}) {
        auto world = makeWorld({0, 0});
        def.common.omega = turn;
        world->addSoftBody(def);
        deform(*world, def, [&](const Vec2& p) { return Vec2(p.x(), -p.y()); });
        double first = 0, last = 0;
        for (int i = 0; i < 20 * 60; ++i) {
            world->step(kStep);
            const double now = energy(*world, def, 0);
            if (i < 60) first = std::max(first, now);
            if (i >= 60) last = std::max(last, now);
        }
        EXPECT_LE(last, first);
    }
}

TEST(ShapeMemory, StiffAndHeavySpringsStayStable)
{
    for (const double ks : {0.1, 1e3, 1e6, 1e9}) {
        const SoftBodyDef def = defaultBall({0, 0}, 30, ks);
        auto world = makeWorld({0, 0});
        world->addSoftBody(def);
        deform(*world, def, [](const Vec2& p) { return Vec2(p.x(), -p.y()); });
        run(*world, 20);
        EXPECT_GT(areaRatio(*world, 0, def), 0.85) << "ks " << ks;
        EXPECT_TRUE(allFinite(*world));
    }
}

/// Runs a folded body for a second; does its area come back?
bool unfolds(const SoftBodyDef& def)
{
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    deform(*world, def, [](const Vec2& p) { return Vec2(p.x(), -p.y()); });
    run(*world, 1);
    return areaRatio(*world, 0, def) > 0;
}

TEST(ShapeMemory, BodiesWithoutAShapeOfTheirOwnAreLeftAlone)
{
    const SoftBodyDef ball = defaultBall({0, 0}, 30);
    EXPECT_TRUE(unfolds(ball));

    SoftBodyDef torn = ball;
    torn.springs[3].restLength *= 0.9;
    torn.springs[3].tearRatio = 1.05;
    EXPECT_FALSE(unfolds(torn)) << "a torn spring";
    SoftBodyDef loose = ball;
    loose.springs.clear();
    EXPECT_FALSE(unfolds(loose)) << "no springs";
    SoftBodyDef hoop = ball;
    std::erase_if(hoop.springs,
                  [](const SpringDef& spring) { return spring.a >= 24 || spring.b != (spring.a + 1) % 24; });
    EXPECT_FALSE(unfolds(hoop)) << "a ring of links has no shape";
    SoftBodyDef nailed = ball;
    nailed.movable.assign(nailed.particles.size(), 1);
    nailed.movable.back() = 0;
    EXPECT_FALSE(unfolds(nailed)) << "an immovable particle";
    SoftBodyDef swollen = ball;
    for (SpringDef& spring : swollen.springs) spring.restLength *= 1.3;
    EXPECT_FALSE(unfolds(swollen)) << "not built at rest";
}

TEST(ShapeMemory, PiecesOfOneBodyKeepTheirShapesNotTheirPlaces)
{
    SoftBodyDef def = defaultBall({0, 0}, 30);
    const SoftBodyDef other = defaultBall({200, 0}, 20);
    const auto shift = static_cast<std::uint32_t>(def.particles.size());
    def.particles.insert(def.particles.end(), other.particles.begin(), other.particles.end());
    def.masses.insert(def.masses.end(), other.masses.begin(), other.masses.end());
    for (SpringDef spring : other.springs) {
        spring.a += shift, spring.b += shift;
        def.springs.push_back(spring);
    }
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    const auto apart = [](const Vec2& p) { return p.x() > 100 ? Vec2(p.x() + 300, p.y() - 80) : p; };
    deform(*world, def, apart);
    run(*world, 2);
    for (std::size_t i = 0; i < def.particles.size(); ++i)
        EXPECT_NEAR((pointsOf(*world, 0)[i] - apart(def.particles[i])).norm(), 0, 1e-4);  // lengths: single
}

/// Long steps: the ball falls, is stopped and is pressed flat within one of them, wherever in it the ground comes.
TEST(ShapeMemory, ABallThatIsHitWithinALongStepBouncesNoHigherThanItFell)
{
    constexpr double kLongStep = 1.0 / 30;
    for (double height = 272; height < 275; height += 0.3) {
        SoftBodyDef def = defaultBall({0, -height}, 13.4, 6900);
        for (SpringDef& spring : def.springs) spring.kd = 100;
        for (double& mass : def.masses) mass *= 8;
        auto world = makeWorld({0, kGravity});
        const BodyHandle ball = world->addSoftBody(def);
        world->addRigidBody(simple(ground(0)));
        double highest = 1e9;
        for (int i = 0; i < 200; ++i) {
            world->step(kLongStep);
            if (world->bodies().velocity[ball].y() < 0) highest = std::min(highest, world->bodies().position[ball].y());
        }
        EXPECT_GT(highest, -height) << "fell from " << height;
    }
}

TEST(ShapeMemory, AFoldedBodyIsRestoredBitForBit)
{
    const SoftBodyDef def = defaultBall({0, -60}, 30);
    const auto make = [&] {
        auto world = makeWorld({0, kGravity});
        world->addSoftBody(def);
        world->addRigidBody(ground(0));
        return world;
    };
    auto world = make();
    // Turned, then folded to where no rotation fits: the one it had is part of the state.
    world->setOmega(0, 4);
    run(*world, 0.3);
    const std::uint64_t before = world->hash();
    deform(*world, def, [](const Vec2& p) { return Vec2(p.x(), -120 - p.y()); });
    EXPECT_NE(world->hash(), before);
    const auto saved = world->save();
    auto equal = make();
    equal->restore(saved);
    EXPECT_EQ(equal->hash(), world->hash());
    for (int i = 0; i < 200; ++i) {
        world->step(kStep);
        equal->step(kStep);
        ASSERT_EQ(equal->hash(), world->hash()) << "step " << i;
    }
}

/// What four particles that are drawn to their places hold, and their motion, are one sum: ½ omega² m e·e' keeps it to
/// rounding where all of the way counts, at any phase of the swing.
TEST(ShapeMemory, WhatItHoldsAndTheMotionHaveOneSum)
{
    constexpr double kMass = 3, kRate = 400;  // kg, 1 / s²
    for (const double h : {0.001, 0.025}) {
        for (const double tolerance : {0.0, 0.5}) {
            const std::array<double, 8> rest{10, 0, 0, 10, -10, 0, 0, -10};
            std::array<double, 8> position = rest, velocity{}, change{};
            for (double& x : position) x *= 1.2;
            const std::array<double, 4> mass{kMass, kMass, kMass, kMass};
            const soft::Cloud cloud{position.data(), velocity.data(), mass.data(), rest.data(), 4};
            const soft::CloudMotion still;
            const auto energy = [&] {
                double twice = kRate * soft::drawn(cloud, still, tolerance, h);
                for (const double v : velocity) twice += kMass * v * v;
                return twice / 2;
            };
            const double start = energy();
            EXPECT_NEAR(start, 0.5 * 4 * kMass * kRate * std::pow(2 - tolerance, 2), 1e-9 * start);
            for (int i = 0; i < 1000; ++i) {
                soft::sse2::clouds.pull(cloud, still, {tolerance, h * kRate, 0}, change.data());
                soft::sse2::clouds.give(cloud, still, {}, change.data(), velocity.data());
                for (std::size_t k = 0; k < position.size(); ++k) position[k] += h * velocity[k];
                ASSERT_NEAR(energy(), start, (tolerance > 0 ? 0.7 * h * h * kRate : 1e-9) * start) << h << ", " << i;
            }
        }
    }
}

}  // namespace

}  // namespace jet::physics::test
