// Script engines: run the ScriptItems of a playing scene (SPEC SC).
#pragma once

#include <jet/input.hpp>
#include <jet/item.hpp>
#include <jet/physics.hpp>
#include <jet/result.hpp>

#include <memory>
#include <string>

namespace jet {

class Simulation;

enum class ScriptEventKind {
    Step,
    PrePaint,
    PostPaint,
    KeyDown,
    KeyUp,
    KeyTyped,
    BodyCollision,
    PointerDown,
    PointerUp,
    PointerMove,
    ContactBegin,  ///< to runtimes that are ContactListening alone
    ContactEnd     ///< the same
};

struct ScriptEvent {
    ScriptEventKind kind;
    KeyEvent key;          ///< Key*
    PointerEvent pointer;  ///< Pointer*
    ItemId bodyA, bodyB;   ///< BodyCollision, Contact*
    Contact contact;  ///< BodyCollision; ContactBegin: where it pushes hardest, all impulse; no normal: not known where
};

/// The scripts of one running simulation. Used on the simulation's thread only; destroyed before the Simulation.
class JET_API ScriptRuntime {
public:
    virtual ~ScriptRuntime();
    /// Runs one script item's code with the global `script` set to it. An Error names item and line. Time-limited.
    virtual Result<void> run(const Item& script) = 0;
    /// Calls the listeners of the event. A listener that fails or exceeds its time is removed and reported through
    /// Simulation::print(); the others go on.
    virtual void dispatch(const ScriptEvent& event) = 0;
    /// Is anyone listening? Lets the simulation skip work.
    virtual bool listensTo(ScriptEventKind kind) const = 0;
};

/// A ScriptRuntime that derives from this one, too, is told of touches that begin and end, each pair of bodies by
/// turns: who begins to listen later is told first of all that touch, and after Simulation::restore() of all that
/// differs.
class JET_API ContactListening {
public:
    virtual ~ContactListening();
    /// Is anyone listening to ContactBegin or ContactEnd?
    virtual bool listensToContacts() const = 0;
};

class JET_API ScriptEngine {
public:
    virtual ~ScriptEngine();
    virtual std::unique_ptr<ScriptRuntime> createRuntime(Simulation& simulation) = 0;
};

}  // namespace jet
