// Scene-level springs, angular springs, torques and forces (thesis §2.4.3, package "actuators"; SPEC PH7).
#pragma once

#include "anchor.hpp"

namespace jet::physics {

class Actuators {
public:
    ActuatorHandle add(const State&, const SpringActuatorDef&);
    ActuatorHandle add(const State&, const AngularSpringActuatorDef&);
    ActuatorHandle add(const State&, const TorqueActuatorDef&);
    ActuatorHandle add(const State&, const ForceActuatorDef&);

    bool anySpring() const { return !springs_.empty() || !angularSprings_.empty(); }
    bool any() const { return anySpring() || !torques_.empty() || !forces_.empty(); }
    Index torqueCount() const { return static_cast<Index>(torques_.size()); }
    Index forceCount() const { return static_cast<Index>(forces_.size()); }
    Index springCount() const { return static_cast<Index>(springs_.size()); }
    Index angularSpringCount() const { return static_cast<Index>(angularSprings_.size()); }
    /// restLength < 0: as it is. What is torn stays torn.
    void setSpring(ActuatorHandle, double restLength, double ks, double kd, double tearRatio);
    /// Would that change nothing?
    bool isSet(ActuatorHandle, double restLength, double ks, double kd, double tearRatio) const;
    void setTorque(ActuatorHandle handle, double value) { torques_[handle].value = value; }
    void setForce(ActuatorHandle handle, const Vec2& value) { forces_[handle].force = value; }
    double torque(ActuatorHandle handle) const { return torques_[handle].value; }
    const Vec2& force(ActuatorHandle handle) const { return forces_[handle].force; }
    Index bodyOfTorque(ActuatorHandle handle) const { return torques_[handle].at.body; }
    Index bodyOfForce(ActuatorHandle handle) const { return forces_[handle].at.body; }
    /// Calls visit(body, body) for what the spring holds together; kNone: the background.
    template <class Visit>
    void visitSpring(ActuatorHandle spring, Visit&& visit) const
    {
        visit(springs_[spring].a.body, springs_[spring].b.body);
    }
    /// The same for all whole springs.
    template <class Visit>
    void eachBond(Visit&& visit) const
    {
        for (const Spring& spring : springs_)
            if (spring.alive != 0) visit(spring.a.body, spring.b.body);
        for (const AngularSpring& spring : angularSprings_)
            visit(spring.a.body, spring.centre.body), visit(spring.centre.body, spring.b.body);
    }

    /// Calls visit(body, body, ks, kd) for the whole springs; kNone: the background.
    template <class Visit>
    void eachSpring(Visit&& visit) const
    {
        for (const Spring& spring : springs_)
            if (spring.alive != 0) visit(spring.a.body, spring.b.body, spring.ks, spring.kd);
    }

    /// What whole springs hold: visit(body, body, energy); ½ ks e e', e the strain now, e' before the last move over h.
    template <class Visit>
    void eachEnergy(const State& state, double h, Visit&& visit) const
    {
        for (const Spring& spring : springs_)
            if (spring.alive != 0) visit(spring.a.body, spring.b.body, energy(state, spring, h));
        for (const AngularSpring& spring : angularSprings_)
            visit(spring.a.body != kNone ? spring.a.body : spring.centre.body, spring.b.body, energy(state, spring, h));
    }

    void addTo(StiffnessBounds&, const State&) const;
    /// `plain`: stiffness and damping as they are.
    void prepare(const StiffnessBounds&, double h, bool plain = false);
    /// Adds torques and forces to the nodes; they hold for one substep, as levers turn with their bodies.
    void addForces(State&) const;
    /// Changes velocities by the impulses of springs and angular springs over h.
    void applySprings(State&, double h, bool backwards);
    /// The same as forces of the state as it is, for Method::SemiImplicitEuler.
    void addSpringForces(State&);

    template <class Archive>
    void archive(Archive& with)
    {
        for (Spring& spring : springs_)
            with(spring.alive), with(spring.restLength), with(spring.ks), with(spring.kd), with(spring.tearLength);
        for (AngularSpring& spring : angularSprings_) with(spring.angle);
        for (Torque& torque : torques_) with(torque.value);
        for (Force& force : forces_) with(force.force);
    }

private:
    struct Spring {
        AnchorPoint a, b;
        double restLength, ks, kd, tearLength;
        std::uint8_t alive = 1;
        double stiffness = 0, damping = 0;  // for the prepared substep, as in soft_springs.cpp
    };
    struct AngularSpring {
        AnchorPoint a, centre, b;
        double restAngle, ks, kd, angle;
        double restCompliance;
        double stiffness = 0, damping = 0;  // for the prepared substep, as in soft_springs.cpp
    };
    struct Torque {
        AnchorPoint at;
        double value;
    };
    struct Force {
        AnchorPoint at;
        Vec2 force;
    };

    static double energy(const State&, const Spring&, double h);
    static double energy(const State&, const AngularSpring&, double h);
    static void apply(State&, Spring&, double h);
    static void apply(State&, AngularSpring&, double h);

    std::vector<Spring> springs_;
    std::vector<AngularSpring> angularSprings_;
    std::vector<Torque> torques_;
    std::vector<Force> forces_;
};

}  // namespace jet::physics
