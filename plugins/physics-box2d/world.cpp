#include "world.hpp"

#include "units.hpp"
#include "validation.hpp"

#include <box2d/b2_contact.h>
#include <box2d/b2_fixture.h>

#include <bit>

namespace jet::box2d {

namespace {

void check(const WorldSettings& settings)
{
    checks().check(settings);
    if (settings.method == Method::SemiImplicitEuler) fail("it has a method of its own, and no semi-implicit Euler.");
}

}  // namespace

World::World(const WorldSettings& settings) : settings_(settings)
{
    check(settings);
    stage_ = std::make_unique<Stage>(settings);
}

void World::does(const Entry& entry)
{
    play(*stage_, entry);
    history_.add(entry);  // only what could be done
    changed();
}

void World::doesSpecial(Special special)
{
    special(*stage_);
    remember(std::move(special));
}

void World::remember(Special special)
{
    history_.add({Deed::Special, static_cast<std::uint32_t>(special_.size()), 1, 0, 0, 0});
    special_.push_back(std::move(special));
    changed();
}

namespace {

/// Box2D divides by a pulley's ratio, as a float.
void check(JointHandle handle, const JointDef& def)
{
    checks().check(handle, def);
    if (def.kind == JointDef::Kind::Pulley) checks().above(named("joint", handle), "ratio", def.ratio, 1e-6);
}

/// A state from elsewhere may name what is not there.
void requireExisting(const Stage& stage, const Entry& e)
{
    switch (e.deed) {
    case Deed::Step:
    case Deed::Special:
    case Deed::SetGravity: return;
    case Deed::SetTorque: return requireBelow("torque", e.handle, stage.torques().size());
    case Deed::SetForce: return requireBelow("force", e.handle, stage.forces().size());
    case Deed::SetMotor:
    case Deed::SetJointTarget:
    case Deed::RemoveJoint: return requireBelow("joint", e.handle, stage.joints().size());
    default: return requireBelow("body", e.handle, stage.bodies().size());
    }
}

}  // namespace

void World::play(Stage& stage, const Entry& e) const
{
    const Vec2 value(e.x, e.y);
    requireExisting(stage, e);
    switch (e.deed) {
    case Deed::Step:
        for (std::uint32_t i = 0; i < e.count; ++i) stage.step(e.x);
        return;
    case Deed::Special: return special_.at(e.handle)(stage);
    case Deed::SetTorque: return stage.setTorque(e.handle, e.x);
    case Deed::SetForce: return stage.setForce(e.handle, value);
    case Deed::ApplyForce: return stage.applyForce(e.handle, value);
    case Deed::ApplyImpulse: return stage.applyImpulse(e.handle, value);
    case Deed::SetVelocity: return stage.setVelocity(e.handle, value);
    case Deed::SetOmega: return stage.setOmega(e.handle, e.x);
    case Deed::SetPosition: return stage.setPosition(e.handle, value);
    case Deed::SetGravity: return stage.setGravity(value);
    case Deed::SetMass: return stage.setMass(e.handle, e.x);
    case Deed::SetEnabled: return stage.setEnabled(e.handle, e.flag != 0);
    case Deed::SetMotor: {
        JointDef def = stage.joints().at(e.handle).def;
        def.driven = e.flag != 0, def.motorSpeed = e.x;
        return stage.setJoint(e.handle, def);
    }
    case Deed::SetJointTarget: return stage.setJointTarget(e.handle, value);
    case Deed::RemoveJoint: return stage.removeJoint(e.handle);
    case Deed::Wake: return stage.wake(e.handle);
    }
}

BodyHandle World::addSoftBody(const SoftBodyDef&)
{
    fail("soft bodies (particles, springs, gas, plasticity, tearing) are not supported by this engine. Choose the "
         "engine "
         "'jet-physics' for this scene, or make the item a rigid body.");
}

BodyHandle World::addRigidBody(const RigidBodyDef& def)
{
    checks().check(static_cast<BodyHandle>(bodyCount()), def, settings_.materialCount);
    if (def.shapes.empty() && def.borders.empty()) fail(named("body", bodyCount()) + " needs borders or shapes.");
    std::size_t corners = 0;
    for (const auto& border : def.borders) corners += border.size();
    constexpr std::size_t kMostCorners = 10'000;  // crossings and holes are sought by their square
    if (corners > kMostCorners)
        fail(named("body", bodyCount()) + ": its outline has " + std::to_string(corners) + " corners, more than " +
             std::to_string(kMostCorners) + "; draw it with fewer.");
    return adds(def);
}

ActuatorHandle World::addSpring(const SpringActuatorDef& def)
{
    checks().check(static_cast<ActuatorHandle>(stage_->springs().size()), def, bodyCount());
    requireBodies({&def.a, &def.b});
    return adds(def);
}

ActuatorHandle World::addAngularSpring(const AngularSpringActuatorDef& def)
{
    checks().check(static_cast<ActuatorHandle>(stage_->angularSprings().size()), def, bodyCount());
    requireBodies({&def.a, &def.centre, &def.b});
    return adds(def);
}

ActuatorHandle World::addTorque(const TorqueActuatorDef& def)
{
    const std::string item = named("torque", stage_->torques().size());
    checks().check(item, def.at, bodyCount());
    checks().number(item, "value", def.value);
    requireBodies({&def.at});
    return adds(def);
}

ActuatorHandle World::addForce(const ForceActuatorDef& def)
{
    const std::string item = named("force", stage_->forces().size());
    checks().check(item, def.at, bodyCount());
    checks().number(item, "value", def.force);
    requireBodies({&def.at});
    return adds(def);
}

JointHandle World::addJoint(const JointDef& def)
{
    const auto handle = static_cast<JointHandle>(jointCount());
    checks().checkAnchors(handle, def, bodyCount());
    check(handle, def);
    requireBodies({&def.a, &def.b});
    return adds(def);
}

void World::step(double dt)
{
    if (!(dt > 0 && dt <= 1)) fail("a step lasts more than 0 and at most 1 second.");
    try {
        does({Deed::Step, 0, 1, 0, dt, 0});
    } catch (...) {
        stage_ = again(history_);  // half a step is none
        changed();
        throw;
    }
}

void World::setTorque(ActuatorHandle torque, double value)
{
    requireActuator(ActuatorKind::Torque, torque);
    checks().number(named("torque", torque), "value", value);
    does({Deed::SetTorque, torque, 1, 0, value, 0});
}

void World::setForce(ActuatorHandle force, const Vec2& value)
{
    requireActuator(ActuatorKind::Force, force);
    checks().number(named("force", force), "value", value);
    does({Deed::SetForce, force, 1, 0, value.x(), value.y()});
}

void World::applyForce(BodyHandle body, const Vec2& force)
{
    requireBody(body);
    checks().number(named("body", body), "force", force);
    does({Deed::ApplyForce, body, 1, 0, force.x(), force.y()});
}

void World::applyImpulse(BodyHandle body, const Vec2& impulse)
{
    requireBody(body);
    checks().number(named("body", body), "impulse", impulse);
    does({Deed::ApplyImpulse, body, 1, 0, impulse.x(), impulse.y()});
}

void World::setVelocity(BodyHandle body, const Vec2& velocity)
{
    requireBody(body);
    checks().number(named("body", body), "velocity", velocity);
    does({Deed::SetVelocity, body, 1, 0, velocity.x(), velocity.y()});
}

void World::setOmega(BodyHandle body, double omega)
{
    requireBody(body);
    checks().number(named("body", body), "turning rate", omega);
    does({Deed::SetOmega, body, 1, 0, omega, 0});
}

void World::setPosition(BodyHandle body, const Vec2& centre)
{
    requireBody(body);
    checks().place(named("body", body), "position", centre);
    does({Deed::SetPosition, body, 1, 0, centre.x(), centre.y()});
}

void World::setGravity(const Vec2& gravity)
{
    checks().number("the world", "gravity", gravity);
    does({Deed::SetGravity, 0, 1, 0, gravity.x(), gravity.y()});
}

bool World::springAlive(BodyHandle, std::uint32_t) const { fail("soft bodies are not supported by this engine."); }

void World::setSettings(const WorldSettings& settings)
{
    check(settings);
    if (settings.materialCount != settings_.materialCount)
        fail("the number of materials cannot change while the world runs.");
    doesSpecial([settings](Stage& stage) { stage.setSettings(settings); });
}

void World::setBody(BodyHandle body, const BodyCommon& common)
{
    requireBody(body);
    checks().check(body, common, settings_.materialCount);
    if (common.fixed != stage_->bodies()[body].common.fixed)
        fail(named("body", body) + " cannot become fixed or free while the world runs; make it kinematic instead.");
    doesSpecial([body, common](Stage& stage) { stage.setBody(body, common); });
}

void World::setMass(BodyHandle body, double mass)
{
    requireBody(body);
    checks().checkMass(body, mass);
    does({Deed::SetMass, body, 1, 0, mass, 0});
}

void World::setEnabled(BodyHandle body, bool enabled)
{
    requireBody(body);
    does({Deed::SetEnabled, body, 1, enabled, 0, 0});
}

void World::setJoint(JointHandle joint, const JointDef& def)
{
    requireJoint(joint);
    JointDef whole = def;
    whole.a = stage_->joints()[joint].def.a, whole.b = stage_->joints()[joint].def.b;
    check(joint, whole);
    doesSpecial([joint, whole](Stage& stage) { stage.setJoint(joint, whole); });
}

void World::setSpring(ActuatorHandle spring, double restLength, double ks, double kd, double tearRatio)
{
    requireActuator(ActuatorKind::Spring, spring);
    const std::string item = named("spring", spring);
    checks().number(item, "rest length", restLength);
    checks().spring(item, ks, kd, tearRatio);
    doesSpecial([=](Stage& stage) { stage.setSpring(spring, restLength, ks, kd, tearRatio); });
}

JointState World::joint(JointHandle joint) const
{
    requireJoint(joint);
    return stage_->stateOf(stage_->joints()[joint]);
}

void World::setMotor(JointHandle joint, bool driven, double speed)
{
    requireJoint(joint);
    checks().number(named("joint", joint), "motor speed", speed);
    does({Deed::SetMotor, joint, 1, driven, speed, 0});
}

void World::setJointTarget(JointHandle joint, const Vec2& target)
{
    requireJoint(joint);
    checks().place(named("joint", joint), "target", target);
    const Joint& found = stage_->joints()[joint];
    if (!found.groundA && !found.groundB)
        fail(named("joint", joint) + ": only a joint with the background has a target.");
    does({Deed::SetJointTarget, joint, 1, 0, target.x(), target.y()});
}

void World::removeJoint(JointHandle joint)
{
    requireJoint(joint);
    does({Deed::RemoveJoint, joint, 1, 0, 0, 0});
}

bool World::awake(BodyHandle body) const
{
    requireBody(body);
    return stage_->bodies()[body].body->IsAwake();
}

void World::wake(BodyHandle body)
{
    requireBody(body);
    does({Deed::Wake, body, 1, 0, 0, 0});
}

std::uint32_t World::island(BodyHandle body) const
{
    requireBody(body);
    read();
    if (islands_.empty()) islands_ = stage_->islands();
    return islands_[body];
}

void World::read() const
{
    if (!stale_) return;
    stale_ = false;
    islands_.clear();
    Readings& r = readings_;
    r = Readings();
    for (const Body& body : stage_->bodies()) {
        r.position.push_back(units(body.body->GetWorldCenter()));
        r.angle.push_back(static_cast<double>(body.body->GetAngle()));
        r.velocity.push_back(units(body.body->GetLinearVelocity()));
        r.omega.push_back(static_cast<double>(body.body->GetAngularVelocity()));
        r.firstPoint.push_back(static_cast<std::uint32_t>(r.points.size()));
        Box& bounds = r.bounds.emplace_back();
        for (const Vec2& local : body.local) {
            r.points.push_back(placeOf(body, local));
            bounds.extend(r.points.back());
        }
    }
    r.firstPoint.push_back(static_cast<std::uint32_t>(r.points.size()));
}

BodyStates World::bodies() const
{
    read();
    const Readings& r = readings_;
    return {r.position, r.angle, r.velocity, r.omega, r.bounds, r.firstPoint, r.points};
}

bool World::touching(BodyHandle a, BodyHandle b) const
{
    return hasBody(a) && hasBody(b) && stage_->book().touching(a, b);
}

bool World::contains(BodyHandle handle, const Vec2& point) const
{
    requireBody(handle);
    if (!isFinite(point)) return false;
    const Body& body = stage_->bodies()[handle];
    if (!body.body->IsEnabled()) return false;
    if (!body.solid) {
        for (const b2Fixture* f = body.body->GetFixtureList(); f; f = f->GetNext())
            if (f->TestPoint(metres(point))) return true;
        return false;
    }
    Rings rings;
    std::size_t begin = 0;
    for (const std::size_t end : body.ringEnds) {
        Ring& ring = rings.emplace_back();
        for (std::size_t i = begin; i < end; ++i) ring.push_back(placeOf(body, body.local[i]));
        begin = end;
    }
    return box2d::contains(rings, point);
}

std::uint64_t World::hash() const
{
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    const auto add = [&hash](auto value) {
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
        hash = (hash ^ bits) * 0x100000001b3ULL;
        hash ^= hash >> 32;
    };
    for (const Body& body : stage_->bodies()) {
        const b2Vec2 at = body.body->GetPosition(), v = body.body->GetLinearVelocity();
        for (const float value : {at.x, at.y, body.body->GetAngle(), v.x, v.y, body.body->GetAngularVelocity()})
            add(value);
        add(body.body->IsAwake() * 2 + body.body->IsEnabled());
        add(body.force.x()), add(body.force.y());
    }
    for (const Torque& torque : stage_->torques()) add(torque.value);
    for (const Force& force : stage_->forces()) add(force.value.x()), add(force.value.y());
    for (const AngularSpring& spring : stage_->angularSprings()) add(spring.angle);
    for (const Spring& spring : stage_->springs()) add(spring.torn);
    for (const Joint& joint : stage_->joints()) add(joint.joint == nullptr);
    for (const b2Contact* c = stage_->world().GetContactList(); c; c = c->GetNext())
        for (int32 i = 0; i < c->GetManifold()->pointCount; ++i)
            add(c->GetManifold()->points[i].normalImpulse), add(c->GetManifold()->points[i].tangentImpulse);
    return hash;
}

std::vector<std::byte> World::save() const { return history_.bytes(); }

std::unique_ptr<Stage> World::again(const History& history) const
{
    auto stage = std::make_unique<Stage>(settings_);
    for (const Entry& entry : history.entries()) play(*stage, entry);
    return stage;
}

void World::restore(std::span<const std::byte> state)
{
    History wanted = History::read(state);
    std::size_t specials = 0;
    for (const Entry& entry : wanted.entries())
        if (entry.deed == Deed::Special) specials = std::max<std::size_t>(specials, entry.handle + 1);
    if (specials > special_.size())
        fail("the saved state does not fit this world; it can only be restored into the world that saved it, or one "
             "built from the same scene.");
    std::vector<Entry> rest;
    std::unique_ptr<Stage> fresh;
    if (!wanted.continues(history_, rest)) {
        fresh = std::make_unique<Stage>(settings_);
        rest = wanted.entries();
    }
    Stage& stage = fresh ? *fresh : *stage_;
    try {
        for (const Entry& entry : rest) play(stage, entry);
    } catch (...) {
        if (!fresh) stage_ = again(history_);  // half a future is none
        throw;
    }
    if (stage.changes() != stage_->changes())
        fail("the saved state is of a time before something was added or removed; it can only be restored into a world "
             "of the same bodies, joints, springs, torques and forces.");
    if (fresh) stage_ = std::move(fresh);
    history_ = std::move(wanted);
    changed();
}

}  // namespace jet::box2d
