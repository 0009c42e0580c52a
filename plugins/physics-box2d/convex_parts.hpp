// Cuts the region of a body, concave and with holes, into convex parts of at most 8 corners, as Box2D wants them.
#pragma once

#include "outline.hpp"

namespace jet::box2d {

/// Parts of an odd-even region; sides may cross. Parts thinner than Box2D's tolerance are left out.
std::vector<Ring> convexParts(const Rings& rings);

}  // namespace jet::box2d
