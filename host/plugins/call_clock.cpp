#include "call_clock.hpp"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace jet::host {

namespace {

bool countsEvenly()
{
#if defined(__x86_64__)
    constexpr unsigned kPowerManagement = 0x80000007, kInvariantTsc = 1U << 8;
    unsigned a = 0, b = 0, c = 0, d = 0;
    return __get_cpuid(kPowerManagement, &a, &b, &c, &d) != 0 && (d & kInvariantTsc) != 0;
#else
    return false;
#endif
}

}  // namespace

const bool CallClock::even_ = countsEvenly();

namespace {

struct Instant {
    std::uint64_t ticks = CallClock::now();
    std::chrono::steady_clock::time_point time = std::chrono::steady_clock::now();
};
const Instant kStart;  // after even_, which it uses

}  // namespace

double CallClock::ticksPerMs()
{
    constexpr double kLongEnoughMs = 1;  // two readings 25 ns apart are then exact to 0.01 %
    Instant now;
    const auto elapsed = [&] { return std::chrono::duration<double, std::milli>(now.time - kStart.time).count(); };
    while (elapsed() < kLongEnoughMs) now = Instant();
    return static_cast<double>(now.ticks - kStart.ticks) / elapsed();
}

}  // namespace jet::host
