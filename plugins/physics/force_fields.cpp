#include "force_fields.hpp"

#include "rigid/decompose.hpp"
#include "surface.hpp"
#include "validation.hpp"

#include <algorithm>

namespace jet::physics {

namespace {

constexpr int kLooks = 8;  // at a field on the way past its centre

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

ForceFields::Field::Field(const ForceFieldDef& is) : def(is), region(gridOver(is.region))
{
    const Pieces whole = decompose(is.region);
    for (const auto& each : whole.pieces) {
        Piece& piece = pieces.emplace_back();
        for (const std::uint32_t corner : each.corners) {
            piece.corners.push_back(whole.points[corner]);
            piece.box.extend(piece.corners.back());
        }
    }
}

ForceFields::Field ForceFields::made(Index handle, const ForceFieldDef& def)
{
    try {
        return Field(def);
    } catch (const Failure& failure) {
        checks().fail(named("force field", handle) + ": its region " + failure.error().message);
    }
}

Index ForceFields::add(const ForceFieldDef& def)
{
    Field field = made(count(), def);
    if (removed_ == 0) {
        fields_.push_back(std::move(field));
        return count() - 1;
    }
    const auto place = std::find_if(fields_.begin(), fields_.end(), [](const Field& f) { return f.removed; });
    *place = std::move(field), --removed_;
    return static_cast<Index>(place - fields_.begin());
}

void ForceFields::remove(Index field)
{
    fields_[field] = Field(ForceFieldDef());
    fields_[field].removed = true, ++removed_;
}

void ForceFields::set(Index field, const ForceFieldDef& def)
{
    if (def.kind != fields_[field].def.kind)
        checks().fail(
            named("force field", field) +
            ": its kind cannot change while the world runs; add another field, and give this one no strength.");
    fields_[field] = made(field, def);
}

bool ForceFields::isSet(Index field, const ForceFieldDef& def) const
{
    const ForceFieldDef& now = fields_[field].def;
    return def.kind == now.kind && def.region == now.region && def.vector == now.vector && def.centre == now.centre &&
           def.strength == now.strength && def.reach == now.reach && def.drag == now.drag;
}

void ForceFields::restored()
{
    for (Field& field : fields_)
        if (!field.removed) field = Field(ForceFieldDef(field.def));
}

double ForceFields::Field::slowing(double h) const
{
    if (def.kind == ForceFieldDef::Kind::Drag) return dragOver(def.strength, h);
    return def.kind == ForceFieldDef::Kind::Buoyancy ? dragOver(def.drag, h) : 0;
}

Vec2 ForceFields::Field::acceleration(const Vec2& at, const Vec2& velocity, const Vec2& weight, double h) const
{
    switch (def.kind) {
    case ForceFieldDef::Kind::Directional: return def.vector;
    case ForceFieldDef::Kind::Drag: return slowing(h) * (def.vector - velocity);
    case ForceFieldDef::Kind::Buoyancy: return -def.strength * weight - slowing(h) * velocity;
    case ForceFieldDef::Kind::Radial:
    case ForceFieldDef::Kind::Vortex: break;
    }
    // What passes the centre within the step is drawn to and fro there: the mean over its way, else it gains energy.
    const bool passes = velocity.norm() * h > (at - def.centre).norm() / 4;
    const int looks = passes ? kLooks : 1;
    Vec2 sum(0, 0);
    for (int i = 0; i < looks; ++i) {
        const Vec2 arm = at + (passes ? (i + 0.5) * h / looks : 0) * velocity - def.centre;
        const double distance = arm.norm();
        if (distance > 0) sum += fading(distance, def.reach) / (looks * distance) * arm;
    }
    return def.strength * (def.kind == ForceFieldDef::Kind::Radial ? sum : perpendicular(sum));
}

/// Of a field on a body.
struct ForceFields::Pull {
    State& state;
    const Field& field;
    const BodyRecord& body;
    Vec2 weight;
    double h = 0;

    /// At a point that moves with the node; `moment`: mass units², about that point.
    void at(Index node, const Vec2& place, double mass, double moment = 0) const
    {
        Nodes& nodes = state.nodes;
        const Vec2 lever = place - nodes.position[node];
        const Vec2 force = mass * field.acceleration(place, nodes.velocityAt(node, lever), weight, h);
        nodes.force.add(node, force);
        nodes.torque.add(node, cross(lever, force));
        if (moment > 0) nodes.torque.add(node, -(field.slowing(h) * moment * nodes.omega[node]));
    }
    void atIfCovered(Index node, const Vec2& place, double mass) const
    {
        if (field.covers(place)) at(node, place, mass);
    }
    /// On a convex surface of mass / units².
    void on(const Surface& surface, double density) const
    {
        const Index node = body.nodes.first;
        const Moments m = momentsOf(surface);
        if (!(m.area > 0)) return;
        if (field.isLinear()) return at(node, m.centroid, density * m.area, density * m.second);
        // Three points of each triangle about the middle: exact for what is quadratic.
        for (int i = 0; i < surface.count; ++i) {
            const Vec2 &a = surface.points[static_cast<std::size_t>(i)],
                       &b = surface.points[static_cast<std::size_t>((i + 1) % surface.count)];
            const double mass = density * std::abs(cross(a - m.centroid, b - m.centroid)) / 6;
            for (const Vec2& middle : {Vec2(0.5 * (a + b)), Vec2(0.5 * (b + m.centroid)), Vec2(0.5 * (m.centroid + a))})
                at(node, middle, mass);
        }
    }
};

void ForceFields::actOnSurface(Pull& pull, std::span<const Part> parts)
{
    const Index node = pull.body.nodes.first;
    const Vec2 centre = pull.state.nodes.position[node], turn = pull.state.nodes.rotation[node];
    double area = 0;
    for (const Part& part : parts) area += momentsOf(surfaceOf(part, Vec2(0, 0), Vec2(1, 0))).area;
    if (!(area > 0)) return pull.atIfCovered(node, centre, pull.state.massOf(pull.body));
    const double density = pull.state.massOf(pull.body) / area;
    for (const Part& part : parts) {
        const Surface surface = surfaceOf(part, centre, turn);
        if (pull.field.def.region.empty()) {
            pull.on(surface, density);
            continue;
        }
        const Box box = boxOf(surface);
        for (const Piece& piece : pull.field.pieces) {
            if (!piece.box.intersects(box)) continue;
            const Surface inside = clipped(surface, piece.corners);
            if (inside.count > 2) pull.on(inside, density);
        }
    }
}

void ForceFields::act(State& state, const RigidStage& rigid, const Field& field, Index handle, const Vec2& weight,
                      double h)
{
    const BodyRecord& body = state.bodies[handle];
    const Nodes& nodes = state.nodes;
    Pull pull{state, field, body, weight, h};
    const Index first = body.nodes.first;
    if (body.asleep) {
        return;
    } else if (!body.rigid) {
        for (Index n = first; n < body.nodes.end(); ++n) pull.atIfCovered(n, nodes.position[n], nodes.mass[n]);
    } else if (nodes.invMass[first] == 0) {
        return;
    } else if (rigid.has(handle)) {
        actOnSurface(pull, rigid.convexPartsOf(handle));
    } else if (body.points.count == 0) {
        pull.atIfCovered(first, nodes.position[first], state.massOf(body));
    } else {
        for (Index p = body.points.first; p < body.points.end(); ++p)
            pull.atIfCovered(first, state.pointNow(p), state.massOf(body) / body.points.count);
    }
}

void ForceFields::addForces(State& state, const RigidStage& rigid, const Vec2& gravity, double h) const
{
    for (const Field& field : fields_) {
        if (field.removed) continue;
        for (Index handle = 0; handle < state.bodies.size(); ++handle) {
            const BodyRecord& body = state.bodies[handle];
            if (!body.fixed) act(state, rigid, field, handle, body.gravityScale * gravity, h);
        }
    }
}

}  // namespace jet::physics
