// The kernels of cloud_kernels.hpp, included once by the file of each instruction set, in a namespace of its own, after
// cloud_lanes.inc.hpp.

namespace {

#define JET_ALWAYS __attribute__((always_inline))

JET_INLINE Two turned(const Two& v) { return swapped(v) * both(-1, 1); }  // by a right angle
/// x² + y² of each particle, twice.
JET_INLINE Two squares(const Two& v)
{
    const Two own = v * v;
    return own + swapped(own);
}
/// Calls act(n, two) for each two particles from n on.
template <class Act>
JET_INLINE void eachTwo(std::size_t count, Act&& act)
{
    std::size_t n = 0;
    for (; n + 2 <= count; n += 2) act(n, true);
    if (n < count) act(n, false);
}

CloudSums sums(const Cloud& cloud)
{
    CloudSums sums;
    if (cloud.count == 0) return sums;
    const Two from = both(cloud.position[0], cloud.position[1]);
    Two low = from, high = from;
    Two mass{}, place{}, moving{}, own{}, turning{}, along{}, across{};
    eachTwo(cloud.count, [&](std::size_t n, bool two) JET_ALWAYS {
        const Two m = masses(cloud.mass, n, two), now = vectors(cloud.position, n, two), at = now - from;
        low = least(low, now), high = most(high, now);
        const Two weighed = m * at, speed = vectors(cloud.velocity, n, two);
        mass += m, place += weighed, moving += m * speed, own += weighed * at, turning += weighed * swapped(speed);
        if (!cloud.rest) return;
        const Two arm = vectors(cloud.rest, n, two);
        along += arm * weighed, across += arm * swapped(weighed);
    });
    sums.mass = sumX(mass);
    const double x = sumX(place) / sums.mass, y = sumY(place) / sums.mass;
    sums.vx = sumX(moving) / sums.mass, sums.vy = sumY(moving) / sums.mass;
    const double inertia = sumX(own) + sumY(own) - sums.mass * (x * x + y * y);
    sums.inertia = inertia > 0 ? inertia : 0;
    sums.momentum = sumX(turning) - sumY(turning) - sums.mass * (x * sums.vy - y * sums.vx);
    sums.along = sumX(along) + sumY(along);
    sums.across = sumX(across) - sumY(across);
    sums.x = cloud.position[0] + x, sums.y = cloud.position[1] + y;
    for (int axis = 0; axis < 2; ++axis) {
        sums.lowest[axis] = lowOf(low)[axis] < highOf(low)[axis] ? lowOf(low)[axis] : highOf(low)[axis];
        sums.greatest[axis] = lowOf(high)[axis] > highOf(high)[axis] ? lowOf(high)[axis] : highOf(high)[axis];
    }
    return sums;
}

/// What of the velocities is not the motion's.
JET_INLINE Two ownVelocity(const Two& velocity, const Two& arm, const CloudMotion& motion)
{
    return velocity - both(motion.vx, motion.vy) - all(motion.omega) * turned(arm);
}
JET_INLINE Two goals(const Two& rest, const CloudMotion& motion)
{
    return all(motion.c) * rest + all(motion.s) * turned(rest);
}

CloudStray stray(const Cloud& cloud, const CloudMotion& motion)
{
    const Two centre = both(motion.x, motion.y);
    Two off{}, speed{};
    eachTwo(cloud.count, [&](std::size_t n, bool two) JET_ALWAYS {
        const Two arm = vectors(cloud.position, n, two) - centre;
        speed = most(speed, squares(ownVelocity(vectors(cloud.velocity, n, two), arm, motion)));
        if (cloud.rest) off = most(off, squares(goals(vectors(cloud.rest, n, two), motion) - arm));
    });
    return {mostX(off), mostX(speed)};
}

CloudPulled pull(const Cloud& cloud, const CloudMotion& motion, const CloudPull& by, double* change)
{
    const Two centre = both(motion.x, motion.y), tolerance = all(by.tolerance);
    const Two tolerated = tolerance * tolerance;
    Two pulled{}, turn{}, damped{}, dampedTurn{};
    CloudPulled result;
    eachTwo(cloud.count, [&](std::size_t n, bool two) JET_ALWAYS {
        const Two arm = vectors(cloud.position, n, two) - centre;
        const Two away = goals(vectors(cloud.rest, n, two), motion) - arm, squared = squares(away);
        const Bits drawn = squared > tolerated;
        Two sum{};
        if (anySet(drawn)) {
            result.any = true;
            const Two elastic = where(drawn, all(by.elastic) * (all(1) - tolerance / root(squared)) * away);
            const Two own = ownVelocity(vectors(cloud.velocity, n, two), arm, motion);
            const Two damping = where(drawn, all(-by.damped) * own);
            const Two m = masses(cloud.mass, n, two);
            pulled += m * elastic, turn += m * arm * swapped(elastic);
            damped += m * damping, dampedTurn += m * arm * swapped(damping);
            sum = elastic + damping;
        }
        store(change, n, two, sum);
    });
    result.x = sumX(pulled), result.y = sumY(pulled), result.turn = sumX(turn) - sumY(turn);
    result.dampedX = sumX(damped), result.dampedY = sumY(damped),
    result.dampedTurn = sumX(dampedTurn) - sumY(dampedTurn);
    return result;
}

void give(const Cloud& cloud, const CloudMotion& motion, const CloudReturn& back, const double* change,
          double* velocity)
{
    const Two centre = both(motion.x, motion.y), net = both(back.x, back.y);
    eachTwo(cloud.count, [&](std::size_t n, bool two) JET_ALWAYS {
        const Two arm = vectors(cloud.position, n, two) - centre, goal = goals(vectors(cloud.rest, n, two), motion);
        const Two more = vectors(change, n, two) + net + all(back.goal) * turned(goal) + all(back.place) * turned(arm);
        store(velocity, n, two, vectors(velocity, n, two) + more);
    });
}

double farthest(const double* position, const double* from, const double* moving, double t, std::size_t count)
{
    Two far{};
    eachTwo(count, [&](std::size_t n, bool two) JET_ALWAYS {
        Two off = vectors(position, n, two) - vectors(from, n, two);
        if (moving) off -= all(t) * vectors(moving, n, two);
        far = most(far, squares(off));
    });
    return mostX(far);
}

}  // namespace

const CloudKernels clouds{&sums, &stray, &pull, &give, &farthest};
