// Debian's Chipmunk 7 with 10 iterations, its default.
#include "bench/physics/engines.hpp"

#include <chipmunk/chipmunk.h>

namespace jet::bench {

namespace {

cpVect vec(const Point& p) { return cpv(p.x, p.y); }

class ChipmunkEngine final : public Engine {
public:
    explicit ChipmunkEngine(const Scene& scene) : space_(cpSpaceNew())
    {
        cpSpaceSetGravity(space_, vec(scene.gravity));
        cpSpaceSetIterations(space_, 10);
        for (const SceneBody& body : scene.bodies) add(scene, body);
        for (const SceneJoint& j : scene.joints) {
            // Its constraints do not take two bodies that cannot move.
            if (fixed(scene, j.a) && fixed(scene, j.b)) continue;
            constrain(cpPivotJointNew2(bodies_[j.a], bodies_[j.b], vec(j.localA), vec(j.localB)));
        }
        for (const SceneSpring& s : scene.springs) {
            if (fixed(scene, s.a) && fixed(scene, s.b)) continue;
            constrain(
                cpDampedSpringNew(bodies_[s.a], bodies_[s.b], cpvzero, cpvzero, s.restLength, s.stiffness, s.damping));
        }
    }
    ~ChipmunkEngine() override
    {
        for (cpConstraint* constraint : constraints_)
            cpSpaceRemoveConstraint(space_, constraint), cpConstraintFree(constraint);
        for (cpShape* shape : shapes_) cpSpaceRemoveShape(space_, shape), cpShapeFree(shape);
        for (cpBody* body : bodies_) cpSpaceRemoveBody(space_, body), cpBodyFree(body);
        cpSpaceFree(space_);
    }
    ChipmunkEngine(const ChipmunkEngine&) = delete;
    ChipmunkEngine& operator=(const ChipmunkEngine&) = delete;

    void step(double dt) override { cpSpaceStep(space_, dt); }
    Pose pose(std::size_t body) const override
    {
        const cpVect at = cpBodyGetPosition(bodies_[body]);
        return {{at.x, at.y}, cpBodyGetAngle(bodies_[body])};
    }

private:
    static bool fixed(const Scene& scene, std::uint32_t body)
    {
        return scene.bodies[body].type == SceneBody::Type::Static;
    }
    void constrain(cpConstraint* constraint)
    {
        cpSpaceAddConstraint(space_, constraint);
        constraints_.push_back(constraint);
    }
    void add(const Scene& scene, const SceneBody& body)
    {
        const AreaMoments moments = momentsOf(body);
        const double density = body.mass > 0 ? body.mass / moments.area : 1, mass = density * moments.area;
        const double offset = moments.centroid.x * moments.centroid.x + moments.centroid.y * moments.centroid.y;
        const double inertia = body.fixedRotation ? INFINITY : density * moments.secondMoment - mass * offset;
        cpBody* made = body.type == SceneBody::Type::Static      ? cpBodyNewStatic()
                       : body.type == SceneBody::Type::Kinematic ? cpBodyNewKinematic()
                                                                 : cpBodyNew(mass, inertia);
        cpSpaceAddBody(space_, made);
        bodies_.push_back(made);
        if (body.type == SceneBody::Type::Dynamic) cpBodySetCenterOfGravity(made, vec(moments.centroid));
        cpBodySetPosition(made, vec(body.position));
        cpBodySetAngle(made, body.angle);
        cpBodySetVelocity(made, vec(body.velocity));
        cpBodySetAngularVelocity(made, body.omega);
        for (const SceneShape& shape : body.shapes) addShape(scene, body, made, shape);
        if (body.type == SceneBody::Type::Static) cpSpaceReindexShapesForBody(space_, made);
    }
    void addShape(const Scene& scene, const SceneBody& body, cpBody* made, const SceneShape& shape)
    {
        cpShape* shaped = nullptr;
        if (shape.kind == SceneShape::Kind::Circle) {
            shaped = cpCircleShapeNew(made, shape.radius, cpvzero);
        } else {
            std::vector<cpVect> corners;
            for (const Point& corner : cornersOf(shape)) corners.push_back(vec(corner));
            shaped = cpPolyShapeNewRaw(made, static_cast<int>(corners.size()), corners.data(), 0);
        }
        cpShapeSetFriction(shaped, std::sqrt(scene.friction));  // it multiplies the two
        cpShapeSetElasticity(shaped, scene.restitution);
        const cpBitmask all = body.collides ? CP_ALL_CATEGORIES : 0;
        cpShapeSetFilter(shaped, cpShapeFilterNew(static_cast<cpGroup>(body.group), CP_ALL_CATEGORIES, all));
        cpSpaceAddShape(space_, shaped);
        shapes_.push_back(shaped);
    }

    cpSpace* space_;
    std::vector<cpBody*> bodies_;
    std::vector<cpShape*> shapes_;
    std::vector<cpConstraint*> constraints_;
};

}  // namespace

std::unique_ptr<Engine> makeChipmunk(const Scene& scene) { return std::make_unique<ChipmunkEngine>(scene); }

}  // namespace jet::bench
