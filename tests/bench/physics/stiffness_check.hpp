// The hanging sheet with stiffer and stiffer springs.
#pragma once

namespace jet::bench {

/// From 30 Hz, the scene's, to 480 Hz of a particle on one spring: false when a number becomes none, or motion and
/// height of the sheet ever hold more energy than at its start.
bool everyStiffnessIsStable();

}  // namespace jet::bench
