// Composite bodies (thesis §2.4.3.6): each particle of a soft body is sprung to its place in an invisible rigid twin.
//
// The twin weighs nothing. It lies where the springs to it balance, which for springs in proportion to the particles'
// masses m is the least squares fit of shape_memory.hpp: at the centre of mass, turned by the angle of
// (sum m q·p, sum m q x p). So there is no body of its own to be moved, met, woken or saved, the springs' forces are
// inner ones that neither push nor turn the body, and what swings about its place does so at sqrt(ks / m), as between
// the thesis's two bodies.
//
// Their rate is held to omega² h² <= 0.5, beside which what the body's own springs take (h² S <= 2) leaves symplectic
// Euler stable for a loss of up to 0.75 of the velocities a substep: h² (S + omega²) <= 2 (2 - loss). Substeps are
// chosen so that omega h <= 0.5 where that is possible; what a stiffer twin cannot give as force it takes as damping.
#pragma once

#include "soft_springs.hpp"

namespace jet::physics::soft {

class Twins {
public:
    void use(const CloudKernels& kernels) { kernels_ = &kernels; }
    /// Has the body one? Those that tore do not, nor has what stands.
    static bool has(const BodyRecord& body, const SoftSprings&, BodyHandle);
    /// Substeps / s by which the body's twin swings in time; 0 without one.
    static double swingRate(const BodyRecord& body);
    /// Changes velocities by what the springs to all twins do in a substep of h seconds.
    void apply(State&, const SoftSprings&, double h);

private:
    void apply(State&, BodyRecord&, double h);

    const CloudKernels* kernels_ = &sse2::clouds;
    std::vector<Vec2> change_, pinned_;  // scratch: of velocity [particles]; velocities of those that are pinned
};

}  // namespace jet::physics::soft
