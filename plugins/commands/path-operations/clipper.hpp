// Union, difference, intersection and exclusion of areas bounded by curves, and outlines at a distance.
//
// lib2geom combines curves exactly, but fails where outlines touch along a length or cross themselves; Qt's clipper
// (QPainterPath) takes everything, but makes polygons, to which curves are fitted again. So the first is asked first,
// its answer checked, and the second asked where it is wrong. Polygon clippers (Clipper, Boost.Geometry) know no curves
// at all.
#pragma once

#include <jet/path.hpp>

#include <span>

namespace jet::path_operations {

enum class Boolean { Union, Difference, Intersection, Exclusion };

/// The area of the first path combined with that of each further one. Open contours count as closed by a line. Holes of
/// the result run the other way. Throws Failure where the clipper's result is not the area it should be.
Path combine(std::span<const Path> paths, Boolean operation);

/// The outline `distance` (scene units) outside of the area of the path, or inside when negative; round corners
/// outside. Empty where nothing is left.
Path offset(const Path& path, double distance);

}  // namespace jet::path_operations
