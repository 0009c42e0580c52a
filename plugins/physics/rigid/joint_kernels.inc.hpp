// The kernels of points that joints hold together, included by kernels.inc.hpp; the scheme is in solver_data.hpp.

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
