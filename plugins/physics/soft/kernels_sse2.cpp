// The kernels for any x86-64 processor, and the choice between the instruction sets.
#include "kernels_body.hpp"

namespace jet::physics::soft {
namespace {

struct Sse2 {
    struct F8 {
        __m128 low, high;  // springs 0 2 4 6, and 1 3 5 7
    };
    struct Offsets {
        F8 x, y, vx, vy;
    };

    static F8 load(const float* p) { return {_mm_loadu_ps(p), _mm_loadu_ps(p + 4)}; }
    static F8 one() { return {_mm_set1_ps(1), _mm_set1_ps(1)}; }
    static F8 add(F8 a, F8 b) { return {_mm_add_ps(a.low, b.low), _mm_add_ps(a.high, b.high)}; }
    static F8 sub(F8 a, F8 b) { return {_mm_sub_ps(a.low, b.low), _mm_sub_ps(a.high, b.high)}; }
    static F8 mul(F8 a, F8 b) { return {_mm_mul_ps(a.low, b.low), _mm_mul_ps(a.high, b.high)}; }
    static F8 div(F8 a, F8 b) { return {_mm_div_ps(a.low, b.low), _mm_div_ps(a.high, b.high)}; }
    static F8 sqrt(F8 a) { return {_mm_sqrt_ps(a.low), _mm_sqrt_ps(a.high)}; }
    static F8 zeroUnlessAbove(F8 value, F8 a, float least)
    {
        const __m128 limit = _mm_set1_ps(least);
        return {_mm_and_ps(value.low, _mm_cmpgt_ps(a.low, limit)), _mm_and_ps(value.high, _mm_cmpgt_ps(a.high, limit))};
    }
    static bool anyAbove(F8 a, F8 b)
    {
        return _mm_movemask_ps(_mm_or_ps(_mm_cmpgt_ps(a.low, b.low), _mm_cmpgt_ps(a.high, b.high))) != 0;
    }

    static void transpose(__m128 p0, __m128 p1, __m128 p2, __m128 p3, __m128& x, __m128& y, __m128& vx, __m128& vy)
    {
        const __m128 low0 = _mm_unpacklo_ps(p0, p1), low1 = _mm_unpacklo_ps(p2, p3);
        const __m128 high0 = _mm_unpackhi_ps(p0, p1), high1 = _mm_unpackhi_ps(p2, p3);
        x = _mm_movelh_ps(low0, low1);
        y = _mm_movehl_ps(low1, low0);
        vx = _mm_movelh_ps(high0, high1);
        vy = _mm_movehl_ps(high1, high0);
    }
    template <class Difference>
    static Offsets gather(Difference&& d)
    {
        Offsets o;
        transpose(d(0), d(2), d(4), d(6), o.x.low, o.y.low, o.vx.low, o.vy.low);
        transpose(d(1), d(3), d(5), d(7), o.x.high, o.y.high, o.vx.high, o.vy.high);
        return o;
    }
    static Offsets offsets(const float* a, const float* b)
    {
        return gather([=](int i) { return _mm_sub_ps(_mm_loadu_ps(a + 4 * i), _mm_loadu_ps(b + 4 * i)); });
    }
    static Offsets offsets(const float* relative, const std::uint32_t* a, const std::uint32_t* b)
    {
        return gather([=](int i) {
            return _mm_sub_ps(_mm_loadu_ps(relative + 4 * std::size_t{a[i]}),
                              _mm_loadu_ps(relative + 4 * std::size_t{b[i]}));
        });
    }

    /// The force of each spring as two doubles, in the order of the springs.
    static void widen(F8 fx, F8 fy, __m128d (&f)[8])
    {
        const __m128 even0 = _mm_unpacklo_ps(fx.low, fy.low), even1 = _mm_unpackhi_ps(fx.low, fy.low);
        const __m128 odd0 = _mm_unpacklo_ps(fx.high, fy.high), odd1 = _mm_unpackhi_ps(fx.high, fy.high);
        const auto second = [](__m128 v) { return _mm_cvtps_pd(_mm_movehl_ps(v, v)); };
        f[0] = _mm_cvtps_pd(even0), f[2] = second(even0), f[4] = _mm_cvtps_pd(even1), f[6] = second(even1);
        f[1] = _mm_cvtps_pd(odd0), f[3] = second(odd0), f[5] = _mm_cvtps_pd(odd1), f[7] = second(odd1);
    }
    static void exert(double* a, double* b, F8 fx, F8 fy)
    {
        __m128d f[8];
        widen(fx, fy, f);
        for (int i = 0; i < 8; ++i) _mm_storeu_pd(a + 2 * i, _mm_sub_pd(_mm_loadu_pd(a + 2 * i), f[i]));
        for (int i = 0; i < 8; ++i) _mm_storeu_pd(b + 2 * i, _mm_add_pd(_mm_loadu_pd(b + 2 * i), f[i]));
    }
    static void exert(double* force, const std::uint32_t* a, const std::uint32_t* b, F8 fx, F8 fy)
    {
        __m128d f[8];
        widen(fx, fy, f);
        for (int i = 0; i < 8; ++i) {
            double *atA = force + 2 * std::size_t{a[i]}, *atB = force + 2 * std::size_t{b[i]};
            _mm_storeu_pd(atA, _mm_sub_pd(_mm_loadu_pd(atA), f[i]));
            _mm_storeu_pd(atB, _mm_add_pd(_mm_loadu_pd(atB), f[i]));
        }
    }
};

}  // namespace

const Kernels& kernelsSse2() { return KernelSet<Sse2>::table; }

bool hasAvx2()
{
    static const bool has = __builtin_cpu_supports("avx2") != 0;
    return has;
}

const Kernels& bestKernels() { return hasAvx2() ? kernelsAvx2() : kernelsSse2(); }

}  // namespace jet::physics::soft
