#include "outline.hpp"

#include "trigonometry.hpp"

namespace jet::physics {

namespace {

constexpr int kCorners = 16;  // of a circle

/// Appends `count` points of an arc from `start` over `sweep` radians, both ends included where it is not closed.
void addArc(std::vector<Vec2>& ring, const Vec2& centre, double radius, double start, double sweep, int count,
            bool closed)
{
    for (int i = 0; i < count; ++i)
        ring.push_back(centre + radius * direction(start + sweep * i / (closed ? count : count - 1)));
}

}  // namespace

std::vector<Vec2> outlineOf(const ShapeDef& shape)
{
    if (shape.kind == ShapeDef::Kind::Polygon) return shape.points;
    std::vector<Vec2> ring;
    // A regular polygon of n corners has the area n/2 sin(2 pi / n) r².
    const double inscribed = kCorners / (2 * kPi) * direction(2 * kPi / kCorners).y();
    const double radius = shape.radius / std::sqrt(inscribed);
    if (shape.kind == ShapeDef::Kind::Circle) {
        addArc(ring, shape.points[0], radius, 0, 2 * kPi, kCorners, true);
        return ring;
    }
    const Vec2 axis = shape.points[1] - shape.points[0];
    const double angle = angleOf(axis.y(), axis.x());
    addArc(ring, shape.points[1], radius, angle - kPi / 2, kPi, kCorners / 2 + 1, false);
    addArc(ring, shape.points[0], radius, angle + kPi / 2, kPi, kCorners / 2 + 1, false);
    return ring;
}

}  // namespace jet::physics
