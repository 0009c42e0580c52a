#include "pairs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace jet::physics {

namespace {

constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
constexpr std::uint64_t kCellsPerPart = 8;

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

void PairSweep::Sides::resize(std::size_t count)
{
    for (auto* list : {&minX, &minY, &maxX, &maxY}) list->resize(count + 4);
    for (std::size_t k = 0; k < 4; ++k) minX[count + k] = std::numeric_limits<float>::infinity();
}

void PairSweep::resize(std::size_t parts, float typical)
{
    if (typical_ != typical) std::fill(classes_.begin(), classes_.end(), kNoClass);
    typical_ = typical;
    if (boxes_.size() == parts) return;
    boxes_.resize(parts), before_.resize(parts, kNowhere);
    if (moved_.size() < parts) anyMoved_ = true;
    moved_.resize(parts, 1), pieceOf_.resize(parts, 0);
    classes_.resize(parts, kNoClass), buckets_.resize(parts), sorted_.resize(parts);
    shift_ = 64 - std::max(1, static_cast<int>(std::bit_width(parts)));
    reaches_.resize(parts, 0), sortedReaches_.resize(parts + 4);
    now_.resize(parts), then_.resize(parts);
}

void PairSweep::setLong(Index part)
{
    if (pieceOf_[part] != 0) return;
    pieceOf_[part] = static_cast<Index>(pieces_.size());
    pieces_.emplace_back();
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

/// Which buckets there are: those of the tables, those of hashed cells, one of the last class, one of what is nowhere.
void PairSweep::layOut()
{
    for (Grid& grid : grids_) {
        grid.members = 0;
        grid.minX = grid.minY = 3e38F, grid.maxX = grid.maxY = -3e38F;
    }
    for (Index part = 0; part < boxes_.size(); ++part) {
        const FatBox& box = boxes_[part];
        if (moved_[part] != 0 || classes_[part] == kNoClass) classes_[part] = classOf(box);
        if (classes_[part] == kAbsent) continue;
        Grid& grid = grids_[classes_[part]];
        ++grid.members;
        grid.minX = std::min(grid.minX, box.minX), grid.maxX = std::max(grid.maxX, box.minX);
        grid.minY = std::min(grid.minY, box.minY), grid.maxY = std::max(grid.maxY, box.minY);
    }
    hashed_ = 0;
    for (int which = 0; which < kLast; ++which) {
        Grid& grid = grids_[which];
        if (grid.members == 0) continue;
        grid.perRow = 1 / static_cast<double>(cellSize(which)), grid.perColumn = kColumnsPerCell * grid.perRow;
        grid.row = lineOf(grid.minY, grid.perRow), grid.lastRow = lineOf(grid.maxY, grid.perRow);
        grid.column = lineOf(grid.minX, grid.perColumn), grid.lastColumn = lineOf(grid.maxX, grid.perColumn);
        const std::uint64_t cells = (grid.lastRow - grid.row + 1) * (grid.lastColumn - grid.column + 1);
        grid.table = cells <= kCellsPerPart * grid.members + 64;
        if (!grid.table) grid.perColumn = grid.perRow, cells_.resize(boxes_.size());
        grid.first = hashed_;
        if (grid.table) hashed_ += static_cast<std::size_t>(cells);
    }
    begin_.assign(hashed_ + (std::size_t{1} << (64 - shift_)) + 3, Index{0});
}

/// By buckets, and by index within them: counted, then placed.
void PairSweep::sort()
{
    layOut();
    for (Index part = 0; part < boxes_.size(); ++part) {
        const int which = classes_[part];
        const FatBox& box = boxes_[part];
        std::size_t bucket = which == kLast ? lastBucket() : lastBucket() + 1;
        if (which < kLast) {
            const Grid& grid = grids_[which];
            const std::uint64_t row = lineOf(box.minY, grid.perRow), column = lineOf(box.minX, grid.perColumn);
            if (grid.table) {
                bucket = grid.first + static_cast<std::size_t>(row - grid.row) * grid.width() +
                         static_cast<std::size_t>(column - grid.column);
            } else {
                cells_[part] = cellOf(which, row, column);
                bucket = hashed_ + hashOf(cells_[part]);
            }
        }
        buckets_[part] = static_cast<Index>(bucket);
        ++begin_[bucket];
    }
    Index before = 0;
    for (Index& begin : begin_) begin = before += begin;  // where each ends
    for (auto part = static_cast<Index>(boxes_.size()); part-- > 0;) {
        const Index at = --begin_[buckets_[part]];
        sorted_[at] = part;
        now_.set(at, boxes_[part]);
        // Of what lies in pieces it is not known which of them met.
        then_.set(at, pieceOf_[part] != 0 ? kNowhere : moved_[part] != 0 ? before_[part] : boxes_[part]);
        sortedReaches_[at] = reaches_[part];
    }
}

void PairSweep::finish()
{
    std::fill(moved_.begin(), moved_.end(), std::uint8_t{0});
    anyMoved_ = false;
}

std::size_t PairSweep::bytes() const
{
    return boxes_.capacity() * (2 * sizeof(FatBox) + 3 * sizeof(Index) + 10 * sizeof(float) + 2) +
           begin_.capacity() * sizeof(Index) + cells_.capacity() * sizeof(std::uint64_t);
}

}  // namespace jet::physics
