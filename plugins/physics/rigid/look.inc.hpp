// Full looks at eight pairs, compiled once for each instruction set: look_sse2.cpp and look_avx2.cpp include this in a
// namespace of their own, after lane_ops.inc.hpp. Step by step what points.cpp and manifold.cpp do with one pair, every
// operation in the same order.

namespace {

struct Vectors {
    Eight x, y;
};
JET_INLINE Vectors operator+(const Vectors& a, const Vectors& b) { return {a.x + b.x, a.y + b.y}; }
JET_INLINE Vectors operator-(const Vectors& a, const Vectors& b) { return {a.x - b.x, a.y - b.y}; }
JET_INLINE Vectors operator-(const Vectors& a) { return {-a.x, -a.y}; }
JET_INLINE Vectors operator*(const Eight& s, const Vectors& a) { return {s * a.x, s * a.y}; }
JET_INLINE Eight dot(const Vectors& a, const Vectors& b) { return a.x * b.x + a.y * b.y; }
JET_INLINE Eight cross(const Vectors& a, const Vectors& b) { return a.x * b.y - a.y * b.x; }
JET_INLINE Vectors turned(const Vectors& turn, const Vectors& v)
{
    return {turn.x * v.x - turn.y * v.y, turn.y * v.x + turn.x * v.y};
}
JET_INLINE Vectors turnedBack(const Vectors& turn, const Vectors& v)
{
    return {turn.x * v.x + turn.y * v.y, turn.x * v.y - turn.y * v.x};
}
JET_INLINE Vectors choose(const Bits& mask, const Vectors& yes, const Vectors& no)
{
    return {choose(mask, yes.x, no.x), choose(mask, yes.y, no.y)};
}
JET_INLINE Vectors where(const Bits& mask, const Vectors& v) { return {where(mask, v.x), where(mask, v.y)}; }

/// Eight pairs and what is known of them before points are sought.
struct Pairs {
    RigidContact* c[8];
    const Part *a[8], *b[8];
    Vectors speed;                       // of B against A
    Vectors turnA, turnB;                // of the bodies
    Eight omegaA, omegaB;                // rad / s
    Eight radiusA, radiusB, lengthA;     // of the parts
    Bits countA, countB;                 // corners
    Vectors move, turn;                  // where B's frame is in A's
    Eight slop, shorter, travel, reach;  // units
    Vectors oldMove, oldTurn;
    Eight separations[2], oldReach;
    Bits flags, flags2, ids, count;
    Eight stepImpulse;
};

struct Touch {
    Vectors onA, onB;
    Eight separation;
    Bits id;
};
struct Found {
    Vectors normal;
    Eight gap;
    Bits count;
    Touch points[2];
};

/// The first half of Collider::update(): fills in the pairs; which of them need points. `seen` but for the speeds.
JET_INLINE Bits prepare(const LookInput& in, const Index* which, Pairs& p, Seen& seen, Bits& reused)
{
    const Pose *poseA[8], *poseB[8];
    for (int i = 0; i < 8; ++i) {
        RigidContact& c = in.contacts[which[i]];
        p.c[i] = &c;
        p.a[i] = &in.parts[c.partA], p.b[i] = &in.parts[c.partB];
        poseA[i] = &in.poses[c.bodyA], poseB[i] = &in.poses[c.bodyB];
    }
    Vectors apart;
    placesApart(poseA, poseB, apart.x, apart.y);
    const Motions a = motionsOf(poseA), b = motionsOf(poseB);
    p.turnA = {a.cosine, a.sine}, p.turnB = {b.cosine, b.sine};
    p.speed = {b.velocityX - a.velocityX, b.velocityY - a.velocityY};
    p.omegaA = a.omega, p.omegaB = b.omega;
    p.move = turnedBack(p.turnA, apart), p.turn = turnedBack(p.turnA, p.turnB);
    p.travel = closingWay(a, b, apart.x, apart.y, in.dt);
    Eight lengthB, reachA, reachB, corners, word, word2, ids;
    gather([&](int i) { return p.a[i]; }, p.radiusA, p.lengthA, reachA, corners);
    p.countA = bitsIn(corners) & 0xff;
    gather([&](int i) { return p.b[i]; }, p.radiusB, lengthB, reachB, corners);
    p.countB = bitsIn(corners) & 0xff;
    p.shorter = least(p.lengthA, lengthB);
    gather([&](int i) { return &p.c[i]->at; }, p.oldMove.x, p.oldMove.y, p.oldTurn.x, p.oldTurn.y);
    gather([&](int i) { return &p.c[i]->slop; }, p.slop, p.separations[0], p.separations[1], p.oldReach);
    gather([&](int i) { return &p.c[i]->count; }, word, word2, ids, p.stepImpulse);
    p.flags = bitsIn(word), p.flags2 = bitsIn(word2), p.ids = bitsIn(ids);
    p.count = p.flags & 0xff;
    const Bits foreseen = (p.flags2 & 0xff00) != 0;

    const Eight fast = kFast * p.shorter;
    p.reach = kSpeculative * p.slop + least(p.travel, fast);
    Eight far = kSpeculative * p.slop + p.travel;
    if (in.surprise != nullptr) {
        float ofA[8], ofB[8];
        for (int i = 0; i < 8; ++i) ofA[i] = in.surprise[p.c[i]->bodyA], ofB[i] = in.surprise[p.c[i]->bodyB];
        const Eight surpriseA = load(ofA), surpriseB = load(ofB);
        p.reach = p.reach + surpriseA + surpriseB, far = far + surpriseA + surpriseB;
    }
    const Bits meet = meeting(in.boxes, p.c);
    // Collider::staysApart()
    const Vectors moved = p.move - p.oldMove, turn = p.turn - p.oldTurn;
    const Eight squared = dot(moved, moved);
    const Eight gap = p.separations[0] - root(squared) - root(dot(turn, turn)) * reachB;
    const Bits stays = meet & (p.count == 0) & (gap > far);
    // Collider::reuse()
    const Eight slack = kReuseMove * p.slop, none = all(0.0F);
    reused = meet & ~stays & ~foreseen & ~(squared > slack * slack) &
             ~(absolute(cross(p.oldTurn, p.turn)) > kReuseTurn) & ~(dot(p.oldTurn, p.turn) < none) &
             ~(p.reach > p.oldReach + p.slop);
    seen.meet = bitsOf(meet), seen.apart = bitsOf(stays), seen.reused = bitsOf(reused);
    seen.fast = bitsOf(p.travel > fast);
    store(seen.gap, gap);
    return meet & ~stays & ~reused;
}

JET_INLINE void place(const Pairs& p, Touch& touch, const Vectors& onA, const Vectors& onB, const Eight& separation,
                      const Bits& featureA, const Bits& featureB)
{
    touch.onA = onA;
    touch.onB = turnedBack(p.turn, onB - p.move);
    touch.separation = separation;
    touch.id = featureA << 8 | featureB;
}

/// One point between two corners (or centres) that lie apart: manifold::betweenPoints().
JET_INLINE Found betweenPoints(const Pairs& p, const Vectors& a, const Vectors& b, const Vectors& fallback,
                               const Bits& featureA, const Bits& featureB)
{
    Found f;
    const Vectors apart = b - a;
    const Eight squared = dot(apart, apart), radius = p.radiusA + p.radiusB, length = root(squared);
    f.gap = length - radius;
    const Bits near = ~(squared > (radius + p.reach) * (radius + p.reach));
    f.normal = where(near, choose(length > all(1e-12F), (1.0F / length) * apart, fallback));
    f.count = near & 1;
    place(p, f.points[0], a + p.radiusA * f.normal, b - p.radiusB * f.normal, length - radius, featureA, featureB);
    return f;
}

JET_INLINE Vectors firstCorners(const Part* const (&parts)[8])
{
    Vectors v, next;
    gather([&](int i) { return &parts[i]->corners[0]; }, v.x, v.y, next.x, next.y);
    return v;
}
/// The corner, and the one after it.
JET_INLINE void sideOf(const Part* const (&parts)[8], const Bits& side, Vectors& from, Vectors& to)
{
    std::int32_t at[8];
    store(at, side);
    gather([&](int i) { return &parts[i]->corners[at[i]]; }, from.x, from.y, to.x, to.y);
}
JET_INLINE Vectors normalOf(const Part* const (&parts)[8], const Bits& side)
{
    std::int32_t at[8];
    store(at, side);
    Vectors normal, next;
    gather([&](int i) { return &parts[i]->normals[at[i]]; }, normal.x, normal.y, next.x, next.y);
    return normal;
}
JET_INLINE Bits nextOf(const Bits& side, const Bits& count) { return (side + 1) & ((side + 1) != count); }

/// Corners and normals of eight parts.
struct Outlines {
    Vectors corners[kMostCorners], normals[kMostCorners];
};
JET_INLINE void outlinesOf(const Part* const (&parts)[8], int count, Outlines& o)
{
    for (int k = 0; k < count; k += 2) {
        gather([&](int i) { return &parts[i]->corners[k]; }, o.corners[k].x, o.corners[k].y, o.corners[k + 1].x,
               o.corners[k + 1].y);
        gather([&](int i) { return &parts[i]->normals[k]; }, o.normals[k].x, o.normals[k].y, o.normals[k + 1].x,
               o.normals[k + 1].y);
    }
}

JET_INLINE Found collideCircles(const Pairs& p)
{
    const Vectors right{all(1.0F), all(0.0F)};
    return betweenPoints(p, firstCorners(p.a), p.move + turned(p.turn, firstCorners(p.b)), right, all(0), all(0));
}

/// manifold::withPoint()
JET_INLINE Found collideDiscs(const Pairs& p, int most)
{
    Outlines a;
    outlinesOf(p.a, most, a);
    const Vectors b = p.move + turned(p.turn, firstCorners(p.b));
    Eight separation = all(-3e38F);
    Bits side = all(0);
    for (int i = 0; i < most; ++i) {
        const Eight s = dot(a.normals[i], b - a.corners[i]);
        const Bits farther = s > separation;
        separation = choose(farther, s, separation), side = choose(farther, all(i), side);
    }
    Vectors v1, v2;
    sideOf(p.a, side, v1, v2);
    const Vectors normal = normalOf(p.a, side);
    const Eight none = all(0.0F);
    const Bits outside = separation > all(1e-7F);
    const Bits first = outside & (dot(b - v1, v2 - v1) < none),
               second = outside & ~first & (dot(b - v2, v1 - v2) < none);
    const Bits corner = first | second, near = ~(separation > p.reach + p.radiusA + p.radiusB);
    const Found at =
        betweenPoints(p, choose(first, v1, v2), b, normal, choose(first, side, nextOf(side, p.countA)), all(0));
    Found f;
    Touch& touch = f.points[0];
    place(p, touch, b + (p.radiusA - separation) * normal, b - p.radiusB * normal, separation - p.radiusA - p.radiusB,
          side + 0x40, all(0));
    f.gap = choose(near & corner, at.gap, separation - p.radiusA - p.radiusB);
    f.normal = where(near, choose(corner, at.normal, normal));
    f.count = near & choose(corner, at.count, all(1));
    touch.onA = choose(corner, at.points[0].onA, touch.onA), touch.onB = choose(corner, at.points[0].onB, touch.onB);
    touch.separation = choose(corner, at.points[0].separation, touch.separation);
    touch.id = choose(corner, at.points[0].id, touch.id);
    return f;
}

/// manifold::farthestSide()
JET_INLINE Bits farthestSide(const Outlines& a, int countA, const Outlines& b, int countB, Eight& separation)
{
    Bits best = all(0);
    separation = all(-3e38F);
    for (int i = 0; i < countA; ++i) {
        const Vectors n = a.normals[i];
        const Eight offset = dot(n, a.corners[i]);
        Eight nearest = dot(n, b.corners[0]);
        for (int j = 1; j < countB; ++j) nearest = least(nearest, dot(n, b.corners[j]));
        nearest = nearest - offset;
        const Bits farther = nearest > separation;
        separation = choose(farther, nearest, separation), best = choose(farther, all(i), best);
    }
    return best;
}

/// manifold::mostOpposed(): of A's sides where `ofA` is set, else of B's.
JET_INLINE Bits mostOpposed(const Outlines& a, const Outlines& b, int count, const Bits& ofA, const Vectors& normal)
{
    Bits best = all(0);
    Eight smallest = dot(choose(ofA, a.normals[0], b.normals[0]), normal);
    for (int i = 1; i < count; ++i) {
        const Eight along = dot(choose(ofA, a.normals[i], b.normals[i]), normal);
        const Bits less = along < smallest;
        smallest = choose(less, along, smallest), best = choose(less, all(i), best);
    }
    return best;
}

/// Two sides, from corner to corner, and which of their parts' they are.
struct Sides {
    Vectors a1, a2, b1, b2;
    Bits a, nextA, b, nextB;
};

/// manifold::nearestOfSegments(); along: 0..1.
struct NearestPoints {
    Vectors onA, onB;
    Eight alongA, alongB;
};
JET_INLINE NearestPoints nearestOf(const Sides& s)
{
    const Vectors d1 = s.a2 - s.a1, d2 = s.b2 - s.b1, r = s.a1 - s.b1;
    const Eight a = dot(d1, d1), e = dot(d2, d2), f = dot(d2, r), c = dot(d1, r), b = dot(d1, d2);
    const Eight none = all(0.0F), one = all(1.0F);
    const auto unit = [&](const Eight& x) { return choose(x < none, none, choose(one < x, one, x)); };
    const Bits flatA = a <= none, flatB = e <= none;
    const Eight denominator = a * e - b * b, start = unit(-c / a);
    const Eight between = where(denominator > 1e-6F * a * e, unit((b * f - c * e) / denominator));
    const Eight along = (b * between + f) / e;
    const Bits before = along<none, after = along> one;
    NearestPoints n;
    n.alongA = choose(before, start, choose(after, unit((b - c) / a), between));
    n.alongB = choose(before, none, choose(after, one, along));
    n.alongA = where(~flatA, choose(flatB, start, n.alongA));
    n.alongB = where(~flatB, choose(flatA, unit(f / e), n.alongB));
    n.onA = s.a1 + n.alongA * d1, n.onB = s.b1 + n.alongB * d2;
    return n;
}

/// manifold::clip(): B's side is the reference where `flipped` is set.
JET_INLINE Found clip(const Pairs& p, const Sides& s, const Bits& flipped, const Vectors& normal)
{
    const Vectors r1 = choose(flipped, s.b1, s.a1), r2 = choose(flipped, s.b2, s.a2);
    const Vectors i1 = choose(flipped, s.a1, s.b1), i2 = choose(flipped, s.a2, s.b2);
    const Eight radiusR = choose(flipped, p.radiusB, p.radiusA), radiusI = choose(flipped, p.radiusA, p.radiusB);
    const Vectors tangent{-normal.y, normal.x};
    const Eight lower = dot(tangent, r1), upper = dot(tangent, r2), a = dot(tangent, i1), b = dot(tangent, i2);
    const Bits wide = a - b > all(1e-9F);
    const Vectors along = i1 - i2;
    const Vectors p1 = choose((b < lower) & wide, i2 + ((lower - b) / (a - b)) * along, i2);
    const Vectors p2 = choose((a > upper) & wide, i2 + ((upper - b) / (a - b)) * along, i1);
    const Eight radius = radiusR + radiusI;
    Found f;
    Bits has[2];
    const auto look = [&](int k, const Vectors& at, const Bits& sideA, const Bits& sideB) {
        const Eight separation = dot(normal, at - r1);
        has[k] = ~(separation > p.reach + radius);
        const Vectors onR = at + (radiusR - separation) * normal, onI = at - radiusI * normal;
        place(p, f.points[k], choose(flipped, onI, onR), choose(flipped, onR, onI), separation - radius, sideA, sideB);
    };
    look(0, p1, choose(flipped, s.nextA, s.a), choose(flipped, s.b, s.nextB));
    look(1, p2, choose(flipped, s.a, s.nextA), choose(flipped, s.nextB, s.b));
    // One alone is the first.
    Touch& t = f.points[0];
    const Touch& second = f.points[1];
    t.onA = choose(has[0], t.onA, second.onA), t.onB = choose(has[0], t.onB, second.onB);
    t.separation = choose(has[0], t.separation, second.separation), t.id = choose(has[0], t.id, second.id);
    f.count = (has[0] & 1) + (has[1] & 1);
    f.gap = all(0.0F);
    f.normal = choose(flipped, -normal, normal);
    return f;
}

/// manifold::sides()
JET_INLINE Found collidePolygons(const Pairs& p, int mostA, int mostB, const Bits& needed)
{
    Outlines a, b;
    const int corners = mostA > mostB ? mostA : mostB;
    outlinesOf(p.a, corners, a), outlinesOf(p.b, corners, b);
    for (int k = 0; k < corners; ++k)
        b.corners[k] = p.move + turned(p.turn, b.corners[k]), b.normals[k] = turned(p.turn, b.normals[k]);
    const Eight radius = p.radiusA + p.radiusB, farthest = p.reach + radius;
    Eight separationA, separationB;
    const Bits sideA = farthestSide(a, mostA, b, mostB, separationA);
    const Bits clearA = separationA > farthest;
    Found none;
    none.normal = {all(0.0F), all(0.0F)}, none.gap = separationA - radius, none.count = all(0);
    if (bitsOf(needed & ~clearA) == 0) {
        none.points[0] = none.points[1] = {none.normal, none.normal, none.gap, none.count};
        return none;
    }
    const Bits sideB = farthestSide(b, mostB, a, mostA, separationB);
    const Bits clearB = separationB > farthest;
    none.gap = choose(clearA, none.gap, separationB - radius);

    const Bits flipped = separationB > separationA + 1e-3F * least(p.lengthA, all(1e6F));
    const Vectors normalA = normalOf(p.a, sideA), normalB = turned(p.turn, normalOf(p.b, sideB));
    const Vectors normal = choose(flipped, normalB, normalA);
    const Bits opposed = mostOpposed(a, b, corners, flipped, normal);
    Sides s;
    s.a = choose(flipped, opposed, sideA), s.b = choose(flipped, sideB, opposed);
    s.nextA = nextOf(s.a, p.countA), s.nextB = nextOf(s.b, p.countB);
    sideOf(p.a, s.a, s.a1, s.a2), sideOf(p.b, s.b, s.b1, s.b2);
    s.b1 = p.move + turned(p.turn, s.b1), s.b2 = p.move + turned(p.turn, s.b2);

    Found f = clip(p, s, flipped, normal);
    const Eight separation = most(separationA, separationB);
    Bits corner = ~clearA & ~clearB & (separation > 1e-4F * p.lengthA);
    if (bitsOf(needed & corner) != 0) {
        const NearestPoints n = nearestOf(s);
        const Eight zero = all(0.0F), one = all(1.0F);
        const Vectors apart = n.onB - n.onA;
        corner = corner & ((n.alongA == zero) | (n.alongA == one)) & ((n.alongB == zero) | (n.alongB == one)) &
                 (dot(apart, apart) > 1.001F * separation * separation);
        const Found at = betweenPoints(p, n.onA, n.onB, normalOf(p.a, s.a), choose(n.alongA == zero, s.a, s.nextA),
                                       choose(n.alongB == zero, s.b, s.nextB));
        f.normal = choose(corner, at.normal, f.normal), f.gap = choose(corner, separation - radius, f.gap);
        f.count = choose(corner, at.count, f.count);
        Touch& t = f.points[0];
        const Touch& c = at.points[0];
        t.onA = choose(corner, c.onA, t.onA), t.onB = choose(corner, c.onB, t.onB);
        t.separation = choose(corner, c.separation, t.separation), t.id = choose(corner, c.id, t.id);
    }
    const Bits clear = clearA | clearB;
    f.normal = where(~clear, f.normal), f.gap = choose(clear, none.gap, f.gap), f.count = f.count & ~clear;
    return f;
}

/// The points they had, carried on: Collider::reuse(), and Collider::renew() where they were found anew.
JET_INLINE void finish(Pairs& p, const Found& f, const Bits& renewed, const Bits& reused, Seen& seen)
{
    Vectors normal, onA[2], onB[2];
    Eight impulses[2], tangents[2], friction, restitution;
    gather([&](int i) { return &p.c[i]->normal; }, normal.x, normal.y, onA[0].x, onA[0].y);
    gather([&](int i) { return &p.c[i]->onA[1]; }, onA[1].x, onA[1].y, onB[0].x, onB[0].y);
    gather([&](int i) { return &p.c[i]->onB[1]; }, onB[1].x, onB[1].y, impulses[0], impulses[1]);
    gather([&](int i) { return &p.c[i]->tangentImpulse; }, tangents[0], tangents[1], friction, restitution);
    const Bits oldIds[2] = {p.ids & 0xffff, (p.ids >> 16) & 0xffff};
    const Bits had[2] = {p.count > 0, p.count > 1}, has[2] = {f.count > 0, f.count > 1};
    Eight carried[2], slid[2];
    for (int k = 0; k < 2; ++k) {
        const Bits first = had[0] & (oldIds[0] == f.points[k].id), second = had[1] & (oldIds[1] == f.points[k].id);
        carried[k] = choose(second, impulses[1], where(first, impulses[0]));
        slid[k] = choose(second, tangents[1], where(first, tangents[0]));
    }
    // samePoint()
    const Bits ofA = (oldIds[0] & 0xff00) == (f.points[0].id & 0xff00);
    const Bits ofB = (oldIds[0] & 0xff) == (f.points[0].id & 0xff);
    const Bits lone = (p.count == 1) & (f.count == 1) & (ofA | ofB) & (dot(normal, f.normal) > all(kSameWay));
    carried[0] = choose(lone, impulses[0], carried[0]), slid[0] = choose(lone, tangents[0], slid[0]);
    Bits ids[2];
    for (int k = 0; k < 2; ++k) {
        const Vectors at = p.move + turned(p.turn, onB[k]) - onA[k];
        p.separations[k] = choose(reused & had[k], dot(normal, at), p.separations[k]);
        const Bits set = renewed & has[k];
        const Touch& touch = f.points[k];
        onA[k] = choose(set, touch.onA, onA[k]), onB[k] = choose(set, touch.onB, onB[k]);
        p.separations[k] = choose(set, touch.separation, p.separations[k]);
        impulses[k] = choose(set, carried[k], impulses[k]), tangents[k] = choose(set, slid[k], tangents[k]);
        ids[k] = choose(set, touch.id, oldIds[k]);
    }
    const Bits bare = renewed & (f.count == 0);
    p.separations[0] = choose(bare, f.gap, p.separations[0]);
    normal = choose(renewed, f.normal, normal);
    p.oldMove = choose(renewed, p.move, p.oldMove), p.oldTurn = choose(renewed, p.turn, p.oldTurn);
    p.oldReach = choose(renewed, p.reach, p.oldReach);
    p.flags = choose(renewed, (p.flags & ~0xff) | f.count, p.flags);
    p.flags2 = p.flags2 & choose(renewed, all(~0xffff), all(~0xff));  // not due, not foreseen
    const Bits words = ids[0] | ids[1] << 16;

    scatter([&](int i) { return &p.c[i]->at; }, p.oldMove.x, p.oldMove.y, p.oldTurn.x, p.oldTurn.y);
    scatter([&](int i) { return &p.c[i]->slop; }, p.slop, p.separations[0], p.separations[1], p.oldReach);
    scatter([&](int i) { return &p.c[i]->count; }, valuesIn(p.flags), valuesIn(p.flags2), valuesIn(words),
            p.stepImpulse);
    scatter([&](int i) { return &p.c[i]->normal; }, normal.x, normal.y, onA[0].x, onA[0].y);
    scatter([&](int i) { return &p.c[i]->onA[1]; }, onA[1].x, onA[1].y, onB[0].x, onB[0].y);
    scatter([&](int i) { return &p.c[i]->onB[1]; }, onB[1].x, onB[1].y, impulses[0], impulses[1]);
    scatter([&](int i) { return &p.c[i]->tangentImpulse; }, tangents[0], tangents[1], friction, restitution);

    store(seen.gap, choose(renewed, where(bare, f.gap), load(seen.gap)));
    // Collider::hitSpeed()
    const Vectors n = turned(p.turnA, normal), armA = turned(p.turnA, onA[0]), armB = turned(p.turnB, onB[0]);
    const Eight approach = -(n.x * p.speed.x + n.y * p.speed.y + p.omegaB * cross(armB, n) - p.omegaA * cross(armA, n));
    store(seen.speed, approach / p.shorter);
}

/// Those whose points are not sought are not due any more, that is all.
JET_INLINE void settle(const Pairs& p)
{
    for (RigidContact* c : p.c) c->due = false;
}

template <class Collide>
JET_INLINE void lookAt(const LookInput& in, const Index* which, Seen& seen, Collide&& collide)
{
    Pairs p;
    Bits reused;
    const Bits needed = prepare(in, which, p, seen, reused);
    if ((bitsOf(needed) | seen.reused) == 0) return settle(p);
    finish(p, collide(p, needed), needed, reused, seen);
}

void circles(const LookInput& in, const Index* which, Seen& seen)
{
    lookAt(in, which, seen, [](const Pairs& p, const Bits&) {
        Found f = collideCircles(p);
        f.points[1] = f.points[0];
        return f;
    });
}

void discs(const LookInput& in, const Index* which, int most, Seen& seen)
{
    lookAt(in, which, seen, [&](const Pairs& p, const Bits&) {
        Found f = collideDiscs(p, most);
        f.points[1] = f.points[0];
        return f;
    });
}

void polygons(const LookInput& in, const Index* which, int mostA, int mostB, Seen& seen)
{
    lookAt(in, which, seen,
           [&](const Pairs& p, const Bits& needed) { return collidePolygons(p, mostA, mostB, needed); });
}

/// B's sides in lanes, against each of A's.
SidePoints nearestSides(const Part& a, const Part& b, const Relative& bInA)
{
    float x[9], y[9];
    for (int i = 0; i <= 8; ++i) {
        const Vec2f at = b.corners[i], turn = bInA.turn;
        x[i] = bInA.move.x + (turn.x * at.x - turn.y * at.y), y[i] = bInA.move.y + (turn.y * at.x + turn.x * at.y);
    }
    Sides s;
    s.b1 = {load(x), load(y)}, s.b2 = {load(x + 1), load(y + 1)};
    Eight best = all(3e38F);
    Bits side = all(0);
    Vectors onA{all(0.0F), all(0.0F)}, onB = onA;
    for (int i = 0; i < a.count; ++i) {
        s.a1 = {all(a.corners[i].x), all(a.corners[i].y)}, s.a2 = {all(a.corners[i + 1].x), all(a.corners[i + 1].y)};
        const NearestPoints n = nearestOf(s);
        const Vectors apart = n.onB - n.onA;
        const Eight squared = dot(apart, apart);
        const Bits nearer = squared < best;
        best = choose(nearer, squared, best), side = choose(nearer, all(i), side);
        onA = choose(nearer, n.onA, onA), onB = choose(nearer, n.onB, onB);
    }
    float squares[8], points[4][8];
    std::int32_t sides[8];
    store(squares, best), store(sides, side);
    store(points[0], onA.x), store(points[1], onA.y), store(points[2], onB.x), store(points[3], onB.y);
    int first = 0;
    for (int j = 1; j < b.count; ++j)
        if (squares[j] < squares[first] || (squares[j] == squares[first] && sides[j] < sides[first])) first = j;
    return {{points[0][first], points[1][first]}, {points[2][first], points[3][first]}, squares[first]};
}

}  // namespace

extern const Looker pairLooker;
const Looker pairLooker{circles, discs, polygons, nearestSides};
