// Viewports: what width, height, viewBox and preserveAspectRatio of the outermost and of nested <svg> and <symbol>
// mean.
#pragma once

#include "document.hpp"
#include "length.hpp"

#include <optional>

namespace jet::svg {

struct Viewport {
    Vec2 size;          ///< of the page or of the place it is put, in outer units
    Vec2 userSize;      ///< what 100 % is inside
    Affine toOuter;     ///< inner to outer user units
    bool sized = true;  ///< false: the drawing does not say how large it is
};

/// Of the outermost <svg>, in pixels, 96 to the inch. None: it has a width or height of zero or below; nothing is
/// drawn.
std::optional<Viewport> outermostViewport(const Element& svg, double fontSize);

/// Of an <svg> or <symbol> in a drawing, whose attributes `use` overrides where it is given. None: nothing is drawn.
std::optional<Viewport> innerViewport(const Element& element, const Element* use, const LengthContext& lengths);

}  // namespace jet::svg
