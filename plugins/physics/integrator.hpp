// Semi-implicit Euler (thesis §2.4.2, listing 2.4.3.1.1): velocities first, then positions with the new velocities.
#pragma once

#include "soft_springs.hpp"

namespace jet::physics {

/// Gravity, springs, forces, torques and damping over h. Forces and torques are used up; `pushed`: are there any?
void integrateVelocities(State&, const WorldSettings&, SoftSprings&, double h, bool pushed);
/// Adds what the springs leave to be added to velocities, too.
void integratePositions(State&, const SoftSprings&, double h);

}  // namespace jet::physics
