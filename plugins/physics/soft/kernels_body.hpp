// The kernels over a vector type V of one instruction set; included once by each kernels_<set>.cpp. Everything here has
// internal linkage, so that no code compiled for a newer processor is ever shared with older ones.
#pragma once

#include "kernels.hpp"

#include <immintrin.h>

namespace jet::physics::soft {
namespace {

// Springs shorter than the root of this have no direction.
constexpr float kLeastSquare = 1e-30F;

template <class V>
struct KernelSet {
    using F8 = typename V::F8;

    /// Tensions of one block along x and y; false in `whole` where a spring may be longer than it holds.
    static bool tension(const typename V::Offsets& o, const float* coefficients, const float* tear, F8& fx, F8& fy)
    {
        const F8 squared = V::add(V::mul(o.x, o.x), V::mul(o.y, o.y));
        const F8 length = V::sqrt(squared);
        const F8 inverse = V::zeroUnlessAbove(V::div(V::one(), length), squared, kLeastSquare);
        const F8 nx = V::mul(o.x, inverse), ny = V::mul(o.y, inverse);
        const F8 speed = V::add(V::mul(o.vx, nx), V::mul(o.vy, ny));
        const F8 stretch = V::sub(length, V::load(coefficients));
        const F8 force = V::add(V::mul(V::load(coefficients + 8), stretch), V::mul(V::load(coefficients + 16), speed));
        fx = V::mul(force, nx);
        fy = V::mul(force, ny);
        return tear && V::anyAbove(length, V::load(tear));
    }

    static std::size_t pull(const SpringBlocks& blocks, const float* relative, double* force)
    {
        std::size_t torn = 0;
        const float* coefficients = blocks.coefficients;
        const float* tear = blocks.tear;
        const auto note = [&](std::size_t block, bool tears) {
            if (tears) blocks.torn[torn++] = static_cast<std::uint32_t>(block);
            coefficients += 24;
            if (tear) tear += 8;
        };
        F8 fx, fy;
        for (std::size_t i = 0; i < blocks.runCount; ++i) {
            const Run run = blocks.runs[i];
            const bool tears =
                tension(V::offsets(relative + 4 * run.a, relative + 4 * run.b), coefficients, tear, fx, fy);
            V::exert(force + 2 * run.a, force + 2 * run.b, fx, fy);
            note(i, tears);
        }
        for (std::size_t i = 0; i < blocks.scatteredCount; ++i) {
            const std::uint32_t *a = blocks.ends + 16 * i, *b = a + 8;
            const bool tears = tension(V::offsets(relative, a, b), coefficients, tear, fx, fy);
            V::exert(force, a, b, fx, fy);
            note(blocks.runCount + i, tears);
        }
        return torn;
    }

    static void relate(const double* position, const double* velocity, std::size_t nodes, const Frame& frame,
                       float* relative)
    {
        const __m128d origin = _mm_setr_pd(frame.x, frame.y), drift = _mm_setr_pd(frame.vx, frame.vy);
        for (std::size_t n = 0; n < nodes; ++n) {
            const __m128 at = _mm_cvtpd_ps(_mm_sub_pd(_mm_loadu_pd(position + 2 * n), origin));
            const __m128 moving = _mm_cvtpd_ps(_mm_sub_pd(_mm_loadu_pd(velocity + 2 * n), drift));
            _mm_storeu_ps(relative + 4 * n, _mm_movelh_ps(at, moving));
        }
    }

    static void accelerate(double* velocity, double* force, const double* inverseMass, std::size_t nodes,
                           const VelocityStep& step)
    {
        const __m128d gravity = _mm_setr_pd(step.gravityX, step.gravityY);
        const __m128d h = _mm_set1_pd(step.h), kept = _mm_set1_pd(step.kept), zero = _mm_setzero_pd();
        for (std::size_t n = 0; n < nodes; ++n) {
            const __m128d inverse = _mm_set1_pd(inverseMass[n]);
            const __m128d pull = _mm_and_pd(gravity, _mm_cmpgt_pd(inverse, zero));
            const __m128d change = _mm_mul_pd(h, _mm_add_pd(pull, _mm_mul_pd(inverse, _mm_loadu_pd(force + 2 * n))));
            const __m128d v = _mm_mul_pd(kept, _mm_add_pd(_mm_loadu_pd(velocity + 2 * n), change));
            _mm_storeu_pd(velocity + 2 * n, v);
            _mm_storeu_pd(force + 2 * n, zero);
        }
    }

    static void advance(double* position, double* velocity, std::size_t nodes, double h)
    {
        const __m128d step = _mm_set1_pd(h), signs = _mm_set1_pd(-0.0), slow = _mm_set1_pd(0.7 * kMostSpeed);
        for (std::size_t n = 0; n < nodes; ++n) {
            __m128d v = _mm_loadu_pd(velocity + 2 * n);
            if (_mm_movemask_pd(_mm_cmple_pd(_mm_andnot_pd(signs, v), slow)) != 3) {
                v = limited(v);
                _mm_storeu_pd(velocity + 2 * n, v);
            }
            _mm_storeu_pd(position + 2 * n, _mm_add_pd(_mm_loadu_pd(position + 2 * n), _mm_mul_pd(step, v)));
        }
    }

    static __m128d limited(__m128d v)
    {
        const __m128d squares = _mm_mul_pd(v, v);
        const __m128d sum = _mm_add_pd(squares, _mm_shuffle_pd(squares, squares, 1));
        if (!(_mm_cvtsd_f64(sum) <= 1e300)) return _mm_setzero_pd();
        const __m128d scale = _mm_div_pd(_mm_set1_pd(kMostSpeed), _mm_sqrt_pd(sum));
        return _mm_mul_pd(v, _mm_min_pd(scale, _mm_set1_pd(1)));
    }

    static constexpr Kernels table{&relate, &pull, &accelerate, &advance};
};

}  // namespace
}  // namespace jet::physics::soft
