// Force field tool: drag a rectangle, an ellipse or a region drawn freely; bodies inside are pushed at play. Shift
// keeps the box square, Alt grows it from its centre, Esc gives up.
#include <jet/catalog.hpp>
#include <jet/plugin.hpp>
#include <jet/tool.hpp>

#include <cmath>

namespace {

constexpr double kSpacing = 3;  // pixels between the points of a region drawn freely
constexpr double kDegree = 3.14159265358979323846 / 180;

class ForceFieldTool final : public jet::Tool {
public:
    using Tool::Tool;

    void activate() override
    {
        host().setCursor("cross");
        host().showStatus("Drag the region of the field. Shift: square, Alt: from its centre.");
    }
    void deactivate() override { cancel(); }

    void press(const jet::PointerEvent& event) override
    {
        if (event.button != jet::PointerButton::Left) return;
        dragging_ = true;
        start_ = end_ = event.scene;
        drawn_ = {event.scene};
        modifiers_ = event.modifiers;
    }
    void drag(const jet::PointerEvent& event) override
    {
        if (!dragging_) return;
        end_ = event.scene;
        modifiers_ = event.modifiers;
        if ((event.scene - drawn_.back()).norm() * host().pixelsPerUnit() >= kSpacing) drawn_.push_back(event.scene);
        show();
    }
    void release(const jet::PointerEvent& event) override
    {
        if (!dragging_) return;
        drag(event);
        const jet::Path path = region();
        cancel();
        if (!path.isEmpty()) create(path);
    }

    bool keyPress(const jet::KeyEvent& event) override { return constrain(event.key, true); }
    bool keyRelease(const jet::KeyEvent& event) override { return constrain(event.key, false); }

    bool cancel() override
    {
        if (!dragging_) return false;
        dragging_ = false;
        host().showStatus("");
        host().requestRepaint();
        return true;
    }

    void paint(jet::Painter& painter) const override
    {
        if (dragging_) painter.stroke(region(), host().layerPen());
    }

    const jet::PropertyTable& options() const override
    {
        static const jet::PropertyTable table{
            jet::choice("kind", "Kind", {"directional", "radial", "vortex", "drag", "buoyancy"}),
            jet::choice("shape", "Shape", {"rectangle", "ellipse", "free"}),
            jet::real("strength", "Strength", 100)
                .range(-1e9, 1e9)
                .says("Directional, radial (outwards) and vortex (clockwise): units/s²; drag: units/s, the speed of "
                      "the wind."),
            jet::real("direction", "Direction", -90)
                .in("°")
                .range(-360, 360)
                .says("Of directional fields and wind; clockwise, 0: to the right, -90: up."),
            jet::real("rate", "Rate", 1).range(0, 1e9).says("Drag: 1/s; buoyancy: lift in weights."),
        };
        return table;
    }

private:
    double number(const char* id) const { return host().options().get(id, options()).as<double>(); }
    std::string word(const char* id) const { return host().options().get(id, options()).as<std::string>(); }

    /// Empty where it has no area.
    jet::Path region() const
    {
        if (word("shape") == "free") {
            const jet::Path path = jet::Path::polygon(drawn_, true);
            return drawn_.size() > 2 && std::abs(path.area()) > 0 ? path : jet::Path();
        }
        const jet::Box box = jet::dragBox(start_, end_, modifiers_);
        if (!(box.width() > 0) || !(box.height() > 0)) return {};
        return word("shape") == "ellipse" ? jet::Path::ellipse(box) : jet::Path::rectangle(box);
    }

    void create(const jet::Path& path)
    {
        if (!host().scene().catalog().itemType("force-field"))
            return host().showStatus("Force fields need the plugin org.jet.items.physics, which is not there: " +
                                     host().scene().catalog().explain(jet::ContributionKind::ItemType, "force-field"));
        const std::string kind = word("kind");
        const double angle = number("direction") * kDegree;
        auto edit = host().items().begin("Create force field");
        const jet::Item& field = edit.add("force-field", host().insertionPoint(edit), path);
        edit.set(field, "kind", kind);
        if (kind == "directional" || kind == "drag")
            edit.set(field, "vector", jet::Vec2(number("strength") * jet::Vec2(std::cos(angle), std::sin(angle))));
        if (kind == "radial" || kind == "vortex") edit.set(field, "strength", number("strength"));
        if (kind == "drag" || kind == "buoyancy") edit.set(field, "strength", number("rate"));
        if (kind == "buoyancy") edit.set(field, "drag", 1.0);  // water brakes, or what floats would bob for ever
        edit.select(field);
        edit.commit();
    }

    void show()
    {
        const jet::Box box = region().bounds();
        const auto rounded = [](double length) { return jet::numberText(std::round(length * 100) / 100); };
        if (!region().isEmpty())
            host().showStatus(word("kind") + " " + rounded(box.width()) + " × " + rounded(box.height()));
        host().requestRepaint();
    }

    // Shift and Alt also count while the pointer rests.
    bool constrain(const std::string& key, bool down)
    {
        if (!dragging_ || (key != "Shift" && key != "Alt")) return false;
        (key == "Shift" ? modifiers_.shift : modifiers_.alt) = down;
        show();
        return true;
    }

    bool dragging_ = false;
    jet::Vec2 start_{0, 0}, end_{0, 0};  // scene units
    std::vector<jet::Vec2> drawn_;
    jet::Modifiers modifiers_;
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<ForceFieldTool>("force-field-tool"); }
