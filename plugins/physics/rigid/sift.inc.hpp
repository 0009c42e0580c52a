// The sieve of pairs, compiled once for each instruction set: sift_sse2.cpp and sift_avx2.cpp include this in a
// namespace of their own, after lane_ops.inc.hpp.

namespace {

std::uint32_t stayApart(const SiftInput& in, const Index* which, float* until)
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
    Eight flags, more, ids, impulse;
    gather([&](int i) { return &c[i]->count; }, flags, more, ids, impulse);
    const Bits bare = (bitsIn(flags) & 0xffffff) == 0;  // neither points, nor touching, nor passing
    const Eight travel = closingWay(a, b, dx, dy, in.dt);
    // Collider::staysApart()
    const Eight movedX = a.cosine * dx + a.sine * dy - oldX, movedY = a.cosine * dy - a.sine * dx - oldY;
    const Eight turnedX = a.cosine * b.cosine + a.sine * b.sine - oldCosine,
                turnedY = a.cosine * b.sine - a.sine * b.cosine - oldSine;
    gap = gap - root(movedX * movedX + movedY * movedY) - root(turnedX * turnedX + turnedY * turnedY) * b.reach;
    store(until, gap - in.speculative * slop);
    return bitsOf(bare & (gap > in.speculative * slop + travel) & meeting(in.boxes, c));
}

std::size_t near(const BoxesInCells& boxes, const SoughtBox& box, const Stretch* stretches, std::size_t count,
                 Index* hits)
{
    const Eight minX = all(box.now.minX), minY = all(box.now.minY), maxX = all(box.now.maxX), maxY = all(box.now.maxY);
    const Eight wasMinX = all(box.was.minX), wasMinY = all(box.was.minY), wasMaxX = all(box.was.maxX),
                wasMaxY = all(box.was.maxY);
    const Eight reach = all(box.reach), farther = all(Sieve::kLonger * box.reach);
    std::size_t found = 0;
    for (const Stretch* s = stretches; s != stretches + count; ++s) {
        for (Index at = s->first; at < s->last; at += 8) {
            const Bits meet = (load(boxes.minX + at) <= maxX) & (minX <= load(boxes.maxX + at)) &
                              (load(boxes.minY + at) <= maxY) & (minY <= load(boxes.maxY + at));
            std::uint32_t bits = bitsOf(meet);
            if (s->last - at < 8) bits &= (1U << (s->last - at)) - 1;
            if (bits == 0) continue;
            const Bits met = (load(boxes.wasMinX + at) <= wasMaxX) & (wasMinX <= load(boxes.wasMaxX + at)) &
                             (load(boxes.wasMinY + at) <= wasMaxY) & (wasMinY <= load(boxes.wasMaxY + at));
            const Eight others = load(boxes.reach + at);
            bits &= ~bitsOf(met & ~((others > farther) | (others * Sieve::kLonger < reach)));
            for (; bits != 0; bits &= bits - 1) hits[found++] = at + static_cast<Index>(__builtin_ctz(bits));
        }
    }
    return found;
}

}  // namespace

extern const Sieve pairSieve;
const Sieve pairSieve{stayApart, near};
