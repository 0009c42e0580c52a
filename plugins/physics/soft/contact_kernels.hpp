// The inner loops of contacts between soft bodies: 8 points at walls at a time (see contacts.hpp).
//
// What is compared with walls is single, on differences of positions and velocities taken in double; what goes to the
// three particles of a contact is one impulse in double, split so that it sums to nothing. The choice of instructions
// and the promise of equal bits are those of kernels.hpp.
#pragma once

#include "rigid/lanes.hpp"

#include <cstddef>
#include <cstdint>

namespace jet::physics::soft {

using Floats = Lanes<float>;
using Flags = LaneTypes<float>::Mask;  // all bits set or none
inline constexpr int kWide = 8;

/// Eight contacts no two of which share a particle.
struct alignas(32) ContactBlock {
    std::int32_t point[kWide]{}, first[kWide]{}, second[kWide]{};  // nodes: the particle, and the ends of the wall
    Floats side{};                                                 // +1, -1: Walls::outward; 0: an empty lane
    Floats thickness{}, slop{};                                    // units
    Floats friction{}, restitution{};
    Floats firstReach{}, secondReach{};          // units the wall is felt beyond its ends; below 0: ends before them
    Floats invPoint{}, invFirst{}, invSecond{};  // inverse masses
    Flags inside{}, engaged{}, still{};          // ContactPoint's; still: one side never moves
    // As of the substep.
    Flags active{};
    Floats normalX{}, normalY{}, separation{}, along{}, mass{}, approach{};
    // What an impulse does to the velocities of the three, 1 / mass, where one is active.
    double ofPoint[kWide]{}, ofFirst[kWide]{}, ofSecond[kWide]{};
    // Carried from substep to substep, mass * unit / s.
    Floats normalImpulse{}, tangentImpulse{}, stepImpulse{};
    Flags far{};     // of those that do not act: may wait long
    Floats drift{};  // units they moved along their walls, and those turned, since they were looked at
};

/// What is asked of each block in each substep; apart from them, as a line of memory holds a dozen.
struct ContactHead {
    std::uint8_t idle = 0;  // substeps in which none of them can become active
    bool any = false;       // is one active?
    bool elastic = false;   // has one of the active ones restitution?
    bool bounces = false;   // is one to be thrown back?
    bool drifted = false;   // has one of the active ones moved so far that it must be looked at again?
    bool uneven = false;    // has one a wall whose ends differ in mass?
};

struct Softness {
    float biasRate, massScale, impulseScale;
};

struct ContactStep {
    float h = 0, inverseH = 0;  // seconds
    float restSpeed = 0;        // units / s: slower impacts do not bounce
    Softness moving{}, still{};
};

/// Eight walls of a body, in single, from an origin of the body.
struct alignas(32) WallBlock {
    Floats x{}, y{}, edgeX{}, edgeY{}, normalX{}, normalY{}, inverseSquare{}, slope{};  // slope: edgeX / edgeY
    float left = 0, top = 0, right = 0, bottom = 0;
};

struct NearQuery {
    float x = 0, y = 0;  // the point, from the same origin
    float reach = 0;     // units around it
    float slide = 0;     // units past the second end of a wall at which that does not hold the point any more
    float behind = 0;    // units it may lie behind a wall and still be at its front
};

struct NearResult {
    bool inside = false;     // of an odd number of borders
    bool onSurface = false;  // at the front of a wall, nearer than `behind`
};

/// Particles as they lie in State::nodes.
struct Particles {
    const double* position;
    double* velocity;
    const double* inverseMass;
};

/// All blocks, and the numbers of those with contacts that act, ascending.
struct ContactBlocks {
    ContactBlock* blocks;
    ContactHead* heads;
    std::size_t count;
    std::uint32_t* acting;  // [count], of which actingCount are filled
    std::size_t actingCount;
};

struct ContactKernels {
    /// Geometry as the particles stand, and which contacts act in this substep, where that may have changed. Velocities
    /// are those the particles really moved with: before springs push them against what they lie on. Returns how many
    /// blocks act.
    std::size_t (*refresh)(const ContactBlocks&, const Particles&, const ContactStep&);
    /// How fast those that may bounce meet.
    void (*meet)(const ContactBlocks&, const Particles&, float restSpeed);
    /// Applies the impulses carried over.
    void (*warm)(const ContactBlocks&, const Particles&);
    /// `push`: with what pushes overlaps apart; otherwise after the positions moved, without.
    void (*solve)(const ContactBlocks&, const Particles&, const ContactStep&, bool push);
    void (*bounce)(const ContactBlocks&, const Particles&, float restSpeed);
    /// near[block]: a bit for each wall the point may come to.
    NearResult (*survey)(const WallBlock*, std::size_t count, const NearQuery&, std::uint8_t* near);
};

namespace sse2 {
extern const ContactKernels contacts;
}
namespace avx2 {
extern const ContactKernels contacts;
}

}  // namespace jet::physics::soft
