// BoxTool: a tool that draws one shape by dragging its box. Shift makes the box square, Alt grows it from its start as
// the centre, Esc gives up. A plugin adds what is inscribed in the box:
//
//   class RectangleTool final : public jet::BoxTool {
//   public:
//       explicit RectangleTool(jet::ToolHost& host) : BoxTool(host, {"rectangle", "square"}) {}
//       jet::Path shape(const jet::Box& box) const override { return jet::Path::rectangle(box); }
//   };
#pragma once

#include <jet/tool.hpp>

#include <string>

namespace jet {

class JET_API BoxTool : public Tool {
public:
    /// The words of the status line and the undo step.
    struct Words {
        std::string shape;        ///< "rectangle"
        std::string constrained;  ///< what Shift makes of it: "square"
    };

    BoxTool(ToolHost& host, Words words);

    /// The path of the new ShapeItem for a box that is not empty. Also painted while dragging.
    virtual Path shape(const Box& box) const = 0;

    void activate() override;
    void press(const PointerEvent& event) override;
    void drag(const PointerEvent& event) override;
    void release(const PointerEvent& event) override;
    bool keyPress(const KeyEvent& event) override;
    bool keyRelease(const KeyEvent& event) override;
    bool cancel() override;
    void paint(Painter& painter) const override;
    /// One option: "color", the face of new shapes.
    const PropertyTable& options() const override;

private:
    Box box() const { return dragBox(start_, end_, constrain_); }
    void show();
    bool constrain(const std::string& key, bool down);

    Words words_;
    bool dragging_ = false;
    Vec2 start_, end_;  // scene units
    Modifiers constrain_;
};

}  // namespace jet
