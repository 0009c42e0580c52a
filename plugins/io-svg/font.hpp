// The CSS shorthand `font`: "italic bold 12px/1.5 Georgia, serif" in the properties it stands for.
#pragma once

#include <optional>
#include <string_view>

namespace jet::svg {

/// Views into the value, or to words of CSS.
struct FontShorthand {
    std::string_view style = "normal", weight = "normal", size, family;
};

/// Nothing where the value is none: then it counts as not written. The names of system fonts ("caption") are none here.
std::optional<FontShorthand> parseFont(std::string_view value);

}  // namespace jet::svg
