// A world that passes every call on to another one: base of those that look at what is added.
#pragma once

#include <jet/physics_removal.hpp>

#include <utility>

namespace jet {

class ForwardingWorld : public PhysicsWorld, public WorldRemoval, public LiveAngularSprings {
public:
    explicit ForwardingWorld(PhysicsWorld& world) : world_(world) {}

    BodyHandle addSoftBody(const SoftBodyDef& def) override { return world_.addSoftBody(def); }
    BodyHandle addRigidBody(const RigidBodyDef& def) override { return world_.addRigidBody(def); }
    ActuatorHandle addSpring(const SpringActuatorDef& def) override { return world_.addSpring(def); }
    ActuatorHandle addAngularSpring(const AngularSpringActuatorDef& def) override
    {
        return world_.addAngularSpring(def);
    }
    ActuatorHandle addTorque(const TorqueActuatorDef& def) override { return world_.addTorque(def); }
    ActuatorHandle addForce(const ForceActuatorDef& def) override { return world_.addForce(def); }
    ActuatorHandle addForceField(const ForceFieldDef& def) override { return world_.addForceField(def); }
    JointHandle addJoint(const JointDef& def) override { return world_.addJoint(def); }

    void step(double dt) override { world_.step(dt); }

    std::size_t bodyCount() const override { return world_.bodyCount(); }
    BodyStates bodies() const override { return world_.bodies(); }
    std::span<const Contact> contacts() const override { return world_.contacts(); }
    StepStats stats() const override { return world_.stats(); }
    bool touching(BodyHandle a, BodyHandle b) const override { return world_.touching(a, b); }
    bool contains(BodyHandle body, const Vec2& point) const override { return world_.contains(body, point); }
    bool springAlive(BodyHandle body, std::uint32_t index) const override { return world_.springAlive(body, index); }
    double springTension(BodyHandle body, std::uint32_t index) const override
    {
        return world_.springTension(body, index);
    }
    std::span<const std::uint32_t> pieces(BodyHandle body) const override { return world_.pieces(body); }
    std::vector<std::vector<std::uint32_t>> borders(BodyHandle body) const override { return world_.borders(body); }
    std::size_t jointCount() const override { return world_.jointCount(); }
    JointState joint(JointHandle handle) const override { return world_.joint(handle); }
    bool awake(BodyHandle body) const override { return world_.awake(body); }
    std::uint32_t island(BodyHandle body) const override { return world_.island(body); }
    std::span<const ContactEvent> contactEvents() const override { return world_.contactEvents(); }
    std::optional<CastHit> rayCast(const Vec2& from, const Vec2& to, const QueryFilter& filter) const override
    {
        return world_.rayCast(from, to, filter);
    }
    std::optional<CastHit> shapeCast(const ShapeDef& shape, const Vec2& way, const QueryFilter& filter) const override
    {
        return world_.shapeCast(shape, way, filter);
    }
    std::vector<BodyHandle> overlapping(const Box& box, const QueryFilter& filter) const override
    {
        return world_.overlapping(box, filter);
    }
    std::optional<CastHit> nearest(const Vec2& point, double reach, const QueryFilter& filter) const override
    {
        return world_.nearest(point, reach, filter);
    }
    std::uint64_t hash() const override { return world_.hash(); }
    std::vector<std::byte> save() const override { return world_.save(); }
    void restore(std::span<const std::byte> state) override { world_.restore(state); }

    void setTorque(ActuatorHandle torque, double value) override { world_.setTorque(torque, value); }
    void setForce(ActuatorHandle force, const Vec2& value) override { world_.setForce(force, value); }
    void applyForce(BodyHandle body, const Vec2& force) override { world_.applyForce(body, force); }
    void applyImpulse(BodyHandle body, const Vec2& impulse) override { world_.applyImpulse(body, impulse); }
    void setVelocity(BodyHandle body, const Vec2& velocity) override { world_.setVelocity(body, velocity); }
    void setOmega(BodyHandle body, double omega) override { world_.setOmega(body, omega); }
    void setPosition(BodyHandle body, const Vec2& centre) override { world_.setPosition(body, centre); }
    void setGravity(const Vec2& gravity) override { world_.setGravity(gravity); }
    void setSettings(const WorldSettings& settings) override { world_.setSettings(settings); }
    void setBody(BodyHandle body, const BodyCommon& common) override { world_.setBody(body, common); }
    void setMass(BodyHandle body, double mass) override { world_.setMass(body, mass); }
    void setEnabled(BodyHandle body, bool enabled) override { world_.setEnabled(body, enabled); }
    void setJoint(JointHandle joint, const JointDef& def) override { world_.setJoint(joint, def); }
    void setSpring(ActuatorHandle spring, double restLength, double ks, double kd, double tearRatio) override
    {
        world_.setSpring(spring, restLength, ks, kd, tearRatio);
    }
    void setForceField(ActuatorHandle field, const ForceFieldDef& def) override { world_.setForceField(field, def); }
    void setSoftMatter(BodyHandle body, const SoftMatter& matter) override { world_.setSoftMatter(body, matter); }
    void setSprings(BodyHandle body, double ks, double kd, double tearRatio) override
    {
        world_.setSprings(body, ks, kd, tearRatio);
    }
    void setPinned(BodyHandle body, std::uint32_t particle, bool pinned) override
    {
        world_.setPinned(body, particle, pinned);
    }
    void setMotor(JointHandle joint, bool driven, double speed) override { world_.setMotor(joint, driven, speed); }
    void setJointTarget(JointHandle joint, const Vec2& target) override { world_.setJointTarget(joint, target); }
    void removeJoint(JointHandle joint) override { world_.removeJoint(joint); }
    void wake(BodyHandle body) override { world_.wake(body); }

    void removeBody(BodyHandle body) override { removal(world_).removeBody(body); }
    void removeActuator(ActuatorKind kind, ActuatorHandle actuator) override
    {
        removal(world_).removeActuator(kind, actuator);
    }
    bool hasBody(BodyHandle body) const override { return removal(std::as_const(world_)).hasBody(body); }
    bool hasActuator(ActuatorKind kind, ActuatorHandle actuator) const override
    {
        return removal(std::as_const(world_)).hasActuator(kind, actuator);
    }
    bool hasJoint(JointHandle joint) const override { return removal(std::as_const(world_)).hasJoint(joint); }
    void setAngularSpring(ActuatorHandle spring, std::optional<double> restAngle, double ks, double kd) override
    {
        liveAngularSprings(world_).setAngularSpring(spring, restAngle, ks, kd);
    }

protected:
    PhysicsWorld& world_;
};

}  // namespace jet
