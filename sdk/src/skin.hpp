// Skin: binds a Bézier path to the border of a soft body, so that the drawn curve follows the particles.
#pragma once

#include <jet/path.hpp>
#include <jet/physics.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace jet {

/// The path with segments in the place of its intermediate points, of the same shape: between two border particles the
/// drawn curve then has nothing of its own that could dip into what the particles rest on.
Path splitAtIntermediatePoints(Path path);

/// Each point p of the path is kept in the frame of its nearest border edge a-b at rest: p = a + u (b - a) + v perp(b -
/// a). Exact at rest and under any rigid motion and scaling; smooth in between.
class Skin {
public:
    Skin() = default;
    Skin(const Path& path, const SoftBodyDef& body);
    /// The path, split at its intermediate points, over the body's present particles.
    Path deformed(std::span<const Vec2> particles) const;

private:
    struct Binding {
        std::uint32_t a = kNoHandle, b = kNoHandle;
        double u = 0, v = 0;
        Vec2 rest;
    };
    Path rest_;
    std::vector<Binding> bindings_;  // point, in, out of each segment in order
};

}  // namespace jet
