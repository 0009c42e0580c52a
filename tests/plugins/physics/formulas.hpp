// What the tests of formulas share: measuring periods and decays of something that swings.
#pragma once

#include "scenes.hpp"

#include <cmath>
#include <functional>

namespace jet::physics::test {

inline constexpr double kPi = 3.14159265358979323846;

struct Swing {
    double period = 0;     // seconds, between the falling zero crossings
    double decrement = 0;  // ln of the ratio of two maxima a period apart
};

/// Steps until `value` has fallen through zero `crossings` times after the first.
inline Swing swingOf(PhysicsWorld& world, double step, int crossings, const std::function<double()>& value)
{
    double first = 0, last = 0, before = value(), beforeThat = before;
    int found = 0;
    std::vector<double> maxima;
    for (int i = 1; found <= crossings && i < 4'000'000; ++i) {
        world.step(step);
        const double now = value();
        if (before > 0 && now <= 0) {
            last = (i - now / (now - before)) * step;
            if (found++ == 0) first = last;
        }
        // The top of the parabola through three samples.
        const double bend = beforeThat - 2 * before + now;
        if (i > 1 && before > 0 && before >= beforeThat && before > now && bend < 0)
            maxima.push_back(before - (beforeThat - now) * (beforeThat - now) / (8 * bend));
        beforeThat = before, before = now;
    }
    Swing result;
    result.period = found > crossings ? (last - first) / crossings : std::nan("");
    if (maxima.size() > 1)
        result.decrement = std::log(maxima.front() / maxima.back()) / static_cast<double>(maxima.size() - 1);
    return result;
}

}  // namespace jet::physics::test
