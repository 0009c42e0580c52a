#include "broad_phase.hpp"

#include <algorithm>

namespace jet::physics {

void findPairs(const State& state, const std::vector<Motion>& motions, std::vector<BodyPair>& pairs)
{
    pairs.clear();
    std::vector<Scratch::Reach>& reaches = state.scratch.reaches;
    reaches.clear();
    for (Index body = 0; body < motions.size(); ++body) {
        const BodyRecord& record = state.bodies[body];
        const Box& box = motions[body].reach;
        const bool stands = record.fixed || record.kinematic;  // for what it meets
        if (record.points.count == 0 || box.isNull()) continue;
        reaches.push_back({box.min.x(), box.max.x(), box.min.y(), box.max.y(), body, stands, record.simple});
    }
    std::sort(reaches.begin(), reaches.end(), [](const Scratch::Reach& p, const Scratch::Reach& q) {
        return p.left < q.left || (p.left == q.left && p.body < q.body);
    });
    const std::size_t count = reaches.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Scratch::Reach own = reaches[i];
        for (std::size_t j = i + 1; j < count && !(reaches[j].left > own.right); ++j) {
            const Scratch::Reach& other = reaches[j];
            if (other.top > own.bottom || other.bottom < own.top) continue;
            if ((own.stands && other.stands) || (own.simple && other.simple)) continue;
            if (!state.mayMeet(own.body, other.body)) continue;
            pairs.push_back({std::min(own.body, other.body), std::max(own.body, other.body)});
        }
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const BodyPair& p, const BodyPair& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); });
}

}  // namespace jet::physics
