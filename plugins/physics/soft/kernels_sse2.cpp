// The kernels for any x86-64 processor, and the choice between the instruction sets.
#include "flight_body.hpp"
#include "kernels_body.hpp"

#include <jet/physics.hpp>

namespace jet::physics::soft {
namespace {

struct Sse2 {
    struct F8 {
        __m128 low, high;
    };

    static F8 load(const float* p) { return {_mm_loadu_ps(p), _mm_loadu_ps(p + 4)}; }
    static void store(float* p, F8 a) { _mm_storeu_ps(p, a.low), _mm_storeu_ps(p + 4, a.high); }
    static F8 zero() { return {_mm_setzero_ps(), _mm_setzero_ps()}; }
    static F8 one() { return {_mm_set1_ps(1), _mm_set1_ps(1)}; }
    static F8 all(float x) { return {_mm_set1_ps(x), _mm_set1_ps(x)}; }
    static F8 add(F8 a, F8 b) { return {_mm_add_ps(a.low, b.low), _mm_add_ps(a.high, b.high)}; }
    static F8 sub(F8 a, F8 b) { return {_mm_sub_ps(a.low, b.low), _mm_sub_ps(a.high, b.high)}; }
    static F8 mul(F8 a, F8 b) { return {_mm_mul_ps(a.low, b.low), _mm_mul_ps(a.high, b.high)}; }
    static F8 div(F8 a, F8 b) { return {_mm_div_ps(a.low, b.low), _mm_div_ps(a.high, b.high)}; }
    static F8 most(F8 a, F8 b) { return {_mm_max_ps(a.low, b.low), _mm_max_ps(a.high, b.high)}; }
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

    // For flights: see FlightSet.
    using F = F8;
    static constexpr std::size_t kRows = 1;
    template <class Of>
    static F rows(Of&& of)
    {
        return load(of(0));
    }
    using Mask = F8;
    static Mask none() { return zero(); }
    static Mask above(F8 a, F8 b) { return {_mm_cmpgt_ps(a.low, b.low), _mm_cmpgt_ps(a.high, b.high)}; }
    static Mask either(Mask a, Mask b) { return {_mm_or_ps(a.low, b.low), _mm_or_ps(a.high, b.high)}; }
    static bool any(Mask a) { return _mm_movemask_ps(_mm_or_ps(a.low, a.high)) != 0; }

    /// of(k): four numbers of lane k.
    template <class Of>
    static void transpose(Of&& of, F8& x, F8& y, F8& vx, F8& vy)
    {
        transpose(of(0), of(1), of(2), of(3), x.low, y.low, vx.low, vy.low);
        transpose(of(4), of(5), of(6), of(7), x.high, y.high, vx.high, vy.high);
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

    /// Four pairs of doubles in a row from one origin, as four singles along x and four along y.
    static void narrow(const double* from, const double* origin, float* x, float* y)
    {
        KernelSet<Sse2>::narrow([=](int i) { return from + 2 * i; }, [=](int) { return origin; }, x, y);
    }

    /// Origins of four frames, and pairs of doubles anywhere from them.
    struct Origins {
        const double* first;
        explicit Origins(const double* of) : first(of) {}
        void narrow(const double* from, const std::uint32_t* node, float* x, float* y) const
        {
            constexpr std::size_t kStride = sizeof(Frame) / sizeof(double);
            KernelSet<Sse2>::narrow([=](int i) { return from + 2 * std::size_t{node[i]}; },
                                    [&](int i) { return first + kStride * static_cast<std::size_t>(i); }, x, y);
        }
    };

    static std::size_t accelerateAlike(double*, const double*, const std::uint32_t*, std::size_t, std::size_t,
                                       const VelocityStep*, const Planes&)
    {
        return 0;
    }
    static std::size_t accelerate(const NodeArrays&, std::size_t n, std::size_t, const VelocityStep&, const float*,
                                  const float*, double*, bool&)
    {
        return n;
    }

    /// Two nodes: x y x y of what they gained, and moved.
    struct Landing : LandingOne {
        using LandingOne::LandingOne;
        void operator()(double* x, double* v, __m128 gained, __m128 moved) const
        {
            one(x, v, _mm_cvtps_pd(gained), _mm_cvtps_pd(moved));
            one(x + 2, v + 2, _mm_cvtps_pd(_mm_movehl_ps(gained, gained)), _mm_cvtps_pd(_mm_movehl_ps(moved, moved)));
        }
    };

    /// From node n on, until one has a component of velocity that is not below `slow`; returns that, or `nodes`.
    static std::size_t advance(double* position, double* velocity, std::size_t n, std::size_t nodes, const Advance& by)
    {
        return advanceOne(position, velocity, n, nodes, by);
    }
};

}  // namespace

const Kernels& kernelsSse2()
{
    static constexpr Kernels kernels = KernelSet<Sse2>::with(FlightSet<Sse2>::table);
    return kernels;
}

bool hasAvx2()
{
    static const bool has = __builtin_cpu_supports("avx2") != 0;
    return has;
}

bool hasAvx512()
{
    static const bool has = hasAvx2() && __builtin_cpu_supports("avx512dq") != 0 &&
                            __builtin_cpu_supports("avx512vl") != 0 && __builtin_cpu_supports("avx512vbmi2") != 0;
    return has;
}

const Kernels& kernelsFor(Simd simd)
{
    if ((simd == Simd::Automatic || simd == Simd::Avx512) && hasAvx512()) return kernelsAvx512();
    return simd != Simd::Sse2 && hasAvx2() ? kernelsAvx2() : kernelsSse2();
}

}  // namespace jet::physics::soft
