// The quality an engine must keep in the benchmark's scenes to be worth its time. Nothing here is about time.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace jet::bench {

/// A sentence for each bound of the scene that this quality (qualityOf) breaks, or does not tell about.
std::vector<std::string> brokenBounds(const std::string& scene, const nlohmann::ordered_json& quality);
/// How many there are; 0 for scenes that are not of this program.
std::size_t boundsOf(const std::string& scene);

}  // namespace jet::bench
