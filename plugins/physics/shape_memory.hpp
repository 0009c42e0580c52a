// Soft bodies remember their shape: springs know lengths, not sides, so a crushed lattice can rest inside out.
//
// Shape matching (Müller, Heidelberger, Teschner, Gross, "Meshless deformations based on shape matching", 2005): the
// particles x of a lattice have goals g = c + R q, the shape at rest (q from its centre of mass) moved and turned to
// where they are. Their least squares fit in the plane is closed: R turns by the angle of
// (sum m q·p, sum m q×p), p = x - c. With d = g - x, particles are pulled to their goals by the potential
//
//   U = ½ omega² sum m max(0, |d| - tolerance)²
//
// Up to the tolerance only the springs act: ordinary squish stays theirs, and a body at rest is not touched. The
// forces are the full gradient of U, with what c and R do when x moves: that takes away the net force and the net
// torque, so U needs no other correction to keep momentum, angular momentum and energy. Moving the particles to their
// goals outright, as in the paper, was the alternative: unconditionally stable, but with a stiffness that depends on
// the step.
#pragma once

#include "soft/cloud_kernels.hpp"
#include "soft_springs.hpp"

namespace jet::physics {

class ShapeMemory {
public:
    /// Takes the lattices of the body as their shapes. What springs do not hold in shape (ropes, hinges, loose
    /// particles), what was not built at rest, and what is nailed down has none.
    void add(const State&, const SoftBodyDef&, BodyHandle, std::span<const Index> nodeOf);

    void remove(BodyHandle body)
    {
        std::erase_if(lattices_, [body](const Lattice& lattice) { return lattice.body == body; });
    }

    void use(const soft::CloudKernels& kernels) { kernels_ = &kernels; }
    /// Once a step, before its substeps, where nothing can hit the bodies: those that cannot come near their tolerance
    /// within dt are left out of it.
    void look(State&, double dt);
    /// Is that so for all lattices of the body?
    bool relaxes(State&, Index body, double dt);
    /// Changes velocities by the impulses over h. Bodies with a torn spring are left alone.
    /// `offs`: [bodies] units their particles are from where the shape at rest has them, at most. One that is hit must
    /// be seen as it is crushed: later, it would get what it costs to crush it as a present. Empty: as of look().
    void apply(State&, const SoftSprings&, double h, std::span<const double> offs);

    /// What it holds of bodies that count(body): visit(body, energy), as of SoftSprings::energy().
    template <class Counts, class Visit>
    void eachEnergy(State& state, const SoftSprings& springs, double h, Counts&& counts, Visit&& visit)
    {
        for (Lattice& lattice : lattices_)
            if (counts(lattice.body) && !springs.anyTorn(lattice.body) && !forgets(state, lattice))
                visit(lattice.body, energy(state, lattice, h));
    }

    template <class Archive>
    void archive(Archive& with)
    {
        for (Lattice& lattice : lattices_) with(lattice.rotation);
    }

private:
    /// Particles of one body that springs join.
    struct Lattice {
        BodyHandle body = kNoHandle;
        std::vector<Index> nodes;  // ascending; empty: those of the whole body, whose shape is BodyRecord::restArms
        std::vector<Vec2> rest;    // q, scene units
        double mass = 0;
        double inertia = 0;          // sum m |q|²
        double tolerance = 0;        // scene units
        double rate = 0;             // omega², 1 / s²
        bool relaxed = false;        // far inside the tolerance in this step: see look()
        Vec2 rotation = Vec2(1, 0);  // (cos, sin) of R; stays where it was while no angle fits better than others
    };
    /// The rigid motion nearest to that of the particles.
    struct Motion {
        soft::CloudMotion rigid;  // R: (c, s)
        double inertia = 0;       // sum m |p|²
        double fit = 0;           // sum m (R q)·p; inertia at rest
        bool certain = true;      // is there a best R?
    };

    static bool anyPinned(const State&, const Lattice&);
    static bool forgets(const State&, const Lattice&);
    bool relaxes(State&, Lattice&, double dt);
    double energy(State&, const Lattice&, double h);
    static double rateAt(const Lattice& lattice, double h);
    soft::Cloud cloudOf(State&, const Lattice&);
    Motion match(const soft::Cloud&, const Lattice&) const;
    static soft::CloudReturn netOf(const soft::CloudPulled&, const Lattice&, const Motion&);

    const soft::CloudKernels* kernels_ = &soft::sse2::clouds;
    std::vector<Lattice> lattices_;
    // Scratch: changes of velocity, one a particle of the lattice at hand, and copies of particles that lie scattered.
    std::vector<Vec2> change_, position_, velocity_;
    std::vector<double> mass_;
};

}  // namespace jet::physics
