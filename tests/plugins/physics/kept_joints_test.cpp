// Constraints of joints stay from step to step: whatever changes between two steps must count as if they had been made
// anew. A world that is restored from what it saved makes them anew.
#include "shape_worlds.hpp"

#include <functional>

namespace jet::physics::test {

namespace {

constexpr int kSide = 8;

using Change = std::function<void(PhysicsWorld&)>;

/// Steps two worlds, the second of which is restored before each step; `change` comes before the fifth.
void expectAsMadeAnew(Precision precision, const Change& change)
{
    WorldSettings settings = shapeSettings();
    settings.precision = precision;
    const auto kept = netWorld(settings, kSide), anew = netWorld(settings, kSide);
    for (int i = 0; i < 12; ++i) {
        for (PhysicsWorld* world : {kept.get(), anew.get()}) {
            if (i == 5) change(*world);
            if (world == anew.get()) world->restore(std::vector<std::byte>(world->save()));
            world->step(i < 9 ? kStep : kStep / 2);
        }
        for (JointHandle joint = 0; joint < kept->jointCount(); ++joint) {
            const JointState one = kept->joint(joint), other = anew->joint(joint);
            ASSERT_EQ(one.force, other.force) << "joint " << joint << ", step " << i;
            ASSERT_EQ(one.torque, other.torque) << "joint " << joint << ", step " << i;
            ASSERT_EQ(one.broken, other.broken) << "joint " << joint << ", step " << i;
        }
        ASSERT_EQ(kept->save(), anew->save()) << "step " << i;
    }
}

class KeptJoints : public testing::TestWithParam<Precision> {};

TEST_P(KeptJoints, NothingChanges)
{
    expectAsMadeAnew(GetParam(), [](PhysicsWorld&) {});
}
TEST_P(KeptJoints, OneIsRemovedAndOneIsAdded)
{
    expectAsMadeAnew(GetParam(), [](PhysicsWorld& world) {
        world.removeJoint(7);
        JointDef joint;
        joint.kind = JointDef::Kind::Weld;
        joint.a = {20, world.bodies().position[20]}, joint.b = {29, world.bodies().position[20]};
        world.addJoint(joint);
    });
}
TEST_P(KeptJoints, OneBreaks)
{
    expectAsMadeAnew(GetParam(), [](PhysicsWorld& world) {
        JointDef joint;
        joint.breakForce = 5;
        world.setJoint(3, joint);
    });
}
TEST_P(KeptJoints, AMotorIsSwitchedOn)
{
    expectAsMadeAnew(GetParam(), [](PhysicsWorld& world) {
        JointDef joint;
        joint.maxTorque = 1e4;
        world.setJoint(4, joint);
        world.setMotor(4, true, 3);
    });
}
TEST_P(KeptJoints, ABodyStands)
{
    expectAsMadeAnew(GetParam(), [](PhysicsWorld& world) {
        BodyCommon common;
        common.kinematic = true;
        world.setBody(20, common);
        world.setVelocity(20, {3, 0});
    });
}
TEST_P(KeptJoints, ABodyIsSwitchedOff)
{
    expectAsMadeAnew(GetParam(), [](PhysicsWorld& world) { world.setEnabled(20, false); });
}
TEST_P(KeptJoints, ABodyComesThatIsHeldByTheBackground)
{
    expectAsMadeAnew(GetParam(), [](PhysicsWorld& world) {
        RigidBodyDef def;
        def.shapes.push_back({ShapeDef::Kind::Circle, {Vec2(-30, 0)}, 4});
        JointDef joint;
        joint.b = {world.addRigidBody(def), {-30, -6}}, joint.a.point = {-30, -6};
        const JointHandle at = world.addJoint(joint);
        world.setJointTarget(at, {-31, -5});
    });
}

INSTANTIATE_TEST_SUITE_P(Precisions, KeptJoints, testing::Values(Precision::Single, Precision::Double),
                         [](const auto& each) { return each.param == Precision::Single ? "Single" : "Double"; });

TEST(KeptJoints, ATargetThatMovesIsFollowedInEveryStep)
{
    auto world = JetPhysics().createWorld(shapeSettings());
    RigidBodyDef def;
    def.shapes.push_back({ShapeDef::Kind::Circle, {Vec2(0, 10)}, 4});
    JointDef joint;
    joint.b = {world->addRigidBody(def), {0, 0}};
    const JointHandle at = world->addJoint(joint);
    for (int i = 0; i < 60; ++i) {
        world->setJointTarget(at, {0.1 * i, 0});
        world->step(kStep);
        const JointState state = world->joint(at);
        ASSERT_NEAR((state.pointB - state.pointA).norm(), 0, 0.2) << i;
    }
}

}  // namespace

}  // namespace jet::physics::test
