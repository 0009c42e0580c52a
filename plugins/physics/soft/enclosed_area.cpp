#include "enclosed_area.hpp"

#include <cmath>
#include <limits>

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

/// ln x by the series of artanh: that of the library has other bits on other processors.
double logarithm(double x)
{
    constexpr double kLog2 = 0.69314718055994530942;
    int exponent = 0;
    double part = std::frexp(x, &exponent);
    if (part < 0.7071) part *= 2, --exponent;
    const double t = (part - 1) / (part + 1);
    double sum = 0;
    for (int k = 23; k >= 1; k -= 2) sum = sum * t * t + 1.0 / k;
    return 2 * t * sum + exponent * kLog2;
}

/// Pressure by area, as it acts: held to `most`.
struct Pressure {
    double gas, stiffness, rest, most;  // SoftMatter::pressure and areaStiffness

    Pressure(const BodyRecord& body, double h, double lightest)
        : gas(body.soft->matter.pressure), stiffness(body.soft->matter.areaStiffness), rest(body.soft->restArea),
          most(kMostPressure / (h * h * lightest))
    {
    }
    double at(double area) const
    {
        return std::clamp(gas * rest / std::max(area, kLeastArea * rest) + stiffness * (1 - area / rest), -most, most);
    }
    /// Its integral over the area.
    double sum(double area) const
    {
        const double least = full(), largest = empty(), held = std::clamp(area, least, largest);
        const double dense = std::max(held, kLeastArea * rest);
        return gas * rest * (logarithm(dense / rest) + (held - dense) / dense) +
               stiffness * held * (1 - held / (2 * rest)) + most * (area - held) * (area < least ? 1 : -1);
    }

private:
    /// Areas below the first, and above the second, are those of the greatest pressure.
    double full() const
    {
        const double a = most - stiffness, root = std::sqrt(a * a + 4 * stiffness * gas);
        const double area = a > 0 ? 2 * gas / (a + root) * rest : (root - a) / (2 * stiffness) * rest;
        if (area >= kLeastArea * rest) return area;
        return stiffness > 0 ? std::min(kLeastArea, (gas / kLeastArea - a) / stiffness) * rest
                             : -std::numeric_limits<double>::max();
    }
    double empty() const
    {
        const double b = most + stiffness;
        return stiffness > 0 ? (b + std::sqrt(b * b + 4 * stiffness * gas)) / (2 * stiffness) * rest
                             : std::numeric_limits<double>::max();
    }
};

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
    const double pressure = Pressure(body, h, lightest).at(now);
    const SoftMatter& matter = body.soft->matter;
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

bool holdsGas(const BodyRecord& body)
{
    if (body.rigid || body.fixed || !body.enabled || body.soft->open || !(body.soft->restArea > 0)) return false;
    return body.soft->matter.pressure > 0 || body.soft->matter.areaStiffness > 0;
}

void applyPressure(State& state, double h)
{
    for (const BodyRecord& body : state.bodies)
        if (!body.asleep && holdsGas(body)) push(state, body, h, state.scratch.gradient);
}

double gasEnergy(const State& state, const BodyRecord& body, double h)
{
    if (!holdsGas(body)) return 0;
    double lightest = 0;
    eachWall(state, body, [&](const Wall& wall) {
        lightest = std::max({lightest, state.nodes.invMass[wall.first], state.nodes.invMass[wall.second]});
    });
    if (!(lightest > 0)) return 0;
    const Pressure pressure(body, h, lightest);
    return pressure.sum(body.soft->restArea) - pressure.sum(enclosedArea(state, body));
}

}  // namespace jet::physics::soft
