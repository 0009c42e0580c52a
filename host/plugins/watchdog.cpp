#include "watchdog.hpp"

#include "guard.hpp"

#include <algorithm>

namespace jet::host {

Watchdog::Watchdog(std::chrono::milliseconds interval, double patience)
    : interval_(interval), patience_(patience), thread_([this] { run(); })
{
}

Watchdog::~Watchdog()
{
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void Watchdog::run()
{
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, interval_, [this] { return quit_; })) look();
}

void Watchdog::look() const
{
    const double ticksPerMs = CallClock::ticksPerMs();
    for (ThreadCalls& calls : CallBoard::memory().threads) {
        const std::uint32_t depth = calls.depth.load(std::memory_order_acquire);
        if (depth == 0 || depth > ThreadCalls::kDepth || calls.thread == 0) continue;
        // A copy; if the call returns meanwhile, the depth or the beginning differs when looked at again.
        const CallFrame frame = calls.frames[depth - 1];
        const std::uint64_t now = CallClock::now();
        const double ms =
            static_cast<double>(now - std::min(now, std::max(frame.began, calls.alive.load()))) / ticksPerMs;
        if (ms < infoOf(frame.callback).hangMs * patience_ || calls.told == frame.began) continue;
        if (calls.depth != depth || calls.frames[depth - 1].began != frame.began) continue;
        calls.told = frame.began;
        CallAccount::with(frame.plugin,
                          [&](Plugin& plugin, Guard& guard) { guard.hangs(plugin, frame.callback, ms / 1000); });
    }
}

}  // namespace jet::host
