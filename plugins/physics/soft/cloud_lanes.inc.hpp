// Two particles' vectors for cloud_kernels.inc.hpp, included before it in the namespace of one instruction set. Without
// AVX they are two registers of one: what the compiler makes of vectors of 32 bytes there goes through memory.

namespace {

typedef double One __attribute__((vector_size(16), may_alias));
typedef std::int64_t OneBits __attribute__((vector_size(16), may_alias));

#ifdef __AVX2__
using Two = Lanes<double>;  // x y of one particle, x y of the next
using Bits = LaneTypes<double>::Mask;

JET_INLINE Two joined(const One& low, const One& high) { return __builtin_shufflevector(low, high, 0, 1, 2, 3); }
JET_INLINE One lowOf(const Two& v) { return __builtin_shufflevector(v, v, 0, 1); }
JET_INLINE One highOf(const Two& v) { return __builtin_shufflevector(v, v, 2, 3); }
JET_INLINE Two all(double value) { return Two{} + value; }
JET_INLINE Two swapped(const Two& v) { return __builtin_shufflevector(v, v, 1, 0, 3, 2); }
JET_INLINE Two most(const Two& a, const Two& b) { return (Two)_mm256_max_pd((__m256d)a, (__m256d)b); }
JET_INLINE Two least(const Two& a, const Two& b) { return (Two)_mm256_min_pd((__m256d)a, (__m256d)b); }
JET_INLINE Two where(const Bits& mask, const Two& v) { return (Two)(mask & (Bits)v); }
JET_INLINE bool anySet(const Bits& mask) { return _mm256_movemask_pd((__m256d)mask) != 0; }
JET_INLINE Two root(const Two& v) { return (Two)_mm256_sqrt_pd((__m256d)v); }
#else
struct Two {
    One low, high;
};
struct Bits {
    OneBits low, high;
};

JET_INLINE Two joined(const One& low, const One& high) { return {low, high}; }
JET_INLINE One lowOf(const Two& v) { return v.low; }
JET_INLINE One highOf(const Two& v) { return v.high; }
JET_INLINE Two all(double value) { return {One{} + value, One{} + value}; }
JET_INLINE Two operator+(const Two& a, const Two& b) { return {a.low + b.low, a.high + b.high}; }
JET_INLINE Two operator-(const Two& a, const Two& b) { return {a.low - b.low, a.high - b.high}; }
JET_INLINE Two operator*(const Two& a, const Two& b) { return {a.low * b.low, a.high * b.high}; }
JET_INLINE Two operator/(const Two& a, const Two& b) { return {a.low / b.low, a.high / b.high}; }
JET_INLINE Two& operator+=(Two& a, const Two& b) { return a = a + b; }
JET_INLINE Two& operator-=(Two& a, const Two& b) { return a = a - b; }
JET_INLINE Bits operator>(const Two& a, const Two& b) { return {a.low > b.low, a.high > b.high}; }
JET_INLINE Two swapped(const Two& v)
{
    return {__builtin_shufflevector(v.low, v.low, 1, 0), __builtin_shufflevector(v.high, v.high, 1, 0)};
}
JET_INLINE Two most(const Two& a, const Two& b)
{
    return {(One)_mm_max_pd((__m128d)a.low, (__m128d)b.low), (One)_mm_max_pd((__m128d)a.high, (__m128d)b.high)};
}
JET_INLINE Two least(const Two& a, const Two& b)
{
    return {(One)_mm_min_pd((__m128d)a.low, (__m128d)b.low), (One)_mm_min_pd((__m128d)a.high, (__m128d)b.high)};
}
JET_INLINE Two where(const Bits& mask, const Two& v)
{
    return {(One)(mask.low & (OneBits)v.low), (One)(mask.high & (OneBits)v.high)};
}
JET_INLINE bool anySet(const Bits& mask) { return _mm_movemask_pd((__m128d)(mask.low | mask.high)) != 0; }
JET_INLINE Two root(const Two& v) { return {(One)_mm_sqrt_pd((__m128d)v.low), (One)_mm_sqrt_pd((__m128d)v.high)}; }
#endif

JET_INLINE Two both(double x, double y) { return joined(One{x, y}, One{x, y}); }
/// One after the other.
JET_INLINE double sumX(const Two& v) { return lowOf(v)[0] + highOf(v)[0]; }
JET_INLINE double sumY(const Two& v) { return lowOf(v)[1] + highOf(v)[1]; }
JET_INLINE double mostX(const Two& v) { return lowOf(v)[0] > highOf(v)[0] ? lowOf(v)[0] : highOf(v)[0]; }

JET_INLINE One oneAt(const double* from) { return (One)_mm_loadu_pd(from); }
/// Vectors of two particles; a last one alone is taken twice.
JET_INLINE Two vectors(const double* from, std::size_t n, bool two)
{
    const One first = oneAt(from + 2 * n);
#ifdef __AVX2__
    if (two) return (Two)_mm256_loadu_pd(from + 2 * n);
#endif
    return joined(first, two ? oneAt(from + 2 * n + 2) : first);
}
/// Masses; that of one taken twice counts once.
JET_INLINE Two masses(const double* from, std::size_t n, bool two)
{
    return joined(One{} + from[n], One{} + (two ? from[n + 1] : 0));
}
JET_INLINE void store(double* to, std::size_t n, bool two, const Two& v)
{
#ifdef __AVX2__
    if (two) return _mm256_storeu_pd(to + 2 * n, (__m256d)v);
#endif
    _mm_storeu_pd(to + 2 * n, (__m128d)lowOf(v));
    if (two) _mm_storeu_pd(to + 2 * n + 2, (__m128d)highOf(v));
}

}  // namespace
