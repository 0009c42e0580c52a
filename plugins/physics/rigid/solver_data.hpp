// What the solver's kernels work on: structures of arrays in groups of as many constraints as a register has lanes.
// The bodies of a group's lanes are all different (graph colouring), so that lanes never wait for each other.
//
// Derivation. Within a step, anchors and normals are frozen. A contact point with levers rA, rB and normal n (from A to
// B) has the relative speed  vn = n·(vB - vA) + (rB × n) wB - (rA × n) wA,  and its separation after some substeps is
// s = s0 + n·(dB - dA) + (rB × n) aB - (rA × n) aA  with the moves d and turns a since the start of the step. The
// effective mass is 1 / (mA + mB + iA (rA × n)² + iB (rB × n)²), with inverse masses m and inverse moments i. So a
// point needs two levers, not four coordinates, and no rotation during the substeps.
//
// Turning is measured at the radius of gyration k, where i = m / k²: with the spin k w in place of w, the sweep k a of
// a and levers divided by k, one inverse mass is all that an impulse needs of a body, beside its velocity.
//
// Joints swing: their arms turn with the bodies, once a substep. A push meets the error as it will be at the end of the
// substep, which the arms' turning on adds (h/2) (wA² rA - wB² rB) a second to; a relax pass then meets the arms as
// they have become. Both act along the arms of the same moment, so that what swings keeps its speed (the scheme is that
// of RATTLE, Andersen 1983, https://doi.org/10.1016/0021-9991(83)90014-1).
#pragma once

#include "lanes.hpp"
#include "state.hpp"
#include "trigonometry_terms.hpp"

#include <iterator>
#include <utility>

namespace jet::physics {

/// Hot state of a body: all a kernel reads or writes of it, in one cache line. Body 0 stands for all that never moves.
template <class Real>
struct alignas(8 * sizeof(Real)) BodyState {
    Real velocityX = 0, velocityY = 0;  // units / s
    Real spin = 0;                      // units / s, at the radius of gyration
    Real invMass = 0;                   // 1 / mass
    Real moveX = 0, moveY = 0;          // units since the start of the step
    Real sweep = 0;                     // units since the start of the step, at the radius of gyration
    Real perGyration = 0;               // 1 / that radius; 0: never turns

    Real omega() const { return spin * perGyration; }  // rad / s
    Real turn() const { return sweep * perGyration; }  // radians since the start of the step
};

/// Groups name bodies by how far their states lie from the first, in units of eight bytes: addresses count in them.
template <class Real>
inline constexpr std::int32_t kFar = sizeof(BodyState<Real>) / 8;
template <class Real>
std::int32_t farOf(Index slot)
{
    return static_cast<std::int32_t>(slot) * kFar<Real>;
}
template <class Real>
Index slotAt(std::int32_t far)
{
    return static_cast<Index>(far / kFar<Real>);
}

/// What the body passes of a substep need beside the state, in rows that match the state's velocities.
template <class Real>
struct alignas(4 * sizeof(Real)) BodyPush {
    Real accelerationX = 0, accelerationY = 0, accelerationW = 0;  // of gravity, forces, torques (of the spin)
    Real noAcceleration = 0;
    // Change of velocity by all accumulated impulses: warm starting without visiting the constraints again.
    Real warmX = 0, warmY = 0, warmW = 0;
    Real noWarming = 0;
    Real beforeX = 0, beforeY = 0, beforeW = 0;  // velocity after warm starting
    Real invMass = 0;
};

// Groups of lanes. Kernels for processors without registers of 32 bytes see them as L of their own
// (half_lanes.inc.hpp).

template <class Real, template <class> class L = Lanes>
struct alignas(32) ContactLanes {
    std::int32_t a[kLanes<Real>], b[kLanes<Real>];  // bodies, see kFar; 0: never moves
    L<Real> normalX, normalY;                       // from A to B
    L<Real> mostPush;                               // units / s that overlap is pushed out with at most
    struct Point {
        L<Real> leverA, leverB;  // r × n, in radii of gyration
        L<Real> separation;      // at the start of the step, plus slop
        L<Real> now;             // the same after the last move
        L<Real> mass;            // 0: no such point
        L<Real> impulse;         // accumulated, of a substep
    } points[2];
};

/// Read by the relax pass only.
template <class Real, template <class> class L = Lanes>
struct alignas(32) FrictionLanes {
    L<Real> friction;
    struct Point {
        L<Real> leverA, leverB;  // r × tangent, in radii of gyration
        L<Real> mass;
        L<Real> impulse;
        L<Real> total;  // along the normal, of the step
    } points[2];
};

/// Read by the last pass of a step only, and kept only by groups in which something bounces.
template <class Real, template <class> class L = Lanes>
struct alignas(32) BounceLanes {
    L<Real> restitution;
    L<Real> approach[2];  // relative normal speed at the start of the step; negative: approaching
};

/// A point of A held to a point of B: the core of revolute, weld and similar joints.
template <class Real, template <class> class L = Lanes>
struct alignas(32) JointLanes {
    std::int32_t a[kLanes<Real>], b[kLanes<Real>];
    L<Real> leverAX, leverAY, leverBX, leverBY;  // the arms in radii of gyration
    L<Real> pushX, pushY;  // units / s that a push asks for: by the error, and the arms' turning on
    L<Real> inverseXX, inverseXY, inverseYY;
    L<Real> impulseX, impulseY;
    // Read once a substep.
    L<Real> armAX, armAY, armBX, armBY;  // from the centres
    L<Real> errorX, errorY;
    L<Real> perGyrationA, perGyrationB;
    L<Real> startAX, startAY, startBX, startBY, startErrorX, startErrorY;  // at the start of the step
};

/// Where the points of a group of joints lie in their bodies, from the centres; of the background: where they are.
template <class Real, template <class> class L = Lanes>
struct alignas(32) AnchorLanes {
    static constexpr int kFours = kLanes<Real> / 4;
    L<double> ax[kFours], ay[kFours], bx[kFours], by[kFours];
};

/// Where a body is at the start of a step, and how it is turned.
struct alignas(32) BodyPlace {
    double x = 0, y = 0, cosine = 0, sine = 0;  // body 0 is not turned at all
};

/// A damped spring of some frequency, integrated implicitly over h, as a bias rate and two scales of the impulse.
template <class Real>
struct Softness {
    Real biasRate = 0, massScale = 1, impulseScale = 0;
};

template <class Real>
struct StepConstants {
    Real h = 0, inverseH = 0;              // s, 1 / s
    Real linearKept = 1, angularKept = 1;  // velocity of what moves left by damping after a substep
    Softness<Real> moving, still, joint;   // contacts between moving bodies, with one that does not move, joints
    Real restSpeed = 0;                    // units / s; slower hits do not bounce
    Real totalKept = 1, totalAdded = 0;    // how a relax pass adds to the totals: they begin anew with a step's first
                                           // substep, and get the impulses that are left at the end of each
};

struct RigidContact;
struct Pose;
/// A contact that has points, and where its constraint lies.
struct LaneOfContact {
    const RigidContact* contact = nullptr;
    ContactLanes<float>* group = nullptr;
    FrictionLanes<float>* friction = nullptr;
    std::size_t lane = 0;
};

template <class Real>
struct Kernels {
    // Groups of one call to calm, solve or relax contacts have no moving body in common.

    /// Looks how far apart the bodies are after their move, and takes the pushing velocity back out, of normals alone.
    void (*calmContacts)(BodyState<Real>*, ContactLanes<Real>*, std::size_t, const StepConstants<Real>&);
    /// Adds the accumulated impulses of contacts to the bodies' velocities.
    void (*warmContacts)(BodyState<Real>*, const ContactLanes<Real>*, const FrictionLanes<Real>*, std::size_t);
    void (*warmJoints)(BodyState<Real>*, const JointLanes<Real>*, std::size_t);
    /// Pushes out of overlaps: normals only.
    void (*solveContacts)(BodyState<Real>*, ContactLanes<Real>*, std::size_t, const StepConstants<Real>&);
    /// Takes the pushing velocity back out; friction; totals.
    void (*relaxContacts)(BodyState<Real>*, ContactLanes<Real>*, FrictionLanes<Real>*, std::size_t,
                          const StepConstants<Real>&);
    /// For the bounces: relative speeds before anything is solved.
    void (*approachContacts)(const BodyState<Real>*, const ContactLanes<Real>*, BounceLanes<Real>*, std::size_t);
    void (*scaleContacts)(ContactLanes<Real>*, FrictionLanes<Real>*, std::size_t, Real by);
    /// Moves the separations on to the end of the step, and sets a bit for each lane that pushed.
    void (*carryContacts)(ContactLanes<Real>*, const FrictionLanes<Real>*, std::uint32_t* bits, std::size_t);
    void (*bounceContacts)(BodyState<Real>*, ContactLanes<Real>*, FrictionLanes<Real>*, const BounceLanes<Real>*,
                           std::size_t, const StepConstants<Real>&);
    /// Makes the joints for where the bodies are at the start of a step.
    void (*startJoints)(const BodyState<Real>*, const BodyPlace*, JointLanes<Real>*, const AnchorLanes<Real>*,
                        std::size_t);
    /// Looks where the arms turn in a substep.
    void (*foreseeJoints)(const BodyState<Real>*, JointLanes<Real>*, std::size_t, const StepConstants<Real>&);
    /// Pushes errors out.
    void (*pushJoints)(BodyState<Real>*, JointLanes<Real>*, std::size_t, const StepConstants<Real>&);
    /// Takes the pushing velocity back out.
    void (*relaxJoints)(BodyState<Real>*, JointLanes<Real>*, std::size_t);
    /// Turns the arms to where the bodies are now; what the accumulated impulses warm follows. Says whether any is
    /// strained.
    bool (*turnJoints)(const BodyState<Real>*, BodyPush<Real>*, JointLanes<Real>*, std::size_t,
                       const StepConstants<Real>&);
    /// Takes up the impulses of the last substep, then forces, damping and warm starting.
    void (*integrateVelocities)(BodyState<Real>*, BodyPush<Real>*, std::size_t, const StepConstants<Real>&);
    void (*integratePositions)(BodyState<Real>*, std::size_t, Real h);
    /// (cos, sin) of angles, as direction() has them; false: some are too far for it, and theirs are not true.
    bool (*turnBodies)(const double* angles, double* directions, std::size_t);
    /// Writes the constraints of eight contacts anew, for the same bodies as before; of `states`, in slots.
    void (*writeContacts)(const LaneOfContact* eight, const Pose*, const BodyState<float>* states);
};

/// The kernels for this processor, or those asked for where it has them.
enum class KernelChoice : std::uint8_t { Best, Sse2, Avx2 };
template <class Real>
const Kernels<Real>& kernels(KernelChoice);
bool hasAvx2();

namespace sse2 {
extern const Kernels<float> singles;
extern const Kernels<double> doubles;
}  // namespace sse2
namespace avx2 {
extern const Kernels<float> singles;
extern const Kernels<double> doubles;
}  // namespace avx2

}  // namespace jet::physics
