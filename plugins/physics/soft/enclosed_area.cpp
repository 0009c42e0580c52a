#include "enclosed_area.hpp"

namespace jet::physics::soft {

namespace {

constexpr double kLeastArea = 0.05;  // of the area at rest: below it, gas is not compressed any further
constexpr double kMostPressure = 0.25;

struct Wall {
    Index first, second;  // nodes
    Vec2 outward;         // normal times length
};

template <class Visit>
void eachWall(const State& state, const BodyRecord& body, Visit&& visit)
{
    for (Index w = body.walls.first; w < body.walls.end(); ++w) {
        if (state.walls.outward[w] == 0) continue;
        const Index first = state.points.node[state.walls.first[w]], second = state.points.node[state.walls.second[w]];
        const Vec2 along = state.nodes.position[second] - state.nodes.position[first];
        visit(Wall{first, second, perpendicular(along) * state.walls.outward[w]});
    }
}

void push(State& state, const BodyRecord& body, double h, std::vector<Vec2>& gradient)
{
    Nodes& nodes = state.nodes;
    gradient.assign(body.nodes.count, Vec2(0, 0));
    eachWall(state, body, [&](const Wall& wall) {
        gradient[wall.first - body.nodes.first] += 0.5 * wall.outward;
        gradient[wall.second - body.nodes.first] += 0.5 * wall.outward;
    });
    double give = 0, rate = 0, lightest = 0;
    for (Index k = 0; k < body.nodes.count; ++k) {
        const Index n = body.nodes.first + k;
        if (nodes.invMass[n] == 0 || gradient[k].isZero()) continue;
        give += nodes.invMass[n] * gradient[k].squaredNorm();
        lightest = std::max(lightest, nodes.invMass[n]);
    }
    if (!(give > 0)) return;
    for (Index k = 0; k < body.nodes.count; ++k) rate += gradient[k].dot(nodes.velocity[body.nodes.first + k]);

    const double rest = body.soft->restArea, now = enclosedArea(state, body), gas = std::max(now, kLeastArea * rest);
    const double most = kMostPressure / (h * h * lightest);
    const SoftMatter& matter = body.soft->matter;
    const double pressure =
        std::clamp(matter.pressure * rest / gas + matter.areaStiffness * (1 - now / rest), -most, most);
    const double stiffness = matter.pressure * rest / (gas * gas) + matter.areaStiffness / rest;
    const double impulse = h * (pressure - h * stiffness * rate) / (1 + h * h * stiffness * give);
    for (Index k = 0; k < body.nodes.count; ++k)
        nodes.velocity[body.nodes.first + k] += nodes.invMass[body.nodes.first + k] * impulse * gradient[k];
}

}  // namespace

double enclosedArea(const State& state, const BodyRecord& body)
{
    if (body.nodes.count == 0) return 0;
    const Vec2 origin = state.nodes.position[body.nodes.first];
    double area = 0;
    eachWall(state, body,
             [&](const Wall& wall) { area += 0.5 * (state.nodes.position[wall.first] - origin).dot(wall.outward); });
    return area;
}

void applyPressure(State& state, double h)
{
    for (const BodyRecord& body : state.bodies) {
        if (body.rigid || body.fixed || !body.enabled || body.soft->open || !(body.soft->restArea > 0)) continue;
        if (body.soft->matter.pressure > 0 || body.soft->matter.areaStiffness > 0)
            push(state, body, h, state.scratch.gradient);
    }
}

}  // namespace jet::physics::soft
