// How fast can the springs at each node swing, and how many substeps does that take?
//
// Gershgorin: the fastest squared frequency of a spring network is at most the largest S_a + S_b over its springs,
// where S_n sums ks / m (for a rigid body: ks (1/m + r²/I)) over the springs at node n. Symplectic Euler is stable for
// (omega h)² < 4. The substep is chosen for omega h <= 0.5, where the frequency is right to 1 %; when that would take
// more substeps than allowed, the springs of the stiffest nodes are softened to (omega h)² <= 2 and no further.
#pragma once

#include "state.hpp"

namespace jet::physics {

class StiffnessBounds {
public:
    void reset(std::size_t nodes) { sums_.assign(nodes, 0.0); }
    void add(Index node, double rate)
    {
        if (node != kNone) sums_[node] += rate;
    }

    /// rad / s; no spring network of the world swings faster.
    double fastest() const
    {
        double most = 0;
        for (double sum : sums_) most = std::max(most, sum);
        return std::sqrt(2 * most);
    }
    /// The part of the stiffness a spring at this node may keep at substep h.
    double share(Index node, double h) const
    {
        const double product = node == kNone ? 0 : sums_[node] * h * h;
        return product > 1 ? 1 / product : 1;
    }

private:
    std::vector<double> sums_;  // 1 / s²
};

/// Substeps for a step of dt: at least 480 a second for the contacts, up to 1920 for stiff springs.
inline int substepsFor(double dt, double fastest)
{
    constexpr double kContactRate = 480, kHighestRate = 1920, kPhasePerSubstep = 0.5;
    constexpr int kMost = 4096;
    const double wanted = std::clamp(fastest / kPhasePerSubstep, kContactRate, kHighestRate);
    return static_cast<int>(std::clamp(std::ceil(dt * wanted - 1e-9), 1.0, static_cast<double>(kMost)));
}

}  // namespace jet::physics
