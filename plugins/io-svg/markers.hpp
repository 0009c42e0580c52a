// Markers: where along a path they stand, and how the content of a <marker> gets there (SVG 2, section 13.7).
#pragma once

#include "document.hpp"
#include "length.hpp"

#include <jet/path.hpp>

#include <optional>

namespace jet::svg {

/// The kind of vertex is an index into Style::markers.
enum class MarkerKind { Start, Mid, End };

struct MarkerVertex {
    MarkerKind kind = MarkerKind::Mid;
    Vec2 point;
    double angle = 0;  ///< radians: of the path there, halfway between both sides at a corner
};

/// In the order of the path.
std::vector<MarkerVertex> markerVertices(const Path& path);

/// Maps the content of a marker to the user units of the path. None: the marker has no size.
struct MarkerPlacement {
    Affine toUser;
    Vec2 viewport;  ///< what 100 % is in the content
};
std::optional<MarkerPlacement> placeMarker(const Element& marker, const MarkerVertex& vertex, double strokeWidth,
                                           const LengthContext& lengths);

}  // namespace jet::svg
