// The kernels of points that joints hold together, included by kernels.inc.hpp; the scheme is in solver_data.hpp.

/// Gives the bodies of a group an impulse, and its opposite.
template <class Real>
JET_INLINE void pull(const Joints<Real>& j, BodyLanes<Real>& a, BodyLanes<Real>& b, const Lanes<Real>& x,
                     const Lanes<Real>& y)
{
    a.velocityX -= a.invMass * x, a.velocityY -= a.invMass * y;
    a.spin -= a.invMass * (j.leverAX * y - j.leverAY * x);
    b.velocityX += b.invMass * x, b.velocityY += b.invMass * y;
    b.spin += b.invMass * (j.leverBX * y - j.leverBY * x);
}

template <class Real>
void warmJoints(BodyState<Real>* bodies, const JointLanes<Real>* groups, std::size_t count)
{
    for (std::size_t g = 0; g < count; ++g) {
        const Joints<Real>& j = view(groups[g]);
        BodyLanes<Real> a = velocities(bodies, j.a), b = velocities(bodies, j.b);
        pull<Real>(j, a, b, j.impulseX, j.impulseY);
        scatter(bodies, j.a, a);
        scatter(bodies, j.b, b);
    }
}

/// Makes levers and masses of the arms.
template <class Real>
JET_INLINE void weigh(Joints<Real>& j, const Lanes<Real>& invMassA, const Lanes<Real>& invMassB)
{
    const Lanes<Real> zero = all<Real>(0), one = all<Real>(1);
    const Lanes<Real> ax = j.armAX, ay = j.armAY, bx = j.armBX, by = j.armBY;
    j.leverAX = j.perGyrationA * ax, j.leverAY = j.perGyrationA * ay;
    j.leverBX = j.perGyrationB * bx, j.leverBY = j.perGyrationB * by;
    const Lanes<Real> mass = invMassA + invMassB;
    const Lanes<Real> inertiaA = invMassA * j.perGyrationA * j.perGyrationA;  // inverse
    const Lanes<Real> inertiaB = invMassB * j.perGyrationB * j.perGyrationB;
    const Lanes<Real> xx = mass + inertiaA * ay * ay + inertiaB * by * by;
    const Lanes<Real> yy = mass + inertiaA * ax * ax + inertiaB * bx * bx;
    const Lanes<Real> xy = -inertiaA * ax * ay - inertiaB * bx * by;
    const Lanes<Real> determinant = xx * yy - xy * xy;
    const Mask<Real> sound = determinant > zero;
    const Lanes<Real> inverse = choose<Real>(sound, one / choose<Real>(sound, determinant, one), zero);
    j.inverseXX = yy * inverse, j.inverseYY = xx * inverse, j.inverseXY = -xy * inverse;
}

/// Arms of four joints, and where they end. On the background, which is not turned anyhow, there is no arm, and the
/// anchor is the place.
template <class Real>
struct Ends {
    Lanes<double> armX, armY, x, y;

    JET_INLINE Ends(const BodyPlace* places, const std::int32_t* index, const Lanes<double>& anchorX,
                    const Lanes<double>& anchorY)
    {
        const Lanes<double> zero = all<double>(0);
        Lanes<double> placeX, placeY, cosine, sine;
        gatherRows([&](int i) JET_INLINED { return &beside<Real>(places, index[i])->x; }, placeX, placeY, cosine, sine);
        const Mask<double> ground = (cosine == zero) & (sine == zero);
        armX = cosine * anchorX - sine * anchorY, armY = sine * anchorX + cosine * anchorY;
        x = placeX + choose<double>(ground, anchorX, armX), y = placeY + choose<double>(ground, anchorY, armY);
    }
};

template <class Real>
void startJoints(const BodyState<Real>* bodies, const BodyPlace* places, JointLanes<Real>* groups,
                 const AnchorLanes<Real>* anchors, std::size_t count)
{
    for (std::size_t g = 0; g < count; ++g) {
        Joints<Real>& j = view(groups[g]);
        const Anchors<Real>& at = view(anchors[g]);
        for (int i = 0; i < Anchors<Real>::kFours; ++i) {
            const Ends<Real> a(places, j.a + 4 * i, at.ax[i], at.ay[i]), b(places, j.b + 4 * i, at.bx[i], at.by[i]);
            const Lanes<double> errorX = b.x - a.x, errorY = b.y - a.y;
            putFour(j.startAX, i, a.armX), putFour(j.startAY, i, a.armY);
            putFour(j.startBX, i, b.armX), putFour(j.startBY, i, b.armY);
            putFour(j.armAX, i, a.armX + 0.5 * errorX), putFour(j.armAY, i, a.armY + 0.5 * errorY);
            putFour(j.armBX, i, b.armX - 0.5 * errorX), putFour(j.armBY, i, b.armY - 0.5 * errorY);
            putFour(j.startErrorX, i, errorX), putFour(j.startErrorY, i, errorY);
        }
        j.errorX = j.startErrorX, j.errorY = j.startErrorY;
        j.perGyrationA = moves(bodies, j.a).perGyration, j.perGyrationB = moves(bodies, j.b).perGyration;
        weigh<Real>(j, velocities(bodies, j.a).invMass, velocities(bodies, j.b).invMass);
    }
}

template <class Real>
void foreseeJoints(const BodyState<Real>* bodies, JointLanes<Real>* groups, std::size_t count,
                   const StepConstants<Real>& step)
{
    // A body that turns by more than a radian a substep is not foreseen farther than that.
    const Lanes<Real> zero = all<Real>(0), half = all(step.h / 2), most = all(step.inverseH / 2);
    const Lanes<Real> rate = all(step.joint.biasRate);
    constexpr Real kHeld = Real(0.1);
    for (std::size_t g = 0; g < count; ++g) {
        Joints<Real>& j = view(groups[g]);
        const BodyLanes<Real> a = velocities(bodies, j.a), b = velocities(bodies, j.b);
        const Lanes<Real> omegaA = j.perGyrationA * a.spin, omegaB = j.perGyrationB * b.spin;
        const Lanes<Real> inwardA = least(half * omegaA * omegaA, most);
        const Lanes<Real> inwardB = least(half * omegaB * omegaB, most);
        const Lanes<Real> aroundAX = -omegaA * j.armAY, aroundAY = omegaA * j.armAX;
        const Lanes<Real> aroundBX = -omegaB * j.armBY, aroundBY = omegaB * j.armBX;
        const Lanes<Real> apartX = b.velocityX + aroundBX - a.velocityX - aroundAX;
        const Lanes<Real> apartY = b.velocityY + aroundBY - a.velocityY - aroundAY;
        const Lanes<Real> turning =
            aroundAX * aroundAX + aroundAY * aroundAY + aroundBX * aroundBX + aroundBY * aroundBY;
        const Mask<Real> held = apartX * apartX + apartY * apartY <= kHeld * kHeld * turning;
        j.pushX = rate * j.errorX + choose<Real>(held, inwardA * j.armAX - inwardB * j.armBX, zero);
        j.pushY = rate * j.errorY + choose<Real>(held, inwardA * j.armAY - inwardB * j.armBY, zero);
    }
}

/// `wanted` makes impulses of the points' speeds.
template <class Real, class Wanted>
JET_INLINE void holdJoints(BodyState<Real>* bodies, JointLanes<Real>* groups, std::size_t count, const Wanted& wanted)
{
    for (std::size_t g = 0; g < count; ++g) {
        Joints<Real>& j = view(groups[g]);
        BodyLanes<Real> a = velocities(bodies, j.a), b = velocities(bodies, j.b);
        Lanes<Real> x = b.velocityX - a.velocityX - b.spin * j.leverBY + a.spin * j.leverAY;
        Lanes<Real> y = b.velocityY - a.velocityY + b.spin * j.leverBX - a.spin * j.leverAX;
        wanted(j, x, y);
        j.impulseX += x, j.impulseY += y;
        pull<Real>(j, a, b, x, y);
        scatter(bodies, j.a, a);
        scatter(bodies, j.b, b);
    }
}

template <class Real>
void pushJoints(BodyState<Real>* bodies, JointLanes<Real>* groups, std::size_t count, const StepConstants<Real>& step)
{
    const Lanes<Real> massScale = all(step.joint.massScale), impulseScale = all(step.joint.impulseScale);
    holdJoints<Real>(bodies, groups, count, [&](const Joints<Real>& j, Lanes<Real>& x, Lanes<Real>& y) JET_INLINED {
        const Lanes<Real> speedX = x + j.pushX, speedY = y + j.pushY;
        x = -massScale * (j.inverseXX * speedX + j.inverseXY * speedY) - impulseScale * j.impulseX;
        y = -massScale * (j.inverseXY * speedX + j.inverseYY * speedY) - impulseScale * j.impulseY;
    });
}

template <class Real>
void relaxJoints(BodyState<Real>* bodies, JointLanes<Real>* groups, std::size_t count)
{
    holdJoints<Real>(bodies, groups, count, [](const Joints<Real>& j, Lanes<Real>& x, Lanes<Real>& y) JET_INLINED {
        const Lanes<Real> speedX = x, speedY = y;
        x = -(j.inverseXX * speedX + j.inverseXY * speedY);
        y = -(j.inverseXY * speedX + j.inverseYY * speedY);
    });
}

/// Taylor's, of the angle squared: up to x^13 of the sine over x, and x^14 of the cosine.
constexpr double kSine[] = {1.0 / 6227020800, -1.0 / 39916800, 1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6, 1};
constexpr double kCosine[] = {-1.0 / 87178291200, 1.0 / 479001600, -1.0 / 3628800, 1.0 / 40320,
                              -1.0 / 720,         1.0 / 24,        -1.0 / 2,       1};

template <class Real, const auto& terms, std::size_t... after>
JET_INLINE Lanes<Real> polynomial(const Lanes<Real>& z, std::index_sequence<after...>)
{
    Lanes<Real> sum = all(static_cast<Real>(terms[0]));
    ((sum = sum * z + static_cast<Real>(terms[after + 1])), ...);
    return sum;
}
template <class Real, const auto& terms>
JET_INLINE Lanes<Real> polynomial(const Lanes<Real>& z)
{
    return polynomial<Real, terms>(z, std::make_index_sequence<std::size(terms) - 1>());
}

/// Those of a quarter of the angle, doubled twice; within 1e-12, and the same bits everywhere.
template <class Real>
JET_INLINE void directionOf(const Lanes<Real>& angle, Lanes<Real>& cosine, Lanes<Real>& sine)
{
    constexpr Real kFullTurn = Real(6.283185307179586);
    constexpr Real kRounds = sizeof(Real) == 4 ? Real(12582912) : Real(6755399441055744);  // adding it rounds
    const Lanes<Real> turns = angle * (1 / kFullTurn) + kRounds - kRounds;
    const Lanes<Real> x = Real(0.25) * (angle - kFullTurn * turns), z = x * x;
    sine = x * polynomial<Real, kSine>(z), cosine = polynomial<Real, kCosine>(z);
    for (int doubled = 0; doubled < 2; ++doubled) {
        const Lanes<Real> half = sine;
        sine = 2 * half * cosine, cosine = 1 - 2 * half * half;
    }
}

/// By how much a body turns when it alone takes away an error of one.
template <class Real>
JET_INLINE Lanes<Real> turnOf(const Lanes<Real>& invMass, const Lanes<Real>& perGyration, const Lanes<Real>& armX,
                              const Lanes<Real>& armY)
{
    const Lanes<Real> zero = all<Real>(0), one = all<Real>(1), inverse = perGyration * perGyration;
    const Lanes<Real> arm = magnitude<Real>(armX) + magnitude<Real>(armY);
    return choose<Real>(invMass > zero, inverse * arm / (one + inverse * (armX * armX + armY * armY)), zero);
}

template <class Real>
bool turnJoints(const BodyState<Real>* bodies, BodyPush<Real>* pushes, JointLanes<Real>* groups, std::size_t count,
                const StepConstants<Real>& step)
{
    const Lanes<Real> half = all(Real(0.5));
    constexpr Real kFar = Real(0.05), kWhirl = Real(0.25), kTurn = Real(0.5);
    const Lanes<Real> zero = all<Real>(0), one = all<Real>(1);
    Lanes<Real> strained = zero;
    for (std::size_t g = 0; g < count; ++g) {
        Joints<Real>& j = view(groups[g]);
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
        // No push turns a body by more than half a radian: it would lead elsewhere than it was meant to.
        const Lanes<Real> error = magnitude<Real>(j.errorX) + magnitude<Real>(j.errorY);
        const Lanes<Real> turn = error * most(turnOf<Real>(a.invMass, moveA.perGyration, ax, ay),
                                              turnOf<Real>(b.invMass, moveB.perGyration, bx, by));
        const Lanes<Real> mostTurn = all(kTurn);
        const Lanes<Real> push = mostTurn / most(turn, mostTurn);
        j.errorX *= push, j.errorY *= push;
        strained = choose<Real>((error <= 2 * far) & calm, strained, one);
        const Lanes<Real> perA = a.invMass * moveA.perGyration, perB = b.invMass * moveB.perGyration;
        const Lanes<Real> warmA = perA * ((j.armAX - ax) * j.impulseY - (j.armAY - ay) * j.impulseX);
        const Lanes<Real> warmB = perB * ((bx - j.armBX) * j.impulseY - (by - j.armBY) * j.impulseX);
        // What never moves may be in many groups, of other threads, too.
        eachLane<Real>([&](int i) JET_INLINED {
            if (perA[i] != 0) beside<Real>(pushes, j.a[i])->warmW += warmA[i];
            if (perB[i] != 0) beside<Real>(pushes, j.b[i])->warmW += warmB[i];
        });
        j.armAX = ax, j.armAY = ay, j.armBX = bx, j.armBY = by;
        weigh<Real>(j, a.invMass, b.invMass);
    }
    bool any = false;
    for (int i = 0; i < kLanes<Real>; ++i) any |= strained[i] > 0;
    return any;
}
