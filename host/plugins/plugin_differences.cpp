#include "plugin_differences.hpp"

#include "plugin_set_files.hpp"
#include "suggest.hpp"

#include <algorithm>
#include <map>

namespace jet::host {

namespace {

constexpr const char* kFreeze = "'jet plugins freeze' writes exact versions";

/// What is said of one plugin.
struct Wish {
    std::string id;
    std::string wanted;  // a range or a version, for people
    std::vector<VersionRange> ranges;
    int uses = 0;
    std::vector<std::pair<ContributionKind, std::string>> provides = {};

    bool admits(const Version& version) const
    {
        return std::all_of(ranges.begin(), ranges.end(),
                           [&](const VersionRange& range) { return range.admits(version); });
    }
};

std::string missingRemedy(const PluginManager& plugins, const Wish& wish)
{
    // The reverse index may know another plugin that does the same.
    std::string others;
    for (const auto& [kind, id] : wish.provides) {
        const Provider provider = plugins.whoProvides(kind, id);
        if (provider.availability != Availability::Usable || provider.plugin == wish.id) continue;
        others += (others.empty() ? "" : ", ") + std::string(kindName(kind)) + " '" + id + "' comes from " +
                  provider.plugin + " instead";
    }
    if (!others.empty()) return others;
    std::vector<std::string> known;
    for (const Plugin* plugin : plugins.plugins()) known.push_back(plugin->manifest.id);
    const std::string guess = wish.uses > 0 ? std::string() : didYouMean(wish.id, known);
    return "get its .jetplugin file and run 'jet plugins install FILE'" + guess;
}

std::string versionRemedy(const Wish& wish, const Version& here)
{
    const auto recorded = Version::parse(wish.wanted);
    if (recorded && here > *recorded) return "go on with the newer one, which the project records when it is saved";
    if (recorded) return "install " + wish.wanted + " or later: the older one may not understand all of the project";
    return "install a version in that range";
}

/// None: all is as it was said.
std::optional<PluginDifference> compare(const PluginManager& plugins, const Wish& wish)
{
    using Kind = PluginDifference::Kind;
    PluginDifference difference;
    difference.id = difference.name = wish.id;
    difference.wanted = wish.wanted;
    difference.uses = wish.uses;
    const Plugin* plugin = plugins.plugin(wish.id);
    if (!plugin) {
        difference.reason = "it is not installed";
        difference.remedy = missingRemedy(plugins, wish);
        return difference;
    }
    difference.name = plugin->manifest.name;
    difference.here = plugin->broken ? std::string() : plugin->manifest.version.text();
    if (plugin->state == PluginState::Faulted) {
        difference.kind = Kind::Faulted;
        difference.reason = "it is faulted: " + plugin->reason;
        difference.remedy = "mend or install it again";
    } else if (plugin->state == PluginState::Disabled) {
        difference.kind = plugin->leftOut ? Kind::LeftOut : Kind::Disabled;
        difference.reason = std::string("it is ") + (plugin->leftOut ? "left out" : "disabled") + ": " + plugin->reason;
        difference.remedy = "enable it";
    } else if (!wish.admits(plugin->manifest.version)) {
        difference.kind = Kind::OtherVersion;
        difference.reason = "version " + difference.here + " is here";
        difference.remedy = versionRemedy(wish, plugin->manifest.version);
    } else {
        return std::nullopt;
    }
    return difference;
}

void add(std::map<std::string, Wish>& wishes, const PluginSet& set)
{
    for (const PluginSet::Entry* entry : set.entries()) {
        if (entry->isPattern()) continue;
        Wish& wish = wishes[entry->plugin.id];
        wish.id = entry->plugin.id;
        wish.ranges.push_back(entry->plugin.range);
        if (!entry->plugin.range.isAny() && wish.wanted.empty()) wish.wanted = entry->plugin.range.text();
    }
}

bool mayBeAbsent(const PluginSet& set, const std::string& id)
{
    const auto named = set.entries();
    return std::all_of(named.begin(), named.end(),
                       [&](const auto* entry) { return entry->plugin.id != id || entry->optional; });
}

/// With what its scenes use now: a plugin that a hand-written project does not name is known by the reverse index.
std::map<std::string, Wish> recordOf(const Project& project)
{
    std::map<std::string, Wish> wishes;
    for (const PluginUse& use : project.pluginsUsed()) wishes[use.id] = {use.id, {}, {}, use.count, use.provides};
    for (const PluginUse& use : project.recordedPlugins()) {
        const auto found = wishes.find(use.id);
        if (found == wishes.end()) continue;  // its scenes use it no more
        found->second.wanted = use.version;
        if (const auto version = Version::parse(use.version))
            found->second.ranges.push_back(VersionRange::exactly(*version));
    }
    return wishes;
}

std::vector<PluginDifference> compareAll(const PluginManager& plugins, const std::map<std::string, Wish>& wishes,
                                         const PluginSet* set)
{
    std::vector<PluginDifference> list;
    for (const auto& [id, wish] : wishes) {
        auto difference = compare(plugins, wish);
        if (!difference) continue;
        const bool absent = difference->kind == PluginDifference::Kind::Missing;
        if (!absent || wish.uses > 0 || !set || !mayBeAbsent(*set, id)) list.push_back(std::move(*difference));
    }
    return list;
}

/// A set that cannot be read says nothing here: who opens the project is told of it elsewhere.
std::optional<PluginSet> projectSet(const Project& project)
{
    auto set = project.file().empty() ? std::nullopt : PluginSetFiles(project.file()).ofProject();
    return set && *set ? std::optional(std::move(**set)) : std::nullopt;
}

// --- frozen

class FrozenCheck {
public:
    explicit FrozenCheck(const PluginManager& plugins) : plugins_(plugins) {}

    void set(const PluginSet& set)
    {
        for (const PluginDifference& difference : setDifferences(plugins_, set)) note(sentenceOf(difference));
        const auto recorded = exactOnes(set);
        if (!recorded) return;
        for (const Plugin* plugin : plugins_.plugins())
            if (plugin->usable() && !recorded->contains(plugin->manifest.id))
                note(plugin->manifest.id + ": a plugin of the set '" + set.name +
                     "' requires it, and the set gives no version of it; " + kFreeze);
    }

    void project(const Project& project)
    {
        for (const PluginDifference& difference : projectDifferences(plugins_, project)) note(sentenceOf(difference));
        if (const auto set = projectSet(project)) (void)exactOnes(*set);
        std::set<std::string> recorded;
        for (const PluginUse& use : project.recordedPlugins()) recorded.insert(use.id);
        for (const PluginUse& use : project.pluginsUsed())
            if (!recorded.contains(use.id))
                note(use.id + ": the project uses it and does not record its version; save the project once");
    }

    void note(const std::string& text)
    {
        if (std::find(lines_.begin(), lines_.end(), text) == lines_.end()) lines_.push_back(text);
    }

    Result<void> result(const Location& where) const
    {
        if (lines_.empty()) return {};
        std::string text = "the plugins are not those that are recorded (--frozen):";
        for (const std::string& line : lines_) text += "\n  " + line;
        return Error(text, where);
    }

private:
    /// The plugins of which the set names the version; notes that there are others.
    std::optional<std::set<std::string>> exactOnes(const PluginSet& set)
    {
        std::set<std::string> exact;
        std::string vague;
        for (const PluginSet::Entry* entry : set.entries()) {
            if (entry->plugin.range.isExact())
                exact.insert(entry->plugin.id);
            else if (!entry->optional || entry->isPattern() || plugins_.plugin(entry->plugin.id))
                vague += (vague.empty() ? "" : ", ") + entry->text();
        }
        if (vague.empty()) return exact;
        note("the plugin set '" + set.name + "' gives no exact version of " + vague + "; " + kFreeze);
        return std::nullopt;
    }

    const PluginManager& plugins_;
    std::vector<std::string> lines_;
};

}  // namespace

std::vector<PluginDifference> projectDifferences(const PluginManager& plugins, const Project& project)
{
    auto wishes = recordOf(project);
    const auto set = projectSet(project);
    if (set) add(wishes, *set);
    return compareAll(plugins, wishes, set ? &*set : nullptr);
}

std::vector<PluginDifference> setDifferences(const PluginManager& plugins, const PluginSet& set)
{
    std::map<std::string, Wish> wishes;
    add(wishes, set);
    auto list = compareAll(plugins, wishes, &set);
    for (const PluginSet::Entry* entry : set.entries()) {
        const auto all = plugins.plugins();
        const auto fits = [&](const Plugin* plugin) { return entry->matches(plugin->manifest.id); };
        if (!entry->isPattern() || entry->optional || std::any_of(all.begin(), all.end(), fits)) continue;
        PluginDifference difference;
        difference.id = difference.name = entry->plugin.id;
        difference.reason = "no installed plugin is meant by it";
        difference.remedy = "mend the set, or install such plugins";
        list.push_back(std::move(difference));
    }
    return list;
}

std::string sentenceOf(const PluginDifference& difference)
{
    std::string text = difference.id + ": ";
    if (difference.uses > 0) {
        text += "the project wants " + (difference.wanted.empty() ? std::string("it") : difference.wanted) + " (" +
                std::to_string(difference.uses) + (difference.uses == 1 ? " use), " : " uses), ");
    } else if (!difference.wanted.empty()) {
        text += "the plugin set wants " + difference.wanted + ", ";
    }
    // How to switch a plugin on is in the reason already.
    return text + difference.reason + (difference.canEnable() ? "" : "; " + difference.remedy);
}

Result<void> checkFrozen(const PluginManager& plugins, const Project* project)
{
    const auto& chosen = plugins.options().set;
    Location where;
    FrozenCheck check(plugins);
    if (chosen) {
        check.set(*chosen);
        where.file = chosen->file.string();
    }
    if (project) {
        check.project(*project);
        where.file = project->file().string();
    }
    if (!chosen && !project)
        return Error("--frozen compares with exact versions: name a set that has them (--plugins SET), or a project");
    return check.result(where);
}

std::vector<FrozenPlugin> pluginsInUse(PluginManager& plugins, const Project* project)
{
    std::set<std::string> ids;
    if (project) {
        for (const PluginUse& use : project->pluginsUsed()) ids.insert(use.id);
        bool scripts = false;
        for (const Scene* scene : project->scenes())
            scene->root().walk([&](const Item& item) { scripts = scripts || item.is<ScriptItem>(); });
        const auto firstOf = [&](ContributionKind kind) {
            for (const Contribution& one : plugins.contributions(kind)) {
                const std::string provider = plugins.provider(kind, one.id);
                ids.insert(provider.substr(0, provider.find(' ')));
                return;
            }
        };
        firstOf(ContributionKind::PhysicsEngine);
        if (scripts) firstOf(ContributionKind::ScriptEngine);
    }
    std::vector<std::string> waiting(ids.begin(), ids.end());
    while (!waiting.empty()) {
        const Plugin* plugin = plugins.plugin(waiting.back());
        waiting.pop_back();
        if (!plugin) continue;
        for (const Dependency& need : plugin->manifest.requires_)
            if (ids.insert(need.id).second) waiting.push_back(need.id);
    }
    std::map<std::string, Version> found;
    for (const Plugin* plugin : plugins.plugins())
        if (plugin->usable() && (!project || ids.contains(plugin->manifest.id)))
            found.emplace(plugin->manifest.id, plugin->manifest.version);
    std::vector<FrozenPlugin> list;
    list.reserve(found.size());
    for (const auto& [id, version] : found) list.push_back({id, version});
    return list;
}

}  // namespace jet::host
