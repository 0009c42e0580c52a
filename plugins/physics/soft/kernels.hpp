// The inner loops of soft bodies: 8 springs at a time, with the instructions the processor has.
//
// Every kernel exists for SSE2 (each x86-64 has it) and AVX2, flights for AVX-512, too. They are chosen at run time and
// give the same bits:
// only operations that IEEE 754 rounds exactly (+ - * / and square root), the same lanes, the same order of sums. No
// fused multiply-add, no reciprocal estimates: those differ between processors.
//
// Precision: positions and velocities are double; a spring's own arithmetic, and the sum of the springs' forces at a
// particle, are single, relative to the body's own frame. Forces between particles of a body sum to nothing; what
// rounding leaves of that is taken out of the body's acceleration, so momentum is kept to the last bits of double.
//
// While springs are computed their nodes lie in planes: all x, all y, and so on. Springs whose ends both lie 8 in a row
// then need no gathering (Run). Bodies alike, of the same springs between the same particles, are computed 8 at a time:
// row k of the planes holds particle k of each, and every spring is a run.
#pragma once

#include <cstddef>
#include <cstdint>

namespace jet {
enum class Simd : std::uint8_t;  // physics.hpp, whose code must not be compiled for some processors only
}

namespace jet::physics::soft {

/// Lanes a block of springs has.
inline constexpr std::uint32_t kLanes = 8;

/// Far above any sensible scene; keeps absurd forces from reaching infinity, where nothing would come back from.
inline constexpr double kMostSpeed = 1e6;  // units / s

/// Of index, that the springs of a body with a pattern have (layout.hpp).
inline constexpr std::size_t kMostDifferences = 8;

/// Springs from nodes a .. a + 7 to b .. b + 7.
struct Run {
    std::uint32_t a = 0, b = 0;
};

/// A stretch of nodes in planes: x, y, vx and vy (units, units / s, from the frame), and the sums of the springs'
/// forces along x and y.
struct Planes {
    enum Plane : std::size_t { X, Y, Vx, Vy, Fx, Fy, kCount };

    float* first;        ///< plane X
    std::size_t stride;  ///< from each plane to the next: the room, and 8 more
    float* near;         ///< [room][4] x y vx vy, where many springs must be gathered; else null
    std::size_t room;    ///< nodes, a multiple of 8: see roomFor()

    float* operator[](Plane plane) const { return first + plane * stride; }
};

/// Nodes that are pulled at and moved at a time.
inline constexpr std::size_t kPortion = 64;

/// Room in the planes for a body: a portion and what it reaches to. A body larger than that goes through the planes
/// piece by piece. `reach`: nodes from the first one of a block to the last.
inline std::size_t roomFor(std::size_t nodes, std::size_t reach)
{
    constexpr std::size_t kPiece = 512;
    const std::size_t whole = (nodes + 7) & ~std::size_t{7}, piece = (reach + 2 * kPortion + kPiece) & ~std::size_t{7};
    return whole < piece ? whole : piece;
}

/// Springs of one body, or of 8 alike. Node indices are places in the planes.
struct SpringBlocks {
    const Run* runs = nullptr;  ///< those of equal a one after the other
    std::size_t runCount = 0;
    const std::uint32_t* ends = nullptr;  ///< [scattered][16]: 8 nodes a, ascending over all of them; 8 nodes b >= a
    std::size_t scatteredCount = 0;
    const float* rest = nullptr;          ///< [runs + scattered][8] units
    const std::uint32_t* kind = nullptr;  ///< [runs + scattered] into kinds: most blocks are alike
    const float* kinds = nullptr;         ///< [][2][8]: stiffness, damping; both 0: no spring
    const float* tear = nullptr;          ///< [runs + scattered][8] units; null: none tears
    std::uint32_t* torn = nullptr;        ///< [runs + scattered]: blocks that may have torn springs are put here
    float crush = 0;                      ///< seconds; see kCrushed
    std::size_t reach = 0;                ///< nodes from the first one of a block to the last, at most
};

/// Springs shorter than this part of their rest length are damped by their stiffness times SpringBlocks::crush, too.
/// Where the ends of a spring pass each other its direction turns at once, which no step follows: undamped bodies that
/// are crushed again and again would gather energy without end.
inline constexpr float kCrushed = 0.25F;

/// What one substep does to the velocities of a body's particles.
struct VelocityStep {
    double h = 0;  ///< seconds
    double gravityX = 0, gravityY = 0;
    double kept = 1;  ///< part of the velocity that damping leaves
};

/// Origin and velocity of a body's frame.
struct Frame {
    double x = 0, y = 0, vx = 0, vy = 0;
};

/// The nodes of one body, as they lie in State::nodes.
struct NodeArrays {
    const double* position;  ///< [count][2]
    double* velocity;        ///< [count][2]
    double* force;           ///< [count][2] from outside; null: none
    const double* inverseMass;
    std::size_t count;
};

/// What the springs of a body did in one substep.
struct Swing {
    double x = 0, y = 0;   ///< sum of their forces: null but for rounding
    bool pinned = false;   ///< is any of the nodes?
    std::size_t torn = 0;  ///< blocks put into SpringBlocks::torn
};

/// Part of a large body, gone through apart from the others, at the same time. Springs belong to the part that their
/// block's first node lies in; what they do to nodes of the next part, not further than its head, is handed over.
struct Stretch {
    std::size_t first = 0, end = 0;           ///< nodes; multiples of kPortion, but for the end of the last
    std::size_t run = 0, scattered = 0;       ///< the first blocks of its own
    std::size_t head = 0;                     ///< nodes from its first on that move only when the part before is done
    float *held = nullptr, *spilt = nullptr;  ///< [2][room for a head] forces along x, y: its head's; on the next one's
};
inline std::size_t headFor(std::size_t reach) { return (reach + 8 + kPortion - 1) / kPortion * kPortion; }

struct FlightKernels;

struct Kernels {
    /// Changes the velocities by the springs, gravity and the forces from outside, as accelerate() does; the planes are
    /// its scratch. A body is gone through once, a few rows at a time: what is related to the frame is pulled at and
    /// accelerated while it is still near in the cache.
    Swing (*swing)(const SpringBlocks&, const NodeArrays&, const Frame&, const VelocityStep&, const Planes&,
                   const Stretch&);
    /// Then moves the head of a part, which the part before has spilt forces on.
    Swing (*join)(const NodeArrays&, const VelocityStep&, const Planes&, const Stretch&, const float* spilt);
    /// Fills the planes with those of bodies alike: row k, lane l is node nodeAt[8 k + l] in frames[l]; no forces.
    void (*relateAlike)(const double* position, const double* velocity, const std::uint32_t* nodeAt, std::size_t rows,
                        const Frame* frames, const Planes&);
    /// Adds the springs' forces; returns how many blocks it put into `torn`.
    std::size_t (*pull)(const SpringBlocks&, const Planes&);
    /// totals[l], totals[8 + l]: sums of the forces along x and y of the body in lane l.
    void (*sumAlike)(const Planes&, std::size_t rows, double* totals);
    /// v = kept (v + h (g + f / m)), force = 0; nodes of inverse mass 0 stay as they are.
    void (*accelerate)(double* velocity, double* force, const double* inverseMass, std::size_t nodes,
                       const VelocityStep&);
    /// The same for `count` bodies alike; steps[l] is that of lane l.
    void (*accelerateAlike)(double* velocity, double* force, const double* inverseMass, const std::uint32_t* nodeAt,
                            std::size_t rows, std::size_t count, const VelocityStep* steps, const Planes&);
    /// v += (driftX, driftY), x += h v, after slowing what is faster than kMostSpeed; what is not a number is stopped.
    void (*advance)(double* position, double* velocity, std::size_t nodes, double h, double driftX, double driftY);
    const FlightKernels* flight;  ///< see flight.hpp
};

const Kernels& kernelsSse2();
const Kernels& kernelsAvx2();
const Kernels& kernelsAvx512();
/// Does this processor have AVX2?
bool hasAvx2();
/// And AVX-512, of a kind that does not slow the rest down: since Ice Lake and Zen 4?
bool hasAvx512();
/// Those asked for, or the widest before them that this processor has; Automatic: the widest.
const Kernels& kernelsFor(Simd);

}  // namespace jet::physics::soft
