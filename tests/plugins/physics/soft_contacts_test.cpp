// Contacts between soft bodies, and what soft bodies bear: frequencies, masses, speeds.
#include "lattices.hpp"

#include <limits>

namespace jet::physics::test {

namespace {

/// Every third particle has `ratio` times the mass of the others.
std::unique_ptr<PhysicsWorld> pileOfBalls(Simd simd, double thickness, double ratio = 1)
{
    WorldSettings settings;
    settings.gravity = {0, 98};
    settings.simd = simd;
    auto world = JetPhysics().createWorld(settings);
    for (int i = 0; i < 9; ++i) {
        SoftBodyDef ball = defaultBall({50.0 * (i % 3) + 7 * (i / 3), -30 - 50.0 * (i / 3)}, 20, 40);
        ball.matter.thickness = thickness;
        for (std::size_t k = 0; k < ball.masses.size(); k += 3) ball.masses[k] *= ratio;
        world->addSoftBody(ball);
    }
    world->addRigidBody(ground(0));
    world->addRigidBody(fixed({boxRing({-75, -100}, 100, 400), boxRing({190, -100}, 100, 400)}));
    return world;
}

/// Least distance of the border points of one body from the border of another, scene units.
double distanceBetween(const PhysicsWorld& world, BodyHandle a, BodyHandle b, const SoftBodyDef& defB)
{
    double least = std::numeric_limits<double>::infinity();
    const auto from = pointsOf(world, a), to = pointsOf(world, b);
    const auto& ring = defB.borders[0];
    for (const Vec2& at : from) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 &p = to[ring[i]], edge = to[ring[(i + 1) % ring.size()]] - p;
            const double along = std::clamp((at - p).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
            least = std::min(least, (at - p - along * edge).norm());
        }
    }
    return least;
}

}  // namespace

TEST(SoftContacts, InstructionSetsGiveTheSameBits)
{
    for (const double ratio : {1.0, 1000.0}) {
        auto one = pileOfBalls(Simd::Sse2, 1, ratio), other = pileOfBalls(Simd::Avx2, 1, ratio);
        for (int i = 0; i < 240; ++i) {
            one->step(kStep), other->step(kStep);
            ASSERT_EQ(one->hash(), other->hash()) << "step " << i << ", " << ratio;
        }
    }
}

TEST(SoftContacts, ARestoredPileHasTheSameFuture)
{
    for (const double ratio : {1.0, 1000.0}) {
        auto world = pileOfBalls(Simd::Automatic, 0, ratio);
        run(*world, 2);
        EXPECT_GT(world->contacts().size(), 10u);
        const auto saved = world->save();
        run(*world, 2);
        const auto expected = world->hash();
        world->restore(saved);
        run(*world, 2);
        EXPECT_EQ(world->hash(), expected) << ratio;
        auto other = pileOfBalls(Simd::Automatic, 0, ratio);
        other->restore(saved);
        run(*other, 2);
        EXPECT_EQ(other->hash(), expected) << ratio;
    }
}

TEST(SoftContacts, APileSavedAfterLiveChangesHasTheSameFuture)
{
    auto world = pileOfBalls(Simd::Automatic, 1), other = pileOfBalls(Simd::Automatic, 1);
    run(*world, 1);
    // What steps begin with is read again, as if the world had been restored.
    world->setMass(4, 3 * 0.7);
    world->setPinned(8, 3, true);
    world->applyImpulse(2, {5, -3});
    other->restore(world->save());
    for (int i = 0; i < 60; ++i) {
        world->step(kStep), other->step(kStep);
        ASSERT_EQ(world->hash(), other->hash()) << "step " << i;
    }
}

TEST(SoftContacts, AFixedWallBearsTheWeightOfWhatRestsOnIt)
{
    for (const double thickness : {0.0, 2.0}) {
        auto world = makeWorld({0, 98});
        SoftBodyDef ball = defaultBall({0, -25}, 20, 40);
        ball.matter.thickness = thickness;
        world->addSoftBody(ball);
        world->addRigidBody(ground(0));
        run(*world, 6);
        double mass = 0, up = 0;
        for (const double m : ball.masses) mass += m;
        constexpr int kSteps = 240;  // it still sways a little
        for (int i = 0; i < kSteps; ++i) {
            world->step(kStep);
            for (const Contact& c : world->contacts()) {
                up -= c.impulse * c.normal.y();
                EXPECT_EQ(c.bodyA, 0U);
                EXPECT_EQ(c.bodyB, 1U);
                EXPECT_LT(c.penetration, 0.2);
            }
        }
        const double weight = mass * 98 * kSteps * kStep;
        EXPECT_NEAR(up, weight, 0.02 * weight) << thickness;
    }
}

TEST(SoftContacts, AFixedWallIsFeltWhereItWasPut)
{
    auto world = makeWorld({0, 98});
    world->addSoftBody(defaultBall({0, -25}, 20, 40));
    world->addRigidBody(ground(0));
    run(*world, 3);
    const Vec2 centre = world->bodies().position[1];
    const double height = world->bodies().position[0].y();
    for (const double shift : {0.5, 3.0, 40.0}) {
        world->setPosition(1, centre + Vec2(0, shift));
        run(*world, 4);
        EXPECT_NEAR(world->bodies().position[0].y(), height + shift, 2) << shift;
        EXPECT_TRUE(world->touching(0, 1));
    }
}

TEST(SoftContacts, APileComesToRestWithoutOverlapOrInversion)
{
    for (const double thickness : {0.0, 2.0}) {
        auto world = pileOfBalls(Simd::Automatic, thickness);
        run(*world, 15);
        const SoftBodyDef ball = defaultBall({0, 0}, 20, 40);
        for (BodyHandle a = 0; a < 9; ++a) {
            EXPECT_GT(areaRatio(*world, a, ball), 0.7);
            EXPECT_LT(world->bodies().velocity[a].norm(), 2);
            for (BodyHandle b = 0; b < 9; ++b) {
                if (a == b) continue;
                EXPECT_GT((world->bodies().position[a] - world->bodies().position[b]).norm(), 20);
                if (thickness > 0) {
                    EXPECT_GT(distanceBetween(*world, a, b, ball), 2 * thickness - 0.5);
                }
            }
        }
    }
}

/// Three balls on each other, at rest: what their contacts are is not looked at again.
std::unique_ptr<PhysicsWorld> restingColumn(double thickness = 1)
{
    WorldSettings settings;
    settings.gravity = {0, 98};
    auto world = JetPhysics().createWorld(settings);
    for (int i = 0; i < 3; ++i) {
        SoftBodyDef ball = defaultBall({0, -25 - 45.0 * i}, 20, 40);
        ball.matter.thickness = thickness;
        world->addSoftBody(ball);
    }
    world->addRigidBody(ground(0));
    world->addRigidBody(fixed({boxRing({-75, -100}, 100, 400), boxRing({75, -100}, 100, 400)}));
    run(*world, 20);
    return world;
}

double deepest(const PhysicsWorld& world)
{
    double depth = 0;
    for (const Contact& contact : world.contacts()) depth = std::max(depth, contact.penetration);
    return depth;
}

TEST(SoftContacts, ABodyPutBesideARestingOneIsFeltAtOnce)
{
    auto world = restingColumn();
    const Vec2 middle = world->bodies().position[1], low = world->bodies().position[0];
    ASSERT_TRUE(world->touching(0, 1));
    world->setPosition(1, middle - Vec2(0, 200));
    world->step(kStep);
    EXPECT_FALSE(world->touching(0, 1));
    world->setPosition(1, middle);
    world->step(kStep);
    EXPECT_TRUE(world->touching(0, 1));
    run(*world, 5);
    EXPECT_LT(world->bodies().position[1].y(), low.y() - 25);
}

TEST(SoftContacts, ARestingBodyThatIsHitIsNotPassed)
{
    for (const double speed : {20.0, 300.0, 3000.0}) {
        auto world = restingColumn();
        world->setVelocity(2, {0, speed});
        for (int i = 0; i < 300; ++i) {
            world->step(kStep);
            ASSERT_GT(world->bodies().position[0].y() - world->bodies().position[1].y(), 0) << speed << ", step " << i;
            ASSERT_GT(world->bodies().position[1].y() - world->bodies().position[2].y(), 0) << speed << ", step " << i;
        }
        if (speed > 1000) continue;  // crushed past each other, two of them jam side by side
        run(*world, 10);
        EXPECT_LT(deepest(*world), 1);
    }
}

TEST(SoftContacts, LayersMasksAndGroupsAreHeeded)
{
    // Balls over a floor on layer 2 and over a soft one of group 7: who does not meet it falls through.
    auto world = makeWorld({0, 98});
    RigidBodyDef floor = simple(ground(0));
    floor.common.layer = 2;
    world->addRigidBody(floor);
    const auto add = [&](double x, double y, std::uint32_t mask, std::uint32_t group, bool fixed = false) {
        SoftBodyDef ball = softBall({x, y}, 20);
        ball.common.mask = mask, ball.common.group = group, ball.common.fixed = fixed;
        return world->addSoftBody(ball);
    };
    const BodyHandle held = add(-300, -40, ~0U, 0), through = add(-150, -40, ~2U, 0);
    add(150, 0, ~0U, 7, true), add(300, 0, ~0U, 7, true);
    const BodyHandle alike = add(150, -60, ~2U, 7), other = add(300, -60, ~0U, 8);
    const auto saved = world->save();
    run(*world, 2);
    const auto height = [&](BodyHandle body) { return world->bodies().position[body].y(); };
    EXPECT_LT(height(held), 0);
    EXPECT_GT(height(through), 100);
    EXPECT_GT(height(alike), 100);
    EXPECT_LT(height(other), -20);
    BodyCommon common;
    common.mask = ~2U;
    world->setBody(held, common);
    run(*world, 2);
    EXPECT_GT(height(held), 100) << "it does not meet the floor any more";
    world->restore(saved);
    run(*world, 2);
    EXPECT_LT(height(held), 0) << "nor does what was saved know of that";
}

TEST(SoftContacts, AThicknessGivenWhileBodiesRestIsFelt)
{
    auto world = restingColumn();
    const SoftBodyDef ball = defaultBall({0, 0}, 20, 40);
    ASSERT_LT(distanceBetween(*world, 0, 1, ball), 2.5);
    for (BodyHandle body = 0; body < 3; ++body) {
        SoftMatter matter;
        matter.thickness = 3;
        world->setSoftMatter(body, matter);
    }
    run(*world, 5);
    EXPECT_GT(distanceBetween(*world, 0, 1, ball), 5.5);
    EXPECT_GT(distanceBetween(*world, 1, 2, ball), 5.5);
}

TEST(SoftContacts, AMassGivenWhileBodiesRestIsFelt)
{
    const auto heightOfTheLowest = [](double factor) {
        auto world = restingColumn();
        world->setMass(2, factor * defaultBall({0, 0}, 20, 40).masses[0] * 100);
        run(*world, 10);
        const Box bounds = world->bodies().bounds[0];
        return bounds.size().y();
    };
    EXPECT_LT(heightOfTheLowest(4), heightOfTheLowest(0.25) - 0.2);
}

/// Counts begins and ends of two bodies; the impulses of all begins.
struct Touches {
    int begun = 0, ended = 0;
    double impulse = 0;

    void see(const PhysicsWorld& world, BodyHandle a, BodyHandle b)
    {
        for (const ContactEvent& event : world.contactEvents()) {
            if (event.bodyA != a || event.bodyB != b) continue;
            (event.begins ? begun : ended) += 1;
            if (event.begins) impulse += event.impulse;
        }
    }
};

TEST(SoftContacts, EventsTellWhenSoftBodiesBeginAndEndToTouch)
{
    WorldSettings settings;
    settings.gravity = {0, 98};
    auto world = JetPhysics().createWorld(settings);
    const BodyHandle low = world->addSoftBody(defaultBall({0, -21}, 20, 40));
    const BodyHandle high = world->addSoftBody(defaultBall({2, -90}, 20, 40));
    const BodyHandle floor = world->addRigidBody(ground(0));
    Touches balls, ground;
    int touchedGround = 0;
    bool before = false;
    for (int i = 0; i < 900; ++i) {
        world->step(kStep);
        balls.see(*world, low, high), ground.see(*world, low, floor);
        EXPECT_EQ(ground.begun - ground.ended, world->touching(low, floor) ? 1 : 0) << "step " << i;
        EXPECT_EQ(balls.begun - balls.ended, world->touching(low, high) ? 1 : 0) << "step " << i;
        touchedGround += world->touching(low, floor) && !before;
        before = world->touching(low, floor);
    }
    EXPECT_EQ(ground.begun, touchedGround);
    EXPECT_GE(balls.begun, 1);
    EXPECT_GT(balls.impulse, 0);
    EXPECT_GT(ground.impulse, 0);
    world->setPosition(high, {0, -500});
    world->step(kStep);
    balls.see(*world, low, high);
    EXPECT_EQ(balls.begun, balls.ended);
}

TEST(SoftContacts, EventsOfARestoredWorldGoOnAsTheyWould)
{
    auto world = restingColumn();
    EXPECT_FALSE(world->contactEvents().empty());  // asked for the first time: all that touch
    world->step(kStep);
    EXPECT_TRUE(world->contactEvents().empty());
    const auto saved = world->save();
    world->setPosition(2, {0, -900});
    world->step(kStep);
    Touches upper;
    upper.see(*world, 1, 2);
    EXPECT_EQ(upper.ended, 1);
    world->restore(saved);
    world->step(kStep);
    EXPECT_TRUE(world->contactEvents().empty());
}

TEST(SoftContacts, AHitKeepsMomentumAndAngularMomentum)
{
    auto world = makeWorld({0, 0}, 0.4, 0.5);
    const SoftBodyDef left = defaultBall({0, 0}, 20, 60), right = defaultBall({70, 12}, 20, 60);
    world->addSoftBody(left);
    world->addSoftBody(right);
    world->setVelocity(0, {90, 0});
    const auto spin = [&] {
        // From the motion of the particles over a step.
        const std::vector<Vec2> before(world->bodies().points.begin(), world->bodies().points.end());
        world->step(kStep);
        double sum = 0;
        for (std::size_t i = 0; i < before.size(); ++i)
            sum += left.masses[0] * cross(before[i], (world->bodies().points[i] - before[i]) / kStep);
        return sum;
    };
    const double turning = spin();
    bool touched = false;
    for (int i = 0; i < 120; ++i) {
        world->step(kStep);
        touched |= world->touching(0, 1);
        EXPECT_LT((world->bodies().velocity[0] + world->bodies().velocity[1] - Vec2(90, 0)).norm(), 1e-10);
    }
    EXPECT_TRUE(touched);
    EXPECT_GT(world->bodies().velocity[1].x(), 20);
    EXPECT_NEAR(spin(), turning, 0.02 * std::abs(turning) + 1);
}

TEST(SoftContacts, EveryFrequencyOfAHangingSheetIsCalm)
{
    // The scene soft-sheet at a smaller size: 30 Hz is a particle's on one spring, k = (2 pi f)² m / 2.
    constexpr int kSide = 24;
    for (const double hertz : {30.0, 60.0, 120.0, 240.0, 480.0}) {
        SoftBodyDef def;
        const double mass = 0.0254, omega = 2 * 3.14159265358979 * hertz;
        for (int i = 0; i < kSide * kSide; ++i) {
            def.particles.emplace_back(0.2 * (i % kSide), 0.2 * (i / kSide));
            def.movable.push_back(i >= kSide);
        }
        def.masses.assign(def.particles.size(), mass);
        const auto join = [&](std::uint32_t a, std::uint32_t b) {
            def.springs.push_back(
                {a, b, (def.particles[a] - def.particles[b]).norm(), omega * omega * mass / 2, 0.1 * omega * mass, 0});
        };
        for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
            const bool right = i % kSide + 1 < kSide, below = i / kSide + 1 < kSide;
            if (right) join(i, i + 1);
            if (below) join(i, i + kSide);
            if (right && below) join(i, i + kSide + 1), join(i + 1, i + kSide);
        }
        auto world = makeWorld({0, 10});
        world->addSoftBody(def);
        // Of motion and of height: what springs hold is left out, so it can only be less than what there was.
        const auto energy = [&](std::span<const Vec2> before) {
            const auto now = pointsOf(*world, 0);
            double sum = 0;
            for (std::size_t i = 0; i < now.size(); ++i)
                sum += mass * (0.5 * ((now[i] - before[i]) / kStep).squaredNorm() - 10 * now[i].y());
            return sum;
        };
        const double start = energy(def.particles);
        double span = 0;  // what it may convert: the fall of the sheet by its own stretch
        for (const Vec2& p : def.particles) span += mass * 10 * 0.2 * p.y();
        for (int i = 0; i < 300; ++i) {
            const auto points = pointsOf(*world, 0);
            const std::vector<Vec2> before(points.begin(), points.end());
            world->step(kStep);
            ASSERT_TRUE(allFinite(*world)) << hertz;
            ASSERT_LT(energy(before), start + 0.02 * span) << hertz << " Hz, step " << i;
        }
    }
}

TEST(SoftContacts, ASmallBallAtTwentyThousandUnitsASecondDoesNotPassAThinWall)
{
    for (const double height : {0.0, 0.21, -0.37}) {
        auto world = makeWorld({0, 0}, 0.3, 0.2);
        world->addRigidBody(fixed({boxRing({1000, 0}, 1, 400)}));
        SoftBodyDef ball = softBall({0, height}, 0.5, 2000, 1, 12, 2);
        ball.common.velocity = {20000, 0};
        world->addSoftBody(ball);
        for (int i = 0; i < 120; ++i) {
            world->step(kStep);
            ASSERT_LT(world->bodies().bounds[1].max.x(), 1000.5) << height << " step " << i;
        }
        EXPECT_TRUE(allFinite(*world));
    }
}

/// The corner between two walls is pinned, and a pin that cannot be driven out lies beside it within the body: to push
/// a wall there, that little beside what holds it, would throw its other end.
TEST(SoftContacts, AWallPushedBesideItsPinDoesNotThrowItsOtherEnd)
{
    constexpr double kMostSingle = 1e15;  // heavier bodies are solved in double, by ContactSolver
    for (const double mass : {1.0, 10 * kMostSingle}) {
        for (const double beside : {2e-2, 2e-4, 2e-6}) {
            auto world = makeWorld({0, 0});
            const auto add = [&](const std::vector<Vec2>& ring, std::size_t pin) {
                SoftBodyDef def;
                def.particles = ring;
                def.masses.assign(ring.size(), mass);
                def.movable.assign(ring.size(), 1);
                def.movable[pin] = 0;
                auto& border = def.borders.emplace_back();
                for (std::uint32_t i = 0; i < ring.size(); ++i) {
                    border.push_back(i);
                    for (std::uint32_t k = 0; k < i; ++k)
                        def.springs.push_back({k, i, (ring[k] - ring[i]).norm(), 100 * mass, 0, 0});
                }
                return world->addSoftBody(def);
            };
            const BodyHandle table = add({{-20, 0}, {20, 0}, {20, 20}, {0, 20}, {-20, 20}}, 3);
            add({{beside, 8}, {5, 80}, {-5, 80}}, 0);
            const double length = world->bodies().bounds[table].size().norm();
            auto before = pointsOf(*world, table);
            std::vector<Vec2> places(before.begin(), before.end());
            for (int i = 0; i < 60; ++i) {
                world->step(kStep);
                const auto now = pointsOf(*world, table);
                double fastest = 0;
                for (std::size_t k = 0; k < now.size(); ++k)
                    fastest = std::max(fastest, (now[k] - places[k]).norm() / kStep), places[k] = now[k];
                // Overlaps are pushed out at 4 lengths a second, ends of walls at no more than twice that.
                ASSERT_LT(fastest, 2 * 4 * length) << mass << ", " << beside << " beside it, step " << i;
            }
        }
    }
}

TEST(SoftContacts, NoMassRatioAndNoStepMakesThemExplode)
{
    for (const double ratio : {1e-4, 1.0, 1e4}) {
        for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 1000}) {
            for (const double ks : {1e-3, 1e3, 1e9}) {
                auto world = makeWorld({0, 98});
                SoftBodyDef lower = defaultBall({0, -21}, 20, ks), upper = defaultBall({4, -64}, 20, ks);
                for (double& mass : upper.masses) mass *= ratio;
                lower.matter.pressure = 30, lower.matter.selfCollision = true;
                upper.matter.yield = 0.1, upper.matter.thickness = 1;
                world->addSoftBody(lower);
                world->addSoftBody(upper);
                world->addRigidBody(ground(0));
                ForceFieldDef wind;
                wind.kind = ForceFieldDef::Kind::Vortex;
                wind.strength = 200, wind.reach = 50;
                world->addForceField(wind);
                for (int i = 0; i < 120; ++i) world->step(step);
                ASSERT_TRUE(allFinite(*world)) << ratio << " " << step << " " << ks;
                for (const Box& box : world->bodies().bounds)
                    EXPECT_LT(box.size().norm(), 3000) << ratio << " " << step << " " << ks;
                for (BodyHandle body = 0; body < 2; ++body)
                    EXPECT_LT(world->bodies().velocity[body].norm(), 3000) << ratio << " " << step << " " << ks;
            }
        }
    }
}

}  // namespace jet::physics::test
