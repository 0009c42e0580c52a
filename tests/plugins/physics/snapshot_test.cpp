// Same scene, same steps: same bits. A snapshot carries everything the future depends on.
#include "scenes.hpp"

#include <jet/result.hpp>

namespace jet::physics::test {

namespace {

/// Soft and rigid bodies, every kind of actuator, piles and bounces.
std::unique_ptr<PhysicsWorld> busyWorld(int threads = 1)
{
    WorldSettings settings;
    settings.gravity = {0, 400};
    settings.linearDamping = 0.05;
    settings.materials = {MaterialPair{0.5, 0.3, true}};
    settings.threads = threads;
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(fixed({boxRing({0, 0}, 640, 640), boxRing({0, 0}, 600, 600)}));
    for (int i = 0; i < 12; ++i)
        world->addRigidBody(box({-150.0 + 60 * (i % 6), -100.0 - 50 * (i / 6)}, 25, 25, 1, 0.3 * i));
    for (int i = 0; i < 4; ++i) world->addSoftBody(softBall({-180.0 + 120 * i, 100}, 30, 200 + 50 * i, 1, 14, 2));
    SpringActuatorDef spring;
    spring.a = {1, {-150, -100}};
    spring.b = {13, {-180, 100}};
    world->addSpring(spring);
    AngularSpringActuatorDef hinge;
    hinge.a = {2, {-90, -100}};
    hinge.centre = {kNoHandle, {-60, -60}};
    hinge.b = {3, {-30, -100}};
    hinge.ks = 300;
    world->addAngularSpring(hinge);
    world->addTorque({{14, {-60, 100}}, 200});
    world->addForce({{4, {30, -100}}, {50, 0}});
    return world;
}

TEST(Snapshot, TwoRunsGiveTheSameHashes)
{
    auto first = busyWorld(), second = busyWorld(4);
    for (int i = 0; i < 240; ++i) {
        first->step(kStep);
        second->step(kStep);
        ASSERT_EQ(first->hash(), second->hash()) << "step " << i;
    }
}

TEST(Snapshot, TheHashSeesASingleBit)
{
    auto first = busyWorld(), second = busyWorld();
    EXPECT_EQ(first->hash(), second->hash());
    second->setVelocity(5, {1e-12, 0});
    EXPECT_NE(first->hash(), second->hash());
    auto third = busyWorld();
    third->setTorque(0, 200.0000001);
    EXPECT_NE(first->hash(), third->hash());
}

TEST(Snapshot, ARestoredWorldHasTheSameFuture)
{
    auto world = busyWorld();
    for (int i = 0; i < 100; ++i) world->step(kStep);
    world->applyForce(3, {100, -200});
    const auto saved = world->save();
    const std::uint64_t hash = world->hash();
    const auto contacts = std::vector<Contact>(world->contacts().begin(), world->contacts().end());
    std::vector<std::uint64_t> future;
    for (int i = 0; i < 120; ++i) world->step(kStep), future.push_back(world->hash());

    world->restore(saved);
    EXPECT_EQ(world->hash(), hash);
    EXPECT_EQ(world->contacts().size(), contacts.size());
    for (int i = 0; i < 120; ++i) {
        world->step(kStep);
        ASSERT_EQ(world->hash(), future[i]) << "same world, step " << i;
    }

    auto equal = busyWorld();
    equal->restore(saved);
    for (int i = 0; i < 120; ++i) {
        equal->step(kStep);
        ASSERT_EQ(equal->hash(), future[i]) << "equal world, step " << i;
    }
}

TEST(Snapshot, TornSpringsAndGravityAreRestored)
{
    auto world = makeWorld({0, 0});
    SoftBodyDef def;
    def.particles = {{0, 0}, {10, 0}};
    def.masses = {1, 1};
    def.springs = {{0, 1, 4, 1, 0, 2}};
    world->addSoftBody(def);
    const auto whole = world->save();
    world->setGravity({0, 50});
    world->step(kStep);
    EXPECT_FALSE(world->springAlive(0, 0));
    world->restore(whole);
    EXPECT_TRUE(world->springAlive(0, 0));
    world->step(kStep);
    EXPECT_EQ(world->bodies().velocity[0].y(), 0);
}

TEST(Snapshot, AForeignSnapshotIsRefusedAndChangesNothing)
{
    auto world = busyWorld();
    run(*world, 0.5);
    auto other = makeWorld({0, 0});
    other->addRigidBody(box({0, 0}, 1, 1));
    const std::uint64_t before = world->hash();
    EXPECT_THROW(world->restore(other->save()), Failure);
    EXPECT_THROW(world->restore({}), Failure);
    auto cut = world->save();
    cut.resize(cut.size() / 2);
    EXPECT_THROW(world->restore(cut), Failure);
    EXPECT_EQ(world->hash(), before);
}

/// Impulses are of a substep: the next step may be of another length.
TEST(Snapshot, TheStepAfterItMayBeOfAnyLength)
{
    for (const double next : {kStep / 7, kStep / 16, kStep / 3.1}) {
        auto world = busyWorld(), other = busyWorld();
        for (int i = 0; i < 150; ++i) world->step(kStep);
        other->restore(world->save());
        world->step(next), other->step(next);
        EXPECT_EQ(other->hash(), world->hash()) << next;
    }
}

/// What the springs ask of a step must not depend on when they tore.
TEST(Snapshot, ASpringBetweenBodiesThatToreBeforeIsTheSameToARestoredWorld)
{
    const auto make = [] {
        auto world = makeWorld({0, 50});
        world->addRigidBody(box({0, 0}, 10, 10));
        world->addRigidBody(box({60, 0}, 10, 10, 2));
        SpringActuatorDef spring;
        spring.a = {0, {3, 4}}, spring.b = {1, {57, 0}};
        spring.ks = 1e5;
        world->addSpring(spring);
        spring.a = {0, {5, 0}}, spring.b = {1, {60, 5}};
        spring.ks = 1e6, spring.restLength = 30, spring.tearRatio = 1.5;
        world->addSpring(spring);
        return world;
    };
    auto world = make(), other = make();
    for (int i = 0; i < 20; ++i) world->step(kStep);
    other->restore(world->save());
    for (int i = 0; i < 20; ++i) world->step(kStep), other->step(kStep);
    EXPECT_EQ(other->hash(), world->hash());
}

/// Angles of soft bodies are unwrapped from step to step; what is restored must not depend on how they came about.
TEST(Snapshot, RestoringWhatWasJustSavedChangesNoBit)
{
    auto world = makeWorld({0, 98.1});
    world->addRigidBody(ground(0));
    for (int i = 0; i < 12; ++i) world->addSoftBody(softBall({11.0 * (i % 4) + i, -12.0 - 24 * (i / 4)}, 10));
    for (int i = 0; i < 90; ++i) {
        world->step(kStep);
        const auto hash = world->hash();
        world->restore(world->save());
        ASSERT_EQ(world->hash(), hash) << "step " << i;
    }
}

std::string refusal(PhysicsWorld& world, std::span<const std::byte> state)
{
    try {
        world.restore(state);
    } catch (const Failure& failure) {
        return failure.error().message;
    }
    return {};
}

TEST(Snapshot, OneFlippedBitAnywhereIsRefusedAndChangesNothing)
{
    auto world = busyWorld();
    run(*world, 1);
    const auto saved = world->save();
    const std::uint64_t before = world->hash();
    for (std::size_t at = 0; at < saved.size(); at += at < 64 ? 1 : 977) {
        auto flipped = saved;
        flipped[at] ^= std::byte{1} << static_cast<int>(at % 8);
        EXPECT_FALSE(refusal(*world, flipped).empty()) << "byte " << at;
        ASSERT_EQ(world->hash(), before) << "byte " << at;
    }
    auto damaged = saved;
    damaged[saved.size() / 2] ^= std::byte{16};
    EXPECT_NE(refusal(*world, damaged).find("damaged"), std::string::npos);
    auto longer = saved;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(refusal(*world, longer).empty());
    EXPECT_EQ(refusal(*world, saved), "");
}

TEST(Snapshot, AWorldThatHasBecomeAnotherRefusesWhatItWas)
{
    auto world = busyWorld();
    run(*world, 0.5);
    const auto saved = world->save();
    world->addRigidBody(box({0, -250}, 10, 10));
    EXPECT_NE(refusal(*world, saved).find("it has 17 bodies, 0 joints"), std::string::npos) << refusal(*world, saved);
    auto one = makeWorld({0, 100}), other = makeWorld({0, 100});
    one->addRigidBody(simple(box({0, 0}, 10, 10)));
    other->addRigidBody(simple(box({0, 0}, 10, 12)));
    EXPECT_NE(refusal(*other, one->save()).find("other shapes"), std::string::npos) << refusal(*other, one->save());
}

}  // namespace

}  // namespace jet::physics::test
