// Soft bodies that nothing else acts on are moved for a whole step at once: soft/flight.hpp.
#include "lattices.hpp"

#include <algorithm>
#include <random>

namespace jet::physics::test {

namespace {

constexpr double kCell = 10;  // units

/// Light and stiff; the first row may be pinned.
SoftBodyDef light(std::uint32_t columns, std::uint32_t rows, bool pinned, double tearRatio = 0)
{
    SpringDef spring;
    spring.ks = 400, spring.kd = 0.5, spring.tearRatio = tearRatio;
    SoftBodyDef def = sheet(columns, rows, kCell, spring);
    def.masses.assign(def.particles.size(), 0.1);
    def.movable.assign(def.particles.size(), 1);
    for (std::uint32_t x = 0; pinned && x < columns; ++x) def.movable[x] = 0;
    return def;
}

/// Draws it out of shape, so that it swings.
SoftBodyDef bent(SoftBodyDef def)
{
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> by(-0.2 * kCell, 0.2 * kCell);
    for (std::size_t i = 0; i < def.particles.size(); ++i)
        if (def.movable[i] != 0) def.particles[i] += Vec2(by(engine), by(engine));
    return def;
}

/// Around a sheet of as many rows as columns.
void border(SoftBodyDef& def, std::uint32_t side)
{
    auto& ring = def.borders.emplace_back();
    for (std::uint32_t i = 0; i + 1 < side; ++i) ring.push_back(i);
    for (std::uint32_t i = 0; i + 1 < side; ++i) ring.push_back(side - 1 + side * i);
    for (std::uint32_t i = 0; i + 1 < side; ++i) ring.push_back(side * side - 1 - i);
    for (std::uint32_t i = 0; i + 1 < side; ++i) ring.push_back(side * (side - 1 - i));
}

/// A field that nothing is in: what it might push goes substep by substep.
void forbidFlights(PhysicsWorld& world)
{
    ForceFieldDef field;
    field.region = {boxRing({1e6, 1e6}, 10, 10)};
    field.vector = Vec2(1, 0);
    world.addForceField(field);
}

std::vector<Vec2> placesOf(const PhysicsWorld& world, BodyHandle body)
{
    const auto points = pointsOf(world, body);
    return {points.begin(), points.end()};
}

double farthestApart(const std::vector<Vec2>& p, const std::vector<Vec2>& q)
{
    double most = 0;
    for (std::size_t i = 0; i < p.size(); ++i) most = std::max(most, (p[i] - q[i]).norm());
    return most;
}

Vec2 centreOf(const PhysicsWorld& world, BodyHandle body)
{
    Vec2 sum(0, 0);
    const auto points = pointsOf(world, body);
    for (const Vec2& p : points) sum += p;
    return sum / static_cast<double>(points.size());
}

}  // namespace

TEST(Flight, GoesWhereSubstepsGo)
{
    struct Case {
        std::uint32_t columns, rows;
        bool pinned;
        double damping;
    };
    for (const Case& is : {Case{24, 20, true, 0}, Case{24, 20, true, 0.8}, Case{24, 20, false, 0},
                           Case{23, 9, false, 0.8}, Case{100, 90, true, 0}, Case{8, 40, true, 0.3}}) {
        std::vector<Vec2> places[2];
        std::uint64_t hashes[2];
        for (const bool flies : {true, false}) {
            WorldSettings settings;
            settings.gravity = Vec2(0, 100);
            settings.linearDamping = is.damping;
            const auto world = JetPhysics().createWorld(settings);
            SoftBodyDef def = bent(light(is.columns, is.rows, is.pinned));
            if (!is.pinned) def.common.omega = 1, def.common.velocity = Vec2(40, -30);
            const BodyHandle body = world->addSoftBody(def);
            if (!flies) forbidFlights(*world);
            run(*world, 1);
            ASSERT_GT(world->stats().substeps, 1U);
            places[flies ? 0 : 1] = placesOf(*world, body);
            hashes[flies ? 0 : 1] = world->hash();
        }
        const double apart = farthestApart(places[0], places[1]);
        EXPECT_LT(apart, 2e-3) << is.columns << " x " << is.rows;  // it falls by 50 units, or swings by as much
        EXPECT_NE(hashes[0], hashes[1]) << "they are two ways to go";
    }
}

TEST(Flight, TheCentreOfMassFallsAsItMust)
{
    WorldSettings settings;
    settings.gravity = Vec2(3, 100);
    const auto world = JetPhysics().createWorld(settings);
    SoftBodyDef def = bent(light(16, 16, false));
    def.common.velocity = Vec2(50, 40), def.common.omega = 2;
    const BodyHandle body = world->addSoftBody(def);
    Vec2 at = centreOf(*world, body);
    world->step(kStep);
    Vec2 velocity = world->bodies().velocity[body];
    at = centreOf(*world, body);
    for (int i = 0; i < 120; ++i) {
        world->step(kStep);
        // n substeps of h: v += n h g, x += n h v + h² g n (n + 1) / 2
        const double n = world->stats().substeps, h = kStep / n;
        at += kStep * velocity + h * h * n * (n + 1) / 2 * settings.gravity;
        velocity += kStep * settings.gravity;
        const Vec2 now = centreOf(*world, body);
        ASSERT_LT((now - at).norm(), 1e-10 * (1 + at.norm())) << i;
        ASSERT_LT((world->bodies().velocity[body] - velocity).norm(), 1e-11 * (1 + velocity.norm())) << i;
    }
}

TEST(Flight, ThreadsAndStatesThatAreRestoredGiveTheSameBits)
{
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 4}) {
        WorldSettings settings;
        settings.gravity = Vec2(0, 100);
        settings.threads = threads;
        const auto world = JetPhysics().createWorld(settings), other = JetPhysics().createWorld(settings);
        for (PhysicsWorld* in : {world.get(), other.get()}) in->addSoftBody(bent(light(100, 130, true)));  // in parts
        run(*world, 0.2);
        other->restore(world->save());
        run(*world, 0.2), run(*other, 0.2);
        EXPECT_EQ(world->hash(), other->hash()) << threads;
        hashes.push_back(world->hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

/// Rows that fill eights and sixteens and rows that do not, alone and in parts, and springs that are crushed.
TEST(Flight, EveryInstructionSetGivesTheSameBits)
{
    std::vector<SoftBodyDef> defs = {light(16, 12, true), light(23, 17, false), light(40, 25, true),
                                     light(100, 130, true), light(9, 50, true, 1.6)};
    for (SoftBodyDef& def : defs) def = bent(def);
    defs.push_back(bent(light(33, 20, true)));
    for (Vec2& p : defs.back().particles)
        if (p.y() > 5.5 * kCell) p.y() = 5.5 * kCell + 0.15 * (p.y() - 5.5 * kCell);
    for (const SoftBodyDef& def : defs) {
        std::vector<std::uint64_t> hashes;
        for (const Simd simd : {Simd::Sse2, Simd::Avx2, Simd::Avx512, Simd::Automatic}) {
            WorldSettings settings;
            settings.gravity = Vec2(0, 100);
            settings.simd = simd;
            const auto world = JetPhysics().createWorld(settings);
            world->addSoftBody(def);
            run(*world, 0.3);
            hashes.push_back(world->hash());
        }
        EXPECT_EQ(hashes, std::vector<std::uint64_t>(4, hashes[0])) << def.particles.size();
    }
}

TEST(Flight, SpringsTearAsTheyDoInSubsteps)
{
    std::vector<bool> whole[2];
    for (const bool flies : {true, false}) {
        WorldSettings settings;
        settings.gravity = Vec2(0, 100);
        const auto world = JetPhysics().createWorld(settings);
        const SoftBodyDef def = bent(light(16, 12, true, 1.35));
        const BodyHandle body = world->addSoftBody(def);
        if (!flies) forbidFlights(*world);
        run(*world, 0.5);
        for (std::uint32_t i = 0; i < def.springs.size(); ++i)
            whole[flies ? 0 : 1].push_back(world->springAlive(body, i));
    }
    EXPECT_GT(std::count(whole[0].begin(), whole[0].end(), false), 0);
    EXPECT_GT(std::count(whole[0].begin(), whole[0].end(), true), 200);
    EXPECT_EQ(whole[0], whole[1]);
}

TEST(Flight, EndsWhereSomethingIsMet)
{
    WorldSettings settings;
    settings.gravity = Vec2(0, 100);
    const auto world = JetPhysics().createWorld(settings);
    SoftBodyDef def = light(16, 16, false);
    border(def, 16);
    const BodyHandle body = world->addSoftBody(def);
    const double top = 400;
    const BodyHandle floor = world->addRigidBody(ground(top));
    bool met = false;
    for (int i = 0; i < 600; ++i) {
        world->step(kStep);
        met |= world->touching(body, floor);
        double lowest = 0;
        for (const Vec2& p : pointsOf(*world, body)) lowest = std::max(lowest, p.y());
        ASSERT_LT(lowest, top + 0.5) << i;
    }
    EXPECT_TRUE(met);
}

/// The last row swings down and up again once in a step: at both of its ends it is far from the floor that it meets
/// between them.
TEST(Flight, EndsWhereSomethingIsMetWithinAStep)
{
    constexpr std::uint32_t kSide = 12;
    constexpr double kRaised = 0.25 * kCell, kBottom = (kSide - 1) * kCell, kMass = 0.1;
    for (const double periods : {0.95, 1.0, 1.1}) {  // in a step
        const double omega = 2 * 3.14159265358979 * periods / kStep;
        std::vector<Vec2> places[2];
        for (const bool flies : {true, false}) {
            const auto world = makeWorld({0, 0});
            SoftBodyDef def = light(kSide, kSide, false);
            for (SpringDef& spring : def.springs) spring.ks = 0.5 * kMass * omega * omega, spring.kd = 0;
            for (std::size_t i = 0; i < def.particles.size(); ++i) {
                if (i < kSide * (kSide - 1))
                    def.movable[i] = 0;
                else
                    def.particles[i].y() -= kRaised;
            }
            border(def, kSide);
            const BodyHandle body = world->addSoftBody(def);
            const BodyHandle floor = world->addRigidBody(ground(kBottom + 0.4 * kRaised));
            if (!flies) forbidFlights(*world);
            world->step(kStep);
            EXPECT_TRUE(world->touching(body, floor)) << periods << (flies ? " in flight" : " in substeps");
            places[flies ? 0 : 1] = placesOf(*world, body);
        }
        EXPECT_EQ(farthestApart(places[0], places[1]), 0) << periods;
    }
}

}  // namespace jet::physics::test
