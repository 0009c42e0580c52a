// Points of one body near or inside another: which walls may they touch in the coming step, and from which side?
//
// A point outside may touch every wall whose front it is at and which it can reach, whatever happens to its direction:
// the solver takes up a wall only once the point really comes to it, so fast points cannot tunnel and slow ones cost
// little. A point inside is pushed out through one wall: the one that held it before, else the nearest whose outside
// opposes the point's own (thesis §2.4.3.7), else the nearest.
#pragma once

#include "broad_phase.hpp"
#include "contact_point.hpp"

#include <span>

namespace jet::physics {

class NarrowPhase {
public:
    /// `previous`: the contacts of the step before, sorted by key; `dt`: the time the contacts are to serve, seconds.
    NarrowPhase(const State&, const std::vector<Motion>&, std::span<const ContactPoint> previous, double dt);

    /// Appends the contacts of A's points with B's walls. `pattern` carries what the pair has in common.
    void collide(Index bodyA, Index bodyB, const ContactPoint& pattern, std::vector<ContactPoint>& found);

    /// Contacts of the border points of a soft body with its own walls that face them.
    void collideSelf(Index body, const ContactPoint& pattern, std::vector<ContactPoint>& found);

private:
    struct WallView {
        double separation, along, distance, length;
        Vec2 normal;
    };
    struct Approach {
        Index point;
        Vec2 at, normal;  // in B's frame
        double reach;     // units around `at`
    };

    void gatherPoints(const BodyRecord& a, const Box& near);
    void touch(const Approach&, const ContactPoint& pattern, std::vector<ContactPoint>& found);
    /// Near that end of the wall, is the point rather its neighbour's? Then neither catches what slides over the
    /// corner.
    bool yields(Index wall, const std::vector<WallEnd>& ends, const std::vector<Index>& neighbours,
                const Approach&) const;
    Index wallToLeaveThrough(const Approach&) const;
    bool view(Index wall, const Vec2& at, WallView&) const;
    bool heldBefore(Index point, Index wall) const;

    const State& state_;
    const std::vector<Motion>& motions_;
    std::span<const ContactPoint> previous_;
    double dt_;
    // Of the pair at work.
    const BodyRecord* a_ = nullptr;
    const BodyRecord* b_ = nullptr;
    const EdgeGrid* grid_ = nullptr;  // of b_
    const std::vector<Vec2>* frame_ = nullptr;
    std::vector<Index>& candidates_;
};

}  // namespace jet::physics
