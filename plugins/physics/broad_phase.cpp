#include "broad_phase.hpp"

namespace jet::physics {

void findPairs(const State& state, const std::vector<Motion>& motions, std::vector<BodyPair>& pairs)
{
    pairs.clear();
    std::vector<Index>& order = state.scratch.order;
    order.clear();
    for (Index body = 0; body < motions.size(); ++body)
        if (state.bodies[body].points.count > 0 && !motions[body].reach.isNull()) order.push_back(body);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        const double left = motions[a].reach.min.x(), right = motions[b].reach.min.x();
        return left < right || (left == right && a < b);
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Box& own = motions[order[i]].reach;
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const Box& other = motions[order[j]].reach;
            if (other.min.x() > own.max.x()) break;
            if (other.min.y() > own.max.y() || other.max.y() < own.min.y()) continue;
            if (state.bodies[order[i]].fixed && state.bodies[order[j]].fixed) continue;
            if (state.bodies[order[i]].simple && state.bodies[order[j]].simple) continue;
            if (!state.mayMeet(order[i], order[j])) continue;
            pairs.push_back({std::min(order[i], order[j]), std::max(order[i], order[j])});
        }
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const BodyPair& p, const BodyPair& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); });
}

}  // namespace jet::physics
