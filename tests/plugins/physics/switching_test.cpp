// Bodies that become something else, or are switched off and on, while the world runs.
#include "shape_worlds.hpp"

#include <jet/result.hpp>

#include <functional>

namespace jet::physics::test {

namespace {

using Become = std::function<void(BodyCommon&)>;

/// A box and a ball on the ground beside a shelf with a box on it; `which` becomes another.
std::unique_ptr<PhysicsWorld> smallWorld(bool drawn, BodyHandle which, const Become& become)
{
    WorldSettings settings;
    settings.gravity = {20, 100};
    settings.materialCount = 2;
    settings.materials = {{0.6, 0, true}, {0.05, 0.5, true}, {0.05, 0.5, true}, {0.05, 0.5, true}};
    auto world = JetPhysics().createWorld(settings);
    std::vector<RigidBodyDef> defs = {ground(0), box({0, -6}, 20, 12), box({3, -20}, 12, 12, 2, 0.2),
                                      box({60, -20}, 40, 4), box({55, -30}, 10, 12)};
    defs[3].common.kinematic = true;
    for (BodyHandle i = 0; i < defs.size(); ++i) {
        if (i == which) become(defs[i].common);
        world->addRigidBody(drawn ? defs[i] : simple(defs[i]));
    }
    return world;
}

void expectAsIfAddedSo(BodyHandle which, const Become& become)
{
    for (const bool drawn : {false, true}) {
        const auto wanted = smallWorld(drawn, which, become);
        const auto changed = smallWorld(drawn, which, [](BodyCommon&) {});
        BodyCommon common;
        common.kinematic = which == 3;
        become(common);
        changed->setBody(which, common);
        changed->setVelocity(which, common.velocity);
        for (int i = 0; i < 90; ++i) {
            wanted->step(kStep), changed->step(kStep);
            for (BodyHandle b = 0; b < wanted->bodyCount(); ++b) {
                const double off = (wanted->bodies().position[b] - changed->bodies().position[b]).norm();
                ASSERT_NEAR(off, 0, 1e-7) << (drawn ? "drawn, step " : "simple, step ") << i << ", body " << b;
                ASSERT_NEAR(wanted->bodies().angle[b], changed->bodies().angle[b], 1e-7) << i << ", body " << b;
            }
        }
    }
}

std::size_t countEvents(const PhysicsWorld& world, BodyHandle a, BodyHandle b, bool begins)
{
    const auto events = world.contactEvents();
    return static_cast<std::size_t>(std::count_if(events.begin(), events.end(), [&](const ContactEvent& e) {
        return e.bodyA == a && e.bodyB == b && e.begins == begins;
    }));
}

TEST(SetBody, EveryPropertyOfARigidBodyCountsAsIfItHadBeenSo)
{
    expectAsIfAddedSo(1, [](BodyCommon& c) { c.material = 1; });
    expectAsIfAddedSo(1, [](BodyCommon& c) { c.gravityScale = -0.5; });
    expectAsIfAddedSo(1, [](BodyCommon& c) { c.mask = 0; });
    expectAsIfAddedSo(2, [](BodyCommon& c) { c.layer = 0; });
    expectAsIfAddedSo(2, [](BodyCommon& c) { c.fixedRotation = true; });
    expectAsIfAddedSo(1, [](BodyCommon& c) { c.sensor = true; });
    expectAsIfAddedSo(1, [](BodyCommon& c) { c.kinematic = true, c.velocity = {5, 0}; });
    expectAsIfAddedSo(3, [](BodyCommon& c) { c.kinematic = false; });
    expectAsIfAddedSo(3, [](BodyCommon& c) { c.oneSided = {0, 1}; });
    const auto world = smallWorld(false, 0, [](BodyCommon&) {});
    BodyCommon wrong;
    wrong.material = 2;
    EXPECT_THROW(world->setBody(1, wrong), Failure);
    EXPECT_THROW(world->setBody(0, BodyCommon()), Failure) << "the ground cannot become free";
    EXPECT_THROW(world->setBody(9, BodyCommon()), Failure);
}

TEST(SetBody, BodiesOfAGroupThatIsGivenLaterPassEachOther)
{
    const auto world = smallWorld(false, 0, [](BodyCommon&) {});
    run(*world, 0.5);
    ASSERT_TRUE(world->touching(1, 2));
    BodyCommon common;
    common.group = 4;
    world->setBody(1, common), world->setBody(2, common);
    world->step(kStep);
    EXPECT_EQ(countEvents(*world, 1, 2, false), 1U) << "they ceased to touch";
    run(*world, 1);
    EXPECT_FALSE(world->touching(1, 2));
    EXPECT_GT(world->bodies().position[2].y(), -8) << "it sank through the lower one, onto the ground";
}

TEST(SetBody, WhatTouchesAsBeforeHasNotParted)
{
    const auto world = smallWorld(false, 0, [](BodyCommon&) {});
    run(*world, 0.5);
    ASSERT_TRUE(world->touching(0, 1));
    BodyCommon common;
    common.material = 1;
    world->setBody(1, common);
    world->step(kStep);
    EXPECT_TRUE(world->touching(0, 1));
    EXPECT_EQ(countEvents(*world, 0, 1, true) + countEvents(*world, 0, 1, false), 0U);
}

TEST(SetBody, WakesWhatSleepsOnTheBody)
{
    const auto world = makeWorld({0, 100});
    RigidBodyDef shelf = simple(box({0, 5}, 100, 10));
    shelf.common.kinematic = true;
    world->addRigidBody(shelf);
    const BodyHandle sleeper = world->addRigidBody(simple(box({0, -5}, 10, 10)));
    run(*world, 4);
    ASSERT_FALSE(world->awake(sleeper));
    world->setBody(sleeper, BodyCommon());
    world->setBody(0, shelf.common);
    world->setMass(sleeper, 1);
    EXPECT_FALSE(world->awake(sleeper)) << "setting what is set wakes nobody";
    BodyCommon ghost;
    ghost.kinematic = true, ghost.mask = 0;
    world->setBody(0, ghost);
    run(*world, 1);
    EXPECT_GT(world->bodies().position[sleeper].y(), 40) << "it fell";
}

TEST(SetEnabled, ABodySwitchedOffMeetsNothingIsNotSeenAndStandsStill)
{
    for (const bool drawn : {false, true}) {
        const auto world = makeWorld({0, 100});
        const auto made = [&](const RigidBodyDef& def) { return world->addRigidBody(drawn ? def : simple(def)); };
        const BodyHandle shelf = made(fixed({boxRing({0, 5}, 100, 10)})), load = made(box({0, -5}, 10, 10));
        run(*world, 4);
        ASSERT_FALSE(world->awake(load));
        world->setEnabled(shelf, false);
        EXPECT_TRUE(world->overlapping(Box({-40, 2}, {-30, 8}), {}).empty());
        EXPECT_FALSE(world->contains(shelf, {-30, 5}));
        world->step(kStep);
        EXPECT_EQ(countEvents(*world, shelf, load, false), 1U);
        run(*world, 0.5);
        EXPECT_GT(world->bodies().position[load].y(), 5) << "it fell through";
        world->setEnabled(load, false);
        const Vec2 there = world->bodies().position[load];
        run(*world, 1);
        EXPECT_EQ((world->bodies().position[load] - there).norm(), 0);
        world->setEnabled(load, true);
        world->step(kStep);
        EXPECT_NEAR(world->bodies().velocity[load].y(), 100 * kStep, 1e-9) << "from rest";
        world->setPosition(load, {0, -20});
        world->setEnabled(shelf, true);
        run(*world, 2);
        EXPECT_NEAR(world->bodies().position[load].y(), -5, 0.05) << "the shelf holds again";
    }
}

TEST(SetEnabled, JointsAndSpringsToABodySwitchedOffHoldNothing)
{
    const auto world = makeWorld({0, 100});
    const BodyHandle hook = world->addRigidBody(simple(fixed({boxRing({0, 0}, 4, 4)})));
    const BodyHandle hung = world->addRigidBody(simple(box({0, 20}, 4, 4)));
    const BodyHandle sprung = world->addRigidBody(simple(box({40, 20}, 4, 4)));
    JointDef joint;
    joint.kind = JointDef::Kind::Distance;
    joint.a = {hook, {0, 0}}, joint.b = {hung, {0, 20}};
    world->addJoint(joint);
    SpringActuatorDef spring;
    spring.a = {hook, {40, 0}}, spring.b = {sprung, {40, 20}}, spring.ks = 100;
    world->addSpring(spring);
    run(*world, 0.5);
    EXPECT_NEAR(world->bodies().position[hung].y(), 20, 0.1);
    EXPECT_LT(world->bodies().position[sprung].y(), 24);
    world->setEnabled(hook, false);
    const double from = world->bodies().position[hung].y();
    run(*world, 1);
    EXPECT_NEAR(world->bodies().position[hung].y() - from, 50, 2) << "free fall, 100 t² / 2";
    EXPECT_GT(world->bodies().position[sprung].y(), 60);
}

TEST(SetEnabled, ASoftBodyKeepsItsPins)
{
    const auto world = makeWorld({0, 100});
    const BodyHandle ball = world->addSoftBody(softBall({0, 0}, 10));
    const BodyHandle load = world->addRigidBody(simple(box({0, -20}, 6, 6)));
    world->setPinned(ball, 0, true);
    world->setPinned(ball, 3, true);
    run(*world, 0.5);
    world->setEnabled(ball, false);
    const std::vector<Vec2> there(world->bodies().points.begin(), world->bodies().points.end());
    world->setPinned(ball, 3, false);
    run(*world, 1);
    const std::uint32_t first = world->bodies().firstPoint[ball], count = world->bodies().firstPoint[ball + 1] - first;
    for (std::uint32_t p = first; p < first + count; ++p) ASSERT_EQ(world->bodies().points[p], there[p]);
    EXPECT_GT(world->bodies().position[load].y(), 20) << "it fell through the ball";
    world->setEnabled(ball, true);
    run(*world, 1);
    EXPECT_EQ(world->bodies().points[first], there[first]) << "still pinned";
    EXPECT_NE(world->bodies().points[first + 3], there[first + 3]) << "pinned no more";
}

TEST(SetEnabled, BelongsToTheStateThatIsSaved)
{
    const auto world = pyramidWorld(shapeSettings(), 12);
    const BodyHandle ball = world->addSoftBody(softBall({200, -50}, 10));
    run(*world, 0.2);
    const auto whole = world->save();
    run(*world, 0.3);
    const auto standing = world->hash();
    world->restore(whole);
    world->setEnabled(30, false);
    world->setEnabled(ball, false);
    BodyCommon ghost;
    ghost.mask = 0;
    world->setBody(40, ghost);
    const auto holed = world->save();
    run(*world, 0.3);
    const auto fallen = world->hash();
    EXPECT_NE(fallen, standing);
    world->restore(whole);
    run(*world, 0.3);
    EXPECT_EQ(world->hash(), standing);
    world->restore(holed);
    run(*world, 0.3);
    EXPECT_EQ(world->hash(), fallen);
    const auto other = pyramidWorld(shapeSettings(), 12);
    other->addSoftBody(softBall({200, -50}, 10));
    other->restore(holed);
    run(*other, 0.3);
    EXPECT_EQ(other->hash(), fallen) << "in a world just built";
}

TEST(SetEnabled, BitsDoNotDependOnThreadsNorInstructions)
{
    const auto future = [](int threads, Simd simd) {
        const auto world = pyramidWorld(shapeSettings(threads, simd));
        for (int i = 0; i < 60; ++i) {
            if (i % 10 == 5) world->setEnabled(static_cast<BodyHandle>(1 + 7 * i), false);
            if (i == 40) world->setEnabled(36, true);
            world->step(kStep);
        }
        return world->hash();
    };
    const auto expected = future(1, Simd::Sse2);
    EXPECT_EQ(future(2, Simd::Sse2), expected);
    EXPECT_EQ(future(2, Simd::Automatic), expected);
}

}  // namespace

}  // namespace jet::physics::test
