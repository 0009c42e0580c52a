// Stroke: draws an item's path as a line, with the words of SVG's stroke properties.
#include <jet/effect.hpp>
#include <jet/plugin.hpp>

#include <algorithm>
#include <numeric>

namespace {

/// SVG's stroke-dasharray: lengths separated by spaces or commas; an odd list is repeated, so that dashes and gaps pair
/// up. A list with a negative or unreadable length, or without any length above zero, means a solid line.
std::vector<double> parseDashes(std::string_view text)
{
    std::vector<double> dashes;
    const auto skipSeparators = [&text] {
        text.remove_prefix(std::min(text.size(), text.find_first_not_of(" ,\t\r\n")));
    };
    for (skipSeparators(); !text.empty(); skipSeparators()) {
        double length = 0;
        if (!jet::readNumber(text, length) || length < 0) return {};
        dashes.push_back(length);
    }
    if (std::accumulate(dashes.begin(), dashes.end(), 0.0) <= 0) return {};
    if (const std::size_t count = dashes.size(); count % 2 == 1)
        for (std::size_t i = 0; i < count; ++i) dashes.push_back(dashes[i]);
    return dashes;
}

class Stroke final : public jet::Effect {
public:
    const jet::PropertyTable& properties() const override
    {
        static const jet::PropertyTable table{
            jet::color("color", "Color", jet::Color{0, 0, 0, 255}),
            jet::real("width", "Width", 1).in("units").range(0, 1e6),
            jet::choice("cap", "Cap", {"butt", "round", "square"}).says("How the line ends."),
            jet::choice("join", "Join", {"miter", "round", "bevel"}).says("How the line turns a corner."),
            jet::real("miter-limit", "Miter limit", 4)
                .range(1, 1e6)
                .says("Longest mitre, in line widths, before a corner is bevelled."),
            jet::text("dashes", "Dashes", "")
                .says("Lengths of dash, gap, … in scene units, e.g. \"6 3\"; empty: a solid line."),
            jet::real("dash-offset", "Dash offset", 0).in("units").range(-1e9, 1e9),
        };
        return table;
    }

    void paint(const jet::EffectInput& in, const jet::EffectState*, jet::PaintPurpose,
               jet::Painter& painter) const override
    {
        jet::Pen pen;
        pen.color = in.get<jet::Color>("color");
        pen.width = in.get<double>("width");
        if (pen.width <= 0) return;  // SVG: a zero width draws nothing
        const auto cap = in.get<std::string>("cap"), join = in.get<std::string>("join");
        pen.cap = cap == "round" ? jet::LineCap::Round : cap == "square" ? jet::LineCap::Square : jet::LineCap::Butt;
        pen.join = join == "round"   ? jet::LineJoin::Round
                   : join == "bevel" ? jet::LineJoin::Bevel
                                     : jet::LineJoin::Miter;
        pen.miterLimit = in.get<double>("miter-limit");
        pen.dashes = parseDashes(in.get<std::string>("dashes"));
        pen.dashOffset = in.get<double>("dash-offset");
        painter.stroke(in.path, pen);
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.effect<Stroke>("stroke"); }
