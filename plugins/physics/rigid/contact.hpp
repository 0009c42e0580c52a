// Rigid bodies and the pairs of their parts that are near each other, kept from step to step.
#pragma once

#include "part.hpp"

#include "state.hpp"

namespace jet::physics {

/// A rigid body as collision and solver see it. Index 0 is nobody.
struct RigidBody {
    Index node = kNone, handle = kNone;
    Index firstPart = 0;
    Index partCount : 26 = 0;
    bool moves : 1 = false;  // pushed by contacts
    bool kinematic : 1 = false, sensor : 1 = false;
    bool enabled : 1 = true;
    bool asleep : 1 = false, posed : 1 = false;  // rests; its pose was taken since it does
    Index rules : 28 = 0;                        // in the collider's book
    bool oneSided : 1 = false;                   // by them
    bool mayRest : 1 = true;
    Index looks : 2 = 0;  // how often it was looked at whether it rests, three at most
    float length = 1;     // typical size, units
    float finest = 0;     // the same of its smallest part
    float reach = 0;      // farthest point from the centre, units
    double gyration = 1;  // its radius, units

    bool takesPart() const { return enabled && !asleep; }
};
static_assert(sizeof(RigidBody) == 40);

/// What collision needs to know of a body's motion, refreshed at the start of a step. In a line of its own, as threads
/// write those of different bodies.
struct alignas(64) Pose {
    double x = 0, y = 0;                            // scene units
    Vec2f turn{1, 0};                               // (cos, sin)
    float velocityX = 0, velocityY = 0, omega = 0;  // units / s, rad / s
    float travel = 0;                               // units its farthest point may move in this step
    float reach = 0;                                // of its body, units
    float room = -1;          // units a part may move in its box; below 0: it is to be fitted anew
    Vec2f rest{kUnknown, 0};  // where it was when it last moved, from where its boxes were fitted
    Vec2f restTurn{1, 0};     // and how it was turned then

    static constexpr float kUnknown = 1e30F;  // it is looked at in any case
};
static_assert(sizeof(Pose) == 64);

/// Where a body was when its boxes were fitted.
struct Fitting {
    double x = 0, y = 0;  // scene units
    Vec2f turn{1, 0};
    float travel = 0, unused = 0;
};

/// A part's box with room to move in; while the part keeps within, no new pairs are sought for it.
struct alignas(16) FatBox {
    float minX = 0, minY = 0, maxX = -1, maxY = -1;
    bool meets(const FatBox& b) const { return minX <= b.maxX && b.minX <= maxX && minY <= b.maxY && b.minY <= maxY; }
};

/// Where a contact's constraint lies in the solver: a colour and a lane, or nowhere.
using Place = std::uint32_t;
inline constexpr Place kIdle = 0xffffffffU;    // has no constraint: nothing near enough, or not to be pushed
inline constexpr Place kFree = 0xfffffffeU;    // no contact at all
inline constexpr Place kAsleep = 0xfffffffdU;  // between bodies that rest: its constraint was taken away
inline constexpr bool isPlaced(Place place) { return place < kAsleep; }
inline constexpr int kLaneBits = 24;

/// Two parts whose boxes meet. Two cache lines of its own, as threads write different contacts, of which pairs without
/// points need the first alone; the impulses are the solver's while it has a constraint.
struct alignas(64) RigidContact {
    Index partA = 0, partB = 0;
    Index bodyA = 0, bodyB = 0;    // rigid bodies
    Relative at;                   // the pose the points were found in
    float slop = 0;                // units: overlap left in peace
    float separation[2] = {0, 0};  // units, when last looked at; at least, without points
    float reach = 0;               // units the points were sought in
    std::uint8_t count = 0;        // points
    bool touching = false;         // pushed, or overlapped without being resolved, in the last step
    bool passing = false;          // one-sided: came from behind and goes through until they are apart
    bool resolve = true;           // false: sensors, or a platform passed from behind
    bool due = true;               // to be looked at in the next step in any case
    bool foreseen = false;         // its point is one of a hit later in the step
    bool special = false;          // one-sided, or of very different lengths: looked at alone
    std::uint8_t unused = 0;
    std::uint16_t ids[2] = {0, 0};
    float stepImpulse = 0;                                  // sum over the step, mass units / s
    Vec2f normal;                                           // in A's frame, from A to B
    Vec2f onA[2], onB[2];                                   // in the frames of their bodies
    float impulse[2] = {0, 0}, tangentImpulse[2] = {0, 0};  // of the last substep, mass units / s
    float friction = 0, restitution = 0;

    /// Units between the surfaces where they are nearest; huge when nothing is near.
    float nearest() const
    {
        if (count == 0) return 3e38F;
        return count > 1 && separation[1] < separation[0] ? separation[1] : separation[0];
    }
    static std::uint64_t keyOf(Index partA, Index partB)
    {
        return (static_cast<std::uint64_t>(std::min(partA, partB)) << 32) | std::max(partA, partB);
    }
    std::uint64_t key() const { return keyOf(partA, partB); }
};
static_assert(sizeof(RigidContact) == 128);

/// When a contact without points has to be looked at again; in a list of its own, as most of them are far from it.
struct Nearing {
    double until = -1;  // units both bodies' ways may have grown to; below 0: as soon as one of them moves
    Index bodyA = 0, bodyB = 0;
    float slop = 0;
    float thin = 0;  // units a step: what moves farther against the other may pass through it
};

}  // namespace jet::physics
