// The area of a convex part of a rigid body, and what of it is within a convex region.
#pragma once

#include "rigid/part.hpp"

#include <array>
#include <span>

namespace jet::physics {

/// Convex, in scene coordinates, in either direction.
struct Surface {
    static constexpr int kMost = 40;  // a round part has 16 corners, and each side of what clips it adds one
    std::array<Vec2, kMost> points;
    int count = 0;

    void add(const Vec2& at)
    {
        if (count < kMost) points[static_cast<std::size_t>(count++)] = at;
    }
};

struct Moments {
    double area = 0;  // units²
    Vec2 centroid = Vec2(0, 0);
    double second = 0;  // units⁴, polar, about the centroid
};

/// Of a part whose body is at `centre`, turned by the angle of which `turn` is (cos, sin).
Surface surfaceOf(const Part&, const Vec2& centre, const Vec2& turn);
Box boxOf(const Surface&);
Moments momentsOf(const Surface&);
/// What of it is within the convex ring, whose area is positive (Sutherland and Hodgman, 1974).
Surface clipped(const Surface&, std::span<const Vec2> ring);

}  // namespace jet::physics
