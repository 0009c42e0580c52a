// One simulated scene: keeps the stages of a step and runs them in order (thesis §2.4.3.8; SPEC PH10).
#pragma once

#include "actuators.hpp"
#include "contact_finder.hpp"
#include "contact_solver.hpp"
#include "force_fields.hpp"
#include "outlines.hpp"
#include "queries.hpp"
#include "reports.hpp"
#include "rigid/stage.hpp"
#include "shape_memory.hpp"
#include "slots.hpp"
#include "slumber.hpp"
#include "soft/accounts.hpp"
#include "soft/contacts.hpp"
#include "soft/joints.hpp"
#include "soft/tears.hpp"
#include "soft/twins.hpp"
#include "soft/wholes.hpp"
#include "soft_springs.hpp"
#include "state.hpp"
#include "structure.hpp"

#include <jet/physics_removal.hpp>

namespace jet::physics {

class World final : public PhysicsWorld, public WorldRemoval, public LiveAngularSprings {
public:
    explicit World(const WorldSettings&);

    BodyHandle addSoftBody(const SoftBodyDef&) override;
    BodyHandle addRigidBody(const RigidBodyDef&) override;
    ActuatorHandle addSpring(const SpringActuatorDef&) override;
    ActuatorHandle addAngularSpring(const AngularSpringActuatorDef&) override;
    ActuatorHandle addTorque(const TorqueActuatorDef&) override;
    ActuatorHandle addForce(const ForceActuatorDef&) override;

    ActuatorHandle addForceField(const ForceFieldDef&) override;

    void step(double dt) override;

    std::size_t bodyCount() const override { return state_.bodies.size(); }
    BodyStates bodies() const override;
    std::span<const Contact> contacts() const override;
    StepStats stats() const override;
    bool touching(BodyHandle a, BodyHandle b) const override;
    bool contains(BodyHandle body, const Vec2& point) const override;

    void setTorque(ActuatorHandle torque, double value) override;
    void setForce(ActuatorHandle force, const Vec2& value) override;
    void applyForce(BodyHandle body, const Vec2& force) override;
    void applyImpulse(BodyHandle body, const Vec2& impulse) override;
    void setVelocity(BodyHandle body, const Vec2& velocity) override;
    void setOmega(BodyHandle body, double omega) override;
    void setPosition(BodyHandle body, const Vec2& centre) override;
    void setGravity(const Vec2& gravity) override;

    void setForceField(ActuatorHandle field, const ForceFieldDef&) override;
    void setSoftMatter(BodyHandle body, const SoftMatter&) override;
    void setSprings(BodyHandle body, double ks, double kd, double tearRatio) override;
    void setPinned(BodyHandle body, std::uint32_t particle, bool pinned) override;
    double springTension(BodyHandle body, std::uint32_t index) const override;
    bool springAlive(BodyHandle body, std::uint32_t index) const override;
    std::span<const std::uint32_t> pieces(BodyHandle body) const override;
    std::vector<std::vector<std::uint32_t>> borders(BodyHandle body) const override;

    void setSettings(const WorldSettings&) override;
    void setBody(BodyHandle, const BodyCommon&) override;
    void setMass(BodyHandle, double mass) override;
    void setEnabled(BodyHandle, bool enabled) override;
    void setJoint(JointHandle, const JointDef&) override;
    void setSpring(ActuatorHandle spring, double restLength, double ks, double kd, double tearRatio) override;

    void setAngularSpring(ActuatorHandle, std::optional<double> restAngle, double ks, double kd) override;

    // See world_removal.cpp.
    void removeBody(BodyHandle) override;
    void removeActuator(ActuatorKind, ActuatorHandle) override;
    bool hasBody(BodyHandle) const override;
    bool hasActuator(ActuatorKind, ActuatorHandle) const override;
    bool hasJoint(JointHandle) const override;

    bool awake(BodyHandle) const override;
    void wake(BodyHandle) override;
    std::uint32_t island(BodyHandle) const override;

    JointHandle addJoint(const JointDef&) override;
    JointState joint(JointHandle) const override;
    std::size_t jointCount() const override { return jointsAt_.size(); }
    void setMotor(JointHandle, bool driven, double speed) override;
    void setJointTarget(JointHandle, const Vec2& target) override;
    void removeJoint(JointHandle) override;
    std::span<const ContactEvent> contactEvents() const override;
    std::optional<CastHit> rayCast(const Vec2& from, const Vec2& to, const QueryFilter&) const override;
    std::optional<CastHit> shapeCast(const ShapeDef&, const Vec2& way, const QueryFilter&) const override;
    std::vector<BodyHandle> overlapping(const Box&, const QueryFilter&) const override;
    std::optional<CastHit> nearest(const Vec2& point, double reach, const QueryFilter&) const override;

    std::uint64_t hash() const override;
    std::vector<std::byte> save() const override;
    void restore(std::span<const std::byte> bytes) override;

private:
    BodyRecord& newBody(const BodyCommon&, bool rigid);
    void keepNormals();
    void outlineAll();
    /// What is told of the body, after it was changed between steps.
    void reread(BodyHandle);
    void extendReadings();
    BodyHandle finishBody(BodyHandle, const BodyCommon&);
    BodyHandle setRigidMass(const RigidBodyDef&, const std::vector<std::vector<Vec2>>& outlines, const Drawing&);
    // Removal.
    void requireBody(BodyHandle) const;
    void requireBodies(std::initializer_list<const Anchor*>) const;
    void requireActuator(ActuatorKind, ActuatorHandle) const;
    Index actuatorCount(ActuatorKind) const;
    Build buildOf(BodyHandle) const;
    BodyHandle settleIn(const Build&);
    void removeHolders(BodyHandle);
    void forgetContacts(BodyHandle);
    void wakeHeld(ActuatorKind, ActuatorHandle);
    JointHandle freeJoint(bool soft, bool pull) const;
    void applyMotion(BodyHandle);
    static bool isHeld(const BodyRecord&);
    void holdSoft(BodyRecord&, bool before);
    BodyRecord& softBody(BodyHandle);
    const BodyRecord& softBody(BodyHandle) const;
    void cutTorn();
    void refuseExplosion();

    /// Where a joint is kept: with the rigid bodies, or, when it holds a soft one, with those.
    struct JointAt {
        bool soft = false, pull = false;
        Index index = 0;
    };
    JointAt jointAt(JointHandle) const;
    bool isRemoved(const JointAt&) const;
    JointState rigidJoint(Index) const;

    void wakeHeld(const JointDef&);
    void wakeHeld(const Anchor&);
    /// It was moved from outside: it wakes, and so does what rests on it.
    void rouse(BodyHandle);
    void wakeUp(BodyHandle);
    void wakeAll();
    void stir(BodyHandle);
    bool anyAsleep() const { return slumber_.any() || rigid_.anyAsleep(); }
    /// May it wake others?
    bool comesNear(Index body) const;
    void spreadWaking(bool midst);
    Bonds bondsOfRigid() const;
    void restIfDue(double dt);
    void restTogether();
    void nameIslands();
    bool nothingMoves() const;
    void noteStanding();
    /// After restoring a state of another table of materials: whom bodies meet is found afresh.
    void heedMaterials();
    void keepMark();
    bool skipStep();
    const std::vector<Index>& islands() const;

    void prepareStiffness();
    void substep(double h, int index, int count);
    void flyFree(double h, int count);
    bool isLeftAlone(Index body, double dt);
    /// May there be forces on nodes?
    bool anyForces() const { return pushed_ || plain_ || actuators_.any() || fields_.any(); }
    /// Is any of stepForces_ not null?
    bool anyStepForce() const;
    soft::Accounts::Scene accounted(double h);
    /// Nothing but simple rigid bodies, and no spring between them: then the rigid stage does the whole step.
    bool onlySimple() const;
    void stepSimple(double dt);
    void moveKinematic(double h);
    /// Points, readings and reports are worked out when someone asks.
    void refresh() const;
    void reportIfAsked() const;
    const Queries& queries() const;
    void stepPart(double dt);
    void report();

    template <class Archive>
    void archivePins(Archive& with)
    {
        auto any = static_cast<std::uint8_t>(!pinsWhileHeld_.empty());
        with(any);
        pinsWhileHeld_.resize(any != 0 ? state_.nodes.size() : 0, 0);
        if (any != 0) with(pinsWhileHeld_);
    }
    template <class Self, class Archive>
    static void archive(Self& self, Archive& with);
    template <class Self, class Archive>
    static void archiveSlumber(Self& self, Archive& with);
    template <class Self, class Archive>
    static void archivePulls(Self& self, Archive& with);
    bool anyPull() const;
    void requirePulls() const;

    WorldSettings settings_;
    State state_;
    Structure structure_;
    Slots slots_;
    SoftSprings springs_;
    ShapeMemory shapes_;
    soft::Twins twins_;
    soft::Wholes wholes_;
    Actuators actuators_;
    ForceFields fields_;
    std::vector<std::uint8_t> pinsWhileHeld_;  // [nodes] pinned particles of bodies that are switched off, or kinematic
    ContactFinder finder_;
    ContactSet contacts_;
    soft::Contacts softContacts_;
    soft::Joints softJoints_;
    soft::Accounts accounts_;
    std::vector<JointAt> jointsAt_;
    bool jointsRemoved_ = false;  // may any of them have been?
    soft::Tears tears_;
    RigidStage rigid_;
    Slumber slumber_;
    /// Scratch of restTogether().
    struct Resting {
        std::vector<Index> group, firstRigid, root;  // [bodies]
        std::vector<std::uint8_t> restless, soft;    // [bodies]
        Bonds bonds;
    };
    Resting resting_;
    Queries queries_;
    Column<double> gyrations_{1};  // [bodies] units, of rigid ones that rigid_ does not have; up to the last of them
    // What is told of the last step is worked out when somebody asks.
    mutable Outlines outlines_{state_, rigid_};
    mutable Reports reports_;
    bool settled_ = false;                 // has it been stepped?
    bool stale_ = false;                   // points and readings are older than the nodes
    Index softMovers_ = 0;                 // soft bodies that are not fixed
    Index complex_ = 0;                    // bodies that go by points and walls
    Column<Vec2> stepForces_{Vec2(0, 0)};  // [nodes] of applyForce, for the next step only; no rows before the first
    bool pushed_ = false;                  // is any of them not null?
    StepStats stats_;
    std::vector<Index> islands_;  // [bodies] kNone: none, or asleep
    bool islandsKnown_ = false;   // are they those of the last step?

    std::size_t savedBytes_ = 4096;  // of the last state that was saved

    StiffnessBounds bounds_;
    double rate_ = -1;        // substeps / s the springs want; < 0: not known since something was added
    bool plain_ = false;      // as the thesis has it: Method::SemiImplicitEuler
    double preparedFor_ = 0;  // substep the springs are prepared for, seconds
    std::vector<WideSwing> wideSwings_;
    double impulsesOf_ = 0;        // substep the impulses of contacts and joints are of, seconds
    std::uint64_t pairsOf_ = 0;    // mark of the table of materials by which they were found,
    std::uint64_t tableMark_ = 0;  // and of that in force
};

}  // namespace jet::physics
