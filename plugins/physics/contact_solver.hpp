// Contacts as soft constraints over substeps ("Soft Step", Catto 2024, https://box2d.org/posts/2024/02/solver2d/).
//
// Contacts are mostly candidates, of which few touch: each substep lists those that do, and looks at the others again
// only when they may have come near.
//
// Each substep: prepare -> solve (pushes overlaps out) -> positions move -> relax (takes the pushing velocity back out)
// -> finish (restitution). Impulses are kept from substep to substep and from step to step (warm starting), which is
// what lets stacks stand. Position-based contacts (XPBD) and solving each contact once a step were the alternatives:
// measured, they drop stacks or stretch under load.
#pragma once

#include "contact_point.hpp"

namespace jet::physics {

/// The contacts a detection found, and which of them act in the substep at hand.
struct ContactSet {
    std::vector<ContactPoint> points;
    std::vector<ContactHead> heads;  // [points]
    std::vector<Index> active;       // ascending

    /// After points were found or restored.
    void begin(const State&);
};

class ContactSolver {
public:
    /// Gravity in units/s²: impacts slower than a few substeps of it rest instead of bouncing.
    ContactSolver(State& state, ContactSet& contacts, double h, double gravity);

    void prepare();
    void solve();
    void relax();
    /// Bounces, and what the next substep may know of this one.
    void finish();

private:
    struct Softness {
        double biasRate, massScale, impulseScale;
    };
    enum class Pass { Push, Relax };

    static Softness softness(double hertz, double dampingRatio, double h);
    std::uint8_t refresh(ContactPoint&);
    std::uint8_t idleFor(const ContactPoint&) const;
    bool rests(const ContactPoint&) const;
    bool decideActive(ContactPoint&, double wallLength, double slide) const;
    void solveOne(ContactPoint&, Pass);
    template <class Relative, class Act>
    void solveWith(ContactPoint&, Pass, Relative&&, Act&&) const;
    void restitute();
    template <class Act>
    void each(Act&& act)
    {
        for (const Index i : contacts_.active) act(contacts_.points[i]);
    }
    Vec2 relativeVelocity(const ContactPoint&) const;
    void applyImpulse(const ContactPoint&, const Vec2& impulse);
    double effectiveMass(const ContactPoint&, const Vec2& direction) const;
    double reaction(const ContactPoint&) const;
    bool uneven(const ContactPoint&) const;
    double pushSpeed(const ContactPoint&) const;

    State& state_;
    ContactSet& contacts_;
    double h_;
    double restSpeed_;
    bool hit_ = false;  // does something hit something in this substep?
    Softness moving_, fixed_;
};

}  // namespace jet::physics
