#include <jet/events.hpp>

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace jet {
namespace {

struct Rang {
    static constexpr EventType type{"test.rang"};
    int times = 1;
};
struct Knocked {
    static constexpr EventType type{"test.knocked"};
};

class EventsCenterTest : public testing::Test {
protected:
    EventsCenter events;
    int door = 0, window = 0;  // senders
};

TEST_F(EventsCenterTest, AListenerHearsItsSenderAndTypeOnly)
{
    int heard = 0;
    const auto subscription = events.subscribe<Rang>(&door, [&](const Rang& e) { heard += e.times; });
    events.post(&door, Rang{3});
    events.post(&window, Rang{10});
    events.post(&door, Knocked{});
    EXPECT_EQ(heard, 3);
}

TEST_F(EventsCenterTest, WithoutASenderAListenerHearsAllOnce)
{
    int heard = 0;
    const auto subscription = events.subscribe<Rang>(nullptr, [&](const Rang&) { ++heard; });
    events.post(&door, Rang{});
    events.post(&window, Rang{});
    events.post(nullptr, Rang{});
    EXPECT_EQ(heard, 3);
}

TEST_F(EventsCenterTest, ListenersAreCalledInTheOrderTheySubscribed)
{
    std::string order;
    const auto a = events.subscribe<Rang>(&door, [&](const Rang&) { order += 'a'; });
    auto b = events.subscribe<Rang>(&door, [&](const Rang&) { order += 'b'; });
    const auto c = events.subscribe<Rang>(&door, [&](const Rang&) { order += 'c'; });
    b.reset();
    const auto d = events.subscribe<Rang>(&door, [&](const Rang&) { order += 'd'; });
    events.post(&door, Rang{});
    EXPECT_EQ(order, "acd");
}

TEST_F(EventsCenterTest, TheEndOfASubscriptionIsTheEndOfCalls)
{
    int heard = 0;
    {
        const auto subscription = events.subscribe<Rang>(&door, [&](const Rang&) { ++heard; });
        EXPECT_EQ(events.listenerCount(), 1u);
    }
    events.post(&door, Rang{});
    EXPECT_EQ(heard, 0);
    EXPECT_EQ(events.listenerCount(), 0u);
}

TEST_F(EventsCenterTest, AMovedSubscriptionLivesOnAndAssignmentEndsTheOldOne)
{
    std::string heard;
    auto a = events.subscribe<Rang>(&door, [&](const Rang&) { heard += 'a'; });
    auto b = events.subscribe<Rang>(&door, [&](const Rang&) { heard += 'b'; });
    a = std::move(b);
    Subscription kept(std::move(a));
    events.post(&door, Rang{});
    EXPECT_EQ(heard, "b");
}

TEST_F(EventsCenterTest, AListenerMayEndItselfAndOthersWhileBeingCalled)
{
    std::string heard;
    Subscription a, b, c;
    a = events.subscribe<Rang>(&door, [&](const Rang&) {
        heard += 'a';
        a.reset();
        b.reset();
    });
    b = events.subscribe<Rang>(&door, [&](const Rang&) { heard += 'b'; });
    c = events.subscribe<Rang>(&door, [&](const Rang&) { heard += 'c'; });
    events.post(&door, Rang{});
    events.post(&door, Rang{});
    EXPECT_EQ(heard, "acc");
}

TEST_F(EventsCenterTest, AListenerThatSubscribesDuringACallHearsFromTheNextEventOn)
{
    std::string heard;
    std::vector<Subscription> late;
    const auto a = events.subscribe<Rang>(&door, [&](const Rang&) {
        heard += 'a';
        if (late.empty()) late.push_back(events.subscribe<Rang>(&door, [&](const Rang&) { heard += 'n'; }));
    });
    events.post(&door, Rang{});
    EXPECT_EQ(heard, "a");
    events.post(&door, Rang{});
    EXPECT_EQ(heard, "aan");
}

TEST_F(EventsCenterTest, EventsMayBePostedInsideListeners)
{
    std::string heard;
    const auto a = events.subscribe<Rang>(&door, [&](const Rang& e) {
        heard += std::to_string(e.times);
        if (e.times > 1) events.post(&door, Rang{e.times - 1});
    });
    events.post(&door, Rang{3});
    EXPECT_EQ(heard, "321");
}

TEST_F(EventsCenterTest, WhatAHandlerHoldsIsFreedWhenItEnds)
{
    auto held = std::make_shared<int>(1);
    Subscription other = events.subscribe<Rang>(&door, [](const Rang&) {});
    Subscription third = events.subscribe<Rang>(&door, [](const Rang&) {});
    Subscription self = events.subscribe<Rang>(&door, [&, held](const Rang&) {
        self.reset();  // while it runs: freed after
        EXPECT_GE(held.use_count(), 2);
    });
    EXPECT_EQ(held.use_count(), 2);
    events.post(&door, Rang{});
    EXPECT_EQ(held.use_count(), 1);
    self = events.subscribe<Rang>(&door, [held](const Rang&) {});
    self.reset();
    EXPECT_EQ(held.use_count(), 1);
}

// An object in a handler that holds subscriptions to the same channel: its destruction comes back into the center.
TEST_F(EventsCenterTest, AHandlerMayOwnOtherSubscriptions)
{
    struct Owner {
        std::vector<Subscription> own;
    };
    auto owner = std::make_shared<Owner>();
    for (int i = 0; i < 10; ++i) owner->own.push_back(events.subscribe<Rang>(&door, [](const Rang&) {}));
    Subscription last = events.subscribe<Rang>(&door, [owner](const Rang&) {});
    Subscription ends = events.subscribe<Rang>(&door, [&](const Rang&) { last.reset(); });
    owner.reset();
    events.post(&door, Rang{});
    EXPECT_EQ(events.listenerCount(), 1u);
    events.post(&door, Rang{});
}

TEST_F(EventsCenterTest, AnExceptionInOneListenerDoesNotStopTheOthers)
{
    std::vector<std::string> problems;
    events.setExceptionHandler([&](std::exception_ptr p) {
        try {
            std::rethrow_exception(p);
        } catch (const std::exception& e) {
            problems.push_back(e.what());
        }
    });
    int heard = 0;
    const auto a = events.subscribe<Rang>(&door, [](const Rang&) { throw std::runtime_error("broken"); });
    const auto b = events.subscribe<Rang>(&door, [&](const Rang&) { ++heard; });
    events.post(&door, Rang{});
    EXPECT_EQ(heard, 1);
    EXPECT_EQ(problems, std::vector<std::string>{"broken"});
}

TEST_F(EventsCenterTest, AnExceptionInTheExceptionHandlerIsNoReasonToStopEither)
{
    events.setExceptionHandler([](std::exception_ptr) { throw std::runtime_error("the handler broke, too"); });
    int heard = 0;
    const auto a = events.subscribe<Rang>(&door, [](const Rang&) { throw std::runtime_error("broken"); });
    const auto b = events.subscribe<Rang>(&door, [&](const Rang&) { ++heard; });
    EXPECT_NO_THROW(events.post(&door, Rang{}));
    EXPECT_EQ(heard, 1);
}

TEST_F(EventsCenterTest, ASubscriptionMayOutliveTheCenter)
{
    Subscription subscription;
    {
        EventsCenter shortLived;
        subscription = shortLived.subscribe<Rang>(&door, [](const Rang&) {});
    }
    subscription.reset();
}

TEST_F(EventsCenterTest, AListenerMayDestroyTheCenter)
{
    auto center = std::make_unique<EventsCenter>();
    const auto a = center->subscribe<Rang>(&door, [&](const Rang&) { center.reset(); });
    center->post(&door, Rang{});
    EXPECT_EQ(center, nullptr);
}

TEST_F(EventsCenterTest, AnEventOfAnotherThreadWaitsForTheOwner)
{
    std::thread::id where;
    int heard = 0, woken = 0;
    events.setWakeUp([&] { ++woken; });
    const auto a = events.subscribe<Rang>(&door, [&](const Rang& e) {
        heard += e.times;
        where = std::this_thread::get_id();
    });
    std::thread([&] { events.post(&door, Rang{5}); }).join();
    EXPECT_EQ(heard, 0);
    EXPECT_EQ(woken, 1);
    events.dispatchQueued();
    EXPECT_EQ(heard, 5);
    EXPECT_EQ(where, std::this_thread::get_id());
}

TEST_F(EventsCenterTest, AFailingTaskLosesNoneOfTheOthers)
{
    std::string ran;
    int problems = 0;
    events.setExceptionHandler([&](std::exception_ptr) { ++problems; });
    events.enqueue([&] { ran += 'a'; });
    events.enqueue([] { throw std::runtime_error("broken"); });
    events.enqueue([&] { ran += 'c'; });
    events.dispatchQueued();
    EXPECT_EQ(ran, "ac");
    EXPECT_EQ(problems, 1);
}

TEST_F(EventsCenterTest, ATaskMayDestroyTheCenterWithTasksWaiting)
{
    auto center = std::make_unique<EventsCenter>();
    bool ran = false;
    center->enqueue([&] { center.reset(); });
    center->enqueue([&] { ran = true; });
    center->dispatchQueued();
    EXPECT_FALSE(ran);
}

TEST_F(EventsCenterTest, ManyThreadsPostWhileTheOwnerDispatches)
{
    constexpr int kThreads = 4, kEach = 2000;
    int heard = 0;
    const auto a = events.subscribe<Rang>(&door, [&](const Rang& e) { heard += e.times; });
    std::vector<std::thread> threads;
    for (int t = 0; t < kThreads; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < kEach; ++i) events.post(&door, Rang{});
        });
    while (heard < kThreads * kEach) events.dispatchQueued();
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(heard, kThreads * kEach);
}

TEST_F(EventsCenterTest, ManyListenersComeAndGoQuickly)
{
    std::vector<Subscription> all;
    for (int i = 0; i < 100'000; ++i) all.push_back(events.subscribe<Rang>(&door, [](const Rang&) {}));
    EXPECT_EQ(events.listenerCount(), 100'000u);
    all.clear();
    EXPECT_EQ(events.listenerCount(), 0u);
}

}  // namespace
}  // namespace jet
