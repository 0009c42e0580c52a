// Flights for processors with AVX-512: two rows of 8 nodes at a time. All else is done as with AVX2, and all bits are
// the same. Compiled with -mavx512f -mavx512dq -mavx512vl; called only where hasAvx512().
#include "avx2_lanes.hpp"

namespace jet::physics::soft {
namespace {

struct Avx512 {
    using F = __m512;
    using Mask = __mmask16;
    static constexpr std::size_t kRows = 2;

    static F load(const float* p) { return _mm512_loadu_ps(p); }
    static void store(float* p, F a) { _mm512_storeu_ps(p, a); }
    static F zero() { return _mm512_setzero_ps(); }
    static F one() { return _mm512_set1_ps(1); }
    static F all(float x) { return _mm512_set1_ps(x); }
    static F add(F a, F b) { return _mm512_add_ps(a, b); }
    static F sub(F a, F b) { return _mm512_sub_ps(a, b); }
    static F mul(F a, F b) { return _mm512_mul_ps(a, b); }
    static F div(F a, F b) { return _mm512_div_ps(a, b); }
    static F most(F a, F b) { return _mm512_max_ps(a, b); }
    static F sqrt(F a) { return _mm512_sqrt_ps(a); }
    static F zeroUnlessAbove(F value, F a, float least) { return _mm512_maskz_mov_ps(above(a, all(least)), value); }
    static Mask none() { return 0; }
    static Mask above(F a, F b) { return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ); }
    static Mask either(Mask a, Mask b) { return static_cast<Mask>(a | b); }
    static bool any(Mask a) { return a != 0; }
    template <class Of>
    static F rows(Of&& of)
    {
        return _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(of(0))), _mm256_loadu_ps(of(1)), 1);
    }
};

}  // namespace

const Kernels& kernelsAvx512()
{
    static const Kernels kernels = [] {
        static FlightKernels flight = *kernelsAvx2().flight;
        flight.fly = FlightSet<Avx2, Avx512>::table.fly;
        Kernels all = kernelsAvx2();
        all.flight = &flight;
        return all;
    }();
    return kernels;
}

}  // namespace jet::physics::soft
