// The guard around every call into a plugin: an exception becomes a message and a neutral result, the plugin is
// faulted, the editor goes on. Only guarded objects leave the plugin manager, so no caller can forget it.
#pragma once

#include "plugin.hpp"

#include <exception>
#include <functional>
#include <mutex>
#include <string>

namespace jet::host {

/// What went wrong in a plugin, for the user.
struct PluginProblem {
    std::string plugin;    ///< id
    std::string callback;  ///< e.g. "Tool::press"
    std::string message;   ///< a sentence with plugin, callback and reason
    std::string reason;    ///< the same as Plugin::reason
};

/// Shared by the manager and all guarded objects.
class Guard {
public:
    std::function<void(const PluginProblem&)> onProblem;  ///< [thread of the failing call]

    /// Calls fn; on an exception faults the plugin, reports, and returns `neutral`. A faulted plugin is not called at
    /// all.
    template <class Fn, class T>
    T call(Plugin& plugin, const char* callback, Fn&& fn, T neutral)
    {
        if (!plugin.usable()) return neutral;
        plugin.calls.fetch_add(1, std::memory_order_relaxed);
        try {
            return fn();
        } catch (...) {
            fault(plugin, callback, std::current_exception());
            return neutral;
        }
    }
    template <class Fn>
    bool run(Plugin& plugin, const char* callback, Fn&& fn)
    {
        return call(
            plugin, callback,
            [&] {
                fn();
                return true;
            },
            false);
    }

    /// The first fault of a plugin is told; later ones are consequences. [any thread]
    void fault(Plugin& plugin, const char* callback, std::exception_ptr problem);

private:
    std::mutex mutex_;  // guards the reason of plugins that are being faulted
};

/// What the exception says. Call inside or outside of its catch block.
std::string reasonOf(std::exception_ptr problem);

}  // namespace jet::host
