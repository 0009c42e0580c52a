#include "canvas/tool_session.hpp"

#include "canvas/insertion_point.hpp"

#include <algorithm>
#include <iterator>

namespace jet::host {

namespace {

struct CursorName {
    std::string_view name;
    Qt::CursorShape shape;
};

constexpr CursorName kCursors[] = {
    {"arrow", Qt::ArrowCursor},          {"cross", Qt::CrossCursor},          {"move", Qt::SizeAllCursor},
    {"size-fdiag", Qt::SizeFDiagCursor}, {"size-bdiag", Qt::SizeBDiagCursor}, {"size-hor", Qt::SizeHorCursor},
    {"size-ver", Qt::SizeVerCursor},     {"rotate", Qt::PointingHandCursor},  {"hand", Qt::OpenHandCursor},
    {"text", Qt::IBeamCursor},
};

constexpr Color kAccent{61, 139, 253, 255};

}  // namespace

ToolSession::ToolSession(std::string id, Scene& scene, Editor& editor, ToolOptions& options, ToolSurface& surface)
    : id_(std::move(id)), scene_(scene), editor_(editor), options_(options.of(id_)), surface_(surface),
      self_(std::make_shared<ToolSurface*>(&surface)), tool_(editor.catalog().createTool(id_, *this))
{
}

ToolSession::~ToolSession() = default;

bool ToolSession::guarded(const std::function<bool(Tool&)>& call)
{
    if (!tool_) return false;
    try {
        return call(*tool_);
    } catch (const std::exception& problem) {
        scene_.items().abandon();
        editor_.showMessage("The tool \"" + id_ + "\" failed: " + problem.what());
        return false;
    }
}

void ToolSession::guarded(void (Tool::*call)(const PointerEvent&), const PointerEvent& event)
{
    guarded([&](Tool& tool) {
        (tool.*call)(event);
        return true;
    });
}

void ToolSession::activate()
{
    surface_.setToolCursor(cursor_);
    guarded([](Tool& tool) {
        tool.activate();
        return true;
    });
}

void ToolSession::deactivate()
{
    guarded([](Tool& tool) {
        tool.deactivate();
        return true;
    });
    textEditing_ = false;
}

void ToolSession::press(const PointerEvent& event) { guarded(&Tool::press, event); }
void ToolSession::drag(const PointerEvent& event) { guarded(&Tool::drag, event); }
void ToolSession::release(const PointerEvent& event) { guarded(&Tool::release, event); }
void ToolSession::move(const PointerEvent& event) { guarded(&Tool::move, event); }
void ToolSession::doubleClick(const PointerEvent& event) { guarded(&Tool::doubleClick, event); }

bool ToolSession::wheel(const WheelEvent& event)
{
    return guarded([&](Tool& tool) { return tool.wheel(event); });
}

bool ToolSession::keyPress(const KeyEvent& event)
{
    return guarded([&](Tool& tool) { return tool.keyPress(event); });
}

bool ToolSession::keyRelease(const KeyEvent& event)
{
    return guarded([&](Tool& tool) { return tool.keyRelease(event); });
}

bool ToolSession::cancel()
{
    return guarded([](Tool& tool) { return tool.cancel(); });
}

void ToolSession::paint(Painter& painter) const
{
    if (!tool_) return;
    try {
        tool_->paint(painter);
    } catch (const std::exception& problem) {
        editor_.showMessage("The tool \"" + id_ + "\" failed while drawing: " + problem.what());
    }
}

const Item& ToolSession::insertionPoint(Transaction& edit) { return host::insertionPoint(editor_, scene_, edit); }

Pen ToolSession::layerPen() const
{
    Pen pen;
    pen.color = kAccent;
    pen.width = 1.5;
    pen.cosmetic = true;
    return pen;
}

void ToolSession::setCursor(std::string_view name)
{
    for (const CursorName& known : kCursors) {
        if (known.name == name) cursor_ = QCursor(known.shape);
    }
    surface_.setToolCursor(cursor_);
}

bool ToolSession::hasTool(std::string_view id) const
{
    const auto tools = editor_.catalog().contributions(ContributionKind::Tool);
    return std::any_of(tools.begin(), tools.end(), [&](const Contribution& tool) { return tool.id == id; });
}

void ToolSession::switchTool(std::string_view id)
{
    if (!hasTool(id)) return;
    // Later: the tool that asks is in the middle of one of its own calls.
    editor_.events().enqueue([&editor = editor_, tool = std::string(id)] { editor.setActiveTool(tool); });
}

bool ToolSession::handOver(std::string_view id, const PointerEvent& click)
{
    if (!hasTool(id)) return false;
    const std::weak_ptr<ToolSurface*> surface = self_;
    editor_.events().enqueue([&editor = editor_, tool = std::string(id), click, surface] {
        editor.setActiveTool(tool);
        if (const auto present = surface.lock(); present && editor.activeTool() == tool) (*present)->clickTool(click);
    });
    return true;
}

}  // namespace jet::host
