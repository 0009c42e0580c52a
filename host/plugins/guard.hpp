// The guard around every call into a plugin: an exception becomes a message and a neutral result, the plugin is faulted, the
// editor goes on. Only guarded objects leave the plugin manager, so no caller can forget it.
#pragma once

#include "plugin.hpp"

#include <exception>
#include <functional>
#include <string>

namespace jet::host {

/// What went wrong in a plugin, for the user.
struct PluginProblem {
    std::string plugin;    ///< id
    std::string callback;  ///< e.g. "Tool::press"
    std::string message;   ///< a sentence with plugin, callback and reason
};

/// Shared by the manager and all guarded objects.
class Guard {
public:
    std::function<void(const PluginProblem&)> onProblem;  ///< [thread of the failing call]

    /// Calls fn; on an exception faults the plugin, reports, and returns `neutral`. A faulted plugin is not called at all.
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

    void fault(Plugin& plugin, const char* callback, std::exception_ptr problem);
};

}  // namespace jet::host
