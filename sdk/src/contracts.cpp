// Key functions of the interfaces plugins implement: one home for each vtable and type info, whatever library uses it.
#include <jet/catalog.hpp>
#include <jet/editor.hpp>
#include <jet/effect.hpp>
#include <jet/format.hpp>
#include <jet/item_type.hpp>
#include <jet/painter.hpp>
#include <jet/plugin.hpp>
#include <jet/script.hpp>
#include <jet/tool.hpp>
#include <jet/tool_view.hpp>
#include <jet/ui/panel.hpp>  // the interface needs no Qt

namespace jet {

Painter::~Painter() = default;
bool Painter::picture(const Affine& frame, std::string_view)
{
    const auto corner = [&](double x, double y) -> Vec2 { return frame * Vec2(x, y); };
    Path outline = Path::polygon(std::array{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)});
    outline.moveTo(corner(0, 0)), outline.lineTo(corner(1, 1));
    outline.moveTo(corner(1, 0)), outline.lineTo(corner(0, 1));
    Pen pen;
    pen.color = Color{128, 128, 128, 255};
    pen.cosmetic = true;
    stroke(outline, pen);
    return true;
}
PluginRegistrar::~PluginRegistrar() = default;
Catalog::~Catalog() = default;
void Catalog::recall(const PluginUse&) {}
Importer::~Importer() = default;
Exporter::~Exporter() = default;
PoseSource::~PoseSource() = default;
const LiveBody* PoseSource::liveBody(const Item&) const { return nullptr; }
ScriptRuntime::~ScriptRuntime() = default;
ContactListening::~ContactListening() = default;
ScriptEngine::~ScriptEngine() = default;
WorldBuilder::~WorldBuilder() = default;
Editor::~Editor() = default;
Panel::~Panel() = default;

Progress Editor::progress(const std::string&) { return {}; }

Command::~Command() = default;
bool Command::isEnabled(Editor&) const { return true; }

EffectState::~EffectState() = default;
Effect::~Effect() = default;
std::string Effect::rejects(const Item& item) const
{
    return item.path().isEmpty() ? "'" + item.name() + "' has no path to apply it to" : std::string();
}
void Effect::applied(Transaction&, const Item&) const {}
std::unique_ptr<EffectState> Effect::update(const EffectInput&) const { return nullptr; }
void Effect::paint(const EffectInput&, const EffectState*, PaintPurpose, Painter&) const {}
bool Effect::wantsLiveBody() const { return false; }
std::optional<BodyDef> Effect::buildBody(const EffectInput&, const BodyCommon&) const { return std::nullopt; }

ToolView::~ToolView() = default;
ToolView* toolView(ToolHost& host) { return dynamic_cast<ToolView*>(&host); }

ItemType::~ItemType() = default;
void ItemType::paint(const Item&, const Path&, PaintPurpose, Painter&) const {}
void ItemType::build(const Item&, WorldBuilder&) const {}

ToolHost::~ToolHost() = default;
void ToolHost::switchTool(std::string_view) {}
Tool::~Tool() = default;
void Tool::activate() {}
void Tool::deactivate() { cancel(); }
void Tool::press(const PointerEvent&) {}
void Tool::drag(const PointerEvent&) {}
void Tool::release(const PointerEvent&) {}
void Tool::move(const PointerEvent&) {}
void Tool::doubleClick(const PointerEvent&) {}
bool Tool::wheel(const WheelEvent&) { return false; }
bool Tool::keyPress(const KeyEvent&) { return false; }
bool Tool::keyRelease(const KeyEvent&) { return false; }
bool Tool::cancel() { return false; }
void Tool::paint(Painter&) const {}
const PropertyTable& Tool::options() const
{
    static const PropertyTable none;
    return none;
}

std::string_view manifestKey(ContributionKind kind)
{
    static constexpr std::string_view keys[] = {"tools",     "effects",        "itemTypes",     "importers",
                                                "exporters", "physicsEngines", "scriptEngines", "panels",
                                                "commands",  "settingsPages"};
    return keys[static_cast<int>(kind)];
}

std::string_view kindName(ContributionKind kind)
{
    static constexpr std::string_view names[] = {"tool",     "effect",         "item type",     "importer",
                                                 "exporter", "physics engine", "script engine", "panel",
                                                 "command",  "settings page"};
    return names[static_cast<int>(kind)];
}

}  // namespace jet
