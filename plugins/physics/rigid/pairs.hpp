// The broad phase: which parts may meet? Boxes with room to move in lie in rows as high as they are, sorted by their
// left sides; parts of very different size in rows of their own. Only what has left its box is sought in them, and as
// long as every part keeps within its box nothing is done (see docs/decisions/0045).
#pragma once

#include "contact.hpp"

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
    /// `typical`: units, the size of most parts; it decides how wide rows are.
    void resize(std::size_t parts, float typical);
    std::size_t parts() const { return boxes_.size(); }
    const FatBox& box(Index part) const { return boxes_[part]; }
    /// To be followed by noteMoves(); different parts may be moved at once.
    void move(Index part, const FatBox& to)
    {
        if (moved_[part] == 0) before_[part] = boxes_[part];
        boxes_[part] = to;
        moved_[part] = 1;
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
        if (part < boxes_.size()) boxes_[part] = before_[part] = kNowhere;
    }

    /// Calls found(a, b, met) for each pair of boxes that meet and of which one was moved; then nothing counts as
    /// moved. `met`: they did so before they were moved, too. Pairs of long parts may come more than once.
    template <class Found>
    void sweep(Found&& found)
    {
        sort();
        for (std::size_t i = 0; i < sorted_.size(); ++i)
            if (moved_[sorted_[i].part] != 0) meet(sorted_[i].part, found);
        finish();
    }

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
        std::fill(keys_.begin(), keys_.end(), kUnknown);
    }
    std::size_t bytes() const;

private:
    /// Parts of a class are at most so high and wide as its rows; each class is four times the one before.
    static constexpr int kClasses = 8;
    static constexpr std::uint64_t kUnknown = ~std::uint64_t{0};
    static constexpr FatBox kNowhere{3e38F, 3e38F, -3e38F, -3e38F};

    struct Entry {
        std::uint64_t key;  // class, row, left side
        Index part;
        bool operator<(const Entry& other) const { return key < other.key || (key == other.key && part < other.part); }
    };

    float rowHeight(int which) const { return typical_ * static_cast<float>(1 << (2 * which + 1)); }
    static std::uint64_t rowOf(float y, float height);
    static std::uint64_t keyOf(int which, std::uint64_t row, float x);
    std::uint64_t keyOf(const FatBox&) const;
    void sort();
    void finish();
    bool meetsPieces(Index part, const FatBox&) const;
    std::size_t firstFrom(std::uint64_t key) const;

    template <class Found>
    void meet(Index part, Found&& found)
    {
        if (pieceOf_[part] == 0) return meet(part, boxes_[part], found);
        for (const FatBox& piece : pieces_[pieceOf_[part]]) meet(part, piece, found);
    }
    template <class Found>
    void meet(Index part, const FatBox& box, Found&& found)
    {
        for (int which = 0; which < kClasses; ++which) {
            const std::size_t first = classes_[which], last = classes_[which + 1];
            if (first == last) continue;
            // The last class has no bound.
            const float height = rowHeight(which);
            const std::uint64_t low = rowOf(box.minY - height, height), high = rowOf(box.maxY, height);
            if (which == kClasses - 1 || high - low >= last - first) {
                scan(part, box, first, last, found);
                continue;
            }
            for (std::uint64_t row = low; row <= high; ++row) {
                const std::size_t begin = firstFrom(keyOf(which, row, box.minX - height));
                const std::uint64_t end = keyOf(which, row, box.maxX);
                std::size_t k = begin;
                while (k < last && sorted_[k].key <= end) ++k;
                if (k > begin) scan(part, box, begin, k, found);
            }
        }
    }
    template <class Found>
    void scan(Index part, const FatBox& box, std::size_t first, std::size_t last, Found&& found)
    {
        for (std::size_t j = first; j < last; j += 4) {
            // The lists are padded by boxes at infinity.
            unsigned hits = near(j, box);
            if (last - j < 4) hits &= (1U << (last - j)) - 1;
            for (; hits != 0; hits &= hits - 1) {
                const Index other = sorted_[j + static_cast<std::size_t>(__builtin_ctz(hits))].part;
                if (other == part || (moved_[other] != 0 && other < part)) continue;
                if (pieceOf_[other] != 0 && !meetsPieces(other, box)) continue;
                const FatBox& was = moved_[other] != 0 ? before_[other] : boxes_[other];
                const bool met = was.meets(before_[part]) && pieceOf_[part] == 0 && pieceOf_[other] == 0;
                found(std::min(part, other), std::max(part, other), met);
            }
        }
    }
    /// A bit for each of four boxes that meets the box.
    unsigned near(std::size_t first, const FatBox& box) const
    {
#if defined(__SSE2__)
        const __m128 x = _mm_and_ps(_mm_cmple_ps(_mm_loadu_ps(&minX_[first]), _mm_set1_ps(box.maxX)),
                                    _mm_cmpge_ps(_mm_loadu_ps(&maxX_[first]), _mm_set1_ps(box.minX)));
        const __m128 y = _mm_and_ps(_mm_cmple_ps(_mm_loadu_ps(&minY_[first]), _mm_set1_ps(box.maxY)),
                                    _mm_cmpge_ps(_mm_loadu_ps(&maxY_[first]), _mm_set1_ps(box.minY)));
        return static_cast<unsigned>(_mm_movemask_ps(_mm_and_ps(x, y)));
#else
        unsigned bits = 0;
        for (std::size_t k = 0; k < 4; ++k)
            bits |= static_cast<unsigned>((minX_[first + k] <= box.maxX) & (maxX_[first + k] >= box.minX) &
                                          (minY_[first + k] <= box.maxY) & (maxY_[first + k] >= box.minY))
                    << k;
        return bits;
#endif
    }

    std::vector<FatBox> boxes_, before_;          // [parts] before they were moved
    std::vector<Index> pieceOf_;                  // [parts] 0: it is in one piece
    std::vector<std::vector<FatBox>> pieces_{1};  // of long parts
    std::vector<std::uint8_t> moved_;
    bool anyMoved_ = false;
    float typical_ = 1;
    std::vector<std::uint64_t> keys_;  // [parts]
    std::vector<Entry> sorted_;
    std::size_t classes_[kClasses + 1] = {};        // where they begin
    std::vector<float> minX_, minY_, maxX_, maxY_;  // in the order of sorted_
};

}  // namespace jet::physics
