// EventsCenter with several threads, and coalesced subscriptions. Run with the thread sanitizer, too. What happens on
// one thread is in events_test.cpp.
#include "scene_fakes.hpp"

#include <jet/events.hpp>

#include <atomic>
#include <thread>

namespace jet {
namespace {

struct Counted {
    static constexpr EventType type{"test.counted"};
    int thread = 0, number = 0;
};
struct Summed {
    static constexpr EventType type{"test.summed"};
    int number = 0;
    struct Burst {
        int events = 0, sum = 0;
        void add(const Summed& event) { ++events, sum += event.number; }
    };
};

/// Runs `work(i)` on n threads while this one dispatches, until all have ended.
template <class Work>
void whileDispatching(EventsCenter& events, int n, Work work)
{
    std::atomic<int> running{n};
    std::vector<std::thread> threads;
    for (int i = 0; i < n; ++i)
        threads.emplace_back([&running, work, i] {
            work(i);
            --running;
        });
    while (running > 0) events.dispatchQueued();
    for (std::thread& thread : threads) thread.join();
    events.dispatchQueued();
}

TEST(EventsThreads, EventsOfEachThreadArriveAllAndInOrderOnTheOwnersThread)
{
    EventsCenter events;
    constexpr int kThreads = 4, kEvents = 5000;
    std::vector<int> next(kThreads, 0);
    const auto owner = std::this_thread::get_id();
    const auto subscription = events.subscribe<Counted>(&next, [&](const Counted& e) {
        ASSERT_EQ(std::this_thread::get_id(), owner);
        ASSERT_EQ(e.number, next[static_cast<std::size_t>(e.thread)]++);
    });
    whileDispatching(events, kThreads, [&](int i) {
        for (int k = 0; k < kEvents; ++k) events.post(&next, Counted{i, k});
    });
    EXPECT_EQ(next, std::vector<int>(kThreads, kEvents));
}

TEST(EventsThreads, OtherThreadsSubscribeAndLeave)
{
    EventsCenter events;
    std::atomic<int> heard{0};
    whileDispatching(events, 4, [&](int) {
        for (int k = 0; k < 300; ++k) {
            const auto a = events.subscribe<Counted>(nullptr, [&](const Counted&) { ++heard; });
            const auto b = events.subscribeCoalesced<Counted>(nullptr, [&](const Counted&) { ++heard; });
            events.post(&heard, Counted{0, k});
        }
    });
    EXPECT_EQ(events.listenerCount(), 0u);
    const int before = heard;
    events.post(&heard, Counted{});
    events.dispatchQueued();
    EXPECT_EQ(heard, before);
}

TEST(EventsThreads, ASubscriptionOfAnotherThreadHearsFromTheNextDispatchOn)
{
    EventsCenter events;
    int heard = 0;
    Subscription subscription;
    std::thread([&] { subscription = events.subscribe<Counted>(nullptr, [&](const Counted&) { ++heard; }); }).join();
    events.post(&events, Counted{});
    EXPECT_EQ(heard, 0);
    events.dispatchQueued();
    events.post(&events, Counted{});
    EXPECT_EQ(heard, 1);
}

TEST(EventsThreads, ASubscriptionEndedElsewhereHearsNoMore)
{
    EventsCenter events;
    int heard = 0;
    auto subscription = events.subscribe<Counted>(nullptr, [&](const Counted&) { ++heard; });
    std::thread([&] { subscription.reset(); }).join();
    events.post(&events, Counted{});
    EXPECT_EQ(heard, 0);
    events.dispatchQueued();
    EXPECT_EQ(events.listenerCount(), 0u);
}

TEST(EventsThreads, ASubscriptionMayEndOnAnotherThreadAfterTheCenter)
{
    Subscription subscription;
    {
        EventsCenter events;
        subscription = events.subscribe<Counted>(nullptr, [](const Counted&) {});
    }
    std::thread([&] { subscription.reset(); }).join();
}

TEST(CoalescedEvents, ManyEventsAreOneCallAtTheNextDispatch)
{
    EventsCenter events;
    std::vector<int> seen;
    const auto subscription =
        events.subscribeCoalesced<Counted>(&seen, [&](const Counted& e) { seen.push_back(e.number); });
    for (int i = 0; i < 100; ++i) events.post(&seen, Counted{0, i});
    EXPECT_TRUE(seen.empty());
    events.dispatchQueued();
    EXPECT_EQ(seen, std::vector<int>{99}) << "the latest";
    events.dispatchQueued();
    EXPECT_EQ(seen.size(), 1u);
    events.post(&seen, Counted{0, 7});
    events.dispatchQueued();
    EXPECT_EQ(seen, (std::vector<int>{99, 7}));
}

TEST(CoalescedEvents, AnEventTypeSaysHowABurstIsMade)
{
    EventsCenter events;
    Summed::Burst last;
    const auto subscription =
        events.subscribeCoalesced<Summed>(nullptr, [&](const Summed::Burst& burst) { last = burst; });
    for (int i = 1; i <= 10; ++i) events.post(&events, Summed{i});
    events.dispatchQueued();
    EXPECT_EQ(last.events, 10);
    EXPECT_EQ(last.sum, 55);
}

TEST(CoalescedEvents, WhatAHandlerCausesComesWithTheNextDispatch)
{
    EventsCenter events;
    int calls = 0;
    const auto subscription = events.subscribeCoalesced<Counted>(nullptr, [&](const Counted&) {
        if (++calls < 3) events.post(&events, Counted{});
    });
    events.post(&events, Counted{});
    for (int expected : {1, 2, 3, 3}) {
        events.dispatchQueued();
        EXPECT_EQ(calls, expected);
    }
}

TEST(CoalescedEvents, WhoLeftBetweenEventAndDispatchHearsNothing)
{
    EventsCenter events;
    int calls = 0;
    auto subscription = events.subscribeCoalesced<Counted>(nullptr, [&](const Counted&) { ++calls; });
    events.post(&events, Counted{});
    subscription.reset();
    events.dispatchQueued();
    EXPECT_EQ(calls, 0);
}

TEST(CoalescedEvents, AnExceptionInAHandlerDoesNotStopLaterBursts)
{
    EventsCenter events;
    int problems = 0, calls = 0;
    events.setExceptionHandler([&](std::exception_ptr) { ++problems; });
    const auto subscription = events.subscribeCoalesced<Counted>(nullptr, [&](const Counted&) {
        ++calls;
        throw std::runtime_error("no");
    });
    for (int i = 0; i < 3; ++i) {
        events.post(&events, Counted{});
        events.dispatchQueued();
    }
    EXPECT_EQ(calls, 3);
    EXPECT_EQ(problems, 3);
}

class SceneBursts : public test::SceneFixture {};

TEST_F(SceneBursts, ABurstNamesEachChangedItemOnce)
{
    const ItemId a = addBox(Box({0, 0}, {1, 1})).id(), b = addBox(Box({0, 0}, {1, 1})).id();
    std::vector<ItemsChanged::Burst> bursts;
    const auto subscription = events.subscribeCoalesced<ItemsChanged>(
        &scene, [&](const ItemsChanged::Burst& burst) { bursts.push_back(burst); });
    for (int i = 0; i < 5; ++i) {
        auto edit = items().begin("Rename");
        edit.set(*items().find(b), "name", std::to_string(i));
        edit.set(*items().find(a), "name", std::to_string(i));
        edit.commit();
    }
    history().undo();
    events.dispatchQueued();
    ASSERT_EQ(bursts.size(), 1u);
    EXPECT_EQ(bursts[0].items, (std::vector<ItemId>{a, b}));
    EXPECT_EQ(bursts[0].scene, &scene);
    EXPECT_FALSE(bursts[0].tree || bursts[0].settings);
    auto edit = items().begin("Both");
    edit.remove(*items().find(a));
    edit.setScene("time-step", 0.5);
    edit.commit();
    events.dispatchQueued();
    EXPECT_TRUE(bursts[1].tree && bursts[1].settings);
}

}  // namespace
}  // namespace jet
