// The broad phase: which parts may meet? Boxes with room to move in are swept in the order of their left sides, eight
// at a time; as long as every part keeps within its box nothing is done. Measured against a dynamic tree this costs a
// third, because neighbours in a pile are neighbours in the sweep (see docs/decisions/0012).
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
    void resize(std::size_t parts);
    FatBox& box(Index part) { return boxes_[part]; }
    const FatBox& box(Index part) const { return boxes_[part]; }
    /// To be followed by noteMoves(); different parts may be marked at once.
    void markMoved(Index part) { moved_[part] = 1; }
    void noteMoves() { anyMoved_ = true; }
    bool anyMoved() const { return anyMoved_; }

    /// Calls found(a, b), a < b, for each pair of boxes that meet and of which one was marked; then unmarks all.
    template <class Found>
    void sweep(Found&& found)
    {
        sort();
        const std::size_t count = order_.size();
        for (std::size_t i = 0; i < count; ++i) {
            const float right = maxX_[i], low = minY_[i], high = maxY_[i];
            const bool moved = sortedMoved_[i] != 0;
            for (std::size_t j = i + 1; j < count; j += 8) {
                // The lists are padded by eight boxes at infinity.
                unsigned hits = near(j, right, low, high) | near(j + 4, right, low, high) << 4;
                for (; hits != 0; hits &= hits - 1) {
                    const std::size_t k = j + static_cast<std::size_t>(__builtin_ctz(hits));
                    if (!moved && sortedMoved_[k] == 0) continue;
                    found(std::min(order_[i], order_[k]), std::max(order_[i], order_[k]));
                }
                if (!(minX_[j + 7] <= right)) break;
            }
        }
        finish();
    }

    std::vector<FatBox>& boxes() { return boxes_; }
    template <class Archive>
    void archive(Archive& with)
    {
        with(boxes_), with(moved_), with(anyMoved_);
    }
    std::size_t bytes() const;

private:
    void sort();
    void finish();
    /// A bit for each of four boxes that begins before `right` and meets low..high.
    unsigned near(std::size_t first, float right, float low, float high) const
    {
#if defined(__SSE2__)
        const __m128 x = _mm_cmple_ps(_mm_loadu_ps(&minX_[first]), _mm_set1_ps(right));
        const __m128 y = _mm_and_ps(_mm_cmple_ps(_mm_loadu_ps(&minY_[first]), _mm_set1_ps(high)),
                                    _mm_cmpge_ps(_mm_loadu_ps(&maxY_[first]), _mm_set1_ps(low)));
        return static_cast<unsigned>(_mm_movemask_ps(_mm_and_ps(x, y)));
#else
        unsigned bits = 0;
        for (std::size_t k = 0; k < 4; ++k)
            bits |= static_cast<unsigned>((minX_[first + k] <= right) & (minY_[first + k] <= high) &
                                          (maxY_[first + k] >= low))
                    << k;
        return bits;
#endif
    }

    std::vector<FatBox> boxes_;
    std::vector<std::uint8_t> moved_;
    bool anyMoved_ = false;
    std::vector<Index> order_;  // parts by left side, then by index
    std::vector<std::uint64_t> keys_;
    std::vector<float> minX_, minY_, maxX_, maxY_;  // in that order
    std::vector<std::uint8_t> sortedMoved_;
};

}  // namespace jet::physics
