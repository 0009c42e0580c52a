// Changes while the world runs: settings, bodies, joints and springs between bodies.
#include "validation.hpp"
#include "world.hpp"

#include <bit>
#include <tuple>

namespace jet::physics {

namespace {

bool isLike(const MaterialPair& a, const MaterialPair& b)
{
    return a.friction == b.friction && a.restitution == b.restitution && a.collides == b.collides;
}

/// In all that decides how things move, but for the materials.
bool isLike(const WorldSettings& a, const WorldSettings& b)
{
    const auto parts = [](const WorldSettings& s) {
        return std::tie(s.linearDamping, s.angularDamping, s.applyGravity, s.applyDamping, s.findCollisions,
                        s.resolveCollisions, s.substeps, s.method, s.allowSleep);
    };
    return a.gravity == b.gravity && parts(a) == parts(b);
}

std::uint64_t markOf(const std::vector<MaterialPair>& materials)
{
    std::uint64_t mark = 0xcbf29ce484222325ULL;
    for (const MaterialPair& pair : materials)
        for (const double value : {pair.friction, pair.restitution, pair.collides ? 1.0 : 0.0})
            mark = (mark ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x100000001b3ULL, mark ^= mark >> 32;
    return mark;
}

}  // namespace

void World::keepMark() { tableMark_ = markOf(settings_.materials); }

void World::heedMaterials()
{
    if (tableMark_ == pairsOf_) return;
    pairsOf_ = tableMark_;
    wakeAll();
    rigid_.forgetPairs();
}

void World::setSettings(const WorldSettings& wanted)
{
    checks().check(wanted);
    if (wanted.materialCount != settings_.materialCount)
        throw Failure(Error("Physics: the count of materials cannot change while the world runs; it is " +
                            std::to_string(settings_.materialCount) + "."));
    WorldSettings settings = wanted;
    settings.precision = settings_.precision, settings.simd = settings_.simd;
    if (settings.method == Method::SemiImplicitEuler) settings.substeps = 1;
    const bool kept = std::equal(settings.materials.begin(), settings.materials.end(), settings_.materials.begin(),
                                 [](const MaterialPair& a, const MaterialPair& b) { return isLike(a, b); });
    if (!kept || !isLike(settings, settings_)) wakeAll();
    settings_ = std::move(settings);
    keepMark();
    heedMaterials();
}

void World::setMass(BodyHandle handle, double mass)
{
    requireBody(handle);
    checks().checkMass(handle, mass);
    BodyRecord& body = state_.bodies[handle];
    const double before = state_.massOf(body);
    if (mass == before) return;
    Nodes& nodes = state_.nodes;
    if (body.rigid) {
        nodes.mass[body.nodes.first] = mass;
        applyMotion(handle);
    } else {
        const double ratio = mass / before;
        body.soft->mass = mass;
        for (Index n = body.nodes.first; n < body.nodes.end(); ++n) nodes.mass[n] *= ratio, nodes.invMass[n] /= ratio;
        reread(handle);  // as after restoring it
    }
    rate_ = -1;
    rigid_.disturb(handle);
    wakeUp(handle);
}

void World::setBody(BodyHandle handle, const BodyCommon& common)
{
    requireBody(handle);
    checks().check(handle, common, settings_.materialCount);
    BodyRecord& body = state_.bodies[handle];
    if (common.fixed != body.fixed)
        throw Failure(Error("Physics: body " + std::to_string(handle) +
                            " cannot become fixed or free while the world runs; " +
                            (body.rigid ? "make it kinematic" : "pin its particles") + " instead."));
    if (body.material == common.material && body.gravityScale == common.gravityScale && body.sensor == common.sensor &&
        body.layer == common.layer && state_.filters[handle] == Filter::of(common) &&
        body.drives == (common.kinematic && !common.fixed) && body.fixedRotation == common.fixedRotation &&
        (body.soft ? body.soft->watch.mayRest == common.allowSleep : rigid_.isSet(handle, common)))
        return;
    reportIfAsked();  // of what it was
    body.material = common.material, body.gravityScale = common.gravityScale;
    body.sensor = common.sensor, body.layer = common.layer;
    state_.setFilter(handle, Filter::of(common));
    const bool held = isHeld(body);
    body.drives = common.kinematic && !common.fixed, body.fixedRotation = common.fixedRotation;
    stir(handle);
    wakeUp(handle);
    if (body.rigid) {
        applyMotion(handle);
        if (body.fixedRotation && !body.drives) state_.nodes.omega.edit(body.nodes.first) = 0;
        rigid_.set(state_, handle, common);
    } else {
        body.soft->watch.mayRest = common.allowSleep;
        holdSoft(body, held);
    }
    reread(handle);
    rate_ = -1;
    queries_.outdate();
}

void World::setEnabled(BodyHandle handle, bool enabled)
{
    requireBody(handle);
    BodyRecord& body = state_.bodies[handle];
    if (body.enabled == enabled) return;
    reportIfAsked();  // of what it was
    stir(handle);
    wakeUp(handle);
    const bool held = isHeld(body);
    body.enabled = enabled;
    Nodes& nodes = state_.nodes;
    if (!enabled)
        for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
            nodes.velocity[n] = Vec2(0, 0), nodes.omega.set(n, 0);
    if (body.rigid) {
        applyMotion(handle);
        rigid_.enable(state_, handle, enabled);
    } else {
        holdSoft(body, held);
    }
    reread(handle);
    rate_ = -1;
    queries_.outdate();
}

/// Nothing pushes its particles: it is switched off, or kinematic.
bool World::isHeld(const BodyRecord& body) { return !body.enabled || body.drives; }

/// What is held is all pins; they are told from those it has. `before`: was it held?
void World::holdSoft(BodyRecord& body, bool before)
{
    Nodes& nodes = state_.nodes;
    const bool held = isHeld(body);
    body.kinematic = body.drives && body.enabled;
    if (body.kinematic) soft::stiffen(state_, body);
    if (held == before || body.fixed) return;
    pinsWhileHeld_.resize(nodes.size(), 0);
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n) {
        if (held) {
            pinsWhileHeld_[n] = nodes.invMass[n] == 0;
            nodes.invMass[n] = 0;
            continue;
        }
        nodes.invMass[n] = pinsWhileHeld_[n] != 0 ? 0 : 1 / nodes.mass[n];
        if (pinsWhileHeld_[n] != 0) nodes.velocity[n] = Vec2(0, 0);
    }
}

void World::setJoint(JointHandle handle, const JointDef& def)
{
    const JointAt at = jointAt(handle);
    checks().check(handle, def);
    if (isLike(def, at.soft ? softJoints_.joint(at.index) : rigid_.joint(at.index))) return;
    wakeHeld(at.soft ? softJoints_.def(at.index) : rigid_.joint(at.index).def);
    if (at.soft) {
        softJoints_.set(state_, at.index, def);
        finder_.exclude(softJoints_.excluded());
    } else {
        rigid_.setJoint(state_, at.index, def);
    }
}

void World::setSpring(ActuatorHandle spring, double restLength, double ks, double kd, double tearRatio)
{
    requireActuator(ActuatorKind::Spring, spring);
    const std::string item = named("spring", spring);
    checks().number(item, "rest length", restLength);
    checks().spring(item, ks, kd, tearRatio);
    if (actuators_.isSet(spring, restLength, ks, kd, tearRatio)) return;
    wakeHeld(ActuatorKind::Spring, spring);
    actuators_.setSpring(spring, restLength, ks, kd, tearRatio);
    rate_ = -1;
}

void World::setAngularSpring(ActuatorHandle spring, std::optional<double> restAngle, double ks, double kd)
{
    requireActuator(ActuatorKind::AngularSpring, spring);
    const std::string item = named("angular spring", spring);
    if (restAngle) checks().number(item, "rest angle", *restAngle);
    checks().spring(item, ks, kd);
    if (actuators_.isSet(spring, restAngle, ks, kd)) return;
    wakeHeld(ActuatorKind::AngularSpring, spring);
    actuators_.setAngularSpring(spring, restAngle, ks, kd);
    rate_ = -1;
}

}  // namespace jet::physics
