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

}  // namespace

}  // namespace jet::physics::test
