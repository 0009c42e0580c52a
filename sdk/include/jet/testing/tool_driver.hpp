// ToolDriver: gestures on a tool without a window.
//
//   TestToolHost host(scene);
//   ToolDriver tool(host, catalog.createTool("rectangle", host));
//   tool.hold({.shift = true}).drag({10, 10}, {60, 40}).key("Escape");
#pragma once

#include <jet/scene.hpp>
#include <jet/testing/recording_painter.hpp>
#include <jet/tool.hpp>

#include <memory>
#include <string>
#include <string_view>

namespace jet::test {

/// A scene view without a window: 1 pixel a scene unit unless told otherwise. What the tool asks of it can be read.
class TestToolHost final : public ToolHost {
public:
    explicit TestToolHost(Scene& scene) : scene_(scene) {}
    ~TestToolHost() override;

    Scene& scene() override { return scene_; }
    const Item& insertionPoint(Transaction& edit) override;
    Pen layerPen() const override;
    double pixelsPerUnit() const override { return scale; }
    void requestRepaint() override { ++repaints; }
    void showStatus(std::string text) override { status = std::move(text); }
    void setCursor(std::string_view name) override { cursor = name; }
    const Properties& options() const override { return values; }
    void switchTool(std::string_view id) override { wantedTool = id; }

    double scale = 1;  ///< pixels a scene unit
    int repaints = 0;
    std::string status, cursor, wantedTool;
    Properties values;  ///< of the tool's options

private:
    Scene& scene_;
};

/// Feeds one tool with events as a scene view does. Pixels follow from the host's scale, with the origin at the
/// top-left. Everything returns the driver, so that gestures read as a line.
class ToolDriver {
public:
    ToolDriver(TestToolHost& host, std::unique_ptr<Tool> tool);
    ~ToolDriver();

    Tool& operator*() { return *tool_; }
    Tool* operator->() { return tool_.get(); }

    /// Modifiers held from now on; hold({}) lets go.
    ToolDriver& hold(Modifiers modifiers);
    ToolDriver& press(const Vec2& at);
    /// A drag while the button is down, else a move.
    ToolDriver& move(const Vec2& to);
    ToolDriver& release();
    ToolDriver& click(const Vec2& at);
    ToolDriver& doubleClick(const Vec2& at);
    /// Press, several moves on the straight line, release.
    ToolDriver& drag(const Vec2& from, const Vec2& to, int steps = 4);
    ToolDriver& wheel(const Vec2& at, double steps);
    /// A key as the view delivers it: Escape asks cancel() first and reaches keyPress() when no gesture was under way.
    ToolDriver& key(std::string_view key);
    /// Sets one of the tool's options; throws Failure when it has no such option or the value does not fit.
    ToolDriver& option(std::string_view property, Value value);
    /// Did the tool use the last key or wheel?
    bool used() const { return used_; }
    /// What the tool paints over the scene now.
    RecordingPainter painted() const;

private:
    PointerEvent at(const Vec2& scene) const;

    TestToolHost& host_;
    std::unique_ptr<Tool> tool_;
    Modifiers modifiers_;
    Vec2 position_;
    bool down_ = false;
    bool used_ = false;
};

}  // namespace jet::test
