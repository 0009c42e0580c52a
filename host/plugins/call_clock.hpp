// The clock of the guard: the processor's time stamp counter where it runs evenly (8 ns a reading), else steady_clock.
#pragma once

#include <chrono>
#include <cstdint>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace jet::host {

class CallClock {
public:
    static std::uint64_t now()
    {
#if defined(__x86_64__)
        if (even_) [[likely]]
            return __rdtsc();
#endif
        return steady();
    }
    /// Measured against steady_clock since the program started.
    static double ticksPerMs();

private:
    static std::uint64_t steady()
    {
        return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
    }
    static const bool even_;
};

}  // namespace jet::host
