// Keeps absurd speeds from reaching infinity.
#pragma once

#include <jet/geometry.hpp>

namespace jet::physics {

void limitSpeed(Vec2& velocity, double& omega);

}  // namespace jet::physics
