// Bodies and actuators that are taken out. A body that is nothing, without fixtures and switched off, keeps the place
// of a removed one, until another takes its handle over.
#include "stage.hpp"
#include "units.hpp"
#include "validation.hpp"
#include "world.hpp"

#include <box2d/b2_distance_joint.h>

namespace jet::box2d {

BodyHandle Stage::nextBody() const { return free_.empty() ? static_cast<BodyHandle>(bodies_.size()) : *free_.begin(); }

void Stage::createPlaceholder(BodyHandle handle, const b2Vec2& at)
{
    b2BodyDef made;
    made.position = at;
    made.enabled = false;
    made.userData.pointer = handle + std::size_t{1};
    bodies_[handle] = Body();
    bodies_[handle].common.fixed = true;
    bodies_[handle].body = world_->CreateBody(&made);
    bodies_[handle].removed = true;
}

void Stage::removeBody(BodyHandle handle)
{
    const b2Body* body = bodies_[handle].body;
    for (JointHandle joint = 0; joint < joints_.size(); ++joint)
        if (!joints_[joint].removed && (joints_[joint].def.a.body == handle || joints_[joint].def.b.body == handle))
            removeJoint(joint);
    for (ActuatorHandle i = 0; i < springs_.size(); ++i)
        if (!springs_[i].removed && (springs_[i].def.a.body == handle || springs_[i].def.b.body == handle))
            removeActuator(ActuatorKind::Spring, i);
    for (ActuatorHandle i = 0; i < angularSprings_.size(); ++i) {
        const AngularSpring& spring = angularSprings_[i];
        if (!spring.removed && (spring.a.body == body || spring.centre.body == body || spring.b.body == body))
            removeActuator(ActuatorKind::AngularSpring, i);
    }
    for (ActuatorHandle i = 0; i < torques_.size(); ++i)
        if (torques_[i].body == body) removeActuator(ActuatorKind::Torque, i);
    for (ActuatorHandle i = 0; i < forces_.size(); ++i)
        if (forces_[i].at.body == body) removeActuator(ActuatorKind::Force, i);
    const b2Vec2 at = body->GetPosition();
    world_->DestroyBody(bodies_[handle].body);  // wakes what touched it
    createPlaceholder(handle, at);
    removedNow_.push_back(handle), ++changes_;
    std::erase_if(reports_, [handle](const Contact& c) { return c.bodyA == handle || c.bodyB == handle; });
}

namespace {

template <class Actuator>
Actuator& clear(Actuator& actuator)
{
    actuator = Actuator();
    actuator.removed = true;
    return actuator;
}

void rouse(const End& end)
{
    if (end.body != nullptr) end.body->SetAwake(true);
}

}  // namespace

void Stage::removeActuator(ActuatorKind kind, ActuatorHandle handle)
{
    ++changes_;
    switch (kind) {
    case ActuatorKind::Spring:
        if (springs_[handle].joint) world_->DestroyJoint(springs_[handle].joint);  // wakes what it held
        clear(springs_[handle]);
        return;
    case ActuatorKind::AngularSpring: {
        const AngularSpring spring = angularSprings_[handle];
        for (const End& end : {spring.a, spring.centre, spring.b}) rouse(end);
        clear(angularSprings_[handle]);
        return;
    }
    case ActuatorKind::Torque:
        rouse({torques_[handle].body, {}});
        clear(torques_[handle]);
        return;
    case ActuatorKind::Force:
        rouse(forces_[handle].at);
        clear(forces_[handle]);
        return;
    case ActuatorKind::ForceField: return;
    }
}

std::size_t Stage::count(ActuatorKind kind) const
{
    switch (kind) {
    case ActuatorKind::Spring: return springs_.size();
    case ActuatorKind::AngularSpring: return angularSprings_.size();
    case ActuatorKind::Torque: return torques_.size();
    case ActuatorKind::Force: return forces_.size();
    case ActuatorKind::ForceField: break;
    }
    return 0;
}

bool Stage::has(ActuatorKind kind, ActuatorHandle handle) const
{
    if (handle >= count(kind)) return false;
    switch (kind) {
    case ActuatorKind::Spring: return !springs_[handle].removed;
    case ActuatorKind::AngularSpring: return !angularSprings_[handle].removed;
    case ActuatorKind::Torque: return !torques_[handle].removed;
    case ActuatorKind::Force: return !forces_[handle].removed;
    case ActuatorKind::ForceField: break;
    }
    return false;
}

bool World::hasBody(BodyHandle body) const { return body < bodyCount() && !stage_->bodies()[body].removed; }
bool World::hasActuator(ActuatorKind kind, ActuatorHandle actuator) const { return stage_->has(kind, actuator); }
bool World::hasJoint(JointHandle joint) const { return joint < jointCount() && !stage_->joints()[joint].removed; }

void World::requireBody(BodyHandle body) const
{
    requireBelow("body", body, bodyCount());
    if (!hasBody(body)) fail(named("body", body) + " was removed.");
}

void World::requireBodies(std::initializer_list<const Anchor*> anchors) const
{
    for (const Anchor* anchor : anchors)
        if (anchor->body != kNoHandle) requireBody(anchor->body);
}

void World::requireJoint(JointHandle joint) const
{
    requireBelow("joint", joint, jointCount());
    if (!hasJoint(joint)) fail(named("joint", joint) + " was removed.");
}

void World::requireActuator(ActuatorKind kind, ActuatorHandle actuator) const
{
    requireBelow(nameOf(kind), actuator, stage_->count(kind));
    if (!stage_->has(kind, actuator)) fail(named(nameOf(kind), actuator) + " was removed.");
}

void World::removeBody(BodyHandle body)
{
    requireBody(body);
    doesSpecial([body](Stage& stage) { stage.removeBody(body); });
}

void World::removeActuator(ActuatorKind kind, ActuatorHandle actuator)
{
    requireActuator(kind, actuator);
    doesSpecial([kind, actuator](Stage& stage) { stage.removeActuator(kind, actuator); });
}

void World::setAngularSpring(ActuatorHandle spring, std::optional<double> restAngle, double ks, double kd)
{
    requireActuator(ActuatorKind::AngularSpring, spring);
    const std::string item = named("angular spring", spring);
    if (restAngle) checks().number(item, "rest angle", *restAngle);
    checks().spring(item, ks, kd);
    doesSpecial([=](Stage& stage) { stage.setAngularSpring(spring, restAngle, ks, kd); });
}

}  // namespace jet::box2d
