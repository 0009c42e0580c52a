// Bodies of a stage, and what is done to them between steps.
#include "stage.hpp"

#include "fixtures.hpp"
#include "units.hpp"
#include "validation.hpp"

#include <box2d/b2_fixture.h>

#include <numeric>

namespace jet::box2d {

BodyHandle handleOf(const b2Body& body)
{
    // The ground and the ends of joints at the background have none.
    const uintptr_t pointer = const_cast<b2Body&>(body).GetUserData().pointer;
    return pointer == 0 ? kNoHandle : static_cast<BodyHandle>(pointer - 1);
}

Vec2 placeOf(const Body& body, const Vec2& local)
{
    const b2Transform& pose = body.body->GetTransform();
    const double c = static_cast<double>(pose.q.c), s = static_cast<double>(pose.q.s);
    return units(pose.p) + Vec2(c * local.x() - s * local.y(), s * local.x() + c * local.y());
}

Stage::Stage(const WorldSettings& settings) : settings_(settings), book_(settings_, bodies_)
{
    world_ = std::make_unique<b2World>(b2Vec2(0, 0));
    world_->SetContactFilter(&book_);
    world_->SetContactListener(&book_);
    const b2BodyDef ground;
    ground_ = world_->CreateBody(&ground);
    applySettings();
}

void Stage::applySettings()
{
    world_->SetGravity(settings_.applyGravity ? metres(settings_.gravity) : b2Vec2(0, 0));
    world_->SetAllowSleeping(settings_.allowSleep);
}

namespace {

b2BodyType typeOf(const BodyCommon& common)
{
    return common.fixed ? b2_staticBody : common.kinematic ? b2_kinematicBody : b2_dynamicBody;
}

/// Bodies without area count as equal masses at their points, so that a degenerate drawing still has a centre.
Moments momentsOf(const RigidBodyDef& def, const Ring& points)
{
    Moments m = def.shapes.empty() ? box2d::momentsOf(def.borders) : box2d::momentsOf(def.shapes);
    if (m.area > 0) return m;
    m.centroid = std::accumulate(points.begin(), points.end(), Vec2(0, 0)) / static_cast<double>(points.size());
    for (const Vec2& p : points) m.second += (p - m.centroid).squaredNorm() / static_cast<double>(points.size());
    return m;
}

}  // namespace

BodyHandle Stage::add(const RigidBodyDef& def)
{
    Body body;
    body.common = def.common, body.mass = def.mass, body.solid = def.shapes.empty();
    Rings rings = def.borders;
    for (const ShapeDef& shape : def.shapes) rings.push_back(outlineOf(shape));
    std::erase_if(rings, [](const Ring& ring) { return ring.empty(); });
    if (rings.empty()) fail("a rigid body needs an outline with points.");
    Box bounds;
    for (const Ring& ring : rings) {
        body.local.insert(body.local.end(), ring.begin(), ring.end());
        body.ringEnds.push_back(body.local.size());
        for (const Vec2& p : ring) bounds.extend(p);
    }
    RigidBodyDef clean = def;
    std::erase_if(clean.borders, [](const Ring& ring) { return ring.size() < 3; });
    if (clean.shapes.empty() && clean.borders.empty()) fail("a rigid body's border needs three points or more.");
    const Moments moments = momentsOf(clean, body.local);
    for (Vec2& p : body.local) p -= moments.centroid;
    body.second = std::max(moments.second, 1e-6 * bounds.size().squaredNorm());
    body.thinnest = bounds.size().minCoeff();

    b2BodyDef made;
    made.type = typeOf(def.common);
    made.position = metres(moments.centroid);
    made.gravityScale = static_cast<float>(def.common.gravityScale);
    made.fixedRotation = def.common.fixedRotation;
    made.allowSleep = def.common.allowSleep;
    const BodyHandle handle = nextBody();
    made.userData.pointer = handle + std::size_t{1};
    body.body = world_->CreateBody(&made);
    const bool isNew = handle == bodies_.size();
    if (isNew) bodies_.emplace_back();
    Body before = std::move(bodies_[handle]);
    bodies_[handle] = body;  // before the fixtures: the filter looks it up
    try {
        addFixtures(*body.body, clean, moments.centroid);
    } catch (...) {
        world_->DestroyBody(body.body);
        bodies_[handle] = std::move(before);
        if (isNew) bodies_.pop_back();
        throw;
    }
    if (before.body != nullptr) world_->DestroyBody(before.body);
    free_.erase(handle), ++changes_;
    applyMass(bodies_[handle]);
    setVelocity(handle, def.common.velocity);
    setOmega(handle, def.common.omega);
    return handle;
}

void Stage::applyMass(Body& body)
{
    if (body.body->GetType() != b2_dynamicBody) return;
    b2MassData mass;
    mass.mass = static_cast<float>(body.mass);
    mass.center.SetZero();
    mass.I = std::max(squareMetres(body.mass * body.second), std::numeric_limits<float>::min());
    body.body->SetMassData(&mass);
}

void Stage::refilter(const Body& body)
{
    for (b2Fixture* f = body.body->GetFixtureList(); f; f = f->GetNext()) f->Refilter();
}

void Stage::setSettings(const WorldSettings& settings)
{
    settings_ = settings;
    applySettings();
    for (const Body& body : bodies_) {
        refilter(body);
        body.body->SetAwake(true);
    }
}

void Stage::setBody(BodyHandle handle, const BodyCommon& common)
{
    Body& body = bodies_[handle];
    const bool fixed = body.common.fixed;
    body.common = common;
    body.common.fixed = fixed;
    body.body->SetType(typeOf(body.common));
    body.body->SetGravityScale(static_cast<float>(common.gravityScale));
    body.body->SetFixedRotation(common.fixedRotation);
    body.body->SetSleepingAllowed(common.allowSleep);
    applyMass(body);  // Box2D works it out anew from densities, which are 0 here
    for (b2Fixture* f = body.body->GetFixtureList(); f; f = f->GetNext()) {
        f->SetSensor(common.sensor);
        f->Refilter();
    }
    body.body->SetAwake(true);
}

void Stage::setMass(BodyHandle handle, double mass)
{
    bodies_[handle].mass = mass;
    applyMass(bodies_[handle]);
    wake(handle);
}

void Stage::setEnabled(BodyHandle handle, bool enabled)
{
    b2Body& body = *bodies_[handle].body;
    if (!enabled) body.SetLinearVelocity(b2Vec2_zero), body.SetAngularVelocity(0);
    body.SetEnabled(enabled);
}

void Stage::setPosition(BodyHandle handle, const Vec2& centre)
{
    b2Body& body = *bodies_[handle].body;
    body.SetTransform(metres(centre), body.GetAngle());
    body.SetAwake(true);
}

void Stage::setVelocity(BodyHandle handle, const Vec2& velocity)
{
    bodies_[handle].body->SetLinearVelocity(metres(velocity));
}

void Stage::setOmega(BodyHandle handle, double omega)
{
    bodies_[handle].body->SetAngularVelocity(static_cast<float>(omega));
}

void Stage::setGravity(const Vec2& gravity)
{
    settings_.gravity = gravity;
    applySettings();
    for (const Body& body : bodies_) body.body->SetAwake(true);
}

void Stage::applyForce(BodyHandle handle, const Vec2& force)
{
    bodies_[handle].force += force;
    wake(handle);
}

void Stage::applyImpulse(BodyHandle handle, const Vec2& impulse)
{
    bodies_[handle].body->ApplyLinearImpulseToCenter(metres(impulse), true);
}

void Stage::wake(BodyHandle handle) { bodies_[handle].body->SetAwake(true); }

}  // namespace jet::box2d
