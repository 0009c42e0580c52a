// What every test of a plugin has: the plugin, the seed, the board it writes on, and call(), through which all calls
// into the plugin go. Nothing is guarded here: what leaves a callback is the finding.
#pragma once

#include "board.hpp"
#include "random.hpp"

#include "host/plugins/manifest.hpp"

#include <jet/events.hpp>
#include <jet/scene.hpp>
#include <jet/testing/catalog.hpp>
#include <jet/testing/tool_driver.hpp>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace jet::host::check {

/// Sanitizers make everything slower and larger; limits allow for it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr int kSlowness = 5;
#else
inline constexpr int kSlowness = 1;
#endif

/// A test that failed, with the reason.
class Failed : public std::runtime_error {
public:
    using runtime_error::runtime_error;
};

struct Context {
    std::filesystem::path folder;
    Manifest manifest;
    std::string contribution;  ///< id of the one under test; empty for tests of the whole plugin
    std::uint64_t seed = 1;
    std::filesystem::path samples;  ///< folder of sample files for importers; may be empty
    Board& board;
    Random random;

    /// A callback that takes longer has hung, for a person: it blocks the window. Time in which a busy machine gives
    /// the thread no processor does not count.
    static constexpr std::chrono::seconds callLimit{2 * kSlowness};

    [[noreturn]] void fail(const std::string& reason) const { throw Failed(reason); }
    void activity(const std::string& text) const { board.activity(text); }

    /// Calls into the plugin: an exception, or taking too long, fails the test and names the callback.
    template <class Fn>
    decltype(auto) call(const char* callback, Fn&& fn) const
    {
        board.callback(callback);
        const Watch watch{*this, callback, Clock::now(), std::uncaught_exceptions()};
        try {
            return fn();
        } catch (const Failed&) {
            throw;
        } catch (const std::exception& e) {
            fail(where(std::string(callback) + " failed with an exception: " + e.what()));
        } catch (...) {
            fail(where(std::string(callback) + " failed with an unknown exception"));
        }
    }
    /// "…, in edit 12".
    std::string where(const std::string& problem) const;

private:
    /// Runs while the thread works or sleeps, and stands while it is ready and waits for a processor. Of one thread.
    struct Clock {
        using duration = std::chrono::nanoseconds;
        using time_point = std::chrono::time_point<std::chrono::steady_clock, duration>;
        static time_point now();
    };
    struct Watch {
        const Context& context;
        const char* callback;
        Clock::time_point begin;
        int exceptions;
        ~Watch() noexcept(false);
    };
};

/// A scene without a window, with the plugin, what it requires and, if wanted, what it makes use of.
class Stage {
public:
    enum class With { Optional, RequiredOnly };
    explicit Stage(Context& context, With with = With::Optional);
    ~Stage();

    Context& context;
    test::TestCatalog catalog;
    EventsCenter events;
    Scene scene;
    test::TestToolHost host;

    ItemsCenter& items() { return scene.items(); }
    /// Shapes, a body, a group, a spring, a script; some hidden, locked, with effects of the plugin.
    void fill();
    /// A change made elsewhere in the editor: items added, removed, moved, changed, selected.
    void editElsewhere();
    /// Loads the plugin of some physics engine, if one is installed.
    bool loadPhysicsEngine();

    void checkClosed(const std::string& who);
    /// Written, read and written again: the same bytes, the same hash.
    void checkSaving();
    void checkPainting();
    /// Items that are in the scene beyond `most` are removed.
    void thin(std::size_t most);

private:
    std::string listenerProblem_;
};

/// Undo and redo against the hashes of the states they lead to.
class UndoModel {
public:
    explicit UndoModel(Stage& stage) : stage_(stage) { record(); }
    /// After each edit.
    void record();
    /// Some steps back or forward, comparing at each.
    void wander();
    /// All the way back and forward.
    void sweep();

private:
    void goTo(std::size_t position);
    Stage& stage_;
    std::vector<std::uint64_t> hashes_;  // by position in the history; 0: not known
};

}  // namespace jet::host::check
