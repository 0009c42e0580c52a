// What ItemsCenter keeps, shared by items_center.cpp, transaction.cpp and undo_redo.cpp.
#pragma once

#include "item_mutator.hpp"
#include "open_transactions.hpp"
#include "spatial_index.hpp"
#include "thread_rule.hpp"

#include <jet/catalog.hpp>
#include <jet/item_type.hpp>
#include <jet/scene.hpp>
#include <jet/symbols.hpp>

#include <algorithm>
#include <deque>
#include <unordered_map>
#include <unordered_set>

namespace jet {

/// The id of every scene's top group; no other item has it.
inline constexpr ItemId kRootId{~std::uint64_t{0}};
/// Ids are exact as numbers of JSON and of scripts, too.
inline constexpr std::uint64_t kMaximumId = (std::uint64_t{1} << 53) - 1;
/// Items nested deeper are refused, in files and in transactions alike, so that what was made can be saved and read.
inline constexpr std::size_t kMaximumDepth = 1000;

/// Depth below the top group; what the subtree adds to it.
std::size_t depthOf(const Item& item);
std::size_t heightOf(const Item& item);

/// A selection as it was at some moment; shared by all who remember that moment.
using SelectionPtr = std::shared_ptr<const std::vector<ItemId>>;

/// Items by id. Ids are given in sequence, so most find their item at that place of a vector.
class IdTable {
public:
    Item* find(std::uint64_t id) const
    {
        if (id < dense_.size() && dense_[id]) return dense_[id];
        if (sparse_.empty()) return nullptr;
        const auto found = sparse_.find(id);
        return found == sparse_.end() ? nullptr : found->second;
    }
    void insert(std::uint64_t id, Item* item)
    {
        ++size_;
        if (id >= 4 * size_ + 1024) {
            sparse_.emplace(id, item);
            return;
        }
        if (id >= dense_.size()) dense_.resize(std::max<std::size_t>(id + 1, dense_.size() + dense_.size() / 2));
        dense_[id] = item;
    }
    void erase(std::uint64_t id)
    {
        --size_;
        if (id < dense_.size() && dense_[id]) {
            dense_[id] = nullptr;
        } else {
            sparse_.erase(id);
        }
    }
    std::size_t size() const { return size_; }

private:
    std::vector<Item*> dense_;
    std::unordered_map<std::uint64_t, Item*> sparse_;
    std::size_t size_ = 0;
};

/// A transaction that is open, or one nested in it: a savepoint of its changes.
struct OpenLevel {
    std::uint64_t serial = 0;
    std::string label;
    std::size_t changesBefore = 0;
    SelectionPtr selectionBefore;
    std::uint64_t nextIdBefore = 0;
    OpenMark mark = {};
};

struct UndoStep;

struct ItemsCenter::Private {
    Private(Scene& s, EventsCenter& e, Catalog& c);
    ~Private();

    Scene& scene;
    EventsCenter& events;
    Catalog& catalog;
    const std::thread::id owner;  // of the events, and so of the scene
    std::unique_ptr<Item> root;
    std::unique_ptr<Item> symbols;  // the top of the symbols' own tree (jet/symbols.hpp)
    std::size_t symbolItems = 0;    // in that tree, without the top
    class Links;
    std::unique_ptr<Links> links;  // instances follow their symbols
    IdTable byId;
    std::uint64_t nextId = 1;
    std::unordered_set<std::uint64_t> selected;
    mutable SelectionPtr ordered;         // the same in the order selected
    mutable bool selectionStale = false;  // selected items were removed since: they leave `ordered` when asked for
    std::uint64_t serial = 0;
    std::vector<OpenLevel> levels;  // outermost first; none: no transaction is open
    std::vector<Change> changes;    // of all levels, in the order made

    Item& get(ItemId id);
    /// Is it this very item of this scene's tree?
    bool owns(const Item& item) const;
    /// Throws Failure for an item of another scene or one that was removed; the second one for the top group, too.
    void own(const Item& item) const;
    void ownChangeable(const Item& item) const;
    /// In the tree of symbols it has an id, but no place in the scene.
    void enlist(Item& subtree, bool ofSymbols);
    void delist(const Item& subtree, bool ofSymbols);
    /// Is it in the tree of symbols, or its top?
    bool isOfSymbols(const Item& item) const;

    /// Makes the change (again), or takes it back. Both directions use stored values only.
    void apply(Change& change);
    /// Makes the change and records it in the open transaction.
    void make(Change change);
    void revert(Change& change);
    /// Takes back the open transaction's changes after the first `count`.
    void revertTo(std::size_t count);
    /// Takes back what a level and those in it did; it stays open.
    void revertLevel(std::size_t level);
    /// Closes a level and those in it. Of the outermost: tells of what is pending.
    void closeLevels(std::size_t level);
    /// Where a call that makes several changes began, to take them back when it fails half-way.
    class Savepoint {
    public:
        /// May hold ids of items that were removed before: they are not there when it is restored, either, and asking
        /// for the selection without them at each of many removals would cost the square of their number.
        explicit Savepoint(Private& d) : d_(d), changes_(d.changes.size()), nextId_(d.nextId), selection_(d.ordered) {}
        void restore() const
        {
            d_.revertTo(changes_);
            d_.nextId = nextId_;
            d_.restoreSelection(selection_);
        }

    private:
        Private& d_;
        std::size_t changes_;
        std::uint64_t nextId_;
        SelectionPtr selection_;
    };

    void setPath(Item& item, const Path& path);
    void setProperty(Item& item, const std::string& property, const Value& value);
    void insert(ItemId parent, std::size_t index, std::unique_ptr<Item> item);
    std::unique_ptr<Item> take(ItemId id);
    void moveItem(ItemId from, std::size_t fromIndex, ItemId to, std::size_t toIndex);

    const std::vector<ItemId>& selection() const;
    void setSelection(std::vector<ItemId> items);
    void restoreSelection(const SelectionPtr& before);

    // --- where items are

    SpatialIndex index;
    bool indexed = false;     // the index knows the items; it is made when first asked
    bool orderValid = false;  // every Item::order_ is its place in painting order
    void makeIndex();
    /// Sorts bottom first.
    void sortByOrder(std::vector<const Item*>& items);

    // --- events: kept back while something is under way

    bool touched = false, selectionTouched = false;  // not told yet
    bool scheduled = false;                          // a task is queued that will tell
    int undoing = 0;
    std::shared_ptr<int> alive = std::make_shared<int>();  // lets queued tasks know that this is gone
    void noteTouched();
    void noteSelection();
    void tellLater();
    void tell();
    /// Sends what is pending, then ItemsChanged and HistoryChanged for a step. Steps are told in the order made, each
    /// to all listeners before the next: what a listener does meanwhile is told when it is the turn of that.
    void announce(std::shared_ptr<UndoStep> step, std::size_t firstChange, ItemsChanged::Cause cause);
    struct Announcement {
        std::shared_ptr<UndoStep> step;
        std::size_t firstChange;
        ItemsChanged::Cause cause;
    };
    std::deque<Announcement> announcements;
    bool announcing = false;
};

struct UndoStep {
    std::string label, mergeKey;
    std::vector<Change> changes;
    SelectionPtr selectionBefore, selectionAfter;
    std::size_t bytes = 0;
};

struct UndoRedoCenter::Private {
    ItemsCenter* items = nullptr;
    std::deque<std::shared_ptr<UndoStep>> steps;  // shared with who tells of a step: listeners may make new ones
    std::size_t done = 0;
    std::ptrdiff_t clean = 0;  // number of done steps at the saved state; -1: unreachable
    std::size_t bytes = 0, limit = kDefaultMemoryLimit, forgotten = 0;

    /// Returns the step and the first of its changes that are new.
    std::pair<std::shared_ptr<UndoStep>, std::size_t> push(UndoStep step);
    void merge(UndoStep& step);
    void count(UndoStep& step);
    void forgetOldest();
    void notify() const;
};

/// Memory a subtree takes, in bytes: an estimate.
std::size_t memoryOf(const Item* subtree);

/// The item type's table, from the SDK or a plugin; null when its plugin is absent.
const PropertyTable* itemTable(Catalog& catalog, std::string_view type);
const ItemType* itemTypeOf(Catalog& catalog, std::string_view type);

}  // namespace jet
