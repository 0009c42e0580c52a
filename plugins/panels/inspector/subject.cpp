#include "subject.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jet::inspector {

namespace {

std::vector<SharedEffect> effectsOf(const Item& item)
{
    std::vector<SharedEffect> effects;
    for (const EffectInstance& effect : item.effects()) {
        const auto same = [&](const SharedEffect& e) { return e.type == effect.type; };
        effects.push_back({effect.type, static_cast<int>(std::count_if(effects.begin(), effects.end(), same))});
    }
    return effects;
}

/// NaN in the parts in which two vectors differ, or one of them is mixed already.
Vec2 common(const Vec2& a, const Vec2& b)
{
    constexpr double kMixed = std::numeric_limits<double>::quiet_NaN();
    return {a.x() == b.x() ? a.x() : kMixed, a.y() == b.y() ? a.y() : kMixed};
}

/// The value `of` gives for all items; none as soon as two differ, but of vectors what is common to them.
template <class Of>
std::optional<Value> commonValue(const std::vector<const Item*>& items, Of of)
{
    std::optional<Value> common;
    for (const Item* item : items) {
        Value value = of(*item);
        if (!common) {
            common = std::move(value);
        } else if (common->kind() == ValueKind::Vec2 && value.kind() == ValueKind::Vec2) {
            common = Value(inspector::common(common->template as<Vec2>(), value.template as<Vec2>()));
        } else if (!(*common == value)) {
            return std::nullopt;
        }
    }
    return common;
}

}  // namespace

Value resolved(const Value& wanted, const Value& present)
{
    if (wanted.kind() != ValueKind::Vec2 || present.kind() != ValueKind::Vec2) return wanted;
    const Vec2 now = wanted.as<Vec2>(), before = present.as<Vec2>();
    return Vec2(std::isnan(now.x()) ? before.x() : now.x(), std::isnan(now.y()) ? before.y() : now.y());
}

std::optional<std::size_t> indexOf(const Item& item, const SharedEffect& effect)
{
    int occurrence = 0;
    for (std::size_t i = 0; i < item.effects().size(); ++i) {
        if (item.effects()[i].type == effect.type && occurrence++ == effect.occurrence) return i;
    }
    return std::nullopt;
}

const ItemType* typeOf(Catalog& catalog, const std::string& type)
{
    const ItemType* builtIn = builtInItemType(type);
    return builtIn ? builtIn : catalog.itemType(type);
}

std::vector<PropertySpec> sharedProperties(Catalog& catalog, const std::set<std::string>& types)
{
    std::optional<std::vector<PropertySpec>> shared;
    for (const std::string& id : types) {
        const ItemType* type = typeOf(catalog, id);
        if (!type) return {};
        const PropertyTable& table = type->properties();
        if (!shared) shared.emplace(table.specs().begin(), table.specs().end());
        std::erase_if(*shared, [&](const PropertySpec& spec) {
            const PropertySpec* other = table.find(spec.id);
            return !other || other->kind != spec.kind || other->unit != spec.unit || other->choices != spec.choices;
        });
    }
    return std::move(shared).value_or(std::vector<PropertySpec>());
}

Subject::Subject(const Scene& scene)
{
    for (const ItemId id : scene.items().selection()) {
        if (const Item* item = scene.items().find(id)) items_.push_back(item);
    }
    if (items_.empty()) return;
    type_ = items_.front()->type();
    effects_ = effectsOf(*items_.front());
    for (const Item* item : items_) {
        if (item->type() != type_) type_.clear();
        types_.insert(item->type());
        std::erase_if(effects_, [&](const SharedEffect& effect) { return !indexOf(*item, effect); });
    }
}

bool Subject::sameOutline(const Subject& other) const
{
    return isEmpty() == other.isEmpty() && (items_.size() > 1) == (other.items_.size() > 1) && types_ == other.types_ &&
           effects_ == other.effects_;
}

Box Subject::bounds() const
{
    Box box;
    for (const Item* item : items_) box.extend(item->bounds());
    return box;
}

std::optional<Value> Subject::common(std::string_view property, const Value& fallback) const
{
    return commonValue(items_, [&](const Item& item) { return item.property(property).value_or(fallback); });
}

Value effectValue(const Item& item, std::size_t index, std::string_view property, const Value& fallback)
{
    const EffectInstance& instance = item.effects()[index];
    if (property == "visible") return instance.visible;
    const Value* stored = instance.properties.find(property);
    return stored ? *stored : fallback;
}

std::optional<Value> Subject::common(const SharedEffect& effect, std::string_view property, const Value& fallback) const
{
    return commonValue(items_,
                       [&](const Item& item) { return effectValue(item, *indexOf(item, effect), property, fallback); });
}

}  // namespace jet::inspector
