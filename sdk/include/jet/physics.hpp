// The contract between the editor and a physics engine plugin: ids, spans and plain structs, no scene types.
//
// Order of calls: engine.createWorld -> world.add... (any number) -> world.step / read / act, repeated -> destroyed.
// A world belongs to one thread at a time, the simulation's, also for what is const: readings are worked out when they
// are first asked for. Handles are indices in the order of adding, per kind; what was added stays (a body may be
// switched off, a joint removed) unless it is taken out (physics_removal.hpp). Spans that are told hold until the next
// call that is not const. A world outlives its engine object, but not the library it comes from.
//
// Whatever is out of range, not a number, or names what is not there is refused by throwing Failure with a sentence
// that names the item, the field, its value and the range (physics_checks.hpp has all of them; the defaults below are
// in range); the world then is as it was. So is what an engine lacks. Numbers without a range may be any up to 1e30.
//
// Units: scene units (y down), seconds, mass units; force = mass * unit / s². Angles and torques grow clockwise on
// screen.
#pragma once

#include <jet/geometry.hpp>
#include <jet/physics_soft.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace jet {

using BodyHandle = std::uint32_t;
using ParticleHandle = std::uint32_t;
using ActuatorHandle = std::uint32_t;
using JointHandle = std::uint32_t;
inline constexpr std::uint32_t kNoHandle = 0xffffffffU;

/// How a pair of materials meets (thesis §2.4.3.4; SPEC PH8).
struct MaterialPair {
    double friction = 0.6;     ///< Coulomb coefficient, >= 0
    double restitution = 0.1;  ///< 0 no bounce .. 1 full
    bool collides = true;
};

/// Width of the numbers rigid contacts and joints are solved in. Positions are double at this interface in any case.
enum class Precision : std::uint8_t {
    Automatic,  ///< double for small worlds and those with soft bodies, single for large ones
    Double,     ///< momentum is kept to the last bits
    Single
};

/// Instructions of the wide kernels; every choice gives the same bits. Automatic takes the widest of the processor's
/// that there is code for; a choice that it has not, or that nothing is written for, falls to the next narrower.
enum class Simd : std::uint8_t { Automatic, Sse2, Avx2, Avx512 };

/// How a world advances.
enum class Method : std::uint8_t {
    Automatic,         ///< whatever holds best: nothing explodes
    SemiImplicitEuler  ///< as the thesis has it (§2.4.3.1): one substep, forces alone; for teaching and comparison
};

struct WorldSettings {
    Vec2 gravity{0, 98.1};        ///< scene units / s²
    double linearDamping = 0.0;   ///< 1/s, >= 0; velocity decays as exp(-damping t)
    double angularDamping = 0.0;  ///< the same of omega
    bool applyGravity = true;     ///< the four switches of SPEC PH10
    bool applyDamping = true;
    bool findCollisions = true;
    bool resolveCollisions = true;
    std::uint32_t materialCount = 1;
    std::vector<MaterialPair> materials =
        std::vector<MaterialPair>(1);  ///< [materialCount x materialCount], row major, symmetric
    int threads = 1;                   ///< 1..64, of which the caller's is one; the bits do not depend on it
    /// 0..4096, of the rigid solver a step; 0: 4 in large worlds of rigid bodies, else as the scene needs.
    int substeps = 0;
    Precision precision = Precision::Automatic;
    Simd simd = Simd::Automatic;
    Method method = Method::Automatic;
    bool allowSleep = true;  ///< may groups of bodies that rest be left out until something wakes them?
};

/// Spring between two particles of one soft body (SPEC PH2).
struct SpringDef {
    std::uint32_t a = 0, b = 0;  ///< particle indices within the body
    double restLength = 0;       ///< scene units, >= 0
    double ks = 10;              ///< stiffness, force / unit, >= 0
    double kd = 0.1;             ///< damping along the spring, force / (unit/s), >= 0
    double tearRatio = 0;        ///< kt: tears beyond restLength * tearRatio; 0 never tears
};

/// Angular spring over three particles a - centre - b (SPEC PH3); keeps the angle from a to b about the centre.
struct AngularSpringDef {
    std::uint32_t a = 0, centre = 0, b = 0;
    double restAngle = 0;  ///< radians
    double ks = 10;        ///< torque / rad, >= 0
    double kd = 0.1;       ///< torque / (rad/s), >= 0
};

struct BodyCommon {
    bool fixed = false;          ///< never moves; collides with everything that does
    std::uint32_t material = 0;  ///< index into WorldSettings::materials
    Vec2 velocity;               ///< initial, units/s
    double omega = 0;            ///< initial, rad/s (soft bodies: applied about their centre of mass)
    double gravityScale = 1;     ///< times gravity; below 0 it rises
    bool sensor = false;         ///< contacts are reported, not resolved

    bool kinematic = false;      ///< moves with its velocity and omega, and nothing pushes it
    bool fixedRotation = false;  ///< never turns
    std::uint32_t group = 0;     ///< bodies of one group above 0 do not collide with each other
    std::uint32_t layer = 1;     ///< bits: the layers it is on
    std::uint32_t mask = ~0U;    ///< bits: the layers it collides with; both sides must agree
    Vec2 oneSided;               ///< not null: only what comes against this direction collides (platforms)
    bool allowSleep = true;      ///< may it fall asleep?
};

/// A simple part of a rigid body, in scene coordinates at rest.
struct ShapeDef {
    enum class Kind : std::uint8_t {
        Circle,   ///< points[0] is the centre
        Capsule,  ///< around the segment from points[0] to points[1]
        Polygon,  ///< convex, 3 to 8 points, in either direction
        Chain     ///< an open line of 2 points or more, solid to the right of its way; of fixed bodies only
    };
    Kind kind = Kind::Polygon;
    std::vector<Vec2> points;
    double radius = 0;  ///< circle and capsule, scene units, > 0
};

/// Particles, and what holds them together. Borders are closed walls that others collide with; those of one body are
/// one region: a point is inside when it is inside an odd number of them (an outer border and holes). Concave is
/// normal.
struct SoftBodyDef {
    BodyCommon common;
    std::vector<Vec2> particles;                      ///< positions, scene units
    std::vector<double> masses;                       ///< one a particle, > 0
    std::vector<std::uint8_t> movable;                ///< one a particle; empty = all movable
    std::vector<std::vector<std::uint32_t>> borders;  ///< closed rings of particle indices
    std::vector<SpringDef> springs;
    std::vector<AngularSpringDef> angularSprings;
    SoftMatter matter;
};

/// A body that keeps its shape, of closed borders (one region, as of SoftBodyDef) or of simple shapes.
struct RigidBodyDef {
    BodyCommon common;
    std::vector<std::vector<Vec2>> borders;  ///< closed rings, scene coordinates at rest
    double mass = 1;                         ///< > 0; the moment of inertia follows from the outline (SPEC PH5)
    std::vector<ShapeDef> shapes;            ///< instead of borders: a body composed of these parts
};

/// A point fixed to a body (or, with body == kNoHandle, to the background).
struct Anchor {
    BodyHandle body = kNoHandle;
    Vec2 point;  ///< scene coordinates at the time of adding
    /// Soft bodies only, scene units: holds all particles no farther than this from `point`; 0: those nearest to it.
    double radius = 0;
};

/// Scene-level spring (SPEC PH7): joins two anchors. restLength < 0: the distance at the time of adding.
struct SpringActuatorDef {
    Anchor a, b;
    double restLength = -1;    ///< scene units
    double ks = 10, kd = 0.1;  ///< force / unit, force / (unit/s); >= 0
    double tearRatio = 0;      ///< tears beyond restLength * tearRatio; 0 never tears
};

/// Keeps the angle from a to b about the centre, between bodies.
struct AngularSpringActuatorDef {
    Anchor a, centre, b;
    double restAngle = 0;      ///< radians
    bool restFromPose = true;  ///< take the angle at the time of adding instead of restAngle
    double ks = 10, kd = 0.1;  ///< torque / rad, torque / (rad/s); >= 0
};

/// Torque on a body about a point of it. Clockwise on screen is positive here.
struct TorqueActuatorDef {
    Anchor at;
    double value = 0;  ///< force * unit
};

/// Constant force on a body at a point of it, in scene directions.
struct ForceActuatorDef {
    Anchor at;
    Vec2 force;  ///< mass * unit / s²
};

/// Holds two bodies together, or a body to the background. Which fields count depends on the kind; angles and lengths
/// are measured from the pose at the time of adding.
struct JointDef {
    enum class Kind : std::uint8_t {
        Revolute,   ///< b's point stays at a's; turning is free, limited or driven
        Prismatic,  ///< slides along `axis`, which turns with a; no turning
        Weld,       ///< neither moves nor turns against the other; `hertz` > 0 makes it elastic
        Distance,   ///< keeps `length` between the points; `hertz` > 0 makes it a spring
        Rope,       ///< no farther than `length`
        Wheel,      ///< slides along `axis` on a spring of `hertz`, turns freely or driven
        Motor,      ///< drives b's speed against a to `motorVelocity` and `motorSpeed` with limited force and torque
        Mouse,      ///< pulls b's point towards a's (mostly the background's) with limited force
        Pulley      ///< |groundA a| + ratio |groundB b| stays what it is
    };
    Kind kind = Kind::Revolute;
    Anchor a, b;
    Vec2 axis{1, 0};          ///< direction in the scene; prismatic and wheel
    bool limited = false;     ///< keep angle (revolute) or travel (prismatic, wheel) from `lower` to `upper`
    double lower = 0;         ///< radians or scene units
    double upper = 0;         ///< radians or scene units
    bool driven = false;      ///< the motor is on
    double motorSpeed = 0;    ///< rad/s (revolute, wheel, motor) or units/s (prismatic)
    Vec2 motorVelocity;       ///< units/s; motor joint
    double maxForce = 0;      ///< force the motor (along each axis) or mouse has at most, >= 0; with 0 it does nothing
    double maxTorque = 0;     ///< torque the motor has at most, force * unit, >= 0; with 0 it does not turn
    double hertz = 0;         ///< 1/s of the joint's spring, >= 0; 0: rigid
    double dampingRatio = 1;  ///< >= 0; 1: critical
    double length = -1;       ///< scene units; < 0: the distance at the time of adding
    double ratio = 1;         ///< pulley
    Vec2 groundA, groundB;    ///< pulley's wheels, scene coordinates
    double breakForce = 0;    ///< breaks above this force, whatever the torque, after the step; 0: never
    bool collide = false;     ///< may the joined bodies collide?
};

/// What a joint did in the last step.
struct JointState {
    Vec2 force;         ///< on b, mass * unit / s²
    double torque = 0;  ///< on b, force * unit
    double value = 0;   ///< angle (radians) or travel or distance (units) since the time of adding
    bool broken = false;
    Vec2 pointA, pointB;  ///< where it holds the two, scene coordinates
};

/// Two bodies began to touch, or ended. Touches that go on are in contacts().
struct ContactEvent {
    BodyHandle bodyA = kNoHandle, bodyB = kNoHandle;  ///< bodyA < bodyB
    bool begins = false;
    double impulse = 0;  ///< begins: of the first step, mass * unit / s
};

/// Where a ray or a cast shape first meets a body.
struct CastHit {
    BodyHandle body = kNoHandle;
    Vec2 point;           ///< scene coordinates
    Vec2 normal;          ///< unit, out of the body
    double fraction = 0;  ///< 0..1 of the way
};

/// Which bodies a query sees.
struct QueryFilter {
    std::uint32_t mask = ~0U;       ///< bits: layers
    BodyHandle except = kNoHandle;  ///< this body is looked through
    bool sensors = false;           ///< are sensors seen?
};

/// One touching point found in the last step (SPEC PH9).
struct Contact {
    BodyHandle bodyA = kNoHandle;  ///< owner of the particle or vertex
    BodyHandle bodyB = kNoHandle;  ///< owner of the wall
    std::uint32_t particle = 0;    ///< index within A's first-to-last border points
    std::uint32_t wall = 0;        ///< index of the wall's first point within B's border points
    Vec2 point;                    ///< scene units
    double edgeParameter = 0;      ///< 0..1 along the wall
    Vec2 normal;                   ///< unit, from B towards A
    double penetration = 0;        ///< scene units, > 0 when overlapping
    double impulse = 0;            ///< normal impulse of the last step, mass * unit / s
};

/// Structure-of-arrays view of all bodies after a step; valid until the next non-const call on the world.
struct BodyStates {
    std::span<const Vec2> position;  ///< [bodies] centre of mass
    std::span<const double> angle;   ///< [bodies] radians since the start; soft bodies: best-fit rotation
    std::span<const Vec2> velocity;  ///< [bodies] of the centre of mass
    std::span<const double> omega;   ///< [bodies] rad/s
    std::span<const Box> bounds;     ///< [bodies]
    std::span<const std::uint32_t>
        firstPoint;                ///< [bodies + 1] ranges into points: soft = particles, rigid = border vertices
    std::span<const Vec2> points;  ///< [firstPoint.back()] current positions
};

/// Counts and times of the last step.
struct StepStats {
    std::uint32_t contacts = 0;
    double broadPhaseMs = 0, narrowPhaseMs = 0, solverMs = 0, springsMs = 0;
    std::uint32_t awakeBodies = 0;  ///< bodies that were computed
    std::uint32_t islands = 0;      ///< groups of bodies that touch or are joined; 0 where sleeping is off
    std::uint32_t colours = 0;      ///< groups of contacts that are solved side by side
    std::uint32_t pairs = 0;        ///< pairs of parts whose boxes meet
    std::uint32_t substeps = 0;     ///< the step was taken in
    double islandsMs = 0, continuousMs = 0;
    std::size_t memory = 0;  ///< bytes the world holds for bodies, contacts and joints
};

class JET_API PhysicsWorld {
public:
    virtual ~PhysicsWorld();

    /// What is added between steps counts from the next one on.
    virtual BodyHandle addSoftBody(const SoftBodyDef&) = 0;
    virtual BodyHandle addRigidBody(const RigidBodyDef&) = 0;
    virtual ActuatorHandle addSpring(const SpringActuatorDef&) = 0;
    virtual ActuatorHandle addAngularSpring(const AngularSpringActuatorDef&) = 0;
    virtual ActuatorHandle addTorque(const TorqueActuatorDef&) = 0;
    virtual ActuatorHandle addForce(const ForceActuatorDef&) = 0;

    /// Advances by dt seconds (> 0; JET's own engine takes up to 500). Bit-equal for equal histories, whatever the
    /// thread count.
    virtual void step(double dt) = 0;

    virtual std::size_t bodyCount() const = 0;
    virtual BodyStates bodies() const = 0;
    /// All that touched in the last step, whether it began then or goes on.
    virtual std::span<const Contact> contacts() const = 0;
    virtual StepStats stats() const = 0;
    /// Did these two bodies touch in the last step? False for bodies of equal handle.
    virtual bool touching(BodyHandle a, BodyHandle b) const = 0;
    /// Does the body contain the point? (For anchors and picking.)
    virtual bool contains(BodyHandle body, const Vec2& point) const = 0;

    // Acting on the world between steps. Torques and forces of actuators persist until set again.
    virtual void setTorque(ActuatorHandle torque, double value) = 0;
    virtual void setForce(ActuatorHandle force, const Vec2& value) = 0;
    /// Force for the next step only, at the centre of mass (soft: spread by mass).
    virtual void applyForce(BodyHandle body, const Vec2& force) = 0;
    /// At the centre of mass, at once; mass * unit / s.
    virtual void applyImpulse(BodyHandle body, const Vec2& impulse) = 0;
    virtual void setVelocity(BodyHandle body, const Vec2& velocity) = 0;
    virtual void setOmega(BodyHandle body, double omega) = 0;
    /// Moves the body without changing its shape or velocity.
    virtual void setPosition(BodyHandle body, const Vec2& centre) = 0;
    virtual void setGravity(const Vec2& gravity) = 0;

    /// Spring and torn state for drawing: is the soft body's spring `index` still whole?
    virtual bool springAlive(BodyHandle body, std::uint32_t index) const = 0;

    // What follows an engine may lack; the default refuses with a sentence.

    /// Live changes. `setSettings` takes all but the count of materials, precision and SIMD; `setBody` all but `fixed`
    /// and the initial velocities; `setJoint` all but the kind and the anchors.
    virtual void setSettings(const WorldSettings&);
    virtual void setBody(BodyHandle, const BodyCommon&);
    virtual void setMass(BodyHandle, double mass);
    /// Switched off, a body stands still, is unseen, meets and holds nothing; it starts from rest when switched on.
    virtual void setEnabled(BodyHandle, bool enabled);
    virtual void setJoint(JointHandle, const JointDef&);
    /// restLength < 0: as it is.
    virtual void setSpring(ActuatorHandle spring, double restLength, double ks, double kd, double tearRatio);

    /// `setForceField` may change all but the kind. Fields count by themselves.
    virtual ActuatorHandle addForceField(const ForceFieldDef&);
    virtual void setForceField(ActuatorHandle field, const ForceFieldDef&);
    virtual void setSoftMatter(BodyHandle, const SoftMatter&);
    /// Of all springs of a soft body; what is torn stays torn.
    virtual void setSprings(BodyHandle, double ks, double kd, double tearRatio);
    /// Holds a particle where it is, or lets it go.
    virtual void setPinned(BodyHandle, std::uint32_t particle, bool pinned);
    /// What the soft body's spring `index` pulls with now; below 0 where it pushes. For stress maps.
    virtual double springTension(BodyHandle, std::uint32_t index) const;
    /// [particles] which piece of its torn body a particle belongs to, from 0; empty: the body is whole.
    virtual std::span<const std::uint32_t> pieces(BodyHandle) const { return {}; }
    /// The walls of a soft body as they are now, closed rings of particle indices; pieces have their own.
    virtual std::vector<std::vector<std::uint32_t>> borders(BodyHandle) const { return {}; }

    virtual JointHandle addJoint(const JointDef&);
    virtual std::size_t jointCount() const { return 0; }
    virtual JointState joint(JointHandle) const;
    virtual void setMotor(JointHandle, bool driven, double speed);
    /// Moves the end of a joint that is fixed to the background (a mouse joint's target).
    virtual void setJointTarget(JointHandle, const Vec2& target);
    virtual void removeJoint(JointHandle);

    virtual bool awake(BodyHandle) const { return true; }
    virtual void wake(BodyHandle) {}
    /// Number of the group of touching or joined bodies it was computed with; kNoHandle: none, or asleep.
    virtual std::uint32_t island(BodyHandle) const { return kNoHandle; }
    /// Touches that began or ended in the last step, in ascending order of bodies. Telling them takes time: a world
    /// with soft bodies, or rigid ones without simple shapes, may begin with it when it is first asked, and then tells
    /// of all that touch as beginning. Ask from the first step on, or compare contacts().
    virtual std::span<const ContactEvent> contactEvents() const { return {}; }

    // Queries see the world as it is, also between adding and the first step.

    /// The first body on the way from one place to another.
    virtual std::optional<CastHit> rayCast(const Vec2& from, const Vec2& to, const QueryFilter& = {}) const;
    /// The first body a shape meets when it is moved without turning.
    virtual std::optional<CastHit> shapeCast(const ShapeDef&, const Vec2& way, const QueryFilter& = {}) const;
    /// Bodies whose outline meets the box, ascending.
    virtual std::vector<BodyHandle> overlapping(const Box&, const QueryFilter& = {}) const;
    /// The point of any body nearest to `point`, no farther than `reach`; fraction = distance / reach.
    virtual std::optional<CastHit> nearest(const Vec2& point, double reach, const QueryFilter& = {}) const;

    /// Hash of the complete dynamic state (positions, velocities, actuator values, warm-start data).
    virtual std::uint64_t hash() const = 0;
    /// The dynamic state as bytes; restore() continues bit-equal. Only for the world that saved it, or an equal one.
    virtual std::vector<std::byte> save() const = 0;
    virtual void restore(std::span<const std::byte> state) = 0;
};

class JET_API PhysicsEngine {
public:
    virtual ~PhysicsEngine();
    virtual std::unique_ptr<PhysicsWorld> createWorld(const WorldSettings&) = 0;
};

}  // namespace jet
