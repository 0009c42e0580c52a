// Debian's Box2D 2.4.1: 8 velocity and 3 position iterations, its manual's values.
#include "bench/physics/engines.hpp"

#include <box2d/box2d.h>

namespace jet::bench {

namespace {

b2Vec2 vec(const Point& p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

class Box2dEngine final : public Engine {
public:
    explicit Box2dEngine(const Scene& scene) : world_(vec(scene.gravity))
    {
        world_.SetAllowSleeping(false);
        for (const SceneBody& body : scene.bodies) add(scene, body);
        for (const SceneJoint& joint : scene.joints) {
            b2RevoluteJointDef def;
            def.bodyA = bodies_[joint.a], def.bodyB = bodies_[joint.b];
            def.localAnchorA = vec(joint.localA), def.localAnchorB = vec(joint.localB);
            world_.CreateJoint(&def);
        }
        for (const SceneSpring& spring : scene.springs) {
            b2DistanceJointDef def;
            def.bodyA = bodies_[spring.a], def.bodyB = bodies_[spring.b];
            def.length = static_cast<float>(spring.restLength);
            def.minLength = 0, def.maxLength = 1e6F;
            def.stiffness = static_cast<float>(spring.stiffness), def.damping = static_cast<float>(spring.damping);
            def.collideConnected = true;
            world_.CreateJoint(&def);
        }
    }

    void step(double dt) override { world_.Step(static_cast<float>(dt), 8, 3); }
    Pose pose(std::size_t body) const override
    {
        const b2Body& b = *bodies_[body];
        return {{b.GetPosition().x, b.GetPosition().y}, b.GetAngle()};
    }

private:
    void add(const Scene& scene, const SceneBody& body)
    {
        b2BodyDef def;
        def.type = body.type == SceneBody::Type::Static      ? b2_staticBody
                   : body.type == SceneBody::Type::Kinematic ? b2_kinematicBody
                                                             : b2_dynamicBody;
        def.position = vec(body.position);
        def.angle = static_cast<float>(body.angle);
        def.linearVelocity = vec(body.velocity);
        def.angularVelocity = static_cast<float>(body.omega);
        def.fixedRotation = body.fixedRotation;
        b2Body* made = world_.CreateBody(&def);
        b2FixtureDef fixture;
        fixture.friction = static_cast<float>(scene.friction);
        fixture.restitution = static_cast<float>(scene.restitution);
        fixture.density = static_cast<float>(body.mass > 0 ? body.mass / momentsOf(body).area : 1);
        fixture.filter.groupIndex = static_cast<int16>(-body.group);
        if (!body.collides) fixture.filter.maskBits = 0;
        for (const SceneShape& shape : body.shapes) {
            b2CircleShape circle;
            b2PolygonShape polygon;
            if (shape.kind == SceneShape::Kind::Circle) {
                circle.m_radius = static_cast<float>(shape.radius);
                fixture.shape = &circle;
            } else {
                b2Vec2 corners[b2_maxPolygonVertices];
                int count = 0;
                for (const Point& corner : cornersOf(shape)) corners[count++] = vec(corner);
                polygon.Set(corners, count);
                fixture.shape = &polygon;
            }
            made->CreateFixture(&fixture);
        }
        bodies_.push_back(made);
    }

    b2World world_;
    std::vector<b2Body*> bodies_;
};

}  // namespace

std::unique_ptr<Engine> makeBox2d(const Scene& scene) { return std::make_unique<Box2dEngine>(scene); }

}  // namespace jet::bench
