// The guard around every call into a plugin: an exception becomes a message and a neutral result, what the plugin left
// half done is rolled back, the plugin is faulted, the editor goes on. Each call is noted on the CallBoard (for the
// crash ledger and the watchdog) and on the plugin's account (for its cost). Only guarded objects leave the plugin
// manager, so no caller can forget it.
#pragma once

#include "call_account.hpp"
#include "plugin.hpp"

#include <jet/call_watch.hpp>

#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

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
    /// A call takes very long and goes on; the reason is empty. [a thread of its own]
    std::function<void(const PluginProblem&)> onHang;

    Guard();

    /// Calls fn; on an exception faults the plugin, reports, and returns `neutral`. A faulted plugin is not called at
    /// all. The plugin has been loaded, or is being.
    template <class Fn, class T>
    T call(Plugin& plugin, Callback callback, Fn&& fn, T neutral)
    {
        if (!plugin.usable()) return neutral;
        const std::size_t open = openTransactionCount();
        try {
            T result = [&]() -> T {
                const CallScope scope(*plugin.account, callback);
                return fn();
            }();
            if (openTransactionCount() > open) [[unlikely]]
                leftOpen(plugin, callback, open);
            return result;
        } catch (...) {
            abandonTransactions(open);
            fault(plugin, callback, std::current_exception());
            return neutral;
        }
    }
    template <class Fn>
    bool run(Plugin& plugin, Callback callback, Fn&& fn)
    {
        return call(
            plugin, callback,
            [&] {
                fn();
                return true;
            },
            false);
    }
    /// For destructors: run even when the plugin is switched off.
    template <class Fn>
    void destroy(Plugin& plugin, Callback callback, Fn&& fn)
    {
        try {
            const CallScope scope(*plugin.account, callback);
            fn();
        } catch (...) {
            fault(plugin, callback, std::current_exception());
        }
    }

    /// The first fault of a plugin is told; later ones are consequences. [any thread]
    void fault(Plugin& plugin, Callback callback, std::exception_ptr problem);
    void fault(Plugin& plugin, Callback callback, const std::string& sentence);
    /// Transactions opened in the callback are still open after it: rolled back, unless tools may hold them so.
    void leftOpen(Plugin& plugin, Callback callback, std::size_t before);
    /// [watchdog]
    void hangs(Plugin& plugin, Callback callback, double seconds);
    /// Sentences about what was slow, for the user to see. [any thread]
    std::vector<std::string> notices() const;

private:
    mutable std::mutex mutex_;  // guards the reason of plugins that are being faulted, and the notices
    std::vector<std::string> notices_;
};

/// What the exception says. Call inside or outside of its catch block.
std::string reasonOf(std::exception_ptr problem);

}  // namespace jet::host
