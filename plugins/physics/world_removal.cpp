// Bodies and actuators are taken out, and later ones take their places (slots.hpp).
#include "outline.hpp"
#include "validation.hpp"
#include "world.hpp"

#include <algorithm>
#include <utility>

namespace jet::physics {

bool World::hasBody(BodyHandle body) const { return body < bodyCount() && !state_.bodies[body].removed; }

void World::requireBody(BodyHandle body) const
{
    requireBelow("body", body, bodyCount());
    if (state_.bodies[body].removed) checks().fail(named("body", body) + " was removed.");
}

void World::requireBodies(std::initializer_list<const Anchor*> anchors) const
{
    for (const Anchor* anchor : anchors)
        if (anchor->body != kNoHandle) requireBody(anchor->body);
}

Index World::actuatorCount(ActuatorKind kind) const
{
    return kind == ActuatorKind::ForceField ? fields_.count() : actuators_.count(kind);
}

bool World::hasActuator(ActuatorKind kind, ActuatorHandle handle) const
{
    if (handle >= actuatorCount(kind)) return false;
    return kind == ActuatorKind::ForceField ? fields_.exists(handle) : actuators_.exists(kind, handle);
}

void World::requireActuator(ActuatorKind kind, ActuatorHandle handle) const
{
    requireBelow(nameOf(kind), handle, actuatorCount(kind));
    if (!hasActuator(kind, handle)) checks().fail(named(nameOf(kind), handle) + " was removed.");
}

void World::wakeHeld(ActuatorKind kind, ActuatorHandle handle)
{
    actuators_.eachHeld(kind, handle, [&](Index body) { wakeUp(body); });
}

void World::removeActuator(ActuatorKind kind, ActuatorHandle handle)
{
    requireActuator(kind, handle);
    if (kind == ActuatorKind::ForceField) {
        wakeAll();
        fields_.remove(handle);
    } else {
        wakeHeld(kind, handle);
        actuators_.remove(kind, handle);
    }
    rate_ = -1;
    islandsKnown_ = false;
    structure_.removeActuator(static_cast<std::uint32_t>(kind), handle);
}

bool World::isRemoved(const JointAt& at) const
{
    return at.soft ? softJoints_.joint(at.index).removed : rigid_.joint(at.index).removed;
}

bool World::hasJoint(JointHandle joint) const { return joint < jointsAt_.size() && !isRemoved(jointsAt_[joint]); }

/// A removed one that is kept where the new one will be, else the next.
JointHandle World::freeJoint(bool soft, bool pull) const
{
    const auto isFree = [&](const JointAt& at) { return at.soft == soft && at.pull == pull && isRemoved(at); };
    const auto found = jointsRemoved_ ? std::find_if(jointsAt_.begin(), jointsAt_.end(), isFree) : jointsAt_.end();
    return static_cast<JointHandle>(found - jointsAt_.begin());
}

/// Its parts are not known before it is in the stage.
Build World::buildOf(BodyHandle handle) const
{
    const BodyRecord& body = state_.bodies[handle];
    Build build;
    build.rigid = body.rigid, build.single = body.single, build.simple = body.simple;
    build.nodes = body.nodes.count, build.points = body.points.count, build.walls = body.walls.count;
    if (body.soft) build.springs = body.soft->springs.count, build.angularSprings = body.soft->angularSprings.count;
    return build;
}

/// The newest body, which no stage knows yet, goes where a removed one was, if there is one of its build.
BodyHandle World::settleIn(const Build& build)
{
    const auto newest = static_cast<BodyHandle>(state_.bodies.size() - 1);
    const Index place = slots_.take(build);
    if (place == kNone) return newest;
    if (state_.bodies[place].soft) {
        state_.bodies[newest].soft->springs = state_.bodies[place].soft->springs;
        state_.bodies[newest].soft->angularSprings = state_.bodies[place].soft->angularSprings;
    }
    moveNewest(state_, place);
    const std::size_t nodes = state_.nodes.size();
    stepForces_.cut(nodes);
    if (pinsWhileHeld_.size() > nodes) pinsWhileHeld_.resize(nodes);
    return place;
}

void World::removeHolders(BodyHandle body)
{
    const auto holds = [body](const JointDef& def) { return def.a.body == body || def.b.body == body; };
    for (JointHandle joint = 0; joint < jointsAt_.size(); ++joint) {
        const JointAt& at = jointsAt_[joint];
        if (!isRemoved(at) && holds(at.soft ? softJoints_.def(at.index) : rigid_.joint(at.index).def))
            removeJoint(joint);
    }
    for (const ActuatorKind kind :
         {ActuatorKind::Spring, ActuatorKind::AngularSpring, ActuatorKind::Torque, ActuatorKind::Force}) {
        for (ActuatorHandle handle = 0; handle < actuators_.count(kind); ++handle) {
            bool any = false;
            actuators_.eachHeld(kind, handle, [&](Index held) { any |= held == body; });
            if (any) removeActuator(kind, handle);
        }
    }
}

/// By points and walls, and what was told of its contacts.
void World::forgetContacts(BodyHandle body)
{
    const auto has = [body](const auto& contact) { return contact.bodyA == body || contact.bodyB == body; };
    if (std::erase_if(contacts_.points, has) > 0) contacts_.begin(state_);
    reports_.forget(body);
    softContacts_.remove(body);
    accounts_.forget(body);
}

void World::removeBody(BodyHandle handle)
{
    requireBody(handle);
    reportIfAsked();  // of what it was
    removeHolders(handle);
    setEnabled(handle, false);  // what lies on it wakes
    BodyRecord& body = state_.bodies[handle];
    forgetContacts(handle);
    queries_.remove(handle);
    if (!stepForces_.values().empty())
        for (Index n = body.nodes.first; n < body.nodes.end(); ++n) stepForces_.set(n, Vec2(0, 0));
    if (!pinsWhileHeld_.empty())
        std::fill_n(pinsWhileHeld_.begin() + body.nodes.first, body.nodes.count, std::uint8_t{0});
    if (body.soft) {
        slumber_.disturb(state_, handle);
        softMovers_ -= !body.fixed;
        tears_.forget(state_, handle);
        springs_.remove(handle);
        shapes_.remove(handle);
        body.soft->matter = {};
    }
    Build build = buildOf(handle);
    if (body.simple) {
        build.parts = static_cast<Index>(rigid_.convexPartsOf(handle).size());
        if (body.isLean()) build.points = build.walls = ringSizeOf(rigid_.onlyPart(handle));
        rigid_.remove(state_, handle);
    }
    complex_ -= !body.simple;
    body.removed = true;
    body.drives = body.fixedRotation = body.sensor = false;
    slots_.give(handle, build);
    structure_.removeBody(handle);
    rate_ = -1;
    islandsKnown_ = false;
    reread(handle);
}

}  // namespace jet::physics
