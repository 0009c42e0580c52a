// Joints that hold a soft body: to a rigid one, to another soft one, or to the background.
//
// A joint does not hold a soft body as a whole, but a patch of it: the particles within Anchor::radius, or those
// nearest to the point. For the joint the patch is a rigid body of their mass and moment of inertia: where they are,
// how they move and how the patch has turned (the best fit of its shape at rest) is summed over the particles, and what
// the joint changes of it is given back to them, so that momentum and angular momentum are kept. So a patch takes the
// same rows as a rigid body (rigid/joint.hpp). A single particle cannot turn: what needs a direction is refused.
#pragma once

#include "pulls.hpp"
#include "rigid/joint.hpp"

#include <algorithm>
#include <utility>

namespace jet::physics::soft {

class Joints {
public:
    /// Checks the anchors; throws a Failure that tells what is missing.
    /// `place`: of a removed joint, that it takes over.
    Index add(const State&, const JointDef&, Index place = kNone);
    bool empty() const { return joints_.empty(); }
    Index count() const { return static_cast<Index>(joints_.size()); }
    const JointDef& def(Index joint) const { return joints_[joint].joint.def; }
    bool lives(Index joint) const { return joints_[joint].joint.lives(); }
    const Joint& joint(Index joint) const { return joints_[joint].joint; }

    void push(State&, double h, bool warmed = false);
    /// What push() else begins with, for others to act in between.
    void warm(State&, double h);
    void relax(State&);
    /// After the last substep of a step of dt: what the joints bore; true when one broke under it.
    bool finish(const State&, double dt);
    /// Calls visit(body, body) for each that is whole; kNone: the background.
    template <class Visit>
    void eachBond(Visit&& visit) const
    {
        for (const Held& held : joints_)
            if (held.joint.lives()) visit(bodyOf(held.joint.def.a), bodyOf(held.joint.def.b));
    }
    /// Bodies that joints keep from colliding; ascending.
    std::vector<std::pair<Index, Index>> excluded() const;
    /// Does any of them hold the body?
    bool holds(Index body) const
    {
        return std::any_of(joints_.begin(), joints_.end(), [body](const Held& held) {
            if (held.joint.removed) return false;
            return bodyOf(held.joint.def.a) == body || bodyOf(held.joint.def.b) == body;
        });
    }
    /// Warm-start impulses are of one substep: for others of another length.
    void scale(double ratio);

    /// Calls visit(body, body, pulley) for what acts; kNone: the background.
    template <class Visit>
    void eachHeld(const State& state, Visit&& visit) const
    {
        using Kind = JointDef::Kind;
        for (const Held& held : joints_) {
            const JointDef& def = held.joint.def;
            if (!pulls(state, held)) continue;
            visit(bodyOf(def.a), bodyOf(def.b), def.kind == Kind::Pulley);
        }
    }
    /// What motors and mice gave since this was asked: visit(body, body, energy).
    template <class Visit>
    void takeGiven(Visit&& visit)
    {
        for (Held& held : joints_)
            if (held.given != 0)
                visit(bodyOf(held.joint.def.a), bodyOf(held.joint.def.b), std::exchange(held.given, 0.0));
    }
    /// What springs of their own hold: visit(body, body, energy).
    template <class Visit>
    void eachEnergy(const State& state, double h, Visit&& visit)
    {
        for (Held& held : joints_)
            if (held.joint.def.hertz > 0 && held.joint.def.kind != JointDef::Kind::Mouse && pulls(state, held))
                visit(bodyOf(held.joint.def.a), bodyOf(held.joint.def.b), energy(state, held, h));
    }

    /// Scales what the joints of such bodies start the next substep with.
    template <class Holds>
    void scale(double part, Holds&& holds)
    {
        for (Held& held : joints_) {
            const JointDef& def = held.joint.def;
            if (!holds(bodyOf(def.a)) && !holds(bodyOf(def.b))) continue;
            for (double& impulse : held.joint.impulse) impulse *= part;
        }
    }

    /// How much of their errors the joints may push out: partOf(body, body), 0 to 1. All, where somebody put them
    /// there.
    template <class PartOf>
    void allow(PartOf&& partOf)
    {
        for (Held& held : joints_)
            held.part = held.settling > 0 ? 1 : partOf(bodyOf(held.joint.def.a), bodyOf(held.joint.def.b));
    }

    JointState state(const State&, Index joint) const;
    void setMotor(Index joint, bool driven, double speed);
    /// All that liveDef() takes.
    void set(const State&, Index joint, const JointDef&);
    /// False when neither end is the background.
    bool setTarget(Index joint, const Vec2& target);
    /// What it knew of the patches it held is given back when another joint takes its place.
    void remove(Index joint) { joints_[joint].joint.removed = true; }
    std::size_t bytes() const;

    template <class Archive>
    void archive(Archive& with)
    {
        for (Held& held : joints_)
            if (!isPull(held.joint.def)) archive(with, held);
    }
    template <class Archive>
    void archivePulls(Archive& with, const State& state)
    {
        physics::archivePulls(
            with, joints_, [](const Held& held) { return isPull(held.joint.def); },
            [&](Held& held) {
                archivePull(with, held.joint.def);
                with(held.joint.a), with(held.joint.b), with(held.joint.restAngle);
                archivePatch(with, held.a), archivePatch(with, held.b);
                archive(with, held);
                if (!isPull(held.joint.def) || !fits(state, held)) RestoreArchive::fail();
            });
    }
    /// A body fell into pieces: of what a pull holds it keeps the piece its point lies in. What else joints hold they
    /// keep as a whole: their patches are no part of a state.
    void keepPieces(const State&);
    void dropPulls()
    {
        physics::dropPulls(joints_, [](const Held& held) { return isPull(held.joint.def); });
    }

private:
    /// One end: nodes of the world; none: the background; one of a rigid body; particles of a soft one.
    struct Hold {
        bool rigid = false;
        std::vector<Index> nodes;
        std::vector<Vec2> rest;  // particles from their centre of mass, when the joint was added
        Vec2 local;              // the anchored point, from the centre, in the patch's frame; background: the scene's
        double angle = 0;        // radians since, unwrapped
        double lag = 0;          // radians that the best fit of its shape is ahead
        double gyration = 0;     // units²: moment of inertia a mass, at rest

        bool background() const { return nodes.empty(); }
        bool turns() const { return background() || rigid || nodes.size() > 1; }
    };
    enum class Act { Warm, Push, WarmAndPush, Relax };
    /// With the impulses of the substep before.
    static bool begins(Act what) { return what == Act::Warm || what == Act::WarmAndPush; }
    struct Pose {
        Vec2 centre = Vec2(0, 0), velocity = Vec2(0, 0), rotation = Vec2(1, 0);
        double angle = 0, omega = 0, invMass = 0, invInertia = 0;
        double lag = 0;  // as of Hold
    };
    struct Held {
        Joint joint;  // a and b: 0 the background, else 1 and 2
        Hold a, b;
        double far = 0;            // units: errors beyond are not pushed out at once
        double part = 1;           // of which that is done now
        double settling = 0;       // seconds for which errors count as put there, by adding or changing the joint
        double springMass = 0;     // that its spring's hertz was given for: effective, when the joint was added
        double given = 0;          // energy, by its motor or mouse
        Vec2 pushed = Vec2(0, 0);  // impulses on b in this step
        double turned = 0;
        double work = 0, stored = 0;  // of this substep: done on the ends; in springs at its start
    };

    template <class Archive>
    static void archive(Archive& with, Held& held)
    {
        Joint& joint = held.joint;
        with(joint.removed), with(joint.broken), with(joint.impulse), with(joint.length), with(joint.localAxis);
        with(held.a.angle), with(held.b.angle), with(held.a.local), with(held.b.local), with(held.springMass);
        with(held.a.lag), with(held.b.lag);
        with(held.settling);
        JointDef& def = joint.def;
        with(def.driven), with(def.motorSpeed), with(def.motorVelocity), with(def.limited), with(def.lower);
        with(def.upper), with(def.maxForce), with(def.maxTorque), with(def.hertz), with(def.dampingRatio);
        with(def.ratio), with(def.breakForce), with(def.axis), with(def.collide);
        with(joint.state.force), with(joint.state.torque);
    }
    template <class Archive>
    static void archivePatch(Archive& with, Hold& hold)
    {
        with(hold.rigid), with(hold.gyration);
        with.list(hold.nodes, [&](Index& node) { with(node); });
        with.list(hold.rest, [&](Vec2& place) { with(place); });
    }
    static bool fits(const State&, const Held&);
    static Hold hold(const State&, const Anchor&);
    static void keepPiece(const State&, Joint&, Hold&, const BodyRecord&);
    static void requireDirection(const JointDef&, const Hold& a, const Hold& b);
    /// moved: seconds by which particles moved since the hold's angle was known.
    static Pose poseOf(const State&, const Hold&, double moved = 0);
    static void follow(const Hold&, double likeness, double moved, Pose&);
    static void give(State&, const Hold&, const Pose& before, const BodyState<double>& after);
    static JointFrame frame(const Held&, const Pose& a, const Pose& b);
    bool settle(Held&, double dt);
    static bool pulls(const State&, const Held&);
    /// Is all that it holds asleep, or does it stand?
    static bool rests(const State&, const Held&);
    static Index bodyOf(const Anchor& anchor) { return anchor.body == kNoHandle ? kNone : anchor.body; }
    void addPoint(const Joint&, const JointFrame&);
    void makeRows(const Held&, const Pose& a, const Pose& b, double h);
    void keepStiffness(const Held&, JointRow<double>&, double h) const;
    void solveRows(Held&, Act);
    double energy(const State&, Held&, double h);
    void solve(State&, Held&, Act);
    void takeGain(Held&);

    std::vector<Held> joints_;
    double h_ = 0;
    // Scratch.
    std::vector<JointRow<double>> rows_;
    std::vector<BodyState<double>> ends_;
};

}  // namespace jet::physics::soft
