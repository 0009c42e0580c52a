// What threads share costs time: a line of memory that one of them writes is fetched anew by all others.
#pragma once

#include <atomic>

namespace jet::physics {

/// Asks for a line that is going to be written, some rounds before: unlike __builtin_prefetch(at, 1), which without
/// -mprfchw only asks to read, this takes it from other threads as well. Processors without the instruction pass over
/// it.
inline void prefetchToWrite(const void* at)
{
#if defined(__x86_64__)
    asm volatile("prefetchw %0" : : "m"(*static_cast<const char*>(at)));
#else
    __builtin_prefetch(at, 1);
#endif
}

/// Raised by any thread, again and again; its line is written once.
class Flag {
public:
    void raise()
    {
        if (!raised_.load(std::memory_order_relaxed)) raised_.store(true, std::memory_order_relaxed);
    }
    void lower() { raised_.store(false, std::memory_order_relaxed); }
    explicit operator bool() const { return raised_.load(std::memory_order_relaxed); }

private:
    std::atomic<bool> raised_ = false;
};

}  // namespace jet::physics
