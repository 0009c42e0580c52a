// ToolSession: one tool working in one scene view. It is what the tool sees as its host, and it keeps the tool's
// mistakes from reaching the view.
#pragma once

#include "canvas/tool_options.hpp"

#include <jet/editor.hpp>
#include <jet/tool_view.hpp>

#include <QCursor>

#include <functional>
#include <memory>
#include <string>

namespace jet::host {

/// The view as a tool session sees it.
class ToolSurface {
public:
    virtual ~ToolSurface() = default;
    virtual double surfaceScale() const = 0;  ///< pixels a scene unit
    virtual void repaintTool() = 0;
    virtual void setToolCursor(const QCursor& cursor) = 0;
    /// A press and a release for the tool that is active now.
    virtual void clickTool(const PointerEvent& click) = 0;
};

class ToolSession final : public ToolHost, public ToolView {
public:
    /// Creates the tool; tool() is null when its plugin does not give one.
    ToolSession(std::string id, Scene& scene, Editor& editor, ToolOptions& options, ToolSurface& surface);
    ~ToolSession() override;

    const std::string& id() const { return id_; }
    const Tool* tool() const { return tool_.get(); }

    void activate();
    void deactivate();
    void press(const PointerEvent& event);
    void drag(const PointerEvent& event);
    void release(const PointerEvent& event);
    void move(const PointerEvent& event);
    void doubleClick(const PointerEvent& event);
    bool wheel(const WheelEvent& event);
    bool keyPress(const KeyEvent& event);
    bool keyRelease(const KeyEvent& event);
    bool cancel();
    void paint(Painter& painter) const;
    /// Are keys with Ctrl the tool's first?
    bool isTextEditing() const { return textEditing_; }

    // ToolHost, for the tool.
    Scene& scene() override { return scene_; }
    const Item& insertionPoint(Transaction& edit) override;
    Pen layerPen() const override;
    double pixelsPerUnit() const override { return surface_.surfaceScale(); }
    void requestRepaint() override { surface_.repaintTool(); }
    void showStatus(std::string text) override { editor_.showStatus(std::move(text)); }
    void setCursor(std::string_view name) override;
    const Properties& options() const override { return options_; }
    void switchTool(std::string_view id) override;

    // ToolView.
    bool hasTool(std::string_view id) const override;
    bool handOver(std::string_view tool, const PointerEvent& click) override;
    void setTextEditing(bool on) override { textEditing_ = on; }

private:
    /// Calls the tool. What it throws becomes a message, and its open transaction is taken back.
    bool guarded(const std::function<bool(Tool&)>& call);
    void guarded(void (Tool::*call)(const PointerEvent&), const PointerEvent& event);

    std::string id_;
    Scene& scene_;
    Editor& editor_;
    const Properties& options_;
    ToolSurface& surface_;
    QCursor cursor_ = Qt::ArrowCursor;
    bool textEditing_ = false;
    std::shared_ptr<ToolSurface*> self_;  ///< for what is done later: gone with the session
    std::unique_ptr<Tool> tool_;
};

}  // namespace jet::host
