// BodyPoint: a point that holds a body, or the background; for tools that draw joints, springs and forces. Points snap
// to the middles and the path points of bodies.
//
//   const jet::BodyPoint end = jet::bodyPointAt(host(), event.scene, !event.modifiers.alt);
//   if (!end.isBackground()) edit.add("joint", parent, jet::Path::line(end.inside, other.inside));
#pragma once

#include <jet/tool.hpp>

#include <string>

namespace jet {

struct BodyPoint {
    Vec2 at;           ///< scene units; as shown
    Vec2 inside;       ///< the same, or a little nearer to the middle: in the body for certain
    ItemId body;       ///< none: the background
    std::string name;  ///< of the body
    bool snapped = false;

    bool isBackground() const { return body == ItemId{}; }
};

/// The topmost body at `at`; with `snap` at the nearest middle or point of a body within a few pixels of it. [gui]
JET_API BodyPoint bodyPointAt(ToolHost& host, const Vec2& at, bool snap);
/// A ring about the point, and a dot in it where it holds a body; in the host's pen.
JET_API void paintBodyPoint(const BodyPoint& point, const ToolHost& host, Painter& painter);

}  // namespace jet
