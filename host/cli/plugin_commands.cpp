#include "commands.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace jet::host {

using Json = nlohmann::ordered_json;

namespace {

Json describe(const Plugin& plugin)
{
    Json json{{"id", plugin.manifest.id},
              {"name", plugin.manifest.name},
              {"version", plugin.manifest.version.text()},
              {"state", std::string(stateName(plugin.state))},
              {"reason", plugin.reason},
              {"description", plugin.manifest.description},
              {"license", plugin.manifest.license},
              {"folder", plugin.folder.string()},
              {"jet", plugin.manifest.jet.text()},
              {"builtFor", {{"sdk", plugin.manifest.sdk}, {"abi", plugin.manifest.abi}}},
              {"requires", Json::array()},
              {"contributes", Json::object()}};
    for (const Dependency& need : plugin.manifest.requires_) json["requires"].push_back(need.id);
    for (const Contribution& one : plugin.manifest.contributions) {
        Json entry{{"id", one.id}, {"label", one.label}};
        if (!one.extensions.empty()) entry["extensions"] = one.extensions;
        if (!one.shortcut.empty()) entry["shortcut"] = one.shortcut;
        json["contributes"][std::string(manifestKey(one.kind))].push_back(std::move(entry));
    }
    return json;
}

std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace); }

}  // namespace

int listPlugins(Session& session)
{
    const auto all = session.plugins().plugins();
    if (session.options().json) {
        Json list = Json::array();
        for (const Plugin* plugin : all) list.push_back(describe(*plugin));
        std::printf("%s\n", dump(list).c_str());
        return kOk;
    }
    std::size_t width = 0;
    for (const Plugin* plugin : all) width = std::max(width, plugin->manifest.id.size());
    for (const Plugin* plugin : all) {
        std::printf("%-*s  %-8s %-9s %s\n", static_cast<int>(width), plugin->manifest.id.c_str(),
                    plugin->manifest.version.text().c_str(), std::string(stateName(plugin->state)).c_str(),
                    plugin->reason.empty() ? plugin->manifest.description.c_str() : plugin->reason.c_str());
    }
    return kOk;
}

int pluginInfo(Session& session, const std::string& id)
{
    PluginManager& plugins = session.plugins();
    const Plugin* plugin = plugins.plugin(id);
    if (!plugin) {
        session.error(Error("there is no plugin '" + id + "'; 'jet plugins list' shows all"));
        return kFailed;
    }
    // Whether it really runs is part of what one wants to know: load it.
    if (plugin->state == PluginState::Resolved) (void)plugins.load(id);
    if (plugin->state == PluginState::Faulted)
        session.error(Error("the plugin " + plugin->title() + " cannot be used: " + plugin->reason));
    if (session.options().json) {
        std::printf("%s\n", dump(describe(*plugin)).c_str());
        return plugin->state == PluginState::Faulted ? kFailed : kOk;
    }
    std::printf("%s\n  %s\n  state    %s%s%s\n  folder   %s\n  licence  %s\n", plugin->title().c_str(),
                plugin->manifest.description.c_str(), std::string(stateName(plugin->state)).c_str(),
                plugin->reason.empty() ? "" : ": ", plugin->reason.c_str(), plugin->folder.c_str(),
                plugin->manifest.license.c_str());
    std::printf("  built    for SDK %s, %s\n", plugin->manifest.sdk.c_str(), plugin->manifest.abi.c_str());
    if (plugin->library) std::printf("  loaded   in %.2f ms\n", plugin->loadMs);
    for (const Dependency& need : plugin->manifest.requires_) std::printf("  requires %s\n", need.id.c_str());
    for (const Contribution& one : plugin->manifest.contributions) {
        std::printf("  %s '%s': %s", std::string(kindName(one.kind)).c_str(), one.id.c_str(), one.label.c_str());
        for (const std::string& extension : one.extensions) std::printf(" .%s", extension.c_str());
        std::printf(one.shortcut.empty() ? "\n" : " (%s)\n", one.shortcut.c_str());
    }
    return plugin->state == PluginState::Faulted ? kFailed : kOk;
}

int explainContribution(Session& session, const std::string& id)
{
    PluginManager& plugins = session.plugins();
    const std::string name = !id.empty() && id.front() == '.' ? id.substr(1) : id;
    bool found = false;
    for (int k = 0; k < kContributionKinds; ++k) {
        const auto kind = static_cast<ContributionKind>(k);
        const std::string sentence = plugins.explain(kind, name);
        if (sentence.starts_with("No installed")) continue;
        std::printf("%s\n", sentence.c_str());
        found = true;
    }
    if (found) return kOk;
    if (const Plugin* plugin = plugins.plugin(name)) {
        std::printf("%s is a plugin: %s%s%s\n", plugin->title().c_str(), std::string(stateName(plugin->state)).c_str(),
                    plugin->reason.empty() ? "" : ", ", plugin->reason.c_str());
        return kOk;
    }
    session.error(Error("no installed plugin provides a tool, effect, item type, format, panel or engine called '" +
                        name + "'; 'jet plugins list' shows what is installed"));
    return kFailed;
}

int enablePlugin(Session& session, const std::string& id, bool enable)
{
    if (!session.plugins().plugin(id)) {
        session.error(Error("there is no plugin '" + id + "'; 'jet plugins list' shows all"));
        return kFailed;
    }
    auto disabled = readDisabledPlugins();
    enable ? disabled.erase(id) : disabled.insert(id).second;
    if (const auto written = writeDisabledPlugins(disabled); !written) {
        session.error(written.error());
        return kFailed;
    }
    std::printf("%s is switched %s from the next start on\n", id.c_str(), enable ? "on" : "off");
    return kOk;
}

}  // namespace jet::host
