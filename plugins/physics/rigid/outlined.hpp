// Touching points where at least one part belongs to a drawn outline or a chain: as collide(), but no side within the
// body holds anything, and corners hold only from where they are outside.
//
// Why: a box that glides over the seam of two parts overlaps the second a little from ahead, before it overlaps it from
// above; plain separating axes would take that for a hit. An axis counts here only where the outline faces it.
#pragma once

#include "part.hpp"

namespace jet::physics {

/// `outlineA`, `outlineB`: null for parts that are all outside.
Manifold collideOutlined(const Part& a, const PartOutline* outlineA, const Part& b, const PartOutline* outlineB,
                         const Relative& bInA, float reach);

}  // namespace jet::physics
