// Properties that change while playing: of the copy that plays, and of the world.
#include "known_effect.hpp"
#include "scene_state.hpp"
#include "simulation_state.hpp"

#include <jet/simulation.hpp>

namespace jet {

void Simulation::Private::keepTables(const Item& item)
{
    if (!types.contains(item.type())) types.emplace(item.type(), itemTypeOf(scene->catalog(), item.type()));
    if (!item.is<BodyItem>()) return;
    for (const EffectInstance& instance : item.effects())
        if (!effects.contains(instance.type)) effects.emplace(instance.type, knownEffect(scene->catalog(), instance));
}

PropertyPlace Simulation::Private::placeOf(const Item& item, std::string_view property) const
{
    const auto type = types.find(item.type());
    const PropertyTable* own = type != types.end() && type->second ? &type->second->properties() : nullptr;
    return jet::placeOf(item, own, property, [&](const EffectInstance& instance) {
        const auto effect = effects.find(instance.type);
        return effect != effects.end() && effect->second ? &effect->second->properties() : nullptr;
    });
}

std::optional<BodyDef> Simulation::Private::definitionOf(const Item& item, std::size_t effect) const
{
    const EffectInstance& instance = item.effects()[effect];
    const Effect& builder = *effects.at(instance.type);
    return builder.buildBody({item, item.path(), instance.properties, builder.properties()}, BodyCommon{});
}

/// Properties of body items.
void Simulation::Private::changeBody(const Item& item, std::string_view property, const Value& value)
{
    const std::size_t i = bindingOf(item.id());
    if (i >= bodies.size()) throw Failure(Error("no body was made of it when play started"));
    const BodyHandle body = bodies[i].body;
    if (property == "velocity") return world->setVelocity(body, value.as<Vec2>());
    if (property == "omega") return world->setOmega(body, value.as<double>());
    std::string problem;
    const BodyCommon common = commonOf(*scene, item, problem);
    if (!problem.empty()) throw Failure(Error(problem));
    if (common.fixed != bodies[i].fixed)
        throw Failure(Error("a body cannot become fixed or free; make it kinematic instead"));
    world->setBody(body, common);
}

/// Properties of the effect that builds the body; those of others are only looks.
void Simulation::Private::changeBody(const Item& item, std::size_t effect, const std::optional<BodyDef>& before)
{
    BodyBinding& binding = bodies[bindingOf(item.id())];
    const std::optional<BodyDef> after = definitionOf(item, effect);
    if (!before || !after) throw Failure(Error("no body comes of it any more"));
    changeDefinition(binding.body, *before, *after, *world);
    binding.mass = massOf(*after);
    const auto* soft = std::get_if<SoftBodyDef>(&*after);
    if (!soft || !binding.live) return;
    for (std::size_t s = 0; s < binding.live->springs.size(); ++s)
        binding.live->springs[s].stiffness = soft->springs[s].ks;
}

void Simulation::Private::changeItem(const Item& item)
{
    const auto type = types.find(item.type());
    if (type != types.end() && type->second) changeParts(item, *type->second, parts[item.id()], *world);
}

void Simulation::Private::change(const Item& item, const PropertyPlace& place, std::string_view property,
                                 const Value& value)
{
    const std::size_t i = bindingOf(item.id());
    const bool builds = place.effect && i < bodies.size() && bodies[i].effect == *place.effect;
    const std::optional<BodyDef> built = builds ? definitionOf(item, *place.effect) : std::nullopt;
    const Value before = valueAt(item, place, property);
    putAt(item, place, property, value);
    const bool ofItem = !place.effect && !item.is<BodyItem>() && !item.is<TorqueItem>();
    try {
        if (builds) changeBody(item, *place.effect, built);
        if (!place.effect && item.is<BodyItem>()) changeBody(item, property, value);
        if (ofItem) changeItem(item);
    } catch (...) {
        putAt(item, place, property, before);
        if (ofItem) bringBack(item);
        throw;
    }
}

/// After a refusal, of which the world may have done a part.
void Simulation::Private::bringBack(const Item& item)
{
    try {
        changeItem(item);
    } catch (const Failure&) {  // what is refused now was refused before: it changed nothing
    }
}

template <class Def>
std::uint32_t Simulation::Private::firstOf(ItemId item) const
{
    const auto found = parts.find(item);
    if (found == parts.end()) return kNoHandle;
    for (const ItemPart& part : found->second.parts)
        if (std::holds_alternative<Def>(part.def)) return part.handle;
    return kNoHandle;
}

JointHandle Simulation::jointOf(ItemId item) const { return d_->firstOf<JointDef>(item); }
ActuatorHandle Simulation::forceOf(ItemId item) const { return d_->firstOf<ForceActuatorDef>(item); }

void Simulation::setItemProperty(ItemId id, std::string_view property, Value value)
{
    const Item* item = d_->scene->items().find(id);
    if (!item) throw Failure(Error("the item is not in the playing scene"));
    if (property == "visible" || property == "locked" || property == "name") {
        value = property == "name" ? Value(value.as<std::string>()) : Value(value.as<bool>());
        putAt(*item, {}, property, value);
    } else {
        const PropertyPlace place = d_->placeOf(*item, property);
        if (!place.spec) throw Failure(Error("'" + item->name() + "' has no property '" + std::string(property) + "'"));
        if (place.spec->kind == ValueKind::Real && value.get<std::int64_t>()) value = value.as<double>();
        place.spec->check(value).orThrow();
        try {
            d_->change(*item, place, property, value);
        } catch (const Failure& failure) {
            throw Failure(Error("'" + item->name() + "': '" + std::string(property) +
                                "' stays as it is while playing: " + failure.error().message));
        }
        if (item->is<TorqueItem>() && property == "value") setTorque(id, value.as<double>());
    }
    if (d_->onProperty) d_->onProperty(id, property, value);
}

}  // namespace jet
