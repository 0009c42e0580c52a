// Sleep. Bodies that touch, or are held together, form a group; a group in which every body rests is left out of the
// steps until something wakes one of them.
//
// Slow is not at rest: a heavy pendulum stands nearly still where it turns. So a body has to be slow for half a second,
// and in balance as well: its velocity must not be about to change, as it does under any force that is not borne. What
// touches others may be faster, and may tremble, as bodies in large piles do: it rests as well when it has not come
// away for two seconds.
#include "disjoint_sets.hpp"
#include "room.hpp"
#include "stage.hpp"

#include <cmath>

namespace jet::physics {

namespace {

constexpr double kLook = 0.25;        // seconds between looks; a body has to be still in two such spans
constexpr double kStillSpeed = 0.01;  // lengths of the body a second, of one that touches others
constexpr double kHangingSpeed = 0.001;
constexpr double kUnborne = 2e-4;      // of gravity: acceleration that counts as none
constexpr double kUnborneSize = 2e-4;  // lengths / s²: the same without gravity
constexpr double kPlace = 0.02;        // lengths: within this far a body that touches others is where it was
constexpr float kPlaceTime = 2;        // seconds
constexpr double kGap = 1.2e-7;        // of single precision

}  // namespace

bool RigidStage::driven(Index body, const State& state) const
{
    const RigidBody& is = collider_.bodies()[body];
    return is.kinematic && (state.nodes.velocity[is.node] != Vec2(0, 0) || state.nodes.omega[is.node] != 0);
}

bool RigidStage::allAsleep(const State& state) const
{
    return sleepers_ == movers_ && !woke_ && !drowsy_ && ended_.empty() && !collider_.restless() &&
           std::none_of(kinematic_.begin(), kinematic_.end(), [&](Index body) { return driven(body, state); });
}

void RigidStage::skip() { events_.clear(); }

bool RigidStage::restDue(double dt)
{
    if (sleepers_ == movers_) return false;
    sinceLook_ += dt;
    return sinceLook_ > kLook - 1e-9;
}

/// Was it still between the last two looks and this one, and in balance?
RigidStage::Stillness RigidStage::stillness(Index index, const State& state, double gravity, double interval)
{
    RigidBody& body = collider_.bodies()[index];
    const Vec2& at = state.nodes.position[body.node];
    const double reach = static_cast<double>(body.reach), turned = state.nodes.angle[body.node] * reach;
    const double length = static_cast<double>(body.finest);
    Watch& watch = watches_[index];
    const auto norm = [](double a, double b, double c) { return std::sqrt(a * a + b * b + c * c); };
    const auto perSecond = [&](double way) { return static_cast<float>(std::clamp(way / interval, -1e30, 1e30)); };
    const auto from = [](double now, float place) { return now - static_cast<double>(place); };
    const double offX = from(at.x(), watch.placeX), offY = from(at.y(), watch.placeY);
    const double offTurned = from(turned, watch.placeTurned);
    const float x = perSecond(from(offX, watch.x)), y = perSecond(from(offY, watch.y));
    const float swing = perSecond(from(offTurned, watch.turned));
    const double before = norm(watch.velocityX, watch.velocityY, watch.swing), now = norm(x, y, swing);
    const double bend = norm(x - watch.velocityX, y - watch.velocityY, swing - watch.swing) / interval;
    watch.velocityX = x, watch.velocityY = y, watch.swing = swing;
    if (body.looks < 3) ++body.looks;
    watch.stayed += static_cast<float>(interval);
    // Far from the origin single precision has gaps.
    const double gap = kGap * (std::abs(at.x()) + std::abs(at.y()) + std::abs(turned));
    if (body.looks == 1 || norm(offX, offY, offTurned) > kPlace * length + gap) {
        const auto single = [](double value) { return static_cast<float>(std::clamp(value, -3e38, 3e38)); };
        watch.placeX = single(at.x()), watch.placeY = single(at.y()), watch.placeTurned = single(turned);
        watch.stayed = 0;
    }
    watch.x = static_cast<float>(from(at.x(), watch.placeX)), watch.y = static_cast<float>(from(at.y(), watch.placeY));
    watch.turned = static_cast<float>(from(turned, watch.placeTurned));
    if (!body.mayRest || body.looks < 3) return Stillness::Moves;
    const bool balanced = bend < (gravity > 0 ? kUnborne * gravity : kUnborneSize * length);
    const double speed = std::max(before, now) / length;
    if (balanced && speed < kHangingSpeed) return Stillness::Rests;
    const bool leans = (balanced && speed < kStillSpeed) || watch.stayed > kPlaceTime - 1e-3F;
    return leans ? Stillness::Leans : Stillness::Moves;
}

void RigidStage::rest(State& state, const WorldSettings& settings, const Bonds& bonds)
{
    const double interval = sinceLook_, gravity = settings.applyGravity ? settings.gravity.norm() : 0;
    sinceLook_ = 0;
    const std::size_t count = collider_.bodies().size();
    if (watches_.size() < count) makeRoom(count - watches_.size(), watches_);
    watches_.resize(count);
    arena_.reset();  // the step is over
    still_ = arena_.take<Stillness>(count);
    std::fill(still_.begin(), still_.end(), Stillness::Moves);
    bool any = false;
    for (Index i = 1; i < count; ++i) {
        const RigidBody& body = collider_.bodies()[i];
        if (!body.moves || body.asleep) continue;
        still_[i] = stillness(i, state, gravity, interval);
        any |= still_[i] != Stillness::Moves;
    }
    if (!any) return;
    for (const Index handle : bonds.awake) still_[bodyOf(handle)] = Stillness::Moves;  // 0: nobody's
    unite(state, bonds);
    // One that moves keeps all of its group awake.
    for (Index i = 1; i < count; ++i)
        if (group_[i] != kNone && still_[i] != Stillness::Rests) still_[rootOf(group_, i)] = Stillness::Moves;
    fallAsleep(state);
}

/// Groups of the bodies that are awake, by their least body.
void RigidStage::unite(const State& state, const Bonds& bonds)
{
    const auto& bodies = collider_.bodies();
    if (group_.size() < bodies.size()) makeRoom(bodies.size() - group_.size(), group_);
    group_.resize(bodies.size(), kNone);
    const auto grouped = [&](Index body) { return bodies[body].moves && !bodies[body].asleep; };
    for (Index i = 1; i < bodies.size(); ++i)
        if (!bodies[i].asleep) group_[i] = bodies[i].moves ? i : kNone;
    const auto hold = [&](Index a, Index b) {
        if (grouped(a) && grouped(b)) return physics::unite(group_, a, b);
        if (grouped(a) && driven(b, state)) still_[a] = Stillness::Moves;
        if (grouped(b) && driven(a, state)) still_[b] = Stillness::Moves;
    };
    const auto& contacts = collider_.contacts();
    for (Index i = 0; i < contacts.size(); ++i) {
        if (!isPlaced(collider_.places()[i])) continue;
        for (const Index body : {contacts[i].bodyA, contacts[i].bodyB})
            if (still_[body] == Stillness::Leans) still_[body] = Stillness::Rests;
        hold(contacts[i].bodyA, contacts[i].bodyB);
    }
    for (const Joint& joint : joints_)
        if (joint.lives()) hold(joint.a, joint.b);
    for (const auto& [a, b] : bonds.pairs) {
        const Index first = bodyOf(a), second = bodyOf(b);
        if (first != second) hold(first, second);
    }
}

void RigidStage::fallAsleep(State& state)
{
    auto& bodies = collider_.bodies();
    const std::uint32_t before = sleepers_;
    for (Index i = 1; i < bodies.size(); ++i) {
        RigidBody& body = bodies[i];
        if (!body.moves || body.asleep) continue;
        const Index root = rootOf(group_, i);
        if (still_[root] != Stillness::Rests) continue;
        group_[i] = root;
        body.asleep = true, body.posed = false;
        state.nodes.velocity[body.node] = Vec2(0, 0), state.nodes.omega.edit(body.node) = 0;
        state.bodies[body.handle].asleep = true;
        ++sleepers_;
    }
    if (sleepers_ == before) return;
    drowsy_ = true;
    ++jointsVersion_;
    const auto rests = [&](Index body) { return bodies[body].moves ? bodies[body].asleep : !driven(body, state); };
    const auto& places = collider_.places();
    for (Index i = 0; i < places.size(); ++i) {
        const RigidContact& c = collider_.contacts()[i];
        if (places[i] == kFree || places[i] == kAsleep || !rests(c.bodyA) || !rests(c.bodyB)) continue;
        if (active_ == Active::Single) single_.suspend(collider_, i);
        if (active_ == Active::Double) double_.suspend(collider_, i);
    }
}

void RigidStage::wakeGroup(State& state, Index group)
{
    auto& bodies = collider_.bodies();
    for (Index i = group; i < bodies.size(); ++i) {
        if (!bodies[i].asleep || group_[i] != group) continue;
        bodies[i].asleep = bodies[i].posed = false;
        state.bodies[bodies[i].handle].asleep = false;
        bodies[i].looks = 0;
        --sleepers_;
        woke_ = true;
        ++jointsVersion_;
    }
}

void RigidStage::wake(State& state, Index handle)
{
    if (!has(handle)) return;
    const Index body = bodyOf(handle);
    collider_.bodies()[body].looks = 0;
    if (collider_.bodies()[body].asleep) wakeGroup(state, group_[body]);
}

void RigidStage::wakeAll(State& state)
{
    for (Index i = 1; i < collider_.bodies().size(); ++i) wake(state, collider_.bodies()[i].handle);
}

void RigidStage::stir(State& state, Index handle)
{
    if (!has(handle) || sleepers_ == 0) return;
    const Index body = bodyOf(handle);
    const auto wakeBody = [&](Index other) {
        if (collider_.bodies()[other].asleep) wakeGroup(state, group_[other]);
    };
    for (Index i = 0; i < collider_.places().size(); ++i) {
        const RigidContact& c = collider_.contacts()[i];
        if (collider_.places()[i] != kAsleep || (c.bodyA != body && c.bodyB != body)) continue;
        collider_.markDue(i);
        collider_.places()[i] = kIdle;
        if (c.resolve && c.count > 0) wakeBody(c.bodyA == body ? c.bodyB : c.bodyA);
    }
    for (const Joint& joint : joints_) {
        if (!joint.lives() || (joint.a != body && joint.b != body)) continue;
        wakeBody(joint.a == body ? joint.b : joint.a);
    }
}

/// Impulses are of one substep: for another length they stand for the same force.
void RigidStage::scaleSleeping(double h)
{
    if (restH_ == h) return;
    const auto ratio = static_cast<float>(restH_ > 0 ? h / restH_ : 1);
    restH_ = h;
    if (sleepers_ == 0) return;
    for (Index i = 0; i < collider_.places().size(); ++i) {
        if (collider_.places()[i] != kAsleep) continue;
        RigidContact& c = collider_.contacts()[i];
        for (int k = 0; k < 2; ++k) c.impulse[k] *= ratio, c.tangentImpulse[k] *= ratio;
    }
}

}  // namespace jet::physics
