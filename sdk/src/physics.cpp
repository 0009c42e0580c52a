#include <jet/physics.hpp>
#include <jet/result.hpp>

namespace jet {

PhysicsWorld::~PhysicsWorld() = default;
PhysicsEngine::~PhysicsEngine() = default;

namespace {

[[noreturn]] void refuse(const char* what)
{
    throw Failure(Error(std::string("This physics engine has no ") + what + "; choose another one for this scene."));
}

}  // namespace

JointHandle PhysicsWorld::addJoint(const JointDef&) { refuse("joints"); }
JointState PhysicsWorld::joint(JointHandle) const { refuse("joints"); }
void PhysicsWorld::setMotor(JointHandle, bool, double) { refuse("joints"); }
void PhysicsWorld::setJointTarget(JointHandle, const Vec2&) { refuse("joints"); }
void PhysicsWorld::removeJoint(JointHandle) { refuse("joints"); }
std::optional<CastHit> PhysicsWorld::rayCast(const Vec2&, const Vec2&, const QueryFilter&) const { return {}; }
std::optional<CastHit> PhysicsWorld::shapeCast(const ShapeDef&, const Vec2&, const QueryFilter&) const { return {}; }
std::vector<BodyHandle> PhysicsWorld::overlapping(const Box&, const QueryFilter&) const { return {}; }
std::optional<CastHit> PhysicsWorld::nearest(const Vec2&, double, const QueryFilter&) const { return {}; }

}  // namespace jet
