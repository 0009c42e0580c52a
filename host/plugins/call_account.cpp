#include "call_account.hpp"

#include <algorithm>
#include <mutex>

namespace jet::host {

namespace {

/// The accounts by their place on the board. Recursive: reporting a plugin may call into another.
struct Directory {
    std::recursive_mutex mutex;
    std::array<std::atomic<CallAccount*>, BoardMemory::kPlugins> accounts{};
};

Directory& directory()
{
    static Directory* const all = new Directory;  // outlives whoever calls while the program ends
    return *all;
}

}  // namespace

CallAccount::CallAccount(Plugin& plugin, Guard& guard, std::string_view title)
    : plugin_(plugin), guard_(guard), place_(CallBoard::addPlugin(title))
{
    const double ticksPerMs = CallClock::ticksPerMs();
    for (std::size_t i = 0; i < entries_.size(); ++i)
        if (const int budget = infoOf(static_cast<Callback>(i)).budgetMs; budget > 0)
            entries_[i].budget = static_cast<std::uint64_t>(budget * ticksPerMs);
    if (place_ == 0) return;
    const std::lock_guard lock(directory().mutex);
    directory().accounts[place_] = this;
}

CallAccount::~CallAccount()
{
    if (place_ == 0) return;
    const std::lock_guard lock(directory().mutex);
    directory().accounts[place_] = nullptr;
}

void CallAccount::addLongest(Entry& entry, std::uint64_t ticks)
{
    std::uint64_t known = entry.longest.load(std::memory_order_relaxed);
    while (known < ticks && !entry.longest.compare_exchange_weak(known, ticks, std::memory_order_relaxed)) {
    }
}

std::vector<CallbackTime> CallAccount::times() const
{
    std::vector<CallbackTime> all;
    const double ticksPerMs = CallClock::ticksPerMs();
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const Entry& entry = entries_[i];
        if (entry.calls == 0) continue;
        all.push_back({static_cast<Callback>(i), entry.calls, static_cast<double>(entry.ticks) / ticksPerMs,
                       static_cast<double>(entry.longest) / ticksPerMs, entry.overruns});
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.totalMs > b.totalMs; });
    return all;
}

CallAccount* CallAccount::at(std::uint16_t place)
{
    return place < BoardMemory::kPlugins ? directory().accounts[place].load(std::memory_order_acquire) : nullptr;
}

bool CallAccount::withErased(std::uint16_t place, void (*fn)(Plugin&, Guard&, void*), void* data)
{
    if (place == 0 || place >= BoardMemory::kPlugins) return false;
    const std::lock_guard lock(directory().mutex);
    const CallAccount* account = directory().accounts[place];
    if (!account) return false;
    fn(account->plugin_, account->guard_, data);
    return true;
}

}  // namespace jet::host
