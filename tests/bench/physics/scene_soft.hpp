// The scenes of soft bodies.
#pragma once

#include "bench/physics/scene.hpp"

namespace jet::bench {

Scene softBalls();
Scene softSheet();
/// The same with other numbers of balls, and of particles along a side of the sheet.
Scene softPile(int columns, int rows);
Scene hangingSheet(std::uint32_t side);

}  // namespace jet::bench
