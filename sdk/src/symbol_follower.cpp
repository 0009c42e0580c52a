#include "symbol_follower.hpp"

#include "bits.hpp"

#include <algorithm>
#include <span>

namespace jet {

namespace {

const Affine kUnplaced;

bool isLinkProperty(std::string_view property)
{
    return property == kLinkSymbol || property == kLinkX || property == kLinkY || property == kLinkOffset;
}

bool hasReferences(const Item& item)
{
    const auto inAny = [](const Properties& properties) {
        return std::ranges::any_of(properties.entries(),
                                   [](const auto& entry) { return entry.second.template get<ItemId>() != nullptr; });
    };
    return inAny(item.properties()) ||
           std::ranges::any_of(item.effects(), [&](const EffectInstance& effect) { return inAny(effect.properties); });
}

/// Bit by bit, as the properties are compared.
bool isAt(const Item& instance, const Affine& placement)
{
    const Affine at = placementOf(instance);
    return sameBits(Vec2(at.matrix().col(0)), Vec2(placement.matrix().col(0))) &&
           sameBits(Vec2(at.matrix().col(1)), Vec2(placement.matrix().col(1))) &&
           sameBits(Vec2(at.matrix().col(2)), Vec2(placement.matrix().col(2)));
}

/// None where the instance is flattened to a line: then points of it cannot be taken into the symbol.
std::optional<Affine> inverseOf(const Affine& placement)
{
    if (placement.isIdentity()) return placement;
    if (!placement.isInvertible()) return std::nullopt;
    const Affine inverse(placement.inverse(Eigen::Affine));
    if (!inverse.matrix().allFinite()) return std::nullopt;
    return inverse;
}

}  // namespace

void ItemsCenter::Private::Links::Follower::run()
{
    collectFields();
    // Inner symbols first: instances of them are complete when those around them are placed anew.
    std::vector<const Base*> left;
    for (const Base& base : now_.bases)
        if (d_.byId.find(base.symbol.value)) left.push_back(&base);
    while (!left.empty()) {
        const auto next = std::ranges::find_if(left, [&](const Base* one) {
            return std::ranges::none_of(left, [&](const Base* other) {
                return other != one && links_.reaches(one->symbol, other->symbol, now_.pending);
            });
        });
        if (next == left.end()) throw Failure(Error("the changes would make symbols parts of each other"));
        const Base& base = **next;
        left.erase(next);
        follow(base);
    }
}

/// Whose members a recorded change touched, in whatever way it came to be.
std::set<ItemId> ItemsCenter::Private::Links::Follower::concerned(std::size_t count) const
{
    std::set<ItemId> symbols;
    const auto note = [&](ItemId id, bool asContainer) {
        const Item* item = d_.byId.find(id.value);
        if (!item) return;
        if (const ItemId link = linkOf(*item)) symbols.insert(link);
        const Item* holder = asContainer ? holderOfMembers(*item) : holderOf(*item);
        if (holder) symbols.insert(isSymbol(*holder) ? holder->id() : linkOf(*holder));
    };
    for (const Change& change : std::span(d_.changes).subspan(std::min(count, d_.changes.size()))) {
        note(changedItem(change), false);
        if (const auto* added = std::get_if<ItemAdded>(&change)) note(added->parent, true);
        if (const auto* removed = std::get_if<ItemRemoved>(&change)) note(removed->parent, true);
        if (const auto* moved = std::get_if<ItemMoved>(&change))
            note(moved->oldParent, true), note(moved->newParent, true);
    }
    return symbols;
}

/// In any order: what is made anew is an instance's content, which no symbol counts among its members.
void ItemsCenter::Private::Links::Follower::mend(std::size_t count)
{
    for (const ItemId symbol : concerned(count)) mendInstancesOf(symbol);
}

/// The last word is the symbol's: what steps that crossed each other left otherwise is made anew.
void ItemsCenter::Private::Links::Follower::mendInstancesOf(ItemId symbol)
{
    const Item* own = d_.byId.find(symbol.value);
    if (!own) return;
    for (const std::uint64_t id : std::set(links_.instancesOf(symbol))) {
        const Item* instance = d_.byId.find(id);
        if (instance && !isExact(*own, *instance)) links_.replaceContent(*instance);
    }
}

/// From the transaction's own record: what two instances changed of the same item is joined, not overwritten.
void ItemsCenter::Private::Links::Follower::collectFields()
{
    std::size_t first = d_.changes.size();
    for (const Base& base : now_.bases) first = std::min(first, base.firstChange);
    for (std::size_t i = first; i < d_.changes.size(); ++i) {
        const Change& change = d_.changes[i];
        const ItemId id = changedItem(change);
        if (!id) continue;
        if (std::holds_alternative<PathChanged>(change)) {
            fields_[id.value].path = true;
        } else if (const auto* property = std::get_if<PropertyChanged>(&change)) {
            isLinkProperty(property->property) ? void(fields_[id.value].link = true)
                                               : void(fields_[id.value].properties.insert(property->property));
        } else if (std::holds_alternative<TypeChanged>(change)) {
            fields_[id.value].type = true;
        } else if (!std::holds_alternative<ItemAdded>(change) && !std::holds_alternative<ItemRemoved>(change) &&
                   !std::holds_alternative<ItemMoved>(change)) {
            fields_[id.value].effects = true;
        }
    }
}

void ItemsCenter::Private::Links::Follower::follow(const Base& base)
{
    const Item& symbol = d_.get(base.symbol);
    std::vector<Receiver> all = receivers(base);
    Difference difference;
    for (const Pending& pending : now_.pending) {
        if (pending.symbol != base.symbol) continue;
        if (pending.holder == base.symbol) {
            const Difference own = directly(symbol);
            difference.structure = true;
            difference.items.insert(own.items.begin(), own.items.end());
            continue;
        }
        const auto receiver = std::ranges::find(all, pending.holder, &Receiver::instance);
        if (receiver == all.end()) continue;  // detached or linked to another symbol since
        ItemPairs toSymbol = pending.toSymbol;
        takeIn(pending, toSymbol, difference);
        receiver->pairs.clear();
        for (const auto& [mine, theirs] : toSymbol)
            if (d_.byId.find(mine)) receiver->pairs.emplace(theirs.value, ItemId{mine});
    }
    if (!difference.structure && difference.items.empty()) return;
    // A reference leads to the counterpart as long as there is one.
    if (difference.structure)
        walkMembers(symbol, [&](const Item& item) {
            if (hasReferences(item)) difference.items.insert(item.id().value);
        });
    for (Receiver& receiver : all) giveOut(symbol, receiver, difference);
}

std::vector<ItemsCenter::Private::Links::Follower::Receiver>
ItemsCenter::Private::Links::Follower::receivers(const Base& base) const
{
    std::vector<Receiver> all;
    for (const std::uint64_t id : links_.instancesOf(base.symbol)) {
        Receiver& one = all.emplace_back(Receiver{ItemId{id}, {}});
        const auto pairs = [&](ItemId mine, ItemId theirs) { one.pairs.emplace(theirs.value, mine); };
        const bool changed = std::ranges::find(now_.pending, one.instance, &Pending::holder) != now_.pending.end();
        if (!changed) pairMembers(d_.get(one.instance), base.symbol, base.outline, pairs);
    }
    return all;
}

ItemsCenter::Private::Links::Follower::Difference
ItemsCenter::Private::Links::Follower::directly(const Item& symbol) const
{
    Difference difference;
    walkMembers(symbol, [&](const Item& item) {
        if (fields_.contains(item.id().value)) difference.items.insert(item.id().value);
    });
    return difference;
}

// --- from an instance into its symbol

void ItemsCenter::Private::Links::Follower::takeIn(const Pending& pending, ItemPairs& toSymbol, Difference& difference)
{
    const Item& holder = d_.get(pending.holder);
    fresh_.clear();
    takeLinks(holder, toSymbol, difference, false);
    takeContainers(holder, toSymbol, difference);
    takeStructure(pending, holder, d_.get(pending.symbol), toSymbol, difference);
    takeLinks(holder, toSymbol, difference, true);
    takeFields(holder, toSymbol, difference);
}

/// Before the members, as an instance that was detached has some from now on; of what is linked by now after them, as
/// it has none any more, and some may have moved elsewhere.
void ItemsCenter::Private::Links::Follower::takeLinks(const Item& holder, const ItemPairs& toSymbol,
                                                      Difference& difference, bool ofNewInstances)
{
    const std::optional<Affine> inverse = inverseOf(placementOf(holder));
    const Item& symbol = d_.get(linkOf(holder));
    for (const auto& [mine, theirs] : toSymbol) {
        const auto changed = fields_.find(mine);
        if (changed == fields_.end() || !changed->second.link) continue;
        const Item* item = d_.byId.find(mine);
        if (!item || holderOf(*item) != &holder) continue;
        const Item* counterpart = counterpartOf(*item, toSymbol, symbol);
        if (!counterpart) continue;
        if (ofNewInstances != (isInstance(*item) && !isInstance(*counterpart))) continue;
        const bool moved = linkOf(*item) == linkOf(*counterpart);
        if (moved && !inverse) continue;
        difference.items.insert(theirs.value);
        difference.structure = difference.structure || !moved;
        syncLink(*item, *counterpart, inverse.value_or(kUnplaced));
    }
}

/// What holds items from now on has to be able to before they come. A link that came from elsewhere is stronger.
void ItemsCenter::Private::Links::Follower::takeContainers(const Item& holder, const ItemPairs& toSymbol,
                                                           Difference& difference)
{
    const Item& symbol = d_.get(linkOf(holder));
    walkMembers(holder, [&](const Item& mine) {
        const auto changed = fields_.find(mine.id().value);
        if (changed == fields_.end() || !changed->second.type || !mine.isContainer()) return;
        const Item* theirs = counterpartOf(mine, toSymbol, symbol);
        if (!theirs || isInstance(*theirs)) return;
        difference.items.insert(theirs->id().value);
        syncType(mine, *theirs);
    });
}

void ItemsCenter::Private::Links::Follower::takeStructure(const Pending& pending, const Item& holder,
                                                          const Item& symbol, ItemPairs& toSymbol,
                                                          Difference& difference)
{
    const Affine inverse = inverseOf(placementOf(holder)).value_or(kUnplaced);
    Alignment alignment{toSymbol, inverse};
    for (const auto& [container, members] : pending.outline)
        for (const ItemId id : members) {
            const Item* item = d_.byId.find(id.value);
            const bool stayed = item && item->parent()->id().value == container && toSymbol.contains(id.value);
            if (stayed && !counterpartOf(*item, toSymbol, symbol)) alignment.gone.insert(id.value);
        }
    const auto alignChanged = [&](const Item& container, const Item* counterpart) {
        if (!counterpart || isInstance(*counterpart)) return;  // another instance may have removed or linked it
        const auto before = pending.outline.find(container.id().value);
        const auto isSame = [](const auto& child, ItemId id) { return child->id() == id; };
        const bool asBefore =
            before != pending.outline.end() && std::ranges::equal(container.children(), before->second, isSame);
        if (asBefore && !fresh_.contains(counterpart->id().value)) return;
        if (!container.children().empty()) syncType(container, *counterpart);  // or made of it what holds no items
        difference.items.insert(counterpart->id().value);
        difference.structure = true;
        alignMembers(container, *counterpart, alignment);
    };
    alignChanged(holder, &symbol);
    walkMembers(holder, [&](const Item& item) {
        if (item.isContainer() && !isInstance(item)) alignChanged(item, counterpartOf(item, toSymbol, symbol));
    });
    for (const auto& [mine, theirs] : pending.toSymbol) {
        const Item* item = d_.byId.find(mine);
        if (item && holderOf(*item) == &holder) continue;
        toSymbol.erase(mine);
        const Item* gone = d_.byId.find(theirs.value);
        if (!gone || holderOf(*gone) != &symbol) continue;
        difference.structure = true;
        d_.make(ItemRemoved{gone->id(), gone->parent()->id(), gone->index(), nullptr});
    }
    finish(alignment, toSymbol);
    for (const auto& [mine, theirs] : alignment.made) difference.items.insert(theirs.value);
}

void ItemsCenter::Private::Links::Follower::takeFields(const Item& holder, const ItemPairs& toSymbol,
                                                       Difference& difference)
{
    const Affine placement = placementOf(holder);
    const std::optional<Affine> inverse = inverseOf(placement);
    const Item& symbol = d_.get(linkOf(holder));
    walkMembers(holder, [&](const Item& mine) {
        const auto changed = fields_.find(mine.id().value);
        const Item* counterpart = counterpartOf(mine, toSymbol, symbol);
        if (changed == fields_.end() || !counterpart) return;
        const Item& theirs = *counterpart;
        const ChangedFields& fields = changed->second;
        difference.items.insert(theirs.id().value);
        const bool fits = mine.isContainer() ? isInstance(mine) || !isInstance(theirs) : theirs.children().empty();
        if (fields.type && fits) syncType(mine, theirs), syncProperties(mine, theirs, toSymbol);
        for (const std::string& property : fields.properties) {
            const bool common = property == "name" || property == "visible" || property == "locked";
            if (common || mine.type() == theirs.type()) syncProperty(mine, theirs, property, toSymbol);
        }
        if (fields.effects) syncEffects(mine, theirs, toSymbol);
        // What only moved along with its instance has the symbol's points already, and is not to pass through rounding.
        if (fields.path && inverse && !sameBits(mine.path(), placedPath(theirs.path(), placement)))
            syncPath(theirs, placedPath(mine.path(), *inverse));
    });
}

// --- from a symbol into its instances

void ItemsCenter::Private::Links::Follower::giveOut(const Item& symbol, Receiver& receiver,
                                                    const Difference& difference)
{
    const Item& instance = d_.get(receiver.instance);
    const Affine placement = placementOf(instance);
    std::erase_if(receiver.pairs, [&](const auto& pair) {
        const Item* theirs = d_.byId.find(pair.first);
        return !theirs || holderOf(*theirs) != &symbol;
    });
    const auto forEach = [&](auto&& visit) {
        for (const std::uint64_t id : difference.items) {
            const Item* theirs = d_.byId.find(id);
            const auto found = receiver.pairs.find(id);
            const Item* mine = found == receiver.pairs.end() ? nullptr : d_.byId.find(found->second.value);
            if (theirs && mine) visit(*theirs, *mine);
        }
    };
    forEach([&](const Item& theirs, const Item& mine) {  // as in takeIn(): what comes before the members, and after
        if (isInstance(theirs) && !isInstance(mine)) return;
        syncLink(theirs, mine, placement);
        if (theirs.isContainer()) syncType(theirs, mine);
    });
    if (difference.structure) {
        Alignment alignment{receiver.pairs, placement};
        alignAll(symbol, instance, alignment);
        removeOthers(instance, receiver.pairs);
        finish(alignment, receiver.pairs);
    }
    forEach([&](const Item& theirs, const Item& mine) { syncFields(theirs, mine, receiver.pairs, placement); });
}

void ItemsCenter::Private::Links::Follower::fill(Links& links, const Item& group, const Item& symbol)
{
    const Followed nothing;
    Follower follower(links, nothing);
    ItemPairs pairs;
    Alignment alignment{pairs, kUnplaced};
    follower.alignAll(group, symbol, alignment);
    follower.finish(alignment, pairs);
    follower.mendInstancesOf(symbol.id());  // others that showed that it was empty
}

// --- trees

void ItemsCenter::Private::Links::Follower::alignAll(const Item& from, const Item& to, Alignment& alignment)
{
    alignMembers(from, to, alignment);
    for (const auto& member : from.children()) {
        if (!member->isContainer() || isInstance(*member)) continue;
        const Item* counterpart = counterpartOf(*member, alignment.pairs, *holderOfMembers(to));
        if (counterpart && !isInstance(*counterpart)) alignAll(*member, *counterpart, alignment);
    }
}

/// Null when there is none, or not any more: it may have been removed, or moved elsewhere.
const Item* ItemsCenter::Private::Links::Follower::counterpartOf(const Item& item, const ItemPairs& pairs,
                                                                 const Item& holder) const
{
    const auto found = pairs.find(item.id().value);
    const Item* counterpart = found == pairs.end() ? nullptr : d_.byId.find(found->second.value);
    return counterpart && holderOf(*counterpart) == &holder ? counterpart : nullptr;
}

/// Gives `to` the counterparts of the members of `from`, in the same order. Parents come before what is in them, so
/// that nothing is moved into itself.
void ItemsCenter::Private::Links::Follower::alignMembers(const Item& from, const Item& to, Alignment& alignment)
{
    std::size_t index = 0;
    for (const auto& member : from.children()) {
        const Item* counterpart = counterpartOf(*member, alignment.pairs, *holderOfMembers(to));
        if (!counterpart) {
            if (alignment.gone.contains(member->id().value) && !fresh_.contains(to.id().value)) continue;
            counterpart = &make(*member, to, index, alignment);
        } else if (counterpart->isAncestorOf(to)) {
            continue;  // two instances moved each into the other: the first one did
        } else if (counterpart->parent() != &to || counterpart->index() != index) {
            const std::size_t before = counterpart->index();
            const bool ahead = counterpart->parent() == &to && before < index;
            checkDepth(to, *counterpart);
            d_.make(
                ItemMoved{counterpart->id(), counterpart->parent()->id(), to.id(), before, index - (ahead ? 1 : 0)});
        }
        index = counterpart->index() + 1;
    }
}

const Item& ItemsCenter::Private::Links::Follower::make(const Item& from, const Item& parent, std::size_t index,
                                                        Alignment& alignment)
{
    auto item = content_.copy(from, alignment.placement, alignment.pairs, true);
    checkDepth(parent, *item);
    alignment.pairs[from.id().value] = item->id();
    fresh_.insert(item->id().value);
    const Item& made = *item;
    alignment.made.emplace_back(from.id(), made.id());
    d_.make(ItemAdded{made.id(), parent.id(), index, std::move(item)});
    return made;
}

/// References between the items that were made: known when all are.
void ItemsCenter::Private::Links::Follower::finish(const Alignment& alignment, const ItemPairs& pairs)
{
    for (const auto& [from, to] : alignment.made) {
        syncProperties(d_.get(from), d_.get(to), pairs);
        syncEffects(d_.get(from), d_.get(to), pairs);
    }
}

void ItemsCenter::Private::Links::Follower::removeOthers(const Item& holder, const ItemPairs& pairs)
{
    std::unordered_set<std::uint64_t> kept;
    for (const auto& pair : pairs) kept.insert(pair.second.value);
    std::vector<ItemId> others;
    walkMembers(holder, [&](const Item& item) {
        if (!kept.contains(item.id().value)) others.push_back(item.id());
    });
    for (const ItemId id : others)
        if (const Item* item = d_.byId.find(id.value))
            d_.make(ItemRemoved{id, item->parent()->id(), item->index(), nullptr});
}

// --- what instances have to be

namespace {

bool pairStructure(const Item& symbol, const Item& instance, ItemPairs& pairs)
{
    if (symbol.children().size() != instance.children().size()) return false;
    for (std::size_t i = 0; i < symbol.children().size(); ++i) {
        const Item& theirs = *symbol.children()[i];
        const Item& mine = *instance.children()[i];
        pairs.emplace(theirs.id().value, mine.id());
        if (linkOf(theirs) != linkOf(mine) || theirs.type() != mine.type()) return false;
        if (!isInstance(theirs) && !pairStructure(theirs, mine, pairs)) return false;
    }
    return true;
}

bool sameProperties(const Properties& theirs, const Properties& mine, const ItemPairs& pairs)
{
    return std::ranges::equal(theirs.entries(), mine.entries(), [&](const auto& a, const auto& b) {
        return a.first == b.first && (isLinkProperty(a.first) || withCounterparts(a.second, pairs) == b.second);
    });
}

bool sameEffects(const Item& theirs, const Item& mine, const ItemPairs& pairs)
{
    return std::ranges::equal(theirs.effects(), mine.effects(), [&](const EffectInstance& a, const EffectInstance& b) {
        return a.type == b.type && a.visible == b.visible && sameProperties(a.properties, b.properties, pairs);
    });
}

bool sameItem(const Item& theirs, const Item& mine, const ItemPairs& pairs, const Affine& placement)
{
    return theirs.name() == mine.name() && theirs.visible() == mine.visible() && theirs.locked() == mine.locked() &&
           sameBits(placedPath(theirs.path(), placement), mine.path()) &&
           (!isInstance(theirs) || isAt(mine, innerPlacement(placement, theirs))) &&
           sameProperties(theirs.properties(), mine.properties(), pairs) && sameEffects(theirs, mine, pairs);
}

}  // namespace

bool ItemsCenter::Private::Links::Follower::isExact(const Item& symbol, const Item& instance) const
{
    ItemPairs pairs;
    if (!pairStructure(symbol, instance, pairs)) return false;
    const Affine placement = placementOf(instance);
    bool exact = true;
    walkMembers(symbol, [&](const Item& theirs) {
        const auto mine = pairs.find(theirs.id().value);
        exact = exact && sameItem(theirs, d_.get(mine->second), pairs, placement);
    });
    return exact;
}

// --- items

void ItemsCenter::Private::Links::Follower::syncFields(const Item& from, const Item& to, const ItemPairs& pairs,
                                                       const Affine& placement)
{
    syncType(from, to);
    for (const char* common : {"name", "visible", "locked"}) syncProperty(from, to, common, pairs);
    syncProperties(from, to, pairs);
    syncEffects(from, to, pairs);
    syncLink(from, to, placement);
    syncPath(to, placedPath(from.path(), placement));
}

/// With the properties of the new type and no others: where two instances disagree, nothing else may set them.
void ItemsCenter::Private::Links::Follower::syncType(const Item& from, const Item& to)
{
    if (from.type() == to.type()) return;
    const PropertyTable* table = itemTable(d_.catalog, from.type());
    std::vector<PropertyChanged> dropped;
    for (const auto& [id, value] : to.properties().entries())
        if (table && !table->find(id)) dropped.push_back({to.id(), id, value, Value()});
    for (PropertyChanged& change : dropped) d_.make(std::move(change));
    d_.make(TypeChanged{to.id(), to.type(), from.type()});
    if (!table) return;
    for (const PropertySpec& spec : table->specs())
        if (!to.properties().find(spec.id)) d_.make(PropertyChanged{to.id(), spec.id, Value(), spec.fallback});
}

void ItemsCenter::Private::Links::Follower::syncProperties(const Item& from, const Item& to, const ItemPairs& pairs)
{
    std::set<std::string> all;
    for (const Item* item : {&from, &to})
        for (const auto& [id, value] : item->properties().entries()) all.insert(id);
    for (const std::string& id : all)
        if (!isLinkProperty(id)) syncProperty(from, to, id, pairs);
}

void ItemsCenter::Private::Links::Follower::syncProperty(const Item& from, const Item& to, const std::string& property,
                                                         const ItemPairs& pairs)
{
    Value after = withCounterparts(from.property(property).value_or(Value()), pairs);
    Value before = to.property(property).value_or(Value());
    if (!(before == after)) d_.make(PropertyChanged{to.id(), property, std::move(before), std::move(after)});
}

void ItemsCenter::Private::Links::Follower::syncPath(const Item& to, Path path)
{
    if (!path.isFinite()) throw Failure(Error("'" + to.name() + "' would lie beyond all numbers in an instance"));
    if (!sameBits(to.path(), path)) d_.make(PathChanged{to.id(), to.path(), std::move(path)});
}

void ItemsCenter::Private::Links::Follower::syncEffects(const Item& from, const Item& to, const ItemPairs& pairs)
{
    std::vector<EffectInstance> wanted(from.effects().begin(), from.effects().end());
    for (EffectInstance& effect : wanted) {
        const Properties before = effect.properties;
        for (const auto& [id, value] : before.entries())
            if (value.get<ItemId>()) effect.properties.set(id, withCounterparts(value, pairs));
    }
    std::size_t same = 0;
    while (same < wanted.size() && same < to.effects().size() && wanted[same] == to.effects()[same]) ++same;
    while (to.effects().size() > same) {
        const std::size_t last = to.effects().size() - 1;
        d_.make(EffectRemoved{to.id(), last, to.effects()[last]});
    }
    for (std::size_t i = same; i < wanted.size(); ++i) d_.make(EffectAdded{to.id(), i, std::move(wanted[i])});
}

void ItemsCenter::Private::Links::Follower::syncLink(const Item& from, const Item& to, const Affine& placement)
{
    const ItemId wanted = linkOf(from);
    const auto setProperty = [&](std::string_view id, Value after) {
        const Value* stored = to.properties().find(id);
        Value before = stored ? *stored : Value();
        if (!(before == after)) d_.make(PropertyChanged{to.id(), std::string(id), std::move(before), std::move(after)});
    };
    if (!wanted) {
        if (!isInstance(to)) return;
        while (!to.children().empty()) {  // those of the other symbol; its own come as new ones
            const Item& last = *to.children().back();
            d_.make(ItemRemoved{last.id(), to.id(), last.index(), nullptr});
        }
        for (const std::string_view id : {kLinkOffset, kLinkX, kLinkY, kLinkSymbol}) setProperty(id, Value());
        fresh_.insert(to.id().value);
        return;
    }
    syncType(from, to);  // only a group is linked
    const Affine place = innerPlacement(placement, from);
    const bool same = linkOf(to) == wanted;
    if (same && isAt(to, place)) return;
    if (same) {
        links_.setPlacementProperties(to, place);
        return links_.moveContent(d_.get(wanted), to, place);
    }
    links_.setPlacementProperties(to, place);
    setProperty(kLinkSymbol, wanted);
    links_.replaceContent(to);
}

}  // namespace jet
