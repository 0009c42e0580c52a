#include "property_tables.hpp"

#include <jet/catalog.hpp>
#include <jet/effect.hpp>
#include <jet/item_type.hpp>
#include <jet/scene.hpp>

namespace jet::duktape {

PropertyTables::PropertyTables(const Scene& scene)
{
    Catalog& catalog = scene.catalog();
    scene.root().walk([&](const Item& item) {
        if (!types_.contains(item.type())) {
            const ItemType* type = builtInItemType(item.type());
            if (!type) type = catalog.itemType(item.type());
            types_.emplace(item.type(), type ? &type->properties() : nullptr);
        }
        if (!item.is<BodyItem>()) return;
        for (const EffectInstance& instance : item.effects()) {
            if (effects_.contains(instance.type)) continue;
            const Effect* effect = catalog.effect(instance.type);
            effects_.emplace(instance.type, effect ? &effect->properties() : nullptr);
        }
    });
}

PropertyTables::Found PropertyTables::find(const Item& item, std::string_view property) const
{
    Found found;
    found.stored = item.property(property);
    if (const auto type = types_.find(item.type()); type != types_.end() && type->second)
        found.spec = type->second->find(property);
    if (found.spec || found.stored || !item.is<BodyItem>()) return found;
    for (const EffectInstance& instance : item.effects()) {
        const auto effect = effects_.find(instance.type);
        if (effect == effects_.end() || !effect->second) continue;
        found.spec = effect->second->find(property);
        if (!found.spec) continue;
        if (const Value* value = instance.properties.find(property)) found.stored = *value;
        return found;
    }
    return found;
}

std::string PropertyTables::known(const Item& item) const
{
    std::string known = "name, visible, locked";
    if (const auto type = types_.find(item.type()); type != types_.end() && type->second) {
        for (const PropertySpec& spec : type->second->specs()) known += ", " + spec.id;
    } else {
        for (const auto& [id, value] : item.properties().entries()) known += ", " + id;
    }
    if (!item.is<BodyItem>()) return known;
    for (const EffectInstance& instance : item.effects())
        if (const auto effect = effects_.find(instance.type); effect != effects_.end() && effect->second)
            for (const PropertySpec& spec : effect->second->specs()) known += ", " + spec.id;
    return known;
}

}  // namespace jet::duktape
