// Ray casts, shape casts, overlaps and nearest points over all bodies: a tree of boxes, then each outline or round
// shape exactly. Circles and capsules are round here, whatever outline they are drawn with.
#pragma once

#include "query.hpp"
#include "query_tree.hpp"
#include "rigid/stage.hpp"
#include "state.hpp"

#include <jet/physics.hpp>

namespace jet::physics {

class Queries {
public:
    /// Where the parts of rigid bodies are.
    void use(const RigidStage& rigid) { rigid_ = &rigid; }
    /// After a body was added.
    void addSoft(Index body);
    void addRigid(const State&, Index body, const RigidBodyDef&);
    void remove(Index body);

    /// Bodies have moved, come or gone since the last query.
    void outdate() { outdated_ = true; }
    /// Points must be true.
    void update(const State&);

    std::optional<CastHit> rayCast(const State&, const Vec2& from, const Vec2& way, const QueryFilter&) const;
    std::optional<CastHit> shapeCast(const State&, const ShapeDef&, const Vec2& way, const QueryFilter&) const;
    std::vector<BodyHandle> overlapping(const State&, const Box&, const QueryFilter&) const;
    std::optional<CastHit> nearest(const State&, const Vec2& point, double reach, const QueryFilter&) const;
    bool contains(const State&, Index body, const Vec2& point) const;

    std::size_t bytes() const
    {
        return items_.capacity() * sizeof(Kept) + rounds_.capacity() * sizeof(Round) +
               boxes_.capacity() * (sizeof(Box) + 100);
    }

private:
    /// An outline of a body, or a round shape of it, but for bodies of one shape, whose parts say enough.
    struct Kept {
        Index body = 0;
        Index round = kNone;  // into rounds_
        Range walls;          // of a shape, from the body's first, as walls get other numbers; none: all of the body
        int outward = 0;      // of a shape's walls, whatever other shapes lie over it
        bool open = false;    // a chain
    };
    /// All within the radius of a segment, in the body's frame.
    struct Round {
        Vec2 a, b;
        double radius = 0;
    };
    /// One of them, or the part of a body of one shape.
    struct Item {
        Index body = 0;
        Range walls;
        int outward = 0;
        const Part* part = nullptr;  // a polygon
        bool isRound = false, open = false;
        Round round;
        bool whole() const { return !isRound && part == nullptr && walls.count == 0; }
    };
    /// From the scene to the frame the item's points are in.
    struct Frame {
        Vec2 at{0, 0}, turn{1, 0};
        Vec2 in(const Vec2& p) const { return unrotated(turn, p - at); }
        Vec2 out(const Vec2& p) const { return at + rotated(turn, p); }
    };

    /// The kept ones, then bodies by their handles, of which those of one shape are items.
    Item itemAt(std::size_t index) const;
    void keep(const Kept&);
    Item itemOf(Index body) const;
    static bool seen(const State&, Index body, const QueryFilter&);
    static Frame frameOf(const State&, const Item&);
    static Range wallsOf(const State&, const Item&);
    Box boxOf(const State&, const Item&) const;
    /// Calls visit(edge) for each side of the item that may meet the region, which is in the item's frame.
    template <class Visit>
    static void eachEdge(const State&, const Item&, const Box& region, Visit&& visit);
    bool inside(const State&, const Item&, const Vec2& at) const;
    std::optional<QueryHit> castRay(const State&, const Item&, const Vec2& from, const Vec2& way, double most) const;
    /// Calls visit(item) for each of the body's.
    template <class Visit>
    void eachItem(Index body, Visit&& visit) const;
    /// The part of the way on which a ray that starts within the body has not left all its shapes; < 0: it starts
    /// outside.
    double within(const State&, Index body, const Vec2& from, const Vec2& way) const;
    std::optional<QueryHit> castShape(const State&, const Item&, const CastShape&, const Vec2& way) const;
    bool overlaps(const State&, const Item&, const CastShape&) const;
    bool meetsBox(const State&, const Item&, const Box&) const;
    /// Fraction is the distance.
    /// From within a body of several shapes, to the border they have together; none: the point is not within.
    std::optional<QueryHit> nearestFromWithin(const State&, Index body, const Vec2& point) const;
    std::optional<QueryHit> nearestOf(const State&, const Item&, const Vec2& point, double reach) const;

    const RigidStage* rigid_ = nullptr;
    std::vector<Kept> items_;  // ascending by bodies
    std::vector<Round> rounds_;
    bool anySingle_ = false;  // is there a body of one shape?
    std::vector<Box> boxes_;
    QueryTree tree_;
    bool outdated_ = true;
};

}  // namespace jet::physics
