// What the engine tells is a number, whatever ran away inside: each door of the world ends here.
#pragma once

#include <jet/geometry.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace jet::physics {

/// What is infinite is told as the most that single precision holds, in which parts of the engine compute; what is no
/// number at all, as nothing.
inline double told(double value)
{
    if (std::isfinite(value)) return value;
    return std::isnan(value) ? 0 : std::copysign(double{std::numeric_limits<float>::max()}, value);
}

inline Vec2 told(const Vec2& value) { return {told(value.x()), told(value.y())}; }

}  // namespace jet::physics
