// Random numbers, values, paths: the same for the same seed, on every machine.
#pragma once

#include <jet/property.hpp>
#include <jet/scene.hpp>

#include <functional>
#include <random>
#include <string>

namespace jet::host::check {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// 0 … count - 1; 0 for a count of 0.
    std::size_t below(std::size_t count) { return count == 0 ? 0 : static_cast<std::size_t>(engine_() % count); }
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double lo, double hi) { return lo + unit() * (hi - lo); }
    bool chance(double probability) { return unit() < probability; }
    std::uint64_t bits() { return engine_(); }

    Vec2 point() { return {between(-100, 500), between(-100, 500)}; }
    Color color();
    /// With what XML, JSON and terminals trip over: quotes, '<', '&', line ends, characters beyond ASCII.
    std::string text();
    /// Rectangles, ellipses, curves, stars, open lines, points, nothing, several contours.
    Path path();
    Affine map();
    /// In range, with its ends and the default now and then.
    Value value(const PropertySpec& spec, const Scene& scene);
    Properties properties(const PropertyTable& table, const Scene& scene);
    /// An item that is not the root; null if there is none. `suits` may be empty.
    const Item* item(const Scene& scene, const std::function<bool(const Item&)>& suits = {});

private:
    double real(const PropertySpec& spec);
    std::mt19937_64 engine_;
};

}  // namespace jet::host::check
