// The contract between the editor and a physics engine plugin: ids, spans and plain structs, no scene types.
//
// Order of calls: engine.createWorld -> world.add... (any number) -> world.step / read / act, repeated -> destroyed.
// A world belongs to one thread at a time: the simulation's. Handles are indices in the order of adding, per kind.
// Units: scene units (y down), seconds, mass units; force = mass * unit / s². Angles and torques grow clockwise on
// screen.
#pragma once

#include <jet/geometry.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace jet {

using BodyHandle = std::uint32_t;
using ParticleHandle = std::uint32_t;
using ActuatorHandle = std::uint32_t;
inline constexpr std::uint32_t kNoHandle = 0xffffffffU;

/// How a pair of materials meets (thesis §2.4.3.4; SPEC PH8).
struct MaterialPair {
    double friction = 0.6;     ///< Coulomb coefficient
    double restitution = 0.1;  ///< 0 no bounce, 1 full
    bool collides = true;
};

struct WorldSettings {
    Vec2 gravity{0, 98.1};       ///< scene units / s²
    double linearDamping = 0.0;  ///< 1/s; velocity decays as exp(-damping t)
    double angularDamping = 0.0;
    bool applyGravity = true;  ///< the four switches of SPEC PH10
    bool applyDamping = true;
    bool findCollisions = true;
    bool resolveCollisions = true;
    std::uint32_t materialCount = 1;
    std::vector<MaterialPair> materials =
        std::vector<MaterialPair>(1);  ///< [materialCount x materialCount], row major, symmetric
    int threads = 1;
};

/// Spring between two particles of one soft body (SPEC PH2).
struct SpringDef {
    std::uint32_t a = 0, b = 0;  ///< particle indices within the body
    double restLength = 0;       ///< scene units
    double ks = 10;              ///< stiffness, force / unit
    double kd = 0.1;             ///< damping along the spring, force / (unit/s)
    double tearRatio = 0;        ///< kt: tears beyond restLength * tearRatio; 0 never tears
};

/// Angular spring over three particles a - centre - b (SPEC PH3); keeps the angle from a to b about the centre.
struct AngularSpringDef {
    std::uint32_t a = 0, centre = 0, b = 0;
    double restAngle = 0;  ///< radians
    double ks = 10;        ///< torque / rad
    double kd = 0.1;       ///< torque / (rad/s)
};

struct BodyCommon {
    bool fixed = false;          ///< never moves; collides with everything that does
    std::uint32_t material = 0;  ///< index into WorldSettings::materials
    Vec2 velocity;               ///< initial, units/s
    double omega = 0;            ///< initial, rad/s (soft bodies: applied about their centre of mass)
    double gravityScale = 1;
    bool sensor = false;  ///< contacts are reported, not resolved
};

/// Closed walls a body collides with. Borders of one body are one region: a
/// point is inside when it is inside an odd number of borders: an outer border and holes. Concave is normal.
struct SoftBodyDef {
    BodyCommon common;
    std::vector<Vec2> particles;                      ///< positions, scene units
    std::vector<double> masses;                       ///< one a particle, > 0
    std::vector<std::uint8_t> movable;                ///< one a particle; empty = all movable
    std::vector<std::vector<std::uint32_t>> borders;  ///< closed rings of particle indices
    std::vector<SpringDef> springs;
    std::vector<AngularSpringDef> angularSprings;
};

struct RigidBodyDef {
    BodyCommon common;
    std::vector<std::vector<Vec2>> borders;  ///< closed rings, scene coordinates at rest
    double mass = 1;                         ///< > 0; the moment of inertia follows from the borders (SPEC PH5)
};

/// A point fixed to a body (or, with body == kNoHandle, to the background).
struct Anchor {
    BodyHandle body = kNoHandle;
    Vec2 point;  ///< scene coordinates at the time of adding
};

/// Scene-level spring (SPEC PH7): joins two anchors. restLength < 0: the distance at the time of adding.
struct SpringActuatorDef {
    Anchor a, b;
    double restLength = -1;
    double ks = 10, kd = 0.1;
    double tearRatio = 0;
};

struct AngularSpringActuatorDef {
    Anchor a, centre, b;
    double restAngle = 0;
    bool restFromPose = true;  ///< take the angle at the time of adding instead of restAngle
    double ks = 10, kd = 0.1;
};

/// Torque on a body about a point of it. Clockwise on screen is positive here.
struct TorqueActuatorDef {
    Anchor at;
    double value = 0;  ///< force * unit
};

/// Constant force on a body at a point of it, in scene directions.
struct ForceActuatorDef {
    Anchor at;
    Vec2 force;
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
};

class JET_API PhysicsWorld {
public:
    virtual ~PhysicsWorld();

    virtual BodyHandle addSoftBody(const SoftBodyDef&) = 0;
    virtual BodyHandle addRigidBody(const RigidBodyDef&) = 0;
    virtual ActuatorHandle addSpring(const SpringActuatorDef&) = 0;
    virtual ActuatorHandle addAngularSpring(const AngularSpringActuatorDef&) = 0;
    virtual ActuatorHandle addTorque(const TorqueActuatorDef&) = 0;
    virtual ActuatorHandle addForce(const ForceActuatorDef&) = 0;

    /// Advances by dt seconds (> 0). Bit-equal for equal histories, whatever the thread count.
    virtual void step(double dt) = 0;

    virtual std::size_t bodyCount() const = 0;
    virtual BodyStates bodies() const = 0;
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
    virtual void applyImpulse(BodyHandle body, const Vec2& impulse) = 0;
    virtual void setVelocity(BodyHandle body, const Vec2& velocity) = 0;
    virtual void setOmega(BodyHandle body, double omega) = 0;
    /// Moves the body without changing its shape or velocity.
    virtual void setPosition(BodyHandle body, const Vec2& centre) = 0;
    virtual void setGravity(const Vec2& gravity) = 0;

    /// Spring and torn state for drawing: is the soft body's spring `index` still whole?
    virtual bool springAlive(BodyHandle body, std::uint32_t index) const = 0;

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
