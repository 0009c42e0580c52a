// Jelly blocks, and worlds in which they may sleep.
#pragma once

#include "lattices.hpp"
#include "shape_worlds.hpp"

namespace jet::physics::test {

inline WorldSettings sleepy(int threads = 1, Simd simd = Simd::Automatic)
{
    WorldSettings settings = shapeSettings(threads, simd);
    settings.allowSleep = true;
    return settings;
}

/// A square of side 10.
inline SoftBodyDef jelly(const Vec2& centre, double ks = 1000, double kd = 5)
{
    SoftBodyDef def = square(centre, 10);
    for (SpringDef& spring : def.springs) spring.ks = ks, spring.kd = kd;
    return def;
}

}  // namespace jet::physics::test
