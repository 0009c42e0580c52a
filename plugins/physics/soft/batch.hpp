// Which soft bodies are computed together: one whose springs form runs, or up to eight alike, a lane each.
//
// Copies of one body are what scenes are made of, and most bodies are too small or too round for runs of springs of one
// index difference. Bodies are alike when they have as many particles and springs between the same of them, in the same
// order; lengths, stiffnesses and masses may differ.
#pragma once

#include "layout.hpp"
#include "state.hpp"

#include <vector>

namespace jet::physics::soft {

/// Fewer bodies alike than this are computed one by one.
inline constexpr std::size_t kLeastAlike = 3;

struct Batch {
    std::vector<Index> bodies;  // one, or one a lane
    Index rows = 0;             // nodes of one body
    std::vector<Index> nodeAt;  // [rows * 8] of bodies alike; lanes without a body stand for the first. Empty: one body
    Blocks blocks;  // of bodies alike: runs alone, each of one spring of every body; seats are those of lane 0
    std::vector<Stretch> parts;  // of one large body, that are computed apart; else one that is all of it
    // See SpringBlocks. tear is empty where none tears.
    std::vector<float> rest, tear;
    std::vector<std::uint32_t> kind;  // [blocks]
    std::vector<float> kinds;         // [][2][8]
    std::uint32_t shared = 0;         // kinds that may be of several blocks; those behind are of one each

    bool alike() const { return !nodeAt.empty(); }
    /// May it fly (soft/flight.hpp)?
    bool flies() const { return !blocks.pattern.differences.empty(); }
    /// Nodes the planes hold at a time.
    std::size_t room() const { return alike() ? std::size_t{rows} * kLanes : roomFor(rows, blocks.reach); }
    /// block * 8 + lane of the body's spring
    std::uint32_t seat(std::uint32_t lane, std::uint32_t spring) const { return blocks.seat[spring] + lane; }
    /// Are there so many springs to gather that all particles are also kept as x y vx vy?
    bool gathers() const { return 2 * blocks.ends.size() > rows; }
    /// Divides a large body. How is up to the body alone: bits must not depend on threads.
    void divide();
    /// Before the springs are filled in: each block gets a kind of its own.
    void part();
    /// Afterwards: what is equal is kept once.
    void share();
    /// Stiffness of the spring in that seat; its damping follows 8 further on.
    float* spring(std::uint32_t seat) { return &kinds[std::size_t{kind[seat / kLanes]} * 2 * kLanes + seat % kLanes]; }
    float spring(std::uint32_t seat) const
    {
        return kinds[std::size_t{kind[seat / kLanes]} * 2 * kLanes + seat % kLanes];
    }
    /// The spring in that seat is no more.
    void cut(std::uint32_t seat);
    std::size_t bytes() const;
};

/// What the springs of a body join, in the order of its particles; equal for bodies alike.
struct Topology {
    Index particles = 0;
    std::uint64_t hash = 0;

    static Topology of(const SoftBodyDef&);
    bool operator==(const Topology& other) const { return particles == other.particles && hash == other.hash; }
};

/// A body to be computed wide, and its springs, between nodes counted from its first.
struct Candidate {
    Index body = 0;
    Topology topology;
    std::vector<Ends> ends;
};

/// Batches for these bodies, in a fixed order. Those of single bodies are taken from `before` where it has them.
std::vector<Batch> batchesOf(const State&, std::vector<Candidate>, std::vector<Batch> before);

}  // namespace jet::physics::soft
