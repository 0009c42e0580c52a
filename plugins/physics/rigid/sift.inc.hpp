// The sieve of pairs, compiled once for each instruction set: sift_sse2.cpp and sift_avx2.cpp include this in a
// namespace of their own, after lane_ops.inc.hpp.

namespace {

std::uint32_t stayApart(const SiftInput& in, const Index* which, float* gaps)
{
    const RigidContact* c[8];
    const Pose *poseA[8], *poseB[8];
    for (int i = 0; i < 8; ++i) {
        c[i] = &in.contacts[which[i]];
        poseA[i] = &in.poses[c[i]->bodyA], poseB[i] = &in.poses[c[i]->bodyB];
    }
    Eight dx, dy;
    placesApart(poseA, poseB, dx, dy);
    const Motions a = motionsOf(poseA), b = motionsOf(poseB);
    Eight oldX, oldY, oldCosine, oldSine, slop, gap, second, reach;
    gather([&](int i) { return &c[i]->at; }, oldX, oldY, oldCosine, oldSine);
    gather([&](int i) { return &c[i]->slop; }, slop, gap, second, reach);
    const Eight travel = closingWay(a, b, dx, dy, in.dt);
    // Collider::staysApart()
    const Eight movedX = a.cosine * dx + a.sine * dy - oldX, movedY = a.cosine * dy - a.sine * dx - oldY;
    const Eight turnedX = a.cosine * b.cosine + a.sine * b.sine - oldCosine,
                turnedY = a.cosine * b.sine - a.sine * b.cosine - oldSine;
    gap = gap - root(movedX * movedX + movedY * movedY) - root(turnedX * turnedX + turnedY * turnedY) * b.reach;
    store(gaps, gap);
    return bitsOf((gap > in.speculative * slop + travel) & meeting(in.boxes, c));
}

}  // namespace

extern const Sieve pairSieve;
const Sieve pairSieve{stayApart};
