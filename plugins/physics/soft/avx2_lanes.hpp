// Eight lanes of AVX2 for kernels_body.hpp and flight_body.hpp.
#pragma once

#include "flight_body.hpp"
#include "kernels_body.hpp"

namespace jet::physics::soft {
namespace {

struct Avx2 {
    using F8 = __m256;

    static F8 load(const float* p) { return _mm256_loadu_ps(p); }
    static void store(float* p, F8 a) { _mm256_storeu_ps(p, a); }
    static F8 zero() { return _mm256_setzero_ps(); }
    static F8 one() { return _mm256_set1_ps(1); }
    static F8 all(float x) { return _mm256_set1_ps(x); }
    static F8 add(F8 a, F8 b) { return _mm256_add_ps(a, b); }
    static F8 sub(F8 a, F8 b) { return _mm256_sub_ps(a, b); }
    static F8 mul(F8 a, F8 b) { return _mm256_mul_ps(a, b); }
    static F8 div(F8 a, F8 b) { return _mm256_div_ps(a, b); }
    static F8 most(F8 a, F8 b) { return _mm256_max_ps(a, b); }
    static F8 sqrt(F8 a) { return _mm256_sqrt_ps(a); }
    static F8 zeroUnlessAbove(F8 value, F8 a, float least)
    {
        return _mm256_and_ps(value, _mm256_cmp_ps(a, _mm256_set1_ps(least), _CMP_GT_OQ));
    }
    static bool anyAbove(F8 a, F8 b) { return _mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_GT_OQ)) != 0; }

    // For flights: see FlightSet.
    using F = F8;
    static constexpr std::size_t kRows = 1;
    template <class Of>
    static F rows(Of&& of)
    {
        return load(of(0));
    }
    using Mask = __m256;
    static Mask none() { return _mm256_setzero_ps(); }
    static Mask above(F8 a, F8 b) { return _mm256_cmp_ps(a, b, _CMP_GT_OQ); }
    static Mask either(Mask a, Mask b) { return _mm256_or_ps(a, b); }
    static bool any(Mask a) { return _mm256_movemask_ps(a) != 0; }

    /// of(k): four numbers of lane k.
    template <class Of>
    static void transpose(Of&& of, F8& x, F8& y, F8& vx, F8& vy)
    {
        const auto both = [&](std::uint32_t k) {
            return _mm256_insertf128_ps(_mm256_castps128_ps256(of(k)), of(k + 4), 1);
        };
        const __m256 p0 = both(0), p1 = both(1), p2 = both(2), p3 = both(3);
        const __m256d low0 = _mm256_castps_pd(_mm256_unpacklo_ps(p0, p1));
        const __m256d low1 = _mm256_castps_pd(_mm256_unpacklo_ps(p2, p3));
        const __m256d high0 = _mm256_castps_pd(_mm256_unpackhi_ps(p0, p1));
        const __m256d high1 = _mm256_castps_pd(_mm256_unpackhi_ps(p2, p3));
        x = _mm256_castpd_ps(_mm256_unpacklo_pd(low0, low1)), y = _mm256_castpd_ps(_mm256_unpackhi_pd(low0, low1));
        vx = _mm256_castpd_ps(_mm256_unpacklo_pd(high0, high1)),
        vy = _mm256_castpd_ps(_mm256_unpackhi_pd(high0, high1));
    }

    /// Four pairs of doubles in a row from one origin, as four singles along x and four along y.
    static void narrow(const double* from, const double* origin, float* x, float* y)
    {
        const __m256d start = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(origin));
        const __m128 low = _mm256_cvtpd_ps(_mm256_sub_pd(_mm256_loadu_pd(from), start));
        const __m128 high = _mm256_cvtpd_ps(_mm256_sub_pd(_mm256_loadu_pd(from + 4), start));
        _mm_storeu_ps(x, _mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)));
        _mm_storeu_ps(y, _mm_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)));
    }

    /// Two pairs of doubles from two places.
    static __m256d two(const double* low, const double* high)
    {
        return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(low)), _mm_loadu_pd(high), 1);
    }

    /// Origins of four frames, and pairs of doubles anywhere from them.
    struct Origins {
        __m256d low, high;
        explicit Origins(const double* of) : low(two(of, of + kStride)), high(two(of + 2 * kStride, of + 3 * kStride))
        {
        }
        void narrow(const double* from, const std::uint32_t* node, float* x, float* y) const
        {
            const auto at = [=](int i) { return from + 2 * std::size_t{node[i]}; };
            const __m128 first = _mm256_cvtpd_ps(_mm256_sub_pd(two(at(0), at(1)), low));
            const __m128 second = _mm256_cvtpd_ps(_mm256_sub_pd(two(at(2), at(3)), high));
            _mm_storeu_ps(x, _mm_shuffle_ps(first, second, _MM_SHUFFLE(2, 0, 2, 0)));
            _mm_storeu_ps(y, _mm_shuffle_ps(first, second, _MM_SHUFFLE(3, 1, 3, 1)));
        }
        static constexpr std::size_t kStride = sizeof(Frame) / sizeof(double);
    };

    /// Two bodies at a time; returns how many were done.
    static std::size_t accelerateAlike(double* velocity, const double* inverseMass, const std::uint32_t* nodeAt,
                                       std::size_t rows, std::size_t count, const VelocityStep* steps, const Planes& in)
    {
        const float *fx = in[Planes::Fx], *fy = in[Planes::Fy];
        std::size_t lane = 0;
        for (; lane + 2 <= count; lane += 2) {
            const VelocityStep &own = steps[lane], &next = steps[lane + 1];
            const __m256d gravity = _mm256_setr_pd(own.gravityX, own.gravityY, next.gravityX, next.gravityY);
            const __m256d h = _mm256_set1_pd(own.h), kept = _mm256_set1_pd(own.kept), none = _mm256_setzero_pd();
            for (std::size_t at = lane; at < 8 * rows; at += 8) {
                const std::size_t n = nodeAt[at], m = nodeAt[at + 1];
                double *v = velocity + 2 * n, *w = velocity + 2 * m;
                const __m256d inverse = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loaddup_pd(inverseMass + n)),
                                                             _mm_loaddup_pd(inverseMass + m), 1);
                const __m128 force = _mm_unpacklo_ps(_mm_castsi128_ps(_mm_loadu_si64(fx + at)),
                                                     _mm_castsi128_ps(_mm_loadu_si64(fy + at)));
                const __m256d fall = _mm256_and_pd(gravity, _mm256_cmp_pd(inverse, none, _CMP_GT_OQ));
                const __m256d change =
                    _mm256_mul_pd(h, _mm256_add_pd(fall, _mm256_mul_pd(inverse, _mm256_cvtps_pd(force))));
                const __m256d now = _mm256_mul_pd(kept, _mm256_add_pd(two(v, w), change));
                _mm_storeu_pd(v, _mm256_castpd256_pd128(now));
                _mm_storeu_pd(w, _mm256_extractf128_pd(now, 1));
            }
        }
        return lane;
    }

    /// Nodes n up to `to`, with forces from fx and fy on, four at a time; returns the first that was not done.
    static std::size_t accelerate(const NodeArrays& nodes, std::size_t n, std::size_t to, const VelocityStep& step,
                                  const float* fx, const float* fy, double* sums, bool& pinned)
    {
        const __m256d gravity = _mm256_setr_pd(step.gravityX, step.gravityY, step.gravityX, step.gravityY);
        const __m256d h = _mm256_set1_pd(step.h), kept = _mm256_set1_pd(step.kept), none = _mm256_setzero_pd();
        __m256d low = _mm256_loadu_pd(sums), high = _mm256_loadu_pd(sums + 4), still = none;
        const auto push = [&](double* v, __m256d inverse, __m256d force) {
            const __m256d fall = _mm256_and_pd(gravity, _mm256_cmp_pd(inverse, none, _CMP_GT_OQ));
            const __m256d change = _mm256_mul_pd(h, _mm256_add_pd(fall, _mm256_mul_pd(inverse, force)));
            _mm256_storeu_pd(v, _mm256_mul_pd(kept, _mm256_add_pd(_mm256_loadu_pd(v), change)));
        };
        double* velocity = nodes.velocity;
        for (; n + 4 <= to; n += 4, fx += 4, fy += 4) {
            const __m128 x = _mm_loadu_ps(fx), y = _mm_loadu_ps(fy);
            const __m256d inverse = _mm256_loadu_pd(nodes.inverseMass + n);
            const __m256d first = _mm256_cvtps_pd(_mm_unpacklo_ps(x, y));
            const __m256d second = _mm256_cvtps_pd(_mm_unpackhi_ps(x, y));
            low = _mm256_add_pd(low, first), high = _mm256_add_pd(high, second);
            still = _mm256_or_pd(still, _mm256_cmp_pd(inverse, none, _CMP_EQ_OQ));
            push(velocity + 2 * n, _mm256_permute4x64_pd(inverse, 0x50), first);
            push(velocity + 2 * n + 4, _mm256_permute4x64_pd(inverse, 0xfa), second);
        }
        _mm256_storeu_pd(sums, low), _mm256_storeu_pd(sums + 4, high);
        pinned |= _mm256_movemask_pd(still) != 0;
        return n;
    }

    /// Two nodes: x y x y of what they gained, and moved.
    struct Landing : LandingOne {
        __m256d time2, way2, gain2;
        Landing(double t, const FlightReturn& back)
            : LandingOne(t, back), time2(_mm256_broadcastsd_pd(time)),
              way2(_mm256_insertf128_pd(_mm256_castpd128_pd256(way), way, 1)),
              gain2(_mm256_insertf128_pd(_mm256_castpd128_pd256(gain), gain, 1))
        {
        }
        void operator()(double* x, double* v, __m128 gained, __m128 moved) const
        {
            const __m256d before = _mm256_loadu_pd(v), went = _mm256_add_pd(_mm256_cvtps_pd(moved), way2);
            const __m256d all = _mm256_add_pd(_mm256_mul_pd(time2, before), went);
            _mm256_storeu_pd(x, _mm256_add_pd(_mm256_loadu_pd(x), all));
            _mm256_storeu_pd(v, _mm256_add_pd(before, _mm256_add_pd(_mm256_cvtps_pd(gained), gain2)));
        }
    };

    /// From node n on, until one has a component of velocity that is not below `slow`; returns that, or `nodes`.
    static std::size_t advance(double* position, double* velocity, std::size_t n, std::size_t nodes, const Advance& by)
    {
        const __m256d step = _mm256_set1_pd(by.h), signs = _mm256_set1_pd(-0.0), least = _mm256_set1_pd(by.slow);
        const __m256d drift = _mm256_setr_pd(by.driftX, by.driftY, by.driftX, by.driftY);
        const bool drifts = by.drifts();
        for (; n + 2 <= nodes; n += 2) {
            __m256d v = _mm256_loadu_pd(velocity + 2 * n);
            if (drifts) v = _mm256_add_pd(v, drift);
            if (_mm256_movemask_pd(_mm256_cmp_pd(_mm256_andnot_pd(signs, v), least, _CMP_LE_OQ)) != 15) break;
            if (drifts) _mm256_storeu_pd(velocity + 2 * n, v);
            _mm256_storeu_pd(position + 2 * n,
                             _mm256_add_pd(_mm256_loadu_pd(position + 2 * n), _mm256_mul_pd(step, v)));
        }
        return advanceOne(position, velocity, n, nodes, by);
    }
};

}  // namespace
}  // namespace jet::physics::soft
