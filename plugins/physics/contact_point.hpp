// A point of body A that may touch a wall of body B in this step: found by the narrow phase, solved by the contact
// solver.
#pragma once

#include "state.hpp"

namespace jet::physics {

/// Slop as a part of the length of the smaller body.
inline constexpr double kSlopPerLength = 0.002;
/// What a soft contact holds is in proportion to the lighter mass, so a heavy body would sink into a light one. A
/// contact is soft up to so many slops of overlap; from there on it yields less and less, and from twice as many on it
/// is as hard as its load demands. One that did not come from the wall's front stays soft.
inline constexpr double kYieldSlops = 10;
/// In slops: overlaps up to this depth can come of resting; a point deeper behind a wall went round its end or is
/// inside.
inline constexpr double kTouchDepth = 4;

struct ContactPoint {
    // Found once a detection.
    Index point = 0, wall = 0;
    Index bodyA = 0, bodyB = 0;
    double slop = 0;       // units; overlap that is left in peace, so that resting contacts persist
    double thickness = 0;  // units between the point and the wall when they touch
    double friction = 0, restitution = 0;
    double surprise = 0;   // units a hit may bring the point nearer than its velocity says
    bool resolve = true;   // false: sensors
    bool inside = false;   // the point began this step inside B and is pushed out through this wall
    bool engaged = false;  // the point has come to the wall from outside
    bool firstInset = false, secondInset = false;  // near that end the wall leaves the point to its neighbour

    bool plain = false;  // only particles: nothing here turns
    bool lone = false;   // a particle at a wall that never moves
    Index nodeA = 0, nodeB0 = 0, nodeB1 = 0;
    Vec2 first, edge;  // lone: the wall

    // Refreshed each substep.
    bool active = false;
    bool round = false;                 // touched at the wall's first end, around which its thickness goes
    Vec2 normal;                        // unit, out of B
    double separation = 0;              // units along the normal; negative when overlapping
    double along = 0;                   // 0..1 on the wall
    double weightB0 = 1, weightB1 = 0;  // the wall's point between its ends; a rigid wall is one node
    Vec2 armA, armB;                    // from the nodes, units
    double normalMass = 0, tangentMass = 0;
    double approachSpeed = 0;  // along the normal before the contact acts, units/s; negative when approaching
    bool againstFixed = false;

    // Carried from substep to substep and, by (point, wall), from step to step.
    double normalImpulse = 0, tangentImpulse = 0;  // of the last substep, mass * unit / s
    double keptImpulse = 0;                        // normalImpulse as it was before this substep
    double stepImpulse = 0;                        // normal, summed over the step

    std::uint64_t key() const { return (static_cast<std::uint64_t>(point) << 32) | wall; }
};

/// What is read of each contact in each substep; the rest only of those that are active.
struct ContactHead {
    std::uint8_t idle = 0;  // substeps in which it cannot become active
};

}  // namespace jet::physics
