// A small physics world: bodies keep their shape, fall, spin and bounce off the lowest fixed body. Bodies do not meet
// each other, and springs do nothing; put your own solver into step().
//
// The rules of the contract (jet/physics.hpp): handles count from 0 in the order of adding; equal histories give equal
// bits, so no clock, no random number, no order that depends on addresses; save() and restore() cover all that moves.
#pragma once

#include <jet/physics.hpp>

class MyPluginWorld final : public jet::PhysicsWorld {
public:
    explicit MyPluginWorld(const jet::WorldSettings& settings) : settings_(settings) {}

    jet::BodyHandle addSoftBody(const jet::SoftBodyDef& def) override { return add(def.common, {def.particles}, 1); }
    jet::BodyHandle addRigidBody(const jet::RigidBodyDef& def) override
    {
        return add(def.common, def.borders, def.mass);
    }
    jet::ActuatorHandle addSpring(const jet::SpringActuatorDef&) override { return springs_++; }
    jet::ActuatorHandle addAngularSpring(const jet::AngularSpringActuatorDef&) override { return angularSprings_++; }
    jet::ActuatorHandle addTorque(const jet::TorqueActuatorDef& def) override;
    jet::ActuatorHandle addForce(const jet::ForceActuatorDef& def) override;

    void step(double dt) override;

    std::size_t bodyCount() const override { return position_.size(); }
    jet::BodyStates bodies() const override
    {
        return {position_, angle_, velocity_, omega_, bounds_, firstPoint_, points_};
    }
    std::span<const jet::Contact> contacts() const override { return {}; }
    jet::StepStats stats() const override { return {}; }
    bool touching(jet::BodyHandle, jet::BodyHandle) const override { return false; }
    bool contains(jet::BodyHandle body, const jet::Vec2& point) const override { return bounds_[body].contains(point); }

    void setTorque(jet::ActuatorHandle torque, double value) override { torques_[torque].value = value; }
    void setForce(jet::ActuatorHandle force, const jet::Vec2& value) override { forces_[force].force = value; }
    void applyForce(jet::BodyHandle body, const jet::Vec2& force) override { pushed_[body] += force; }
    void applyImpulse(jet::BodyHandle body, const jet::Vec2& impulse) override
    {
        if (!fixed_[body]) velocity_[body] += impulse / mass_[body];
    }
    void setVelocity(jet::BodyHandle body, const jet::Vec2& velocity) override { velocity_[body] = velocity; }
    void setOmega(jet::BodyHandle body, double omega) override { omega_[body] = omega; }
    void setPosition(jet::BodyHandle body, const jet::Vec2& centre) override
    {
        position_[body] = centre;
        place(body);
    }
    void setGravity(const jet::Vec2& gravity) override { settings_.gravity = gravity; }
    bool springAlive(jet::BodyHandle, std::uint32_t) const override { return true; }

    std::uint64_t hash() const override;
    std::vector<std::byte> save() const override;
    void restore(std::span<const std::byte> state) override;

private:
    jet::BodyHandle add(const jet::BodyCommon& common, const std::vector<std::vector<jet::Vec2>>& rings, double mass);
    /// Computes the points and the bounds of a body from its position and angle.
    void place(jet::BodyHandle body);
    double floor() const;

    jet::WorldSettings settings_;
    // [bodies]
    std::vector<jet::Vec2> position_, velocity_, pushed_;
    std::vector<double> angle_, omega_, mass_;
    std::vector<bool> fixed_;
    std::vector<jet::Box> bounds_;
    // [firstPoint_.back()]: where the points are, and where they lie from the middle at angle 0
    std::vector<std::uint32_t> firstPoint_{0};
    std::vector<jet::Vec2> points_, shape_;

    std::vector<jet::TorqueActuatorDef> torques_;
    std::vector<jet::ForceActuatorDef> forces_;
    std::uint32_t springs_ = 0, angularSprings_ = 0;
};
