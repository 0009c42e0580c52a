// The threads of one world. Each has its share of a loop's blocks, the same in each loop, so that data stay in its
// cache; whoever is done takes from the others. Whoever comes late finds nothing left to do, so a machine that is busy
// with other things costs nothing but the help.
//
// What a block does must not depend on who does it or when; then results are the same for any number of threads.
//
// A line of memory that another thread has written may take a quarter of a microsecond to come. So what is waited for
// lies in few lines, each written by one thread where that can be, and what comes again and again with the same
// shares is handed out once: rounds().
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace jet::physics {

class Pool {
public:
    Pool() = default;
    ~Pool();
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;

    /// Of run(), with the caller's. Threads are started when they are first needed.
    void setThreads(int threads);
    /// How many are used now: one, where others keep the processors.
    int threads() const { return used_; }

    /// Lives for a step. Workers then wait for the next task without falling asleep, but not for long. If one of them
    /// lost its processor in the midst of something, the caller goes on alone for some steps, more of them each time.
    class Attention {
    public:
        explicit Attention(Pool& pool) : pool_(pool) { pool_.beginStep(); }
        ~Attention() { pool_.endStep(); }
        Attention(const Attention&) = delete;
        Attention& operator=(const Attention&) = delete;

    private:
        Pool& pool_;
    };

    /// Calls work(block) for each block below `blocks`, at once and in any order; returns when all is done.
    template <class Work>
    void run(std::size_t blocks, Work&& work)
    {
        if (used_ <= 1 || blocks <= 1) {
            for (std::size_t block = 0; block < blocks; ++block) work(block);
            return;
        }
        fork([](void* what, std::size_t block) { (*static_cast<std::remove_reference_t<Work>*>(what))(block); }, &work,
             blocks);
    }
    /// The same for ranges [first, last) of `count` things, `size` of them a block.
    template <class Work>
    void ranges(std::size_t count, std::size_t size, Work&& work)
    {
        if (used_ <= 1 || count <= size) {
            if (count > 0) work(std::size_t{0}, count);
            return;
        }
        run((count + size - 1) / size,
            [&](std::size_t block) { work(block * size, std::min(count, (block + 1) * size)); });
    }

    /// Calls work(round, block) for each block below `blocks`, at once and in any order, then between(round), by the
    /// caller; then it is the next round's turn. The same as a run() for each of them, but threads stay at it.
    template <class Work, class Between>
    void rounds(std::size_t rounds, std::size_t blocks, Work&& work, Between&& between)
    {
        if (used_ <= 1 || blocks <= 1 || rounds == 0) {
            for (std::size_t round = 0; round < rounds; ++round) {
                for (std::size_t block = 0; block < blocks; ++block) work(round, block);
                between(round);
            }
            return;
        }
        goRound(rounds, blocks, std::ref(work), std::ref(between));
    }

    /// Two loops at once: each thread has its share of both.
    template <class First, class Second>
    void both(std::size_t first, First&& one, std::size_t second, Second&& other)
    {
        const std::size_t blocks = first + second;
        run(blocks, [&](std::size_t block) {
            const std::size_t ones = block * first / blocks;
            if ((block + 1) * first / blocks > ones) {
                one(ones);
            } else {
                other(block - ones);
            }
        });
    }
    /// A loop, and beside it something that one thread does; one after the other where the loop is short.
    template <class Work, class Other>
    void beside(std::size_t blocks, Work&& work, Other&& other)
    {
        if (used_ > 1 && blocks > 1) return both(blocks, work, 1, [&](std::size_t) { other(); });
        for (std::size_t block = 0; block < blocks; ++block) work(block);
        other();
    }

private:
    using Clock = std::chrono::steady_clock;
    using Call = void (*)(void*, std::size_t);
    static constexpr std::uint64_t kTask = std::uint64_t{1} << 32;
    struct Share;
    struct Rounds;
    void beginStep();
    void endStep();
    void handOut(Call, void* what, std::size_t blocks, std::size_t from);
    void fork(Call, void* what, std::size_t blocks);
    void await(std::size_t blocks, Clock::time_point since);
    void wakeSleepers();
    void goRound(std::size_t rounds, std::size_t blocks, const std::function<void(std::size_t, std::size_t)>& work,
                 const std::function<void(std::size_t)>& between);
    void lead(Rounds&);
    void follow(Rounds&, std::size_t self);
    bool claim(std::size_t block, std::uint64_t round);
    std::size_t claimOwn(const Rounds&, std::size_t self, std::uint64_t round);
    std::size_t claimOthers(const Rounds&, std::uint64_t round);
    void start();
    void stop();
    void serve(std::size_t self);
    std::size_t finishShare(Share&, bool own);
    std::size_t finishOthers(std::size_t self);
    bool isNew(std::size_t self, std::uint64_t seen) const { return shares_[self].ticket.load() / kTask != seen; }

    /// A thread's blocks of the task, in one line of memory, and none beside it, as lines come in pairs. They are
    /// taken in order. What is beside the ticket is written before it, and read by those who have got a block.
    struct alignas(128) Share {
        std::size_t first = 0;
        Call call = nullptr;
        std::atomic<void*> what{nullptr};
        std::atomic<std::uint64_t> count{0};   // blocks of the share
        std::atomic<std::uint64_t> ticket{0};  // number of the task, blocks left to take
    };

    /// The last round that a block was taken in, which its thread has to itself as long as nobody takes it from it.
    struct alignas(128) Claim {
        std::atomic<std::uint64_t> round{0};
    };

    // Read by all, and hardly ever written.
    std::vector<Share> shares_;  // [threads]
    std::vector<Claim> claims_;  // [blocks of rounds]
    std::atomic<bool> stopping_{false};
    // The caller's.
    alignas(128) int threads_ = 1;
    int used_ = 1;
    int rest_ = 0, nextRest_ = 0;  // steps to go on alone; after the next stall
    bool stalled_ = false;         // did the caller wait for a worker for long in this step?
    bool called_ = false;          // has it called any in this step?
    std::uint64_t task_ = 0;
    Clock::time_point ended_;  // the last step
    std::vector<std::thread> workers_;
    // What tells how far the others are.
    alignas(128) std::atomic<std::size_t> done_{0};      // blocks
    alignas(128) std::atomic<std::uint64_t> round_{0};   // may be worked at; they are counted on from task to task
    alignas(128) std::atomic<std::uint64_t> helped_{0};  // blocks of rounds that workers did, ever
    // Of those who have nothing to do.
    alignas(128) std::atomic<int> sleeping_{0};
    std::atomic<std::uint64_t> step_{0};
    std::atomic<bool> attended_{false};
    std::atomic<Clock::duration> patience_{};  // between steps
    std::mutex mutex_;
    std::condition_variable wake_;
};

}  // namespace jet::physics
