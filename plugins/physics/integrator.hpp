// Semi-implicit Euler (thesis §2.4.2, listing 2.4.3.1.1): velocities first, then positions with the new velocities.
#pragma once

#include "state.hpp"

namespace jet::physics {

/// Gravity, forces, torques and damping over h.
void integrateVelocities(State&, const WorldSettings&, double h);
void integratePositions(State&, double h);

}  // namespace jet::physics
