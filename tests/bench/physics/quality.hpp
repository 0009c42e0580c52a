// How well did an engine do? The same code for all of them, from positions alone.
#pragma once

#include "bench/physics/engines.hpp"

#include <nlohmann/json.hpp>

namespace jet::bench {

std::vector<Pose> posesOf(const Engine&, std::size_t bodies);

/// `before`: the poses one step before `now`.
nlohmann::ordered_json qualityOf(const Scene&, const std::vector<Pose>& before, const std::vector<Pose>& now);

}  // namespace jet::bench
