// Semi-implicit Euler (thesis §2.4.2, listing 2.4.3.1.1): velocities first, then positions with the new velocities.
#pragma once

#include "soft/kernels.hpp"
#include "state.hpp"

namespace jet::physics {

/// Gravity, forces, torques and damping over h. Forces and torques are used up.
void integrateVelocities(State&, const WorldSettings&, const soft::Kernels&, double h);
/// Keeps absurd speeds from reaching infinity.
void limitVelocities(State&);
void integratePositions(State&, const soft::Kernels&, double h);

}  // namespace jet::physics
