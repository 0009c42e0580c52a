// What is changed while a world runs goes on as if it had been so from the start.
#include "scenes.hpp"

#include <jet/result.hpp>

namespace jet::physics::test {

namespace {

/// Runs two worlds of the same scene, one made as wanted, one changed to it before the first step.
template <class Make, class Change>
void expectTheSameFuture(Make&& make, Change&& change, double seconds = 2)
{
    auto wanted = make(true), changed = make(false);
    change(*changed);
    for (int i = 0; i < static_cast<int>(seconds / kStep); ++i) {
        wanted->step(kStep), changed->step(kStep);
        for (BodyHandle b = 0; b < wanted->bodyCount(); ++b) {
            ASSERT_NEAR((wanted->bodies().position[b] - changed->bodies().position[b]).norm(), 0, 1e-7)
                << i << " " << b;
            ASSERT_NEAR(wanted->bodies().angle[b], changed->bodies().angle[b], 1e-7) << i << " " << b;
        }
    }
}

TEST(LiveChanges, SettingsCountFromTheNextStep)
{
    const auto settings = [](bool wanted) {
        WorldSettings s;
        s.gravity = wanted ? Vec2(40, 200) : Vec2(0, 100);
        s.linearDamping = wanted ? 0.3 : 0;
        s.materials = {wanted ? MaterialPair{0.1, 0.6, true} : MaterialPair{0.9, 0, true}};
        return s;
    };
    const auto make = [&](bool wanted) {
        auto world = JetPhysics().createWorld(settings(wanted));
        world->addRigidBody(ground(0));
        world->addRigidBody(box({0, -30}, 20, 20, 1, 0.2));
        world->addRigidBody(rigid({circleRing({50, -40}, 12, 20)}));
        return world;
    };
    expectTheSameFuture(make, [&](PhysicsWorld& world) { world.setSettings(settings(true)); });
    WorldSettings two = settings(true);
    two.materialCount = 2;
    two.materials.resize(4);
    EXPECT_THROW(make(true)->setSettings(two), Failure);
}

TEST(LiveChanges, FrictionChangesUnderABoxThatRests)
{
    WorldSettings settings;
    settings.gravity = {60, 100};
    settings.materials = {{0.9, 0, true}};
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(ground(0, 20000));
    const BodyHandle sliding = world->addRigidBody(box({0, -5}, 10, 10));
    run(*world, 1);
    EXPECT_LT(world->bodies().velocity[sliding].norm(), 0.1) << "0.6 is below the friction of 0.9";
    settings.materials = {{0.2, 0, true}};
    world->setSettings(settings);
    run(*world, 1);
    EXPECT_NEAR(world->bodies().velocity[sliding].x(), (60 - 0.2 * 100) * 1, 1) << "a = g (sin - mu cos)";
}

/// Boxes of one size: their own boxes met before, and do not come to meet again.
TEST(LiveChanges, AStackStandsWhenItsTouchesAreFoundAfresh)
{
    WorldSettings settings;
    settings.gravity = {0, 100};
    settings.materials = {{0.9, 0, true}};
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(ground(0, 20000));
    for (int i = 0; i < 4; ++i) world->addRigidBody(box({0, -5.0 - 10 * i}, 10, 10));
    run(*world, 0.5);
    settings.materials = {{0.8, 0, true}};
    world->setSettings(settings);
    run(*world, 0.5);
    EXPECT_NEAR(world->bodies().position[4].y(), -35, 0.3) << "after another table of materials";
    settings.gravity = {0, 0}, settings.findCollisions = false;
    world->setSettings(settings);
    run(*world, 0.1);
    settings.gravity = {0, 100}, settings.findCollisions = true;
    world->setSettings(settings);
    run(*world, 0.5);
    EXPECT_NEAR(world->bodies().position[4].y(), -35, 0.3) << "after nothing was sought";
}

TEST(LiveChanges, AMassCountsInEveryKindOfBody)
{
    const auto make = [](bool wanted) {
        auto world = makeWorld({0, 100}, 0.5, 0.3);
        world->addRigidBody(ground(0));
        world->addRigidBody(box({0, -40}, 20, 20, wanted ? 7 : 1, 0.4));
        world->addRigidBody(box({8, -90}, 20, 20));
        SpringActuatorDef spring;
        spring.a = {1, {10, -40}}, spring.b.point = {40, -120};
        world->addSpring(spring);
        return world;
    };
    expectTheSameFuture(
        make, [](PhysicsWorld& world) { world.setMass(1, 7); }, 0.5);
    auto world = makeWorld({0, 0});
    const BodyHandle soft = world->addSoftBody(softBall({0, 0}, 10));
    world->setMass(soft, 4);
    world->applyImpulse(soft, {8, 0});
    EXPECT_NEAR(world->bodies().velocity[soft].x(), 2, 1e-12);
    EXPECT_THROW(world->setMass(soft, 0), Failure);
}

TEST(LiveChanges, JointsAndSpringsTakeNewValues)
{
    const auto make = [](bool wanted) {
        auto world = makeWorld({0, 100});
        const BodyHandle lever = world->addRigidBody(box({20, 0}, 40, 6));
        JointDef def;
        def.b.body = lever;
        def.driven = wanted, def.motorSpeed = wanted ? 2 : 0, def.maxTorque = wanted ? 1e5 : 0;
        def.limited = wanted, def.lower = wanted ? -1 : 0, def.upper = wanted ? 1 : 0;
        world->addJoint(def);
        const BodyHandle weight = world->addRigidBody(box({100, 40}, 10, 10));
        SpringActuatorDef spring;
        spring.a.point = {100, 0}, spring.b = {weight, {100, 40}};
        spring.restLength = wanted ? 25 : 40, spring.ks = wanted ? 30 : 5, spring.kd = wanted ? 0.4 : 0.1;
        world->addSpring(spring);
        return world;
    };
    expectTheSameFuture(make, [](PhysicsWorld& world) {
        JointDef def;
        def.driven = true, def.motorSpeed = 2, def.maxTorque = 1e5;
        def.limited = true, def.lower = -1, def.upper = 1;
        world.setJoint(0, def);
        world.setSpring(0, 25, 30, 0.4, 0);
    });
    auto world = make(true);
    EXPECT_THROW(world->setSpring(0, 1, -1, 0, 0), Failure);
    EXPECT_THROW(world->setSpring(1, 1, 1, 0, 0), Failure);
    JointDef wrong;
    wrong.lower = 1, wrong.upper = -1;
    EXPECT_THROW(world->setJoint(0, wrong), Failure);
    run(*world, 1);
    EXPECT_NEAR((world->joint(0).pointA - world->joint(0).pointB).norm(), 0, 0.05);
}

TEST(LiveChanges, AreRestoredWithTheState)
{
    auto world = makeWorld({0, 100});
    const BodyHandle weight = world->addRigidBody(box({0, 40}, 10, 10));
    SpringActuatorDef spring;
    spring.b = {weight, {0, 40}};
    world->addSpring(spring);
    run(*world, 0.2);
    const auto before = world->save();
    const auto hash = world->hash();
    run(*world, 0.5);
    const auto future = world->hash();
    world->setMass(weight, 3);
    world->setSpring(0, 10, 50, 0, 0);
    world->restore(before);
    EXPECT_EQ(world->hash(), hash);
    run(*world, 0.5);
    EXPECT_EQ(world->hash(), future);
}

TEST(LiveChanges, TheSchemeOfTheThesisTakesOneSubstepWhenItIsChosenLate)
{
    const auto settings = [](bool wanted) {
        WorldSettings s;
        s.gravity = {0, 100};
        s.method = wanted ? Method::SemiImplicitEuler : Method::Automatic;
        return s;
    };
    const auto make = [&](bool wanted) {
        auto world = JetPhysics().createWorld(settings(wanted));
        world->addRigidBody(simple(box({0, 0}, 10, 10)));
        return world;
    };
    expectTheSameFuture(make, [&](PhysicsWorld& world) { world.setSettings(settings(true)); });
}

/// With and without a soft body: those have joints of their own.
class LiveJoints : public testing::TestWithParam<bool> {
protected:
    LiveJoints() : world(makeWorld({0, 100})), soft(GetParam()) {}

    BodyHandle add(const Vec2& at, double mass = 1)
    {
        if (!soft) return world->addRigidBody(simple(box(at, 20, 20, mass)));
        SoftBodyDef def = softBall(at, 10, 5000, 10);
        for (double& each : def.masses) each *= mass;
        return world->addSoftBody(def);
    }
    JointDef jointOf(JointDef::Kind kind, const Anchor& a, const Anchor& b) const
    {
        JointDef def;
        def.kind = kind, def.a = a, def.b = b;
        for (Anchor* anchor : {&def.a, &def.b})
            if (soft && anchor->body != kNoHandle) anchor->radius = 8;
        return def;
    }
    Vec2 at(BodyHandle body) const { return world->bodies().position[body]; }

    std::unique_ptr<PhysicsWorld> world;
    bool soft;
};

TEST_P(LiveJoints, AnAxisThatIsSetAgainTurnsOnWithItsBody)
{
    WorldSettings still;
    still.gravity = {0, 0};
    world->setSettings(still);
    const BodyHandle rail = add({0, 0}, 1000), sled = add({60, 0});
    JointDef def = jointOf(JointDef::Kind::Prismatic, {rail, {0, 0}}, {sled, {60, 0}});
    const JointHandle joint = world->addJoint(def);
    world->setOmega(rail, 1), world->setOmega(sled, 1), world->setVelocity(sled, {0, 60});
    run(*world, 1.57);
    const double slid = world->joint(joint).value;
    def.maxForce = 10;
    world->setJoint(joint, def);
    EXPECT_NEAR(world->joint(joint).value, slid, 1e-9) << "it slides along the same line as before";
}

TEST_P(LiveJoints, APulleyOfAnotherRatioKeepsTheRopeThereIs)
{
    const BodyHandle left = add({-50, 0}, 2), right = add({50, 0}, 2);
    JointDef def = jointOf(JointDef::Kind::Pulley, {left, {-50, 0}}, {right, {50, 0}});
    def.groundA = {-50, -100}, def.groundB = {50, -100};
    const JointHandle joint = world->addJoint(def);
    run(*world, 0.5);
    def.ratio = 2;
    world->setJoint(joint, def);
    const double before = at(left).y() + 2 * at(right).y();
    run(*world, 0.5);
    EXPECT_NEAR(at(left).y() + 2 * at(right).y(), before, 2) << "nothing is drawn in at once";
    EXPECT_GT(at(left).y(), 5) << "half the weight of the right one holds up the left one";
}

TEST_P(LiveJoints, WhetherTheJoinedCollideCanBeChanged)
{
    world->setGravity({0, 0});
    const BodyHandle a = add({0, 0}), b = add({60, 0});
    JointDef def = jointOf(JointDef::Kind::Rope, {a, {0, 0}}, {b, {60, 0}});
    def.length = 200;
    const JointHandle joint = world->addJoint(def);
    def.collide = true;
    world->setJoint(joint, def);
    world->setVelocity(b, {-60, 0});
    bool touched = false;
    for (int i = 0; i < 60; ++i) world->step(kStep), touched |= world->touching(a, b);
    EXPECT_TRUE(touched);
}

TEST_P(LiveJoints, WhatIsSwitchedOffHangsOnNothing)
{
    const BodyHandle body = add({0, 0});
    JointDef def = jointOf(JointDef::Kind::Weld, {kNoHandle, {0, 0}}, {body, {0, 0}});
    const JointHandle joint = world->addJoint(def);
    run(*world, 0.5);
    EXPECT_NEAR(world->joint(joint).force.y(), -100, 5);
    world->setEnabled(body, false);
    world->step(kStep);
    EXPECT_EQ(world->joint(joint).force, Vec2(0, 0));
    def.breakForce = 1;
    world->setJoint(joint, def);
    run(*world, 0.1);
    EXPECT_FALSE(world->joint(joint).broken) << "it bears nothing";
}

TEST_P(LiveJoints, WhatAJointBoreIsRestored)
{
    const BodyHandle body = add({0, 0});
    const JointHandle joint = world->addJoint(jointOf(JointDef::Kind::Weld, {kNoHandle, {0, 0}}, {body, {0, 0}}));
    run(*world, 0.5);
    const auto saved = world->save();
    const Vec2 force = world->joint(joint).force;
    world->applyImpulse(body, {50, 50});
    run(*world, 0.1);
    EXPECT_NE(world->joint(joint).force, force);
    world->restore(saved);
    EXPECT_EQ(world->joint(joint).force, force);
}

INSTANTIATE_TEST_SUITE_P(Bodies, LiveJoints, testing::Bool(),
                         [](const auto& info) { return std::string(info.param ? "Soft" : "Rigid"); });

TEST(LiveChanges, AStateIsRestoredAcrossAChangeOfWhatIsResolved)
{
    WorldSettings settings;
    settings.gravity = {0, 100};
    settings.materials[0].restitution = 0.5;
    const auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(simple(ground(0)));
    for (int i = 0; i < 12; ++i) world->addRigidBody(simple(box({3.0 * (i % 3), -10.0 - 12 * i}, 10, 10)));
    run(*world, 1);
    const auto saved = world->save();
    run(*world, 0.5);
    const std::uint64_t future = world->hash();
    settings.resolveCollisions = false;
    world->setSettings(settings);
    world->step(kStep);
    settings.resolveCollisions = true;
    world->setSettings(settings);
    world->restore(saved);
    run(*world, 0.5);
    EXPECT_EQ(world->hash(), future);
}

}  // namespace

}  // namespace jet::physics::test
