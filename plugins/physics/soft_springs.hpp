// Springs and angular springs inside soft bodies (thesis §2.4.3.2, §2.4.3.3), one structure of arrays for the whole
// world.
//
// Stiffness is explicit in symplectic Euler: exact in frequency while omega h is small, and never gaining energy on
// average while omega h < 2; StiffnessBounds keeps it below. Damping is a pairwise impulse that can take away at most
// the relative velocity along the spring, so no damping constant is too large. Fully implicit springs were the
// alternative: stable at any stiffness too, but they damp what the author asked to swing.
#pragma once

#include "state.hpp"
#include "stiffness.hpp"

namespace jet::physics {

class SoftSprings {
public:
    Index springCount() const { return static_cast<Index>(a_.size()); }
    Index angularCount() const { return static_cast<Index>(angular_.size()); }

    /// `firstNode` is added to the definition's particle indices.
    void add(const SpringDef&, Index firstNode);
    void add(const State&, const AngularSpringDef&, Index firstNode);

    void addTo(StiffnessBounds&, const State&) const;
    /// Fixes what depends on the step: softened stiffness where the step is too long for it, damping shares.
    void prepare(const State&, const StiffnessBounds&, double h);
    /// Changes velocities by the springs' impulses over h. `backwards` alternates, so that no end of the list is
    /// favoured.
    void apply(State&, double h, bool backwards);

    bool alive(Index spring) const { return alive_[spring] != 0; }
    /// Springs from a particle to itself never were whole, and never tear.
    bool anyTorn(Range springs) const;

    template <class Archive>
    void archive(Archive& with)
    {
        with(alive_);
        for (Angular& spring : angular_) with(spring.angle);
    }

private:
    struct Angular {
        Index a, centre, b;
        double restAngle, ks, kd;
        double angle;           // unwrapped: continues through ±pi
        double restCompliance;  // sum of |grad angle|² / m at rest
        double stiffness = 0;   // ks after softening
        double damping = 0;     // kd and what softening adds
    };

    void applySpring(State&, Index spring, double h);
    void applyAngular(State&, Angular&, double h);

    std::vector<Index> a_, b_;                   // nodes
    std::vector<double> rest_, ks_, kd_, tear_;  // tear_: length, 0 = never
    std::vector<std::uint8_t> alive_;
    std::vector<double> stiffness_, dampingShare_;  // for the prepared h
    std::vector<Angular> angular_;
};

}  // namespace jet::physics
