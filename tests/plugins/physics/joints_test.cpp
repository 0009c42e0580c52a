// Joints between rigid bodies and the background, against the formulas of mechanics.
#include "scenes.hpp"

#include <jet/result.hpp>

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
