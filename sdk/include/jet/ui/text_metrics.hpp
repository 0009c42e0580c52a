// Text metrics: how wide text is that a QtPainter draws.
#pragma once

#include <jet/painter.hpp>

#include <string_view>

namespace jet::ui {

/// Advance of one line, in the unit of style.size. Starts an offscreen application where there is none. [main thread]
JET_API double textWidth(std::string_view utf8, const TextStyle& style);

}  // namespace jet::ui
