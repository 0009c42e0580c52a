// How instances follow their symbols (jet/symbols.hpp).
//
// Between transactions each instance holds the same items as its symbol, with paths mapped by its placement: exactly
// the same, bit by bit, so that files need not store them. While a transaction is open, the instances it changes
// something in differ. Before the first such change it is noted who is whose counterpart (before()); at the commit, or
// before a call that reads what they hold (settle()), the changes are taken into the symbol and from there into all its
// instances (follow()). What that does are changes as any others, recorded in the transaction: undo, events and the
// journal need to know nothing of symbols.
//
// Counterparts are told by their places, so all rests on this: after follow() every instance is exact again, whatever
// contradicted itself (mend()), and what is not pending is as it was then. A call settles before it looks at anything:
// following may change, link or remove the very item it was given.
#pragma once

#include "scene_state.hpp"

#include <functional>
#include <set>

namespace jet {

/// Counterparts: from an item of an instance to that of the symbol, or the other way.
using ItemPairs = std::unordered_map<std::uint64_t, ItemId>;
/// Members by container, as they were at some moment.
using ItemOutline = std::unordered_map<std::uint64_t, std::vector<ItemId>>;

/// Whose members an item added to `container` would be one of: the container itself, or what holds it; null if none.
const Item* holderOfMembers(const Item& container);
/// The path as an instance of that placement has it. The identity keeps the bits.
Path placedPath(const Path& path, const Affine& placement);
/// Of an instance that is a member of a symbol, in an instance of that. The one place where it is computed, so that it
/// is the same bits everywhere; zeros have no sign.
Affine innerPlacement(const Affine& outer, const Item& member);
Affine withoutSignedZeros(Affine placement);
void setLink(Item& item, ItemId symbol, const Affine& placement);
/// References between items lead to the counterparts; others stay.
Value withCounterparts(const Value& value, const ItemPairs& pairs);
/// The same for all references of an item. Without `keepOthers` the others lead nowhere.
void redirectOwnReferences(Item& item, const ItemPairs& pairs, bool keepOthers);
/// Of an item and its members, too.
void redirectReferences(Item& item, const ItemPairs& pairs, bool keepOthers);
/// Lets the references of an item in an instance be what those of the symbol's member become.
void referAs(const Item& member, Item& item, const ItemPairs& pairs);

/// All items an item owns by itself: not those of instances in it, but these instances.
template <class Visit>
void walkMembers(const Item& container, Visit&& visit)
{
    for (const auto& child : container.children()) {
        visit(*child);
        if (!isInstance(*child)) walkMembers(*child, visit);
    }
}

/// Ids of all instances of a symbol, also those in symbols.
const std::set<std::uint64_t>& linkedTo(const Item& symbol);
/// `wanted`, or where it is empty or taken the next free "Symbol 1", "Wheel 2".
std::string freeSymbolName(const Scene& scene, std::string wanted);

/// Makes the items of an instance: for a commit, and for a file that is read.
class InstanceContent {
public:
    /// Where ids come from; how a symbol is found by its id; how many items may be made.
    InstanceContent(std::function<ItemId()> nextId, std::function<const Item*(ItemId)> symbol, std::size_t most)
        : nextId_(std::move(nextId)), symbol_(std::move(symbol)), left_(most)
    {
    }
    /// Copies of the symbol's members, complete.
    std::vector<std::unique_ptr<Item>> of(const Item& symbol, const Affine& placement);
    /// A copy of one member: alone (an instance with its content), or with its members.
    std::unique_ptr<Item> copy(const Item& member, const Affine& placement, ItemPairs& pairs, bool alone);

private:
    std::function<ItemId()> nextId_;
    std::function<const Item*(ItemId)> symbol_;
    std::size_t left_, depth_ = 0;
};

/// More items than this are not made of symbols at once, by a file or a change: nested ones multiply.
inline constexpr std::size_t kMaximumInstanceItems = 2'000'000;

class ItemsCenter::Private::Links {
public:
    explicit Links(Private& d);
    ~Links();
    Links(const Links&) = delete;
    Links& operator=(const Links&) = delete;

    // --- which instances there are

    void enlisted(const Item& item);
    void delisted(const Item& item);
    const std::set<std::uint64_t>& instancesOf(ItemId symbol) const;
    bool hasSymbols() const { return !d_.symbols->children().empty(); }

    // --- during a transaction

    /// Before a change is made: refuses what symbols do not allow, remembers what it is about to touch.
    void before(const Change& change);
    /// Changes after the first `count` were taken back.
    void reverted(std::size_t count);
    void close();
    /// Lets the instances follow; part of the open transaction. Each is then what its symbol makes of it.
    void follow();
    /// At the commit: the same, also for what needed no following.
    void finish();
    /// Lets them follow, if something in that subtree waits for it.
    void settle(const Item& subtree);

    /// Sets a property of a link: of the group's own, or of the symbol's key.
    void set(const Item& item, std::string_view property, const Value& value);
    /// The instance is settled.
    void place(const Item& instance, const Affine& placement);
    /// After a subtree was copied from another scene: leads its instances to this scene's symbols, or brings those.
    void adopt(const Item& source, Item& copy);
    /// Makes an item that is about to be added to the symbols one of them.
    static void nameKey(Item& symbol);

private:
    /// An instance, or a symbol itself, in which something was changed.
    struct Pending {
        ItemId holder, symbol;
        std::size_t firstChange = 0;
        ItemPairs toSymbol;   // as it was before
        ItemOutline outline;  // as it was before
    };
    /// A symbol of such instances, as it was before.
    struct Base {
        ItemId symbol;
        std::size_t firstChange = 0;
        ItemOutline outline;
    };
    struct Followed {
        std::size_t begin = 0, end = 0;  // its changes
        std::vector<Pending> pending;
        std::vector<Base> bases;
    };
    class Follower;

    void touch(const Item* holder);
    const Pending* pendingOf(ItemId holder) const;
    /// Does a symbol show another one, or will it when what is pending is taken in?
    bool reaches(ItemId from, ItemId symbol, const std::vector<Pending>& pending) const;
    void checkEntering(const Item& subtree, const Item& parent) const;
    void checkField(const Item& item, const Change& change) const;
    void relink(const Item& group, ItemId symbol);
    void setPlacementProperties(const Item& instance, const Affine& placement);
    void replaceContent(const Item& instance);
    static void checkDepth(const Item& parent, const Item& subtree);
    /// Keeps the items, if they are those of the symbol.
    void moveContent(const Item& symbol, const Item& instance, const Affine& placement);
    bool isShapedLike(const Item& theirs, const Item& mine) const;
    void moveMembers(const Item& container, const Item& counterpart, const Affine& placement);
    /// The number of changes after which all instances were exact for the last time.
    std::size_t exactAfter() const { return followed_.empty() ? 0 : followed_.back().end; }
    /// Makes sure of all instances that changes after the first `count` had to do with.
    void mend(std::size_t count);
    const Item& symbolFor(const Item& foreign, const Private& other);
    std::unique_ptr<Item> bring(const Item& member, const Private& other, ItemPairs& pairs);
    InstanceContent content();

    Private& d_;
    std::unordered_map<std::uint64_t, std::set<std::uint64_t>> instances_;  // by symbol
    std::vector<Pending> pending_;
    std::unordered_map<std::uint64_t, std::size_t> pendingAt_;  // by holder
    std::vector<Base> bases_;
    std::vector<Followed> followed_;
    bool following_ = false;
};

}  // namespace jet
