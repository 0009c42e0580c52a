// Where an item keeps a property that is named while playing: its own, or, of bodies, one of its effects'.
#pragma once

#include "item_mutator.hpp"

#include <jet/item.hpp>

#include <optional>

namespace jet {

struct PropertyPlace {
    const PropertySpec* spec = nullptr;  ///< null: no table has it, as "name" and "visible"
    std::optional<std::size_t> effect;   ///< which of the item's; none: its own
};

/// The item's own come first, then those of its effects from the first on. `tableOf(instance)`: null where the effect
/// is not there.
template <class TableOf>
PropertyPlace placeOf(const Item& item, const PropertyTable* own, std::string_view property, TableOf&& tableOf)
{
    if (const PropertySpec* spec = own ? own->find(property) : nullptr) return {spec, {}};
    if (!item.is<BodyItem>()) return {};
    for (std::size_t i = 0; i < item.effects().size(); ++i) {
        const PropertyTable* table = tableOf(item.effects()[i]);
        if (const PropertySpec* spec = table ? table->find(property) : nullptr) return {spec, i};
    }
    return {};
}

/// None: it is stored nowhere, and has its default.
inline Value valueAt(const Item& item, const PropertyPlace& place, std::string_view property)
{
    const Properties& stored = place.effect ? item.effects()[*place.effect].properties : item.properties();
    const Value* value = stored.find(property);
    return value ? *value : Value();
}

/// A value of None takes away what is stored.
inline void putAt(const Item& item, const PropertyPlace& place, std::string_view property, const Value& value)
{
    Item& changed = const_cast<Item&>(item);  // of a copy that plays or is shown
    if (!place.effect) return Item::Mutator::setProperty(changed, property, value);
    Properties& stored = Item::Mutator::effects(changed)[*place.effect].properties;
    if (value.isNone()) {
        stored.erase(property);
    } else {
        stored.set(property, value);
    }
}

}  // namespace jet
