// Links during a transaction: what is refused, what is remembered, and the changes of a link itself. How instances
// follow: symbol_follower.cpp.
#include "symbol_links.hpp"

#include "symbol_follower.hpp"

#include <mutex>
#include <random>

namespace jet {

namespace {

[[noreturn]] void fail(std::string message) { throw Failure(Error(std::move(message))); }

ItemOutline outlineOf(const Item& holder)
{
    ItemOutline outline;
    const auto note = [&](const Item& container) {
        std::vector<ItemId>& members = outline[container.id().value];
        for (const auto& child : container.children()) members.push_back(child->id());
    };
    note(holder);
    walkMembers(holder, [&](const Item& item) {
        if (item.isContainer() && !isInstance(item)) note(item);
    });
    return outline;
}

}  // namespace

// --- whose tree an item is in

namespace {

struct Tree {
    const void* owner;
    std::function<const std::set<std::uint64_t>&(ItemId)> instances;
};

// By the top group; scenes are made by other threads, too (a copy that is played).
std::mutex topsMutex;
std::unordered_map<const Item*, Tree>& tops()
{
    static std::unordered_map<const Item*, Tree> all;
    return all;
}

std::optional<Tree> treeOf(const Item& item)
{
    const std::scoped_lock lock(topsMutex);
    const auto found = tops().find(&topGroup(item));
    return found == tops().end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

const std::set<std::uint64_t>& linkedTo(const Item& symbol)
{
    static const std::set<std::uint64_t> none;
    const auto tree = treeOf(symbol);
    return tree ? tree->instances(symbol.id()) : none;
}

ItemsCenter::Private::Links::Links(Private& d) : d_(d)
{
    const Tree tree{&d, [this](ItemId symbol) -> const std::set<std::uint64_t>& { return instancesOf(symbol); }};
    const std::scoped_lock lock(topsMutex);
    for (const Item* top : {d.root.get(), d.symbols.get()}) tops().insert_or_assign(top, tree);
}

ItemsCenter::Private::Links::~Links()
{
    const std::scoped_lock lock(topsMutex);
    for (const Item* top : {d_.root.get(), d_.symbols.get()}) tops().erase(top);
}

// --- which instances there are

void ItemsCenter::Private::Links::enlisted(const Item& item)
{
    if (const ItemId symbol = linkOf(item)) instances_[symbol.value].insert(item.id().value);
}

void ItemsCenter::Private::Links::delisted(const Item& item)
{
    if (const ItemId symbol = linkOf(item)) instances_[symbol.value].erase(item.id().value);
}

const std::set<std::uint64_t>& ItemsCenter::Private::Links::instancesOf(ItemId symbol) const
{
    static const std::set<std::uint64_t> none;
    const auto found = instances_.find(symbol.value);
    return found == instances_.end() ? none : found->second;
}

InstanceContent ItemsCenter::Private::Links::content()
{
    return InstanceContent([this] { return ItemId{d_.nextId++}; },
                           [this](ItemId id) { return static_cast<const Item*>(d_.byId.find(id.value)); },
                           kMaximumInstanceItems);
}

// --- before a change

bool ItemsCenter::Private::Links::reaches(ItemId from, ItemId symbol, const std::vector<Pending>& pending) const
{
    std::set<ItemId> seen{from};
    std::vector<ItemId> open{from};
    const auto collect = [&](const Item& item) {
        if (const ItemId link = linkOf(item); link && seen.insert(link).second) open.push_back(link);
    };
    while (!open.empty() && !seen.contains(symbol)) {
        const ItemId at = open.back();
        open.pop_back();
        d_.get(at).walk(collect);
        for (const Pending& one : pending)
            if (const Item* holder = one.symbol == at ? d_.byId.find(one.holder.value) : nullptr)
                for (const auto& child : holder->children()) child->walk(collect);
    }
    return seen.contains(symbol);
}

void ItemsCenter::Private::Links::checkEntering(const Item& subtree, const Item& parent) const
{
    for (const Item* up = holderOfMembers(parent); up; up = holderOf(*up)) {
        const ItemId symbol = isSymbol(*up) ? up->id() : linkOf(*up);
        const Item& own = d_.get(symbol);
        subtree.walk([&](const Item& item) {
            const ItemId inner = linkOf(item);
            if (inner && (inner == symbol || reaches(inner, symbol, pending_)))
                fail("'" + item.name() + "' shows the symbol '" + own.name() +
                     "', which cannot be a part of itself; detach it first");
        });
    }
}

void ItemsCenter::Private::Links::checkField(const Item& item, const Change& change) const
{
    if (!isSymbol(item)) return;
    const auto* property = std::get_if<PropertyChanged>(&change);
    if (!property || property->property != "name")
        fail("the symbol '" + item.name() + "' has but a name of its own; change what is in it, or an instance");
}

void ItemsCenter::Private::Links::before(const Change& change)
{
    if (following_ || !hasSymbols()) return;
    if (const auto* added = std::get_if<ItemAdded>(&change)) {
        const Item& parent = d_.get(added->parent);
        checkEntering(*added->detached, parent);
        touch(holderOfMembers(parent));
    } else if (const auto* removed = std::get_if<ItemRemoved>(&change)) {
        const Item& item = d_.get(removed->item);
        if (isSymbol(item) && !instancesOf(item.id()).empty())
            fail("the symbol '" + item.name() + "' is used " + std::to_string(instancesOf(item.id()).size()) +
                 " times; detach or delete its instances first");
        touch(holderOf(item));
    } else if (const auto* moved = std::get_if<ItemMoved>(&change)) {
        const Item& item = d_.get(moved->item);
        const Item& parent = d_.get(moved->newParent);
        if (isSymbol(item) ? &parent != d_.symbols.get()
                           : &topGroup(item) != &topGroup(parent) || &parent == d_.symbols.get())
            fail("'" + item.name() + "' cannot be moved into a symbol or out of it, only copied");
        if (holderOf(item) != holderOfMembers(parent)) checkEntering(item, parent);
        touch(holderOf(item));
        touch(holderOfMembers(parent));
    } else if (const ItemId id = changedItem(change)) {
        const Item& item = d_.get(id);
        checkField(item, change);
        touch(holderOf(item));
    }
}

const ItemsCenter::Private::Links::Pending* ItemsCenter::Private::Links::pendingOf(ItemId holder) const
{
    const auto found = pendingAt_.find(holder.value);
    return found == pendingAt_.end() ? nullptr : &pending_[found->second];
}

void ItemsCenter::Private::Links::touch(const Item* holder)
{
    if (!holder || pendingOf(holder->id())) return;
    const bool direct = isSymbol(*holder);
    const ItemId symbol = direct ? holder->id() : linkOf(*holder);
    const Item& own = d_.get(symbol);
    auto base = std::ranges::find(bases_, symbol, &Base::symbol);
    if (base == bases_.end()) base = bases_.insert(base, Base{symbol, d_.changes.size(), outlineOf(own)});
    Pending pending{holder->id(), symbol, d_.changes.size(), {}, {}};
    if (!direct) {
        pending.outline = outlineOf(*holder);
        pairMembers(*holder, symbol, base->outline,
                    [&](ItemId mine, ItemId theirs) { pending.toSymbol.emplace(mine.value, theirs); });
    }
    pendingAt_.emplace(holder->id().value, pending_.size());
    pending_.push_back(std::move(pending));
}

void ItemsCenter::Private::Links::reverted(std::size_t count)
{
    while (!followed_.empty() && followed_.back().end > count) {
        pending_ = std::move(followed_.back().pending);
        bases_ = std::move(followed_.back().bases);
        followed_.pop_back();
    }
    if (pending_.empty()) return;
    const auto later = [count](const auto& one) { return one.firstChange >= count; };
    std::erase_if(pending_, later);
    std::erase_if(bases_, later);
    pendingAt_.clear();
    for (std::size_t i = 0; i < pending_.size(); ++i) pendingAt_.emplace(pending_[i].holder.value, i);
}

void ItemsCenter::Private::Links::close() { pending_.clear(), pendingAt_.clear(), bases_.clear(), followed_.clear(); }

void ItemsCenter::Private::Links::settle(const Item& subtree)
{
    for (const Pending& one : pending_) {
        const Item* holder = d_.byId.find(one.holder.value);
        const ItemId link = linkOf(subtree);
        const bool direct = holder && isSymbol(*holder);
        // Of an instance it is the symbols it shows that count: others are perhaps being changed by who calls this.
        const bool shown = direct && (!link || link == one.holder || reaches(link, one.holder, pending_));
        if (!holder || holder == &subtree || shown || subtree.isAncestorOf(*holder)) {
            follow();
            return d_.own(subtree);  // what another instance had removed is gone here, too
        }
    }
}

void ItemsCenter::Private::Links::follow()
{
    if (pending_.empty()) return;
    Followed now{d_.changes.size(), 0, std::move(pending_), std::move(bases_)};
    pending_.clear(), pendingAt_.clear(), bases_.clear();
    following_ = true;
    try {
        Follower(*this, now).run();
        mend(exactAfter());
    } catch (...) {
        following_ = false;
        d_.revertTo(now.begin);
        pending_ = std::move(now.pending), bases_ = std::move(now.bases);
        reverted(d_.changes.size() + 1);  // finds the holders again
        throw;
    }
    following_ = false;
    now.end = d_.changes.size();
    followed_.push_back(std::move(now));  // also without changes: what is taken back may make some necessary
}

void ItemsCenter::Private::Links::mend(std::size_t count)
{
    const Followed nothing;
    Follower(*this, nothing).mend(count);
}

void ItemsCenter::Private::Links::finish()
{
    follow();
    if (!hasSymbols() || d_.changes.empty()) return;
    const std::size_t before = d_.changes.size();
    following_ = true;
    try {
        mend(0);  // of the whole transaction, whatever was followed and taken back in it
    } catch (...) {
        following_ = false;
        d_.revertTo(before);
        throw;
    }
    following_ = false;
}

// --- changes of a link

void ItemsCenter::Private::Links::nameKey(Item& symbol)
{
    static constexpr char kDigits[] = "0123456789abcdef";
    std::random_device source;
    std::string key;
    for (int i = 0; i < 16; ++i) key += kDigits[source() % 16];
    Item::Mutator::setProperty(symbol, kSymbolKey, Value(key));
}

void ItemsCenter::Private::Links::set(const Item& item, std::string_view property, const Value& value)
{
    const PropertySpec& spec = *linkTable().find(property);
    if (!item.is<GroupItem>() || isSymbol(item))
        fail("'" + item.name() + "' is not a group; only a group can be an instance of a symbol");
    if (property == kSymbolKey) fail("the key of a symbol cannot be changed");
    if (!value.isNone()) spec.check(value).orThrow();
    if (property == kLinkSymbol) return relink(item, value.isNone() ? ItemId{} : value.as<ItemId>());
    settle(item);
    if (!isInstance(item)) fail("'" + item.name() + "' is not an instance of a symbol");
    Affine placement = placementOf(item);
    const Vec2 part = (value.isNone() ? spec.fallback : value).as<Vec2>();
    if (property == kLinkX) placement.linear().col(0) = part;
    if (property == kLinkY) placement.linear().col(1) = part;
    if (property == kLinkOffset) placement.matrix().col(2) = part;
    place(item, placement);
}

void ItemsCenter::Private::Links::relink(const Item& group, ItemId symbol)
{
    if (linkOf(group) == symbol) return;
    const Item* own = symbol ? d_.byId.find(symbol.value) : nullptr;
    if (symbol && (!own || !isSymbol(*own))) fail("there is no symbol of that number in this scene");
    settle(group);
    if (own) settle(*own);
    if (own && own->children().empty()) follow();  // it may get its members from the group; others await some, too
    d_.own(group);
    if (!group.is<GroupItem>()) fail("'" + group.name() + "' is no longer a group");
    const ItemId old = linkOf(group);
    if (old == symbol) return;
    const auto setProperty = [&](std::string_view id, Value to) {
        const Value* stored = group.properties().find(id);
        Value before = stored ? *stored : Value();
        if (!(before == to)) d_.make(PropertyChanged{group.id(), std::string(id), std::move(before), std::move(to)});
    };
    if (!symbol) {
        for (const std::string_view id : {kLinkOffset, kLinkX, kLinkY, kLinkSymbol}) setProperty(id, Value());
        return;
    }
    for (const Item* up = holderOf(group); up; up = holderOf(*up)) {
        const ItemId outer = isSymbol(*up) ? up->id() : linkOf(*up);
        if (outer == symbol || reaches(symbol, outer, pending_))
            fail("the symbol '" + own->name() + "' cannot be a part of itself");
    }
    if (!old) {
        setProperty(kLinkOffset, Vec2(0, 0));
        setProperty(kLinkX, Vec2(1, 0));
        setProperty(kLinkY, Vec2(0, 1));
    }
    const bool fills = !old && own->children().empty() && !group.children().empty();
    if (fills) checkEntering(group, *own);
    setProperty(kLinkSymbol, symbol);
    following_ = true;
    try {
        if (fills) {
            Follower::fill(*this, group, *own);
        } else {
            replaceContent(group);
        }
    } catch (...) {
        following_ = false;
        throw;
    }
    following_ = false;
}

void ItemsCenter::Private::Links::checkDepth(const Item& parent, const Item& subtree)
{
    if (depthOf(parent) + 1 + heightOf(subtree) > kMaximumDepth)
        fail("items would be nested more than " + std::to_string(kMaximumDepth) +
             " deep in an instance; flatten the groups");
}

void ItemsCenter::Private::Links::replaceContent(const Item& instance)
{
    while (!instance.children().empty()) {
        const Item& last = *instance.children().back();
        d_.make(ItemRemoved{last.id(), instance.id(), last.index(), nullptr});
    }
    InstanceContent made = content();
    for (auto& item : made.of(d_.get(linkOf(instance)), placementOf(instance))) {
        checkDepth(instance, *item);
        item->walk([](const Item& one) {
            if (!one.path().isFinite()) fail("'" + one.name() + "' would lie beyond all numbers");
        });
        d_.make(ItemAdded{item->id(), instance.id(), instance.children().size(), std::move(item)});
    }
}

void ItemsCenter::Private::Links::setPlacementProperties(const Item& instance, const Affine& placement)
{
    const std::pair<std::string_view, Vec2> parts[] = {{kLinkX, placement.linear().col(0)},
                                                       {kLinkY, placement.linear().col(1)},
                                                       {kLinkOffset, placement.matrix().col(2)}};
    for (const auto& [id, part] : parts) {
        const Value to(part);
        linkTable().find(id)->check(to).orThrow();
        const Value* stored = instance.properties().find(id);
        if (stored && *stored == to) continue;
        d_.make(PropertyChanged{instance.id(), std::string(id), stored ? *stored : Value(), to});
    }
}

void ItemsCenter::Private::Links::place(const Item& instance, const Affine& wanted)
{
    const Affine placement = withoutSignedZeros(wanted);
    const std::size_t before = d_.changes.size();
    const bool was = following_;
    try {
        setPlacementProperties(instance, placement);
        following_ = true;
        moveContent(d_.get(linkOf(instance)), instance, placement);
    } catch (...) {
        following_ = was;
        d_.revertTo(before);
        throw;
    }
    following_ = was;
}

bool ItemsCenter::Private::Links::isShapedLike(const Item& theirs, const Item& mine) const
{
    return std::ranges::equal(theirs.children(), mine.children(), [&](const auto& a, const auto& b) {
        const ItemId inner = linkOf(*a);
        return inner == linkOf(*b) && isShapedLike(inner ? d_.get(inner) : *a, *b);
    });
}

void ItemsCenter::Private::Links::moveContent(const Item& symbol, const Item& instance, const Affine& placement)
{
    isShapedLike(symbol, instance) ? moveMembers(symbol, instance, placement) : replaceContent(instance);
}

void ItemsCenter::Private::Links::moveMembers(const Item& container, const Item& counterpart, const Affine& placement)
{
    for (std::size_t i = 0; i < container.children().size(); ++i) {
        const Item& theirs = *container.children()[i];
        const Item& mine = *counterpart.children()[i];
        if (!theirs.path().isEmpty()) {
            Path path = placedPath(theirs.path(), placement);
            if (!path.isFinite()) fail("'" + mine.name() + "' would lie beyond all numbers");
            d_.make(PathChanged{mine.id(), mine.path(), std::move(path)});
        }
        if (const ItemId inner = linkOf(theirs)) {
            const Affine place = innerPlacement(placement, theirs);
            setPlacementProperties(mine, place);
            moveMembers(d_.get(inner), mine, place);
        } else {
            moveMembers(theirs, mine, placement);
        }
    }
}

// --- from another scene

/// An instance keeps its link where this scene has the symbol, with that one's content; else the symbol comes along.
/// What stood in a scene that is gone becomes a plain group.
void ItemsCenter::Private::Links::adopt(const Item& source, Item& copy)
{
    if (linkOf(source)) {
        const auto tree = treeOf(source);
        const auto* other = tree ? static_cast<const Private*>(tree->owner) : nullptr;
        const Item* foreign = other ? other->byId.find(linkOf(source).value) : nullptr;
        if (!foreign) {
            for (const std::string_view id : {kLinkOffset, kLinkX, kLinkY, kLinkSymbol})
                Item::Mutator::setProperty(copy, id, Value());
            return;
        }
        const Item& symbol = symbolFor(*foreign, *other);
        const Affine placement = placementOf(source);
        setLink(copy, symbol.id(), placement);
        while (!copy.children().empty()) Item::Mutator::take(copy, copy.children().size() - 1);
        InstanceContent made = content();
        for (auto& item : made.of(symbol, placement))
            Item::Mutator::insert(copy, copy.children().size(), std::move(item));
        return;
    }
    for (std::size_t i = 0; i < source.children().size(); ++i)
        adopt(*source.children()[i], *Item::Mutator::child(copy, i));
}

const Item& ItemsCenter::Private::Links::symbolFor(const Item& foreign, const Private& other)
{
    const Value key = foreign.property(kSymbolKey).value_or(Value());
    for (const auto& own : d_.symbols->children())
        if (own->property(kSymbolKey) == key) return *own;
    ItemPairs pairs;
    auto symbol = Item::Mutator::copyAlone(foreign, ItemId{d_.nextId++});
    for (const auto& member : foreign.children())
        Item::Mutator::insert(*symbol, symbol->children().size(), bring(*member, other, pairs));
    for (std::size_t i = 0; i < symbol->children().size(); ++i)
        redirectReferences(*Item::Mutator::child(*symbol, i), pairs, false);
    Item::Mutator::setName(*symbol, freeSymbolName(d_.scene, symbol->name()));
    const Item& made = *symbol;
    d_.make(ItemAdded{made.id(), kSymbolsId, d_.symbols->children().size(), std::move(symbol)});
    return made;
}

std::unique_ptr<Item> ItemsCenter::Private::Links::bring(const Item& member, const Private& other, ItemPairs& pairs)
{
    auto item = Item::Mutator::copyAlone(member, ItemId{d_.nextId++});
    pairs.emplace(member.id().value, item->id());
    if (linkOf(member)) {
        adopt(member, *item);
        return item;
    }
    for (const auto& child : member.children())
        Item::Mutator::insert(*item, item->children().size(), bring(*child, other, pairs));
    return item;
}

}  // namespace jet
