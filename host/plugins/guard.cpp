#include "guard.hpp"

#include "host_call_watch.hpp"

#include <cmath>

namespace jet::host {

namespace {

/// A tool holds its gesture's transaction from one callback to the next, a panel that of a slider being dragged.
bool mayKeepOpen(Callback callback)
{
    switch (callback) {
    case Callback::ToolPress:
    case Callback::ToolDrag:
    case Callback::ToolRelease:
    case Callback::ToolMove:
    case Callback::ToolDoubleClick:
    case Callback::ToolWheel:
    case Callback::ToolKeyPress:
    case Callback::ToolKeyRelease:
    case Callback::PanelEvent: return true;
    default: return false;
    }
}

}  // namespace

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

Guard::Guard() { HostCallWatch::install(); }

void Guard::fault(Plugin& plugin, Callback callback, std::exception_ptr problem)
{
    fault(plugin, callback, std::string(nameOf(callback)) + " failed: " + reasonOf(problem));
}

void Guard::fault(Plugin& plugin, Callback callback, const std::string& sentence)
{
    {
        const std::lock_guard lock(mutex_);
        if (plugin.state == PluginState::Faulted) return;
        plugin.reason = sentence;
        plugin.state = PluginState::Faulted;  // after the reason: who sees the state may read it
    }
    if (onProblem)
        onProblem({plugin.manifest.id, std::string(nameOf(callback)),
                   "the plugin " + plugin.title() + " was switched off: " + sentence, sentence});
}

void Guard::leftOpen(Plugin& plugin, Callback callback, std::size_t before)
{
    if (mayKeepOpen(callback)) return;
    const std::string label = abandonTransactions(before);
    fault(plugin, callback,
          std::string(nameOf(callback)) + " left the change '" + label +
              "' open, which was rolled back; a transaction is committed or rolled back before the callback returns");
}

void Guard::hangs(Plugin& plugin, Callback callback, double seconds)
{
    const std::string sentence = "JET waits for the plugin " + plugin.title() + ": " + std::string(nameOf(callback)) +
                                 " has not returned for " + std::to_string(std::lround(seconds)) + " s";
    {
        const std::lock_guard lock(mutex_);
        notices_.push_back(sentence);
    }
    if (onHang) onHang({plugin.manifest.id, std::string(nameOf(callback)), sentence, {}});
}

std::vector<std::string> Guard::notices() const
{
    const std::lock_guard lock(mutex_);
    return notices_;
}

}  // namespace jet::host
