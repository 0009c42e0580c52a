// Keeps absurd speeds from reaching infinity.
#pragma once

#include <jet/geometry.hpp>

namespace jet::physics {

void limitSpeed(Vec2& velocity, double& omega);
/// The same for what a body moves and turns in dt seconds.
void limitMove(Vec2& move, double& turn, double dt);

}  // namespace jet::physics
