#include "outline.hpp"

#include "trigonometry.hpp"

namespace jet::physics {

namespace {

constexpr int kCorners = 16;             // of a circle
constexpr int kHalf = kCorners / 2 + 1;  // of a capsule's end
constexpr double kBand = 0.4;            // of a chain's shortest side: depth of its band

/// A regular polygon of n corners has the area n/2 sin(2 pi / n) r².
double ringRadius(double radius)
{
    static const double inscribed = kCorners / (2 * kPi) * direction(2 * kPi / kCorners).y();
    return radius / std::sqrt(inscribed);
}

/// Appends `count` points of an arc from `start` over `sweep` radians, both ends included where it is not closed.
void addArc(std::vector<Vec2>& ring, const Vec2& centre, double radius, double start, double sweep, int count,
            bool closed)
{
    for (int i = 0; i < count; ++i)
        ring.push_back(centre + radius * direction(start + sweep * i / (closed ? count : count - 1)));
}

}  // namespace

namespace {

/// A band along the line, on its solid side: thin enough not to meet itself.
std::vector<Vec2> bandOf(const std::vector<Vec2>& line)
{
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const double length = (line[i + 1] - line[i]).norm();
        if (length > 0) shortest = std::min(shortest, length);
    }
    std::vector<Vec2> ring = line;
    for (std::size_t i = line.size(); i-- > 0;) {
        Vec2 along(0, 0);
        if (i > 0) along += (line[i] - line[i - 1]).stableNormalized();
        if (i + 1 < line.size()) along += (line[i + 1] - line[i]).stableNormalized();
        if (along.norm() > 1e-9) ring.push_back(line[i] + kBand * shortest * perpendicular(along).normalized());
    }
    return ring;
}

}  // namespace

std::vector<Vec2> outlineOf(const ShapeDef& shape)
{
    if (shape.kind == ShapeDef::Kind::Polygon) return shape.points;
    if (shape.kind == ShapeDef::Kind::Chain) return bandOf(shape.points);
    std::vector<Vec2> ring;
    const double radius = ringRadius(shape.radius);
    if (shape.kind == ShapeDef::Kind::Circle) {
        addArc(ring, shape.points[0], radius, 0, 2 * kPi, kCorners, true);
        return ring;
    }
    const Vec2 axis = shape.points[1] - shape.points[0];
    const double angle = angleOf(axis.y(), axis.x());
    addArc(ring, shape.points[1], radius, angle - kPi / 2, kPi, kHalf, false);
    addArc(ring, shape.points[0], radius, angle + kPi / 2, kPi, kHalf, false);
    return ring;
}

Index ringSizeOf(const Part& part)
{
    return part.count == 1 ? kCorners : part.count == 2 ? 2 * kHalf : static_cast<Index>(part.count);
}

PartRing ringOf(const Part& part)
{
    static const std::array<Vec2, kCorners> circle = [] {
        std::array<Vec2, kCorners> at;
        for (int i = 0; i < kCorners; ++i) at[static_cast<std::size_t>(i)] = direction(2 * kPi * i / kCorners);
        return at;
    }();
    const auto corner = [&](int i) { return Vec2(part.corners[i].x, part.corners[i].y); };
    PartRing ring;
    if (part.count > 2) {
        for (int i = 0; i < part.count; ++i) ring.points[ring.count++] = corner(part.reversed ? part.count - 1 - i : i);
        ring.outward = part.reversed ? 1 : -1;
        return ring;
    }
    const double radius = ringRadius(static_cast<double>(part.radius));
    if (part.count == 1) {
        for (const Vec2& at : circle) ring.points[ring.count++] = corner(0) + radius * at;
        return ring;
    }
    const Vec2 axis = (corner(1) - corner(0)).stableNormalized();
    constexpr int kQuarter = kCorners / 4;
    const auto addEnd = [&](int end, int from) {
        for (int i = 0; i < kHalf; ++i)
            ring.points[ring.count++] =
                corner(end) + radius * rotated(axis, circle[static_cast<std::size_t>((from + i) % kCorners)]);
    };
    addEnd(1, 3 * kQuarter), addEnd(0, kQuarter);
    return ring;
}

namespace {

struct Moments {
    double area = 0, second = 0;  // the latter about the shape's own centroid
    Vec2 centroid;
};

Moments momentsOf(const ShapeDef& shape)
{
    Moments m;
    if (shape.kind == ShapeDef::Kind::Chain) return m;
    const double r = shape.radius, disc = kPi * r * r;
    if (shape.kind == ShapeDef::Kind::Circle) {
        m.area = disc, m.second = 0.5 * disc * r * r, m.centroid = shape.points[0];
        return m;
    }
    if (shape.kind == ShapeDef::Kind::Capsule) {
        const double half = 0.5 * (shape.points[1] - shape.points[0]).norm(), box = 4 * half * r;
        m.centroid = 0.5 * (shape.points[0] + shape.points[1]);
        m.area = box + disc;
        // Half discs: their moment about the ends' centres, moved over by Steiner with centroids 4r / 3pi beyond.
        const double beyond = 4 * r / (3 * kPi);
        m.second = box * (4 * half * half + 4 * r * r) / 12 +
                   disc * (0.5 * r * r - beyond * beyond + (half + beyond) * (half + beyond));
        return m;
    }
    const Vec2 origin = shape.points[0];
    Vec2 moment(0, 0);
    double second = 0;
    for (std::size_t i = 0; i < shape.points.size(); ++i) {
        const Vec2 a = shape.points[i] - origin, b = shape.points[(i + 1) % shape.points.size()] - origin;
        const double twice = cross(a, b);
        m.area += 0.5 * twice;
        moment += twice / 6 * (a + b);
        second += twice / 12 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
    }
    if (m.area == 0) return m;
    const Vec2 centre = moment / m.area;
    m.second = std::abs(second - m.area * centre.squaredNorm());
    m.centroid = origin + centre;
    m.area = std::abs(m.area);
    return m;
}

}  // namespace

Region measureShapes(const std::vector<ShapeDef>& shapes)
{
    Region region;
    Vec2 moment(0, 0);
    for (const ShapeDef& shape : shapes) {
        const Moments m = momentsOf(shape);
        region.area += m.area;
        moment += m.area * m.centroid;
    }
    if (!(region.area > 0)) return Region();
    region.centroid = moment / region.area;
    for (const ShapeDef& shape : shapes) {
        const Moments m = momentsOf(shape);
        region.inertia += (m.second + m.area * (m.centroid - region.centroid).squaredNorm()) / region.area;
    }
    return region;
}

}  // namespace jet::physics
