// In Path Rigid Body: makes a rigid body of a shape (thesis §3.5.2.2, SPEC EF2): the polygon through its segments and
// intermediate points, or, where it has none, one that follows the curves closely. A circle of curves is a circle: it
// rolls as a wheel does.
#include <jet/effect.hpp>
#include <jet/items_center.hpp>
#include <jet/plugin.hpp>

#include <numbers>

namespace {

using Ring = std::vector<jet::Vec2>;

// A circle 100 units wide follows its curve within a quarter of a unit.
constexpr double kTolerance = 0.0025;  // of the larger side of the bounds
// Outlines beyond these sizes have areas a double cannot hold.
constexpr double kSmallest = 1e-100, kLargest = 1e100;

bool hasIntermediatePoints(const jet::Path& path)
{
    for (const jet::Contour& contour : path.contours())
        for (std::size_t i = 0; i < contour.curveCount(); ++i)
            if (contour.segments[i].intermediate > 0) return true;
    return false;
}

/// All points on a line, give or take `tolerance`. (The signed area would not do: that of a figure eight is zero.)
bool isFlat(const Ring& ring, double tolerance)
{
    jet::Vec2 longest = jet::Vec2::Zero();
    for (const jet::Vec2& p : ring)
        if ((p - ring[0]).norm() > longest.norm()) longest = p - ring[0];
    return std::all_of(ring.begin(), ring.end(), [&](const jet::Vec2& p) {
        return std::abs(jet::cross(longest, p - ring[0])) <= tolerance * longest.norm();
    });
}

/// The rings of the body: open contours count as closed by a line, as a fill sees them; those without area are left
/// out.
std::vector<Ring> ringsOf(const jet::Path& path)
{
    const jet::Vec2 box = path.bounds().size();
    const double size = std::max(box.x(), box.y());
    if (!(size > kSmallest && size < kLargest)) return {};
    const double tolerance = 1e-9 * size;
    std::vector<Ring> rings;
    for (const jet::Polyline& line :
         hasIntermediatePoints(path) ? path.polygonized() : path.flatten(kTolerance * size)) {
        Ring ring;
        for (const jet::Vec2& p : line.points)
            if (ring.empty() || (p - ring.back()).norm() > tolerance) ring.push_back(p);
        while (ring.size() > 1 && (ring.back() - ring.front()).norm() <= tolerance) ring.pop_back();
        if (!isFlat(ring, tolerance)) rings.push_back(std::move(ring));
    }
    return rings;
}

struct Circle {
    jet::Vec2 centre;
    double radius = 0;
};

// The four cubics of a circle leave it by 2.7e-4 of the radius; what is drawn as one, and turned or scaled alike both
// ways, stays within this. An ellipse of 1000 : 1001 does not.
constexpr double kRoundness = 4e-4;

/// The circle that a path of four curves draws, as the ellipse tool does; none for polygons and for what has
/// intermediate points, which tell what polygon is wanted.
std::optional<Circle> circleOf(const jet::Path& path)
{
    if (path.contours().size() != 1 || hasIntermediatePoints(path)) return std::nullopt;
    const jet::Contour& contour = path.contours().front();
    if (!contour.closed || contour.curveCount() != 4) return std::nullopt;
    const auto corner = [&](std::size_t i) { return contour.segments[i].point; };
    const Circle circle{0.25 * (corner(0) + corner(1) + corner(2) + corner(3)), 0.5 * (corner(0) - corner(2)).norm()};
    if (!(circle.radius > kSmallest && circle.radius < kLargest)) return std::nullopt;
    constexpr int kSamples = 8;  // a curve; the error of a quarter has its peaks at 0.21 and 0.79
    double turned = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const jet::Cubic curve = contour.curve(i);
        for (int k = 0; k < kSamples; ++k) {
            const jet::Vec2 arm = curve.at(k / double{kSamples}) - circle.centre;
            const jet::Vec2 next = curve.at((k + 1) / double{kSamples}) - circle.centre;
            if (!(std::abs(arm.norm() - circle.radius) <= kRoundness * circle.radius)) return std::nullopt;
            turned += std::atan2(jet::cross(arm, next), arm.dot(next));
        }
    }
    // Once round, not to and fro.
    if (std::abs(std::abs(turned) - 2 * std::numbers::pi) > 1e-6) return std::nullopt;
    return circle;
}

class Outline final : public jet::EffectState {
public:
    explicit Outline(const jet::Path& path) : rings(ringsOf(path))
    {
        if (circleOf(path)) {
            edges = path;
            return;
        }
        for (const Ring& ring : rings) {
            jet::Path polygon = jet::Path::polygon(ring);
            edges.contours().push_back(std::move(polygon.contours().front()));
            corners += ring.size();
        }
    }
    std::vector<Ring> rings;
    jet::Path edges;
    std::size_t corners = 0;  ///< 0: a circle
};

constexpr jet::Color kEdge{40, 90, 220, 255}, kVertex{210, 30, 30, 255};

void paintOutline(const Outline& outline, jet::Painter& painter)
{
    jet::Pen pen;
    pen.color = kEdge;
    pen.cosmetic = true;
    if (!outline.edges.isEmpty()) painter.stroke(outline.edges, pen);
    if (outline.corners == 0) return;

    const double pixels = outline.edges.length() / static_cast<double>(outline.corners) * painter.pixelsPerUnit();
    if (pixels < 24) return;  // indices would cover each other
    std::size_t index = 0;    // counted through all rings, as contacts count walls and vertices
    for (const Ring& ring : outline.rings) {
        for (std::size_t i = 0; i < ring.size(); ++i, ++index) {
            const jet::Vec2 middle = 0.5 * (ring[i] + ring[(i + 1) % ring.size()]);
            painter.text(middle, std::to_string(index), jet::TextStyle{kEdge, 10, true, true});
            painter.text(ring[i], std::to_string(index), jet::TextStyle{kVertex, 10, true, true});
        }
    }
}

class InPathRigidBody final : public jet::Effect {
public:
    const jet::PropertyTable& properties() const override
    {
        static const jet::PropertyTable table{jet::real("mass", "Mass", 1).range(1e-6, 1e9)};
        return table;
    }

    std::string rejects(const jet::Item& item) const override
    {
        const std::string name = "'" + item.name() + "' ";
        if (!item.is<jet::ShapeItem>() && !item.is<jet::BodyItem>())
            return name + "is not a shape; only shapes become rigid bodies";
        for (const char* other : {"in-path-rigid-body", "in-path-body"})
            if (item.effect(other)) return name + "already is a body; change or remove its effect " + other;
        if (ringsOf(item.path()).empty()) return name + "encloses no area; a rigid body needs an outline that does";
        return {};
    }

    void applied(jet::Transaction& edit, const jet::Item& item) const override
    {
        if (!item.is<jet::BodyItem>()) edit.setType(item, jet::BodyItem::type);
    }

    std::unique_ptr<jet::EffectState> update(const jet::EffectInput& in) const override
    {
        return std::make_unique<Outline>(in.path);
    }

    void paint(const jet::EffectInput& in, const jet::EffectState* state, jet::PaintPurpose purpose,
               jet::Painter& painter) const override
    {
        if (purpose != jet::PaintPurpose::Edit) return;
        if (state) {
            paintOutline(static_cast<const Outline&>(*state), painter);
        } else {
            paintOutline(Outline(in.path), painter);
        }
    }

    std::optional<jet::BodyDef> buildBody(const jet::EffectInput& in, const jet::BodyCommon& common) const override
    {
        jet::RigidBodyDef body;
        body.common = common;
        body.mass = in.get<double>("mass");
        if (const auto circle = circleOf(in.path)) {
            body.shapes = {{jet::ShapeDef::Kind::Circle, {circle->centre}, circle->radius}};
            return body;
        }
        body.borders = ringsOf(in.path);
        if (body.borders.empty())
            throw jet::Failure(jet::Error("its outline encloses no area; a rigid body needs one that does"));
        return body;
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.effect<InPathRigidBody>("in-path-rigid-body"); }
