// The outline of a simple shape as a closed ring, for all that works on points and walls: soft contacts, anchors,
// drawing.
#pragma once

#include <jet/physics.hpp>

namespace jet::physics {

/// Round shapes become polygons of the same area, so that mass and contacts agree.
std::vector<Vec2> outlineOf(const ShapeDef&);

}  // namespace jet::physics
