// Contacts between soft bodies that are not fast for their size: found by surveying the walls of one for the points of
// the other, eight at a time, and solved in blocks of eight that share no particle. What is fast, or meets rigid
// bodies, goes by contact_finder.hpp and contact_solver.hpp; the rules are the same: a candidate for each wall a point
// may reach in the step, taken up once it really comes to it; "Soft Step" over the substeps, with warm starting.
//
// Order of calls: find -> each substep refresh, push and relax; travel each time before positions are predicted anew,
// and once the step is over; keep before what is here is read or saved.
//
// A pair of slow bodies is surveyed further than they come in the step, and looked at again only once they have used up
// that room: what rests costs nothing but solving. How far a body went is summed over the steps (path_).
//
// Blocks of those that touched before come first and are dense; the others are mostly idle. Colouring by what acts in
// each substep was the alternative: it costs more than the lanes it fills.
#pragma once

#include "broad_phase.hpp"
#include "contact_kernels.hpp"
#include "contact_point.hpp"

#include <array>
#include <functional>
#include <span>

namespace jet::physics::soft {

/// May the body's contacts be computed in single?
bool fitsContacts(const State&, const BodyRecord&);

class Contacts {
public:
    void use(const ContactKernels& kernels) { kernels_ = &kernels; }

    /// Candidates for the coming dt seconds of these pairs (ascending; a == b: the body with itself). `first`: of the
    /// step.
    void find(State&, const WorldSettings&, const std::vector<Motion>&, std::span<const BodyPair>, double dt,
              bool first);
    /// At the start of a substep, before anything pushes.
    void refresh(State&, double h, double gravity);
    void push(State&);
    void relax(State&);
    /// Takes the state of the contacts out of the blocks, where it is while they are solved.
    void keep();
    /// Warm-start impulses are of one substep: for others of another length.
    void scale(double ratio);
    void clear();
    /// How far the bodies' particles went from where they were. Between steps: `carry`.
    void travel(const State&, std::span<const Vec2> from);
    void carry(Index body, double way);
    /// A body has woken: what it touches is solved again.
    void rouse() { roused_ = true; }
    /// Calls visit(body, body) for each pair.
    template <class Visit>
    void eachPair(Visit&& visit) const
    {
        for (const Pair& pair : pairs_) visit(pair.a, pair.b);
    }
    /// Masses have changed.
    void outdate() { refill_ = true; }
    /// Drops what touches walls of such bodies: the walls have got other numbers.
    void forget(const State&, const std::function<bool(Index)>& body);

    /// Calls visit(ContactPoint) for each candidate, with what a report needs.
    template <class Visit>
    void each(const State& state, Visit&& visit) const
    {
        for (const Pair& pair : pairs_)
            for (Index i = pair.first; i < pair.end; ++i) visit(asContact(state, pair, touches_[i]));
        for (const ContactPoint& c : ended_) visit(c);
    }
    std::size_t bytes() const;

    template <class Archive>
    void archive(Archive& with)
    {
        with.list(pairs_, [&](Pair& pair) { with(pair); });
        with.list(touches_, [&](Touch& touch) {
            with(touch.point), with(touch.wall), with(touch.inside), with(touch.engaged), with(touch.active);
            with(touch.far);
            with(touch.insets), with(touch.inset), with(touch.seat), with(touch.along), with(touch.normalImpulse),
                with(touch.tangentImpulse);
            with(touch.stepImpulse);
        });
        with.list(ended_, [&](ContactPoint& c) {
            with(c.point), with(c.wall), with(c.bodyA), with(c.bodyB), with(c.slop), with(c.thickness);
            with(c.inside), with(c.engaged), with(c.stepImpulse);
        });
        with.list(path_, [&](double& path) { with(path); });
    }
    /// What the body touches, and how far it went.
    void remove(Index body);
    /// Does what was read back fit the state?
    bool fits(const State&) const;
    /// After reading back: there are no blocks.
    void restored()
    {
        resize(0);
        kept_ = true;
    }

private:
    struct Touch {
        Index point = 0, wall = 0;
        Index seat = kNone;                                            // block * 8 + lane; kNone: not solved
        std::uint8_t inside = 0, engaged = 0, active = 0, insets = 0;  // insets: 1 first end, 2 second
        std::uint8_t far = 1;                                          // may long be left unseen while it does not act
        float inset = 0;                                               // units the wall ends before such an end
        float along = 0, normalImpulse = 0, tangentImpulse = 0, stepImpulse = 0;
    };
    struct Pair {
        Index a = 0, b = 0;
        Index first = 0, end = 0;  // touches
        float slop = 0, thickness = 0, friction = 0, restitution = 0;
        std::uint16_t resolve = 1, kept = 0;  // kept: its touches are those of the find before
        float room = 0;     // units both may come nearer, since it was surveyed, before that must be done again
        double seenAt = 0;  // their paths then, units

        bool isLike(const Pair& other) const
        {
            return slop == other.slop && thickness == other.thickness && friction == other.friction &&
                   restitution == other.restitution && resolve == other.resolve;
        }
    };
    static bool comesBefore(const Pair& p, const Pair& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); }
    /// The walls of a body for the survey, as of this find.
    struct Skin {
        Vec2 origin;
        Index first = 0, count = 0;  // blocks
    };

    void look(State&, const std::vector<Motion>&, double dt, bool first);
    void plan(const State&, const WorldSettings&, const std::vector<Motion>&, std::span<const BodyPair>);
    void survey(State&, const std::vector<Motion>&, Pair&, double dt);
    bool wellSeated() const;
    /// Have touches that shall be solved no seats?
    bool lacksSeats(const State&) const;
    static bool isSolved(const State& state, const Pair& pair)
    {
        return pair.resolve != 0 && !state.atRest(pair.a, pair.b);
    }
    void rebuild(const State&);
    Index seatAmong(const State&, const Touch&);
    void vacate(Touch&);
    void resize(std::size_t blocks);
    ContactBlocks blocks();
    void keep(const Pair&);
    std::size_t live() const;
    void compact();
    void skin(State&, Index body);
    void corners(State&, Index body);
    void meet(State&, const std::vector<Motion>&, Pair&, bool aOnB, double dt);
    void meetItself(State&, const Motion&, const Pair&, double dt);
    void add(const State&, const Pair&, Index point, Index wall, bool inside);
    std::uint8_t insetsAt(const State&, Index point, Index wall) const;
    Index wallToLeaveThrough(const State&, const BodyRecord&, Index point, Index piece) const;
    void carryOver(const State&, const Pair& before, const Pair& now, bool first);
    const Touch* heldBefore(Index point, Index wall) const;
    void seat(const State&);
    Index freeSeat(Index, Index, Index);
    void fill(const State&, const Pair&, const Touch&);
    ContactPoint asContact(const State&, const Pair&, const Touch&) const;

    const ContactKernels* kernels_ = &sse2::contacts;
    std::vector<Pair> pairs_, pairsBefore_;
    std::vector<Touch> touches_;       // ranges of the pairs; between them, what is over
    std::vector<ContactPoint> ended_;  // pushed in this step, but are over
    std::vector<ContactBlock> blocks_;
    std::vector<ContactHead> heads_;     // [blocks]
    std::vector<std::uint32_t> acting_;  // [blocks], of which the first actingCount_ are blocks that act
    std::size_t actingCount_ = 0;
    bool refill_ = false;    // do the blocks hold what was so before?
    bool kept_ = true;       // do the touches hold what the blocks do?
    bool unseated_ = false;  // have some touches no seats?
    bool roused_ = false;    // has a body woken since the last find?
    ContactStep step_;
    std::vector<double> path_;  // [bodies] units their fastest particles went

    // Scratch.
    const Pair* before_ = nullptr;       // of the pair at work, in the last find
    std::vector<Skin> skins_;            // [bodies]
    std::vector<std::uint8_t> skinned_;  // [bodies] what is as of this find
    std::vector<WallBlock> walls_;
    std::vector<std::uint8_t> near_;
    std::vector<Touch> compacted_;
    std::vector<std::uint64_t> seated_;  // [nodes] open blocks that hold it
    std::array<Index, 64> open_{};
    std::array<std::uint8_t, 64> filled_{};
};

}  // namespace jet::physics::soft
