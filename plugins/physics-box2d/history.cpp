#include "history.hpp"

#include "validation.hpp"

#include <cstring>

namespace jet::box2d {

namespace {
constexpr std::uint64_t kMark = 0x3244322d5445'4a2dULL;  // "-JET-2D2"
static_assert(sizeof(Entry) == 32, "entries are written as they are: without gaps");

/// FNV-1a over 64-bit words: what is played again has to be what was done.
std::uint64_t sealOf(const std::vector<Entry>& entries)
{
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const Entry& entry : entries) {
        std::uint64_t words[sizeof(Entry) / 8];
        std::memcpy(words, &entry, sizeof words);
        for (const std::uint64_t word : words) hash = (hash ^ word) * 0x100000001b3ULL, hash ^= hash >> 32;
    }
    return hash;
}
}  // namespace

void History::add(const Entry& entry)
{
    if (entry.deed == Deed::Step && !entries_.empty() && entries_.back().deed == Deed::Step &&
        entries_.back().x == entry.x) {
        entries_.back().count += entry.count;
        return;
    }
    entries_.push_back(entry);
}

std::vector<std::byte> History::bytes() const
{
    const std::uint64_t head[2] = {kMark, sealOf(entries_)};
    std::vector<std::byte> out(sizeof head + entries_.size() * sizeof(Entry));
    std::memcpy(out.data(), head, sizeof head);
    if (!entries_.empty()) std::memcpy(out.data() + sizeof head, entries_.data(), entries_.size() * sizeof(Entry));
    return out;
}

History History::read(std::span<const std::byte> bytes)
{
    std::uint64_t head[2] = {0, 0};
    if (bytes.size() >= sizeof head) std::memcpy(head, bytes.data(), sizeof head);
    if (head[0] != kMark || (bytes.size() - sizeof head) % sizeof(Entry) != 0)
        fail("the saved state is none of this engine's; restore what save() gave.");
    History history;
    history.entries_.resize((bytes.size() - sizeof head) / sizeof(Entry));
    if (!history.entries_.empty())
        std::memcpy(history.entries_.data(), bytes.data() + sizeof head, bytes.size() - sizeof head);
    if (sealOf(history.entries_) != head[1]) fail("the saved state is damaged: its bytes are not as they were saved.");
    for (const Entry& entry : history.entries_)
        if (entry.deed > Deed::Wake || (entry.deed == Deed::Step && !(entry.x > 0 && entry.x <= 1)))
            fail("the saved state is none of this engine's; restore what save() gave.");
    return history;
}

bool History::continues(const History& past, std::vector<Entry>& rest) const
{
    const std::size_t known = past.entries_.size();
    if (known > entries_.size()) return false;
    rest.assign(entries_.begin() + static_cast<std::ptrdiff_t>(known), entries_.end());
    if (known == 0) return true;
    for (std::size_t i = 0; i + 1 < known; ++i)
        if (!(past.entries_[i] == entries_[i])) return false;
    // The last one may be steps that go on.
    Entry last = entries_[known - 1];
    const Entry& before = past.entries_.back();
    if (last == before) return true;
    if (last.deed != Deed::Step || before.deed != Deed::Step || last.x != before.x || last.count < before.count)
        return false;
    last.count -= before.count;
    rest.insert(rest.begin(), last);
    return true;
}

}  // namespace jet::box2d
