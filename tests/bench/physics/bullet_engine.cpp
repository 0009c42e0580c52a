// Debian's Bullet 3.24: its soft bodies (position-based, as its demos set them up), in the plane z = 0. Bodies that are
// no particles are its rigid boxes. What is stiff there is told by a part from 0 to 1 and the count of passes; no
// setting means newtons a metre, so all links are as stiff as they get.
#include "bench/physics/engines.hpp"

// Its headers warn under -Wpedantic; they are included as a system's.
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <stdexcept>

namespace jet::bench {

namespace {

constexpr int kPasses = 4;
constexpr btScalar kThick = 4;  // of walls in z, so that none is passed beside the plane

btVector3 vec(const Point& p) { return {static_cast<btScalar>(p.x), static_cast<btScalar>(p.y), 0}; }

class BulletEngine final : public Engine {
public:
    explicit BulletEngine(const Scene& scene)
        : dispatcher_(&configuration_), world_(&dispatcher_, &broadPhase_, &solver_, &configuration_)
    {
        world_.setGravity(vec(scene.gravity));
        btSoftBodyWorldInfo& info = world_.getWorldInfo();
        info.m_gravity = vec(scene.gravity);
        info.m_broadphase = &broadPhase_, info.m_dispatcher = &dispatcher_;
        info.air_density = 0, info.water_density = 0;
        info.m_sparsesdf.Initialize();
        particles_.resize(scene.bodies.size());
        rigid_.resize(scene.bodies.size());
        for (const SceneSoft& soft : scene.soft) addSoft(scene, soft);
        for (std::size_t i = 0; i < scene.bodies.size(); ++i)
            if (particles_[i].body == nullptr) addWall(scene, i);
    }
    ~BulletEngine() override
    {
        for (const auto& soft : soft_) world_.removeSoftBody(soft.get());
        for (const auto& body : rigid_)
            if (body) world_.removeRigidBody(body.get());
    }
    BulletEngine(const BulletEngine&) = delete;
    BulletEngine& operator=(const BulletEngine&) = delete;

    void step(double dt) override
    {
        world_.stepSimulation(static_cast<btScalar>(dt), 0);
        // What is pressed flat would give way out of the plane.
        for (const auto& soft : soft_)
            for (int i = 0; i < soft->m_nodes.size(); ++i)
                soft->m_nodes[i].m_x.setZ(0), soft->m_nodes[i].m_q.setZ(0), soft->m_nodes[i].m_v.setZ(0);
    }
    Pose pose(std::size_t body) const override
    {
        const Particle& particle = particles_[body];
        const btVector3 at = particle.body != nullptr ? particle.body->m_nodes[particle.node].m_x
                                                      : rigid_[body]->getWorldTransform().getOrigin();
        return {{at.x(), at.y()}, 0};
    }

private:
    struct Particle {
        btSoftBody* body = nullptr;
        int node = 0;
    };

    void addSoft(const Scene& scene, const SceneSoft& soft)
    {
        std::vector<btVector3> points;
        std::vector<btScalar> masses;
        for (std::uint32_t i = 0; i < soft.count; ++i) {
            const SceneBody& body = scene.bodies[soft.first + i];
            points.push_back(vec(body.position));
            masses.push_back(body.type == SceneBody::Type::Dynamic ? static_cast<btScalar>(body.mass) : 0);
        }
        auto made = std::make_unique<btSoftBody>(&world_.getWorldInfo(), static_cast<int>(soft.count), points.data(),
                                                 masses.data());
        for (const SceneSpring& s : scene.springs) {
            if (s.a < soft.first || s.a >= soft.first + soft.count) continue;
            made->appendLink(static_cast<int>(s.a - soft.first), static_cast<int>(s.b - soft.first));
            made->m_links[made->m_links.size() - 1].m_rl = static_cast<btScalar>(s.restLength);
        }
        made->m_cfg.piterations = kPasses;
        made->m_cfg.kDF = static_cast<btScalar>(scene.friction);
        made->m_cfg.collisions = 0;
        if (soft.ring > 0) {
            // Its bodies meet by particles and faces: those between neighbours of the outline and what is nearest
            // inside. (Its clusters, convex groups of particles, want a volume: flat ones are pushed out of the plane.)
            made->getCollisionShape()->setMargin(static_cast<btScalar>(scene.bodies[soft.first].shapes.at(0).radius));
            made->m_cfg.collisions = btSoftBody::fCollision::SDF_RS | btSoftBody::fCollision::VF_SS;
            addFaces(*made, soft, points);
        }
        for (std::uint32_t i = 0; i < soft.count; ++i) particles_[soft.first + i] = {made.get(), static_cast<int>(i)};
        world_.addSoftBody(made.get());
        soft_.push_back(std::move(made));
    }

    /// A band along the outline, without a gap: Bullet never comes to the end of building a tree of faces that do not
    /// all hang together by their edges.
    static void addFaces(btSoftBody& body, const SceneSoft& soft, const std::vector<btVector3>& points)
    {
        std::vector<std::uint32_t> within(soft.ring, soft.ring);
        for (std::uint32_t i = 0; i < soft.ring; ++i) {
            const btVector3 middle = (points[i] + points[(i + 1) % soft.ring]) / 2;
            for (std::uint32_t k = soft.ring; k < soft.count; ++k)
                if ((points[k] - middle).length2() < (points[within[i]] - middle).length2()) within[i] = k;
        }
        const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            body.appendFace(static_cast<int>(a), static_cast<int>(b), static_cast<int>(c));
        };
        for (std::uint32_t i = 0; i < soft.ring; ++i) {
            const std::uint32_t next = (i + 1) % soft.ring;
            face(i, next, within[i]);
            if (within[i] != within[next]) face(next, within[next], within[i]);
        }
    }

    void addWall(const Scene& scene, std::size_t index)
    {
        const SceneBody& body = scene.bodies[index];
        if (body.type != SceneBody::Type::Static || body.shapes.size() != 1 ||
            body.shapes[0].kind != SceneShape::Kind::Box)
            throw std::runtime_error("Bullet is a peer of soft bodies between fixed boxes alone.");
        const Point& half = body.shapes[0].half;
        const btVector3 size(static_cast<btScalar>(half.x), static_cast<btScalar>(half.y), kThick);
        shapes_.push_back(std::make_unique<btBoxShape>(size));
        btTransform place(btQuaternion(0, 0, static_cast<btScalar>(body.angle)), vec(body.position));
        motions_.push_back(std::make_unique<btDefaultMotionState>(place));
        rigid_[index] = std::make_unique<btRigidBody>(0, motions_.back().get(), shapes_.back().get());
        rigid_[index]->setFriction(static_cast<btScalar>(scene.friction));
        world_.addRigidBody(rigid_[index].get());
    }

    btSoftBodyRigidBodyCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadPhase_;
    btSequentialImpulseConstraintSolver solver_;
    btSoftRigidDynamicsWorld world_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btMotionState>> motions_;
    std::vector<std::unique_ptr<btRigidBody>> rigid_;  // by body of the scene; empty where it is a particle
    std::vector<std::unique_ptr<btSoftBody>> soft_;
    std::vector<Particle> particles_;
};

}  // namespace

std::unique_ptr<Engine> makeBullet(const Scene& scene) { return std::make_unique<BulletEngine>(scene); }

}  // namespace jet::bench
