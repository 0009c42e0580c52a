// Colours as CSS writes them.
#pragma once

#include <jet/value.hpp>

#include <optional>
#include <string_view>

namespace jet::svg {

/// #rgb, #rgba, #rrggbb, #rrggbbaa, rgb(), rgba(), hsl(), hsla(), names, transparent. None for anything else.
std::optional<Color> parseColor(std::string_view text);
/// Takes a colour from the front of `text`, up to a space outside of parentheses.
std::optional<Color> takeColor(std::string_view& text);

}  // namespace jet::svg
