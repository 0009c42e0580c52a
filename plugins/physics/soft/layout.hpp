// How a soft body lies in memory: in which order its particles, and which springs are computed side by side.
//
// Springs whose two ends both lie 8 in a row need no gathering: that is a run. Lattices have many of them as soon as
// their particles are numbered row by row, for then all springs of one direction join nodes of one index difference.
// So several orders are tried and the one with the most springs in runs is taken. Colouring the springs (so that no two
// of a group share a particle) was the alternative: needed where springs act on velocities one after the other, but
// then every spring gathers.
#pragma once

#include "kernels.hpp"

#include <jet/physics.hpp>

#include <vector>

namespace jet::physics::soft {

struct Ends {
    std::uint32_t a = 0, b = 0;  ///< nodes, counted from the body's first
};

/// How the springs of a regular lattice lie: in runs alone, of a few differences of index, as where all rows are as
/// long.
struct Pattern {
    std::vector<std::uint32_t> differences;  ///< b - a, ascending; empty: no pattern
    std::vector<std::uint8_t> present;       ///< [nodes / 8] bit k: a run of differences[k] starts at these 8 nodes
};

struct Blocks {
    std::vector<Run> runs;
    std::vector<std::uint32_t> ends;  ///< of scattered springs, see SpringBlocks
    std::vector<std::uint32_t> seat;  ///< [springs] block * 8 + lane
    std::uint32_t reach = 0;          ///< nodes from the first of a block to the last, at most
    Pattern pattern;

    std::size_t count() const { return runs.size() + ends.size() / (2 * kLanes); }
};

/// Particle of each node: order[node]. A permutation.
std::vector<std::uint32_t> orderOf(const SoftBodyDef&);

/// Seats for the springs; a run holds at least 5, but where there is a pattern.
Blocks arrange(const std::vector<Ends>& springs, std::uint32_t nodes);

}  // namespace jet::physics::soft
