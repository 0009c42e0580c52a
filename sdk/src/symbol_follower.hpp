// One following: what was changed in instances goes into their symbols, and from there into all instances.
#pragma once

#include "symbol_links.hpp"

#include <set>
#include <string>
#include <unordered_set>

namespace jet {

/// What was changed of an item itself.
struct ChangedFields {
    bool path = false, type = false, effects = false, link = false;
    std::set<std::string> properties;  ///< also "name", "visible" and "locked"
};

class ItemsCenter::Private::Links::Follower {
public:
    Follower(Links& links, const Followed& now) : links_(links), d_(links.d_), now_(now), content_(links.content()) {}
    void run();
    /// Makes sure of all instances that changes after the first `count` had to do with.
    void mend(std::size_t count);
    /// Makes the symbol's members from those of a group that has just become its first instance.
    static void fill(Links& links, const Item& group, const Item& symbol);

private:
    /// How a symbol differs from what its instances have.
    struct Difference {
        bool structure = false;
        std::set<std::uint64_t> items;  // of the symbol
    };
    /// An instance and its counterparts of the symbol's items.
    struct Receiver {
        ItemId instance;
        ItemPairs pairs;
    };
    /// Two trees of members, and who is whose counterpart in them.
    struct Alignment {
        ItemPairs& pairs;
        const Affine& placement;
        std::vector<std::pair<ItemId, ItemId>> made = {};
        std::unordered_set<std::uint64_t> gone = {};  // members whose counterparts another instance removed
    };

    void collectFields();
    void follow(const Base& base);
    std::vector<Receiver> receivers(const Base& base) const;
    Difference directly(const Item& symbol) const;
    void takeIn(const Pending& pending, ItemPairs& toSymbol, Difference& difference);
    void takeLinks(const Item& holder, const ItemPairs& toSymbol, Difference& difference, bool ofNewInstances);
    void takeContainers(const Item& holder, const ItemPairs& toSymbol, Difference& difference);
    void takeStructure(const Pending& pending, const Item& holder, const Item& symbol, ItemPairs& toSymbol,
                       Difference& difference);
    void takeFields(const Item& holder, const ItemPairs& toSymbol, Difference& difference);
    void giveOut(const Item& symbol, Receiver& receiver, const Difference& difference);

    std::set<ItemId> concerned(std::size_t count) const;
    void mendInstancesOf(ItemId symbol);
    bool isExact(const Item& symbol, const Item& instance) const;
    void alignMembers(const Item& from, const Item& to, Alignment& alignment);
    void alignAll(const Item& from, const Item& to, Alignment& alignment);
    void finish(const Alignment& alignment, const ItemPairs& pairs);
    void removeOthers(const Item& holder, const ItemPairs& pairs);
    const Item* counterpartOf(const Item& item, const ItemPairs& pairs, const Item& holder) const;
    const Item& make(const Item& from, const Item& parent, std::size_t index, Alignment& alignment);

    void syncFields(const Item& from, const Item& to, const ItemPairs& pairs, const Affine& placement);
    void syncProperties(const Item& from, const Item& to, const ItemPairs& pairs);
    void syncProperty(const Item& from, const Item& to, const std::string& property, const ItemPairs& pairs);
    void syncPath(const Item& to, Path path);
    void syncType(const Item& from, const Item& to);
    void syncEffects(const Item& from, const Item& to, const ItemPairs& pairs);
    void syncLink(const Item& from, const Item& to, const Affine& placement);

    Links& links_;
    Private& d_;
    const Followed& now_;
    InstanceContent content_;
    std::unordered_map<std::uint64_t, ChangedFields> fields_;
    std::unordered_set<std::uint64_t> fresh_;  // of the symbol, made or unlinked for an instance: without members yet
};

/// Tells `pair(item, counterpart)` for all members of an instance, given the outline its symbol had.
template <class Pair>
void pairMembers(const Item& container, ItemId counterpart, const ItemOutline& outline, Pair&& pair)
{
    const auto found = outline.find(counterpart.value);
    if (found == outline.end()) return;
    const std::size_t count = std::min(container.children().size(), found->second.size());
    for (std::size_t i = 0; i < count; ++i) {
        const Item& child = *container.children()[i];
        pair(child.id(), found->second[i]);
        if (!isInstance(child)) pairMembers(child, found->second[i], outline, pair);
    }
}

}  // namespace jet
