// A physics engine small enough to predict: boxes that move in straight lines and touch where they overlap, so that
// tests of scripts test the scripts. Effect "fake-body" gives an item the box of its path.
#pragma once

#include <jet/effect.hpp>
#include <jet/item.hpp>
#include <jet/item_type.hpp>

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
    /// Of the boxes; what is cast is its first point.
    std::optional<CastHit> rayCast(const Vec2& from, const Vec2& to, const QueryFilter& filter) const override
    {
        std::optional<CastHit> best;
        for (BodyHandle body = 0; body < bounds_.size(); ++body) {
            if (body == filter.except || (filter.mask & 1U) == 0) continue;
            double enter = 0, leave = 1;
            Vec2 normal(0, 0);
            for (int axis = 0; axis < 2; ++axis) {
                const double way = to[axis] - from[axis];
                const double low = (bounds_[body].min[axis] - from[axis]) / way;
                const double high = (bounds_[body].max[axis] - from[axis]) / way;
                if (way == 0 && (from[axis] < bounds_[body].min[axis] || from[axis] > bounds_[body].max[axis]))
                    leave = -1;
                if (way == 0) continue;
                if (std::min(low, high) > enter) {
                    enter = std::min(low, high);
                    normal = axis == 0 ? Vec2(way > 0 ? -1 : 1, 0) : Vec2(0, way > 0 ? -1 : 1);
                }
                leave = std::min(leave, std::max(low, high));
            }
            if (enter <= 0 || enter > leave || (best && best->fraction <= enter)) continue;
            best = CastHit{body, from + enter * (to - from), normal, enter};
        }
        return best;
    }
    std::optional<CastHit> shapeCast(const ShapeDef& shape, const Vec2& way, const QueryFilter& filter) const override
    {
        return rayCast(shape.points.at(0), shape.points.at(0) + way, filter);
    }
    std::vector<BodyHandle> overlapping(const Box& box, const QueryFilter& filter) const override
    {
        std::vector<BodyHandle> found;
        for (BodyHandle body = 0; body < bounds_.size(); ++body)
            if (body != filter.except && bounds_[body].intersects(box)) found.push_back(body);
        return found;
    }
    std::optional<CastHit> nearest(const Vec2& point, double reach, const QueryFilter& filter) const override
    {
        for (BodyHandle body = 0; body < bounds_.size(); ++body) {
            const Vec2 at(std::clamp(point.x(), bounds_[body].min.x(), bounds_[body].max.x()),
                          std::clamp(point.y(), bounds_[body].min.y(), bounds_[body].max.y()));
            const double far = (at - point).norm();
            if (body != filter.except && far > 0 && far <= reach)
                return CastHit{body, at, (point - at) / far, far / reach};
        }
        return std::nullopt;
    }

    std::span<const ContactEvent> contactEvents() const override
    {
        return ++eventsAsked, std::span<const ContactEvent>();
    }

    JointHandle addJoint(const JointDef& def) override
    {
        return joints_.push_back(def), static_cast<JointHandle>(joints_.size() - 1);
    }
    std::size_t jointCount() const override { return joints_.size(); }
    JointState joint(JointHandle joint) const override
    {
        const JointDef& def = joints_.at(joint);
        return {{0, 0}, 0, 0, false, def.a.point, def.b.point};
    }
    void setJoint(JointHandle joint, const JointDef& def) override { joints_.at(joint) = def; }
    void setJointTarget(JointHandle joint, const Vec2& target) override { joints_.at(joint).b.point = target; }
    void removeJoint(JointHandle) override {}

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
    mutable int eventsAsked = 0;

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
    std::vector<JointDef> joints_;
};

class FakePhysics final : public PhysicsEngine {
public:
    std::unique_ptr<PhysicsWorld> createWorld(const WorldSettings& settings) override
    {
        return std::make_unique<FakeWorld>(settings);
    }
};

/// A joint to the background at the end of its path.
class FakeJoint final : public ItemType {
public:
    const PropertyTable& properties() const override
    {
        static const PropertyTable table{choice("kind", "Kind", {"revolute", "mouse"}),
                                         flag("driven", "Motor on", false), real("motor-speed", "Motor speed", 0),
                                         real("max-force", "Greatest force", 0),
                                         real("max-torque", "Greatest torque", 0)};
        return table;
    }
    std::string label() const override { return "Joint"; }
    void build(const Item& item, WorldBuilder& builder) const override
    {
        JointDef def;
        def.a = builder.anchor(item, item.path().segment(0).point);
        def.b.point = item.path().segment(1).point;
        builder.world().addJoint(def);
    }
};

/// A force at the start of its path.
class FakeForce final : public ItemType {
public:
    const PropertyTable& properties() const override
    {
        static const PropertyTable table{vector("value", "Force", {0, 0})};
        return table;
    }
    std::string label() const override { return "Force"; }
    void build(const Item& item, WorldBuilder& builder) const override
    {
        ForceActuatorDef def;
        def.at = builder.anchor(item, item.path().segment(0).point);
        def.force = item.properties().get("value", properties()).as<Vec2>();
        builder.bind(item, builder.world().addForce(def));
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
