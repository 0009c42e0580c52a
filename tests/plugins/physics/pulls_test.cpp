// Mouse joints with the background come and go while a world runs: a state of before, of the midst or of after can be
// restored at any time, and goes on bit-equal.
#include "lattices.hpp"
#include "snapshot.hpp"

#include <jet/physics_removal.hpp>
#include <jet/result.hpp>

#include <cstring>
#include <functional>

namespace jet::physics::test {

namespace {

constexpr int kGrab = 20, kLetGo = 60, kGrabAgain = 75, kEnd = 100;

using Bytes = std::vector<std::byte>;

JointDef pullOn(BodyHandle body, const Vec2& at, double radius = 0)
{
    JointDef def;
    def.kind = JointDef::Kind::Mouse;
    def.a.point = at, def.b = {body, at, radius};
    def.hertz = 5, def.dampingRatio = 0.9, def.maxForce = 4000;
    return def;
}

/// A heap of boxes and discs on a ground, a chain that hangs, and, where `soft`, balls among them.
std::unique_ptr<PhysicsWorld> heap(bool soft, bool sleeps, Precision precision = Precision::Automatic)
{
    WorldSettings settings;
    settings.materials = {MaterialPair{0.5, 0.1, true}};
    settings.allowSleep = sleeps;
    settings.precision = precision;
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(ground(0));
    for (int i = 0; i < 10; ++i)
        world->addRigidBody(box({-40.0 + 20 * (i % 5), -12.0 - 22 * (i / 5)}, 18, 18, 1 + 0.1 * i, 0.05 * i));
    for (int i = 0; i < 3; ++i) {
        const BodyHandle link = world->addRigidBody(box({150.0 + 20 * i, -100}, 18, 6));
        JointDef hinge;
        hinge.a = {i == 0 ? kNoHandle : link - 1, {141.0 + 20 * i, -100}}, hinge.b = {link, {141.0 + 20 * i, -100}};
        world->addJoint(hinge);
    }
    if (soft)
        for (int i = 0; i < 2; ++i) world->addSoftBody(defaultBall({-150.0 + 60 * i, -40}, 20, 60));
    return world;
}

struct Held {
    BodyHandle body;
    double radius;
};

/// What the hand does before the step with this number; the joint is always the same one.
void act(PhysicsWorld& world, int step, const Held& held, JointHandle& hand)
{
    if (step == kGrab || step == kGrabAgain)
        hand = world.addJoint(pullOn(held.body, world.bodies().position[held.body], held.radius));
    if (step > kGrab && step < kLetGo)
        world.setJointTarget(hand, {100 * std::sin(0.1 * step), -120 + 20 * std::cos(0.2 * step)});
    if (step == kLetGo) world.removeJoint(hand);
}

void expectAnyStateGoesOn(const std::function<std::unique_ptr<PhysicsWorld>()>& make, const Held& held)
{
    auto world = make();
    JointHandle hand = kNoHandle;
    std::vector<Bytes> states;
    std::vector<std::size_t> joints;
    for (int step = 0; step < kEnd; ++step) {
        states.push_back(world->save());
        joints.push_back(world->jointCount());
        act(*world, step, held, hand);
        world->step(kStep);
    }
    const Bytes last = world->save();
    const JointHandle theHand = hand;
    const auto goOn = [&](PhysicsWorld& from, int start) {
        from.restore(states[start]);
        ASSERT_EQ(from.save(), states[start]) << start;
        ASSERT_EQ(from.jointCount(), joints[start]) << start;
        JointHandle own = theHand;
        for (int step = start; step < kEnd; ++step) {
            ASSERT_EQ(from.save(), states[step]) << "from " << start << ", step " << step;
            act(from, step, held, own);
            ASSERT_EQ(own, theHand);
            from.step(kStep);
        }
        ASSERT_EQ(from.save(), last) << start;
    };
    for (const int start : {kGrab + 15, 5, kEnd - 1, kGrab, kGrab + 1, kLetGo, kLetGo + 1, kGrabAgain + 2, 0}) {
        goOn(*world, start);
        goOn(*make(), start);
    }
    // From the midst of one drag into that of the next, and back.
    for (const int at : {kGrab + 10, kGrabAgain + 5, kGrab + 30, 3, kGrabAgain + 10}) {
        world->restore(states[at]);
        ASSERT_EQ(world->save(), states[at]) << at;
    }
}

}  // namespace

TEST(Pulls, AStateOfBeforeDuringOrAfterADragOfARigidBodyGoesOnBitEqual)
{
    for (const Precision precision : {Precision::Single, Precision::Double})
        expectAnyStateGoesOn([=] { return heap(false, false, precision); }, {3, 0});
}

TEST(Pulls, SoDoesOneOfASoftBody)
{
    expectAnyStateGoesOn([] { return heap(true, false); }, {14, 12});
}

TEST(Pulls, SoDoesOneOfARigidBodyAmongSoftOnes)
{
    expectAnyStateGoesOn([] { return heap(true, false); }, {3, 0});
}

TEST(Pulls, SoDoesOneThatSleptBefore)
{
    for (const bool soft : {false, true})
        expectAnyStateGoesOn(
            [=] {
                auto world = heap(soft, true);
                run(*world, 20);
                return world;
            },
            {static_cast<BodyHandle>(soft ? 15 : 8), soft ? 12.0 : 0});
}

TEST(Pulls, SoDoesOneOfAChain)
{
    expectAnyStateGoesOn([] { return heap(false, false); }, {13, 0});
}

TEST(Pulls, AJointOfAnotherKindNeverTakesThePlaceOfOneNorTheOtherWayRound)
{
    for (const bool soft : {false, true}) {
        auto world = makeWorld({0, 0});
        soft ? world->addSoftBody(defaultBall({0, 0}, 20)) : world->addRigidBody(box({0, 0}, 20, 20));
        JointDef pin;
        pin.a.point = {0, 0}, pin.b = {0, {0, 0}, 8};
        const JointHandle pull = world->addJoint(pullOn(0, {0, 0}, 8));
        world->removeJoint(pull);
        const JointHandle pinned = world->addJoint(pin);
        EXPECT_NE(pinned, pull);
        world->removeJoint(pinned);
        EXPECT_EQ(world->addJoint(pullOn(0, {0, 0}, 8)), pull);
        EXPECT_EQ(world->addJoint(pin), pinned);
        EXPECT_EQ(world->jointCount(), 2u);
    }
}

TEST(Pulls, WhatIsAddedForGoodBesideOneIsStillPartOfWhatAWorldIsMadeOf)
{
    auto world = heap(true, false);
    const Bytes before = world->save();
    const JointHandle hand = world->addJoint(pullOn(3, world->bodies().position[3]));
    JointDef pin;
    pin.a.point = {0, -100}, pin.b = {4, world->bodies().position[4]};
    world->addJoint(pin);
    const Bytes after = world->save();
    EXPECT_THROW(world->restore(before), Failure);
    EXPECT_EQ(world->save(), after);
    // Without the hand that joint has another place: another world.
    auto other = heap(true, false);
    other->addJoint(pin);
    EXPECT_THROW(other->restore(after), Failure);
    EXPECT_THROW(world->restore(other->save()), Failure);
    world->removeJoint(hand);
    world->step(kStep);
    world->restore(after);
    EXPECT_EQ(world->save(), after);
    EXPECT_TRUE(removal(*world).hasJoint(hand));
}

TEST(Pulls, AStateThatNamesWhatIsNotThereIsRefusedAndChangesNothing)
{
    for (const Held held : {Held{3, 0}, Held{14, 12}}) {
        auto world = heap(true, false);
        world->addJoint(pullOn(held.body, world->bodies().position[held.body], held.radius));
        world->step(kStep);
        const Bytes state = world->save();
        auto plain = heap(true, false);
        const Bytes was = plain->save();
        // Numbers of bodies, nodes and places in the block of pulls at the end, made greater than all there are.
        int refused = 0;
        for (std::size_t at = state.size() - 700; at + 8 < state.size(); at += 4) {
            Bytes wrong = state;
            const std::uint32_t none = 0x7fffffff;
            std::memcpy(wrong.data() + at, &none, sizeof none);
            seal(wrong);
            try {
                plain->restore(wrong);
                plain->restore(was);
            } catch (const Failure&) {
                ++refused;
            }
            ASSERT_EQ(plain->save(), was) << "byte " << at;
        }
        EXPECT_GT(refused, 10);
        plain->restore(state);
        EXPECT_EQ(plain->save(), state);
    }
}

TEST(Pulls, ABodyThatIsTakenOutTakesItsPullAlong)
{
    auto world = heap(true, false);
    const JointHandle hand = world->addJoint(pullOn(14, world->bodies().position[14], 12));
    removal(*world).removeBody(14);
    EXPECT_FALSE(removal(*world).hasJoint(hand));
    const Bytes state = world->save();
    run(*world, 0.5);
    world->restore(state);
    EXPECT_EQ(world->save(), state);
}

/// At rest the spring bears the weight: m g = k x, with k = m w².
TEST(Pulls, AHangingBodyRestsItsWeightOverTheStiffnessBelowTheHand)
{
    auto world = makeWorld({0, 98.1});
    RigidBodyDef disc;
    disc.shapes.push_back({ShapeDef::Kind::Circle, {Vec2(0, 0)}, 10});
    disc.mass = 7;
    world->addRigidBody(disc);
    JointDef def = pullOn(0, {0, 0});
    def.maxForce = 7 * 9810;
    world->addJoint(def);
    run(*world, 5);
    const double omega = 2 * 3.14159265358979 * 5;
    EXPECT_NEAR(world->bodies().position[0].y(), 98.1 / (omega * omega), 1e-4);
}

}  // namespace jet::physics::test
