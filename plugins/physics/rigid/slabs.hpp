// Any closed rings, however they cross, cut into horizontal slabs at every corner and crossing.
#pragma once

#include "triangulate.hpp"

namespace jet::physics {

/// Triangles of the region inside an odd number of the rings. Fails where there are too many crossings; see
/// decompose().
Mesh slabs(const std::vector<Ring>& rings);

}  // namespace jet::physics
