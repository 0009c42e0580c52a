// Physics engines and their worlds under guard.
#include "guarded_object.hpp"

#include <jet/physics_removal.hpp>

namespace jet::host {

namespace {

/// A world that failed is in no state to go on: the run ends with a Failure. A Failure from the world itself is a word
/// about what it was given, and passes: the plugin is not at fault.
class GuardedWorld final : public PhysicsWorld,
                           public WorldRemoval,
                           public LiveAngularSprings,
                           GuardedObject<PhysicsWorld, Callback::WorldDestroy> {
    // First of all, since their types are deduced.
    template <class Fn>
    auto use(Callback callback, Fn&& fn) const
    {
        std::optional<Error> refusal;
        std::decay_t<decltype(fn(*inner_))> result{};
        const bool fine = tell(callback, [&](PhysicsWorld& world) {
            try {
                result = fn(world);
            } catch (const Failure& failure) {
                refusal = failure.error();
            }
        });
        if (refusal) throw Failure(*refusal);
        if (!fine) throw switchedOff();
        return result;
    }
    template <class Fn>
    void act(Callback callback, Fn&& fn) const
    {
        use(callback, [&](PhysicsWorld& world) {
            fn(world);
            return true;
        });
    }
    template <class Fn>
    void act(Fn&& fn) const
    {
        act(Callback::WorldAct, std::forward<Fn>(fn));
    }

public:
    using GuardedObject::GuardedObject;

    void step(double dt) override
    {
        act(Callback::WorldStep, [&](PhysicsWorld& w) { w.step(dt); });
    }

    BodyHandle addSoftBody(const SoftBodyDef& def) override
    {
        return use(Callback::WorldBuild, [&](PhysicsWorld& w) { return w.addSoftBody(def); });
    }
    BodyHandle addRigidBody(const RigidBodyDef& def) override
    {
        return use(Callback::WorldBuild, [&](PhysicsWorld& w) { return w.addRigidBody(def); });
    }
    ActuatorHandle addSpring(const SpringActuatorDef& def) override
    {
        return use(Callback::WorldBuild, [&](PhysicsWorld& w) { return w.addSpring(def); });
    }
    ActuatorHandle addAngularSpring(const AngularSpringActuatorDef& def) override
    {
        return use(Callback::WorldBuild, [&](PhysicsWorld& w) { return w.addAngularSpring(def); });
    }
    ActuatorHandle addTorque(const TorqueActuatorDef& def) override
    {
        return use(Callback::WorldBuild, [&](PhysicsWorld& w) { return w.addTorque(def); });
    }
    ActuatorHandle addForce(const ForceActuatorDef& def) override
    {
        return use(Callback::WorldBuild, [&](PhysicsWorld& w) { return w.addForce(def); });
    }

    JointHandle addJoint(const JointDef& def) override
    {
        return use(Callback::WorldBuild, [&](PhysicsWorld& w) { return w.addJoint(def); });
    }
    ActuatorHandle addForceField(const ForceFieldDef& def) override
    {
        return use(Callback::WorldBuild, [&](PhysicsWorld& w) { return w.addForceField(def); });
    }

    std::size_t bodyCount() const override
    {
        return use(Callback::WorldRead, [](PhysicsWorld& w) { return w.bodyCount(); });
    }
    BodyStates bodies() const override
    {
        return use(Callback::WorldRead, [](PhysicsWorld& w) { return w.bodies(); });
    }
    std::span<const Contact> contacts() const override
    {
        return use(Callback::WorldRead, [](PhysicsWorld& w) { return w.contacts(); });
    }
    StepStats stats() const override
    {
        return use(Callback::WorldRead, [](PhysicsWorld& w) { return w.stats(); });
    }
    bool touching(BodyHandle a, BodyHandle b) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.touching(a, b); });
    }
    bool contains(BodyHandle body, const Vec2& point) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.contains(body, point); });
    }
    bool springAlive(BodyHandle body, std::uint32_t index) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.springAlive(body, index); });
    }
    JointState joint(JointHandle handle) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.joint(handle); });
    }
    bool awake(BodyHandle body) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.awake(body); });
    }
    std::span<const ContactEvent> contactEvents() const override
    {
        return use(Callback::WorldRead, [](PhysicsWorld& w) { return w.contactEvents(); });
    }
    std::optional<CastHit> rayCast(const Vec2& from, const Vec2& to, const QueryFilter& filter) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.rayCast(from, to, filter); });
    }
    std::optional<CastHit> shapeCast(const ShapeDef& shape, const Vec2& way, const QueryFilter& filter) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.shapeCast(shape, way, filter); });
    }
    std::vector<BodyHandle> overlapping(const Box& box, const QueryFilter& filter) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.overlapping(box, filter); });
    }
    std::optional<CastHit> nearest(const Vec2& point, double reach, const QueryFilter& filter) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.nearest(point, reach, filter); });
    }
    double springTension(BodyHandle body, std::uint32_t index) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.springTension(body, index); });
    }
    std::span<const std::uint32_t> pieces(BodyHandle body) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.pieces(body); });
    }
    std::vector<std::vector<std::uint32_t>> borders(BodyHandle body) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.borders(body); });
    }
    std::size_t jointCount() const override
    {
        return use(Callback::WorldRead, [](PhysicsWorld& w) { return w.jointCount(); });
    }
    std::uint32_t island(BodyHandle body) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return w.island(body); });
    }
    std::uint64_t hash() const override
    {
        return use(Callback::WorldRead, [](PhysicsWorld& w) { return w.hash(); });
    }

    void setTorque(ActuatorHandle torque, double value) override
    {
        act([&](PhysicsWorld& w) { w.setTorque(torque, value); });
    }
    void setForce(ActuatorHandle force, const Vec2& value) override
    {
        act([&](PhysicsWorld& w) { w.setForce(force, value); });
    }
    void applyForce(BodyHandle body, const Vec2& force) override
    {
        act([&](PhysicsWorld& w) { w.applyForce(body, force); });
    }
    void applyImpulse(BodyHandle body, const Vec2& impulse) override
    {
        act([&](PhysicsWorld& w) { w.applyImpulse(body, impulse); });
    }
    void setVelocity(BodyHandle body, const Vec2& velocity) override
    {
        act([&](PhysicsWorld& w) { w.setVelocity(body, velocity); });
    }
    void setOmega(BodyHandle body, double omega) override
    {
        act([&](PhysicsWorld& w) { w.setOmega(body, omega); });
    }
    void setPosition(BodyHandle body, const Vec2& centre) override
    {
        act([&](PhysicsWorld& w) { w.setPosition(body, centre); });
    }
    void setGravity(const Vec2& gravity) override
    {
        act([&](PhysicsWorld& w) { w.setGravity(gravity); });
    }

    void setMotor(JointHandle handle, bool driven, double speed) override
    {
        act([&](PhysicsWorld& w) { w.setMotor(handle, driven, speed); });
    }
    void setJointTarget(JointHandle handle, const Vec2& target) override
    {
        act([&](PhysicsWorld& w) { w.setJointTarget(handle, target); });
    }
    void removeJoint(JointHandle handle) override
    {
        act([&](PhysicsWorld& w) { w.removeJoint(handle); });
    }
    void wake(BodyHandle body) override
    {
        act([&](PhysicsWorld& w) { w.wake(body); });
    }

    void setSettings(const WorldSettings& settings) override
    {
        act([&](PhysicsWorld& w) { w.setSettings(settings); });
    }
    void setBody(BodyHandle body, const BodyCommon& common) override
    {
        act([&](PhysicsWorld& w) { w.setBody(body, common); });
    }
    void setMass(BodyHandle body, double mass) override
    {
        act([&](PhysicsWorld& w) { w.setMass(body, mass); });
    }
    void setEnabled(BodyHandle body, bool enabled) override
    {
        act([&](PhysicsWorld& w) { w.setEnabled(body, enabled); });
    }
    void setJoint(JointHandle joint, const JointDef& def) override
    {
        act([&](PhysicsWorld& w) { w.setJoint(joint, def); });
    }
    void setSpring(ActuatorHandle spring, double restLength, double ks, double kd, double tearRatio) override
    {
        act([&](PhysicsWorld& w) { w.setSpring(spring, restLength, ks, kd, tearRatio); });
    }
    void setForceField(ActuatorHandle field, const ForceFieldDef& def) override
    {
        act([&](PhysicsWorld& w) { w.setForceField(field, def); });
    }
    void setSoftMatter(BodyHandle body, const SoftMatter& matter) override
    {
        act([&](PhysicsWorld& w) { w.setSoftMatter(body, matter); });
    }
    void setSprings(BodyHandle body, double ks, double kd, double tearRatio) override
    {
        act([&](PhysicsWorld& w) { w.setSprings(body, ks, kd, tearRatio); });
    }
    void setPinned(BodyHandle body, std::uint32_t particle, bool pinned) override
    {
        act([&](PhysicsWorld& w) { w.setPinned(body, particle, pinned); });
    }

    // Of these, the world under guard may have none: then it is refused.
    void removeBody(BodyHandle body) override
    {
        act([&](PhysicsWorld& w) { removal(w).removeBody(body); });
    }
    void removeActuator(ActuatorKind kind, ActuatorHandle actuator) override
    {
        act([&](PhysicsWorld& w) { removal(w).removeActuator(kind, actuator); });
    }
    bool hasBody(BodyHandle body) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return removal(w).hasBody(body); });
    }
    bool hasActuator(ActuatorKind kind, ActuatorHandle actuator) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return removal(w).hasActuator(kind, actuator); });
    }
    bool hasJoint(JointHandle joint) const override
    {
        return use(Callback::WorldRead, [&](PhysicsWorld& w) { return removal(w).hasJoint(joint); });
    }
    void setAngularSpring(ActuatorHandle spring, std::optional<double> restAngle, double ks, double kd) override
    {
        act([&](PhysicsWorld& w) { liveAngularSprings(w).setAngularSpring(spring, restAngle, ks, kd); });
    }

    std::vector<std::byte> save() const override
    {
        return use(Callback::WorldSave, [](PhysicsWorld& w) { return w.save(); });
    }
    void restore(std::span<const std::byte> state) override
    {
        act(Callback::WorldRestore, [&](PhysicsWorld& w) { w.restore(state); });
    }
};

class GuardedPhysicsEngine final : public PhysicsEngine, GuardedObject<PhysicsEngine, Callback::EngineDestroy> {
public:
    using GuardedObject::GuardedObject;
    using GuardedObject::renewInner;

    std::unique_ptr<PhysicsWorld> createWorld(const WorldSettings& settings) override
    {
        std::optional<Error> refusal;
        std::unique_ptr<PhysicsWorld> world;
        tell(Callback::EngineCreateWorld, [&](PhysicsEngine& engine) {
            try {
                world = engine.createWorld(settings);
            } catch (const Failure& failure) {
                refusal = failure.error();  // of these settings: another scene may play
            }
        });
        if (refusal) throw Failure(*refusal);
        if (!world) return nullptr;
        return std::make_unique<GuardedWorld>(guard_, plugin_, std::move(world));
    }
};

}  // namespace

std::shared_ptr<PhysicsEngine> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<PhysicsEngine> engine)
{
    return std::make_shared<GuardedPhysicsEngine>(guard, plugin, std::move(engine));
}
void renew(PhysicsEngine& guarded, std::shared_ptr<PhysicsEngine> engine)
{
    static_cast<GuardedPhysicsEngine&>(guarded).renewInner(std::move(engine));
}

}  // namespace jet::host
