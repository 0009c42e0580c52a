#include "set_commands.hpp"

#include "project_access.hpp"

#include "host/plugins/plugin_control.hpp"
#include "host/plugins/plugin_differences.hpp"
#include "host/plugins/plugin_set_files.hpp"

#include <jet/format.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace jet::host {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

struct SetOptions {
    fs::path project, output;
    std::string name;
};

void print(const Json& json) { std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str()); }

int fail(Session& session, const Error& error)
{
    session.error(error);
    return kFailed;
}

/// The sets of this run; brings in the project's, if one is named.
PluginControl& controlOf(Session& session, const SetOptions& o, std::unique_ptr<PluginControl>& control)
{
    if (!o.project.empty()) session.useProjectPlugins(o.project);
    control = std::make_unique<PluginControl>(session.plugins(), session.events());
    if (!o.project.empty()) control->setProject(o.project);
    return *control;
}

Json jsonOf(const PluginSetInfo& set)
{
    return {{"name", set.name},       {"title", set.title},        {"description", set.description},
            {"source", set.source},   {"file", set.file.string()}, {"plugins", set.plugins},
            {"missing", set.missing}, {"problem", set.problem},    {"inUse", set.inUse}};
}

int list(Session& session, const SetOptions& o)
{
    std::unique_ptr<PluginControl> control;
    auto sets = controlOf(session, o, control).sets();
    const bool broken = std::any_of(sets.begin(), sets.end(), [](const auto& set) { return !set.problem.empty(); });
    if (session.options().json) {
        Json json = Json::array();
        for (const PluginSetInfo& set : sets) json.push_back(jsonOf(set));
        print(json);
        return broken ? kFailed : kOk;
    }
    std::size_t width = 5;
    for (const PluginSetInfo& set : sets) width = std::max(width, set.name.size());
    for (const PluginSetInfo& set : sets) {
        const std::string text = set.description.empty() ? set.title : set.description;
        std::printf("%c %-*s  %-12s %4zu plugin%s  %s\n", set.inUse ? '*' : ' ', static_cast<int>(width),
                    set.name.empty() ? "(all)" : set.name.c_str(), set.source.c_str(), set.plugins,
                    set.plugins == 1 ? " " : "s", set.problem.empty() ? text.c_str() : "cannot be read");
        for (const std::string& missing : set.missing) std::printf("    missing  %s\n", missing.c_str());
    }
    for (const PluginSetInfo& set : sets)
        if (!set.problem.empty()) session.error(Error(set.problem));
    return broken ? kFailed : kOk;
}

/// One plugin of a set: what the set says, and what is here.
Json entryJson(const PluginManager& plugins, const PluginSet& set, const std::string& id)
{
    const Plugin* plugin = plugins.plugin(id);
    Json json{{"id", id}, {"wanted", set.wantedOf(id)}};
    json["version"] = plugin && !plugin->broken ? plugin->manifest.version.text() : "";
    json["state"] = plugin ? std::string(stateName(plugin->state)) : "not installed";
    json["fits"] = plugin && !plugin->broken && set.admits(id, plugin->manifest.version);
    return json;
}

int show(Session& session, const SetOptions& o)
{
    std::unique_ptr<PluginControl> control;
    controlOf(session, o, control);
    const PluginManager& plugins = session.plugins();
    const auto set = PluginSetFiles(o.project).choose(o.name);
    if (!set) return fail(session, set.error());
    for (const Error& remark : set->warnings) session.warning(remark.message, remark.where);
    std::set<std::string> ids = plugins.selectedBy(*set);
    for (const PluginSet::Entry* entry : set->entries())
        if (!entry->isPattern()) ids.insert(entry->plugin.id);
    Json json{{"name", set->name},
              {"title", set->title},
              {"description", set->description},
              {"source", std::string(sourceName(set->source))},
              {"file", set->file.string()},
              {"includes", Json::array()},
              {"excludes", Json::array()},
              {"plugins", Json::array()}};
    for (const PluginSet& other : set->includes) json["includes"].push_back(other.name);
    for (const PluginSet::Entry& entry : set->excluded) json["excludes"].push_back(entry.plugin.id);
    for (const std::string& id : ids) json["plugins"].push_back(entryJson(plugins, *set, id));
    if (session.options().json) {
        print(json);
        return kOk;
    }
    std::printf("%s (%s)\n", set->title.c_str(), set->name.c_str());
    if (!set->description.empty()) std::printf("  %s\n", set->description.c_str());
    if (!set->file.empty()) std::printf("  file     %s\n", set->file.c_str());
    for (const Json& other : json["includes"]) std::printf("  includes %s\n", other.get<std::string>().c_str());
    for (const Json& id : json["excludes"]) std::printf("  without  %s\n", id.get<std::string>().c_str());
    std::size_t width = 0;
    for (const std::string& id : ids) width = std::max(width, id.size());
    for (const Json& one : json["plugins"]) {
        const std::string wanted = one["wanted"], version = one["version"];
        std::printf("  %-*s  %-8s %-13s%s\n", static_cast<int>(width), one["id"].get<std::string>().c_str(),
                    version.c_str(), one["state"].get<std::string>().c_str(),
                    wanted.empty() ? "" : (" wants " + wanted).c_str());
    }
    return kOk;
}

int use(Session& session, const SetOptions& o)
{
    std::unique_ptr<PluginControl> control;
    const std::string name = o.name == "all" ? std::string() : o.name;
    const auto change = controlOf(session, o, control).useSet(name);
    if (!change) return fail(session, change.error());
    if (session.options().json)
        print({{"ok", true}, {"set", name}, {"changed", change->plugins}, {"text", change->message}});
    else
        std::printf("%s\n", change->message.c_str());
    return kOk;
}

int freeze(Session& session, const SetOptions& o)
{
    std::unique_ptr<Project> project;
    std::string title = "Plugins in use", description = "All plugins of this installation that can be used.";
    if (!o.project.empty()) {
        project = openProject(session, o.project);
        if (!project) return kFailed;
        title = project->name();
        description = "What the project uses, in the versions it was last seen to work with.";
        for (const PluginDifference& difference : projectDifferences(session.plugins(), *project))
            if (difference.kind != PluginDifference::Kind::OtherVersion)
                return fail(session, Error("the plugins of this project cannot be frozen while one of them cannot be "
                                           "used: " +
                                               sentenceOf(difference),
                                           Location{project->file().string(), 0, 0}));
    } else if (const auto& set = session.plugins().options().set) {
        title = set->title;
        description = set->description;
    }
    const auto plugins = pluginsInUse(session.plugins(), project.get());
    std::vector<std::string> entries;
    entries.reserve(plugins.size());
    for (const FrozenPlugin& plugin : plugins) entries.push_back(plugin.text());
    const std::string text = setText(title, description, entries);
    if (o.output.empty()) {
        std::printf("%s", text.c_str());
        return kOk;
    }
    if (const auto written = writeFileAtomically(o.output, text); !written) return fail(session, written.error());
    if (session.options().json)
        print({{"ok", true}, {"file", o.output.string()}, {"plugins", entries}});
    else
        std::printf("wrote %s: %zu plugins\n", o.output.c_str(), entries.size());
    return kOk;
}

}  // namespace

void addSetCommands(CLI::App& plugins, std::function<int(Session&)>& run)
{
    const auto options = std::make_shared<SetOptions>();
    const auto calls = [&run, options](int (*action)(Session&, const SetOptions&)) {
        return [&run, options, action] { run = [options, action](Session& s) { return action(s, *options); }; };
    };
    const auto addProject = [&](CLI::App* to) {
        to->add_option("--project", options->project, "Also the set of this project")->type_name("PROJECT");
    };
    auto* sets = plugins.add_subcommand("sets", "The plugin sets there are: source, plugins, what is missing");
    sets->require_subcommand(0, 1);
    addProject(sets);
    const auto listSets = calls(list);
    sets->callback([sets, listSets] {
        if (sets->get_subcommands().empty()) listSets();
    });
    const auto one = [&](const char* name, const char* help, int (*action)(Session&, const SetOptions&)) {
        auto* added = sets->add_subcommand(name, help);
        added->add_option("name", options->name, "Name or file of a set")->required()->type_name("NAME");
        added->callback(calls(action));
    };
    one("show", "The plugins of a set, and what is here", show);
    one("use", "Use this set in all later runs; 'all' for no set", use);

    auto* freezing = plugins.add_subcommand("freeze", "Write a set of the plugins in use, in exactly their versions");
    freezing->add_option("project", options->project, "What this project uses; all plugins if not given")
        ->type_name("PROJECT");
    freezing->add_option("-o,--output", options->output, "File to write; to stdout if not given")->type_name("FILE");
    freezing->callback(calls(freeze));
}

}  // namespace jet::host
