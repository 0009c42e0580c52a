// Live changes of soft bodies and of fields, between steps.
#include "validation.hpp"
#include "world.hpp"

namespace jet::physics {

namespace {

[[noreturn]] void failNotSoft(std::uint32_t handle)
{
    throw Failure(Error("Physics: body " + std::to_string(handle) + " is rigid; only soft bodies have springs."));
}

}  // namespace

void World::setForceField(ActuatorHandle field, const ForceFieldDef& def)
{
    requireBelow("force field", field, fields_.count());
    validate(def);
    fields_.set(field, def);
}

BodyRecord& World::softBody(BodyHandle handle)
{
    requireBelow("body", handle, bodyCount());
    if (state_.bodies[handle].rigid) failNotSoft(handle);
    return state_.bodies[handle];
}

void World::setSoftMatter(BodyHandle handle, const SoftMatter& matter)
{
    validate(matter);
    softBody(handle).matter = matter;
}

void World::setSprings(BodyHandle handle, double ks, double kd, double tearRatio)
{
    softBody(handle);
    requireSpring("the springs of a body", 0, ks, kd, tearRatio);
    springs_.set(handle, ks, kd, tearRatio);
    rate_ = -1;
}

void World::setPinned(BodyHandle handle, std::uint32_t particle, bool pinned)
{
    const BodyRecord& body = softBody(handle);
    requireBelow("particle", particle, body.points.count);
    if (body.fixed) return;
    Nodes& nodes = state_.nodes;
    keepFreeInverse();
    const Index node = state_.points.node[body.points.first + particle];
    nodes.invMass[node] = pinned ? 0 : 1 / nodes.mass[node];
    if (pinned) nodes.velocity[node] = Vec2(0, 0);
    rate_ = -1;
}

double World::springTension(BodyHandle handle, std::uint32_t index) const
{
    requireBelow("body", handle, bodyCount());
    if (state_.bodies[handle].rigid) failNotSoft(handle);
    requireBelow("spring", index, state_.bodies[handle].springs.count);
    return springs_.tension(state_, handle, state_.bodies[handle].springs.first + index);
}

}  // namespace jet::physics
