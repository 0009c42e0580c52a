// Contacts and joints of rigid bodies as wide constraints: begin -> bodies, joints, contacts -> then either run() for a
// whole step, or push() and relax() around position changes made elsewhere -> finish.
//
// Constraints of contacts stay from step to step, with their impulses, as long as the contact has points: a contact
// between quiet bodies is not even looked at; carry() moves its separation on.
#pragma once

#include "collider.hpp"
#include "joint.hpp"
#include "snapshot.hpp"
#include "solver_data.hpp"

#include <vector>

namespace jet::physics {

struct StepShape {
    double h = 0;  // seconds a substep
    int substeps = 1;
    double restSpeed = 0;  // units / s
    KernelChoice choice = KernelChoice::Best;
};

/// A pair that began or ceased to touch.
struct TouchChange {
    Index bodyA = 0, bodyB = 0;  // rigid bodies
    bool begins = false;
    float impulse = 0;  // mass units / s
};

template <class Real>
class Solver {
public:
    /// Forgets the joints' constraints; bodies are to be set by body() and push().
    void begin(std::size_t bodies, const StepShape&, Pool&);
    BodyState<Real>& body(Index i) { return states_[i]; }
    BodyPush<Real>& force(Index i) { return pushes_[i]; }

    /// Updates the contacts that are due, and their constraints. `resolve` false: nothing is pushed.
    void refresh(Collider&, double dt, bool resolve);
    void addJoint(Joint&, Index index, const State&, const std::vector<RigidBody>&);

    /// How fast the hardest hit comes, in sizes of the smaller part a second.
    float hardestHit() const { return hardest_; }
    /// Is any contact that was looked at one of a hit to come?
    bool foresees() const { return foresees_; }

    /// After the last constraint. `passes` over all of them; more when something is hit hard.
    void prepare(int passes);
    /// A whole step: velocities and moves of all bodies.
    void run();

    // One substep at a time, for worlds in which other stages move the same bodies between.
    void warm();
    void push();
    void relax();
    void bounce();

    /// Gives the joints their impulses, and notes which contacts touch.
    void finish(Collider&, std::vector<Joint>&);
    const std::vector<TouchChange>& changes() const { return changes_; }

    /// Impulses and separations of a contact that has a constraint, as they are now.
    void fetch(RigidContact&, Place) const;
    /// Takes the constraints of all contacts away; their impulses go back to them.
    void release(Collider&);
    bool holdsContacts() const;
    /// Takes the constraint of a contact between bodies that rest away; its impulses go back to it.
    void suspend(Collider&, Index contact);

    std::size_t colours() const;
    std::size_t bytes() const;

    /// Of the constraints, after the collider, which knows which contact has which.
    template <class Archive>
    void archive(Archive& with, const Collider& collider)
    {
        with(lastH_), with(bounces_);
        if constexpr (std::is_same_v<Archive, RestoreArchive>) place(collider);
        for (Place at : collider.places())
            if (isPlaced(at)) values(at, with);
    }

private:
    struct Colour {
        std::vector<ContactLanes<Real>> contacts;
        std::vector<FrictionLanes<Real>> frictions;
        std::vector<BounceLanes<Real>> bounces;
        std::vector<Index> index;                     // [lanes] of the contact; kNone
        std::vector<std::uint32_t> touched, touches;  // [groups] lanes that touched before, that touch, as bits
        std::size_t count = 0;                        // lanes in use
    };
    struct JointColour {
        std::vector<JointLanes<Real>> joints;
        std::vector<Index> index;
        std::size_t count = 0;
    };
    /// What became of a contact that was looked at.
    struct Outcome {
        Index contact;
        bool kept;
    };

    static constexpr int kColours = 24;  // more are solved one by one, in the last
    static constexpr std::size_t kWidth = kLanes<Real>;

    static Place placeOf(int colour, std::size_t lane)
    {
        return static_cast<Place>(colour) << kLaneBits | static_cast<Place>(lane);
    }
    Colour& colourAt(Place place) { return colours_[place >> kLaneBits]; }
    const Colour& colourAt(Place place) const { return colours_[place >> kLaneBits]; }
    static std::size_t laneAt(Place place) { return place & ((1U << kLaneBits) - 1); }
    /// The first colour neither body is in yet; what does not move is in none.
    static int colourOf(Index a, bool movesA, Index b, bool movesB, std::vector<std::uint32_t>& taken);
    /// Groups [first, last) of a colour, and what was found of them.
    struct Block {
        std::uint32_t colour = 0, first = 0, last = 0;
        float hardest = 0;
        bool foresees = false;
        std::vector<Outcome> outcomes;
    };
    void refreshPlaced(Collider&, double dt, bool resolve);
    void refreshBlock(Collider&, double dt, bool resolve, Block&);
    void refreshIdle(Collider&, double dt, bool resolve);
    Block& blockAt(std::size_t);
    /// Calls work(colour, first group, last) for all colours in turn; groups of one at once.
    template <class Work>
    void eachColour(Work&& work);
    void settle(Collider&, const Outcome&, bool resolve);
    void admit(Collider&, Index contact);
    void remove(Collider&, Index contact);
    void addLane(Colour&, bool alone);
    void write(const Collider&, const RigidContact&, Place);
    void change(RigidContact&, bool touching);
    void place(const Collider&);
    void moveLane(Collider&, Colour&, std::size_t from, std::size_t to);
    template <class Archive>
    void values(Place place, Archive& with)
    {
        Colour& colour = colourAt(place);
        const std::size_t group = laneAt(place) / kWidth, lane = laneAt(place) % kWidth;
        ContactLanes<Real>& g = colour.contacts[group];
        FrictionLanes<Real>& f = colour.frictions[group];
        const auto value = [&](Lanes<Real>& lanes) {
            Real x = lanes[lane];
            with(x);
            lanes[lane] = x;
        };
        with(g.a[lane]), with(g.b[lane]), with(colour.index[laneAt(place)]);
        value(g.normalX), value(g.normalY), value(g.mostPush), value(f.friction);
        for (int k = 0; k < 2; ++k) {
            auto& p = g.points[k];
            auto& q = f.points[k];
            value(p.leverA), value(p.leverB), value(p.separation), value(p.mass), value(p.impulse);
            value(q.leverA), value(q.leverB), value(q.mass), value(q.impulse);
        }
        if (!bounces_) return;
        BounceLanes<Real>& r = colour.bounces[group];
        value(r.restitution), value(r.most[0]), value(r.most[1]);
    }
    void scaleImpulses(Real by);
    void warmAll();
    void solveAll(bool push);
    void solveJointsOnce(bool push);
    void noteAll();
    static std::size_t groups(std::size_t lanes) { return (lanes + kWidth - 1) / kWidth; }

    StepShape shape_;
    int passes_ = 1;
    StepConstants<Real> constants_;
    const Kernels<Real>* kernels_ = nullptr;
    std::vector<BodyState<Real>> states_;
    std::vector<BodyPush<Real>> pushes_;
    std::vector<std::uint32_t> taken_, takenByJoints_;  // [bodies] colours
    std::vector<Colour> colours_;
    std::vector<JointColour> jointColours_;
    std::vector<JointRow<Real>> rows_;
    Pool* pool_ = nullptr;
    std::vector<Block> blocks_;   // never shrinks, so that nothing is allocated in a steady step
    std::vector<Index> idleDue_;  // contacts
    std::vector<TouchChange> changes_;
    double lastH_ = 0;  // seconds: the impulses are of substeps of this
    float hardest_ = 0;
    bool foresees_ = false;
    bool bounces_ = false;  // does any contact have restitution?
};

extern template class Solver<float>;
extern template class Solver<double>;

}  // namespace jet::physics
