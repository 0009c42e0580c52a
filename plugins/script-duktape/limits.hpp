// What scripts may use: time per call, memory in all, native stack. One Budget a heap; the heap's user data leads to
// it.
//
// Order of calls: begin · (Duktape runs and asks through jet_script_...) · end, never nested. Outside, time is not
// limited.
#pragma once

#include <chrono>
#include <cstddef>

namespace jet::duktape {

class Play;

struct Limits {
    std::chrono::nanoseconds call = std::chrono::milliseconds(50);  ///< one run of a script, one call of a listener
    std::size_t memory = 64U << 20;                                 ///< bytes, all scripts of a simulation together
    std::size_t stack = 2U << 20;  ///< bytes of native stack below the call into Duktape
    std::size_t listenersPerEvent = 1000;
};

class Budget;

/// Duktape's user data. The fuel comes first: JET_SCRIPT_TICK counts it down in place (see duk_overrides.h).
struct HeapData {
    int fuel = 0;
    Budget* budget = nullptr;
    Play* play = nullptr;
};

class Budget {
public:
    explicit Budget(const Limits& limits);
    Budget(const Budget&) = delete;
    Budget& operator=(const Budget&) = delete;

    /// Starts the clock of one call.
    void begin(std::chrono::nanoseconds time);
    void end() { running_ = false; }
    bool isRunning() const { return running_; }

    /// Did the present call, or the last one, use up its time? Its memory?
    bool timedOut() const { return timedOut_; }
    bool outOfMemory() const { return outOfMemory_; }

    /// Looks at the clock; true when the call must stop. Then there is fuel to make the error object, and the next
    /// question.
    bool mustStop();
    bool stackIsLow() const;

    // The heap's allocator. Null when the limit is reached; Duktape then collects garbage and tries again.
    void* allocate(std::size_t size);
    void* reallocate(void* block, std::size_t size);
    void release(void* block);
    /// Duktape has tried in vain: the call must stop. From here on there is a reserve for the error object.
    void memoryIsOut() { outOfMemory_ = true; }
    std::size_t memoryUsed() const { return used_; }
    std::size_t memoryLimit() const { return memoryLimit_; }
    /// Room for the others after a script that filled the memory was stopped: an eighth more each time, up to twice the
    /// limit.
    void growMemoryLimit();

    const Limits& limits() const { return limits_; }
    HeapData* heapData() { return &data_; }
    static Budget& of(void* heapData) { return *static_cast<HeapData*>(heapData)->budget; }

private:
    bool reserve(std::size_t bytes);

    HeapData data_;
    Limits limits_;
    std::chrono::steady_clock::time_point deadline_;
    std::chrono::nanoseconds time_{0};
    std::chrono::nanoseconds processorTimeAtStart_{0};
    bool processorTimeKnown_ = false;
    const char* stackStart_ = nullptr;
    std::size_t used_ = 0;
    std::size_t memoryLimit_;
    bool outOfMemory_ = false;
    bool running_ = false;
    bool timedOut_ = false;
};

}  // namespace jet::duktape
