// The solver's kernels, compiled once for each instruction set: kernels_sse2.cpp and kernels_avx2.cpp include this in a
// namespace of their own. "Soft Step" (Catto 2024, https://box2d.org/posts/2024/02/solver2d/): see solver_data.hpp.

/// The state that lies as far as a group says.
template <class State>
JET_INLINE State* farFrom(State* states, std::int32_t far)
{
    return reinterpret_cast<State*>(reinterpret_cast<std::uintptr_t>(states) + static_cast<std::uintptr_t>(far) * 8U);
}
/// What another array has for the same body.
template <class Real, class Other>
JET_INLINE Other* beside(Other* others, std::int32_t far)
{
    constexpr std::uintptr_t kEach = sizeof(Other) / kFar<Real>;
    static_assert(sizeof(Other) % kFar<Real> == 0);
    return reinterpret_cast<Other*>(reinterpret_cast<std::uintptr_t>(others) +
                                    static_cast<std::uintptr_t>(far) * kEach);
}

#if defined(__AVX2__)
#include "whole_lanes.inc.hpp"
#else
#include "half_lanes.inc.hpp"
#endif

namespace {

// Groups as these lanes see them.
template <class Real>
using Contacts = ContactLanes<Real, Lanes>;
template <class Real>
using Frictions = FrictionLanes<Real, Lanes>;
template <class Real>
using Bounces = BounceLanes<Real, Lanes>;
template <class Real>
using Joints = JointLanes<Real, Lanes>;
template <class Real>
using Anchors = AnchorLanes<Real, Lanes>;

template <template <class, template <class> class> class Group, class Real>
JET_INLINE Group<Real, Lanes>& view(Group<Real, physics::Lanes>& group)
{
    static_assert(sizeof(Group<Real, Lanes>) == sizeof group);
    return *static_cast<Group<Real, Lanes>*>(static_cast<void*>(&group));
}
template <template <class, template <class> class> class Group, class Real>
JET_INLINE const Group<Real, Lanes>& view(const Group<Real, physics::Lanes>& group)
{
    return *static_cast<const Group<Real, Lanes>*>(static_cast<const void*>(&group));
}

template <class Real>
JET_INLINE Lanes<Real> magnitude(const Lanes<Real>& value)
{
    return most(value, Lanes<Real>(-value));
}

/// The row that begins with the value.
template <class Real>
JET_INLINE Row<Real>& rowAt(Real& first)
{
    return *static_cast<Row<Real>*>(static_cast<void*>(&first));
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

template <class Real>
JET_INLINE BodyLanes<Real> velocities(const BodyState<Real>* bodies, const std::int32_t* index)
{
    BodyLanes<Real> s;
    gatherRows([&](int i) JET_INLINED { return &farFrom(bodies, index[i])->velocityX; }, s.velocityX, s.velocityY,
               s.spin, s.invMass);
    return s;
}
template <class Real>
JET_INLINE MoveLanes<Real> moves(const BodyState<Real>* bodies, const std::int32_t* index)
{
    MoveLanes<Real> s;
    gatherRows([&](int i) JET_INLINED { return &farFrom(bodies, index[i])->moveX; }, s.moveX, s.moveY, s.sweep,
               s.perGyration);
    return s;
}

template <class Real>
JET_INLINE void scatter(BodyState<Real>* bodies, const std::int32_t* index, const BodyLanes<Real>& s)
{
    scatterRows(bodies, index, s.velocityX, s.velocityY, s.spin, s.invMass);
}
/// Calls work(lane) for each.
template <class Real, class Work>
JET_INLINE void eachLane(const Work& work)
{
    work(0), work(1), work(2), work(3);
    if constexpr (kLanes<Real> == 8) work(4), work(5), work(6), work(7);
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
        const Contacts<Real>& c = view(groups[g]);
        const Frictions<Real>& f = view(frictions[g]);
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

/// A group's bodies between the two halves of a pass over it, of which eachGroup() tells.
template <class Real>
struct Visit {
    BodyLanes<Real> a, b;
    Lanes<Real> linear, given;  // speed of the centres along the normal; sum of what was given before

    template <class Group>
    JET_INLINE Visit(const BodyState<Real>* bodies, const Group& group)
        : a(velocities(bodies, group.a)), b(velocities(bodies, group.b))
    {
    }
    template <class Group>
    JET_INLINE void leave(BodyState<Real>* bodies, const Group& group) const
    {
        scatter(bodies, group.a, a);
        scatter(bodies, group.b, b);
    }
};

/// Gives a point what `wanted` says of it and its speed, but never pulls; the change.
template <class Real, class Point, class Wanted>
JET_INLINE Lanes<Real> give(Point& p, const Lanes<Real>& speed, const Wanted& wanted)
{
    const Lanes<Real> impulse = most(wanted(p, speed), all<Real>(0)), change = impulse - p.impulse;
    p.impulse = impulse;
    return change;
}

/// Both points of a group, one after the other; the sum of the changes.
template <class Real, class Wanted>
JET_INLINE Lanes<Real> pushNormals(Contacts<Real>& c, Visit<Real>& v, const Wanted& wanted)
{
    const Pair<Real> pair(v.a, v.b, c.points);
    const Lanes<Real> first = give<Real>(c.points[0], pair.first(v.linear), wanted);
    const Lanes<Real> second = give<Real>(c.points[1], pair.second(v.linear, first), wanted);
    Pair<Real>::turn(v.a, v.b, pair, first, second);
    return first + second;
}

/// What a point that is not pushed out wants.
template <class Real>
struct Relaxed {
    Real inverseH;
    template <class Point>
    JET_INLINE Lanes<Real> operator()(const Point& p, const Lanes<Real>& speed) const
    {
        return p.impulse - p.mass * (speed + most(p.now, all<Real>(0)) * inverseH);
    }
};

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
    const auto begin = [&](std::size_t g) JET_INLINED {
        const Contacts<Real>& c = view(groups[g]);
        Visit<Real> v(bodies, c);
        v.linear = c.normalX * (v.b.velocityX - v.a.velocityX) + c.normalY * (v.b.velocityY - v.a.velocityY);
        return v;
    };
    const auto end = [&](std::size_t g, Visit<Real>& v) JET_INLINED {
        Contacts<Real>& c = view(groups[g]);
        const Mask<Real> still = (v.a.invMass == zero) | (v.b.invMass == zero);
        const Lanes<Real> rate = choose<Real>(still, all(step.still.biasRate), all(step.moving.biasRate));
        const Lanes<Real> massScale = choose<Real>(still, all(step.still.massScale), all(step.moving.massScale));
        const Lanes<Real> impulseScale =
            choose<Real>(still, all(step.still.impulseScale), all(step.moving.impulseScale));
        const Lanes<Real> given = pushNormals<Real>(c, v, [&](const auto& p, const Lanes<Real>& speed) JET_INLINED {
            const Mask<Real> apart = p.now > zero;
            const Lanes<Real> bias = choose<Real>(apart, p.now * step.inverseH, most(rate * p.now, -c.mostPush));
            const Lanes<Real> kept = p.impulse - choose<Real>(apart, zero, impulseScale) * p.impulse;
            return kept - p.mass * choose<Real>(apart, one, massScale) * (speed + bias);
        });
        shove<Real>(v.a, v.b, c.normalX * given, c.normalY * given);
        v.leave(bodies, c);
    };
    eachGroup(count, begin, end);
}

/// Relaxes normals alone, where the bodies are now.
template <class Real>
void calmContacts(BodyState<Real>* bodies, ContactLanes<Real>* groups, std::size_t count,
                  const StepConstants<Real>& step)
{
    const Relaxed<Real> wanted{step.inverseH};
    const auto begin = [&](std::size_t g) JET_INLINED {
        Contacts<Real>& c = view(groups[g]);
        const MoveLanes<Real> moveA = moves(bodies, c.a), moveB = moves(bodies, c.b);
        const Lanes<Real> moved = c.normalX * (moveB.moveX - moveA.moveX) + c.normalY * (moveB.moveY - moveA.moveY);
        for (auto& p : c.points) p.now = p.separation + moved + p.leverB * moveB.sweep - p.leverA * moveA.sweep;
        Visit<Real> v(bodies, c);
        v.linear = c.normalX * (v.b.velocityX - v.a.velocityX) + c.normalY * (v.b.velocityY - v.a.velocityY);
        v.given = give<Real>(c.points[0], Pair<Real>(v.a, v.b, c.points).first(v.linear), wanted);
        return v;
    };
    const auto end = [&](std::size_t g, Visit<Real>& v) JET_INLINED {
        Contacts<Real>& c = view(groups[g]);
        const Pair<Real> pair(v.a, v.b, c.points);
        const Lanes<Real> second = give<Real>(c.points[1], pair.second(v.linear, v.given), wanted);
        Pair<Real>::turn(v.a, v.b, pair, v.given, second);
        const Lanes<Real> given = v.given + second;
        shove<Real>(v.a, v.b, c.normalX * given, c.normalY * given);
        v.leave(bodies, c);
    };
    eachGroup(count, begin, end);
}

template <class Real>
void relaxContacts(BodyState<Real>* bodies, ContactLanes<Real>* groups, FrictionLanes<Real>* frictions,
                   std::size_t count, const StepConstants<Real>& step)
{
    const auto begin = [&](std::size_t g) JET_INLINED {
        const Contacts<Real>& c = view(groups[g]);
        Frictions<Real>& f = view(frictions[g]);
        Visit<Real> v(bodies, c);
        const Lanes<Real> towardsX = v.b.velocityX - v.a.velocityX, towardsY = v.b.velocityY - v.a.velocityY;
        // The tangent is the normal turned to the left. Friction does not change speeds of centres along the normal.
        const Lanes<Real> along = c.normalX * towardsY - c.normalY * towardsX;
        v.linear = c.normalX * towardsX + c.normalY * towardsY;
        const Pair<Real> pair(v.a, v.b, f.points);
        const auto rub = [&](int k, const Lanes<Real>& slide) JET_INLINED {
            auto& q = f.points[k];
            const Lanes<Real> limit = f.friction * c.points[k].impulse;
            const Lanes<Real> impulse = least(most(q.impulse - q.mass * slide, -limit), limit);
            const Lanes<Real> change = impulse - q.impulse;
            q.impulse = impulse;
            return change;
        };
        const Lanes<Real> first = rub(0, pair.first(along)), second = rub(1, pair.second(along, first));
        Pair<Real>::turn(v.a, v.b, pair, first, second);
        v.given = first + second;
        return v;
    };
    const auto end = [&](std::size_t g, Visit<Real>& v) JET_INLINED {
        Contacts<Real>& c = view(groups[g]);
        const Lanes<Real> rubbed = v.given, given = pushNormals<Real>(c, v, Relaxed<Real>{step.inverseH});
        shove<Real>(v.a, v.b, c.normalX * given - c.normalY * rubbed, c.normalY * given + c.normalX * rubbed);
        for (int k = 0; k < 2; ++k) {
            Lanes<Real>& total = view(frictions[g]).points[k].total;
            total = step.totalKept * total + step.totalAdded * c.points[k].impulse;
        }
        v.leave(bodies, c);
    };
    eachGroup(count, begin, end);
}

template <class Real>
void approachContacts(const BodyState<Real>* bodies, const ContactLanes<Real>* groups, BounceLanes<Real>* bounces,
                      std::size_t count)
{
    for (std::size_t g = 0; g < count; ++g) {
        const Contacts<Real>& c = view(groups[g]);
        const BodyLanes<Real> a = velocities(bodies, c.a), b = velocities(bodies, c.b);
        for (int k = 0; k < 2; ++k) {
            const auto& p = c.points[k];
            view(bounces[g]).approach[k] = speedAlong<Real>(a, b, c.normalX, c.normalY, p.leverA, p.leverB);
        }
    }
}

template <class Real>
void scaleContacts(ContactLanes<Real>* groups, FrictionLanes<Real>* frictions, std::size_t count, Real by)
{
    for (std::size_t g = 0; g < count; ++g)
        for (int k = 0; k < 2; ++k) view(groups[g]).points[k].impulse *= by, view(frictions[g]).points[k].impulse *= by;
}

template <class Real>
void carryContacts(ContactLanes<Real>* groups, const FrictionLanes<Real>* frictions, std::uint32_t* bits,
                   std::size_t count)
{
    const Lanes<Real> zero = all<Real>(0);
    for (std::size_t g = 0; g < count; ++g) {
        const Frictions<Real>& f = view(frictions[g]);
        for (auto& p : view(groups[g]).points) p.separation = p.now;
        bits[g] = bitsOf<Real>(most(f.points[0].total, f.points[1].total) > zero);
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
        Contacts<Real>& c = view(groups[g]);
        Frictions<Real>& f = view(frictions[g]);
        const Bounces<Real>& r = view(bounces[g]);
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
#include "row_kernels.inc.hpp"

template <class Real>
void integrateVelocities(BodyState<Real>* bodies, BodyPush<Real>* pushes, std::size_t count,
                         const StepConstants<Real>& step)
{
    const Row<Real> stay = rowWith<Real>(1, 1, 1, 1),
                    go = rowWith<Real>(step.linearKept, step.linearKept, step.angularKept, 1);
    for (std::size_t i = 0; i < count; ++i) {
        Row<Real>&velocity = rowAt(bodies[i].velocityX), &warm = rowAt(pushes[i].warmX),
        &before = rowAt(pushes[i].beforeX);
        warm += velocity - before;
        const Row<Real>& kept = bodies[i].invMass != 0 ? go : stay;
        before = velocity = kept * (velocity + step.h * rowAt(pushes[i].accelerationX)) + warm;
    }
}

template <class Real>
void integratePositions(BodyState<Real>* bodies, std::size_t count, Real h)
{
    const Row<Real> step = rowWith<Real>(h, h, h, 0);
    for (std::size_t i = 0; i < count; ++i) rowAt(bodies[i].moveX) += step * rowAt(bodies[i].velocityX);
}

/// physics::direction() of some angles at once, to the same bits.
JET_INLINE void directionsOf(const Doubles& angle, Doubles& cosine, Doubles& sine)
{
    const Doubles rounded = angle * (2 / kPi) + kRounds, turns = rounded - kRounds;
    const Doubles x = (angle - turns * kHalfPiHigh) - turns * kHalfPiLow, q = x * x;
    Doubles c = Doubles{} + kCosineTerms[0], s = Doubles{} + kSineTerms[0];
    for (std::size_t i = 1; i < std::size(kCosineTerms); ++i) c = kCosineTerms[i] + q * c, s = kSineTerms[i] + q * s;
    s = s * x;
    const DoubleBits quarter = (DoubleBits)rounded;  // in its last two bits
    const DoubleBits swapped = ((DoubleBits)c ^ (DoubleBits)s) & -(quarter & 1);
    cosine = (Doubles)((DoubleBits)c ^ swapped ^ ((quarter + 1) >> 1) << 63);
    sine = (Doubles)((DoubleBits)s ^ swapped ^ (quarter >> 1) << 63);
}

bool turnBodies(const double* angles, double* directions, std::size_t count)
{
    DoubleBits near = ~DoubleBits{};
    const auto turn = [&](const double* from, double* to) JET_INLINED {
        const Doubles angle = *reinterpret_cast<const DoublesAnywhere*>(from);
        near &= (DoubleBits)(angle < kFarAngle) & (DoubleBits)(angle > -kFarAngle);
        Doubles cosine, sine;
        directionsOf(angle, cosine, sine);
        putPairs(to, cosine, sine);
    };
    std::size_t i = 0;
    for (; i + kDoubles <= count; i += kDoubles) turn(angles + i, directions + 2 * i);
    if (i < count) {
        double last[kDoubles] = {}, turned[2 * kDoubles];
        std::copy(angles + i, angles + count, last);
        turn(last, turned);
        std::copy(turned, turned + 2 * (count - i), directions + 2 * i);
    }
    bool all = true;
    for (std::size_t k = 0; k < kDoubles; ++k) all &= near[k] != 0;
    return all;
}

template <class Real>
constexpr Kernels<Real> table()
{
    return {calmContacts<Real>,   warmContacts<Real>,     warmJoints<Real>,          solveContacts<Real>,
            relaxContacts<Real>,  approachContacts<Real>, scaleContacts<Real>,       carryContacts<Real>,
            bounceContacts<Real>, startJoints<Real>,      foreseeJoints<Real>,       pushJoints<Real>,
            relaxJoints<Real>,    turnJoints<Real>,       integrateVelocities<Real>, integratePositions<Real>,
            turnBodies,           writeContacts};
}

}  // namespace

extern const Kernels<float> singles = table<float>();
extern const Kernels<double> doubles = table<double>();
