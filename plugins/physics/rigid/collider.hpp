// Collision of rigid bodies that are made of simple parts: poses -> boxes -> pairs -> points, once a step.
//
// A pair of parts whose boxes meet is a contact. It keeps its index while it lives, and is looked at again only when
// one of its bodies has moved: a body that stays within its slop of where it was is quiet, and what is between quiet
// bodies costs nothing here (the solver carries the separations on).
#pragma once

#include "domains.hpp"
#include "look.hpp"
#include "pairs.hpp"
#include "pool.hpp"
#include "rules.hpp"
#include "sharing.hpp"
#include "sift.hpp"
#include "weld.hpp"

#include <jet/physics.hpp>

#include <functional>

namespace jet::physics {

class Collider {
public:
    /// Begins a body; its parts follow.
    Index addBody(const RigidBody&, const Rules&);
    void addPart(Part, const PartOutline* = nullptr);

    /// Another body in place of a removed one with as many parts; all its parts follow.
    void replaceBody(Index, const RigidBody&, const Rules&);
    void replacePart(Index body, Index which, Part, const PartOutline* = nullptr);

    /// Two bodies that shall not collide, because a joint holds them.
    void exclude(Index a, Index b) { excluded_.insert(bodyKey(a, b)); }
    void include(Index a, Index b) { excluded_.erase(bodyKey(a, b)); }
    void includeAll() { excluded_.clear(); }
    bool excludes(Index a, Index b) const { return excluded_.contains(bodyKey(a, b)); }
    /// Something about the body has changed: all its contacts are looked at again.
    void disturb(Index body);
    /// Its pairs are sought afresh, those that were known and have been forgotten too.
    void seekAgain(Index body);

    /// The contact, which is to push, holds a sleeping body: that is to be woken first.
    void rouse(Index contact);
    /// Sleeping bodies that were found to be touched by others.
    std::vector<Index>& roused() { return roused_; }
    /// Contacts that slept and have a body that does not any more are looked at again.
    void releaseAwake();
    /// Nothing that has been looked at in this step is looked at again because it moves.
    void settleDrifts();
    /// Is there a reason to look at contacts though nothing moves?
    bool restless() const { return disturbed_ || rearranged_ || !welded_ || poses_.size() != bodies_.size(); }

    /// Where bodies are and which pairs may meet in the coming dt seconds.
    void find(const State&, const WorldSettings&, double dt, StepStats&, Pool&, Arena&, const Domains&);
    /// After update(): bodies that fast ones are going to hit may come farther than they know; they are given more
    /// room, and what they meet in it is to be updated too. False: there are none.
    bool expectHits(const State&, const WorldSettings&, double dt, Pool&, Arena&);

    /// Is the pair to be looked at in this step?
    bool due(const RigidContact& c) const { return c.due || drift_[c.bodyA] + drift_[c.bodyB] > c.slop; }
    /// The same for one without points. Cheaper, and says less often yes: not before its bodies may have come together.
    bool nears(Index contact) const
    {
        // Nothing is skipped that can be computed: whether it moves far enough cannot be predicted.
        const Nearing& n = nearing_[contact];
        const bool moved = drift_[n.bodyA] + drift_[n.bodyB] > n.slop,
                   near = reached_[n.bodyA] + reached_[n.bodyB] > n.until;
        return (moved & near) != 0 || (n.until < 0 && contacts_[contact].due);
    }
    /// It is looked at in the next step.
    void markDue(Index contact) { contacts_[contact].due = true, nearing_[contact].until = -1; }
    /// The body's farthest point has come so many units.
    void travelled(Index body, double way)
    {
        if (body < way_.size()) way_[body] += way;  // else it was never looked at
    }
    /// [bodies] units a body may come from where it rests in this step.
    const float* drifts() const { return drift_.data(); }
    /// Are there contacts that are due for another reason?
    bool anyDisturbed() const { return disturbed_; }
    /// What sift() is going to read of a contact.
    void prefetch(Index contact) const
    {
        __builtin_prefetch(&contacts_[contact], 1);
        __builtin_prefetch(&poses_[nearing_[contact].bodyA]), __builtin_prefetch(&poses_[nearing_[contact].bodyB]);
    }
    /// All of it is read and written soon.
    void prefetchWhole(Index contact) const
    {
        prefetchToWrite(&contacts_[contact]), prefetchToWrite(&contacts_[contact].normal);
    }
    /// Nothing more is looked at in this step: gives back what of the arena is needed for that alone.
    void endLooks(Arena& arena)
    {
        arena.release(looks_);
        drift_ = {}, reached_ = {};
    }
    /// It may be forgotten soon.
    void prefetchKnown(Index contact) const { known_.prefetch(contacts_[contact].key()); }
    /// All that was due has been looked at.
    void settled() { disturbed_ = false; }
    /// What was seen of a pair.
    struct Look {
        bool kept = true;   // false: they are far apart and the pair is to be forgotten
        bool hits = false;  // so hard, in this step, that what lies behind must be known
        float speed = 0;    // hitSpeed() of a pair with points
    };
    /// Brings the pair's points up to date. Different contacts may be updated at once.
    Look update(RigidContact&, double dt);
    /// The same for many, eight at a time.
    void update(const std::vector<Index>& which, std::vector<Look>& looks, double dt);
    /// Of up to eight contacts without points: a bit for each that update() would keep without points, and it is done.
    std::uint32_t sift(const Index* which, std::size_t count, double dt);
    void forget(Index contact)
    {
        places_[contact] = kFree;
        forgetPair(contact);
    }
    /// The same, beside whatever others do with contacts, of one whose place says so.
    void forgetPair(Index contact);

    /// The part of its move (0..1) after which a fast body would pass through something that was not foreseen; 1: none.
    /// `beside` is called once, maybe by another thread.
    void stopTunnelling(std::vector<float>& allowed, std::span<const Vec2> moves, std::span<const double> turns,
                        double dt, Pool&, Arena&, const std::function<void()>& beside);

    const Rules& rulesOf(const RigidBody& body) const { return rules_[body.rules]; }
    void setRules(RigidBody&, const Rules&);

    std::vector<RigidBody>& bodies() { return bodies_; }
    const std::vector<RigidBody>& bodies() const { return bodies_; }
    const std::vector<Part>& parts() const { return parts_; }
    const std::vector<Pose>& poses() const { return poses_; }
    /// With gaps, where places() says kFree.
    std::vector<RigidContact>& contacts() { return contacts_; }
    const std::vector<RigidContact>& contacts() const { return contacts_; }
    std::vector<Place>& places() { return places_; }
    const std::vector<Place>& places() const { return places_; }
    std::size_t contactCount() const { return contacts_.size() - free_.size(); }

    /// Relative speed of a pair's first point, as a part of the smaller part's size: how hard a hit is.
    float hitSpeed(const RigidContact&) const;
    /// Bodies that stand were moved or changed.
    void rearrange() { rearranged_ = true; }
    void forgetPairs();
    void disturbAll();
    std::size_t bytes() const;
    /// Gives back the room there is to spare.
    void fitRoom();

    template <class Archive>
    void archive(Archive& with)
    {
        prepareSweep();
        with.list(contacts_, [&](RigidContact& c) { with(c); });
        with.list(places_, [&](Place& p) { with(p); });
        with.list(free_, [&](Index& i) { with(i); });
        with.list(nearing_, [&](Nearing& n) { with(n); });
        way_.resize(bodies_.size(), 0.0);
        with(way_);
        poses_.resize(bodies_.size()), fitted_.resize(bodies_.size());
        with(fitted_);
        for (Pose& pose : poses_) with(pose.room), with(pose.rest), with(pose.restTurn);
        with(disturbed_), with(rearranged_);
        sweep_.archive(with);
    }
    /// After restoring: what follows from what was restored.
    void rebuild();

private:
    static constexpr float kSlop = 0.002F;  // of the length of the smaller part
    static std::uint64_t bodyKey(Index a, Index b)
    {
        return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
    }
    static void cover(RigidBody&, const Part&);
    void measure();
    void prepareBodies(Arena&);
    bool takePose(Index body, const State&, float fall, double dt);
    void noteDrift(Index body);
    Vec2f fromFitting(Index body) const;
    bool fitBoxes(Index body, double dt);
    float ahead(Index body) const;
    bool keepsWithin(Index body, double dt) const;
    FatBox boxOf(Index part, const Pose&, float room, double dt) const;
    struct Slab {
        Vec2f along{1, 0};  // unit
        float from = 0, to = 0, low = 0, high = 0;
    };
    void prepareSweep();
    static Slab slabOf(const Part&);
    bool isLong(const Part&) const;
    static FatBox boxAround(const Vec2f* corners, int count, float room, const Pose&, double dt);
    FatBox withAhead(FatBox, const Pose&, double dt) const;
    void fitPieces(std::vector<FatBox>&, Index part, const Pose&, float room, double dt) const;
    void fitBox(Index part, const Pose&, float room, double dt);
    void findPairs(const WorldSettings&, Pool&, Arena&);
    /// A pair of parts, the left one first; in the order of their left sides.
    struct FoundPair {
        std::uint64_t left = 0, right = 0;
        Index contact = kNone;  // that it becomes
        Index partA() const { return static_cast<Index>(left); }
        Index partB() const { return static_cast<Index>(right); }
        std::uint64_t key() const { return RigidContact::keyOf(partA(), partB()); }
        friend bool operator==(const FoundPair& p, const FoundPair& q)
        {
            return p.left == q.left && p.right == q.right;
        }
        friend bool operator<(const FoundPair& p, const FoundPair& q)
        {
            return p.left != q.left ? p.left < q.left : p.right < q.right;
        }
    };
    void mergeFound(std::size_t blocks, Pool&);
    /// [first, middle) and [middle, last).
    struct Neighbours {
        std::size_t first = 0, middle = 0, last = 0;
    };
    void mergeBlocks(std::size_t first, std::size_t last, int levels);
    void mergePart(const Neighbours&, std::size_t part, std::size_t parts);
    std::pair<Index, Index> orderedParts(const FoundPair&) const;
    void prefetchPair(const FoundPair&) const;
    void addFound(const WorldSettings&, Pool&);
    bool accepts(const FoundPair&, const WorldSettings&) const;
    void takeContacts();
    void prefetchNew(Index contact) const;
    const MaterialPair& materialsOf(Index bodyA, Index bodyB, const WorldSettings&) const;
    void makeContact(const FoundPair&, const WorldSettings&);
    bool mayMeet(Index bodyA, Index bodyB) const;
    std::size_t listHits(std::size_t first, std::size_t last, Index* which) const;
    bool expectHit(Index contact, const State&, double dt);
    bool surprise(Index body, float gain, double dt);
    bool apart(Index partA, Index partB) const;
    Relative relative(Index bodyA, Index bodyB) const;
    Manifold meet(const RigidContact&, const Relative&, float reach) const;
    bool fromBehind(const RigidContact&) const;
    void noteReached(Index body)
    {
        reached_[body] = way_[body] + static_cast<double>(poses_[body].travel + surprise_[body]);
    }
    bool isLonger(Index partA, Index partB) const { return sweep_.isLonger(partA, partB); }
    /// Of a step that is over.
    struct Moves {
        std::span<const Vec2> moves;    // [bodies]
        std::span<const double> turns;  // [bodies]
        float dropped;                  // units: what is lost of moves in single precision
        double dt;
    };
    /// The part of their moves that two bodies go at most; above 1: what held them back gives way.
    struct Stop {
        Index bodyA, bodyB;
        float part;
    };
    void findStops(std::size_t first, std::size_t last, const Moves&, std::vector<Stop>&) const;
    float untilPassed(const RigidContact&, float thin, const Moves&) const;
    float withinBox(Index body, const Vec2& move, double dt) const;
    float untilCentrePasses(const RigidContact&, const Vec2& relativeMove) const;
    float closingSpeed(const RigidContact&) const;
    enum Kind : std::uint8_t { kCircles, kDiscs, kPolygons, kAlone, kKinds };
    Kind kindOf(const RigidContact&) const;
    void update(Kind, const std::size_t* places, std::size_t count, const std::vector<Index>& which,
                std::vector<Look>& looks, double dt);
    Look take(RigidContact&, const Seen&, std::size_t lane, double dt);
    bool noteHit(const RigidContact&, bool fast);
    bool reuse(RigidContact&, const Relative&, float reach) const;
    void renew(RigidContact&, const Manifold&, const Relative&, float reach) const;
    bool staysApart(const RigidContact&, const Relative&, float reach);
    void noteGap(const RigidContact&, float gap);
    void foresee(RigidContact&, const Relative&, double dt) const;
    void decideSide(RigidContact&) const;

    const Looker* looker_ = &sse2::pairLooker;
    const Sieve* sieve_ = &sse2::pairSieve;
    std::vector<RigidBody> bodies_{RigidBody()};
    RuleBook rules_;
    std::vector<Part> parts_;
    Weld weld_;
    std::vector<Index> replaced_;  // parts that the sweep knows as they were
    bool rearranged_ = true;       // has something that stands come, gone or been moved?
    bool welded_ = false;          // are the outlines those of where bodies stand?
    std::vector<Pose> poses_;
    std::vector<Fitting> fitted_;
    // Of the step, in the arena; all but the first until endLooks().
    std::span<float> surprise_;  // [bodies] units a hit may carry it in this step
    std::span<float> drift_;     // [bodies] units it may come from where it rests in this step; huge: it moves
    std::span<double> reached_;  // [bodies] units they may have come at the end of this step
    std::size_t looks_ = 0;      // mark of the arena
    PairSweep sweep_;
    KeySet known_, excluded_;
    std::vector<FoundPair> found_, merged_;        // scratch of findPairs()
    std::vector<std::vector<FoundPair>> foundBy_;  // the same, by blocks
    std::vector<std::size_t> runs_;                // [blocks + 1] where the pairs of each begin
    std::vector<RigidContact> contacts_;
    std::vector<Place> places_;               // [contacts]
    std::vector<Nearing> nearing_;            // [contacts]
    std::vector<std::uint8_t> hits_;          // [contacts] has one been seen in this step?
    std::vector<std::vector<Stop>> stopsBy_;  // scratch of stopTunnelling()
    /// How a body moves in this step; of stopTunnelling(), in the arena.
    struct Going {
        Vec2f move;         // units
        float allowed = 1;  // part of it
        float unused = 0;
    };
    std::span<Going> going_;     // [bodies]
    std::vector<double> way_;    // [bodies] units their farthest points have come since they were added
    std::vector<Index> free_;    // gaps in the contacts
    std::vector<Index> roused_;  // bodies
    float typical_ = 0;          // length of a moving part in the middle
    Flag fast_;                  // does any body move by much of its size in this step?
    bool surprised_ = false, disturbed_ = true;
};

/// When the parts come to touch, as a part of dt, moving with the velocities of their poses; > 1: not in this step.
float timeOfImpact(const Part& a, const Part& b, const Pose& poseA, const Pose& poseB, double dt, float target,
                   const Looker&);

}  // namespace jet::physics
