// Rigid bodies and the pairs of their parts that are near each other, kept from step to step.
#pragma once

#include "part.hpp"

#include "state.hpp"

namespace jet::physics {

/// A rigid body as collision and solver see it. Index 0 is nobody.
struct RigidBody {
    Index node = kNone, handle = kNone;
    Index firstPart = 0, partCount = 0;
    Index material = 0;
    std::uint32_t group = 0, layer = 1, mask = ~0U;
    bool moves = false;  // pushed by contacts
    bool kinematic = false, sensor = false;
    float length = 1;                    // typical size, units
    float reach = 0;                     // farthest point from the centre, units
    float oneSidedX = 0, oneSidedY = 0;  // unit, or null
};

/// What collision needs to know of a body's motion, refreshed at the start of a step.
struct Pose {
    double x = 0, y = 0;                            // scene units
    Vec2f turn{1, 0};                               // (cos, sin)
    float velocityX = 0, velocityY = 0, omega = 0;  // units / s, rad / s
    float travel = 0;                               // units its farthest point may move in this step
};

/// A part's box with room to move in; while the part keeps within, no new pairs are sought for it.
struct FatBox {
    float minX = 0, minY = 0, maxX = -1, maxY = -1;
    bool meets(const FatBox& b) const { return minX <= b.maxX && b.minX <= maxX && minY <= b.maxY && b.minY <= maxY; }
};

struct RigidContact {
    Index partA = 0, partB = 0;
    Index bodyA = 0, bodyB = 0;  // rigid bodies
    float friction = 0, restitution = 0;
    float slop = 0;          // units: overlap left in peace
    std::uint8_t count = 0;  // points
    bool resolve = true;     // false: sensors, or a platform passed from behind
    bool touching = false;   // pushed, or overlapped without being resolved, in the last step
    bool touched = false;    // the same, a step before
    bool passing = false;    // one-sided: came from behind and goes through until they are apart
    std::uint16_t ids[2] = {0, 0};
    Relative at;                                            // the pose the points were found in
    float reach = 0;                                        // units they were sought in
    Vec2f normal;                                           // in A's frame, from A to B
    Vec2f onA[2], onB[2];                                   // in the frames of their bodies
    float separation[2] = {0, 0};                           // units, at the start of the step
    float impulse[2] = {0, 0}, tangentImpulse[2] = {0, 0};  // of the last substep, mass units / s
    float stepImpulse = 0;                                  // greatest of the step

    std::uint64_t key() const { return (static_cast<std::uint64_t>(partA) << 32) | partB; }
};

}  // namespace jet::physics
