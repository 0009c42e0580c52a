// Lanes in registers of 32 bytes: the compiler's vectors, and what they lack. Included by kernels.inc.hpp.

template <class Real>
using Lanes = physics::Lanes<Real>;
template <class Real>
using Mask = typename LaneTypes<Real>::Mask;

template <class Real>
JET_INLINE Lanes<Real> all(Real value)
{
    return Lanes<Real>{} + value;
}
template <class Real>
JET_INLINE Lanes<Real> choose(const Mask<Real>& mask, const Lanes<Real>& yes, const Lanes<Real>& no)
{
    return (Lanes<Real>)((mask & (Mask<Real>)yes) | (~mask & (Mask<Real>)no));
}
/// A bit for each lane that is set.
template <class Real>
JET_INLINE std::uint32_t bitsOf(const Mask<Real>& mask)
{
    if constexpr (sizeof(Real) == 4)
        return static_cast<std::uint32_t>(__builtin_ia32_movmskps256((Lanes<float>)mask));
    else
        return static_cast<std::uint32_t>(__builtin_ia32_movmskpd256((Lanes<double>)mask));
}
template <class Values>
JET_INLINE Values least(const Values& a, const Values& b)
{
    return a < b ? a : b;
}
template <class Values>
JET_INLINE Values most(const Values& a, const Values& b)
{
    return a > b ? a : b;
}

typedef float Four __attribute__((vector_size(16), may_alias));
typedef double FourDoubles __attribute__((vector_size(32), may_alias));

/// Four values that lie side by side.
template <class Real>
struct RowOf {
    typedef Four Values;
};
template <>
struct RowOf<double> {
    typedef FourDoubles Values;
};
template <class Real>
using Row = typename RowOf<Real>::Values;
template <class Real>
JET_INLINE Row<Real> rowWith(Real x, Real y, Real z, Real w)
{
    return Row<Real>{x, y, z, w};
}

/// Rows of four values of eight bodies to four rows of eight, or back: within the halves of a register, as AVX2
/// shuffles best.
JET_INLINE void transpose(Lanes<float> (&c)[4])
{
    const Lanes<float> t0 = __builtin_shufflevector(c[0], c[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const Lanes<float> t1 = __builtin_shufflevector(c[0], c[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const Lanes<float> t2 = __builtin_shufflevector(c[2], c[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const Lanes<float> t3 = __builtin_shufflevector(c[2], c[3], 2, 10, 3, 11, 6, 14, 7, 15);
    c[0] = __builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13);
    c[1] = __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15);
    c[2] = __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13);
    c[3] = __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15);
}

/// Rows of four values of eight places, or four, to four rows of as many.
template <class Of>
JET_INLINE void gatherRows(const Of& of, Lanes<float>& x, Lanes<float>& y, Lanes<float>& z, Lanes<float>& w)
{
    // Written out: of a loop the compiler makes one through memory.
    const auto rows = [&](int i) JET_INLINED {
        const Four low = *reinterpret_cast<const Four*>(of(i)), high = *reinterpret_cast<const Four*>(of(i + 4));
        return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
    };
    Lanes<float> c[4] = {rows(0), rows(1), rows(2), rows(3)};
    transpose(c);
    x = c[0], y = c[1], z = c[2], w = c[3];
}
template <class Of>
JET_INLINE void gatherRows(const Of& of, Lanes<double>& x, Lanes<double>& y, Lanes<double>& z, Lanes<double>& w)
{
    const auto row = [&](int i) JET_INLINED { return *reinterpret_cast<const FourDoubles*>(of(i)); };
    const Lanes<double> c0 = row(0), c1 = row(1), c2 = row(2), c3 = row(3);
    const Lanes<double> t0 = __builtin_shufflevector(c0, c1, 0, 4, 2, 6),
                        t1 = __builtin_shufflevector(c0, c1, 1, 5, 3, 7);
    const Lanes<double> t2 = __builtin_shufflevector(c2, c3, 0, 4, 2, 6),
                        t3 = __builtin_shufflevector(c2, c3, 1, 5, 3, 7);
    x = __builtin_shufflevector(t0, t2, 0, 1, 4, 5), y = __builtin_shufflevector(t1, t3, 0, 1, 4, 5);
    z = __builtin_shufflevector(t0, t2, 2, 3, 6, 7), w = __builtin_shufflevector(t1, t3, 2, 3, 6, 7);
}

JET_INLINE void scatterRows(BodyState<float>* bodies, const std::int32_t* index, const Lanes<float>& x,
                            const Lanes<float>& y, const Lanes<float>& z, const Lanes<float>& invMass)
{
    Lanes<float> c[4] = {x, y, z, invMass};
    transpose(c);
    // What never moves may be in many groups, of other threads, too.
    const int moving = __builtin_ia32_movmskps256((Lanes<float>)(invMass != Lanes<float>{}));
    const auto put = [&](int i) JET_INLINED {
        Four* const to = reinterpret_cast<Four*>(farFrom(bodies, index[i]));
        *to = i < 4 ? __builtin_shufflevector(c[i & 3], c[i & 3], 0, 1, 2, 3)
                    : __builtin_shufflevector(c[i & 3], c[i & 3], 4, 5, 6, 7);
    };
    if (moving == 0xff) [[likely]] {
        put(0), put(1), put(2), put(3), put(4), put(5), put(6), put(7);
    } else {
        for (int i = 0; i < 8; ++i)
            if ((moving >> i & 1) != 0) put(i);
    }
}

JET_INLINE void scatterRows(BodyState<double>* bodies, const std::int32_t* index, const Lanes<double>& x,
                            const Lanes<double>& y, const Lanes<double>& z, const Lanes<double>& invMass)
{
    const Lanes<double> t0 = __builtin_shufflevector(x, y, 0, 4, 2, 6), t1 = __builtin_shufflevector(x, y, 1, 5, 3, 7);
    const Lanes<double> t2 = __builtin_shufflevector(z, invMass, 0, 4, 2, 6),
                        t3 = __builtin_shufflevector(z, invMass, 1, 5, 3, 7);
    const auto put = [&](int i, const Lanes<double>& row) JET_INLINED {
        BodyState<double>& body = *farFrom(bodies, index[i]);
        if (body.invMass != 0) *reinterpret_cast<FourDoubles*>(&body) = row;
    };
    put(0, __builtin_shufflevector(t0, t2, 0, 1, 4, 5)), put(1, __builtin_shufflevector(t1, t3, 0, 1, 4, 5));
    put(2, __builtin_shufflevector(t0, t2, 2, 3, 6, 7)), put(3, __builtin_shufflevector(t1, t3, 2, 3, 6, 7));
}

JET_INLINE void putFour(Lanes<double>& to, int, const Lanes<double>& values) { to = values; }
JET_INLINE void putFour(Lanes<float>& to, int four, const Lanes<double>& values)
{
    reinterpret_cast<Four*>(&to)[four] = __builtin_convertvector(values, Four);
}

/// Visits groups that have no body in common, each in two halves: v = begin(g), then end(g, v). The next group is begun
/// before one ends: what is done with a group is a chain of results, and a processor that looks a few hundred
/// instructions ahead has little else to do while it waits for them.
template <class Begin, class End>
JET_INLINE void eachGroup(std::size_t count, const Begin& begin, const End& end)
{
    if (count == 0) return;
    auto even = begin(0);
    std::size_t g = 0;
    for (; g + 2 < count; g += 2) {
        auto odd = begin(g + 1);
        end(g, even);
        even = begin(g + 2);
        end(g + 1, odd);
    }
    if (g + 1 == count) return end(g, even);
    auto odd = begin(g + 1);
    end(g, even), end(g + 1, odd);
}

// Doubles as they lie in memory.
typedef FourDoubles Doubles;
typedef double DoublesAnywhere __attribute__((vector_size(32), may_alias, aligned(8)));
typedef std::uint64_t DoubleBits __attribute__((vector_size(32)));
constexpr std::size_t kDoubles = 4;

JET_INLINE void putPairs(double* to, const Doubles& first, const Doubles& second)
{
    reinterpret_cast<DoublesAnywhere*>(to)[0] = __builtin_shufflevector(first, second, 0, 4, 1, 5);
    reinterpret_cast<DoublesAnywhere*>(to)[1] = __builtin_shufflevector(first, second, 2, 6, 3, 7);
}
