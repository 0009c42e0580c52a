// Painting a scene through its effects and item types: used by the window and by picture exporters alike.
#pragma once

#include <jet/effect.hpp>
#include <jet/format.hpp>

namespace jet {

/// Draws all shown items in tree order (the first is the bottom). `poses` may be null; `clip` is the scene area that
/// matters.
JET_API void paintScene(const Scene& scene, const PoseSource* poses, PaintPurpose purpose, const Box& clip,
                        Painter& painter);
/// Draws one item (not its children): its visible effects in order, then what its type adds.
JET_API void paintItem(const Scene& scene, const Item& item, const Path& path, PaintPurpose purpose, Painter& painter);

}  // namespace jet
