// Soft bodies that move as wholes: kinematic ones, and those that never turn.
//
// What never turns has its angular momentum taken out wherever velocities were changed. That alone would let it turn by
// changing its shape, as a falling cat does; so after it moved it is turned back to the angle by which its shape at
// rest fitted best before (shape_memory.hpp), positions and velocities alike, which neither strains nor pushes it.
#pragma once

#include "mass_sums.hpp"
#include "state.hpp"

#include <span>

namespace jet::physics::soft {

/// How a kinematic body moves: all its particles, pinned or not, have a say.
inline MassSums motionOf(const State& state, const BodyRecord& body)
{
    return body.kinematic ? massSums(state.nodes, body.nodes) : freeSums(state.nodes, body.nodes);
}

/// Makes its velocities those of a rigid motion.
void stiffen(State&, const BodyRecord&);

class Wholes {
public:
    /// At the start of a step. Those with pins are kept from turning, but not turned back; pieces of torn ones turn.
    void gather(const State&);
    /// Velocities have changed, if only by damping.
    void keep(State&) const;
    /// Positions will change, and have changed by h seconds; those of kinematic ones change now.
    void begin(const State&);
    void end(State&, double h) const;

private:
    struct Kinematic {
        Index handle;
        Vec2 velocity;
        double omega;
    };
    /// One that never turns.
    struct Upright {
        Index handle;
        bool pinned;
        Range free;              // into free_
        Vec2 turn = Vec2(1, 0);  // (cos, sin) of the best fit
    };
    MassSums sums(const State&, const Upright&) const;
    std::span<const Index> freeOf(const Upright& body) const
    {
        return std::span(free_).subspan(body.free.first, body.free.count);
    }

    std::vector<Kinematic> kinematic_;
    std::vector<Upright> upright_;
    std::vector<Index> free_;  // nodes
};

}  // namespace jet::physics::soft
