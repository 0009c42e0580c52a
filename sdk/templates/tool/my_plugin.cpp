// A tool: drag from the middle of a regular polygon to one of its corners. Esc gives up.
#include <jet/plugin.hpp>
#include <jet/tool.hpp>

#include <numbers>
#include <utility>
#include <vector>

namespace {

class MyPluginTool final : public jet::Tool {
public:
    using Tool::Tool;

    void activate() override { host().showStatus("Drag from the middle to a corner."); }
    void deactivate() override { cancel(); }

    void press(const jet::PointerEvent& e) override
    {
        dragging_ = true;
        centre_ = corner_ = e.scene;
    }

    void drag(const jet::PointerEvent& e) override
    {
        corner_ = e.scene;
        host().requestRepaint();
    }

    void release(const jet::PointerEvent&) override
    {
        if (!cancel() || corner_ == centre_) return;  // a click without a drag draws nothing
        auto edit = host().items().begin("Create polygon");
        const jet::Item& shape = edit.add<jet::ShapeItem>(host().insertionPoint(edit), polygon());
        edit.select(shape);
        edit.commit();
    }

    bool cancel() override
    {
        host().requestRepaint();
        return std::exchange(dragging_, false);
    }

    void paint(jet::Painter& painter) const override
    {
        if (dragging_) painter.stroke(polygon(), host().layerPen());
    }

    // Shown in the tool-option panel, which is made from this table; the values are kept between runs.
    const jet::PropertyTable& options() const override
    {
        static const jet::PropertyTable table{jet::integer("corners", "Corners", 6).range(3, 100)};
        return table;
    }

private:
    jet::Path polygon() const
    {
        const int count = host().options().get("corners", options()).as<int>();
        std::vector<jet::Vec2> corners;
        for (int i = 0; i < count; ++i)
            corners.push_back(jet::Affine::rotation(2 * std::numbers::pi * i / count, centre_) * corner_);
        return jet::Path::polygon(corners);
    }

    bool dragging_ = false;
    jet::Vec2 centre_, corner_;  // scene units
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<MyPluginTool>("my-plugin"); }
