// Hello tool: drag from the middle of a star to one of its points. Esc gives up.
#include <jet/plugin.hpp>
#include <jet/tool.hpp>

#include <numbers>
#include <utility>

namespace {

class HelloTool final : public jet::Tool {
public:
    using Tool::Tool;

    void activate() override { host().showStatus("Drag from the middle of a star to one of its points."); }

    void press(const jet::PointerEvent& e) override
    {
        dragging_ = true;
        centre_ = tip_ = e.scene;
    }

    void drag(const jet::PointerEvent& e) override
    {
        tip_ = e.scene;
        host().requestRepaint();
    }

    void release(const jet::PointerEvent&) override
    {
        if (!cancel() || tip_ == centre_) return;  // a click without a drag draws nothing
        auto edit = host().items().begin("Create star");
        const jet::Item& shape = edit.add<jet::ShapeItem>(host().insertionPoint(edit), star());
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
        if (dragging_) painter.stroke(star(), host().layerPen());
    }

    const jet::PropertyTable& options() const override
    {
        static const jet::PropertyTable table{jet::integer("points", "Points", 5).range(3, 50)};
        return table;
    }

private:
    jet::Path star() const
    {
        const int points = host().options().get("points", options()).as<int>();
        std::vector<jet::Vec2> corners;
        for (int i = 0; i < 2 * points; ++i) {
            const auto turn = jet::Affine::rotation(i * std::numbers::pi / points, centre_);
            corners.push_back(centre_ + (i % 2 ? 0.4 : 1.0) * (turn * tip_ - centre_));
        }
        return jet::Path::polygon(corners);
    }

    bool dragging_ = false;
    jet::Vec2 centre_, tip_;  // scene units
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<HelloTool>("hello-star"); }
