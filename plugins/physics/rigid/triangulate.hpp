// The region inside an odd number of closed rings, as triangles: rings -> cleaned -> triangles.
//
// Rings that neither cross nor touch are clipped ear by ear, holes joined to their outer ring by a bridge. All others
// are cut into slabs at every corner and crossing, which cannot fail and only makes more and thinner triangles.
#pragma once

#include <jet/geometry.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace jet::physics {

using Ring = std::vector<Vec2>;

struct Mesh {
    using Triangle = std::array<std::uint32_t, 3>;  // of positive area

    std::vector<Vec2> points;
    std::vector<Triangle> triangles;  // those that meet share points and whole sides

    double area() const;
};

/// The rings without points twice, and without those of fewer than three points.
std::vector<Ring> cleaned(const std::vector<Ring>& rings);

/// Do no two sides cross or touch, other than neighbours at their corner?
bool areSimple(const std::vector<Ring>& rings);

/// Simple rings turned so that the area of outer ones is positive and that of holes negative.
std::vector<Ring> oriented(std::vector<Ring> rings);

/// Empty where the rings enclose nothing.
Mesh triangulate(const std::vector<Ring>& rings);

/// Exchanges diagonals until no triangle's circle holds its neighbour's corner (Delaunay, keeping the outline).
void improve(Mesh&);

}  // namespace jet::physics
