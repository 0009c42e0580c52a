// Joint tool: drag, or click twice, from one body to another or to the background; a Joint item holds the two at play.
// Ends snap to the middles and points of bodies (Alt: freely), Esc gives up.
#include <jet/catalog.hpp>
#include <jet/line_tool.hpp>
#include <jet/plugin.hpp>

#include <algorithm>
#include <vector>

namespace {

class JointTool final : public jet::LineTool {
public:
    explicit JointTool(jet::ToolHost& host)
        : LineTool(host, "Drag from one body to another, or to the background; or click both. Alt: without snapping.")
    {
    }

    std::string describe(const Line& line) const override
    {
        return option("kind") + ": " + words(line.from) + " – " + words(line.to);
    }
    void finish(const Line& line) override { create(line.from, line.to); }
    void paintLine(const Line& line, jet::Painter& painter) const override
    {
        painter.stroke(pathOf(line.from, line.to), host().layerPen());
    }

    const jet::PropertyTable& options() const override
    {
        static const jet::PropertyTable table{
            jet::choice("kind", "Kind",
                        {"revolute", "prismatic", "weld", "distance", "rope", "wheel", "motor", "mouse", "pulley"}),
            jet::choice("pivot", "Turns about", {"automatic", "start", "end", "middle"})
                .says("Where revolute, prismatic, weld and wheel joints hold; automatic: at the end in the background, "
                      "else at the start."),
            jet::flag("snap", "Snap to bodies", true).says("Ends go to the middles and points of bodies."),
        };
        return table;
    }

private:
    std::string option(const char* id) const { return host().options().get(id, options()).as<std::string>(); }

    static std::string words(const jet::BodyPoint& end) { return end.isBackground() ? "background" : end.name; }

    bool hasPivot() const
    {
        const std::string kind = option("kind");
        return kind == "revolute" || kind == "prismatic" || kind == "weld" || kind == "wheel";
    }

    jet::Vec2 pivot(const jet::BodyPoint& from, const jet::BodyPoint& to) const
    {
        const std::string where = option("pivot");
        if (where == "middle") return 0.5 * (from.at + to.at);
        if (where == "end" || (where == "automatic" && to.isBackground())) return to.at;
        return from.at;
    }

    static jet::Path line(const std::vector<jet::Vec2>& points) { return jet::Path::polygon(points, false); }

    /// As joint items want it: body A, (pivot | the wheels of a pulley), body B.
    jet::Path pathOf(const jet::BodyPoint& from, const jet::BodyPoint& to) const
    {
        if (hasPivot()) return line({from.inside, pivot(from, to), to.inside});
        if (option("kind") != "pulley") return line({from.inside, to.inside});
        const double above = std::min(from.at.y(), to.at.y()) - std::max((to.at - from.at).norm(), 1.0);
        return line({from.inside, {from.inside.x(), above}, {to.inside.x(), above}, to.inside});
    }

    /// Why these two cannot be joined; empty: they can.
    std::string refusal(const jet::BodyPoint& from, const jet::BodyPoint& to) const
    {
        if (from.isBackground() && to.isBackground())
            return "There is no body at either end: drag from a body to another one, or to the background.";
        if (from.body == to.body) return "Both ends lie in " + from.name + ": a joint holds two different bodies.";
        if (!host().scene().catalog().itemType("joint"))
            return "Joints need the plugin org.jet.items.physics, which is not there: " +
                   host().scene().catalog().explain(jet::ContributionKind::ItemType, "joint");
        return {};
    }

    void create(const jet::BodyPoint& from, const jet::BodyPoint& to)
    {
        if (const std::string why = refusal(from, to); !why.empty()) return host().showStatus(why);
        const std::string kind = option("kind");
        auto edit = host().items().begin("Create joint");
        const jet::Item& joint = edit.add("joint", host().insertionPoint(edit), pathOf(from, to));
        edit.set(joint, "kind", kind);
        // Without strength or spring these would do nothing.
        if (kind == "wheel") edit.set(joint, "hertz", 4.0), edit.set(joint, "damping-ratio", 0.7), setAxis(edit, joint);
        if (kind == "mouse") edit.set(joint, "hertz", 4.0), edit.set(joint, "max-force", 1e5);
        if (kind == "motor") edit.set(joint, "max-force", 1e5), edit.set(joint, "max-torque", 1e6);
        if (kind == "prismatic" && from.at != to.at) edit.set(joint, "axis", jet::Vec2((to.at - from.at).normalized()));
        edit.select(joint);
        edit.commit();
        host().showStatus("Joined " + words(from) + " and " + words(to) + ".");
    }

    /// Wheels hang below what they carry.
    static void setAxis(jet::Transaction& edit, const jet::Item& joint) { edit.set(joint, "axis", jet::Vec2(0, 1)); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<JointTool>("joint-tool"); }
