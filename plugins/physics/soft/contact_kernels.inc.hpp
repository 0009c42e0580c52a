// The kernels of contact_kernels.hpp, included once by the file of each instruction set, in a namespace of its own.

namespace {

constexpr float kTouchSlops = 4;  // kTouchDepth of contact_point.hpp
constexpr float kIdleSlops = 8, kMostIdle = 8, kFarIdle = 6;
constexpr float kMostDrift = 1;  // slops an acting contact moves before it is looked at again
constexpr float kPushLengthsPerSecond = 4, kSlopsPerLength = 500;  // as of contact_solver.cpp

typedef float Four __attribute__((vector_size(16)));

JET_INLINE Floats all(float value) { return Floats{} + value; }
JET_INLINE Floats choose(const Flags& mask, const Floats& yes, const Floats& no)
{
    return (Floats)((mask & (Flags)yes) | (~mask & (Flags)no));
}
JET_INLINE Floats least(const Floats& a, const Floats& b) { return a < b ? a : b; }
JET_INLINE Floats most(const Floats& a, const Floats& b) { return a > b ? a : b; }
JET_INLINE Floats size(const Floats& a) { return most(a, -a); }
JET_INLINE Floats root(const Floats& a)
{
#ifdef __AVX2__
    return (Floats)_mm256_sqrt_ps((__m256)a);
#else
    const Four low = (Four)_mm_sqrt_ps((__m128)__builtin_shufflevector(a, a, 0, 1, 2, 3));
    const Four high = (Four)_mm_sqrt_ps((__m128)__builtin_shufflevector(a, a, 4, 5, 6, 7));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}
JET_INLINE unsigned bits(const Flags& mask)
{
#ifdef __AVX2__
    return static_cast<unsigned>(_mm256_movemask_ps((__m256)mask));
#else
    const __m128 low = (__m128)__builtin_shufflevector(mask, mask, 0, 1, 2, 3);
    const __m128 high = (__m128)__builtin_shufflevector(mask, mask, 4, 5, 6, 7);
    return static_cast<unsigned>(_mm_movemask_ps(low)) | (static_cast<unsigned>(_mm_movemask_ps(high)) << 4);
#endif
}

/// Of each contact: the particle from the wall's first end, and the wall's second end from its first.
struct Offsets {
    Floats x, y, edgeX, edgeY;
};

JET_INLINE Offsets offsets(const double* of, const ContactBlock& c)
{
    Four row[kWide];
    for (int i = 0; i < kWide; ++i) {
        const __m128d first = _mm_loadu_pd(of + 2 * static_cast<std::ptrdiff_t>(c.first[i]));
        const __m128d point = _mm_loadu_pd(of + 2 * static_cast<std::ptrdiff_t>(c.point[i]));
        const __m128d second = _mm_loadu_pd(of + 2 * static_cast<std::ptrdiff_t>(c.second[i]));
        row[i] = (Four)_mm_movelh_ps(_mm_cvtpd_ps(_mm_sub_pd(point, first)), _mm_cvtpd_ps(_mm_sub_pd(second, first)));
    }
    Floats pair[4];
    for (int i = 0; i < 4; ++i) pair[i] = __builtin_shufflevector(row[i], row[i + 4], 0, 1, 2, 3, 4, 5, 6, 7);
    const Floats t0 = __builtin_shufflevector(pair[0], pair[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const Floats t1 = __builtin_shufflevector(pair[0], pair[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const Floats t2 = __builtin_shufflevector(pair[2], pair[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const Floats t3 = __builtin_shufflevector(pair[2], pair[3], 2, 10, 3, 11, 6, 14, 7, 15);
    return {__builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15),
            __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15)};
}

/// Impulses along normal and tangent, on the particle, and against it on the ends of the wall. Many contacts act
/// without pushing; those are passed over.
JET_INLINE void exert(const ContactBlock& c, const Particles& particles, const Floats& normal, const Floats& tangent)
{
    const Floats x = normal * c.normalX - tangent * c.normalY, y = normal * c.normalY + tangent * c.normalX;
    // One pair after the other, x and y of a lane together.
    const Floats pairs[2] = {__builtin_shufflevector(x, y, 0, 8, 1, 9, 2, 10, 3, 11),
                             __builtin_shufflevector(x, y, 4, 12, 5, 13, 6, 14, 7, 15)};
    float impulses[2 * kWide], share[kWide];
    __builtin_memcpy(impulses, pairs, sizeof impulses);
    __builtin_memcpy(share, &c.along, sizeof share);
    const __m128d one = _mm_set1_pd(1);
    const Flags pushes = c.active & ((normal != Floats{}) | (tangent != Floats{}));
    for (unsigned rest = bits(pushes); rest != 0; rest &= rest - 1) {
        const int i = __builtin_ctz(rest);
        double pair = 0;
        __builtin_memcpy(&pair, impulses + 2 * i, sizeof pair);
        const __m128d impulse = _mm_cvtps_pd(_mm_castpd_ps(_mm_set_sd(pair)));
        const __m128d along = _mm_set1_pd(static_cast<double>(share[i]));
        const auto act = [&](std::int32_t node, __m128d by) {
            double* at = particles.velocity + 2 * static_cast<std::ptrdiff_t>(node);
            const __m128d change = _mm_mul_pd(_mm_set1_pd(particles.inverseMass[node]), by);
            _mm_storeu_pd(at, _mm_add_pd(_mm_loadu_pd(at), change));
        };
        const __m128d against = _mm_xor_pd(impulse, _mm_set1_pd(-0.0));
        act(c.point[i], impulse);
        act(c.first[i], _mm_mul_pd(_mm_sub_pd(one, along), against));
        act(c.second[i], _mm_mul_pd(along, against));
    }
}

JET_INLINE void decide(ContactBlock& c, const Offsets& at, const Offsets& moving, const ContactStep& step)
{
    const Floats zero{}, one = all(1), far = all(1e30F);
    const Floats squared = at.edgeX * at.edgeX + at.edgeY * at.edgeY;
    const Flags valid = (squared > all(1e-24F)) & (c.side != zero);
    const Floats length = root(squared), inverse = choose(valid, one / length, zero);
    const Floats wallX = -at.edgeY * c.side * inverse, wallY = at.edgeX * c.side * inverse;
    const Floats height = at.x * wallX + at.y * wallY;
    const Floats along = choose(valid, (at.x * at.edgeX + at.y * at.edgeY) / squared, zero);
    c.along = least(most(along, zero), one);

    // A thick border is round where two of its walls meet: there the corner itself is what is touched.
    const Flags thick = c.thickness > zero;
    const Floats distance = root(at.x * at.x + at.y * at.y);
    const Flags round = thick & (along < zero) & (height > zero) & (distance > all(1e-12F)) & ~c.inside;
    const Floats outX = choose(round, at.x / distance, wallX), outY = choose(round, at.y / distance, wallY);
    c.normalX = outX, c.normalY = outY;
    c.separation = choose(round, distance, height) - c.thickness;

    const Floats relativeX = moving.x - c.along * moving.edgeX, relativeY = moving.y - c.along * moving.edgeY;
    c.approach = relativeX * outX + relativeY * outY;
    const Floats slide = choose(valid, (relativeX * at.edgeX + relativeY * at.edgeY) / squared, zero);

    const Flags front = c.separation > zero;
    const Floats come = -c.approach * step.h;
    const Flags late = front & (c.separation > come + come + kTouchSlops * c.slop);
    const Floats part = least(one, choose(come > zero, c.separation / come, one));
    const Floats there = along + choose(front & (come > zero), slide * step.h * part, zero);
    const Floats firstReach = choose(thick, choose(round, far, zero), c.firstReach);
    const Floats secondReach = choose(thick, zero, c.secondReach);
    const Flags off = (there * length < -firstReach) | ((one - there) * length < -secondReach);
    const Flags behind = (c.separation + c.thickness < -kTouchSlops * c.slop) & ~c.engaged;
    const Flags met = valid & ~late & ~off & ~behind;
    c.engaged |= met;
    c.active = met | (valid & c.inside);

    const Floats rest = one - c.along;
    const Floats give = c.invPoint + rest * rest * c.invFirst + c.along * c.along * c.invSecond;
    c.mass = choose(give > zero, one / give, zero);
    // How far beside the wall, and how fast towards it or away.
    c.beside = choose(thick, (along - one) * length, most(-along, along - one) * length);
    c.passing = size(slide) * length;
    c.normalImpulse = choose(c.active, c.normalImpulse, zero);
    c.tangentImpulse = choose(c.active, c.tangentImpulse, zero);
}

/// For how many substeps those that do not act need not be looked at: what is far, and slow for that, may wait.
JET_INLINE std::int32_t idleFor(ContactBlock& c, const ContactStep& step)
{
    const Floats above = (c.separation - kIdleSlops * c.slop) / (4 * size(c.approach) * step.h + c.slop);
    const Floats beside = (c.beside - kIdleSlops * c.slop) / (4 * c.passing * step.h + c.slop);
    const Flags waits = (c.side != Floats{}) & ~c.active;
    const Floats wait = choose(waits, least(most(above, beside), all(kMostIdle)), all(kMostIdle));
    c.far = (wait >= all(kFarIdle)) & ~c.active;
    float shortest = kMostIdle;
    for (int i = 0; i < kWide; ++i) shortest = wait[i] < shortest ? wait[i] : shortest;
    return shortest > 1 ? static_cast<std::int32_t>(shortest) : 0;
}

/// Is there nothing to look at in this substep? What acts keeps its direction and its place on the wall until it has
/// moved so far that they have changed.
JET_INLINE bool isAsItWas(ContactBlock& c)
{
    if (c.idle == 0) return false;
    --c.idle;
    return !c.any || bits(c.active & (c.drift > kMostDrift * c.slop)) == 0;
}

void refresh(ContactBlock* blocks, std::size_t count, const Particles& particles, const ContactStep& step)
{
    for (std::size_t i = 0; i < count; ++i) {
        ContactBlock& c = blocks[i];
        if (isAsItWas(c)) continue;
        decide(c, offsets(particles.position, c), offsets(particles.velocity, c), step);
        c.any = bits(c.active) != 0;
        c.elastic = bits(c.active & (c.restitution > Floats{})) != 0;
        c.bounces = false;
        c.idle = idleFor(c, step);
        c.drift = Floats{};
    }
}

void meet(ContactBlock* blocks, std::size_t count, const Particles& particles, float restSpeed)
{
    for (std::size_t i = 0; i < count; ++i) {
        ContactBlock& c = blocks[i];
        if (!c.any || !c.elastic) continue;
        const Offsets moving = offsets(particles.velocity, c);
        c.approach = (moving.x - c.along * moving.edgeX) * c.normalX + (moving.y - c.along * moving.edgeY) * c.normalY;
        c.bounces = bits(c.active & (c.restitution > Floats{}) & (c.approach < all(-restSpeed))) != 0;
    }
}

void warm(const ContactBlock* blocks, std::size_t count, const Particles& particles)
{
    for (std::size_t i = 0; i < count; ++i)
        if (blocks[i].any) exert(blocks[i], particles, blocks[i].normalImpulse, blocks[i].tangentImpulse);
}

JET_INLINE void solveOne(ContactBlock& c, const Particles& particles, const ContactStep& step, bool push)
{
    const Floats zero{}, one = all(1);
    const Offsets moving = offsets(particles.velocity, c);
    const Floats relativeX = moving.x - c.along * moving.edgeX, relativeY = moving.y - c.along * moving.edgeY;
    const Floats speed = relativeX * c.normalX + relativeY * c.normalY;
    const Floats slide = relativeY * c.normalX - relativeX * c.normalY;
    if (!push) {
        c.separation += step.h * speed;
        c.drift += step.h * (size(slide) + size(moving.edgeX) + size(moving.edgeY));
    }
    const Flags apart = c.separation > zero;
    Floats bias = choose(apart, c.separation * step.inverseH, zero), massScale = one, impulseScale = zero;
    if (push) {
        const Floats rate = choose(c.still, all(step.still.biasRate), all(step.moving.biasRate));
        const Floats fastest = -kPushLengthsPerSecond * kSlopsPerLength * c.slop;
        bias = choose(apart, bias, most(rate * least(zero, c.separation + c.slop), fastest));
        massScale = choose(apart, one, choose(c.still, all(step.still.massScale), all(step.moving.massScale)));
        impulseScale =
            choose(apart, zero, choose(c.still, all(step.still.impulseScale), all(step.moving.impulseScale)));
    }
    const Floats wanted = -c.mass * massScale * (speed + bias) - impulseScale * c.normalImpulse;
    const Floats normal = choose(c.active, most(c.normalImpulse + wanted, zero), zero);
    const Floats grip = c.friction * normal;
    const Floats tangent = choose(c.active, most(least(c.tangentImpulse - c.mass * slide, grip), -grip), zero);
    exert(c, particles, normal - c.normalImpulse, tangent - c.tangentImpulse);
    c.normalImpulse = normal;
    c.tangentImpulse = tangent;
    if (!push) c.stepImpulse += normal;
}

void solve(ContactBlock* blocks, std::size_t count, const Particles& particles, const ContactStep& step, bool push)
{
    for (std::size_t i = 0; i < count; ++i)
        if (blocks[i].any) solveOne(blocks[i], particles, step, push);
}

void bounce(ContactBlock* blocks, std::size_t count, const Particles& particles, float restSpeed)
{
    const Floats zero{};
    for (std::size_t i = 0; i < count; ++i) {
        ContactBlock& c = blocks[i];
        if (!c.bounces) continue;
        const Offsets moving = offsets(particles.velocity, c);
        const Floats relativeX = moving.x - c.along * moving.edgeX, relativeY = moving.y - c.along * moving.edgeY;
        const Flags thrown =
            c.active & (c.restitution > zero) & (c.approach < all(-restSpeed)) & (c.normalImpulse > zero);
        const Floats missing = relativeX * c.normalX + relativeY * c.normalY + c.restitution * c.approach;
        const Floats impulse = choose(thrown, most(c.normalImpulse - c.mass * missing, zero), c.normalImpulse);
        const Floats change = impulse - c.normalImpulse;
        exert(c, particles, change, zero);
        c.stepImpulse += change;
        c.normalImpulse = impulse;
    }
}

NearResult survey(const WallBlock* blocks, std::size_t count, const NearQuery& query, std::uint8_t* near)
{
    const Floats zero{}, one = all(1), x = all(query.x), y = all(query.y);
    NearResult result;
    unsigned crossings = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const WallBlock& w = blocks[i];
        near[i] = 0;
        const bool level = query.y >= w.top && query.y <= w.bottom && query.x <= w.right;
        const bool beside = query.x >= w.left - query.reach && query.x <= w.right + query.reach &&
                            query.y >= w.top - query.reach && query.y <= w.bottom + query.reach;
        if (!level && !beside) continue;
        const Floats offX = x - w.x, offY = y - w.y;
        if (level) {
            const Flags straddles = (w.y > y) ^ (w.y + w.edgeY > y);
            crossings += static_cast<unsigned>(__builtin_popcount(bits(straddles & (x < w.x + offY * w.slope))));
        }
        if (!beside) continue;
        const Floats raw = (offX * w.edgeX + offY * w.edgeY) * w.inverseSquare, over = raw - one;
        const Floats along = least(most(raw, zero), one);
        const Flags past = (over > zero) & (over * over > all(query.slide * query.slide) * w.inverseSquare);
        const Floats awayX = offX - along * w.edgeX, awayY = offY - along * w.edgeY;
        const Floats away = awayX * awayX + awayY * awayY;
        const Flags front = offX * w.normalX + offY * w.normalY >= all(-query.behind);
        near[i] = static_cast<std::uint8_t>(bits(front & ~past & (away <= all(query.reach * query.reach))));
        result.onSurface |= bits(front & (away <= all(query.behind * query.behind))) != 0;
    }
    result.inside = (crossings & 1) != 0;
    return result;
}

}  // namespace

const ContactKernels contacts{&refresh, &meet, &warm, &solve, &bounce, &survey};
