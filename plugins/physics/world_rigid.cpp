// Steps of simple rigid bodies alone, joints, and queries.
#include "integrator.hpp"
#include "told.hpp"
#include "validation.hpp"
#include "world.hpp"

namespace jet::physics {

bool World::onlySimple() const { return complex_ == 0 && !rigid_.empty() && !actuators_.anySpring(); }

void World::stepSimple(double dt)
{
    // Without forces nothing of this is touched: threads have the nodes in their caches.
    const bool pushed = pushed_ || actuators_.any() || fields_.any();
    if (pushed) state_.nodes.coverForces();
    std::vector<Vec2>& force = state_.nodes.force.values();
    std::vector<double>& torque = state_.nodes.torque.values();
    if (pushed) {
        for (Index n = 0; n < force.size(); ++n) force[n] = stepForces_[n];
        std::fill(torque.begin(), torque.end(), 0.0);
        if (actuators_.any()) actuators_.addForces(state_);
        if (fields_.any())
            fields_.addForces(state_, rigid_, settings_.applyGravity ? settings_.gravity : Vec2(0, 0), dt);
    }
    rigid_.step(state_, settings_, dt, stats_);
    restIfDue(dt);
    if (pushed) {
        std::fill(stepForces_.values().begin(), stepForces_.values().end(), Vec2(0, 0));
        std::fill(force.begin(), force.end(), Vec2(0, 0));
        std::fill(torque.begin(), torque.end(), 0.0);
    }
    pushed_ = false;
    contacts_.points.clear();
    stale_ = true;
    reports_.setDue(true);
}

void World::moveKinematic(double h)
{
    Nodes& nodes = state_.nodes;
    for (const BodyRecord& body : state_.bodies) {
        if (!body.kinematic || body.soft) continue;
        const Index node = body.nodes.first;
        nodes.position[node] += h * nodes.velocity[node];
        nodes.angle.edit(node) += h * nodes.omega[node];
        nodes.rotation.edit(node) = direction(nodes.angle[node]);
    }
}

void World::refresh() const
{
    if (!stale_) return;
    auto& self = const_cast<World&>(*this);  // caches of what the nodes say
    self.stale_ = false;
    updatePoints(self.state_);
    if (!outlines_.lean()) updateReadings(self.state_);
}

void World::reread(BodyHandle handle) { outlines_.lean() ? outlines_.retell(handle) : updateReading(state_, handle); }

void World::reportIfAsked() const
{
    if (!reports_.due()) return;
    refresh();
    const_cast<World&>(*this).report();  // stages bring what they keep into the form it is told in
}

std::span<const Contact> World::contacts() const
{
    reportIfAsked();
    return reports_.contacts();
}

StepStats World::stats() const
{
    reportIfAsked();
    if (settings_.allowSleep) islands();
    StepStats stats = stats_;
    stats.memory = bytesOf(state_) + rigid_.bytes() + queries_.bytes() + softContacts_.bytes() + softJoints_.bytes() +
                   accounts_.bytes() + slumber_.bytes() + tears_.bytes() + reports_.bytes() +
                   islands_.capacity() * sizeof(Index);
    return stats;
}

JointHandle World::addJoint(const JointDef& def)
{
    const auto next = static_cast<JointHandle>(jointsAt_.size());
    checks().checkAnchors(next, def, bodyCount());
    checks().check(next, def);
    requireBodies({&def.a, &def.b});
    bool soft = false;
    for (const Anchor* anchor : {&def.a, &def.b})
        soft |= anchor->body != kNoHandle && !state_.bodies[anchor->body].rigid;
    for (const Anchor* anchor : {&def.a, &def.b})
        if (anchor->body != kNoHandle && !soft && !rigid_.has(anchor->body))
            checks().fail("joint " + std::to_string(next) + ": body " + std::to_string(anchor->body) +
                          " has no simple rigid shape; joints hold those, soft bodies and the background. Give it "
                          "shapes, or use a spring between bodies.");
    const bool pull = isPull(def);
    const JointHandle handle = freeJoint(soft, pull);
    const Index place = handle == next ? kNone : jointsAt_[handle].index;
    const Index index = soft ? softJoints_.add(state_, def, place) : rigid_.addJoint(state_, def, place);
    if (handle == next) jointsAt_.push_back({soft, pull, index});
    wakeHeld(def);
    if (soft) finder_.exclude(softJoints_.excluded());
    if (!pull) structure_.add(def, handle, index);
    return handle;
}

World::JointAt World::jointAt(JointHandle handle) const
{
    requireBelow("joint", handle, jointsAt_.size());
    if (isRemoved(jointsAt_[handle])) checks().fail(named("joint", handle) + " was removed.");
    return jointsAt_[handle];
}

JointState World::joint(JointHandle handle) const
{
    const JointAt at = jointAt(handle);
    JointState state = at.soft ? softJoints_.state(state_, at.index) : rigidJoint(at.index);
    state.force = told(state.force), state.torque = told(state.torque), state.value = told(state.value);
    state.pointA = told(state.pointA), state.pointB = told(state.pointB);
    return state;
}

JointState World::rigidJoint(Index index) const
{
    const Joint& joint = rigid_.joint(index);
    const JointFrame frame = frameOf(joint, state_, rigid_.collider().bodies());
    JointState state = const_cast<World*>(this)->rigid_.stateOf(index);  // a cache of what the solver has
    state.broken = joint.broken;
    state.pointA = frame.pointA;
    state.pointB = frame.pointB;
    const Vec2 apart = frame.pointB - frame.pointA;
    switch (joint.def.kind) {
    case JointDef::Kind::Prismatic:
    case JointDef::Kind::Wheel: state.value = apart.dot(frame.axis); break;
    case JointDef::Kind::Distance:
    case JointDef::Kind::Rope:
    case JointDef::Kind::Mouse: state.value = apart.norm(); break;
    default: state.value = frame.angle;
    }
    return state;
}

void World::setMotor(JointHandle handle, bool driven, double speed)
{
    const JointAt at = jointAt(handle);
    checks().number(named("joint", handle), "motor speed", speed);
    handle = at.index;
    if (at.soft) {
        const JointDef& def = softJoints_.def(at.index);
        if (def.driven != driven || def.motorSpeed != speed) wakeHeld(def);
        return softJoints_.setMotor(at.index, driven, speed);
    }
    const JointDef& def = rigid_.joint(handle).def;
    if (def.driven != driven || def.motorSpeed != speed) wakeHeld(def);
    rigid_.setMotor(handle, driven, speed);
}

void World::setJointTarget(JointHandle handle, const Vec2& target)
{
    const JointAt at = jointAt(handle);
    const std::string item = named("joint", handle);
    checks().place(item, "target", target);
    if (at.soft && softJoints_.setTarget(at.index, target)) return wakeHeld(softJoints_.def(at.index));
    if (at.soft) checks().fail(item + ": only a joint with the background has a target.");
    const Joint& joint = rigid_.joint(at.index);
    if (joint.a != 0 && joint.b != 0) checks().fail(item + ": only a joint with the background has a target.");
    if ((joint.a == 0 ? joint.localA : joint.localB) != target) wakeHeld(joint.def);
    rigid_.setTarget(at.index, target);
}

void World::removeJoint(JointHandle handle)
{
    const JointAt at = jointAt(handle);
    jointsRemoved_ = true;
    if (at.soft) {
        wakeHeld(softJoints_.def(at.index));
        softJoints_.remove(at.index);
        finder_.exclude(softJoints_.excluded());
        return;
    }
    wakeHeld(rigid_.joint(at.index).def);
    rigid_.removeJoint(at.index);
}

}  // namespace jet::physics
