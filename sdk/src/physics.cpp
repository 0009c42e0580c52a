#include <jet/physics.hpp>
#include <jet/physics_removal.hpp>
#include <jet/result.hpp>

namespace jet {

PhysicsWorld::~PhysicsWorld() = default;
PhysicsEngine::~PhysicsEngine() = default;
WorldRemoval::~WorldRemoval() = default;
LiveAngularSprings::~LiveAngularSprings() = default;

namespace {

[[noreturn]] void refuse(const char* what)
{
    throw Failure(Error(std::string("This physics engine has no ") + what + "; choose another one for this scene."));
}

}  // namespace

void PhysicsWorld::setSettings(const WorldSettings&) { refuse("settings that change while it runs"); }
void PhysicsWorld::setBody(BodyHandle, const BodyCommon&) { refuse("properties of bodies that change while it runs"); }
void PhysicsWorld::setMass(BodyHandle, double) { refuse("masses that change while it runs"); }
void PhysicsWorld::setEnabled(BodyHandle, bool) { refuse("bodies that can be switched off"); }
void PhysicsWorld::setJoint(JointHandle, const JointDef&) { refuse("joints"); }
void PhysicsWorld::setSpring(ActuatorHandle, double, double, double, double)
{
    refuse("springs that change while it runs");
}
ActuatorHandle PhysicsWorld::addForceField(const ForceFieldDef&) { refuse("fields of force"); }
void PhysicsWorld::setForceField(ActuatorHandle, const ForceFieldDef&) { refuse("fields of force"); }
void PhysicsWorld::setSoftMatter(BodyHandle, const SoftMatter&) { refuse("soft bodies"); }
void PhysicsWorld::setSprings(BodyHandle, double, double, double) { refuse("soft bodies"); }
void PhysicsWorld::setPinned(BodyHandle, std::uint32_t, bool) { refuse("soft bodies"); }
double PhysicsWorld::springTension(BodyHandle, std::uint32_t) const { refuse("soft bodies"); }
JointHandle PhysicsWorld::addJoint(const JointDef&) { refuse("joints"); }
JointState PhysicsWorld::joint(JointHandle) const { refuse("joints"); }
void PhysicsWorld::setMotor(JointHandle, bool, double) { refuse("joints"); }
void PhysicsWorld::setJointTarget(JointHandle, const Vec2&) { refuse("joints"); }
void PhysicsWorld::removeJoint(JointHandle) { refuse("joints"); }
std::optional<CastHit> PhysicsWorld::rayCast(const Vec2&, const Vec2&, const QueryFilter&) const
{
    refuse("queries of what is where");
}
std::optional<CastHit> PhysicsWorld::shapeCast(const ShapeDef&, const Vec2&, const QueryFilter&) const
{
    refuse("queries of what is where");
}
std::vector<BodyHandle> PhysicsWorld::overlapping(const Box&, const QueryFilter&) const
{
    refuse("queries of what is where");
}
std::optional<CastHit> PhysicsWorld::nearest(const Vec2&, double, const QueryFilter&) const
{
    refuse("queries of what is where");
}

std::string_view nameOf(ActuatorKind kind)
{
    switch (kind) {
    case ActuatorKind::Spring: return "spring";
    case ActuatorKind::AngularSpring: return "angular spring";
    case ActuatorKind::Torque: return "torque";
    case ActuatorKind::Force: return "force";
    case ActuatorKind::ForceField: return "force field";
    }
    throw Failure(Error("Physics: there is no such kind of actuator."));
}

WorldRemoval& removal(PhysicsWorld& world)
{
    if (auto* able = dynamic_cast<WorldRemoval*>(&world)) return *able;
    refuse("way to take bodies and actuators out of a world that runs");
}

const WorldRemoval& removal(const PhysicsWorld& world) { return removal(const_cast<PhysicsWorld&>(world)); }

LiveAngularSprings& liveAngularSprings(PhysicsWorld& world)
{
    if (auto* able = dynamic_cast<LiveAngularSprings*>(&world)) return *able;
    refuse("angular springs that change while it runs");
}

}  // namespace jet
