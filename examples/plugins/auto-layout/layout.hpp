// Moves boxes apart by gradient descent. Free of scenes and editors, so that it can be tested by itself.
#pragma once

#include <jet/format.hpp>

#include <vector>

/// What the descent made of it.
struct Layout {
    std::vector<jet::Vec2> shifts;  ///< one a box, scene units
    bool apart = false;             ///< no two boxes overlap
    bool cancelled = false;
};

/// Minimises E = sum over pairs of the squared depth of overlap + a weak pull of each box to where it was, by gradient
/// descent. The pull fades, so that the end has no overlap wherever there is room, and there is room: the plane is
/// infinite. `gap` is kept between boxes.
Layout layOut(const std::vector<jet::Box>& boxes, double gap, const jet::Progress& progress);
