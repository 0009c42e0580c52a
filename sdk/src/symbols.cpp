// What tools and commands do with symbols, by way of transactions like anybody.
#include "symbol_links.hpp"

#include <jet/arrange.hpp>

namespace jet {

namespace {

const Item& topOf(const Scene& scene) { return *scene.items().find(kSymbolsId); }

}  // namespace

std::vector<const Item*> symbolsOf(const Scene& scene)
{
    std::vector<const Item*> symbols;
    for (const auto& symbol : topOf(scene).children()) symbols.push_back(symbol.get());
    return symbols;
}

const Item* findSymbol(const Scene& scene, std::string_view name)
{
    for (const auto& symbol : topOf(scene).children())
        if (symbol->name() == name) return symbol.get();
    return nullptr;
}

const Item* symbolOf(const Scene& scene, const Item& item)
{
    const ItemId link = linkOf(item);
    return link ? scene.items().find(link) : nullptr;
}

std::vector<const Item*> instancesOf(const Scene& scene, const Item& symbol)
{
    std::vector<const Item*> found;
    for (const std::uint64_t id : linkedTo(symbol))
        if (const Item* item = scene.items().find(ItemId{id}); &topGroup(*item) == &scene.root()) found.push_back(item);
    return found;
}

bool isSymbolUsed(const Item& symbol) { return !linkedTo(symbol).empty(); }

std::string freeSymbolName(const Scene& scene, std::string wanted)
{
    if (!wanted.empty() && !findSymbol(scene, wanted)) return wanted;
    if (wanted.empty()) wanted = "Symbol";
    for (int number = wanted == "Symbol" ? 1 : 2;; ++number)
        if (std::string name = wanted + ' ' + std::to_string(number); !findSymbol(scene, name)) return name;
}

const Item* createSymbol(Transaction& edit, const Scene& scene, std::span<const Item* const> items, std::string name)
{
    const Item* instance = groupItems(edit, items);
    if (!instance) return nullptr;
    const Item& symbol = edit.add<GroupItem>(topOf(scene));
    edit.set(symbol, "name", freeSymbolName(scene, std::move(name)));
    edit.set(*instance, "name", symbol.name());
    edit.set(*instance, kLinkSymbol, symbol.id());
    return instance;
}

const Item& placeSymbol(Transaction& edit, const Item& symbol, const Item& parent, const Affine& placement)
{
    const Item& instance = edit.add<GroupItem>(parent);
    edit.set(instance, "name", symbol.name());
    edit.set(instance, kLinkSymbol, symbol.id());
    setPlacement(edit, instance, placement);
    return instance;
}

void setPlacement(Transaction& edit, const Item& instance, const Affine& placement)
{
    const std::pair<std::string_view, Vec2> parts[] = {{kLinkX, placement.linear().col(0)},
                                                       {kLinkY, placement.linear().col(1)},
                                                       {kLinkOffset, placement.matrix().col(2)}};
    for (const auto& [id, part] : parts)
        if (instance.property(id) != Value(part)) edit.set(instance, id, part);
}

void swapSymbol(Transaction& edit, const Item& instance, const Item& symbol)
{
    if (!isInstance(instance)) throw Failure(Error("'" + instance.name() + "' is not an instance of a symbol"));
    edit.set(instance, kLinkSymbol, symbol.id());
}

void detachInstance(Transaction& edit, const Item& instance)
{
    if (!isInstance(instance)) throw Failure(Error("'" + instance.name() + "' is not an instance of a symbol"));
    edit.set(instance, kLinkSymbol, Value());
}

void removeSymbol(Transaction& edit, const Item& symbol)
{
    if (!isSymbol(symbol)) throw Failure(Error("'" + symbol.name() + "' is not a symbol"));
    edit.remove(symbol);
}

}  // namespace jet
