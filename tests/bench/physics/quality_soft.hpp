// How well did soft bodies do, over the timed steps and at their end? From positions alone.
#pragma once

#include "bench/physics/engines.hpp"

#include <nlohmann/json.hpp>

namespace jet::bench {

class SoftWatch {
public:
    explicit SoftWatch(const Scene&);

    /// After each timed step.
    void see(const Engine&);
    /// Of outlines: area, inversions, balls that passed into each other, pairs of balls that touch, and balls that
    /// touch no other; of what hangs: the mean height over the timed steps of the row that is lowest at first.
    nlohmann::ordered_json quality(const std::vector<Pose>& now) const;

private:
    const Scene& scene_;
    std::vector<std::size_t> bottom_;  // bodies of the lowest row, where the scene has no outlines
    double sum_ = 0;
    int steps_ = 0;
};

}  // namespace jet::bench
