// Eight lanes for contact_kernels.inc.hpp, and how they reach the particles of a block. Included before it in the
// namespace of one instruction set. Without AVX eight are two registers of four: what the compiler makes of vectors of
// 32 bytes there goes through memory.

namespace {

typedef float Four __attribute__((vector_size(16), may_alias));
typedef std::int32_t FourBits __attribute__((vector_size(16), may_alias));

#ifdef __AVX2__
using Eight = Floats;
using Bits = Flags;

JET_INLINE Eight get(const Floats& from) { return from; }
JET_INLINE Bits get(const Flags& from) { return from; }
JET_INLINE void put(Floats& to, const Eight& x) { to = x; }
JET_INLINE void put(Flags& to, const Bits& x) { to = x; }
JET_INLINE Eight joined(const Four& low, const Four& high)
{
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
JET_INLINE Eight all(float value) { return Eight{} + value; }
JET_INLINE Eight choose(const Bits& mask, const Eight& yes, const Eight& no)
{
    return (Eight)_mm256_blendv_ps((__m256)no, (__m256)yes, (__m256)mask);
}
JET_INLINE Eight where(const Bits& mask, const Eight& x) { return (Eight)(mask & (Bits)x); }
JET_INLINE Eight least(const Eight& a, const Eight& b) { return (Eight)_mm256_min_ps((__m256)a, (__m256)b); }
JET_INLINE Eight most(const Eight& a, const Eight& b) { return (Eight)_mm256_max_ps((__m256)a, (__m256)b); }
JET_INLINE Eight size(const Eight& a) { return (Eight)((Bits)a & 0x7fffffff); }
JET_INLINE Eight root(const Eight& a) { return (Eight)_mm256_sqrt_ps((__m256)a); }
JET_INLINE unsigned bits(const Bits& mask) { return static_cast<unsigned>(_mm256_movemask_ps((__m256)mask)); }
JET_INLINE Four lowOf(const Eight& x) { return __builtin_shufflevector(x, x, 0, 1, 2, 3); }
JET_INLINE Four highOf(const Eight& x) { return __builtin_shufflevector(x, x, 4, 5, 6, 7); }
#else
struct Eight {
    Four low, high;
};
struct Bits {
    FourBits low, high;
};

JET_INLINE Eight get(const Floats& from)
{
    const auto* half = reinterpret_cast<const Four*>(&from);
    return {half[0], half[1]};
}
JET_INLINE Bits get(const Flags& from)
{
    const auto* half = reinterpret_cast<const FourBits*>(&from);
    return {half[0], half[1]};
}
JET_INLINE void put(Floats& to, const Eight& x)
{
    auto* half = reinterpret_cast<Four*>(&to);
    half[0] = x.low, half[1] = x.high;
}
JET_INLINE void put(Flags& to, const Bits& x)
{
    auto* half = reinterpret_cast<FourBits*>(&to);
    half[0] = x.low, half[1] = x.high;
}
JET_INLINE Eight joined(const Four& low, const Four& high) { return {low, high}; }
JET_INLINE Eight all(float value) { return {Four{} + value, Four{} + value}; }

// One operator for two lanes of four, with lanes or a number on either side.
#define JET_LANES(op, Result, Lanes)                                                                                   \
    JET_INLINE Result operator op(const Lanes& a, const Lanes& b) { return {a.low op b.low, a.high op b.high}; }
#define JET_NUMBERS(op)                                                                                                \
    JET_LANES(op, Eight, Eight)                                                                                        \
    JET_INLINE Eight operator op(const Eight& a, float b) { return a op all(b); }                                      \
    JET_INLINE Eight operator op(float a, const Eight& b) { return all(a) op b; }
JET_NUMBERS(+)
JET_NUMBERS(-)
JET_NUMBERS(*)
JET_NUMBERS(/)
JET_LANES(<, Bits, Eight)
JET_LANES(<=, Bits, Eight)
JET_LANES(>, Bits, Eight)
JET_LANES(>=, Bits, Eight)
JET_LANES(!=, Bits, Eight)
JET_LANES(&, Bits, Bits)
JET_LANES(|, Bits, Bits)
JET_LANES(^, Bits, Bits)
#undef JET_NUMBERS
#undef JET_LANES
JET_INLINE Eight operator-(const Eight& x) { return {-x.low, -x.high}; }
JET_INLINE Bits operator~(const Bits& x) { return {~x.low, ~x.high}; }

JET_INLINE Four choose(const FourBits& mask, const Four& yes, const Four& no)
{
    return (Four)((mask & (FourBits)yes) | (~mask & (FourBits)no));
}
JET_INLINE Eight choose(const Bits& mask, const Eight& yes, const Eight& no)
{
    return {choose(mask.low, yes.low, no.low), choose(mask.high, yes.high, no.high)};
}
JET_INLINE Eight where(const Bits& mask, const Eight& x)
{
    return {(Four)(mask.low & (FourBits)x.low), (Four)(mask.high & (FourBits)x.high)};
}
JET_INLINE Eight least(const Eight& a, const Eight& b)
{
    return {(Four)_mm_min_ps((__m128)a.low, (__m128)b.low), (Four)_mm_min_ps((__m128)a.high, (__m128)b.high)};
}
JET_INLINE Eight most(const Eight& a, const Eight& b)
{
    return {(Four)_mm_max_ps((__m128)a.low, (__m128)b.low), (Four)_mm_max_ps((__m128)a.high, (__m128)b.high)};
}
JET_INLINE Eight size(const Eight& a)
{
    return {(Four)((FourBits)a.low & 0x7fffffff), (Four)((FourBits)a.high & 0x7fffffff)};
}
JET_INLINE Eight root(const Eight& a) { return {(Four)_mm_sqrt_ps((__m128)a.low), (Four)_mm_sqrt_ps((__m128)a.high)}; }
JET_INLINE unsigned bits(const Bits& mask)
{
    return static_cast<unsigned>(_mm_movemask_ps((__m128)mask.low)) |
           (static_cast<unsigned>(_mm_movemask_ps((__m128)mask.high)) << 4);
}
JET_INLINE Four lowOf(const Eight& x) { return x.low; }
JET_INLINE Four highOf(const Eight& x) { return x.high; }
#endif

/// The least of the lanes; those that are not numbers are left out, `most` stands for all of them.
JET_INLINE float leastOf(const Eight& x, float most)
{
    const Eight bounded = least(x, all(most));
    const __m128 four = _mm_min_ps((__m128)lowOf(bounded), (__m128)highOf(bounded));
    const __m128 two = _mm_min_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 1)));
}

/// Of each contact: the particle from the wall's first end, and the wall's second end from its first.
struct Offsets {
    Eight x, y, edgeX, edgeY;
};

JET_INLINE Offsets offsets(const double* of, const ContactBlock& c)
{
    const auto at = [of](std::int32_t node) { return of + 2 * static_cast<std::ptrdiff_t>(node); };
    const auto row = [&](int i) {
#ifdef __AVX2__
        const __m256d ends = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(at(c.point[i]))),
                                                  _mm_loadu_pd(at(c.second[i])), 1);
        const __m256d first = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(at(c.first[i])));
        return (Four)_mm256_cvtpd_ps(_mm256_sub_pd(ends, first));
#else
        const __m128d first = _mm_loadu_pd(at(c.first[i]));
        const __m128d point = _mm_sub_pd(_mm_loadu_pd(at(c.point[i])), first);
        const __m128d second = _mm_sub_pd(_mm_loadu_pd(at(c.second[i])), first);
        return (Four)_mm_movelh_ps(_mm_cvtpd_ps(point), _mm_cvtpd_ps(second));
#endif
    };
    Four columns[2][4];
    for (int half = 0; half < 2; ++half) {
        __m128 a = (__m128)row(4 * half), b = (__m128)row(4 * half + 1);
        __m128 c2 = (__m128)row(4 * half + 2), d = (__m128)row(4 * half + 3);
        _MM_TRANSPOSE4_PS(a, b, c2, d);
        columns[half][0] = (Four)a, columns[half][1] = (Four)b, columns[half][2] = (Four)c2, columns[half][3] = (Four)d;
    }
    return {joined(columns[0][0], columns[1][0]), joined(columns[0][1], columns[1][1]),
            joined(columns[0][2], columns[1][2]), joined(columns[0][3], columns[1][3])};
}

/// Impulses along normal and tangent, on the particle, and against it on the ends of the wall; lanes without any change
/// nothing. No branches: which lanes push is known last of all, and to guess it wrong would cost more than all lanes.
JET_INLINE void exert(const ContactBlock& c, const Particles& particles, const Eight& normal, const Eight& tangent)
{
    const Eight normalX = get(c.normalX), normalY = get(c.normalY);
    const Eight x = normal * normalX - tangent * normalY, y = normal * normalY + tangent * normalX;
    // x and y of a lane together.
    const __m128 two[4] = {
        _mm_unpacklo_ps((__m128)lowOf(x), (__m128)lowOf(y)), _mm_unpackhi_ps((__m128)lowOf(x), (__m128)lowOf(y)),
        _mm_unpacklo_ps((__m128)highOf(x), (__m128)highOf(y)), _mm_unpackhi_ps((__m128)highOf(x), (__m128)highOf(y))};
    const auto add = [&](std::int32_t node, __m128d change) {
        double* at = particles.velocity + 2 * static_cast<std::ptrdiff_t>(node);
        _mm_storeu_pd(at, _mm_add_pd(_mm_loadu_pd(at), change));
    };
    for (int i = 0; i < kWide; i += 2) {
#ifdef __AVX2__
        const __m256d impulse = _mm256_cvtps_pd(two[i / 2]);
        const auto act = [&](const std::int32_t* node, const double* part) {
            const __m256d parts =
                _mm256_permute_pd(_mm256_broadcast_pd(reinterpret_cast<const __m128d*>(part + i)), 0xc);
            const __m256d change = _mm256_mul_pd(parts, impulse);
            add(node[i], _mm256_castpd256_pd128(change));
            add(node[i + 1], _mm256_extractf128_pd(change, 1));
        };
#else
        const __m128d impulse = _mm_cvtps_pd(two[i / 2]), next = _mm_cvtps_pd(_mm_movehl_ps(two[i / 2], two[i / 2]));
        const auto act = [&](const std::int32_t* node, const double* part) {
            add(node[i], _mm_mul_pd(_mm_set1_pd(part[i]), impulse));
            add(node[i + 1], _mm_mul_pd(_mm_set1_pd(part[i + 1]), next));
        };
#endif
        act(c.point, c.ofPoint), act(c.first, c.ofFirst), act(c.second, c.ofSecond);
    }
}

}  // namespace
