// Which effect answers for an instance of a scene.
#pragma once

#include <jet/catalog.hpp>
#include <jet/effect.hpp>
#include <jet/item.hpp>

namespace jet {

/// Were the properties read while the effect's plugin was not there? Then they are texts where the effect wants values,
/// until the scene is read again.
inline bool readWithoutPlugin(const Effect& effect, const EffectInstance& instance)
{
    for (const auto& [id, value] : instance.properties.entries())
        if (value.isRaw() && effect.properties().find(id)) return true;
    return false;
}

/// Null where the plugin is absent, and where it came after the scene was read.
inline const Effect* knownEffect(Catalog& catalog, const EffectInstance& instance)
{
    const Effect* effect = catalog.effect(instance.type);
    return effect && !readWithoutPlugin(*effect, instance) ? effect : nullptr;
}

}  // namespace jet
