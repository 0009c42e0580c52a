#include "pairs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

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

void PairSweep::resize(std::size_t parts, float typical)
{
    if (typical_ != typical) std::fill(keys_.begin(), keys_.end(), kUnknown);
    typical_ = typical;
    if (boxes_.size() == parts) return;
    for (std::size_t part = sorted_.size(); part < parts; ++part) sorted_.push_back({0, static_cast<Index>(part)});
    boxes_.resize(parts), before_.resize(parts, kNowhere);
    if (moved_.size() < parts) anyMoved_ = true;
    moved_.resize(parts, 1), pieceOf_.resize(parts, 0);
    keys_.resize(parts, kUnknown);
    for (auto* list : {&minX_, &minY_, &maxX_, &maxY_}) list->resize(parts + 4);
    for (std::size_t k = 0; k < 4; ++k) minX_[parts + k] = std::numeric_limits<float>::infinity();
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

std::uint64_t PairSweep::rowOf(float y, float height)
{
    constexpr double kMost = 1 << 27;
    return static_cast<std::uint64_t>(
        std::clamp(std::floor(static_cast<double>(y) / static_cast<double>(height)), -kMost, kMost) + kMost);
}

std::uint64_t PairSweep::keyOf(int which, std::uint64_t row, float x)
{
    return static_cast<std::uint64_t>(which) << 61 | row << 32 | ordered(x);
}

std::uint64_t PairSweep::keyOf(const FatBox& box) const
{
    const float extent = 1.001F * std::max(box.maxX - box.minX, box.maxY - box.minY);
    int which = 0;
    while (which < kClasses - 1 && !(extent <= rowHeight(which))) ++which;
    return keyOf(which, rowOf(box.minY, rowHeight(which)), box.minX);
}

/// The order hardly changes between sweeps: insertion moves little. A scene that was thrown about is sorted afresh.
void PairSweep::sort()
{
    const std::size_t count = sorted_.size();
    for (Index part = 0; part < count; ++part)
        if (moved_[part] != 0 || keys_[part] == kUnknown) keys_[part] = keyOf(boxes_[part]);
    for (Entry& entry : sorted_) entry.key = keys_[entry.part];
    std::size_t moves = 0;
    for (std::size_t i = 1; i < count && moves < 16 * count; ++i) {
        const Entry entry = sorted_[i];
        std::size_t at = i;
        for (; at > 0 && entry < sorted_[at - 1]; --at) sorted_[at] = sorted_[at - 1];
        sorted_[at] = entry;
        moves += i - at;
    }
    if (moves >= 16 * count) std::sort(sorted_.begin(), sorted_.end());
    for (std::size_t i = 0; i < count; ++i) {
        const FatBox& box = boxes_[sorted_[i].part];
        minX_[i] = box.minX, maxX_[i] = box.maxX, minY_[i] = box.minY, maxY_[i] = box.maxY;
    }
    for (int which = 0; which <= kClasses; ++which)
        classes_[which] = which == kClasses ? count : firstFrom(static_cast<std::uint64_t>(which) << 61);
}

std::size_t PairSweep::firstFrom(std::uint64_t key) const
{
    const auto before = [](const Entry& entry, std::uint64_t wanted) { return entry.key < wanted; };
    return static_cast<std::size_t>(std::lower_bound(sorted_.begin(), sorted_.end(), key, before) - sorted_.begin());
}

void PairSweep::finish()
{
    std::fill(moved_.begin(), moved_.end(), std::uint8_t{0});
    anyMoved_ = false;
}

std::size_t PairSweep::bytes() const
{
    return boxes_.capacity() * (2 * sizeof(FatBox) + sizeof(Entry) + sizeof(std::uint64_t) + 4 * sizeof(float) + 1);
}

}  // namespace jet::physics
