#include "plugin.hpp"

namespace jet::host {

std::string_view originName(PluginOrigin origin)
{
    static constexpr std::string_view names[] = {"path", "project", "user", "built-in"};
    return names[static_cast<int>(origin)];
}

std::string Plugin::title() const { return manifest.name + " (" + manifest.id + " " + manifest.version.text() + ")"; }

std::vector<CallbackCost> callbackCosts(const Plugin& plugin)
{
    const std::uint64_t calls = plugin.calls;
    if (calls == 0) return {};
    CallbackCost all;
    all.callback = "all";
    all.calls = calls;
    return {all};
}

}  // namespace jet::host
