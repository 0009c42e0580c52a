// Where an actuator holds on: the background, a rigid body's local point, or a few particles of a soft body.
#pragma once

#include "state.hpp"
#include "stiffness.hpp"

#include <array>

namespace jet::physics {

struct AnchorPoint {
    static constexpr int kMostNodes = 6;

    int count = 0;  // nodes held; 0: the background
    std::array<Index, kMostNodes> node{};
    std::array<double, kMostNodes> weight{};  // sum 1; particles' weighted mean is the anchored point
    Vec2 local;  // background: scene point; rigid: in the node's frame; soft: what the mean misses
    Index body = kNone;

    Vec2 position(const State&) const;
    /// From the node to the anchored point, scene directions; zero for particles.
    Vec2 arm(const State&) const;
    Vec2 velocity(const State&) const;
    void applyImpulse(State&, const Vec2& impulse) const;
    void addForce(State&, const Vec2& force) const;
    /// Adds a spring of stiffness ks held here to the bounds.
    void addTo(StiffnessBounds&, const State&, double ks) const;
    double share(const StiffnessBounds&, double h) const;
};

AnchorPoint resolveAnchor(const State&, const Anchor&);

/// Impulses along given directions at several anchors at once, as one constraint: what it takes to change their rate.
/// Anchors may hold the same node.
class AnchorJacobian {
public:
    void add(const State&, const AnchorPoint&, const Vec2& direction);
    double rate(const State&) const;
    double compliance(const State&) const;
    void apply(State&, double impulse) const;
    /// rad/s of what that would turn fastest; 0 where it would turn slower than it did.
    double turns(const State&, double impulse) const;
    /// The same, but it makes nothing turn faster than `most` rad/s.
    void applyTurning(State&, double impulse, double most) const;
    /// The same as a force, for this substep.
    void addForce(State&, double force) const;

private:
    /// (Of numbers, as vectors would be set to 0 for each of the many that are not used.)
    struct Entry {
        Index node;
        double x, y, angular;
        Vec2 linear() const { return {x, y}; }
    };
    int count_ = 0;
    std::array<Entry, 3 * AnchorPoint::kMostNodes> entries_;
};

}  // namespace jet::physics
