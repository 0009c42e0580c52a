// The kernels over a vector type V of one instruction set; included once by each kernels_<set>.cpp. Everything here has
// internal linkage, so that no code compiled for a newer processor is ever shared with older ones.
#pragma once

#include "kernels.hpp"

#include <immintrin.h>

namespace jet::physics::soft {
namespace {

// Springs shorter than the root of this have no direction.
constexpr float kLeastSquare = 1e-30F;

inline __m128d splat(double value) { return _mm_set1_pd(value); }

/// One node after the other, from n on, until one has a component of velocity that is not below `slow`.
inline std::size_t advanceOne(double* position, const double* velocity, std::size_t n, std::size_t nodes, double h,
                              double slow)
{
    const __m128d step = splat(h), signs = splat(-0.0), least = splat(slow);
    for (; n < nodes; ++n) {
        const __m128d v = _mm_loadu_pd(velocity + 2 * n);
        if (_mm_movemask_pd(_mm_cmple_pd(_mm_andnot_pd(signs, v), least)) != 3) break;
        _mm_storeu_pd(position + 2 * n, _mm_add_pd(_mm_loadu_pd(position + 2 * n), _mm_mul_pd(step, v)));
    }
    return n;
}

template <class V>
struct KernelSet {
    using F8 = typename V::F8;
    struct Offsets {
        F8 x, y, vx, vy;
    };

    /// Tensions of one block along x and y; true where a spring may be longer than it holds.
    static bool tension(const Offsets& o, const float* coefficients, const float* tear, float crush, F8& fx, F8& fy)
    {
        const F8 squared = V::add(V::mul(o.x, o.x), V::mul(o.y, o.y));
        const F8 length = V::sqrt(squared);
        const F8 inverse = V::zeroUnlessAbove(V::div(V::one(), length), squared, kLeastSquare);
        const F8 nx = V::mul(o.x, inverse), ny = V::mul(o.y, inverse);
        const F8 speed = V::add(V::mul(o.vx, nx), V::mul(o.vy, ny));
        const F8 rest = V::load(coefficients), stiffness = V::load(coefficients + 8);
        F8 force = V::add(V::mul(stiffness, V::sub(length, rest)), V::mul(V::load(coefficients + 16), speed));
        const F8 least = V::mul(V::all(kCrushed), rest);
        if (V::anyAbove(least, length)) {
            const F8 damped = V::mul(V::mul(V::all(crush), stiffness), speed);
            force = V::add(force, V::zeroUnlessAbove(damped, V::sub(least, length), 0));
        }
        fx = V::mul(force, nx);
        fy = V::mul(force, ny);
        return tear && V::anyAbove(length, V::load(tear));
    }

    static F8 apart(const float* plane, F8 a, std::size_t b) { return V::sub(a, V::load(plane + b)); }

    /// Runs with the same first nodes come one after the other: those are read once, and their forces summed before
    /// they are put down.
    static std::size_t pull(const SpringBlocks& blocks, const Planes& planes)
    {
        const Planes in = planes;
        std::size_t torn = 0;
        const float* coefficients = blocks.coefficients;
        const float* tear = blocks.tear;
        const auto note = [&](std::size_t block, bool tears) {
            if (tears) blocks.torn[torn++] = static_cast<std::uint32_t>(block);
            coefficients += 24;
            if (tear) tear += 8;
        };
        F8 fx, fy;
        for (std::size_t i = 0; i < blocks.runCount;) {
            const std::uint32_t a = blocks.runs[i].a;
            const Offsets first{V::load(in.x + a), V::load(in.y + a), V::load(in.vx + a), V::load(in.vy + a)};
            F8 sumX = V::zero(), sumY = V::zero();
            do {
                const std::size_t b = blocks.runs[i].b;
                const bool tears = tension({apart(in.x, first.x, b), apart(in.y, first.y, b), apart(in.vx, first.vx, b),
                                            apart(in.vy, first.vy, b)},
                                           coefficients, tear, blocks.crush, fx, fy);
                sumX = V::add(sumX, fx), sumY = V::add(sumY, fy);
                V::store(in.fx + b, V::add(V::load(in.fx + b), fx));
                V::store(in.fy + b, V::add(V::load(in.fy + b), fy));
                note(i++, tears);
            } while (i < blocks.runCount && blocks.runs[i].a == a);
            V::store(in.fx + a, V::sub(V::load(in.fx + a), sumX));
            V::store(in.fy + a, V::sub(V::load(in.fy + a), sumY));
        }
        for (std::size_t i = 0; i < blocks.scatteredCount; ++i) {
            const std::uint32_t *a = blocks.ends + 16 * i, *b = a + 8;
            const bool tears =
                tension(in.near ? gathered(in.near, a, b) : picked(in, a, b), coefficients, tear, blocks.crush, fx, fy);
            scatter(in, a, b, fx, fy);
            note(blocks.runCount + i, tears);
        }
        return torn;
    }

    static Offsets gathered(const float* near, const std::uint32_t* a, const std::uint32_t* b)
    {
        Offsets o;
        V::transpose(
            [=](std::uint32_t k) {
                return _mm_sub_ps(_mm_loadu_ps(near + 4 * std::size_t{a[k]}),
                                  _mm_loadu_ps(near + 4 * std::size_t{b[k]}));
            },
            o.x, o.y, o.vx, o.vy);
        return o;
    }

    static Offsets picked(const Planes& in, const std::uint32_t* a, const std::uint32_t* b)
    {
        float x[kLanes], y[kLanes], vx[kLanes], vy[kLanes];
        for (std::uint32_t k = 0; k < kLanes; ++k) {
            x[k] = in.x[a[k]] - in.x[b[k]], y[k] = in.y[a[k]] - in.y[b[k]];
            vx[k] = in.vx[a[k]] - in.vx[b[k]], vy[k] = in.vy[a[k]] - in.vy[b[k]];
        }
        return {V::load(x), V::load(y), V::load(vx), V::load(vy)};
    }

    static void scatter(const Planes& in, const std::uint32_t* a, const std::uint32_t* b, F8 fx, F8 fy)
    {
        float x[kLanes], y[kLanes];
        V::store(x, fx), V::store(y, fy);
        for (std::uint32_t k = 0; k < kLanes; ++k) {
            in.fx[a[k]] -= x[k], in.fy[a[k]] -= y[k];
            in.fx[b[k]] += x[k], in.fy[b[k]] += y[k];
        }
    }

    /// Four pairs of doubles from their origins, as four singles along x and four along y.
    template <class From, class Origin>
    static void narrow(From&& from, Origin&& origin, float* x, float* y)
    {
        const auto pair = [&](int i) {
            return _mm_cvtpd_ps(_mm_sub_pd(_mm_loadu_pd(from(i)), _mm_loadu_pd(origin(i))));
        };
        const __m128 low = _mm_movelh_ps(pair(0), pair(1)), high = _mm_movelh_ps(pair(2), pair(3));
        _mm_storeu_ps(x, _mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)));
        _mm_storeu_ps(y, _mm_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)));
    }

    static void relate(const double* position, const double* velocity, std::size_t nodes, const Frame& frame,
                       const Planes& out)
    {
        const __m128 none = _mm_setzero_ps();
        std::size_t n = 0;
        for (; n + 4 <= nodes; n += 4) {
            V::narrow(position + 2 * n, &frame.x, out.x + n, out.y + n);
            V::narrow(velocity + 2 * n, &frame.vx, out.vx + n, out.vy + n);
            _mm_storeu_ps(out.fx + n, none), _mm_storeu_ps(out.fy + n, none);
            if (out.near) interleave(out, n);
        }
        for (; n < nodes; ++n) {
            out.x[n] = static_cast<float>(position[2 * n] - frame.x);
            out.y[n] = static_cast<float>(position[2 * n + 1] - frame.y);
            out.vx[n] = static_cast<float>(velocity[2 * n] - frame.vx);
            out.vy[n] = static_cast<float>(velocity[2 * n + 1] - frame.vy);
        }
        for (std::size_t k = nodes & ~std::size_t{3}; out.near && k < nodes; ++k)
            _mm_storeu_ps(out.near + 4 * k, _mm_setr_ps(out.x[k], out.y[k], out.vx[k], out.vy[k]));
        // Sums take four at a time.
        for (n &= ~std::size_t{3}; n < nodes + 8; ++n) out.fx[n] = out.fy[n] = 0;
    }

    static void interleave(const Planes& out, std::size_t n)
    {
        __m128 node[4] = {_mm_loadu_ps(out.x + n), _mm_loadu_ps(out.y + n), _mm_loadu_ps(out.vx + n),
                          _mm_loadu_ps(out.vy + n)};
        _MM_TRANSPOSE4_PS(node[0], node[1], node[2], node[3]);
        for (int i = 0; i < 4; ++i) _mm_storeu_ps(out.near + 4 * n + 4 * i, node[i]);
    }

    static void relateAlike(const double* position, const double* velocity, const std::uint32_t* nodeAt,
                            std::size_t rows, const Frame* frames, const Planes& out)
    {
        const __m128 none = _mm_setzero_ps();
        for (std::size_t half = 0; half < 8; half += 4) {
            const typename V::Origins places(&frames[half].x), moving(&frames[half].vx);
            for (std::size_t at = half; at < 8 * rows; at += 8) {
                places.narrow(position, nodeAt + at, out.x + at, out.y + at);
                moving.narrow(velocity, nodeAt + at, out.vx + at, out.vy + at);
                _mm_storeu_ps(out.fx + at, none), _mm_storeu_ps(out.fy + at, none);
            }
        }
    }

    static void sum(const Planes& in, std::size_t nodes, double* total)
    {
        __m128d sums[4] = {_mm_setzero_pd(), _mm_setzero_pd(), _mm_setzero_pd(), _mm_setzero_pd()};
        for (std::size_t n = 0; n < nodes; n += 4) {
            const __m128 x = _mm_loadu_ps(in.fx + n), y = _mm_loadu_ps(in.fy + n);
            sums[0] = _mm_add_pd(sums[0], _mm_cvtps_pd(x));
            sums[1] = _mm_add_pd(sums[1], _mm_cvtps_pd(_mm_movehl_ps(x, x)));
            sums[2] = _mm_add_pd(sums[2], _mm_cvtps_pd(y));
            sums[3] = _mm_add_pd(sums[3], _mm_cvtps_pd(_mm_movehl_ps(y, y)));
        }
        for (int axis = 0; axis < 2; ++axis) {
            const __m128d both = _mm_add_pd(sums[2 * axis], sums[2 * axis + 1]);
            total[axis] = _mm_cvtsd_f64(both) + _mm_cvtsd_f64(_mm_unpackhi_pd(both, both));
        }
    }

    static void sumAlike(const Planes& in, std::size_t rows, double* totals)
    {
        for (int axis = 0; axis < 2; ++axis) {
            const float* f = axis == 0 ? in.fx : in.fy;
            __m128d sums[4] = {_mm_setzero_pd(), _mm_setzero_pd(), _mm_setzero_pd(), _mm_setzero_pd()};
            for (std::size_t row = 0; row < rows; ++row) {
                for (int half = 0; half < 2; ++half) {
                    const __m128 four = _mm_loadu_ps(f + 8 * row + 4 * half);
                    sums[2 * half] = _mm_add_pd(sums[2 * half], _mm_cvtps_pd(four));
                    sums[2 * half + 1] = _mm_add_pd(sums[2 * half + 1], _mm_cvtps_pd(_mm_movehl_ps(four, four)));
                }
            }
            for (int i = 0; i < 4; ++i) _mm_storeu_pd(totals + 8 * axis + 2 * i, sums[i]);
        }
    }

    struct Push {
        __m128d gravity, h, kept;
        explicit Push(const VelocityStep& step)
            : gravity(_mm_setr_pd(step.gravityX, step.gravityY)), h(splat(step.h)), kept(splat(step.kept))
        {
        }
        void operator()(double* velocity, double inverseMass, __m128d force) const
        {
            const __m128d inverse = splat(inverseMass);
            const __m128d fall = _mm_and_pd(gravity, _mm_cmpgt_pd(inverse, _mm_setzero_pd()));
            const __m128d change = _mm_mul_pd(h, _mm_add_pd(fall, _mm_mul_pd(inverse, force)));
            _mm_storeu_pd(velocity, _mm_mul_pd(kept, _mm_add_pd(_mm_loadu_pd(velocity), change)));
        }
    };

    static void accelerate(double* velocity, double* force, const double* inverseMass, std::size_t nodes,
                           const VelocityStep& step, const Planes* planes)
    {
        const Push push(step);
        const __m128d zero = _mm_setzero_pd();
        std::size_t n = planes && !force ? V::accelerate(velocity, inverseMass, nodes, step, *planes) : 0;
        for (; n < nodes; ++n) {
            __m128d all = zero;
            if (force) all = _mm_loadu_pd(force + 2 * n), _mm_storeu_pd(force + 2 * n, zero);
            if (planes) all = _mm_add_pd(all, widened(*planes, n));
            push(velocity + 2 * n, inverseMass[n], all);
        }
    }

    static __m128d widened(const Planes& in, std::size_t n)
    {
        return _mm_cvtps_pd(_mm_unpacklo_ps(_mm_load_ss(in.fx + n), _mm_load_ss(in.fy + n)));
    }

    static void accelerateAlike(double* velocity, double* force, const double* inverseMass, const std::uint32_t* nodeAt,
                                std::size_t rows, std::size_t count, const VelocityStep* steps, const Planes& in)
    {
        // Body by body: their particles lie together.
        std::size_t lane = force ? 0 : V::accelerateAlike(velocity, inverseMass, nodeAt, rows, count, steps, in);
        for (; lane < count; ++lane) {
            const Push push(steps[lane]);
            for (std::size_t row = 0; row < rows; ++row) {
                const std::size_t at = 8 * row + lane, n = nodeAt[at];
                __m128d all = widened(in, at);
                if (force) {
                    all = _mm_add_pd(_mm_loadu_pd(force + 2 * n), all);
                    _mm_storeu_pd(force + 2 * n, _mm_setzero_pd());
                }
                push(velocity + 2 * n, inverseMass[n], all);
            }
        }
    }

    static void advance(double* position, double* velocity, std::size_t nodes, double h)
    {
        constexpr double kSlow = 0.7 * kMostSpeed;
        for (std::size_t n = 0; n < nodes; ++n) {
            n = V::advance(position, velocity, n, nodes, h, kSlow);  // up to one that is fast
            if (n == nodes) return;
            const __m128d v = limited(_mm_loadu_pd(velocity + 2 * n));
            _mm_storeu_pd(velocity + 2 * n, v);
            _mm_storeu_pd(position + 2 * n, _mm_add_pd(_mm_loadu_pd(position + 2 * n), _mm_mul_pd(splat(h), v)));
        }
    }

    static __m128d limited(__m128d v)
    {
        const __m128d squares = _mm_mul_pd(v, v);
        const __m128d sum = _mm_add_pd(squares, _mm_shuffle_pd(squares, squares, 1));
        if (!(_mm_cvtsd_f64(sum) <= 1e300)) return _mm_setzero_pd();
        const __m128d scale = _mm_div_pd(splat(kMostSpeed), _mm_sqrt_pd(sum));
        return _mm_mul_pd(v, _mm_min_pd(scale, splat(1)));
    }

    static constexpr Kernels table{&relate,     &relateAlike,     &pull,   &sum, &sumAlike,
                                   &accelerate, &accelerateAlike, &advance};
};

}  // namespace
}  // namespace jet::physics::soft
