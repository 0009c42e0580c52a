// Curves the geometry tests share: random ones from a fixed seed, and those on which curve code usually breaks.
#pragma once

#include <jet/path.hpp>

#include <random>
#include <string>
#include <utility>
#include <vector>

namespace jet::test {

/// Repeatable on every standard library: the engine is specified exactly, the distributions are not, so they are ours.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    double real(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }
    Vec2 point(double size = 100) { return {real(-size, size), real(-size, size)}; }
    Cubic cubic(double size = 100) { return {{point(size), point(size), point(size), point(size)}}; }
    std::size_t index(std::size_t count) { return engine_() % count; }
    std::uint64_t bits() { return engine_(); }

private:
    std::mt19937_64 engine_;
};

/// (s², s³) for s in [-1, 1]: a cusp at t = 1/2. Its length is 2 (13^1.5 - 8) / 27.
inline Cubic cuspCubic() { return {{Vec2(1, -1), Vec2(-1.0 / 3, 1), Vec2(-1.0 / 3, -1), Vec2(1, 1)}}; }

/// Cusp, loop, S, hairpin, there-and-back on a line, corners, coincident points, nothing at all.
inline std::vector<std::pair<std::string, Cubic>> awkwardCubics()
{
    return {{"cusp", cuspCubic()},
            {"loop", {{Vec2(0, 0), Vec2(30, 20), Vec2(-20, 20), Vec2(10, 0)}}},
            {"closed loop", {{Vec2(0, 0), Vec2(30, 20), Vec2(-20, 20), Vec2(0, 0)}}},
            {"inflection", {{Vec2(0, 0), Vec2(10, 20), Vec2(10, -20), Vec2(20, 0)}}},
            {"hairpin", {{Vec2(0, 0), Vec2(100, 1e-9), Vec2(100, 2e-9), Vec2(0, 3e-9)}}},
            {"there and back", {{Vec2(0, 0), Vec2(40, 20), Vec2(-20, -10), Vec2(20, 10)}}},
            {"corner line", {{Vec2(1, 2), Vec2(1, 2), Vec2(9, -4), Vec2(9, -4)}}},
            {"even line", {{Vec2(0, 0), Vec2(1, 1), Vec2(2, 2), Vec2(3, 3)}}},
            {"handle at the start", {{Vec2(0, 0), Vec2(0, 0), Vec2(10, 10), Vec2(20, 0)}}},
            {"handle at the end", {{Vec2(0, 0), Vec2(10, 10), Vec2(20, 0), Vec2(20, 0)}}},
            {"point", {{Vec2(5, 5), Vec2(5, 5), Vec2(5, 5), Vec2(5, 5)}}},
            {"huge", {{Vec2(0, 0), Vec2(1e200, 3e200), Vec2(-2e200, 1e200), Vec2(1e200, 0)}}},
            {"tiny", {{Vec2(0, 0), Vec2(1e-200, 3e-200), Vec2(-2e-200, 1e-200), Vec2(1e-200, 0)}}}};
}

}  // namespace jet::test
