// The kernels for processors with AVX2. Compiled with -mavx2; called only where hasAvx2().
#include "kernels_body.hpp"

namespace jet::physics::soft {
namespace {

struct Avx2 {
    using F8 = __m256;  // springs 0 2 4 6 1 3 5 7
    struct Offsets {
        F8 x, y, vx, vy;
    };

    static F8 load(const float* p) { return _mm256_loadu_ps(p); }
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

    static Offsets transpose(__m256 p01, __m256 p23, __m256 p45, __m256 p67)
    {
        const __m256d low0 = _mm256_castps_pd(_mm256_unpacklo_ps(p01, p23));
        const __m256d low1 = _mm256_castps_pd(_mm256_unpacklo_ps(p45, p67));
        const __m256d high0 = _mm256_castps_pd(_mm256_unpackhi_ps(p01, p23));
        const __m256d high1 = _mm256_castps_pd(_mm256_unpackhi_ps(p45, p67));
        return {_mm256_castpd_ps(_mm256_unpacklo_pd(low0, low1)), _mm256_castpd_ps(_mm256_unpackhi_pd(low0, low1)),
                _mm256_castpd_ps(_mm256_unpacklo_pd(high0, high1)), _mm256_castpd_ps(_mm256_unpackhi_pd(high0, high1))};
    }
    static Offsets offsets(const float* a, const float* b)
    {
        const auto d = [=](int i) { return _mm256_sub_ps(_mm256_loadu_ps(a + 8 * i), _mm256_loadu_ps(b + 8 * i)); };
        return transpose(d(0), d(1), d(2), d(3));
    }
    static __m256 pair(const float* relative, std::uint32_t first, std::uint32_t second)
    {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(relative + 4 * std::size_t{first})),
                                    _mm_loadu_ps(relative + 4 * std::size_t{second}), 1);
    }
    static Offsets offsets(const float* relative, const std::uint32_t* a, const std::uint32_t* b)
    {
        const auto d = [=](int i) {
            return _mm256_sub_ps(pair(relative, a[i], a[i + 1]), pair(relative, b[i], b[i + 1]));
        };
        return transpose(d(0), d(2), d(4), d(6));
    }

    /// The forces of springs 0 2, 1 3, 4 6, 5 7 as doubles.
    static void widen(F8 fx, F8 fy, __m256d (&f)[4])
    {
        const __m256 first = _mm256_unpacklo_ps(fx, fy), last = _mm256_unpackhi_ps(fx, fy);
        f[0] = _mm256_cvtps_pd(_mm256_castps256_ps128(first));
        f[1] = _mm256_cvtps_pd(_mm256_extractf128_ps(first, 1));
        f[2] = _mm256_cvtps_pd(_mm256_castps256_ps128(last));
        f[3] = _mm256_cvtps_pd(_mm256_extractf128_ps(last, 1));
    }
    static void exert(double* a, double* b, F8 fx, F8 fy)
    {
        __m256d f[4];
        widen(fx, fy, f);
        const __m256d pairs[4] = {_mm256_permute2f128_pd(f[0], f[1], 0x20), _mm256_permute2f128_pd(f[0], f[1], 0x31),
                                  _mm256_permute2f128_pd(f[2], f[3], 0x20), _mm256_permute2f128_pd(f[2], f[3], 0x31)};
        for (int i = 0; i < 4; ++i) _mm256_storeu_pd(a + 4 * i, _mm256_sub_pd(_mm256_loadu_pd(a + 4 * i), pairs[i]));
        for (int i = 0; i < 4; ++i) _mm256_storeu_pd(b + 4 * i, _mm256_add_pd(_mm256_loadu_pd(b + 4 * i), pairs[i]));
    }
    static void exert(double* force, const std::uint32_t* a, const std::uint32_t* b, F8 fx, F8 fy)
    {
        __m256d f[4];
        widen(fx, fy, f);
        const auto act = [=](std::uint32_t nodeA, std::uint32_t nodeB, __m128d by) {
            double *atA = force + 2 * std::size_t{nodeA}, *atB = force + 2 * std::size_t{nodeB};
            _mm_storeu_pd(atA, _mm_sub_pd(_mm_loadu_pd(atA), by));
            _mm_storeu_pd(atB, _mm_add_pd(_mm_loadu_pd(atB), by));
        };
        for (int half = 0; half < 2; ++half) {
            const int at = 4 * half;
            const __m256d even = f[2 * half], odd = f[2 * half + 1];
            act(a[at], b[at], _mm256_castpd256_pd128(even));
            act(a[at + 1], b[at + 1], _mm256_castpd256_pd128(odd));
            act(a[at + 2], b[at + 2], _mm256_extractf128_pd(even, 1));
            act(a[at + 3], b[at + 3], _mm256_extractf128_pd(odd, 1));
        }
    }
};

}  // namespace

const Kernels& kernelsAvx2() { return KernelSet<Avx2>::table; }

}  // namespace jet::physics::soft
