// Live changes of soft bodies and of fields, between steps.
#include "told.hpp"
#include "validation.hpp"
#include "world.hpp"

#include <algorithm>
#include <tuple>

namespace jet::physics {

namespace {

[[noreturn]] void failNotSoft(std::uint32_t handle)
{
    throw Failure(Error("Physics: body " + std::to_string(handle) + " is rigid; only soft bodies have springs."));
}

bool isLike(const SoftMatter& a, const SoftMatter& b)
{
    const auto parts = [](const SoftMatter& is) {
        return std::tie(is.thickness, is.pressure, is.areaStiffness, is.shapeStiffness, is.shapeDamping, is.yield,
                        is.creep, is.mostFlow, is.selfCollision);
    };
    return parts(a) == parts(b);
}

}  // namespace

void World::setForceField(ActuatorHandle field, const ForceFieldDef& def)
{
    requireActuator(ActuatorKind::ForceField, field);
    checks().check(field, def);
    if (fields_.isSet(field, def)) return;
    fields_.set(field, def);
    wakeAll();
}

BodyRecord& World::softBody(BodyHandle handle)
{
    requireBody(handle);
    if (state_.bodies[handle].rigid) failNotSoft(handle);
    return state_.bodies[handle];
}

const BodyRecord& World::softBody(BodyHandle handle) const { return const_cast<World*>(this)->softBody(handle); }

std::span<const std::uint32_t> World::pieces(BodyHandle handle) const { return softBody(handle).soft->pieces; }

std::vector<std::vector<std::uint32_t>> World::borders(BodyHandle handle) const
{
    softBody(handle);
    return soft::Tears::rings(state_, handle);
}

/// Walls get other numbers, so what was found at the old ones is told first, and forgotten.
void World::cutTorn()
{
    if (!tears_.due(state_, springs_)) return;
    report();
    tears_.look(state_, springs_);
    softJoints_.keepPieces(state_);
    const auto isCut = [&](Index body) { return tears_.isCut(body); };
    softContacts_.forget(state_, isCut);
    auto& points = contacts_.points;
    points.erase(std::remove_if(points.begin(), points.end(), [&](const ContactPoint& c) { return isCut(c.bodyB); }),
                 points.end());
    contacts_.begin(state_);
}

/// The thesis's scheme has no bound. What runs away is stopped before anything that is not a number gets out.
void World::refuseExplosion()
{
    Nodes& nodes = state_.nodes;
    const auto runsAway = [&](Index n) {
        constexpr double kMost = 0.5 * soft::kMostSpeed;
        return !(nodes.velocity[n].squaredNorm() <= kMost * kMost && std::abs(nodes.omega[n]) <= kMost);
    };
    Index first = kNone;
    for (Index handle = 0; handle < state_.bodies.size(); ++handle) {
        const Range& own = state_.bodies[handle].nodes;
        bool away = false;
        for (Index n = own.first; n < own.end(); ++n) away |= runsAway(n);
        if (!away) continue;
        first = std::min(first, handle);
        for (Index n = own.first; n < own.end(); ++n) nodes.velocity[n] = Vec2(0, 0), nodes.omega.set(n, 0);
    }
    if (first == kNone) return;
    throw Failure(Error("Physics: body " + std::to_string(first) +
                        " explodes: its springs are too stiff for semi-implicit Euler at this time step. Use the "
                        "method \"automatic\", a smaller time step, or softer springs."));
}

void World::setSoftMatter(BodyHandle handle, const SoftMatter& matter)
{
    checks().check(handle, matter);
    SoftMatter& own = softBody(handle).soft->matter;
    if (!isLike(own, matter)) stir(handle), wakeUp(handle);
    if (own.shapeStiffness != matter.shapeStiffness || own.shapeDamping != matter.shapeDamping) rate_ = -1;
    own = matter;
}

void World::setSprings(BodyHandle handle, double ks, double kd, double tearRatio)
{
    softBody(handle);
    checks().spring(named("body", handle), ks, kd, tearRatio);
    if (springs_.isSet(handle, ks, kd, tearRatio)) return;
    wakeUp(handle);
    springs_.set(handle, ks, kd, tearRatio);
    rate_ = -1;
}

void World::setPinned(BodyHandle handle, std::uint32_t particle, bool pinned)
{
    const BodyRecord& body = softBody(handle);
    requireBelow("particle", particle, body.points.count);
    if (body.fixed) return;
    Nodes& nodes = state_.nodes;
    const Index node = state_.points.node[body.points.first + particle];
    if (isHeld(body)) {
        pinsWhileHeld_[node] = pinned;
        return;
    }
    if ((nodes.invMass[node] == 0) != pinned) wakeUp(handle);
    nodes.invMass[node] = pinned ? 0 : 1 / nodes.mass[node];
    if (pinned) nodes.velocity[node] = Vec2(0, 0);
    reread(handle);
    rate_ = -1;
}

double World::springTension(BodyHandle handle, std::uint32_t index) const
{
    requireBody(handle);
    if (state_.bodies[handle].rigid) failNotSoft(handle);
    const Range& springs = state_.bodies[handle].soft->springs;
    requireBelow("spring", index, springs.count);
    return told(springs_.tension(state_, handle, springs.first + index));
}

}  // namespace jet::physics
