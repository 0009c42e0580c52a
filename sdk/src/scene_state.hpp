// What ItemsCenter keeps, shared by items_center.cpp, transaction.cpp and undo_redo.cpp.
#pragma once

#include "item_mutator.hpp"

#include <jet/catalog.hpp>
#include <jet/item_type.hpp>
#include <jet/scene.hpp>

#include <unordered_map>
#include <unordered_set>

namespace jet {

/// The id of every scene's top group; no other item has it.
inline constexpr ItemId kRootId{~std::uint64_t{0}};
/// Ids are exact as numbers of JSON and of scripts, too.
inline constexpr std::uint64_t kMaximumId = (std::uint64_t{1} << 53) - 1;
/// Items nested deeper are refused, in files and in transactions alike, so that what was made can be saved and read.
inline constexpr std::size_t kMaximumDepth = 1000;

struct OpenTransaction {
    std::uint64_t serial = 0;
    std::string label;
    std::vector<Change> changes;
    std::vector<ItemId> selectionBefore;
    std::uint64_t nextIdBefore = 0;
};

struct ItemsCenter::Private {
    Private(Scene& s, EventsCenter& e, Catalog& c);

    Scene& scene;
    EventsCenter& events;
    Catalog& catalog;
    std::unique_ptr<Item> root;
    std::unordered_map<std::uint64_t, Item*> byId;
    std::uint64_t nextId = 1;
    std::unordered_set<std::uint64_t> selected;
    mutable std::vector<ItemId>
        ordered;  // the same in the order selected; what was removed since leaves it when asked for
    std::uint64_t serial = 0;
    std::optional<OpenTransaction> open;

    Item& get(ItemId id);
    /// Is it this very item of this scene's tree?
    bool owns(const Item& item) const;
    /// Throws Failure for an item of another scene or one that was removed; the second one for the top group, too.
    void own(const Item& item) const;
    void ownChangeable(const Item& item) const;
    void enlist(Item& subtree);
    void delist(const Item& subtree);

    /// Makes the change (again), or takes it back. Both directions use stored values only.
    void apply(Change& change);
    /// Makes the change and records it in the open transaction.
    void make(Change change);
    void revert(Change& change);
    void revertAll();
    /// Takes back the open transaction's changes after the first `count`.
    void revertTo(std::size_t count);
    /// Where a call that makes several changes began, to take them back when it fails half-way.
    class Savepoint {
    public:
        explicit Savepoint(Private& d)
            : d_(d), changes_(d.open->changes.size()), nextId_(d.nextId), selection_(d.selection())
        {
        }
        void restore() const
        {
            d_.revertTo(changes_);
            d_.nextId = nextId_;
            d_.setSelection(selection_);
            d_.notifyTouched();
        }

    private:
        Private& d_;
        std::size_t changes_;
        std::uint64_t nextId_;
        std::vector<ItemId> selection_;
    };

    void insert(ItemId parent, std::size_t index, std::unique_ptr<Item> item);
    std::unique_ptr<Item> take(ItemId id);

    const std::vector<ItemId>& selection() const;
    void setSelection(std::vector<ItemId> items);
    void notifyTouched();
    void notifyChanged(std::span<const Change> changes, ItemsChanged::Cause cause);
};

struct UndoStep {
    std::string label, mergeKey;
    std::vector<Change> changes;
    std::vector<ItemId> selectionBefore, selectionAfter;
};

struct UndoRedoCenter::Private {
    ItemsCenter* items = nullptr;
    std::vector<UndoStep> steps;
    std::size_t done = 0;
    std::ptrdiff_t clean = 0;  // number of done steps at the saved state; -1: unreachable

    void push(UndoStep step);
};

/// The item type's table, from the SDK or a plugin; null when its plugin is absent.
const PropertyTable* itemTable(Catalog& catalog, std::string_view type);
const ItemType* itemTypeOf(Catalog& catalog, std::string_view type);

}  // namespace jet
