#include "spatial_index.hpp"

#include "item_mutator.hpp"

#include <jet/items_center.hpp>

#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost.Geometry includes some
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>

namespace jet {

namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using Point = bg::model::point<double, 2, bg::cs::cartesian>;
using Rectangle = bg::model::box<Point>;

constexpr std::uint32_t kNone = ~0U;
constexpr std::size_t kSettled = 256;         // items brought into the tree after an edit
constexpr std::size_t kAlwaysAllowed = 4096;  // waiting or void entries that are no reason to pack

/// What the tree holds: good while the slot has this very stamp.
struct Entry {
    Rectangle box;
    std::uint32_t slot, stamp;
};
struct BoxOf {
    using result_type = const Rectangle&;
    result_type operator()(const Entry& entry) const { return entry.box; }
};
using Tree = bgi::rtree<Entry, bgi::quadratic<16>, BoxOf>;

/// One an item, for as long as the index knows it.
struct Slot {
    Item* item = nullptr;
    Box box;                        // as known; of an item that waits, good if not stale
    std::uint32_t stamp = 0;        // grows whenever what the tree says of it becomes void
    std::uint32_t waiting = kNone;  // its place in the list of those that wait; none: it is in the tree
};

struct Waiting {
    Box box;
    std::uint32_t slot;
    bool stale;  // the box has to be looked at again
};

Rectangle rectangleOf(const Box& box) { return {Point(box.min.x(), box.min.y()), Point(box.max.x(), box.max.y())}; }

double extentOf(const Box& box) { return std::max(box.width(), box.height()); }

/// Bounds of the item's own path; Item::bounds() of a leaf is that and cached.
Box pathBounds(const Item& item) { return item.children().empty() ? item.bounds() : item.path().bounds(); }

}  // namespace

struct SpatialIndex::Private {
    Tree tree;
    std::vector<Slot> slots;
    std::vector<std::uint32_t> freeSlots;
    std::vector<Waiting> waiting;
    std::vector<std::uint32_t> stale;  // slots whose waiting box has to be looked at again
    std::size_t count = 0;             // items known
    std::size_t inTree = 0, voided = 0;
    double largest = 0;  // the longest side in the tree: longer ones wait for good, so that queries of painted areas,
                         // which reach a quarter of a side beyond, need not look far
    std::size_t large = 0;

    void wait(std::uint32_t slot)
    {
        Slot& s = slots[slot];
        if (s.waiting == kNone) {
            s.waiting = static_cast<std::uint32_t>(waiting.size());
            waiting.push_back({{}, slot, false});
        }
        Waiting& w = waiting[s.waiting];
        if (w.stale) return;
        w.stale = true;
        stale.push_back(slot);
    }

    void leaveTree(Slot& s)
    {
        if (s.waiting != kNone) return;
        ++s.stamp;
        --inTree;
        ++voided;
    }

    void dropWaiting(std::uint32_t place)
    {
        slots[waiting[place].slot].waiting = kNone;
        if (place + 1 != waiting.size()) {
            waiting[place] = waiting.back();
            slots[waiting[place].slot].waiting = place;
        }
        waiting.pop_back();
    }

    void lookAtStale()
    {
        for (const std::uint32_t slot : stale) {
            Slot& s = slots[slot];
            if (!s.item || s.waiting == kNone || !waiting[s.waiting].stale) continue;
            Waiting& w = waiting[s.waiting];
            w.box = s.box = pathBounds(*s.item);
            w.stale = false;
            if (s.box.isNull()) dropWaiting(s.waiting);  // a group: nowhere, until it gets a path
        }
        stale.clear();
    }

    /// Packs the tree of all items but the largest few.
    void pack()
    {
        lookAtStale();
        std::vector<double> extents;
        extents.reserve(count);
        for (const Slot& s : slots)
            if (s.item && !s.box.isNull()) extents.push_back(extentOf(s.box));
        largest = 0;
        if (!extents.empty()) {
            const auto most = extents.begin() + static_cast<std::ptrdiff_t>(extents.size() * 19 / 20);
            std::nth_element(extents.begin(), most, extents.end());
            largest = 2 * *most;
        }
        waiting = {};
        std::vector<Entry> entries;
        entries.reserve(count);
        for (std::uint32_t i = 0; i < slots.size(); ++i) {
            Slot& s = slots[i];
            if (!s.item || s.box.isNull()) continue;
            s.waiting = kNone;
            if (extentOf(s.box) > largest) {
                s.waiting = static_cast<std::uint32_t>(waiting.size());
                waiting.push_back({s.box, i, false});
            } else {
                entries.push_back({rectangleOf(s.box), i, s.stamp});
            }
        }
        large = waiting.size();
        inTree = entries.size();
        voided = 0;
        tree = Tree(entries.begin(), entries.end());
    }

    bool isWorthPacking() const
    {
        const std::size_t loose = waiting.size() - std::min(large, waiting.size());
        return std::max(loose, voided) > std::max(kAlwaysAllowed, count / 2);
    }
};

SpatialIndex::SpatialIndex() : d_(std::make_unique<Private>()) {}
SpatialIndex::~SpatialIndex() = default;

void SpatialIndex::add(Item& item)
{
    std::uint32_t slot = static_cast<std::uint32_t>(d_->slots.size());
    if (d_->freeSlots.empty()) {
        d_->slots.emplace_back();
    } else {
        slot = d_->freeSlots.back();
        d_->freeSlots.pop_back();
    }
    d_->slots[slot].item = &item;
    Item::Mutator::slot(item) = slot;
    ++d_->count;
    d_->wait(slot);
}

void SpatialIndex::remove(Item& item)
{
    const std::uint32_t slot = std::exchange(Item::Mutator::slot(item), kNone);
    if (slot == kNone) return;
    Slot& s = d_->slots[slot];
    d_->leaveTree(s);
    if (s.waiting != kNone) d_->dropWaiting(s.waiting);
    s.item = nullptr;
    d_->freeSlots.push_back(slot);
    --d_->count;
}

void SpatialIndex::changed(Item& item)
{
    const std::uint32_t slot = Item::Mutator::slot(item);
    if (slot == kNone) return;
    d_->leaveTree(d_->slots[slot]);
    d_->wait(slot);
}

void SpatialIndex::settle()
{
    d_->lookAtStale();
    std::size_t place = d_->waiting.size();
    for (std::size_t tries = 0; place > 0 && tries < kSettled; ++tries) {
        const auto at = static_cast<std::uint32_t>(--place);
        const Waiting w = d_->waiting[at];
        if (extentOf(w.box) > d_->largest) continue;
        d_->tree.insert(Entry{rectangleOf(w.box), w.slot, d_->slots[w.slot].stamp});
        d_->dropWaiting(at);
        ++d_->inTree;
    }
}

void SpatialIndex::clear() { d_ = std::make_unique<Private>(); }

std::size_t SpatialIndex::size() const { return d_->count; }

void SpatialIndex::query(const Box& box, bool painted, std::vector<const Item*>& found)
{
    if (box.isNull()) return;
    d_->lookAtStale();
    if (d_->isWorthPacking()) d_->pack();
    const auto meets = [&](const Box& bounds) {
        return !bounds.isNull() && box.intersects(painted ? paintedArea(bounds) : bounds);
    };
    const Box reach =
        painted ? box.inflated(paintedArea(Box({0, 0}, {d_->largest, d_->largest})).max.x() - d_->largest) : box;
    const auto take = [&](const Entry& entry) {
        const Slot& s = d_->slots[entry.slot];
        if (s.stamp == entry.stamp && s.item && s.waiting == kNone && meets(s.box)) found.push_back(s.item);
    };
    d_->tree.query(bgi::intersects(rectangleOf(reach)), boost::make_function_output_iterator(take));
    for (const Waiting& w : d_->waiting)
        if (meets(w.box)) found.push_back(d_->slots[w.slot].item);
}

}  // namespace jet
