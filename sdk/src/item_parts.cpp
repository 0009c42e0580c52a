#include "item_parts.hpp"

#include <cmath>

namespace jet {

std::uint32_t RecordingWorld::keep(ItemPart::Def def, std::uint32_t handle)
{
    parts.parts.push_back({std::move(def), handle});
    return handle;
}

ActuatorHandle RecordingWorld::addSpring(const SpringActuatorDef& def) { return keep(def, world_.addSpring(def)); }
ActuatorHandle RecordingWorld::addAngularSpring(const AngularSpringActuatorDef& def)
{
    return keep(def, world_.addAngularSpring(def));
}
ActuatorHandle RecordingWorld::addTorque(const TorqueActuatorDef& def) { return keep(def, world_.addTorque(def)); }
ActuatorHandle RecordingWorld::addForce(const ForceActuatorDef& def) { return keep(def, world_.addForce(def)); }
ActuatorHandle RecordingWorld::addForceField(const ForceFieldDef& def) { return keep(def, world_.addForceField(def)); }
JointHandle RecordingWorld::addJoint(const JointDef& def) { return keep(def, world_.addJoint(def)); }

namespace {

[[noreturn]] void refuse(const char* why) { throw Failure(Error(why)); }

double drawn(const Anchor& a, const Anchor& b) { return (b.point - a.point).norm(); }

void change(PhysicsWorld& world, std::uint32_t handle, const SpringActuatorDef& before, const SpringActuatorDef& def)
{
    // Below 0 the world leaves it as it is, the item means as drawn.
    const double rest = def.restLength < 0 && before.restLength >= 0 ? drawn(before.a, before.b) : def.restLength;
    world.setSpring(handle, rest, def.ks, def.kd, def.tearRatio);
}

double drawn(const Anchor& a, const Anchor& centre, const Anchor& b)
{
    const Vec2 armA = a.point - centre.point, armB = b.point - centre.point;
    return std::atan2(cross(armA, armB), armA.dot(armB));
}

void change(PhysicsWorld& world, std::uint32_t handle, const AngularSpringActuatorDef& before,
            const AngularSpringActuatorDef& def)
{
    std::optional<double> rest;  // as it is
    if (!def.restFromPose && (before.restFromPose || def.restAngle != before.restAngle)) rest = def.restAngle;
    if (def.restFromPose && !before.restFromPose) rest = drawn(before.a, before.centre, before.b);
    liveAngularSprings(world).setAngularSpring(handle, rest, def.ks, def.kd);
}

void change(PhysicsWorld& world, std::uint32_t handle, const TorqueActuatorDef&, const TorqueActuatorDef& def)
{
    world.setTorque(handle, def.value);
}

void change(PhysicsWorld& world, std::uint32_t handle, const ForceActuatorDef&, const ForceActuatorDef& def)
{
    world.setForce(handle, def.force);
}

void change(PhysicsWorld& world, std::uint32_t handle, const JointDef& before, const JointDef& def)
{
    if (def.kind != before.kind) refuse("a joint stays of its kind");
    if (def.a.radius != before.a.radius) refuse("a joint goes on holding what it held when play started");
    JointDef wanted = def;
    const bool hasLength = def.kind == JointDef::Kind::Distance || def.kind == JointDef::Kind::Rope;
    if (hasLength && def.length < 0 && before.length >= 0) wanted.length = drawn(before.a, before.b);
    world.setJoint(handle, wanted);
}

void change(PhysicsWorld& world, std::uint32_t handle, const ForceFieldDef& before, const ForceFieldDef& def)
{
    if (def.kind != before.kind) refuse("a field stays of its kind");
    world.setForceField(handle, def);
}

/// Changes what was added, call by call. It never throws: item types do not expect that where nothing was wrong before.
class ChangingWorld final : public ForwardingWorld {
public:
    ChangingWorld(PhysicsWorld& world, std::vector<ItemPart>& parts) : ForwardingWorld(world), parts_(parts) {}

    BodyHandle addSoftBody(const SoftBodyDef&) override { return fail("its bodies stay as they are"); }
    BodyHandle addRigidBody(const RigidBodyDef&) override { return fail("its bodies stay as they are"); }
    ActuatorHandle addSpring(const SpringActuatorDef& def) override { return next(def); }
    ActuatorHandle addAngularSpring(const AngularSpringActuatorDef& def) override { return next(def); }
    ActuatorHandle addTorque(const TorqueActuatorDef& def) override { return next(def); }
    ActuatorHandle addForce(const ForceActuatorDef& def) override { return next(def); }
    ActuatorHandle addForceField(const ForceFieldDef& def) override { return next(def); }
    JointHandle addJoint(const JointDef& def) override { return next(def); }

    std::uint32_t fail(std::string why)
    {
        if (refusal.empty()) refusal = std::move(why);
        return kNoHandle;
    }
    bool isThrough() const { return at_ == parts_.size(); }

    std::string refusal;

private:
    template <class Def>
    std::uint32_t next(const Def& def)
    {
        Def* before = at_ < parts_.size() ? std::get_if<Def>(&parts_[at_].def) : nullptr;
        if (!before) return fail("it did not get into the world when play started");
        const std::uint32_t handle = parts_[at_++].handle;
        try {
            change(world_, handle, *before, def);
            Def now = def;
            *before = std::move(now);
        } catch (const Failure& failure) {
            fail(failure.error().message);
        }
        return handle;
    }

    std::vector<ItemPart>& parts_;
    std::size_t at_ = 0;
};

class ChangingBuilder final : public WorldBuilder {
public:
    ChangingBuilder(PhysicsWorld& world, ItemParts& parts) : changing(world, parts.parts), anchors_(parts.anchors) {}

    PhysicsWorld& world() override { return changing; }
    Anchor anchor(const Item&, const Vec2& point) const override
    {
        return at_ < anchors_.size() ? anchors_[at_++] : Anchor{kNoHandle, point};
    }
    void bind(const Item&, ActuatorHandle) override {}
    void warn(const Item&, std::string message) override { changing.fail(std::move(message)); }

    ChangingWorld changing;

private:
    const std::vector<Anchor>& anchors_;
    mutable std::size_t at_ = 0;
};

}  // namespace

void changeParts(const Item& item, const ItemType& type, ItemParts& parts, PhysicsWorld& world)
{
    ChangingBuilder builder(world, parts);
    type.build(item, builder);
    if (builder.changing.refusal.empty() && !builder.changing.isThrough())
        builder.changing.fail("it adds and takes away nothing while playing");
    if (!builder.changing.refusal.empty()) throw Failure(Error(builder.changing.refusal));
}

}  // namespace jet
