// Bodies and actuators that are taken out of a physics world while it runs: an ability of worlds beside PhysicsWorld,
// which an engine may lack. Also the one live change PhysicsWorld has no call for, that of angular springs.
//
//   auto& out = removal(world);
//   const BodyHandle bullet = world.addRigidBody(def);
//   ... steps ...
//   out.removeBody(bullet);
//
// Handles. From the call on a removed handle names nothing: every call with it is refused by a Failure that says so
// ("body 3 was removed"), and the world is as it was; queries do not see the body, and touching() is false. Its entry
// in bodies() stays, at rest and with an empty box, so that the entries of others keep their places; what else it says
// has no meaning. Something added later may take a removed handle over, so keep none. That of a body is given again
// after the next step at the earliest, as that step still tells the end of its contacts; that of an actuator, and of a
// joint (removed by removeJoint(), or with a body it held), with the next of its kind that is added.
//
// Memory. Engines use what a removed body had for another one built alike, with as many points, parts, particles and
// springs: a world that adds and removes bodies of a finite number of shapes needs no more memory than for those that
// lived at once, shape by shape.
//
// Snapshots and hashes. What was added and removed, in which order, is part of what a world is made of: a state saved
// before it is refused after it, as of a world made otherwise; states saved since are restored bit-equal. Equal
// histories of adding, removing and steps give equal hashes. Mouse joints between a body and the background are the
// exception: they come and go as a hand drags bodies, and belong to the state that is saved, with all that they are.
//
// Threads: as PhysicsWorld, by the thread that has the world.
#pragma once

#include <jet/physics.hpp>

#include <string_view>

namespace jet {

/// Actuators have handles per kind.
enum class ActuatorKind : std::uint8_t { Spring, AngularSpring, Torque, Force, ForceField };
/// As messages call it: "angular spring". Throws a Failure where there is no such kind.
JET_API std::string_view nameOf(ActuatorKind);

class JET_API WorldRemoval {
public:
    virtual ~WorldRemoval();

    /// Takes it out between steps, with every joint, spring, angular spring, torque and force that holds it. What lay
    /// on it, touched it or was held by it wakes; the end of its contacts is told by contactEvents() of the next step.
    /// Fields of force are no part of a body. Refused where there is no such body, or it was removed before.
    virtual void removeBody(BodyHandle) = 0;
    /// What it held wakes. Refused where there is no such actuator, or it was removed before.
    virtual void removeActuator(ActuatorKind, ActuatorHandle) = 0;

    /// Is there such a body, actuator, or joint now? False for any number that names none; a broken joint exists until
    /// it is removed.
    virtual bool hasBody(BodyHandle) const = 0;
    virtual bool hasActuator(ActuatorKind, ActuatorHandle) const = 0;
    virtual bool hasJoint(JointHandle) const = 0;
};

/// Angular springs between bodies whose values change while the world runs.
class JET_API LiveAngularSprings {
public:
    virtual ~LiveAngularSprings();

    /// restAngle: radians, from a to b about the centre; the spring goes there the short way. None: as it is. ks:
    /// torque / rad, kd: torque / (rad/s), both 0 to 1e30. What it holds wakes when something changes.
    virtual void setAngularSpring(ActuatorHandle angularSpring, std::optional<double> restAngle, double ks,
                                  double kd) = 0;
};

/// The world's own, as long as the world lives; throws a Failure that tells to choose another engine where it has none.
JET_API WorldRemoval& removal(PhysicsWorld&);
JET_API const WorldRemoval& removal(const PhysicsWorld&);
JET_API LiveAngularSprings& liveAngularSprings(PhysicsWorld&);

}  // namespace jet
