// The scenes of soft bodies.
#pragma once

#include "bench/physics/scene.hpp"

namespace jet::bench {

Scene softBalls();
Scene softSheet();

}  // namespace jet::bench
