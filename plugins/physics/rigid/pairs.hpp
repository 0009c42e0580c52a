// The broad phase: which parts may meet? Boxes with room to move in lie in the cells of a grid that is hashed, those of
// very different size in grids of their own. Only what has left its box is sought in them, and as long as every part
// keeps within its box nothing is done (see docs/decisions/0045 and 0046).
#pragma once

#include "contact.hpp"

#include <algorithm>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace jet::physics {

/// A set of 64-bit keys other than ~0, with open addressing.
class KeySet {
public:
    /// False when it was there already.
    bool insert(std::uint64_t key);
    bool contains(std::uint64_t key) const;
    void erase(std::uint64_t key);
    void clear();
    std::size_t bytes() const { return slots_.capacity() * sizeof(std::uint64_t); }

private:
    std::size_t slotOf(std::uint64_t key) const;
    void grow();

    std::vector<std::uint64_t> slots_;
    std::size_t count_ = 0;
};

class PairSweep {
public:
    /// `typical`: units, the size of most parts; it decides how wide cells are.
    void resize(std::size_t parts, float typical);
    std::size_t parts() const { return boxes_.size(); }
    const FatBox& box(Index part) const { return boxes_[part]; }
    const FatBox* boxes() const { return boxes_.data(); }
    /// To be followed by noteMoves(); different parts may be moved at once.
    void move(Index part, const FatBox& to)
    {
        if (moved_[part] == 0) before_[part] = boxes_[part];
        boxes_[part] = to;
        moved_[part] = 1;
    }
    /// Units to its farthest point.
    void setReach(Index part, float reach) { reaches_[part] = reach; }
    /// Is one of them so long that its box meets much that it does not?
    bool isLonger(Index a, Index b) const
    {
        return reaches_[a] > kLonger * reaches_[b] || reaches_[b] > kLonger * reaches_[a];
    }
    /// A long part: its box is large, but only what meets one of these pieces of it is met.
    void setLong(Index part);
    std::vector<FatBox>* piecesOf(Index part) { return pieceOf_[part] == 0 ? nullptr : &pieces_[pieceOf_[part]]; }
    void noteMoves() { anyMoved_ = true; }
    bool anyMoved() const { return anyMoved_; }
    /// Pairs that were found before are to be found again.
    void forget() { std::fill(before_.begin(), before_.end(), kNowhere); }
    /// The same for a part that is moved next.
    void forget(Index part)
    {
        if (part < boxes_.size()) boxes_[part] = before_[part] = kNowhere, classes_[part] = kNoClass;
    }

    /// begin(), seek() of all parts, finish().
    template <class Found>
    void sweep(Found&& found)
    {
        begin();
        seek(0, parts(), found);
        finish();
    }
    /// A sweep: begin, seek all parts, finish; then nothing counts as moved.
    void begin() { sort(); }
    /// Calls found(a, b) for each pair of boxes that meet, of which one was moved, and that did not meet before, if
    /// that one is of [first, last); different parts may be sought at once. Boxes of long parts meet before they do:
    /// their pairs come each time, even repeatedly.
    template <class Found>
    void seek(std::size_t first, std::size_t last, Found&& found) const
    {
        for (auto part = static_cast<Index>(first); part < last; ++part)
            if (moved_[part] != 0) meet(part, found);
    }
    void finish();

    template <class Archive>
    void archive(Archive& with)
    {
        with(boxes_), with(moved_), with(anyMoved_);
        for (std::vector<FatBox>& pieces : pieces_) with.list(pieces, [&](FatBox& piece) { with(piece); });
    }
    /// After restoring.
    void rebuild()
    {
        forget();
        std::fill(classes_.begin(), classes_.end(), kNoClass);
    }
    std::size_t bytes() const;

private:
    /// Parts of a class are at most as high and wide as its cells; each class is four times the one before. The last
    /// has no bound, and no cells either.
    static constexpr int kClasses = 8, kLast = kClasses - 1;
    static constexpr std::uint8_t kNoClass = 255, kAbsent = kClasses;
    static constexpr int kColumnsPerCell = 4;
    static constexpr float kLonger = 3;
    static constexpr std::uint64_t kUnknown = ~std::uint64_t{0};
    static constexpr FatBox kNowhere{3e38F, 3e38F, -3e38F, -3e38F};

    /// The cells of a class: a table from its first row and column on, narrow columns one after the other, so that a
    /// part of a row is one stretch. Where what is in it lies too far apart, its cells are hashed instead.
    struct Grid {
        double perRow = 0, perColumn = 0;  // 1 / units
        std::uint64_t row = 0, lastRow = 0, column = 0, lastColumn = 0;
        std::size_t first = 0;  // bucket
        std::size_t members = 0;
        float minX = 0, minY = 0, maxX = 0, maxY = 0;  // of left upper corners
        bool table = false;
        std::size_t width() const { return static_cast<std::size_t>(lastColumn - column + 1); }
    };
    /// Cells a box may find others in.
    struct Lines {
        std::uint64_t row, lastRow, column, lastColumn;
        std::uint64_t rows() const { return lastRow < row ? 0 : lastRow - row + 1; }
        std::uint64_t columns() const { return lastColumn < column ? 0 : lastColumn - column + 1; }
    };

    /// Most boxes with their room are less than two and a half of the typical length high and wide.
    float cellSize(int which) const { return 2.5F * typical_ * static_cast<float>(1 << (2 * which)); }
    static std::uint64_t cellOf(int which, std::uint64_t row, std::uint64_t column)
    {
        return static_cast<std::uint64_t>(which) << 56 | row << 28 | column;
    }
    /// Which row or column: 28 bits. What lies beyond the last ones is in them.
    static std::uint64_t lineOf(float at, double perLine)
    {
        constexpr double kMost = (1 << 27) - 1;
        const double x = std::min(std::max(static_cast<double>(at) * perLine, -kMost), kMost);
        const auto whole = static_cast<std::int64_t>(x);
        return static_cast<std::uint64_t>(whole - (x < static_cast<double>(whole)) + (1 << 27));
    }
    std::size_t hashOf(std::uint64_t cell) const
    {
        return static_cast<std::size_t>(cell * 0x9e3779b97f4a7c15ULL >> shift_);
    }
    std::size_t lastBucket() const { return begin_.size() - 3; }
    std::uint8_t classOf(const FatBox&) const;
    void layOut();
    Lines linesFor(const Grid& grid, float size, const FatBox& box) const
    {
        Lines l{lineOf(box.minY - size, grid.perRow), lineOf(box.maxY, grid.perRow),
                lineOf(box.minX - size, grid.perColumn), lineOf(box.maxX, grid.perColumn)};
        if (grid.table) {
            l.row = std::max(l.row, grid.row), l.lastRow = std::min(l.lastRow, grid.lastRow);
            l.column = std::max(l.column, grid.column), l.lastColumn = std::min(l.lastColumn, grid.lastColumn);
        }
        return l;
    }
    void sort();
    bool meetsPieces(Index part, const FatBox&) const;

    template <class Found>
    void meet(Index part, Found&& found) const
    {
        if (pieceOf_[part] == 0) return meet(part, boxes_[part], found);
        for (const FatBox& piece : pieces_[pieceOf_[part]]) meet(part, piece, found);
    }
    template <class Found>
    void meet(Index part, const FatBox& box, Found&& found) const
    {
        Lines lines[kLast];
        std::uint64_t stretches = 0;
        for (int which = 0; which < kLast; ++which) {
            const Grid& grid = grids_[which];
            if (grid.members == 0) continue;
            const Lines& l = lines[which] = linesFor(grid, cellSize(which), box);
            stretches += l.rows() * (grid.table ? 1 : l.columns());
        }
        // As many as boxes: all are looked at.
        if (4 * stretches > boxes_.size() + 64) return scan(part, box, 0, boxes_.size(), kUnknown, found);
        for (int which = 0; which < kLast; ++which)
            if (grids_[which].members > 0) meet(part, box, which, lines[which], found);
        scan(part, box, begin_[lastBucket()], begin_[lastBucket() + 1], kUnknown, found);
    }
    template <class Found>
    void meet(Index part, const FatBox& box, int which, const Lines& l, Found&& found) const
    {
        const Grid& grid = grids_[which];
        if (grid.table) {
            if (l.columns() == 0) return;
            for (std::uint64_t row = l.row; row <= l.lastRow; ++row) {
                const std::size_t start = grid.first + static_cast<std::size_t>(row - grid.row) * grid.width();
                scan(part, box, begin_[start + static_cast<std::size_t>(l.column - grid.column)],
                     begin_[start + static_cast<std::size_t>(l.lastColumn - grid.column) + 1], kUnknown, found);
            }
            return;
        }
        for (std::uint64_t row = l.row; row <= l.lastRow; ++row) {
            for (std::uint64_t column = l.column; column <= l.lastColumn; ++column) {
                const std::uint64_t cell = cellOf(which, row, column);
                const std::size_t bucket = hashed_ + hashOf(cell);
                scan(part, box, begin_[bucket], begin_[bucket + 1], cell, found);
            }
        }
    }
    /// `cell`: the one that is meant, as others may be in its bucket; kUnknown: any.
    template <class Found>
    void scan(Index part, const FatBox& box, std::size_t first, std::size_t last, std::uint64_t cell,
              Found&& found) const
    {
        const FatBox& was = pieceOf_[part] != 0 ? kNowhere : before_[part];
        for (std::size_t j = first; j < last; j += 4) {
            unsigned hits = near(now_, j, box);
            if (last - j < 4) hits &= (1U << (last - j)) - 1;
            if (hits == 0) continue;
            hits &= ~near(then_, j, was) | longer(j, part);
            for (; hits != 0; hits &= hits - 1) {
                const Index other = sorted_[j + static_cast<std::size_t>(__builtin_ctz(hits))];
                if (other == part || (moved_[other] != 0 && other < part)) continue;
                if (cell != kUnknown && cells_[other] != cell) continue;
                if (pieceOf_[other] != 0 && !meetsPieces(other, box)) continue;
                found(std::min(part, other), std::max(part, other));
            }
        }
    }
    /// Boxes in the order of sorted_, padded by some at infinity.
    struct Sides {
        std::vector<float> minX, minY, maxX, maxY;
        void resize(std::size_t count);
        void set(std::size_t at, const FatBox& box)
        {
            minX[at] = box.minX, maxX[at] = box.maxX, minY[at] = box.minY, maxY[at] = box.maxY;
        }
    };
    /// A bit for each of four boxes that meets the box.
    static unsigned near(const Sides& boxes, std::size_t first, const FatBox& box)
    {
#if defined(__SSE2__)
        const __m128 x = _mm_and_ps(_mm_cmple_ps(_mm_loadu_ps(&boxes.minX[first]), _mm_set1_ps(box.maxX)),
                                    _mm_cmpge_ps(_mm_loadu_ps(&boxes.maxX[first]), _mm_set1_ps(box.minX)));
        const __m128 y = _mm_and_ps(_mm_cmple_ps(_mm_loadu_ps(&boxes.minY[first]), _mm_set1_ps(box.maxY)),
                                    _mm_cmpge_ps(_mm_loadu_ps(&boxes.maxY[first]), _mm_set1_ps(box.minY)));
        return static_cast<unsigned>(_mm_movemask_ps(_mm_and_ps(x, y)));
#else
        unsigned bits = 0;
        for (std::size_t k = first; k < first + 4; ++k)
            bits |= static_cast<unsigned>((boxes.minX[k] <= box.maxX) & (boxes.maxX[k] >= box.minX) &
                                          (boxes.minY[k] <= box.maxY) & (boxes.maxY[k] >= box.minY))
                    << (k - first);
        return bits;
#endif
    }
    /// A bit for each of four parts that is much longer than the part, or the part than it.
    unsigned longer(std::size_t first, Index part) const
    {
        const float reach = reaches_[part];
#if defined(__SSE2__)
        const __m128 others = _mm_loadu_ps(&sortedReaches_[first]), factor = _mm_set1_ps(kLonger);
        return static_cast<unsigned>(
            _mm_movemask_ps(_mm_or_ps(_mm_cmpgt_ps(others, _mm_set1_ps(kLonger * reach)),
                                      _mm_cmplt_ps(_mm_mul_ps(factor, others), _mm_set1_ps(reach)))));
#else
        unsigned bits = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const float other = sortedReaches_[first + k];
            bits |= static_cast<unsigned>((other > kLonger * reach) | (kLonger * other < reach)) << k;
        }
        return bits;
#endif
    }

    std::vector<FatBox> boxes_, before_;          // [parts] before they were moved
    std::vector<Index> pieceOf_;                  // [parts] 0: it is in one piece
    std::vector<std::vector<FatBox>> pieces_{1};  // of long parts
    std::vector<std::uint8_t> moved_;
    bool anyMoved_ = false;
    float typical_ = 1;
    std::vector<std::uint8_t> classes_;  // [parts]
    std::vector<std::uint64_t> cells_;   // [parts] of those that are hashed; nothing as long as none is
    std::vector<Index> buckets_;         // [parts]
    std::vector<Index> begin_;           // [buckets + 1]
    std::size_t hashed_ = 0;             // first bucket of hashed cells
    int shift_ = 63;                     // of a product of 64 bits, to the number of a hash
    Grid grids_[kClasses];
    std::vector<Index> sorted_;                   // parts, bucket by bucket
    std::vector<float> reaches_, sortedReaches_;  // [parts], in the order of sorted_
    Sides now_, then_;                            // boxes, and those before they were moved
};

}  // namespace jet::physics
