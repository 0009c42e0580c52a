#include "pool.hpp"

#include <algorithm>
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
    shares_ = std::vector<Share>(static_cast<std::size_t>(threads_));
    for (std::size_t i = 1; i < shares_.size(); ++i) workers_.emplace_back([this, i] { serve(i); });
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

bool Pool::take(std::size_t self, std::size_t& block)
{
    for (std::size_t i = 0; i < shares_.size(); ++i) {
        Share& share = shares_[(self + i) % shares_.size()];
        std::uint64_t ticket = share.ticket.load(std::memory_order_acquire);
        while (ticket % kTask != 0)
            if (share.ticket.compare_exchange_weak(ticket, ticket - 1, std::memory_order_acq_rel)) {
                block = share.first + ticket % kTask - 1;
                return true;
            }
    }
    return false;
}

bool Pool::anyLeft() const
{
    return std::any_of(shares_.begin(), shares_.end(),
                       [](const Share& share) { return share.ticket.load() % kTask != 0; });
}

void Pool::fork(Call call, void* what, std::size_t blocks)
{
    if (workers_.empty()) start();
    call_ = call, what_ = what;
    done_.store(0, std::memory_order_relaxed);
    task_ += kTask;
    for (std::size_t i = 0; i < shares_.size(); ++i) {
        const std::size_t first = i * blocks / shares_.size(), last = (i + 1) * blocks / shares_.size();
        shares_[i].first = first;
        shares_[i].ticket.store(task_ + (last - first));
    }
    if (sleeping_.load() > 0) {
        const std::lock_guard lock(mutex_);
        wake_.notify_all();
    }
    std::size_t mine = 0;
    for (std::size_t block = 0; take(0, block); ++mine) call(what, block);
    done_.fetch_add(mine, std::memory_order_acq_rel);
    // The others are in the midst of their last block; if they have lost their processor, ours may be what they need.
    for (int round = 0; done_.load(std::memory_order_acquire) != blocks; ++round) {
        pause();
        if (round > 2000) std::this_thread::yield();
    }
}

void Pool::serve(std::size_t self)
{
    using Clock = std::chrono::steady_clock;
    auto idleSince = Clock::now();
    while (!stopping_.load(std::memory_order_relaxed)) {
        std::size_t block = 0, mine = 0;
        for (; take(self, block); ++mine) {
            call_(what_, block);
            done_.fetch_add(1, std::memory_order_acq_rel);
        }
        if (mine > 0) idleSince = Clock::now();
        for (int i = 0; i < 64 && !anyLeft(); ++i) pause();
        if (anyLeft() || Clock::now() - idleSince < kPatience) continue;
        std::unique_lock lock(mutex_);
        ++sleeping_;
        wake_.wait(lock, [this] { return stopping_ || anyLeft(); });
        --sleeping_;
        idleSince = Clock::now();
    }
}

}  // namespace jet::physics
