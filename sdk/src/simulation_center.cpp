// Plays on a thread of its own. Commands go in through a queue; immutable frames come out behind a mutex held for a
// pointer swap only. The catalog and the edited scene are used on the owner's thread alone.
#include "hand_deeds.hpp"
#include "known_effect.hpp"
#include "property_place.hpp"
#include "scene_state.hpp"

#include <jet/physics_view.hpp>
#include <jet/rewind.hpp>
#include <jet/simulation.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace jet {

using Clock = std::chrono::steady_clock;

namespace {
constexpr int kMaximumCatchUp = 4;  // steps made up for at once before the game slows down instead
}

struct SimulationCenter::Private {
    Private(SimulationCenter& s, EventsCenter& e) : self(s), events(e) {}

    SimulationCenter& self;
    EventsCenter& events;
    const Scene* scene = nullptr;
    std::unique_ptr<Scene> display;
    SimulationOptions options;
    State state = State::Stopped;
    std::thread thread;
    std::shared_ptr<int> life = std::make_shared<int>();  // queued tasks of an ended run see it expired

    // Shared with the simulation's thread.
    std::mutex mutex;
    std::condition_variable wake;
    std::deque<std::function<void(Simulation&)>> commands;
    bool paused = false, quit = false;
    int singleSteps = 0;
    double speed = 1;
    std::shared_ptr<const SimulationFrame> frame;
    std::optional<std::uint64_t> rewindTarget;
    RewindState rewind;
    std::atomic<bool> framePending{false}, pictured{false};

    RewindLimits limits, runLimits;  // of the next run; of this one
    PhysicsMarks marks;

    // As of the latest frame.
    std::optional<HeldBody> held;
    bool listensToPointer = false;

    HandDeeds hand;  // of the simulation's thread

    template <class Task>
    void onOwner(Task task)
    {
        events.enqueue([alive = std::weak_ptr<int>(life), task = std::move(task)] {
            if (!alive.expired()) task();
        });
    }

    void send(std::function<void(Simulation&)> command)
    {
        if (state == State::Stopped) return;
        const std::lock_guard lock(mutex);
        commands.push_back(std::move(command));
        wake.notify_one();
    }

    void publish(Simulation& simulation, double stepMs)
    {
        auto next = std::make_shared<SimulationFrame>();
        next->step = simulation.stepCount();
        next->time = simulation.time();
        next->stepMs = stepMs;
        next->view = simulation.view();
        if (pictured) {
            auto picture = std::make_shared<PhysicsPicture>(simulation.physicsPicture());
            picture->stepMs = stepMs;
            next->physics = std::move(picture);
        }
        const std::optional<HeldBody> holds = simulation.held();
        const bool listens = simulation.listensToPointer();
        simulation.scene().root().walk([&](const Item& item) {
            if (const Path* pose = simulation.pose(item)) next->poses.emplace_back(item.id(), *pose);
            if (const LiveBody* body = simulation.liveBody(item)) next->bodies.emplace_back(item.id(), *body);
        });
        std::sort(next->bodies.begin(), next->bodies.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        std::sort(next->poses.begin(), next->poses.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        {
            const std::lock_guard lock(mutex);
            frame = std::move(next);
            held = holds, listensToPointer = listens;
        }
        if (!framePending.exchange(true))
            onOwner([this] {
                framePending = false;
                events.post(&self, SimulationFrameReady{});
            });
    }

    // What an engine throws ends the run, not the program.
    void run(std::unique_ptr<Simulation> simulation)
    {
        std::string problem;
        try {
            play(*simulation);
        } catch (const std::exception& e) {
            problem = e.what();
        } catch (...) {
            problem = "an unknown exception";
        }
        simulation.reset();
        if (!problem.empty()) onOwner([this, problem] { stopWith("the run was stopped: " + problem); });
    }

    void remember(const Simulation& simulation, RewindHistory& history)
    {
        if (!history.wants(simulation.stepCount())) return;
        try {
            history.record(simulation.stepCount(), simulation.save());
        } catch (const Failure&) {  // an engine that cannot save can still play
            history.clear();
        }
        if (const RewindState kept = history.state(); kept.any) hand.forgetBefore(kept.oldest);
        tellRewind(simulation, history);
    }

    void tellRewind(const Simulation& simulation, const RewindHistory& history)
    {
        RewindState state = history.state();
        state.present = simulation.stepCount();
        const std::lock_guard lock(mutex);
        rewind = state;
    }

    /// Where not every step is kept, the physics is computed on from the one before, with what the hand did; scripts
    /// are left out of that.
    void goBack(Simulation& simulation, const RewindHistory& history, std::uint64_t step)
    {
        const auto state = history.find(step);
        if (!state) return;
        try {
            simulation.restore(state->bytes);
        } catch (const Failure& failure) {
            return simulation.print(
                {OutputLine::Kind::Warning, std::string("one cannot go back there: ") + failure.what(), {}, 0});
        }
        const std::uint64_t last = std::min(step, history.state().newest);
        while (!simulation.hasScripts() && simulation.stepCount() < last) {
            hand.again(simulation);
            simulation.stepPhysics();
        }
        hand.wentBack();
        tellRewind(simulation, history);
        publish(simulation, 0);
    }

    void play(Simulation& simulation)
    {
        const auto dt = std::chrono::duration<double>(simulation.timeStep());
        auto next = Clock::now();
        RewindHistory history(runLimits, simulation.timeStep());
        hand = {};
        remember(simulation, history);
        publish(simulation, 0);
        for (;;) {
            bool stepNow = false;
            std::optional<std::uint64_t> target;
            {
                std::unique_lock lock(mutex);
                const auto ready = [&] { return quit || !commands.empty() || singleSteps > 0 || rewindTarget; };
                if (paused && !ready()) wake.wait(lock, [&] { return ready() || !paused; });
                if (!paused) wake.wait_until(lock, next, ready);
                if (quit) return;
                auto waiting = std::exchange(commands, {});
                if (singleSteps > 0) {
                    --singleSteps;
                    stepNow = true;
                }
                const double pace = speed;
                const bool playing = !paused;
                target = std::exchange(rewindTarget, std::nullopt);
                lock.unlock();
                if (target) goBack(simulation, history, *target);
                for (auto& command : waiting) command(simulation);
                const auto now = Clock::now();
                if (playing && now >= next) {
                    stepNow = true;
                    next += std::chrono::duration_cast<Clock::duration>(dt / pace);
                    if (now - next > dt * kMaximumCatchUp / pace) next = now;
                } else if (!playing) {
                    next = now;
                }
            }
            if (!stepNow) {
                if (hand.moved()) publish(simulation, 0);
                continue;
            }
            hand.goOn(simulation);
            const auto before = Clock::now();
            simulation.step();
            const double took = std::chrono::duration<double, std::milli>(Clock::now() - before).count();
            remember(simulation, history);
            publish(simulation, took);
            if (simulation.requestedScene()) {
                onOwner([this, name = *simulation.requestedScene()] { goTo(name); });
                return;
            }
        }
    }

    void end()
    {
        {
            const std::lock_guard lock(mutex);
            quit = true;
            wake.notify_one();
        }
        if (thread.joinable()) thread.join();
        life = std::make_shared<int>();
        const std::lock_guard lock(mutex);
        commands.clear();
        quit = paused = false;
        singleSteps = 0;
        rewindTarget.reset();
        rewind = {};
        held.reset(), listensToPointer = false;
        framePending = false;
    }

    void setState(State next)
    {
        if (state == next) return;
        state = next;
        events.post(&self, SimulationStateChanged{next});
    }

    void stopWith(std::string message)
    {
        events.post(&self, OutputPrinted{{OutputLine::Kind::Error, std::move(message), {}, 0}});
        self.stop();
    }

    // A script asked for another scene. The thread has ended by now.
    void goTo(const std::string& name)
    {
        const Scene* target = options.sceneByName ? options.sceneByName(name) : nullptr;
        if (!target) return stopWith("there is no scene '" + name + "' to go to; the run was stopped");
        const auto kept = options;
        end();
        if (const auto begun = begin(*target, kept); !begun) return stopWith(begun.error().message);
        setState(State::Playing);
    }

    Result<void> begin(const Scene& playing, SimulationOptions with)
    {
        options = std::move(with);
        auto simulation = Simulation::start(playing, options);
        if (!simulation) return simulation.error();
        scene = &playing;
        runLimits = limits;
        listensToPointer = (*simulation)->listensToPointer();
        display = playing.clone(events);
        for (const OutputLine& line : (*simulation)->output()) events.post(&self, OutputPrinted{line});
        (*simulation)->setOutputHandler([this](const OutputLine& line) {
            onOwner([this, line] { events.post(&self, OutputPrinted{line}); });
        });
        (*simulation)->setPropertyHandler([this](ItemId item, std::string_view property, const Value& value) {
            onOwner([this, item, property = std::string(property), value] {
                const Item* found = display ? display->items().find(item) : nullptr;
                if (!found) return;
                Catalog& catalog = display->catalog();
                const auto tableOf = [&](const EffectInstance& instance) {
                    const Effect* effect = knownEffect(catalog, instance);
                    return effect ? &effect->properties() : nullptr;
                };
                putAt(*found, placeOf(*found, itemTable(catalog, found->type()), property, tableOf), property, value);
            });
        });
        thread = std::thread([this, s = std::move(*simulation)]() mutable { run(std::move(s)); });
        return {};
    }
};

SimulationCenter::SimulationCenter(EventsCenter& events) : d_(std::make_unique<Private>(*this, events)) {}
SimulationCenter::~SimulationCenter() { d_->end(); }

Result<void> SimulationCenter::play(const Scene& scene, SimulationOptions options)
{
    stop();
    auto begun = d_->begin(scene, std::move(options));
    if (begun) d_->setState(State::Playing);
    return begun;
}

void SimulationCenter::pause()
{
    if (d_->state != State::Playing) return;
    {
        const std::lock_guard lock(d_->mutex);
        d_->paused = true;
    }
    d_->setState(State::Paused);
}

void SimulationCenter::resume()
{
    if (d_->state != State::Paused) return;
    {
        const std::lock_guard lock(d_->mutex);
        d_->paused = false;
        d_->wake.notify_one();
    }
    d_->setState(State::Playing);
}

void SimulationCenter::singleStep()
{
    if (d_->state == State::Stopped) return;
    if (d_->state == State::Playing) pause();
    const std::lock_guard lock(d_->mutex);
    ++d_->singleSteps;
    d_->wake.notify_one();
}

void SimulationCenter::stop()
{
    if (d_->state == State::Stopped) return;
    d_->end();
    d_->scene = nullptr;
    d_->display.reset();
    d_->frame.reset();
    d_->setState(State::Stopped);
}

SimulationCenter::State SimulationCenter::state() const { return d_->state; }
const Scene* SimulationCenter::scene() const { return d_->scene; }
const Scene* SimulationCenter::runningScene() const { return d_->display.get(); }

RewindState SimulationCenter::rewindState() const
{
    const std::lock_guard lock(d_->mutex);
    return d_->rewind;
}

void SimulationCenter::rewindTo(std::uint64_t step)
{
    if (d_->state == State::Stopped) return;
    if (d_->state == State::Playing) pause();
    const std::lock_guard lock(d_->mutex);
    d_->rewindTarget = step;
    d_->wake.notify_one();
}

void SimulationCenter::setRewindLimits(const RewindLimits& limits) { d_->limits = limits; }

void SimulationCenter::setPhysicsMarks(const PhysicsMarks& marks)
{
    if (d_->marks == marks) return;
    d_->marks = marks;
    const bool before = d_->pictured.exchange(marks.any());
    if (!before && marks.any())  // a paused run has a frame without the picture
        d_->send([this](Simulation& simulation) { d_->publish(simulation, 0); });
    d_->events.post(this, PhysicsMarksChanged{});
}

const PhysicsMarks& SimulationCenter::physicsMarks() const { return d_->marks; }

void SimulationCenter::setSpeed(double factor)
{
    const std::lock_guard lock(d_->mutex);
    d_->speed = std::clamp(factor, 0.01, 100.0);
}

std::shared_ptr<const SimulationFrame> SimulationCenter::frame() const
{
    const std::lock_guard lock(d_->mutex);
    return d_->frame;
}

void SimulationCenter::key(const KeyEvent& event, bool down)
{
    d_->send([event, down](Simulation& simulation) { simulation.key(event, down); });
}

void SimulationCenter::pointer(ScriptEventKind kind, const PointerEvent& event)
{
    d_->send([kind, event](Simulation& simulation) { simulation.pointer(kind, event); });
}

void SimulationCenter::grab(const Vec2& point, double reach)
{
    d_->send([this, point, reach](Simulation& simulation) {
        d_->hand.act(simulation, {HandDeed::Kind::Grab, point, reach});
    });
}

void SimulationCenter::drag(const Vec2& to)
{
    d_->send([this, to](Simulation& simulation) { d_->hand.act(simulation, {HandDeed::Kind::Drag, to}); });
}

void SimulationCenter::letGo()
{
    d_->send([this](Simulation& simulation) { d_->hand.act(simulation, {HandDeed::Kind::LetGo, {0, 0}}); });
}

std::optional<HeldBody> SimulationCenter::held() const
{
    const std::lock_guard lock(d_->mutex);
    return d_->held;
}

bool SimulationCenter::listensToPointer() const
{
    const std::lock_guard lock(d_->mutex);
    return d_->listensToPointer;
}

void SimulationCenter::setViewSize(const Vec2& pixels)
{
    d_->options.viewSize = pixels;
    d_->send([pixels](Simulation& simulation) { simulation.view().size = pixels; });
}

}  // namespace jet
