// States are kept in groups: a whole one first, then differences. A group is dropped as a whole, and a state in the
// middle of one is unpacked from its beginning, which is why groups are short.
#include <jet/rewind.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>

namespace jet {

namespace {

constexpr std::size_t kGroup = 24;  // states
using Words = std::vector<std::uint64_t>;

Words wordsOf(std::span<const std::byte> bytes)
{
    Words words((bytes.size() + 7) / 8, 0);
    if (!bytes.empty()) std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

/// Near 0 for values that go on as they did: floating-point numbers of one exponent are ordered as their bits are, so
/// that bodies that move evenly are foreseen. Small differences of either sign become small numbers (zigzag).
std::uint64_t difference(std::uint64_t value, std::uint64_t before, std::uint64_t earlier)
{
    const std::uint64_t off = value - (2 * before - earlier);
    return (off << 1) ^ (0 - (off >> 63));
}
std::uint64_t undo(std::uint64_t coded, std::uint64_t before, std::uint64_t earlier)
{
    const std::uint64_t off = (coded >> 1) ^ (0 - (coded & 1));
    return off + (2 * before - earlier);
}

std::size_t sizeOf(std::uint64_t value)
{
    std::size_t bytes = 0;
    for (; value > 0; value >>= 8) ++bytes;
    return bytes;
}

/// Two words share a byte that tells how long both are; then their bytes that are not null.
std::vector<std::byte> pack(const Words& now, const Words& before, const Words& earlier)
{
    std::vector<std::byte> out;
    out.reserve(now.size() * 5);
    for (std::size_t i = 0; i < now.size(); i += 2) {
        std::uint64_t value[2] = {difference(now[i], before[i], earlier[i]), 0};
        if (i + 1 < now.size()) value[1] = difference(now[i + 1], before[i + 1], earlier[i + 1]);
        const std::size_t size[2] = {sizeOf(value[0]), sizeOf(value[1])};
        out.push_back(static_cast<std::byte>(size[0] | size[1] << 4));
        for (int k = 0; k < 2; ++k) {
            const auto* bytes = reinterpret_cast<const std::byte*>(&value[k]);
            out.insert(out.end(), bytes, bytes + size[k]);
        }
    }
    out.shrink_to_fit();
    return out;
}

Words unpack(const std::vector<std::byte>& packed, const Words& before, const Words& earlier)
{
    Words now(before.size());
    const std::byte* at = packed.data();
    for (std::size_t i = 0; i < now.size(); i += 2) {
        const auto sizes = static_cast<std::size_t>(*at++);
        const std::size_t size[2] = {sizes & 15U, sizes >> 4};
        for (std::size_t k = 0; k < 2 && i + k < now.size(); ++k) {
            std::uint64_t value = 0;
            std::memcpy(&value, at, size[k]);
            at += size[k];
            now[i + k] = undo(value, before[i + k], earlier[i + k]);
        }
    }
    return now;
}

struct Packed {
    std::uint64_t step = 0;
    std::vector<std::byte> bytes;
};

struct Group {
    std::size_t size = 0;  // of a state, bytes
    Words first;
    std::vector<Packed> states;  // the first one has no bytes of its own
    std::size_t memory = 0;

    Words at(std::size_t index) const
    {
        Words before = first, earlier = first;
        for (std::size_t i = 1; i <= index; ++i) {
            Words now = unpack(states[i].bytes, before, earlier);
            earlier = std::move(before), before = std::move(now);
        }
        return before;
    }
};

}  // namespace

struct RewindHistory::Private {
    RewindLimits limits;
    double timeStep = 1.0 / 60;
    std::deque<Group> groups;
    std::size_t memory = 0;
    std::uint32_t interval = 1;
    Words before, earlier;  // the two last states of the last group

    std::uint64_t mostSteps() const { return static_cast<std::uint64_t>(std::ceil(limits.seconds / timeStep)); }
    bool empty() const { return groups.empty(); }
    std::uint64_t newest() const { return groups.back().states.back().step; }
    std::uint64_t oldest() const { return groups.front().states.front().step; }

    void begin(std::uint64_t step, std::size_t size, Words words)
    {
        Group group;
        group.size = size;
        group.memory = words.size() * 8 + sizeof(Group);
        group.first = words;
        group.states.push_back({step, {}});
        memory += group.memory;
        groups.push_back(std::move(group));
        before = words, earlier = std::move(words);
    }

    void append(std::uint64_t step, Words words)
    {
        Group& group = groups.back();
        Packed packed{step, pack(words, before, earlier)};
        group.memory += packed.bytes.size() + sizeof(Packed);
        memory += packed.bytes.size() + sizeof(Packed);
        group.states.push_back(std::move(packed));
        earlier = std::move(before), before = std::move(words);
    }

    void forgetFrom(std::uint64_t step)
    {
        while (!groups.empty() && groups.back().states.front().step >= step) drop(groups.back()), groups.pop_back();
        if (groups.empty() || newest() < step) return;
        Group& group = groups.back();
        while (group.states.back().step >= step) {
            const std::size_t freed = group.states.back().bytes.size() + sizeof(Packed);
            group.memory -= freed, memory -= freed;
            group.states.pop_back();
        }
        before = group.at(group.states.size() - 1);
        earlier = group.states.size() > 1 ? group.at(group.states.size() - 2) : before;
    }

    void drop(const Group& group) { memory -= group.memory; }

    /// A group may go when the one after it reaches back far enough. Where all of that takes too much memory, fewer
    /// states are kept from now on.
    void keepWithin(std::uint64_t newestStep)
    {
        while (groups.size() > 1 && groups[1].states.front().step + mostSteps() <= newestStep)
            drop(groups.front()), groups.pop_front();
        while (groups.size() > 1 && memory > limits.bytes) {
            const std::uint64_t kept = newestStep - oldest();
            if (kept < mostSteps() && interval < 60) interval = std::min(60U, interval * 2);
            drop(groups.front()), groups.pop_front();
        }
    }
};

RewindHistory::RewindHistory(RewindLimits limits, double timeStep) : d_(std::make_unique<Private>())
{
    d_->limits = limits;
    d_->timeStep = timeStep;
}
RewindHistory::~RewindHistory() = default;

bool RewindHistory::wants(std::uint64_t step) const
{
    return d_->limits.seconds > 0 && (d_->empty() || step % d_->interval == 0 || step <= d_->newest());
}

void RewindHistory::record(std::uint64_t step, std::span<const std::byte> state)
{
    auto& d = *d_;
    if (!(d.limits.seconds > 0)) return;
    d.forgetFrom(step);
    Words words = wordsOf(state);
    const bool fits = !d.empty() && d.groups.back().size == state.size() && d.groups.back().states.size() < kGroup;
    fits ? d.append(step, std::move(words)) : d.begin(step, state.size(), std::move(words));
    d.keepWithin(step);
}

void RewindHistory::clear()
{
    d_->groups.clear();
    d_->memory = 0;
    d_->interval = 1;
}

std::optional<RewindHistory::State> RewindHistory::find(std::uint64_t step) const
{
    if (d_->empty()) return std::nullopt;
    const auto after = std::find_if(d_->groups.begin(), d_->groups.end(),
                                    [&](const Group& group) { return group.states.front().step > step; });
    const Group& group = after == d_->groups.begin() ? d_->groups.front() : *std::prev(after);
    std::size_t index = 0;
    while (index + 1 < group.states.size() && group.states[index + 1].step <= step) ++index;
    const Words words = group.at(index);
    State state{group.states[index].step, std::vector<std::byte>(group.size)};
    if (group.size > 0) std::memcpy(state.bytes.data(), words.data(), group.size);
    return state;
}

RewindState RewindHistory::state() const
{
    RewindState state;
    if (d_->empty()) return state;
    state.any = true;
    state.oldest = d_->oldest(), state.newest = d_->newest();
    state.bytes = d_->memory, state.interval = d_->interval;
    return state;
}

}  // namespace jet
