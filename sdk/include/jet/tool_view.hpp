// ToolView: what a scene view in a window can do for a tool beyond ToolHost. A tool asks toolView() for it and goes on
// without where there is none: in tests, and in hosts with one tool.
//
//   if (ToolView* view = toolView(host())) view->setTextEditing(true);
#pragma once

#include <jet/tool.hpp>

namespace jet {

/// Implemented by hosts. [gui]
class JET_API ToolView {
public:
    virtual ~ToolView();
    /// Is there such a tool?
    virtual bool hasTool(std::string_view id) const = 0;
    /// As ToolHost::switchTool(), and the other tool gets that click: a press and a release. False, and nothing
    /// happens, when there is no such tool.
    virtual bool handOver(std::string_view tool, const PointerEvent& click) = 0;
    /// While a text is being edited, keys with Ctrl are the tool's first, too: Ctrl+C copies letters then, no items.
    /// What keyPress() does not use goes to the menus as ever. Off when the tool is deactivated.
    virtual void setTextEditing(bool on) = 0;
};

/// The view of a tool's host; null where it has none.
JET_API ToolView* toolView(ToolHost& host);

}  // namespace jet
