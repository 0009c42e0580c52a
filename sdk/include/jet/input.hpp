// Pointer and keyboard input as tools and running games get it, free of any toolkit.
#pragma once

#include <jet/geometry.hpp>

#include <string>

namespace jet {

struct Modifiers {
    bool shift = false, alt = false, control = false;
    bool operator==(const Modifiers&) const = default;
};

enum class PointerButton { None, Left, Right, Middle };

struct PointerEvent {
    Vec2 scene;   ///< scene units, snapped if snapping is on
    Vec2 pixels;  ///< in the view, from its top-left
    PointerButton button = PointerButton::Left;
    Modifiers modifiers;
};

struct WheelEvent {
    Vec2 scene;
    double steps = 0;  ///< notches; positive away from the user
    Modifiers modifiers;
};

/// Keys are named as in the files and scripts: "A".."Z", "0".."9", "Left", "Right", "Up", "Down", "Space", "Enter",
/// "Escape", "Backspace", "Delete", "Tab", "Shift", "Control", "Alt", "F1".."F12", else the character typed.
struct KeyEvent {
    std::string key;
    std::string text;  ///< what was typed, UTF-8; may be empty
    Modifiers modifiers;
    bool repeat = false;
};

/// The box of a drag: Shift makes it square, Alt grows it from its start as the centre.
inline Box dragBox(const Vec2& start, const Vec2& end, const Modifiers& modifiers)
{
    Vec2 d = end - start;
    if (modifiers.shift) {
        const double side = std::max(std::abs(d.x()), std::abs(d.y()));
        d = Vec2(std::copysign(side, d.x()), std::copysign(side, d.y()));
    }
    return modifiers.alt ? Box(start - d, start + d) : Box(start, start + d);
}

}  // namespace jet
