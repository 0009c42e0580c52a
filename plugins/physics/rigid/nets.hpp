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

#include <cmath>
#include <span>
#include <vector>

namespace jet::physics {

class Nets {
public:
    /// Is their energy to be looked at, in a step of dt seconds in which a joint was, or was not, strained? It always
    /// is where there are few joints.
    bool due(std::size_t joints, bool strained, double dt);
    /// What a body may have after a step, mass units² / s².
    struct Budget {
        double energy = 0;  // kinetic, at its start, and the work of forces since
        double jolt = 0;    // kinetic energy that forces give one at rest in it
    };
    /// After the solver has finished with a step. `budgets`: [bodies]. `place(body)`: where its centre is now.
    template <class Real, class PlaceOf>
    void restrain(Solver<Real>&, const Collider&, std::vector<Joint>&, std::span<const Budget> budgets,
                  PlaceOf&& place);

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

    static bool takesPart(const Joint&, const std::vector<RigidBody>&);
    void gather(const std::vector<Joint>&, const std::vector<RigidBody>&);
    Index netOf(const Joint&, const std::vector<RigidBody>&) const;
    template <class Real>
    void addWork(const Solver<Real>&, const std::vector<Joint>&, const std::vector<RigidBody>&);
    bool settle();
    template <class Real>
    void allowExchange(const Solver<Real>&, const Collider&, std::span<const Budget>);
    Index rootOf(Index body);
    void unite(Index a, Index b);

    double attention_ = 0;  // seconds for which it goes on looking
    std::vector<Ledger> ledgers_, former_;
    // Of one step.
    std::vector<Net> nets_;
    std::vector<Index> group_;    // [bodies]
    std::vector<Index> netAt_;    // [bodies] kNone: in none
    std::vector<double> gained_;  // [bodies] of their islands, at the roots
};

template <class Real, class PlaceOf>
void Nets::restrain(Solver<Real>& solver, const Collider& collider, std::vector<Joint>& joints,
                    std::span<const Budget> budgets, PlaceOf&& place)
{
    const std::vector<RigidBody>& bodies = collider.bodies();
    gather(joints, bodies);
    const auto each = [&](auto&& work) {
        for (Index i = 1; i < bodies.size(); ++i)
            if (netAt_[i] != kNone) work(i, nets_[netAt_[i]], solver.body(i));
    };
    each([&](Index i, Net& net, const BodyState<Real>& s) {
        net.after += kineticEnergy(s), net.allowed += budgets[i].energy, net.jolt += budgets[i].jolt;
    });
    addWork(solver, joints, bodies);
    if (!settle()) return;
    allowExchange(solver, collider, budgets);
    for (const Joint& joint : joints)
        for (const Index driver : {joint.a, joint.b}) {
            if (!bodies[driver].kinematic || netOf(joint, bodies) == kNone) continue;
            // What is held by something that moves by itself may be thrown at twice its speed.
            const BodyState<Real>& s = solver.body(driver);
            Net& net = nets_[netOf(joint, bodies)];
            each([&](Index i, Net& of, const BodyState<Real>& held) {
                if (&of != &net) return;
                const double speed = std::hypot(static_cast<double>(s.velocityX), static_cast<double>(s.velocityY)) +
                                     std::abs(static_cast<double>(s.omega())) * (place(i) - place(driver)).norm();
                net.carried += 2 * speed * speed / static_cast<double>(held.invMass);
            });
        }
    for (Net& net : nets_) net.excess = std::clamp(net.excess, 0.0, std::max(0.0, net.after - net.carried));

    const auto velocity = [](const BodyState<Real>& s) {
        return Vec2(static_cast<double>(s.velocityX), static_cast<double>(s.velocityY));
    };
    each([&](Index i, Net& net, const BodyState<Real>& s) {
        if (!(net.excess > 0)) return;
        const double mass = 1 / static_cast<double>(s.invMass);
        net.mass += mass, net.centre += mass * place(i), net.velocity += mass * velocity(s);
    });
    for (Net& net : nets_)
        if (net.mass > 0) net.centre /= net.mass, net.velocity /= net.mass;
    each([&](Index i, Net& net, const BodyState<Real>& s) {
        if (!(net.excess > 0)) return;
        const double mass = 1 / static_cast<double>(s.invMass), k = s.perGyration > 0 ? bodies[i].gyration : 0;
        const Vec2 arm = place(i) - net.centre;
        net.spin += mass * (cross(arm, Vec2(velocity(s) - net.velocity)) + k * static_cast<double>(s.spin));
        net.inertia += mass * (arm.squaredNorm() + k * k);
    });
    // Anchors hold the whole as well: all its motion is within.
    for (Net& net : nets_) {
        net.omega = net.inertia > 0 ? net.spin / net.inertia : 0;
        if (net.anchored) net.velocity = Vec2(0, 0), net.omega = 0;
    }
    /// Of the whole, where the body is.
    const auto whole = [&](Index i, const Net& net, const BodyState<Real>& s) {
        const Vec2 arm = place(i) - net.centre;
        BodyState<Real> carried = s;
        carried.velocityX = static_cast<Real>(net.velocity.x() - net.omega * arm.y());
        carried.velocityY = static_cast<Real>(net.velocity.y() + net.omega * arm.x());
        carried.spin = static_cast<Real>(s.perGyration > 0 ? net.omega * bodies[i].gyration : 0);
        return carried;
    };
    each([&](Index i, Net& net, const BodyState<Real>& s) {
        if (!(net.excess > 0)) return;
        BodyState<Real> apart = s;
        const BodyState<Real> with = whole(i, net, s);
        apart.velocityX -= with.velocityX, apart.velocityY -= with.velocityY, apart.spin -= with.spin;
        net.within += kineticEnergy(apart);
    });
    for (Net& net : nets_)
        if (net.excess > 0) net.kept = net.within > net.excess ? std::sqrt((net.within - net.excess) / net.within) : 0;
    each([&](Index i, Net& net, BodyState<Real>& s) {
        if (!(net.excess > 0)) return;
        BodyState<Real> with = whole(i, net, s);
        // Energy beyond that came with momentum, of joints torn far apart.
        const double outer = net.after - net.within, rest = net.excess - net.within;
        const auto moves =
            static_cast<Real>(rest > 0 && outer > 0 ? std::sqrt(std::max(0.0, outer - rest) / outer) : 1);
        const auto kept = static_cast<Real>(net.kept);
        s.velocityX = moves * with.velocityX + kept * (s.velocityX - with.velocityX);
        s.velocityY = moves * with.velocityY + kept * (s.velocityY - with.velocityY);
        s.spin = moves * with.spin + kept * (s.spin - with.spin);
    });
    // Impulses that forces alone may explain bear them in the next step as well.
    solver.scaleJoints(joints, [&](const Joint& joint) {
        const Index net = netOf(joint, bodies);
        return net == kNone || nets_[net].excess < nets_[net].jolt ? 1 : nets_[net].kept;
    });
}

}  // namespace jet::physics
