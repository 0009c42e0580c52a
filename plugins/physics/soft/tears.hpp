// What happens to the border of a soft body when its springs tear: it is cut open, and where cuts meet, the body falls
// into pieces with borders of their own, which collide with each other.
//
// A wall holds as long as the spring along it does. When that is torn, the flesh behind it opens: the wall from p to q
// gives way to two, from p over c to q, where c is the particle behind the wall that springs joined to both, and that
// sees them at the widest angle (as in a Delaunay triangulation of the shape at rest). These walls are looked at in
// turn. A ring that comes to a particle it already has falls into two. Pieces are particles that whole springs join.
//
// Alternative that lost: a triangulation of every body that could tear, kept from the start. It costs memory where
// nothing ever tears, and knows no more than the springs do.
#pragma once

#include "soft_springs.hpp"

namespace jet::physics::soft {

class Tears {
public:
    /// Did springs tear since the last look()?
    bool due(const State&, const SoftSprings&) const;
    /// Cuts the bodies in which they did. Walls get other numbers.
    void look(State&, const SoftSprings&);
    /// The body is removed: its walls are where they were drawn, for another one.
    void forget(State&, Index body);
    bool isCut(Index body) const
    {
        return std::any_of(cuts_.begin(), cuts_.end(), [&](const Cut& cut) { return cut.body == body; });
    }
    /// Particles of the body's rings as they are now, from the body's first point.
    static std::vector<std::vector<Index>> rings(const State&, Index body);
    bool any() const { return !cuts_.empty(); }
    std::size_t bytes() const;

    /// Walls exist as drawn until the first cut; after it they are part of what is saved.
    template <class Archive>
    void archive(Archive& with, State& state)
    {
        auto cut = static_cast<std::uint8_t>(any());
        with(cut);
        if (cut == 0) {
            if (any()) undo(state);
            return;
        }
        if (!any()) remember(state);
        Walls& walls = state.walls;
        const auto keep = [&](auto& values) { with.list(values, [&](auto& value) { with(value); }); };
        keep(walls.first), keep(walls.second), keep(walls.previous), keep(walls.next), keep(walls.outward);
        // How far walls are felt beyond their ends is worked out anew where a soft body is met; rigid ones do not
        // change.
        walls.firstEnd.resize(walls.first.size(), WallEnd::Blunt),
            walls.secondEnd.resize(walls.first.size(), WallEnd::Blunt);
        keep(cuts_);
        for (BodyRecord& body : state.bodies) {
            if (!body.soft) continue;
            with(body.walls), with(body.soft->open), with(body.soft->pieceCount);
            keep(body.soft->pieces);
        }
    }

private:
    struct Cut {
        Index body = 0, torn = 0;  // springs torn when it was looked at last
        Index room = 0;            // walls its range may hold
        Range drawn;               // its range before it was cut
        Range spare;               // that was given to it for its cuts, or to one that was removed
    };
    struct Mesh;

    void remember(const State&);
    void undo(State&);
    Cut& cutOf(Index body);
    static int sideOf(const State&, const BodyRecord&, const std::vector<Index>& ring);
    static void split(State&, const Mesh&, Index body);
    void write(State&, Cut&, const std::vector<std::vector<Index>>& rings, std::int8_t outward);

    std::vector<Cut> cuts_;  // ascending
    Walls drawn_;            // before the first cut
    std::vector<Range> drawnRanges_;
};

}  // namespace jet::physics::soft
