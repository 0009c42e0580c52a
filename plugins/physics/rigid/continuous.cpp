// Fast bodies: what is going to be hit within the coming step, and where they are stopped.
#include "collider.hpp"

#include <cmath>
#include <cstring>

namespace jet::physics {

namespace {

constexpr std::size_t kMarkedABlock = 1024;  // contacts
constexpr std::size_t kBodiesABlock = 128;
constexpr std::size_t kHitsABlock = 256;  // contacts
constexpr float kGivesWay = 2;

float clamped(double x) { return static_cast<float>(std::clamp(x, -3e37, 3e37)); }

}  // namespace

/// Fast pairs get the point at which they will touch, not the one where they are nearest now: what flies past a corner
/// is not caught by it.
void Collider::foresee(RigidContact& c, const Relative& at, double dt) const
{
    const Part &a = parts_[c.partA], &b = parts_[c.partB];
    Pose poseA = poses_[c.bodyA], poseB = poses_[c.bodyB];
    if (fromBehind(c)) return;
    const float hit = timeOfImpact(a, b, poseA, poseB, dt, c.slop, *looker_);
    if (hit > 1) return;
    const auto moveOn = [&](Pose& pose) {
        const float t = hit * static_cast<float>(dt);
        pose.x += static_cast<double>(pose.velocityX) * t, pose.y += static_cast<double>(pose.velocityY) * t;
        const Vec2 turn = direction(static_cast<double>(pose.omega) * t);
        pose.turn = turned({static_cast<float>(turn.x()), static_cast<float>(turn.y())}, pose.turn);
    };
    moveOn(poseA), moveOn(poseB);
    Relative then;
    then.move = turnedBack(poseA.turn, {static_cast<float>(poseB.x - poseA.x), static_cast<float>(poseB.y - poseA.y)});
    then.turn = turnedBack(poseA.turn, poseB.turn);
    Manifold m = meet(c, then, 8 * c.slop);
    m.normal = turnedBack(poses_[c.bodyA].turn, turned(poseA.turn, m.normal));
    for (int i = 0; i < m.count; ++i)
        m.points[i].separation = dot(m.normal, at.move + turned(at.turn, m.points[i].onB) - m.points[i].onA);
    renew(c, m, at, 0);
    c.foreseen = c.due = c.count > 0;  // never reused
}

float timeOfImpact(const Part& a, const Part& b, const Pose& poseA, const Pose& poseB, double dt, float target,
                   const Looker& looker)
{
    const float dtf = static_cast<float>(dt);
    const Vec2f velocity{poseB.velocityX - poseA.velocityX, poseB.velocityY - poseA.velocityY};
    // As seen from the part that reaches less, if the other turns little.
    const bool fromA = a.reach <= b.reach;
    const float swing = fromA ? poseB.omega : poseA.omega;
    const bool carried = std::abs(swing) * dtf < 0.1F;
    const float turning = carried ? std::abs(poseB.omega - poseA.omega) * std::min(a.reach, b.reach)
                                  : std::abs(poseA.omega) * a.reach + std::abs(poseB.omega) * b.reach;
    float t = 0;
    for (int round = 0; round < 40; ++round) {
        const Vec2 turnA = direction(static_cast<double>(poseA.omega) * t),
                   turnB = direction(static_cast<double>(poseB.omega) * t);
        const Vec2f qA = turned({static_cast<float>(turnA.x()), static_cast<float>(turnA.y())}, poseA.turn);
        const Vec2f qB = turned({static_cast<float>(turnB.x()), static_cast<float>(turnB.y())}, poseB.turn);
        const Vec2f apart{static_cast<float>(poseB.x - poseA.x + static_cast<double>(velocity.x) * t),
                          static_cast<float>(poseB.y - poseA.y + static_cast<double>(velocity.y) * t)};
        const Distance d = distanceOf(a, b, {turnedBack(qA, apart), turnedBack(qA, qB)}, looker);
        if (d.distance <= target) return t / dtf;
        const Vec2f seen = carried ? velocity + swing * Vec2f{apart.y, -apart.x} : velocity;
        const float closing = -dot(turned(qA, d.normal), seen) + turning;
        if (!(closing * dtf > 1e-9F * d.distance)) return 2;
        t += (d.distance - target + 0.5F * std::abs(target)) / closing;  // a little beyond, to end
        if (t > dtf) return 2;
    }
    return t / dtf;
}

bool Collider::expectHits(const State& state, const WorldSettings& settings, double dt, Pool& pool, Arena& arena)
{
    if (!fast_) return false;
    bool grew = false;
    Index which[kHitsABlock];
    for (std::size_t first = 0; first < contacts_.size();) {
        const std::size_t last = std::min(first + kHitsABlock, contacts_.size()), count = listHits(first, last, which);
        first = last;
        for (std::size_t i = 0; i < count; ++i) {
            if (!expectHit(which[i], state, dt)) continue;
            // What follows may be hit by those that were surprised now.
            grew = true, first = which[i] + std::size_t{1};
            break;
        }
    }
    if (!grew) return false;
    settleDrifts();
    findPairs(settings, pool, arena);
    return true;
}

/// Contacts of [first, last) that hit, or have a body that was surprised; how many. Which they are follows no pattern:
/// none is jumped over.
std::size_t Collider::listHits(std::size_t first, std::size_t last, Index* which) const
{
    std::size_t count = 0;
    if (!surprised_) {
        const auto hit = [&](std::size_t contact) {
            which[count] = static_cast<Index>(contact);
            count += static_cast<std::size_t>(hits_[contact] != 0);
        };
        for (; first + sizeof(std::uint64_t) <= last; first += sizeof(std::uint64_t)) {
            std::uint64_t eight = 0;
            std::memcpy(&eight, &hits_[first], sizeof eight);
            for (std::size_t i = 0; eight != 0 && i < sizeof eight; ++i) hit(first + i);
        }
        for (; first < last; ++first) hit(first);
        return count;
    }
    for (; first < last; ++first) {
        const Nearing& n = nearing_[first];
        which[count] = static_cast<Index>(first);
        count += static_cast<std::size_t>((surprise_[n.bodyA] + surprise_[n.bodyB] > 0) + (hits_[first] != 0) > 0);
    }
    return count;
}

/// Whom a hit, or a body that was surprised, surprises in turn. False: nobody.
bool Collider::expectHit(Index contact, const State& state, double dt)
{
    const RigidContact& c = contacts_[contact];
    if (!isPlaced(places_[contact]) || !c.resolve || c.count == 0) return false;
    const float surprised = surprised_ ? std::max(surprise_[c.bodyA], surprise_[c.bodyB]) : 0;
    const float travel = std::max(hits_[contact] != 0 ? closingSpeed(c) * static_cast<float>(dt) : 0, surprised);
    const double a = state.nodes.invMass[bodies_[c.bodyA].node], b = state.nodes.invMass[bodies_[c.bodyB].node];
    if (!(a + b > 0)) return false;
    const auto gain = [&](double share) { return (1 + c.restitution) * travel * static_cast<float>(share / (a + b)); };
    const bool first = surprise(c.bodyA, gain(a), dt), second = surprise(c.bodyB, gain(b), dt);
    return first || second;
}

void Collider::settleDrifts()
{
    for (Index i = 1; i < bodies_.size(); ++i)
        if (surprise_[i] == 0) drift_[i] = 0;  // has been looked at
}

/// The body may be carried `gain` units farther in this step. False: that is nothing new.
bool Collider::surprise(Index index, float gain, double dt)
{
    const RigidBody& body = bodies_[index];
    if (!body.moves || gain <= 1.001F * surprise_[index] || gain < 0.5F * kFast * body.finest) return false;
    if (poses_[index].travel >= gain) return false;  // is as fast itself
    surprised_ = true;
    surprise_[index] = gain;
    drift_[index] = 1e30F;
    noteReached(index);
    for (Index p = 0; p < body.partCount; ++p)
        fitBox(body.firstPart + p, poses_[index], std::max(poses_[index].room, 0.0F) + gain, dt);
    sweep_.noteMoves();
    poses_[index].room = -1;  // fitted closely again in the next step
    poses_[index].rest.x = Pose::kUnknown;
    return true;
}

/// Where a hit throws a body out of the way it was expected to take, what lies there is not known: it goes no farther
/// than its boxes do.
float Collider::withinBox(Index body, const Vec2& move, double dt) const
{
    const Pose& pose = poses_[body];
    // A surprise was looked ahead of in the whole circle.
    const double room = static_cast<double>(std::max(0.1F * typical_, pose.room) + surprise_[body]);
    const Vec2 expected(dt * static_cast<double>(pose.velocityX), dt * static_cast<double>(pose.velocityY));
    double part = 1;
    for (int axis = 0; axis < 2; ++axis) {
        const double most = move[axis] > 0 ? std::max(expected[axis], 0.0) : std::max(-expected[axis], 0.0);
        if (std::abs(move[axis]) > most + room) part = std::min(part, (most + room) / std::abs(move[axis]));
    }
    return static_cast<float>(part);
}

/// What overlaps already is pushed apart, but a centre that comes to the other side would be pushed on.
float Collider::untilCentrePasses(const RigidContact& c, const Vec2& relativeMove) const
{
    constexpr double kCore = 0.5;  // of the centre's distance from the surface: it comes no nearer in one step
    const Pose &poseA = poses_[c.bodyA], &poseB = poses_[c.bodyB];
    const Vec2f n = turned(poseA.turn, c.normal), on = turned(poseA.turn, c.onA[0]);
    const Vec2 normal(n.x, n.y), toB(poseB.x - poseA.x - on.x, poseB.y - poseA.y - on.y);
    const double closing = -normal.dot(relativeMove);
    double away = std::numeric_limits<double>::infinity();
    if (bodies_[c.bodyB].moves) away = std::min(away, toB.dot(normal));
    if (bodies_[c.bodyA].moves) away = std::min(away, Vec2(on.x, on.y).dot(normal));
    return away > 0 && closing > kCore * away ? static_cast<float>(kCore * away / closing) : 1.0F;
}

void Collider::stopTunnelling(std::vector<float>& allowed, std::span<const Vec2> moves, std::span<const double> turns,
                              double dt, Pool& pool, Arena& arena, const std::function<void()>& beside)
{
    allowed.assign(bodies_.size(), 1.0F);
    if (contacts_.empty()) return beside();
    const std::size_t mark = arena.mark();
    going_ = arena.take<Going>(bodies_.size());
    going_[0] = {};  // the background
    std::atomic<float> farthest = 0;
    pool.ranges(bodies_.size(), kBodiesABlock, [&](std::size_t first, std::size_t last) {
        float most = 0;
        for (auto i = static_cast<Index>(std::max<std::size_t>(first, 1)); i < last; ++i) {
            const Vec2f move{static_cast<float>(moves[i].x()), static_cast<float>(moves[i].y())};
            most = std::max({most, std::abs(move.x), std::abs(move.y)});
            if (bodies_[i].moves) allowed[i] = withinBox(i, moves[i], dt);
            going_[i] = {move, allowed[i]};
        }
        float before = farthest.load(std::memory_order_relaxed);
        while (before < most && !farthest.compare_exchange_weak(before, most, std::memory_order_relaxed)) {
        }
    });
    const float dropped = 1e-6F * farthest.load(std::memory_order_relaxed);  // the digits that single precision drops
    const std::size_t blocks = (contacts_.size() + kMarkedABlock - 1) / kMarkedABlock;
    if (stopsBy_.size() < blocks) stopsBy_.resize(blocks);
    const Moves all{moves, turns, dropped, dt};
    const auto find = [&](std::size_t block) {
        stopsBy_[block].clear();
        const std::size_t last = std::min(contacts_.size(), (block + 1) * kMarkedABlock);
        findStops(block * kMarkedABlock, last, all, stopsBy_[block]);
    };
    pool.beside(blocks, find, beside);
    // What another moving body has hit must give way to it.
    for (std::size_t block = 0; block < blocks; ++block)
        for (const Stop& stop : stopsBy_[block])
            if (stop.part > 1) allowed[stop.bodyA] = allowed[stop.bodyB] = 1;
    for (std::size_t block = 0; block < blocks; ++block)
        for (const Stop& stop : stopsBy_[block])
            for (const Index body : {stop.bodyA, stop.bodyB})
                if (stop.part <= 1 && bodies_[body].moves) allowed[body] = std::min(allowed[body], stop.part);
    going_ = {};
    arena.release(mark);
}

/// Of contacts [first, last), in an order that does not matter.
void Collider::findStops(std::size_t first, std::size_t last, const Moves& all, std::vector<Stop>& stops) const
{
    for (std::size_t i = first; i < last; ++i) {
        const Nearing& n = nearing_[i];
        const Going &a = going_[n.bodyA], &b = going_[n.bodyB];
        const Vec2f rough = b.move - a.move;
        const float most = 0.9999F * n.thin - all.dropped;
        const bool passes = !(most > 0) | !(dot(rough, rough) <= most * most);
        const bool held = (a.allowed < 1) | (b.allowed < 1);
        if (!(passes | held) || places_[i] == kFree) continue;
        const RigidContact& c = contacts_[i];
        if (held && c.count > 0 && poses_[c.bodyA].travel > 0 && poses_[c.bodyB].travel > 0)
            stops.push_back({c.bodyA, c.bodyB, kGivesWay});
        const float part = passes ? untilPassed(c, n.thin, all) : 1;
        if (part < 1) stops.push_back({c.bodyA, c.bodyB, part});
    }
}

/// The part of their moves after which the two would pass through each other.
float Collider::untilPassed(const RigidContact& c, float thin, const Moves& all) const
{
    const Vec2 relativeMove = all.moves[c.bodyB] - all.moves[c.bodyA];
    if (!(relativeMove.squaredNorm() > static_cast<double>(thin) * static_cast<double>(thin))) return 1;
    if (!c.resolve || fromBehind(c)) return 1;
    if (c.nearest() <= 0) return c.count > 0 ? untilCentrePasses(c, relativeMove) : 1;
    Pose a = poses_[c.bodyA], b = poses_[c.bodyB];
    const auto actual = [&](Pose& pose, Index body) {
        pose.velocityX = clamped(all.moves[body].x() / all.dt), pose.velocityY = clamped(all.moves[body].y() / all.dt);
        pose.omega = clamped(all.turns[body] / all.dt);
    };
    actual(a, c.bodyA), actual(b, c.bodyB);
    // A little deeper than contacts come by themselves.
    const float hit = timeOfImpact(parts_[c.partA], parts_[c.partB], a, b, all.dt, -2 * c.slop, *looker_);
    return hit > 0 ? hit : 1;  // 0: lies in it already: to be pushed out, not to be held
}

}  // namespace jet::physics
