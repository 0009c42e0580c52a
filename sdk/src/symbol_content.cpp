// Links as data, and the items an instance has because its symbol has them.
#include "bits.hpp"
#include "symbol_links.hpp"

namespace jet {

namespace {

PropertySpec symbolReference()
{
    PropertySpec spec;
    spec.id = kLinkSymbol;
    spec.label = "Symbol";
    spec.kind = ValueKind::Item;
    spec.fallback = ItemId{};
    return spec;
}

}  // namespace

const PropertyTable& linkTable()
{
    static const PropertyTable table{
        symbolReference(),
        vector(std::string(kLinkX), "X axis", {1, 0}).range(-1e12, 1e12),
        vector(std::string(kLinkY), "Y axis", {0, 1}).range(-1e12, 1e12),
        vector(std::string(kLinkOffset), "Offset", {0, 0}).in("units").range(-1e15, 1e15),
        text(std::string(kSymbolKey), "Key", ""),
    };
    return table;
}

ItemId linkOf(const Item& item)
{
    if (!item.is<GroupItem>()) return {};
    const Value* link = item.properties().find(kLinkSymbol);
    const ItemId* symbol = link ? link->get<ItemId>() : nullptr;
    return symbol ? *symbol : ItemId{};
}

bool isSymbol(const Item& item) { return item.parent() && item.parent()->id() == kSymbolsId; }

Affine placementOf(const Item& instance)
{
    const auto part = [&](std::string_view id) { return instance.properties().get(id, linkTable()).as<Vec2>(); };
    const Vec2 x = part(kLinkX), y = part(kLinkY), offset = part(kLinkOffset);
    return Affine::fromSvg(x.x(), x.y(), y.x(), y.y(), offset.x(), offset.y());
}

const Item* holderOfMembers(const Item& container)
{
    for (const Item* up = &container; up; up = up->parent())
        if (isSymbol(*up) || isInstance(*up)) return up;
    return nullptr;
}

const Item* holderOf(const Item& item) { return item.parent() ? holderOfMembers(*item.parent()) : nullptr; }

Path placedPath(const Path& path, const Affine& placement)
{
    return path.isEmpty() || placement.isIdentity() ? path : path.transformed(placement);
}

Affine withoutSignedZeros(Affine placement)
{
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 2; ++row) placement(row, column) += 0.0;
    return placement;
}

Affine innerPlacement(const Affine& outer, const Item& member)
{
    return withoutSignedZeros(outer * placementOf(member));
}

void setLink(Item& item, ItemId symbol, const Affine& placement)
{
    Properties properties = item.properties();
    properties.set(kLinkSymbol, symbol);
    properties.set(kLinkX, Vec2(placement.linear().col(0)));
    properties.set(kLinkY, Vec2(placement.linear().col(1)));
    properties.set(kLinkOffset, Vec2(placement.matrix().col(2)));
    Item::Mutator::setProperties(item, std::move(properties));
}

Value withCounterparts(const Value& value, const ItemPairs& pairs)
{
    const ItemId* reference = value.get<ItemId>();
    const auto found = reference ? pairs.find(reference->value) : pairs.end();
    return found == pairs.end() ? value : Value(found->second);
}

namespace {

bool hasReference(const Properties& properties)
{
    return std::ranges::any_of(properties.entries(), [](const auto& entry) {
        return entry.second.template get<ItemId>() && entry.first != kLinkSymbol;
    });
}

Properties redirected(const Properties& properties, const ItemPairs& pairs, bool keepOthers)
{
    Properties result = properties;
    for (const auto& [id, value] : properties.entries()) {
        const ItemId* reference = value.get<ItemId>();
        if (!reference || id == kLinkSymbol) continue;
        const bool known = pairs.contains(reference->value);
        if (known || !keepOthers) result.set(id, known ? pairs.at(reference->value) : ItemId{});
    }
    return result;
}

}  // namespace

void redirectOwnReferences(Item& item, const ItemPairs& pairs, bool keepOthers)
{
    if (hasReference(item.properties()))
        Item::Mutator::setProperties(item, redirected(item.properties(), pairs, keepOthers));
    if (std::ranges::any_of(item.effects(), [](const auto& effect) { return hasReference(effect.properties); }))
        for (EffectInstance& effect : Item::Mutator::effects(item))
            effect.properties = redirected(effect.properties, pairs, keepOthers);
}

void referAs(const Item& member, Item& item, const ItemPairs& pairs)
{
    const auto refer = [&](const Properties& theirs, const Properties& mine) {
        Properties result = mine;
        for (const auto& [id, value] : theirs.entries())
            if (value.get<ItemId>() && id != kLinkSymbol) result.set(id, withCounterparts(value, pairs));
        return result;
    };
    if (hasReference(member.properties()))
        Item::Mutator::setProperties(item, refer(member.properties(), item.properties()));
    for (std::size_t i = 0; i < std::min(member.effects().size(), item.effects().size()); ++i)
        if (hasReference(member.effects()[i].properties))
            Item::Mutator::effects(item)[i].properties =
                refer(member.effects()[i].properties, item.effects()[i].properties);
}

void redirectReferences(Item& item, const ItemPairs& pairs, bool keepOthers)
{
    redirectOwnReferences(item, pairs, keepOthers);
    if (isInstance(item)) return;  // what is in it refers to what is in it
    for (std::size_t i = 0; i < item.children().size(); ++i)
        redirectReferences(*Item::Mutator::child(item, i), pairs, keepOthers);
}

namespace {

void append(Item& parent, std::unique_ptr<Item> child)
{
    Item::Mutator::insert(parent, parent.children().size(), std::move(child));
}

}  // namespace

std::vector<std::unique_ptr<Item>> InstanceContent::of(const Item& symbol, const Affine& placement)
{
    if (++depth_ > kMaximumDepth) throw Failure(Error("symbols are nested more than 1000 deep in each other"));
    ItemPairs pairs;
    std::vector<std::unique_ptr<Item>> made;
    made.reserve(symbol.children().size());
    for (const auto& member : symbol.children()) made.push_back(copy(*member, placement, pairs, false));
    for (const auto& item : made) redirectReferences(*item, pairs, true);
    --depth_;
    return made;
}

std::unique_ptr<Item> InstanceContent::copy(const Item& member, const Affine& placement, ItemPairs& pairs, bool alone)
{
    if (left_-- == 0)
        throw Failure(Error("symbols in symbols would make more than " + std::to_string(kMaximumInstanceItems) +
                            " items; use fewer instances"));
    auto item = Item::Mutator::copyAlone(member, nextId_());
    pairs.emplace(member.id().value, item->id());
    Item::Mutator::setPath(*item, placedPath(member.path(), placement));
    if (const ItemId inner = linkOf(member)) {
        const Affine place = innerPlacement(placement, member);
        setLink(*item, inner, place);
        if (const Item* symbol = symbol_(inner))
            for (auto& child : of(*symbol, place)) append(*item, std::move(child));
    } else if (!alone) {
        for (const auto& child : member.children()) append(*item, copy(*child, placement, pairs, false));
    }
    return item;
}

}  // namespace jet
