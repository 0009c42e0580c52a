// Soft bodies that tear: where, into what, what the pieces do, and what a hand holds of them.
#include "lattices.hpp"

#include <jet/physics_removal.hpp>

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

JointDef pullAt(const Vec2& point, double radius)
{
    JointDef def;
    def.kind = JointDef::Kind::Mouse;
    def.a.point = point, def.b = {0, point, radius};
    def.hertz = 5, def.dampingRatio = 0.9, def.maxForce = 1e5;
    return def;
}

/// Its left end is fixed to the background.
std::unique_ptr<PhysicsWorld> hungStrip()
{
    auto world = makeWorld({0, 0});
    world->addSoftBody(strip(1.2));
    JointDef wall;
    wall.kind = JointDef::Kind::Weld;
    wall.a.point = {0, 15}, wall.b = {0, {0, 15}, 20};
    world->addJoint(wall);
    return world;
}

/// Where the particles of some columns are, on average.
Vec2 middle(const PhysicsWorld& world, int from, int to)
{
    const auto points = pointsOf(world, 0);
    Vec2 sum(0, 0);
    for (int row = 0; row < kRows; ++row)
        for (int column = from; column <= to; ++column) sum += points[at(column, row)];
    return sum / (kRows * (to - from + 1));
}

std::size_t piecesOf(const PhysicsWorld& world)
{
    const auto pieces = world.pieces(0);
    return pieces.empty() ? 1 : *std::max_element(pieces.begin(), pieces.end()) + 1;
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

// The middle column of cells lies between x = 60 and 70: a hand at x = 70 holds the right piece, and some of the left.
constexpr int kTaken = 5, kGivenUp = 130;
const Vec2 kGrip(70, 15);

TEST(Tears, AHandKeepsThePieceThatItsPointLiesIn)
{
    auto world = hungStrip();
    const JointHandle hand = world->addJoint(pullAt(kGrip, 30));
    for (int i = 0; i < 240; ++i) {
        world->setJointTarget(hand, kGrip + Vec2(std::min(2.0 * i, 300.0), 0));
        world->step(kStep);
        ASSERT_TRUE(allFinite(*world)) << i;
    }
    ASSERT_EQ(piecesOf(*world), 2u);
    // Of the columns of the right piece it holds 7 to 10, whose middle was 15 from the hand.
    EXPECT_NEAR(world->joint(hand).pointB.x(), 370, 0.5);
    EXPECT_NEAR(middle(*world, 7, 10).x(), 385, 1);
    EXPECT_NEAR(middle(*world, 0, 6).x(), 30, 1) << "nobody holds the left one, but the wall";
    const Vec2 left = middle(*world, 0, 6);
    for (int i = 0; i < 120; ++i) world->setJointTarget(hand, {370, 15 + 3.0 * i}), world->step(kStep);
    EXPECT_LT((middle(*world, 0, 6) - left).norm(), 3) << "it swings, wherever the right one is drawn";
    world->removeJoint(hand);
    run(*world, 1);
    EXPECT_GT(middle(*world, 7, 12).y(), 372 + 80) << "it flies on";
}

TEST(Tears, AnyStateOfADragThatTearsABodyGoesOnBitEqual)
{
    std::vector<std::vector<std::byte>> states;
    std::vector<std::size_t> pieces;
    JointHandle hand = kNoHandle;
    const auto act = [&](PhysicsWorld& world, int step) {
        if (step == kTaken) hand = world.addJoint(pullAt(kGrip, 30));
        if (step > kTaken && step < kGivenUp) world.setJointTarget(hand, kGrip + Vec2(1.5 * step, 0.3 * step));
        if (step == kGivenUp) world.removeJoint(hand);
        world.step(kStep);
    };
    auto world = hungStrip();
    for (int step = 0; step < kGivenUp + 20; ++step) {
        states.push_back(world->save()), pieces.push_back(piecesOf(*world));
        act(*world, step);
    }
    const auto last = world->save();
    const auto torn = static_cast<int>(std::find(pieces.begin(), pieces.end(), 2u) - pieces.begin());
    ASSERT_GT(torn, kTaken + 2);
    ASSERT_LT(torn, kGivenUp - 10);
    auto other = hungStrip();
    for (const int from : {torn + 5, torn - 2, torn, kGivenUp + 5, torn - 1, 0, torn + 1, kTaken + 1}) {
        for (PhysicsWorld* again : {world.get(), other.get()}) {
            again->restore(states[from]);
            ASSERT_EQ(piecesOf(*again), pieces[from]);
            for (int step = from; step < kGivenUp + 20; ++step) {
                ASSERT_EQ(again->save(), states[step]) << "from " << from << ", step " << step << ", torn " << torn;
                act(*again, step);
            }
            ASSERT_EQ(again->save(), last) << from;
        }
    }
}

TEST(Tears, OfABodyThatFellApartAHandTakesOnePiece)
{
    auto world = makeWorld({0, 0});
    const SoftBodyDef def = strip(1.2);
    world->addSoftBody(def);
    pullApart(*world, def, 1500);
    for (int i = 0; i < 300 && piecesOf(*world) < 2; ++i) world->step(kStep);
    ASSERT_EQ(piecesOf(*world), 2u);
    const Vec2 grip = middle(*world, 7, 7), left = middle(*world, 0, 6);
    EXPECT_LT((grip - middle(*world, 6, 6)).norm(), 40) << "within the radius lie both";
    const JointHandle hand = world->addJoint(pullAt(grip, 60));
    world->setJointTarget(hand, grip + Vec2(0, 500));
    world->step(kStep);
    EXPECT_GT(middle(*world, 7, 9).y() - grip.y(), 1);
    EXPECT_NEAR(middle(*world, 0, 6).y(), left.y(), 1e-3);
}

TEST(Tears, OfABodyThatFallsToDustAHandHoldsOneParticleUntilItLetsGo)
{
    auto world = hungStrip();
    const JointHandle hand = world->addJoint(pullAt(kGrip, 30));
    run(*world, 0.5);
    const auto before = world->save();
    world->setSprings(0, 300, 0.5, 0.5);  // all of them are longer than half of what they were
    const Vec2 target(70, 215);
    world->setJointTarget(hand, target);
    for (int i = 0; i < 120; ++i) {
        world->step(kStep);
        ASSERT_TRUE(allFinite(*world)) << i;
    }
    EXPECT_EQ(piecesOf(*world), static_cast<std::size_t>(kColumns * kRows));
    EXPECT_NEAR((world->joint(hand).pointB - target).norm(), 0, 0.1);
    int there = 0;
    for (const Vec2& p : pointsOf(*world, 0)) there += (p - target).norm() < 0.1;
    EXPECT_EQ(there, 1);
    const auto dust = world->save();
    run(*world, 0.5);
    const auto later = world->hash();
    world->restore(dust);
    run(*world, 0.5);
    EXPECT_EQ(world->hash(), later);
    world->removeJoint(hand);
    run(*world, 0.5);
    world->restore(before);
    EXPECT_EQ(world->save(), before);
    EXPECT_TRUE(removal(*world).hasJoint(hand));
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
