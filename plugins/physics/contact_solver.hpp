// Contacts as soft constraints over substeps ("Soft Step", Catto 2024, https://box2d.org/posts/2024/02/solver2d/).
//
// Each substep: prepare -> solve (pushes overlaps out) -> positions move -> relax (takes the pushing velocity back out)
// -> finish (restitution). Impulses are kept from substep to substep and from step to step (warm starting), which is
// what lets stacks stand. Position-based contacts (XPBD) and solving each contact once a step were the alternatives:
// measured, they drop stacks or stretch under load.
#pragma once

#include "contact_point.hpp"

#include <span>

namespace jet::physics {

class ContactSolver {
public:
    /// Gravity in units/s²: impacts slower than a few substeps of it rest instead of bouncing.
    ContactSolver(State& state, double h, double gravity);

    void prepare(std::span<ContactPoint>);
    void solve(std::span<ContactPoint>);
    void relax(std::span<ContactPoint>);
    /// Bounces, and what the next substep may know of this one.
    void finish(std::span<ContactPoint>);

private:
    struct Softness {
        double biasRate, massScale, impulseScale;
    };
    enum class Pass { Push, Relax };

    static Softness softness(double hertz, double dampingRatio, double h);
    void refresh(ContactPoint&);
    bool decideActive(ContactPoint&, double wallLength, double slide) const;
    void solveOne(ContactPoint&, Pass);
    void restitute(std::span<ContactPoint>);
    Vec2 relativeVelocity(const ContactPoint&) const;
    void applyImpulse(const ContactPoint&, const Vec2& impulse);
    double effectiveMass(const ContactPoint&, const Vec2& direction) const;
    double pushSpeed(const ContactPoint&) const;

    State& state_;
    double h_;
    double restSpeed_;
    bool hit_ = false;  // does something hit something in this substep?
    Softness moving_, fixed_;
};

}  // namespace jet::physics
