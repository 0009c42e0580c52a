// Composite bodies: springs to an invisible rigid twin, against formulas and against a twin built by hand.
#include "formulas.hpp"
#include "lattices.hpp"
#include "snapshot.hpp"

#include <jet/result.hpp>

#include <cstring>
#include <numeric>

namespace jet::physics::test {

namespace {

constexpr double kRadius = 40;
constexpr std::uint32_t kCount = 24;

/// A ring without any springs of its own: the twin alone holds it.
SoftBodyDef ring(double shapeStiffness, double shapeDamping = 0)
{
    SoftBodyDef def;
    def.particles = circleRing({0, 0}, kRadius, kCount);
    def.masses.assign(kCount, 1.0 / kCount);
    def.borders.emplace_back(kCount);
    std::iota(def.borders[0].begin(), def.borders[0].end(), 0U);
    def.matter.shapeStiffness = shapeStiffness, def.matter.shapeDamping = shapeDamping;
    return def;
}

Vec2 squashed(const Vec2& p) { return {1.6 * p.x() + 0.3 * p.y(), 0.4 * p.y()}; }

/// The ring of a world with everything else as it was, but each particle where `map` has it.
template <class Map>
void deform(PhysicsWorld& world, Map&& map)
{
    auto bytes = world.save();
    for (std::uint32_t i = 0; i < kCount; ++i) {
        double at[2];
        std::byte* const place = bytes.data() + kStateHead + sizeof(std::uint64_t) + i * sizeof at;
        std::memcpy(at, place, sizeof at);
        const Vec2 moved = map(Vec2(at[0], at[1]));
        at[0] = moved.x(), at[1] = moved.y();
        std::memcpy(place, at, sizeof at);
    }
    seal(bytes);
    world.restore(bytes);
}

/// How far the farthest particle is from its place in the shape, turned and moved to where the body is.
double farthest(const PhysicsWorld& world, const SoftBodyDef& def)
{
    const auto now = pointsOf(world, 0);
    Vec2 here(0, 0), there(0, 0);
    double mass = 0, along = 0, across = 0, most = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        mass += def.masses[i];
        here += def.masses[i] * now[i], there += def.masses[i] * def.particles[i];
    }
    for (std::size_t i = 0; i < now.size(); ++i) {
        const Vec2 p = now[i] - here / mass, q = def.particles[i] - there / mass;
        along += def.masses[i] * q.dot(p), across += def.masses[i] * cross(q, p);
    }
    const Affine turn = Affine::rotation(std::atan2(across, along));
    for (std::size_t i = 0; i < now.size(); ++i)
        most = std::max(most, (now[i] - here / mass - turn.linear() * (def.particles[i] - there / mass)).norm());
    return most;
}

double breathing(const PhysicsWorld& world) { return pointsOf(world, 0)[0].norm() - kRadius; }

}  // namespace

TEST(Composite, SwingsAboutItsShapeAtTheRootOfStiffnessOverMassOverSixDecades)
{
    for (double ks = 0.01; ks < 2e4; ks *= 10) {
        const double mass = 1.0 / kCount, period = 2 * kPi * std::sqrt(mass / ks);
        for (const double zeta : {0.0, 0.1}) {
            auto world = makeWorld({0, 0});
            world->addSoftBody(ring(ks, 2 * zeta * std::sqrt(ks * mass)));
            deform(*world, [](const Vec2& p) { return Vec2(1.1 * p); });
            const Swing swing = swingOf(*world, std::min(kStep, period / 40), 3, [&] { return breathing(*world); });
            const double slower = std::sqrt(1 - zeta * zeta), expected = 2 * kPi * zeta / slower;
            EXPECT_NEAR(swing.period, period / slower, (zeta > 0 ? 0.01 : 3e-3) * period) << ks << " " << zeta;
            EXPECT_NEAR(swing.decrement, expected, 0.02 * expected + 2e-3) << ks << " " << zeta;
        }
    }
}

TEST(Composite, SwingsLikeATwinThatIsBuiltOfARigidBodyAndSprings)
{
    // The thesis's own construction: a rigid body that meets nothing, and a spring from each particle to its place.
    const double ks = 3, kd = 0.02;
    auto world = makeWorld({0, 0});
    world->addSoftBody(ring(ks, kd));
    auto built = makeWorld({0, 0});
    built->addSoftBody(ring(0));
    RigidBodyDef twin = rigid({circleRing({0, 0}, kRadius, kCount)}, 1);
    twin.common.mask = 0;
    built->addRigidBody(twin);
    for (const Vec2& place : ring(0).particles) {
        SpringActuatorDef spring;
        spring.a = {0, place}, spring.b = {1, place};
        spring.restLength = 0, spring.ks = ks, spring.kd = kd;
        built->addSpring(spring);
    }
    const auto stretched = [](const Vec2& p) { return Vec2(1.2 * p.x(), 0.9 * p.y()); };
    deform(*world, stretched), deform(*built, stretched);
    for (int i = 0; i < 120; ++i) {
        world->step(kStep), built->step(kStep);
        for (std::uint32_t k = 0; k < kCount; k += 5)
            ASSERT_NEAR((pointsOf(*world, 0)[k] - pointsOf(*built, 0)[k]).norm(), 0, 0.02 * 8) << i << " " << k;
    }
}

TEST(Composite, AlwaysComesBackWhateverWasDoneToIt)
{
    const std::function<Vec2(const Vec2&)> deeds[] = {
        squashed, [](const Vec2& p) { return Vec2(-p.x(), p.y()); },           // inside out
        [](const Vec2& p) { return Vec2(0.01 * p.x(), 0.01 * p.y()); },        // a crumb
        [](const Vec2& p) { return Vec2(5 * std::abs(p.x()), p.x() * 0.2); },  // folded to a line
        [](const Vec2& p) { return Vec2(p.x() + 0.9 * p.y(), 3 * p.y()); }};
    for (std::size_t i = 0; i < std::size(deeds); ++i) {
        auto world = makeWorld({0, 0});
        SoftBodyDef def = ring(5, 0.1);
        def.particles[0] *= 1.5;  // not round, so that sides can be told
        world->addSoftBody(def);
        deform(*world, deeds[i]);
        run(*world, 12);
        EXPECT_LT(farthest(*world, def), 1e-3 * kRadius) << i;
    }
}

TEST(Composite, ComesBackThoughItsOwnSpringsFlowed)
{
    SoftBodyDef def = softBall({0, 0}, kRadius, 30, 0.5);
    def.matter.yield = 0.02, def.matter.creep = 50, def.matter.mostFlow = 0.3;
    const auto left = [&](double stiffness) {
        def.matter.shapeStiffness = stiffness, def.matter.shapeDamping = 0.2;
        auto world = makeWorld({0, 98}, 0.6, 0);
        world->addSoftBody(def);
        world->addRigidBody(ground(kRadius + 1));
        world->addRigidBody(box({0, -kRadius - 20}, 100, 20, 40));
        run(*world, 3);
        world->setEnabled(2, false);
        world->setGravity({0, 0});
        run(*world, 6);
        return farthest(*world, def);
    };
    EXPECT_GT(left(0), 2) << "clay stays pressed";
    EXPECT_LT(left(2000), 0.5);
}

TEST(Composite, IsNeitherPushedNorTurnedByItsTwin)
{
    for (const double ks : {1.0, 1e3, 1e9}) {
        auto world = makeWorld({0, 0});
        SoftBodyDef def = ring(ks, 0.05);
        for (std::uint32_t i = 0; i < kCount; ++i) def.masses[i] *= 1 + i % 5;
        const double mass = std::accumulate(def.masses.begin(), def.masses.end(), 0.0);
        def.common.velocity = {30, -10};
        def.common.omega = 2;
        world->addSoftBody(def);
        deform(*world, squashed);
        world->step(kStep / 100);
        // The angular momentum is what omega and the inertia about the centre of mass, as it lies, make.
        const auto momenta = [&] {
            double inertia = 0;
            for (std::uint32_t i = 0; i < kCount; ++i)
                inertia += def.masses[i] * (pointsOf(*world, 0)[i] - world->bodies().position[0]).squaredNorm();
            return std::pair(Vec2(mass * world->bodies().velocity[0]), inertia * world->bodies().omega[0]);
        };
        const auto before = momenta();
        for (int i = 0; i < 300; ++i) {
            world->step(kStep);
            const auto now = momenta();
            ASSERT_NEAR((now.first - before.first).norm(), 0, 1e-10 * mass * 30) << ks << " " << i;
            ASSERT_NEAR(now.second, before.second, 1e-9 * std::abs(before.second)) << ks << " " << i;
        }
    }
}

TEST(Composite, NoStiffnessNoMassAndNoStepMakesItExplode)
{
    for (const double ks : {1e-3, 1.0, 1e3, 1e6, 1e9}) {
        for (const double own : {0.0, 100.0, 1e9}) {
            for (const double spread : {1.0, 1e4}) {
                for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 1000}) {
                    auto world = makeWorld({0, 98}, 0.6, 0.2);
                    SoftBodyDef def = softBall({0, -60}, kRadius, std::max(own, 1.0), 0);
                    if (own == 0) def.springs.clear();
                    for (std::size_t i = 0; i < def.masses.size(); i += 2) def.masses[i] *= spread;
                    def.matter.shapeStiffness = ks, def.matter.shapeDamping = 0;
                    world->addSoftBody(def);
                    world->addRigidBody(ground(0));
                    const double mass = std::accumulate(def.masses.begin(), def.masses.end(), 0.0);
                    double most = 0;
                    std::vector<Vec2> last(pointsOf(*world, 0).begin(), pointsOf(*world, 0).end());
                    for (int i = 0; i < 4 / step; ++i) {
                        world->step(step);
                        const auto now = pointsOf(*world, 0);
                        double energy = 0;
                        for (std::size_t k = 0; k < last.size(); ++k)
                            energy += 0.5 * def.masses[k] * ((now[k] - last[k]) / step).squaredNorm(), last[k] = now[k];
                        most = std::max(most, energy);
                    }
                    // Its centre is 60 above the ground: however flat it is pressed, it has no more to give.
                    EXPECT_LT(most, mass * 98 * 60) << ks << " " << own << " " << spread << " " << step;
                }
            }
        }
    }
}

TEST(Composite, IsCalmWhateverItsOwnSpringsAndTheirDampersAre)
{
    // Stirred in free space; dampers at their bound and a twin at its own once threw each other.
    for (const double own : {1.0, 1e4, 1e9}) {
        for (const double kd : {1.0, 100.0}) {
            for (const double stiff : {10.0, 1e3, 1e5, 1e7, 1e9}) {
                for (const double spread : {1.0, 1e4}) {
                    auto world = makeWorld({0, 0});
                    SoftBodyDef def = softBall({0, 0}, kRadius, own, kd);
                    for (std::size_t i = 0; i < def.masses.size(); i += 2) def.masses[i] *= spread;
                    def.matter.shapeStiffness = stiff, def.matter.shapeDamping = 0.05 * spread;
                    world->addSoftBody(def);
                    deform(*world,
                           [](const Vec2& p) { return Vec2(p + 3 * Vec2(std::sin(p.y()), std::sin(7 * p.x()))); });
                    run(*world, 10);
                    const double before = farthest(*world, def);
                    EXPECT_LT(before, stiff >= 1e5 ? 0.2 : 5) << own << " " << kd << " " << stiff << " " << spread;
                    world->step(kStep);
                    EXPECT_NEAR(farthest(*world, def), before, 0.01)
                        << own << " " << kd << " " << stiff << " " << spread;
                }
            }
        }
    }
}

TEST(Composite, APinnedParticleStaysAndTheOthersHangInTheirShape)
{
    auto world = makeWorld({0, 98});
    SoftBodyDef def = ring(2000, 1);
    def.movable.assign(kCount, 1);
    def.movable[6] = 0;
    world->addSoftBody(def);
    run(*world, 10);
    EXPECT_EQ(pointsOf(*world, 0)[6], def.particles[6]);
    EXPECT_LT(farthest(*world, def), 0.2 * kRadius);
    EXPECT_LT(world->bodies().velocity[0].norm(), 1);
}

TEST(Composite, ItsStiffnessChangesWhileItRunsAndARewindBringsTheOldOneBack)
{
    const SoftBodyDef def = ring(0);
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    deform(*world, squashed);
    const auto loose = world->save();
    run(*world, 1);
    EXPECT_GT(farthest(*world, def), 20) << "nothing holds it";
    SoftMatter matter = def.matter;
    matter.shapeStiffness = 50, matter.shapeDamping = 0.5;
    world->setSoftMatter(0, matter);
    run(*world, 0.2);
    const auto held = world->save();
    run(*world, 5);
    const auto hash = world->hash();
    EXPECT_LT(farthest(*world, def), 0.01);
    world->restore(held);
    run(*world, 5);
    EXPECT_EQ(world->hash(), hash);
    world->restore(loose);
    run(*world, 1);
    EXPECT_GT(farthest(*world, def), 20) << "as before it was given a twin";
    EXPECT_THROW(world->setSoftMatter(0, {.shapeStiffness = -1}), Failure);
    EXPECT_THROW(world->setSoftMatter(0, {.shapeDamping = std::nan("")}), Failure);
}

TEST(Composite, InstructionSetsGiveTheSameBits)
{
    std::uint64_t hashes[2];
    for (const Simd simd : {Simd::Sse2, Simd::Avx2}) {
        WorldSettings settings;
        settings.simd = simd;
        auto world = JetPhysics().createWorld(settings);
        world->addRigidBody(ground(60));
        for (int i = 0; i < 5; ++i) {
            SoftBodyDef def = softBall({90.0 * i, 0}, kRadius, 20, 0.2);
            def.matter.shapeStiffness = 40;
            world->addSoftBody(def);
        }
        run(*world, 3);
        hashes[simd == Simd::Avx2] = world->hash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Composite, WhatToreHasNoTwinAnyMore)
{
    SoftBodyDef def;
    def.particles = {{0, 0}, {20, 0}};
    def.masses = {1, 1};
    def.springs = {{0, 1, 20, 10, 0, 1.5}};
    def.matter.shapeStiffness = 10;
    def.common.velocity = {0, 0};
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    const auto pull = world->addForce({{0, {20, 0}}, {1000, 0}});
    run(*world, 1);
    EXPECT_FALSE(world->springAlive(0, 0));
    world->setForce(pull, {0, 0});
    const Vec2 speed = (pointsOf(*world, 0)[1] - pointsOf(*world, 0)[0]);
    run(*world, 1);
    EXPECT_GT((pointsOf(*world, 0)[1] - pointsOf(*world, 0)[0]).norm(), speed.norm()) << "they part";
}

}  // namespace jet::physics::test
