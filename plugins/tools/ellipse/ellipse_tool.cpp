// Ellipse tool: drag a box, get an ellipse of four segments in it (thesis §3.5.1.4). Shift makes a circle, Alt grows it
// from its centre, Esc gives up. A new shape gets a face, as in the thesis's §4.2, if there is an effect of that kind.
#include <jet/catalog.hpp>
#include <jet/plugin.hpp>
#include <jet/tool.hpp>

namespace {

constexpr jet::Color kGreen{50, 205, 50, 255};

class EllipseTool final : public jet::Tool {
public:
    using Tool::Tool;

    void activate() override
    {
        host().setCursor("cross");
        host().showStatus("Drag to draw an ellipse. Shift: circle, Alt: from its centre.");
    }

    void press(const jet::PointerEvent& e) override
    {
        if (e.button != jet::PointerButton::Left) return;
        dragging_ = true;
        start_ = end_ = e.scene;
        constrain_ = e.modifiers;
    }

    void drag(const jet::PointerEvent& e) override
    {
        end_ = e.scene;
        constrain_ = e.modifiers;
        show();
    }

    void release(const jet::PointerEvent& e) override
    {
        if (!dragging_) return;
        end_ = e.scene;
        cancel();
        if (box().isEmpty()) return;  // a click without a drag draws nothing
        auto edit = host().items().begin("Create ellipse");
        const jet::Item& shape = edit.add<jet::ShapeItem>(host().insertionPoint(edit), jet::Path::ellipse(box()));
        if (host().scene().catalog().effect("polygon-face"))
            edit.addEffect(shape, "polygon-face", {{"color", host().options().get("color", options())}});
        edit.select(shape);
        edit.commit();
    }

    bool keyPress(const jet::KeyEvent& e) override { return constrain(e.key, true); }
    bool keyRelease(const jet::KeyEvent& e) override { return constrain(e.key, false); }

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
        if (dragging_) painter.stroke(jet::Path::ellipse(box()), host().layerPen());
    }

    const jet::PropertyTable& options() const override
    {
        static const jet::PropertyTable table{jet::color("color", "Color", kGreen).says("Face of new ellipses.")};
        return table;
    }

private:
    static std::string shortText(double length) { return jet::numberText(std::round(length * 100) / 100); }
    jet::Box box() const { return jet::dragBox(start_, end_, constrain_); }

    void show()
    {
        if (!dragging_) return;
        host().showStatus("Ellipse " + shortText(box().width()) + " × " + shortText(box().height()));
        host().requestRepaint();
    }

    // Shift and Alt also count when they are pressed or let go while the pointer rests.
    bool constrain(const std::string& key, bool down)
    {
        if (!dragging_ || (key != "Shift" && key != "Alt")) return false;
        (key == "Shift" ? constrain_.shift : constrain_.alt) = down;
        show();
        return true;
    }

    bool dragging_ = false;
    jet::Vec2 start_, end_;  // scene units
    jet::Modifiers constrain_;
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<EllipseTool>("ellipse"); }
