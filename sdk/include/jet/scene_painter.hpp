// Painting a scene through its effects and item types: used by the window and by picture exporters alike.
#pragma once

#include <jet/effect.hpp>
#include <jet/format.hpp>

namespace jet {

/// What is drawn over a scene, in its coordinates, such as marks of what runs in it. A PoseSource that has any derives
/// from this as well, so that every surface shows it.
class JET_API SceneOverlay {
public:
    virtual ~SceneOverlay();
    virtual void paintOver(Painter& painter) const = 0;
};

/// Draws all shown items in tree order (the first is the bottom), then what `poses` has over them. `poses` may be null;
/// `clip` is the scene area that matters.
JET_API void paintScene(const Scene& scene, const PoseSource* poses, PaintPurpose purpose, const Box& clip,
                        Painter& painter);
/// Draws one item (not its children): its visible effects in order, then what its type adds.
JET_API void paintItem(const Scene& scene, const Item& item, const Path& path, PaintPurpose purpose, Painter& painter);

}  // namespace jet
