#include "bits.hpp"
#include "physics_ranges.hpp"
#include "scene_state.hpp"
#include "symbol_links.hpp"
#include "utf8.hpp"

#include <algorithm>
#include <functional>

namespace jet {

namespace {

[[noreturn]] void fail(std::string message) { throw Failure(Error(std::move(message))); }

bool isCommon(std::string_view property) { return property == "name" || property == "visible" || property == "locked"; }

void checkPath(const Path& path)
{
    if (!path.isFinite()) fail("a path with a coordinate that is not a number cannot be stored");
}

// What a file could not give back is not taken in.
void checkText(std::string_view property, std::string_view text)
{
    if (firstUnstorable(text) != std::string_view::npos)
        fail("the text of '" + std::string(property) + "' is not UTF-8 or has a NUL in it; it cannot be stored");
}

void checkValue(const PropertySpec* spec, std::string_view owner, std::string_view property, const Value& value)
{
    if (!spec) fail("'" + std::string(owner) + "' has no property '" + std::string(property) + "'");
    if (!value.isNone()) spec->check(value).orThrow();
    if (const auto* text = value.get<std::string>()) checkText(property, *text);
}

// All of the table's properties: given values where there are some, else the defaults.
Properties completed(const PropertyTable& table, Properties given, std::string_view owner)
{
    Properties all;
    for (const auto& [id, value] : given.entries()) {
        const PropertySpec* spec = table.find(id);
        checkValue(spec, owner, id, value);
        if (value.isNone()) continue;
        // an integer given for a real is stored as a real, so that it reads back as the same bytes
        all.set(id, spec->kind == ValueKind::Real ? Value(value.as<double>()) : value);
    }
    for (const PropertySpec& spec : table.specs())
        if (!all.find(spec.id)) all.set(spec.id, spec.fallback);
    return all;
}

Value normalized(const PropertySpec& spec, Value value)
{
    if (spec.kind == ValueKind::Real && value.get<std::int64_t>()) return Value(value.as<double>());
    return value;
}

}  // namespace

Transaction::Transaction(Transaction&& other) noexcept
    : center_(std::exchange(other.center_, nullptr)), serial_(other.serial_)
{
}

Transaction::~Transaction() { rollback(); }

namespace {

/// The place of the transaction of that serial among the open ones; none when it is no longer open.
std::optional<std::size_t> levelOf(const std::vector<OpenLevel>& levels, std::uint64_t serial)
{
    for (std::size_t i = levels.size(); i-- > 0;)
        if (levels[i].serial == serial) return i;
    return std::nullopt;
}

}  // namespace

bool Transaction::isOpen() const { return center_ && levelOf(center_->d_->levels, serial_); }

bool Transaction::isEmpty() const
{
    if (!isOpen()) return true;
    const auto& d = *center_->d_;
    return d.changes.size() == d.levels[*levelOf(d.levels, serial_)].changesBefore;
}

ItemsCenter& Transaction::open() const
{
    if (center_) requireThread(center_->d_->owner, "Transaction", nullptr);
    if (!isOpen()) fail("the transaction is no longer open");
    const auto& levels = center_->d_->levels;
    if (levels.back().serial != serial_)
        fail("finish or cancel '" + levels.back().label + "' first, which was begun inside of '" +
             levels[*levelOf(levels, serial_)].label + "'");
    return *center_;
}

std::size_t depthOf(const Item& item)
{
    std::size_t depth = 0;
    for (const Item* up = item.parent(); up; up = up->parent()) ++depth;
    return depth;
}

std::size_t heightOf(const Item& item)
{
    std::size_t height = 0;
    for (const auto& child : item.children()) height = std::max(height, heightOf(*child) + 1);
    return height;
}

namespace {

/// Takes back what was done when it fails half-way.
template <class Center, class Work>
decltype(auto) wholly(Center& d, Work work)
{
    const typename Center::Savepoint before(d);
    try {
        return work();
    } catch (...) {
        before.restore();
        throw;
    }
}

void checkPlace(const Item& parent, std::size_t height)
{
    if (!parent.isContainer()) fail("'" + parent.name() + "' is not a group or layer; items go into groups and layers");
    if (depthOf(parent) + 1 + height > kMaximumDepth)
        fail("items would be nested more than " + std::to_string(kMaximumDepth) + " deep; flatten the groups");
}

}  // namespace

const Item& Transaction::add(std::string_view type, const Item& parent, Path path, std::optional<std::size_t> index)
{
    auto& d = *open().d_;
    d.own(parent);
    const PropertyTable* table = itemTable(d.catalog, type);
    if (!table) fail(d.catalog.explain(ContributionKind::ItemType, type));
    checkPlace(parent, 0);
    checkPath(path);
    const bool isSymbol = &parent == d.symbols.get();
    if (isSymbol && (type != GroupItem::type || !path.isEmpty())) fail("a symbol is a group without a path of its own");
    auto item = std::make_unique<Item>(ItemId{d.nextId}, type);
    Item::Mutator::setName(*item, itemTypeOf(d.catalog, type)->label() + " " + std::to_string(d.nextId));
    Item::Mutator::setPath(*item, std::move(path));
    Item::Mutator::setProperties(*item, completed(*table, {}, type));
    if (isSymbol) ItemsCenter::Private::Links::nameKey(*item);
    const Item& added = *item;
    const std::size_t count = parent.children().size();
    d.make(ItemAdded{item->id(), parent.id(), std::min(index.value_or(count), count), std::move(item)});
    return added;
}

namespace {

std::unique_ptr<Item> deepCopy(const Item& source, std::uint64_t& nextId, ItemPairs& ids)
{
    const ItemId id{nextId++};
    ids.emplace(source.id().value, id);
    auto copy = Item::Mutator::copyAlone(source, id);
    for (const auto& child : source.children())
        Item::Mutator::insert(*copy, copy->children().size(), deepCopy(*child, nextId, ids));
    return copy;
}

void pairMembers(const Item& source, const Item& copy, ItemPairs& pairs)
{
    for (std::size_t i = 0; i < std::min(source.children().size(), copy.children().size()); ++i) {
        const Item& member = *source.children()[i];
        pairs.emplace(member.id().value, copy.children()[i]->id());
        if (!isInstance(member)) pairMembers(member, *copy.children()[i], pairs);
    }
}

using SymbolOf = std::function<const Item&(ItemId)>;

// What is in an instance refers to what its symbol says: to the counterpart of a member, or to that very item, even
// where it is in this instance.
void referAs(const SymbolOf& symbolOf, const Item& symbol, Item& instance)
{
    ItemPairs pairs;
    pairMembers(symbol, instance, pairs);
    const auto refer = [&](auto&& self, const Item& container, Item& copy) -> void {
        for (std::size_t i = 0; i < std::min(container.children().size(), copy.children().size()); ++i) {
            const Item& theirs = *container.children()[i];
            Item& mine = *Item::Mutator::child(copy, i);
            referAs(theirs, mine, pairs);
            isInstance(theirs) ? referAs(symbolOf, symbolOf(linkOf(theirs)), mine) : self(self, theirs, mine);
        }
    };
    refer(refer, symbol, instance);
}

// References between items of the copied subtree lead to the copies. Others stay.
void redirectCopies(const SymbolOf& symbolOf, const Item& source, Item& copy, const ItemPairs& ids)
{
    redirectOwnReferences(copy, ids, true);
    if (const ItemId link = linkOf(source)) return referAs(symbolOf, symbolOf(link), copy);
    for (std::size_t i = 0; i < copy.children().size(); ++i)
        redirectCopies(symbolOf, *source.children()[i], *Item::Mutator::child(copy, i), ids);
}

// The same of a subtree of another scene, where the numbers of others would mean other items: they lead nowhere.
void redirectForeign(const Item& source, Item& copy, const ItemPairs& ids, bool keepOthers)
{
    redirectOwnReferences(copy, ids, keepOthers);
    ItemPairs inner;
    const bool linked = isInstance(source);
    if (linked) pairMembers(source, copy, inner);
    for (std::size_t i = 0; i < copy.children().size(); ++i)
        redirectForeign(*source.children()[i], *Item::Mutator::child(copy, i), linked ? inner : ids,
                        linked || keepOthers);
}

}  // namespace

const Item& Transaction::addCopy(const Item& source, const Item& parent, std::optional<std::size_t> index)
{
    auto& d = *open().d_;
    d.own(parent);
    checkPlace(parent, heightOf(source));
    if (isSymbol(source) || source.id() == kSymbolsId || parent.id() == kSymbolsId)
        fail("a symbol is not copied; place an instance of it");
    const bool own = d.owns(source);
    return wholly(d, [&]() -> const Item& {
        own ? d.links->settle(source) : d.links->follow();
        d.own(parent);
        checkPlace(parent, heightOf(source));  // again, as all of them may have followed
        ItemPairs ids;
        auto copy = deepCopy(source, d.nextId, ids);
        own ? redirectCopies([&](ItemId id) -> const Item& { return d.get(id); }, source, *copy, ids)
            : redirectForeign(source, *copy, ids, false);
        if (!own) d.links->adopt(source, *copy);
        const Item& added = *copy;
        const std::size_t count = parent.children().size();
        d.make(ItemAdded{copy->id(), parent.id(), std::min(index.value_or(count), count), std::move(copy)});
        return added;
    });
}

void Transaction::remove(const Item& item)
{
    auto& d = *open().d_;
    d.own(item);
    if (!item.parent()) fail("the top group of a scene cannot be removed");
    wholly(d, [&] {
        d.links->settle(item);
        d.make(ItemRemoved{item.id(), item.parent()->id(), item.index(), nullptr});
    });
}

void Transaction::move(const Item& item, const Item& newParent, std::size_t index)
{
    auto& d = *open().d_;
    d.own(item), d.own(newParent);
    if (!item.parent()) fail("the top group of a scene cannot be moved");
    if (&item == &newParent || item.isAncestorOf(newParent)) fail("'" + item.name() + "' cannot be moved into itself");
    checkPlace(newParent, heightOf(item));
    if (isSymbol(item) != (newParent.id() == kSymbolsId)) fail("a symbol stays among the symbols, and nothing else");
    const std::size_t room = newParent.children().size() - (item.parent() == &newParent ? 1 : 0);
    const ItemMoved change{item.id(), item.parent()->id(), newParent.id(), item.index(), std::min(index, room)};
    if (change.oldParent == change.newParent && change.oldIndex == change.newIndex) return;
    d.make(change);
}

void Transaction::set(const Item& item, std::string_view property, Value value)
{
    auto& d = *open().d_;
    d.ownChangeable(item);
    if (property == "name") {
        if (!value.get<std::string>()) fail("a name is a text");
        checkText(property, *value.get<std::string>());
    } else if (isCommon(property)) {
        if (!value.get<bool>()) fail("'" + std::string(property) + "' is true or false");
    } else {
        const PropertyTable* table = itemTable(d.catalog, item.type());
        if (!table) fail(d.catalog.explain(ContributionKind::ItemType, item.type()));
        const PropertySpec* spec = table->find(property);
        if (!spec && linkTable().find(property)) return wholly(d, [&] { d.links->set(item, property, value); });
        checkValue(spec, item.type(), property, value);
        value = normalized(*spec, std::move(value));
    }
    Value before = item.property(property).value_or(Value());
    if (before == value) return;
    d.make(PropertyChanged{item.id(), std::string(property), std::move(before), std::move(value)});
}

void Transaction::setPath(const Item& item, Path path)
{
    auto& d = *open().d_;
    d.ownChangeable(item);
    checkPath(path);
    if (sameBits(item.path(), path)) return;
    d.make(PathChanged{item.id(), item.path(), std::move(path)});
}

namespace {

template <class Center>
void transformTree(Transaction& edit, Center& d, const Item& item, const Affine& m)
{
    if (!item.path().isEmpty()) edit.setPath(item, item.path().transformed(m));
    if (isInstance(item)) return d.links->place(item, m * placementOf(item));
    for (const auto& child : item.children()) transformTree(edit, d, *child, m);
}

}  // namespace

void Transaction::transform(const Item& item, const Affine& m)
{
    auto& d = *open().d_;
    d.own(item);
    if (m.isIdentity()) return;
    const std::size_t before = d.changes.size();
    try {
        d.links->settle(item);  // not while its members are walked over
        transformTree(*this, d, item, m);
    } catch (...) {
        d.revertTo(before);
        throw;
    }
}

void Transaction::transform(const Item& item, const Affine& m, std::span<const std::size_t> segments)
{
    open().d_->own(item);
    Path path = item.path();
    for (const std::size_t index : segments)
        if (index >= path.segmentCount()) fail("the path has no segment " + std::to_string(index));
    path.transform(m, segments);
    setPath(item, std::move(path));
}

namespace {

template <class Center>
void changeType(Center& d, const Item& item, std::string_view type, const PropertyTable& table)
{
    d.links->settle(item);
    if (item.type() == type) return;
    if (!item.children().empty() && type != GroupItem::type && type != LayerItem::type)
        fail("'" + item.name() + "' holds other items, so it must stay a group or layer");
    std::vector<PropertyChanged> dropped;
    for (const auto& [id, value] : item.properties().entries())
        if (!table.find(id)) dropped.push_back({item.id(), id, value, Value()});
    for (PropertyChanged& change : dropped) d.make(std::move(change));
    d.make(TypeChanged{item.id(), item.type(), std::string(type)});
    for (const PropertySpec& spec : table.specs())
        if (!item.properties().find(spec.id)) d.make(PropertyChanged{item.id(), spec.id, Value(), spec.fallback});
}

}  // namespace

void Transaction::setType(const Item& item, std::string_view type)
{
    auto& d = *open().d_;
    const PropertyTable* table = itemTable(d.catalog, type);
    d.ownChangeable(item);
    if (!table) fail(d.catalog.explain(ContributionKind::ItemType, type));
    if (item.type() == type) return;
    wholly(d, [&] { changeType(d, item, type, *table); });
}

std::size_t Transaction::addEffect(const Item& item, std::string_view effect, Properties properties)
{
    auto& d = *open().d_;
    d.ownChangeable(item);
    const Effect* found = d.catalog.effect(effect);
    if (!found) fail(d.catalog.explain(ContributionKind::Effect, effect));
    if (const std::string reason = found->rejects(item); !reason.empty()) fail(reason);
    const std::size_t index = item.effects().size();
    const ItemsCenter::Private::Savepoint before(d);
    d.make(EffectAdded{
        item.id(), index,
        EffectInstance{std::string(effect), completed(found->properties(), std::move(properties), effect), true}});
    try {
        found->applied(*this, item);
    } catch (...) {
        if (isOpen()) before.restore();
        throw;
    }
    return index;
}

namespace {

const EffectInstance& effectAt(const Item& item, std::size_t index)
{
    if (index >= item.effects().size()) fail("'" + item.name() + "' has no effect number " + std::to_string(index));
    return item.effects()[index];
}

}  // namespace

void Transaction::removeEffect(const Item& item, std::size_t index)
{
    auto& d = *open().d_;
    d.ownChangeable(item);
    d.make(EffectRemoved{item.id(), index, effectAt(item, index)});
}

void Transaction::moveEffect(const Item& item, std::size_t from, std::size_t to)
{
    auto& d = *open().d_;
    d.ownChangeable(item);
    effectAt(item, from), effectAt(item, to);
    if (from != to) d.make(EffectMoved{item.id(), from, to});
}

void Transaction::setEffect(const Item& item, std::size_t index, std::string_view property, Value value)
{
    auto& d = *open().d_;
    d.ownChangeable(item);
    const EffectInstance& effect = effectAt(item, index);
    Value before;
    if (property == "visible") {
        if (!value.get<bool>()) fail("'visible' is true or false");
        before = effect.visible;
    } else {
        const Effect* found = d.catalog.effect(effect.type);
        if (!found) fail(d.catalog.explain(ContributionKind::Effect, effect.type));
        const PropertySpec* spec = found->properties().find(property);
        checkValue(spec, effect.type, property, value);
        value = normalized(*spec, std::move(value));
        if (const Value* stored = effect.properties.find(property)) before = *stored;
    }
    if (before == value) return;
    d.make(EffectPropertyChanged{item.id(), index, std::string(property), std::move(before), std::move(value)});
}

void Transaction::setScene(std::string_view property, Value value)
{
    auto& d = *open().d_;
    const PropertySpec* spec = Scene::settingsTable().find(property);
    checkValue(spec, "scene", property, value);
    value = normalized(*spec, std::move(value));
    const Value* stored = d.scene.settings().find(property);
    Value before = stored ? *stored : Value();
    if (before == value) return;
    d.make(ScenePropertyChanged{std::string(property), std::move(before), std::move(value)});
}

void Transaction::setMaterials(MaterialTable materials)
{
    auto& d = *open().d_;
    for (const std::string& name : materials.names()) checkText("material", name);
    checkMaterials(materials).orThrow();
    if (d.scene.materials() == materials) return;
    d.make(MaterialsChanged{d.scene.materials(), std::move(materials)});
}

void Transaction::select(const Item& item) { setSelection({item.id()}); }
void Transaction::setSelection(std::vector<ItemId> items) { open().d_->setSelection(std::move(items)); }

void Transaction::commit(std::string_view mergeKey)
{
    ItemsCenter& center = open();
    auto& d = *center.d_;
    if (d.levels.size() > 1) {  // what it did is now the outer one's
        d.levels.pop_back();
        center_ = nullptr;
        return;
    }
    d.links->finish();
    d.links->close();
    OpenLevel& level = d.levels.front();
    if (d.changes.empty()) {
        center_ = nullptr;
        return d.closeLevels(0);
    }
    d.selection();  // without those that were removed
    auto& history = *d.scene.undoRedo().d_;
    const auto [step, first] =
        history.push(UndoStep{std::move(level.label), std::string(mergeKey), std::exchange(d.changes, {}),
                              std::move(level.selectionBefore), d.ordered});
    center_ = nullptr;
    d.levels.clear();
    if (d.indexed) d.index.settle();
    d.announce(step, first, ItemsChanged::Cause::Commit);
}

void Transaction::rollback()
{
    if (isOpen()) {
        auto& d = *center_->d_;
        const std::size_t level = *levelOf(d.levels, serial_);
        d.revertLevel(level);
        d.closeLevels(level);
    }
    center_ = nullptr;
}

void Transaction::restart()
{
    auto& d = *open().d_;
    d.revertLevel(d.levels.size() - 1);
}

}  // namespace jet
