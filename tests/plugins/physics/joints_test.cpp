// Joints between rigid bodies and the background, against the formulas of mechanics.
#include "scenes.hpp"

#include <jet/result.hpp>

#include <array>
#include <random>

namespace jet::physics::test {

namespace {

constexpr double kPi = 3.14159265358979323846;

RigidBodyDef disc(const Vec2& centre, double radius, double mass = 1)
{
    RigidBodyDef def;
    def.shapes = {{ShapeDef::Kind::Circle, {centre}, radius}};
    def.mass = mass;
    return def;
}

JointDef between(JointDef::Kind kind, BodyHandle a, const Vec2& atA, BodyHandle b, const Vec2& atB)
{
    JointDef def;
    def.kind = kind;
    def.a = {a, atA};
    def.b = {b, atB};
    return def;
}

TEST(Joints, APendulumSwingsInItsPeriod)
{
    // T = 2 pi sqrt((I + m l²) / (m g l)) for small swings; a disc has I = m r² / 2.
    const double g = 100, l = 50, r = 5;
    auto world = makeWorld({0, g});
    const double start = 0.05;
    const Vec2 at(l * std::sin(start), l * std::cos(start));
    const BodyHandle bob = world->addRigidBody(disc(at, r));
    world->addJoint(between(JointDef::Kind::Revolute, kNoHandle, {0, 0}, bob, {0, 0}));
    int crossings = 0;
    double first = 0, last = 0, before = at.x();
    for (int i = 1; i <= 1200; ++i) {
        world->step(kStep);
        const double x = world->bodies().position[bob].x();
        EXPECT_NEAR(world->bodies().position[bob].norm(), l, 0.02 * l);
        if (before > 0 && x <= 0) {
            last = (i - x / (x - before)) * kStep;
            if (crossings++ == 0) first = last;
        }
        before = x;
    }
    ASSERT_GT(crossings, 3);
    const double period = 2 * kPi * std::sqrt((r * r / 2 + l * l) / (g * l));
    EXPECT_NEAR((last - first) / (crossings - 1), period, 0.01 * period);
}

/// What swings about a point without friction keeps its speed, whatever holds it.
class SwingingJoints : public testing::TestWithParam<JointDef::Kind> {};

TEST_P(SwingingJoints, KeepTheirSpeed)
{
    const double arm = 40, speed = 5;  // rad / s: 4.8 degrees a step
    for (const bool amongSoft : {false, true}) {
        auto world = makeWorld({0, 0});
        RigidBodyDef bob = disc({arm, 0}, 5);
        bob.common.velocity = {0, arm * speed};
        bob.common.omega = speed;
        const BodyHandle body = world->addRigidBody(bob);
        if (amongSoft) world->addSoftBody(softBall({500, 0}, 40, 10, 0.1, 16, 2));
        const bool held = GetParam() == JointDef::Kind::Distance || GetParam() == JointDef::Kind::Rope;
        world->addJoint(between(GetParam(), kNoHandle, {0, 0}, body, held ? Vec2(arm, 0) : Vec2(0, 0)));
        for (int second = 1; second <= 20; ++second) {
            run(*world, 1);
            EXPECT_NEAR(world->bodies().position[body].norm(), arm, 1e-4 * arm) << "after " << second << " s";
            EXPECT_NEAR(world->bodies().velocity[body].norm(), arm * speed, 1e-4 * (second + 1) * arm * speed)
                << "after " << second << " s, soft bodies: " << amongSoft;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SwingingJoints,
                         testing::Values(JointDef::Kind::Revolute, JointDef::Kind::Distance, JointDef::Kind::Rope));

/// Of motion and of gravity, of bodies of mass 1.
double energyOf(const PhysicsWorld& world, const std::vector<BodyHandle>& bodies, double inertia, double g)
{
    double sum = 0;
    for (const BodyHandle body : bodies)
        sum += 0.5 * world.bodies().velocity[body].squaredNorm() +
               0.5 * inertia * world.bodies().omega[body] * world.bodies().omega[body] -
               g * world.bodies().position[body].y();
    return sum;
}

TEST(SwingingJoints, ADoublePendulumKeepsItsEnergy)
{
    // Two bars hinged together fall from the horizontal, over and over.
    const double g = 100, length = 40;
    for (const Precision precision : {Precision::Double, Precision::Single}) {
        WorldSettings settings;
        settings.gravity = {0, g};
        settings.precision = precision;
        auto world = JetPhysics().createWorld(settings);
        std::vector<BodyHandle> bars;
        for (int i = 0; i < 2; ++i) {
            bars.push_back(world->addRigidBody(simple(box({length * (0.5 + i), 0}, length, 4))));
            const Vec2 hinge(length * i, 0);
            world->addJoint(between(JointDef::Kind::Revolute, i == 0 ? kNoHandle : bars[i - 1], hinge, bars[i], hinge));
        }
        const double inertia = (length * length + 4 * 4) / 12;
        for (int i = 0; i < 1200; ++i) {
            world->step(kStep);
            ASSERT_NEAR(energyOf(*world, bars, inertia, g), 0, 0.01 * 2 * g * length) << "step " << i;
        }
    }
}

TEST(SwingingJoints, WhatSlidesOnATurningRailIsFlungOut)
{
    // Two bars joined by a rail turn about their common centre: r'' = omega² r, angular momentum and energy stay.
    auto world = makeWorld({0, 0});
    const double omega = 2, from = 30;
    std::vector<BodyHandle> bars;
    for (const double x : {-from, from}) {
        RigidBodyDef bar = simple(box({x, 0}, 20, 4));
        bar.common.velocity = {0, omega * x};
        bar.common.omega = omega;
        bars.push_back(world->addRigidBody(bar));
    }
    world->addJoint(between(JointDef::Kind::Prismatic, bars[0], {0, 0}, bars[1], {0, 0}));
    const double inertia = (20.0 * 20 + 4 * 4) / 12;
    const double start = energyOf(*world, bars, inertia, 0), momentum = 2 * (from * from + inertia) * omega;
    for (int i = 0; i < 120; ++i) {
        world->step(kStep);
        const auto& now = world->bodies();
        double turning = 0;
        for (const BodyHandle bar : bars) {
            const Vec2 at = now.position[bar], velocity = now.velocity[bar];
            turning += at.x() * velocity.y() - at.y() * velocity.x() + inertia * now.omega[bar];
        }
        ASSERT_NEAR(turning, momentum, 1e-5 * momentum) << "step " << i;
        ASSERT_NEAR(energyOf(*world, bars, inertia, 0), start, 1e-5 * start) << "step " << i;
        ASSERT_NEAR(now.angle[bars[0]], now.angle[bars[1]], 1e-5) << "step " << i;
    }
    EXPECT_GT(world->bodies().position[bars[1]].norm(), 4 * from);
}

TEST(SwingingJoints, APulleyPassesEnergyOn)
{
    // One end swings while the other goes up and down, by more than 20 units: thousands of energy.
    const double g = 100;
    auto world = makeWorld({0, g});
    const std::vector<BodyHandle> ends = {world->addRigidBody(disc({-80, 60}, 4)),
                                          world->addRigidBody(disc({40, 90}, 4))};
    JointDef def = between(JointDef::Kind::Pulley, ends[0], {-80, 60}, ends[1], {40, 90});
    def.groundA = {-40, 0}, def.groundB = {40, 0};
    world->addJoint(def);
    const double start = energyOf(*world, ends, 8, g), length = (Vec2(-80, 60) - def.groundA).norm() + 90;
    for (int i = 0; i < 240; ++i) {
        world->step(kStep);
        const double ropes = (world->bodies().position[ends[0]] - def.groundA).norm() +
                             (world->bodies().position[ends[1]] - def.groundB).norm();
        ASSERT_NEAR(ropes, length, 1e-4 * length) << "step " << i;
        ASSERT_NEAR(energyOf(*world, ends, 8, g), start, 3) << "step " << i;
    }
    EXPECT_LT(world->bodies().position[ends[1]].y(), 70);
}

TEST(SwingingJoints, AnUnevenPairKeepsItsAngularMomentum)
{
    // A light body welded to a heavy one at the end of a long arm, turning freely for ten seconds.
    const double heavy = 48, light = 1, reach = 60, omega = 9, inertia = (400.0 + 100) / 12;
    auto world = makeWorld({0, 0});
    const Vec2 centre(reach * light / (heavy + light), 0);
    const auto add = [&](const Vec2& at, double mass) {
        RigidBodyDef def = simple(box(at, 20, 10, mass));
        def.common.velocity = {0, omega * (at.x() - centre.x())};
        def.common.omega = omega;
        return world->addRigidBody(def);
    };
    const BodyHandle a = add({0, 0}, heavy), b = add({reach, 0}, light);
    world->addJoint(between(JointDef::Kind::Weld, a, {reach, 0}, b, {reach, 0}));
    const auto momentum = [&] {
        double sum = 0;
        for (const auto& [body, mass] : {std::pair(a, heavy), std::pair(b, light)}) {
            const Vec2 at = world->bodies().position[body], velocity = world->bodies().velocity[body];
            sum += mass * (at.x() * velocity.y() - at.y() * velocity.x() + inertia * world->bodies().omega[body]);
        }
        return sum;
    };
    const double start = momentum();
    run(*world, 10);
    EXPECT_NEAR(momentum(), start, 1e-6 * start);
    EXPECT_NEAR(world->bodies().omega[b], omega, 0.002 * omega);
}

struct Member {
    BodyHandle body = kNoHandle;
    double mass = 0, inertia = 0;
};

/// Bodies of mass 1 to 10 anywhere, held together by joints of every kind, at random; no gravity.
std::vector<Member> addMechanism(PhysicsWorld& world, std::mt19937& random)
{
    const auto number = [&](double from, double to) { return from + (to - from) * (random() / 4294967296.0); };
    std::vector<Member> members;
    std::vector<Vec2> places;
    const unsigned count = 2 + random() % 8;
    for (unsigned i = 0; i < count; ++i) {
        const Vec2 at(number(-50, 50), number(-50, 50));
        const double width = number(2, 30), height = number(2, 30);
        RigidBodyDef def = simple(box(at, width, height, std::pow(10, number(0, 1))));
        def.common.velocity = {number(-50, 50), number(-50, 50)};
        def.common.omega = number(-5, 5);
        const double inertia = def.mass * (width * width + height * height) / 12;
        members.push_back({world.addRigidBody(def), def.mass, inertia}), places.push_back(at);
    }
    using Kind = JointDef::Kind;
    for (unsigned joints = 1 + random() % count; joints > 0; --joints) {
        const Kind kind = std::array{Kind::Revolute, Kind::Prismatic, Kind::Weld,  Kind::Distance,
                                     Kind::Rope,     Kind::Wheel,     Kind::Pulley}[random() % 7];
        const unsigned a = random() % count, b = (a + 1 + random() % (count - 1)) % count;
        const bool apart = kind == Kind::Distance || kind == Kind::Rope || kind == Kind::Pulley;
        const Vec2 middle = 0.5 * (places[a] + places[b]) + Vec2(number(-10, 10), number(-10, 10));
        const BodyHandle first = kind != Kind::Pulley && random() % 4 == 0 ? kNoHandle : members[a].body;
        JointDef def = between(kind, first, apart ? places[a] : middle, members[b].body, apart ? places[b] : middle);
        def.groundA = {number(-80, 80), -100}, def.groundB = {number(-80, 80), -100};
        def.axis = {1, number(-1, 1)};
        if (random() % 3 == 0) def.limited = true, def.lower = -number(0, 3), def.upper = number(0, 3);
        world.addJoint(def);
    }
    return members;
}

TEST(SwingingJoints, MechanismsGatherNoEnergy)
{
    for (unsigned seed = 0; seed < 80; ++seed) {
        std::mt19937 random(seed);
        WorldSettings settings;
        settings.gravity = {0, 0};
        settings.precision = seed % 2 == 0 ? Precision::Double : Precision::Single;
        settings.findCollisions = false;
        settings.allowSleep = false;
        auto world = JetPhysics().createWorld(settings);
        const std::vector<Member> members = addMechanism(*world, random);
        const auto energy = [&] {
            double sum = 0;
            for (const auto& [body, mass, inertia] : members)
                sum += 0.5 * mass * world->bodies().velocity[body].squaredNorm() +
                       0.5 * inertia * std::pow(world->bodies().omega[body], 2);
            return sum;
        };
        const double start = energy();
        for (int i = 0; i < 240; ++i) {
            world->step(kStep);
            ASSERT_LE(energy(), 1.02 * start) << "mechanism " << seed << ", step " << i;
        }
    }
}

TEST(Joints, AMotorReachesItsSpeedAndItsTorqueIsLimited)
{
    auto world = makeWorld({0, 0});
    const BodyHandle wheel = world->addRigidBody(disc({0, 0}, 10, 2));
    JointDef def = between(JointDef::Kind::Revolute, kNoHandle, {0, 0}, wheel, {0, 0});
    def.driven = true;
    def.motorSpeed = 3;
    def.maxTorque = 50;
    const JointHandle motor = world->addJoint(def);
    run(*world, 0.5);
    EXPECT_NEAR(world->bodies().omega[wheel], 50 * 0.5 / (2 * 100 / 2.0), 1e-3) << "omega = torque t / I";
    run(*world, 10);
    EXPECT_NEAR(world->bodies().omega[wheel], 3, 1e-6);
    world->setMotor(motor, true, -1);
    run(*world, 10);
    EXPECT_NEAR(world->bodies().omega[wheel], -1, 1e-6);
}

TEST(Joints, LimitsHoldAHangingLever)
{
    auto world = makeWorld({0, 200});
    const BodyHandle lever = world->addRigidBody(simple(box({20, 0}, 40, 6)));
    JointDef def = between(JointDef::Kind::Revolute, kNoHandle, {0, 0}, lever, {0, 0});
    def.limited = true;
    def.lower = -0.2, def.upper = 0.5;
    const JointHandle hinge = world->addJoint(def);
    run(*world, 4);
    EXPECT_NEAR(world->joint(hinge).value, 0.5, 0.01);
    EXPECT_LT(std::abs(world->bodies().omega[lever]), 0.05);
}

TEST(Joints, APrismaticJointSlidesOnlyAlongItsAxis)
{
    auto world = makeWorld({0, 100});
    const BodyHandle slider = world->addRigidBody(simple(box({0, 0}, 10, 10)));
    JointDef def = between(JointDef::Kind::Prismatic, kNoHandle, {0, 0}, slider, {0, 0});
    def.axis = {1, 1};
    def.limited = true;
    def.lower = -10, def.upper = 30;
    const JointHandle rail = world->addJoint(def);
    run(*world, 0.25);
    const Vec2 at = world->bodies().position[slider];
    EXPECT_NEAR(at.x(), at.y(), 0.05) << "the rail is oblique";
    EXPECT_NEAR(at.x(), 0.5 * 50 * 0.0625, 0.1) << "a = g cos 45 along the rail";
    run(*world, 4);
    EXPECT_NEAR(world->joint(rail).value, 30, 0.2);
    EXPECT_NEAR(world->bodies().angle[slider], 0, 1e-3);
}

TEST(Joints, AWeldHoldsACantilever)
{
    auto world = makeWorld({0, 100});
    const BodyHandle beam = world->addRigidBody(simple(box({20, 0}, 40, 8)));
    world->addJoint(between(JointDef::Kind::Weld, kNoHandle, {0, 0}, beam, {0, 0}));
    run(*world, 3);
    EXPECT_NEAR(world->bodies().angle[beam], 0, 0.01);
    EXPECT_NEAR((world->bodies().position[beam] - Vec2(20, 0)).norm(), 0, 0.3);
}

TEST(Joints, ADistanceSpringSwingsAtItsFrequencyAndARopeDoesNotPush)
{
    auto world = makeWorld({0, 0});
    const BodyHandle ball = world->addRigidBody(disc({0, 30}, 3));
    JointDef spring = between(JointDef::Kind::Distance, kNoHandle, {0, 0}, ball, {0, 30});
    spring.hertz = 2, spring.dampingRatio = 0.0, spring.length = 25;
    world->addJoint(spring);
    double least = 1e9, most = 0;
    for (int i = 0; i < 120; ++i) {
        world->step(kStep);
        least = std::min(least, world->bodies().position[ball].y());
        most = std::max(most, world->bodies().position[ball].y());
    }
    EXPECT_NEAR(0.5 * (least + most), 25, 1.0);
    EXPECT_LT(most, 30.5) << "it gains no energy";

    auto roped = makeWorld({0, 100});
    const BodyHandle weight = roped->addRigidBody(disc({10, 0}, 3));
    JointDef rope = between(JointDef::Kind::Rope, kNoHandle, {0, 0}, weight, {10, 0});
    rope.length = 40;
    roped->addJoint(rope);
    roped->step(kStep);
    EXPECT_NEAR(roped->bodies().velocity[weight].y(), 100 * kStep, 1e-9) << "slack, it falls freely";
    run(*roped, 10);
    EXPECT_LT(roped->bodies().position[weight].norm(), 40.5);
}

TEST(Joints, APulleyKeepsTheLengthOfItsRope)
{
    auto world = makeWorld({0, 100});
    const BodyHandle light = world->addRigidBody(disc({-20, 60}, 3, 1)),
                     heavy = world->addRigidBody(disc({20, 60}, 3, 3));
    JointDef def = between(JointDef::Kind::Pulley, light, {-20, 60}, heavy, {20, 60});
    def.groundA = {-20, 0}, def.groundB = {20, 0};
    world->addJoint(def);
    run(*world, 0.5);
    const double lightRope = world->bodies().position[light].y(), heavyRope = world->bodies().position[heavy].y();
    EXPECT_NEAR(lightRope + heavyRope, 120, 0.1);
    // Atwood's machine: a = g (M - m) / (M + m).
    EXPECT_NEAR(heavyRope, 60 + 0.5 * 50 * 0.25, 0.2);
}

TEST(Joints, AJointBreaksAboveItsForce)
{
    auto world = makeWorld({0, 100});
    const BodyHandle held = world->addRigidBody(disc({0, 20}, 3, 2)), lost = world->addRigidBody(disc({100, 20}, 3, 6));
    JointDef def = between(JointDef::Kind::Rope, kNoHandle, {0, 0}, held, {0, 20});
    def.breakForce = 400;
    const JointHandle first = world->addJoint(def);
    def.a.point = {100, 0}, def.b = {lost, {100, 20}};
    const JointHandle second = world->addJoint(def);
    run(*world, 2);
    EXPECT_FALSE(world->joint(first).broken) << "200 hang on it";
    EXPECT_TRUE(world->joint(second).broken) << "600 hung on it";
    EXPECT_GT(world->bodies().position[lost].y(), 100);
    EXPECT_LT(world->bodies().position[held].y(), 21);
}

TEST(Joints, EachKindBreaksExactlyAboveItsForce)
{
    // A weight of 200 that rests in the joint from the start: a thousandth more is borne, a thousandth less is not.
    using Kind = JointDef::Kind;
    for (const Kind kind : {Kind::Revolute, Kind::Prismatic, Kind::Weld, Kind::Distance, Kind::Rope, Kind::Wheel,
                            Kind::Motor, Kind::Pulley}) {
        for (const double part : {0.999, 1.001}) {
            auto world = makeWorld({0, 100});
            const BodyHandle body = world->addRigidBody(simple(box({0, 0}, 20, 20, 2)));
            JointDef def = between(kind, kNoHandle, {0, 0}, body, {0, 0});
            if (kind == Kind::Distance || kind == Kind::Rope) def.a.point = {0, -50};
            if (kind == Kind::Motor) def.driven = true, def.maxForce = def.maxTorque = 1e6;
            if (kind == Kind::Pulley) {
                def.a = {world->addRigidBody(simple(box({100, 0}, 20, 20, 2))), {100, 0}};
                def.groundA = {100, -60}, def.groundB = {0, -60};
            }
            def.breakForce = part * 200;
            const JointHandle joint = world->addJoint(def);
            run(*world, 3);
            EXPECT_EQ(world->joint(joint).broken, part < 1) << static_cast<int>(kind) << " " << part;
            EXPECT_NEAR(world->joint(joint).force.norm(), part < 1 ? 0 : 200, 0.02) << static_cast<int>(kind);
            EXPECT_EQ(world->bodies().position[body].y() > 100, part < 1) << static_cast<int>(kind);
        }
    }
}

TEST(Joints, TwoBodiesThatCannotMoveAreNoTrouble)
{
    auto world = makeWorld({0, 100});
    const BodyHandle a = world->addRigidBody(simple(fixed({boxRing({0, 0}, 10, 10)})));
    const BodyHandle b = world->addRigidBody(simple(fixed({boxRing({20, 0}, 10, 10)})));
    world->addJoint(between(JointDef::Kind::Revolute, a, {10, 0}, b, {11, 0}));
    run(*world, 1);
    EXPECT_TRUE(allFinite(*world));
    EXPECT_THROW(world->addJoint(between(JointDef::Kind::Revolute, a, {0, 0}, a, {0, 0})), Failure);
}

TEST(Joints, ShortRopesAndRodsGiveNoEnergy)
{
    // Their direction turns by much, and over, within a substep.
    for (const JointDef::Kind kind : {JointDef::Kind::Rope, JointDef::Kind::Distance}) {
        for (const double length : {0.0, 0.01, 0.1, 0.3, 1.0, 3.0}) {
            for (const double step : {1.0 / 30, kStep, 1.0 / 1000}) {
                auto world = makeWorld({0, 98.1});
                world->addRigidBody(simple(box({length + 6, 5}, 20, 20)));
                JointDef joint;
                joint.kind = kind;
                joint.b = {0, {length, 0}};
                world->addJoint(joint);
                double most = 0;
                for (int i = 0; i < 600; ++i) {
                    world->step(step);
                    const double omega = world->bodies().omega[0];
                    most = std::max(most, 0.5 * world->bodies().velocity[0].squaredNorm() +
                                              0.5 * 800 / 12 * omega * omega -
                                              98.1 * (world->bodies().position[0].y() - 5));
                }
                EXPECT_LT(most, 0.02 * 98.1 * 20) << static_cast<int>(kind) << " " << length << " " << step;
            }
        }
    }
}

/// A box on the ground, and one above it, a little apart.
std::unique_ptr<PhysicsWorld> twoBoxes(double apart)
{
    auto world = makeWorld({0, 98.1});
    world->addRigidBody(simple(ground(0)));
    world->addRigidBody(simple(box({0, -10}, 20, 20)));
    world->addRigidBody(simple(box({0, -30 - apart}, 20, 20)));
    return world;
}

JointDef between(JointDef::Kind kind, const Vec2& point)
{
    JointDef def;
    def.kind = kind;
    def.a = {1, point}, def.b = {2, point};
    return def;
}

TEST(Joints, WhatAJointHoldsNoLongerIsMetAtOnce)
{
    for (const bool breaks : {false, true}) {
        auto world = twoBoxes(0.5);
        const JointHandle weld = world->addJoint(between(JointDef::Kind::Weld, {0, -20}));
        run(*world, 1);
        EXPECT_FALSE(world->touching(1, 2));
        if (breaks) {
            JointDef weak = between(JointDef::Kind::Weld, {0, -20});
            weak.breakForce = 1;
            world->setJoint(weld, weak);
        } else {
            world->removeJoint(weld);
        }
        run(*world, 2);
        if (breaks) {
            EXPECT_TRUE(world->joint(weld).broken);
        } else {
            EXPECT_THROW(world->joint(weld), Failure) << "a removed one is none";
        }
        EXPECT_NEAR(world->bodies().position[2].y(), -30, 0.1) << "it stands on the lower one";
        EXPECT_TRUE(world->touching(1, 2));
    }
}

TEST(Joints, ANewJointEndsTheTouchOfWhatItHolds)
{
    auto world = twoBoxes(0);
    run(*world, 1);
    ASSERT_TRUE(world->touching(1, 2));
    world->addJoint(between(JointDef::Kind::Revolute, {0, -20}));
    world->setOmega(2, 6);
    run(*world, 0.3);
    EXPECT_FALSE(world->touching(1, 2));
    EXPECT_GT(world->bodies().angle[2], 0.5) << "its corner goes through the lower one";
}

TEST(Joints, BodiesPassEachOtherUntilTheLastJointThatSaysSoIsGone)
{
    auto world = twoBoxes(-5);
    const JointHandle weld = world->addJoint(between(JointDef::Kind::Weld, {0, -18}));
    const JointHandle rope = world->addJoint(between(JointDef::Kind::Rope, {0, -18}));
    run(*world, 0.5);
    world->removeJoint(weld);
    run(*world, 0.5);
    EXPECT_FALSE(world->touching(1, 2));
    world->removeJoint(rope);
    world->step(kStep);
    EXPECT_TRUE(world->touching(1, 2));
}

TEST(Joints, BodiesPassEachOtherAgainInAWorldRestoredToBeforeTheBreak)
{
    auto world = twoBoxes(-5);
    JointDef weak = between(JointDef::Kind::Weld, {0, -18});
    weak.breakForce = 1e5;
    world->addJoint(weak);
    run(*world, 0.5);
    const auto whole = world->save();
    run(*world, 0.5);
    const auto future = world->hash();
    world->restore(whole);
    world->applyForce(2, {0, -1e7});
    run(*world, 0.5);
    ASSERT_TRUE(world->joint(0).broken);
    world->restore(whole);
    run(*world, 0.5);
    EXPECT_FALSE(world->touching(1, 2));
    EXPECT_EQ(world->hash(), future);
}

TEST(Joints, AMouseJointBringsABodyToItsTarget)
{
    auto world = makeWorld({0, 0});
    const BodyHandle body = world->addRigidBody(disc({0, 0}, 5));
    JointDef def = between(JointDef::Kind::Mouse, kNoHandle, {0, 0}, body, {0, 0});
    def.hertz = 5, def.dampingRatio = 1, def.maxForce = 1e6;
    const JointHandle mouse = world->addJoint(def);
    world->setJointTarget(mouse, {40, -30});
    run(*world, 3);
    EXPECT_NEAR((world->bodies().position[body] - Vec2(40, -30)).norm(), 0, 0.1);
}

}  // namespace

}  // namespace jet::physics::test
