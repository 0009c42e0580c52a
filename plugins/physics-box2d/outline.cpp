#include "outline.hpp"

#include <numbers>

namespace jet::box2d {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kCorners = 16;  // of a circle

/// Sums up parts of a region, each about a common origin.
struct Sums {
    double area = 0, second = 0;
    Vec2 moment{0, 0};

    void addRing(const Ring& ring, const Vec2& origin, double sign)
    {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 a = ring[i] - origin, b = ring[(i + 1) % ring.size()] - origin;
            const double twice = sign * cross(a, b);
            area += 0.5 * twice;
            moment += twice / 6 * (a + b);
            second += twice / 12 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
        }
    }
    void addPart(double partArea, const Vec2& centre, double aboutCentre)
    {
        area += partArea;
        moment += partArea * centre;
        second += aboutCentre + partArea * centre.squaredNorm();
    }
    Moments about(const Vec2& origin) const
    {
        if (!(area > 0)) return {};
        const Vec2 centre = moment / area;
        return {area, origin + centre, std::max(0.0, second / area - centre.squaredNorm())};
    }
};

bool crosses(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const double abc = cross(b - a, c - a), abd = cross(b - a, d - a);
    const double cda = cross(d - c, a - c), cdb = cross(d - c, b - c);
    return abc * abd < 0 && cda * cdb < 0;
}

void addCapsule(Sums& sums, const Vec2& from, const Vec2& to, double r)
{
    const double half = 0.5 * (to - from).norm(), box = 4 * half * r, disc = kPi * r * r;
    // Half discs have their centroids 4r / 3pi beyond the ends (Steiner).
    const double beyond = 4 * r / (3 * kPi);
    const double second = box * (4 * half * half + 4 * r * r) / 12 +
                          disc * (0.5 * r * r - beyond * beyond + (half + beyond) * (half + beyond));
    sums.addPart(box + disc, 0.5 * (from + to), second);
}

void addArc(Ring& ring, const Vec2& centre, double radius, double start, double sweep, int count, int pieces)
{
    for (int i = 0; i < count; ++i) {
        const double angle = start + sweep * i / pieces;
        ring.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
}

}  // namespace

double twiceArea(const Ring& ring)
{
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        twice += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
    return twice;
}

bool contains(const Rings& rings, const Vec2& p)
{
    bool inside = false;
    for (const Ring& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
            if ((a.y() > p.y()) == (b.y() > p.y())) continue;
            if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
        }
    return inside;
}

bool sidesCross(const Rings& rings)
{
    struct Side {
        Vec2 a, b;
        Box box;
    };
    std::vector<Side> sides;
    for (const Ring& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
            sides.push_back({a, b, Box(a, b)});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.box.min.x() < b.box.min.x(); });
    for (std::size_t i = 0; i < sides.size(); ++i)
        for (std::size_t k = i + 1; k < sides.size() && sides[k].box.min.x() <= sides[i].box.max.x(); ++k)
            if (sides[i].box.intersects(sides[k].box) && crosses(sides[i].a, sides[i].b, sides[k].a, sides[k].b))
                return true;
    return false;
}

bool isHole(const Rings& rings, std::size_t ring)
{
    Rings others;
    for (std::size_t i = 0; i < rings.size(); ++i)
        if (i != ring) others.push_back(rings[i]);
    return contains(others, rings[ring].front());
}

Moments momentsOf(const Rings& rings)
{
    Sums sums;
    const Vec2 origin = rings.front().front();
    for (std::size_t i = 0; i < rings.size(); ++i) {
        const double side = twiceArea(rings[i]) < 0 ? -1 : 1;
        sums.addRing(rings[i], origin, isHole(rings, i) ? -side : side);
    }
    return sums.about(origin);
}

Moments momentsOf(const std::vector<ShapeDef>& shapes)
{
    Sums sums;
    const Vec2 origin = shapes.front().points.front();
    for (const ShapeDef& shape : shapes) {
        const double r = shape.radius;
        switch (shape.kind) {
        case ShapeDef::Kind::Circle:
            sums.addPart(kPi * r * r, shape.points[0] - origin, 0.5 * kPi * r * r * r * r);
            break;
        case ShapeDef::Kind::Capsule: addCapsule(sums, shape.points[0] - origin, shape.points[1] - origin, r); break;
        case ShapeDef::Kind::Polygon: sums.addRing(shape.points, origin, twiceArea(shape.points) < 0 ? -1 : 1); break;
        case ShapeDef::Kind::Chain: break;
        }
    }
    return sums.about(origin);
}

Ring outlineOf(const ShapeDef& shape)
{
    if (shape.kind == ShapeDef::Kind::Polygon || shape.kind == ShapeDef::Kind::Chain) return shape.points;
    Ring ring;
    // A regular polygon of n corners has the area n/2 sin(2 pi / n) r².
    const double radius = shape.radius / std::sqrt(kCorners / (2 * kPi) * std::sin(2 * kPi / kCorners));
    if (shape.kind == ShapeDef::Kind::Circle) {
        addArc(ring, shape.points[0], radius, 0, 2 * kPi, kCorners, kCorners);
        return ring;
    }
    const Vec2 axis = shape.points[1] - shape.points[0];
    const double angle = std::atan2(axis.y(), axis.x());
    addArc(ring, shape.points[1], radius, angle - kPi / 2, kPi, kCorners / 2 + 1, kCorners / 2);
    addArc(ring, shape.points[0], radius, angle + kPi / 2, kPi, kCorners / 2 + 1, kCorners / 2);
    return ring;
}

}  // namespace jet::box2d
