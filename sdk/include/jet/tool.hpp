// Tool: what the pointer does in a scene view (thesis §3.5.1). One tool object per scene view; its state is per scene.
//
// Order of calls: activate · (press · drag* · (release | cancel) | move | wheel | key | doubleClick)* · deactivate.
// paint() is called after the scene was drawn, in scene coordinates. All on the GUI thread.
#pragma once

#include <jet/input.hpp>
#include <jet/painter.hpp>
#include <jet/property.hpp>
#include <jet/scene.hpp>

#include <string>
#include <string_view>

namespace jet {

/// What a tool can ask of the view it works in.
class JET_API ToolHost {
public:
    virtual ~ToolHost();
    virtual Scene& scene() = 0;
    ItemsCenter& items() { return scene().items(); }
    /// The container new items go to: the group or layer of the selection, else the active or first layer, made if need
    /// be. Within an open transaction, so that a made layer is part of it.
    virtual const Item& insertionPoint(Transaction& edit) = 0;
    /// Pen for rubber bands and outlines: cosmetic, in the accent colour.
    virtual Pen layerPen() const = 0;
    virtual double pixelsPerUnit() const = 0;
    virtual void requestRepaint() = 0;
    /// One line of help or measure in the status bar.
    virtual void showStatus(std::string text) = 0;
    /// "arrow", "cross", "move", "size-fdiag", "size-bdiag", "size-hor", "size-ver", "rotate", "hand", "text".
    virtual void setCursor(std::string_view name) = 0;
    /// The tool's own options (see Tool::options), kept between runs.
    virtual const Properties& options() const = 0;
    /// Makes another tool the active one, e.g. to edit the nodes of what was double-clicked. The asking tool is
    /// deactivated, perhaps before this returns. A host with one tool, and one without that tool, ignores it.
    virtual void switchTool(std::string_view id);
};

class JET_API Tool {
public:
    explicit Tool(ToolHost& host) : host_(host) {}
    virtual ~Tool();
    Tool(const Tool&) = delete;
    Tool& operator=(const Tool&) = delete;

    virtual void activate();
    /// Must end a gesture as cancel() does.
    virtual void deactivate();
    virtual void press(const PointerEvent& event);
    /// Moves with the left button held.
    virtual void drag(const PointerEvent& event);
    virtual void release(const PointerEvent& event);
    /// Moves with no button held.
    virtual void move(const PointerEvent& event);
    virtual void doubleClick(const PointerEvent& event);
    /// Returns true when the tool used the event; else the view zooms.
    virtual bool wheel(const WheelEvent& event);
    virtual bool keyPress(const KeyEvent& event);
    virtual bool keyRelease(const KeyEvent& event);
    /// Gives up the gesture under way; returns false when there was none.
    virtual bool cancel();
    virtual void paint(Painter& painter) const;
    /// Options shown in the tool-option panel; read them through host().options().
    virtual const PropertyTable& options() const;

protected:
    ToolHost& host() const { return host_; }

private:
    ToolHost& host_;
};

}  // namespace jet
