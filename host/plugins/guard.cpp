#include "guard.hpp"

namespace jet::host {

void Guard::fault(Plugin& plugin, const char* callback, std::exception_ptr problem)
{
    std::string reason = "an unknown exception";
    try {
        std::rethrow_exception(problem);
    } catch (const std::exception& e) {
        reason = e.what();
    } catch (...) {
    }
    plugin.reason = std::string(callback) + " failed: " + reason;
    plugin.state = PluginState::Faulted;
    if (onProblem)
        onProblem({plugin.manifest.id, callback,
                   "The plugin " + plugin.title() + " failed in " + callback + " and was switched off: " + reason});
}

}  // namespace jet::host
