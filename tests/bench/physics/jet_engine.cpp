// JET's engine through the contract of the SDK.
#include "bench/physics/engines.hpp"

#include "engine.hpp"
#include "soft/kernels.hpp"

#include <cmath>
#include <map>

namespace jet::bench {

namespace {

Vec2 vec(const Point& p) { return {p.x, p.y}; }

Simd simdOf(const std::string& name)
{
    return name == "avx512" ? Simd::Avx512
           : name == "avx2" ? Simd::Avx2
           : name == "sse2" ? Simd::Sse2
                            : Simd::Automatic;
}

class JetEngine final : public Engine {
public:
    JetEngine(const Scene& scene, const JetOptions& options) : scene_(scene)
    {
        WorldSettings settings;
        settings.gravity = vec(scene.gravity);
        settings.threads = options.threads;
        settings.substeps = options.substeps;
        settings.allowSleep = false;
        settings.simd = simdOf(options.simd);
        if (!options.precision.empty())
            settings.precision = options.precision == "double" ? Precision::Double : Precision::Single;
        // Material 1 collides with nothing.
        settings.materialCount = 2;
        settings.materials.assign(4, {scene.friction, scene.restitution, false});
        settings.materials[0].collides = true;
        world_ = physics::JetPhysics().createWorld(settings);
        places_.resize(scene.bodies.size());
        for (const SceneSoft& soft : scene.soft) addSoft(soft);
        for (std::size_t i = 0; i < scene.bodies.size(); ++i)
            if (places_[i].body == kNoHandle) addRigid(i);
        for (const SceneJoint& joint : scene.joints) addJoint(joint);
    }

    void step(double dt) override { world_->step(dt); }
    Pose pose(std::size_t body) const override
    {
        const Place& place = places_[body];
        const BodyStates states = world_->bodies();
        if (place.particle != kNoHandle) {
            const Vec2 at = states.points[states.firstPoint[place.body] + place.particle];
            return {{at.x(), at.y()}, 0};
        }
        const Vec2 at =
            states.position[place.body] + Vec2(Affine::rotation(states.angle[place.body]).linear() * place.fromCentre);
        return {{at.x(), at.y()}, scene_.bodies[body].angle + states.angle[place.body]};
    }
    std::size_t memory() const override { return world_->stats().memory; }
    std::uint64_t hash() const override { return world_->hash(); }
    std::vector<std::byte> save() const override { return world_->save(); }
    void restore(std::span<const std::byte> bytes) override { world_->restore(bytes); }

private:
    struct Place {
        BodyHandle body = kNoHandle;
        ParticleHandle particle = kNoHandle;
        Vec2 fromCentre;  // the origin from the centre of mass, as placed
    };

    void addSoft(const SceneSoft& soft)
    {
        SoftBodyDef def;
        def.common.material = 0;
        for (std::uint32_t i = 0; i < soft.count; ++i) {
            const SceneBody& body = scene_.bodies[soft.first + i];
            def.particles.push_back(vec(body.position));
            def.masses.push_back(body.mass);
            def.movable.push_back(body.type == SceneBody::Type::Dynamic);
        }
        for (const SceneSpring& s : scene_.springs)
            if (s.a >= soft.first && s.a < soft.first + soft.count)
                def.springs.push_back({s.a - soft.first, s.b - soft.first, s.restLength, s.stiffness, s.damping, 0});
        if (soft.ring > 0) {
            auto& ring = def.borders.emplace_back();
            for (std::uint32_t i = 0; i < soft.ring; ++i) ring.push_back(i);
        }
        // The others' particles are circles that reach this far out of the outline.
        if (soft.ring > 0) def.matter.thickness = scene_.bodies[soft.first].shapes.at(0).radius;
        const BodyHandle handle = world_->addSoftBody(def);
        for (std::uint32_t i = 0; i < soft.count; ++i) places_[soft.first + i] = {handle, i, Vec2(0, 0)};
    }

    void addRigid(std::size_t index)
    {
        const SceneBody& body = scene_.bodies[index];
        RigidBodyDef def;
        const Affine place = Affine::translation(vec(body.position)) * Affine::rotation(body.angle);
        for (const SceneShape& shape : body.shapes) {
            ShapeDef& part = def.shapes.emplace_back();
            if (shape.kind == SceneShape::Kind::Circle) {
                part.kind = ShapeDef::Kind::Circle;
                part.radius = shape.radius;
                part.points = {vec(body.position)};
                continue;
            }
            for (const Point& corner : cornersOf(shape)) part.points.push_back(place * vec(corner));
        }
        const AreaMoments moments = momentsOf(body);
        def.mass = body.mass > 0 ? body.mass : moments.area;
        def.common.fixed = body.type == SceneBody::Type::Static;
        def.common.kinematic = body.type == SceneBody::Type::Kinematic;
        def.common.fixedRotation = body.fixedRotation;
        def.common.velocity = vec(body.velocity);
        def.common.omega = body.omega;
        def.common.group = static_cast<std::uint32_t>(body.group);
        def.common.material = body.collides ? 0 : 1;
        const BodyHandle handle = world_->addRigidBody(def);
        places_[index] = {handle, kNoHandle, vec(body.position) - world_->bodies().position[handle]};
    }

    void addJoint(const SceneJoint& joint)
    {
        JointDef def;
        def.a = {places_[joint.a].body, vec(worldPoint(joint.a, joint.localA))};
        def.b = {places_[joint.b].body, vec(worldPoint(joint.b, joint.localB))};
        world_->addJoint(def);
    }
    Point worldPoint(std::uint32_t index, const Point& local) const
    {
        const SceneBody& body = scene_.bodies[index];
        const double c = std::cos(body.angle), s = std::sin(body.angle);
        return {body.position.x + c * local.x - s * local.y, body.position.y + s * local.x + c * local.y};
    }

    const Scene& scene_;
    std::unique_ptr<PhysicsWorld> world_;
    std::vector<Place> places_;
};

}  // namespace

std::unique_ptr<Engine> makeJet(const Scene& scene, const JetOptions& options)
{
    return std::make_unique<JetEngine>(scene, options);
}

std::vector<std::string> jetSimds()
{
    std::vector<std::string> all;
    if (physics::soft::hasAvx512()) all.emplace_back("avx512");
    if (physics::soft::hasAvx2()) all.emplace_back("avx2");
    all.emplace_back("sse2");
    return all;
}

std::vector<std::string> jetSimds(const Scene& scene)
{
    std::vector<std::string> all = jetSimds();
    // Springs and flights of soft bodies are all that is written for it (soft/kernels_avx512.cpp).
    if (scene.soft.empty()) std::erase(all, "avx512");
    return all;
}

}  // namespace jet::bench
