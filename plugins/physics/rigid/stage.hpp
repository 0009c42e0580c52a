// Rigid bodies of simple shape in a world: from the contract's definitions to parts and joints, and their share of a
// step. What is concave, has holes or many corners goes by points and walls (contact_finder.hpp) instead, as does every
// pair with a soft body.
#pragma once

#include "collider.hpp"
#include "drawn.hpp"
#include "nets.hpp"
#include "pulls.hpp"
#include "solver.hpp"
#include "touches.hpp"

#include <functional>

namespace jet::physics {

/// What holds bodies together, or awake, beside contacts and joints of their own; handles.
struct Bonds {
    std::vector<std::pair<Index, Index>> pairs;
    std::vector<Index> awake;
};

class RigidStage {
public:
    /// The body's borders; fails with a sentence where they are too intricate.
    static Drawing takeApart(const RigidBodyDef&);
    /// About the centre of mass; none: the outline is not simple.
    static std::vector<DrawnPart> partsOf(const RigidBodyDef&, const Drawing&, const Vec2& centre, double length);
    /// Its node is where it shall be. Where the handle was that of a removed body, that one had as many parts.
    void add(const State&, Index handle, const RigidBodyDef&, const std::vector<DrawnPart>&, double gyration);
    /// One that has been switched off.
    void remove(const State&, Index handle);
    /// Its radius, units.
    double gyrationOf(Index handle) const { return collider_.bodies()[bodyOf(handle)].gyration; }
    /// Of a body that has no other.
    const Part& onlyPart(Index handle) const { return collider_.parts()[collider_.bodies()[bodyOf(handle)].firstPart]; }
    std::span<const Part> convexPartsOf(Index handle) const
    {
        const RigidBody& body = collider_.bodies()[bodyOf(handle)];
        return std::span(collider_.parts()).subspan(body.firstPart, body.partCount);
    }
    bool has(Index handle) const { return bodyOf(handle) != 0; }
    std::size_t count() const { return collider_.bodies().size() - 1 - removed_; }
    bool empty() const { return count() == 0; }

    /// `place`: of a removed joint, that it takes over.
    Index addJoint(const State&, const JointDef&, Index place = kNone);
    const Joint& joint(Index index) const { return joints_[index]; }
    /// Of the last step.
    const JointState& stateOf(Index joint)
    {
        tellJoints();
        return joints_[joint].state;
    }
    Index jointCount() const { return static_cast<Index>(joints_.size()); }
    void removeJoint(Index);
    /// All but the kind and the anchors.
    void setJoint(const State&, Index, const JointDef&);
    void setMotor(Index joint, bool driven, double speed);
    /// Where it is held on the background.
    void setTarget(Index joint, const Vec2&);
    /// They are sought afresh, and their impulses are forgotten.
    void forgetPairs();

    // Live changes, see live.cpp; the body is awake, and its node is what it shall be.
    void set(const State&, Index handle, const BodyCommon&);
    /// Are the properties that only this stage knows of what they shall be?
    bool isSet(Index handle, const BodyCommon&) const;
    void enable(const State&, Index handle, bool enabled);

    /// The whole step, where nothing else moves: `forces` and torques lie in the nodes.
    void step(State&, const WorldSettings&, double dt, StepStats&);

    // Or in turns with the other stages, in double precision: begin, then each substep push and relax around the move.
    void begin(State&, const WorldSettings&, double h, double dt, StepStats&);
    /// `midst`: what others do after warm starting, before joints and contacts are solved.
    void push(State&, const std::function<void()>& midst = {});
    void relax(State&);
    void finish(State&, bool bounce);

    // Sleep: see rest.cpp.
    /// Is it time to look who rests, after a step of dt?
    bool restDue(double dt);
    /// Lets groups of bodies that rest fall asleep.
    void rest(State&, const WorldSettings&, const Bonds&);
    void wake(State&, Index handle);
    void wakeAll(State&);
    /// A body that is not pushed begins to move, or is moved: what rests on it wakes.
    void stir(State&, Index handle);
    /// Has the step nothing to do?
    bool allAsleep(const State&) const;
    /// In place of such a step.
    void skip();
    /// Called in the midst of a step, when groups have woken; may wake others.
    void onWaking(std::function<void()> call) { alsoWake_ = std::move(call); }
    /// The handle of one body of the group that the body fell asleep with.
    Index groupOf(Index handle) const { return collider_.bodies()[group_[bodyOf(handle)]].handle; }
    bool anyAsleep() const { return sleepers_ > 0; }
    bool asleep(Index handle) const { return has(handle) && collider_.bodies()[bodyOf(handle)].asleep; }

    void report(std::vector<Contact>&, std::vector<std::uint64_t>& touching) const;
    const std::vector<ContactEvent>& events() const { return events_; }
    const Collider& collider() const { return collider_; }
    /// Something about the body was changed from outside.
    void disturb(Index handle);
    /// Bodies that stand were moved or changed.
    void rearrange() { collider_.rearrange(); }
    std::size_t bytes() const;
    /// Of steps; between them it holds nothing of theirs.
    Arena& arena() { return arena_; }
    Pool& pool() { return pool_; }
    void fitRoom() { collider_.fitRoom(), bodyOf_.shrink_to_fit(); }

    template <class Archive>
    void archive(Archive& with)
    {
        collider_.archive(with);
        watches_.resize(collider_.bodies().size()), group_.resize(collider_.bodies().size(), kNone);
        with(watches_), with(group_), with(sinceLook_), with(restH_), with(sleepers_), with(drowsy_), with(woke_);
        with(resolving_), with(substeps_);
        for (RigidBody& body : collider_.bodies()) {
            const auto flag = [&with](bool value) {
                with(value);
                return value;
            };
            std::uint32_t looks = body.looks;
            with(looks);
            body.looks = looks & 3;
            body.asleep = flag(body.asleep), body.enabled = flag(body.enabled), body.moves = flag(body.moves);
            body.kinematic = flag(body.kinematic), body.sensor = flag(body.sensor), body.mayRest = flag(body.mayRest);
            Rules rules = collider_.rulesOf(body);
            with(rules);
            if constexpr (std::is_same_v<Archive, RestoreArchive>) collider_.setRules(body, rules);
        }
        with.list(ended_, [&](Parting& parting) { with(parting); });
        nets_.archive(with);
        with(active_);
        if (active_ == Active::Single) single_.archive(with, collider_);
        if (active_ == Active::Double) double_.archive(with, collider_);
        if constexpr (std::is_same_v<Archive, RestoreArchive>) {
            single_.dropJoints(), double_.dropJoints();
        } else {
            tellJoints();
        }
        for (Joint& joint : joints_)
            if (!isPull(joint.def)) archive(with, joint);
    }
    template <class Archive>
    void archivePulls(Archive& with)
    {
        physics::archivePulls(
            with, joints_, [](const Joint& joint) { return isPull(joint.def); },
            [&](Joint& joint) {
                archivePull(with, joint.def);
                with(joint.a), with(joint.b), with(joint.restAngle);
                archive(with, joint);
                const std::size_t bodies = collider_.bodies().size();
                if (!isPull(joint.def) || joint.a >= bodies || joint.b >= bodies || (joint.a == 0) == (joint.b == 0))
                    RestoreArchive::fail();
            });
    }
    void dropPulls()
    {
        physics::dropPulls(joints_, [](const Joint& joint) { return isPull(joint.def); });
    }
    void rebuild()
    {
        collider_.rebuild();
        collider_.includeAll();
        for (const Joint& joint : joints_)
            if (joint.keepsApart()) collider_.exclude(joint.a, joint.b);
        if (active_ != Active::Single) single_ = {};  // it was not in the state, and knows contacts of another one
        if (active_ != Active::Double) double_ = {};
        countMovers();
        recountTouches();
        ++jointsVersion_;
    }

private:
    template <class Archive>
    static void archive(Archive& with, Joint& joint)
    {
        with(joint.removed), with(joint.broken), with(joint.impulse), with(joint.substep);
        with(joint.state.force), with(joint.state.torque);
        with(joint.localA), with(joint.localB), with(joint.localAxis), with(joint.length);
        JointDef& def = joint.def;
        with(def.limited), with(def.lower), with(def.upper), with(def.driven), with(def.motorSpeed);
        with(def.motorVelocity), with(def.maxForce), with(def.maxTorque), with(def.hertz);
        with(def.dampingRatio), with(def.ratio), with(def.breakForce), with(def.axis), with(def.collide);
    }
    /// 0: it is not here.
    Index bodyOf(Index handle) const
    {
        if (handle < ownHandles_) return handle + 1;
        return handle - ownHandles_ < bodyOf_.size() ? bodyOf_[handle - ownHandles_] : 0;
    }
    void keepBodyOf(Index handle, Index body);
    StepShape shapeOf(const WorldSettings&, double dt, bool large) const;
    template <class Real>
    void solve(Solver<Real>&, State&, const WorldSettings&, double dt, StepStats&);
    template <class Real>
    void load(Solver<Real>&, const State&);
    template <class Real>
    void startJoints(Solver<Real>&, const State&);
    void tellJoints();
    template <class Real>
    void look(Solver<Real>&, State&, const WorldSettings&, double dt, StepStats&);
    template <class Real>
    void refresh(Solver<Real>&, State&, const WorldSettings&, double dt);
    /// Leans: rests if it touches others.
    enum class Stillness : std::uint8_t { Moves, Leans, Rests };
    void wakeGroup(State&, Index group);
    Stillness stillness(Index body, const State&, double gravity, double interval);
    bool driven(Index body, const State&) const;
    void unite(const State&, const Bonds&);
    void fallAsleep(State&);
    void scaleSleeping(double h);
    void activate(bool singles);
    template <class Real>
    void advance(Solver<Real>&, State&, double dt);
    template <class Real>
    void restrain(Solver<Real>&, const State&, double dt);
    void exchange(State&, bool store);
    void noteTouches(const std::vector<TouchChange>&);
    bool haveOnlyPair(Index a, Index b) const;
    void recountTouches();
    void part(const RigidContact&);
    void replace(Index removed, const RigidBody&, const Rules&, const std::vector<DrawnPart>&);
    void forgetContacts(Index body);
    void forgetContactsIf(const std::function<bool(const RigidContact&)>&);
    void decideMeeting(const Joint&);
    void changed(Index body);
    void countMovers();
    void breakJoints();

    /// Which solver holds the contacts' constraints.
    enum class Active : std::uint8_t { None, Single, Double };

    Pool pool_;
    Arena arena_;
    Collider collider_;
    Active active_ = Active::None;
    bool resolving_ = true;
    Index ownHandles_ = 0;       // handles below are those of body handle + 1
    std::vector<Index> bodyOf_;  // [handles from there on] 0: not here
    std::vector<Joint> joints_;
    std::uint64_t jointsVersion_ = 1;   // counts changes of what the solver knows of joints
    std::uint64_t brittleVersion_ = 0;  // that `brittle_` is of
    bool brittle_ = false;              // may any of them break?
    Nets nets_;
    Solver<float> single_;
    Solver<double> double_;
    std::vector<ContactEvent> events_;
    /// Two bodies, by their handles, that touched until one of them was changed.
    struct Parting {
        Index a = 0, b = 0;
    };
    std::vector<Parting> ended_;  // since the last step
    Touches touches_;
    std::vector<Vec2> start_;
    std::vector<double> startAngle_;
    std::vector<float> allowed_;
    std::vector<Nets::Budget>
        budgets_;          // [bodies] at the start of the step, and given by others since; of those it moves
    double substeps_ = 1;  // of the last step

    /// How a body moved between the last looks at it. Turns are ways of its farthest point.
    struct Watch {
        float placeX = 0, placeY = 0, placeTurned = 0;  // near which it has stayed
        float x = 0, y = 0, turned = 0;                 // as of the last look, from there
        float velocityX = 0, velocityY = 0, swing = 0;  // mean before the last look
        float stayed = 0;                               // seconds
    };
    std::vector<Watch> watches_;  // [bodies]
    std::vector<Index> group_;    // [bodies] that fell asleep together: the least of them
    std::span<Stillness> still_;  // [bodies] of rest(), in the arena
    double sinceLook_ = 0;        // seconds
    double restH_ = 0;            // substep the impulses of sleeping contacts are of, seconds
    std::uint32_t sleepers_ = 0;  // bodies
    bool drowsy_ = false;         // has one fallen asleep after the last step?
    bool woke_ = false;           // has a body woken since contacts were last looked at?
    std::function<void()> alsoWake_;
    Index movers_ = 0;
    std::size_t removed_ = 0;       // bodies
    std::vector<Index> kinematic_;  // bodies
};

}  // namespace jet::physics
