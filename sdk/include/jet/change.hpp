// What a transaction records: data-only changes. Undo, events, the dirty mark and crash recovery all come from these
// records.
#pragma once

#include <jet/item.hpp>
#include <jet/materials.hpp>

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace jet {

// Each change holds what is needed to go both ways; old values are stored, never recomputed, so undo is bit-exact.

struct ItemAdded {
    ItemId item, parent;
    std::size_t index = 0;
    std::unique_ptr<Item> detached;  ///< the subtree while the change is undone
};
struct ItemRemoved {
    ItemId item, parent;
    std::size_t index = 0;
    std::unique_ptr<Item> detached;  ///< the subtree while the change is in force
};
struct ItemMoved {
    ItemId item, oldParent, newParent;
    std::size_t oldIndex = 0, newIndex = 0;
};
struct PathChanged {
    ItemId item;
    Path before, after;
};
/// Also the common properties "name", "visible" and "locked". A None value: not set.
struct PropertyChanged {
    ItemId item;
    std::string property;
    Value before, after;
};
struct TypeChanged {
    ItemId item;
    std::string before, after;
};
struct EffectAdded {
    ItemId item;
    std::size_t index = 0;
    EffectInstance effect;
};
struct EffectRemoved {
    ItemId item;
    std::size_t index = 0;
    EffectInstance effect;
};
struct EffectMoved {
    ItemId item;
    std::size_t from = 0, to = 0;
};
/// Also the common property "visible".
struct EffectPropertyChanged {
    ItemId item;
    std::size_t index = 0;
    std::string property;
    Value before, after;
};
struct ScenePropertyChanged {
    std::string property;
    Value before, after;
};
struct MaterialsChanged {
    MaterialTable before, after;
};

using Change = std::variant<ItemAdded, ItemRemoved, ItemMoved, PathChanged, PropertyChanged, TypeChanged, EffectAdded,
                            EffectRemoved, EffectMoved, EffectPropertyChanged, ScenePropertyChanged, MaterialsChanged>;

/// The item a change is about; none for changes of the scene itself.
JET_API ItemId changedItem(const Change& change);
/// Memory the change keeps, in bytes: an estimate for the history's budget.
JET_API std::size_t memoryOf(const Change& change);

}  // namespace jet
