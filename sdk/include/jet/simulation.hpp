// Simulation: a running copy of a scene. The same code plays with and without a window.
//
//   auto simulation = Simulation::start(scene, options).orThrow();
//   simulation->setKey("D", true);
//   simulation->step();
//
// A Simulation belongs to one thread at a time. SimulationCenter runs one on a thread of its own.
#pragma once

#include <jet/events.hpp>
#include <jet/format.hpp>
#include <jet/input.hpp>
#include <jet/live_body.hpp>
#include <jet/physics.hpp>
#include <jet/scene.hpp>
#include <jet/script.hpp>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace jet {

struct PhysicsMarks;    // jet/physics_view.hpp
struct PhysicsPicture;  // jet/physics_view.hpp
struct RewindLimits;    // jet/rewind.hpp
struct RewindState;     // jet/rewind.hpp

struct SimulationOptions {
    std::optional<double> timeStep;  ///< seconds; none: the scene's
    std::string physics;             ///< engine id; empty: the scene's, else the first installed
    std::uint64_t seed = 1;          ///< for Math.random in scripts
    int threads = 1;
    Vec2 viewSize{1280, 720};  ///< pixels, as scripts see it
    /// Finds another scene for CC.getScene(name) and playScene; may be empty.
    std::function<const Scene*(std::string_view)> sceneByName;
};

/// What is printed while playing.
struct OutputLine {
    enum class Kind { Text, Warning, Error };
    Kind kind = Kind::Text;
    std::string text;
    ItemId script;  ///< the script item an error is in; none otherwise
    int line = 0;   ///< of that script, from 1
};

/// The camera of a running game.
struct GameView {
    View view;
    Vec2 size;  ///< pixels
};

/// A body that a hand holds, and the spring between them.
struct HeldBody {
    ItemId item;
    Vec2 at;    ///< where it is held, scene coordinates
    Vec2 hand;  ///< where it is drawn to
};

class JET_API Simulation final : public PoseSource {
public:
    /// Copies the scene, builds all bodies and runs the scripts. Fails when there is no physics engine. A body that
    /// cannot be built stays as drawn, with a warning; script errors are printed, not fatal.
    static Result<std::unique_ptr<Simulation>> start(const Scene& scene, SimulationOptions options);
    ~Simulation() override;

    /// One fixed time step: scripts' onStep, physics, then collisions, onPrePaint and onPostPaint to scripts (SPEC
    /// PH10). What an engine throws passes through: the run is over then.
    void step();
    std::uint64_t stepCount() const;
    /// Simulated seconds.
    double time() const;
    double timeStep() const;

    const Scene& scene() const;
    PhysicsWorld& world();
    const PhysicsWorld& world() const;

    // Bodies and actuators by item.
    BodyHandle bodyOf(ItemId item) const;  ///< kNoHandle when the item has no body
    ItemId itemOf(BodyHandle body) const;
    ActuatorHandle actuatorOf(ItemId item) const;
    /// The first constant force the item added when play started; kNoHandle when it added none.
    ActuatorHandle forceOf(ItemId item) const;
    /// The first joint the item added when play started; kNoHandle when it added none.
    JointHandle jointOf(ItemId item) const;
    const Path* pose(const Item& item) const override;
    const LiveBody* liveBody(const Item& item) const override;
    /// In the thesis's sign: positive turns left (counter-clockwise on screen).
    void setTorque(ItemId item, double value);
    double torque(ItemId item) const;

    // Input. Keys are named as in KeyEvent; unknown names are simply never pressed.
    void key(const KeyEvent& event, bool down);
    void setKey(std::string_view key, bool down);
    bool isPressed(std::string_view key) const;
    void pointer(ScriptEventKind kind, const PointerEvent& event);
    /// Do scripts listen to any event of the pointer now? Then what is dragged is theirs.
    bool listensToPointer() const;

    // A hand that drags bodies about, as a person's does while a game is tried out: grab -> drag ... -> letGo. It pulls
    // by a spring of limited force, a joint of the world, and belongs to the state that is saved.
    /// Takes hold of the topmost shown body that contains the point and may move, else of the nearest one no farther
    /// than `reach` (scene units), and wakes it; what was held is let go first. Its item; none when nothing is there,
    /// or when the engine has no joints, which is printed once.
    ItemId grab(const Vec2& point, double reach = 0);
    /// Where the hand is from now on; nothing where it holds nothing.
    void drag(const Vec2& to);
    void letGo();
    std::optional<HeldBody> held() const;

    GameView& view();
    const GameView& view() const;

    /// Appends to the output; also what scripts print.
    void print(OutputLine line);
    void print(std::string text) { print(OutputLine{OutputLine::Kind::Text, std::move(text), {}, 0}); }
    /// The last 10,000 lines.
    const std::deque<OutputLine>& output() const;
    /// Called for each line as it is printed, on the simulation's thread.
    void setOutputHandler(std::function<void(const OutputLine&)> handler);

    /// A script asked to go to another scene; the player acts on it after the step.
    void requestScene(std::string name);
    const std::optional<std::string>& requestedScene() const;
    const Scene* sceneByName(std::string_view name) const;

    /// Deterministic random number in [0, 1).
    double random();
    /// Changes a property of an item, or of a body's effects, while playing: in this run only, and from the next step
    /// on. Throws Failure when it cannot change while playing, with the reason; then nothing has changed.
    void setItemProperty(ItemId item, std::string_view property, Value value);

    /// Called for each such change, on the simulation's thread.
    void setPropertyHandler(std::function<void(ItemId, std::string_view, const Value&)> handler);

    /// Hash of the dynamic state: equal runs give equal hashes.
    std::uint64_t hash() const;
    /// The dynamic state as bytes: physics, steps, actuators, camera, random numbers; not what scripts keep in
    /// variables of their own, nor keys. After restore() it goes on bit-equal. Only for the simulation that saved it,
    /// or an equal one.
    std::vector<std::byte> save() const;
    void restore(std::span<const std::byte> state);
    bool hasScripts() const;
    /// Steps the physics alone, as between two kept states of a history: scripts hear nothing of it.
    void stepPhysics();
    /// The world as it is now, for looking at it.
    PhysicsPicture physicsPicture() const;
    /// The state file of the command line (DESIGN §5), as JSON text.
    std::string stateJson() const;

private:
    Simulation();
    static Result<std::unique_ptr<Simulation>> prepare(const Scene& scene, SimulationOptions options);
    struct Private;
    std::unique_ptr<Private> d_;
};

/// An immutable picture of a running simulation, handed from its thread to the window.
struct SimulationFrame {
    std::uint64_t step = 0;
    double time = 0;
    double stepMs = 0;  ///< wall time of the last step
    GameView view;
    std::vector<std::pair<ItemId, Path>> poses;       ///< items with a body, sorted by id
    std::vector<std::pair<ItemId, LiveBody>> bodies;  ///< of items with an effect that wants it, sorted by id
    std::shared_ptr<const PhysicsPicture> physics;    ///< while a physics mark is set, else null
};

/// Sent by the SimulationCenter on the owner thread of its EventsCenter.
struct SimulationStateChanged {
    static constexpr EventType type{"org.jet.simulation-state-changed"};
    enum class State { Stopped, Playing, Paused };
    State state;
};
struct SimulationFrameReady {
    static constexpr EventType type{"org.jet.simulation-frame-ready"};
};
struct OutputPrinted {
    static constexpr EventType type{"org.jet.output-printed"};
    OutputLine line;
};

/// Plays one scene at a time on its own thread, in real time (thesis §2.4.3.8 Animator, SPEC EN8). An exception inside
/// an engine ends the run with a message (OutputPrinted).
class JET_API SimulationCenter {
public:
    using State = SimulationStateChanged::State;

    explicit SimulationCenter(EventsCenter& events);
    ~SimulationCenter();

    Result<void> play(const Scene& scene, SimulationOptions options);
    void pause();
    void resume();
    /// One step while paused.
    void singleStep();
    /// Ends the run; the edited scene was never touched (SPEC PH11).
    void stop();
    State state() const;
    /// The scene being played, as edited; null when stopped.
    const Scene* scene() const;
    /// A copy of the scene for painting with a frame's poses, with what scripts changed; null when stopped. [owner's
    /// thread]
    const Scene* runningScene() const;
    /// 1 = real time.
    void setSpeed(double factor);

    // Going back (jet/rewind.hpp). [owner's thread]
    RewindState rewindState() const;
    /// Pauses, and shows the state after `step`, or the nearest that can be gone back to. Asked for again before it is
    /// done, only the last wish counts.
    void rewindTo(std::uint64_t step);
    /// Of the next run; 10 s and 256 MB at first.
    void setRewindLimits(const RewindLimits& limits);

    // Looking inside (jet/physics_view.hpp). The marks stay from run to run; PhysicsMarksChanged tells of them.
    void setPhysicsMarks(const PhysicsMarks& marks);
    const PhysicsMarks& physicsMarks() const;

    /// Latest frame; null when stopped. [owner's thread]
    std::shared_ptr<const SimulationFrame> frame() const;
    /// Queued for the simulation thread.
    void key(const KeyEvent& event, bool down);
    void pointer(ScriptEventKind kind, const PointerEvent& event);
    void setViewSize(const Vec2& pixels);

    // The hand of Simulation::grab(), queued as well. It may hold while the run is paused; what is gone back to is as
    // it was, and is let go when the run goes on from there.
    void grab(const Vec2& point, double reach);
    void drag(const Vec2& to);
    void letGo();
    /// As of the latest frame. [owner's thread]
    std::optional<HeldBody> held() const;
    /// As of the latest frame: do scripts listen to the pointer? [owner's thread]
    bool listensToPointer() const;

private:
    struct Private;
    std::unique_ptr<Private> d_;
};

}  // namespace jet
