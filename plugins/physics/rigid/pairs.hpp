// The broad phase: which parts may meet? Boxes with room to move in lie in the cells of a grid that is hashed, those of
// very different size in grids of their own. Only what has left its box is sought in them, and as long as every part
// keeps within its box nothing is done (see docs/decisions/0045 and 0046).
#pragma once

#include "arena.hpp"
#include "pool.hpp"
#include "sift.hpp"

#include <algorithm>
#include <vector>

namespace jet::physics {

/// A set of 64-bit keys other than ~0, with open addressing.
class KeySet {
public:
    /// False when it was there already.
    bool insert(std::uint64_t key);
    bool contains(std::uint64_t key) const;
    /// It is asked for soon.
    void prefetch(std::uint64_t key) const
    {
        if (!slots_.empty()) __builtin_prefetch(&slots_[slotOf(key)], 1);
    }
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
    /// With which instructions boxes are compared; the pairs do not depend on it.
    void use(const Sieve& sieve) { sieve_ = &sieve; }
    std::size_t parts() const { return boxes_.size(); }
    const FatBox& box(Index part) const { return boxes_[part]; }
    const FatBox* boxes() const { return boxes_.data(); }
    /// Before anything is moved, and until finish(): room for where it was.
    void open(Arena& arena) { before_ = arena.take<FatBox>(parts()); }
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
    float typical() const { return typical_; }
    /// A long part: its box is large, but only what meets one of these pieces of it is met.
    void setLong(Index part, bool isLong = true);
    std::vector<FatBox>* piecesOf(Index part) { return pieceOf(part) == 0 ? nullptr : &pieces_[pieceOf_[part]]; }
    void noteMoves() { anyMoved_ = true; }
    bool anyMoved() const { return anyMoved_; }
    /// Pairs that were found before are to be found again.
    void forget()
    {
        std::fill(boxes_.begin(), boxes_.end(), kNowhere);
        rebuild();
    }
    /// The same for a part that is moved next.
    void forget(Index part)
    {
        if (part >= boxes_.size()) return;
        boxes_[part] = kNowhere, classes_[part] = kNoClass;
        filled_ = false;
    }

    /// begin(), seek() of all parts, finish().
    template <class Found>
    void sweep(Arena& arena, Found&& found)
    {
        Pool alone;
        begin(arena, alone);
        seek(0, parts(), found);
        finish(arena);
    }
    /// A sweep: begin, seek all parts, finish; then nothing counts as moved.
    void begin(Arena&, Pool&);
    /// Calls found(a, b) for each pair of boxes that meet, of which one was moved, and that did not meet before, if
    /// that one is of [first, last); different parts may be sought at once. Boxes of long parts meet before they do:
    /// their pairs come each time, even repeatedly.
    template <class Found>
    void seek(std::size_t first, std::size_t last, Found&& found) const
    {
        for (auto part = static_cast<Index>(first); part < last; ++part) {
            if (moved_[part] == 0) continue;
            if (pieceOf(part) == 0) {
                meet(part, boxes_[part], found);
            } else {
                for (const FatBox& piece : pieces_[pieceOf_[part]]) meet(part, piece, found);
            }
        }
    }
    void finish(Arena&);

    template <class Archive>
    void archive(Archive& with)
    {
        with(boxes_), with(moved_), with(anyMoved_);
        for (std::vector<FatBox>& pieces : pieces_) with.list(pieces, [&](FatBox& piece) { with(piece); });
    }
    /// After restoring.
    void rebuild()
    {
        filled_ = false;
        std::fill(classes_.begin(), classes_.end(), kNoClass);
    }
    std::size_t bytes() const;

private:
    /// Parts of a class are at most as high and wide as its cells; each class is four times the one before. The last
    /// has no bound, and no cells either.
    static constexpr int kClasses = 8, kLast = kClasses - 1;
    static constexpr std::uint8_t kNoClass = 255, kAbsent = kClasses;
    static constexpr float kColumnsPerCell = 4;
    static constexpr float kLonger = Sieve::kLonger;
    static constexpr FatBox kNowhere{3e38F, 3e38F, -3e38F, -3e38F};

    /// Of a class, or of some of it.
    struct Extent {
        float minX, minY, maxX, maxY;  // of left upper corners
        std::size_t members;
    };

    /// The cells of a class: a table from its first row and column on, narrow columns one after the other, so that a
    /// part of a row is one stretch. Where what is in it lies too far apart, its cells are hashed instead. A class of
    /// few has none: it is looked through with the last.
    struct Grid {
        enum class Kind : std::uint8_t { None, Table, Hashed } kind = Kind::None;
        float perRow = 0, perColumn = 0;  // 1 / units
        Extent extent{};
        std::size_t rows = 0, columns = 0;
        std::size_t first = 0;  // bucket

        static std::size_t line(float from, float perLine, std::size_t lines)
        {
            return static_cast<std::size_t>(
                static_cast<std::int64_t>(std::min(std::max(from * perLine, 0.0F), static_cast<float>(lines - 1))));
        }
        std::size_t row(float y) const { return line(y - extent.minY, perRow, rows); }
        std::size_t column(float x) const { return line(x - extent.minX, perColumn, columns); }
    };

    /// Most boxes with their room are less than two and a half of the typical length high and wide.
    float cellSize(int which) const { return 2.5F * typical_ * static_cast<float>(1 << (2 * which)); }
    static std::uint64_t cellOf(int which, std::uint64_t row, std::uint64_t column)
    {
        return static_cast<std::uint64_t>(which) << 56 | row << 28 | column;
    }
    std::uint64_t cellOf(Index part) const
    {
        const double perLine = perHashedLine(classes_[part]);
        return cellOf(classes_[part], lineOf(boxes_[part].minY, perLine), lineOf(boxes_[part].minX, perLine));
    }
    double perHashedLine(int which) const { return 1 / static_cast<double>(cellSize(which)); }
    /// Which row or column of hashed cells: 28 bits. What lies beyond the last ones is in them.
    static std::uint64_t lineOf(float at, double perLine)
    {
        constexpr double kMost = (1 << 27) - 1;
        const double x = std::min(std::max(static_cast<double>(at) * perLine, -kMost), kMost);
        const auto whole = static_cast<std::int64_t>(x);
        return static_cast<std::uint64_t>(whole - (x < static_cast<double>(whole)) + (1 << 27));
    }
    std::size_t hashOf(std::uint64_t cell) const
    {
        return hashed_ + static_cast<std::size_t>(cell * 0x9e3779b97f4a7c15ULL >> shift_);
    }
    std::size_t lastBucket() const { return begin_.size() - 3; }
    std::uint8_t classOf(const FatBox&) const;
    std::size_t bucketOf(Index part) const;
    void classify(Arena&, Pool&);
    void layOut(Arena&, Pool&);
    void sort(Arena&, Pool&);
    bool retouch();
    std::size_t slotOf(Index part) const;
    void setSlot(std::size_t slot, Index part);
    bool meetsPieces(Index part, const FatBox&) const;

    /// What a box may meet lies in stretches of sorted_, which are looked through some at a time.
    template <class Found>
    class Search {
    public:
        Search(const PairSweep& sweep, Index part, const FatBox& box, Found& found)
            : sweep_(sweep), part_(part),
              found_(found), box_{box, sweep.pieceOf(part) != 0 ? kNowhere : sweep.before_[part], sweep.reaches_[part]}
        {
        }
        void add(std::size_t first, std::size_t last)
        {
            for (; first < last; first += Sieve::kMost) {
                const std::size_t length = std::min(last - first, Sieve::kMost);
                if (count_ == kStretches || length_ + length > Sieve::kMost) look();
                stretches_[count_++] = {static_cast<Index>(first), static_cast<Index>(first + length)};
                length_ += length;
            }
        }
        /// Those of one cell, as others may be in its bucket.
        void addHashed(std::uint64_t cell)
        {
            look();
            const std::size_t bucket = sweep_.hashOf(cell);
            for (std::size_t at = sweep_.begin_[bucket]; at < sweep_.begin_[bucket + 1]; at += Sieve::kMost) {
                stretches_[count_++] = {static_cast<Index>(at),
                                        std::min(static_cast<Index>(at + Sieve::kMost), sweep_.begin_[bucket + 1])};
                look([&](Index other) { return sweep_.cellOf(other) == cell; });
            }
        }
        void look()
        {
            look([](Index) { return true; });
        }

    private:
        static constexpr std::size_t kStretches = 32;

        template <class Counts>
        void look(Counts&& counts)
        {
            Index near[Sieve::kMost + Sieve::kPairs];
            const std::size_t hits = sweep_.sieve_->near(sweep_.boxesInCells(), box_, stretches_, count_, near);
            for (std::size_t i = 0; i < hits; ++i) {
                const Index other = sweep_.sorted_[near[i]];
                if (other == part_ || (sweep_.moved_[other] != 0 && other < part_) || !counts(other)) continue;
                if (sweep_.pieceOf(other) != 0 && !sweep_.meetsPieces(other, box_.now)) continue;
                found_(std::min(part_, other), std::max(part_, other));
            }
            count_ = length_ = 0;
        }

        const PairSweep& sweep_;
        Index part_;
        Found& found_;
        SoughtBox box_;
        Stretch stretches_[kStretches];
        std::size_t count_ = 0, length_ = 0;
    };

    template <class Found>
    void meet(Index part, const FatBox& box, Found&& found) const
    {
        Search<std::remove_reference_t<Found>> search(*this, part, box, found);
        // As many stretches as boxes: all are looked at.
        if (retouched_ || 4 * stretchesOf(box) > boxes_.size() + 64) {
            search.add(0, boxes_.size());
        } else {
            for (int which = 0; which < kLast; ++which) {
                if (grids_[which].kind == Grid::Kind::Table) meetTable(box, which, search);
                if (grids_[which].kind == Grid::Kind::Hashed) meetHashed(box, which, search);
            }
            search.add(begin_[lastBucket()], begin_[lastBucket() + 1]);
        }
        search.look();
    }
    std::uint64_t stretchesOf(const FatBox&) const;
    template <class Search>
    void meetTable(const FatBox& box, int which, Search& search) const
    {
        const Grid& grid = grids_[which];
        const float size = cellSize(which);
        const std::size_t left = grid.column(box.minX - size), right = grid.column(box.maxX) + 1;
        const std::size_t bottom = grid.row(box.maxY);
        for (std::size_t row = grid.row(box.minY - size); row <= bottom; ++row) {
            const Index* cells = &begin_[grid.first + row * grid.columns];
            search.add(cells[left], cells[right]);
        }
    }
    template <class Search>
    void meetHashed(const FatBox& box, int which, Search& search) const
    {
        const Lines l = hashedLines(box, which);
        for (std::uint64_t row = l.top; row <= l.bottom; ++row)
            for (std::uint64_t column = l.left; column <= l.right; ++column)
                search.addHashed(cellOf(which, row, column));
    }
    /// Hashed cells a box may find others in.
    struct Lines {
        std::uint64_t top, bottom, left, right;
    };
    Lines hashedLines(const FatBox& box, int which) const
    {
        const float size = cellSize(which);
        const double perLine = perHashedLine(which);
        return {lineOf(box.minY - size, perLine), lineOf(box.maxY, perLine), lineOf(box.minX - size, perLine),
                lineOf(box.maxX, perLine)};
    }

    /// Boxes in the order of sorted_, padded by some at infinity.
    struct Sides {
        std::span<float> minX, minY, maxX, maxY;
        static std::size_t roomFor(std::size_t count) { return 4 * (count + Sieve::kPairs); }
        void lay(std::span<float> room);
        void set(std::size_t at, const FatBox& box)
        {
            minX[at] = box.minX, maxX[at] = box.maxX, minY[at] = box.minY, maxY[at] = box.maxY;
        }
    };
    BoxesInCells boxesInCells() const
    {
        return {now_.minX.data(),  now_.minY.data(),  now_.maxX.data(),  now_.maxY.data(),     then_.minX.data(),
                then_.minY.data(), then_.maxX.data(), then_.maxY.data(), sortedReaches_.data()};
    }

    const Sieve* sieve_ = &sse2::pairSieve;
    Index pieceOf(Index part) const { return pieces_.size() == 1 ? 0 : pieceOf_[part]; }

    std::vector<FatBox> boxes_;                   // [parts]
    std::span<FatBox> before_;                    // [parts] before they were moved; of those that were
    std::vector<Index> pieceOf_;                  // [parts] 0: it is in one piece; nothing where all are
    std::vector<std::vector<FatBox>> pieces_{1};  // of long parts
    std::vector<Index> long_{0};                  // [pieces_] whose they are
    std::vector<std::uint8_t> moved_;
    bool anyMoved_ = false;
    bool filled_ = false;     // are the cells those of the last sweep, but for what was moved since?
    bool retouched_ = false;  // only the boxes were brought up to date, not the cells: what is sought is sought in all
    float typical_ = 1;
    std::vector<std::uint8_t> classes_;  // [parts]
    std::vector<Index> buckets_;         // [parts]
    std::vector<Index> begin_;           // [buckets + 1]
    std::size_t hashed_ = 0;             // first bucket of hashed cells
    int shift_ = 63;                     // of a product of 64 bits, to the number of a hash
    Grid grids_[kClasses];
    std::vector<Index> sorted_;                   // parts, bucket by bucket
    std::vector<float> reaches_, sortedReaches_;  // [parts], in the order of sorted_
    std::vector<float> room_;                     // of now_
    Sides now_, then_;                            // boxes, and, during a sweep, those before they were moved
    std::size_t mark_ = 0;                        // of the arena, before then_ was taken
};

}  // namespace jet::physics
