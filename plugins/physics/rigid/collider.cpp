// Where bodies are, their boxes, and the pairs whose boxes meet.
#include "collider.hpp"

#include "manifold.hpp"
#include "room.hpp"

#include <chrono>
#include <cmath>
#include <tuple>

namespace jet::physics {

namespace {

constexpr float kRoom = 0.03F;  // of the typical length: margin of the boxes
constexpr float kRoomOfLength = 0.05F;
constexpr float kAhead = 2;     // steps
constexpr float kQuiet = 0.5F;  // slops: within this far of where it was a body counts as still
constexpr float kMoved = 1e30F;
constexpr float kLongTypical = 6;  // typical lengths: longer thin parts are sought piece by piece
constexpr int kMostPieces = 64;

float clamped(double x) { return static_cast<float>(std::clamp(x, -3e37, 3e37)); }

}  // namespace

Index Collider::addBody(const RigidBody& body, const Rules& rules)
{
    makeRoom(1, bodies_);
    bodies_.push_back(body);
    bodies_.back().rules = rules_.add(rules), bodies_.back().oneSided = rules.isOneSided();
    bodies_.back().firstPart = static_cast<Index>(parts_.size());
    return static_cast<Index>(bodies_.size() - 1);
}

void Collider::addPart(Part part, const PartOutline* outline)
{
    weld_.add(outline);
    rearranged_ = true;
    RigidBody& body = bodies_.back();
    part.body = static_cast<Index>(bodies_.size() - 1);
    cover(body, part);
    makeRoom(1, parts_);
    parts_.push_back(part);
    typical_ = 0;
}

/// The body has one part more.
void Collider::cover(RigidBody& body, const Part& part)
{
    body.length = body.partCount == 0 ? part.length : std::max(body.length, part.length);
    body.finest = body.partCount == 0 ? part.length : std::min(body.finest, part.length);
    body.reach = std::max(body.reach, part.reach);
    ++body.partCount;
}

void Collider::replaceBody(Index index, const RigidBody& body, const Rules& rules)
{
    RigidBody& own = bodies_[index];
    const Index row = own.rules, firstPart = own.firstPart;
    own = body;
    own.firstPart = firstPart, own.rules = row;
    setRules(own, rules);
    if (index < poses_.size()) poses_[index] = Pose(), fitted_[index] = Fitting(), way_[index] = 0;
    disturbed_ = true;
    rearranged_ |= !body.moves && !body.kinematic;
}

void Collider::replacePart(Index body, Index which, Part part, const PartOutline* outline)
{
    const Index index = bodies_[body].firstPart + which;
    part.body = body;
    cover(bodies_[body], part);
    parts_[index] = part;
    rearranged_ |= weld_.replace(index, outline);
    sweep_.forget(index);
    replaced_.push_back(index);
    typical_ = 0;
}

void Collider::setRules(RigidBody& body, const Rules& rules)
{
    const Index before = body.rules;
    body.rules = rules_.add(rules);
    rules_.drop(before);
    body.oneSided = rules.isOneSided();
}

void Collider::disturb(Index body)
{
    if (body < poses_.size()) poses_[body].room = -1, poses_[body].rest.x = Pose::kUnknown;
    disturbed_ = true;
}

void Collider::seekAgain(Index body)
{
    disturb(body);
    for (Index p = 0; p < bodies_[body].partCount; ++p) sweep_.forget(bodies_[body].firstPart + p);
}

void Collider::disturbAll()
{
    for (Index i = 1; i < poses_.size(); ++i) disturb(i);
    for (Index i = 0; i < contacts_.size(); ++i) markDue(i);
}

void Collider::rouse(Index contact)
{
    for (const Index body : {contacts_[contact].bodyA, contacts_[contact].bodyB})
        if (bodies_[body].asleep) roused_.push_back(body);
    markDue(contact);
}

void Collider::releaseAwake()
{
    const auto awake = [&](Index body) { return bodies_[body].moves && !bodies_[body].asleep; };
    for (Index i = 0; i < contacts_.size(); ++i) {
        if (places_[i] != kAsleep || !(awake(contacts_[i].bodyA) || awake(contacts_[i].bodyB))) continue;
        places_[i] = kIdle;
        markDue(i);
    }
}

void Collider::find(const State& state, const WorldSettings& settings, double dt, StepStats& stats, Pool& pool,
                    Arena& arena, const Domains& domains)
{
    const auto start = std::chrono::steady_clock::now();
    looker_ = &looker(choiceOf(settings)), sieve_ = &sieve(choiceOf(settings));
    sweep_.use(*sieve_);
    if (typical_ == 0 && !parts_.empty()) measure();
    if (rearranged_ || !welded_) weld_.run(parts_, bodies_, rules_, state, typical_);
    if (rearranged_) {
        for (Index i = 0; i < contacts_.size(); ++i) markDue(i);
        disturbed_ = true;
    }
    if (disturbed_)
        for (Nearing& n : nearing_) n.until = -1;
    welded_ = true;
    rearranged_ = false;
    prepareBodies(arena);
    const float fall = static_cast<float>(settings.applyGravity ? settings.gravity.norm() * dt * dt : 0);
    Flag left;
    const auto take = [&](Index body, Index) {
        if (!bodies_[body].posed && takePose(body, state, fall, dt)) fast_.raise();
        if (bodies_[body].posed != bodies_[body].asleep) bodies_[body].posed = bodies_[body].asleep;
        noteReached(body);
        if (bodies_[body].asleep) {
            drift_[body] = 0;
            return;
        }
        noteDrift(body);
        if (bodies_[body].enabled && fitBoxes(body, dt)) left.raise();
    };
    // Both threads have read all poses since.
    domains.eachBody(pool, take, [&](Index body, Index) { prefetchToWrite(&poses_[body]); });
    if (left) sweep_.noteMoves();
    findPairs(settings, pool, arena);
    hits_.assign(contacts_.size(), 0);
    stats.broadPhaseMs += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void Collider::measure()
{
    std::vector<float> lengths;
    for (const Part& part : parts_)
        if (bodies_[part.body].moves) lengths.push_back(part.length);
    if (lengths.empty()) lengths.push_back(parts_[0].length);
    std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2), lengths.end());
    typical_ = lengths[lengths.size() / 2];
}

/// The sweep is to know the parts as they are.
void Collider::prepareSweep()
{
    if (typical_ == 0 && !parts_.empty()) measure();
    const auto tell = [&](Index part) {
        sweep_.setReach(part, parts_[part].reach);
        const bool wasLong = sweep_.piecesOf(part) != nullptr;
        sweep_.setLong(part, isLong(parts_[part]));
        // What smaller parts came to, or larger, has other boxes now.
        if (wasLong != (sweep_.piecesOf(part) != nullptr)) seekAgain(parts_[part].body);
    };
    if (sweep_.parts() != parts_.size() || (!replaced_.empty() && sweep_.typical() != typical_)) {
        sweep_.resize(parts_.size(), typical_);
        for (Index part = 0; part < parts_.size(); ++part) tell(part);
    } else {
        for (const Index part : replaced_) tell(part);
    }
    replaced_.clear();
}

void Collider::prepareBodies(Arena& arena)
{
    const std::size_t count = bodies_.size();
    if (poses_.size() < count) makeRoom(count - poses_.size(), poses_, fitted_, way_);
    poses_.resize(count), fitted_.resize(count), way_.resize(count, 0.0);
    surprise_ = arena.take<float>(count);
    std::fill(surprise_.begin(), surprise_.end(), 0.0F);
    looks_ = arena.mark();
    drift_ = arena.take<float>(count), reached_ = arena.take<double>(count);
    drift_[0] = 0, reached_[0] = 0;
    prepareSweep();
    sweep_.open(arena);
    surprised_ = false;
    fast_.lower();
}

/// How far the body is from where its boxes were fitted.
Vec2f Collider::fromFitting(Index i) const
{
    return {static_cast<float>(poses_[i].x - fitted_[i].x), static_cast<float>(poses_[i].y - fitted_[i].y)};
}

/// True: it moves by much of its size in this step.
bool Collider::takePose(Index i, const State& state, float fall, double dt)
{
    const RigidBody& body = bodies_[i];
    Pose& pose = poses_[i];
    const Nodes& nodes = state.nodes;
    const Vec2 &at = nodes.position[body.node], &turn = nodes.rotation[body.node],
               &velocity = nodes.velocity[body.node];
    pose.x = at.x(), pose.y = at.y();
    pose.turn = {static_cast<float>(turn.x()), static_cast<float>(turn.y())};
    pose.velocityX = clamped(velocity.x()), pose.velocityY = clamped(velocity.y());
    pose.omega = clamped(nodes.omega[body.node]);
    const float turning = std::min(std::abs(pose.omega) * static_cast<float>(dt), 2.0F) * body.reach;
    const float straight =
        static_cast<float>(dt) * std::sqrt(pose.velocityX * pose.velocityX + pose.velocityY * pose.velocityY);
    pose.travel = turning + (body.moves ? fall : 0) + straight;
    pose.reach = body.reach;
    drift_[i] = turning + straight;
    return pose.travel > 0.25F * body.finest;
}

/// How far the body may come from where it was when its contacts were last looked at; if that is much, it is now here.
void Collider::noteDrift(Index i)
{
    Pose& pose = poses_[i];
    const Vec2f moved = fromFitting(i) - pose.rest;
    const float dx = moved.x, dy = moved.y;
    const float turn = std::abs(cross(pose.restTurn, pose.turn)) + (dot(pose.restTurn, pose.turn) < 0 ? 2.0F : 0.0F);
    const float drift = drift_[i] + std::sqrt(dx * dx + dy * dy) + turn * bodies_[i].reach;
    drift_[i] = drift;
    if (drift <= kQuiet * kSlop * bodies_[i].finest) return;
    drift_[i] = kMoved;
    pose.rest = fromFitting(i), pose.restTurn = pose.turn;
}

/// Boxes are fitted anew when a part, with what it moves in this step, may leave them. False: it keeps within.
bool Collider::fitBoxes(Index i, double dt)
{
    Pose& pose = poses_[i];
    const Fitting& old = fitted_[i];
    const Vec2f moved = fromFitting(i);
    if (pose.room >= 0) {
        const float dx = moved.x, dy = moved.y;
        const float turn = std::abs(cross(old.turn, pose.turn)) + (dot(old.turn, pose.turn) < 0 ? 2.0F : 0.0F);
        const float left = pose.room - 1.2F * turn * bodies_[i].reach - pose.travel;
        if (left >= 0 && dx * dx + dy * dy <= left * left) return false;
        const float farther = left + ahead(i);
        if (farther >= 0 && dx * dx + dy * dy <= farther * farther && keepsWithin(i, dt)) return false;
    }
    pose.rest = pose.rest - moved;
    fitted_[i] = {pose.x, pose.y, pose.turn, pose.travel};
    // A long body that turns would have to be fitted in each step.
    pose.room = kRoom * typical_ + std::min(3 * pose.travel, kRoomOfLength * bodies_[i].length);
    for (Index p = 0; p < bodies_[i].partCount; ++p) fitBox(bodies_[i].firstPart + p, pose, pose.room, dt);
    return true;
}

/// Units the boxes reach farther in the direction the body moved in when they were fitted, at most.
float Collider::ahead(Index body) const { return std::min(kAhead * fitted_[body].travel, 0.7F * typical_); }

/// Are the body's parts, with what they move in this step, still in their boxes?
bool Collider::keepsWithin(Index body, double dt) const
{
    for (Index p = 0; p < bodies_[body].partCount; ++p) {
        const Index part = bodies_[body].firstPart + p;
        const FatBox needed = boxOf(part, poses_[body], 0, dt);
        const FatBox& box = sweep_.box(part);
        if (needed.minX < box.minX || needed.minY < box.minY || needed.maxX > box.maxX || needed.maxY > box.maxY)
            return false;
    }
    return true;
}

void Collider::fitBox(Index index, const Pose& pose, float room, double dt)
{
    sweep_.move(index, withAhead(boxOf(index, pose, room, dt), pose, dt));
    if (std::vector<FatBox>* pieces = sweep_.piecesOf(index)) fitPieces(*pieces, index, pose, room, dt);
}

/// What moves will be there next.
FatBox Collider::withAhead(FatBox box, const Pose& pose, double dt) const
{
    const float aheadX = kAhead * pose.velocityX * static_cast<float>(dt),
                aheadY = kAhead * pose.velocityY * static_cast<float>(dt);
    const float most = 0.5F * typical_;
    box.minX += std::clamp(aheadX, -most, 0.0F), box.maxX += std::clamp(aheadX, 0.0F, most);
    box.minY += std::clamp(aheadY, -most, 0.0F), box.maxY += std::clamp(aheadY, 0.0F, most);
    return box;
}

FatBox Collider::boxOf(Index index, const Pose& pose, float room, double dt) const
{
    const Part& part = parts_[index];
    return boxAround(part.corners, part.count, part.radius + room, pose, dt);
}

FatBox Collider::boxAround(const Vec2f* corners, int count, float room, const Pose& pose, double dt)
{
    // Two corners at a time; of an odd number the last one comes with the first again.
    using namespace manifold;
    const Four along = allOf(pose.turn.x), across{-pose.turn.y, pose.turn.y, -pose.turn.y, pose.turn.y};
    Four lowest = allOf(3e38F), highest = allOf(-3e38F);
    for (int i = 0; i < count; i += 2) {
        const Vec2f two[] = {corners[i], corners[i + 1 < count ? i + 1 : 0]};
        const Four corner = load(two);
        const Four at = along * corner + across * __builtin_shufflevector(corner, corner, 1, 0, 3, 2);
        lowest = at < lowest ? at : lowest, highest = at > highest ? at : highest;
    }
    const float minX = std::min(lowest[0], lowest[2]), minY = std::min(lowest[1], lowest[3]);
    const float maxX = std::max(highest[0], highest[2]), maxY = std::max(highest[1], highest[3]);
    const float stepX = pose.velocityX * static_cast<float>(dt), stepY = pose.velocityY * static_cast<float>(dt);
    const float straight = std::sqrt(stepX * stepX + stepY * stepY);
    // Far from the origin single precision has gaps; they are added.
    const float gap = static_cast<float>(2e-7 * (std::abs(pose.x) + std::abs(pose.y)));
    const float margin = room + gap + (pose.travel - straight);
    FatBox box;
    box.minX = static_cast<float>(pose.x) + minX + std::min(stepX, 0.0F) - margin;
    box.maxX = static_cast<float>(pose.x) + maxX + std::max(stepX, 0.0F) + margin;
    box.minY = static_cast<float>(pose.y) + minY + std::min(stepY, 0.0F) - margin;
    box.maxY = static_cast<float>(pose.y) + maxY + std::max(stepY, 0.0F) + margin;
    return box;
}

/// A part along its longest side, in its body's frame.
Collider::Slab Collider::slabOf(const Part& part)
{
    Slab slab;
    float longest = 0;
    for (int i = 0; i < part.count; ++i) {
        const Vec2f side = part.corners[(i + 1) % part.count] - part.corners[i];
        const float length = std::sqrt(dot(side, side));
        if (length > longest) longest = length, slab.along = (1 / length) * side;
    }
    slab.from = slab.low = 3e38F, slab.to = slab.high = -3e38F;
    const Vec2f across{-slab.along.y, slab.along.x};
    for (int i = 0; i < part.count; ++i) {
        const float u = dot(slab.along, part.corners[i]), v = dot(across, part.corners[i]);
        slab.from = std::min(slab.from, u), slab.to = std::max(slab.to, u);
        slab.low = std::min(slab.low, v), slab.high = std::max(slab.high, v);
    }
    return slab;
}

/// Is its box, when it lies obliquely, mostly empty, and large enough that this matters?
bool Collider::isLong(const Part& part) const
{
    const Slab slab = slabOf(part);
    return part.count > 1 && slab.to - slab.from > 4 * (slab.high - slab.low + 2 * part.radius) &&
           slab.to - slab.from > kLongTypical * typical_;
}

void Collider::fitPieces(std::vector<FatBox>& pieces, Index index, const Pose& pose, float room, double dt) const
{
    const Part& part = parts_[index];
    const Slab slab = slabOf(part);
    const Vec2f across{-slab.along.y, slab.along.x};
    const float length = slab.to - slab.from;
    const int count = std::clamp(static_cast<int>(std::min(length / (2 * typical_), 1000.0F)), 1, kMostPieces);
    pieces.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const float from = slab.from + length * static_cast<float>(i) / static_cast<float>(count),
                    to = slab.from + length * static_cast<float>(i + 1) / static_cast<float>(count);
        const Vec2f corners[] = {from * slab.along + slab.low * across, from * slab.along + slab.high * across,
                                 to * slab.along + slab.low * across, to * slab.along + slab.high * across};
        pieces[static_cast<std::size_t>(i)] = withAhead(boxAround(corners, 4, part.radius + room, pose, dt), pose, dt);
    }
}

void Collider::forgetPairs()
{
    contacts_.clear(), places_.clear(), free_.clear(), nearing_.clear();
    known_.clear();
    sweep_.forget();
    for (Pose& pose : poses_) pose.room = -1;
}

void Collider::rebuild()
{
    sweep_.rebuild();
    welded_ = false;  // outlines follow from places
    for (RigidBody& body : bodies_) body.posed = false;
    known_.clear();
    for (Index i = 0; i < contacts_.size(); ++i)
        if (places_[i] != kFree) known_.insert(contacts_[i].key());
}

void Collider::fitRoom() { physics::fitRoom(bodies_, parts_); }

std::size_t Collider::bytes() const
{
    return bodies_.capacity() * sizeof(RigidBody) + parts_.capacity() * sizeof(Part) +
           poses_.capacity() * sizeof(Pose) + fitted_.capacity() * sizeof(Fitting) +
           contacts_.capacity() * (sizeof(RigidContact) + sizeof(Nearing)) + way_.capacity() * sizeof(double) +
           (places_.capacity() + free_.capacity()) * 4 + sweep_.bytes() + known_.bytes() + excluded_.bytes() +
           weld_.bytes() + rules_.bytes();
}

}  // namespace jet::physics
