// Sine, cosine, arc tangent and exponential from + - * / and floor alone: the C library's differ in the last bit from
// one system to the next, and a simulation must give the same bits everywhere. Errors stay below 4e-16 of the result's
// scale.
#pragma once

#include <jet/geometry.hpp>

namespace jet::physics {

inline constexpr double kPi = 3.14159265358979323846;

/// (cos angle, sin angle). Angles beyond 1e9 radians lose digits, as they have lost them already.
Vec2 direction(double angle);

/// The angle of the vector (x, y), in (-pi, pi]; 0 for the null vector.
double angleOf(double y, double x);

/// exp(-x) for x >= 0.
double decay(double x);

/// `angle` shifted by whole turns into [-pi, pi].
double wrapped(double angle);

/// `v` turned by the angle whose (cos, sin) is `rotation`.
inline Vec2 rotated(const Vec2& rotation, const Vec2& v)
{
    return {rotation.x() * v.x() - rotation.y() * v.y(), rotation.y() * v.x() + rotation.x() * v.y()};
}
inline Vec2 unrotated(const Vec2& rotation, const Vec2& v)
{
    return {rotation.x() * v.x() + rotation.y() * v.y(), rotation.x() * v.y() - rotation.y() * v.x()};
}

}  // namespace jet::physics
