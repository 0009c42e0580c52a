#include "scene_state.hpp"

#include <algorithm>

namespace jet {

namespace {

// For std::visit over the changes.
template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

void setSceneSetting(Properties& settings, const std::string& id, const Value& value)
{
    if (value.isNone()) {
        settings.erase(id);
    } else {
        settings.set(id, value);
    }
}

void setEffectProperty(EffectInstance& effect, const std::string& id, const Value& value)
{
    if (id == "visible") {
        effect.visible = value.as<bool>();
    } else if (value.isNone()) {
        effect.properties.erase(id);
    } else {
        effect.properties.set(id, value);
    }
}

template <class T>
void moveElement(std::vector<T>& all, std::size_t from, std::size_t to)
{
    T element = std::move(all[from]);
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(from));
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(to), std::move(element));
}

}  // namespace

ItemId changedItem(const Change& change)
{
    return std::visit(
        [](const auto& c) {
            if constexpr (requires { c.item; }) {
                return c.item;
            } else {
                return ItemId{};
            }
        },
        change);
}

const ItemType* itemTypeOf(Catalog& catalog, std::string_view type)
{
    if (const ItemType* builtIn = builtInItemType(type)) return builtIn;
    return catalog.itemType(type);
}

const PropertyTable* itemTable(Catalog& catalog, std::string_view type)
{
    const ItemType* found = itemTypeOf(catalog, type);
    return found ? &found->properties() : nullptr;
}

ItemsCenter::Private::Private(Scene& s, EventsCenter& e, Catalog& c)
    : scene(s), events(e), catalog(c), root(std::make_unique<Item>(kRootId, GroupItem::type))
{
    Item::Mutator::setName(*root, "Top group");
    byId.emplace(kRootId.value, root.get());
}

Item& ItemsCenter::Private::get(ItemId id)
{
    const auto found = byId.find(id.value);
    if (found == byId.end()) throw Failure(Error("the item is no longer in the scene"));
    return *found->second;
}

bool ItemsCenter::Private::owns(const Item& item) const
{
    const auto found = byId.find(item.id().value);
    return found != byId.end() && found->second == &item;
}

void ItemsCenter::Private::own(const Item& item) const
{
    if (!owns(item)) throw Failure(Error("'" + item.name() + "' is not in this scene, or not any more"));
}

void ItemsCenter::Private::ownChangeable(const Item& item) const
{
    own(item);
    if (item.id() == kRootId) throw Failure(Error("the top group of a scene cannot be changed; change what is in it"));
}

void ItemsCenter::Private::enlist(Item& subtree)
{
    subtree.walk([this](const Item& item) {
        byId.emplace(item.id().value, const_cast<Item*>(&item));
        nextId = std::max(nextId, item.id().value + 1);
    });
}

void ItemsCenter::Private::delist(const Item& subtree)
{
    bool selectedGone = false;
    subtree.walk([&](const Item& item) {
        byId.erase(item.id().value);
        scene.dropEffectStates(item.id());
        selectedGone = selected.erase(item.id().value) > 0 || selectedGone;
    });
    if (selectedGone) events.post(&scene, SelectionChanged{&scene});
}

const std::vector<ItemId>& ItemsCenter::Private::selection() const
{
    if (ordered.size() != selected.size())
        std::erase_if(ordered, [&](ItemId id) { return !selected.contains(id.value); });
    return ordered;
}

void ItemsCenter::Private::insert(ItemId parent, std::size_t index, std::unique_ptr<Item> item)
{
    enlist(*item);
    Item::Mutator::insert(get(parent), index, std::move(item));
}

std::unique_ptr<Item> ItemsCenter::Private::take(ItemId id)
{
    Item& item = get(id);
    auto taken = Item::Mutator::take(get(item.parent()->id()), item.index());
    delist(*taken);
    return taken;
}

void ItemsCenter::Private::apply(Change& change)
{
    using M = Item::Mutator;
    std::visit(
        Overloaded{
            [&](ItemAdded& c) { insert(c.parent, c.index, std::move(c.detached)); },
            [&](ItemRemoved& c) { c.detached = take(c.item); },
            [&](ItemMoved& c) {
                auto item = M::take(get(c.oldParent), c.oldIndex);
                M::insert(get(c.newParent), c.newIndex, std::move(item));
            },
            [&](PathChanged& c) { M::setPath(get(c.item), c.after); },
            [&](PropertyChanged& c) { M::setProperty(get(c.item), c.property, c.after); },
            [&](TypeChanged& c) { M::setType(get(c.item), c.after); },
            [&](EffectAdded& c) {
                auto& effects = M::effects(get(c.item));
                effects.insert(effects.begin() + static_cast<std::ptrdiff_t>(c.index), c.effect);
            },
            [&](EffectRemoved& c) {
                auto& effects = M::effects(get(c.item));
                effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(c.index));
            },
            [&](EffectMoved& c) { moveElement(M::effects(get(c.item)), c.from, c.to); },
            [&](EffectPropertyChanged& c) { setEffectProperty(M::effects(get(c.item))[c.index], c.property, c.after); },
            [&](ScenePropertyChanged& c) { setSceneSetting(scene.settings_, c.property, c.after); },
            [&](MaterialsChanged& c) { scene.materials_ = c.after; },
        },
        change);
}

void ItemsCenter::Private::make(Change change)
{
    apply(change);
    open->changes.push_back(std::move(change));
    notifyTouched();
}

void ItemsCenter::Private::revert(Change& change)
{
    using M = Item::Mutator;
    std::visit(Overloaded{
                   [&](ItemAdded& c) { c.detached = take(c.item); },
                   [&](ItemRemoved& c) { insert(c.parent, c.index, std::move(c.detached)); },
                   [&](ItemMoved& c) {
                       auto item = M::take(get(c.newParent), c.newIndex);
                       M::insert(get(c.oldParent), c.oldIndex, std::move(item));
                   },
                   [&](PathChanged& c) { M::setPath(get(c.item), c.before); },
                   [&](PropertyChanged& c) { M::setProperty(get(c.item), c.property, c.before); },
                   [&](TypeChanged& c) { M::setType(get(c.item), c.before); },
                   [&](EffectAdded& c) {
                       auto& effects = M::effects(get(c.item));
                       effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(c.index));
                   },
                   [&](EffectRemoved& c) {
                       auto& effects = M::effects(get(c.item));
                       effects.insert(effects.begin() + static_cast<std::ptrdiff_t>(c.index), c.effect);
                   },
                   [&](EffectMoved& c) { moveElement(M::effects(get(c.item)), c.to, c.from); },
                   [&](EffectPropertyChanged& c) {
                       setEffectProperty(M::effects(get(c.item))[c.index], c.property, c.before);
                   },
                   [&](ScenePropertyChanged& c) { setSceneSetting(scene.settings_, c.property, c.before); },
                   [&](MaterialsChanged& c) { scene.materials_ = c.before; },
               },
               change);
}

void ItemsCenter::Private::revertTo(std::size_t count)
{
    while (open->changes.size() > count) {
        revert(open->changes.back());
        open->changes.pop_back();
    }
}

void ItemsCenter::Private::revertAll()
{
    revertTo(0);
    nextId = open->nextIdBefore;
    setSelection(open->selectionBefore);
}

void ItemsCenter::Private::setSelection(std::vector<ItemId> items)
{
    std::unordered_set<std::uint64_t> known;
    std::erase_if(
        items, [&](ItemId id) { return id == kRootId || !byId.contains(id.value) || !known.insert(id.value).second; });
    if (items == selection()) return;
    ordered = std::move(items);
    selected = std::move(known);
    events.post(&scene, SelectionChanged{&scene});
}

void ItemsCenter::Private::notifyTouched() { events.post(&scene, SceneTouched{&scene}); }

void ItemsCenter::Private::notifyChanged(std::span<const Change> changes, ItemsChanged::Cause cause)
{
    events.post(&scene, ItemsChanged{&scene, changes, cause});
}

ItemsCenter::ItemsCenter(Scene& scene, EventsCenter& events, Catalog& catalog)
    : d_(std::make_unique<Private>(scene, events, catalog))
{
}
ItemsCenter::~ItemsCenter() = default;

Transaction ItemsCenter::begin(std::string_view label)
{
    if (d_->open)
        throw Failure(Error("'" + std::string(label) + "' cannot start while '" + d_->open->label +
                            "' is under way; finish or cancel that first"));
    d_->open = OpenTransaction{++d_->serial, std::string(label), {}, d_->selection(), d_->nextId};
    return Transaction(*this, d_->serial);
}

bool ItemsCenter::inTransaction() const { return d_->open.has_value(); }

void ItemsCenter::abandon()
{
    if (!d_->open) return;
    const bool touched = !d_->open->changes.empty();
    d_->revertAll();
    d_->open.reset();
    if (touched) d_->notifyTouched();
}

const Item& ItemsCenter::root() const { return *d_->root; }

const Item* ItemsCenter::find(ItemId id) const
{
    const auto found = d_->byId.find(id.value);
    return found == d_->byId.end() ? nullptr : found->second;
}

std::size_t ItemsCenter::itemCount() const { return d_->byId.size() - 1; }
const std::vector<ItemId>& ItemsCenter::selection() const { return d_->selection(); }

bool ItemsCenter::isSelected(ItemId id) const { return d_->selected.contains(id.value); }

void ItemsCenter::setSelection(std::vector<ItemId> items) { d_->setSelection(std::move(items)); }

namespace {

const Item* topmostAt(const Item& item, const Vec2& p, double distance)
{
    if (!item.visible() || item.locked()) return nullptr;
    const Box box = item.bounds();
    if (box.isNull() || !box.inflated(distance).contains(p)) return nullptr;
    const auto children = item.children();
    for (auto child = children.rbegin(); child != children.rend(); ++child)
        if (const Item* found = topmostAt(**child, p, distance)) return found;
    if (item.isContainer() || item.path().isEmpty()) return nullptr;
    const bool closed = std::any_of(item.path().contours().begin(), item.path().contours().end(),
                                    [](const Contour& c) { return c.closed; });
    if (closed && item.path().contains(p, FillRule::EvenOdd)) return &item;
    return item.path().nearest(p).distance <= distance ? &item : nullptr;
}

void collectIn(const Item& item, const Box& box, std::vector<const Item*>& found)
{
    if (!item.visible() || item.locked()) return;
    const Box bounds = item.bounds();
    if (bounds.isNull() || !box.intersects(bounds)) return;
    if (!item.isContainer() && !item.path().isEmpty() && box.contains(item.path().bounds())) found.push_back(&item);
    for (const auto& child : item.children()) collectIn(*child, box, found);
}

}  // namespace

const Item* ItemsCenter::itemAt(const Vec2& p, double distance) const { return topmostAt(*d_->root, p, distance); }

std::vector<const Item*> ItemsCenter::itemsIn(const Box& box) const
{
    std::vector<const Item*> found;
    collectIn(*d_->root, box, found);
    return found;
}

}  // namespace jet
