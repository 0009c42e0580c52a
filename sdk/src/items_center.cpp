// The tree and the selection of a scene, changes made and taken back, and who is told. Where items are:
// items_query.cpp.
#include "scene_state.hpp"
#include "symbol_links.hpp"

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
    : scene(s), events(e), catalog(c), owner(ownerThreadOf(e)), root(std::make_unique<Item>(kRootId, GroupItem::type))
{
    Item::Mutator::setName(*root, "Top group");
    byId.insert(kRootId.value, root.get());
    symbols = std::make_unique<Item>(kSymbolsId, GroupItem::type);
    Item::Mutator::setName(*symbols, "Symbols");
    byId.insert(kSymbolsId.value, symbols.get());
    links = std::make_unique<Links>(*this);
    ordered = std::make_shared<const std::vector<ItemId>>();
}

ItemsCenter::Private::~Private() = default;

Item& ItemsCenter::Private::get(ItemId id)
{
    Item* found = byId.find(id.value);
    if (!found) throw Failure(Error("the item is no longer in the scene"));
    return *found;
}

bool ItemsCenter::Private::owns(const Item& item) const { return byId.find(item.id().value) == &item; }

void ItemsCenter::Private::own(const Item& item) const
{
    if (!owns(item)) throw Failure(Error("'" + item.name() + "' is not in this scene, or not any more"));
}

void ItemsCenter::Private::ownChangeable(const Item& item) const
{
    own(item);
    if (!item.parent()) throw Failure(Error("the top group of a scene cannot be changed; change what is in it"));
}

bool ItemsCenter::Private::isOfSymbols(const Item& item) const
{
    return !symbols->children().empty() && &topGroup(item) == symbols.get();
}

void ItemsCenter::Private::enlist(Item& subtree, bool ofSymbols)
{
    orderValid = false;
    subtree.walk([&](const Item& constant) {
        Item& item = const_cast<Item&>(constant);
        byId.insert(item.id().value, &item);
        nextId = std::max(nextId, item.id().value + 1);
        links->enlisted(item);
        if (ofSymbols) {
            ++symbolItems;
        } else if (indexed) {
            index.add(item);
        }
    });
}

void ItemsCenter::Private::delist(const Item& subtree, bool ofSymbols)
{
    orderValid = false;
    bool selectedGone = false;
    subtree.walk([&](const Item& item) {
        byId.erase(item.id().value);
        links->delisted(item);
        if (ofSymbols) {
            --symbolItems;
        } else if (indexed) {
            index.remove(const_cast<Item&>(item));
        }
        scene.dropEffectStates(item.id());
        selectedGone = selected.erase(item.id().value) > 0 || selectedGone;
    });
    if (!selectedGone) return;
    selectionStale = true;
    noteSelection();
}

void ItemsCenter::Private::insert(ItemId parent, std::size_t place, std::unique_ptr<Item> item)
{
    Item& holder = get(parent);
    enlist(*item, &topGroup(holder) == symbols.get());
    Item::Mutator::insert(holder, place, std::move(item));
}

std::unique_ptr<Item> ItemsCenter::Private::take(ItemId id)
{
    Item& item = get(id);
    Item& holder = get(item.parent()->id());
    auto taken = Item::Mutator::take(holder, item.index());
    delist(*taken, &topGroup(holder) == symbols.get());
    return taken;
}

void ItemsCenter::Private::moveItem(ItemId from, std::size_t fromIndex, ItemId to, std::size_t toIndex)
{
    auto item = Item::Mutator::take(get(from), fromIndex);
    Item::Mutator::insert(get(to), toIndex, std::move(item));
    orderValid = false;
}

void ItemsCenter::Private::setPath(Item& item, const Path& path)
{
    Item::Mutator::setPath(item, path);
    if (indexed) index.changed(item);
}

void ItemsCenter::Private::setProperty(Item& item, const std::string& property, const Value& value)
{
    const bool link = property == kLinkSymbol;
    if (link) links->delisted(item);
    Item::Mutator::setProperty(item, property, value);
    if (link) links->enlisted(item);
}

void ItemsCenter::Private::apply(Change& change)
{
    using M = Item::Mutator;
    std::visit(
        Overloaded{
            [&](ItemAdded& c) { insert(c.parent, c.index, std::move(c.detached)); },
            [&](ItemRemoved& c) { c.detached = take(c.item); },
            [&](ItemMoved& c) { moveItem(c.oldParent, c.oldIndex, c.newParent, c.newIndex); },
            [&](PathChanged& c) { setPath(get(c.item), c.after); },
            [&](PropertyChanged& c) { setProperty(get(c.item), c.property, c.after); },
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
    links->before(change);
    if (changes.size() == changes.capacity()) changes.reserve(2 * changes.size() + 1);  // what is made gets recorded
    apply(change);
    changes.push_back(std::move(change));
    noteTouched();
}

void ItemsCenter::Private::revert(Change& change)
{
    using M = Item::Mutator;
    std::visit(Overloaded{
                   [&](ItemAdded& c) { c.detached = take(c.item); },
                   [&](ItemRemoved& c) { insert(c.parent, c.index, std::move(c.detached)); },
                   [&](ItemMoved& c) { moveItem(c.newParent, c.newIndex, c.oldParent, c.oldIndex); },
                   [&](PathChanged& c) { setPath(get(c.item), c.before); },
                   [&](PropertyChanged& c) { setProperty(get(c.item), c.property, c.before); },
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
    if (changes.size() > count) noteTouched();
    while (changes.size() > count) {
        revert(changes.back());
        changes.pop_back();
    }
    links->reverted(count);
}

void ItemsCenter::Private::revertLevel(std::size_t level)
{
    const OpenLevel& at = levels[level];
    revertTo(at.changesBefore);
    nextId = at.nextIdBefore;
    restoreSelection(at.selectionBefore);
}

void ItemsCenter::Private::closeLevels(std::size_t level)
{
    levels.erase(levels.begin() + static_cast<std::ptrdiff_t>(level), levels.end());
    if (!levels.empty()) return;
    links->close();
    if (indexed) index.settle();
    tell();
}

// --- selection

const std::vector<ItemId>& ItemsCenter::Private::selection() const
{
    if (std::exchange(selectionStale, false)) {
        std::vector<ItemId> left = *ordered;
        std::erase_if(left, [&](ItemId id) { return !selected.contains(id.value); });
        ordered = std::make_shared<const std::vector<ItemId>>(std::move(left));
    }
    return *ordered;
}

void ItemsCenter::Private::setSelection(std::vector<ItemId> items)
{
    if (items == selection()) return;
    std::unordered_set<std::uint64_t> known;
    known.reserve(items.size());
    std::erase_if(items, [&](ItemId id) {
        const Item* item = byId.find(id.value);
        return !item || !item->parent() || isOfSymbols(*item) || !known.insert(id.value).second;
    });
    if (items == selection()) return;
    ordered = std::make_shared<const std::vector<ItemId>>(std::move(items));
    selected = std::move(known);
    noteSelection();
}

void ItemsCenter::Private::restoreSelection(const SelectionPtr& before)
{
    if (!selectionStale && before == ordered) return;
    setSelection(*before);
    if (*ordered == *before) ordered = before;
}

// --- events

void ItemsCenter::Private::noteTouched()
{
    touched = true;
    tellLater();
}

void ItemsCenter::Private::noteSelection()
{
    selectionTouched = true;
    tellLater();
}

// While a transaction is open, between the calls of who makes it; else at once.
void ItemsCenter::Private::tellLater()
{
    if (undoing > 0) return;  // told when all of the step is done
    if (levels.empty()) return tell();
    if (std::exchange(scheduled, true)) return;
    events.enqueue([this, gone = std::weak_ptr<int>(alive)] {
        if (gone.expired()) return;
        scheduled = false;
        tell();
    });
}

void ItemsCenter::Private::tell()
{
    const std::weak_ptr<int> gone = alive;  // a listener may close the scene
    if (std::exchange(touched, false)) events.post(&scene, SceneTouched{&scene});
    if (gone.expired()) return;
    if (std::exchange(selectionTouched, false)) events.post(&scene, SelectionChanged{&scene});
}

void ItemsCenter::Private::announce(std::shared_ptr<UndoStep> step, std::size_t firstChange, ItemsChanged::Cause cause)
{
    announcements.push_back({std::move(step), firstChange, cause});
    if (announcing) return;
    announcing = true;
    const std::weak_ptr<int> gone = alive;  // a listener may close the scene
    while (!announcements.empty()) {
        const Announcement next = std::move(announcements.front());
        announcements.pop_front();
        tell();
        if (gone.expired()) return;
        events.post(&scene, ItemsChanged{&scene, std::span(next.step->changes).subspan(next.firstChange), next.cause});
        if (gone.expired()) return;
        events.post(&scene, HistoryChanged{&scene});
        if (gone.expired()) return;
    }
    announcing = false;
}

void ItemsChanged::Burst::add(const ItemsChanged& event)
{
    scene = event.scene;
    for (const Change& change : event.changes) {
        if (const ItemId id = changedItem(change)) {
            items.push_back(id);
        } else {
            settings = true;
        }
        tree = tree || std::holds_alternative<ItemAdded>(change) || std::holds_alternative<ItemRemoved>(change) ||
               std::holds_alternative<ItemMoved>(change);
    }
    std::ranges::sort(items);
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

ItemsCenter::ItemsCenter(Scene& scene, EventsCenter& events, Catalog& catalog)
    : d_(std::make_unique<Private>(scene, events, catalog))
{
}
ItemsCenter::~ItemsCenter() = default;

Transaction ItemsCenter::begin(std::string_view label)
{
    requireThread(d_->owner, "ItemsCenter::begin", __builtin_return_address(0));
    d_->selection();  // without those that were removed
    d_->levels.push_back({++d_->serial, std::string(label), d_->changes.size(), d_->ordered, d_->nextId});
    d_->levels.back().mark = OpenMark(*this, d_->levels.back().label, [](ItemsCenter& center) {
        const std::size_t innermost = center.d_->levels.size() - 1;
        center.d_->revertLevel(innermost);
        center.d_->closeLevels(innermost);
    });
    return Transaction(*this, d_->serial);
}

bool ItemsCenter::inTransaction() const { return !d_->levels.empty(); }
std::string ItemsCenter::transactionLabel() const { return d_->levels.empty() ? "" : d_->levels.front().label; }

void ItemsCenter::abandon()
{
    if (d_->levels.empty()) return;
    d_->revertLevel(0);
    d_->closeLevels(0);
}

const Item& ItemsCenter::root() const { return *d_->root; }
const Item* ItemsCenter::find(ItemId id) const { return d_->byId.find(id.value); }
std::size_t ItemsCenter::itemCount() const { return d_->byId.size() - 2 - d_->symbolItems; }
const std::vector<ItemId>& ItemsCenter::selection() const { return d_->selection(); }
bool ItemsCenter::isSelected(ItemId id) const { return d_->selected.contains(id.value); }

void ItemsCenter::setSelection(std::vector<ItemId> items)
{
    requireThread(d_->owner, "ItemsCenter::setSelection", __builtin_return_address(0));
    d_->setSelection(std::move(items));
}

}  // namespace jet
