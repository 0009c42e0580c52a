// The flight of a body that nothing but its springs, gravity and damping acts on for a whole step: all substeps in one
// go, in single.
//
// Substep by substep, a body would be read from and written to double each time. Here only what changes is counted,
// from the body's state at the start of the step: D, what velocities have gained, and H, how far nodes are from where
// they would have come at their first velocities. Both are small, so single keeps them better than the forces are known
// (their lengths are single, too), and the velocities and places in double get them added once.
//
//   D += kept h (g + f / m) + (kept - 1) v,  H += h D;  at the end of the flight of t:  x += t v + H, v += D
//
// What rounding leaves of forces that sum to nothing is taken out at the end: the momentum a free body must have is
// known in closed form, and so is the way of its centre of mass.
//
// A flight is an attempt: if a spring may tear, the body moves further than expected, or numbers get out of hand, it is
// given up, nothing has changed, and the body goes substep by substep.
//
// Springs are computed as in kernels.hpp, whole rows at once where nothing speaks against it. Here each block's forces
// are kept apart, in a ring that stays near in the cache, and a node gathers those that pull at it when all are known:
// sums in memory would overlap from one run to the next, and each wait for the one before. This needs a Pattern
// (layout.hpp).
#pragma once

#include "kernels.hpp"

namespace jet::physics::soft {

/// Nodes that are moved together where the processor can.
inline constexpr std::size_t kFlightLanes = 16;
/// What a flight is made of, for so many nodes: changes of velocity D along x and y, ways H, inverse masses.
inline constexpr std::size_t kFlightRow = 5 * kFlightLanes;

/// A body in flight. Room for 8 nodes more than it has.
struct FlightPlanes {
    enum Plane : std::size_t { X, Y, Vx, Vy, kCount };

    float* first;        ///< plane X: units from the frame, which moves uniformly
    std::size_t stride;  ///< from each plane to the next
    float* rows;         ///< [nodes / kFlightLanes][kFlightRow]

    /// D along x of a node; the others follow, kFlightLanes apart.
    float* row(std::size_t node) const { return rows + node / kFlightLanes * kFlightRow + node % kFlightLanes; }
};

/// Forces not yet gathered: for each difference and the sums of blocks at their first nodes, planes along x and y.
struct FlightRing {
    float* first;      ///< [2 (differences + 1)][stride()]: the first kFlightLanes stand at the end once more
    std::size_t size;  ///< nodes, a power of two

    std::size_t stride() const { return size + kFlightLanes; }
    /// Nodes it must hold for blocks of that reach.
    static std::size_t sizeFor(std::size_t reach)
    {
        std::size_t size = 64;
        while (size < reach + kPortion + headFor(reach)) size *= 2;
        return size;
    }
};

/// The springs' pattern, see Pattern; at most kMostDifferences.
struct FlightPattern {
    const std::uint32_t* differences;
    std::size_t count;
    const std::uint8_t* present;
};

/// One substep.
struct FlightStep {
    float h = 0, pushed = 0;  ///< seconds; h, times the part of the velocity that damping leaves
    float lost = 0;           ///< that part - 1
    float gravityX = 0, gravityY = 0;
    float frameVx = 0, frameVy = 0;
    bool first = false;  ///< of the flight: D and H are not yet there
};

/// What became of a part of a body.
struct FlightSurvey {
    double farthest = 0;            ///< greatest |H|, units
    double fastest = 0;             ///< greatest velocity from the frame, units / s; not a number where any is not
    double gainX = 0, gainY = 0;    ///< sum m D
    double wayX = 0, wayY = 0;      ///< sum m H
    double startX = 0, startY = 0;  ///< sum m v at the start
};

/// Added to all nodes alike.
struct FlightReturn {
    double wayX = 0, wayY = 0, gainX = 0, gainY = 0;
};

struct FlightKernels {
    /// Fills the planes of a part, but for D and H; true if any of its nodes never moves.
    bool (*takeOff)(const NodeArrays&, const Frame&, const FlightPlanes&, std::size_t first, std::size_t end);
    /// A substep of a part, but for the nodes of its head; returns how many blocks it put into SpringBlocks::torn.
    std::size_t (*fly)(const SpringBlocks&, const FlightPattern&, const FlightStep&, const FlightPlanes&,
                       const FlightRing&, const Stretch&);
    /// Then moves the head, which the part before has spilt forces on.
    void (*flyHead)(const FlightStep&, const FlightPlanes&, const Stretch&, const float* spilt);
    /// `free`: are the sums asked for?
    FlightSurvey (*survey)(const NodeArrays&, const double* mass, const FlightPlanes&, bool free, std::size_t first,
                           std::size_t end);
    /// Adds what a flight of `t` seconds brought.
    void (*land)(double* position, double* velocity, const FlightPlanes&, double t, const FlightReturn&,
                 std::size_t first, std::size_t end);
};

}  // namespace jet::physics::soft
