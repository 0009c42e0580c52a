// The border of several shapes that lie side by side or over each other, as it is seen from within.
#pragma once

#include "query.hpp"

namespace jet::physics {

/// Round shapes are points or segments with a radius, polygons are closed, and what is neither is a line.
class ShapeUnion {
public:
    explicit ShapeUnion(std::vector<CastShape> shapes);

    /// Is all around the point within the shapes? So it is on a seam of two of them.
    bool covers(const Vec2& point) const;
    /// The nearest point of the border all shapes have together, to one they cover: `at` is the distance.
    std::optional<QueryHit> nearest(const Vec2& point) const;

private:
    /// A side of a shape, or a circle about `a`.
    struct Piece {
        std::size_t shape;
        Vec2 a, b;
        double radius = 0;
        bool round() const { return radius > 0; }
        Vec2 foot(const Vec2& point) const;
    };
    struct Candidate {
        double away;
        Vec2 at;
    };
    bool contains(const Vec2& point) const;
    /// Where the two cross.
    static void cross(const Piece&, const Piece&, std::vector<Vec2>& found);

    std::vector<CastShape> shapes_;
    std::vector<Piece> pieces_;
    double size_ = 0;  // of all of them, scene units
};

}  // namespace jet::physics
