// SpatialIndex: finds the items of a scene by where their paths are, by an r-tree (Boost.Geometry).
//
// Items that were added or moved since the tree was packed wait in a list beside it, which is searched entry by entry:
// a drag of 10,000 items writes 10,000 boxes a step and leaves the tree alone. What the tree says of an item that waits
// is void. settle() moves a few waiting items into the tree; when more wait, or are void, than the tree is worth, it is
// packed anew. The alternative, removing and inserting each item at each step, costs some 3 µs an item.
#pragma once

#include <jet/item.hpp>

#include <memory>
#include <vector>

namespace jet {

class SpatialIndex {
public:
    SpatialIndex();
    ~SpatialIndex();
    SpatialIndex(const SpatialIndex&) = delete;
    SpatialIndex& operator=(const SpatialIndex&) = delete;

    /// An item entered the tree of items, left it, or got another path. Their boxes are looked at when asked for.
    void add(Item& item);
    void remove(Item& item);
    void changed(Item& item);
    /// After an edit: brings a bounded number of waiting items into the tree.
    void settle();
    /// Forgets everything; all items will be added again.
    void clear();

    /// Appends the items with a path whose bounds, grown to their painted area if `painted`, meet `box`; in no order.
    void query(const Box& box, bool painted, std::vector<const Item*>& found);
    /// Items known.
    std::size_t size() const;

private:
    struct Private;
    std::unique_ptr<Private> d_;
};

}  // namespace jet
