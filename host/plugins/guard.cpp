#include "guard.hpp"

namespace jet::host {

std::string reasonOf(std::exception_ptr problem)
{
    try {
        std::rethrow_exception(problem);
    } catch (const std::exception& e) {
        return e.what();
    } catch (...) {
        return "an unknown exception";
    }
}

void Guard::fault(Plugin& plugin, const char* callback, std::exception_ptr problem)
{
    const std::string reason = reasonOf(problem);
    {
        const std::lock_guard lock(mutex_);
        if (plugin.state == PluginState::Faulted) return;
        plugin.reason = std::string(callback) + " failed: " + reason;
        plugin.state = PluginState::Faulted;  // after the reason: who sees the state may read it
    }
    if (onProblem)
        onProblem(
            {plugin.manifest.id, callback,
             "the plugin " + plugin.title() + " was switched off: " + std::string(callback) + " failed: " + reason,
             plugin.reason});
}

}  // namespace jet::host
