// LineTool: a tool of two points: drag from one to the other, or click both. They snap to the middles and points of
// bodies (Alt: freely), Esc gives up. A plugin says what comes of them:
//
//   class RodTool final : public jet::LineTool {
//   public:
//       explicit RodTool(jet::ToolHost& host) : LineTool(host, "Drag from one body to another; or click both.") {}
//       std::string describe(const Line& line) const override { return "Rod of " + jet::numberText(line.way.norm()); }
//       void paintLine(const Line& line, jet::Painter& painter) const override
//       {
//           painter.stroke(jet::Path::line(line.from.at, line.to.at), host().layerPen());
//       }
//       void finish(const Line& line) override { ... }  // begin an edit, add what holds line.from and line.to
//   };
#pragma once

#include <jet/body_point.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace jet {

class JET_API LineTool : public Tool {
public:
    struct Line {
        BodyPoint from, to;
        Vec2 way;  ///< from `from.at` to `to.at`, scene units; null after two clicks at one place
    };
    /// Where the second point is.
    enum class Second : std::uint8_t {
        Snaps,  ///< as the first one
        Free    ///< where the pointer is; with Shift, at an eighth of a turn about the first
    };

    /// `help`: the status line until there is a first point.
    LineTool(ToolHost& host, std::string help, Second second = Second::Snaps);

    /// There are both points, and the gesture is over: makes what is to be made, or says why not.
    virtual void finish(const Line& line) = 0;
    /// The status line while the second point is sought.
    virtual std::string describe(const Line& line) const = 0;
    /// While the second point is sought; the marks of points come over it.
    virtual void paintLine(const Line& line, Painter& painter) const = 0;

    void activate() override;
    void deactivate() override;
    void press(const PointerEvent& event) override;
    void drag(const PointerEvent& event) override;
    void release(const PointerEvent& event) override;
    void move(const PointerEvent& event) override;
    bool keyPress(const KeyEvent& event) override;
    bool keyRelease(const KeyEvent& event) override;
    bool cancel() override;
    void paint(Painter& painter) const override;
    /// One option: "snap". A tool with others has it among them, or its points do not snap.
    const PropertyTable& options() const override;

private:
    BodyPoint pointAt(const PointerEvent& event, bool maySnap) const;
    Line line() const;
    void follow(const PointerEvent& event);
    void show();
    bool constrain(const std::string& key, bool down);

    std::string help_;
    Second second_;
    bool pressed_ = false;
    bool last_ = false;     // is this the press that ends it?
    bool eighths_ = false;  // Shift is held
    Vec2 pressedAt_;        // pixels
    std::optional<BodyPoint> from_, hover_;
};

}  // namespace jet
