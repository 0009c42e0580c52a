// The inner loops of soft bodies: 8 springs at a time, with the instructions the processor has.
//
// Every kernel exists for SSE2 (each x86-64 has it) and AVX2, chosen at run time, and gives the same bits with both:
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

namespace jet::physics::soft {

/// Lanes a block of springs has.
inline constexpr std::uint32_t kLanes = 8;

/// Far above any sensible scene; keeps absurd forces from reaching infinity, where nothing would come back from.
inline constexpr double kMostSpeed = 1e6;  // units / s

/// Springs from nodes a .. a + 7 to b .. b + 7.
struct Run {
    std::uint32_t a = 0, b = 0;
};

/// [nodes], each with room for 8 more.
struct Planes {
    float *x, *y, *vx, *vy;  ///< units, units / s, from the frame
    float *fx, *fy;          ///< sums of the springs' forces
    float* near;             ///< [nodes][4] x y vx vy, where many springs must be gathered; else null
};

/// Springs of one body, or of 8 alike. Node indices are places in the planes.
struct SpringBlocks {
    const Run* runs = nullptr;  ///< those of equal a one after the other
    std::size_t runCount = 0;
    const std::uint32_t* ends = nullptr;  ///< [scattered][16]: 8 nodes a, 8 nodes b
    std::size_t scatteredCount = 0;
    /// [runs + scattered][3][8]: rest length, stiffness, damping. All 0: no spring.
    const float* coefficients = nullptr;
    const float* tear = nullptr;    ///< [runs + scattered][8] units; null: none tears
    std::uint32_t* torn = nullptr;  ///< [runs + scattered]: blocks that may have torn springs are put here
    float crush = 0;                ///< seconds; see kCrushed
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

struct Kernels {
    /// Fills the planes with nodes 0 .. in the frame; no forces.
    void (*relate)(const double* position, const double* velocity, std::size_t nodes, const Frame&, const Planes&);
    /// The same for bodies alike: row k, lane l is node nodeAt[8 k + l] in frames[l].
    void (*relateAlike)(const double* position, const double* velocity, const std::uint32_t* nodeAt, std::size_t rows,
                        const Frame* frames, const Planes&);
    /// Adds the springs' forces; returns how many blocks it put into `torn`.
    std::size_t (*pull)(const SpringBlocks&, const Planes&);
    /// Sums of the forces along x and y.
    void (*sum)(const Planes&, std::size_t nodes, double* total);
    /// totals[l], totals[8 + l]: those of the body in lane l.
    void (*sumAlike)(const Planes&, std::size_t rows, double* totals);
    /// v = kept (v + h (g + f / m)), force = 0; nodes of inverse mass 0 stay as they are. f: `force`, unless that is
    /// null, and that of the planes, unless those are.
    void (*accelerate)(double* velocity, double* force, const double* inverseMass, std::size_t nodes,
                       const VelocityStep&, const Planes*);
    /// The same for `count` bodies alike; steps[l] is that of lane l.
    void (*accelerateAlike)(double* velocity, double* force, const double* inverseMass, const std::uint32_t* nodeAt,
                            std::size_t rows, std::size_t count, const VelocityStep* steps, const Planes&);
    /// x += h v, after slowing what is faster than kMostSpeed; what is not a number is stopped.
    void (*advance)(double* position, double* velocity, std::size_t nodes, double h);
};

const Kernels& kernelsSse2();
const Kernels& kernelsAvx2();
/// Does this processor have AVX2?
bool hasAvx2();
const Kernels& bestKernels();

}  // namespace jet::physics::soft
