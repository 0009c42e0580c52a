#include "canvas/insertion_point.hpp"

#include <jet/symbols.hpp>

namespace jet::host {

namespace {

bool receives(const Item* item)
{
    return item && item->isContainer() && item->parent() && item->editable() && item->shown();
}

/// The selected container, or the container around the selected item. What is put beside a selected instance of a
/// symbol does not become a part of the symbol; with something inside of it selected, it does.
const Item* containerOf(const Item* item)
{
    if (item && isInstance(*item)) item = item->parent();
    while (item && !item->isContainer()) item = item->parent();
    return item;
}

}  // namespace

const Item& insertionPoint(Editor& editor, Scene& scene, Transaction& edit)
{
    const ItemsCenter& items = scene.items();
    if (!items.selection().empty()) {
        const Item* container = containerOf(items.find(items.selection().front()));
        if (receives(container)) return *container;
    }
    const Item* active = items.find(editor.activeLayer());
    if (receives(active)) return *active;
    for (const auto& child : scene.root().children()) {
        if (child->is<LayerItem>() && receives(child.get())) return *child;
    }
    const Item& layer = edit.add<LayerItem>(scene.root());
    edit.set(layer, "name", "Layer");
    return layer;
}

}  // namespace jet::host
