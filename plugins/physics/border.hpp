// Borders: from rings of points to walls that know which of their sides is outside.
#pragma once

#include "state.hpp"

#include <span>

namespace jet::physics {

/// What a body's rings bound: all that is inside an odd number of them, as drawn, or inside any, as of shapes.
enum class Inside { OddRings, AnyRing };

/// Appends a point to `body`'s; `local` is its place on the node, where that may turn.
void addPoint(State&, const BodyRecord& body, Index node, const Vec2& local, const Vec2& position);

/// Appends the walls of `rings` (indices of points, each ring closed) to `body`, finds their outer sides, and says
/// which points collide. Points of zero-length walls and of borders without area end up without walls; nothing is
/// refused.
void addBorders(State&, BodyRecord& body, std::span<const std::vector<Index>> rings, Inside = Inside::OddRings);

/// Corner kinds of the walls and normals of the points, in the frame of the body's grid.
void updateCorners(State&, const BodyRecord& body);
/// The grid over the body's walls as they are now.
void rebuildGrid(const State&, const BodyRecord& body);
/// The grid over the body's walls; made when it is asked for, as most rigid bodies never need one.
const EdgeGrid& gridOf(const State&, const BodyRecord& body);

struct Region {
    double area = 0;     // units²
    Vec2 centroid;       // scene units
    double inertia = 0;  // second moment about the centroid per unit of mass, units²
};

/// Area, centroid and second moment of the region inside an odd number of the body's borders, so holes count as holes.
/// Area 0 when the walls enclose nothing that can be measured.
Region measureRegion(const State&, const BodyRecord& body);

}  // namespace jet::physics
