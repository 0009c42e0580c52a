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

#include "joint_kernels.inc.hpp"

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
    return {calmContacts<Real>,   warmContacts<Real>,     warmJoints<Real>,          solveContacts<Real>,
            relaxContacts<Real>,  approachContacts<Real>, scaleContacts<Real>,       carryContacts<Real>,
            bounceContacts<Real>, startJoints<Real>,      foreseeJoints<Real>,       pushJoints<Real>,
            relaxJoints<Real>,    turnJoints<Real>,       integrateVelocities<Real>, integratePositions<Real>};
}

}  // namespace

extern const Kernels<float> singles = table<float>();
extern const Kernels<double> doubles = table<double>();
