// Large worlds of simple shapes: stacks, a poured heap in a turning box, a net of joints.
#pragma once

#include "scenes.hpp"

namespace jet::physics::test {

inline WorldSettings shapeSettings(int threads = 1, Simd simd = Simd::Automatic, double restitution = 0)
{
    WorldSettings settings;
    settings.gravity = {0, 98.1};
    settings.materials = {MaterialPair{0.6, restitution, true}};
    settings.threads = threads;
    settings.simd = simd;
    settings.allowSleep = false;
    return settings;
}

inline std::unique_ptr<PhysicsWorld> pyramidWorld(const WorldSettings& settings, int rows = 36)
{
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(simple(ground(0)));
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < rows - row; ++i)
            world->addRigidBody(simple(box({10.0 * i - 5.0 * (rows - row - 1), -5.0 - 10 * row}, 10, 10)));
    return world;
}

/// Boxes, discs and capsules tumble in a box that turns, a few of them fast enough to be foreseen.
inline std::unique_ptr<PhysicsWorld> drumWorld(const WorldSettings& settings, int side = 25)
{
    auto world = JetPhysics().createWorld(settings);
    RigidBodyDef drum;
    const double half = 8.0 * side;
    for (const auto& [x, y] : {std::pair{-half, 0.0}, {half, 0.0}, {0.0, -half}, {0.0, half}})
        drum.shapes.push_back(
            {ShapeDef::Kind::Polygon, boxRing({x, y}, x != 0 ? 10 : 2 * half + 10, x != 0 ? 2 * half + 10 : 10), 0});
    drum.common.kinematic = true;
    drum.common.omega = 0.7;
    world->addRigidBody(drum);
    for (int i = 0; i < side * side; ++i) {
        const Vec2 at(12.0 * (i % side) - 6.0 * side + 6, 12.0 * (i / side) - 6.0 * side + 6);
        RigidBodyDef def;
        if (i % 3 == 0) def.shapes.push_back({ShapeDef::Kind::Circle, {at}, 4});
        if (i % 3 == 1) def.shapes.push_back({ShapeDef::Kind::Polygon, boxRing(at, 9, 6, 0.1 * i), 0});
        if (i % 3 == 2) def.shapes.push_back({ShapeDef::Kind::Capsule, {at - Vec2(3, 0), at + Vec2(3, 1)}, 2});
        if (i % 50 == 7) def.common.velocity = {900.0 - i, 300};
        world->addRigidBody(def);
    }
    return world;
}

/// A plate that moves and has more contacts than there are colours: some are solved one by one.
inline std::unique_ptr<PhysicsWorld> plateWorld(const WorldSettings& settings, int boxes = 60)
{
    auto world = JetPhysics().createWorld(settings);
    world->addRigidBody(simple(ground(0)));
    world->addRigidBody(simple(box({0, -5}, 12.0 * boxes, 10)));
    for (int i = 0; i < 2 * boxes; ++i)
        world->addRigidBody(simple(box({12.0 * (i % boxes) - 6.0 * boxes + 6, -15.0 - 11.0 * (i / boxes)}, 10, 10)));
    return world;
}

inline std::unique_ptr<PhysicsWorld> netWorld(const WorldSettings& settings, int side = 24)
{
    auto world = JetPhysics().createWorld(settings);
    for (int i = 0; i < side * side; ++i) {
        const Vec2 at(10.0 * (i % side), 10.0 * (i / side));
        RigidBodyDef def;
        def.shapes.push_back({ShapeDef::Kind::Circle, {at}, 4});
        def.common.fixed = i / side == 0 && i % 6 == 0;
        const BodyHandle body = world->addRigidBody(def);
        JointDef joint;
        joint.b.body = body;
        if (i % side > 0) {
            joint.a = {body - 1, at - Vec2(5, 0)}, joint.b.point = joint.a.point;
            world->addJoint(joint);
        }
        if (i / side > 0) {
            joint.a = {body - static_cast<BodyHandle>(side), at - Vec2(0, 5)}, joint.b.point = joint.a.point;
            world->addJoint(joint);
        }
    }
    return world;
}

}  // namespace jet::physics::test
