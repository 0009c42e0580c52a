// The thread a game plays on: commands, frames, and what happens when an engine fails on it.
#include "scene_fakes.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <thread>

namespace jet {
namespace {

using test::Hooks;
using testing::HasSubstr;
using namespace std::chrono_literals;
using State = SimulationCenter::State;

class SimulationCenterTest : public test::SceneFixture {
protected:
    SimulationCenterTest()
    {
        const Item& body = addBox(Box({0, 0}, {10, 10}), BodyItem::type);
        auto edit = items().begin("Fill");
        edit.addEffect(body, "box-body");
        edit.add<ScriptItem>(layer());
        edit.commit();
        body_ = body.id();
        printed_ =
            events.subscribe<OutputPrinted>(&center, [this](const OutputPrinted& e) { output.push_back(e.line.text); });
        states_ = events.subscribe<SimulationStateChanged>(
            &center, [this](const SimulationStateChanged& e) { states.push_back(e.state); });
    }
    /// Runs the owner's event loop until `done`, at most 10 s.
    template <class Done>
    bool until(Done&& done)
    {
        const auto end = std::chrono::steady_clock::now() + 10s;
        while (!done()) {
            if (std::chrono::steady_clock::now() > end) return false;
            events.dispatchQueued();
            std::this_thread::sleep_for(1ms);
        }
        return true;
    }
    std::uint64_t step() const { return center.frame() ? center.frame()->step : 0; }
    static std::size_t threadCount()
    {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator("/proc/self/task"), {}));
    }

    SimulationCenter center{events};
    std::vector<std::string> output;
    std::vector<State> states;
    ItemId body_;

private:
    Subscription printed_, states_;
};

TEST_F(SimulationCenterTest, PlayingMakesFramesAndLeavesTheSceneAlone)
{
    const auto before = scene.hash();
    center.play(scene, {}).orThrow();
    EXPECT_EQ(center.state(), State::Playing);
    EXPECT_EQ(center.scene(), &scene);
    ASSERT_NE(center.runningScene(), nullptr);
    EXPECT_EQ(center.runningScene()->hash(), before);
    int frames = 0;
    const auto subscription =
        events.subscribe<SimulationFrameReady>(&center, [&](const SimulationFrameReady&) { ++frames; });
    ASSERT_TRUE(until([&] { return step() >= 3 && frames > 0; }));
    const auto frame = center.frame();
    ASSERT_EQ(frame->poses.size(), 1u);
    EXPECT_EQ(frame->poses[0].first, body_);
    EXPECT_GT(frame->poses[0].second.bounds().min.y(), 0);
    center.stop();
    EXPECT_EQ(center.state(), State::Stopped);
    EXPECT_EQ(center.frame(), nullptr);
    EXPECT_EQ(center.runningScene(), nullptr);
    EXPECT_EQ(scene.hash(), before);
    EXPECT_EQ(states, (std::vector{State::Playing, State::Stopped}));
}

TEST_F(SimulationCenterTest, PausedItStandsAndStepsOneByOne)
{
    center.play(scene, {}).orThrow();
    ASSERT_TRUE(until([&] { return step() >= 1; }));
    center.pause();
    std::this_thread::sleep_for(50ms);
    const auto at = step();
    std::this_thread::sleep_for(100ms);
    EXPECT_EQ(step(), at);
    center.singleStep();
    center.singleStep();
    ASSERT_TRUE(until([&] { return step() == at + 2; }));
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(step(), at + 2);
    center.resume();
    ASSERT_TRUE(until([&] { return step() > at + 4; }));
    EXPECT_EQ(states, (std::vector{State::Playing, State::Paused, State::Playing}));
}

TEST_F(SimulationCenterTest, AHundredRunsLeaveNoThread)
{
    const std::size_t threads = threadCount();
    for (int i = 0; i < 100; ++i) {
        center.play(scene, {}).orThrow();
        if (i % 3 == 0) center.pause();
        if (i % 3 == 1) center.singleStep();
        center.key({"D", "", {}, false}, true);
        if (i % 2 == 0) center.stop();
        events.dispatchQueued();
    }
    center.stop();
    EXPECT_EQ(threadCount(), threads);
    events.dispatchQueued();
    EXPECT_EQ(center.state(), State::Stopped);
}

TEST_F(SimulationCenterTest, TheCenterMayGoWhilePlaying)
{
    auto other = std::make_unique<SimulationCenter>(events);
    other->play(scene, {}).orThrow();
    other.reset();
    events.dispatchQueued();
}

TEST_F(SimulationCenterTest, CommandsOfAStoppedGameDoNotReachTheNext)
{
    std::atomic<int> keys{0};
    Hooks::now().scriptEvent = [&](Simulation&, const ScriptEvent& e) { keys += e.kind == ScriptEventKind::KeyDown; };
    center.key({"A", "", {}, false}, true);
    center.singleStep();
    center.play(scene, {}).orThrow();
    center.pause();
    center.key({"B", "", {}, false}, true);
    ASSERT_TRUE(until([&] { return keys > 0; }));
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(keys, 1);
}

TEST_F(SimulationCenterTest, WhatScriptsPrintAndChangeArrivesOnTheOwnersThread)
{
    const ItemId body = body_;
    Hooks::now().scriptEvent = [body](Simulation& s, const ScriptEvent& e) {
        if (e.kind != ScriptEventKind::Step || s.stepCount() != 1) return;
        s.print("hello");
        s.setItemProperty(body, "visible", false);
    };
    center.play(scene, {}).orThrow();
    ASSERT_TRUE(until([&] { return !output.empty() && !center.runningScene()->items().find(body)->visible(); }));
    EXPECT_EQ(output, std::vector<std::string>{"hello"});
    EXPECT_TRUE(items().find(body)->visible());
}

TEST_F(SimulationCenterTest, AnotherSceneTakesOver)
{
    Scene second("Second", events, catalog);
    Hooks::now().scriptEvent = [](Simulation& s, const ScriptEvent& e) {
        if (e.kind == ScriptEventKind::Step) s.requestScene("Second");
    };
    SimulationOptions options;
    options.sceneByName = [&](std::string_view name) { return name == "Second" ? &second : nullptr; };
    center.play(scene, options).orThrow();
    ASSERT_TRUE(until([&] { return center.scene() == &second; }));
    EXPECT_EQ(center.state(), State::Playing);
}

TEST_F(SimulationCenterTest, ASceneThatIsNotThereStopsTheRun)
{
    Hooks::now().scriptEvent = [](Simulation& s, const ScriptEvent& e) {
        if (e.kind == ScriptEventKind::Step) s.requestScene("Nowhere");
    };
    center.play(scene, {}).orThrow();
    ASSERT_TRUE(until([&] { return center.state() == State::Stopped; }));
    EXPECT_THAT(output, testing::ElementsAre(HasSubstr("there is no scene 'Nowhere' to go to")));
}

TEST_F(SimulationCenterTest, PhysicsThatThrowsStopsTheRunWithAMessage)
{
    Hooks::now().physicsStep = [](std::uint64_t step) {
        if (step == 3) throw std::runtime_error("singular matrix");
    };
    center.play(scene, {}).orThrow();
    ASSERT_TRUE(until([&] { return center.state() == State::Stopped; }));
    EXPECT_EQ(output, std::vector<std::string>{"the run was stopped: singular matrix"});
    Hooks::now().physicsStep = nullptr;
    center.play(scene, {}).orThrow();
    EXPECT_TRUE(until([&] { return step() >= 5; })) << "the next run is fine";
}

TEST_F(SimulationCenterTest, AScriptEngineThatThrowsStopsTheRunWithAMessage)
{
    Hooks::now().scriptEvent = [](Simulation&, const ScriptEvent& e) {
        if (e.kind == ScriptEventKind::KeyDown) throw 42;
    };
    center.play(scene, {}).orThrow();
    center.key({"D", "", {}, false}, true);
    ASSERT_TRUE(until([&] { return center.state() == State::Stopped; }));
    EXPECT_EQ(output, std::vector<std::string>{"the run was stopped: an unknown exception"});
}

TEST_F(SimulationCenterTest, ASceneThatCannotBePlayedLeavesTheCenterStopped)
{
    SimulationOptions options;
    options.physics = "quantum";
    EXPECT_FALSE(center.play(scene, options));
    EXPECT_EQ(center.state(), State::Stopped);
    EXPECT_EQ(center.runningScene(), nullptr);
    EXPECT_TRUE(states.empty());
}

}  // namespace
}  // namespace jet
