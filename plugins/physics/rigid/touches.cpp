#include "touches.hpp"

#include "told.hpp"

#include <algorithm>

namespace jet::physics {

void Touches::change(BodyHandle a, BodyHandle b, bool begins, double impulse, bool only)
{
    changes_.push_back({pairOf(a, b), begins ? 1 : -1, only, begins ? impulse : 0});
}

void Touches::restored(BodyHandle a, BodyHandle b)
{
    const std::uint64_t pair = pairOf(a, b);
    const auto before = [](const Count& count, std::uint64_t of) { return count.pair < of; };
    auto at = std::lower_bound(counts_.begin(), counts_.end(), pair, before);
    if (at == counts_.end() || at->pair != pair) at = counts_.insert(at, {pair, 0});
    ++at->touching;
}

void Touches::tell(std::vector<ContactEvent>& events)
{
    events.clear();
    if (changes_.empty()) return;
    std::sort(changes_.begin(), changes_.end(), [](const Change& p, const Change& q) { return p.pair < q.pair; });
    const bool counts = std::any_of(changes_.begin(), changes_.end(), [](const Change& c) { return !c.only; });
    merged_.clear();
    auto old = counts_.begin();
    for (std::size_t first = 0, end = 0; first < changes_.size(); first = end) {
        Change all = changes_[first];
        for (end = first + 1; end < changes_.size() && changes_[end].pair == all.pair; ++end)
            all.begins += changes_[end].begins, all.impulse += changes_[end].impulse;
        std::int64_t before = all.begins < 0 ? 1 : 0;
        if (!all.only) {
            for (; old != counts_.end() && old->pair < all.pair; ++old) merged_.push_back(*old);
            before = old != counts_.end() && old->pair == all.pair ? (old++)->touching : 0;
            if (before + all.begins > 0) merged_.push_back({all.pair, before + all.begins});
        }
        const bool touched = before > 0, touches = before + all.begins > 0;
        if (touched == touches) continue;
        events.push_back({static_cast<BodyHandle>(all.pair >> 32), static_cast<BodyHandle>(all.pair & 0xffffffffU),
                          touches, touches ? told(all.impulse) : 0});
    }
    changes_.clear();
    if (!counts) return;
    merged_.insert(merged_.end(), old, counts_.end());
    counts_.swap(merged_);
}

}  // namespace jet::physics
