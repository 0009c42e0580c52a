#include <jet/physics_view.hpp>

#include <algorithm>
#include <array>

namespace jet {

namespace {

constexpr Color kContact{220, 40, 40, 255}, kNormal{255, 140, 0, 255}, kBox{120, 120, 140, 160};
constexpr Color kCentre{20, 20, 20, 255}, kAxis{200, 60, 160, 255}, kJoint{0, 120, 90, 255},
    kBroken{160, 160, 160, 255};
constexpr Color kAsleep{128, 128, 128, 150};
constexpr int kShades = 15;          // odd: the middle one is "at rest"
constexpr double kFullStrain = 0.1;  // a tenth longer or shorter has the full colour
constexpr double kLongest = 60;      // pixels of the longest impulse

Pen cosmetic(Color color, double width)
{
    Pen pen;
    pen.color = color;
    pen.width = width;
    pen.cosmetic = true;
    return pen;
}

/// Colours far from each other for numbers near each other: steps of the golden angle around the circle of hues.
Color hue(std::uint32_t number, std::uint8_t alpha)
{
    const double h = std::fmod(number * 0.618033988749895, 1.0) * 6;
    const auto channel = [&](double shift) {
        const double k = std::fmod(h + shift, 6.0);
        return static_cast<std::uint8_t>(std::lround(40 + 200 * std::clamp(std::abs(k - 3) - 1, 0.0, 1.0)));
    };
    return {channel(0), channel(4), channel(2), alpha};
}

void addLine(Path& path, const Vec2& from, const Vec2& to)
{
    path.moveTo(from);
    path.lineTo(to);
}

/// A square of a few pixels, as a stroke.
void addMark(Path& path, const Vec2& at, double half)
{
    Path square = Path::rectangle(Box(at - Vec2(half, half), at + Vec2(half, half)));
    path.contours().push_back(std::move(square.contours().front()));
}

Path outlineOf(const PhysicsPicture& picture, const PhysicsPicture::Body& body)
{
    const std::span<const Vec2> points(picture.points.data() + body.firstPoint, body.pointCount);
    if (!body.soft && points.size() > 2) return Path::polygon(points);
    return Path::rectangle(body.bounds);
}

void paintIslands(const PhysicsPicture& picture, Painter& painter)
{
    for (const PhysicsPicture::Body& body : picture.bodies) {
        if (!body.moves || body.bounds.isNull()) continue;
        const bool grouped = body.awake && body.island != kNoHandle;
        const Color fill = !body.awake ? kAsleep : grouped ? hue(body.island, 110) : Color{90, 160, 90, 90};
        const Color line = !body.awake ? Color{90, 90, 90, 255}
                           : grouped   ? hue(body.island, 255)
                                       : Color{40, 110, 40, 255};
        const Path outline = outlineOf(picture, body);
        painter.fill(outline, fill);
        painter.stroke(outline, cosmetic(line, 1.5));
    }
}

void paintStress(const PhysicsPicture& picture, Painter& painter)
{
    std::array<Path, kShades> shades;
    for (const PhysicsPicture::Spring& spring : picture.springs) {
        // Any engine may tell what is no number.
        const double stress = std::isnan(spring.stress) ? 0 : spring.stress;
        const double part = std::clamp(stress / kFullStrain, -1.0, 1.0);
        addLine(shades[static_cast<std::size_t>(std::lround((part + 1) / 2 * (kShades - 1)))], spring.a, spring.b);
    }
    for (int i = 0; i < kShades; ++i) {
        if (shades[static_cast<std::size_t>(i)].isEmpty()) continue;
        const double part = 2.0 * i / (kShades - 1) - 1;
        const Color end = part < 0 ? Color{30, 90, 255, 255} : Color{255, 40, 20, 255};
        const auto mix = [&](int to) {
            return static_cast<std::uint8_t>(std::lround(150 + std::abs(part) * (to - 150)));
        };
        painter.stroke(shades[static_cast<std::size_t>(i)], cosmetic({mix(end.r), mix(end.g), mix(end.b), 255}, 1.5));
    }
}

void paintContacts(const PhysicsPicture& picture, double pixel, Painter& painter)
{
    double strongest = 0;
    for (const Contact& c : picture.contacts) strongest = std::max(strongest, c.impulse);
    Path points, normals, impulses;
    for (const Contact& c : picture.contacts) {
        addMark(points, c.point, 2.5 * pixel);
        addLine(normals, c.point, c.point + 12 * pixel * c.normal);
        if (c.impulse > 0 && strongest > 0)  // the square root: weak ones stay visible beside strong ones
            addLine(impulses, c.point, c.point + kLongest * std::sqrt(c.impulse / strongest) * pixel * c.normal);
    }
    if (!impulses.isEmpty()) painter.stroke(impulses, cosmetic(kNormal, 3));
    if (!normals.isEmpty()) painter.stroke(normals, cosmetic(kContact, 1));
    if (!points.isEmpty()) painter.fill(points, kContact);
}

void paintCentres(const PhysicsPicture& picture, double pixel, Painter& painter)
{
    Path marks, axes;
    for (const PhysicsPicture::Body& body : picture.bodies) {
        if (!body.moves || body.bounds.isNull()) continue;
        addMark(marks, body.centre, 2 * pixel);
        addLine(axes, body.centre, body.centre + 16 * pixel * Vec2(std::cos(body.angle), std::sin(body.angle)));
    }
    if (!axes.isEmpty()) painter.stroke(axes, cosmetic(kAxis, 1.5));
    if (!marks.isEmpty()) painter.fill(marks, kCentre);
}

void paintJoints(const PhysicsPicture& picture, double pixel, Painter& painter)
{
    Path whole, broken;
    for (const JointState& joint : picture.joints) {
        Path& path = joint.broken ? broken : whole;
        addLine(path, joint.pointA, joint.pointB);
        addMark(path, joint.pointA, 4 * pixel);
        addMark(path, joint.pointB, 3 * pixel);
        if (!joint.broken) continue;
        const Vec2 arm(6 * pixel, 6 * pixel), other(6 * pixel, -6 * pixel),
            middle = 0.5 * (joint.pointA + joint.pointB);
        addLine(path, middle - arm, middle + arm);
        addLine(path, middle - other, middle + other);
    }
    if (!whole.isEmpty()) painter.stroke(whole, cosmetic(kJoint, 2));
    if (!broken.isEmpty()) painter.stroke(broken, cosmetic(kBroken, 1.5));
}

}  // namespace

void paintPhysics(const PhysicsPicture& picture, const PhysicsMarks& marks, Painter& painter)
{
    const double pixel = 1 / std::max(painter.pixelsPerUnit(), 1e-9);
    if (marks.islands) paintIslands(picture, painter);
    if (marks.stress) paintStress(picture, painter);
    if (marks.boxes) {
        Path boxes;
        for (const PhysicsPicture::Body& body : picture.bodies) {
            if (body.bounds.isNull()) continue;
            Path box = Path::rectangle(body.bounds);
            boxes.contours().push_back(std::move(box.contours().front()));
        }
        if (!boxes.isEmpty()) painter.stroke(boxes, cosmetic(kBox, 1));
    }
    if (marks.joints) paintJoints(picture, pixel, painter);
    if (marks.contacts) paintContacts(picture, pixel, painter);
    if (marks.centres) paintCentres(picture, pixel, painter);
}

}  // namespace jet
