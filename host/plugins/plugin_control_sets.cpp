// The part of the PluginsCenter that is about sets, and about what a project says of its plugins.
#include "plugin_control.hpp"
#include "plugin_differences.hpp"
#include "plugin_set_files.hpp"

#include <jet/format.hpp>

#include <algorithm>

namespace jet::host {

namespace {

/// What the set names and does not get: "org.acme.rope >=2: version 1.0.0 is here".
std::vector<std::string> missingOf(const PluginManager& plugins, const PluginSet& set)
{
    std::vector<std::string> missing;
    for (const PluginDifference& difference : setDifferences(plugins, set)) {
        const Plugin* plugin = plugins.plugin(difference.id);
        if (plugin && (plugin->broken || set.admits(difference.id, plugin->manifest.version))) continue;
        const std::string wanted = difference.wanted.empty() ? std::string() : " " + difference.wanted;
        missing.push_back(difference.id + wanted + ": " +
                          (plugin ? "version " + plugin->manifest.version.text() + " is here" : difference.reason));
    }
    return missing;
}

bool isSetName(std::string_view name)
{
    return !name.empty() && name != "project" && name.front() != '.' &&
           name.find_first_of("/\\,.\n\t") == std::string_view::npos;
}

std::string joined(const std::vector<std::string>& texts)
{
    std::string all;
    for (const std::string& text : texts) all += (all.empty() ? "" : "; ") + text;
    return all;
}

}  // namespace

PluginSetInfo PluginControl::infoOf(const Result<PluginSet>& set, const std::string& name) const
{
    PluginSetInfo info;
    info.name = info.title = name;
    if (!set) {
        info.problem = set.error().text();
        return info;
    }
    info.title = set->title;
    info.description = set->description;
    info.source = sourceName(set->source);
    info.file = set->file;
    info.plugins = manager_.selectedBy(*set).size();
    info.missing = missingOf(manager_, *set);
    const auto& used = manager_.options().set;
    info.inUse = used && used->name == set->name && used->file == set->file;
    return info;
}

std::vector<PluginSetInfo> PluginControl::sets() const
{
    PluginSetInfo all;
    all.title = "All plugins";
    all.description = "No set: everything that is installed and not switched off.";
    all.inUse = !manager_.options().set;
    const auto installed = manager_.plugins();
    all.plugins = static_cast<std::size_t>(std::count_if(installed.begin(), installed.end(), [](const Plugin* plugin) {
        return plugin->state != PluginState::Shadowed;
    }));
    std::vector<PluginSetInfo> list{std::move(all)};
    if (startSet_) list.push_back(infoOf(*startSet_, startSet_->name));
    const PluginSetFiles files(project_);
    for (const PluginSetFiles::Listed& one : files.list()) {
        list.push_back(infoOf(files.read(one.name), one.name));
        list.back().source = sourceName(one.source);
        list.back().file = one.file;
    }
    return list;
}

Result<PluginChange> PluginControl::useSet(std::string_view name)
{
    std::optional<PluginSet> set;
    if (startSet_ && name == startSet_->name) {
        set = startSet_;
    } else if (!name.empty()) {
        auto found = PluginSetFiles(project_).read(std::string(name));
        if (!found) return found.error();
        set = std::move(*found);
    }
    // A project's set, and one of the command line, mean nothing to a later run.
    const bool lasts = !set || set->source == SetSource::User || set->source == SetSource::Shipped;
    if (lasts)
        if (const auto written = writeChosenSet(std::string(name)); !written) return written.error();
    PluginChange change;
    change.message = set ? "The plugin set '" + set->title + "' is used" : std::string("All plugins are used");
    change.message += lasts ? "." : ", until JET ends.";
    std::vector<std::string> missing;
    if (set) missing = missingOf(manager_, *set);
    const std::optional<PluginSet> wanted = set;
    change.plugins = manager_.useSet(std::move(set));
    if (!missing.empty()) change.message += " It misses " + joined(missing) + ".";
    std::string later;
    for (const Plugin* plugin : manager_.plugins()) {
        const bool meant = !wanted || wanted->holds(plugin->manifest.id);
        const bool failed = plugin->state == PluginState::Faulted && !plugin->unmet && !plugin->broken;
        if (meant && failed) later += (later.empty() ? "" : ", ") + plugin->manifest.name;
    }
    if (!later.empty()) {
        change.afterRestart = true;
        change.message += " What failed in this run is used again after a restart: " + later + ".";
    }
    tell(change.plugins);
    return change;
}

Result<PluginSetInfo> PluginControl::saveSet(std::string_view name)
{
    const std::string title(name);
    if (!isSetName(name))
        return Error("'" + title + "' cannot be the name of a plugin set; use letters, digits, '-', '_' and spaces");
    std::vector<std::string> ids;
    for (const FrozenPlugin& plugin : pluginsInUse(manager_, nullptr)) ids.push_back(plugin.id);
    const std::filesystem::path file = PluginSetFiles::userFolder() / (title + ".jetset");
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    if (const auto written = writeFileAtomically(file, setText(title, {}, ids)); !written) return written.error();
    return infoOf(PluginSetFiles(project_).read(title), title);
}

std::vector<PluginDifference> PluginControl::differences(const Project& project) const
{
    return projectDifferences(manager_, project);
}

Result<PluginChange> PluginControl::reload(std::string_view id)
{
    if (!reload_) return PluginsCenter::reload(id);
    return reload_(std::string(id));
}

std::string PluginControl::setProject(const std::filesystem::path& project)
{
    project_ = project;
    auto set = PluginSetFiles(project).ofProject();
    const std::string problem = set && !*set ? set->error().text() : std::string();
    manager_.setProjectSet(set && *set ? std::optional(std::move(**set)) : std::nullopt);
    return problem;
}

}  // namespace jet::host
