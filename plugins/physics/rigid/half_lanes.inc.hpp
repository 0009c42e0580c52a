// Lanes for processors without registers of 32 bytes: two registers of 16. What the compiler makes of vectors wider
// than any register goes through memory, value by value. Included by kernels.inc.hpp; the same bits as those.

template <class Real>
struct HalfTypes;
template <>
struct HalfTypes<float> {
    typedef float Values __attribute__((vector_size(16), may_alias));
    typedef std::int32_t Bits __attribute__((vector_size(16), may_alias));
};
template <>
struct HalfTypes<double> {
    typedef double Values __attribute__((vector_size(16), may_alias));
    typedef std::int64_t Bits __attribute__((vector_size(16), may_alias));
};

template <class Real>
struct HalfMasks {
    typename HalfTypes<Real>::Bits low, high;

    friend JET_INLINE HalfMasks operator&(const HalfMasks& a, const HalfMasks& b)
    {
        return {a.low & b.low, a.high & b.high};
    }
    friend JET_INLINE HalfMasks operator|(const HalfMasks& a, const HalfMasks& b)
    {
        return {a.low | b.low, a.high | b.high};
    }
};

template <class Real>
struct Halves {
    using Values = typename HalfTypes<Real>::Values;
    using Masks = HalfMasks<Real>;
    static constexpr int kEach = kLanes<Real> / 2;
    Values low, high;

    JET_INLINE Real operator[](int lane) const { return lane < kEach ? low[lane] : high[lane - kEach]; }
    static JET_INLINE Halves of(Real value) { return {Values{} + value, Values{} + value}; }

// Of lanes with lanes, or with a number on either side.
#define JET_LANES(op)                                                                                                  \
    friend JET_INLINE Halves operator op(const Halves& a, const Halves& b)                                             \
    {                                                                                                                  \
        return {a.low op b.low, a.high op b.high};                                                                     \
    }                                                                                                                  \
    friend JET_INLINE Halves operator op(const Halves& a, Real b) { return a op of(b); }                               \
    friend JET_INLINE Halves operator op(Real a, const Halves& b) { return of(a) op b; }                               \
    JET_INLINE Halves& operator op##=(const Halves& b) { return *this = *this op b; }                                  \
    JET_INLINE Halves& operator op##=(Real b) { return *this = *this op of(b); }
    JET_LANES(+)
    JET_LANES(-)
    JET_LANES(*)
    JET_LANES(/)
#undef JET_LANES
#define JET_LANES(op)                                                                                                  \
    friend JET_INLINE Masks operator op(const Halves& a, const Halves& b)                                              \
    {                                                                                                                  \
        return {a.low op b.low, a.high op b.high};                                                                     \
    }                                                                                                                  \
    friend JET_INLINE Masks operator op(const Halves& a, Real b) { return a op of(b); }
    JET_LANES(<)
    JET_LANES(<=)
    JET_LANES(>)
    JET_LANES(==)
#undef JET_LANES
    friend JET_INLINE Halves operator-(const Halves& a) { return {-a.low, -a.high}; }
};

/// In place of those outside.
template <class Real>
using Lanes = Halves<Real>;
template <class Real>
using Mask = HalfMasks<Real>;

template <class Real>
JET_INLINE Lanes<Real> all(Real value)
{
    return Lanes<Real>::of(value);
}
template <class Real>
JET_INLINE Lanes<Real> choose(const Mask<Real>& mask, const Lanes<Real>& yes, const Lanes<Real>& no)
{
    using Values = typename HalfTypes<Real>::Values;
    using Bits = typename HalfTypes<Real>::Bits;
    const auto half = [](const Bits& bits, const Values& a, const Values& b)
                          JET_INLINED { return (Values)((bits & (Bits)a) | (~bits & (Bits)b)); };
    return {half(mask.low, yes.low, no.low), half(mask.high, yes.high, no.high)};
}
/// A bit for each lane that is set.
template <class Real>
JET_INLINE std::uint32_t bitsOf(const Mask<Real>& mask)
{
    std::uint32_t bits = 0;
    for (int i = 0; i < Halves<Real>::kEach; ++i)
        bits |= static_cast<std::uint32_t>((mask.low[i] & 1) | (mask.high[i] & 1) << Halves<Real>::kEach) << i;
    return bits;
}

#if defined(__SSE2__)
JET_INLINE Halves<float> least(const Halves<float>& a, const Halves<float>& b)
{
    return {__builtin_ia32_minps(a.low, b.low), __builtin_ia32_minps(a.high, b.high)};
}
JET_INLINE Halves<float> most(const Halves<float>& a, const Halves<float>& b)
{
    return {__builtin_ia32_maxps(a.low, b.low), __builtin_ia32_maxps(a.high, b.high)};
}
JET_INLINE Halves<double> least(const Halves<double>& a, const Halves<double>& b)
{
    return {__builtin_ia32_minpd(a.low, b.low), __builtin_ia32_minpd(a.high, b.high)};
}
JET_INLINE Halves<double> most(const Halves<double>& a, const Halves<double>& b)
{
    return {__builtin_ia32_maxpd(a.low, b.low), __builtin_ia32_maxpd(a.high, b.high)};
}
#else
template <class Real>
JET_INLINE Halves<Real> least(const Halves<Real>& a, const Halves<Real>& b)
{
    return choose<Real>(a < b, a, b);
}
template <class Real>
JET_INLINE Halves<Real> most(const Halves<Real>& a, const Halves<Real>& b)
{
    return choose<Real>(a > b, a, b);
}
#endif

using Four = HalfTypes<float>::Values;
using Two = HalfTypes<double>::Values;

/// Four values that lie side by side.
template <class Real>
struct RowOf {
    typedef Four Values;
};
template <>
struct RowOf<double> {
    typedef Halves<double> Values;
};
template <class Real>
using Row = typename RowOf<Real>::Values;
template <class Real>
JET_INLINE Row<Real> rowWith(Real x, Real y, Real z, Real w)
{
    if constexpr (sizeof(Real) == 4)
        return Four{x, y, z, w};
    else
        return Halves<double>{{x, y}, {z, w}};
}

/// Rows of four values of eight places, or four, to four rows of as many.
template <class Of>
JET_INLINE void gatherRows(const Of& of, Halves<float>& x, Halves<float>& y, Halves<float>& z, Halves<float>& w)
{
    const auto columns = [&](int first, Four& a, Four& b, Four& c, Four& d) JET_INLINED {
        const auto row = [&](int i) JET_INLINED { return *reinterpret_cast<const Four*>(of(first + i)); };
        const Four r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
        const Four t0 = __builtin_shufflevector(r0, r1, 0, 4, 1, 5), t1 = __builtin_shufflevector(r0, r1, 2, 6, 3, 7);
        const Four t2 = __builtin_shufflevector(r2, r3, 0, 4, 1, 5), t3 = __builtin_shufflevector(r2, r3, 2, 6, 3, 7);
        a = __builtin_shufflevector(t0, t2, 0, 1, 4, 5), b = __builtin_shufflevector(t0, t2, 2, 3, 6, 7);
        c = __builtin_shufflevector(t1, t3, 0, 1, 4, 5), d = __builtin_shufflevector(t1, t3, 2, 3, 6, 7);
    };
    columns(0, x.low, y.low, z.low, w.low);
    columns(4, x.high, y.high, z.high, w.high);
}
template <class Of>
JET_INLINE void gatherRows(const Of& of, Halves<double>& x, Halves<double>& y, Halves<double>& z, Halves<double>& w)
{
    const auto columns = [&](int first, Two& a, Two& b, Two& c, Two& d) JET_INLINED {
        const Two *const p = reinterpret_cast<const Two*>(of(first)), *const q =
                                                                          reinterpret_cast<const Two*>(of(first + 1));
        a = __builtin_shufflevector(p[0], q[0], 0, 2), b = __builtin_shufflevector(p[0], q[0], 1, 3);
        c = __builtin_shufflevector(p[1], q[1], 0, 2), d = __builtin_shufflevector(p[1], q[1], 1, 3);
    };
    columns(0, x.low, y.low, z.low, w.low);
    columns(2, x.high, y.high, z.high, w.high);
}

JET_INLINE void scatterRows(BodyState<float>* bodies, const std::int32_t* index, const Halves<float>& x,
                            const Halves<float>& y, const Halves<float>& z, const Halves<float>& w)
{
    const auto rows = [&](const std::int32_t* at, const Four& a, const Four& b, const Four& c,
                          const Four& d) JET_INLINED {
        const Four t0 = __builtin_shufflevector(a, b, 0, 4, 1, 5), t1 = __builtin_shufflevector(a, b, 2, 6, 3, 7);
        const Four t2 = __builtin_shufflevector(c, d, 0, 4, 1, 5), t3 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
        const auto put = [&](int i, const Four& row) JET_INLINED {
            BodyState<float>& body = *farFrom(bodies, at[i]);
            if (body.invMass != 0) *reinterpret_cast<Four*>(&body) = row;
        };
        put(0, __builtin_shufflevector(t0, t2, 0, 1, 4, 5)), put(1, __builtin_shufflevector(t0, t2, 2, 3, 6, 7));
        put(2, __builtin_shufflevector(t1, t3, 0, 1, 4, 5)), put(3, __builtin_shufflevector(t1, t3, 2, 3, 6, 7));
    };
    rows(index, x.low, y.low, z.low, w.low);
    rows(index + 4, x.high, y.high, z.high, w.high);
}

JET_INLINE void scatterRows(BodyState<double>* bodies, const std::int32_t* index, const Halves<double>& x,
                            const Halves<double>& y, const Halves<double>& z, const Halves<double>& w)
{
    const auto put = [&](int i, const Two& first, const Two& second) JET_INLINED {
        BodyState<double>& body = *farFrom(bodies, index[i]);
        if (body.invMass == 0) return;
        Two* const row = reinterpret_cast<Two*>(&body);
        row[0] = first, row[1] = second;
    };
    const auto two = [&](int i, const Two& a, const Two& b, const Two& c, const Two& d) JET_INLINED {
        put(i, __builtin_shufflevector(a, b, 0, 2), __builtin_shufflevector(c, d, 0, 2));
        put(i + 1, __builtin_shufflevector(a, b, 1, 3), __builtin_shufflevector(c, d, 1, 3));
    };
    two(0, x.low, y.low, z.low, w.low);
    two(2, x.high, y.high, z.high, w.high);
}

JET_INLINE void putFour(Halves<double>& to, int, const Halves<double>& values) { to = values; }
JET_INLINE void putFour(Halves<float>& to, int four, const Halves<double>& values)
{
    (four == 0 ? to.low : to.high) = Four{static_cast<float>(values[0]), static_cast<float>(values[1]),
                                          static_cast<float>(values[2]), static_cast<float>(values[3])};
}

/// Visits groups, each in two halves: v = begin(g), then end(g, v). Their lanes are two chains of results already.
template <class Begin, class End>
JET_INLINE void eachGroup(std::size_t count, const Begin& begin, const End& end)
{
    for (std::size_t g = 0; g < count; ++g) {
        auto visit = begin(g);
        end(g, visit);
    }
}

// Doubles as they lie in memory.
typedef Two Doubles;
typedef double DoublesAnywhere __attribute__((vector_size(16), may_alias, aligned(8)));
typedef std::uint64_t DoubleBits __attribute__((vector_size(16)));
constexpr std::size_t kDoubles = 2;

JET_INLINE void putPairs(double* to, const Doubles& first, const Doubles& second)
{
    reinterpret_cast<DoublesAnywhere*>(to)[0] = __builtin_shufflevector(first, second, 0, 2);
    reinterpret_cast<DoublesAnywhere*>(to)[1] = __builtin_shufflevector(first, second, 1, 3);
}
