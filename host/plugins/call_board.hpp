// CallBoard: which plugin is in which callback on each thread, right now. One a process, in memory that may be a file:
// what stood there when the process died is the crash ledger (see crash_ledger.hpp). Entering and leaving are a few
// stores; no system call, no lock.
#pragma once

#include "call_clock.hpp"
#include "callbacks.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace jet::host {

/// One call into a plugin that has not returned.
struct CallFrame {
    std::uint16_t plugin = 0;  ///< index into BoardMemory::plugins
    Callback callback = Callback::None;
    std::uint32_t openBefore = 0;  ///< transactions open when a listener was called
    std::uint64_t began = 0;       ///< ticks of CallClock
    std::uint64_t inner = 0;       ///< ticks spent in guarded calls made from within
};

/// The calls of one thread, outermost first.
struct alignas(64) ThreadCalls {
    static constexpr std::uint32_t kDepth = 14;  // deeper calls are counted, not noted

    std::atomic<std::int32_t> thread{0};  ///< id of the thread; 0: free
    std::atomic<std::uint32_t> depth{0};
    std::atomic<std::uint64_t> told{0};   ///< when the call began that the user was told about (see Watchdog)
    std::atomic<std::uint64_t> alive{0};  ///< when the thread last showed that it works on
    CallFrame frames[kDepth];

    CallFrame& enter(std::uint16_t plugin, Callback callback, std::uint64_t now)
    {
        const std::uint32_t level = depth.load(std::memory_order_relaxed);
        CallFrame& frame = frames[level < kDepth ? level : kDepth - 1];
        frame.plugin = plugin;
        frame.callback = callback;
        frame.began = now;
        frame.inner = 0;
        depth.store(level + 1, std::memory_order_release);
        return frame;
    }
    /// A sign of life from inside a call: progress is reported, or events are handled.
    void showLife() { alive.store(CallClock::now(), std::memory_order_relaxed); }
    /// Ticks of the call itself, without the guarded calls made from within.
    std::uint64_t leave(std::uint64_t now)
    {
        const std::uint32_t level = depth.load(std::memory_order_relaxed) - 1;
        depth.store(level, std::memory_order_release);
        if (level >= kDepth) return 0;
        const std::uint64_t took = now - frames[level].began;
        if (level > 0) frames[level - 1].inner += took;
        return took - frames[level].inner;
    }
};

/// A piece of a plugin's library in memory.
struct CodeRange {
    std::atomic<std::uintptr_t> begin{0}, end{0};
    std::atomic<std::uint16_t> plugin{0};
};

/// Plain data, the same in memory and in the file.
struct BoardMemory {
    static constexpr std::uint64_t kMagic = 0x314452414f42544aULL;  // "JTBOARD1"
    static constexpr std::size_t kThreads = 128, kPlugins = 2048, kRanges = 4096, kTitle = 112;

    std::uint64_t magic = kMagic;
    std::uint64_t layout = sizeof(BoardMemory);
    std::int64_t startedAt = 0;  ///< seconds since 1970
    char boot[40] = {};          ///< of the machine: who ran before it started cannot have crashed
    char command[256] = {};
    // Written by the signal handler.
    std::atomic<std::int32_t> signal{0};
    std::atomic<std::int32_t> signalThread{0};
    std::atomic<std::uint16_t> signalPlugin{0};  ///< whose code it happened in; 0: not known
    std::atomic<std::int32_t> exitThread{0};     ///< called exit() from inside a callback
    std::atomic<bool> ending{false};             ///< main has returned: static destructors run

    std::atomic<std::uint32_t> pluginCount{1};  // 0 is nobody
    std::atomic<std::uint32_t> rangeCount{0};
    ThreadCalls threads[kThreads];
    char plugins[kPlugins][kTitle] = {};  ///< "id version"
    CodeRange ranges[kRanges];
};

class CallBoard {
public:
    static BoardMemory& memory() { return *memory_; }

    /// The calling thread's calls.
    static ThreadCalls& here()
    {
        if (ThreadCalls* mine = here_) [[likely]]
            return *mine;
        return join();
    }
    /// The same without taking a place for a thread that has none: for signal handlers.
    static ThreadCalls* hereIfAny() { return here_; }

    /// A place for a plugin; 0 when all are taken (it is then guarded, but not named in a ledger).
    static std::uint16_t addPlugin(std::string_view title);
    /// Notes where the library at this address lies in memory. [any thread]
    static void addCode(std::uint16_t plugin, const void* anyAddress);
    /// Gives back the memory of the read-only parts of the library at this address; they are read again when used.
    static void releaseCode(const void* anyAddress);
    /// After it was really unloaded.
    static void removeCode(std::uint16_t plugin);
    /// Whose code it is; 0: not a plugin's. Safe in a signal handler.
    static std::uint16_t ownerOf(const void* code);
    /// The first plugin (or only this one) with a return address on the stack from there on; 0 if none. A guess, and a
    /// good one. Safe in a signal handler.
    static std::uint16_t ownerOnStack(const void* from, std::uint16_t only = 0);

    /// Puts the board into this file, where it outlives the process.
    static bool moveTo(int file);

private:
    static ThreadCalls& join();
    static BoardMemory* create();

    static BoardMemory* const memory_;
    static inline thread_local constinit ThreadCalls* here_ = nullptr;
};

}  // namespace jet::host
