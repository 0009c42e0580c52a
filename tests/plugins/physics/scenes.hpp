// Bodies and worlds the physics tests share. Scene units, y down, seconds; a step is 1/60 s.
#pragma once

#include "engine.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace jet::physics::test {

inline constexpr double kStep = 1.0 / 60;

inline std::unique_ptr<PhysicsWorld> makeWorld(const Vec2& gravity, double friction = 0.6, double restitution = 0)
{
    WorldSettings settings;
    settings.gravity = gravity;
    settings.materials = {MaterialPair{friction, restitution, true}};
    return JetPhysics().createWorld(settings);
}

inline void run(PhysicsWorld& world, double seconds)
{
    for (int i = 0; i < static_cast<int>(std::lround(seconds / kStep)); ++i) world.step(kStep);
}

inline std::vector<Vec2> boxRing(const Vec2& centre, double width, double height, double angle = 0)
{
    std::vector<Vec2> ring;
    const Affine turn = Affine::rotation(angle);
    for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
        ring.push_back(centre + turn.linear() * Vec2(corner.x() * width / 2, corner.y() * height / 2));
    return ring;
}

inline std::vector<Vec2> circleRing(const Vec2& centre, double radius, int corners)
{
    std::vector<Vec2> ring;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * 3.14159265358979 * i / corners;
        ring.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return ring;
}

inline RigidBodyDef rigid(std::vector<std::vector<Vec2>> borders, double mass = 1)
{
    RigidBodyDef def;
    def.borders = std::move(borders);
    def.mass = mass;
    return def;
}

inline RigidBodyDef fixed(std::vector<std::vector<Vec2>> borders)
{
    RigidBodyDef def = rigid(std::move(borders));
    def.common.fixed = true;
    return def;
}

inline RigidBodyDef box(const Vec2& centre, double width, double height, double mass = 1, double angle = 0)
{
    return rigid({boxRing(centre, width, height, angle)}, mass);
}

/// A fixed slab whose upper side is the line y = top.
inline RigidBodyDef ground(double top, double width = 2000) { return fixed({boxRing({0, top + 50}, width, 100)}); }

/// The same body given as convex parts instead of borders.
inline RigidBodyDef simple(RigidBodyDef def)
{
    for (const auto& ring : def.borders) def.shapes.push_back({ShapeDef::Kind::Polygon, ring, 0});
    def.borders.clear();
    return def;
}

/// A disc of rings of particles about a hub; neighbours, spokes and diagonals are springs. Mass 1.
inline SoftBodyDef softBall(const Vec2& centre, double radius, double ks = 200, double kd = 1, int corners = 24,
                            int rings = 3)
{
    SoftBodyDef def;
    def.particles.push_back(centre);
    for (int ring = 1; ring <= rings; ++ring)
        for (const Vec2& at : circleRing(centre, radius * ring / rings, corners)) def.particles.push_back(at);
    def.masses.assign(def.particles.size(), 1.0 / static_cast<double>(def.particles.size()));
    const auto at = [&](int ring, int i) {
        return ring == 0 ? 0U : static_cast<std::uint32_t>(1 + (ring - 1) * corners + (i + corners) % corners);
    };
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        def.springs.push_back({a, b, (def.particles[a] - def.particles[b]).norm(), ks, kd, 0});
    };
    for (int ring = 1; ring <= rings; ++ring) {
        for (int i = 0; i < corners; ++i) {
            join(at(ring, i), at(ring, i + 1));
            join(at(ring, i), at(ring - 1, i));
            if (ring > 1) join(at(ring, i), at(ring - 1, i + 1)), join(at(ring, i + 1), at(ring - 1, i));
        }
    }
    auto& border = def.borders.emplace_back();
    for (int i = 0; i < corners; ++i) border.push_back(at(rings, i));
    return def;
}

inline double signedArea(std::span<const Vec2> points, std::span<const std::uint32_t> ring)
{
    double area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        area += 0.5 * cross(points[ring[i]], points[ring[(i + 1) % ring.size()]]);
    return area;
}

inline std::span<const Vec2> pointsOf(const PhysicsWorld& world, BodyHandle body)
{
    const BodyStates states = world.bodies();
    return states.points.subspan(states.firstPoint[body], states.firstPoint[body + 1] - states.firstPoint[body]);
}

/// Area of a soft body's first border over its area at rest; negative when it turned inside out.
inline double areaRatio(const PhysicsWorld& world, BodyHandle body, const SoftBodyDef& def)
{
    return signedArea(pointsOf(world, body), def.borders[0]) / signedArea(def.particles, def.borders[0]);
}

inline bool allFinite(const PhysicsWorld& world)
{
    for (const Vec2& p : world.bodies().points)
        if (!isFinite(p)) return false;
    for (const Vec2& p : world.bodies().position)
        if (!isFinite(p)) return false;
    return true;
}

}  // namespace jet::physics::test
