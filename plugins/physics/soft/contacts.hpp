// Contacts between soft bodies that are not fast for their size: found by surveying the walls of one for the points of
// the other, eight at a time, and solved in blocks of eight that share no particle. What is fast, or meets rigid
// bodies, goes by contact_finder.hpp and contact_solver.hpp; the rules are the same: a candidate for each wall a point
// may reach in the step, taken up once it really comes to it; "Soft Step" over the substeps, with warm starting.
//
// Order of calls: find -> each substep push and relax -> keep, once the step is over or before the next find.
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
    void push(State&, double h, double gravity);
    void relax(State&);
    /// Takes the impulses out of the blocks.
    void keep();
    /// Warm-start impulses are of one substep: for others of another length.
    void scale(double ratio);
    void clear();
    /// Drops what touches walls of such bodies: the walls have got other numbers.
    void forget(const State&, const std::function<bool(Index)>& body);

    std::size_t count() const { return touches_.size(); }
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
            with(touch.insets), with(touch.along), with(touch.normalImpulse), with(touch.tangentImpulse);
            with(touch.stepImpulse);
        });
        with.list(ended_, [&](ContactPoint& c) {
            with(c.point), with(c.wall), with(c.bodyA), with(c.bodyB), with(c.slop), with(c.thickness);
            with(c.inside), with(c.engaged), with(c.stepImpulse);
        });
    }
    /// Does what was read back fit the state?
    bool fits(const State&) const;
    /// After reading back: there are no blocks.
    void restored();

private:
    struct Touch {
        Index point = 0, wall = 0;
        Index seat = 0;                                                // block * 8 + lane; kNone: not solved
        std::uint8_t inside = 0, engaged = 0, active = 0, insets = 0;  // insets: 1 first end, 2 second
        float along = 0, normalImpulse = 0, tangentImpulse = 0, stepImpulse = 0;
    };
    struct Pair {
        Index a = 0, b = 0;
        Index first = 0, end = 0;  // touches
        float slop = 0, thickness = 0, friction = 0, restitution = 0;
        std::uint32_t resolve = 1;
    };
    /// The walls of a body for the survey, as of this find.
    struct Skin {
        Vec2 origin;
        Index first = 0, count = 0;  // blocks
    };

    void skin(State&, Index body);
    void meet(State&, const std::vector<Motion>&, const Pair&, bool aOnB, double dt);
    void meetItself(State&, const Motion&, const Pair&, double dt);
    void add(const State&, const Pair&, Index point, Index wall, bool inside);
    std::uint8_t insetsAt(const State&, Index point, Index wall) const;
    Index wallToLeaveThrough(const State&, const BodyRecord&, Index point, Index piece) const;
    void carryOver(const State&, const Pair& before, const Pair& now, bool first);
    const Touch* heldBefore(Index point, Index wall) const;
    void seat(const State&);
    Index freeSeat(Index, Index, Index);
    void fill(const State&, const Pair&, Touch&);
    ContactPoint asContact(const State&, const Pair&, const Touch&) const;

    const ContactKernels* kernels_ = &sse2::contacts;
    std::vector<Pair> pairs_, pairsBefore_;
    std::vector<Touch> touches_, touchesBefore_;
    std::vector<ContactPoint> ended_;  // pushed in this step, but are over
    std::vector<ContactBlock> blocks_;
    ContactStep step_;

    // Scratch.
    const Pair* before_ = nullptr;  // of the pair at work, in the last find
    std::vector<Skin> skins_;       // [bodies]
    std::vector<std::uint8_t> skinned_;
    std::vector<WallBlock> walls_;
    std::vector<std::uint8_t> near_;
    std::vector<std::uint64_t> seated_;  // [nodes] open blocks that hold it
    std::array<Index, 64> open_{};
    std::array<std::uint8_t, 64> filled_{};
};

}  // namespace jet::physics::soft
