// CallAccount: what the calls into one plugin cost, by callback. Written by whoever calls, read by the Plugins panel
// and `jet plugins info`.
#pragma once

#include "call_board.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace jet::host {

class Guard;
struct Plugin;

/// Of one callback, since the plugin was loaded.
struct CallbackTime {
    Callback callback = Callback::None;
    std::uint64_t calls = 0;
    double totalMs = 0;          ///< in the plugin itself, without other plugins it led to
    double longestMs = 0;        ///< of one call
    std::uint64_t overruns = 0;  ///< calls that took longer than the callback's budget
};

class CallAccount {
public:
    CallAccount(Plugin& plugin, Guard& guard, std::string_view title);
    ~CallAccount();
    CallAccount(const CallAccount&) = delete;
    CallAccount& operator=(const CallAccount&) = delete;

    /// On the CallBoard.
    std::uint16_t place() const { return place_; }
    void add(Callback callback, std::uint64_t ticks)
    {
        Entry& entry = entries_[static_cast<std::size_t>(callback)];
        entry.calls.fetch_add(1, std::memory_order_relaxed);
        entry.ticks.fetch_add(ticks, std::memory_order_relaxed);
        if (ticks > entry.longest.load(std::memory_order_relaxed)) [[unlikely]]
            addLongest(entry, ticks);
        if (ticks > entry.budget) [[unlikely]]
            entry.overruns.fetch_add(1, std::memory_order_relaxed);
    }
    /// Event listeners of the plugin that have not ended.
    int listeners() const { return listeners_; }
    void addListeners(int change) { listeners_ += change; }
    Plugin& plugin() const { return plugin_; }
    Guard& guard() const { return guard_; }
    /// Callbacks that were called at least once, the most expensive first. [any thread]
    std::vector<CallbackTime> times() const;

    /// The account at that place of the board; null if none. [thread that owns the plugin manager]
    static CallAccount* at(std::uint16_t place);
    /// Calls fn with the plugin at that place and its guard, which are held alive meanwhile. False: none. [any thread]
    template <class Fn>
    static bool with(std::uint16_t place, Fn&& fn)
    {
        struct Call {
            Fn& fn;
        } call{fn};
        return withErased(
            place, [](Plugin& plugin, Guard& guard, void* data) { static_cast<Call*>(data)->fn(plugin, guard); },
            &call);
    }

private:
    struct Entry {
        std::atomic<std::uint64_t> calls{0}, ticks{0}, longest{0}, overruns{0};
        std::uint64_t budget = ~std::uint64_t{0};  // ticks
    };
    static void addLongest(Entry& entry, std::uint64_t ticks);
    static bool withErased(std::uint16_t place, void (*fn)(Plugin&, Guard&, void*), void* data);

    Plugin& plugin_;
    Guard& guard_;
    std::uint16_t place_;
    std::atomic<int> listeners_{0};
    std::array<Entry, static_cast<std::size_t>(Callback::Count)> entries_;
};

/// One guarded call: on the board, and on the plugin's account.
class CallScope {
public:
    CallScope(CallAccount& account, Callback callback)
        : account_(account), calls_(CallBoard::here()), callback_(callback)
    {
        calls_.enter(account.place(), callback, CallClock::now());
    }
    ~CallScope() { account_.add(callback_, calls_.leave(CallClock::now())); }
    CallScope(const CallScope&) = delete;
    CallScope& operator=(const CallScope&) = delete;

private:
    CallAccount& account_;
    ThreadCalls& calls_;
    Callback callback_;
};

}  // namespace jet::host
