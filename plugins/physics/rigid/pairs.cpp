#include "pairs.hpp"

#include <bit>

namespace jet::physics {

namespace {

constexpr std::uint64_t kEmpty = ~std::uint64_t{0};

/// Floats as integers in the same order.
std::uint32_t ordered(float x)
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return bits & 0x80000000U ? ~bits : bits | 0x80000000U;
}

}  // namespace

std::size_t KeySet::slotOf(std::uint64_t key) const
{
    std::uint64_t h = key * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 32;
    return h & (slots_.size() - 1);
}

bool KeySet::insert(std::uint64_t key)
{
    if (2 * (count_ + 1) > slots_.size()) grow();
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

void PairSweep::resize(std::size_t parts)
{
    for (std::size_t part = order_.size(); part < parts; ++part) order_.push_back(static_cast<Index>(part));
    boxes_.resize(parts);
    if (moved_.size() < parts) anyMoved_ = true;
    moved_.resize(parts, 1);
    keys_.resize(parts);
    for (auto* list : {&minX_, &minY_, &maxX_, &maxY_}) list->resize(parts + 8);
    sortedMoved_.assign(parts + 8, 0);
    for (std::size_t k = 0; k < 8; ++k) minX_[parts + k] = std::numeric_limits<float>::infinity();
}

/// The order hardly changes between sweeps: insertion moves little. A scene that was thrown about is sorted afresh.
void PairSweep::sort()
{
    const std::size_t count = order_.size();
    for (std::size_t i = 0; i < count; ++i)
        keys_[i] = static_cast<std::uint64_t>(ordered(boxes_[order_[i]].minX)) << 32 | order_[i];
    std::size_t moves = 0;
    for (std::size_t i = 1; i < count && moves < 8 * count; ++i) {
        const std::uint64_t key = keys_[i];
        std::size_t at = i;
        for (; at > 0 && keys_[at - 1] > key; --at) keys_[at] = keys_[at - 1];
        keys_[at] = key;
        moves += i - at;
    }
    if (moves >= 8 * count) std::sort(keys_.begin(), keys_.end());
    for (std::size_t i = 0; i < count; ++i) {
        const auto part = static_cast<Index>(keys_[i]);
        order_[i] = part;
        const FatBox& box = boxes_[part];
        minX_[i] = box.minX, maxX_[i] = box.maxX, minY_[i] = box.minY, maxY_[i] = box.maxY;
        sortedMoved_[i] = moved_[part];
    }
}

void PairSweep::finish()
{
    std::fill(moved_.begin(), moved_.end(), std::uint8_t{0});
    anyMoved_ = false;
}

std::size_t PairSweep::bytes() const
{
    return boxes_.capacity() * (sizeof(FatBox) + sizeof(Index) + sizeof(std::uint64_t) + 4 * sizeof(float) + 2);
}

}  // namespace jet::physics
