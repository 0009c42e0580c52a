// What engines of rigid bodies are asked to keep while it moves: in order, inside, together, the same on all threads.
#include "acceptance.hpp"

#include "lattices.hpp"

#include <random>

namespace jet::physics::test {

namespace {

// Falling hinges (Box2D's test of determinism): columns of leaning boxes of 0.5 m, hinged in pairs with limits.

std::unique_ptr<PhysicsWorld> fallingHinges(int threads, int columns)
{
    WorldSettings settings = shapeSettings(threads);
    settings.allowSleep = true;
    auto world = JetPhysics().createWorld(settings);
    const double half = 0.25 * kMetre, shift = 0.4 * half;
    world->addRigidBody(simple(ground(0, 40.0 * half * columns)));
    for (int column = 0; column < columns; ++column)
        for (int i = 0; i < 30; ++i) {
            const double x = 10 * half * (column - 0.5 * (columns - 1)), y = -half - 2 * half * i;
            const BodyHandle body =
                world->addRigidBody(simple(box({x + shift * i, y}, 2 * half, 2 * half, 1, 1 - 0.1 * i)));
            if (i % 2 == 0) continue;
            JointDef hinge;
            hinge.a = {body - 1, {x + shift * i, y + half}}, hinge.b = {body, hinge.a.point};
            hinge.limited = true, hinge.lower = -0.1 * kPi, hinge.upper = 0.2 * kPi;
            hinge.driven = true, hinge.maxTorque = 0.1 * 98.1;  // friction, else what hangs would swing for ever
            world->addJoint(hinge);
        }
    return world;
}

/// Hash at every half second until all sleep, and then; as many steps as it took are their count's.
struct Fall {
    int steps = 0;
    std::vector<std::uint64_t> hashes;
    bool operator==(const Fall&) const = default;
};

Fall fall(int threads, int columns)
{
    auto world = fallingHinges(threads, columns);
    Fall result;
    do {
        world->step(kStep);
        if (++result.steps % 30 == 0) result.hashes.push_back(world->hash());
    } while (world->stats().awakeBodies > 0 && result.steps < 1200);
    result.hashes.push_back(world->hash());
    return result;
}

TEST(FallingHinges, OneHashAndOneStepOfSleepFor1To32Threads)
{
    const Fall one = fall(1, 4);
    // The highest falls for 1.8 s; Box2D's sleep at step 276.
    EXPECT_LT(one.steps, 600);
    for (const int threads : {2, 4, 8, 16, 32}) EXPECT_TRUE(fall(threads, 4) == one) << threads << " threads";
}

TEST(FallingHinges, SixtyColumnsThatThreadsShareHaveOneHashToo)
{
    const Fall one = fall(1, 60);
    EXPECT_LT(one.steps, 600);
    for (const int threads : {2, 4, 32}) EXPECT_TRUE(fall(threads, 60) == one) << threads << " threads";
}

// Dominoes

TEST(Dominoes, FallOneAfterTheOtherToTheLast)
{
    for (const bool drawn : {false, true}) {
        SCOPED_TRACE(drawn);
        Stage stage(drawn);
        stage.add(ground(0));
        const double width = 0.25 * kMetre, height = kMetre, apart = 1.01 * height;
        const int count = 15;
        for (int i = 0; i < count; ++i) stage.add(box({apart * i, -height / 2}, width, height));
        // It turns about its lower right corner, fast enough to bring its centre over it.
        const double lever = std::hypot(width, height) / 2, rise = lever - height / 2;
        const double omega =
            1.5 * std::sqrt(2 * 98.1 * rise / (lever * lever + (width * width + height * height) / 12));
        stage.world->setOmega(stage.watched[0], omega);
        stage.world->setVelocity(stage.watched[0], omega * Vec2(height / 2, width / 2));
        const double reached = std::asin((apart - width) / height);  // where one touches the next
        std::vector<int> hit(count, 0);
        for (int step = 1; step <= 900; ++step) {
            stage.world->step(kStep);
            for (int i = 0; i < count; ++i)
                if (hit[i] == 0 && stage.world->bodies().angle[stage.watched[i]] > 0.9 * reached) hit[i] = step;
        }
        for (int i = 0; i < count; ++i) {
            EXPECT_GT(hit[i], i > 0 ? hit[i - 1] : 0) << "domino " << i << " falls after the one before";
            EXPECT_GT(stage.world->bodies().angle[stage.watched[i]], reached) << "and lies on the next, or the ground";
        }
        EXPECT_NEAR(stage.world->bodies().angle[stage.watched[count - 1]], kPi / 2, 0.02) << "the last lies flat";
        EXPECT_LT(stage.fastest(), 0.05 * kMetre);
    }
}

// Discs

TEST(Discs, ExactlyOverEachOtherTheyStandAsNothingPushesThemAside)
{
    Stage stage;
    stage.add(ground(0));
    for (int i = 0; i < 10; ++i) stage.add(disc({0, -kMetre * (i + 0.5)}, kMetre / 2));
    run(*stage.world, 10);
    for (std::size_t i = 0; i < stage.watched.size(); ++i) {
        const Vec2 moved = stage.at(stage.watched[i]) - stage.placed[i];
        EXPECT_LT(std::abs(moved.x()), 1e-6) << "disc " << i;
        EXPECT_NEAR(moved.y(), 0, 0.0074 * kMetre * (i + 1)) << "disc " << i;
    }
}

/// Four walls around a square, as chains that are solid from inside.
void addRoom(Stage& stage, double side)
{
    RigidBodyDef room;
    room.common.fixed = true;
    const double h = side / 2;
    room.shapes.push_back({ShapeDef::Kind::Chain, {{-h, -h}, {-h, h}, {h, h}, {h, -h}, {-h, -h}}, 0});
    stage.add(room);
}

TEST(Discs, ConfinedToLessRoomThanTheyNeedTheyNeitherLeaveNorGoOnShaking)
{
    // 625 discs of 1 m in a room of 20 m: the closest packing, π / √12, lets in 462.
    WorldSettings settings = shapeSettings();
    settings.gravity = {0, 0};
    Stage stage(false, settings);
    const double room = 20 * kMetre, radius = kMetre / 2;
    addRoom(stage, room);
    for (int i = 0; i < 625; ++i)
        stage.add(disc({(i % 25 - 12) * 0.72 * kMetre, (i / 25 - 12) * 0.72 * kMetre}, radius));
    double fastest = 0;
    for (int step = 0; step < 600; ++step) {
        stage.world->step(kStep);
        fastest = std::max(fastest, stage.fastest());
        for (const BodyHandle body : stage.watched)
            ASSERT_LT(stage.at(body).cwiseAbs().maxCoeff(), room / 2) << "body " << body << " at step " << step;
    }
    // Overlaps are parted by at most 4 lengths a second (docs/physics.md), and from the middle to a wall are twelve.
    EXPECT_LT(fastest, 12 * 4 * kMetre);
    EXPECT_LT(stage.fastest(), 0.05 * kMetre) << "pressed, and still";
}

TEST(Discs, TenThousandOverlapsAtOnePointPartAndKeepTheirMomentum)
{
    // 142 discs have 10,011 pairs.
    for (const bool boxes : {false, true}) {
        SCOPED_TRACE(boxes);
        WorldSettings settings = shapeSettings();
        settings.gravity = {0, 0};
        Stage stage(false, settings);
        for (int i = 0; i < 142; ++i) stage.add(boxes ? box({3, 4}, kMetre, kMetre) : disc({3, 4}, kMetre / 2));
        double fastest = 0;
        for (int step = 0; step < 900; ++step) {
            stage.world->step(kStep);
            fastest = std::max(fastest, stage.fastest());
        }
        Vec2 momentum(0, 0);
        double moving = 0;
        for (const BodyHandle body : stage.watched) {
            momentum += stage.world->bodies().velocity[body];
            moving += stage.world->bodies().velocity[body].norm();
        }
        EXPECT_LT(momentum.norm(), 1e-6 * moving + 1e-9);
        // In a row of them each parts from the next at 4 lengths a second: the outermost go at half the sum.
        EXPECT_LT(fastest, 142 / 2 * 4 * kMetre);
        double deepest = 0;
        for (const Contact& contact : stage.world->contacts()) deepest = std::max(deepest, contact.penetration);
        EXPECT_LT(deepest, 0.01 * kMetre);
    }
}

TEST(Discs, OneRollsDownASlopeWithTwoThirdsOfWhatASliderHas)
{
    const double slope = 0.3, radius = kMetre / 2;
    WorldSettings settings = shapeSettings();
    settings.gravity = 98.1 * Vec2(std::sin(slope), std::cos(slope));
    Stage stage(false, settings);
    stage.add(ground(0, 20000));
    const BodyHandle body = stage.add(disc({0, -radius}, radius));
    run(*stage.world, 4);
    const double speed = 98.1 * std::sin(slope) * 2 / 3 * 4;
    EXPECT_NEAR(stage.world->bodies().velocity[body].x(), speed, 0.01 * speed);
    EXPECT_NEAR(stage.world->bodies().omega[body] * radius, speed, 0.01 * speed) << "without slipping";
}

// Machines

TEST(Machines, ASpinnerStirsAHeapAndNothingLeavesItsDrum)
{
    WorldSettings settings = shapeSettings();
    settings.materials[0].friction = 0.2;
    Stage stage(false, settings);
    const double drum = 20 * kMetre, speed = 5;
    RigidBodyDef wall;
    wall.common.fixed = true;
    auto ring = circleRing({0, 0}, drum, 360);
    ring.push_back(ring.front());
    std::reverse(ring.begin(), ring.end());
    wall.shapes.push_back({ShapeDef::Kind::Chain, ring, 0});
    stage.add(wall);
    const BodyHandle spinner = stage.add(box({0, 0}, 0.4 * kMetre, 1.9 * drum, 400));
    JointDef axle;
    axle.a = {kNoHandle, {0, 0}}, axle.b = {spinner, {0, 0}};
    axle.driven = true, axle.motorSpeed = speed, axle.maxTorque = 1e9;
    stage.world->addJoint(axle);
    for (int i = 0; i < 600; ++i) {
        const Vec2 at((i % 30 - 14.5) * 0.8 * kMetre + (i % 30 < 15 ? -1 : 1) * kMetre, (i / 30 - 10) * 0.8 * kMetre);
        if (i % 3 == 0) stage.add(disc(at, 0.25 * kMetre));
        if (i % 3 == 1) stage.add(box(at, 0.5 * kMetre, 0.5 * kMetre));
        if (i % 3 == 2) {
            RigidBodyDef capsule;
            capsule.shapes.push_back(
                {ShapeDef::Kind::Capsule, {at - Vec2(0.25 * kMetre, 0), at + Vec2(0.25 * kMetre, 0)}, 0.25 * kMetre});
            stage.add(capsule);
        }
    }
    for (int step = 0; step < 600; ++step) {
        stage.world->step(kStep);
        for (const BodyHandle body : stage.watched)
            ASSERT_LT(stage.at(body).norm(), drum) << "body " << body << " at step " << step;
        if (step > 30) {
            ASSERT_NEAR(stage.world->bodies().omega[spinner], speed, 0.05 * speed) << "step " << step;
        }
    }
    EXPECT_NEAR(stage.at(spinner).norm(), 0, 0.01 * kMetre);
    // Nothing that the spinner's end drives at ω R is faster than that and what a fall through the drum adds.
    EXPECT_LT(stage.fastest(), speed * 0.95 * drum + std::sqrt(2 * 98.1 * 2 * drum));
}

TEST(Machines, AFlipperHitsABallUpAndKeepsWithinItsLimitsHoweverStrongItsMotor)
{
    // A ball that lies on a heavy flipper at r leaves with ω r, or more as it slides outwards, as far as its end.
    for (const double torque : {1e7, 1e9, 1e12}) {
        SCOPED_TRACE(torque);
        Stage stage;
        const double length = 3 * kMetre, thick = 0.4 * kMetre, swing = 0.6, speed = 10;
        const BodyHandle flipper = stage.add(box({length / 2, 0}, length, thick, 100));
        JointDef pivot;
        pivot.a = {kNoHandle, {0, 0}}, pivot.b = {flipper, {0, 0}};
        pivot.limited = true, pivot.lower = -swing, pivot.upper = 0;
        pivot.driven = true, pivot.motorSpeed = 1, pivot.maxTorque = torque;
        const JointHandle joint = stage.world->addJoint(pivot);
        const double radius = 0.3 * kMetre, arm = 2 * kMetre, lying = -thick / 2 - radius;
        const BodyHandle ball = stage.add(disc({arm, lying - kMetre}, radius));
        run(*stage.world, 1.5);
        EXPECT_NEAR(stage.at(ball).y(), lying, 0.01 * kMetre);
        stage.world->setMotor(joint, true, -speed);
        double highest = 0;
        for (int step = 0; step < 180; ++step) {
            stage.world->step(kStep);
            highest = std::max(highest, lying - stage.at(ball).y());
            const double angle = stage.world->joint(joint).value;
            // It may show the step in which it arrives, not one more.
            ASSERT_TRUE(angle > -swing - speed * kStep && angle < 0.01) << angle << " at step " << step;
            if (step > 30) {
                ASSERT_NEAR(angle, -swing, 0.01) << "step " << step;
            }
        }
        const double slowest = speed * arm, fastest = speed * (length + thick);
        EXPECT_GT(highest, 0.9 * slowest * slowest / (2 * 98.1));
        EXPECT_LT(highest, fastest * fastest / (2 * 98.1));
    }
}

TEST(Machines, AThinBoxThatSpinsIntoThinGroundNeverPassesIt)
{
    // Box2D's skinny box: 4 m by 0.1 m, falling at 100 m/s and spinning, on a line and a thin post.
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> spin(-50, 50), angle(-kPi, kPi);
    for (int trial = 0; trial < 60; ++trial)
        for (const bool line : {true, false}) {
            Stage stage;
            RigidBodyDef floor = fixed({boxRing({0, 0.05 * kMetre}, 20 * kMetre, 0.1 * kMetre)});
            if (line) {
                floor.borders.clear();
                floor.shapes.push_back({ShapeDef::Kind::Chain, {{-10 * kMetre, 0}, {10 * kMetre, 0}}, 0});
            }
            stage.add(floor);
            stage.add(fixed({boxRing({0, -kMetre}, 0.2 * kMetre, 2 * kMetre)}));
            RigidBodyDef def = box({0, -8 * kMetre}, 4 * kMetre, 0.1 * kMetre, 1, angle(random));
            def.common.velocity = {0, 100 * kMetre}, def.common.omega = spin(random);
            const BodyHandle body = stage.add(def);
            for (int step = 0; step < 120; ++step) {
                stage.world->step(kStep);
                const Vec2 at = stage.at(body);
                if (std::abs(at.x()) > 8 * kMetre) break;  // it may leave at the ends
                ASSERT_LT(at.y(), 0) << "its centre is below the ground: trial " << trial << ", step " << step;
            }
        }
}

TEST(Machines, AChainBearsABallOf125TimesALinksMass)
{
    // Solver2D's: 40 links of 1 m, let go level; Soft Step stretches it by 1.35 m. Damped, so that it comes to hang.
    WorldSettings settings = shapeSettings();
    settings.linearDamping = 1;
    Stage stage(false, settings);
    const int count = 40;
    BodyHandle before = kNoHandle;
    for (int i = 0; i <= count; ++i) {
        const Vec2 left(i * kMetre, 0);
        const BodyHandle body = stage.add(i == count ? disc(left + Vec2(4 * kMetre, 0), 4 * kMetre, 125)
                                                     : box(left + Vec2(kMetre / 2, 0), kMetre, 0.25 * kMetre));
        JointDef joint;
        joint.a = {before, left}, joint.b = {body, left};
        stage.world->addJoint(joint);
        before = body;
    }
    run(*stage.world, 30);
    double stretch = 0;
    for (int i = 0; i <= count; ++i) {
        const JointState state = stage.world->joint(i);
        stretch += (state.pointA - state.pointB).norm();
    }
    EXPECT_LT(stretch, 1.35 * kMetre);
    EXPECT_NEAR(stage.at(before).y(), (count + 4) * kMetre, 1.35 * kMetre);
    EXPECT_NEAR(stage.world->joint(0).force.norm(), (count + 125) * 98.1, 0.01 * (count + 125) * 98.1);
}

// Far from the origin

TEST(FarFromTheOrigin, AStackAndASoftBodyRestAsTheyDoAtIt)
{
    const auto rest = [](const Vec2& origin) {
        auto world = makeWorld({0, 98.1});
        world->addRigidBody(simple(fixed({boxRing(origin + Vec2(0, 50), 2000, 100)})));
        for (int i = 0; i < 8; ++i) world->addRigidBody(simple(box(origin + Vec2(0, -5 - 10 * i), 10, 10)));
        world->addSoftBody(square(origin + Vec2(200, -30), 40));
        run(*world, 10);
        std::vector<Vec2> places;
        for (const Vec2& at : world->bodies().position) places.push_back(at - origin);
        for (const Vec2& velocity : world->bodies().velocity) EXPECT_LT(velocity.norm(), 0.05 * kMetre);
        return places;
    };
    const std::vector<Vec2> here = rest({0, 0});
    for (const double far : {1e5, 1e6, 1e7})
        for (const Vec2& direction : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, -1)}) {
            const std::vector<Vec2> there = rest(far * direction);
            for (std::size_t i = 0; i < here.size(); ++i)
                EXPECT_NEAR((there[i] - here[i]).norm(), 0, 0.01) << "body " << i << " at " << far;
        }
}

}  // namespace

}  // namespace jet::physics::test
