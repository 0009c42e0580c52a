// Soft bodies as the effect In Path Body makes them by default: particles on the outline and on a grid inside, springs
// of stiffness 10 and damping 0.3, mass 1. Simplified: a spring may leave a concave outline at a corner.
#pragma once

#include "scenes.hpp"

#include <algorithm>

namespace jet::physics::test {

inline bool isInside(const std::vector<Vec2>& ring, const Vec2& p)
{
    bool inside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
            inside = !inside;
    }
    return inside;
}

inline bool isClear(const std::vector<Vec2>& ring, const Vec2& p, double distance)
{
    for (const Vec2& corner : ring)
        if ((corner - p).norm() < distance) return false;
    return isInside(ring, p);
}

/// The outline's points are the border; inside particles lie `cell` apart.
inline SoftBodyDef lattice(const std::vector<Vec2>& outline, double cell, double ks = 10)
{
    SoftBodyDef def;
    def.particles = outline;
    const auto border = static_cast<std::uint32_t>(outline.size());
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        if (isInside(outline, 0.5 * (def.particles[a] + def.particles[b])) || (a < border && (a + 1) % border == b))
            def.springs.push_back({a, b, (def.particles[a] - def.particles[b]).norm(), ks, 0.3, 0});
    };
    auto& ring = def.borders.emplace_back();
    for (std::uint32_t i = 0; i < border; ++i) {
        ring.push_back(i);
        join(i, (i + 1) % border);
        join(i, (i + 2) % border);
    }
    Box bounds;
    for (const Vec2& p : outline) bounds.extend(p);
    const Vec2 reach = 0.5 * bounds.size();
    for (double y = -std::floor(reach.y() / cell) * cell; y <= reach.y(); y += cell)
        for (double x = -std::floor(reach.x() / cell) * cell; x <= reach.x(); x += cell)
            if (isClear(outline, bounds.center() + Vec2(x, y), 0.5 * cell))
                def.particles.push_back(bounds.center() + Vec2(x, y));
    const auto count = static_cast<std::uint32_t>(def.particles.size());
    for (std::uint32_t a = border; a < count; ++a)
        for (std::uint32_t b = a + 1; b < count; ++b)
            if ((def.particles[a] - def.particles[b]).cwiseAbs().maxCoeff() < 1.1 * cell) join(a, b);
    for (std::uint32_t i = 0; i < border; ++i) {
        std::vector<std::uint32_t> near;
        for (std::uint32_t p = border; p < count; ++p) near.push_back(p);
        std::sort(near.begin(), near.end(), [&](std::uint32_t a, std::uint32_t b) {
            return (def.particles[a] - outline[i]).norm() < (def.particles[b] - outline[i]).norm();
        });
        for (std::size_t k = 0; k < std::min<std::size_t>(3, near.size()); ++k) join(i, near[k]);
    }
    def.masses.assign(count, 1.0 / count);
    return def;
}

inline SoftBodyDef defaultBall(const Vec2& centre, double radius, double ks = 10)
{
    return lattice(circleRing(centre, radius, 24), 2 * 3.14159265358979 * radius / 24, ks);
}

inline SoftBodyDef square(const Vec2& centre, double side)
{
    std::vector<Vec2> outline;
    const std::vector<Vec2> corners = boxRing(centre, side, side);
    for (std::size_t i = 0; i < 4; ++i)
        for (int k = 0; k < 5; ++k) outline.push_back(corners[i] + k / 5.0 * (corners[(i + 1) % 4] - corners[i]));
    return lattice(outline, side / 5);
}

/// Two thirds of a ring, open below, `radius` to the middle of its flesh and half as thick.
inline SoftBodyDef banana(const Vec2& centre, double radius)
{
    std::vector<Vec2> outline;
    const auto at = [&](double from, int i) {
        const double angle = 3.14159265358979 * (5.0 / 6 + 4.0 / 3 * i / 16);
        return Vec2(centre + from * radius * Vec2(std::cos(angle), std::sin(angle)));
    };
    for (int i = 0; i <= 16; ++i) outline.push_back(at(1.25, i));
    for (int i = 16; i >= 0; --i) outline.push_back(at(0.75, i));
    return lattice(outline, radius / 5);
}

/// `columns` x `rows` particles of mass 1, `cell` apart from the origin on, joined to their eight neighbours by springs
/// like this one.
inline SoftBodyDef sheet(std::uint32_t columns, std::uint32_t rows, double cell = 1, SpringDef spring = {})
{
    SoftBodyDef def;
    for (std::uint32_t y = 0; y < rows; ++y)
        for (std::uint32_t x = 0; x < columns; ++x) def.particles.push_back(cell * Vec2(x, y));
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        spring.a = a, spring.b = b, spring.restLength = (def.particles[a] - def.particles[b]).norm();
        def.springs.push_back(spring);
    };
    for (std::uint32_t y = 0; y < rows; ++y)
        for (std::uint32_t x = 0; x < columns; ++x) {
            const std::uint32_t i = y * columns + x;
            if (x + 1 < columns) join(i, i + 1);
            if (y + 1 < rows) join(i, i + columns);
            if (x + 1 < columns && y + 1 < rows) join(i, i + columns + 1), join(i + 1, i + columns);
        }
    def.masses.assign(def.particles.size(), 1);
    return def;
}

}  // namespace jet::physics::test
