// How large worlds are divided among threads, and that nothing of what happens to a world depends on it.
#include "rigid/domains.hpp"
#include "shape_worlds.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <set>

namespace jet::physics::test {

namespace {

using Links = std::vector<std::pair<Index, Index>>;

/// Bodies 1 … columns · rows at whole coordinates, each linked to its right and lower neighbour.
struct Grid {
    Grid(Index columns, Index rows)
    {
        for (Index i = 0; i < columns * rows; ++i) {
            bodies.push_back({i + 1, static_cast<double>(i % columns), static_cast<double>(i / columns)});
            if (i % columns + 1 < columns) links.emplace_back(i + 1, i + 2);
            if (i / columns + 1 < rows) links.emplace_back(i + 1, i + 1 + columns);
        }
    }
    std::vector<Domains::Body> bodies;
    Links links;
};

Domains divided(int depth, const Grid& grid, std::size_t others = 0)
{
    Domains domains;
    domains.resize(1 + grid.bodies.size() + others);
    domains.divide(depth, grid.bodies, grid.links);
    return domains;
}

std::size_t across(const Domains& domains, const Links& links)
{
    return static_cast<std::size_t>(std::count_if(links.begin(), links.end(), [&](const auto& link) {
        return domains.nodeOf(link.first) != domains.nodeOf(link.second);
    }));
}

TEST(Domains, NodesMeetAtTheLowestOneAboveBoth)
{
    EXPECT_EQ(Domains::meet(5, 5), 5);
    EXPECT_EQ(Domains::meet(4, 5), 2);
    EXPECT_EQ(Domains::meet(4, 6), 1);
    EXPECT_EQ(Domains::meet(7, 3), 3);
    EXPECT_EQ(Domains::meet(1, 6), 1);
}

TEST(Domains, EveryBodyThatMovesIsInOneOfThemAndAllOthersAreTheRoots)
{
    const Grid grid(20, 10);
    const Domains domains = divided(2, grid, 5);
    std::vector<std::size_t> sizes(8);
    std::set<Index> slots;
    for (Index body = 1; body < 206; ++body) {
        ++sizes[domains.nodeOf(body)];
        slots.insert(domains.slotOf(body));
        EXPECT_EQ(domains.bodyAt(domains.slotOf(body)), body);
        const Domains::Slots range = domains.slotsOf(domains.nodeOf(body));
        EXPECT_TRUE(range.first <= domains.slotOf(body) && domains.slotOf(body) < range.last);
    }
    EXPECT_EQ(slots.size(), 205U);
    EXPECT_EQ(sizes[Domains::kRoot], 5U);
    for (std::size_t leaf = 4; leaf < 8; ++leaf) EXPECT_NEAR(static_cast<double>(sizes[leaf]), 50, 6);
}

TEST(Domains, DoNotShareLinesOfMemory)
{
    const Domains domains = divided(2, Grid(20, 10), 5);
    std::vector<Domains::Slots> ranges;
    for (Domains::Node node = 1; node < 8; ++node)
        if (domains.slotsOf(node).last > 0) ranges.push_back(domains.slotsOf(node));
    ASSERT_EQ(ranges.size(), 5U);
    for (const Domains::Slots& one : ranges)
        for (const Domains::Slots& other : ranges) EXPECT_TRUE(one.last > other.first || other.first - one.last >= 4);
}

TEST(Domains, AreCutWhereFewLinksGoAcross)
{
    // A long strip of three rows: nine links are the least that cut it in four.
    const Grid strip(100, 3);
    EXPECT_EQ(across(divided(2, strip), strip.links), 9U);
    // Two squares beside each other, each linked within: nothing goes across between them.
    Grid squares(20, 10);
    std::erase_if(squares.links,
                  [](const auto& link) { return (link.first - 1) % 20 == 9 && (link.second - 1) % 20 == 10; });
    EXPECT_EQ(across(divided(1, squares), squares.links), 0U);
}

TEST(Domains, KeepSmallGroupsWhole)
{
    // 99 stacks of 7, which lean so that any straight cut through the middle would part one.
    Grid stacks(99, 7);
    std::erase_if(stacks.links, [](const auto& link) { return link.second == link.first + 1; });
    for (Domains::Body& body : stacks.bodies) body.x += 0.3 * body.y;
    EXPECT_EQ(across(divided(2, stacks), stacks.links), 0U);
}

TEST(Domains, NewBodiesAreTheRootsUntilTheNextDivision)
{
    Grid grid(20, 10);
    Domains domains = divided(1, grid);
    const Index before = domains.slotOf(200);
    domains.resize(203);
    EXPECT_EQ(domains.newcomers(), 2U);
    EXPECT_EQ(domains.nodeOf(202), Domains::kRoot);
    EXPECT_EQ(domains.slotOf(200), before);
    EXPECT_EQ(domains.bodyAt(domains.slotOf(202)), 202U);
    grid.bodies.push_back({201, 3, 3}), grid.bodies.push_back({202, 17, 3});
    domains.divide(1, grid.bodies, grid.links);
    EXPECT_EQ(domains.newcomers(), 0U);
    EXPECT_NE(domains.nodeOf(201), domains.nodeOf(202));
}

TEST(Domains, ANodeIsVisitedAfterThoseBelowIt)
{
    const Domains domains = divided(2, Grid(20, 10));
    std::vector<int> order;
    domains.below(Domains::kRoot, [&](Domains::Node node) { order.push_back(node); });
    EXPECT_EQ(order, (std::vector<int>{4, 5, 2, 6, 7, 3, 1}));
}

TEST(Domains, HalvesOfTheOrderAcrossAreHalvesOfTheTree)
{
    const Domains domains = divided(2, Grid(20, 10));
    std::vector<int> order;
    domains.across(Domains::kRoot, [&](Domains::Node node) { order.push_back(node); });
    EXPECT_EQ(order, (std::vector<int>{4, 2, 5, 1, 6, 3, 7}));
}

void expectOneVisitEach(const Domains& domains, int bodies)
{
    for (const int threads : {1, 2, 3, 8}) {
        Pool pool;
        pool.setThreads(threads);
        std::vector<std::atomic<int>> visits(domains.slotCount());
        domains.eachBody(pool, [&](Index body, Index slot) { visits[slot] += domains.bodyAt(slot) == body; });
        int all = 0;
        for (const auto& count : visits) {
            all += count;
            EXPECT_LE(count, 1);
        }
        EXPECT_EQ(all, bodies) << threads << " threads";
    }
}

TEST(Domains, EveryBodyIsVisitedOnceWhateverTheThreads)
{
    expectOneVisitEach(divided(2, Grid(60, 30), 3000), 4800);
    expectOneVisitEach(divided(0, Grid(60, 30), 3000), 4800);
    Grid mixed(60, 30);
    for (Index i = 0; i < mixed.bodies.size(); ++i) {
        const Index at = i * 7 % 1800;
        mixed.bodies[i].x = at % 60, mixed.bodies[i].y = at / 60;
    }
    mixed.links.clear();
    expectOneVisitEach(divided(2, mixed, 3000), 4800);
}

// Worlds large enough to be divided. What happens in them, step by step, to worlds of several counts of threads.

using Happening = std::function<void(PhysicsWorld&, int step)>;

void expectTheSame(const std::function<std::unique_ptr<PhysicsWorld>(int threads)>& build, int steps,
                   const Happening& happens)
{
    std::vector<std::unique_ptr<PhysicsWorld>> worlds;
    for (const int threads : {1, 2, 3, 4}) worlds.push_back(build(threads));
    for (int step = 0; step < steps; ++step) {
        if (step == steps / 2) {
            // In the midst of it, one goes on in a world just built.
            const std::vector<std::byte> saved = worlds[1]->save();
            worlds[3]->restore(saved);
        }
        for (const auto& world : worlds) happens(*world, step), world->step(kStep);
        for (const auto& world : worlds) ASSERT_EQ(world->hash(), worlds[0]->hash()) << "step " << step;
    }
}

TEST(DividedWorlds, BodiesThatComeAndJointsAcrossDoNotDependOnThreads)
{
    expectTheSame([](int threads) { return pyramidWorld(shapeSettings(threads), 45); }, 60,
                  [](PhysicsWorld& world, int step) {
                      const auto count = static_cast<BodyHandle>(world.bodies().position.size());
                      if (step % 3 == 0) world.addRigidBody(simple(box({-150.0 + 7 * step, -480}, 8, 8)));
                      if (step == 20) {
                          // From the left foot to the right one.
                          JointDef joint;
                          joint.kind = JointDef::Kind::Rope;
                          joint.a = {1, world.bodies().position[1]}, joint.b = {45, world.bodies().position[45]};
                          world.addJoint(joint);
                      }
                      if (step == 40) world.applyForce(count - 1, {9000, 0});
                  });
}

TEST(DividedWorlds, BodiesThatBecomePlatformsOrAreSwitchedOffDoNotDependOnThreads)
{
    expectTheSame([](int threads) { return pyramidWorld(shapeSettings(threads), 45); }, 50,
                  [](PhysicsWorld& world, int step) {
                      BodyCommon common;
                      if (step == 10 || step == 30) {
                          common.kinematic = step == 10;
                          for (const BodyHandle body : {60U, 400U, 700U}) world.setBody(body, common);
                      }
                      if (step == 15 || step == 35)
                          for (const BodyHandle body : {61U, 500U, 701U}) world.setEnabled(body, step == 35);
                  });
}

TEST(DividedWorlds, WhatMixesIsDividedAnewAndDoesNotDependOnThreads)
{
    expectTheSame([](int threads) { return drumWorld(shapeSettings(threads), 36); }, 150, [](PhysicsWorld&, int) {});
}

TEST(DividedWorlds, WhatPartsIsOneWorldAgainAndDoesNotDependOnThreads)
{
    // Bodies scatter and hit each other until hardly any touch; what was noted of touches must not outlive the
    // division.
    expectTheSame([](int threads) { return pyramidWorld(shapeSettings(threads), 45); }, 60,
                  [](PhysicsWorld& world, int step) {
                      if (step != 15) return;
                      world.setGravity({0, 0});
                      for (BodyHandle body = 1; body < world.bodyCount(); ++body)
                          world.setVelocity(body, world.bodies().position[body] +
                                                      Vec2(100 * std::sin(7.0 * body), 100 * std::cos(11.0 * body)));
                  });
}

TEST(DividedWorlds, SleepAndWakingDoNotDependOnThreads)
{
    const auto build = [](int threads) {
        WorldSettings settings = shapeSettings(threads);
        settings.allowSleep = true;
        auto world = JetPhysics().createWorld(settings);
        world->addRigidBody(simple(ground(0, 8000)));
        for (int stack = 0; stack < 130; ++stack)
            for (int i = 0; i < 12; ++i) world->addRigidBody(simple(box({25.0 * stack, -5.0 - 10 * i}, 10, 10)));
        return world;
    };
    expectTheSame(build, 240, [](PhysicsWorld& world, int step) {
        if (step == 200) {
            EXPECT_EQ(world.stats().awakeBodies, 0U);
            world.applyForce(30, {4000, 0});
        }
    });
}

}  // namespace

}  // namespace jet::physics::test
