// The inner loops of soft bodies: 8 springs at a time, with the instructions the processor has.
//
// Every kernel exists for SSE2 (each x86-64 has it) and AVX2, chosen at run time, and gives the same bits with both:
// only operations that IEEE 754 rounds exactly (+ - * / and square root), the same lanes, the same order of sums. No
// fused multiply-add, no reciprocal estimates: those differ between processors.
//
// Precision: positions, velocities and forces are double; a spring's own arithmetic is single, on positions and
// velocities relative to the body's own frame. What it gives is added to one end and taken from the other as the same
// double, so momentum is kept to the last bits of double. Measured alternatives: docs/decisions.
#pragma once

#include <cstddef>
#include <cstdint>

namespace jet::physics::soft {

/// Lanes a block of springs has.
inline constexpr std::uint32_t kLanes = 8;
/// Lane of the k-th spring of a block: what transposing leaves in order.
inline constexpr std::uint32_t kLaneOf[kLanes] = {0, 4, 1, 5, 2, 6, 3, 7};

/// Far above any sensible scene; keeps absurd forces from reaching infinity, where nothing would come back from.
inline constexpr double kMostSpeed = 1e6;  // units / s

/// Springs from nodes a .. a + 7 to b .. b + 7.
struct Run {
    std::uint32_t a = 0, b = 0;
};

/// Springs of one body. Node indices count from the body's first node.
struct SpringBlocks {
    const Run* runs = nullptr;
    std::size_t runCount = 0;
    const std::uint32_t* ends = nullptr;  ///< [scattered][16]: 8 nodes a, 8 nodes b, in the order of the springs
    std::size_t scatteredCount = 0;
    /// [runs + scattered][3][8], in lanes: rest length, stiffness, damping. All 0: no spring.
    const float* coefficients = nullptr;
    const float* tear = nullptr;    ///< [runs + scattered][8] in lanes, units; null: none tears
    std::uint32_t* torn = nullptr;  ///< [runs + scattered]: blocks that may have torn springs are put here
};

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
    /// relative[n] = single(x, y, vx, vy of node n in the frame).
    void (*relate)(const double* position, const double* velocity, std::size_t nodes, const Frame&, float* relative);
    /// Adds the springs' forces to `force`; returns how many blocks it put into `torn`.
    std::size_t (*pull)(const SpringBlocks&, const float* relative, double* force);
    /// v = kept (v + h (g + f / m)), f = 0; nodes of inverse mass 0 stay as they are.
    void (*accelerate)(double* velocity, double* force, const double* inverseMass, std::size_t nodes,
                       const VelocityStep&);
    /// x += h v, after slowing what is faster than kMostSpeed; what is not a number is stopped.
    void (*advance)(double* position, double* velocity, std::size_t nodes, double h);
};

const Kernels& kernelsSse2();
const Kernels& kernelsAvx2();
/// Does this processor have AVX2?
bool hasAvx2();
const Kernels& bestKernels();

}  // namespace jet::physics::soft
