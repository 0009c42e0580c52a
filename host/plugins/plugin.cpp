#include "plugin.hpp"

namespace jet::host {

std::string_view originName(PluginOrigin origin)
{
    static constexpr std::string_view names[] = {"path", "project", "user", "built-in"};
    return names[static_cast<int>(origin)];
}

std::string Plugin::title() const
{
    return manifest.name + " (" + manifest.id + (broken ? ")" : " " + manifest.version.text() + ")");
}

std::vector<CallbackCost> callbackCosts(const Plugin& plugin)
{
    std::vector<CallbackCost> costs;
    if (!plugin.account) return costs;
    for (const CallbackTime& time : plugin.account->times())
        costs.push_back({std::string(nameOf(time.callback)), time.calls, time.totalMs, time.longestMs, time.overruns});
    return costs;
}

}  // namespace jet::host
