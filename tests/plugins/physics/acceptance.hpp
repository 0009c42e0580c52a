// Stages of the acceptance tests. 10 units are a metre, gravity is 9.81 m/s², friction 0.6 and nothing bounces unless a
// scene says so; bodies are simple shapes or drawn outlines.
#pragma once

#include "shape_worlds.hpp"

namespace jet::physics::test {

inline constexpr double kMetre = 10;
inline constexpr double kPi = 3.14159265358979323846;

inline RigidBodyDef disc(const Vec2& centre, double radius, double mass = 1)
{
    RigidBodyDef def;
    def.shapes.push_back({ShapeDef::Kind::Circle, {centre}, radius});
    def.mass = mass;
    return def;
}

/// A world, and which of its bodies are looked at.
struct Stage {
    bool drawn = false;  ///< outlines instead of simple shapes
    std::unique_ptr<PhysicsWorld> world;
    std::vector<BodyHandle> watched;
    std::vector<Vec2> placed;  ///< [watched] where they began

    explicit Stage(bool drawnBodies = false, const WorldSettings& settings = shapeSettings())
        : drawn(drawnBodies), world(JetPhysics().createWorld(settings))
    {
    }

    BodyHandle add(RigidBodyDef def)
    {
        if (!drawn && def.shapes.empty()) def = simple(std::move(def));
        const bool looks = !def.common.fixed && !def.common.kinematic;
        const BodyHandle body = world->addRigidBody(def);
        if (looks) watched.push_back(body), placed.push_back(world->bodies().position[body]);
        return body;
    }

    Vec2 at(BodyHandle body) const { return world->bodies().position[body]; }

    double fastest() const
    {
        double speed = 0;
        for (const BodyHandle body : watched) speed = std::max(speed, world->bodies().velocity[body].norm());
        return speed;
    }
};

}  // namespace jet::physics::test
