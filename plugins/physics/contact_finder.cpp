#include "contact_finder.hpp"

#include "border.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace jet::physics {

namespace {

// What a body may stray from its predicted motion before contacts are sought again: larger finds more useless contacts,
// smaller seeks more often.
constexpr double kStrayLengths = 0.02, kStrayOfMotion = 0.1;
// Hits faster than this many lengths of the smaller body a step are looked ahead for, through chains of so many bodies.
constexpr double kHitLengths = 0.25;
constexpr int kHitRounds = 3;
// One-sided platforms: cosine of the greatest angle from which they hold; slops behind one that has not come over it.
constexpr double kHolds = 0.5, kBehindSlops = 8;

double millisecondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

bool meetsItself(const BodyRecord& body)
{
    return body.meetsOwn() && !body.fixed && !body.kinematic && body.enabled && body.walls.count > 0;
}

/// In the midst of a step.
void readAgain(State& state)
{
    updatePoints(state);
    for (Index handle = 0; handle < state.bodies.size(); ++handle)
        if (!state.bodies[handle].rigid) updateReading(state, handle);
}

ContactPoint patternOf(const BodyRecord& a, const BodyRecord& b, const WorldSettings& settings)
{
    const MaterialPair& pair =
        settings.materials[static_cast<std::size_t>(a.material) * settings.materialCount + b.material];
    ContactPoint pattern;
    const double lengthA = a.fixed ? b.length : a.length, lengthB = b.fixed ? a.length : b.length;
    pattern.slop = kSlopPerLength * std::min(lengthA, lengthB);
    pattern.thickness = a.thickness() + b.thickness();
    pattern.friction = pair.friction;
    pattern.restitution = pair.restitution;
    pattern.resolve = settings.resolveCollisions && !a.sensor && !b.sensor;
    return pattern;
}

/// The walls of a platform that hold.
class PlatformSide {
public:
    PlatformSide(const State& state, Index platform, const Vec2& side)
        : state_(state), walls_(state.bodies[platform].walls), side_(side)
    {
    }

    /// Unit, out of the wall's body.
    Vec2 outward(Index wall) const
    {
        const Vec2 edge = state_.points.position[state_.walls.second[wall]] - start(wall);
        const double length = edge.norm();
        return length > 0 ? Vec2(perpendicular(edge) * (state_.walls.outward[wall] / length)) : Vec2(0, 0);
    }
    bool faces(const Vec2& outward) const { return outward.dot(side_) >= kHolds; }
    bool holds(Index wall) const { return faces(outward(wall)); }

    struct Seen {
        Index wall;
        double separation = 0;
    };
    /// The nearest holding wall beside which the point is; else `usual`, with nothing between.
    Seen nearest(Index point, Index usual) const
    {
        Seen seen{usual};
        double least = std::numeric_limits<double>::infinity();
        const Vec2& at = state_.points.position[point];
        for (Index wall = walls_.first; wall < walls_.end(); ++wall) {
            const Vec2 normal = outward(wall), offset = at - start(wall);
            if (!faces(normal)) continue;
            const Vec2 edge = state_.points.position[state_.walls.second[wall]] - start(wall);
            const double along = offset.dot(edge), separation = offset.dot(normal);
            if (along < 0 || along > edge.squaredNorm() || std::abs(separation) >= least) continue;
            least = std::abs(separation);
            seen = {wall, separation};
        }
        return seen;
    }
    /// Is a point of the body farther behind the wall nearest to it?
    bool anyBehind(Index body, double depth) const
    {
        const Range& points = state_.bodies[body].points;
        for (Index p = points.first; p < points.end(); ++p)
            if (state_.points.collidable[p] && nearest(p, kNone).separation < -depth) return true;
        return false;
    }

private:
    const Vec2& start(Index wall) const { return state_.points.position[state_.walls.first[wall]]; }

    const State& state_;
    const Range walls_;
    const Vec2 side_;
};

}  // namespace

void ContactFinder::seek(State& state, const WorldSettings& settings, double dt, bool first, StepStats& stats)
{
    const auto start = std::chrono::steady_clock::now();
    // Nothing can meet where there is only one body.
    std::size_t bodies = 0;
    for (const BodyRecord& body : state.bodies)
        bodies += body.points.count == 0 || body.removed ? 0 : body.meetsOwn() ? 2 : 1;
    lonely_ = bodies < 2;
    clear();
    if (lonely_) return;
    if (!first) readAgain(state);
    predict(state, settings, dt);
    findPairs(state, motions_, pairs_);
    for (int round = 0; round < kHitRounds && expectHits(state, dt); ++round) findPairs(state, motions_, pairs_);
    stats.broadPhaseMs += millisecondsSince(start);
}

void ContactFinder::find(State& state, const WorldSettings& settings, double dt, std::vector<ContactPoint>& contacts,
                         StepStats& stats)
{
    if (lonely_) {
        contacts.clear();
        return;
    }
    const auto narrow = std::chrono::steady_clock::now();
    previous_.swap(contacts);
    contacts.clear();
    splitPairs(state, dt);
    readBorders(state);
    collidePairs(state, settings, dt, previous_, contacts);
    carryOver(state, previous_, contacts);
    stats.narrowPhaseMs += millisecondsSince(narrow);
}

/// Corners of the soft bodies that may meet something; and grids of their walls, where points of the other come near.
void ContactFinder::readBorders(State& state)
{
    constexpr std::uint8_t kCorners = 1, kGrid = 2;
    constexpr Index kManyPoints = 64;
    read_.assign(state.bodies.size(), 0);
    const auto comesNear = [&](Index handle, Index other) {
        const BodyRecord &body = state.bodies[handle], &points = state.bodies[other];
        if (handle == other || points.points.count > kManyPoints) return true;
        const double margin = motions_[other].range + body.thickness() + points.thickness();
        const Box near = motions_[handle].reach.inflated(margin);
        for (Index p = points.points.first; p < points.points.end(); ++p)
            if (near.contains(state.points.position[p])) return true;
        return false;
    };
    const auto read = [&](Index handle, Index other) {
        BodyRecord& body = state.bodies[handle];
        if (body.rigid) return;
        // Also where the border tore away: its points have no normals any more.
        if ((read_[handle] & kCorners) == 0) updateCorners(state, body);
        if (body.walls.count > 0 && (read_[handle] & kGrid) == 0 && comesNear(handle, other))
            rebuildGrid(state, body), read_[handle] |= kGrid;
        read_[handle] |= kCorners;
    };
    for (const BodyPair& pair : pairs_)
        if (!state.atRest(pair.a, pair.b)) read(pair.a, pair.b), read(pair.b, pair.a);
}

/// A body that a much faster one may hit gets the faster one's reach: within this very step it may have to be stopped
/// by a wall that it would not have come near. Says whether any reach grew.
bool ContactFinder::expectHits(const State& state, double dt)
{
    bool grew = false;
    for (const BodyPair& pair : pairs_) {
        const BodyRecord &a = state.bodies[pair.a], &b = state.bodies[pair.b];
        if (a.fixed || b.fixed) continue;
        const double closing = (motions_[pair.a].velocity - motions_[pair.b].velocity).norm() * dt;
        const double reach = std::max({closing, motions_[pair.a].surprise, motions_[pair.b].surprise});
        if (reach < kHitLengths * std::min(a.length, b.length)) continue;
        for (Motion* motion : {&motions_[pair.a], &motions_[pair.b]}) {
            if (motion->range >= reach) continue;
            motion->surprise = reach;
            motion->stray += reach;
            motion->reach = motion->reach.inflated(reach);
            motion->range += reach;
            grew = true;
        }
    }
    return grew;
}

bool ContactFinder::isSlow(const State& state, const BodyPair& pair, double dt) const
{
    const BodyRecord &a = state.bodies[pair.a], &b = state.bodies[pair.b];
    const Motion &motionA = motions_[pair.a], &motionB = motions_[pair.b];
    return motionA.surprise == 0 && motionB.surprise == 0 &&
           (motionA.velocity - motionB.velocity).norm() * dt < kHitLengths * std::min(a.length, b.length);
}

/// Leaves in pairs_ what does not go by soft/contacts.hpp; adds bodies that collide with themselves.
void ContactFinder::splitPairs(const State& state, double dt)
{
    const auto wide = [&](const BodyPair& pair) {
        return state.bodies[pair.a].wide && state.bodies[pair.b].wide && !state.filters[pair.a].isOneSided() &&
               !state.filters[pair.b].isOneSided() && (state.atRest(pair.a, pair.b) || isSlow(state, pair, dt));
    };
    for (Index body = 0; body < state.bodies.size(); ++body)
        if (meetsItself(state.bodies[body])) pairs_.push_back({body, body});
    const auto joined = [&](const BodyPair& pair) {
        return std::binary_search(excluded_.begin(), excluded_.end(), std::pair(pair.a, pair.b));
    };
    if (!excluded_.empty()) pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), joined), pairs_.end());
    for (const BodyPair& pair : pairs_)
        if (wide(pair)) softPairs_.push_back(pair);
    pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), wide), pairs_.end());
    std::sort(softPairs_.begin(), softPairs_.end(),
              [](const BodyPair& p, const BodyPair& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); });
}

void ContactFinder::collidePairs(const State& state, const WorldSettings& settings, double dt,
                                 std::span<const ContactPoint> previous, std::vector<ContactPoint>& contacts)
{
    NarrowPhase narrow(state, motions_, previous, dt);
    for (const BodyPair& pair : pairs_) {
        const BodyRecord &a = state.bodies[pair.a], &b = state.bodies[pair.b];
        if (!settings.materials[static_cast<std::size_t>(a.material) * settings.materialCount + b.material].collides)
            continue;
        if (state.atRest(pair.a, pair.b)) continue;
        const ContactPoint pattern = patternOf(a, b, settings);
        if (pair.a == pair.b) {
            if (a.soft->matter.selfCollision) narrow.collideSelf(pair.a, pattern, contacts);
            continue;
        }
        const std::size_t first = contacts.size();
        narrow.collide(pair.a, pair.b, pattern, contacts);
        narrow.collide(pair.b, pair.a, pattern, contacts);
        if (!pattern.resolve) continue;
        decideSide(state, pair.a, pair.b, previous, first, contacts);
        decideSide(state, pair.b, pair.a, previous, first, contacts);
    }
    keepResting(state, settings, previous, contacts);
    // A point inside may have been found twice at one wall: once at its front, once to be pushed out; the latter
    // counts.
    std::sort(contacts.begin(), contacts.end(), [](const ContactPoint& p, const ContactPoint& q) {
        return p.key() < q.key() || (p.key() == q.key() && p.inside && !q.inside);
    });
    contacts.erase(std::unique(contacts.begin(), contacts.end(),
                               [](const ContactPoint& p, const ContactPoint& q) { return p.key() == q.key(); }),
                   contacts.end());
}

/// Of bodies that rest nothing is sought: their contacts are those they had.
void ContactFinder::keepResting(const State& state, const WorldSettings& settings,
                                std::span<const ContactPoint> previous, std::vector<ContactPoint>& contacts) const
{
    for (const ContactPoint& c : previous) {
        if (!state.atRest(c.bodyA, c.bodyB)) continue;
        ContactPoint kept = patternOf(state.bodies[c.bodyA], state.bodies[c.bodyB], settings);
        kept.point = c.point, kept.wall = c.wall, kept.bodyA = c.bodyA, kept.bodyB = c.bodyB;
        kept.inside = c.inside, kept.engaged = c.engaged, kept.active = c.active, kept.along = c.along;
        kept.normalImpulse = c.normalImpulse, kept.tangentImpulse = c.tangentImpulse;
        kept.stepImpulse = c.stepImpulse;
        contacts.push_back(kept);
    }
}

/// What a one-sided platform is to the other body: contacts from `first` on that do not hold it are dropped. It holds
/// what comes against its direction, within 60°. What it does not hold, and has a point behind such a wall of it, comes
/// from behind or beside, and passes until none is.
void ContactFinder::decideSide(const State& state, Index platform, Index other, std::span<const ContactPoint> previous,
                               std::size_t first, std::vector<ContactPoint>& contacts)
{
    const Filter filter = state.filters[platform];
    if (!filter.isOneSided() || first == contacts.size()) return;
    const PlatformSide side(state, platform, filter.side());
    const auto pushes = [&](const ContactPoint& c) {
        return std::minmax(c.bodyA, c.bodyB) == std::minmax(platform, other) &&
               (c.normalImpulse > 0 || c.stepImpulse > 0);
    };
    const bool held = std::any_of(previous.begin(), previous.end(), pushes);
    const auto from = contacts.begin() + static_cast<std::ptrdiff_t>(first);
    if (!held && side.anyBehind(other, kBehindSlops * from->slop)) {
        contacts.erase(from, contacts.end());
        return;
    }
    // Inside a thin platform the nearest way out is behind it.
    for (auto c = from; c != contacts.end(); ++c)
        if (c->inside && c->bodyB == platform && !side.holds(c->wall)) c->wall = side.nearest(c->point, c->wall).wall;
    const auto wrong = [&](const ContactPoint& c) {
        return c.bodyB == platform ? !side.holds(c.wall) : !side.faces(-side.outward(c.wall));
    };
    contacts.erase(std::remove_if(from, contacts.end(), wrong), contacts.end());
}

/// Impulses go to the same point at the same wall, else, where a point slid on, at the neighbouring wall.
void ContactFinder::carryOver(const State& state, std::span<const ContactPoint> previous,
                              std::vector<ContactPoint>& contacts)
{
    auto old = previous.begin();
    for (ContactPoint& c : contacts) {
        while (old != previous.end() && old->point < c.point) ++old;
        const ContactPoint* from = nullptr;
        for (auto it = old; it != previous.end() && it->point == c.point; ++it) {
            if (it->wall == c.wall) {
                from = &*it;
                break;
            }
            const bool neighbour = it->wall == state.walls.previous[c.wall] || it->wall == state.walls.next[c.wall];
            if (neighbour && it->active && it->normalImpulse > 0) from = &*it;
        }
        if (!from) continue;
        const bool same = from->wall == c.wall;
        // Only a point that leaves the neighbouring wall brings its impulse along; one held by both has its own.
        if (!same && from->along >= 0 && from->along <= 1) continue;
        c.normalImpulse = from->normalImpulse;
        c.tangentImpulse = from->tangentImpulse;
        c.along = same ? from->along : from->wall == state.walls.next[c.wall] ? 1 : 0;  // the corner it went round
        if (same) c.stepImpulse = from->stepImpulse, c.engaged = from->engaged && from->active;
    }
}

void ContactFinder::collectEnded(std::span<const ContactPoint> contacts, std::vector<ContactPoint>& ended) const
{
    auto now = contacts.begin();
    for (const ContactPoint& c : previous_) {
        while (now != contacts.end() && now->key() < c.key()) ++now;
        const bool persists = now != contacts.end() && now->key() == c.key();
        if (!persists && c.stepImpulse > 0) ended.push_back(c);
    }
}

void ContactFinder::predict(const State& state, const WorldSettings& settings, double dt)
{
    motions_.assign(state.bodies.size(), Motion());
    budgets_.assign(state.bodies.size(), 0.0);
    for (Index handle = 0; handle < state.bodies.size(); ++handle)
        predictBody(state, handle, settings, dt, motions_[handle], budgets_[handle]);
    offs_.clear();
    for (const Motion& motion : motions_) offs_.push_back(motion.off);
    position_ = state.nodes.position;
    velocity_ = state.nodes.velocity;
    angle_ = state.nodes.angle;
    omega_ = state.nodes.omega;
}

void ContactFinder::predictBody(const State& state, Index handle, const WorldSettings& settings, double dt,
                                Motion& motion, double& budget) const
{
    const BodyRecord& body = state.bodies[handle];
    const Nodes& nodes = state.nodes;
    const Index first = body.nodes.first;
    if (!body.enabled) return;
    if (body.rigid) {
        for (Index p = body.points.first; p < body.points.end(); ++p) motion.reach.extend(state.points.position[p]);
    } else if (body.points.count > 0) {
        motion.reach = state.readings.bounds[handle];
    }
    if (body.fixed || body.nodes.count == 0) return;

    double spread = 0;
    if (body.rigid) {
        motion.centre = nodes.position[first];
        motion.velocity = nodes.velocity[first];
        motion.omega = nodes.omega[first];
    } else {
        motion.centre = state.readings.position[handle];
        motion.velocity = state.readings.velocity[handle];
        motion.omega = state.readings.omega[handle];
        const soft::Cloud cloud{nodes.position[first].data(), nodes.velocity[first].data(), &nodes.mass[first],
                                body.soft->restArms[0].data(), body.nodes.count};
        const Vec2 turn = body.soft->bestTurn();
        const soft::CloudMotion rigid{
            motion.centre.x(), motion.centre.y(), motion.velocity.x(), motion.velocity.y(), motion.omega,
            turn.x(),          turn.y()};
        const soft::CloudStray stray = clouds_->stray(cloud, rigid);
        spread = motion.spread = std::sqrt(stray.speed);
        if (!turn.isZero()) motion.off = std::sqrt(stray.off);
    }
    const double radius = motion.radius = 0.5 * motion.reach.size().norm();
    const double turning = std::min(std::abs(motion.omega) * dt, 2.0) * radius;
    const double gravity = settings.applyGravity ? settings.gravity.norm() * std::abs(body.gravityScale) : 0;
    budget = kStrayLengths * body.length + kStrayOfMotion * (motion.velocity.norm() * dt + turning) + gravity * dt * dt;
    motion.stray = budget + spread * dt;
    motion.range = motion.velocity.norm() * dt + turning + motion.stray;
    const Vec2 step = motion.velocity * dt;
    Box moved = motion.reach;
    moved.min += step, moved.max += step;
    motion.reach.extend(moved);
    motion.reach = motion.reach.inflated(turning + motion.stray + 4 * kSlopPerLength * body.length + body.thickness());
}

bool ContactFinder::strayed(const State& state, double elapsed)
{
    if (lonely_) return false;
    const Nodes& nodes = state.nodes;
    for (Index handle = 0; handle < state.bodies.size(); ++handle) {
        const BodyRecord& body = state.bodies[handle];
        if (body.fixed || body.flown || body.asleep || body.points.count == 0) continue;
        const Index n = body.nodes.first;
        const double off = clouds_->farthest(nodes.position[n].data(), position_[n].data(), velocity_[n].data(),
                                             elapsed, body.nodes.count);
        if (body.rigid) {
            const double turned = std::abs(nodes.angle[n] - angle_[n] - elapsed * omega_[n]);
            if (std::sqrt(off) + static_cast<double>(body.radius) * turned > budgets_[handle]) return true;
            continue;
        }
        if (off > budgets_[handle] * budgets_[handle]) return true;
        // What they moved besides counts twice, as the fit may turn by it. A turn takes them off a straight line.
        const Motion& motion = motions_[handle];
        const double turn = std::abs(motion.omega) * elapsed;
        offs_[handle] = motion.off * (1 + turn) + 2 * (std::sqrt(off) + elapsed * motion.spread) +
                        0.5 * turn * turn * motion.radius;
    }
    return false;
}

double ContactFinder::freedomOf(Index body) const
{
    if (lonely_) return std::numeric_limits<double>::infinity();
    const auto has = [body](const BodyPair& pair) { return pair.a == body || pair.b == body; };
    const auto none = [&](const std::vector<BodyPair>& pairs) { return std::none_of(pairs.begin(), pairs.end(), has); };
    return none(pairs_) && none(softPairs_) ? budgets_[body] : 0;
}

}  // namespace jet::physics
