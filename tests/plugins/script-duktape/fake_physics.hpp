// A physics engine small enough to predict: boxes that move in straight lines and touch where they overlap, so that
// tests of scripts test the scripts. Effect "fake-body" gives an item the box of its path.
#pragma once

#include <jet/effect.hpp>
#include <jet/item.hpp>

namespace jet::test {

class FakeWorld final : public PhysicsWorld {
public:
    explicit FakeWorld(const WorldSettings& settings) : gravity(settings.gravity) {}

    BodyHandle addSoftBody(const SoftBodyDef& def) override { return add(def.common, def.particles); }
    BodyHandle addRigidBody(const RigidBodyDef& def) override { return add(def.common, def.borders.at(0)); }
    ActuatorHandle addSpring(const SpringActuatorDef&) override { return addActuator(kNoHandle); }
    ActuatorHandle addAngularSpring(const AngularSpringActuatorDef&) override { return addActuator(kNoHandle); }
    ActuatorHandle addTorque(const TorqueActuatorDef& def) override { return addActuator(def.at.body); }
    ActuatorHandle addForce(const ForceActuatorDef& def) override { return addActuator(def.at.body); }

    void step(double dt) override
    {
        for (BodyHandle b = 0; b < position_.size(); ++b) {
            if (!fixed_[b]) velocity_[b] += dt * (gravity + force_[b]);
            force_[b] = {0, 0};
            move(b, dt * velocity_[b]);
            angle_[b] += dt * omega_[b];
        }
        for (const Actuator& torque : actuators_)
            if (torque.body != kNoHandle) omega_[torque.body] += dt * torque.value;
        contacts_.clear();
        for (BodyHandle a = 0; a < position_.size(); ++a)
            for (BodyHandle b = a + 1; b < position_.size(); ++b)
                if (touching(a, b)) contacts_.push_back({a, b, 0, 0, position_[a], 0, {0, -1}, 0.5, 2});
    }

    std::size_t bodyCount() const override { return position_.size(); }
    BodyStates bodies() const override { return {position_, angle_, velocity_, omega_, bounds_, first_, points_}; }
    std::span<const Contact> contacts() const override { return contacts_; }
    StepStats stats() const override { return {}; }
    bool touching(BodyHandle a, BodyHandle b) const override
    {
        return a != b && bounds_.at(a).intersects(bounds_.at(b));
    }
    bool contains(BodyHandle body, const Vec2& point) const override { return bounds_.at(body).contains(point); }

    void setTorque(ActuatorHandle torque, double value) override { actuators_.at(torque).value = value; }
    void setForce(ActuatorHandle, const Vec2&) override {}
    void applyForce(BodyHandle body, const Vec2& force) override { force_.at(body) += force; }
    void applyImpulse(BodyHandle body, const Vec2& impulse) override { velocity_.at(body) += impulse; }
    void setVelocity(BodyHandle body, const Vec2& velocity) override { velocity_.at(body) = velocity; }
    void setOmega(BodyHandle body, double omega) override { omega_.at(body) = omega; }
    void setPosition(BodyHandle body, const Vec2& centre) override { move(body, centre - position_.at(body)); }
    void setGravity(const Vec2& value) override { gravity = value; }
    void setBody(BodyHandle, const BodyCommon&) override {}
    void setSpring(ActuatorHandle, double, double, double, double) override {}
    bool springAlive(BodyHandle, std::uint32_t) const override { return true; }

    // Exact: any difference in the last bit of any state changes it.
    std::uint64_t hash() const override
    {
        std::uint64_t h = 14695981039346656037ULL;
        const auto add = [&h](double value) { h = (h ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211ULL; };
        for (std::size_t b = 0; b < position_.size(); ++b) {
            add(position_[b].x()), add(position_[b].y()), add(velocity_[b].x()), add(velocity_[b].y());
            add(angle_[b]), add(omega_[b]);
        }
        return h;
    }
    std::vector<std::byte> save() const override { return {}; }
    void restore(std::span<const std::byte>) override {}

    Vec2 gravity;

private:
    struct Actuator {
        BodyHandle body;
        double value;
    };

    ActuatorHandle addActuator(BodyHandle body)
    {
        actuators_.push_back({body, 0});
        return static_cast<ActuatorHandle>(actuators_.size() - 1);
    }

    BodyHandle add(const BodyCommon& common, const std::vector<Vec2>& border)
    {
        Box box;
        for (const Vec2& p : border) box.extend(p), points_.push_back(p);
        position_.push_back(box.center());
        angle_.push_back(0);
        velocity_.push_back(common.velocity);
        omega_.push_back(common.omega);
        bounds_.push_back(box);
        force_.push_back({0, 0});
        fixed_.push_back(common.fixed);
        first_.push_back(static_cast<std::uint32_t>(points_.size()));
        return static_cast<BodyHandle>(position_.size() - 1);
    }

    void move(BodyHandle b, const Vec2& by)
    {
        position_[b] += by;
        bounds_[b].min += by, bounds_[b].max += by;
        for (std::uint32_t i = first_[b]; i < first_[b + 1]; ++i) points_[i] += by;
    }

    std::vector<Vec2> position_, velocity_, force_, points_;
    std::vector<double> angle_, omega_;
    std::vector<Box> bounds_;
    std::vector<bool> fixed_;
    std::vector<std::uint32_t> first_{0};
    std::vector<Actuator> actuators_;
    std::vector<Contact> contacts_;
};

class FakePhysics final : public PhysicsEngine {
public:
    std::unique_ptr<PhysicsWorld> createWorld(const WorldSettings& settings) override
    {
        return std::make_unique<FakeWorld>(settings);
    }
};

class FakeBody final : public Effect {
public:
    const PropertyTable& properties() const override { return table_; }
    std::optional<BodyDef> buildBody(const EffectInput& input, const BodyCommon& common) const override
    {
        const Box box = input.path.bounds();
        RigidBodyDef def;
        def.common = common;
        def.borders = {{box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}}};
        return def;
    }

private:
    PropertyTable table_;
};

}  // namespace jet::test
