#include "collider.hpp"

#include <chrono>
#include <cmath>

namespace jet::physics {

namespace {

constexpr float kSlop = 0.002F;    // of the length of the smaller part
constexpr float kRoom = 0.12F;     // of the typical length: margin of the boxes
constexpr float kSpeculative = 4;  // slops: nearer than this a pair gets points even without closing speed
constexpr float kReuseMove = 1.0F, kReuseTurn = 0.01F;  // slops, radians: points are kept
constexpr float kFast = 0.5F;  // lengths a step: faster pairs are foreseen by their time of impact
constexpr int kHitRounds = 3;

float clamped(double x) { return static_cast<float>(std::clamp(x, -3e37, 3e37)); }

}  // namespace

Index Collider::addBody(const RigidBody& body)
{
    bodies_.push_back(body);
    bodies_.back().firstPart = static_cast<Index>(parts_.size());
    return static_cast<Index>(bodies_.size() - 1);
}

void Collider::addPart(Part part)
{
    RigidBody& body = bodies_.back();
    part.body = static_cast<Index>(bodies_.size() - 1);
    body.length = body.partCount == 0 ? part.length : std::max(body.length, part.length);
    body.reach = std::max(body.reach, part.reach);
    ++body.partCount;
    parts_.push_back(part);
    typical_ = 0;
}

void Collider::find(const State& state, const WorldSettings& settings, double dt, StepStats& stats)
{
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    takePoses(state, settings, dt);
    fitBoxes(dt);
    ended_.clear();
    findPairs(settings);
    for (int round = 0; round < kHitRounds && expectHits(dt); ++round) findPairs(settings);
    const auto narrow = Clock::now();
    worstHit_ = 0;
    std::size_t kept = 0;
    for (RigidContact& c : contacts_) {
        if (!update(c, dt)) {
            known_.erase(c.key());
            if (c.touching) ended_.push_back(c);
            continue;
        }
        if (&contacts_[kept] != &c) contacts_[kept] = c;
        ++kept;
    }
    contacts_.resize(kept);
    stats.broadPhaseMs += std::chrono::duration<double, std::milli>(narrow - start).count();
    stats.narrowPhaseMs += std::chrono::duration<double, std::milli>(Clock::now() - narrow).count();
}

void Collider::takePoses(const State& state, const WorldSettings& settings, double dt)
{
    if (typical_ == 0 && !parts_.empty()) {
        std::vector<float> lengths;
        for (const Part& part : parts_)
            if (bodies_[part.body].moves) lengths.push_back(part.length);
        if (lengths.empty()) lengths.push_back(parts_[0].length);
        std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2),
                         lengths.end());
        typical_ = lengths[lengths.size() / 2];
    }
    poses_.resize(bodies_.size());
    surprise_.assign(bodies_.size(), 0.0F);
    const double fall = settings.applyGravity ? settings.gravity.norm() * dt * dt : 0;
    for (Index i = 1; i < bodies_.size(); ++i) {
        const RigidBody& body = bodies_[i];
        Pose& pose = poses_[i];
        const Nodes& nodes = state.nodes;
        pose.x = nodes.position[body.node].x(), pose.y = nodes.position[body.node].y();
        pose.turn = {static_cast<float>(nodes.rotation[body.node].x()),
                     static_cast<float>(nodes.rotation[body.node].y())};
        pose.velocityX = clamped(nodes.velocity[body.node].x()),
        pose.velocityY = clamped(nodes.velocity[body.node].y());
        pose.omega = clamped(nodes.omega[body.node]);
        const float turning = std::min(std::abs(pose.omega) * static_cast<float>(dt), 2.0F) * body.reach;
        pose.travel =
            turning + (body.moves ? static_cast<float>(fall) : 0) +
            static_cast<float>(dt) * std::sqrt(pose.velocityX * pose.velocityX + pose.velocityY * pose.velocityY);
    }
}

/// A box is fitted anew when the part, with what it moves in this step, may leave it.
void Collider::fitBoxes(double dt)
{
    if (sweep_.boxes().size() != parts_.size()) sweep_.resize(parts_.size());
    const std::size_t known = fitted_.size();
    fitted_.resize(bodies_.size());
    room_.resize(bodies_.size(), -1);
    for (Index i = 1; i < bodies_.size(); ++i) {
        const Pose &pose = poses_[i], &old = fitted_[i];
        if (i < known && room_[i] >= 0) {
            const float dx = static_cast<float>(pose.x - old.x), dy = static_cast<float>(pose.y - old.y);
            const float turn = std::abs(cross(old.turn, pose.turn)) + (dot(old.turn, pose.turn) < 0 ? 2 : 0);
            if (std::sqrt(dx * dx + dy * dy) + 1.2F * turn * bodies_[i].reach + pose.travel <= room_[i]) continue;
        }
        fitted_[i] = pose;
        room_[i] = kRoom * typical_;
        for (Index p = 0; p < bodies_[i].partCount; ++p) fitBox(bodies_[i].firstPart + p, pose, room_[i], dt);
    }
}

void Collider::fitBox(Index index, const Pose& pose, float room, double dt)
{
    const Part& part = parts_[index];
    float minX = 3e38F, minY = 3e38F, maxX = -3e38F, maxY = -3e38F;
    for (int i = 0; i < part.count; ++i) {
        const Vec2f at = turned(pose.turn, part.corners[i]);
        minX = std::min(minX, at.x), maxX = std::max(maxX, at.x);
        minY = std::min(minY, at.y), maxY = std::max(maxY, at.y);
    }
    const float stepX = pose.velocityX * static_cast<float>(dt), stepY = pose.velocityY * static_cast<float>(dt);
    const float straight = std::sqrt(stepX * stepX + stepY * stepY);
    // Far from the origin single precision has gaps; they are added.
    const float gap = static_cast<float>(2e-7 * (std::abs(pose.x) + std::abs(pose.y)));
    const float margin = part.radius + room + gap + (pose.travel - straight);
    FatBox& box = sweep_.box(index);
    box.minX = static_cast<float>(pose.x) + minX + std::min(stepX, 0.0F) - margin;
    box.maxX = static_cast<float>(pose.x) + maxX + std::max(stepX, 0.0F) + margin;
    box.minY = static_cast<float>(pose.y) + minY + std::min(stepY, 0.0F) - margin;
    box.maxY = static_cast<float>(pose.y) + maxY + std::max(stepY, 0.0F) + margin;
    sweep_.markMoved(index);
}

void Collider::findPairs(const WorldSettings& settings)
{
    if (!sweep_.anyMoved()) return;
    sweep_.sweep([&](Index a, Index b) { addPair(a, b, settings); });
}

void Collider::addPair(Index partA, Index partB, const WorldSettings& settings)
{
    // A moving round part rests on sides of the other: circles come second.
    if (parts_[partA].count < parts_[partB].count && parts_[partA].count == 1) std::swap(partA, partB);
    const Index a = parts_[partA].body, b = parts_[partB].body;
    const RigidBody &bodyA = bodies_[a], &bodyB = bodies_[b];
    if (a == b || (!bodyA.moves && !bodyB.moves)) return;
    if (bodyA.group != 0 && bodyA.group == bodyB.group) return;
    if ((bodyA.layer & bodyB.mask) == 0 || (bodyB.layer & bodyA.mask) == 0) return;
    const MaterialPair& pair =
        settings.materials[static_cast<std::size_t>(bodyA.material) * settings.materialCount + bodyB.material];
    if (!pair.collides || apart(partA, partB) || excluded_.contains(bodyKey(a, b))) return;
    RigidContact c;
    c.partA = partA, c.partB = partB, c.bodyA = a, c.bodyB = b;
    if (!known_.insert(c.key())) return;
    c.friction = static_cast<float>(pair.friction), c.restitution = static_cast<float>(pair.restitution);
    const float lengthA = parts_[partA].length, lengthB = parts_[partB].length;
    c.slop = kSlop * (!bodyA.moves ? lengthB : !bodyB.moves ? lengthA : std::min(lengthA, lengthB));
    c.resolve = !bodyA.sensor && !bodyB.sensor;
    contacts_.push_back(c);
}

/// Boxes of long oblique parts meet much that they do not: here B's box is looked at from A's sides.
bool Collider::apart(Index partA, Index partB) const
{
    const Index longer = parts_[partA].length >= parts_[partB].length ? partA : partB;
    const Part& part = parts_[longer];
    if (part.count < 2) return false;
    const FatBox& box = sweep_.box(longer == partA ? partB : partA);
    const Pose& pose = poses_[part.body];
    const float halfX = 0.5F * (box.maxX - box.minX), halfY = 0.5F * (box.maxY - box.minY);
    const double middleX = 0.5 * (static_cast<double>(box.minX) + box.maxX),
                 middleY = 0.5 * (static_cast<double>(box.minY) + box.maxY);
    const Vec2f middle{static_cast<float>(middleX - pose.x), static_cast<float>(middleY - pose.y)};
    const float room = part.radius + std::max(room_[part.body], 0.0F) + pose.travel + surprise_[part.body];
    for (int i = 0; i < part.count; ++i) {
        const Vec2f n = turned(pose.turn, part.normals[i]);
        const float away =
            dot(n, middle) - dot(part.normals[i], part.corners[i]) - std::abs(n.x) * halfX - std::abs(n.y) * halfY;
        if (away > room) return true;
    }
    return false;
}

/// A body that a much faster one may hit gets room for it: within this very step it may have to be stopped by a wall
/// that it would not have come near.
bool Collider::expectHits(double dt)
{
    bool grew = false;
    for (const RigidContact& c : contacts_) {
        const RigidBody &a = bodies_[c.bodyA], &b = bodies_[c.bodyB];
        if (!c.resolve || !(a.moves || a.kinematic) || !(b.moves || b.kinematic)) continue;
        const float travel =
            std::max({poses_[c.bodyA].travel, poses_[c.bodyB].travel, surprise_[c.bodyA], surprise_[c.bodyB]});
        if (travel < kFast * std::min(parts_[c.partA].length, parts_[c.partB].length)) continue;
        for (const Index body : {c.bodyA, c.bodyB}) {
            if (!bodies_[body].moves || std::max(poses_[body].travel, surprise_[body]) >= 0.999F * travel) continue;
            surprise_[body] = travel;
            room_[body] = kRoom * typical_ + travel;
            for (Index p = 0; p < bodies_[body].partCount; ++p)
                fitBox(bodies_[body].firstPart + p, poses_[body], room_[body], dt);
            room_[body] = -1;  // fitted closely again in the next step
            grew = true;
        }
    }
    return grew;
}

Relative Collider::relative(Index bodyA, Index bodyB) const
{
    const Pose &a = poses_[bodyA], &b = poses_[bodyB];
    Relative at;
    at.move = turnedBack(a.turn, {static_cast<float>(b.x - a.x), static_cast<float>(b.y - a.y)});
    at.turn = turnedBack(a.turn, b.turn);
    return at;
}

/// Brings the pair's points up to date; false: they are far apart and the pair is to be forgotten.
bool Collider::update(RigidContact& c, double dt)
{
    if (!sweep_.box(c.partA).meets(sweep_.box(c.partB))) return false;
    const Part &a = parts_[c.partA], &b = parts_[c.partB];
    const Pose &poseA = poses_[c.bodyA], &poseB = poses_[c.bodyB];
    const Relative at = relative(c.bodyA, c.bodyB);
    const float dx = poseB.velocityX - poseA.velocityX, dy = poseB.velocityY - poseA.velocityY;
    const float turning =
        std::abs(poseA.omega) * bodies_[c.bodyA].reach + std::abs(poseB.omega) * bodies_[c.bodyB].reach;
    const float closing = std::sqrt(dx * dx + dy * dy) + turning;
    const float shorter = std::min(a.length, b.length);
    const float travel = closing * static_cast<float>(dt);
    const float reach =
        kSpeculative * c.slop + std::min(travel, kFast * shorter) + surprise_[c.bodyA] + surprise_[c.bodyB];
    if (reuse(c, at, reach)) return true;
    if ((travel > 0.1F * shorter || c.count == 0) && apart(c.partA, c.partB) && apart(c.partB, c.partA)) return false;
    renew(c, physics::collide(a, b, at, reach), at, reach);
    if (c.count > 0 && c.separation[0] > 0 && travel > kFast * shorter) c.count = 0;
    if (c.count == 0 && c.resolve && travel > kFast * shorter) foresee(c, at, dt);
    if (c.count > 0 && c.resolve) {
        // The speed at which the touching points come together.
        const Vec2f n = turned(poseA.turn, c.normal), armA = turned(poseA.turn, c.onA[0]),
                    armB = turned(poseB.turn, c.onB[0]);
        const float approach = -(n.x * dx + n.y * dy + poseB.omega * cross(armB, n) - poseA.omega * cross(armA, n));
        worstHit_ = std::max(worstHit_, approach / shorter);
    }
    if (bodies_[c.bodyA].oneSidedX != 0 || bodies_[c.bodyA].oneSidedY != 0 || bodies_[c.bodyB].oneSidedX != 0 ||
        bodies_[c.bodyB].oneSidedY != 0)
        decideSide(c);
    return true;
}

/// While two parts hardly move against each other, the points stay on their surfaces and only the separation changes.
bool Collider::reuse(RigidContact& c, const Relative& at, float reach) const
{
    const Vec2f moved = at.move - c.at.move;
    const float most = kReuseMove * c.slop;
    if (dot(moved, moved) > most * most || std::abs(cross(c.at.turn, at.turn)) > kReuseTurn ||
        dot(c.at.turn, at.turn) < 0 || reach > c.reach + c.slop || c.passing)
        return false;
    for (int i = 0; i < c.count; ++i) c.separation[i] = dot(c.normal, at.move + turned(at.turn, c.onB[i]) - c.onA[i]);
    return true;
}

/// Impulses go on with the features they belong to.
void Collider::renew(RigidContact& c, const Manifold& m, const Relative& at, float reach) const
{
    const RigidContact old = c;
    c.at = at, c.reach = reach;
    c.count = static_cast<std::uint8_t>(m.count);
    c.normal = m.normal;
    for (int i = 0; i < m.count; ++i) {
        const ManifoldPoint& p = m.points[i];
        c.onA[i] = p.onA, c.onB[i] = p.onB, c.ids[i] = p.id, c.separation[i] = p.separation;
        c.impulse[i] = c.tangentImpulse[i] = 0;
        for (int k = 0; k < old.count; ++k)
            if (old.ids[k] == p.id) c.impulse[i] = old.impulse[k], c.tangentImpulse[i] = old.tangentImpulse[k];
    }
}

/// Fast pairs get the point at which they will touch, not the one where they are nearest now: what flies past a corner
/// is not caught by it.
void Collider::foresee(RigidContact& c, const Relative& at, double dt) const
{
    const Part &a = parts_[c.partA], &b = parts_[c.partB];
    Pose poseA = poses_[c.bodyA], poseB = poses_[c.bodyB];
    const float hit = timeOfImpact(a, b, poseA, poseB, dt, c.slop);
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
    Manifold m = physics::collide(a, b, then, 8 * c.slop);
    m.normal = turnedBack(poses_[c.bodyA].turn, turned(poseA.turn, m.normal));
    for (int i = 0; i < m.count; ++i)
        m.points[i].separation = dot(m.normal, at.move + turned(at.turn, m.points[i].onB) - m.points[i].onA);
    renew(c, m, at, 0);
    c.at.move.x = 3e37F;  // never reused
}

/// A platform holds what comes against its direction, and lets pass what comes from behind until both are apart.
void Collider::decideSide(RigidContact& c) const
{
    if (c.count == 0) {
        c.passing = false;
        return;
    }
    const Vec2f normal = turned(poses_[c.bodyA].turn, c.normal);
    const auto wrong = [&](const RigidBody& body, Vec2f outward) {
        return (body.oneSidedX != 0 || body.oneSidedY != 0) &&
               body.oneSidedX * outward.x + body.oneSidedY * outward.y < 0.5F;
    };
    const bool deep = c.separation[0] < -8 * c.slop && !c.touching;
    if (wrong(bodies_[c.bodyA], normal) || wrong(bodies_[c.bodyB], -normal) || deep) c.passing = true;
    c.resolve = !c.passing && !bodies_[c.bodyA].sensor && !bodies_[c.bodyB].sensor;
}

float timeOfImpact(const Part& a, const Part& b, const Pose& poseA, const Pose& poseB, double dt, float target)
{
    const float dtf = static_cast<float>(dt);
    const Vec2f velocity{poseB.velocityX - poseA.velocityX, poseB.velocityY - poseA.velocityY};
    const float turning = std::abs(poseA.omega) * a.reach + std::abs(poseB.omega) * b.reach;
    float t = 0;
    for (int round = 0; round < 40; ++round) {
        const Vec2 turnA = direction(static_cast<double>(poseA.omega) * t),
                   turnB = direction(static_cast<double>(poseB.omega) * t);
        const Vec2f qA = turned({static_cast<float>(turnA.x()), static_cast<float>(turnA.y())}, poseA.turn);
        const Vec2f qB = turned({static_cast<float>(turnB.x()), static_cast<float>(turnB.y())}, poseB.turn);
        const Vec2f apart{static_cast<float>(poseB.x - poseA.x + static_cast<double>(velocity.x) * t),
                          static_cast<float>(poseB.y - poseA.y + static_cast<double>(velocity.y) * t)};
        const Distance d = distanceOf(a, b, {turnedBack(qA, apart), turnedBack(qA, qB)});
        if (d.distance <= target) return t / dtf;
        const float closing = -dot(turned(qA, d.normal), velocity) + turning;
        if (!(closing * dtf > 1e-9F * d.distance)) return 2;
        t += (d.distance - 0.5F * target) / closing;
        if (t > dtf) return 2;
    }
    return t / dtf;
}

void Collider::stopTunnelling(std::vector<float>& allowed, const std::vector<Vec2>& moves,
                              const std::vector<double>& turns, double dt) const
{
    allowed.assign(bodies_.size(), 1.0F);
    for (const RigidContact& c : contacts_) {
        if (!c.resolve) continue;
        const Vec2 relativeMove = moves[c.bodyB] - moves[c.bodyA];
        const float thinner = kFast * std::min(parts_[c.partA].thickness, parts_[c.partB].thickness);
        if (!(relativeMove.squaredNorm() > thinner * thinner)) continue;
        if (c.count > 0 && c.separation[0] <= 0) continue;
        Pose a = poses_[c.bodyA], b = poses_[c.bodyB];
        const auto actual = [&](Pose& pose, Index body) {
            pose.velocityX = clamped(moves[body].x() / dt), pose.velocityY = clamped(moves[body].y() / dt);
            pose.omega = clamped(turns[body] / dt);
        };
        actual(a, c.bodyA), actual(b, c.bodyB);
        // A little deeper than contacts come by themselves.
        const float hit = timeOfImpact(parts_[c.partA], parts_[c.partB], a, b, dt, -2 * c.slop);
        if (hit > 1) continue;
        for (const Index body : {c.bodyA, c.bodyB})
            if (bodies_[body].moves) allowed[body] = std::min(allowed[body], hit);
    }
}

void Collider::forgetPairs()
{
    contacts_.clear();
    known_.clear();
    std::fill(room_.begin(), room_.end(), -1.0F);
}

void Collider::rebuild()
{
    known_.clear();
    for (const RigidContact& c : contacts_) known_.insert(c.key());
}

std::size_t Collider::bytes() const
{
    return bodies_.capacity() * sizeof(RigidBody) + parts_.capacity() * sizeof(Part) +
           (poses_.capacity() + fitted_.capacity()) * sizeof(Pose) + contacts_.capacity() * sizeof(RigidContact) +
           sweep_.bytes() + known_.bytes() + excluded_.bytes();
}

}  // namespace jet::physics
