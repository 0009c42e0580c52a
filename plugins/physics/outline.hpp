// The outline of a simple shape as a closed ring, for all that works on points and walls: soft contacts, anchors,
// drawing.
#pragma once

#include "border.hpp"
#include "rigid/part.hpp"

#include <jet/physics.hpp>

#include <array>

namespace jet::physics {

/// Round shapes become polygons of the same area, so that mass and contacts agree.
std::vector<Vec2> outlineOf(const ShapeDef&);

/// The same ring from the part that a shape became, as exact as parts are: to 10^-7 of the body's size.
struct PartRing {
    static constexpr std::size_t kMost = 18;
    std::array<Vec2, kMost> points;  // in the body's frame
    Index count = 0;
    std::int8_t outward = -1;  // as of walls
};
Index ringSizeOf(const Part&);
PartRing ringOf(const Part&);

/// Area, centre and moment of parts together, exactly; where parts overlap they count twice.
Region measureShapes(const std::vector<ShapeDef>&);

}  // namespace jet::physics
