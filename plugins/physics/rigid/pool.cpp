#include "pool.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace jet::physics {

namespace {

// How long a worker waits for the next task before it sleeps: after a step, and between the tasks of one. Where steps
// follow each other within kShortPause, it is twice the pause before the last one. To wake one takes 20 to 45 µs of the
// caller's time, and it begins later still.
constexpr auto kPatience = std::chrono::microseconds(60), kAttention = std::chrono::microseconds(2000);
constexpr auto kShortPause = std::chrono::microseconds(1000);
// Pauses a thread is given to begin its share, a few microseconds: its data are not in the other's cache.
constexpr int kRespite = 150;
// A worker that is this late, and four times as late as the caller was busy, has lost its processor.
constexpr auto kStall = std::chrono::microseconds(500);
constexpr int kShortestRest = 8, kLongestRest = 256;  // steps
constexpr int kSpins = 2000;  // pauses, before a thread that waits lets others have the processor
// Lines about what a task is about that are asked for at once: it lies on the caller's stack, and so does what it
// refers to.
constexpr int kLinesBefore = 2, kLinesAfter = 8;

void pause()
{
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

void ask(const void* what)
{
    for (int line = -kLinesBefore; line <= kLinesAfter; ++line)
        __builtin_prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(what) +
                                                         static_cast<std::uintptr_t>(64 * line)));
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
    step_.fetch_add(1);
    if (std::exchange(called_, false) && used_ > 1) wakeSleepers();
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
    claims_ = std::vector<Claim>(2 * shares_.size());
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

/// Those that sleep, if any do. Who is about to counts himself before he looks for the last time for what was handed
/// out: either he is seen here, or he sees it.
void Pool::wakeSleepers()
{
    if (sleeping_.fetch_add(0) == 0) return;
    const std::lock_guard lock(mutex_);
    wake_.notify_all();
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
            share.call(share.what.load(std::memory_order_relaxed),
                       share.first + share.count.load(std::memory_order_relaxed) - ticket % kTask);
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

/// Divides the blocks among the threads but those before `from`.
void Pool::handOut(Call call, void* what, std::size_t blocks, std::size_t from)
{
    if (workers_.empty()) start();
    called_ = true;
    done_.store(0, std::memory_order_relaxed);
    task_ += kTask;
    // The caller's own comes last, so that nobody takes from it before he has one himself.
    for (std::size_t i = shares_.size(); i-- > 0;) {
        const std::size_t threads = shares_.size() - from, first = i < from ? 0 : (i - from) * blocks / threads,
                          last = i < from ? 0 : (i - from + 1) * blocks / threads;
        shares_[i].first = first, shares_[i].call = call;
        shares_[i].what.store(what, std::memory_order_relaxed);
        shares_[i].count.store(last - first, std::memory_order_relaxed);
        shares_[i].ticket.store(task_ + (last - first), std::memory_order_release);
    }
}

void Pool::fork(Call call, void* what, std::size_t blocks)
{
    const auto since = Clock::now();
    handOut(call, what, blocks, 0);
    std::size_t mine = finishShare(shares_[0], true);
    wakeSleepers();  // those that do not sleep have long begun
    mine += finishOthers(0);
    if (mine > 0) done_.fetch_add(mine, std::memory_order_acq_rel);
    await(blocks, since);
}

/// The others are in the midst of their last blocks; if they have lost their processor, ours may be what they need.
void Pool::await(std::size_t blocks, Clock::time_point since)
{
    const auto finished = [&] { return done_.load(std::memory_order_acquire) == blocks; };
    const auto mine = Clock::now() - since;
    for (int spin = 0; spin < kSpins; ++spin) {
        if (finished()) return;
        pause();
    }
    while (!finished()) std::this_thread::yield();
    const auto late = Clock::now() - since - mine;
    stalled_ = stalled_ || (late > kStall && late > 4 * mine);
}

/// Nothing is written beside it while others read it.
struct alignas(128) Pool::Rounds {
    const std::function<void(std::size_t, std::size_t)>& work;
    const std::function<void(std::size_t)>& between;
    std::uint64_t first = 0;   // number of the first round
    std::uint64_t helped = 0;  // blocks that workers had done before
    std::size_t count = 0, blocks = 0;
    std::size_t share(std::size_t thread, std::size_t threads) const { return thread * blocks / threads; }
};

void Pool::goRound(std::size_t rounds, std::size_t blocks, const std::function<void(std::size_t, std::size_t)>& work,
                   const std::function<void(std::size_t)>& between)
{
    if (workers_.empty()) start();
    if (blocks > claims_.size()) claims_ = std::vector<Claim>(blocks);
    Rounds task{work,   between, round_.load(std::memory_order_relaxed) + 1, helped_.load(std::memory_order_relaxed),
                rounds, blocks};
    round_.store(task.first, std::memory_order_release);
    // One that comes when all is over finds nothing to do, as does the caller in the place of one that never came.
    const auto part = [&](std::size_t i) { follow(task, i + 1); };
    const auto since = Clock::now();
    handOut([](void* what, std::size_t i) { (*static_cast<decltype(part)*>(what))(i); },
            const_cast<void*>(static_cast<const void*>(&part)), workers_.size(), 1);
    wakeSleepers();
    lead(task);
    if (const std::size_t mine = finishOthers(0); mine > 0) done_.fetch_add(mine, std::memory_order_acq_rel);
    await(workers_.size(), since);
}

bool Pool::claim(std::size_t block, std::uint64_t round)
{
    std::uint64_t last = claims_[block].round.load(std::memory_order_relaxed);
    return last < round && claims_[block].round.compare_exchange_strong(last, round, std::memory_order_acq_rel);
}

std::size_t Pool::claimOwn(const Rounds& task, std::size_t self, std::uint64_t round)
{
    std::size_t mine = 0;
    for (std::size_t block = task.share(self, shares_.size()); block < task.share(self + 1, shares_.size()); ++block)
        if (claim(block, round)) task.work(static_cast<std::size_t>(round - task.first), block), ++mine;
    return mine;
}

/// What nobody has begun.
std::size_t Pool::claimOthers(const Rounds& task, std::uint64_t round)
{
    std::size_t mine = 0;
    for (std::size_t block = 0; block < task.blocks; ++block)
        if (claim(block, round)) task.work(static_cast<std::size_t>(round - task.first), block), ++mine;
    return mine;
}

/// The caller's part: it opens the rounds.
void Pool::lead(Rounds& task)
{
    const auto since = Clock::now();
    std::size_t mine = 0;
    for (std::size_t i = 0; i < task.count; ++i) {
        const std::uint64_t round = task.first + i;
        if (i > 0) round_.store(round, std::memory_order_release);
        mine += claimOwn(task, 0, round);
        const auto finished = [&] {
            return helped_.load(std::memory_order_acquire) - task.helped + mine == (i + 1) * task.blocks;
        };
        for (int spin = 0; spin < kSpins && !finished(); ++spin) {
            pause();
            if (spin % kRespite == kRespite - 1) mine += claimOthers(task, round);
        }
        if (!finished()) {
            const auto waiting = Clock::now();
            while (!finished()) std::this_thread::yield();
            const auto late = Clock::now() - waiting, usual = (waiting - since) / static_cast<Clock::rep>(i + 1);
            stalled_ = stalled_ || (late > kStall && late > 4 * usual);
        }
        task.between(i);
    }
    round_.store(task.first + task.count, std::memory_order_release);
}

void Pool::follow(Rounds& task, std::size_t self)
{
    const std::uint64_t over = task.first + task.count;
    for (std::uint64_t seen = task.first - 1;;) {
        std::uint64_t round = seen;
        for (int spin = 0; (round = round_.load(std::memory_order_acquire)) == seen; ++spin) {
            if (spin < kSpins) {
                pause();
            } else {
                std::this_thread::yield();
            }
        }
        if (round >= over) return;
        seen = round;
        std::size_t mine = claimOwn(task, self, round);
        if (mine > 0) helped_.fetch_add(mine, std::memory_order_acq_rel);
        // Others that are late get help, but not at once.
        for (int spin = 0; spin < kRespite && round_.load(std::memory_order_acquire) == round; ++spin) pause();
        if (round_.load(std::memory_order_acquire) != round) continue;
        mine = claimOthers(task, round);
        if (mine > 0) helped_.fetch_add(mine, std::memory_order_acq_rel);
    }
}

void Pool::serve(std::size_t self)
{
    // Since when is there nothing to do; when was a step last known to go on?
    auto idleSince = Clock::now(), attendedAt = idleSince;
    std::uint64_t seen = 0;
    while (!stopping_.load(std::memory_order_relaxed)) {
        if (isNew(self, seen)) {
            seen = shares_[self].ticket.load() / kTask;
            ask(shares_[self].what.load(std::memory_order_relaxed));
            if (const std::size_t mine = finishShare(shares_[self], true); mine > 0)
                done_.fetch_add(mine, std::memory_order_acq_rel);
            if (const std::size_t mine = finishOthers(self); mine > 0) done_.fetch_add(mine, std::memory_order_acq_rel);
            idleSince = attendedAt = Clock::now();
        }
        for (int i = 0; i < 64 && !isNew(self, seen); ++i) pause();
        if (isNew(self, seen)) continue;
        const auto now = Clock::now();
        const bool attended = attended_.load(std::memory_order_relaxed);
        if (attended) attendedAt = now;
        if (now - idleSince < kPatience) continue;
        // What the caller does alone at the end of a step is no part of the pause after it.
        if (attended ? now - idleSince < kAttention : now - attendedAt < patience_.load(std::memory_order_relaxed)) {
            std::this_thread::yield();  // who else wants the processor may have it
            continue;
        }
        std::unique_lock lock(mutex_);
        const std::uint64_t step = step_.load();
        ++sleeping_;
        wake_.wait(lock, [&] { return stopping_ || isNew(self, seen) || step_.load() != step; });
        --sleeping_;
        idleSince = attendedAt = Clock::now();
    }
}

}  // namespace jet::physics
