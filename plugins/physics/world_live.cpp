// Changes while the world runs: settings, masses, joints and springs between bodies.
#include "validation.hpp"
#include "world.hpp"

namespace jet::physics {

void World::setSettings(const WorldSettings& settings)
{
    validate(settings);
    if (settings.materialCount != settings_.materialCount)
        throw Failure(Error("Physics: the count of materials cannot change while the world runs; it is " +
                            std::to_string(settings_.materialCount) + "."));
    const auto same = [](const MaterialPair& a, const MaterialPair& b) {
        return a.friction == b.friction && a.restitution == b.restitution && a.collides == b.collides;
    };
    const bool kept =
        std::equal(settings.materials.begin(), settings.materials.end(), settings_.materials.begin(), same);
    const Precision precision = settings_.precision;
    const Simd simd = settings_.simd;
    settings_ = settings;
    settings_.precision = precision, settings_.simd = simd;
    rigid_.wakeAll(state_);
    if (!kept) rigid_.forgetPairs();
}

void World::setMass(BodyHandle handle, double mass)
{
    requireBelow("body", handle, bodyCount());
    requireFinite("a mass", {mass});
    if (!(mass > 0)) throw Failure(Error("Physics: a body's mass must be greater than 0."));
    BodyRecord& body = state_.bodies[handle];
    Nodes& nodes = state_.nodes;
    const double ratio = mass / body.mass;
    if (!freeInverse_.empty()) keepFreeInverse();
    for (Index n = body.nodes.first; n < body.nodes.end(); ++n) {
        nodes.mass[n] *= ratio;
        nodes.invMass[n] /= ratio, nodes.invInertia[n] /= ratio;
        if (!freeInverse_.empty()) freeInverse_[n] /= ratio;
    }
    body.mass = mass;
    rate_ = -1;
    rigid_.disturb(handle);
    rigid_.wake(state_, handle);
}

void World::setJoint(JointHandle handle, const JointDef& def)
{
    const JointAt at = jointAt(handle);
    validateJoint(def);
    wakeHeld(at.soft ? softJoints_.def(at.index) : rigid_.joint(at.index).def);
    if (at.soft) {
        softJoints_.set(at.index, def);
        finder_.exclude(softJoints_.excluded());
    } else {
        rigid_.setJoint(state_, at.index, def);
    }
}

void World::setSpring(ActuatorHandle spring, double restLength, double ks, double kd, double tearRatio)
{
    requireBelow("spring", spring, actuators_.springCount());
    requireSpring("a spring between bodies", restLength, ks, kd, tearRatio);
    actuators_.visitSpring(spring, [&](Index a, Index b) {
        for (const Index body : {a, b})
            if (body != kNone) rigid_.wake(state_, body);
    });
    actuators_.setSpring(spring, restLength, ks, kd, tearRatio);
    rate_ = -1;
}

}  // namespace jet::physics
