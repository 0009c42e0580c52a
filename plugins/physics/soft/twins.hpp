// Composite bodies (thesis §2.4.3.6): each particle of a soft body is sprung to its place in an invisible rigid twin.
//
// The twin weighs nothing. It lies where the springs to it balance, which for springs in proportion to the particles'
// masses m is the least squares fit of shape_memory.hpp: at the centre of mass, turned by the angle of
// (sum m q·p, sum m q x p). So there is no body of its own to be moved, met, woken or saved, the springs' forces are
// inner ones that neither push nor turn the body, and what swings about its place does so at sqrt(ks / m), as between
// the thesis's two bodies.
//
// A substep damps by them before anything else acts, so that what hangs or bears a load yields by what the forces say:
//
//   v' = (1 - l) v - h r x,  then the body's own springs:  v" = v' - h M⁻¹ (K x + C v'),  x" = x + h v"
//
// for what is not a rigid motion; r = omega². The factors of an eigenvector solve z² - (1 + e - k) z + e = 0 with
// e = (1 - l) (1 - d), d = h u·C u and k = h² u·K u + (1 - d) h² r. They lie in the unit circle iff 0 <= k <= 2 (1 +
// e). So the own dampers of such a body are held to d <= 1; h² r is held to 1/2, and what is lost of it acts as
// damping; and the own springs, of h² u·K u <= 2 h² S (stiffness.hpp), are softened to h² S = 1 - h² r / 2 unless
//
//   h² S + h² r / 2 <= 1 + (1 - l) (1 - 2 h D).
//
// Half as many substeps again as the own springs need without a twin, and omega h <= 1/2, keep that as a rule.
#pragma once

#include "soft_springs.hpp"

namespace jet::physics::soft {

class Twins {
public:
    void use(const CloudKernels& kernels) { kernels_ = &kernels; }
    /// Substeps / s for a body whose springs alone need `own`.
    static double rate(const BodyRecord& body, double own);
    /// Takes what a substep of h seconds can bear, for apply() and for the own springs.
    static void prepare(State&, double h);
    /// Changes velocities by what the springs to all twins do in a substep of h seconds. Bodies that tore have none.
    void apply(State&, const SoftSprings&, double h);
    /// What the springs to the twins of bodies that count(body) hold: visit(body, energy), as of SoftSprings::energy().
    template <class Counts, class Visit>
    void eachEnergy(const State& state, const SoftSprings& springs, double h, Counts&& counts, Visit&& visit) const
    {
        for (BodyHandle body = 0; body < state.bodies.size(); ++body)
            if (counts(body) && pulls(state.bodies[body], springs, body)) visit(body, energy(state, body, h));
    }

private:
    static bool pulls(const BodyRecord&, const SoftSprings&, BodyHandle);
    double energy(const State&, BodyHandle, double h) const;
    void apply(State&, BodyRecord&, double h);

    const CloudKernels* kernels_ = &sse2::clouds;
    std::vector<Vec2> change_, pinned_;  // scratch: of velocity [particles]; velocities of those that are pinned
};

}  // namespace jet::physics::soft
