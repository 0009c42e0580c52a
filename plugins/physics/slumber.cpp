#include "slumber.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jet::physics {

namespace {

constexpr double kLook = 0.25;         // seconds between looks
constexpr double kStillSpeed = 0.001;  // lengths of the body a second, at most
constexpr double kUnborne = 2e-4;      // of gravity: acceleration that counts as none
constexpr double kUnborneSize = 2e-4;  // lengths / s²: the same without gravity
constexpr double kLeft = 0.0002;       // lengths that what swings or creeps may have before it
constexpr double kFast = 4;            // times the greatest speed: with that, it moves

/// Units from its place at the last look.
double farthest(const State& state, const BodyRecord& body)
{
    double squared = 0;
    for (Index k = 0; k < body.nodes.count; ++k)
        squared =
            std::max(squared, (state.nodes.position[body.nodes.first + k] - body.soft->watch.places[k]).squaredNorm());
    return std::sqrt(squared);
}

/// Is much of it fast? What is pressed between others may have a speed without moving.
bool isFast(const State& state, const BodyRecord& body)
{
    constexpr Index kAsked = 8;
    const double most = kFast * kStillSpeed * body.length;
    const Index stride = std::max<Index>(1, body.nodes.count / kAsked);
    Index fast = 0, asked = 0;
    for (Index n = body.nodes.first; n < body.nodes.end(); n += stride) {
        if (state.nodes.invMass[n] == 0) continue;
        ++asked;
        fast += state.nodes.velocity[n].squaredNorm() > most * most;
    }
    return fast > 0 && 2 * fast >= asked;
}

bool mayFallAsleep(const BodyRecord& body)
{
    return body.soft->watch.mayRest && !body.fixed && !body.kinematic && body.enabled && body.nodes.count > 0;
}

}  // namespace

bool Slumber::due(double dt)
{
    sinceLook_ += dt;
    return sinceLook_ > kLook - 1e-9;
}

void Slumber::watch(State& state, double dt)
{
    if (almost_ == 0) return;
    constexpr double kTremble = 2;  // steps at the greatest speed
    const double elapsed = sinceLook_ + (1 + kTremble) * dt;
    for (BodyRecord& body : state.bodies) {
        if (!body.soft || body.soft->watch.looks != kAlmost) continue;
        if (!(farthest(state, body) <= elapsed * static_cast<double>(body.soft->watch.speed))) forget(body.soft->watch);
    }
}

void Slumber::watchWithin(State& state)
{
    if (almost_ == 0) return;
    for (BodyRecord& body : state.bodies)
        if (body.soft && body.soft->watch.looks == kAlmost && isFast(state, body)) forget(body.soft->watch);
}

void Slumber::forget(RestWatch& watch)
{
    almost_ -= watch.looks == kAlmost;
    watch.looks = 0;
}

void Slumber::disturb(State& state, Index body)
{
    if (state.bodies[body].soft) forget(state.bodies[body].soft->watch);
}

void Slumber::judge(State& state, const SoftSprings& springs, const Actuators& actuators, const WorldSettings& settings)
{
    const double interval = sinceLook_;
    sinceLook_ = 0;
    islands_.reserve(state.bodies.size());
    still_.assign(state.bodies.size(), 0);
    constexpr double kNoBound = std::numeric_limits<double>::infinity();
    held_.assign(state.bodies.size(), {kNoBound, kNoBound, 0});
    actuators.eachSpring([&](Index a, Index b, double ks, double kd) {
        for (const Index body : {a, b}) {
            if (body == kNone || !state.bodies[body].soft) continue;
            const BodyRecord& is = state.bodies[body];
            const double rate = ks / is.soft->mass, left = kLeft * is.length;
            if (ks > 0) held_[body].speed = std::min(held_[body].speed, left * std::sqrt(rate));
            if (ks > 0) held_[body].bend = std::min(held_[body].bend, left * rate);
            if (kd > 0) held_[body].speed = std::min(held_[body].speed, left * ks / kd);
        }
    });
    for (Index body = 0; body < state.bodies.size(); ++body) {
        const BodyRecord& is = state.bodies[body];
        if (!is.soft || is.asleep) continue;
        if (!mayFallAsleep(is)) {
            forget(is.soft->watch);
            continue;
        }
        if (isFast(state, is)) {
            forget(is.soft->watch);
            continue;
        }
        still_[body] =
            look(state, body, boundsOf(state, body, springs, settings), interval) && !springs.flows(state, body);
    }
}

Slumber::Bounds Slumber::boundsOf(const State& state, Index body, const SoftSprings& springs,
                                  const WorldSettings& settings) const
{
    const BodyRecord& is = state.bodies[body];
    const double gravity = settings.applyGravity ? settings.gravity.norm() * std::abs(is.gravityScale) : 0;
    Bounds bounds{kStillSpeed * is.length, gravity > 0 ? kUnborne * gravity : kUnborneSize * is.length, 0};
    bounds.fall = 100 * bounds.bend;
    const SoftMatter& matter = is.soft->matter;
    const SoftSprings::Slowest slowest = springs.slowest(body);
    const double left = kLeft * is.length;
    double rate = slowest.ks / is.soft->mass, fade = slowest.fade;
    if (is.hasTwin() && !springs.anyTorn(body)) {
        const double twin = matter.shapeStiffness * is.nodes.count / is.soft->mass;
        rate = std::isfinite(rate) ? rate + twin : twin;
        if (matter.shapeDamping > 0) fade = std::min(fade, matter.shapeStiffness / matter.shapeDamping);
    }
    bounds.speed = std::min({bounds.speed, left * std::sqrt(rate), left * fade, held_[body].speed});
    bounds.bend = std::min({bounds.bend, left * rate, held_[body].bend});
    return bounds;
}

/// Was it still between the last two looks and this one, and near its place at the last one all the time?
bool Slumber::look(State& state, Index body, const Bounds& bounds, double interval)
{
    RestWatch& watch = state.bodies[body].soft->watch;
    const Range& own = state.bodies[body].nodes;
    almost_ -= watch.looks == kAlmost;
    const std::uint8_t looks = watch.looks;
    if (looks < 2) {  // what falls, or turns round, is slow for once: no memory for that
        const auto speed = static_cast<float>(state.nodes.velocity[own.first].norm());
        const bool falls = !(static_cast<double>(std::abs(speed - watch.speed)) <= bounds.fall * interval);
        watch.speed = speed;
        if (looks == 0 || falls) {
            watch.looks = 1;
            return false;
        }
    }
    if (watch.places.capacity() < own.count) {  // where one comes to rest, others will
        for (BodyRecord& body : state.bodies)
            if (body.soft && body.soft->watch.mayRest && !body.fixed)
                body.soft->watch.places.reserve(body.nodes.count),
                    body.soft->watch.speeds.reserve(2 * std::size_t{body.nodes.count});
    }
    watch.places.resize(own.count), watch.speeds.resize(2 * std::size_t{own.count});
    watch.speed = static_cast<float>(std::min(bounds.speed, 1e30)), watch.looks = 2;
    double fastest = 0, bend = 0;
    for (Index k = 0; k < own.count; ++k) {
        const Vec2& at = state.nodes.position[own.first + k];
        const Vec2 speed = looks > 1 ? Vec2((at - watch.places[k]) / interval) : Vec2(0, 0);
        const Vec2 before(static_cast<double>(watch.speeds[2 * k]), static_cast<double>(watch.speeds[2 * k + 1]));
        fastest = std::max(fastest, speed.squaredNorm()), bend = std::max(bend, (speed - before).squaredNorm());
        watch.places[k] = at;
        watch.speeds[2 * k] = static_cast<float>(speed.x()), watch.speeds[2 * k + 1] = static_cast<float>(speed.y());
    }
    if (looks == 1 || !(std::sqrt(fastest) <= bounds.speed)) return false;
    watch.looks = 3;
    if (looks == 2 || !(std::sqrt(bend) <= bounds.bend * interval)) return false;
    watch.looks = kAlmost, ++almost_;
    return looks == kAlmost;
}

void Slumber::fallAsleep(State& state, Index body)
{
    BodyRecord& is = state.bodies[body];
    forget(is.soft->watch);
    is.asleep = true, drowsy_ = true, ++sleepers_;
    std::fill_n(state.nodes.velocity.begin() + is.nodes.first, is.nodes.count, Vec2(0, 0));
}

void Slumber::wake(State& state, Index body)
{
    disturb(state, body);
    if (!state.bodies[body].asleep) return;
    state.bodies[body].asleep = false, --sleepers_;
}

bool Slumber::isFresh(const State& state) const
{
    if (sinceLook_ != 0 || drowsy_ || sleepers_ > 0 || almost_ > 0 || !stirred_.empty()) return false;
    return std::all_of(state.bodies.begin(), state.bodies.end(), [](const BodyRecord& body) {
        return !body.soft || (body.soft->watch.mayRest == body.soft->watch.drawnMayRest && body.soft->watch.looks == 0);
    });
}

void Slumber::makeFresh(State& state)
{
    for (BodyRecord& body : state.bodies) {
        if (!body.soft) continue;
        forget(body.soft->watch);
        body.soft->watch.mayRest = body.soft->watch.drawnMayRest;
    }
    sinceLook_ = 0, drowsy_ = false, sleepers_ = almost_ = 0;
    stirred_.clear(), islands_.clear();
}

bool Slumber::fits(const State& state) const
{
    const auto known = [&](Index body) { return body < state.bodies.size(); };
    if (islands_.size() > state.bodies.size()) return false;
    if (!std::all_of(islands_.begin(), islands_.end(), [&](Index is) { return is == kNone || known(is); }))
        return false;
    if (!std::all_of(stirred_.begin(), stirred_.end(), known)) return false;
    std::uint32_t almost = 0, sleepers = 0;
    for (const BodyRecord& body : state.bodies) {
        if (!body.soft) continue;
        const RestWatch& watch = body.soft->watch;
        if (watch.looks > kAlmost || (watch.looks > 1 && watch.places.size() != body.nodes.count)) return false;
        if (watch.speeds.size() != 2 * watch.places.size()) return false;
        almost += watch.looks == kAlmost, sleepers += body.asleep;
    }
    return almost == almost_ && sleepers == sleepers_;
}

std::size_t Slumber::bytes() const
{
    return (islands_.capacity() + stirred_.capacity()) * sizeof(Index) + still_.capacity() +
           held_.capacity() * sizeof(Bounds);
}

}  // namespace jet::physics
