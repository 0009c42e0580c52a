// The basic shapes and the path element as paths, in user units.
#pragma once

#include "document.hpp"
#include "length.hpp"

#include <jet/path.hpp>

namespace jet::svg {

bool isShape(Tag tag);

/// Empty where the element draws nothing: a size of zero or below, too few points. Curves stay curves. What the element
/// says wrongly goes to `report` with its place, and what came before it is kept.
Path shapePath(const Document& document, ElementIndex e, const LengthContext& lengths, Report& report);

}  // namespace jet::svg
