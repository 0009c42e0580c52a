// In Path Body: makes a soft body of a shape (thesis §3.5.2.1, SPEC EF1). What the lattice is made of is in
// lattice.hpp.
#include "lattice.hpp"

#include <jet/effect.hpp>
#include <jet/items_center.hpp>
#include <jet/plugin.hpp>

#include <algorithm>
#include <numbers>

namespace {

using jet::lattice::Lattice;
using jet::lattice::Options;
using jet::lattice::SpringKind;

const jet::PropertyTable& table()
{
    static const jet::PropertyTable table{
        jet::flag("border-on-segments", "Border on segments", true)
            .says("Border particles on the segments and their intermediate points; off: \"Border count\" of them, "
                  "evenly."),
        jet::integer("border-count", "Border count", 10)
            .range(3, 10'000)
            .says("Particles along the outline when they are not on the segments."),
        jet::integer("border-to-inside", "Border to inside springs", 3)
            .range(0, 100)
            .says("Springs from each border particle to the nearest inside particles it sees."),
        jet::flag("border-springs", "Border springs", true),
        jet::integer("border-springs-from", "Border springs from", 1)
            .range(1, 1000)
            .says("Nearest border particle joined: 1 is the next one."),
        jet::integer("border-springs-to", "Border springs to", 2)
            .range(1, 1000)
            .says("Farthest border particle joined."),
        jet::integer("inside-springs-from", "Inside springs from", 1)
            .range(1, 100)
            .says("Nearest grid neighbour joined: 1 is the next one."),
        jet::integer("inside-springs-to", "Inside springs to", 2).range(1, 100).says("Farthest grid neighbour joined."),
        jet::flag("axis-aligned", "Axis aligned springs", true).says("Horizontal and vertical springs inside."),
        jet::flag("cross", "Cross springs", true)
            .says("Diagonal springs inside. With neither kind there are no particles inside."),
        jet::vector("cell-size", "Cell size", {0, 0})
            .in("units")
            .range(0, 1e6)
            .says("Width and height of a cell of the grid inside; 0: chosen from the outline."),
        jet::real("mass", "Mass", 1).range(1e-6, 1e9).says("Of the whole body, shared by its particles."),
        jet::real("ks", "Stiffness ks", 10).in("force/unit").range(0, 1e9),
        // With 0.1 a ball of the default mass bounces for a quarter of a minute; with 1 it does not bounce at all.
        jet::real("kd", "Damping kd", 0.3).in("force·s/unit").range(0, 1e9),
        jet::real("tear-ratio", "Tears at", 0).in("× rest length").range(0, 1e6).says("0: never tears."),
        jet::real("thickness", "Thickness", 0)
            .in("units")
            .range(0, 1e6)
            .says("How far its border is felt outside; at most a tenth of its size."),
        jet::real("pressure", "Gas pressure", 0).in("force/unit").range(0, 1e9).says("Above that outside, as drawn."),
        jet::real("area-stiffness", "Area stiffness", 0)
            .in("force/unit")
            .range(0, 1e9)
            .says("Pressure that resists a change of its area, times the relative change."),
        jet::real("shape-stiffness", "Shape stiffness", 0)
            .in("force/unit")
            .range(0, 1e9)
            .says("ks of springs that draw each particle to its place in the shape as drawn; 0: none."),
        jet::real("shape-damping", "Shape damping", 0.1).in("force·s/unit").range(0, 1e9).says("kd of these springs."),
        jet::real("yield", "Flows at strain", 0).range(0, 1e6).says("Springs stay changed beyond it; 0: never."),
        jet::real("creep", "Creep", 10).in("1/s").range(0, 1e6).says("How fast strain beyond the yield stays."),
        jet::real("most-flow", "Flows at most", 0.5).in("× rest length").range(0, 0.95),
        jet::flag("self-collision", "Collides with itself", false),
    };
    return table;
}

Options optionsOf(const jet::EffectInput& in)
{
    Options o;
    o.borderOnSegments = in.get<bool>("border-on-segments");
    o.borderCount = in.get<int>("border-count");
    o.borderToInside = in.get<int>("border-to-inside");
    o.borderSprings = in.get<bool>("border-springs");
    o.border = {in.get<int>("border-springs-from"), in.get<int>("border-springs-to")};
    o.inside = {in.get<int>("inside-springs-from"), in.get<int>("inside-springs-to")};
    o.axisAligned = in.get<bool>("axis-aligned");
    o.cross = in.get<bool>("cross");
    o.cell = in.get<jet::Vec2>("cell-size");
    return o;
}

jet::SoftMatter matterOf(const jet::EffectInput& in)
{
    jet::SoftMatter matter;
    // A skin thicker than that is no skin, and would touch everything around it.
    matter.thickness = std::min(in.get<double>("thickness"), 0.1 * in.path.bounds().size().minCoeff());
    matter.pressure = in.get<double>("pressure");
    matter.areaStiffness = in.get<double>("area-stiffness");
    matter.shapeStiffness = in.get<double>("shape-stiffness");
    matter.shapeDamping = in.get<double>("shape-damping");
    matter.yield = in.get<double>("yield");
    matter.creep = in.get<double>("creep");
    matter.mostFlow = in.get<double>("most-flow");
    matter.selfCollision = in.get<bool>("self-collision");
    return matter;
}

jet::Path springLines(const Lattice& lattice, SpringKind kind)
{
    jet::Path lines;
    for (const auto& spring : lattice.springs) {
        if (spring.kind != kind) continue;
        jet::Contour line;
        line.segments = {jet::Segment(lattice.particles[spring.a]), jet::Segment(lattice.particles[spring.b])};
        lines.contours().push_back(std::move(line));
    }
    return lines;
}

/// The lattice as it is drawn, or why there is none.
class Preview final : public jet::EffectState {
public:
    explicit Preview(const jet::EffectInput& in)
    {
        try {
            lattice = jet::lattice::build(in.path, optionsOf(in));
            for (const SpringKind kind : {SpringKind::Border, SpringKind::Inside, SpringKind::BorderToInside})
                springs[static_cast<std::size_t>(kind)] = springLines(lattice, kind);
        } catch (const jet::Failure& failure) {
            problem = failure.error().message;
        }
    }

    Lattice lattice;
    std::array<jet::Path, 3> springs;  // by SpringKind
    std::string problem;
};

constexpr jet::Color kSpringColors[] = {{30, 100, 200, 220}, {110, 110, 120, 170}, {230, 130, 30, 190}};
constexpr jet::Color kBorderParticle{200, 30, 40, 255}, kInsideParticle{60, 60, 70, 255}, kProblem{200, 0, 0, 255};

jet::Pen linePen(jet::Color color)
{
    jet::Pen pen;
    pen.color = color;
    pen.cosmetic = true;
    return pen;
}

/// Squares of a few pixels around points.
jet::Path marks(std::span<const jet::Vec2> points, double unitsPerPixel)
{
    const jet::Vec2 half = jet::Vec2(2, 2) * unitsPerPixel;
    jet::Path squares;
    for (const jet::Vec2& p : points) {
        jet::Path square = jet::Path::rectangle(jet::Box(p - half, p + half));
        squares.contours().push_back(std::move(square.contours().front()));
    }
    return squares;
}

void paintPreview(const Preview& preview, const jet::Box& bounds, jet::Painter& painter)
{
    if (bounds.isNull()) return;
    if (!preview.problem.empty()) {
        painter.text(bounds.center(), preview.problem, jet::TextStyle{kProblem, 12, true, true});
        return;
    }
    for (const SpringKind kind : {SpringKind::Inside, SpringKind::BorderToInside, SpringKind::Border}) {
        const auto index = static_cast<std::size_t>(kind);
        if (!preview.springs[index].isEmpty()) painter.stroke(preview.springs[index], linePen(kSpringColors[index]));
    }
    const Lattice& lattice = preview.lattice;
    const double area = std::max(bounds.width() * bounds.height(), 1e-12);
    const double spacing = std::sqrt(area / static_cast<double>(lattice.particles.size())) * painter.pixelsPerUnit();
    if (spacing < 6) return;  // too small to be told apart
    const std::span<const jet::Vec2> all(lattice.particles);
    const double unitsPerPixel = 1 / painter.pixelsPerUnit();
    if (lattice.insideCount() > 0)
        painter.fill(marks(all.subspan(lattice.borderCount), unitsPerPixel), kInsideParticle);
    painter.fill(marks(all.first(lattice.borderCount), unitsPerPixel), kBorderParticle);
}

// --- Intermediate points for a shape that has none ---

/// The angles between the legs of the control polygon: at least as much as the curve turns.
double turning(const jet::Cubic& curve)
{
    double sum = 0;
    jet::Vec2 before = jet::Vec2::Zero();
    for (int i = 0; i < 3; ++i) {
        const jet::Vec2 leg = curve.p[i + 1] - curve.p[i];
        if (leg.isZero()) continue;
        if (!before.isZero()) sum += std::abs(std::atan2(jet::cross(before, leg), before.dot(leg)));
        before = leg;
    }
    return sum;
}

/// A piece for each 18° a curve turns: a circle of four segments gets 20 border particles, four between each two, as in
/// the thesis's figures. Straight sides get none.
bool addIntermediatePoints(jet::Path& path)
{
    constexpr double kPerPiece = std::numbers::pi / 10;
    bool added = false;
    for (jet::Contour& contour : path.contours()) {
        for (std::size_t i = 0; i < contour.segments.size(); ++i)
            if (contour.segments[i].intermediate > 0) return false;
        for (std::size_t i = 0; i < contour.curveCount(); ++i) {
            const jet::Cubic curve = contour.curve(i);
            if (curve.isLine()) continue;
            const double pieces = std::ceil(turning(curve) / kPerPiece - 1e-6);
            contour.segments[i].intermediate = static_cast<int>(std::clamp(pieces - 1, 1.0, 24.0));
            added = true;
        }
    }
    return added;
}

class InPathBody final : public jet::Effect {
public:
    const jet::PropertyTable& properties() const override { return table(); }

    std::string rejects(const jet::Item& item) const override
    {
        const std::string name = "'" + item.name() + "' ";
        if (!item.is<jet::ShapeItem>() && !item.is<jet::BodyItem>())
            return name + "is not a shape; only shapes become soft bodies";
        for (const char* other : {"in-path-body", "in-path-rigid-body"})
            if (item.effect(other)) return name + "already is a body; change or remove its effect " + other;
        if (item.path().isEmpty()) return name + "has no outline to make a soft body of";
        for (const jet::Contour& contour : item.path().contours())
            if (!contour.closed) return name + "has an open outline; join its ends, then it can be a soft body";
        const jet::Vec2 size = item.path().bounds().size();
        if (!(size.x() > 0 && size.y() > 0))
            return name + "is flat; a soft body needs an outline that encloses an area";
        return {};
    }

    void applied(jet::Transaction& edit, const jet::Item& item) const override
    {
        if (!item.is<jet::BodyItem>()) edit.setType(item, jet::BodyItem::type);
        jet::Path path = item.path();
        if (addIntermediatePoints(path)) edit.setPath(item, std::move(path));
    }

    std::unique_ptr<jet::EffectState> update(const jet::EffectInput& in) const override
    {
        return std::make_unique<Preview>(in);
    }

    void paint(const jet::EffectInput& in, const jet::EffectState* state, jet::PaintPurpose purpose,
               jet::Painter& painter) const override
    {
        if (purpose != jet::PaintPurpose::Edit) return;
        const jet::Box bounds = in.path.bounds();
        if (state) {
            paintPreview(static_cast<const Preview&>(*state), bounds, painter);
        } else {
            paintPreview(Preview(in), bounds, painter);
        }
    }

    std::optional<jet::BodyDef> buildBody(const jet::EffectInput& in, const jet::BodyCommon& common) const override
    {
        Lattice lattice = jet::lattice::build(in.path, optionsOf(in));
        jet::SoftBodyDef body;
        body.common = common;
        body.masses.assign(lattice.particles.size(),
                           in.get<double>("mass") / static_cast<double>(lattice.particles.size()));
        const double ks = in.get<double>("ks"), kd = in.get<double>("kd"), tear = in.get<double>("tear-ratio");
        for (const auto& spring : lattice.springs) {
            const double length = (lattice.particles[spring.b] - lattice.particles[spring.a]).norm();
            body.springs.push_back({spring.a, spring.b, length, ks, kd, tear});
        }
        body.particles = std::move(lattice.particles);
        body.borders = std::move(lattice.rings);
        body.matter = matterOf(in);
        return body;
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.effect<InPathBody>("in-path-body"); }
