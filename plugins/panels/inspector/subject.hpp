// Subject: what the Inspector is about: the selected items, seen as one. A value in which they differ is "mixed": none,
// or of a vector NaN in the part in which they do.
#pragma once

#include <jet/catalog.hpp>
#include <jet/effect.hpp>
#include <jet/item_type.hpp>
#include <jet/scene.hpp>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace jet::inspector {

/// An effect all items of the subject have: the n-th of its type on each of them.
struct SharedEffect {
    std::string type;
    int occurrence = 0;
    bool operator==(const SharedEffect&) const = default;
};

class Subject {
public:
    Subject() = default;
    explicit Subject(const Scene& scene);

    bool isEmpty() const { return items_.empty(); }
    const std::vector<const Item*>& items() const { return items_; }
    /// The type all have; empty when they differ.
    const std::string& type() const { return type_; }
    const std::set<std::string>& types() const { return types_; }
    const std::vector<SharedEffect>& effects() const { return effects_; }
    /// Equal outlines need the same editors.
    bool sameOutline(const Subject& other) const;
    Box bounds() const;

    /// A property of the items; `fallback` where an item has none stored.
    std::optional<Value> common(std::string_view property, const Value& fallback) const;
    /// A property of the effect, or "visible".
    std::optional<Value> common(const SharedEffect& effect, std::string_view property, const Value& fallback) const;

private:
    std::vector<const Item*> items_;
    std::string type_;
    std::set<std::string> types_;
    std::vector<SharedEffect> effects_;
};

/// What an item gets when the user entered `wanted`: of a vector, a part that is NaN stays as it is.
Value resolved(const Value& wanted, const Value& present);
/// Index of the effect on the item, if it has it.
std::optional<std::size_t> indexOf(const Item& item, const SharedEffect& effect);
/// A property of an item's effect, or "visible"; `fallback` where none is stored.
Value effectValue(const Item& item, std::size_t index, std::string_view property, const Value& fallback);
/// What the types declare alike: the table of the only one, or what their tables have in common.
std::vector<PropertySpec> sharedProperties(Catalog& catalog, const std::set<std::string>& types);
/// Of the SDK or of a plugin; null when the plugin is absent.
const ItemType* typeOf(Catalog& catalog, const std::string& type);

}  // namespace jet::inspector
