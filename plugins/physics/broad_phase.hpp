// Which bodies may meet during the coming step?
#pragma once

#include "state.hpp"

#include <limits>

namespace jet::physics {

struct BodyPair {
    Index a, b;  // a < b
};

/// What a body may do in the coming step of dt.
struct Motion {
    Box reach;      // everywhere it may come
    Vec2 velocity;  // of its centre
    double omega = 0;
    Vec2 centre;
    double surprise = 0;  // units a hit by a faster body may carry it, beyond the prediction
    double range = 0;     // units any of its points may move
    double stray = 0;     // units its points may leave the predicted rigid motion before contacts are sought again
    // Soft bodies:
    double spread = 0;                                     // units / s their particles move besides, at most
    double off = std::numeric_limits<double>::infinity();  // units from where the shape at rest has them, at most
    double radius = 0;                                     // units from the centre, at most
};

/// Pairs whose reaches meet, by a sweep over boxes sorted along x; in ascending order. Pairs of fixed bodies are left
/// out, and those that layers, masks and groups keep apart.
void findPairs(const State&, const std::vector<Motion>& motions, std::vector<BodyPair>& pairs);

}  // namespace jet::physics
