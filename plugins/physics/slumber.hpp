// Which soft bodies rest, and what sleeps together with soft bodies. How rigid bodies are judged: rigid/rest.cpp.
//
// Order of calls: after each step watch(), and, when due(), judge(); then fallAsleep() what shall.
//
// A soft body rests when, over three quarters of a second, each of its particles is slow and in balance, as a rigid
// body has to be. But what is soft also moves by itself, and may do so more slowly than any fixed bound: a weak spring
// swings in minutes, a strong damper lets a body sag for hours. So what is slow is measured by the body itself:
//
//   speed < 0.0002 L omega,  speed < 0.0002 L ks / kd,  acceleration < 0.0002 L omega²,   omega² = least ks / mass,
//
// which says that what is left of its motion takes no particle farther than 0.0002 of its length. omega is that of the
// whole body on its weakest spring: lattices swing faster. What still flows (SoftMatter::yield) does not rest.
//
// Places are kept in 4 bytes a particle: as whole quanta, a 32nd of what may pass, modulo 2^16 of them. At one look the
// memory holds places, and the next tells the mean speed since; then it holds where each particle is to be at the look
// after, going on like that, and that one tells by how much the mean speed changed.
//
// Alternative that lost: the centre of mass and the angle alone, which is cheaper, and does not see a body that
// breathes.
#pragma once

#include "actuators.hpp"
#include "soft_springs.hpp"

#include <vector>

namespace jet::physics {

class Slumber {
public:
    /// Is it time to look who rests, after a step of dt?
    bool due(double dt);
    /// After each step: what swings would not be seen where it comes back between the looks.
    void watch(State&, double dt);
    /// In the midst of a step: what comes back after each step would not be seen there either.
    void watchWithin(State&);
    /// Looks at each soft body that is awake.
    void judge(State&, const SoftSprings&, const Actuators&, const WorldSettings&);
    /// As of the last judge().
    bool isStill(Index body) const { return still_[body] != 0; }
    /// Something about it was changed.
    void disturb(State&, Index body);

    /// The least body that sleeps together with it, where one of them is soft; else kNone.
    Index islandOf(Index body) const { return body < islands_.size() ? islands_[body] : kNone; }
    std::vector<Index>& islands() { return islands_; }
    bool any() const { return sleepers_ > 0; }
    void fallAsleep(State&, Index body);
    /// A soft one.
    void wake(State&, Index body);

    /// Bodies that stand and were moved or changed since the last step: they wake what they come near.
    std::vector<Index>& stirred() { return stirred_; }
    const std::vector<Index>& stirred() const { return stirred_; }
    /// Has one fallen asleep after the last step?
    bool& drowsy() { return drowsy_; }
    bool drowsy() const { return drowsy_; }

    /// Is there something to save?
    bool isFresh(const State&) const;
    void makeFresh(State&);
    template <class Archive>
    void archive(Archive& with, State& state)
    {
        with(sinceLook_), with(drowsy_), with(sleepers_), with(almost_);
        with.list(stirred_, [&](Index& body) { with(body); });
        with.list(islands_, [&](Index& island) { with(island); });
        for (BodyRecord& body : state.bodies) {
            if (!body.soft) continue;
            RestWatch& watch = body.soft->watch;
            with(watch.mayRest), with(watch.looks), with(watch.speed);
            if (watch.looks < 2) continue;
            with(watch.slid), with(watch.quantum);
            with.list(watch.places, [&](std::uint16_t& place) { with(place); });
        }
    }
    /// Does what was read back fit the state?
    bool fits(const State&) const;
    std::size_t bytes() const;

private:
    /// What counts as none.
    struct Bounds {
        double speed = 0, bend = 0;  // units / s, units / s²
        double fall = 0;             // units / s²: what changes its speed by more is not worth a look
    };
    Bounds boundsOf(const State&, Index body, const SoftSprings&, const WorldSettings&) const;
    bool look(State&, Index body, const Bounds&, double interval);
    void setLooks(RestWatch&, std::uint8_t looks);
    void forget(RestWatch& watch) { setLooks(watch, 0); }

    std::vector<Index> islands_;  // [bodies]; empty: none sleeps with a soft one
    std::vector<Index> stirred_;
    std::vector<std::uint8_t> still_;  // [bodies]
    std::vector<Bounds> held_;         // [bodies] of judge(): what springs of the scene allow
    double sinceLook_ = 0;             // seconds
    std::uint32_t sleepers_ = 0;       // soft bodies
    std::uint32_t almost_ = 0;         // soft bodies that were still at the last look
    bool drowsy_ = false;
};

}  // namespace jet::physics
