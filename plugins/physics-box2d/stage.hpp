// A Box2D world and what surrounds it. Everything that changes while playing is in here, so that a snapshot can be
// played again in a new one (history.hpp).
#pragma once

#include "contact_book.hpp"
#include "outline.hpp"

#include <jet/physics_removal.hpp>

#include <box2d/b2_joint.h>
#include <box2d/b2_world.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>

class b2DistanceJoint;

namespace jet::box2d {

struct Body {
    b2Body* body = nullptr;
    BodyCommon common;
    double mass = 1;
    double second = 0;                  // moment of inertia about the centre of mass, per mass, square units
    Ring local;                         // border points about the centre of mass
    std::vector<std::size_t> ringEnds;  // in `local`
    bool solid = true;                  // made of closed rings; not of shapes
    double thinnest = 0;                // units: the smaller side of its box at rest
    Vec2 force{0, 0};                   // for the next step only
    bool removed = false;               // a body of Box2D's that is nothing keeps its place
};

struct Spring {
    b2DistanceJoint* joint = nullptr;
    SpringActuatorDef def;
    bool torn = false, removed = false;
};

struct End {
    b2Body* body = nullptr;
    b2Vec2 local{0, 0};
};

struct AngularSpring {
    AngularSpringActuatorDef def;
    End a, centre, b;
    double rest = 0, angle = 0;  // the latter unwrapped from step to step
    bool removed = false;
};

struct Torque {
    b2Body* body = nullptr;
    double value = 0;
    bool removed = false;
};

struct Force {
    End at;
    Vec2 value{0, 0};
    bool removed = false;
};

struct Joint {
    JointDef def;
    b2Joint* joint = nullptr;                       // null: broken or removed
    b2Body *groundA = nullptr, *groundB = nullptr;  // where it holds the background
    b2Vec2 localTarget{0, 0};                       // of a mouse joint that follows a body, in that body's frame
    double restAngle = 0, length = 0;
    JointState state;  // the last one, once it is broken
    bool removed = false;
};

class Stage {
public:
    explicit Stage(const WorldSettings&);

    BodyHandle add(const RigidBodyDef&);
    ActuatorHandle add(const SpringActuatorDef&);
    ActuatorHandle add(const AngularSpringActuatorDef&);
    ActuatorHandle add(const TorqueActuatorDef&);
    ActuatorHandle add(const ForceActuatorDef&);
    JointHandle add(const JointDef&);

    void step(double dt);

    void setSettings(const WorldSettings&);
    void setBody(BodyHandle, const BodyCommon&);
    void setMass(BodyHandle, double mass);
    void setEnabled(BodyHandle, bool enabled);
    void setPosition(BodyHandle, const Vec2& centre);
    void setVelocity(BodyHandle, const Vec2&);
    void setOmega(BodyHandle, double omega);
    void setGravity(const Vec2&);
    void setTorque(ActuatorHandle, double value);
    void setForce(ActuatorHandle, const Vec2& value);
    void setSpring(ActuatorHandle, double restLength, double ks, double kd, double tearRatio);
    void setJoint(JointHandle, const JointDef&);
    void setJointTarget(JointHandle, const Vec2& target);
    void removeJoint(JointHandle);
    void setAngularSpring(ActuatorHandle, std::optional<double> restAngle, double ks, double kd);
    // See removal.cpp.
    void removeBody(BodyHandle);
    void removeActuator(ActuatorKind, ActuatorHandle);
    bool has(ActuatorKind, ActuatorHandle) const;
    std::size_t count(ActuatorKind) const;
    void applyForce(BodyHandle, const Vec2& force);
    void applyImpulse(BodyHandle, const Vec2& impulse);
    void wake(BodyHandle);

    const WorldSettings& settings() const { return settings_; }
    const b2World& world() const { return *world_; }
    const std::vector<Body>& bodies() const { return bodies_; }
    const std::vector<Joint>& joints() const { return joints_; }
    const std::vector<Spring>& springs() const { return springs_; }
    const std::vector<Torque>& torques() const { return torques_; }
    const std::vector<Force>& forces() const { return forces_; }
    const std::vector<AngularSpring>& angularSprings() const { return angularSprings_; }
    const std::vector<Contact>& contacts() const { return reports_; }
    const ContactBook& book() const { return book_; }
    const StepStats& stats() const { return stats_; }
    /// How often something was added or removed.
    std::uint32_t changes() const { return changes_; }
    JointState stateOf(const Joint&) const;
    std::vector<std::uint32_t> islands() const;

private:
    BodyHandle nextBody() const;
    void createPlaceholder(BodyHandle, const b2Vec2& at);
    End end(const Anchor&);
    b2Body* background(const Vec2& at);
    void applyMass(Body&);
    void applySettings();
    static void refilter(const Body&);
    void applySpring(Spring&);
    void configure(Joint&);
    void connect(Joint&);
    void breakJoint(Joint&);
    void findJoined();

    int substepsOf(double dt) const;
    void watchFastBodies(double h);
    void dampen(double h);
    void refuseNoNumbers() const;
    void pushBodies(double h);
    void push(AngularSpring&, double h) const;
    void steer(Joint&, double h) const;
    void tearAndBreak(double h);

    WorldSettings settings_;
    std::vector<Body> bodies_;
    ContactBook book_;
    std::unique_ptr<b2World> world_;
    b2Body* ground_ = nullptr;
    std::vector<Spring> springs_;
    std::vector<AngularSpring> angularSprings_;
    std::vector<Torque> torques_;
    std::vector<Force> forces_;
    std::vector<Joint> joints_;
    std::vector<Contact> reports_;
    StepStats stats_;
    double lastSubstep_ = 1.0 / 60;
    std::set<BodyHandle> free_;           // removed, for bodies that are added
    std::vector<BodyHandle> removedNow_;  // since the last step
    std::uint32_t changes_ = 0;
};

/// One more, at its handle: that of the first that was removed, else behind all others.
template <class Actuator>
ActuatorHandle put(std::vector<Actuator>& all, const Actuator& one)
{
    const auto free = std::find_if(all.begin(), all.end(), [](const Actuator& other) { return other.removed; });
    const auto handle = static_cast<ActuatorHandle>(free - all.begin());
    if (free == all.end()) {
        all.push_back(one);
    } else {
        *free = one;
    }
    return handle;
}

/// Border point or centre of a body now, scene units.
Vec2 placeOf(const Body&, const Vec2& local);
BodyHandle handleOf(const b2Body&);

}  // namespace jet::box2d
