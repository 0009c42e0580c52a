// Rigid bodies of simple shape in a world: from the contract's definitions to parts and joints, and their share of a
// step. What is concave, has holes or many corners goes by points and walls (contact_finder.hpp) instead, as does every
// pair with a soft body.
#pragma once

#include "collider.hpp"
#include "solver.hpp"

namespace jet::physics {

class RigidStage {
public:
    /// Takes the body if its outline is simple; its node is where it shall be. Says whether it did.
    bool add(const State&, Index handle, const RigidBodyDef&);
    bool has(Index handle) const { return handle < bodyOf_.size() && bodyOf_[handle] != 0; }
    std::size_t count() const { return collider_.bodies().size() - 1; }
    bool empty() const { return count() == 0; }

    Index addJoint(const State&, const JointDef&);
    Joint& joint(Index index) { return joints_[index]; }
    const Joint& joint(Index index) const { return joints_[index]; }
    Index jointCount() const { return static_cast<Index>(joints_.size()); }
    void removeJoint(Index);
    /// All but the kind and the anchors.
    void setJoint(const State&, Index, const JointDef&);
    /// They are sought afresh, and their impulses are forgotten.
    void forgetPairs();

    /// The whole step, where nothing else moves: `forces` and torques lie in the nodes.
    void step(State&, const WorldSettings&, double dt, StepStats&);

    // Or in turns with the other stages, in double precision: begin, then each substep push and relax around the move.
    void begin(State&, const WorldSettings&, double h, double dt, StepStats&);
    void push(State&);
    void relax(State&);
    void finish(State&, bool bounce);

    void report(std::vector<Contact>&, std::vector<std::uint64_t>& touching) const;
    const std::vector<ContactEvent>& events() const { return events_; }
    const Collider& collider() const { return collider_; }
    /// Something about the body was changed from outside.
    void disturb(Index handle);
    /// Bodies that stand were moved or changed.
    void rearrange() { collider_.rearrange(); }
    std::size_t bytes() const;

    template <class Archive>
    void archive(Archive& with)
    {
        collider_.archive(with);
        with(active_);
        if (active_ == Active::Single) single_.archive(with, collider_);
        if (active_ == Active::Double) double_.archive(with, collider_);
        for (Joint& joint : joints_) {
            with(joint.removed), with(joint.broken), with(joint.impulse);
            with(joint.localA), with(joint.localB), with(joint.localAxis), with(joint.length);
            JointDef& def = joint.def;
            with(def.limited), with(def.lower), with(def.upper), with(def.driven), with(def.motorSpeed);
            with(def.motorVelocity), with(def.maxForce), with(def.maxTorque), with(def.hertz);
            with(def.dampingRatio), with(def.ratio), with(def.breakForce), with(def.collide);
        }
    }
    void rebuild()
    {
        collider_.rebuild();
        if (active_ != Active::Single) single_ = {};  // it was not in the state, and knows contacts of another one
        if (active_ != Active::Double) double_ = {};
    }

private:
    StepShape shapeOf(const WorldSettings&, double dt, bool large) const;
    template <class Real>
    void solve(Solver<Real>&, State&, const WorldSettings&, double dt, StepStats&);
    template <class Real>
    void load(Solver<Real>&, const State&);
    template <class Real>
    void addJoints(Solver<Real>&, const State&);
    template <class Real>
    void look(Solver<Real>&, const State&, const WorldSettings&, double dt, StepStats&);
    void activate(bool singles);
    template <class Real>
    void advance(Solver<Real>&, State&, double dt);
    void exchange(State&, bool store);
    void noteTouches(const std::vector<TouchChange>&);
    void breakJoints();

    /// Which solver holds the contacts' constraints.
    enum class Active : std::uint8_t { None, Single, Double };

    Pool pool_;
    Collider collider_;
    Active active_ = Active::None;
    bool resolving_ = true;
    std::vector<Index> bodyOf_;  // [handles] 0: not here
    std::vector<Joint> joints_;
    Solver<float> single_;
    Solver<double> double_;
    std::vector<ContactEvent> events_;
    std::vector<Vec2> start_, moves_;
    std::vector<double> startAngle_, turns_;
    std::vector<float> allowed_;
    double substeps_ = 1;  // of the last step
};

}  // namespace jet::physics
