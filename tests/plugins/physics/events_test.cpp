// Events tell of bodies: a touch begins once and ends once, whatever the bodies are made of and whatever is done to
// them in between.
#include "scenes.hpp"

#include <set>

namespace jet::physics::test {

namespace {

/// Follows the events of a world, and says what does not fit: a touch that begins twice, or ends before it began, or
/// other touches than those that touching() tells.
class Listener {
public:
    explicit Listener(PhysicsWorld& world) : world_(world) {}

    void step(double dt = kStep)
    {
        world_.step(dt);
        for (const ContactEvent& event : world_.contactEvents()) {
            const std::pair pair(event.bodyA, event.bodyB);
            const bool fits = event.begins ? together_.insert(pair).second : together_.erase(pair) == 1;
            EXPECT_TRUE(fits) << event.bodyA << ", " << event.bodyB << (event.begins ? " begins" : " ends");
            (event.begins ? begun : ended) += 1;
        }
        for (BodyHandle a = 0; a < world_.bodyCount(); ++a)
            for (BodyHandle b = a + 1; b < world_.bodyCount(); ++b)
                EXPECT_EQ(world_.touching(a, b), together_.contains({a, b})) << a << ", " << b;
    }
    void run(double seconds)
    {
        for (int i = 0; i < static_cast<int>(std::lround(seconds / kStep)); ++i) step();
    }

    int begun = 0, ended = 0;

private:
    PhysicsWorld& world_;
    std::set<std::pair<BodyHandle, BodyHandle>> together_;
};

RigidBodyDef disc(const Vec2& at, double radius)
{
    RigidBodyDef def;
    def.shapes = {{ShapeDef::Kind::Circle, {at}, radius}};
    return def;
}

/// Four small boxes in a row.
RigidBodyDef rake(const Vec2& at)
{
    RigidBodyDef def;
    for (int i = 0; i < 4; ++i)
        def.shapes.push_back({ShapeDef::Kind::Polygon, boxRing(at + Vec2(12 * i, 0), 10, 10), 0});
    return def;
}

TEST(Events, ACompoundBeginsToTouchOnceHoweverManyOfItsPartsDo)
{
    const auto world = makeWorld({0, 200}, 0.5, 0);
    world->addRigidBody(simple(ground(0)));
    world->addRigidBody(rake({0, -30}));
    Listener listener(*world);
    listener.run(1);
    EXPECT_EQ(listener.begun, 1);
    EXPECT_EQ(listener.ended, 0);
    world->setPosition(1, {0, -500});
    listener.step();
    EXPECT_EQ(listener.ended, 1);
}

TEST(Events, DrawnBodiesAndCompoundsThatTumbleBeginAndEndInTurns)
{
    const auto world = makeWorld({0, 200}, 0.4, 0.5);
    world->addRigidBody(ground(0));
    for (int i = 0; i < 3; ++i) {
        world->addRigidBody(rake({60.0 * i, -60.0 - 30 * i}));
        std::vector<Vec2> star;
        for (int k = 0; k < 10; ++k)
            star.push_back(Vec2(60.0 * i, -150) + Vec2(Affine::rotation(0.628 * k).linear() * Vec2(k % 2 ? 9 : 20, 0)));
        world->addRigidBody(rigid({star}));
    }
    Listener listener(*world);
    listener.run(3);
    EXPECT_GT(listener.begun, 10);
}

TEST(Events, WhatTouchedHasPartedWhenCollisionsAreNoLongerSought)
{
    WorldSettings settings;
    settings.gravity = {0, 100};
    const auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(ground(0));
    world->addRigidBody(box({0, -5}, 10, 10));
    Listener listener(*world);
    listener.run(0.2);
    settings.findCollisions = false;
    world->setSettings(settings);
    listener.step();
    EXPECT_EQ(listener.ended, 1);
    settings.findCollisions = true;
    settings.materials[0].friction = 0.2;
    world->setSettings(settings);
    listener.run(0.1);
    settings.materials[0].friction = 0.9;
    world->setSettings(settings);
    listener.run(0.1);
    EXPECT_EQ(listener.begun, 2) << "other friction is no new touch";
}

TEST(Events, ASensorUnderASleepingBodyEndsWhenItIsSwitchedOff)
{
    const auto world = makeWorld({0, 100});
    world->addRigidBody(ground(0));
    world->addRigidBody(box({0, -5}, 10, 10));
    RigidBodyDef gate = fixed({boxRing({0, -10}, 40, 30)});
    gate.common.sensor = true;
    world->addRigidBody(gate);
    Listener listener(*world);
    listener.run(2);
    ASSERT_FALSE(world->awake(1));
    ASSERT_TRUE(world->touching(1, 2));
    world->setEnabled(2, false);
    listener.step();
    EXPECT_FALSE(world->touching(1, 2));
    EXPECT_FALSE(world->awake(1)) << "nothing held it there";
}

TEST(Events, ASoftBodyThatBecomesASensorTellsNoImpulsesOfBefore)
{
    const auto world = makeWorld({0, 100});
    world->addRigidBody(ground(0));
    world->addSoftBody(softBall({0, -11}, 10));
    world->addSoftBody(softBall({0, -32}, 10));
    run(*world, 1);
    ASSERT_TRUE(world->touching(1, 2));
    BodyCommon common;
    common.sensor = true;
    world->setBody(2, common);
    for (int i = 0; i < 3; ++i) {
        world->step(kStep);
        for (const Contact& contact : world->contacts()) {
            const bool held = contact.bodyA == 2 || contact.bodyB == 2;
            EXPECT_TRUE(!held || contact.impulse == 0) << contact.impulse;
        }
    }
}

TEST(Events, WhatTheTableForbidsDoesNotTouchInAStateRestored)
{
    WorldSettings settings;
    settings.gravity = {0, 100};
    for (const bool drawn : {false, true}) {
        const auto world = JetPhysics().createWorld(settings);
        world->addRigidBody(drawn ? ground(0) : simple(ground(0)));
        world->addRigidBody(drawn ? box({0, -5}, 10, 10) : simple(box({0, -5}, 10, 10)));
        run(*world, 0.5);
        ASSERT_TRUE(world->touching(0, 1));
        const auto state = world->save();
        WorldSettings passing = settings;
        passing.materials[0].collides = false;
        world->setSettings(passing);
        world->restore(state);
        EXPECT_TRUE(world->touching(0, 1)) << "it did then";
        run(*world, 0.2);
        EXPECT_FALSE(world->touching(0, 1));
        EXPECT_GT(world->bodies().velocity[1].y(), 15) << "it falls";
        // Where the table is the same, going back is bit-equal as before.
        world->setSettings(settings);
        world->restore(state);
        run(*world, 0.2);
        const auto expected = world->hash();
        world->restore(state);
        run(*world, 0.2);
        EXPECT_EQ(world->hash(), expected);
    }
}

TEST(Events, OfAnotherTimeAreNotToldAfterRestoring)
{
    const auto world = makeWorld({0, 100});
    world->addRigidBody(simple(ground(0)));
    world->addRigidBody(rake({0, -30}));
    Listener listener(*world);
    const auto start = world->save();
    while (listener.begun == 0) listener.step();
    const auto touched = world->save();
    world->restore(start);
    EXPECT_TRUE(world->contactEvents().empty());
    world->restore(touched);
    EXPECT_TRUE(world->contactEvents().empty());
    listener.run(0.5);
    EXPECT_EQ(listener.begun, 1) << "it touched when it was saved";
}

TEST(Events, ABodyAddedInBetweenChangesNothingOfTheLastStep)
{
    const auto world = makeWorld({0, 100});
    world->addRigidBody(ground(0));
    world->addSoftBody(softBall({0, -11}, 10));
    world->addRigidBody(simple(box({60, -5}, 10, 10)));
    Listener listener(*world);
    for (int i = 0; i < 40; ++i) {
        listener.step();
        const StepStats before = world->stats();
        const BodyHandle added = world->addRigidBody(disc({200.0 + 30 * i, -10}, 5));
        EXPECT_NE(world->island(added), world->island(2));
        EXPECT_EQ(world->stats().awakeBodies, before.awakeBodies);
    }
}

}  // namespace

}  // namespace jet::physics::test
