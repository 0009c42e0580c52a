// The contract's world: checks what it is given, does it on a stage, and remembers it for snapshots.
#pragma once

#include "history.hpp"
#include "stage.hpp"

#include <functional>

namespace jet::box2d {

class World final : public PhysicsWorld, public WorldRemoval, public LiveAngularSprings {
public:
    explicit World(const WorldSettings&);

    BodyHandle addSoftBody(const SoftBodyDef&) override;
    BodyHandle addRigidBody(const RigidBodyDef&) override;
    ActuatorHandle addSpring(const SpringActuatorDef&) override;
    ActuatorHandle addAngularSpring(const AngularSpringActuatorDef&) override;
    ActuatorHandle addTorque(const TorqueActuatorDef&) override;
    ActuatorHandle addForce(const ForceActuatorDef&) override;
    JointHandle addJoint(const JointDef&) override;

    void step(double dt) override;

    std::size_t bodyCount() const override { return stage_->bodies().size(); }
    BodyStates bodies() const override;
    std::span<const Contact> contacts() const override { return stage_->contacts(); }
    StepStats stats() const override { return stage_->stats(); }
    bool touching(BodyHandle a, BodyHandle b) const override;
    bool contains(BodyHandle body, const Vec2& point) const override;

    void setTorque(ActuatorHandle, double value) override;
    void setForce(ActuatorHandle, const Vec2& value) override;
    void applyForce(BodyHandle, const Vec2& force) override;
    void applyImpulse(BodyHandle, const Vec2& impulse) override;
    void setVelocity(BodyHandle, const Vec2& velocity) override;
    void setOmega(BodyHandle, double omega) override;
    void setPosition(BodyHandle, const Vec2& centre) override;
    void setGravity(const Vec2& gravity) override;
    bool springAlive(BodyHandle, std::uint32_t) const override;

    void setSettings(const WorldSettings&) override;
    void setBody(BodyHandle, const BodyCommon&) override;
    void setMass(BodyHandle, double mass) override;
    void setEnabled(BodyHandle, bool enabled) override;
    void setJoint(JointHandle, const JointDef&) override;
    void setSpring(ActuatorHandle, double restLength, double ks, double kd, double tearRatio) override;

    std::size_t jointCount() const override { return stage_->joints().size(); }
    JointState joint(JointHandle) const override;
    void setMotor(JointHandle, bool driven, double speed) override;
    void setJointTarget(JointHandle, const Vec2& target) override;
    void removeJoint(JointHandle) override;

    void setAngularSpring(ActuatorHandle, std::optional<double> restAngle, double ks, double kd) override;

    void removeBody(BodyHandle) override;
    void removeActuator(ActuatorKind, ActuatorHandle) override;
    bool hasBody(BodyHandle) const override;
    bool hasActuator(ActuatorKind, ActuatorHandle) const override;
    bool hasJoint(JointHandle) const override;

    bool awake(BodyHandle) const override;
    void wake(BodyHandle) override;
    std::uint32_t island(BodyHandle) const override;
    std::span<const ContactEvent> contactEvents() const override { return stage_->book().events(); }

    std::optional<CastHit> rayCast(const Vec2& from, const Vec2& to, const QueryFilter&) const override;
    std::optional<CastHit> shapeCast(const ShapeDef&, const Vec2& way, const QueryFilter&) const override;
    std::vector<BodyHandle> overlapping(const Box&, const QueryFilter&) const override;
    std::optional<CastHit> nearest(const Vec2& point, double reach, const QueryFilter&) const override;

    std::uint64_t hash() const override;
    std::vector<std::byte> save() const override;
    void restore(std::span<const std::byte> state) override;

private:
    using Special = std::function<void(Stage&)>;
    /// Its handle.
    template <class Def>
    std::uint32_t adds(const Def& def)
    {
        const std::uint32_t handle = stage_->add(def);
        remember([def](Stage& stage) { stage.add(def); });
        return handle;
    }
    void remember(Special);

    void requireBody(BodyHandle) const;
    void requireBodies(std::initializer_list<const Anchor*>) const;
    void requireJoint(JointHandle) const;
    void requireActuator(ActuatorKind, ActuatorHandle) const;
    void does(const Entry&);
    void doesSpecial(Special);
    void play(Stage&, const Entry&) const;
    std::unique_ptr<Stage> again(const History&) const;
    void changed() { stale_ = true; }

    WorldSettings settings_;  // as it was made
    std::unique_ptr<Stage> stage_;
    History history_;
    std::vector<Special> special_;

    // What bodies() shows.
    struct Readings {
        std::vector<Vec2> position, velocity, points;
        std::vector<double> angle, omega;
        std::vector<Box> bounds;
        std::vector<std::uint32_t> firstPoint;
    };
    void read() const;
    mutable Readings readings_;
    mutable bool stale_ = true;
    mutable std::vector<std::uint32_t> islands_;
};

}  // namespace jet::box2d
