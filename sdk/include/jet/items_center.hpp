// ItemsCenter: the only way to change a scene (SPEC EN4). A change happens inside a transaction:
//
//   auto edit = items.begin("Create rectangle");
//   const Item& shape = edit.add<ShapeItem>(parent, Path::rectangle(box));
//   edit.addEffect(shape, "polygon-face", {{"color", green}});
//   edit.commit();                     // leaving without commit, or by an exception, restores everything
//
// Grammar: begin · (add | remove | set… | select)* · (commit | rollback); restart() goes back to just after begin, for
// drags. All of it belongs to the thread that owns the scene.
//
// Transactions nest: begin() while one is open opens an inner one, a savepoint of the outer. Its rollback takes back
// its own part only, its commit hands that part to the outer one; the outermost commit makes the one undo step. While
// an inner transaction is open, the outer ones can only be rolled back, and the inner one with them.
//
// Events are sent when the outermost transaction has ended, never inside it; only SceneTouched and SelectionChanged
// also tell of an open one, at the owner's next dispatchQueued(), between the calls of who makes it.
#pragma once

#include <jet/change.hpp>
#include <jet/events.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jet {

class Catalog;
class ItemsCenter;
class Scene;
class UndoRedoCenter;

/// Sent by the Scene after commit, undo and redo.
struct ItemsChanged {
    static constexpr EventType type{"org.jet.items-changed"};
    enum class Cause { Commit, Undo, Redo };
    const Scene* scene;
    std::span<const Change> changes;  ///< in the order made; for Undo they have been reverted
    Cause cause;

    /// What subscribeCoalesced() delivers.
    struct JET_API Burst {
        const Scene* scene = nullptr;
        std::vector<ItemId> items;  ///< what was changed, added, removed or moved, each once, by id
        bool tree = false;          ///< items were added, removed or moved
        bool settings = false;      ///< settings or materials were changed
        void add(const ItemsChanged& event);
    };
};
/// Sent by the Scene when it looks different: after commit, rollback, undo and redo, before ItemsChanged; and while a
/// transaction is open at each dispatchQueued() that finds it changed since, once however much was changed.
struct SceneTouched {
    static constexpr EventType type{"org.jet.scene-touched"};
    const Scene* scene;
};
/// Sent by the Scene when its history changed: steps, position or the saved state.
struct HistoryChanged {
    static constexpr EventType type{"org.jet.history-changed"};
    const Scene* scene;
};
/// Sent by the Scene when its selection changed. Inside a transaction as SceneTouched is.
struct SelectionChanged {
    static constexpr EventType type{"org.jet.selection-changed"};
    const Scene* scene;
};

/// An open change of a scene. Methods throw Failure for what cannot be done (unknown property, value out of range, NaN
/// in a path, moving a group into itself); the scene is then as before that call.
class JET_API Transaction {
public:
    Transaction(Transaction&& other) noexcept;
    Transaction& operator=(Transaction&&) = delete;
    ~Transaction();  ///< rolls back if still open

    /// A new item at the end of `parent` (or before `index`), with all properties of its type at their defaults.
    const Item& add(std::string_view type, const Item& parent, Path path = {}, std::optional<std::size_t> index = {});
    template <class Kind>
    const Item& add(const Item& parent, Path path = {})
    {
        return add(Kind::type, parent, std::move(path));
    }
    /// Deep copy of `source` (of any scene): names, structure and effects; new ids.
    const Item& addCopy(const Item& source, const Item& parent, std::optional<std::size_t> index = {});
    void remove(const Item& item);
    /// Puts `item` before `index` among newParent's children (counted without the item itself).
    void move(const Item& item, const Item& newParent, std::size_t index);

    /// A property of the item's type, or "name", "visible", "locked". A None value resets to the default.
    void set(const Item& item, std::string_view property, Value value);
    void setPath(const Item& item, Path path);
    /// Transforms the item's path and those of all its descendants.
    void transform(const Item& item, const Affine& m);
    /// Transforms only the given segments of the item's own path.
    void transform(const Item& item, const Affine& m, std::span<const std::size_t> segments);
    /// Turns e.g. a shape into a body. Properties the new type does not declare are dropped, its own get their
    /// defaults.
    void setType(const Item& item, std::string_view type);

    /// Appends an effect with all its properties stored (given ones, else defaults); returns its index.
    std::size_t addEffect(const Item& item, std::string_view effect, Properties properties = {});
    void removeEffect(const Item& item, std::size_t index);
    void moveEffect(const Item& item, std::size_t from, std::size_t to);
    /// A property of the effect, or "visible".
    void setEffect(const Item& item, std::size_t index, std::string_view property, Value value);

    void setScene(std::string_view property, Value value);
    void setMaterials(MaterialTable materials);

    void select(const Item& item);
    void setSelection(std::vector<ItemId> items);

    /// Makes it one undo step. With a merge key, joins the previous step if that has the same key and nothing came
    /// between (a slider drag, arrow-key nudges). Without any change no step is made. An inner transaction's key is not
    /// used: the outer one's counts.
    void commit(std::string_view mergeKey = {});
    void rollback();
    /// Back to the state just after begin(), still open: a drag re-applies its whole movement each time, without drift.
    void restart();
    bool isOpen() const;
    /// Has anything been recorded?
    bool isEmpty() const;

private:
    friend class ItemsCenter;
    Transaction(ItemsCenter& center, std::uint64_t serial) : center_(&center), serial_(serial) {}
    ItemsCenter& open() const;  ///< throws Failure when no longer open
    ItemsCenter* center_;
    std::uint64_t serial_;  ///< tells this transaction from a later one after abandon()
};

/// The tree and the selection of one scene. Lives in a Scene.
class JET_API ItemsCenter {
public:
    ItemsCenter(Scene& scene, EventsCenter& events, Catalog& catalog);
    ~ItemsCenter();
    ItemsCenter(const ItemsCenter&) = delete;
    ItemsCenter& operator=(const ItemsCenter&) = delete;

    /// Opens a transaction; inside of the open one, if there is one.
    [[nodiscard]] Transaction begin(std::string_view label);
    bool inTransaction() const;
    /// Label of the outermost open transaction; empty if none.
    std::string transactionLabel() const;
    /// Rolls all open transactions back, whoever holds them: for the guard, after a plugin failed half-way.
    void abandon();

    /// The scene's implicit top group (thesis §3.4.1); never removed, not shown in the Layers panel.
    const Item& root() const;
    /// Null when there is no such item in the tree now.
    const Item* find(ItemId id) const;
    std::size_t itemCount() const;

    /// In the order selected; ids of items that are in the tree.
    const std::vector<ItemId>& selection() const;
    bool isSelected(ItemId id) const;
    /// Changes the selection without an undo step. Ids not in the tree are left out.
    void setSelection(std::vector<ItemId> items);

    /// The top-most shown, unlocked item (not a group) whose path is within `distance` (scene units) of `p` or, being
    /// closed, contains it. Null if none.
    const Item* itemAt(const Vec2& p, double distance) const;
    /// Shown, unlocked items (not groups) whose bounds lie in `box`, bottom first.
    std::vector<const Item*> itemsIn(const Box& box) const;
    /// Shown items with a path whose painting may reach into `area`, bottom first: for culling. Strokes reach beyond
    /// the path's own bounds: see paintedArea().
    std::vector<const Item*> query(const Box& area) const;

private:
    friend class Transaction;
    friend class UndoRedoCenter;
    friend class Scene;
    friend class SceneBuilder;
    struct Private;
    std::unique_ptr<Private> d_;
};

/// The area the painting of an item may reach, given the bounds of its path: a quarter of its size and 32 units beyond.
JET_API Box paintedArea(const Box& bounds);

/// Undo and redo of one scene (SPEC EN5). Steps hold data only, no pointer into any plugin. When they take more memory
/// than allowed, the oldest are forgotten; the last one is always kept.
class JET_API UndoRedoCenter {
public:
    explicit UndoRedoCenter(ItemsCenter& items);
    ~UndoRedoCenter();

    bool canUndo() const;
    bool canRedo() const;
    /// Label of the step undo() (redo()) would take; empty if none.
    std::string undoLabel() const;
    std::string redoLabel() const;
    /// No-ops when there is nothing to do; throw Failure inside an open transaction.
    void undo();
    void redo();
    void clear();

    /// Steps that are kept, done or undone; how many of them are done; all labels, oldest first: for the History panel.
    std::size_t size() const;
    std::size_t position() const;
    const std::string& label(std::size_t step) const;
    std::vector<std::string> labels() const;
    /// Undoes or redoes until `position` steps are done.
    void goTo(std::size_t position);

    /// Marks the present state as saved; isClean() tells whether we are at that state again.
    void markClean();
    bool isClean() const;
    /// Number of done steps at the saved state; none when it cannot be reached any more.
    std::optional<std::size_t> cleanPosition() const;

    static constexpr std::size_t kDefaultMemoryLimit = std::size_t{256} << 20;
    /// Memory the steps may take and take, in bytes (an estimate).
    void setMemoryLimit(std::size_t bytes);
    std::size_t memoryLimit() const;
    std::size_t memory() const;
    /// Steps forgotten for the lack of memory since the history began.
    std::size_t forgotten() const;

private:
    friend class Transaction;
    ItemsCenter& items() const;
    void take(std::size_t step, ItemsChanged::Cause cause);
    struct Private;
    std::unique_ptr<Private> d_;
};

}  // namespace jet
