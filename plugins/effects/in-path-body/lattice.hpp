// The lattice of a soft body (thesis §3.5.2.1): particles along the outline of a path and on a grid inside it, joined
// by springs. Any closed Bézier path will do: concave, with holes, of several pieces.
//
//   border ─ rings of particles on the outline; their neighbours are joined by walls, which are what collides
//   inside ─ particles on a grid, strictly inside the rings and clear of the walls
//   springs ─ along the rings, between grid neighbours, and from each border particle to the nearest inside particles
//   it sees
//
// What holds for every lattice:
// - "inside" is what physics means by it: inside an odd number of rings;
// - no spring leaves the shape, but for those between neighbours of a ring, which lie on its walls;
// - no two springs join the same particles, and none has length zero;
// - an inside particle hangs on the border, if through others: one that does not would fall out of its body, and is
// left out.
#pragma once

#include "region.hpp"

#include <jet/path.hpp>

#include <cstdint>
#include <vector>

namespace jet::lattice {

inline constexpr std::size_t kMostParticles = 20'000;
inline constexpr std::size_t kMostSprings = 500'000;

/// Distances in steps along a ring or a grid: <1, 2> joins each particle with the next and with the next but one.
struct Steps {
    int from = 1, to = 2;
};

struct Options {
    bool borderOnSegments = true;  ///< border particles on segments and intermediate points; else borderCount, evenly
    int borderCount = 10;          ///< shared among the contours by length, at least 3 each
    bool borderSprings = true;
    Steps border;
    int borderToInside = 3;                 ///< springs from each border particle to inside particles
    bool axisAligned = true, cross = true;  ///< inside springs; with neither there are no inside particles
    Steps inside;
    Vec2 cell;  ///< width and height of a grid cell, scene units; 0: as the other; both 0: chosen from the outline
};

enum class SpringKind : std::uint8_t { Border, Inside, BorderToInside };

struct Spring {
    std::uint32_t a = 0, b = 0;  ///< particle indices
    SpringKind kind = SpringKind::Border;
};

struct Lattice {
    std::vector<Vec2> particles;                    ///< border particles ring by ring, then inside ones row by row
    std::size_t borderCount = 0;                    ///< how many of them are border particles
    std::vector<std::vector<std::uint32_t>> rings;  ///< the border: closed rings of particle indices
    std::vector<Spring> springs;                    ///< by kind, in the order of SpringKind
    Vec2 cell;                                      ///< the grid cell used

    std::size_t insideCount() const { return particles.size() - borderCount; }
};

/// Throws Failure when the outline encloses no area, or when the lattice would exceed kMostParticles or kMostSprings.
Lattice build(const Path& path, const Options& options);

}  // namespace jet::lattice
