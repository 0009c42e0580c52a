#include "window/selected_items.hpp"

#include <unordered_set>

namespace jet::host {

std::vector<const Item*> topSelection(const Scene& scene)
{
    std::unordered_set<std::uint64_t> selected;
    for (const ItemId id : scene.items().selection()) selected.insert(id.value);
    std::vector<const Item*> items;
    scene.root().walk([&](const Item& item) {
        if (!selected.contains(item.id().value)) return true;
        items.push_back(&item);
        return false;
    });
    return items;
}

std::vector<ItemId> selectableItems(const Scene& scene)
{
    std::vector<ItemId> items;
    scene.root().walk([&](const Item& item) {
        if (&item == &scene.root()) return true;
        if (!item.visible() || item.locked()) return false;
        if (item.is<LayerItem>()) return true;
        if (!item.is<ScriptItem>()) items.push_back(item.id());
        return false;
    });
    return items;
}

}  // namespace jet::host
