// Eight floats at once: rows of memory to lanes and back, and what the compiler's vector types lack. Included in the
// namespace of one instruction set, before what uses it; the same bits from each: only exact operations, in one order.

namespace {

typedef float Four __attribute__((vector_size(16), may_alias));
typedef std::int32_t FourBits __attribute__((vector_size(16), may_alias));
typedef double FourDoubles __attribute__((vector_size(32)));
typedef double TwoDoubles __attribute__((vector_size(16), may_alias));

#if defined(__AVX__)
using Eight = Lanes<float>;
using Bits = LaneTypes<float>::Mask;

JET_INLINE Four lowOf(const Eight& x) { return __builtin_shufflevector(x, x, 0, 1, 2, 3); }
JET_INLINE Four highOf(const Eight& x) { return __builtin_shufflevector(x, x, 4, 5, 6, 7); }
JET_INLINE Eight joined(const Four& low, const Four& high)
{
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
JET_INLINE Eight all(float x) { return Eight{} + x; }
JET_INLINE Bits all(std::int32_t x) { return Bits{} + x; }
JET_INLINE Bits bitsIn(const Eight& x) { return (Bits)x; }
JET_INLINE Eight valuesIn(const Bits& x) { return (Eight)x; }

JET_INLINE Eight root(const Eight& x) { return (Eight)__builtin_ia32_sqrtps256(x); }
JET_INLINE Eight choose(const Bits& mask, const Eight& yes, const Eight& no)
{
    return __builtin_ia32_blendvps256(no, yes, (Eight)mask);
}
/// As std::min(a, b) does.
JET_INLINE Eight least(const Eight& a, const Eight& b) { return __builtin_ia32_minps256(b, a); }
/// A bit for each lane that is set.
JET_INLINE std::uint32_t bitsOf(const Bits& mask)
{
    return static_cast<std::uint32_t>(__builtin_ia32_movmskps256((Eight)mask));
}
#else
/// Two registers of four: what the compiler makes of eight where there are none so wide goes through memory.
struct Eight {
    Four low, high;
};
struct Bits {
    FourBits low, high;
};

JET_INLINE Four lowOf(const Eight& x) { return x.low; }
JET_INLINE Four highOf(const Eight& x) { return x.high; }
JET_INLINE Eight joined(const Four& low, const Four& high) { return {low, high}; }
JET_INLINE Eight all(float x) { return {Four{} + x, Four{} + x}; }
JET_INLINE Bits all(std::int32_t x) { return {FourBits{} + x, FourBits{} + x}; }
JET_INLINE Bits bitsIn(const Eight& x) { return {(FourBits)x.low, (FourBits)x.high}; }
JET_INLINE Eight valuesIn(const Bits& x) { return {(Four)x.low, (Four)x.high}; }

// One operator for two lanes of four, with lanes or a number on the right.
#define JET_LANES(op, Result, Lanes, Number)                                                                           \
    JET_INLINE Result operator op(const Lanes& a, const Lanes& b) { return {a.low op b.low, a.high op b.high}; }       \
    JET_INLINE Result operator op(const Lanes& a, Number b) { return a op all(b); }
JET_LANES(+, Eight, Eight, float)
JET_LANES(-, Eight, Eight, float)
JET_LANES(*, Eight, Eight, float)
JET_LANES(/, Eight, Eight, float)
JET_LANES(<, Bits, Eight, float)
JET_LANES(<=, Bits, Eight, float)
JET_LANES(>, Bits, Eight, float)
JET_LANES(==, Bits, Eight, float)
JET_LANES(+, Bits, Bits, std::int32_t)
JET_LANES(&, Bits, Bits, std::int32_t)
JET_LANES(|, Bits, Bits, std::int32_t)
JET_LANES(==, Bits, Bits, std::int32_t)
JET_LANES(!=, Bits, Bits, std::int32_t)
JET_LANES(>, Bits, Bits, std::int32_t)
#undef JET_LANES
JET_INLINE Eight operator*(float a, const Eight& b) { return all(a) * b; }
JET_INLINE Eight operator/(float a, const Eight& b) { return all(a) / b; }
JET_INLINE Eight operator-(const Eight& x) { return {-x.low, -x.high}; }
JET_INLINE Bits operator~(const Bits& x) { return {~x.low, ~x.high}; }
JET_INLINE Bits operator<<(const Bits& x, int by) { return {x.low << by, x.high << by}; }
JET_INLINE Bits operator>>(const Bits& x, int by) { return {x.low >> by, x.high >> by}; }

JET_INLINE Eight choose(const Bits& mask, const Eight& yes, const Eight& no)
{
    return valuesIn((mask & bitsIn(yes)) | (~mask & bitsIn(no)));
}
#if defined(__SSE__)
JET_INLINE Eight root(const Eight& x) { return {__builtin_ia32_sqrtps(x.low), __builtin_ia32_sqrtps(x.high)}; }
JET_INLINE Eight least(const Eight& a, const Eight& b)
{
    return {__builtin_ia32_minps(b.low, a.low), __builtin_ia32_minps(b.high, a.high)};
}
JET_INLINE std::uint32_t bitsOf(const Bits& mask)
{
    return static_cast<std::uint32_t>(__builtin_ia32_movmskps((Four)mask.low) | __builtin_ia32_movmskps((Four)mask.high)
                                                                                    << 4);
}
#else
JET_INLINE Eight root(Eight x)
{
    for (int i = 0; i < 4; ++i) x.low[i] = std::sqrt(x.low[i]), x.high[i] = std::sqrt(x.high[i]);
    return x;
}
JET_INLINE Eight least(const Eight& a, const Eight& b) { return choose(b < a, b, a); }
JET_INLINE std::uint32_t bitsOf(const Bits& mask)
{
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits |= static_cast<std::uint32_t>((mask.low[i] & 1) | (mask.high[i] & 1) << 4) << i;
    return bits;
}
#endif
#endif

JET_INLINE Bits choose(const Bits& mask, const Bits& yes, const Bits& no)
{
    return bitsIn(choose(mask, valuesIn(yes), valuesIn(no)));
}
/// `x` where the mask is set, else null.
JET_INLINE Eight where(const Bits& mask, const Eight& x) { return valuesIn(mask & bitsIn(x)); }
JET_INLINE Eight absolute(const Eight& x) { return valuesIn(bitsIn(x) & 0x7fffffff); }
/// As std::max(a, b) does.
JET_INLINE Eight most(const Eight& a, const Eight& b) { return choose(a < b, b, a); }

JET_INLINE Eight load(const float* from)
{
    Eight x;
    __builtin_memcpy(&x, from, sizeof x);
    return x;
}
JET_INLINE void store(float* to, const Eight& x) { __builtin_memcpy(to, &x, sizeof x); }
JET_INLINE void store(std::int32_t* to, const Bits& x) { __builtin_memcpy(to, &x, sizeof x); }

/// Four rows of four to as many columns.
JET_INLINE void transpose(const Four& a, const Four& b, const Four& c, const Four& d, Four (&out)[4])
{
    const Four t0 = __builtin_shufflevector(a, b, 0, 4, 1, 5), t1 = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Four t2 = __builtin_shufflevector(c, d, 0, 4, 1, 5), t3 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    out[0] = __builtin_shufflevector(t0, t2, 0, 1, 4, 5), out[1] = __builtin_shufflevector(t0, t2, 2, 3, 6, 7);
    out[2] = __builtin_shufflevector(t1, t3, 0, 1, 4, 5), out[3] = __builtin_shufflevector(t1, t3, 2, 3, 6, 7);
}
#if defined(__AVX__)
/// The same in both halves of a register.
JET_INLINE void transpose(const Eight& a, const Eight& b, const Eight& c, const Eight& d, Eight (&out)[4])
{
    const Eight t0 = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
    const Eight t1 = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
    const Eight t2 = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
    const Eight t3 = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
    out[0] = __builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13);
    out[1] = __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15);
    out[2] = __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13);
    out[3] = __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15);
}
#endif

/// Four values of each of eight places, those of a kind together. `of(i)`: where those of lane i lie.
template <class Of>
JET_INLINE void gather(Of&& of, Eight& x, Eight& y, Eight& z, Eight& w)
{
    const auto row = [&](int i) {
        Four four;
        __builtin_memcpy(&four, of(i), sizeof four);
        return four;
    };
#if defined(__AVX__)
    Eight columns[4];
    transpose(joined(row(0), row(4)), joined(row(1), row(5)), joined(row(2), row(6)), joined(row(3), row(7)), columns);
    x = columns[0], y = columns[1], z = columns[2], w = columns[3];
#else
    Four low[4], high[4];
    transpose(row(0), row(1), row(2), row(3), low);
    transpose(row(4), row(5), row(6), row(7), high);
    x = joined(low[0], high[0]), y = joined(low[1], high[1]), z = joined(low[2], high[2]), w = joined(low[3], high[3]);
#endif
}

/// The way back; where some of the places are the same, the last lane's values stay.
template <class Of>
JET_INLINE void scatter(Of&& of, const Eight& x, const Eight& y, const Eight& z, const Eight& w)
{
    const auto put = [&](int i, const Four& row) { __builtin_memcpy(static_cast<void*>(of(i)), &row, sizeof row); };
#if defined(__AVX__)
    Eight rows[4];
    transpose(x, y, z, w, rows);
    for (int i = 0; i < 4; ++i) put(i, lowOf(rows[i])), put(i + 4, highOf(rows[i]));
#else
    Four low[4], high[4];
    transpose(lowOf(x), lowOf(y), lowOf(z), lowOf(w), low);
    transpose(highOf(x), highOf(y), highOf(z), highOf(w), high);
    for (int i = 0; i < 4; ++i) put(i, low[i]), put(i + 4, high[i]);
#endif
}

/// B's place from A's, of eight pairs. The difference is taken before digits are dropped.
JET_INLINE void placesApart(const Pose* const (&a)[8], const Pose* const (&b)[8], Eight& x, Eight& y)
{
    const auto two = [](const Pose* pose) { return *reinterpret_cast<const TwoDoubles*>(&pose->x); };
    const auto apart = [&](int i) -> Four {
#if defined(__AVX__)
        const FourDoubles of = __builtin_shufflevector(two(b[i]), two(b[i + 1]), 0, 1, 2, 3) -
                               __builtin_shufflevector(two(a[i]), two(a[i + 1]), 0, 1, 2, 3);
        return __builtin_convertvector(of, Four);
#else
        const TwoDoubles p = two(b[i]) - two(a[i]), q = two(b[i + 1]) - two(a[i + 1]);
        return Four{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(q[0]),
                    static_cast<float>(q[1])};
#endif
    };
    const Four p = apart(0), q = apart(2), r = apart(4), s = apart(6);
    x = joined(__builtin_shufflevector(p, q, 0, 2, 4, 6), __builtin_shufflevector(r, s, 0, 2, 4, 6));
    y = joined(__builtin_shufflevector(p, q, 1, 3, 5, 7), __builtin_shufflevector(r, s, 1, 3, 5, 7));
}

/// Poses of eight bodies, but for their places.
struct Motions {
    Eight cosine, sine, velocityX, velocityY, omega, travel, reach, unused;
};
JET_INLINE Motions motionsOf(const Pose* const (&poses)[8])
{
    Motions m;
    gather([&](int i) { return &poses[i]->turn; }, m.cosine, m.sine, m.velocityX, m.velocityY);
    gather([&](int i) { return &poses[i]->omega; }, m.omega, m.travel, m.reach, m.unused);
    return m;
}

/// How far points of the two may come together in dt at most: Collider::closingSpeed(), B lying (x, y) from A.
JET_INLINE Eight closingWay(const Motions& a, const Motions& b, const Eight& x, const Eight& y, float dt)
{
    const Bits fromA = a.reach <= b.reach;
    const Eight omega = choose(fromA, b.omega, a.omega), arm = choose(fromA, a.reach, b.reach);
    const Eight slideX = b.velocityX - a.velocityX + omega * y, slideY = b.velocityY - a.velocityY - omega * x;
    return (root(slideX * slideX + slideY * slideY) + absolute(b.omega - a.omega) * arm) * dt;
}

/// Do the boxes of each pair meet?
JET_INLINE Bits meeting(const FatBox* boxes, const RigidContact* const (&c)[8])
{
    Eight minX, minY, maxX, maxY, otherMinX, otherMinY, otherMaxX, otherMaxY;
    gather([&](int i) { return &boxes[c[i]->partA]; }, minX, minY, maxX, maxY);
    gather([&](int i) { return &boxes[c[i]->partB]; }, otherMinX, otherMinY, otherMaxX, otherMaxY);
    return (minX <= otherMaxX) & (otherMinX <= maxX) & (minY <= otherMaxY) & (otherMinY <= maxY);
}

}  // namespace
