#include "force_fields.hpp"

#include "outline.hpp"

namespace jet::physics {

namespace {

EdgeGrid gridOver(const std::vector<std::vector<Vec2>>& rings)
{
    std::vector<EdgeGrid::Edge> edges;
    for (const auto& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
    EdgeGrid grid;
    grid.build(edges);
    return grid;
}

/// Strength left at `distance`.
double fading(double distance, double reach)
{
    if (!(reach > 0)) return 1;
    const double ratio = distance / reach;
    return 1 / (1 + ratio * ratio);
}

/// The rate that, held over h, does to a velocity what drag at `rate` does: it can stop it, never turn it round.
double dragOver(double rate, double h) { return (1 - decay(rate * h)) / h; }

}  // namespace

Index ForceFields::add(const ForceFieldDef& def)
{
    fields_.push_back({def, gridOver(def.region)});
    return count() - 1;
}

void ForceFields::set(Index field, const ForceFieldDef& def)
{
    const auto kind = fields_[field].def.kind;
    fields_[field] = {def, gridOver(def.region)};
    fields_[field].def.kind = kind;
}

bool ForceFields::isSet(Index field, const ForceFieldDef& def) const
{
    const ForceFieldDef& now = fields_[field].def;
    return def.region == now.region && def.vector == now.vector && def.centre == now.centre &&
           def.strength == now.strength && def.reach == now.reach && def.drag == now.drag;
}

void ForceFields::restored()
{
    for (Field& field : fields_) field.region = gridOver(field.def.region);
}

Vec2 ForceFields::Field::acceleration(const Vec2& at, const Vec2& velocity, const Vec2& weight, double h) const
{
    const Vec2 arm = at - def.centre;
    const double distance = arm.norm();
    const Vec2 away = distance > 0 ? Vec2(arm / distance) : Vec2(0, 0);
    switch (def.kind) {
    case ForceFieldDef::Kind::Directional: return def.vector;
    case ForceFieldDef::Kind::Radial: return def.strength * fading(distance, def.reach) * away;
    case ForceFieldDef::Kind::Vortex: return def.strength * fading(distance, def.reach) * perpendicular(away);
    case ForceFieldDef::Kind::Drag: return dragOver(def.strength, h) * (def.vector - velocity);
    case ForceFieldDef::Kind::Buoyancy: return -def.strength * weight - dragOver(def.drag, h) * velocity;
    }
    return Vec2(0, 0);
}

void ForceFields::act(State& state, const RigidStage& rigid, const Field& field, Index handle, const Vec2& weight,
                      double h)
{
    const BodyRecord& body = state.bodies[handle];
    Nodes& nodes = state.nodes;
    const auto pull = [&](Index node, const Vec2& at, double mass) {
        if (!field.covers(at)) return;
        const Vec2 lever = at - nodes.position[node];
        const Vec2 force = mass * field.acceleration(at, nodes.velocityAt(node, lever), weight, h);
        nodes.force[node] += force;
        nodes.torque[node] += cross(lever, force);
    };
    if (!body.rigid) {
        for (Index n = body.nodes.first; n < body.nodes.end(); ++n) pull(n, nodes.position[n], nodes.mass[n]);
    } else if (body.isLean()) {
        const Vec2 centre = nodes.position[body.nodes.first], turn = nodes.rotation[body.nodes.first];
        const PartRing ring = ringOf(rigid.onlyPart(handle));
        for (Index i = 0; i < ring.count; ++i)
            pull(body.nodes.first, centre + rotated(turn, ring.points[i]), state.massOf(body) / ring.count);
    } else if (body.points.count == 0) {
        pull(body.nodes.first, nodes.position[body.nodes.first], state.massOf(body));
    } else {
        for (Index p = body.points.first; p < body.points.end(); ++p)
            pull(body.nodes.first, state.pointNow(p), state.massOf(body) / body.points.count);
    }
}

void ForceFields::addForces(State& state, const RigidStage& rigid, const Vec2& gravity, double h) const
{
    for (const Field& field : fields_) {
        for (Index handle = 0; handle < state.bodies.size(); ++handle) {
            const BodyRecord& body = state.bodies[handle];
            if (!body.fixed) act(state, rigid, field, handle, body.gravityScale * gravity, h);
        }
    }
}

}  // namespace jet::physics
