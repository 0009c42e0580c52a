// The sieve of pairs, compiled once for each instruction set: sift_sse2.cpp and sift_avx2.cpp include this in a
// namespace of their own. The same bits from each: only +, -, *, square roots and comparisons, in the same order.

namespace {

typedef float Four __attribute__((vector_size(16), may_alias));
using Eight = Lanes<float>;
using Bits = LaneTypes<float>::Mask;

JET_INLINE void transpose(const Four& a, const Four& b, const Four& c, const Four& d, Four (&out)[4])
{
    const Four t0 = __builtin_shufflevector(a, b, 0, 4, 1, 5), t1 = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Four t2 = __builtin_shufflevector(c, d, 0, 4, 1, 5), t3 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    out[0] = __builtin_shufflevector(t0, t2, 0, 1, 4, 5), out[1] = __builtin_shufflevector(t0, t2, 2, 3, 6, 7);
    out[2] = __builtin_shufflevector(t1, t3, 0, 1, 4, 5), out[3] = __builtin_shufflevector(t1, t3, 2, 3, 6, 7);
}

/// Four values of each of eight places, those of a kind together. `of(i)`: where those of lane i lie, at 16 bytes.
template <class Of>
JET_INLINE void gather(Of&& of, Eight& x, Eight& y, Eight& z, Eight& w)
{
    const auto row = [&](int i) { return *reinterpret_cast<const Four*>(of(i)); };
    Four low[4], high[4];
    transpose(row(0), row(1), row(2), row(3), low);
    transpose(row(4), row(5), row(6), row(7), high);
    const auto both = [&](int k) { return __builtin_shufflevector(low[k], high[k], 0, 1, 2, 3, 4, 5, 6, 7); };
    x = both(0), y = both(1), z = both(2), w = both(3);
}

JET_INLINE Eight root(const Eight& x)
{
#if defined(__AVX__)
    return (Eight)__builtin_ia32_sqrtps256(x);
#elif defined(__SSE__)
    const Four low = __builtin_ia32_sqrtps(__builtin_shufflevector(x, x, 0, 1, 2, 3)),
               high = __builtin_ia32_sqrtps(__builtin_shufflevector(x, x, 4, 5, 6, 7));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    Eight y;
    for (int i = 0; i < 8; ++i) y[i] = std::sqrt(x[i]);
    return y;
#endif
}

JET_INLINE Eight choose(const Bits& mask, const Eight& yes, const Eight& no)
{
    return (Eight)((mask & (Bits)yes) | (~mask & (Bits)no));
}
JET_INLINE std::uint32_t bitsOf(const Bits& mask)
{
#if defined(__AVX__)
    return static_cast<std::uint32_t>(__builtin_ia32_movmskps256((Eight)mask));
#else
    std::uint32_t bits = 0;
    for (int i = 0; i < 8; ++i) bits |= static_cast<std::uint32_t>(mask[i] & 1) << i;
    return bits;
#endif
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

/// Do the boxes of each pair meet?
JET_INLINE Bits meeting(const SiftInput& in, const RigidContact* const (&c)[8])
{
    Eight minX, minY, maxX, maxY, otherMinX, otherMinY, otherMaxX, otherMaxY;
    gather([&](int i) { return &in.boxes[c[i]->partA]; }, minX, minY, maxX, maxY);
    gather([&](int i) { return &in.boxes[c[i]->partB]; }, otherMinX, otherMinY, otherMaxX, otherMaxY);
    return (minX <= otherMaxX) & (otherMinX <= maxX) & (minY <= otherMaxY) & (otherMinY <= maxY);
}

std::uint32_t stayApart(const SiftInput& in, const Index* which, float* gaps)
{
    const RigidContact* c[8];
    const Pose *poseA[8], *poseB[8];
    float apartX[8], apartY[8];
    for (int i = 0; i < 8; ++i) {
        c[i] = &in.contacts[which[i]];
        poseA[i] = &in.poses[c[i]->bodyA], poseB[i] = &in.poses[c[i]->bodyB];
        apartX[i] = static_cast<float>(poseB[i]->x - poseA[i]->x),
        apartY[i] = static_cast<float>(poseB[i]->y - poseA[i]->y);
    }
    Eight dx, dy;
    for (int i = 0; i < 8; ++i) dx[i] = apartX[i], dy[i] = apartY[i];
    const Motions a = motionsOf(poseA), b = motionsOf(poseB);
    Eight oldX, oldY, oldCosine, oldSine, slop, gap, second, reach;
    gather([&](int i) { return &c[i]->at; }, oldX, oldY, oldCosine, oldSine);
    gather([&](int i) { return &c[i]->slop; }, slop, gap, second, reach);

    // Collider::closingSpeed()
    const Bits fromA = a.reach <= b.reach;
    const Eight omega = choose(fromA, b.omega, a.omega), arm = choose(fromA, a.reach, b.reach);
    const Eight slideX = b.velocityX - a.velocityX + omega * dy, slideY = b.velocityY - a.velocityY - omega * dx;
    const Eight spin = b.omega - a.omega, none = slop - slop;
    const Eight turning = choose(spin < none, -spin, spin);
    const Eight travel = (root(slideX * slideX + slideY * slideY) + turning * arm) * in.dt;

    // Collider::staysApart()
    const Eight movedX = a.cosine * dx + a.sine * dy - oldX, movedY = a.cosine * dy - a.sine * dx - oldY;
    const Eight turnedX = a.cosine * b.cosine + a.sine * b.sine - oldCosine,
                turnedY = a.cosine * b.sine - a.sine * b.cosine - oldSine;
    gap = gap - root(movedX * movedX + movedY * movedY) - root(turnedX * turnedX + turnedY * turnedY) * b.reach;
    for (int i = 0; i < 8; ++i) gaps[i] = gap[i];
    return bitsOf((gap > in.speculative * slop + travel) & meeting(in, c));
}

}  // namespace

extern const Sieve pairSieve;
const Sieve pairSieve{stayApart};
