// What a scene's bodies hold of energy, the same formulas for every engine, from positions alone.
#pragma once

#include "bench/physics/engines.hpp"

namespace jet::bench {

struct Energy {
    double kinetic = 0, potential = 0;  // J; of weight (0 at y = 0) and of the scene's springs

    double all() const { return kinetic + potential; }
};

/// As the scene describes it, before the first step.
Energy energyAtStart(const Scene&);
/// `before`: the poses one step before `now`; what a body does meanwhile is its velocity.
Energy energyOf(const Scene&, const std::vector<Pose>& before, const std::vector<Pose>& now);

}  // namespace jet::bench
