// Questions of where the items of a scene are: answered by the spatial index, in painting order.
#include "scene_state.hpp"

#include <bit>

namespace jet {

Box paintedArea(const Box& bounds)
{
    return bounds.isNull() ? bounds : bounds.inflated(0.25 * std::max(bounds.width(), bounds.height()) + 32);
}

void ItemsCenter::Private::makeIndex()
{
    if (std::exchange(indexed, true)) return;
    root->walk([this](const Item& item) {
        if (&item != root.get()) index.add(const_cast<Item&>(item));
    });
}

void ItemsCenter::Private::sortByOrder(std::vector<const Item*>& items)
{
    // Comparing two places in the tree costs some 50 ns, counting all places some 5 ns an item, once after each change
    // of the tree.
    if (!orderValid && 10 * items.size() * std::bit_width(items.size()) < byId.size()) {
        std::ranges::sort(items, [](const Item* a, const Item* b) { return isPaintedBefore(*a, *b); });
        return;
    }
    if (!std::exchange(orderValid, true)) {
        std::uint32_t order = 0;
        root->walk([&](const Item& item) { Item::Mutator::order(item) = order++; });
    }
    std::ranges::sort(items, {}, [](const Item* item) { return Item::Mutator::order(*item); });
}

namespace {

/// Of the path alone; Item::bounds() of an item without children is that, and cached.
Box pathBounds(const Item& item) { return item.children().empty() ? item.bounds() : item.path().bounds(); }

bool isTarget(const Item& item) { return !item.isContainer() && item.shown() && item.editable(); }

bool isHit(const Item& item, const Vec2& p, double distance)
{
    if (!pathBounds(item).inflated(distance).contains(p)) return false;
    const bool closed = std::ranges::any_of(item.path().contours(), &Contour::closed);
    if (closed && item.path().contains(p, FillRule::EvenOdd)) return true;
    return item.path().nearest(p).distance <= distance;
}

}  // namespace

const Item* ItemsCenter::itemAt(const Vec2& p, double distance) const
{
    d_->makeIndex();
    std::vector<const Item*> found;
    d_->index.query(Box(p, p).inflated(distance), false, found);
    std::erase_if(found, [](const Item* item) { return !isTarget(*item); });
    d_->sortByOrder(found);
    for (auto item = found.rbegin(); item != found.rend(); ++item)
        if (isHit(**item, p, distance)) return *item;
    return nullptr;
}

std::vector<const Item*> ItemsCenter::itemsIn(const Box& box) const
{
    d_->makeIndex();
    std::vector<const Item*> found;
    d_->index.query(box, false, found);
    std::erase_if(found, [&](const Item* item) { return !isTarget(*item) || !box.contains(pathBounds(*item)); });
    d_->sortByOrder(found);
    return found;
}

std::vector<const Item*> ItemsCenter::query(const Box& area) const
{
    d_->makeIndex();
    std::vector<const Item*> found;
    d_->index.query(area, true, found);
    std::erase_if(found, [](const Item* item) { return !item->shown(); });
    d_->sortByOrder(found);
    return found;
}

}  // namespace jet
