// Going back: the history gives back what was recorded, and a simulation that went back has the same future.
#include "support/test_catalog.hpp"

#include <jet/physics_view.hpp>
#include <jet/rewind.hpp>
#include <jet/simulation.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <span>
#include <thread>
#include <vector>

namespace jet {

namespace {

using Bytes = std::vector<std::byte>;

/// Numbers as a world has them: some that move evenly, some that jump, some that rest; an odd count of bytes.
Bytes sample(int step)
{
    std::vector<double> values;
    for (int i = 0; i < 40; ++i) values.push_back(100 * std::sin(0.01 * step + i));
    for (int i = 0; i < 40; ++i) values.push_back(i % 7 == step % 7 ? -1.0 * step : 3.25 * i);
    const auto raw = std::as_bytes(std::span(values));
    Bytes bytes(raw.begin(), raw.end());
    bytes.resize(bytes.size() + 3, std::byte{0x7f});
    bytes.back() = static_cast<std::byte>(step);
    return bytes;
}

TEST(RewindHistory, GivesBackEveryStateBitForBit)
{
    RewindHistory history({10, 1 << 24}, 1.0 / 60);
    for (int step = 0; step <= 100; ++step) history.record(static_cast<std::uint64_t>(step), sample(step));
    for (int step = 100; step >= 0; --step) {
        const auto state = history.find(static_cast<std::uint64_t>(step));
        ASSERT_TRUE(state);
        EXPECT_EQ(state->step, static_cast<std::uint64_t>(step));
        EXPECT_EQ(state->bytes, sample(step)) << step;
    }
}

TEST(RewindHistory, TakesLessMemoryThanTheStates)
{
    RewindHistory history({10, 1 << 24}, 1.0 / 60);
    std::size_t whole = 0;
    for (int step = 0; step < 600; ++step) {
        history.record(static_cast<std::uint64_t>(step), sample(step));
        whole += sample(step).size();
    }
    EXPECT_LT(history.state().bytes, whole * 8 / 10);
}

TEST(RewindHistory, KeepsTheLastSecondsAndForgetsTheRest)
{
    RewindHistory history({2, 1 << 24}, 1.0 / 60);
    for (int step = 0; step <= 1000; ++step) history.record(static_cast<std::uint64_t>(step), sample(step));
    const RewindState state = history.state();
    EXPECT_EQ(state.newest, 1000u);
    EXPECT_LE(state.oldest, 880u) << "two seconds are 120 steps";
    EXPECT_GT(state.oldest, 840u) << "a group of 24 more at most";
    EXPECT_EQ(history.find(3)->step, state.oldest) << "what is gone is answered with the oldest";
}

TEST(RewindHistory, StaysWithinItsMemoryByKeepingFewerStates)
{
    constexpr std::size_t budget = 40'000;
    RewindHistory history({10, budget}, 1.0 / 60);
    for (std::uint64_t step = 0; step <= 3000; ++step)
        if (history.wants(step)) history.record(step, sample(static_cast<int>(step)));
    const RewindState state = history.state();
    EXPECT_LE(state.bytes, budget);
    EXPECT_GT(state.interval, 1u);
    EXPECT_GT(state.newest - state.oldest, 300u) << "half of the ten seconds at least";
    const auto between = history.find(state.newest - 1);
    ASSERT_TRUE(between);
    EXPECT_EQ(between->bytes, sample(static_cast<int>(between->step)));
}

TEST(RewindHistory, RecordingAgainForgetsTheOtherFuture)
{
    RewindHistory history({10, 1 << 24}, 1.0 / 60);
    for (int step = 0; step <= 100; ++step) history.record(static_cast<std::uint64_t>(step), sample(step));
    history.record(41, sample(-7));
    EXPECT_EQ(history.state().newest, 41u);
    EXPECT_EQ(history.find(90)->bytes, sample(-7));
    EXPECT_EQ(history.find(40)->bytes, sample(40));
    history.record(42, sample(-8));
    EXPECT_EQ(history.find(42)->bytes, sample(-8));
}

TEST(RewindHistory, StatesOfOtherSizesAndNoneAtAllAreFine)
{
    RewindHistory history({10, 1 << 24}, 1.0 / 60);
    EXPECT_FALSE(history.find(5));
    EXPECT_FALSE(history.state().any);
    history.record(1, {});
    history.record(2, sample(2));
    history.record(3, Bytes(9, std::byte{1}));
    EXPECT_TRUE(history.find(1)->bytes.empty());
    EXPECT_EQ(history.find(2)->bytes, sample(2));
    EXPECT_EQ(history.find(3)->bytes, Bytes(9, std::byte{1}));
    RewindHistory none({0, 1 << 24}, 1.0 / 60);
    none.record(1, sample(1));
    EXPECT_FALSE(none.wants(2));
    EXPECT_FALSE(none.state().any);
}

class RewindTest : public testing::Test {
protected:
    RewindTest() : scene_("Scene", events_, catalog_)
    {
        body(Path::rectangle({{-400, 200}, {400, 260}}), "in-path-rigid-body", true);
        for (int i = 0; i < 4; ++i)
            body(Path::rectangle({{-10.0 + 3 * i, -40.0 * i}, {15.0 + 3 * i, 20 - 40.0 * i}}), "in-path-rigid-body");
        ball_ = body(Path::ellipse({{-80, 60}, {-40, 100}}), "in-path-body");
        auto edit = scene_.items().begin("Torque");
        const Item& torque = edit.add<TorqueItem>(scene_.root(), Path::rectangle({{-65, 75}, {-55, 85}}));
        edit.set(torque, "value", -300.0);
        edit.commit();
        torque_ = torque.id();
    }
    ItemId body(Path path, const char* effect, bool fixed = false)
    {
        auto edit = scene_.items().begin("Add a body");
        const Item& item = edit.add<ShapeItem>(scene_.root(), std::move(path));
        edit.addEffect(item, effect);
        edit.set(item, "fixed", fixed);
        edit.commit();
        return item.id();
    }
    template <class Done>
    bool until(Done&& done)
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (!done()) {
            if (std::chrono::steady_clock::now() > end) return false;
            events_.dispatchQueued();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }

    test::TestCatalog catalog_{"org.jet.physics", "org.jet.effect.in-path-body", "org.jet.effect.in-path-rigid-body"};
    EventsCenter events_;
    Scene scene_;
    ItemId ball_, torque_;
};

TEST_F(RewindTest, ARestoredSimulationHasTheSameFutureBitForBit)
{
    const auto simulation = Simulation::start(scene_, {}).orThrow();
    RewindHistory history({10, std::size_t{64} << 20}, simulation->timeStep());
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < 240; ++i) {
        history.record(simulation->stepCount(), simulation->save());
        hashes.push_back(simulation->hash());
        if (i == 100) simulation->setTorque(torque_, 800);
        simulation->step();
    }
    for (const std::uint64_t step : {200U, 101U, 7U, 150U, 0U}) {
        const auto state = history.find(step);
        ASSERT_EQ(state->step, step);
        simulation->restore(state->bytes);
        ASSERT_EQ(simulation->stepCount(), step);
        for (std::uint64_t i = step; i < 240; ++i) {
            ASSERT_EQ(simulation->hash(), hashes[i]) << "back at " << step << ", step " << i;
            if (i == 100) simulation->setTorque(torque_, 800);
            simulation->step();
        }
    }
}

TEST_F(RewindTest, PosesFollowWhereverItWent)
{
    const auto simulation = Simulation::start(scene_, {}).orThrow();
    const Item& ball = *simulation->scene().items().find(ball_);
    for (int i = 0; i < 20; ++i) simulation->step();
    const Bytes state = simulation->save();
    const Box before = simulation->pose(ball)->bounds();
    for (int i = 0; i < 20; ++i) simulation->step();
    const Box after = simulation->pose(ball)->bounds();
    simulation->restore(state);
    EXPECT_EQ(simulation->pose(ball)->bounds(), before);
    simulation->world().applyImpulse(simulation->bodyOf(ball_), {50, -200});
    for (int i = 0; i < 20; ++i) simulation->step();
    EXPECT_FALSE(simulation->pose(ball)->bounds() == after) << "another future at the same step";
}

TEST_F(RewindTest, ADamagedStateIsRefused)
{
    const auto simulation = Simulation::start(scene_, {}).orThrow();
    simulation->step();
    const std::uint64_t before = simulation->hash();
    Bytes state = simulation->save();
    state.resize(state.size() - 5);
    EXPECT_THROW(simulation->restore(state), Failure);
    EXPECT_THROW(simulation->restore({}), Failure);
    const Bytes whole = simulation->save();
    for (std::size_t at = 0; at < whole.size(); at += at < 80 ? 3 : 61) {
        Bytes flipped = whole;
        flipped[at] ^= std::byte{4};
        EXPECT_THROW(simulation->restore(flipped), Failure) << "byte " << at;
        ASSERT_EQ(simulation->hash(), before) << "byte " << at;
    }
    simulation->restore(whole);
    EXPECT_EQ(simulation->hash(), before);
}

TEST_F(RewindTest, TheCenterGoesBackShowsItAndPlaysOnFromThere)
{
    SimulationCenter center(events_);
    center.play(scene_, {}).orThrow();
    ASSERT_TRUE(until([&] { return center.frame() && center.frame()->step >= 30; }));
    center.pause();
    ASSERT_TRUE(until([&] { return center.rewindState().present == center.rewindState().newest; }));
    const RewindState state = center.rewindState();
    EXPECT_EQ(state.oldest, 0u);
    EXPECT_GT(state.bytes, 0u);
    const auto bounds = [&] {
        for (const auto& [item, path] : center.frame()->poses)
            if (item == ball_) return path.bounds();
        return Box();
    };
    center.rewindTo(0);
    ASSERT_TRUE(until([&] { return center.frame()->step == 0; }));
    const Box start = bounds();
    center.rewindTo(25);
    ASSERT_TRUE(until([&] { return center.frame()->step == 25; }));
    EXPECT_GT(bounds().min.y(), start.min.y() + 1);
    EXPECT_EQ(center.rewindState().newest, state.newest) << "nothing is forgotten by looking";
    center.singleStep();
    ASSERT_TRUE(until([&] { return center.frame()->step == 26; }));
    ASSERT_TRUE(until([&] { return center.rewindState().newest == 26; })) << "another future begins";
    center.stop();
    EXPECT_FALSE(center.rewindState().any);
}

TEST_F(RewindTest, MarksPutAPictureOfTheWorldIntoTheFrames)
{
    SimulationCenter center(events_);
    center.play(scene_, {}).orThrow();
    ASSERT_TRUE(until([&] { return center.frame() && center.frame()->step >= 1; }));
    EXPECT_EQ(center.frame()->physics, nullptr) << "nobody looks";
    int told = 0;
    const auto marks = events_.subscribe<PhysicsMarksChanged>(&center, [&](const PhysicsMarksChanged&) { ++told; });
    PhysicsMarks wanted;
    wanted.contacts = wanted.stress = true;
    center.setPhysicsMarks(wanted);
    center.setPhysicsMarks(wanted);
    ASSERT_TRUE(until([&] { return center.frame()->physics && !center.frame()->physics->contacts.empty(); }));
    const auto frame = center.frame();
    EXPECT_EQ(frame->physics->bodies.size(), 6u);
    EXPECT_FALSE(frame->physics->springs.empty());
    EXPECT_EQ(told, 1);
    center.setPhysicsMarks({});
    ASSERT_TRUE(until([&] { return center.frame()->physics == nullptr; }));
}

}  // namespace

}  // namespace jet
