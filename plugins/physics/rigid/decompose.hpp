// Drawn outlines as convex parts (docs/decisions/0035): rings -> triangles -> merged where they stay convex.
//
// Parts of one body meet along sides that nothing outside can touch, and share corners at which only some directions
// are outside. Both are marked, so that what slides over a seam feels one smooth outline.
#pragma once

#include "part.hpp"
#include "triangulate.hpp"

namespace jet::physics {

/// A convex piece of a region, by indices into the mesh's points, in the direction of positive area.
struct Piece {
    std::vector<std::uint32_t> corners;
    std::uint8_t inner = 0;           // bits: the side from corner i to i + 1 lies within the region
    std::vector<Vec2> before, after;  // [corners] outward normals of the outline on both sides; null: no outside here
};

struct Pieces {
    std::vector<Vec2> points;
    std::vector<Piece> pieces;
};

/// Convex pieces of at most 8 corners, which together are the region inside an odd number of the rings. This and
/// outlineSides() fail with the end of a sentence ("has 90000 corners; ...") where it would take seconds, or gigabytes.
Pieces decompose(const std::vector<Ring>& rings);

/// A wall of a region that never moves, solid on one side, with what is needed to glide from one to the next.
struct ChainSide {
    Vec2 a, b;           // solid to the right of the way from a to b, as seen on screen
    Vec2 before, after;  // unit: outermost directions the ends may be touched from; null: not at all
};

/// The outline of the region inside an odd number of the rings.
std::vector<ChainSide> outlineSides(const std::vector<Ring>& rings);
/// An open line.
std::vector<ChainSide> chainSides(const std::vector<Vec2>& line);

}  // namespace jet::physics
