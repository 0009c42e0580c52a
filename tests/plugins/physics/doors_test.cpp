// Nothing that a world tells is infinite or no number, even where bodies run away: a scene for each door that once told
// what is none. Masses and speeds are within what a world takes; what they give together is not within single
// precision.
#include "doors.hpp"

#include "snapshot.hpp"

#include <limits>

namespace jet::physics::test {

namespace {

std::unique_ptr<PhysicsWorld> worldOf(Precision precision, double gravity, double restitution = 0)
{
    WorldSettings settings;
    settings.precision = precision;
    settings.gravity = {0, gravity};
    settings.materials = {MaterialPair{0.6, restitution, true}};
    return JetPhysics().createWorld(settings);
}

RigidBodyDef ball(const Vec2& at, double radius, double mass)
{
    RigidBodyDef def;
    def.shapes = {{ShapeDef::Kind::Circle, {at}, radius}};
    def.mass = mass;
    return def;
}

/// A wheel of particles of a mass each about a hub.
SoftBodyDef wheel(const Vec2& at, double radius, double ks, double mass)
{
    SoftBodyDef def;
    def.particles = circleRing(at, radius, 10);
    def.particles.push_back(at);
    def.masses.assign(def.particles.size(), mass);
    auto& border = def.borders.emplace_back();
    for (std::uint32_t i = 0; i < 10; ++i) {
        const std::uint32_t next = (i + 1) % 10;
        def.springs.push_back({i, next, (def.particles[i] - def.particles[next]).norm(), ks, 1, 0});
        def.springs.push_back({i, 10, radius, ks, 1, 0});
        border.push_back(i);
    }
    return def;
}

void expectNumbers(PhysicsWorld& world, int steps)
{
    for (int i = 0; i < steps; ++i) {
        world.step(kStep);
        const std::string none = fieldWithoutNumber(world);
        ASSERT_TRUE(none.empty()) << "after step " << i << ", " << none << " is no number";
    }
}

}  // namespace

TEST(Doors, TheImpulseOfATouchThatBeginsIsANumber)
{
    auto world = worldOf(Precision::Double, 1e30);
    world->addRigidBody(ground(20));
    world->addRigidBody(ball({0, 15.1}, 5, 1e30));
    bool began = false;
    for (int i = 0; i < 8; ++i) {
        world->step(kStep);
        for (const ContactEvent& event : world->contactEvents()) {
            EXPECT_TRUE(std::isfinite(event.impulse)) << event.impulse;
            began |= event.begins && event.impulse > 0;
        }
    }
    EXPECT_TRUE(began);
}

TEST(Doors, TheImpulseOfAContactIsANumber)
{
    auto world = worldOf(Precision::Single, 1e21);
    world->addRigidBody(ground(20, 400));
    RigidBodyDef heavy = ball({0, 12}, 10, 1e26);
    heavy.common.omega = -1e8;
    world->addRigidBody(heavy);
    world->step(kStep);
    ASSERT_FALSE(world->contacts().empty());
    for (const Contact& c : world->contacts()) EXPECT_TRUE(std::isfinite(c.impulse)) << c.impulse;
}

/// Thrown by more in a substep than single precision holds.
TEST(Doors, ThePenetrationOfAContactIsANumber)
{
    auto world = worldOf(Precision::Single, 98.1, 1);
    world->addRigidBody(ground(20, 400));
    RigidBodyDef thrown;
    const Vec2 at(0, 22 - 1e4);
    thrown.shapes = {{ShapeDef::Kind::Capsule, {at, at + Vec2(1e4, 1e4)}, 5}};
    thrown.mass = 1e22;
    thrown.common.velocity = {0, 1e21};
    world->addRigidBody(thrown);
    expectNumbers(*world, 3);
}

TEST(Doors, TheMotionOfASoftBodyIsInNumbers)
{
    auto world = worldOf(Precision::Double, -1e7, 1);
    SoftBodyDef def = wheel({0, 22 - 1e10}, 1e10, 1e11, 1e-14);
    def.common.omega = -1e19;
    world->addSoftBody(def);
    JointDef rope;
    rope.kind = JointDef::Kind::Rope;
    rope.a = {0, {0, 10}}, rope.b.point = {5, 10}, rope.length = 1e6;
    world->addJoint(rope);
    expectNumbers(*world, 3);
}

TEST(Doors, TheMotionOfABodyWithoutAreaIsInNumbers)
{
    auto world = worldOf(Precision::Single, -1e26);
    world->addRigidBody(ground(20, 400));
    SoftBodyDef far = wheel({0, 22 - 1e9}, 1e9, 0.01, 1);
    far.common.velocity = {-1e15, 0}, far.common.omega = -1e25;
    world->addSoftBody(far);
    world->addRigidBody(rigid({{{12, 12}, {22, 12}, {17, 12}}}, 1e-24));
    JointDef suspension;
    suspension.kind = JointDef::Kind::Wheel;
    suspension.a = {1, {0, 10}}, suspension.b = {2, {0, 10}};
    world->addJoint(suspension);
    expectNumbers(*world, 3);
}

TEST(Doors, WhatAJointOfASoftBodyTellsIsANumber)
{
    auto world = worldOf(Precision::Double, 1e29, 1);
    world->addRigidBody(ground(20, 400));
    RigidBodyDef flat = rigid({{{0, 12}, {10, 12}, {5, 12}}}, 1);
    flat.common.velocity = {1e8, 0}, flat.common.omega = -1e12;
    world->addRigidBody(flat);
    SoftBodyDef def = wheel({12, 12}, 10, 1e10, 1e10);
    def.common.omega = -1e28;
    world->addSoftBody(def);
    JointDef pulley;
    pulley.kind = JointDef::Kind::Pulley;
    pulley.a = {1, {0, 10}}, pulley.b = {2, {5, 10}};
    pulley.groundA = {1e9, -100}, pulley.groundB = {10, -100};
    world->addJoint(pulley);
    world->addSpring({{2, {0, 10}}, {1, {1e9, 0}}, 0, 1e22, 1e4, 0});
    world->addTorque({{1, {0, 10}}, 1e13});
    expectNumbers(*world, 3);
}

/// A state that is sealed, but holds what no world ever saved.
TEST(Doors, AStateWithWhatIsNoNumberIsRefusedAndChangesNothing)
{
    auto world = makeWorld({0, 98.1});
    world->addRigidBody(box({0, 0}, 10, 10));
    world->addSoftBody(softBall({40, 0}, 10));
    world->setVelocity(0, {12345.5, 1});
    world->setVelocity(1, {54321.25, 1});
    for (const double odd : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        for (const double replaced : {12345.5, 54321.25}) {
            std::vector<std::byte> state = world->save();
            std::size_t found = 0;
            for (std::size_t at = kStateHead; at + sizeof odd <= state.size(); ++at) {
                double value = 0;
                std::memcpy(&value, &state[at], sizeof value);
                if (value != replaced) continue;
                std::memcpy(&state[at], &odd, sizeof odd);
                ++found;
            }
            ASSERT_GT(found, 0U);
            seal(state);
            const std::uint64_t before = world->hash();
            EXPECT_NE(refusalOf([&] { world->restore(state); }), "") << odd << " for " << replaced;
            EXPECT_EQ(world->hash(), before);
            EXPECT_EQ(fieldWithoutNumber(*world), "");
        }
    }
}

}  // namespace jet::physics::test
