// Scene-level springs, angular springs, torques and forces (thesis §2.4.3, package "actuators"; SPEC PH7).
#pragma once

#include "anchor.hpp"

#include <jet/physics_removal.hpp>

#include <algorithm>
#include <optional>

namespace jet::physics {

class Actuators {
public:
    ActuatorHandle add(const State&, const SpringActuatorDef&);
    ActuatorHandle add(const State&, const AngularSpringActuatorDef&);
    ActuatorHandle add(const State&, const TorqueActuatorDef&);
    ActuatorHandle add(const State&, const ForceActuatorDef&);

    bool anySpring() const { return springs_.any() || angularSprings_.any(); }
    bool any() const { return anySpring() || torques_.any() || forces_.any(); }
    Index torqueCount() const { return count(ActuatorKind::Torque); }
    Index forceCount() const { return count(ActuatorKind::Force); }
    Index springCount() const { return count(ActuatorKind::Spring); }
    Index angularSpringCount() const { return count(ActuatorKind::AngularSpring); }
    /// With those that were removed, as handles go; 0 for fields of force.
    Index count(ActuatorKind) const;
    bool exists(ActuatorKind, ActuatorHandle) const;
    /// The next of its kind takes its place.
    void remove(ActuatorKind, ActuatorHandle);
    /// Calls visit(body) for what it holds, of all but removed ones; the background is no body.
    template <class Visit>
    void eachHeld(ActuatorKind kind, ActuatorHandle handle, Visit&& visit) const
    {
        const auto held = [&](const AnchorPoint& anchor) {
            if (anchor.body != kNone) visit(anchor.body);
        };
        switch (kind) {
        case ActuatorKind::Spring: return held(springs_[handle].a), held(springs_[handle].b);
        case ActuatorKind::AngularSpring:
            return held(angularSprings_[handle].a), held(angularSprings_[handle].centre),
                   held(angularSprings_[handle].b);
        case ActuatorKind::Torque: return held(torques_[handle].at);
        case ActuatorKind::Force: return held(forces_[handle].at);
        case ActuatorKind::ForceField: return;
        }
    }
    /// restLength < 0: as it is. What is torn stays torn.
    void setSpring(ActuatorHandle, double restLength, double ks, double kd, double tearRatio);
    /// Would that change nothing?
    bool isSet(ActuatorHandle, double restLength, double ks, double kd, double tearRatio) const;
    /// No restAngle: as it is.
    void setAngularSpring(ActuatorHandle, std::optional<double> restAngle, double ks, double kd);
    bool isSet(ActuatorHandle angularSpring, std::optional<double> restAngle, double ks, double kd) const;
    void setTorque(ActuatorHandle handle, double value) { torques_[handle].value = value; }
    void setForce(ActuatorHandle handle, const Vec2& value) { forces_[handle].force = value; }
    double torque(ActuatorHandle handle) const { return torques_[handle].value; }
    const Vec2& force(ActuatorHandle handle) const { return forces_[handle].force; }
    Index bodyOfTorque(ActuatorHandle handle) const { return torques_[handle].at.body; }
    Index bodyOfForce(ActuatorHandle handle) const { return forces_[handle].at.body; }
    /// Calls visit(body, body) for what whole springs hold together; kNone: the background.
    template <class Visit>
    void eachBond(Visit&& visit) const
    {
        for (const Spring& spring : springs_)
            if (spring.alive != 0) visit(spring.a.body, spring.b.body);
        for (const AngularSpring& spring : angularSprings_)
            if (!spring.removed) visit(spring.a.body, spring.centre.body), visit(spring.centre.body, spring.b.body);
    }

    /// Calls visit(body, body, ks, kd) for the whole springs; kNone: the background.
    template <class Visit>
    void eachSpring(Visit&& visit) const
    {
        for (const Spring& spring : springs_)
            if (spring.alive != 0) visit(spring.a.body, spring.b.body, spring.ks, spring.kd);
    }

    /// Calls visit(body) for what springs will have moved by more than a part of its length once they are not damped
    /// any more: what damping takes off their pull, at substeps of h, is way that is left.
    template <class Visit>
    void eachCreeping(const State& state, double h, Visit&& visit) const
    {
        constexpr double kLeft = 5e-5;  // lengths; radians
        const auto ask = [&](double left, Index body) {
            if (body != kNone && left > kLeft * state.bodies[body].length) visit(body);
        };
        for (const Spring& spring : springs_) {
            if (spring.alive == 0 || !(spring.stiffness > 0)) continue;
            const double left = spring.braking.norm() / (h * spring.stiffness);
            ask(left, spring.a.body), ask(left, spring.b.body);
        }
        for (const AngularSpring& spring : angularSprings_) {
            if (spring.removed || !(spring.stiffness > 0)) continue;
            const double left = std::abs(spring.braking) / (h * spring.stiffness);
            for (const Index body : {spring.a.body, spring.centre.body, spring.b.body})
                if (body != kNone && left > kLeft) visit(body);
        }
    }

    /// What whole springs hold: visit(body, body, energy); ½ ks e e', e the strain now, e' before the last move over h.
    template <class Visit>
    void eachEnergy(const State& state, double h, Visit&& visit) const
    {
        for (const Spring& spring : springs_)
            if (spring.alive != 0) visit(spring.a.body, spring.b.body, energy(state, spring, h));
        for (const AngularSpring& spring : angularSprings_)
            if (!spring.removed)
                visit(spring.a.body != kNone ? spring.a.body : spring.centre.body, spring.b.body,
                      energy(state, spring, h));
    }

    void addTo(StiffnessBounds&, const State&) const;
    /// `plain`: stiffness and damping as they are.
    void prepare(const StiffnessBounds&, double h, bool plain = false);
    /// Adds torques and forces to the nodes; they hold for one substep, as levers turn with their bodies.
    void addForces(State&) const;
    /// Changes velocities by the impulses of springs and angular springs over h; their damping is that of the substep
    /// before.
    void applySprings(State&, double h, bool backwards);
    /// Makes their damping that of the rates as they are, as rows of the joints' solver.
    void brake(State&, double h, bool backwards);
    /// What brakes is of one substep: for others of another length.
    void scale(double ratio)
    {
        for (Spring& spring : springs_) spring.braking *= ratio;
        for (AngularSpring& spring : angularSprings_) spring.braking *= ratio;
    }
    /// The same as forces of the state as it is, for Method::SemiImplicitEuler.
    void addSpringForces(State&);

    template <class Archive>
    void archive(Archive& with)
    {
        for (Spring& spring : springs_)
            with(spring.alive), with(spring.restLength), with(spring.ks), with(spring.kd), with(spring.tearLength),
                with(spring.braking);
        for (AngularSpring& spring : angularSprings_)
            with(spring.angle), with(spring.restAngle), with(spring.ks), with(spring.kd), with(spring.braking);
        for (Torque& torque : torques_) with(torque.value);
        for (Force& force : forces_) with(force.force);
    }

private:
    struct Spring {
        AnchorPoint a, b;
        double restLength = 0, ks = 0, kd = 0, tearLength = 0;
        std::uint8_t alive = 1;
        bool removed = false;
        double stiffness = 0, damping = 0;  // for the prepared substep, as in soft_springs.cpp
        Vec2 braking = Vec2(0, 0);          // impulse on a of damping in the last substep
    };
    struct AngularSpring {
        AnchorPoint a, centre, b;
        double restAngle = 0, ks = 0, kd = 0, angle = 0;
        double restCompliance = 0;
        double restA = 0, restB = 0;  // units², of the arms at the time of adding
        bool removed = false;
        double stiffness = 0, damping = 0;  // for the prepared substep, as in soft_springs.cpp
        double braking = 0;                 // impulse of damping in the last substep, torque · s
    };
    struct Torque {
        AnchorPoint at;
        double value = 0;
        bool removed = false;
    };
    struct Force {
        AnchorPoint at;
        Vec2 force = Vec2(0, 0);
        bool removed = false;
    };

    /// Of one kind, in the order of their handles. Removed ones hold nothing, and are nothing.
    template <class Actuator>
    class List : public std::vector<Actuator> {
    public:
        bool any() const { return removed_ < this->size(); }
        ActuatorHandle put(const Actuator& actuator)
        {
            if (removed_ == 0) {
                this->push_back(actuator);
                return static_cast<ActuatorHandle>(this->size() - 1);
            }
            const auto place = std::find_if(this->begin(), this->end(), [](const Actuator& a) { return a.removed; });
            *place = actuator, --removed_;
            return static_cast<ActuatorHandle>(place - this->begin());
        }
        Actuator& remove(ActuatorHandle handle)
        {
            ++removed_;
            Actuator& actuator = (*this)[handle] = Actuator();
            actuator.removed = true;
            return actuator;
        }

    private:
        std::size_t removed_ = 0;
    };

    static double energy(const State&, const Spring&, double h);
    static double energy(const State&, const AngularSpring&, double h);
    struct Line {
        double length = 0, compliance = 0;
        Vec2 along;
        AnchorJacobian jacobian;
    };
    static bool lineOf(const State&, const Spring&, Line&);
    static void apply(State&, Spring&, double h);
    static void apply(State&, AngularSpring&, double h);
    static double change(const State&, const AnchorJacobian&, double damping, double braking);
    static void brake(State&, Spring&, double h);
    static void brake(State&, AngularSpring&, double h);
    template <class Actuator, class Visit>
    static void eachOf(List<Actuator>& all, bool backwards, Visit&& visit)
    {
        for (std::size_t i = 0; i < all.size(); ++i) visit(all[backwards ? all.size() - 1 - i : i]);
    }

    List<Spring> springs_;
    List<AngularSpring> angularSprings_;
    List<Torque> torques_;
    List<Force> forces_;
};

}  // namespace jet::physics
