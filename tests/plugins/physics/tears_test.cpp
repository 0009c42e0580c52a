// Soft bodies that tear: where, into what, and what the pieces do.
#include "lattices.hpp"

#include <random>
#include <set>

namespace jet::physics::test {

namespace {

constexpr int kColumns = 13, kRows = 4;

std::uint32_t at(int column, int row) { return static_cast<std::uint32_t>(row * kColumns + column); }

/// A strip of cells of 10 units with both diagonals; the springs of the middle column are weak.
SoftBodyDef strip(double tearRatio)
{
    SoftBodyDef def;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) def.particles.emplace_back(10 * column, 10 * row);
    def.masses.assign(def.particles.size(), 0.1);
    const auto join = [&](int columnA, int rowA, int columnB, int rowB) {
        if (columnA >= kColumns || columnB >= kColumns || rowB >= kRows) return;
        const std::uint32_t a = at(columnA, rowA), b = at(columnB, rowB);
        const bool weak = std::min(columnA, columnB) == kColumns / 2 && columnA != columnB;
        def.springs.push_back({a, b, (def.particles[a] - def.particles[b]).norm(), 300, 0.5, weak ? tearRatio : 0});
    };
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
            join(column, row, column + 1, row), join(column, row, column, row + 1),
                join(column, row, column + 1, row + 1), join(column + 1, row, column, row + 1);
    auto& ring = def.borders.emplace_back();
    for (int column = 0; column + 1 < kColumns; ++column) ring.push_back(at(column, 0));
    for (int row = 0; row + 1 < kRows; ++row) ring.push_back(at(kColumns - 1, row));
    for (int column = kColumns - 1; column > 0; --column) ring.push_back(at(column, kRows - 1));
    for (int row = kRows - 1; row > 0; --row) ring.push_back(at(0, row));
    return def;
}

void pullApart(PhysicsWorld& world, const SoftBodyDef& def, double force)
{
    for (int row = 0; row < kRows; ++row) {
        world.addForce({{0, def.particles[at(0, row)]}, {-force, 0}});
        world.addForce({{0, def.particles[at(kColumns - 1, row)]}, {force, 0}});
    }
}

}  // namespace

TEST(Tears, AStripPulledApartFallsIntoTwoPiecesWithBordersOfTheirOwn)
{
    const SoftBodyDef def = strip(1.2);
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    EXPECT_TRUE(world->pieces(0).empty());
    EXPECT_EQ(world->borders(0), std::vector<std::vector<std::uint32_t>>{def.borders[0]});
    pullApart(*world, def, 1500);
    run(*world, 3);
    const auto pieces = world->pieces(0);
    ASSERT_EQ(pieces.size(), def.particles.size());
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
            EXPECT_EQ(pieces[at(column, row)], column <= kColumns / 2 ? 0u : 1u);
    const auto borders = world->borders(0);
    ASSERT_EQ(borders.size(), 2u);
    for (const auto& ring : borders) {
        std::set<std::uint32_t> own;
        for (const std::uint32_t p : ring) own.insert(pieces[p]);
        EXPECT_EQ(own.size(), 1u);
        EXPECT_EQ(std::set<std::uint32_t>(ring.begin(), ring.end()).size(), ring.size());
        // What is left of 12 x 3 cells without the middle column, 6 and 5 cells wide.
        const double area = std::abs(signedArea(def.particles, ring));
        EXPECT_NEAR(area, *own.begin() == 0 ? 1800 : 1500, 1e-9);
    }
}

TEST(Tears, ACutThatDoesNotGoThroughLeavesOnePieceWithALongerBorder)
{
    SoftBodyDef def = strip(0);
    // Only the upper two cells of the middle column may tear.
    for (SpringDef& s : def.springs) {
        const int columnA = static_cast<int>(s.a) % kColumns, columnB = static_cast<int>(s.b) % kColumns;
        const int row = static_cast<int>(std::max(s.a, s.b)) / kColumns;
        if (std::min(columnA, columnB) == kColumns / 2 && columnA != columnB && row <= 1) s.tearRatio = 1.2;
    }
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    pullApart(*world, def, 1500);
    run(*world, 3);
    const auto pieces = world->pieces(0);
    ASSERT_FALSE(pieces.empty());
    EXPECT_EQ(*std::max_element(pieces.begin(), pieces.end()), 0u);
    const auto borders = world->borders(0);
    ASSERT_EQ(borders.size(), 1u);
    EXPECT_GT(borders[0].size(), def.borders[0].size());
    EXPECT_LT(std::abs(signedArea(def.particles, borders[0])), 3600);
}

TEST(Tears, ASpringTearsAtExactlyItsRatio)
{
    // Wide bodies compute in single, but decide in double: a billionth below the length it holds, a billionth above.
    for (const double part : {1 - 1e-9, 1 + 1e-9}) {
        SoftBodyDef def = strip(0);
        def.common.fixed = true;
        def.springs[0].tearRatio = 1.5;
        def.springs[0].restLength =
            (def.particles[def.springs[0].a] - def.particles[def.springs[0].b]).norm() / (1.5 * part);
        auto world = makeWorld({0, 0});
        world->addSoftBody(def);
        world->step(kStep);
        EXPECT_EQ(world->springAlive(0, 0), part < 1);
        EXPECT_TRUE(world->springAlive(0, 1));
    }
}

TEST(Tears, PiecesHoldEachOtherUp)
{
    SoftBodyDef def = strip(1.2);
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    std::vector<ActuatorHandle> forces;
    for (int row = 0; row < kRows; ++row) {
        forces.push_back(world->addForce({{0, def.particles[at(0, row)]}, {-1500, 0}}));
        forces.push_back(world->addForce({{0, def.particles[at(kColumns - 1, row)]}, {1500, 0}}));
    }
    const auto whole = [&] {
        const auto pieces = world->pieces(0);
        return pieces.empty() || *std::max_element(pieces.begin(), pieces.end()) == 0;
    };
    for (int i = 0; i < 300 && whole(); ++i) world->step(kStep);
    ASSERT_FALSE(whole());
    // Now they are pushed together.
    for (std::size_t i = 0; i < forces.size(); ++i) world->setForce(forces[i], {i % 2 == 0 ? 200 : -200, 0});
    bool touched = false;
    for (int i = 0; i < 240; ++i) {
        world->step(kStep);
        touched |= !world->contacts().empty();
    }
    EXPECT_TRUE(touched);
    ASSERT_TRUE(allFinite(*world));
    const auto points = pointsOf(*world, 0);
    Vec2 left(0, 0), right(0, 0);
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
            (column <= kColumns / 2 ? left : right) +=
                points[at(column, row)] / (kRows * (column <= kColumns / 2 ? 7 : 6));
    EXPECT_GT((right - left).norm(), 25);  // through each other they would be at one place
}

TEST(Tears, SnapshotsFromBeforeAndAfterATearHaveTheSameFuture)
{
    const SoftBodyDef def = strip(1.2);
    auto world = makeWorld({0, 30});
    world->addSoftBody(def);
    world->addRigidBody(ground(120));
    pullApart(*world, def, 1500);
    world->step(kStep);
    ASSERT_TRUE(world->pieces(0).empty());
    const auto before = world->save();
    run(*world, 1.5);
    ASSERT_FALSE(world->pieces(0).empty());
    const auto after = world->save();
    run(*world, 2);
    const auto expected = world->hash();
    const auto borders = world->borders(0);
    world->restore(after);
    run(*world, 2);
    EXPECT_EQ(world->hash(), expected);
    world->restore(before);
    EXPECT_TRUE(world->pieces(0).empty());
    EXPECT_EQ(world->borders(0)[0], def.borders[0]);
    run(*world, 1.5);
    run(*world, 2);
    EXPECT_EQ(world->hash(), expected);
    EXPECT_EQ(world->borders(0), borders);
}

TEST(Tears, WhatTearsAfterRestoringIsInTheStateOfTheWorldThatWasNotRestored)
{
    // The ball was met by the ground when it was flat, which its walls' ends were of; in a world just built they are
    // those of a round one.
    const auto built = [] {
        auto world = makeWorld({0, 0});
        world->addSoftBody(strip(0));
        world->addRigidBody(ground(200));
        SoftBodyDef ball = softBall({60, 188}, 10, 20, 0.1);
        ball.common.velocity = {0, 300};
        world->addSoftBody(ball);
        return world;
    };
    const auto world = built(), other = built();
    for (int i = 0; i < 4; ++i) world->step(kStep);
    ASSERT_TRUE(world->touching(1, 2));
    world->setPosition(2, {5000, 0});
    world->step(kStep);
    other->restore(world->save());
    for (PhysicsWorld* one : {world.get(), other.get()}) {
        one->setSprings(0, 300, 0.5, 0.9);
        one->step(kStep);
        EXPECT_FALSE(one->pieces(0).empty());
    }
    EXPECT_EQ(other->hash(), world->hash());
}

TEST(Tears, WhatFellToDustHasNoBorderToMeetItselfBy)
{
    // Walls, their grid and the normals of points that are no more must not be met, nor depend on when it tore.
    SoftBodyDef def;  // a U whose legs face each other
    def.particles = {{0, 0}, {20, 0}, {20, 40}, {22, 40}, {22, 0}, {42, 0}, {42, 60}, {0, 60}};
    def.masses.assign(8, 1);
    def.borders = {{0, 1, 2, 3, 4, 5, 6, 7}};
    for (std::uint32_t i = 0; i < 8; ++i)
        for (std::uint32_t k = i + 1; k < 8; ++k)
            def.springs.push_back({i, k, (def.particles[i] - def.particles[k]).norm(), 100, 1, 0});
    def.matter.selfCollision = true, def.matter.thickness = 1.5;  // so they touch
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    world->addRigidBody(box({21, 300}, 20, 20));
    // What comes fast is looked ahead for, and makes the body look at itself by its grid.
    const auto hit = [&] {
        world->setPosition(1, {21, 120}), world->setVelocity(1, {0, -3000});
        world->step(kStep);
    };
    const auto meetsItself = [&] {
        const auto contacts = world->contacts();
        return std::any_of(contacts.begin(), contacts.end(), [](const Contact& c) { return c.bodyA == c.bodyB; });
    };
    hit();
    EXPECT_TRUE(meetsItself());
    world->setSprings(0, 100, 1, 0.5);
    hit();
    ASSERT_TRUE(world->borders(0).empty());
    hit();
    EXPECT_FALSE(meetsItself());
}

TEST(Tears, PiecesHaveTheirFleshOnTheSideTheWholeHadIt)
{
    std::mt19937 random(3);
    const auto number = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    int pieces = 0;
    for (int trial = 0; trial < 300; ++trial) {
        SoftBodyDef def = strip(0);
        for (SpringDef& spring : def.springs) spring.tearRatio = 1.05;
        auto world = makeWorld({0, 0});
        world->addSoftBody(def);
        for (int k = 0; k < 6; ++k)
            world->addForce(
                {{0, def.particles[random() % def.particles.size()]}, {number(-900, 900), number(-900, 900)}});
        run(*world, 0.2);
        for (const auto& ring : world->borders(0)) {
            ++pieces;
            EXPECT_GT(signedArea(def.particles, ring), 0) << "drawn with the flesh on the other hand; " << trial;
        }
    }
    EXPECT_GT(pieces, 600);
}

TEST(Tears, GasEscapesFromABodyThatIsCutOpen)
{
    SoftBodyDef def = strip(0);
    def.matter.pressure = 20;
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    run(*world, 5);
    const auto area = [&] {
        double sum = 0;
        for (const auto& ring : world->borders(0)) sum += std::abs(signedArea(pointsOf(*world, 0), ring));
        return sum;
    };
    EXPECT_GT(area(), 3650);
    world->setSprings(0, 300, 0.5, 1.001);
    run(*world, 5);
    EXPECT_LT(area(), 3601);
}

TEST(Tears, GasStaysWhereOnlyAnInnerSpringTears)
{
    const auto pressureAfter = [](bool tears) {
        SoftBodyDef def = strip(0);
        // Two holes, of which no wall tears.
        for (const int column : {2, 8})
            def.borders.push_back({at(column, 1), at(column + 1, 1), at(column + 1, 2), at(column, 2)});
        for (SpringDef& spring : def.springs)
            if (spring.a == at(5, 1) && spring.b == at(6, 2)) spring.tearRatio = tears ? 0.9 : 0;
        def.matter.pressure = 20;
        auto world = makeWorld({0, 0});
        world->addSoftBody(def);
        run(*world, 1);
        int alive = 0;
        for (std::uint32_t i = 0; i < def.springs.size(); ++i) alive += world->springAlive(0, i);
        EXPECT_EQ(alive, static_cast<int>(def.springs.size()) - tears);
        return areaRatio(*world, 0, def);
    };
    EXPECT_NEAR(pressureAfter(true), pressureAfter(false), 0.01);
}

}  // namespace jet::physics::test
