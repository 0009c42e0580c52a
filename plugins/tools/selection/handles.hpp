// The frame around the selection: eight handles that scale it, a ninth and the zones outside the corners that rotate it
// (thesis §3.5.1.1), and the maps these make of the items.
#pragma once

#include <jet/input.hpp>
#include <jet/painter.hpp>

#include <string_view>

namespace jet::selection {

enum class Handle { None, TopLeft, Top, TopRight, Right, BottomRight, Bottom, BottomLeft, Left, Rotate };

class Frame {
public:
    /// Around `box`, the bounds of what is selected. Handles have the same size in pixels at every zoom.
    Frame(const Box& box, double pixelsPerUnit);

    Handle handleAt(const Vec2& p) const;
    void paint(Painter& painter, const Pen& pen) const;

private:
    Vec2 position(Handle handle) const;

    Box frame_;     // larger than the box, so that handles do not cover what is small
    double pixel_;  // scene units
};

/// The cursor's name (see ToolHost::setCursor) over a handle.
std::string_view cursorOf(Handle handle);

/// Dragging a scale handle of `box` by `delta`. The opposite side stays where it is; Alt: the centre. Shift keeps the
/// ratio. The map is never singular: what is dragged flat keeps a thousandth of its size.
Affine scaled(const Box& box, Handle handle, const Vec2& delta, const Modifiers& modifiers);

/// The angle from `from` to `to` about the centre, in (-π, π]; Shift: in steps of 15°.
double dragAngle(const Vec2& centre, const Vec2& from, const Vec2& to, const Modifiers& modifiers);
/// Affine::rotation, but with exact zeros and ones for quarter turns.
Affine rotated(double angle, const Vec2& centre);

}  // namespace jet::selection
