// What is particular to this engine: snapshots by playing again, what it refuses, speed limits. How well it computes is
// measured by tests/physics-conformance.
#include "world.hpp"

#include <jet/result.hpp>

#include <gtest/gtest.h>

namespace jet::box2d {

namespace {

constexpr double kStep = 1.0 / 60;

RigidBodyDef disc(const Vec2& at, double radius)
{
    RigidBodyDef def;
    def.shapes = {{ShapeDef::Kind::Circle, {at}, radius}};
    return def;
}

std::string refusalOf(const std::function<void()>& attempt)
{
    try {
        attempt();
    } catch (const Failure& failure) {
        return failure.error().message;
    }
    return "nothing was refused";
}

TEST(Box2dWorld, SoftBodiesAreRefusedWithTheWayOut)
{
    World world{WorldSettings()};
    const std::string refusal = refusalOf([&] { world.addSoftBody({}); });
    EXPECT_NE(refusal.find("soft bodies"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("jet-physics"), std::string::npos) << refusal;
    EXPECT_EQ(world.bodyCount(), 0u);
}

TEST(Box2dWorld, ARefusedBodyLeavesNothingBehind)
{
    World world{WorldSettings()};
    RigidBodyDef hair;
    hair.borders = {{{0, 0}, {100, 0}, {100, 0.01}}};
    EXPECT_NE(refusalOf([&] { world.addRigidBody(hair); }).find("thin"), std::string::npos);
    EXPECT_EQ(world.bodyCount(), 0u);
    EXPECT_EQ(world.addRigidBody(disc({0, 0}, 5)), 0u);
    world.step(kStep);
}

/// Else adding them takes minutes: crossings, holes and neighbours are sought by their square.
TEST(Box2dWorld, OutlinesThatAreTooIntricateAreRefused)
{
    World world(WorldSettings{});
    RigidBodyDef rings;
    rings.common.fixed = true;
    for (int i = 0; i < 4000; ++i) {
        const double x = 3.0 * (i % 100), y = 3.0 * (i / 100);
        rings.borders.push_back({{x, y}, {x + 2, y}, {x, y + 2}});
    }
    EXPECT_NE(refusalOf([&] { world.addRigidBody(rings); }).find("body 0: its outline has 12000 corners"),
              std::string::npos);
    RigidBodyDef scribble;
    auto& ring = scribble.borders.emplace_back();
    for (int i = 0; i < 1000; ++i) ring.push_back({i * 7919 % 601 * 1.0, i * 104729 % 307 * 1.0});
    const std::string refusal = refusalOf([&] { world.addRigidBody(scribble); });
    EXPECT_NE(refusal.find("3000 trapezoids"), std::string::npos) << refusal;
    EXPECT_EQ(world.bodyCount(), 0u);
}

TEST(Box2dWorld, ABodyDoesNotBecomeFixedWhileTheWorldRuns)
{
    World world{WorldSettings()};
    const BodyHandle body = world.addRigidBody(disc({0, 0}, 5));
    BodyCommon common;
    common.fixed = true;
    EXPECT_NE(refusalOf([&] { world.setBody(body, common); }).find("body 0 cannot become fixed"), std::string::npos);
    world.step(kStep);
    EXPECT_GT(world.bodies().velocity[body].y(), 0);
}

TEST(Box2dWorld, QueriesThatBeginWithinABodyHaveAUnitNormal)
{
    World world{WorldSettings()};
    RigidBodyDef box;
    box.shapes = {{ShapeDef::Kind::Polygon, {{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}, 0}};
    const BodyHandle body = world.addRigidBody(box);
    for (const Vec2& way : {Vec2(30, 40), Vec2(0, 0)}) {
        const auto hit = world.shapeCast({ShapeDef::Kind::Circle, {{3, 4}}, 2}, way, {});
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->fraction, 0);
        EXPECT_NEAR(hit->normal.norm(), 1, 1e-9);
        EXPECT_LE(hit->normal.dot(way), 0);
    }
    EXPECT_NEAR(world.nearest({3, 4}, 20, {})->normal.norm(), 1, 1e-6);
    EXPECT_TRUE(world.overlapping(Box(), {}).empty());
    EXPECT_TRUE(world.contains(body, {3, 4}));
    world.setEnabled(body, false);
    EXPECT_FALSE(world.contains(body, {3, 4})) << "what is switched off is not seen";
}

TEST(Box2dWorld, AStepThatFloatsCannotHoldIsRefusedWithItsBodyAndChangesNothing)
{
    World world{WorldSettings()};
    for (const double x : {0.0, 20.0}) {
        RigidBodyDef heavy = disc({x, 0}, 5);
        heavy.mass = 1e12;
        world.addRigidBody(heavy);
    }
    JointDef joint;
    joint.kind = JointDef::Kind::Distance;
    joint.a = {0, {0, 0}, 0}, joint.b = {1, {20, 0}, 0};
    joint.hertz = 1e15;  // mass times its square is more than a float holds
    joint.length = 30;
    world.addJoint(joint);
    const std::uint64_t before = world.hash();
    const std::string refusal = refusalOf([&] {
        for (int i = 0; i < 5; ++i) world.step(kStep);
    });
    EXPECT_NE(refusal.find("body "), std::string::npos) << refusal;
    EXPECT_EQ(world.hash(), before);
    for (const Vec2& at : world.bodies().position) EXPECT_TRUE(isFinite(at));
}

TEST(Box2dWorld, ASnapshotHoldsWhatWasDoneInBetween)
{
    World world{WorldSettings()};
    const BodyHandle body = world.addRigidBody(disc({0, 0}, 5));
    const ActuatorHandle torque = world.addTorque({{body, {0, 0}, 0}, 0});
    for (int i = 0; i < 30; ++i) world.step(kStep);
    world.setTorque(torque, 500);
    world.setVelocity(body, {70, 0});
    for (int i = 0; i < 30; ++i) world.step(kStep);
    const std::vector<std::byte> state = world.save();
    const std::uint64_t saved = world.hash();
    world.applyImpulse(body, {0, -300});
    for (int i = 0; i < 30; ++i) world.step(kStep);
    ASSERT_NE(world.hash(), saved);
    world.restore(state);
    EXPECT_EQ(world.hash(), saved);
    EXPECT_GT(world.bodies().omega[body], 1);
    EXPECT_EQ(world.save(), state) << "the past is the same, too";
}

TEST(Box2dWorld, RestoringForwardsGoesOnFromThePresent)
{
    World ahead{WorldSettings()}, behind{WorldSettings()};
    for (World* world : {&ahead, &behind}) world->addRigidBody(disc({0, 0}, 5));
    for (int i = 0; i < 100; ++i) ahead.step(kStep);
    for (int i = 0; i < 40; ++i) behind.step(kStep);
    behind.restore(ahead.save());
    EXPECT_EQ(behind.hash(), ahead.hash());
}

TEST(Box2dWorld, AStateThatNamesWhatIsNotThereIsRefusedAndChangesNothing)
{
    World world{WorldSettings()};
    world.addRigidBody(disc({0, 0}, 5));
    for (int i = 0; i < 10; ++i) world.step(kStep);
    const std::uint64_t before = world.hash();
    History forged = History::read(world.save());
    forged.add({Deed::Step, 0, 5, 0, kStep, 0});
    forged.add({Deed::SetVelocity, 77, 1, 0, 1, 0});
    EXPECT_NE(refusalOf([&] { world.restore(forged.bytes()); }).find("body 77"), std::string::npos);
    EXPECT_EQ(world.hash(), before);
    world.step(kStep);
}

TEST(History, StepsWithoutAnythingBetweenAreOneEntry)
{
    History history;
    for (int i = 0; i < 1000; ++i) history.add({Deed::Step, 0, 1, 0, kStep, 0});
    history.add({Deed::Wake, 3, 1, 0, 0, 0});
    history.add({Deed::Step, 0, 1, 0, kStep, 0});
    EXPECT_EQ(history.entries().size(), 3u);
    EXPECT_LT(history.bytes().size(), 200u);

    History past;
    for (int i = 0; i < 600; ++i) past.add({Deed::Step, 0, 1, 0, kStep, 0});
    std::vector<Entry> rest;
    ASSERT_TRUE(history.continues(past, rest));
    ASSERT_EQ(rest.size(), 3u);
    EXPECT_EQ(rest[0].count, 400u);
    past.add({Deed::Wake, 4, 1, 0, 0, 0});
    EXPECT_FALSE(history.continues(past, rest)) << "another body was woken";
}

TEST(Box2dWorld, FastBodiesAreNotSlowedDown)
{
    WorldSettings settings;
    settings.gravity = {0, 0};
    World world(settings);
    RigidBodyDef def = disc({0, 0}, 5);
    def.common.velocity = {20000, 0};
    const BodyHandle body = world.addRigidBody(def);
    for (int i = 0; i < 60; ++i) world.step(kStep);
    EXPECT_NEAR(world.bodies().position[body].x(), 20000, 20) << "Box2D alone would go 1,200";
}

}  // namespace

}  // namespace jet::box2d
