// Contacts and joints of rigid bodies as wide constraints: begin -> bodies, joints, contacts -> then either run() for a
// whole step, or push() and relax() around position changes made elsewhere -> finish.
//
// Constraints of contacts stay from step to step, with their impulses, as long as the contact has points: a contact
// between quiet bodies is not even looked at; carry() moves its separation on.
#pragma once

#include "collider.hpp"
#include "domains.hpp"
#include "joint.hpp"
#include "sharing.hpp"
#include "snapshot.hpp"
#include "solver_data.hpp"

#include <algorithm>
#include <functional>
#include <vector>

namespace jet::physics {

struct StepShape {
    double h = 0;  // seconds a substep
    int substeps = 1;
    double restSpeed = 0;  // units / s
    double linearKept = 1,
           angularKept = 1;  // velocity left by damping after a substep
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
    /// Bodies are to be set by body() and push().
    /// The arena is new, and the solver's until the step ends.
    void begin(std::size_t bodies, const StepShape&, Pool&, Arena&);
    /// Is the body, which does not move, where only what moves may be? Then the bodies are to be divided anew.
    bool isAstray(Index body) const { return domains_.nodeOf(body) != Domains::kRoot; }
    /// Divides the bodies anew when that is due; between begin() and the first use of a body.
    void divide(Collider&, const State&, const std::vector<Joint>&, bool anyway);
    BodyState<Real>& body(Index i) { return states_[domains_.slotOf(i)]; }
    const BodyState<Real>& body(Index i) const { return states_[domains_.slotOf(i)]; }
    /// Of the step; see pushBodies().
    const BodyPush<Real>& pushOf(Index i) const { return pushes_[domains_.slotOf(i)]; }
    /// Calls work(body, state) for all bodies, many at once.
    template <class Work>
    void eachBody(Work&& work)
    {
        domains_.eachBody(
            *pool_, [&](Index body, Index slot) { work(body, states_[slot]); },
            [&](Index, Index slot) { __builtin_prefetch(&states_[slot]); });
    }
    /// The same, which is to write the states.
    template <class Work>
    void setBodies(Work&& work)
    {
        domains_.eachBody(
            *pool_, [&](Index body, Index slot) { work(body, states_[slot]); },
            [&](Index, Index slot) { prefetchToWrite(&states_[slot]); });
    }
    /// After contacts were looked at: calls work(body, push) for all bodies, which is to fill them in.
    template <class Work>
    void pushBodies(Work&& work)
    {
        pushes_ = arena_->take<BodyPush<Real>>(domains_.slotCount());
        pushes_[0] = BodyPush<Real>();
        domains_.eachBody(
            *pool_, [&](Index body, Index slot) { work(body, pushes_[slot]); },
            [&](Index, Index slot) { prefetchToWrite(&pushes_[slot]); });
    }
    const Domains& domains() const { return domains_; }

    /// Updates the contacts that are due, and their constraints. `resolve` false: nothing is pushed.
    void refresh(Collider&, double dt, bool resolve);
    /// Lays the constraints of joints out, unless they are those of `version` of the joints and their bodies.
    void layOutJoints(std::vector<Joint>&, const std::vector<RigidBody>&, std::uint64_t version);
    /// For where their bodies are.
    void startJoints(const std::vector<Joint>&, const State&, const std::vector<RigidBody>&);
    /// Between steps: gives the joints the impulses of the last one, where they do not have them yet.
    void tellJoints(std::vector<Joint>&);
    /// The same, and forgets them.
    void releaseJoints(std::vector<Joint>&);
    void dropJoints();
    /// The impulses that their next step starts with.
    void scaleJoints(std::vector<Joint>&, const std::function<double(const Joint&)>& factor);

    /// The nodes' directions follow from their angles, in a world where all of them are bodies. `beside` is called
    /// once, maybe by another thread.
    void turn(Nodes&, const std::function<void()>& beside) const;

    const StepShape& shape() const { return shape_; }
    /// Did errors of joints come to more than a small part of their arms?
    bool strained() const
    {
        return std::any_of(std::begin(strained_), std::end(strained_), [](bool is) { return is; });
    }
    /// Calls work(row, error) for all rows of joints, with their present errors.
    template <class Work>
    void eachRow(Work&& work) const
    {
        for (const auto& rows : rows_)
            for (const JointRow<Real>& row : rows) work(row, row.error + row.moved(states_.data()));
    }

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

    /// Notes which contacts touch.
    void finish(Collider&, std::vector<Joint>&);
    const std::vector<TouchChange>& changes() const { return changes_; }

    /// Impulses and separations of a contact that has a constraint, as they are now.
    void fetch(RigidContact&, Place) const;
    /// What one of its points was given along the normal in the step, mass units / s.
    Real total(Place place, int point) const
    {
        return colourAt(place).frictions[laneAt(place) / kWidth].points[point].total[laneAt(place) % kWidth];
    }
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
        with(lastH_), with(bounces_), with(bordersThen_), with(sinceDivided_);
        domains_.archive(with, collider.bodies().size());
        if constexpr (std::is_same_v<Archive, RestoreArchive>) place(collider);
        for (Place at : collider.places())
            if (isPlaced(at)) values(at, with);
    }

private:
    struct Colour {
        std::vector<ContactLanes<Real>> contacts;
        std::vector<FrictionLanes<Real>> frictions;
        std::vector<BounceLanes<Real>> bounces;
        std::vector<Index> index;  // [lanes] of the contact; kNone
        std::vector<std::uint32_t> touched,
            touches;            // [groups] lanes that touched before, that touch, as bits
        std::size_t count = 0;  // lanes in use
    };
    struct JointColour {
        std::vector<JointLanes<Real>> joints;
        std::vector<AnchorLanes<Real>> anchors;
        std::vector<Index> index;  // [lanes] of the joint; kNone
        std::size_t count = 0;
    };
    /// A joint that has rows, and the slots of its bodies.
    struct Rowed {
        Index joint, a, b;
    };
    using Node = Domains::Node;
    /// What became of a contact that was looked at.
    struct Outcome {
        Index contact;
        Node node;    // that it belongs to
        bool kept;    // false: the pair is forgotten
        bool rouses;  // a sleeping body: that wakes first, and nothing else becomes of it
    };
    /// What the outcomes of a node leave to all; in a line of its own.
    struct alignas(64) Settling {
        std::vector<TouchChange> changes;
        float hardest = 0;
    };

    /// Colours each body is in, as bits, on each level of the tree of domains that there is.
    struct Taken {
        std::vector<std::uint32_t> levels[Domains::kLevels];
        void resize(std::size_t bodies, int depth)
        {
            for (int level = 0; level <= depth; ++level) levels[level].resize(bodies, 0);
        }
        void clear()
        {
            for (auto& level : levels) std::fill(level.begin(), level.end(), 0U);
        }
        std::size_t bytes() const
        {
            std::size_t sum = 0;
            for (const auto& level : levels) sum += level.capacity() * sizeof(std::uint32_t);
            return sum;
        }
    };

    static constexpr std::size_t kColours = 24;  // of a node; more are solved one by one, in the last
    static constexpr std::size_t kWidth = kLanes<Real>;

    static Place placeOf(std::size_t colour, std::size_t lane)
    {
        return static_cast<Place>(colour) << kLaneBits | static_cast<Place>(lane);
    }
    Colour& colourAt(Place place) { return colours_[place >> kLaneBits]; }
    const Colour& colourAt(Place place) const { return colours_[place >> kLaneBits]; }
    static std::size_t laneAt(Place place) { return place & ((1U << kLaneBits) - 1); }
    static std::size_t firstColourOf(Node node) { return (node - std::size_t{1}) * kColours; }
    static Node nodeOf(std::size_t colour) { return static_cast<Node>(colour / kColours + 1); }
    /// In the last colour of a node lanes may share bodies.
    static bool isLast(std::size_t colour) { return colour % kColours == kColours - 1; }
    Node nodeOf(Index a, bool movesA, Index b, bool movesB) const;
    /// The first colour of their node that neither body is in yet; what does not move is in none.
    std::size_t colourOf(Index a, bool movesA, Index b, bool movesB, Taken& taken) const;
    std::uint32_t& takenOf(Taken& taken, Index body, Node node) const
    {
        return taken.levels[Domains::levelOf(node)][body];
    }
    /// Groups [first, last) of a colour, or some contacts without points, and what was found of them.
    struct alignas(64) Block {
        std::vector<Outcome> outcomes;
        float hardest = 0;
        bool foresees = false, bounces = false;  // may any of the outcomes bounce?
        std::uint32_t colour = 0, first = 0, last = 0;
        std::vector<Index> due;  // contacts to be looked at
        std::vector<Collider::Look> looks;
    };
    std::size_t listPlaced();
    void refreshPlaced(Collider&, double dt, bool resolve, Block&);
    std::uint32_t dueLanes(const Colour&, std::size_t group, bool all) const;
    void listDue(Collider&, Block&);
    class Rewriter;
    void refreshIdle(Collider&, double dt, bool resolve, std::size_t first, std::size_t last, Block&);
    void settleBlocks(Collider&, std::size_t count, bool resolve);
    Block& blockAt(std::size_t);
    /// Calls work(node), children before their parents, otherwise at once.
    template <class Work>
    void eachNode(Work&& work);
    /// The same, again and again: work(round, node).
    template <class Work>
    void eachNode(std::size_t rounds, Work&& work);
    /// Once through all constraints.
    struct Pass {
        enum class Kind : std::uint8_t { Warm, Push, Relax } kind = Kind::Warm;
        int again = 0;       // of the same kind in this substep
        bool moves = false;  // are bodies moved before?
        bool first = false;  // substep
        bool last = false;   // of the substep
    };
    int relaxPasses() const;
    Pass passAt(std::size_t) const;
    void pass(const Pass&, Node);
    void moveBodies(const Pass&, Index first, Index count);
    void moveBodies(const Pass&, Node);
    void listShared();
    void askForShared(Node) const;
    /// Calls work(colour) for the colours of a node in turn.
    template <class Work>
    void eachColour(Node node, Work&& work);
    /// Calls work(contacts, frictions, count) for groups that have no moving body in common, in turn.
    template <class Work>
    void eachRun(Node node, Work&& work);
    void countUsed();
    bool isDivisionDue(const Collider&, std::size_t joints, int& depth) const;
    std::size_t borderContacts() const;
    void moveToNodes(Collider&);
    static void copyLane(const Colour& from, std::size_t source, Colour& to, std::size_t target, bool bounces);
    static void clear(Colour&);
    void forgetPairs(Collider&, std::size_t count);
    void settleNode(Collider&, std::size_t count, Node, bool resolve);
    void settle(Collider&, const Outcome&, bool resolve, Settling&);
    void admit(Collider&, Index contact, Settling&);
    void remove(Collider&, Index contact);
    void addLane(Colour&, bool alone);
    void write(const Collider&, const RigidContact&, Place);
    static void change(RigidContact&, bool touching, std::vector<TouchChange>&);
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
        for (std::int32_t* far : {&g.a[lane], &g.b[lane]}) {
            Index slot = slotAt<Real>(*far);
            with(slot);
            *far = farOf<Real>(slot);
        }
        with(colour.index[laneAt(place)]);
        value(g.normalX), value(g.normalY), value(g.mostPush), value(f.friction);
        for (int k = 0; k < 2; ++k) {
            auto& p = g.points[k];
            auto& q = f.points[k];
            value(p.leverA), value(p.leverB), value(p.separation), value(p.now), value(p.mass), value(p.impulse);
            value(q.leverA), value(q.leverB), value(q.mass), value(q.impulse), value(q.total);
        }
        if (!bounces_) return;
        BounceLanes<Real>& r = colour.bounces[group];
        value(r.restitution);
    }
    void addJoint(const Joint&, Index index);
    void calmJoints(Node node);
    void keepRows(std::vector<Joint>&);
    void noteChanges();
    void noteFlip(Collider&, Colour&, std::size_t group, std::vector<TouchChange>&);
    void warmNode(Node);
    void turnNode(Node);
    void foreseeNode(Node);
    void pushNode(Node);
    void relaxNode(Node, const Pass&);
    static std::size_t groups(std::size_t lanes) { return (lanes + kWidth - 1) / kWidth; }

    StepShape shape_;
    int passes_ = 1;
    StepConstants<Real> constants_;
    const Kernels<Real>* kernels_ = nullptr;
    std::span<BodyState<Real>> states_;  // [slots] of the step, in the arena
    std::span<BodyPush<Real>> pushes_;
    Domains domains_;
    std::uint64_t bordersThen_ = 0;   // contacts between domains after the last division
    std::uint64_t sinceDivided_ = 0;  // steps
    Taken taken_, takenByJoints_;
    std::vector<Colour> colours_;                                                          // [nodes][colours]
    std::vector<JointColour> jointColours_;                                                // the same
    std::size_t used_[Domains::kNodes + 1] = {}, usedByJoints_[Domains::kNodes + 1] = {};  // [nodes] colours
    std::vector<JointRow<Real>> rows_[Domains::kNodes + 1], made_[Domains::kNodes + 1];
    std::vector<TurningRows<Real>> turning_[Domains::kNodes + 1];
    std::vector<Rowed> rowed_[Domains::kNodes + 1];
    std::uint64_t jointsVersion_ = 0;  // that they are laid out for; 0: none
    double jointsH_ = 0;               // seconds: their impulses are of substeps of this
    bool anyPoint_ = false;            // has any joint a point?
    bool jointsTold_ = true;           // have the joints got the impulses of the last step?
    bool strained_[Domains::kNodes + 1] = {};
    std::span<float> drifts_;  // [slots] of the collider, in the arena
    Pool* pool_ = nullptr;
    Arena* arena_ = nullptr;
    std::vector<Block> blocks_;          // never shrinks, so that nothing is allocated in a steady step
    std::vector<std::uint32_t> inTurn_;  // blocks of what has constraints, as threads take them
    std::vector<TouchChange> changes_;
    Settling settling_[Domains::kNodes + 1];
    std::vector<Index> shared_[Domains::kNodes + 1];  // [leaves] slots whose bodies others push as well
    double lastH_ = 0;                                // seconds: the impulses are of substeps of this
    float hardest_ = 0;
    bool foresees_ = false;
    bool bounces_ = false;  // does any contact have restitution?
    bool fresh_ = true;     // is the step's first substep to come?
};

/// Subtrees at once, as many as there are threads; then what lies above them.
template <class Real>
template <class Work>
void Solver<Real>::eachNode(Work&& work)
{
    int level = 0;
    while (level < domains_.depth() && 1 << level < pool_->threads()) ++level;
    const auto nodeAt = [](int of, std::size_t i) { return static_cast<Node>((std::size_t{1} << of) + i); };
    pool_->run(std::size_t{1} << level, [&](std::size_t i) { domains_.below(nodeAt(level, i), work); });
    while (level-- > 0) pool_->run(std::size_t{1} << level, [&](std::size_t i) { work(nodeAt(level, i)); });
}

template <class Real>
template <class Work>
void Solver<Real>::eachNode(std::size_t rounds, Work&& work)
{
    int top = 0;  // level from which on threads go through the tree apart; the caller goes through what lies above
    while (top < domains_.depth() && 1 << top < pool_->threads()) ++top;
    const auto nodeAt = [](int level, std::size_t i) { return static_cast<Node>((std::size_t{1} << level) + i); };
    pool_->rounds(
        rounds, std::size_t{1} << top,
        [&](std::size_t round, std::size_t i) {
            domains_.below(nodeAt(top, i), [&](Node node) { work(round, node); });
        },
        [&](std::size_t round) {
            for (int level = top; level-- > 0;)
                for (std::size_t i = 0; i < std::size_t{1} << level; ++i) work(round, nodeAt(level, i));
        });
}

extern template class Solver<float>;
extern template class Solver<double>;

}  // namespace jet::physics
