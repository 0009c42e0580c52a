#include "slumber.hpp"

#include <algorithm>
#include <bit>
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

// Of RestWatch::looks.
constexpr std::uint8_t kPlaces = 2, kSlow = 3;
constexpr std::uint8_t kAlmost = 4;     // and from there on
constexpr std::uint8_t kConfirmed = 6;  // and in balance between all looks but the last

/// Does its memory hold where particles are to be, rather than where they were?
bool isForetold(std::uint8_t looks) { return looks >= kSlow && looks % 2 == 1; }

// Quanta. What is measured between whole ones is wrong by up to 2 an axis.
constexpr double kPerBound = 32, kRounding = 3;

/// The number of whole quanta modulo 2^16; of numbers up to 2^51.
std::uint16_t residue(double quanta)
{
    constexpr double kUnits = 0x1.8p52;  // added to it, the last bits of a double are units
    return static_cast<std::uint16_t>(std::bit_cast<std::uint64_t>(quanta + kUnits));
}

double squaredNorm(double x, double y) { return x * x + y * y; }

/// Is a length in quanta surely not above the most?
bool isWithin(double length, double most) { return length == 0 || length + kRounding <= most; }

/// Quanta from what its memory holds.
double farthest(const State& state, const BodyRecord& body)
{
    const RestWatch& watch = body.soft->watch;
    const double per = 1 / watch.quantum;
    double squared = 0;
    for (Index k = 0; k < body.nodes.count; ++k) {
        const Vec2& at = state.nodes.position[body.nodes.first + k];
        squared = std::max(
            squared,
            squaredNorm(static_cast<std::int16_t>(residue(at.x() * per) - watch.places[2 * std::size_t{k}]),
                        static_cast<std::int16_t>(residue(at.y() * per) - watch.places[2 * std::size_t{k} + 1])));
    }
    return std::sqrt(squared);
}

/// Notes where particles are, to tell motions of a part of `least` units.
void keepPlaces(const State& state, const BodyRecord& body, double least)
{
    RestWatch& watch = body.soft->watch;
    double size = body.length;
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
        size = std::max(size, state.nodes.position[n].cwiseAbs().maxCoeff());
    watch.quantum = std::max({least / kPerBound, 0x1p-51 * size, 1e-300});
    const double per = 1 / watch.quantum;
    for (Index k = 0; k < body.nodes.count; ++k)
        for (const int axis : {0, 1})
            watch.places[2 * std::size_t{k} + axis] = residue(state.nodes.position[body.nodes.first + k][axis] * per);
}

/// Its memory holds where they were; now, where they will be when they go on like that. Quanta the fastest went.
double foretell(const State& state, const BodyRecord& body)
{
    RestWatch& watch = body.soft->watch;
    const double went = farthest(state, body), per = 1 / watch.quantum;
    for (Index k = 0; k < body.nodes.count; ++k)
        for (const int axis : {0, 1}) {
            std::uint16_t& place = watch.places[2 * std::size_t{k} + axis];
            place =
                static_cast<std::uint16_t>(2 * residue(state.nodes.position[body.nodes.first + k][axis] * per) - place);
        }
    return went;
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
        if (!body.soft || body.soft->watch.looks < kAlmost) continue;
        RestWatch& watch = body.soft->watch;
        const double foretold = isForetold(watch.looks) ? static_cast<double>(watch.slid) : 0;
        if (!isWithin(farthest(state, body), elapsed * static_cast<double>(watch.speed) / watch.quantum + foretold))
            forget(watch);
    }
}

void Slumber::watchWithin(State& state)
{
    if (almost_ == 0) return;
    for (BodyRecord& body : state.bodies)
        if (body.soft && body.soft->watch.looks >= kAlmost && isFast(state, body)) forget(body.soft->watch);
}

void Slumber::setLooks(RestWatch& watch, std::uint8_t looks)
{
    almost_ -= watch.looks >= kAlmost, almost_ += looks >= kAlmost;
    watch.looks = looks;
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
        // For all at the first look, not when they come to rest: a world in its rhythm takes no memory.
        is.soft->watch.places.resize(2 * std::size_t{is.nodes.count});
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

/// Was it still between the last three looks and this one, and near its place at the last one all the time?
bool Slumber::look(State& state, Index body, const Bounds& bounds, double interval)
{
    const BodyRecord& is = state.bodies[body];
    RestWatch& watch = is.soft->watch;
    const double slow = bounds.speed * interval, balanced = bounds.bend * interval * interval;  // units
    const auto start = [&](std::uint8_t looks) {
        keepPlaces(state, is, std::min(slow, balanced));
        watch.speed = static_cast<float>(std::min(bounds.speed, 1e30)), watch.slid = 0;
        setLooks(watch, looks);
    };
    if (watch.looks < kPlaces) {  // what falls, or turns round, is slow for once
        const auto speed = static_cast<float>(state.nodes.velocity[is.nodes.first].norm());
        const bool falls = !(static_cast<double>(std::abs(speed - watch.speed)) <= bounds.fall * interval);
        const bool first = watch.looks == 0;
        watch.speed = speed;
        if (first || falls) {
            setLooks(watch, 1);
        } else {
            start(kPlaces);
        }
        return false;
    }
    const std::uint8_t looks = watch.looks;
    if (isForetold(looks)) {
        const double bend = farthest(state, is);
        const bool fine = isWithin(bend, balanced / watch.quantum);
        const double slid = (static_cast<double>(watch.slid) + bend) * watch.quantum;
        start(!fine ? kPlaces : looks == kSlow ? kAlmost : kConfirmed);
        watch.slid = static_cast<float>(slid / watch.quantum);
        return watch.looks == kConfirmed;
    }
    const double before = static_cast<double>(watch.slid), went = foretell(state, is);
    watch.slid = static_cast<float>(went);
    if (!isWithin(went, slow / watch.quantum)) {
        start(kPlaces);
        return false;
    }
    // What is slow enough twice is in balance, whatever its directions.
    const bool confirmed =
        looks >= kConfirmed || (looks >= kAlmost && isWithin(before + went, balanced / watch.quantum));
    setLooks(watch, confirmed ? kConfirmed + 1 : looks + 1);
    return confirmed;
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
        if (watch.looks > kConfirmed + 1) return false;
        if (watch.looks >= kPlaces &&
            (watch.places.size() != 2 * std::size_t{body.nodes.count} || !(watch.quantum > 0)))
            return false;
        almost += watch.looks >= kAlmost, sleepers += body.asleep;
    }
    return almost == almost_ && sleepers == sleepers_;
}

std::size_t Slumber::bytes() const
{
    return (islands_.capacity() + stirred_.capacity()) * sizeof(Index) + still_.capacity() +
           held_.capacity() * sizeof(Bounds);
}

}  // namespace jet::physics
