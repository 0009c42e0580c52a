#include "plugin_control.hpp"

#include "user_choice.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace jet::host {

namespace {

PluginInfo describe(const Plugin& plugin)
{
    const Manifest& manifest = plugin.manifest;
    PluginInfo info;
    info.id = manifest.id;
    info.name = manifest.name;
    info.version = plugin.versionText();
    info.description = manifest.description;
    info.license = manifest.license;
    info.folder = plugin.folder;
    info.state = plugin.state;
    info.reason = plugin.reason;
    for (const Dependency& need : manifest.requires_) info.requires_.push_back(need.text());
    for (const Dependency& need : manifest.optional) info.optional.push_back(need.text());
    for (const Dependency& enemy : manifest.conflicts) info.conflicts.push_back(enemy.text());
    info.origin = originName(plugin.origin);
    for (const Error& warning : manifest.warnings) info.warnings.push_back(warning.text());
    info.warnings.insert(info.warnings.end(), plugin.remarks.begin(), plugin.remarks.end());
    info.contributions = manifest.contributions;
    for (Contribution& one : info.contributions)
        if (!one.icon.empty()) one.icon = (plugin.folder / one.icon).string();
    info.loadMs = plugin.loadMs;
    info.callbacks = callbackCosts(plugin);
    for (const CallbackCost& cost : info.callbacks) info.calls += cost.calls;
    if (plugin.library) info.mappedBytes = mappedBytes(plugin.mapped);
    return info;
}

}  // namespace

std::uint64_t mappedBytes(const std::filesystem::path& file)
{
    std::error_code ignored;
    std::string wanted = std::filesystem::canonical(file, ignored).string();
    if (wanted.empty() && !file.empty()) wanted = file.string() + " (deleted)";  // a copy, gone once it was mapped
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

PluginControl::PluginControl(PluginManager& manager, EventsCenter& events, PackageActions packages)
    : manager_(manager), events_(events), packages_(std::move(packages))
{
    if (const auto& set = manager_.options().set; set && set->source == SetSource::CommandLine) startSet_ = set;
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
    std::set<std::string> ids{std::string(id)};
    if (enabled)
        for (std::string& need : requirements(id)) ids.insert(std::move(need));
    const bool leftOut = plugin->leftOut;
    auto disabled = readDisabledPlugins();
    for (const std::string& one : ids) {
        if (enabled)
            disabled.erase(one);
        else
            disabled.insert(one);
    }
    if (const auto written = writeDisabledPlugins(disabled); !written) return written.error();
    PluginChange change;
    change.plugins = manager_.setEnabled(ids, enabled);
    const std::string name = plugin->manifest.name;
    if (enabled && !plugin->usable()) {
        // What failed while it ran needs a fresh start; anything else is told by its reason.
        change.afterRestart = plugin->state == PluginState::Faulted && !plugin->unmet && !plugin->broken;
        change.message = name +
                         (change.afterRestart ? " failed in this run and is used again after a restart: "
                                              : " is switched on, but cannot be used: ") +
                         plugin->reason + ".";
    } else {
        change.message = name + " is switched " + (enabled ? "on." : "off.");
    }
    const auto& set = manager_.options().set;
    if (enabled && leftOut && set)
        change.message += " It is not in the plugin set '" + set->name + "': this holds until JET ends.";
    tell(change.plugins);
    return change;
}

Result<PluginChange> PluginControl::install(const std::filesystem::path& file)
{
    if (!packages_.install) return PluginsCenter::install(file);
    const auto installed = packages_.install(file);
    if (!installed) return installed.error();
    PluginChange change;
    for (const PackageActions::Installed& one : *installed) {
        const Plugin* before = manager_.plugin(one.id);
        const bool inUse = before && before->library && before->folder == one.folder;
        if (!inUse) {
            manager_.removeFolder(one.folder);  // an older copy that was in the same place
            manager_.addFolder(one.folder, PluginOrigin::User);
        }
        change.afterRestart = change.afterRestart || inUse;
        change.plugins.push_back(one.id);
        change.message += (change.message.empty() ? "" : " ") + one.message +
                          (inUse ? " The version that is in use stays until JET is started again." : "");
    }
    tell(change.plugins);
    return change;
}

Result<PluginChange> PluginControl::remove(std::string_view id)
{
    if (!packages_.remove) return PluginsCenter::remove(id);
    const Plugin* plugin = manager_.plugin(id);
    if (!plugin) return Error("there is no plugin '" + std::string(id) + "'; 'jet plugins list' shows all");
    if (plugin->origin != PluginOrigin::User)
        return Error(plugin->title() + " is not one of the user's plugins, but lies in " + plugin->folder.string() +
                     "; switch it off instead");
    PluginChange change;
    change.message = plugin->manifest.name + " is removed; its settings are kept.";
    const auto folder = packages_.remove(std::string(id));
    if (!folder) return folder.error();
    change.plugins = manager_.removeFolder(*folder);
    change.plugins.emplace_back(id);
    tell(change.plugins);
    return change;
}

}  // namespace jet::host
