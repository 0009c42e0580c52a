// Force tool: drag, or click twice, from a point of a body in the direction it is to be pushed; a Force item pushes it
// at play, the harder the longer the arrow. The point snaps to the middles and points of bodies (Alt: freely), Shift
// keeps to eighths of a turn, Esc gives up.
#include <jet/catalog.hpp>
#include <jet/item_type.hpp>
#include <jet/line_tool.hpp>
#include <jet/plugin.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

constexpr double kDot = 4;   // scene units: the item's path about the point where the force acts
constexpr double kHead = 9;  // pixels

class ForceTool final : public jet::LineTool {
public:
    explicit ForceTool(jet::ToolHost& host)
        : LineTool(host,
                   "Drag from a point of a body the way it is to be pushed; or click both. Alt: without snapping, "
                   "Shift: eighths of a turn.",
                   Second::Free)
    {
    }

    std::string describe(const Line& line) const override
    {
        const auto rounded = [](double value) { return jet::numberText(std::round(value * 100) / 100); };
        const jet::Vec2 value = force(line.way);
        return (line.from.isBackground() ? "background" : line.from.name) + ": force " + rounded(value.norm()) + " (" +
               rounded(value.x()) + ", " + rounded(value.y()) + ")";
    }

    void finish(const Line& line) override
    {
        if (const std::string why = refusal(line); !why.empty()) return host().showStatus(why);
        const jet::Vec2 half(kDot, kDot), &at = line.from.inside;
        auto edit = host().items().begin("Create force");
        const jet::Item& item =
            edit.add("force", host().insertionPoint(edit), jet::Path::ellipse(jet::Box(at - half, at + half)));
        edit.set(item, "value", force(line.way));
        edit.select(item);
        edit.commit();
        host().showStatus("A force pushes " + line.from.name + ".");
    }

    void paintLine(const Line& line, jet::Painter& painter) const override
    {
        if (!(line.way.norm() > 0)) return;
        const double head = kHead / std::max(host().pixelsPerUnit(), 1e-9);
        const jet::Vec2 tip = line.from.at + line.way, along = line.way.normalized(),
                        across = jet::perpendicular(along);
        painter.stroke(jet::Path::line(line.from.at, tip), host().layerPen());
        painter.stroke(jet::Path::polygon(std::array{jet::Vec2(tip - head * along + 0.5 * head * across), tip,
                                                     jet::Vec2(tip - head * along - 0.5 * head * across)},
                                          false),
                       host().layerPen());
    }

    const jet::PropertyTable& options() const override
    {
        static const jet::PropertyTable table{
            jet::real("scale", "Force a unit", 10)
                .in("mass/s²")
                .range(1e-6, 1e9)
                .says(
                    "Of the arrow: with 10, one of 100 units pushes with 1,000, about ten times the weight of mass 1."),
            jet::flag("snap", "Snap to bodies", true).says("The point goes to the middles and points of bodies."),
        };
        return table;
    }

private:
    jet::Vec2 force(const jet::Vec2& arrow) const
    {
        const jet::Vec2 exact = host().options().get("scale", options()).as<double>() * arrow;
        // A force straight up has no part to the side, whatever is left of a cosine.
        const double least = 1e-12 * exact.norm();
        return {std::abs(exact.x()) < least ? 0 : exact.x(), std::abs(exact.y()) < least ? 0 : exact.y()};
    }

    /// Why no force can be made; empty: it can.
    std::string refusal(const Line& line) const
    {
        if (line.from.isBackground())
            return "There is no body at the start: drag from the point of a body that is pushed.";
        if (!(line.way.norm() > 0)) return "The arrow has no length: drag it the way the body is to be pushed.";
        const jet::ItemType* type = host().scene().catalog().itemType("force");
        if (!type)
            return "Forces need the plugin org.jet.items.physics, which is not there: " +
                   host().scene().catalog().explain(jet::ContributionKind::ItemType, "force");
        const auto fits = type->properties().find("value")->check(force(line.way));
        return fits ? std::string() : "No force is as strong as this arrow is long: " + fits.error().message;
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<ForceTool>("force-tool"); }
