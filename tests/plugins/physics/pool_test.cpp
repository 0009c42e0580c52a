// The threads of a world: every block is done once, by whomever.
#include "rigid/pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace jet::physics::test {

namespace {

TEST(Pool, DoesEveryBlockOnceHoweverManyThereAre)
{
    for (const int threads : {1, 2, 3, 7}) {
        Pool pool;
        pool.setThreads(threads);
        for (const std::size_t blocks : {0U, 1U, 2U, 3U, 8U, 100U}) {
            for (int again = 0; again < 200; ++again) {
                std::vector<int> done(blocks, 0);
                pool.run(blocks, [&](std::size_t block) { ++done[block]; });
                ASSERT_EQ(done, std::vector<int>(blocks, 1)) << threads << " threads, time " << again;
            }
        }
    }
}

TEST(Pool, WhatOneTaskWroteTheNextOneReads)
{
    Pool pool;
    pool.setThreads(2);
    const Pool::Attention attention(pool);
    std::vector<std::uint64_t> values(64);
    std::iota(values.begin(), values.end(), 0U);
    for (int round = 0; round < 5000; ++round) {
        // Each block reads what another one wrote in the round before.
        std::vector<std::uint64_t> next(values.size());
        pool.run(values.size(), [&](std::size_t i) { next[i] = values[(i + 31) % values.size()] + 1; });
        values.swap(next);
    }
    std::vector<std::uint64_t> expected(values.size());
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = (i + 31U * 5000U) % 64U + 5000U;
    EXPECT_EQ(values, expected);
}

TEST(Pool, CutsRangesWithoutGapsOrOverlaps)
{
    Pool pool;
    pool.setThreads(3);
    for (const std::size_t count : {0U, 1U, 10U, 11U, 1000U}) {
        std::vector<int> seen(count, 0);
        pool.ranges(count, 10, [&](std::size_t first, std::size_t last) {
            EXPECT_LE(last - first, 10U);
            for (std::size_t i = first; i < last; ++i) ++seen[i];
        });
        EXPECT_EQ(seen, std::vector<int>(count, 1));
    }
}

TEST(Pool, TwoLoopsAtOnceAreDoneWholeAndEachThreadHasItsShareOfBoth)
{
    for (const int threads : {1, 2, 3, 7}) {
        Pool pool;
        pool.setThreads(threads);
        for (const std::size_t first : {0U, 1U, 2U, 9U, 40U})
            for (const std::size_t second : {0U, 1U, 5U, 33U}) {
                std::vector<int> one(first, 0), other(second, 0);
                pool.both(
                    first, [&](std::size_t block) { ++one.at(block); }, second,
                    [&](std::size_t block) { ++other.at(block); });
                ASSERT_EQ(one, std::vector<int>(first, 1)) << threads << " threads, " << first << " and " << second;
                ASSERT_EQ(other, std::vector<int>(second, 1)) << threads << " threads, " << first << " and " << second;
            }
    }
}

TEST(Pool, WhatIsBesideALoopIsDoneOnceAndByTheCallerWhereTheLoopIsShort)
{
    for (const int threads : {1, 2, 4}) {
        Pool pool;
        pool.setThreads(threads);
        for (const std::size_t blocks : {0U, 1U, 2U, 30U}) {
            std::vector<int> done(blocks, 0);
            int beside = 0;
            std::thread::id by;
            const auto work = [&](std::size_t block) { ++done[block]; };
            pool.beside(blocks, work, [&] { ++beside, by = std::this_thread::get_id(); });
            ASSERT_EQ(done, std::vector<int>(blocks, 1));
            ASSERT_EQ(beside, 1);
            if (blocks < 2) {
                EXPECT_EQ(by, std::this_thread::get_id());
            }
        }
    }
}

TEST(Pool, ARoundBeginsWhenAllOfTheLastOneIsDoneAndTheCallerHasBeenThere)
{
    const auto caller = std::this_thread::get_id();
    for (const int threads : {1, 2, 3, 7}) {
        Pool pool;
        pool.setThreads(threads);
        for (const std::size_t blocks : {0U, 1U, 2U, 4U, 9U, 40U})
            for (const std::size_t rounds : {0U, 1U, 2U, 300U}) {
                // A block is done once a round, and reads what others wrote in the round before and then the caller.
                std::vector<std::size_t> done(blocks, 0), next(blocks, 0);
                std::size_t between = 0;
                pool.rounds(
                    rounds, blocks,
                    [&](std::size_t round, std::size_t block) {
                        EXPECT_EQ(between, round);
                        next[block] += done[(block + 1) % blocks] == round ? 1 : 1000000;
                    },
                    [&](std::size_t round) {
                        EXPECT_EQ(std::this_thread::get_id(), caller);
                        EXPECT_EQ(round, between++);
                        done = next;
                    });
                EXPECT_EQ(between, rounds);
                ASSERT_EQ(done, std::vector<std::size_t>(blocks, rounds)) << threads << " threads, " << blocks;
            }
    }
}

TEST(Pool, ABlockWhoseThreadIsLateIsDoneByAnother)
{
    Pool pool;
    pool.setThreads(2);
    const auto caller = std::this_thread::get_id();
    // In the second round the worker stays in its first block until all others are done: the caller does its part too.
    std::vector<std::thread::id> by(8);
    std::atomic<int> done = 0;
    std::atomic<bool> begun = false;
    const auto until = [giveUp = std::chrono::steady_clock::now() + std::chrono::seconds(20)](auto&& holds) {
        while (!holds() && std::chrono::steady_clock::now() < giveUp) std::this_thread::yield();
    };
    pool.rounds(
        3, by.size(),
        [&](std::size_t round, std::size_t block) {
            if (round != 1) return;
            by[block] = std::this_thread::get_id();
            if (by[block] == caller) {
                until([&] { return begun.load(); });
            } else {
                begun = true;
                until([&] { return done >= 7; });
            }
            ++done;
        },
        [](std::size_t) {});
    EXPECT_EQ(done, 8);
    EXPECT_EQ(std::count(by.begin(), by.end(), caller), 7);
}

TEST(Pool, RoundsAndLoopsMayFollowEachOther)
{
    for (const int threads : {2, 3}) {
        Pool pool;
        pool.setThreads(threads);
        std::atomic<int> sum = 0;
        for (int again = 0; again < 300; ++again) {
            const Pool::Attention step(pool);
            pool.rounds(
                5, 2, [&](std::size_t, std::size_t) { ++sum; }, [&](std::size_t) { sum += 10; });
            pool.run(7, [&](std::size_t) { sum += 100; });
        }
        EXPECT_EQ(sum, 300 * (5 * 2 + 5 * 10 + 7 * 100));
    }
}

TEST(Pool, WorkersThatSleepAreWokenAndMayChangeInNumber)
{
    Pool pool;
    for (const int threads : {2, 4, 1, 3}) {
        pool.setThreads(threads);
        for (int i = 0; i < 3; ++i) {
            std::atomic<int> sum = 0;
            pool.run(50, [&](std::size_t block) { sum += static_cast<int>(block); });
            EXPECT_EQ(sum, 1225);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }
}

TEST(Pool, GoesOnAloneForSomeStepsAfterAWorkerKeptItWaiting)
{
    Pool pool;
    pool.setThreads(2);
    const auto caller = std::this_thread::get_id();
    // Until a worker has woken up while the caller was busy, and kept it waiting much longer.
    for (int i = 0; i < 200; ++i) {
        {
            const Pool::Attention step(pool);
            pool.run(2, [&](std::size_t) {
                const bool isCaller = std::this_thread::get_id() == caller;
                std::this_thread::sleep_for(std::chrono::milliseconds(isCaller ? 5 : 100));
            });
        }
        const Pool::Attention next(pool);
        if (pool.threads() == 1) break;
    }
    int alone = 1;
    for (; alone < 1000; ++alone) {
        const Pool::Attention step(pool);
        if (pool.threads() == 2) break;
        pool.run(2, [&](std::size_t) { EXPECT_EQ(std::this_thread::get_id(), caller); });
    }
    EXPECT_EQ(alone, 8);
}

}  // namespace

}  // namespace jet::physics::test
