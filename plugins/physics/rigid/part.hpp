// A convex part of a rigid body: a point, a segment or a polygon of up to 8 corners, rounded by a radius. So a circle
// is a rounded point and a capsule a rounded segment, and one pair of algorithms collides them all.
#pragma once

#include <jet/geometry.hpp>

#include <cstdint>

namespace jet::physics {

using jet::cross;

/// Single precision: parts are small and lie about their body's centre of mass.
struct Vec2f {
    float x = 0, y = 0;
};
inline Vec2f operator+(Vec2f a, Vec2f b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2f operator-(Vec2f a, Vec2f b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2f operator-(Vec2f a) { return {-a.x, -a.y}; }
inline Vec2f operator*(float s, Vec2f a) { return {s * a.x, s * a.y}; }
inline float dot(Vec2f a, Vec2f b) { return a.x * b.x + a.y * b.y; }
inline float cross(Vec2f a, Vec2f b) { return a.x * b.y - a.y * b.x; }
/// `v` turned by the angle whose (cos, sin) is `turn`, and back.
inline Vec2f turned(Vec2f turn, Vec2f v) { return {turn.x * v.x - turn.y * v.y, turn.y * v.x + turn.x * v.y}; }
inline Vec2f turnedBack(Vec2f turn, Vec2f v) { return {turn.x * v.x + turn.y * v.y, turn.x * v.y - turn.y * v.x}; }

inline constexpr int kMostCorners = 8;

/// What of a part is the outside of its body: parts of drawn outlines and walls of chains only (outlined.hpp).
struct PartOutline {
    std::uint8_t inner = 0;  // bits: the side from corner i to i + 1 is none that can be touched
    bool wall = false;       // a side of a chain: solid behind it
    // Directions a corner may be touched from lie between these, in the body's frame; null: none.
    Vec2f before[kMostCorners], after[kMostCorners];
};

/// In rows of 16 bytes, as the wide looks read them (look.inc.hpp). Corners and normals beyond the last are those of
/// the first again, so that the corner after any is the next.
struct alignas(16) Part {
    float radius = 0;        // units
    float length = 0;        // typical size, units: tolerances are fractions of it
    float reach = 0;         // units: farthest point from the body's centre of mass
    std::uint8_t count = 0;  // corners: 1 circle, 2 capsule, 3.. polygon
    bool reversed = false;   // do they lie in the other direction than they were given in?
    bool outlined = false;   // has it an outline (weld.hpp)?
    std::uint8_t unused = 0;
    Vec2f normals[kMostCorners];      // unit, outward, of the side from corner i to i + 1; a segment has two
    Vec2f corners[kMostCorners + 1];  // in the body's frame, so that normals are to the right of the way round
    std::uint32_t body = 0;           // index of the rigid body
    float thickness = 0;              // units: the narrowest way through it

    /// The middle of its corners, in the body's frame.
    Vec2f centre() const;
};
static_assert(sizeof(Part) == 160);

/// Where B's frame is in A's.
struct Relative {
    Vec2f move;        // units
    Vec2f turn{1, 0};  // (cos, sin)
};

struct ManifoldPoint {
    Vec2f onA;             // surface point in A's frame
    Vec2f onB;             // surface point in B's frame
    std::uint16_t id = 0;  // which features touch
    float separation = 0;  // units; negative: overlap
};

struct Manifold {
    Vec2f normal;  // unit, from A to B, in A's frame
    int count = 0;
    float gap = 0;  // units they are apart, or more, when there are no points
    ManifoldPoint points[2];
};

/// Fills in what follows from corners and radius. `corners`: 1, 2, or a convex polygon in either direction.
Part makePart(const Vec2* corners, int count, double radius);

/// Touching points of two parts that are no farther apart than `reach` units.
Manifold collide(const Part& a, const Part& b, const Relative& bInA, float reach);

struct Looker;
/// The distance of two parts, with the nearest points and the normal from A to B, all in A's frame. Exact while they
/// are apart; negative, and only about as deep as they are, when they overlap.
struct Distance {
    float distance = 0;
    Vec2f onA, onB, normal;
};
Distance distanceOf(const Part& a, const Part& b, const Relative& bInA, const Looker&);

}  // namespace jet::physics
