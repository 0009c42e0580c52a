#include "support/tool_fixture.hpp"

namespace jet::test {

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

ToolFixture::ToolFixture(std::initializer_list<std::string_view> plugins)
    : catalog_(plugins), scene_("Scene", events_, catalog_), host_(scene_), emptyHash_(scene_.hash())
{
}

ToolFixture::~ToolFixture() = default;

ToolDriver& ToolFixture::tool(std::string_view id)
{
    auto found = tools_.find(id);
    if (found == tools_.end()) {
        auto made = catalog_.createTool(id, host_);
        if (!made) throw Failure(Error(catalog_.explain(ContributionKind::Tool, id)));
        found = tools_.emplace(std::string(id), std::make_unique<ToolDriver>(host_, std::move(made))).first;
    }
    if (active_ != id) {
        if (!active_.empty()) (*tools_.find(active_)->second)->deactivate();
        active_ = id;
        (*found->second)->activate();
    }
    return *found->second;
}

std::vector<const Item*> ToolFixture::itemsOf(std::string_view type) const
{
    std::vector<const Item*> found;
    scene_.root().walk([&](const Item& item) {
        if (item.type() == type) found.push_back(&item);
    });
    return found;
}

std::vector<const Item*> ToolFixture::selected()
{
    std::vector<const Item*> found;
    for (const ItemId id : items().selection()) found.push_back(items().find(id));
    return found;
}

const Item& ToolFixture::add(std::string_view type, Path path, const Item* parent)
{
    auto edit = items().begin("Add");
    const Item& item = edit.add(type, parent ? *parent : items().root(), std::move(path));
    edit.commit();
    return item;
}

}  // namespace jet::test
