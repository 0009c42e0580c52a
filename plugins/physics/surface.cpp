#include "surface.hpp"

#include "outline.hpp"
#include "state.hpp"

namespace jet::physics {

Surface surfaceOf(const Part& part, const Vec2& centre, const Vec2& turn)
{
    Surface surface;
    const PartRing ring = ringOf(part);
    for (Index i = 0; i < static_cast<Index>(ring.count); ++i) surface.add(centre + rotated(turn, ring.points[i]));
    return surface;
}

Box boxOf(const Surface& surface)
{
    Box box;
    for (int i = 0; i < surface.count; ++i) box.extend(surface.points[static_cast<std::size_t>(i)]);
    return box;
}

/// About its first point, as scene coordinates may be large.
Moments momentsOf(const Surface& surface)
{
    Moments sum;
    double second = 0;
    const Vec2& origin = surface.points[0];
    for (int i = 1; i + 1 < surface.count; ++i) {
        const Vec2 a = surface.points[static_cast<std::size_t>(i)] - origin,
                   b = surface.points[static_cast<std::size_t>(i) + 1] - origin;
        const double area = cross(a, b) / 2;
        sum.area += area;
        sum.centroid += area / 3 * (a + b);
        second += area / 6 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
    }
    if (sum.area == 0) return {};
    sum.centroid /= sum.area;
    sum.second = std::abs(second) - std::abs(sum.area) * sum.centroid.squaredNorm();
    sum.area = std::abs(sum.area), sum.centroid += origin;
    return sum;
}

Surface clipped(const Surface& surface, std::span<const Vec2> ring)
{
    Surface now = surface;
    for (std::size_t i = 0; i < ring.size() && now.count > 0; ++i) {
        const Vec2 &from = ring[i], side = ring[(i + 1) % ring.size()] - from;
        const auto depth = [&](const Vec2& at) { return cross(side, at - from); };
        const Surface before = now;
        now.count = 0;
        for (int k = 0; k < before.count; ++k) {
            const Vec2 &a = before.points[static_cast<std::size_t>(k)],
                       &b = before.points[static_cast<std::size_t>((k + 1) % before.count)];
            const double da = depth(a), db = depth(b);
            if (da >= 0) now.add(a);
            if ((da >= 0) != (db >= 0)) now.add(a + da / (da - db) * (b - a));
        }
    }
    return now;
}

}  // namespace jet::physics
