// An item type, a rubber band between the two ends of its path, and the tool that draws one. At play the band is a
// spring between the bodies its ends lie on (or the background).
#include <jet/item_type.hpp>
#include <jet/plugin.hpp>
#include <jet/tool.hpp>

#include <utility>

namespace {

class MyPluginType final : public jet::ItemType {
public:
    const jet::PropertyTable& properties() const override
    {
        static const jet::PropertyTable table{
            jet::real("stiffness", "Stiffness", 50).in("force/unit").range(0, 1e6),
            jet::real("slack", "Length at rest", 0.5).in("× length as drawn").range(0, 10),
            jet::color("color", "Colour", {200, 60, 40, 255}),
        };
        return table;
    }

    std::string label() const override { return "My plugin"; }

    void paint(const jet::Item& item, const jet::Path& path, jet::PaintPurpose, jet::Painter& painter) const override
    {
        jet::Pen pen;
        pen.color = value<jet::Color>(item, "color");
        pen.width = 2;
        painter.stroke(path, pen);
    }

    void build(const jet::Item& item, jet::WorldBuilder& builder) const override
    {
        const std::size_t count = item.path().segmentCount();
        if (count < 2) return builder.warn(item, "a rubber band needs two ends; it does nothing");
        jet::SpringActuatorDef spring;
        spring.a = builder.anchor(item, item.path().segment(0).point);
        spring.b = builder.anchor(item, item.path().segment(count - 1).point);
        spring.ks = value<double>(item, "stiffness");
        spring.kd = 1;
        spring.restLength = value<double>(item, "slack") * (spring.b.point - spring.a.point).norm();
        builder.bind(item, builder.world().addSpring(spring));
    }

private:
    template <class T>
    T value(const jet::Item& item, std::string_view property) const
    {
        return item.properties().get(property, properties()).as<T>();
    }
};

class MyPluginTool final : public jet::Tool {
public:
    using Tool::Tool;

    void activate() override { host().showStatus("Drag from one end to the other."); }
    void deactivate() override { cancel(); }
    void press(const jet::PointerEvent& e) override { dragging_ = true, start_ = end_ = e.scene; }
    void drag(const jet::PointerEvent& e) override { end_ = e.scene, host().requestRepaint(); }
    void release(const jet::PointerEvent&) override
    {
        if (!cancel() || start_ == end_) return;
        auto edit = host().items().begin("Create rubber band");
        edit.select(edit.add("my-plugin", host().insertionPoint(edit), jet::Path::line(start_, end_)));
        edit.commit();
    }
    bool cancel() override
    {
        host().requestRepaint();
        return std::exchange(dragging_, false);
    }
    void paint(jet::Painter& painter) const override
    {
        if (dragging_) painter.stroke(jet::Path::line(start_, end_), host().layerPen());
    }

private:
    bool dragging_ = false;
    jet::Vec2 start_, end_;  // scene units
};

}  // namespace

JET_PLUGIN(plugin)
{
    plugin.itemType<MyPluginType>("my-plugin");
    plugin.tool<MyPluginTool>("draw-my-plugin");
}
