#include "pool.hpp"

#include <chrono>

namespace jet::physics {

namespace {

constexpr std::uint64_t kTask = std::uint64_t{1} << 32;
constexpr auto kPatience = std::chrono::microseconds(60);  // how long a worker waits for the next task before it sleeps

void pause()
{
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

}  // namespace

Pool::~Pool() { stop(); }

void Pool::setThreads(int threads)
{
    threads = std::clamp(threads, 1, 64);
    if (threads == threads_) return;
    stop();
    threads_ = threads;
}

void Pool::start()
{
    for (int i = 1; i < threads_; ++i) workers_.emplace_back([this] { serve(); });
}

void Pool::stop()
{
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
    workers_.clear();
    stopping_ = false;
}

bool Pool::take(std::size_t& block)
{
    std::uint64_t ticket = ticket_.load(std::memory_order_acquire);
    while (ticket % kTask != 0)
        if (ticket_.compare_exchange_weak(ticket, ticket - 1, std::memory_order_acq_rel)) {
            block = ticket % kTask - 1;
            return true;
        }
    return false;
}

void Pool::fork(Call call, void* what, std::size_t blocks)
{
    if (workers_.empty()) start();
    call_ = call, what_ = what;
    done_.store(0, std::memory_order_relaxed);
    ticket_.store((ticket_.load(std::memory_order_relaxed) / kTask + 1) * kTask + blocks);
    if (sleeping_.load() > 0) {
        const std::lock_guard lock(mutex_);
        wake_.notify_all();
    }
    std::size_t mine = 0;
    for (std::size_t block = 0; take(block); ++mine) call(what, block);
    done_.fetch_add(mine, std::memory_order_acq_rel);
    // The others are in the midst of their last block; if they have lost their processor, ours may be what they need.
    for (int round = 0; done_.load(std::memory_order_acquire) != blocks; ++round) {
        pause();
        if (round > 2000) std::this_thread::yield();
    }
}

void Pool::serve()
{
    using Clock = std::chrono::steady_clock;
    auto idleSince = Clock::now();
    while (!stopping_.load(std::memory_order_relaxed)) {
        std::size_t block = 0;
        if (take(block)) {
            call_(what_, block);
            done_.fetch_add(1, std::memory_order_acq_rel);
            idleSince = Clock::now();
            continue;
        }
        for (int i = 0; i < 64 && ticket_.load(std::memory_order_relaxed) % kTask == 0; ++i) pause();
        if (ticket_.load(std::memory_order_relaxed) % kTask != 0 || Clock::now() - idleSince < kPatience) continue;
        std::unique_lock lock(mutex_);
        ++sleeping_;
        wake_.wait(lock, [this] { return stopping_ || ticket_.load() % kTask != 0; });
        --sleeping_;
        idleSince = Clock::now();
    }
}

}  // namespace jet::physics
