#include "state.hpp"

#include "room.hpp"
#include "speed_limit.hpp"
#include "told.hpp"

#include <algorithm>

namespace jet::physics {

void Nodes::addParticle(const Vec2& at, double nodeMass, double inverseMass)
{
    position.push_back(at);
    velocity.push_back(Vec2(0, 0));
    mass.push_back(nodeMass);
    invMass.push_back(inverseMass);
}

void Nodes::addRigid(double nodeMass)
{
    addParticle(Vec2(0, 0), nodeMass, 0);
    for (Column<double>* column : {&angle, &omega, &invInertia}) column->cover(size());
    rotation.cover(size());
}

namespace {

/// Moves the last rows to others, and ends the vector before them.
template <class T>
void moveLast(std::vector<T>& rows, Range from, Index to)
{
    if (rows.size() < from.end()) return;  // it has none of anybody
    std::copy_n(rows.begin() + from.first, from.count, rows.begin() + to);
    rows.resize(from.first);
}
template <class T>
void moveLast(Column<T>& rows, Range from, Index to)
{
    for (Index i = 0; i < from.count; ++i) rows.set(to + i, rows[from.first + i]);
    rows.cut(from.first);
}

void moveLast(Walls& walls, Range from, Index to, Index pointsBack)
{
    const Index back = from.first - to;
    for (Index w = from.first; w < from.end(); ++w) {
        walls.first[w] -= pointsBack, walls.second[w] -= pointsBack;
        walls.previous[w] -= back, walls.next[w] -= back;
    }
    moveLast(walls.first, from, to), moveLast(walls.second, from, to);
    moveLast(walls.previous, from, to), moveLast(walls.next, from, to);
    moveLast(walls.outward, from, to), moveLast(walls.firstEnd, from, to), moveLast(walls.secondEnd, from, to);
}

}  // namespace

void moveNewest(State& state, Index to)
{
    BodyRecord body = std::move(state.bodies.back());
    const auto handle = static_cast<Index>(state.bodies.size() - 1);
    state.bodies.pop_back();
    state.setFilter(to, state.filters[handle]);
    state.filters.cut(handle);
    const BodyRecord& place = state.bodies[to];
    Nodes& nodes = state.nodes;
    moveLast(nodes.position, body.nodes, place.nodes.first), moveLast(nodes.velocity, body.nodes, place.nodes.first);
    moveLast(nodes.mass, body.nodes, place.nodes.first), moveLast(nodes.invMass, body.nodes, place.nodes.first);
    for (Column<double>* column : {&nodes.angle, &nodes.omega, &nodes.invInertia, &nodes.torque})
        moveLast(*column, body.nodes, place.nodes.first);
    moveLast(nodes.rotation, body.nodes, place.nodes.first), moveLast(nodes.force, body.nodes, place.nodes.first);
    Points& points = state.points;
    for (Index p = body.points.first; p < body.points.end(); ++p)
        points.node[p] -= body.nodes.first - place.nodes.first;
    moveLast(points.node, body.points, place.points.first), moveLast(points.local, body.points, place.points.first);
    moveLast(points.position, body.points, place.points.first);
    if (!points.normal.empty()) moveLast(points.normal, body.points, place.points.first);
    moveLast(points.collidable, body.points, place.points.first);
    moveLast(state.walls, body.walls, place.walls.first, body.points.first - place.points.first);
    body.nodes.first = place.nodes.first, body.points.first = place.points.first;
    body.walls.first = place.walls.first;
    state.bodies[to] = std::move(body);
}

void fitRoom(State& state)
{
    Nodes& nodes = state.nodes;
    fitRoom(nodes.position, nodes.velocity, nodes.mass, nodes.invMass, state.bodies);
    nodes.angle.fit(), nodes.omega.fit(), nodes.rotation.fit(), nodes.invInertia.fit();
    Points& points = state.points;
    fitRoom(points.node, points.position, points.normal, points.collidable);
    points.local.fit();
    Walls& walls = state.walls;
    fitRoom(walls.first, walls.second, walls.previous, walls.next, walls.outward, walls.firstEnd, walls.secondEnd);
}

std::size_t bytesOf(const State& state)
{
    const Nodes& nodes = state.nodes;
    const Points& points = state.points;
    const Walls& walls = state.walls;
    const BodyReadings& readings = state.readings;
    std::size_t sum =
        roomOf(nodes.position, nodes.velocity, nodes.mass, nodes.invMass, nodes.angle, nodes.omega, nodes.rotation,
               nodes.invInertia, nodes.torque, nodes.force) +
        roomOf(points.node, points.local, points.position, points.normal, points.collidable) +
        roomOf(walls.first, walls.second, walls.previous, walls.next, walls.outward, walls.firstEnd, walls.secondEnd) +
        roomOf(readings.position, readings.velocity, readings.angle, readings.omega, readings.bounds,
               readings.firstPoint) +
        roomOf(state.bodies);
    for (const BodyRecord& body : state.bodies)
        if (body.soft)
            sum += sizeof(SoftRecord) + roomOf(body.soft->pieces, body.soft->restArms, body.soft->watch.places);
    return sum;
}

void updatePoints(State& state)
{
    Points& points = state.points;
    for (const BodyRecord& body : state.bodies) {
        if (body.rigid) {
            for (Index p = body.points.first; p < body.points.end(); ++p) points.position[p] = state.pointNow(p);
        } else {
            constexpr std::size_t kTogether = 4096;
            state.run((body.points.count + kTogether - 1) / kTogether, [&](std::size_t block) {
                const std::size_t first = body.points.first + block * kTogether;
                const std::size_t end = std::min<std::size_t>(body.points.end(), first + kTogether);
                const auto now = state.nodes.position.begin();
                if (body.soft->inOrder)
                    std::copy_n(now + points.node[first], end - first, points.position.begin() + first);
                else
                    for (std::size_t p = first; p < end; ++p) points.position[p] = now[points.node[p]];
            });
        }
    }
}

namespace {

// Speeds are limited where they move something; what joints and contacts make of them after that may have run away.

void limitSpeeds(Nodes& nodes, Range particles)
{
    double turning = 0;
    for (Index n = particles.first; n < particles.end(); ++n) limitSpeed(nodes.velocity[n], turning);
}

void readRigid(State& state, Index handle)
{
    Nodes& nodes = state.nodes;
    const Index node = state.bodies[handle].nodes.first;
    if (!isFinite(nodes.velocity[node]) || !std::isfinite(nodes.omega[node]))
        limitSpeed(nodes.velocity[node], nodes.omega.edit(node));
    state.readings.position[handle] = nodes.position[node];
    state.readings.velocity[handle] = nodes.velocity[node];
    state.readings.angle[handle] = nodes.angle[node];
    state.readings.omega[handle] = nodes.omega[node];
}

soft::CloudSums sumsOf(const State& state, const BodyRecord& body)
{
    const Index first = body.nodes.first;
    return state.clouds->sums({state.nodes.position[first].data(), state.nodes.velocity[first].data(),
                               &state.nodes.mass[first], body.soft->restArms[0].data(), body.nodes.count});
}

/// Best fit of a rigid motion: the angle that maximises sum m (R rest)·now, the rate that carries the angular momentum.
void readSoft(State& state, Index handle)
{
    const BodyRecord& body = state.bodies[handle];
    if (body.nodes.count == 0) return;
    soft::CloudSums sums = sumsOf(state, body);
    if (!std::isfinite(sums.vx) || !std::isfinite(sums.vy) || !std::isfinite(sums.momentum)) {
        limitSpeeds(state.nodes, body.nodes);
        sums = sumsOf(state, body);
    }
    double& angle = state.readings.angle[handle];
    // Of what was before only the whole turns count, so that a restored state reads the same bits.
    body.soft->fit = {sums.along, sums.across};
    const double fit = angleOf(sums.across, sums.along);
    angle = fit + 2 * kPi * std::round((angle - fit) / (2 * kPi));
    state.readings.position[handle] = {sums.x, sums.y};
    state.readings.velocity[handle] = {sums.vx, sums.vy};
    state.readings.omega[handle] = told(sums.omega());
    state.readings.bounds[handle] = {Vec2(sums.lowest[0], sums.lowest[1]), Vec2(sums.greatest[0], sums.greatest[1])};
}

}  // namespace

void updateReading(State& state, Index handle)
{
    const BodyRecord& body = state.bodies[handle];
    if (body.removed) {
        state.readings.velocity[handle] = Vec2(0, 0), state.readings.omega[handle] = 0;
        state.readings.bounds[handle] = Box();
        return;
    }
    if (!body.rigid) return readSoft(state, handle);
    readRigid(state, handle);
    Box& bounds = state.readings.bounds[handle];
    bounds = Box();
    for (Index p = body.points.first; p < body.points.end(); ++p) bounds.extend(state.points.position[p]);
    if (body.points.count == 0) bounds.extend(state.readings.position[handle]);
}

void updateReadings(State& state)
{
    for (Index handle = 0; handle < state.bodies.size(); ++handle) updateReading(state, handle);
}

}  // namespace jet::physics
