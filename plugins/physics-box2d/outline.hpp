// Outlines of bodies in the plane: what they contain, their moments, and rings for shapes that have none.
#pragma once

#include <jet/physics.hpp>

#include <vector>

namespace jet::box2d {

using Ring = std::vector<Vec2>;
using Rings = std::vector<Ring>;

/// Of a region of density 1.
struct Moments {
    double area = 0;
    Vec2 centroid{0, 0};
    double second = 0;  ///< about the centroid, per area
};

/// Twice the signed area; above 0 where the ring turns from x to y.
double twiceArea(const Ring&);
/// Is the point inside an odd number of rings?
bool contains(const Rings&, const Vec2& point);
/// Do sides of the rings cross each other? Then depth tells nothing about where the body is.
bool sidesCross(const Rings&);
/// Is the ring inside an odd number of the others, a hole?
bool isHole(const Rings&, std::size_t ring);

/// Of an odd-even region whose sides do not cross.
Moments momentsOf(const Rings&);
/// Of a compound; what overlaps counts twice.
Moments momentsOf(const std::vector<ShapeDef>&);
/// The body's border points: circles become 16 corners around the same area. Chains stay open.
Ring outlineOf(const ShapeDef&);

}  // namespace jet::box2d
