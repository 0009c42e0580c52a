#include "effect_states.hpp"
#include "known_effect.hpp"
#include "scene_state.hpp"

#include <jet/scene_painter.hpp>

#include <algorithm>

namespace jet {

namespace {

constexpr Color kAbsent{200, 0, 120, 255};

/// For what an absent plugin would paint. `what` names it; empty where the outline is enough.
void paintPlaceholder(const Path& path, std::string_view what, PaintPurpose purpose, Painter& painter)
{
    if (purpose != PaintPurpose::Edit || path.isEmpty()) return;
    Pen pen;
    pen.color = kAbsent;
    pen.width = 1.5;
    pen.cosmetic = true;
    pen.dashes = {6, 4};
    painter.stroke(path, pen);
    if (!what.empty()) painter.text(path.bounds().center(), what, TextStyle{kAbsent, 12, true, true});
}

void paintOne(const Scene& scene, const Item& item, const Path& path, const LiveBody* body, PaintPurpose purpose,
              Painter& painter)
{
    // Derived data belongs to the path the item was drawn with; a moving body's path is another in each frame.
    const bool keep = purpose == PaintPurpose::Edit && &path == &item.path();
    for (std::size_t i = 0; i < item.effects().size(); ++i) {
        const EffectInstance& instance = item.effects()[i];
        if (!instance.visible) continue;
        const Effect* effect = knownEffect(scene.catalog(), instance);
        if (!effect) {
            paintPlaceholder(path, {}, purpose, painter);
            continue;
        }
        const EffectInput input{item, path, instance.properties, effect->properties(), body};
        effect->paint(input, keep ? scene.effectStates().get(*effect, input, i) : nullptr, purpose, painter);
    }
    if (const ItemType* type = itemTypeOf(scene.catalog(), item.type())) {
        type->paint(item, path, purpose, painter);
    } else {
        paintPlaceholder(path, item.type(), purpose, painter);
    }
}

void paintTree(const Scene& scene, const Item& item, const PoseSource& poses, PaintPurpose purpose, const Box& clip,
               Painter& painter)
{
    if (!item.visible()) return;
    if (!item.path().isEmpty()) {
        const Path* pose = poses.pose(item);
        const Path& path = pose ? *pose : item.path();
        if (clip.intersects(paintedArea(path.bounds())))
            paintOne(scene, item, path, poses.liveBody(item), purpose, painter);
    }
    for (const auto& child : item.children()) paintTree(scene, *child, poses, purpose, clip, painter);
}

}  // namespace

SceneOverlay::~SceneOverlay() = default;

void paintItem(const Scene& scene, const Item& item, const Path& path, PaintPurpose purpose, Painter& painter)
{
    paintOne(scene, item, path, nullptr, purpose, painter);
}

void paintScene(const Scene& scene, const PoseSource* poses, PaintPurpose purpose, const Box& clip, Painter& painter)
{
    painter.setAssetFolder(scene.assetFolder());
    if (poses) {
        paintTree(scene, scene.root(), *poses, purpose, clip, painter);
        if (const auto* overlay = dynamic_cast<const SceneOverlay*>(poses)) overlay->paintOver(painter);
        return;
    }
    for (const Item* item : scene.items().query(clip)) paintItem(scene, *item, item->path(), purpose, painter);
}

}  // namespace jet
