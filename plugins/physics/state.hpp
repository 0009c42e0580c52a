// The world's data as structures of arrays, shared by the stages of a step.
//
// A node is what moves: a particle of a soft body, or the centre of mass of a rigid body. Only rigid nodes turn.
// A point is what collides: a particle, or a vertex of a rigid border; it rides on a node at a fixed local offset.
// A wall joins two points of one border. Handles of bodies, nodes, points and walls are indices into these arrays.
#pragma once

#include "column.hpp"
#include "edge_grid.hpp"
#include "rigid/pool.hpp"
#include "soft/cloud_kernels.hpp"
#include "trigonometry.hpp"

#include <jet/physics.hpp>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace jet::physics {

using Index = std::uint32_t;
inline constexpr Index kNone = 0xffffffffU;

struct Nodes {
    std::vector<Vec2> position;   // scene units
    std::vector<Vec2> velocity;   // units / s
    std::vector<double> mass;     // mass units
    std::vector<double> invMass;  // 0: never moves
    // Only rows up to that of the last rigid body; torques, and forces of all, once there are any.
    Column<double> angle{0};            // radians since the start; 0 for particles
    Column<double> omega{0};            // rad / s; 0 for particles
    Column<Vec2> rotation{Vec2(1, 0)};  // (cos, sin) of angle
    Column<double> invInertia{0};       // 0: never turns
    Column<double> torque{0};
    Column<Vec2> force{Vec2(0, 0)};  // of applyForce and actuators, for this step

    std::size_t size() const { return position.size(); }
    void addParticle(const Vec2& at, double nodeMass, double inverseMass);
    /// One that may turn, and does not move yet.
    void addRigid(double nodeMass);
    /// Room for forces and torques on all.
    void coverForces() { force.cover(size()), torque.cover(rotation.size()); }

    Vec2 velocityAt(Index node, const Vec2& arm) const { return velocity[node] + omega[node] * perpendicular(arm); }
    void applyImpulse(Index node, const Vec2& arm, const Vec2& impulse)
    {
        velocity[node] += invMass[node] * impulse;
        omega.add(node, invInertia[node] * cross(arm, impulse));
    }
};

struct Points {
    std::vector<Index> node;
    Column<Vec2> local{
        Vec2(0, 0)};             // from the node, in its frame; zero for particles, which have rows only before others
    std::vector<Vec2> position;  // scene units; true after updatePoints()
    // [points] unit, out of the body at this point, in the frame of its grid; zero when unknown. Empty as long as
    // nobody is met by points and walls.
    std::vector<Vec2> normal;
    std::vector<std::uint8_t> collidable;  // is it tested against other bodies?

    std::size_t size() const { return node.size(); }
};

/// How far a wall is felt beyond its end: past a blunt corner (so that nothing slips through the gap between two
/// walls), but not up to a sharp one (so that a body sliding over it is not caught by the wall behind the corner).
enum class WallEnd : std::int8_t { Sharp = -1, Blunt = 1 };

struct Walls {
    std::vector<Index> first, second;   // points
    std::vector<Index> previous, next;  // walls of the same border
    std::vector<std::int8_t> outward;   // +1: outside lies at perpendicular(second - first); -1: opposite; 0: no wall
    std::vector<WallEnd> firstEnd, secondEnd;

    std::size_t size() const { return first.size(); }
};

struct Range {
    Index first = 0, count = 0;
    Index end() const { return first + count; }
};

/// How a soft body moved between the last looks at it: slumber.hpp.
struct RestWatch {
    bool mayRest = true, drawnMayRest = true;
    std::uint8_t looks = 0;             // 1: one speed is known; 2: places; from 3 on it was slow, from 4 on in balance
    float speed = 0;                    // units / s, at which it may come away from its places
    float slid = 0;                     // quanta that the fastest particle moved between the last two looks at places
    double quantum = 0;                 // units
    std::vector<std::uint16_t> places;  // [2 nodes] quanta modulo 2^16: at the last look, or foretold for the next
};

/// What only soft bodies have.
struct SoftRecord {
    SoftMatter matter;
    double mass = 0;
    double restArea = 0;            // inside the borders at rest, units²
    Range springs, angularSprings;  // into SoftSprings
    bool open = false;              // torn at its border, which lets gas out
    bool inOrder = false;           // its points lie as its nodes do
    Index pieceCount = 1;
    std::vector<Index> pieces;          // [particles] of a torn body; empty: whole
    std::vector<Vec2> restArms;         // particles from the centre of mass at rest
    Vec2 twinTurn = Vec2(1, 0);         // (cos, sin) of the twin's angle; stays while no angle fits better than others
    double twinRate = 0, twinLoss = 0;  // as soft/twins.hpp prepared them for the substep at hand
    double restGyrationSquared = 0;     // of the shape at rest, units²
    RestWatch watch;
    Vec2 fit = Vec2(0, 0);  // (sum m q·p, sum m q×p) as last read, q at rest and p now from the centre: see CloudSums

    /// (cos, sin) of the angle by which the shape at rest fits best; null where no angle fits better than others, as
    /// where the body is turned inside out.
    Vec2 bestTurn() const { return bestTurn(fit); }
    Vec2 bestTurn(const Vec2& sums) const
    {
        constexpr double kLeastFit = 0.2;  // of that at rest
        const double size = sums.norm();
        return size > kLeastFit * restGyrationSquared * mass ? Vec2(sums / size) : Vec2(0, 0);
    }
};

struct BodyRecord {
    bool rigid : 1 = false, fixed : 1 = false, sensor : 1 = false;
    bool simple : 1 = false;     // rigid, of convex parts: meets its like in rigid/, not by points and walls
    bool single : 1 = false;     // simple, of one shape, and may move: its part tells its outline
    bool wide : 1 = false;       // soft: meets its like in soft/contacts.hpp
    bool kinematic : 1 = false;  // moves with its velocity, and nothing pushes it
    bool enabled : 1 = true;     // may move, meet and be seen
    bool drives : 1 = false;     // kinematic while it is enabled
    bool fixedRotation : 1 = false;
    bool asleep : 1 = false;   // rests, and is left out until something wakes it
    bool stands : 1 = false;   // as of this step: fixed, or kinematic and not moving
    bool removed : 1 = false;  // its place is free for another
    bool flown : 1 = false;    // soft: nothing else acts on it, and it has been moved for all of the step at hand
    Index material = 0;
    std::uint32_t layer = 1;
    Range nodes, points, walls;
    float radius = 0;   // rigid: farthest point from the centre, scene units
    double length = 1;  // typical size, scene units: tolerances are fractions of it
    double gravityScale = 1;
    std::unique_ptr<SoftRecord> soft;  // of soft bodies
    // Rigid: in the node's frame, and null until gridOf() is asked; soft: in the scene's, as of the last detection.
    mutable std::unique_ptr<EdgeGrid> grid;

    /// Has it no points and walls, as nobody needs them?
    bool isLean() const { return single && points.count == 0; }
    double thickness() const { return soft ? soft->matter.thickness : 0; }
    /// Is each of its particles sprung to its place in a rigid twin (soft/twins.hpp)?
    bool hasTwin() const
    {
        return soft && !fixed && !kinematic && soft->matter.shapeStiffness > 0 && soft->restGyrationSquared > 0;
    }
    /// Does its border meet itself, or one of its pieces another?
    bool meetsOwn() const { return soft && (soft->matter.selfCollision || soft->pieceCount > 1); }
};

/// Whom a body meets, beside its layer, and from which side.
struct Filter {
    std::uint32_t mask = ~0U, group = 0;
    double sideX = 0, sideY = 0;  // unit, out of a one-sided platform; null: from all

    static Filter of(const BodyCommon& common)
    {
        const double length = common.oneSided.norm();
        if (!(length > 0)) return {common.mask, common.group};
        return {common.mask, common.group, common.oneSided.x() / length, common.oneSided.y() / length};
    }
    Vec2 side() const { return {sideX, sideY}; }
    bool isOneSided() const { return sideX != 0 || sideY != 0; }
    friend bool operator==(const Filter&, const Filter&) = default;
};

/// What is read after a step, one entry a body. Where nothing goes by points and walls, nodes are bodies, and say the
/// first four; the others are made for who looks at them.
struct BodyReadings {
    std::vector<Vec2> position, velocity;
    std::vector<double> angle, omega;
    std::vector<Box> bounds;
    std::vector<Index> firstPoint{0};  // [bodies + 1]
};

/// Room that is used again each step. Not thread-local: a destructor of a thread would keep the library in memory.
struct Scratch {
    /// Where a body may come in the coming step, for the search for pairs.
    struct Reach {
        double left, right, top, bottom;  // scene units
        Index body;
        bool stands, simple;
    };
    std::vector<Reach> reaches;
    std::vector<Index> candidates;
    std::vector<EdgeGrid::Edge> edges;
    std::vector<Vec2> gradient;
};

struct State {
    Nodes nodes;
    Points points;
    Walls walls;
    std::vector<BodyRecord> bodies;
    Column<Filter> filters{Filter()};  // rows up to that of the last body that does not meet all
    BodyReadings readings;
    mutable Scratch scratch;  // holds nothing between calls
    const soft::CloudKernels* clouds = &soft::sse2::clouds;
    Pool* pool = nullptr;  // of the step, where threads are of use

    /// Calls work(block) for each block below `blocks`, at once and in any order: its results must not depend on that.
    template <class Work>
    void run(std::size_t blocks, Work&& work) const
    {
        if (pool) return pool->run(blocks, work);
        for (std::size_t block = 0; block < blocks; ++block) work(block);
    }

    /// Do their layers, masks and groups let them meet?
    bool mayMeet(Index a, Index b) const
    {
        const Filter filterA = filters[a], filterB = filters[b];
        if (filterA.group != 0 && filterA.group == filterB.group) return false;
        return (bodies[a].layer & filterB.mask) != 0 && (bodies[b].layer & filterA.mask) != 0;
    }
    void setFilter(Index body, const Filter& filter)
    {
        if (filter == filters[body]) return;
        filters.cover(body + 1);
        filters.edit(body) = filter;
    }
    /// Does one of them sleep, and the other sleep or stand? Then nothing happens between them.
    bool atRest(Index a, Index b) const
    {
        const BodyRecord &first = bodies[a], &second = bodies[b];
        return (first.asleep && (second.asleep || second.stands)) || (second.asleep && first.stands);
    }
    /// Is it kinematic, and under way?
    bool isDriven(const BodyRecord& body) const
    {
        if (!body.kinematic) return false;
        for (Index n = body.nodes.first; n < body.nodes.end(); ++n)
            if (nodes.velocity[n] != Vec2(0, 0) || nodes.omega[n] != 0) return true;
        return false;
    }
    Vec2 pointNow(Index point) const
    {
        const Index node = points.node[point];
        return nodes.position[node] + rotated(nodes.rotation[node], points.local[point]);
    }
    double massOf(const BodyRecord& body) const { return body.soft ? body.soft->mass : nodes.mass[body.nodes.first]; }
    /// Wall ends in the frame of the body's grid.
    const std::vector<Vec2>& gridFrame(const BodyRecord& body) const
    {
        return body.rigid ? points.local.values() : points.position;
    }
};

/// Moves the newest body, that has no stage yet, to the place of a removed one with ranges as long; its ranges go.
void moveNewest(State&, Index to);
/// Gives back the room there is to spare.
void fitRoom(State&);
std::size_t bytesOf(const State&);
/// Moves the points after their nodes.
void updatePoints(State&);
/// Centre, angle, velocity, turning rate and box of each body, from its nodes and points.
void updateReadings(State&);
void updateReading(State&, Index body);

}  // namespace jet::physics
