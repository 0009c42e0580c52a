// How fast can the springs at each node swing and how fast do their dampers act, how many substeps does that take, and
// what part of them can a substep of a given length bear?
//
// A substep of symplectic Euler with the forces of the state it starts from is, for a linear spring network,
//
//   v' = v - h M⁻¹ (K x + C v),  x' = x + h v'.
//
// For an eigenvector u (mass-weighted) its two factors z solve z² - (2 - d - k) z + (1 - d) = 0 with k = h² u·K u and
// d = h u·C u, whatever K and C are, also where they do not commute. Both lie in the unit circle iff 0 <= k, 0 <= d <=
// 2 and k + 2 d <= 4. Gershgorin: k <= 2 max h² S, d <= 2 max h D, where S_n sums ks / m (for a rigid body: ks (1/m +
// r²/I)) and D_n sums kd / m over the springs at node n. So
//
//   h² S + 2 h D <= 2   at every node
//
// is stable at any stiffness and any damping. More closely: u·K u <= sum ks (|u_a| + |u_b|)², a matrix without negative
// entries, so for any positive weights w of the nodes (Collatz, Wielandt) sum ks (w_a + w_b) / (2 m w_n) may stand for
// S_n, and likewise for D_n. Weights near the matrix's greatest eigenvector leave room where a node of many springs has
// neighbours of few. With all weights 1 it is the bound above.
//
// Closer still: u·K u <= sum ks |u_a - u_b|², whatever the directions of the springs and however they are stretched. So
// where 2 kStableLoad M - h² K' - 2 h C' is positive definite, K' and C' the springs' graphs weighed by ks and by the
// damping that acts in a substep, h is stable, and so is each shorter one. For small bodies that is tried at rates
// below the bound's, by factoring the matrix.
//
// The substep is chosen to keep it, and to swing in time: 1 % in frequency
// for omega h <= 0.5. Where that would take more substeps than allowed, the springs of the stiffest nodes are softened
// to h² S = 1 and no further, what they lose acts on as damping (as the implicit part of an implicit spring would),
// and dampers are held to the rest of the bound. Nothing explodes, and what is soft enough stays exact.
#pragma once

#include "state.hpp"

#include <limits>

namespace jet::physics {

/// h² S + 2 h D a substep is chosen for. Below 2, because springs under pressure bend more than the bound knows.
inline constexpr double kStableLoad = 1.95;

class StiffnessBounds {
public:
    void reset(std::size_t nodes)
    {
        elastic_.assign(nodes, 0.0F);
        damping_.assign(nodes, 0.0F);
        weight_.assign(nodes, 1.0F);
    }
    /// Nodes to which nothing has been added.
    void reset(Range nodes)
    {
        for (Index n = nodes.first; n < nodes.end(); ++n) elastic_[n] = damping_[n] = 0, weight_[n] = 1;
    }
    void weigh(Index node, float weight) { weight_[node] = weight; }
    /// (w_a + w_b) / (2 w_a)
    double part(Index a, Index b) const
    {
        const auto own = static_cast<double>(weight_[a]), other = static_cast<double>(weight_[b]);
        return (own + other) / (2 * own);
    }
    void add(Index node, double rate)
    {
        if (node != kNone) elastic_[node] = single(elastic(node) + rate);
    }
    void addDamping(Index node, double rate) { damping_[node] = single(damping(node) + rate); }

    /// rad / s; no spring network of these nodes swings faster.
    double fastest(Range nodes) const
    {
        double most = 0;
        for (Index n = nodes.first; n < nodes.end(); ++n) most = std::max(most, elastic(n));
        return std::sqrt(2 * most);
    }
    /// Substeps a second at which every spring and damper of these nodes may act as it is.
    double stableRate(Range nodes, double load = kStableLoad) const
    {
        double most = 0;
        for (Index n = nodes.first; n < nodes.end(); ++n)
            most = std::max(most, damping(n) + std::sqrt(damping(n) * damping(n) + load * elastic(n)));
        return most / load;
    }
    double elastic(Index node) const { return static_cast<double>(elastic_[node]); }
    double damping(Index node) const { return static_cast<double>(damping_[node]); }
    /// May everything at this node act as it is at substep h?
    bool stable(Index node, double h) const
    {
        h = std::max(h, longest_);
        return h * h * elastic(node) + 2 * h * damping(node) <= 2;
    }
    /// Substeps were made shorter so that what is stable swings no wider: what was not at `h` is softened still.
    void judgeAt(double h) { longest_ = h; }
    double longest() const { return longest_; }
    /// The part of the stiffness a spring at this node may keep at substep h.
    double share(Index node, double h) const
    {
        const double product = node == kNone ? 0 : elastic(node) * h * h;
        return product > 1 ? 1 / product : 1;
    }

private:
    /// Rounding is covered by kStableLoad; nothing is stiffer than the greatest.
    static float single(double rate)
    {
        return static_cast<float>(std::min(rate, static_cast<double>(std::numeric_limits<float>::max())));
    }

    std::vector<float> elastic_;  // S, 1 / s²
    std::vector<float> damping_;  // D, 1 / s
    std::vector<float> weight_;   // w
    double longest_ = 0;          // seconds
};

/// omega h up to which springs swing in time: 0.5, 1 % of the frequency. In large bodies this is for their slower
/// motions alone: the fastest, of a wave length of two springs, may be off by 5 %, and the bound for it is a loose one.
inline bool isLarge(Range nodes) { return nodes.count > 16; }
inline double phaseOf(Range nodes) { return isLarge(nodes) ? 1.2 : 0.5; }
/// In bodies of many particles the fastest is known more closely: sum ks ((u_a - u_b)·d)² <= 2 sum ks ((u_a·d)² +
/// (u_b·d)²) in the directions d that springs have at rest, so no motion is faster than the root of twice the greatest
/// eigenvalue of sum ks d dᵀ / m at a node (1 / sqrt(2) of the other bound in a lattice). 5 % of that frequency, as
/// above.
inline bool isVast(Range nodes) { return nodes.count > 256; }
inline constexpr double kVastPhase = 1.06;

inline constexpr double kContactRate = 480;       // substeps a second, at least
inline constexpr double kLargeContactRate = 300;  // in worlds of many particles: deeper overlaps, a third faster
inline constexpr std::size_t kLargeWorld = 2048;  // nodes
inline constexpr double kHighestRate = 1920;      // and at most, but see WideSwing

/// What swings at omega without damping swings 1 / sqrt(1 - (omega h)² / 4) times as wide as it was drawn, or as a push
/// would have it: the energy that symplectic Euler keeps is not quite that of the spring. Where kHighestRate is the
/// least at which springs may act as they are that is any number, so they get substeps for sqrt(2). Softening them
/// would cost none, but what is held softer than it was asked for is wrong for ever, not only while it swings.
struct WideSwing {
    double kept = 0;  // substeps a second from which on the springs of a body act as they are
    double calm = 0;  // and at which they swing no wider than that
};
inline constexpr double kWidePhase = 1.4142135623730951;  // omega h

/// Substeps for a step of dt that would have `count`.
inline int calmed(int count, double dt, const std::vector<WideSwing>& swings)
{
    double most = count;
    for (const WideSwing& swing : swings)
        if (swing.kept * dt <= count * (1 + 1e-9)) most = std::max(most, std::ceil(dt * swing.calm - 1e-9));
    return static_cast<int>(most);
}

/// Substeps for a step of dt at `rate` substeps a second.
inline int substepsFor(double dt, double rate, std::size_t nodes)
{
    constexpr int kMost = 16384;
    const double wanted = std::clamp(rate, nodes < kLargeWorld ? kContactRate : kLargeContactRate, kHighestRate);
    return static_cast<int>(std::clamp(std::ceil(dt * wanted - 1e-9), 1.0, static_cast<double>(kMost)));
}

}  // namespace jet::physics
