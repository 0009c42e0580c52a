// The solver's kernels, compiled once for each instruction set: kernels_sse2.cpp and kernels_avx2.cpp include this in a
// namespace of their own. "Soft Step" (Catto 2024, https://box2d.org/posts/2024/02/solver2d/): see solver_data.hpp.

namespace {

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
    std::uint32_t bits = 0;
    for (int i = 0; i < kLanes<Real>; ++i) bits |= static_cast<std::uint32_t>(mask[i] & 1) << i;
    return bits;
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

template <class Real>
JET_INLINE Lanes<Real> magnitude(const Lanes<Real>& value)
{
    return most(value, Lanes<Real>(-value));
}

/// The states of a group's bodies, one value of each lane together.
template <class Real>
struct BodyLanes {
    Lanes<Real> velocityX, velocityY, spin, invMass;
};
template <class Real>
struct MoveLanes {
    Lanes<Real> moveX, moveY, sweep, perGyration;
};

typedef float Four __attribute__((vector_size(16), may_alias));

/// Rows of four values of eight bodies to four rows of eight: within the halves of a register, as AVX2 shuffles best.
JET_INLINE void transpose(const Lanes<float> (&c)[4], Lanes<float>& x, Lanes<float>& y, Lanes<float>& z,
                          Lanes<float>& w)
{
    const Lanes<float> t0 = __builtin_shufflevector(c[0], c[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const Lanes<float> t1 = __builtin_shufflevector(c[0], c[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const Lanes<float> t2 = __builtin_shufflevector(c[2], c[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const Lanes<float> t3 = __builtin_shufflevector(c[2], c[3], 2, 10, 3, 11, 6, 14, 7, 15);
    x = __builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13);
    y = __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15);
    z = __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13);
    w = __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15);
}

#if defined(__AVX2__)
JET_INLINE void gather(const BodyState<float>* bodies, const std::int32_t* index, std::size_t half, Lanes<float>& x,
                       Lanes<float>& y, Lanes<float>& z, Lanes<float>& w)
{
    Lanes<float> c[4];
    for (int i = 0; i < 4; ++i) {
        const Four low = reinterpret_cast<const Four*>(&bodies[index[i]])[half];
        const Four high = reinterpret_cast<const Four*>(&bodies[index[i + 4]])[half];
        c[i] = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
    }
    transpose(c, x, y, z, w);
}

JET_INLINE void scatter(BodyState<float>* bodies, const std::int32_t* index, const BodyLanes<float>& s)
{
    const Lanes<float> t0 = __builtin_shufflevector(s.velocityX, s.velocityY, 0, 8, 1, 9, 4, 12, 5, 13);
    const Lanes<float> t1 = __builtin_shufflevector(s.velocityX, s.velocityY, 2, 10, 3, 11, 6, 14, 7, 15);
    const Lanes<float> t2 = __builtin_shufflevector(s.spin, s.invMass, 0, 8, 1, 9, 4, 12, 5, 13);
    const Lanes<float> t3 = __builtin_shufflevector(s.spin, s.invMass, 2, 10, 3, 11, 6, 14, 7, 15);
    const Lanes<float> c[4] = {__builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13),
                               __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15),
                               __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13),
                               __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15)};
    // What never moves may be in many groups, of other threads, too.
    const int moving = __builtin_ia32_movmskps256((Lanes<float>)(s.invMass != Lanes<float>{}));
    for (int i = 0; i < 4; ++i) {
        if (moving == 0xff || (moving >> i & 1) != 0)
            *reinterpret_cast<Four*>(&bodies[index[i]]) = __builtin_shufflevector(c[i], c[i], 0, 1, 2, 3);
        if (moving == 0xff || (moving >> (i + 4) & 1) != 0)
            *reinterpret_cast<Four*>(&bodies[index[i + 4]]) = __builtin_shufflevector(c[i], c[i], 4, 5, 6, 7);
    }
}

#else
/// Without registers of eight, shuffles of eight are taken apart value by value; these stay within fours.
JET_INLINE void transpose(const Four& a, const Four& b, const Four& c, const Four& d, Four (&out)[4])
{
    const Four t0 = __builtin_shufflevector(a, b, 0, 4, 1, 5), t1 = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Four t2 = __builtin_shufflevector(c, d, 0, 4, 1, 5), t3 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    out[0] = __builtin_shufflevector(t0, t2, 0, 1, 4, 5), out[1] = __builtin_shufflevector(t0, t2, 2, 3, 6, 7);
    out[2] = __builtin_shufflevector(t1, t3, 0, 1, 4, 5), out[3] = __builtin_shufflevector(t1, t3, 2, 3, 6, 7);
}

JET_INLINE void gather(const BodyState<float>* bodies, const std::int32_t* index, std::size_t half, Lanes<float>& x,
                       Lanes<float>& y, Lanes<float>& z, Lanes<float>& w)
{
    Lanes<float>* const rows[4] = {&x, &y, &z, &w};
    for (int side = 0; side < 2; ++side) {
        const auto of = [&](int i) { return reinterpret_cast<const Four*>(&bodies[index[4 * side + i]])[half]; };
        Four out[4];
        transpose(of(0), of(1), of(2), of(3), out);
        for (int row = 0; row < 4; ++row) reinterpret_cast<Four*>(rows[row])[side] = out[row];
    }
}

JET_INLINE void scatter(BodyState<float>* bodies, const std::int32_t* index, const BodyLanes<float>& s)
{
    for (int side = 0; side < 2; ++side) {
        const auto of = [&](const Lanes<float>& row) { return reinterpret_cast<const Four*>(&row)[side]; };
        Four out[4];
        transpose(of(s.velocityX), of(s.velocityY), of(s.spin), of(s.invMass), out);
        for (int i = 0; i < 4; ++i) {
            BodyState<float>& body = bodies[index[4 * side + i]];
            if (body.invMass != 0) *reinterpret_cast<Four*>(&body) = out[i];
        }
    }
}
#endif

JET_INLINE void gather(const BodyState<double>* bodies, const std::int32_t* index, std::size_t half, Lanes<double>& x,
                       Lanes<double>& y, Lanes<double>& z, Lanes<double>& w)
{
    const Lanes<double> c0 = reinterpret_cast<const Lanes<double>*>(&bodies[index[0]])[half];
    const Lanes<double> c1 = reinterpret_cast<const Lanes<double>*>(&bodies[index[1]])[half];
    const Lanes<double> c2 = reinterpret_cast<const Lanes<double>*>(&bodies[index[2]])[half];
    const Lanes<double> c3 = reinterpret_cast<const Lanes<double>*>(&bodies[index[3]])[half];
    const Lanes<double> t0 = __builtin_shufflevector(c0, c1, 0, 4, 2, 6),
                        t1 = __builtin_shufflevector(c0, c1, 1, 5, 3, 7);
    const Lanes<double> t2 = __builtin_shufflevector(c2, c3, 0, 4, 2, 6),
                        t3 = __builtin_shufflevector(c2, c3, 1, 5, 3, 7);
    x = __builtin_shufflevector(t0, t2, 0, 1, 4, 5);
    y = __builtin_shufflevector(t1, t3, 0, 1, 4, 5);
    z = __builtin_shufflevector(t0, t2, 2, 3, 6, 7);
    w = __builtin_shufflevector(t1, t3, 2, 3, 6, 7);
}

JET_INLINE void scatter(BodyState<double>* bodies, const std::int32_t* index, const BodyLanes<double>& s)
{
    for (int i = 0; i < 4; ++i) {
        BodyState<double>& body = bodies[index[i]];
        if (body.invMass == 0) continue;
        body.velocityX = s.velocityX[i], body.velocityY = s.velocityY[i], body.spin = s.spin[i];
    }
}

template <class Real>
JET_INLINE BodyLanes<Real> velocities(const BodyState<Real>* bodies, const std::int32_t* index)
{
    BodyLanes<Real> s;
    gather(bodies, index, 0, s.velocityX, s.velocityY, s.spin, s.invMass);
    return s;
}
template <class Real>
JET_INLINE MoveLanes<Real> moves(const BodyState<Real>* bodies, const std::int32_t* index)
{
    MoveLanes<Real> s;
    gather(bodies, index, 1, s.moveX, s.moveY, s.sweep, s.perGyration);
    return s;
}

/// An impulse along a direction with its levers; on B, and against it on A.
template <class Real>
JET_INLINE void push(BodyLanes<Real>& a, BodyLanes<Real>& b, const Lanes<Real>& x, const Lanes<Real>& y,
                     const Lanes<Real>& leverA, const Lanes<Real>& leverB, const Lanes<Real>& impulse)
{
    const Lanes<Real> changeA = a.invMass * impulse, changeB = b.invMass * impulse;
    a.velocityX -= changeA * x, a.velocityY -= changeA * y, a.spin -= changeA * leverA;
    b.velocityX += changeB * x, b.velocityY += changeB * y, b.spin += changeB * leverB;
}

template <class Real>
JET_INLINE Lanes<Real> speedAlong(const BodyLanes<Real>& a, const BodyLanes<Real>& b, const Lanes<Real>& x,
                                  const Lanes<Real>& y, const Lanes<Real>& leverA, const Lanes<Real>& leverB)
{
    return x * (b.velocityX - a.velocityX) + y * (b.velocityY - a.velocityY) + leverB * b.spin - leverA * a.spin;
}

template <class Real>
void warmContacts(BodyState<Real>* bodies, const ContactLanes<Real>* groups, const FrictionLanes<Real>* frictions,
                  std::size_t count)
{
    for (std::size_t g = 0; g < count; ++g) {
        const ContactLanes<Real>& c = groups[g];
        const FrictionLanes<Real>& f = frictions[g];
        BodyLanes<Real> a = velocities(bodies, c.a), b = velocities(bodies, c.b);
        for (int k = 0; k < 2; ++k) {
            const auto& p = c.points[k];
            const auto& q = f.points[k];
            push<Real>(a, b, c.normalX, c.normalY, p.leverA, p.leverB, p.impulse);
            push<Real>(a, b, -c.normalY, c.normalX, q.leverA, q.leverB, q.impulse);
        }
        scatter(bodies, c.a, a);
        scatter(bodies, c.b, b);
    }
}

/// The two points of a group's contacts, one after the other. What the first is given changes the speed of the second
/// by the inverse mass they share, so the bodies need to be pushed but once, by both; a pass waits for little else than
/// such chains of results.
template <class Real>
struct Pair {
    const BodyLanes<Real>&a, &b;
    const Lanes<Real>&leverA0, &leverB0, &leverA1, &leverB1;

    template <class Point>
    JET_INLINE Pair(const BodyLanes<Real>& bodyA, const BodyLanes<Real>& bodyB, const Point (&points)[2])
        : a(bodyA), b(bodyB), leverA0(points[0].leverA), leverB0(points[0].leverB), leverA1(points[1].leverA),
          leverB1(points[1].leverB)
    {
    }
    /// Speeds of the points, where the centres have the speed `linear`.
    JET_INLINE Lanes<Real> first(const Lanes<Real>& linear) const
    {
        return linear + (leverB0 * b.spin - leverA0 * a.spin);
    }
    JET_INLINE Lanes<Real> second(const Lanes<Real>& linear, const Lanes<Real>& givenToFirst) const
    {
        const Lanes<Real> shared =
            a.invMass + b.invMass + a.invMass * (leverA0 * leverA1) + b.invMass * (leverB0 * leverB1);
        return linear + (leverB1 * b.spin - leverA1 * a.spin) + shared * givenToFirst;
    }
    static JET_INLINE void turn(BodyLanes<Real>& a, BodyLanes<Real>& b, const Pair& p, const Lanes<Real>& first,
                                const Lanes<Real>& second)
    {
        a.spin -= a.invMass * (p.leverA0 * first + p.leverA1 * second);
        b.spin += b.invMass * (p.leverB0 * first + p.leverB1 * second);
    }
};

/// Gives the points what `wanted` says of a point and its speed, but never pulls; the sum of the changes.
template <class Real, class Wanted>
JET_INLINE Lanes<Real> pushNormals(ContactLanes<Real>& c, BodyLanes<Real>& a, BodyLanes<Real>& b,
                                   const Lanes<Real>& linear, const Lanes<Real>& zero, const Wanted& wanted)
{
    const Pair<Real> pair(a, b, c.points);
    const auto give = [&](auto& p, const Lanes<Real>& speed) JET_INLINED {
        const Lanes<Real> impulse = most(wanted(p, speed), zero), change = impulse - p.impulse;
        p.impulse = impulse;
        return change;
    };
    const Lanes<Real> first = give(c.points[0], pair.first(linear));
    const Lanes<Real> second = give(c.points[1], pair.second(linear, first));
    Pair<Real>::turn(a, b, pair, first, second);
    return first + second;
}

template <class Real>
JET_INLINE Lanes<Real> relaxNormals(ContactLanes<Real>& c, BodyLanes<Real>& a, BodyLanes<Real>& b,
                                    const Lanes<Real>& linear, const Lanes<Real>& zero, const StepConstants<Real>& step)
{
    return pushNormals<Real>(c, a, b, linear, zero, [&](const auto& p, const Lanes<Real>& speed) JET_INLINED {
        return p.impulse - p.mass * (speed + most(p.now, zero) * step.inverseH);
    });
}

template <class Real>
JET_INLINE void shove(BodyLanes<Real>& a, BodyLanes<Real>& b, const Lanes<Real>& x, const Lanes<Real>& y)
{
    a.velocityX -= a.invMass * x, a.velocityY -= a.invMass * y;
    b.velocityX += b.invMass * x, b.velocityY += b.invMass * y;
}

template <class Real>
void solveContacts(BodyState<Real>* bodies, ContactLanes<Real>* groups, std::size_t count,
                   const StepConstants<Real>& step)
{
    const Lanes<Real> zero = all<Real>(0), one = all<Real>(1);
    for (std::size_t g = 0; g < count; ++g) {
        ContactLanes<Real>& c = groups[g];
        BodyLanes<Real> a = velocities(bodies, c.a), b = velocities(bodies, c.b);
        const Mask<Real> still = (a.invMass == zero) | (b.invMass == zero);
        const Lanes<Real> rate = choose<Real>(still, all(step.still.biasRate), all(step.moving.biasRate));
        const Lanes<Real> massScale = choose<Real>(still, all(step.still.massScale), all(step.moving.massScale));
        const Lanes<Real> impulseScale =
            choose<Real>(still, all(step.still.impulseScale), all(step.moving.impulseScale));
        const Lanes<Real> linear = c.normalX * (b.velocityX - a.velocityX) + c.normalY * (b.velocityY - a.velocityY);
        const Lanes<Real> given =
            pushNormals<Real>(c, a, b, linear, zero, [&](const auto& p, const Lanes<Real>& speed) JET_INLINED {
                const Mask<Real> apart = p.now > zero;
                const Lanes<Real> bias = choose<Real>(apart, p.now * step.inverseH, most(rate * p.now, -c.mostPush));
                const Lanes<Real> kept = p.impulse - choose<Real>(apart, zero, impulseScale) * p.impulse;
                return kept - p.mass * choose<Real>(apart, one, massScale) * (speed + bias);
            });
        shove<Real>(a, b, c.normalX * given, c.normalY * given);
        scatter(bodies, c.a, a);
        scatter(bodies, c.b, b);
    }
}

/// Relaxes normals alone, where the bodies are now.
template <class Real>
void calmContacts(BodyState<Real>* bodies, ContactLanes<Real>* groups, std::size_t count,
                  const StepConstants<Real>& step)
{
    const Lanes<Real> zero = all<Real>(0);
    for (std::size_t g = 0; g < count; ++g) {
        ContactLanes<Real>& c = groups[g];
        BodyLanes<Real> a = velocities(bodies, c.a), b = velocities(bodies, c.b);
        const MoveLanes<Real> moveA = moves(bodies, c.a), moveB = moves(bodies, c.b);
        const Lanes<Real> moved = c.normalX * (moveB.moveX - moveA.moveX) + c.normalY * (moveB.moveY - moveA.moveY);
        for (auto& p : c.points) p.now = p.separation + moved + p.leverB * moveB.sweep - p.leverA * moveA.sweep;
        const Lanes<Real> linear = c.normalX * (b.velocityX - a.velocityX) + c.normalY * (b.velocityY - a.velocityY);
        const Lanes<Real> given = relaxNormals<Real>(c, a, b, linear, zero, step);
        shove<Real>(a, b, c.normalX * given, c.normalY * given);
        scatter(bodies, c.a, a);
        scatter(bodies, c.b, b);
    }
}

template <class Real>
void relaxContacts(BodyState<Real>* bodies, ContactLanes<Real>* groups, FrictionLanes<Real>* frictions,
                   std::size_t count, const StepConstants<Real>& step)
{
    const Lanes<Real> zero = all<Real>(0);
    for (std::size_t g = 0; g < count; ++g) {
        ContactLanes<Real>& c = groups[g];
        FrictionLanes<Real>& f = frictions[g];
        BodyLanes<Real> a = velocities(bodies, c.a), b = velocities(bodies, c.b);
        const Lanes<Real> towardsX = b.velocityX - a.velocityX, towardsY = b.velocityY - a.velocityY;
        // The tangent is the normal turned to the left. Friction does not change speeds of centres along the normal.
        const Lanes<Real> along = c.normalX * towardsY - c.normalY * towardsX;
        const Lanes<Real> linear = c.normalX * towardsX + c.normalY * towardsY;
        const Pair<Real> pair(a, b, f.points);
        const auto rub = [&](int k, const Lanes<Real>& slide) JET_INLINED {
            auto& q = f.points[k];
            const Lanes<Real> limit = f.friction * c.points[k].impulse;
            const Lanes<Real> impulse = least(most(q.impulse - q.mass * slide, -limit), limit);
            const Lanes<Real> change = impulse - q.impulse;
            q.impulse = impulse;
            return change;
        };
        const Lanes<Real> first = rub(0, pair.first(along)), second = rub(1, pair.second(along, first));
        Pair<Real>::turn(a, b, pair, first, second);
        const Lanes<Real> rubbed = first + second, given = relaxNormals<Real>(c, a, b, linear, zero, step);
        shove<Real>(a, b, c.normalX * given - c.normalY * rubbed, c.normalY * given + c.normalX * rubbed);
        for (int k = 0; k < 2; ++k)
            f.points[k].total = step.totalKept * f.points[k].total + step.totalAdded * c.points[k].impulse;
        scatter(bodies, c.a, a);
        scatter(bodies, c.b, b);
    }
}

template <class Real>
void approachContacts(const BodyState<Real>* bodies, const ContactLanes<Real>* groups, BounceLanes<Real>* bounces,
                      std::size_t count)
{
    for (std::size_t g = 0; g < count; ++g) {
        const ContactLanes<Real>& c = groups[g];
        const BodyLanes<Real> a = velocities(bodies, c.a), b = velocities(bodies, c.b);
        for (int k = 0; k < 2; ++k) {
            const auto& p = c.points[k];
            bounces[g].approach[k] = speedAlong<Real>(a, b, c.normalX, c.normalY, p.leverA, p.leverB);
        }
    }
}

template <class Real>
void scaleContacts(ContactLanes<Real>* groups, FrictionLanes<Real>* frictions, std::size_t count, Real by)
{
    for (std::size_t g = 0; g < count; ++g)
        for (int k = 0; k < 2; ++k) groups[g].points[k].impulse *= by, frictions[g].points[k].impulse *= by;
}

template <class Real>
void carryContacts(ContactLanes<Real>* groups, const FrictionLanes<Real>* frictions, std::uint32_t* bits,
                   std::size_t count)
{
    const Lanes<Real> zero = all<Real>(0);
    for (std::size_t g = 0; g < count; ++g) {
        for (auto& p : groups[g].points) p.separation = p.now;
        bits[g] = bitsOf<Real>(most(frictions[g].points[0].total, frictions[g].points[1].total) > zero);
    }
}

/// The two points of a contact share its bounce: a pass leaves at most a quarter of what the one before left wrong.
constexpr int kPairPasses = 6;

template <class Real>
void bounceContacts(BodyState<Real>* bodies, ContactLanes<Real>* groups, FrictionLanes<Real>* frictions,
                    const BounceLanes<Real>* bounces, std::size_t count, const StepConstants<Real>& step)
{
    const Lanes<Real> zero = all<Real>(0);
    for (std::size_t g = 0; g < count; ++g) {
        ContactLanes<Real>& c = groups[g];
        FrictionLanes<Real>& f = frictions[g];
        const BounceLanes<Real>& r = bounces[g];
        Mask<Real> bouncing[2];
        for (int k = 0; k < 2; ++k)
            bouncing[k] = (r.restitution > zero) & (r.approach[k] < -step.restSpeed) & (f.points[k].total > zero);
        if (bitsOf<Real>(bouncing[0] | bouncing[1]) == 0) continue;
        BodyLanes<Real> a = velocities(bodies, c.a), b = velocities(bodies, c.b);
        for (int k = 0; k < 2 * kPairPasses; ++k) {
            auto& p = c.points[k % 2];
            const Lanes<Real> speed = speedAlong<Real>(a, b, c.normalX, c.normalY, p.leverA, p.leverB);
            const Lanes<Real> wanted = most(p.impulse - p.mass * (speed + r.restitution * r.approach[k % 2]), zero);
            const Lanes<Real> change = choose<Real>(bouncing[k % 2], wanted - p.impulse, zero);
            p.impulse += change;
            f.points[k % 2].total += change;
            push<Real>(a, b, c.normalX, c.normalY, p.leverA, p.leverB, change);
        }
        scatter(bodies, c.a, a);
        scatter(bodies, c.b, b);
    }
}

/// Arms in radii of gyration, and what is done with them.
template <class Real>
struct Arms {
    Lanes<Real> ax, ay, bx, by;

    Arms(const JointLanes<Real>& j, const MoveLanes<Real>& moveA, const MoveLanes<Real>& moveB)
        : ax(moveA.perGyration * j.armAX), ay(moveA.perGyration * j.armAY), bx(moveB.perGyration * j.armBX),
          by(moveB.perGyration * j.armBY)
    {
    }
    JET_INLINE void pull(BodyLanes<Real>& a, BodyLanes<Real>& b, const Lanes<Real>& x, const Lanes<Real>& y) const
    {
        a.velocityX -= a.invMass * x, a.velocityY -= a.invMass * y, a.spin -= a.invMass * (ax * y - ay * x);
        b.velocityX += b.invMass * x, b.velocityY += b.invMass * y, b.spin += b.invMass * (bx * y - by * x);
    }
};

template <class Real>
void warmJoints(BodyState<Real>* bodies, const JointLanes<Real>* groups, std::size_t count)
{
    for (std::size_t g = 0; g < count; ++g) {
        const JointLanes<Real>& j = groups[g];
        BodyLanes<Real> a = velocities(bodies, j.a), b = velocities(bodies, j.b);
        const Arms<Real> arms(j, moves(bodies, j.a), moves(bodies, j.b));
        arms.pull(a, b, j.impulseX, j.impulseY);
        scatter(bodies, j.a, a);
        scatter(bodies, j.b, b);
    }
}

template <class Real>
void foreseeJoints(const BodyState<Real>* bodies, JointLanes<Real>* groups, std::size_t count,
                   const StepConstants<Real>& step)
{
    // A body that turns by more than a radian a substep is not foreseen farther than that.
    const Lanes<Real> zero = all<Real>(0), half = all(step.h / 2), most = all(step.inverseH / 2);
    constexpr Real kHeld = Real(0.1);
    for (std::size_t g = 0; g < count; ++g) {
        JointLanes<Real>& j = groups[g];
        const BodyLanes<Real> a = velocities(bodies, j.a), b = velocities(bodies, j.b);
        const MoveLanes<Real> moveA = moves(bodies, j.a), moveB = moves(bodies, j.b);
        const Lanes<Real> omegaA = moveA.perGyration * a.spin, omegaB = moveB.perGyration * b.spin;
        const Lanes<Real> inwardA = least(half * omegaA * omegaA, most);
        const Lanes<Real> inwardB = least(half * omegaB * omegaB, most);
        const Lanes<Real> aroundAX = -omegaA * j.armAY, aroundAY = omegaA * j.armAX;
        const Lanes<Real> aroundBX = -omegaB * j.armBY, aroundBY = omegaB * j.armBX;
        const Lanes<Real> apartX = b.velocityX + aroundBX - a.velocityX - aroundAX;
        const Lanes<Real> apartY = b.velocityY + aroundBY - a.velocityY - aroundAY;
        const Lanes<Real> turning =
            aroundAX * aroundAX + aroundAY * aroundAY + aroundBX * aroundBX + aroundBY * aroundBY;
        const Mask<Real> held = apartX * apartX + apartY * apartY <= kHeld * kHeld * turning;
        j.bendX = choose<Real>(held, inwardA * j.armAX - inwardB * j.armBX, zero);
        j.bendY = choose<Real>(held, inwardA * j.armAY - inwardB * j.armBY, zero);
    }
}

template <class Real>
void solveJoints(BodyState<Real>* bodies, JointLanes<Real>* groups, std::size_t count, const StepConstants<Real>& step,
                 bool pushes)
{
    const Lanes<Real> rate = all(pushes ? step.joint.biasRate : Real(0)), bends = all(Real(pushes ? 1 : 0));
    const Lanes<Real> massScale = all(pushes ? step.joint.massScale : Real(1));
    const Lanes<Real> impulseScale = all(pushes ? step.joint.impulseScale : Real(0));
    for (std::size_t g = 0; g < count; ++g) {
        JointLanes<Real>& j = groups[g];
        BodyLanes<Real> a = velocities(bodies, j.a), b = velocities(bodies, j.b);
        const MoveLanes<Real> moveA = moves(bodies, j.a), moveB = moves(bodies, j.b);
        const Arms<Real> arms(j, moveA, moveB);
        const Lanes<Real> biasX = rate * j.errorX + bends * j.bendX, biasY = rate * j.errorY + bends * j.bendY;
        const Lanes<Real> speedX = b.velocityX - a.velocityX - b.spin * arms.by + a.spin * arms.ay + biasX;
        const Lanes<Real> speedY = b.velocityY - a.velocityY + b.spin * arms.bx - a.spin * arms.ax + biasY;
        const Lanes<Real> x = -massScale * (j.inverseXX * speedX + j.inverseXY * speedY) - impulseScale * j.impulseX;
        const Lanes<Real> y = -massScale * (j.inverseXY * speedX + j.inverseYY * speedY) - impulseScale * j.impulseY;
        j.impulseX += x, j.impulseY += y;
        arms.pull(a, b, x, y);
        scatter(bodies, j.a, a);
        scatter(bodies, j.b, b);
    }
}

/// Taylor's, of the angle squared: up to x^13 of the sine over x, and x^14 of the cosine.
constexpr double kSine[] = {1.0 / 6227020800, -1.0 / 39916800, 1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6, 1};
constexpr double kCosine[] = {-1.0 / 87178291200, 1.0 / 479001600, -1.0 / 3628800, 1.0 / 40320,
                              -1.0 / 720,         1.0 / 24,        -1.0 / 2,       1};

template <class Real, std::size_t count>
JET_INLINE Lanes<Real> polynomial(const Lanes<Real>& z, const double (&terms)[count])
{
    Lanes<Real> sum = all(static_cast<Real>(terms[0]));
    for (std::size_t i = 1; i < count; ++i) sum = sum * z + static_cast<Real>(terms[i]);
    return sum;
}

/// Those of a quarter of the angle, doubled twice; within 1e-12, and the same bits everywhere.
template <class Real>
JET_INLINE void directionOf(const Lanes<Real>& angle, Lanes<Real>& cosine, Lanes<Real>& sine)
{
    constexpr Real kFullTurn = Real(6.283185307179586);
    constexpr Real kRounds = sizeof(Real) == 4 ? Real(12582912) : Real(6755399441055744);  // adding it rounds
    const Lanes<Real> turns = angle * (1 / kFullTurn) + kRounds - kRounds;
    const Lanes<Real> x = Real(0.25) * (angle - kFullTurn * turns), z = x * x;
    sine = x * polynomial<Real>(z, kSine), cosine = polynomial<Real>(z, kCosine);
    for (int doubled = 0; doubled < 2; ++doubled) {
        const Lanes<Real> half = sine;
        sine = 2 * half * cosine, cosine = 1 - 2 * half * half;
    }
}

template <class Real>
void turnJoints(const BodyState<Real>* bodies, BodyPush<Real>* pushes, JointLanes<Real>* groups, std::size_t count,
                const StepConstants<Real>& step)
{
    const Lanes<Real> zero = all<Real>(0), one = all<Real>(1), half = all(Real(0.5));
    constexpr Real kFar = Real(0.05), kWhirl = Real(0.25);
    for (std::size_t g = 0; g < count; ++g) {
        JointLanes<Real>& j = groups[g];
        const BodyLanes<Real> a = velocities(bodies, j.a), b = velocities(bodies, j.b);
        const MoveLanes<Real> moveA = moves(bodies, j.a), moveB = moves(bodies, j.b);
        Lanes<Real> c, s;
        directionOf<Real>(moveA.sweep * moveA.perGyration, c, s);
        Lanes<Real> ax = c * j.startAX - s * j.startAY, ay = s * j.startAX + c * j.startAY;
        directionOf<Real>(moveB.sweep * moveB.perGyration, c, s);
        Lanes<Real> bx = c * j.startBX - s * j.startBY, by = s * j.startBX + c * j.startBY;
        j.errorX = j.startErrorX + (moveB.moveX - moveA.moveX) + (bx - j.startBX) - (ax - j.startAX);
        j.errorY = j.startErrorY + (moveB.moveY - moveA.moveY) + (by - j.startBY) - (ay - j.startAY);
        // Impulses act in one place, half way between the points, so that they do not turn the whole; far ones do.
        const Lanes<Real> far =
            kFar * (magnitude<Real>(ax) + magnitude<Real>(ay) + magnitude<Real>(bx) + magnitude<Real>(by));
        const Lanes<Real> halfX = most(least(half * j.errorX, far), -far),
                          halfY = most(least(half * j.errorY, far), -far);
        // Arms that whirl, as of light bodies that cannot hold heavy ones, stay as they were: that takes speed away.
        const Lanes<Real> mostOmega = all(kWhirl * step.inverseH);
        const Mask<Real> calm = (magnitude<Real>(a.spin * moveA.perGyration) < mostOmega) &
                                (magnitude<Real>(b.spin * moveB.perGyration) < mostOmega);
        ax = choose<Real>(calm, ax + halfX, j.armAX), ay = choose<Real>(calm, ay + halfY, j.armAY);
        bx = choose<Real>(calm, bx - halfX, j.armBX), by = choose<Real>(calm, by - halfY, j.armBY);
        const Lanes<Real> perA = a.invMass * moveA.perGyration, perB = b.invMass * moveB.perGyration;
        const Lanes<Real> warmA = perA * ((j.armAX - ax) * j.impulseY - (j.armAY - ay) * j.impulseX);
        const Lanes<Real> warmB = perB * ((bx - j.armBX) * j.impulseY - (by - j.armBY) * j.impulseX);
        for (int i = 0; i < kLanes<Real>; ++i) {
            if (perA[i] != 0) pushes[j.a[i]].warmW += warmA[i];
            if (perB[i] != 0) pushes[j.b[i]].warmW += warmB[i];
        }
        j.armAX = ax, j.armAY = ay, j.armBX = bx, j.armBY = by;
        const Lanes<Real> mass = a.invMass + b.invMass;
        const Lanes<Real> inertiaA = perA * moveA.perGyration, inertiaB = perB * moveB.perGyration;  // inverse
        const Lanes<Real> xx = mass + inertiaA * ay * ay + inertiaB * by * by;
        const Lanes<Real> yy = mass + inertiaA * ax * ax + inertiaB * bx * bx;
        const Lanes<Real> xy = -inertiaA * ax * ay - inertiaB * bx * by;
        const Lanes<Real> determinant = xx * yy - xy * xy;
        const Mask<Real> sound = determinant > zero;
        const Lanes<Real> inverse = choose<Real>(sound, one / choose<Real>(sound, determinant, one), zero);
        j.inverseXX = yy * inverse, j.inverseYY = xx * inverse, j.inverseXY = -xy * inverse;
    }
}

template <class Real>
void integrateVelocities(BodyState<Real>* bodies, BodyPush<Real>* pushes, std::size_t count, Real h)
{
    for (std::size_t i = 0; i < count; ++i) {
        BodyState<Real>& s = bodies[i];
        BodyPush<Real>& p = pushes[i];
        p.warmX += s.velocityX - p.beforeX, p.warmY += s.velocityY - p.beforeY, p.warmW += s.spin - p.beforeW;
        s.velocityX = p.linearKept * (s.velocityX + h * p.accelerationX) + p.warmX;
        s.velocityY = p.linearKept * (s.velocityY + h * p.accelerationY) + p.warmY;
        s.spin = p.angularKept * (s.spin + h * p.accelerationW) + p.warmW;
        p.beforeX = s.velocityX, p.beforeY = s.velocityY, p.beforeW = s.spin;
    }
}

template <class Real>
void integratePositions(BodyState<Real>* bodies, std::size_t count, Real h)
{
    for (std::size_t i = 0; i < count; ++i) {
        BodyState<Real>& s = bodies[i];
        s.moveX += h * s.velocityX, s.moveY += h * s.velocityY, s.sweep += h * s.spin;
    }
}

template <class Real>
constexpr Kernels<Real> table()
{
    return {calmContacts<Real>,        warmContacts<Real>,      warmJoints<Real>,    solveContacts<Real>,
            relaxContacts<Real>,       approachContacts<Real>,  scaleContacts<Real>, carryContacts<Real>,
            bounceContacts<Real>,      foreseeJoints<Real>,     solveJoints<Real>,   turnJoints<Real>,
            integrateVelocities<Real>, integratePositions<Real>};
}

}  // namespace

extern const Kernels<float> singles = table<float>();
extern const Kernels<double> doubles = table<double>();
