#include "pairs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace jet::physics {

namespace {

constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
constexpr std::size_t kCellsPerPart = 8;
constexpr std::size_t kSortedABlock = 256;  // parts
constexpr std::size_t kFewMembers = 8;      // a class of no more has no cells
constexpr std::size_t kFewMoved = 32;       // boxes: as long as no more have moved, the cells stay as they are

}  // namespace

std::size_t KeySet::slotOf(std::uint64_t key) const
{
    std::uint64_t h = key * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 32;
    return h & (slots_.size() - 1);
}

bool KeySet::insert(std::uint64_t key)
{
    if (3 * (count_ + 1) > 2 * slots_.size()) grow();
    std::size_t at = slotOf(key);
    for (; slots_[at] != kEmpty; at = (at + 1) & (slots_.size() - 1))
        if (slots_[at] == key) return false;
    slots_[at] = key;
    ++count_;
    return true;
}

bool KeySet::contains(std::uint64_t key) const
{
    if (count_ == 0) return false;
    for (std::size_t at = slotOf(key); slots_[at] != kEmpty; at = (at + 1) & (slots_.size() - 1))
        if (slots_[at] == key) return true;
    return false;
}

void KeySet::erase(std::uint64_t key)
{
    if (slots_.empty()) return;
    const std::size_t last = slots_.size() - 1;
    std::size_t at = slotOf(key);
    for (; slots_[at] != key; at = (at + 1) & last)
        if (slots_[at] == kEmpty) return;
    // Moves back what was pushed on by the key that goes.
    for (std::size_t next = (at + 1) & last; slots_[next] != kEmpty; next = (next + 1) & last) {
        const std::size_t home = slotOf(slots_[next]);
        if (((next - home) & last) < ((next - at) & last)) continue;
        slots_[at] = slots_[next];
        at = next;
    }
    slots_[at] = kEmpty;
    --count_;
}

void KeySet::clear()
{
    std::fill(slots_.begin(), slots_.end(), kEmpty);
    count_ = 0;
}

void KeySet::grow()
{
    std::vector<std::uint64_t> old;
    old.swap(slots_);
    slots_.assign(std::max<std::size_t>(64, 2 * old.size()), kEmpty);
    for (std::uint64_t key : old) {
        if (key == kEmpty) continue;
        std::size_t at = slotOf(key);
        while (slots_[at] != kEmpty) at = (at + 1) & (slots_.size() - 1);
        slots_[at] = key;
    }
}

void PairSweep::Sides::lay(std::span<float> room)
{
    const std::size_t each = room.size() / 4;
    minX = room.first(each), minY = room.subspan(each, each), maxX = room.subspan(2 * each, each);
    maxY = room.last(each);
    for (auto* list : {&minX, &minY, &maxX, &maxY})
        std::fill(list->end() - Sieve::kPairs, list->end(), std::numeric_limits<float>::infinity());
}

void PairSweep::resize(std::size_t parts, float typical)
{
    if (typical_ != typical) std::fill(classes_.begin(), classes_.end(), kNoClass);
    typical_ = typical;
    filled_ = false;
    if (boxes_.size() == parts) return;
    boxes_.resize(parts, kNowhere), moved_.resize(parts, 0);
    if (!pieceOf_.empty()) pieceOf_.resize(parts, 0);
    classes_.resize(parts, kNoClass), buckets_.resize(parts), sorted_.resize(parts);
    shift_ = 64 - std::max(1, static_cast<int>(std::bit_width(parts)));
    reaches_.resize(parts, 0), sortedReaches_.resize(parts + Sieve::kPairs);
    room_.resize(Sides::roomFor(parts));
    now_.lay(room_);
}

void PairSweep::setLong(Index part, bool isLong)
{
    if (!isLong) {
        const Index piece = pieceOf(part);
        if (piece == 0) return;
        pieces_[piece].swap(pieces_.back()), long_[piece] = long_.back();
        pieceOf_[long_[piece]] = piece, pieceOf_[part] = 0;
        pieces_.pop_back(), long_.pop_back();
        return;
    }
    pieceOf_.resize(boxes_.size(), 0);
    if (pieceOf_[part] != 0) return;
    pieceOf_[part] = static_cast<Index>(pieces_.size());
    pieces_.emplace_back();
    long_.push_back(part);
}

bool PairSweep::meetsPieces(Index part, const FatBox& box) const
{
    const auto& pieces = pieces_[pieceOf_[part]];
    return std::any_of(pieces.begin(), pieces.end(), [&](const FatBox& piece) { return piece.meets(box); });
}

std::uint8_t PairSweep::classOf(const FatBox& box) const
{
    if (box.maxX < box.minX) return kAbsent;
    const float extent = 1.001F * std::max(box.maxX - box.minX, box.maxY - box.minY);
    int which = 0;
    while (which < kLast && !(extent <= cellSize(which))) ++which;
    return static_cast<std::uint8_t>(which);
}

/// Which class each part is of, and how far the classes reach.
void PairSweep::classify(Arena& arena, Pool& pool)
{
    constexpr Extent kNothing{3e38F, 3e38F, -3e38F, -3e38F, 0};
    const auto add = [](Extent& to, const Extent& more) {
        to.minX = std::min(to.minX, more.minX), to.maxX = std::max(to.maxX, more.maxX);
        to.minY = std::min(to.minY, more.minY), to.maxY = std::max(to.maxY, more.maxY);
        to.members += more.members;
    };
    const std::size_t blocks = (parts() + kSortedABlock - 1) / kSortedABlock, mark = arena.mark();
    const std::span<Extent> extents = arena.take<Extent>(blocks * kClasses);
    std::fill(extents.begin(), extents.end(), kNothing);
    pool.run(blocks, [&](std::size_t block) {
        const auto last = static_cast<Index>(std::min(parts(), (block + 1) * kSortedABlock));
        for (auto part = static_cast<Index>(block * kSortedABlock); part < last; ++part) {
            const FatBox& box = boxes_[part];
            if (moved_[part] != 0 || classes_[part] == kNoClass) classes_[part] = classOf(box);
            if (classes_[part] != kAbsent)
                add(extents[block * kClasses + classes_[part]], {box.minX, box.minY, box.minX, box.minY, 1});
        }
    });
    for (int which = 0; which < kClasses; ++which) {
        Extent& all = grids_[which].extent = kNothing;
        for (std::size_t block = 0; block < blocks; ++block)
            add(all, extents[block * kClasses + static_cast<std::size_t>(which)]);
    }
    arena.release(mark);
}

/// Which buckets there are: those of the tables, those of hashed cells, one of the last class, one of what is nowhere.
void PairSweep::layOut(Arena& arena, Pool& pool)
{
    classify(arena, pool);
    hashed_ = 0;
    bool anyHashed = false;
    for (int which = 0; which < kClasses; ++which) {
        Grid& grid = grids_[which];
        grid.kind = Grid::Kind::None;
        if (which == kLast || grid.extent.members <= kFewMembers) continue;
        const Extent& extent = grid.extent;
        grid.perRow = 1 / cellSize(which), grid.perColumn = kColumnsPerCell * grid.perRow;
        const double rows = std::floor((static_cast<double>(extent.maxY) - extent.minY) * grid.perRow) + 1;
        const double columns = std::floor((static_cast<double>(extent.maxX) - extent.minX) * grid.perColumn) + 1;
        const std::size_t most = kCellsPerPart * extent.members + 64;
        const bool table = rows * columns <= static_cast<double>(most);
        grid.kind = table ? Grid::Kind::Table : Grid::Kind::Hashed;
        anyHashed |= !table;
        if (!table) continue;
        grid.rows = static_cast<std::size_t>(rows), grid.columns = static_cast<std::size_t>(columns);
        grid.first = hashed_;
        hashed_ += grid.rows * grid.columns;
    }
    begin_.assign(hashed_ + (anyHashed ? std::size_t{1} << (64 - shift_) : 0) + 3, Index{0});
}

std::size_t PairSweep::bucketOf(Index part) const
{
    const int which = classes_[part];
    if (which == kAbsent) return lastBucket() + 1;
    const Grid& grid = grids_[which];
    if (grid.kind == Grid::Kind::Table)
        return grid.first + grid.row(boxes_[part].minY) * grid.columns + grid.column(boxes_[part].minX);
    return grid.kind == Grid::Kind::Hashed ? hashOf(cellOf(part)) : lastBucket();
}

/// By buckets, and by index within them: counted, then placed.
void PairSweep::sort(Arena& arena, Pool& pool)
{
    layOut(arena, pool);
    pool.ranges(parts(), kSortedABlock, [&](std::size_t first, std::size_t last) {
        for (auto part = static_cast<Index>(first); part < last; ++part)
            buckets_[part] = static_cast<Index>(bucketOf(part));
    });
    for (const Index bucket : buckets_) ++begin_[bucket];
    Index before = 0;
    for (Index& begin : begin_) begin = before += begin;  // where each ends
    for (auto part = static_cast<Index>(boxes_.size()); part-- > 0;) sorted_[--begin_[buckets_[part]]] = part;
    pool.ranges(parts(), kSortedABlock, [&](std::size_t first, std::size_t last) {
        for (auto at = static_cast<Index>(first); at < last; ++at) {
            sortedReaches_[at] = reaches_[sorted_[at]];
            setSlot(at, sorted_[at]);
        }
    });
    filled_ = true;
}

void PairSweep::setSlot(std::size_t slot, Index part)
{
    now_.set(slot, boxes_[part]);
    // Of what lies in pieces it is not known which of them met.
    then_.set(slot, pieceOf(part) != 0 ? kNowhere : moved_[part] != 0 ? before_[part] : boxes_[part]);
}

std::size_t PairSweep::slotOf(Index part) const
{
    std::size_t slot = begin_[buckets_[part]];
    while (sorted_[slot] != part) ++slot;
    return slot;
}

/// Where few boxes have moved since the cells were filled, only these are brought up to date. False: they are not few.
bool PairSweep::retouch()
{
    if (!filled_) return false;
    Index moved[kFewMoved];
    std::size_t count = 0, boxes = 0;
    for (Index part = 0; part < moved_.size(); ++part) {
        if (moved_[part] == 0) continue;
        boxes += pieceOf(part) == 0 ? 1 : pieces_[pieceOf_[part]].size();
        if (boxes > kFewMoved || count == kFewMoved) return false;
        moved[count++] = part;
    }
    std::copy(now_.minX.begin(), now_.minX.end(), then_.minX.begin());
    std::copy(now_.minY.begin(), now_.minY.end(), then_.minY.begin());
    std::copy(now_.maxX.begin(), now_.maxX.end(), then_.maxX.begin());
    std::copy(now_.maxY.begin(), now_.maxY.end(), then_.maxY.begin());
    for (std::size_t i = 1; i < long_.size(); ++i) setSlot(slotOf(long_[i]), long_[i]);
    for (std::size_t i = 0; i < count; ++i) {
        setSlot(slotOf(moved[i]), moved[i]);
        classes_[moved[i]] = kNoClass;  // when the cells are filled next
    }
    return true;
}

void PairSweep::begin(Arena& arena, Pool& pool)
{
    mark_ = arena.mark();
    then_.lay(arena.take<float>(Sides::roomFor(parts())));
    retouched_ = retouch();
    if (!retouched_) sort(arena, pool);
}

void PairSweep::finish(Arena& arena)
{
    arena.release(mark_);
    std::fill(moved_.begin(), moved_.end(), std::uint8_t{0});
    anyMoved_ = false;
}

/// How many stretches of cells are to be looked through for the box.
std::uint64_t PairSweep::stretchesOf(const FatBox& box) const
{
    std::uint64_t count = 0;
    for (int which = 0; which < kLast; ++which) {
        const Grid& grid = grids_[which];
        if (grid.kind == Grid::Kind::Table) count += grid.row(box.maxY) - grid.row(box.minY - cellSize(which)) + 1;
        if (grid.kind != Grid::Kind::Hashed) continue;
        const Lines l = hashedLines(box, which);
        count += (l.bottom - l.top + 1) * (l.right - l.left + 1);
    }
    return count;
}

std::size_t PairSweep::bytes() const
{
    return boxes_.capacity() * (sizeof(FatBox) + 3 * sizeof(Index) + 2 * sizeof(float) + 2) +
           room_.capacity() * sizeof(float) + begin_.capacity() * sizeof(Index);
}

}  // namespace jet::physics
