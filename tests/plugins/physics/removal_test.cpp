// Bodies and actuators that are taken out of a world that runs, and those that take their places.
#include "doors.hpp"
#include "lattices.hpp"
#include "shape_worlds.hpp"

#include <jet/physics_removal.hpp>
#include <jet/result.hpp>

#include <deque>
#include <random>

namespace jet::physics::test {

namespace {

Anchor on(BodyHandle body, const Vec2& at) { return {body, at, 0}; }
Anchor background(const Vec2& at) { return {kNoHandle, at, 0}; }

JointDef revolute(const Anchor& a, const Anchor& b)
{
    JointDef def;
    def.a = a, def.b = b;
    return def;
}

RigidBodyDef disc(const Vec2& at, double radius)
{
    RigidBodyDef def;
    def.shapes = {{ShapeDef::Kind::Circle, {at}, radius}};
    return def;
}

/// Two shapes, one of them round.
RigidBodyDef hammer(const Vec2& at)
{
    RigidBodyDef def = simple(box(at, 20, 4));
    def.shapes.push_back({ShapeDef::Kind::Capsule, {at + Vec2(10, -4), at + Vec2(10, 4)}, 3});
    return def;
}

/// Concave, as drawn.
RigidBodyDef arrow(const Vec2& at)
{
    return rigid({{at + Vec2(0, -10), at + Vec2(12, 10), at + Vec2(0, 4), at + Vec2(-12, 10)}});
}

/// A ball of jelly that tears when it is pulled.
SoftBodyDef jellyBall(const Vec2& at) { return softBall(at, 12, 200, 1, 12, 2); }

struct Kind {
    const char* name;
    std::function<BodyHandle(PhysicsWorld&, const Vec2&)> add;
    int steps;
};

const std::vector<Kind>& kinds()
{
    static const std::vector<Kind> all{
        {"boxes", [](PhysicsWorld& w, const Vec2& at) { return w.addRigidBody(simple(box(at, 10, 10))); }, 10'000},
        {"discs", [](PhysicsWorld& w, const Vec2& at) { return w.addRigidBody(disc(at, 6)); }, 10'000},
        {"hammers", [](PhysicsWorld& w, const Vec2& at) { return w.addRigidBody(hammer(at)); }, 10'000},
        {"arrows", [](PhysicsWorld& w, const Vec2& at) { return w.addRigidBody(arrow(at)); }, 10'000},
        {"drawings without area",
         [](PhysicsWorld& w, const Vec2& at) {
             return w.addRigidBody(rigid({{at, at + Vec2(10, 0), at + Vec2(20, 0)}}));
         },
         1500},
        {"soft balls", [](PhysicsWorld& w, const Vec2& at) { return w.addSoftBody(jellyBall(at)); }, 1500}};
    return all;
}

/// Adds one a step and removes the one that came twelve steps ago; what is alive falls on a floor.
std::unique_ptr<PhysicsWorld> fountain(const Kind& kind, int steps, WorldSettings settings,
                                       std::vector<std::size_t>* memory = nullptr)
{
    settings.gravity = {0, 300};
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(simple(ground(0)));
    std::deque<BodyHandle> alive;
    for (int i = 0; i < steps; ++i) {
        alive.push_back(kind.add(*world, Vec2(17.0 * (i % 7) - 50, -20.0 - 3 * (i % 5))));
        if (alive.size() > 12) removal(*world).removeBody(alive.front()), alive.pop_front();
        world->step(kStep);
        if (memory != nullptr) memory->push_back(world->stats().memory);
    }
    return world;
}

TEST(Removal, AddingAndRemovingABodyEachStepTakesNoMoreMemory)
{
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(kind.name);
        std::vector<std::size_t> memory;
        const auto world = fountain(kind, kind.steps, WorldSettings(), &memory);
        EXPECT_LE(world->bodyCount(), 16U);
        const auto after = memory.begin() + kind.steps / 3;
        const std::size_t most = *std::max_element(memory.begin(), after);
        // How much contacts take goes up and down with how the bodies lie; bodies that stayed would be a hundred times.
        EXPECT_LE(*std::max_element(after, memory.end()), most + most / 8);
    }
}

TEST(Removal, EqualHistoriesGiveEqualBitsWhateverTheThreadsAndInstructions)
{
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(kind.name);
        const std::uint64_t one = fountain(kind, 300, WorldSettings())->hash();
        for (const int threads : {2, 4}) {
            WorldSettings settings;
            settings.threads = threads;
            EXPECT_EQ(fountain(kind, 300, settings)->hash(), one);
        }
        for (const Simd simd : {Simd::Sse2, Simd::Avx2}) {
            WorldSettings settings;
            settings.simd = simd;
            EXPECT_EQ(fountain(kind, 300, settings)->hash(), one);
        }
    }
}

/// Enough contacts that the world is divided between threads, while bodies of it come and go.
TEST(Removal, InALargeHeapThreadsGiveEqualBits)
{
    const auto hashOf = [](int threads) {
        WorldSettings settings;
        settings.gravity = {0, 300};
        settings.threads = threads;
        auto world = JetPhysics().createWorld(settings);
        world->addRigidBody(simple(ground(0)));
        for (int i = 0; i < 1600; ++i)
            world->addRigidBody(simple(box({10.0 * (i % 80) - 400, -5.0 - 10 * (i / 80)}, 10, 10)));
        std::uint64_t sum = 0;
        for (int i = 0; i < 60; ++i) {
            removal(*world).removeBody(static_cast<BodyHandle>(1 + 23 * i));
            if (i % 2 == 1) world->addRigidBody(simple(box({5.0 * i, -260}, 10, 10)));
            world->step(kStep);
            sum = sum * 31 + world->hash();
        }
        EXPECT_GT(world->stats().contacts, 1500U);
        return sum;
    };
    const std::uint64_t one = hashOf(1);
    EXPECT_EQ(hashOf(2), one);
    EXPECT_EQ(hashOf(4), one);
}

TEST(Removal, WhatIsRemovedIsNamedInTheRefusalOfEveryCallAndTheWorldIsAsItWas)
{
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(kind.name);
        auto world = makeWorld({0, 100});
        world->addRigidBody(simple(ground(0)));
        const BodyHandle body = kind.add(*world, {0, -30});
        run(*world, 0.2);
        WorldRemoval& out = removal(*world);
        EXPECT_TRUE(out.hasBody(body));
        out.removeBody(body);
        EXPECT_FALSE(out.hasBody(body));
        const std::uint64_t before = world->hash();
        const Anchor anchor = on(body, {0, -30}), free = background({0, -60});
        const std::vector<std::function<void()>> acts{
            [&] { out.removeBody(body); },
            [&] {
                world->contains(body, {0, 0});
            },
            [&] {
                world->applyForce(body, {1, 0});
            },
            [&] {
                world->applyImpulse(body, {1, 0});
            },
            [&] {
                world->setVelocity(body, {1, 0});
            },
            [&] { world->setOmega(body, 1); },
            [&] {
                world->setPosition(body, {1, 0});
            },
            [&] { world->setBody(body, {}); },
            [&] { world->setMass(body, 2); },
            [&] { world->setEnabled(body, true); },
            [&] { world->setSoftMatter(body, {}); },
            [&] { world->setSprings(body, 1, 1, 0); },
            [&] { world->setPinned(body, 0, true); },
            [&] { world->springTension(body, 0); },
            [&] { world->springAlive(body, 0); },
            [&] { world->pieces(body); },
            [&] { world->borders(body); },
            [&] { world->awake(body); },
            [&] { world->wake(body); },
            [&] { world->island(body); },
            [&] {
                world->addSpring({anchor, free});
            },
            [&] {
                world->addAngularSpring({free, anchor, free});
            },
            [&] {
                world->addTorque({anchor, 1});
            },
            [&] {
                world->addForce({anchor, {1, 0}});
            },
            [&] { world->addJoint(revolute(free, anchor)); },
        };
        const std::string sentence = "body " + std::to_string(body) + " was removed";
        for (std::size_t i = 0; i < acts.size(); ++i)
            EXPECT_NE(refusalOf(acts[i]).find(sentence), std::string::npos) << i << ": " << refusalOf(acts[i]);
        EXPECT_FALSE(refusalOf([&] { out.removeBody(77); }).empty());
        EXPECT_FALSE(refusalOf([&] { out.removeBody(kNoHandle); }).empty());
        EXPECT_EQ(world->hash(), before);
        const BodyStates states = world->bodies();
        EXPECT_TRUE(states.bounds[body].isNull());
        EXPECT_EQ(states.velocity[body], Vec2(0, 0));
        EXPECT_TRUE(world->overlapping(Box({-500, -500}, {500, -1})).empty());
        EXPECT_FALSE(world->rayCast({-100, -12}, {100, -12}));
        EXPECT_FALSE(world->touching(0, body));
        world->step(kStep);
        EXPECT_TRUE(std::none_of(world->contacts().begin(), world->contacts().end(),
                                 [&](const Contact& c) { return c.bodyA == body || c.bodyB == body; }));
    }
}

TEST(Removal, TheEndOfItsContactsIsToldInTheNextStepAndOnlyThen)
{
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(kind.name);
        auto world = makeWorld({0, 200});
        world->addRigidBody(simple(ground(0)));
        const BodyHandle body = kind.add(*world, {0, -16});
        for (int i = 0; i < 90; ++i) world->step(kStep), world->contactEvents();
        const bool touched = world->touching(0, body);
        removal(*world).removeBody(body);
        const BodyHandle next = kind.add(*world, {400, -200});
        EXPECT_NE(next, body) << "before the end of its contacts was told";
        world->step(kStep);
        const std::vector<ContactEvent> events(world->contactEvents().begin(), world->contactEvents().end());
        ASSERT_EQ(events.size(), touched ? 1U : 0U);
        if (touched) {
            EXPECT_FALSE(events[0].begins);
            EXPECT_EQ(events[0].bodyA, 0U);
            EXPECT_EQ(events[0].bodyB, body);
        }
        world->step(kStep);
        EXPECT_TRUE(world->contactEvents().empty());
        EXPECT_EQ(kind.add(*world, {200, -200}), body);
    }
}

TEST(Removal, WhatSleepsOnARemovedBodyWakesAndFalls)
{
    for (const bool standing : {false, true}) {
        auto world = makeWorld({0, 100});
        world->addRigidBody(simple(ground(0)));
        RigidBodyDef lower = simple(box({0, -10}, 20, 20));
        lower.common.fixed = standing;
        const BodyHandle below = world->addRigidBody(lower);
        const BodyHandle above = world->addRigidBody(simple(box({0, -30}, 20, 20)));
        run(*world, 3);
        ASSERT_FALSE(world->awake(above));
        removal(*world).removeBody(below);
        EXPECT_TRUE(world->awake(above));
        run(*world, 1);
        EXPECT_NEAR(world->bodies().position[above].y(), -10, 0.5);
    }
}

TEST(Removal, JointsSpringsTorquesAndForcesGoWithTheirBody)
{
    for (const bool soft : {false, true}) {
        auto world = makeWorld({0, 0});
        WorldRemoval& out = removal(*world);
        const BodyHandle body =
            soft ? world->addSoftBody(softBall({0, 0}, 20)) : world->addRigidBody(simple(box({0, 0}, 20, 20)));
        const BodyHandle other = world->addRigidBody(simple(box({60, 0}, 20, 20)));
        const JointHandle joint = world->addJoint(revolute(on(body, {0, 0}), on(other, {60, 0})));
        const JointHandle kept = world->addJoint(revolute(background({60, 0}), on(other, {60, 0})));
        const ActuatorHandle spring = world->addSpring({on(body, {0, 0}), on(other, {60, 0})});
        const ActuatorHandle angular =
            world->addAngularSpring({on(body, {0, 0}), on(other, {60, 0}), background({60, 50})});
        const ActuatorHandle torque = world->addTorque({on(body, {0, 0}), 100});
        const ActuatorHandle force = world->addForce({on(body, {0, 0}), {100, 0}});
        const ActuatorHandle own = world->addForce({on(other, {60, 0}), {1, 0}});
        run(*world, 0.1);
        out.removeBody(body);
        EXPECT_FALSE(out.hasJoint(joint));
        EXPECT_TRUE(out.hasJoint(kept));
        EXPECT_FALSE(out.hasActuator(ActuatorKind::Spring, spring));
        EXPECT_FALSE(out.hasActuator(ActuatorKind::AngularSpring, angular));
        EXPECT_FALSE(out.hasActuator(ActuatorKind::Torque, torque));
        EXPECT_FALSE(out.hasActuator(ActuatorKind::Force, force));
        EXPECT_TRUE(out.hasActuator(ActuatorKind::Force, own));
        EXPECT_EQ(refusalOf([&] { world->joint(joint); }), "Physics: joint 0 was removed.");
        EXPECT_EQ(refusalOf([&] { world->setSpring(spring, 1, 1, 1, 0); }), "Physics: spring 0 was removed.");
        EXPECT_EQ(refusalOf([&] { liveAngularSprings(*world).setAngularSpring(angular, 1, 1, 1); }),
                  "Physics: angular spring 0 was removed.");
        EXPECT_EQ(refusalOf([&] { world->setTorque(torque, 1); }), "Physics: torque 0 was removed.");
        EXPECT_EQ(refusalOf([&] { world->setForce(force, {1, 0}); }), "Physics: force 0 was removed.");
        run(*world, 0.1);
        // They come back as others.
        EXPECT_EQ(world->addSpring({on(other, {60, 0}), background({0, 0})}), spring);
        EXPECT_EQ(world->addTorque({on(other, {60, 0}), 1}), torque);
        run(*world, 0.1);
    }
}

/// A box that something pulls, against the same box in a world in which that never was.
TEST(Removal, ARemovedActuatorLeavesAWorldThatNeverHadIt)
{
    const auto path = [](const std::function<void(PhysicsWorld&, BodyHandle)>& before) {
        auto world = makeWorld({0, 50});
        const BodyHandle body = world->addRigidBody(simple(box({0, 0}, 20, 10)));
        before(*world, body);
        run(*world, 1);
        return world->bodies().position[body];
    };
    const Vec2 free = path([](PhysicsWorld&, BodyHandle) {});
    const auto removed = [&](ActuatorKind kind, auto&& add) {
        return path([&](PhysicsWorld& w, BodyHandle body) {
            const ActuatorHandle handle = add(w, body);
            removal(w).removeActuator(kind, handle);
            EXPECT_EQ(add(w, body), handle) << "the next takes its place";
            removal(w).removeActuator(kind, handle);
            EXPECT_FALSE(refusalOf([&] { removal(w).removeActuator(kind, handle); }).empty());
            EXPECT_FALSE(refusalOf([&] { removal(w).removeActuator(kind, 99); }).empty());
        });
    };
    EXPECT_EQ(free, removed(ActuatorKind::Spring, [](PhysicsWorld& w, BodyHandle b) {
                  return w.addSpring({on(b, {5, 0}), background({100, 0})});
              }));
    EXPECT_EQ(free, removed(ActuatorKind::AngularSpring, [](PhysicsWorld& w, BodyHandle b) {
                  return w.addAngularSpring({on(b, {5, 0}), on(b, {0, 0}), background({100, 0}), 1, false, 1e4});
              }));
    EXPECT_EQ(free, removed(ActuatorKind::Torque, [](PhysicsWorld& w, BodyHandle b) {
                  return w.addTorque({on(b, {0, 0}), 1e4});
              }));
    EXPECT_EQ(free, removed(ActuatorKind::Force, [](PhysicsWorld& w, BodyHandle b) {
                  return w.addForce({on(b, {0, 0}), {100, 0}});
              }));
    EXPECT_EQ(free, removed(ActuatorKind::ForceField, [](PhysicsWorld& w, BodyHandle) {
                  ForceFieldDef field;
                  field.vector = {300, 0};
                  return w.addForceField(field);
              }));
}

/// One that was heavy, turned, slept, was switched off, filtered, pinned, torn or bent before it was removed.
TEST(Removal, ABodyThatTakesAPlaceOverCarriesNothingOfItsPredecessor)
{
    const auto spoil = [](PhysicsWorld& w, BodyHandle body, bool soft, int how) {
        BodyCommon common;
        switch (how) {
        case 0: return w.setMass(body, 50);
        case 1:
            common.kinematic = common.sensor = true;
            common.layer = 4, common.mask = 8, common.group = 3, common.gravityScale = -2;
            common.oneSided = {0, -1}, common.allowSleep = false;
            w.setBody(body, common);
            return w.setOmega(body, 9);
        case 2: return w.setEnabled(body, false);
        case 3: w.applyForce(body, {1e5, 0}), w.setOmega(body, 30); return run(w, 0.3);
        case 4:
            common.fixedRotation = true;
            w.setBody(body, common);
            return run(w, 3);
        default:
            if (!soft) return;
            w.setPinned(body, 0, true), w.setPinned(body, 5, true);
            SoftMatter matter;
            matter.yield = 0.01, matter.pressure = 40, matter.shapeStiffness = 90, matter.selfCollision = true;
            w.setSoftMatter(body, matter);
            w.setSprings(body, 300, 2, 1.05);
            for (int i = 0; i < 30; ++i) w.applyForce(body, {3000, 0}), w.step(kStep);
        }
    };
    for (const Kind& kind : kinds()) {
        const bool soft = std::string(kind.name) == "soft balls";
        for (int how = 0; how < 6; ++how) {
            SCOPED_TRACE(std::string(kind.name) + " " + std::to_string(how));
            const auto second = [&](PhysicsWorld& w) { return kind.add(w, {0, -40}); };
            // Contacts of several parts may be solved in another order.
            const bool several = std::string(kind.name) == "hammers" || std::string(kind.name) == "arrows";
            const double bound = several ? 0.2 : 1e-9;
            auto fresh = makeWorld({0, 100}), used = makeWorld({0, 100});
            for (PhysicsWorld* w : {fresh.get(), used.get()}) w->addRigidBody(simple(ground(0)));
            const BodyHandle first = kind.add(*used, {30, -60});
            used->step(kStep);
            spoil(*used, first, soft, how);
            removal(*used).removeBody(first);
            run(*used, 0.6);
            for (int i = 0; i < 36; ++i) fresh->step(kStep);
            const BodyHandle a = second(*fresh), b = second(*used);
            EXPECT_EQ(b, first);
            for (int i = 0; i < 150; ++i) {
                fresh->step(kStep), used->step(kStep);
                const auto p = pointsOf(*fresh, a), q = pointsOf(*used, b);
                ASSERT_EQ(p.size(), q.size());
                for (std::size_t k = 0; k < p.size(); ++k) ASSERT_LT((p[k] - q[k]).norm(), bound) << "step " << i;
            }
            EXPECT_EQ(fresh->awake(a), used->awake(b));
            EXPECT_EQ(fresh->contacts().size(), used->contacts().size());
            if (soft) {
                EXPECT_EQ(fresh->borders(a), used->borders(b));
                EXPECT_TRUE(used->pieces(b).empty());
                EXPECT_TRUE(used->springAlive(b, 0));
            }
        }
    }
}

TEST(Removal, AStateSavedSinceIsRestoredBitEqualAndOneFromBeforeIsRefused)
{
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(kind.name);
        auto world = makeWorld({0, 200});
        world->addRigidBody(simple(ground(0)));
        std::deque<BodyHandle> alive;
        const auto on = [&](int from, int to) {
            for (int i = from; i < to; ++i) {
                alive.push_back(kind.add(*world, Vec2(13.0 * (i % 5), -30)));
                if (alive.size() > 6) removal(*world).removeBody(alive.front()), alive.pop_front();
                world->step(kStep);
            }
        };
        on(0, 40);
        const std::vector<std::byte> early = world->save();
        // Saved before the step after a removal: whose place is free then is part of the state.
        const BodyHandle last = alive.back();
        removal(*world).removeBody(last);
        alive.pop_back();
        const std::vector<std::byte> state = world->save();
        const std::uint64_t hash = world->hash();
        for (int i = 0; i < 20; ++i) world->step(kStep);
        const std::uint64_t end = world->hash();
        world->restore(state);
        EXPECT_EQ(world->hash(), hash);
        for (int i = 0; i < 20; ++i) world->step(kStep);
        EXPECT_EQ(world->hash(), end);
        world->restore(state);
        const BodyHandle next = kind.add(*world, {0, -80});
        EXPECT_NE(next, last) << "its place waits for the next step";
        EXPECT_FALSE(refusalOf([&] { world->restore(early); }).empty());
        EXPECT_FALSE(refusalOf([&] { world->restore(state); }).empty());
        on(100, 110);
    }
}

TEST(Removal, AWorldThatLosesItsLastSoftBodyGoesOnAsOneOfRigidOnes)
{
    auto world = makeWorld({0, 100});
    world->addRigidBody(simple(ground(0)));
    const BodyHandle soft = world->addSoftBody(softBall({0, -20}, 20));
    const BodyHandle on = world->addRigidBody(simple(box({0, -50}, 20, 20)));
    for (int i = 0; i < 120; ++i) world->step(kStep), world->contactEvents();
    ASSERT_TRUE(world->touching(soft, on));
    removal(*world).removeBody(soft);
    world->step(kStep);
    std::size_t ends = 0;
    for (const ContactEvent& event : world->contactEvents()) ends += !event.begins && event.bodyB >= soft;
    EXPECT_EQ(ends, 2U);
    for (int i = 0; i < 240; ++i) world->step(kStep), world->contactEvents();
    EXPECT_NEAR(world->bodies().position[on].y(), -10, 0.2);
    EXPECT_FALSE(world->awake(on));
}

TEST(Removal, AnAngularSpringTakesAnotherAngleAndStrengthWhileItRuns)
{
    auto world = makeWorld({0, 0});
    const BodyHandle rod = world->addRigidBody(simple(box({20, 0}, 40, 4)));
    world->addJoint(revolute(background({0, 0}), on(rod, {0, 0})));
    const ActuatorHandle spring =
        world->addAngularSpring({background({100, 0}), background({0, 0}), on(rod, {40, 0}), 0, true, 1e5, 2e4});
    run(*world, 3);
    EXPECT_NEAR(world->bodies().angle[rod], 0, 1e-6);
    liveAngularSprings(*world).setAngularSpring(spring, 1.0, 1e5, 2e4);
    EXPECT_TRUE(world->awake(rod));
    const std::vector<std::byte> state = world->save();
    run(*world, 3);
    EXPECT_NEAR(world->bodies().angle[rod], 1, 1e-3);
    const std::uint64_t end = world->hash();
    liveAngularSprings(*world).setAngularSpring(spring, std::nullopt, 0, 0);
    const Vec2 arm = world->bodies().position[rod];
    world->setOmega(rod, 2), world->setVelocity(rod, 2 * Vec2(-arm.y(), arm.x()));
    run(*world, 0.5);
    EXPECT_NEAR(world->bodies().angle[rod], 2, 1e-2) << "without strength it holds nothing";
    world->restore(state);
    run(*world, 3);
    EXPECT_EQ(world->hash(), end) << "its values are part of the state";
    for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_FALSE(refusalOf([&] { liveAngularSprings(*world).setAngularSpring(spring, 0.0, bad, 1); }).empty());
    EXPECT_FALSE(refusalOf([&] { liveAngularSprings(*world).setAngularSpring(7, 0.0, 1, 1); }).empty());
}

/// Whatever comes and goes in whatever order: all stays numbers, and two runs are equal.
class Tangle {
public:
    explicit Tangle(unsigned seed) : random_(seed)
    {
        WorldSettings settings;
        settings.gravity = {0, 150};
        world_ = JetPhysics().createWorld(settings);
        world_->addRigidBody(simple(ground(0)));
    }

    std::uint64_t run(int steps)
    {
        std::uint64_t sum = 0;
        for (int i = 0; i < steps; ++i) {
            for (int k = pick(4); k > 0; --k) act();
            world_->step(kStep);
            if (i % 5 == 0) world_->contactEvents();
            if (i % 7 == 0) world_->overlapping(Box({-50, -50}, {50, 0}));
            if (i % 9 == 0) sum = sum * 31 + world_->hash();
            if (i % 31 == 0) world_->restore(world_->save());
            for (const Vec2& at : world_->bodies().points)
                if (!isFinite(at)) ADD_FAILURE() << "no number in step " << i;
        }
        return sum;
    }

private:
    int pick(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }
    Vec2 somewhere() { return {pick(160) - 80.0, -15.0 - pick(120)}; }
    Anchor anchor()
    {
        std::vector<BodyHandle> there;
        for (BodyHandle body = 0; body < world_->bodyCount(); ++body)
            if (removal(*world_).hasBody(body)) there.push_back(body);
        const BodyHandle body = there[static_cast<std::size_t>(pick(static_cast<int>(there.size())))];
        return pick(5) == 0 ? background(somewhere()) : on(body, world_->bodies().position[body]);
    }
    void act()
    {
        WorldRemoval& out = removal(*world_);
        const auto attempt = [](auto&& call) {
            try {
                call();
            } catch (const Failure&) {  // what is not there, or not to be joined so
            }
        };
        const auto any = static_cast<std::uint32_t>(pick(24));
        switch (pick(14)) {
        case 0:
        case 1:
        case 2:
        case 3:
            kinds()[static_cast<std::size_t>(pick(static_cast<int>(kinds().size())))].add(*world_, somewhere());
            return;
        case 4:
        case 5:
        case 6: return attempt([&] { out.removeBody(1 + any); });
        case 7: return attempt([&] { world_->addJoint(revolute(anchor(), anchor())); });
        case 8: return attempt([&] { world_->addSpring({anchor(), anchor(), -1, 50, 1, pick(2) * 1.5}); });
        case 9: return attempt([&] { world_->addAngularSpring({anchor(), anchor(), anchor()}); });
        case 10: return attempt([&] { world_->removeJoint(any); });
        case 11: return attempt([&] { out.removeActuator(static_cast<ActuatorKind>(pick(5)), any); });
        case 12: return attempt([&] { world_->setEnabled(1 + any, pick(2) == 0); });
        default: return attempt([&] { world_->setSprings(1 + any, 300, 1, 1.2); });
        }
    }

    std::mt19937 random_;
    std::unique_ptr<PhysicsWorld> world_;
};

TEST(Removal, WhateverComesAndGoesAllStaysFiniteAndTwoRunsAreEqual)
{
    for (unsigned seed = 1; seed <= 4; ++seed) EXPECT_EQ(Tangle(seed).run(250), Tangle(seed).run(250)) << seed;
}

}  // namespace

}  // namespace jet::physics::test
