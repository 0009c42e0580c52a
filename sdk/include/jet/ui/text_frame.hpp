// Text frame: the outline a text item has so that its letters fill it.
#pragma once

#include <jet/item.hpp>
#include <jet/painter.hpp>

#include <string_view>

namespace jet::ui {

/// How a text item's letters look, from its properties.
JET_API TextStyle textStyleOf(const Item& text);
/// Does the frame depend on this property of a text item? Who sets one fits the frame in the same transaction.
JET_API bool shapesText(std::string_view property);
/// The item's frame, as wide and high as its text is now: turned as it was, growing to the side that its alignment
/// leaves open. A frame without extent stays as it is. [main thread]
JET_API Path fittedTextFrame(const Item& text);

/// Distance of lines, and of a line's top from its baseline, in sizes of the letters.
inline constexpr double kTextLineHeight = 1.2, kTextAscent = 0.93;
/// Width of an empty text, in sizes: it can still be seen and clicked.
inline constexpr double kNarrowestText = 0.5;

}  // namespace jet::ui
