#include "pool.hpp"

#include <algorithm>
#include <chrono>

namespace jet::physics {

namespace {

// How long a worker waits for the next task before it sleeps: after a step, and between the tasks of one. Where steps
// follow each other within kShortPause, it is twice the pause before the last one. To wake it takes some 20 µs and
// more.
constexpr auto kPatience = std::chrono::microseconds(60), kAttention = std::chrono::microseconds(2000);
constexpr auto kShortPause = std::chrono::microseconds(250);
// Pauses a thread is given to begin its share, a few microseconds: its data are not in the other's cache.
constexpr int kRespite = 150;
// A worker that is this late, and four times as late as the caller was busy, has lost its processor.
constexpr auto kStall = std::chrono::microseconds(500);
constexpr int kShortestRest = 8, kLongestRest = 256;  // steps

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
    threads_ = used_ = threads;
    rest_ = 0;
}

void Pool::beginStep()
{
    stalled_ = false;
    used_ = rest_ > 0 ? 1 : threads_;
    rest_ = std::max(rest_ - 1, 0);
    const auto pause = Clock::now() - ended_;
    patience_.store(pause <= kShortPause ? std::max<Clock::duration>(2 * pause, kPatience) : kPatience,
                    std::memory_order_relaxed);
    attended_.store(used_ > 1, std::memory_order_relaxed);
}

void Pool::endStep()
{
    attended_.store(false, std::memory_order_relaxed);
    if (stalled_) {
        nextRest_ = std::min(std::max(2 * nextRest_, kShortestRest), kLongestRest);
        rest_ = nextRest_;
    } else if (used_ > 1) {
        nextRest_ = std::max(nextRest_ - 1, 0);
    }
    used_ = threads_;
    ended_ = Clock::now();
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

/// How many blocks of it were done here.
std::size_t Pool::finishShare(Share& share, bool own)
{
    std::size_t mine = 0;
    std::uint64_t ticket = share.ticket.load(std::memory_order_acquire);
    for (int i = 0;
         !own && i < kRespite && ticket % kTask != 0 && ticket % kTask == share.count.load(std::memory_order_relaxed);
         ++i) {
        pause();
        ticket = share.ticket.load(std::memory_order_acquire);
    }
    while (ticket % kTask != 0)
        if (share.ticket.compare_exchange_weak(ticket, ticket - 1, std::memory_order_acq_rel)) {
            share.call(share.what, share.first + share.count.load(std::memory_order_relaxed) - ticket % kTask);
            ++mine;
            ticket = share.ticket.load(std::memory_order_acquire);
        }
    return mine;
}

std::size_t Pool::finishOthers(std::size_t self)
{
    std::size_t mine = 0;
    for (std::size_t i = 1; i < shares_.size(); ++i) mine += finishShare(shares_[(self + i) % shares_.size()], false);
    return mine;
}

void Pool::fork(Call call, void* what, std::size_t blocks)
{
    if (workers_.empty()) start();
    const auto since = Clock::now();
    done_.store(0, std::memory_order_relaxed);
    task_ += kTask;
    // The caller's own comes last, so that nobody takes from it before he has one himself.
    for (std::size_t i = shares_.size(); i-- > 0;) {
        const std::size_t first = i * blocks / shares_.size(), last = (i + 1) * blocks / shares_.size();
        shares_[i].first = first, shares_[i].call = call, shares_[i].what = what;
        shares_[i].count.store(last - first, std::memory_order_relaxed);
        shares_[i].ticket.store(task_ + (last - first));
    }
    if (sleeping_.load() > 0) {
        const std::lock_guard lock(mutex_);
        wake_.notify_all();
    }
    std::size_t mine = finishShare(shares_[0], true);
    mine += finishOthers(0);
    if (mine > 0) done_.fetch_add(mine, std::memory_order_acq_rel);
    await(blocks, since);
}

/// The others are in the midst of their last blocks; if they have lost their processor, ours may be what they need.
void Pool::await(std::size_t blocks, Clock::time_point since)
{
    const auto finished = [&] { return done_.load(std::memory_order_acquire) == blocks; };
    const auto mine = Clock::now() - since;
    for (int round = 0; round < 2000; ++round) {
        if (finished()) return;
        pause();
    }
    while (!finished()) std::this_thread::yield();
    const auto late = Clock::now() - since - mine;
    stalled_ = stalled_ || (late > kStall && late > 4 * mine);
}

void Pool::serve(std::size_t self)
{
    auto idleSince = Clock::now();
    std::uint64_t seen = 0;
    while (!stopping_.load(std::memory_order_relaxed)) {
        if (isNew(self, seen)) {
            seen = shares_[self].ticket.load() / kTask;
            if (const std::size_t mine = finishShare(shares_[self], true); mine > 0)
                done_.fetch_add(mine, std::memory_order_acq_rel);
            if (const std::size_t mine = finishOthers(self); mine > 0) done_.fetch_add(mine, std::memory_order_acq_rel);
            idleSince = Clock::now();
        }
        for (int i = 0; i < 64 && !isNew(self, seen); ++i) pause();
        if (isNew(self, seen)) continue;
        const auto idle = Clock::now() - idleSince;
        if (idle < kPatience) continue;
        const Clock::duration patience =
            attended_.load(std::memory_order_relaxed) ? kAttention : patience_.load(std::memory_order_relaxed);
        if (idle < patience) {
            std::this_thread::yield();  // who else wants the processor may have it
            continue;
        }
        std::unique_lock lock(mutex_);
        ++sleeping_;
        wake_.wait(lock, [&] { return stopping_ || isNew(self, seen); });
        --sleeping_;
        idleSince = Clock::now();
    }
}

}  // namespace jet::physics
