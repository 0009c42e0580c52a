// Numbers and lengths as attributes and styles write them.
#pragma once

#include <jet/geometry.hpp>

#include <optional>
#include <string_view>
#include <vector>

namespace jet::svg {

/// What percentages and relative units refer to.
struct LengthContext {
    Vec2 viewport;  ///< size of the nearest viewport, user units
    Vec2 window;    ///< size of the outermost viewport, for vw and vh
    double fontSize = 16;
};

/// What 100 % is: the viewport's width, its height, or its diagonal over the square root of two.
enum class Axis { X, Y, Diagonal };

/// User units; a physical unit counts 96 to the inch. None for anything that is not one finite length.
std::optional<double> parseLength(std::string_view text, const LengthContext& context, Axis axis);
/// Takes a length from the front of `text`.
std::optional<double> takeLength(std::string_view& text, const LengthContext& context, Axis axis);

std::optional<double> parseNumber(std::string_view text);
/// "0.5" or "50%".
std::optional<double> parseRatio(std::string_view text);
/// All numbers up to the first thing that is none; `complete` tells whether that was the end.
std::vector<double> parseNumbers(std::string_view text, bool* complete = nullptr);

/// Spaces with at most one comma among them.
void skipCommaSpace(std::string_view& text);
void skipSpace(std::string_view& text);
char lower(char c);
bool equalsIgnoringCase(std::string_view a, std::string_view b);

}  // namespace jet::svg
