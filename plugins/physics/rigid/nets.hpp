// Energy of nets: bodies that joints hold together.
//
// Joints do no work. But joints that cannot all be met (over-determined nets, heavy bodies held by light ones, turns of
// radians a substep) are met one after the other, and what one gives the next may take back too late or never: such a
// net would gather energy without bound. So while a joint of the world is strained, the energy of each net after a step
// is compared with what it had and what it was given: by forces, springs, motors, what moves by itself, and through
// contacts by others. What a net has too much is taken out of the motion within it, and out of the impulses its joints
// start the next step with; its momentum and angular momentum stay. It may regain a little of what it lost lately,
// as the energy of what swings is not exact within a turn.
#pragma once

#include "collider.hpp"
#include "solver.hpp"

#include <span>
#include <vector>

namespace jet::physics {

class Nets {
public:
    /// Is their energy to be looked at, in a step of dt seconds in which a joint was, or was not, strained? It always
    /// is where there are few joints.
    bool due(std::size_t joints, bool strained, double dt);
    /// Of a body after a step; energies in mass units² / s².
    struct Budget {
        double energy = 0;  // kinetic, at its start, and the work of forces since
        double jolt = 0;    // kinetic energy that forces give one at rest in it
        Vec2 place{0, 0};   // where its centre is now
    };
    /// What a step left.
    template <class Real>
    struct Step {
        Solver<Real>& solver;
        const Collider& collider;
        std::vector<Joint>& joints;
        std::span<const Budget> budgets;  // [bodies]
        std::uint64_t version;            // of the joints, and of which bodies take part
        Pool& pool;

        const std::vector<RigidBody>& bodies() const { return collider.bodies(); }
    };
    /// After the solver has finished with a step.
    template <class Real>
    void restrain(const Step<Real>&);

    /// Another joint has this number now.
    void forget(Index joint)
    {
        std::erase_if(ledgers_, [joint](const Ledger& ledger) { return ledger.joint == joint; });
    }

    template <class Archive>
    void archive(Archive& with)
    {
        with(attention_);
        with.list(ledgers_, [&](Ledger& ledger) { with(ledger); });
    }

private:
    /// What a net may still gain.
    struct Ledger {
        std::uint64_t joint = 0;  // the first of the net
        double peak = 0;          // kinetic energy it was allowed at most
        double reserve = 0;       // of what it lost; never more than a part of that
    };
    struct Net {
        Index joint = 0;        // its first
        Index body = 0;         // one of its
        bool anchored = false;  // to what does not move
        double after = 0, allowed = 0, jolt = 0;
        double carried = 0;  // energy it may have from what moves by itself
        double mass = 0, inertia = 0;
        Vec2 centre{0, 0}, velocity{0, 0};
        double spin = 0, omega = 0;
        double within = 0;  // energy of the motion within
        double excess = 0;  // energy to be taken
        double kept = 1;    // part of the motion within that stays
    };

    /// Some bodies of a net, and the sums of what it has of them.
    struct Piece {
        Index net = 0, first = 0, last = 0;  // members [first, last)
        double after = 0, allowed = 0, jolt = 0;
    };

    static bool takesPart(const Joint&, const std::vector<RigidBody>&);
    void gather(const std::vector<Joint>&, const std::vector<RigidBody>&, std::uint64_t version);
    void cut();
    Index netOf(const Joint&, const std::vector<RigidBody>&) const;
    template <class Real, class Work>
    void eachBody(const Step<Real>&, Work&& work);
    template <class Real>
    void addEnergies(const Step<Real>&);
    template <class Real>
    void addWork(const Step<Real>&);
    bool settle();
    template <class Real>
    void allowExchange(const Step<Real>&);
    template <class Real>
    void allowCarriers(const Step<Real>&);
    template <class Real>
    void findWhole(const Step<Real>&);
    template <class Real>
    void takeExcess(const Step<Real>&);
    template <class Real>
    static BodyState<Real> ofWhole(const Step<Real>&, Index body, const Net&);

    double attention_ = 0;  // seconds for which it goes on looking
    std::vector<Ledger> ledgers_, former_;
    // Of one step; which nets there are, and who is in them, of as long as the version is the same.
    std::uint64_t version_ = 0;
    std::vector<Net> nets_;
    std::vector<Index> group_;    // [bodies]
    std::vector<Index> netAt_;    // [bodies] kNone: in none
    std::vector<Index> members_;  // bodies, net by net
    std::vector<Piece> pieces_;
    std::vector<Index> islands_;  // [bodies] nets that push each other
    std::vector<double> gained_;  // [bodies] of their islands, at the roots
};

}  // namespace jet::physics
