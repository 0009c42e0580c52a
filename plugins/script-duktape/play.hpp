// Play: what all the bindings of one running simulation share.
#pragma once

#include "faults.hpp"
#include "items.hpp"
#include "limits.hpp"
#include "listeners.hpp"
#include "property_tables.hpp"
#include "script_files.hpp"

#include <jet/simulation.hpp>

#include <duktape.h>

#include <set>
#include <string>

namespace jet::duktape {

/// Objects that the bindings need at hand; kept alive in the heap's stash.
struct Prototypes {
    void* vector = nullptr;
    void* position = nullptr;
    void* velocity = nullptr;
    void* gravity = nullptr;  ///< the one vector ctx.gravity is
    void* area = nullptr;
    void* item = nullptr;
    void* body = nullptr;
    void* torque = nullptr;
    void* spring = nullptr;
    void* force = nullptr;
    void* joint = nullptr;
    void* tracebackGetter = nullptr;  ///< of Error.prototype.stack
};

class Play {
public:
    Play(Simulation& runningSimulation, const Limits& limits);
    Play(const Play&) = delete;
    Play& operator=(const Play&) = delete;

    static Play& of(duk_context* ctx);

    /// Simulated milliseconds since play started, whole: what System.currentTimeMillis() and Date.now() give.
    double milliseconds() const;

    /// Keeps the value on top of the stack alive as long as the heap; pops it and returns its pointer.
    void* keep(duk_context* ctx);
    /// Pushes a new Vec2d.
    void pushVector(duk_context* ctx, const Vec2& vector) const;
    /// Pushes a BoundingArea.
    void pushArea(duk_context* ctx, const Box& box) const;

    /// Prints a warning with the place of the script that is running; the same one only once.
    void warn(duk_context* ctx, const std::string& text);

    Simulation& simulation;
    Budget budget;
    ItemTable items;
    PropertyTables properties;
    ListenerTable listeners;
    ScriptFiles files;
    Prototypes prototypes;
    ItemId script;    ///< whose code or listener is running
    Place lastThrow;  ///< of something that is no Error
    Vec2 gravity;     ///< the world has no getter for it

private:
    std::set<std::string> warned_;
};

}  // namespace jet::duktape
