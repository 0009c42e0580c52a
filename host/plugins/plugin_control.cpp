#include "plugin_control.hpp"

#include "user_choice.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace jet::host {

namespace {

std::string textOf(const Dependency& need)
{
    return need.minimum == Version{} ? need.id : need.id + " " + need.minimum.text();
}

PluginInfo describe(const Plugin& plugin)
{
    const Manifest& manifest = plugin.manifest;
    PluginInfo info;
    info.id = manifest.id;
    info.name = manifest.name;
    info.version = manifest.version.text();
    info.description = manifest.description;
    info.license = manifest.license;
    info.folder = plugin.folder;
    info.state = plugin.state;
    info.reason = plugin.reason;
    for (const Dependency& need : manifest.requires_) info.requires_.push_back(textOf(need));
    for (const Dependency& need : manifest.optional) info.optional.push_back(textOf(need));
    info.contributions = manifest.contributions;
    info.loadMs = plugin.loadMs;
    info.callbacks = callbackCosts(plugin);
    info.calls = plugin.calls;
    if (plugin.library) info.mappedBytes = mappedBytes(plugin.mapped);
    return info;
}

}  // namespace

std::uint64_t mappedBytes(const std::filesystem::path& file)
{
    std::error_code ignored;
    const std::string wanted = std::filesystem::canonical(file, ignored).string();
    std::uint64_t bytes = 0;
    std::ifstream maps("/proc/self/maps");  // "from-to rwxp offset device inode   path"
    for (std::string line; !wanted.empty() && std::getline(maps, line);) {
        if (!line.ends_with(wanted)) continue;
        std::istringstream fields(line);
        std::uint64_t from = 0, to = 0;
        char dash = 0;
        if (fields >> std::hex >> from >> dash >> to && dash == '-') bytes += to - from;
    }
    return bytes;
}

PluginControl::PluginControl(PluginManager& manager, EventsCenter& events) : manager_(manager), events_(events)
{
    manager_.settingsStore().onChanged = [this](const SettingsChanged& change) { events_.post(this, change); };
}

PluginControl::~PluginControl() { manager_.settingsStore().onChanged = {}; }

std::vector<PluginInfo> PluginControl::plugins() const
{
    std::vector<PluginInfo> list;
    for (const Plugin* plugin : manager_.plugins()) list.push_back(describe(*plugin));
    std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    return list;
}

std::optional<PluginInfo> PluginControl::plugin(std::string_view id) const
{
    const Plugin* found = manager_.plugin(id);
    return found ? std::optional(describe(*found)) : std::nullopt;
}

std::vector<std::string> PluginControl::dependents(std::string_view id) const
{
    std::set<std::string> found{std::string(id)};
    for (bool grown = true; grown;) {
        grown = false;
        for (const Plugin* plugin : manager_.plugins()) {
            if (!plugin->usable() || found.contains(plugin->manifest.id)) continue;
            for (const Dependency& need : plugin->manifest.requires_)
                if (found.contains(need.id)) grown = found.insert(plugin->manifest.id).second || grown;
        }
    }
    found.erase(std::string(id));
    return {found.begin(), found.end()};
}

std::vector<std::string> PluginControl::requirements(std::string_view id) const
{
    std::vector<std::string> waiting{std::string(id)};
    std::set<std::string> seen, disabled;
    while (!waiting.empty()) {
        const Plugin* plugin = manager_.plugin(waiting.back());
        waiting.pop_back();
        if (!plugin || !seen.insert(plugin->manifest.id).second) continue;
        if (plugin->state == PluginState::Disabled) disabled.insert(plugin->manifest.id);
        for (const Dependency& need : plugin->manifest.requires_) waiting.push_back(need.id);
    }
    disabled.erase(std::string(id));
    return {disabled.begin(), disabled.end()};
}

Result<PluginChange> PluginControl::setEnabled(std::string_view id, bool enabled)
{
    const Plugin* plugin = manager_.plugin(id);
    if (!plugin) return Error("there is no plugin '" + std::string(id) + "'; 'jet plugins list' shows all");
    PluginChange change;
    change.plugins = enabled ? requirements(id) : dependents(id);
    change.plugins.insert(change.plugins.begin(), std::string(id));
    auto disabled = readDisabledPlugins();
    for (const std::string& one : change.plugins) {
        if (enabled)
            disabled.erase(one);
        else
            disabled.insert(one);
    }
    if (const auto written = writeDisabledPlugins(disabled); !written) return written.error();
    change.afterRestart = true;
    change.message = plugin->title() + " is switched " + (enabled ? "on" : "off") + " from the next start on.";
    events_.post(this, PluginsChanged{change.plugins});
    return change;
}

Provider PluginControl::whoProvides(ContributionKind kind, std::string_view id) const
{
    Provider provider;
    provider.sentence = manager_.explain(kind, id);
    return provider;
}

}  // namespace jet::host
