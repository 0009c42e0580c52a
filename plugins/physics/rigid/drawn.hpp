// Parts of bodies that are drawn as closed borders or open chains.
#pragma once

#include "decompose.hpp"

#include <jet/physics.hpp>

namespace jet::physics {

struct DrawnPart {
    Part part;
    PartOutline outline;
    bool outlined = false;
};

enum class DrawnAs : std::uint8_t {
    Solid,   ///< convex parts that glide over each other's seams
    Region,  ///< convex parts, all of them felt everywhere: sensors
    Walls    ///< its sides, each solid behind: what never moves
};

/// A drawing taken apart, in scene coordinates.
struct Drawing {
    DrawnAs as = DrawnAs::Solid;
    Ring convex;  ///< one ring of few corners: nothing to take apart
    Pieces pieces;
    std::vector<ChainSide> sides;
};

/// Fails with a sentence where that takes too long: see decompose().
Drawing takeApart(const std::vector<Ring>& borders, DrawnAs);

/// `centre`: origin of the parts' frame, scene units. `length`: typical size of the body. Empty without area.
std::vector<DrawnPart> drawnParts(const Drawing&, const Vec2& centre, double length);
std::vector<DrawnPart> chainParts(const std::vector<Vec2>& line, const Vec2& centre, double length);

}  // namespace jet::physics
