// The outline of a simple shape as a closed ring, for all that works on points and walls: soft contacts, anchors,
// drawing.
#pragma once

#include "border.hpp"

#include <jet/physics.hpp>

namespace jet::physics {

/// Round shapes become polygons of the same area, so that mass and contacts agree.
std::vector<Vec2> outlineOf(const ShapeDef&);

/// Area, centre and moment of parts together, exactly; where parts overlap they count twice.
Region measureShapes(const std::vector<ShapeDef>&);

}  // namespace jet::physics
