// Polygon Face: fills an item's path with a colour (thesis §3.5.2.3).
//
// The thesis fills the polygon through the segments and their intermediate points. Here the exact curve is filled
// unless "curved" is off; the polygon stays available, as it is also what the physics of the item sees.
#include <jet/effect.hpp>
#include <jet/plugin.hpp>

namespace {

class Polygon final : public jet::EffectState {
public:
    explicit Polygon(const jet::Path& path)
    {
        for (const jet::Polyline& line : path.polygonized()) {
            jet::Contour contour;
            contour.closed = line.closed;
            contour.segments.assign(line.points.begin(), line.points.end());
            outline.contours().push_back(std::move(contour));
        }
    }
    jet::Path outline;
};

class PolygonFace final : public jet::Effect {
public:
    const jet::PropertyTable& properties() const override
    {
        static const jet::PropertyTable table{
            jet::color("color", "Color", jet::Color{50, 205, 50, 255}),
            jet::flag("curved", "Curved", true)
                .says("Fill the exact curve; off: the polygon through segments and intermediate points."),
            jet::choice("fill-rule", "Fill rule", {"nonzero", "evenodd"})
                .says("What counts as inside where the outline overlaps itself, as in SVG."),
        };
        return table;
    }

    std::unique_ptr<jet::EffectState> update(const jet::EffectInput& in) const override
    {
        if (in.get<bool>("curved")) return nullptr;
        return std::make_unique<Polygon>(in.path);
    }

    void paint(const jet::EffectInput& in, const jet::EffectState* state, jet::PaintPurpose,
               jet::Painter& painter) const override
    {
        const auto color = in.get<jet::Color>("color");
        const auto rule =
            in.get<std::string>("fill-rule") == "evenodd" ? jet::FillRule::EvenOdd : jet::FillRule::NonZero;
        if (in.get<bool>("curved")) {
            painter.fill(in.path, color, rule);
        } else if (state) {
            painter.fill(static_cast<const Polygon*>(state)->outline, color, rule);
        } else {
            painter.fill(Polygon(in.path).outline, color, rule);
        }
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.effect<PolygonFace>("polygon-face"); }
