// The kernels for processors with AVX2. Compiled with -mavx2; called only where hasAvx2().
#include "kernels_body.hpp"

namespace jet::physics::soft {
namespace {

struct Avx2 {
    using F8 = __m256;

    static F8 load(const float* p) { return _mm256_loadu_ps(p); }
    static void store(float* p, F8 a) { _mm256_storeu_ps(p, a); }
    static F8 zero() { return _mm256_setzero_ps(); }
    static F8 one() { return _mm256_set1_ps(1); }
    static F8 add(F8 a, F8 b) { return _mm256_add_ps(a, b); }
    static F8 sub(F8 a, F8 b) { return _mm256_sub_ps(a, b); }
    static F8 mul(F8 a, F8 b) { return _mm256_mul_ps(a, b); }
    static F8 div(F8 a, F8 b) { return _mm256_div_ps(a, b); }
    static F8 sqrt(F8 a) { return _mm256_sqrt_ps(a); }
    static F8 zeroUnlessAbove(F8 value, F8 a, float least)
    {
        return _mm256_and_ps(value, _mm256_cmp_ps(a, _mm256_set1_ps(least), _CMP_GT_OQ));
    }
    static bool anyAbove(F8 a, F8 b) { return _mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_GT_OQ)) != 0; }

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

    /// Two nodes at a time; returns how many were done.
    static std::size_t accelerate(double* velocity, const double* inverseMass, std::size_t nodes,
                                  const VelocityStep& step, const Planes& in)
    {
        const __m256d gravity = _mm256_setr_pd(step.gravityX, step.gravityY, step.gravityX, step.gravityY);
        const __m256d h = _mm256_set1_pd(step.h), kept = _mm256_set1_pd(step.kept), none = _mm256_setzero_pd();
        const auto push = [&](double* v, __m256d inverse, __m128 force) {
            const __m256d fall = _mm256_and_pd(gravity, _mm256_cmp_pd(inverse, none, _CMP_GT_OQ));
            const __m256d change =
                _mm256_mul_pd(h, _mm256_add_pd(fall, _mm256_mul_pd(inverse, _mm256_cvtps_pd(force))));
            _mm256_storeu_pd(v, _mm256_mul_pd(kept, _mm256_add_pd(_mm256_loadu_pd(v), change)));
        };
        std::size_t n = 0;
        for (; n + 4 <= nodes; n += 4) {
            const __m128 fx = _mm_loadu_ps(in.fx + n), fy = _mm_loadu_ps(in.fy + n);
            const __m256d inverse = _mm256_loadu_pd(inverseMass + n);
            push(velocity + 2 * n, _mm256_permute4x64_pd(inverse, 0x50), _mm_unpacklo_ps(fx, fy));
            push(velocity + 2 * n + 4, _mm256_permute4x64_pd(inverse, 0xfa), _mm_unpackhi_ps(fx, fy));
        }
        return n;
    }

    /// From node n on, until one has a component of velocity that is not below `slow`; returns that, or `nodes`.
    static std::size_t advance(double* position, const double* velocity, std::size_t n, std::size_t nodes, double h,
                               double slow)
    {
        const __m256d step = _mm256_set1_pd(h), signs = _mm256_set1_pd(-0.0), least = _mm256_set1_pd(slow);
        for (; n + 2 <= nodes; n += 2) {
            const __m256d v = _mm256_loadu_pd(velocity + 2 * n);
            if (_mm256_movemask_pd(_mm256_cmp_pd(_mm256_andnot_pd(signs, v), least, _CMP_LE_OQ)) != 15) break;
            _mm256_storeu_pd(position + 2 * n,
                             _mm256_add_pd(_mm256_loadu_pd(position + 2 * n), _mm256_mul_pd(step, v)));
        }
        return advanceOne(position, velocity, n, nodes, h, slow);
    }
};

}  // namespace

const Kernels& kernelsAvx2() { return KernelSet<Avx2>::table; }

}  // namespace jet::physics::soft
