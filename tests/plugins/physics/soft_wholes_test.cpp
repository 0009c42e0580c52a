// Soft bodies with the properties of rigid ones: kinematic, never turning, one-sided.
#include "scenes.hpp"

namespace jet::physics::test {

namespace {

constexpr double kPi = 3.14159265358979;

/// A lattice of columns x rows particles; all neighbours and diagonals are springs. Mass 1.
SoftBodyDef lattice(const Vec2& corner, int columns, int rows, double spacing, double ks)
{
    SoftBodyDef def;
    const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * columns + x); };
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) def.particles.push_back(corner + spacing * Vec2(x, y));
    def.masses.assign(def.particles.size(), 1.0 / static_cast<double>(def.particles.size()));
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        def.springs.push_back({a, b, (def.particles[a] - def.particles[b]).norm(), ks, 1, 0});
    };
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            if (x + 1 < columns) join(at(x, y), at(x + 1, y));
            if (y + 1 < rows) join(at(x, y), at(x, y + 1));
            if (x + 1 < columns && y + 1 < rows) join(at(x, y), at(x + 1, y + 1)), join(at(x + 1, y), at(x, y + 1));
        }
    auto& border = def.borders.emplace_back();
    for (int x = 0; x < columns; ++x) border.push_back(at(x, 0));
    for (int y = 1; y < rows; ++y) border.push_back(at(columns - 1, y));
    for (int x = columns - 2; x >= 0; --x) border.push_back(at(x, rows - 1));
    for (int y = rows - 2; y > 0; --y) border.push_back(at(0, y));
    return def;
}

/// Greatest distance of a particle from where a rigid motion of the body at rest takes it.
double strayFrom(const PhysicsWorld& world, BodyHandle body, const SoftBodyDef& def, const Vec2& move, double angle)
{
    Vec2 centre(0, 0);
    for (const Vec2& at : def.particles) centre += at / static_cast<double>(def.particles.size());
    const Affine turn = Affine::rotation(angle);
    double most = 0;
    for (std::size_t i = 0; i < def.particles.size(); ++i) {
        const Vec2 should = centre + move + turn.linear() * Vec2(def.particles[i] - centre);
        most = std::max(most, (pointsOf(world, body)[i] - should).norm());
    }
    return most;
}

}  // namespace

TEST(KinematicSoftBody, ItMovesByItsVelocityAndSpinWhateverActsOnIt)
{
    for (const Method method : {Method::Automatic, Method::SemiImplicitEuler}) {
        WorldSettings settings;
        settings.linearDamping = 2, settings.angularDamping = 2, settings.method = method;
        const auto world = JetPhysics().createWorld(settings);
        SoftBodyDef def = softBall({0, 0}, 20);
        def.movable.assign(def.particles.size(), 1);
        def.movable[5] = 0;  // a pin goes along
        def.common.kinematic = true;
        def.common.velocity = {30, -10}, def.common.omega = 2;
        def.matter.pressure = 20, def.matter.shapeStiffness = 10;
        const BodyHandle body = world->addSoftBody(def);
        world->addForce({{body, {0, -20}, 0}, {500, 0}});
        world->addSpring({{body, {0, 20}, 0}, {kNoHandle, {0, 300}, 0}, 10});
        world->addRigidBody(simple(box({30, -60}, 20, 20, 50)));
        if (method == Method::Automatic) world->addSoftBody(softBall({0, -60}, 12));
        for (int i = 1; i <= 120; ++i) {
            world->step(kStep);
            const double t = i * kStep;
            ASSERT_LT(strayFrom(*world, body, def, t * Vec2(30, -10), 2 * t), 1e-9) << "after " << t << " s";
        }
        EXPECT_NEAR(world->bodies().omega[body], 2, 1e-9);
        world->applyImpulse(body, {100, 0});
        EXPECT_NEAR(world->bodies().velocity[body].x(), 30, 1e-9) << "as with rigid ones";
        world->setVelocity(body, {0, 5}), world->setOmega(body, 0);
        world->step(kStep);
        EXPECT_LT(strayFrom(*world, body, def, Vec2(60, -20 + 5 * kStep), 4), 1e-9);
    }
}

TEST(KinematicSoftBody, ALiftCarriesRigidAndSoftBodies)
{
    const auto world = makeWorld({0, 98.1});
    SoftBodyDef lift = lattice({-60, 0}, 13, 3, 10, 300);
    lift.common.kinematic = true, lift.common.velocity = {0, -20};
    world->addSoftBody(lift);
    const BodyHandle crate = world->addRigidBody(simple(box({-30, -10.5}, 20, 20, 100)));
    const BodyHandle ball = world->addSoftBody(softBall({30, -12.5}, 12));
    run(*world, 5);
    EXPECT_NEAR(world->bodies().position[crate].y(), -110, 0.5);
    EXPECT_NEAR(world->bodies().velocity[crate].y(), -20, 0.1);
    EXPECT_NEAR(world->bodies().position[ball].y(), -112, 4);
    EXPECT_TRUE(world->touching(0, crate));
    EXPECT_TRUE(world->touching(0, ball));
}

TEST(KinematicSoftBody, ReleasedItIsAsOneThatNeverWas)
{
    const auto fall = [](bool first) {
        const auto world = makeWorld({0, 98.1});
        SoftBodyDef def = softBall({0, 0}, 20);
        def.angularSprings.push_back({1, 0, 7, kPi / 2, 50, 1});
        def.movable.assign(def.particles.size(), 1);
        def.movable[3] = 0;
        def.common.kinematic = first;
        const BodyHandle body = world->addSoftBody(def);
        BodyCommon free;
        if (first) world->setBody(body, free);
        run(*world, 2);
        return std::vector<Vec2>(pointsOf(*world, body).begin(), pointsOf(*world, body).end());
    };
    EXPECT_EQ(fall(true), fall(false));
}

TEST(KinematicSoftBody, ItCanBeCaughtSwitchedOffAndReleasedInMidair)
{
    const auto world = makeWorld({0, 98.1});
    const SoftBodyDef def = softBall({0, 0}, 20);
    const BodyHandle body = world->addSoftBody(def);
    run(*world, 1);
    BodyCommon held;
    held.kinematic = true;
    world->setBody(body, held);
    const double speed = world->bodies().velocity[body].y(), at = world->bodies().position[body].y();
    run(*world, 1);
    EXPECT_NEAR(world->bodies().position[body].y(), at + speed, 1e-6) << "it goes on with the speed it had";
    world->setEnabled(body, false);
    run(*world, 1);
    EXPECT_NEAR(world->bodies().position[body].y(), at + speed, 1e-6);
    world->setBody(body, BodyCommon());
    run(*world, 1);
    EXPECT_NEAR(world->bodies().position[body].y(), at + speed, 1e-6) << "still switched off";
    world->setEnabled(body, true);
    run(*world, 1);
    EXPECT_NEAR(world->bodies().position[body].y(), at + speed + 0.5 * 98.1, 1);
}

TEST(KinematicSoftBody, PinsSetMeanwhileHoldAfterwards)
{
    const auto world = makeWorld({0, 98.1});
    SoftBodyDef def = softBall({0, 0}, 20);
    def.common.kinematic = true, def.common.velocity = {10, 0};
    const BodyHandle body = world->addSoftBody(def);
    world->setPinned(body, 0, true);
    run(*world, 1);
    EXPECT_NEAR(pointsOf(*world, body)[0].x(), 10, 1e-9);
    world->setBody(body, BodyCommon());
    run(*world, 1);
    EXPECT_NEAR((pointsOf(*world, body)[0] - Vec2(10, 0)).norm(), 0, 1e-9) << "its hub is pinned where it came to";
}

TEST(KinematicSoftBody, ARestoredWorldGoesOnBitEqual)
{
    const auto make = [] {
        auto world = makeWorld({0, 98.1});
        SoftBodyDef lift = lattice({-60, 0}, 13, 3, 10, 300), top = lattice({-20, -45}, 5, 3, 10, 300);
        lift.common.kinematic = true, lift.common.velocity = {3, -20}, lift.common.omega = 0.05;
        top.common.fixedRotation = true;
        world->addSoftBody(lift), world->addSoftBody(top);
        world->addSoftBody(softBall({30, -30}, 12));
        return world;
    };
    const auto world = make(), other = make();
    run(*world, 1.5);
    other->restore(world->save());
    for (int i = 0; i < 100; ++i) {
        world->step(kStep), other->step(kStep);
        ASSERT_EQ(world->hash(), other->hash()) << i;
    }
}

TEST(UprightSoftBody, ItDoesNotTurnWhereItWouldOtherwiseFall)
{
    for (const bool upright : {false, true}) {
        const auto world = makeWorld({0, 98.1});
        world->addRigidBody(simple(fixed({boxRing({0, 150}, 100, 100)})));  // it lands on the edge of a table
        SoftBodyDef def = lattice({35, 50}, 6, 6, 8, 600);
        def.common.fixedRotation = upright;
        const BodyHandle body = world->addSoftBody(def);
        double most = 0;
        for (int i = 0; i < 120; ++i) {
            world->step(kStep);
            most = std::max(most, std::abs(world->bodies().angle[body]));
        }
        if (!upright) {
            EXPECT_GT(most, 0.5);
            continue;
        }
        EXPECT_LT(most, 1e-9);
        EXPECT_NEAR(world->bodies().omega[body], 0, 1e-9);
        EXPECT_LT(world->bodies().position[body].y(), 100) << "the table bears it";
        EXPECT_NEAR(areaRatio(*world, body, def), 1, 0.2);
    }
}

TEST(UprightSoftBody, ItMovesAndSwingsAsUsual)
{
    for (const bool upright : {false, true}) {
        const auto world = makeWorld({0, 0});
        SoftBodyDef def = softBall({0, 0}, 20, 200, 0);
        for (Vec2& at : def.particles) at.x() *= 1.1;  // it breathes
        def.common.fixedRotation = upright;
        def.common.velocity = {40, 7}, def.common.omega = 3;
        const BodyHandle body = world->addSoftBody(def);
        world->addTorque({{body, {0, 0}, 0}, 50});
        double least = 10, most = 0;
        for (int i = 0; i < 240; ++i) {
            world->step(kStep);
            const double area = areaRatio(*world, body, def);
            least = std::min(least, area), most = std::max(most, area);
        }
        EXPECT_NEAR(world->bodies().velocity[body].x(), 40, 1e-9);
        EXPECT_NEAR(world->bodies().position[body].y(), 28, 1e-6);
        EXPECT_GT(most - least, 0.05) << "it breathes";
        if (upright) {
            EXPECT_NEAR(world->bodies().angle[body], 0, 1e-9);
        } else {
            EXPECT_GT(world->bodies().angle[body], 3);
        }
    }
}

TEST(UprightSoftBody, ItKeepsTheAngleItHasWhenThatIsAsked)
{
    const auto world = makeWorld({0, 0});
    SoftBodyDef def = softBall({0, 0}, 20);
    def.common.omega = 1;
    const BodyHandle body = world->addSoftBody(def);
    run(*world, 1);
    const double angle = world->bodies().angle[body];
    EXPECT_NEAR(angle, 1, 0.05);
    BodyCommon upright;
    upright.fixedRotation = true;
    world->setBody(body, upright);
    run(*world, 1);
    EXPECT_NEAR(world->bodies().angle[body], angle, 1e-9);
    world->setBody(body, BodyCommon());
    world->setOmega(body, 1);
    run(*world, 1);
    EXPECT_NEAR(world->bodies().angle[body], angle + 1, 0.05);
}

TEST(OneSidedSoftBody, FromBelowOthersPassFromAboveTheyLand)
{
    for (const bool soft : {false, true}) {
        for (const double step : {1.0 / 60, 1.0 / 240}) {
            const auto world = makeWorld({0, 300}, 0.3);
            SoftBodyDef bridge = lattice({-90, 0}, 19, 2, 10, 3000);
            bridge.movable.assign(bridge.particles.size(), 1);
            for (const int pin : {0, 18, 19, 37}) bridge.movable[static_cast<std::size_t>(pin)] = 0;
            bridge.common.oneSided = {0, -1};
            for (double& mass : bridge.masses) mass *= 20;
            world->addSoftBody(bridge);
            SoftBodyDef ball = softBall({5, 80}, 12, 3000, 2, 14, 2);
            ball.common.velocity = {0, -450};
            RigidBodyDef crate = simple(box({5, 80}, 20, 20));
            crate.common.velocity = {0, -450};
            const BodyHandle body = soft ? world->addSoftBody(ball) : world->addRigidBody(crate);
            double highest = 1e9;
            int landed = 0;  // steps it touched in the last three seconds, in which it still bounces
            for (int i = 0; i < static_cast<int>(6 / step); ++i) {
                world->step(step);
                highest = std::min(highest, world->bodies().position[body].y());
                landed += i > 3 / step && world->touching(0, body);
            }
            EXPECT_NEAR(highest, 80 - 450 * 450 / 600.0, 20) << "nothing slowed it; soft " << soft;
            EXPECT_GT(landed, 0.1 / step) << "it came down on the bridge; soft " << soft;
            EXPECT_LT(world->bodies().position[body].y(), 40) << "and stays there; soft " << soft;
        }
    }
}

TEST(OneSidedSoftBody, ItsSideCanBeTakenAway)
{
    const auto world = makeWorld({0, 300}, 0.3);
    SoftBodyDef bridge = lattice({-90, 0}, 19, 2, 10, 3000);
    bridge.common.fixed = true, bridge.common.oneSided = {0, -1};
    world->addSoftBody(bridge);
    SoftBodyDef ball = softBall({5, 80}, 12, 3000, 2, 14, 2);
    ball.common.velocity = {0, -450};
    world->addSoftBody(ball);
    BodyCommon common;
    common.fixed = true;
    world->setBody(0, common);
    double highest = 1e9;
    for (int i = 0; i < 120; ++i) {
        world->step(kStep);
        highest = std::min(highest, world->bodies().position[1].y());
    }
    EXPECT_GT(highest, 15) << "now it is solid from below";
}

}  // namespace jet::physics::test
