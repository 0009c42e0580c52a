// Region: the inside of closed rings of points, as physics sees a body: what lies inside an odd number of rings, so
// that a ring within a ring is a hole. Answers what a lattice has to ask of it, quickly: walls are kept in horizontal
// bands.
#pragma once

#include <jet/geometry.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace jet::lattice {

using Ring = std::vector<Vec2>;

class Region {
public:
    /// `rings` are closed: the last point joins the first.
    explicit Region(const std::vector<Ring>& rings);

    const Box& bounds() const { return bounds_; }
    /// Lengths below this count as nothing: a part in 10^9 of the region's size.
    double tolerance() const { return tolerance_; }
    /// The area inside, holes left out, to about a part in a thousand.
    double area() const;
    bool contains(const Vec2& p) const;
    /// Is a wall within `radii` of p, measured as an ellipse of that half width and half height?
    bool hasWallWithin(const Vec2& p, const Vec2& radii) const;
    /// The x of all walls met by the horizontal line at y, ascending. Between the first and the second is inside, and
    /// so on.
    std::vector<double> crossings(double y) const;
    /// Does the segment stay in the region? It may touch the walls and run along them.
    bool holds(const Vec2& a, const Vec2& b) const;
    /// How many walls all questions so far had to look at: what they cost, the same on every machine.
    std::uint64_t wallsSeen() const { return wallsSeen_; }

private:
    struct Wall {
        Vec2 a, b;
        Box box;
        std::uint32_t firstBand = 0;  // that its box meets
    };

    std::size_t band(double y) const;
    /// Calls visit(wall) once for each wall whose box meets `box`, until it returns false.
    template <class Visit>
    void visitWalls(const Box& box, Visit&& visit) const;
    bool isOnWall(const Vec2& p) const;

    std::vector<Wall> walls_;
    Box bounds_;
    double tolerance_ = 0;
    double bandHeight_ = 1;
    mutable std::uint64_t wallsSeen_ = 0;
    std::vector<std::vector<std::uint32_t>> bands_;  // walls by the bands their boxes meet
};

}  // namespace jet::lattice
