// Box2D computes in metres and floats, and its tolerances suit things from 0.1 to 10 m. 10 scene units are a metre
// here, so that the default gravity of 98.1 units / s² is 9.81 m / s². Masses and seconds stay what they are.
#pragma once

#include <jet/geometry.hpp>

#include <box2d/b2_math.h>

namespace jet::box2d {

inline constexpr double kUnitsPerMetre = 10;

inline float metres(double units) { return static_cast<float>(units / kUnitsPerMetre); }
inline b2Vec2 metres(const Vec2& units) { return {metres(units.x()), metres(units.y())}; }
inline double units(float metres) { return kUnitsPerMetre * static_cast<double>(metres); }
inline Vec2 units(const b2Vec2& metres) { return {units(metres.x), units(metres.y)}; }

// A force has one length in its unit, as a length has; torques and moments of inertia have two.
inline float squareMetres(double squareUnits)
{
    return static_cast<float>(squareUnits / (kUnitsPerMetre * kUnitsPerMetre));
}
inline double squareUnits(float squareMetres)
{
    return kUnitsPerMetre * kUnitsPerMetre * static_cast<double>(squareMetres);
}

inline b2Vec2 direction(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

}  // namespace jet::box2d
