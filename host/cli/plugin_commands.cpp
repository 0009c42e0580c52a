#include "commands.hpp"

#include "host/plugins/plugin_control.hpp"
#include "host/plugins/project_trust.hpp"
#include "host/plugins/suggest.hpp"

#include <jet/project.hpp>

#include <nlohmann/json.hpp>

#include <cstdio>

namespace jet::host {

using Json = nlohmann::ordered_json;

namespace {

Json describe(const Plugin& plugin)
{
    Json json{{"id", plugin.manifest.id},
              {"name", plugin.manifest.name},
              {"version", plugin.versionText()},
              {"state", std::string(stateName(plugin.state))},
              {"reason", plugin.reason},
              {"description", plugin.manifest.description},
              {"license", plugin.manifest.license},
              {"folder", plugin.folder.string()},
              {"origin", std::string(originName(plugin.origin))},
              {"jet", plugin.manifest.jet.text()},
              {"builtFor", {{"sdk", plugin.manifest.sdk}, {"abi", plugin.manifest.abi}}},
              {"requires", Json::array()},
              {"contributes", Json::object()}};
    for (const Dependency& need : plugin.manifest.requires_) json["requires"].push_back(need.text());
    json["optional"] = json["conflicts"] = json["warnings"] = Json::array();
    for (const Dependency& wish : plugin.manifest.optional) json["optional"].push_back(wish.text());
    for (const Dependency& enemy : plugin.manifest.conflicts) json["conflicts"].push_back(enemy.text());
    for (const Error& warning : plugin.manifest.warnings) json["warnings"].push_back(warning.text());
    for (const std::string& remark : plugin.remarks) json["warnings"].push_back(remark);
    for (const Contribution& one : plugin.manifest.contributions) {
        Json entry{{"id", one.id}, {"label", one.label}};
        if (!one.extensions.empty()) entry["extensions"] = one.extensions;
        if (!one.mimeTypes.empty()) entry["mimeTypes"] = one.mimeTypes;
        if (!one.shortcut.empty()) entry["shortcut"] = one.shortcut;
        json["contributes"][std::string(manifestKey(one.kind))].push_back(std::move(entry));
    }
    return json;
}

std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace); }

}  // namespace

int listPlugins(Session& session)
{
    session.compareWithSet();
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
                    plugin->broken ? "-" : plugin->versionText().c_str(), std::string(stateName(plugin->state)).c_str(),
                    plugin->reason.empty() ? plugin->manifest.description.c_str() : plugin->reason.c_str());
    }
    return kOk;
}

namespace {

/// What somebody may have meant who gives the id of what a plugin contributes.
std::string hint(const PluginManager& plugins, const std::string& id)
{
    for (const Plugin* plugin : plugins.plugins())
        for (const Contribution& one : plugin->manifest.contributions)
            if (one.id == id) return "'" + id + "' is one of the things that '" + plugin->manifest.id + "' provides";
    return "'jet plugins list' shows all";
}

}  // namespace

int pluginInfo(Session& session, const std::string& id)
{
    session.compareWithSet();
    PluginManager& plugins = session.plugins();
    const Plugin* plugin = plugins.plugin(id);
    if (!plugin) {
        session.error(Error("there is no plugin '" + id + "'; " + hint(plugins, id)));
        return kFailed;
    }
    // Whether it really runs is part of what one wants to know: load it.
    if (plugin->state == PluginState::Resolved) (void)plugins.load(id);
    for (const Error& warning : plugin->manifest.warnings) session.warning(warning.message, warning.where);
    for (const std::string& remark : plugin->remarks) session.warning(plugin->title() + ": " + remark);
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
    const auto printAll = [](const char* word, const std::vector<Dependency>& list) {
        for (const Dependency& one : list) std::printf("  %s %s\n", word, one.text().c_str());
    };
    printAll("requires", plugin->manifest.requires_);
    printAll("optional", plugin->manifest.optional);
    printAll("conflict", plugin->manifest.conflicts);
    for (const Contribution& one : plugin->manifest.contributions) {
        std::printf("  %s '%s': %s", std::string(kindName(one.kind)).c_str(), one.id.c_str(), one.label.c_str());
        for (const std::string& extension : one.extensions) std::printf(" .%s", extension.c_str());
        std::printf(one.shortcut.empty() ? "\n" : " (%s)\n", one.shortcut.c_str());
    }
    return plugin->state == PluginState::Faulted ? kFailed : kOk;
}

namespace {

Json describe(const Provider& provider, ContributionKind kind)
{
    static constexpr const char* availabilities[] = {"usable",   "disabled",      "left out", "faulted",
                                                     "shadowed", "not installed", "unknown"};
    return {{"kind", std::string(kindName(kind))},
            {"availability", availabilities[static_cast<int>(provider.availability)]},
            {"plugin", provider.plugin},
            {"version", provider.version},
            {"text", provider.sentence}};
}

std::string guess(const PluginManager& plugins, const std::string& name)
{
    std::vector<std::string> known;
    for (const Plugin* plugin : plugins.plugins()) known.push_back(plugin->manifest.id);
    for (int k = 0; k < kContributionKinds; ++k)
        for (std::string& id : plugins.knownIds(static_cast<ContributionKind>(k))) known.push_back(std::move(id));
    return didYouMean(name, known);
}

}  // namespace

int explainContribution(Session& session, const std::string& id, const std::filesystem::path& project)
{
    if (!project.empty()) session.useProjectPlugins(project);
    PluginManager& plugins = session.plugins();
    if (!project.empty()) {
        if (auto opened = Project::load(project, session.events(), plugins); !opened) {
            session.error(opened.error());
            return kFailed;
        }
    }
    const std::string name = !id.empty() && id.front() == '.' ? id.substr(1) : id;
    Json answers = Json::array();
    for (int k = 0; k < kContributionKinds; ++k) {
        const auto kind = static_cast<ContributionKind>(k);
        const Provider provider = plugins.whoProvides(kind, name);
        if (provider.availability != Availability::Unknown) answers.push_back(describe(provider, kind));
    }
    if (session.options().json) std::printf("%s\n", dump(answers).c_str());
    if (!answers.empty()) {
        for (const Json& answer : answers)
            if (!session.options().json) std::printf("%s\n", answer["text"].get<std::string>().c_str());
        return kOk;
    }
    if (const Plugin* plugin = plugins.plugin(name)) {
        std::printf("%s is a plugin: %s%s%s\n", plugin->title().c_str(), std::string(stateName(plugin->state)).c_str(),
                    plugin->reason.empty() ? "" : ", ", plugin->reason.c_str());
        return kOk;
    }
    const std::string meant = guess(plugins, name);
    session.error(Error("no installed plugin provides a tool, effect, item type, format, panel or engine called '" +
                        name + "'" + (meant.empty() ? "; 'jet plugins list' shows what is installed" : meant)));
    return kFailed;
}

int enablePlugin(Session& session, const std::string& id, bool enable)
{
    PluginManager& plugins = session.plugins();
    PluginControl control(plugins, session.events());
    const auto dependents = enable ? std::vector<std::string>() : control.dependents(id);
    const auto change = control.setEnabled(id, enable);
    if (!change) {
        session.error(change.error());
        return kFailed;
    }
    for (const std::string& other : dependents)
        session.warning(other + " requires " + id + " and is switched off with it");
    std::printf("%s is switched %s from the next start on\n", id.c_str(), enable ? "on" : "off");
    for (const std::string& other : change->plugins)
        if (enable && other != id) std::printf("%s is usable again with it\n", other.c_str());
    if (const Plugin* plugin = plugins.plugin(id); enable && plugin->state == PluginState::Faulted)
        session.warning(plugin->title() + " cannot be used: " + plugin->reason);
    return kOk;
}

int trustPlugins(Session& session, const std::filesystem::path& project, bool trusted)
{
    const auto found = findProjectPlugins(project);
    if (!found) {
        session.error(Error("there are no plugins beside this project: no folder plugins/ with a plugin.json in a "
                            "folder of it",
                            Location{project.string(), 0, 0}));
        return kFailed;
    }
    if (const auto done = trustProject(*found, trusted); !done) {
        session.error(done.error());
        return kFailed;
    }
    for (const std::string& name : found->names)
        std::printf("%s: %s\n", trusted ? "trusted" : "trusted no longer", (found->folder / name).c_str());
    return kOk;
}

}  // namespace jet::host
