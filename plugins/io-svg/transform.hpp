// Transforms of the attribute and of the style, and the map from a viewBox to its viewport.
#pragma once

#include <jet/geometry.hpp>

#include <optional>
#include <string_view>

namespace jet::svg {

/// A list of transforms, SVG's or CSS's (with px, deg, rad, grad, turn). None if it is not one: then it has no effect.
std::optional<Affine> parseTransform(std::string_view text);

/// The viewBox attribute; none where absent, malformed or without a size.
std::optional<Box> parseViewBox(std::string_view text);

/// Maps `viewBox` into the box `viewport`, as preserveAspectRatio says (SVG 2, section 8.6).
Affine viewBoxTransform(const Box& viewBox, const Box& viewport, std::string_view preserveAspectRatio);

}  // namespace jet::svg
