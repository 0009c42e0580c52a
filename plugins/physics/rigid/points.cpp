// The points of a pair: kept while its bodies hardly move against each other, else found anew.
#include "collider.hpp"
#include "outlined.hpp"

#include <cmath>

namespace jet::physics {

namespace {

constexpr std::size_t kFewest = 3;  // pairs: fewer are looked at one by one

}  // namespace

Relative Collider::relative(Index bodyA, Index bodyB) const
{
    const Pose &a = poses_[bodyA], &b = poses_[bodyB];
    Relative at;
    at.move = turnedBack(a.turn, {static_cast<float>(b.x - a.x), static_cast<float>(b.y - a.y)});
    at.turn = turnedBack(a.turn, b.turn);
    return at;
}

/// How fast points of the two may come together at most: as seen from the body that reaches less, since a long one
/// that turns is fast only far away.
float Collider::closingSpeed(const RigidContact& c) const
{
    const Pose &a = poses_[c.bodyA], &b = poses_[c.bodyB];
    const bool fromA = bodies_[c.bodyA].reach <= bodies_[c.bodyB].reach;
    const Vec2f arm{static_cast<float>(b.x - a.x), static_cast<float>(b.y - a.y)};
    const float omega = fromA ? b.omega : a.omega;
    const float dx = b.velocityX - a.velocityX + omega * arm.y, dy = b.velocityY - a.velocityY - omega * arm.x;
    const float reach = fromA ? bodies_[c.bodyA].reach : bodies_[c.bodyB].reach;
    return std::sqrt(dx * dx + dy * dy) + std::abs(b.omega - a.omega) * reach;
}

Manifold Collider::meet(const RigidContact& c, const Relative& at, float reach) const
{
    const Part &a = parts_[c.partA], &b = parts_[c.partB];
    if (!a.outlined && !b.outlined) return physics::collide(a, b, at, reach);
    Manifold m = collideOutlined(a, weld_.outlineOf(c.partA), b, weld_.outlineOf(c.partB), at, reach);
    m.gap = 0;  // not known: what is not felt may be near
    return m;
}

/// Is one of them behind the other, which is solid from the front only? Nothing stops it there.
bool Collider::fromBehind(const RigidContact& c) const
{
    const Part &a = parts_[c.partA], &b = parts_[c.partB];
    const auto behind = [](const Part& wall, Vec2f other) { return dot(wall.normals[0], other - wall.corners[0]) < 0; };
    const Relative at = relative(c.bodyA, c.bodyB);
    const PartOutline *outlineA = weld_.outlineOf(c.partA), *outlineB = weld_.outlineOf(c.partB);
    if (outlineA != nullptr && outlineA->wall) return behind(a, at.move + turned(at.turn, b.centre()));
    if (outlineB != nullptr && outlineB->wall) return behind(b, turnedBack(at.turn, a.centre() - at.move));
    return false;
}

Collider::Look Collider::update(RigidContact& c, double dt)
{
    c.due = false;
    if (!sweep_.box(c.partA).meets(sweep_.box(c.partB))) return {.kept = false};
    const Part &a = parts_[c.partA], &b = parts_[c.partB];
    const Relative at = relative(c.bodyA, c.bodyB);
    const float shorter = std::min(a.length, b.length);
    const float travel = closingSpeed(c) * static_cast<float>(dt);
    const float reach =
        kSpeculative * c.slop + std::min(travel, kFast * shorter) + surprise_[c.bodyA] + surprise_[c.bodyB];
    if (staysApart(c, at, kSpeculative * c.slop + travel + surprise_[c.bodyA] + surprise_[c.bodyB])) return {};
    if (!reuse(c, at, reach)) {
        if ((travel > 0.1F * shorter || c.count == 0) && isLonger(c.partA, c.partB) && apart(c.partA, c.partB) &&
            apart(c.partB, c.partA))
            return {.kept = false};
        const Manifold m = meet(c, at, reach);
        renew(c, m, at, reach);
        noteGap(c, m.count == 0 ? m.gap : 0);
        if (c.count > 0 && c.nearest() > 0 && travel > kFast * shorter) c.count = 0;
        if (c.count == 0 && c.resolve && travel > kFast * shorter) foresee(c, at, dt);
        decideSide(c);
    }
    return {.hits = noteHit(c, travel > kFast * shorter), .speed = c.count > 0 ? hitSpeed(c) : 0};
}

/// What overlaps from a hit before is hit again.
bool Collider::noteHit(const RigidContact& c, bool fast)
{
    const bool hits = c.foreseen || (fast && bool(fast_) && c.nearest() <= 0);
    if (hits) hits_[static_cast<std::size_t>(&c - contacts_.data())] = 1;
    return hits;
}

/// Outlines, platforms and long parts have rules of their own. Without a jump: what comes next follows no pattern.
Collider::Kind Collider::kindOf(const RigidContact& c) const
{
    const Part &a = parts_[c.partA], &b = parts_[c.partB];
    const bool alone = c.special | c.passing | a.outlined | b.outlined;
    return static_cast<Kind>(alone ? kAlone : (a.count > 1) + (b.count > 1));  // a circle is always second
}

void Collider::update(const std::vector<Index>& which, std::vector<Look>& looks, double dt)
{
    looks.resize(which.size());
    std::size_t waiting[kKinds][Looker::kPairs], count[kKinds] = {};
    for (std::size_t i = 0; i < which.size(); ++i) {
        const Kind kind = kindOf(contacts_[which[i]]);
        waiting[kind][count[kind]++] = i;
        if (count[kind] < Looker::kPairs) continue;
        update(kind, waiting[kind], Looker::kPairs, which, looks, dt);
        count[kind] = 0;
    }
    for (const Kind kind : {kCircles, kDiscs, kPolygons, kAlone})
        if (count[kind] > 0) update(kind, waiting[kind], count[kind], which, looks, dt);
}

void Collider::update(Kind kind, const std::size_t* places, std::size_t count, const std::vector<Index>& which,
                      std::vector<Look>& looks, double dt)
{
    if (kind == kAlone || count < kFewest) {
        for (std::size_t i = 0; i < count; ++i) looks[places[i]] = update(contacts_[which[places[i]]], dt);
        return;
    }
    Index lanes[Looker::kPairs];
    int mostA = 1, mostB = 1;
    for (std::size_t i = 0; i < Looker::kPairs; ++i) {
        lanes[i] = which[places[i < count ? i : 0]];
        mostA = std::max<int>(mostA, parts_[contacts_[lanes[i]].partA].count);
        mostB = std::max<int>(mostB, parts_[contacts_[lanes[i]].partB].count);
    }
    const LookInput input{
        contacts_.data(),      poses_.data(), sweep_.boxes(), parts_.data(), surprised_ ? surprise_.data() : nullptr,
        static_cast<float>(dt)};
    Seen seen;
    switch (kind) {
    case kCircles: looker_->circles(input, lanes, seen); break;
    case kDiscs: looker_->discs(input, lanes, mostA, seen); break;
    default: looker_->polygons(input, lanes, mostA, mostB, seen);
    }
    for (std::size_t i = 0; i < count; ++i) looks[places[i]] = take(contacts_[lanes[i]], seen, i, dt);
}

/// What is left to do of update() after a wide look.
Collider::Look Collider::take(RigidContact& c, const Seen& seen, std::size_t lane, double dt)
{
    const auto has = [&](std::uint32_t bits) { return (bits >> lane & 1U) != 0; };
    if (!has(seen.meet)) return {.kept = false};
    const bool reused = has(seen.reused), fast = has(seen.fast);
    if (!reused) noteGap(c, seen.gap[lane]);
    if (has(seen.apart)) return {};
    Look look{.speed = seen.speed[lane]};
    if (fast && !reused) {
        if (c.count > 0 && c.nearest() > 0) c.count = 0;
        if (c.count == 0 && c.resolve) {
            foresee(c, Relative(c.at), dt);
            look.speed = c.count > 0 ? hitSpeed(c) : 0;
        }
    }
    look.hits = noteHit(c, fast);
    return look;
}

std::uint32_t Collider::sift(const Index* which, std::size_t count, double dt)
{
    if (surprised_) return 0;
    Index lanes[Sieve::kPairs];
    float until[Sieve::kPairs];
    for (std::size_t i = 0; i < Sieve::kPairs; ++i) lanes[i] = which[std::min(i, count - 1)];
    const SiftInput input{contacts_.data(), poses_.data(), sweep_.boxes(), static_cast<float>(dt), kSpeculative};
    const std::uint32_t apart = sieve_->stayApart(input, lanes, until) & ((1U << count) - 1);
    for (std::uint32_t rest = apart; rest != 0; rest &= rest - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(rest));
        Nearing& n = nearing_[lanes[lane]];
        contacts_[lanes[lane]].due = false;
        n.until = way_[n.bodyA] + way_[n.bodyB] + static_cast<double>(until[lane]);
    }
    return apart;
}

/// Is a pair without points farther apart than `reach`, after what it has moved since it was last looked at?
bool Collider::staysApart(const RigidContact& c, const Relative& at, float reach)
{
    if (c.count > 0 || c.passing) return false;
    const Vec2f moved = at.move - c.at.move, turned = at.turn - c.at.turn;
    const float gap =
        c.separation[0] - std::sqrt(dot(moved, moved)) - std::sqrt(dot(turned, turned)) * parts_[c.partB].reach;
    if (!(gap > reach)) return false;
    noteGap(c, gap);
    return true;
}

/// The bodies are `gap` apart, or farther: they need not be looked at before they can have come that far.
void Collider::noteGap(const RigidContact& c, float gap)
{
    nearing_[static_cast<std::size_t>(&c - contacts_.data())].until =
        way_[c.bodyA] + way_[c.bodyB] + static_cast<double>(gap - kSpeculative * c.slop);
}

float Collider::hitSpeed(const RigidContact& c) const
{
    const Pose &poseA = poses_[c.bodyA], &poseB = poses_[c.bodyB];
    const float dx = poseB.velocityX - poseA.velocityX, dy = poseB.velocityY - poseA.velocityY;
    const Vec2f n = turned(poseA.turn, c.normal), armA = turned(poseA.turn, c.onA[0]),
                armB = turned(poseB.turn, c.onB[0]);
    const float approach = -(n.x * dx + n.y * dy + poseB.omega * cross(armB, n) - poseA.omega * cross(armA, n));
    return approach / std::min(parts_[c.partA].length, parts_[c.partB].length);
}

/// While two parts hardly move against each other, the points stay on their surfaces and only the separation changes.
bool Collider::reuse(RigidContact& c, const Relative& at, float reach) const
{
    const Vec2f moved = at.move - c.at.move;
    const float most = kReuseMove * c.slop;
    if (dot(moved, moved) > most * most || std::abs(cross(c.at.turn, at.turn)) > kReuseTurn ||
        dot(c.at.turn, at.turn) < 0 || reach > c.reach + c.slop || c.passing || c.foreseen)
        return false;
    for (int i = 0; i < c.count; ++i) c.separation[i] = dot(c.normal, at.move + turned(at.turn, c.onB[i]) - c.onA[i]);
    return true;
}

/// Impulses go on with the features they belong to.
void Collider::renew(RigidContact& c, const Manifold& m, const Relative& at, float reach) const
{
    const int count = c.count;
    const bool same = samePoint(c, m);
    const std::uint16_t ids[2] = {c.ids[0], c.ids[1]};
    const float impulses[2] = {c.impulse[0], c.impulse[1]};
    const float tangents[2] = {c.tangentImpulse[0], c.tangentImpulse[1]};
    c.at = at, c.reach = reach;
    c.foreseen = false;
    c.count = static_cast<std::uint8_t>(m.count);
    c.normal = m.normal;
    if (m.count == 0) c.separation[0] = m.gap;
    for (int i = 0; i < m.count; ++i) {
        const ManifoldPoint& p = m.points[i];
        c.onA[i] = p.onA, c.onB[i] = p.onB, c.ids[i] = p.id, c.separation[i] = p.separation;
        c.impulse[i] = c.tangentImpulse[i] = 0;
        for (int k = 0; k < std::min(count, 2); ++k)
            if (ids[k] == p.id || same) c.impulse[i] = impulses[k], c.tangentImpulse[i] = tangents[k];
    }
}

/// A platform holds what comes against its direction, and lets pass what comes from behind until both are apart.
void Collider::decideSide(RigidContact& c) const
{
    const RigidBody &a = bodies_[c.bodyA], &b = bodies_[c.bodyB];
    if (!a.oneSided && !b.oneSided) return;
    if (c.count == 0) {
        c.passing = false;
        c.resolve = !a.sensor && !b.sensor;
        return;
    }
    const Vec2f normal = turned(poses_[c.bodyA].turn, c.normal);
    const auto wrong = [&](const RigidBody& body, Vec2f outward) {
        const Rules& rules = rulesOf(body);
        return body.oneSided && rules.oneSidedX * outward.x + rules.oneSidedY * outward.y < 0.5F;
    };
    const bool deep = c.nearest() < -8 * c.slop && !c.touching;
    if (wrong(a, normal) || wrong(b, -normal) || deep) c.passing = true;
    c.resolve = !c.passing && !a.sensor && !b.sensor;
}

}  // namespace jet::physics
