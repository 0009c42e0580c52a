#include "plugin_set.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace jet::host {

std::string_view sourceName(SetSource source)
{
    static constexpr std::string_view names[] = {"command line", "project", "user", "shipped"};
    return names[static_cast<int>(source)];
}

bool PluginSet::Entry::matches(std::string_view id) const
{
    if (!isPattern()) return id == plugin.id;
    return id.starts_with(std::string_view(plugin.id).substr(0, plugin.id.size() - 1));
}

PluginSet PluginSet::of(const std::vector<std::string>& ids, std::string name)
{
    PluginSet set;
    set.title = name;
    set.name = std::move(name);
    for (const std::string& id : ids) set.plugins.push_back({{id, {}}, false, {}});
    return set;
}

namespace {

bool anyMatches(const std::vector<PluginSet::Entry>& entries, std::string_view id)
{
    return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) { return entry.matches(id); });
}

}  // namespace

bool PluginSet::holds(std::string_view id) const
{
    if (letIn_.contains(id)) return true;
    if (anyMatches(excluded, id)) return false;
    return anyMatches(plugins, id) ||
           std::any_of(includes.begin(), includes.end(), [&](const PluginSet& other) { return other.holds(id); });
}

bool PluginSet::excludes(std::string_view id) const
{
    if (letIn_.contains(id)) return false;
    if (anyMatches(excluded, id)) return true;
    return !holds(id) &&
           std::any_of(includes.begin(), includes.end(), [&](const PluginSet& other) { return other.excludes(id); });
}

bool PluginSet::admits(std::string_view id, const Version& version) const
{
    if (letIn_.contains(id)) return true;
    const auto named = entries();
    return std::all_of(named.begin(), named.end(), [&](const Entry* entry) {
        return entry->isPattern() || entry->plugin.id != id || entry->plugin.admits(version);
    });
}

std::string PluginSet::wantedOf(std::string_view id) const
{
    std::string wanted;
    for (const Entry* entry : entries()) {
        if (entry->isPattern() || entry->plugin.id != id || entry->plugin.range.isAny()) continue;
        wanted += (wanted.empty() ? "" : " ") + entry->plugin.range.text();
    }
    return wanted;
}

std::vector<const PluginSet::Entry*> PluginSet::entries() const
{
    std::vector<const Entry*> list;
    for (const PluginSet& other : includes)
        for (const Entry* entry : other.entries()) list.push_back(entry);
    for (const Entry& entry : plugins) list.push_back(&entry);
    std::erase_if(list, [this](const Entry* entry) { return anyMatches(excluded, entry->plugin.id); });
    return list;
}

void PluginSet::letIn(const std::string& id) { letIn_.insert(id); }

std::set<std::string>
PluginSet::select(const std::set<std::string>& all,
                  const std::function<std::vector<std::string>(const std::string&)>& requirementsOf) const
{
    std::set<std::string> chosen;
    std::vector<std::string> waiting;
    for (const std::string& id : all)
        if (holds(id)) waiting.push_back(id);
    while (!waiting.empty()) {
        const std::string id = std::move(waiting.back());
        waiting.pop_back();
        if (excludes(id) || !all.contains(id) || !chosen.insert(id).second) continue;
        for (std::string& need : requirementsOf(id)) waiting.push_back(std::move(need));
    }
    return chosen;
}

std::string setText(const std::string& title, const std::string& description, const std::vector<std::string>& plugins)
{
    nlohmann::ordered_json json{{"name", title}};
    if (!description.empty()) json["description"] = description;
    json["plugins"] = plugins;
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace jet::host
