#include <jet/arrange.hpp>
#include <jet/editor.hpp>
#include <jet/symbols.hpp>

#include <algorithm>
#include <unordered_set>

namespace jet {

namespace {

ItemList editableOnes(std::span<const Item* const> items)
{
    ItemList list;
    std::copy_if(items.begin(), items.end(), std::back_inserter(list),
                 [](const Item* item) { return item->editable() && item->shown(); });
    return list;
}

/// Those with bounds: a script or an empty group has no place.
ItemList placedOnes(std::span<const Item* const> items)
{
    ItemList list = editableOnes(items);
    std::erase_if(list, [](const Item* item) { return item->bounds().isNull(); });
    return list;
}

void moveBy(Transaction& edit, const Item& item, const Vec2& by)
{
    if (by != Vec2(0, 0)) edit.transform(item, Affine::translation(by));
}

bool alongX(Distribution distribution)
{
    return distribution == Distribution::CentersX || distribution == Distribution::GapsX;
}

/// Raises or lowers one item past the next sibling that is not in `moving`.
void step(Transaction& edit, const Item& item, const std::unordered_set<const Item*>& moving, bool forward)
{
    const Item* next = forward ? item.sibling() : item.priorSibling();
    if (next && !moving.contains(next)) edit.move(item, *item.parent(), next->index());
}

const Item* layerOf(const Item& item)
{
    const Item* layer = &item;
    while (layer && !layer->is<LayerItem>()) layer = layer->parent();
    return layer;
}

/// Layers in tree order, which is the order they are painted in.
ItemList layersOf(const Item& root)
{
    ItemList layers;
    root.walk([&](const Item& item) {
        if (item.is<LayerItem>()) layers.push_back(&item);
        return item.isContainer();
    });
    return layers;
}

const Item& rootOf(const Item& item)
{
    const Item* root = &item;
    while (root->parent()) root = root->parent();
    return *root;
}

}  // namespace

Scene* editableScene(Editor& editor)
{
    Scene* scene = editor.activeScene();
    const SimulationCenter& simulation = editor.simulation();
    const bool playing = scene && simulation.state() != SimulationCenter::State::Stopped && simulation.scene() == scene;
    return playing ? nullptr : scene;
}

ItemList topSelection(const Scene& scene)
{
    // Only containers of something selected are entered, so that the cost does not grow with the rest of the scene.
    std::unordered_set<const Item*> selected, entered;
    for (const ItemId id : scene.items().selection()) {
        const Item* item = scene.items().find(id);
        selected.insert(item);
        for (const Item* at = item->parent(); at && entered.insert(at).second;) at = at->parent();
    }
    ItemList items;
    scene.root().walk([&](const Item& item) {
        if (!selected.contains(&item)) return entered.contains(&item);
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

Box boundsOf(std::span<const Item* const> items)
{
    Box box;
    for (const Item* item : items) box.extend(item->bounds());
    return box;
}

void alignItems(Transaction& edit, std::span<const Item* const> items, Alignment alignment, Box frame)
{
    const ItemList list = placedOnes(items);
    if (frame.isNull()) frame = boundsOf(list);
    for (const Item* item : list) {
        const Box box = item->bounds();
        Vec2 by(0, 0);
        switch (alignment) {
        case Alignment::Left: by.x() = frame.min.x() - box.min.x(); break;
        case Alignment::CenterX: by.x() = frame.center().x() - box.center().x(); break;
        case Alignment::Right: by.x() = frame.max.x() - box.max.x(); break;
        case Alignment::Top: by.y() = frame.min.y() - box.min.y(); break;
        case Alignment::CenterY: by.y() = frame.center().y() - box.center().y(); break;
        case Alignment::Bottom: by.y() = frame.max.y() - box.max.y(); break;
        }
        moveBy(edit, *item, by);
    }
}

void distributeItems(Transaction& edit, std::span<const Item* const> items, Distribution distribution)
{
    ItemList list = placedOnes(items);
    if (list.size() < 3) return;
    const int axis = alongX(distribution) ? 0 : 1;
    const bool gaps = distribution == Distribution::GapsX || distribution == Distribution::GapsY;
    const auto place = [&](const Item* item) {
        return gaps ? item->bounds().min[axis] : item->bounds().center()[axis];
    };
    std::stable_sort(list.begin(), list.end(), [&](const Item* a, const Item* b) { return place(a) < place(b); });

    const double from = place(list.front());
    double space = place(list.back()) - from;
    if (gaps) {
        for (std::size_t i = 0; i + 1 < list.size(); ++i) space -= list[i]->bounds().size()[axis];
    }
    space /= static_cast<double>(list.size() - 1);
    double at = from;
    for (std::size_t i = 0; i + 1 < list.size(); ++i) {  // the last one stays
        Vec2 by(0, 0);
        by[axis] = at - place(list[i]);
        at += space + (gaps ? list[i]->bounds().size()[axis] : 0);
        if (i > 0) moveBy(edit, *list[i], by);
    }
}

void flipItems(Transaction& edit, std::span<const Item* const> items, FlipAxis axis)
{
    const ItemList list = placedOnes(items);
    const Vec2 factor = axis == FlipAxis::Horizontal ? Vec2(-1, 1) : Vec2(1, -1);
    const Affine mirror = Affine::scaling(factor, boundsOf(list).center());
    for (const Item* item : list) edit.transform(*item, mirror);
}

void reorderItems(Transaction& edit, std::span<const Item* const> items, StackOrder order)
{
    ItemList list = editableOnes(items);
    const std::unordered_set<const Item*> moving(list.begin(), list.end());
    // Each in turn from the side they move to, so that they do not stand in each other's way.
    const bool up = order == StackOrder::ToFront || order == StackOrder::Forward;
    const bool lastFirst = order == StackOrder::Forward || order == StackOrder::ToBack;
    if (lastFirst) std::reverse(list.begin(), list.end());
    for (const Item* item : list) {
        switch (order) {
        case StackOrder::ToFront: edit.move(*item, *item->parent(), item->parent()->children().size() - 1); break;
        case StackOrder::ToBack: edit.move(*item, *item->parent(), 0); break;
        default: step(edit, *item, moving, up);
        }
    }
}

const Item* groupItems(Transaction& edit, std::span<const Item* const> items)
{
    ItemList members = editableOnes(items);
    std::erase_if(members, [](const Item* item) { return item->is<LayerItem>(); });
    if (members.empty()) return nullptr;
    const Item& last = *members.back();
    const Item& group = edit.add(GroupItem::type, *last.parent(), {}, last.index() + 1);
    for (const Item* member : members) edit.move(*member, group, group.children().size());
    return &group;
}

ItemList ungroupItems(Transaction& edit, std::span<const Item* const> items)
{
    ItemList freed;
    for (const Item* group : editableOnes(items)) {
        if (!group->is<GroupItem>()) continue;
        if (isInstance(*group)) detachInstance(edit, *group);  // its members leave this instance, not the symbol
        while (!group->children().empty()) {
            const Item& member = *group->children().front();
            freed.push_back(&member);
            edit.move(member, *group->parent(), group->index());
        }
        edit.remove(*group);
    }
    return freed;
}

ItemList moveToNextLayer(Transaction& edit, std::span<const Item* const> items, bool up)
{
    ItemList moved, list = editableOnes(items);
    if (list.empty()) return moved;
    const ItemList layers = layersOf(rootOf(*list.front()));
    for (const Item* item : list) {
        const Item* layer = layerOf(*item);
        if (!layer || layer == item) continue;
        const auto at = std::find(layers.begin(), layers.end(), layer);
        if (up ? at + 1 == layers.end() : at == layers.begin()) continue;
        const Item& target = up ? **(at + 1) : **(at - 1);
        if (!target.editable()) continue;
        edit.move(*item, target, target.children().size());
        moved.push_back(item);
    }
    return moved;
}

}  // namespace jet
