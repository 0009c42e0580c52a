#include <jet/testing/tool_driver.hpp>

namespace jet::test {

TestToolHost::~TestToolHost() = default;

Pen TestToolHost::layerPen() const
{
    Pen pen;
    pen.color = {0, 120, 215, 255};
    pen.cosmetic = true;
    return pen;
}

const Item& TestToolHost::insertionPoint(Transaction& edit)
{
    for (const ItemId id : items().selection()) {
        const Item* item = items().find(id);
        while (item && !item->isContainer()) item = item->parent();
        if (item && item->parent()) return *item;
    }
    for (const auto& child : items().root().children())
        if (child->is<LayerItem>()) return *child;
    return edit.add<LayerItem>(items().root());
}

ToolDriver::ToolDriver(TestToolHost& host, std::unique_ptr<Tool> tool) : host_(host), tool_(std::move(tool)) {}
ToolDriver::~ToolDriver() = default;

PointerEvent ToolDriver::at(const Vec2& scene) const
{
    return PointerEvent{scene, scene * host_.pixelsPerUnit(), down_ ? PointerButton::Left : PointerButton::None,
                        modifiers_};
}

ToolDriver& ToolDriver::hold(Modifiers modifiers)
{
    modifiers_ = modifiers;
    return *this;
}

ToolDriver& ToolDriver::press(const Vec2& p)
{
    down_ = true;
    position_ = p;
    tool_->press(at(p));
    return *this;
}

ToolDriver& ToolDriver::move(const Vec2& to)
{
    position_ = to;
    if (down_) {
        tool_->drag(at(to));
    } else {
        tool_->move(at(to));
    }
    return *this;
}

ToolDriver& ToolDriver::release()
{
    PointerEvent event = at(position_);
    event.button = PointerButton::Left;
    down_ = false;
    tool_->release(event);
    return *this;
}

ToolDriver& ToolDriver::click(const Vec2& p) { return press(p).release(); }

ToolDriver& ToolDriver::doubleClick(const Vec2& p)
{
    click(p);
    PointerEvent event = at(p);
    event.button = PointerButton::Left;
    tool_->doubleClick(event);
    return release();
}

ToolDriver& ToolDriver::drag(const Vec2& from, const Vec2& to, int steps)
{
    press(from);
    for (int i = 1; i < steps; ++i) move(from + (to - from) * (static_cast<double>(i) / steps));
    return move(to).release();
}

ToolDriver& ToolDriver::wheel(const Vec2& p, double steps)
{
    used_ = tool_->wheel(WheelEvent{p, steps, modifiers_});
    return *this;
}

ToolDriver& ToolDriver::key(std::string_view key)
{
    if (key == "Escape" && tool_->cancel()) {
        down_ = false;
        used_ = true;
        return *this;
    }
    const KeyEvent event{std::string(key), key.size() == 1 ? std::string(key) : std::string(), modifiers_, false};
    used_ = tool_->keyPress(event);
    tool_->keyRelease(event);
    return *this;
}

ToolDriver& ToolDriver::option(std::string_view property, Value value)
{
    const PropertySpec* spec = tool_->options().find(property);
    if (!spec) throw Failure(Error("The tool has no option '" + std::string(property) + "'."));
    spec->check(value).orThrow();
    host_.values.set(property, std::move(value));
    return *this;
}

RecordingPainter ToolDriver::painted() const
{
    RecordingPainter painter(host_.scale);
    tool_->paint(painter);
    return painter;
}

}  // namespace jet::test
