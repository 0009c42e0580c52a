// Energy of soft bodies that joints and springs of the scene hold (docs/decisions/0061).
//
// Joints and springs do no work of their own, but a push that moves particles against the springs of their body does:
// it is taken back as velocity, what it strained stays. So an account is kept of each net, soft bodies and what is
// joined to them: its kinetic energy and what its springs, gas, twins and memory of shapes hold, which only forces,
// motors, mice, contacts and other stages may add to. What a step leaves too much is taken out of the motion within the
// net; momentum and angular momentum stay. What cannot be taken is owed, and what owes pushes out errors less (decision
// 0066).
//
// Order of calls: open -> each substep: begin and end around all springs, with force between them where the forces on
// the nodes are known, and around joints -> close.
//
// Springs hold ½ ks e e', e and e' their strains before and after a move: with it symplectic Euler keeps the energy of
// what swings to rounding, whatever the substep, and ½ ks e² would rise and fall with the phase.
#pragma once

#include "actuators.hpp"
#include "shape_memory.hpp"
#include "soft/joints.hpp"
#include "soft/twins.hpp"
#include "soft_springs.hpp"

#include <vector>

namespace jet::physics::soft {

class Accounts {
public:
    static constexpr int kSubsteps = 8;

    struct Scene {
        State& state;
        Joints& joints;
        const Actuators& actuators;
        const SoftSprings& springs;
        ShapeMemory& shapes;
        const Twins& twins;
        Vec2 gravity;  // units / s²
        double h;      // seconds of a substep
    };

    /// Finds what is held together now.
    void open(const Scene&);
    bool any() const { return !nets_.empty(); }
    /// What the forces on the nodes will give over the substep.
    void force(const Scene&);
    /// Around what is to give no energy.
    void begin(const State& state) { change(state, -1); }
    void end(const State& state) { change(state, 1); }
    /// After some substeps, kSubsteps at most: takes what is too much.
    void close(const Scene&, int substeps);

    /// Another body has this number now.
    void forget(Index body)
    {
        std::erase_if(ledgers_, [body](const Ledger& ledger) { return ledger.body == body; });
    }

    template <class Archive>
    void archive(Archive& with)
    {
        with.list(ledgers_, [&](Ledger& ledger) { with(ledger); });
    }
    std::size_t bytes() const;

private:
    /// What a net may still gain.
    struct Ledger {
        std::uint64_t body = 0;  // the first of the net
        double peak = 0;         // most kinetic energy it had
        double reserve = 0;      // of what it lost; never more than a part of that. Negative: a debt
        double held = 0;         // by springs, and as weight, when it was last looked at
    };
    struct Net {
        Index body = 0;                   // its first
        Index first = 0, end = 0;         // its bodies
        Index particles = 0;              // of its soft bodies
        bool anchored = false;            // to what does not move, or moves by itself
        double gained = 0;                // kinetic, of what is to give none; less what forces gave and springs held
        double held = 0, heldBefore = 0;  // by springs, and as weight: now; when it was opened
        double part = 1;                  // of the errors of its joints that may be pushed out
    };
    /// Motion of a net as a whole.
    struct Whole {
        Vec2 centre{0, 0}, velocity{0, 0};
        double omega = 0;
    };

    void gather(const Scene&);
    void restrain(const Scene&);
    void takeGiven(const Scene&);
    double jolt(const Scene&, const Net&) const;
    void change(const State&, double sign);
    /// Of springs, and of weight.
    void addHeld(const Scene&, double sign);
    double settle(Net&, double kinetic, double jolt);
    double take(const Scene&, const Net&, double excess, double jolt);
    Whole whole(const State&, const Net&) const;
    double kinetic(const State&, const Net&, const Whole&) const;
    template <class Visit>
    void eachNode(const State&, const Net&, Visit&& visit) const;
    Index netOf(Index body) const { return body < netAt_.size() ? netAt_[body] : kNone; }

    std::vector<Ledger> ledgers_, former_;
    // Of one step.
    std::vector<Net> nets_;
    std::vector<Index> group_, netAt_;  // [bodies]
    std::vector<Index> bodies_;         // of the nets, one net after the other
    std::vector<std::uint8_t> marks_;   // [bodies]
};

}  // namespace jet::physics::soft
