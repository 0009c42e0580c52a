// The reverse index of the PluginManager: which known plugin provides a contribution, why it does not at present, and
// how to get it.
#include "plugin_manager.hpp"
#include "suggest.hpp"

#include <algorithm>

namespace jet::host {

namespace {

bool isFormat(ContributionKind kind)
{
    return kind == ContributionKind::Importer || kind == ContributionKind::Exporter;
}

std::string describe(ContributionKind kind, std::string_view id)
{
    std::string name(kindName(kind));
    if (id.empty()) return name;
    return isFormat(kind) ? name + " for ." + std::string(id) + " files" : name + " '" + std::string(id) + "'";
}

Availability availabilityOf(const Plugin& plugin)
{
    if (plugin.usable()) return Availability::Usable;
    if (plugin.state == PluginState::Faulted) return Availability::Faulted;
    if (plugin.state == PluginState::Shadowed) return Availability::Shadowed;
    return plugin.leftOut ? Availability::LeftOut : Availability::Disabled;
}

std::string withArticle(const std::string& what)
{
    const bool vowel = std::string_view("aeiou").find(what.front()) != std::string_view::npos;
    return (vowel ? "an " : "a ") + what;
}

std::string sentenceFor(const Plugin& plugin, const std::string& what)
{
    if (plugin.usable()) return "The " + what + " comes from " + plugin.title() + ".";
    const std::string state = plugin.leftOut ? "left out" : std::string(stateName(plugin.state));
    return "The " + what + " needs " + plugin.title() + ", which is " + state + ": " + plugin.reason + ".";
}

}  // namespace

std::vector<std::string> PluginManager::knownIds(ContributionKind kind) const
{
    std::vector<std::string> ids;
    if (isFormat(kind)) {
        for (const auto& [key, id] : formats_)
            if (key.first == kind) ids.push_back(key.second);
        return ids;
    }
    for (const auto& [key, plugin] : index_)
        if (key.first == kind) ids.push_back(key.second);
    return ids;
}

Provider PluginManager::whoProvides(ContributionKind kind, std::string_view id) const
{
    std::string name = isFormat(kind) ? findFormat(kind, id) : std::string(id);
    // Any engine would do: tell of one that is there and does not work.
    if (name.empty() && !isFormat(kind))
        for (const auto& [key, plugin] : index_)
            if (key.first == kind && (name.empty() || plugin->usable())) name = key.second;
    const std::string what = describe(kind, id);
    Provider provider;
    if (const Plugin* plugin = name.empty() ? nullptr : providerOf(kind, name)) {
        provider.availability = availabilityOf(*plugin);
        provider.plugin = plugin->manifest.id;
        provider.name = plugin->manifest.name;
        provider.version = plugin->manifest.version.text();
        provider.sentence = sentenceFor(*plugin, what);
        return provider;
    }
    if (const auto recorded = recorded_.find(Key{kind, std::string(id)}); recorded != recorded_.end()) {
        const PluginUse& use = recorded->second;
        // Installed, but not offering it any more: another version than the project was saved with.
        const Plugin* installed = plugin(use.id);
        provider.availability = Availability::NotInstalled;
        provider.plugin = use.id;
        provider.version = use.version;
        provider.sentence = "The " + what + " needs the plugin " + use.id + " " + use.version + ", " +
                            (installed ? "of which version " + installed->manifest.version.text() +
                                             " is installed, which does not provide it"
                                       : "which the project was saved with and which is not installed") +
                            "; get its .jetplugin file and run 'jet plugins install FILE'.";
        return provider;
    }
    const std::string guess = id.empty() ? std::string() : didYouMean(id, knownIds(kind));
    provider.sentence = "No installed plugin provides " + std::string(id.empty() ? withArticle(what) : "the " + what) +
                        (guess.empty() ? "; install one that does, or look at 'jet plugins list'." : guess);
    return provider;
}

std::string PluginManager::explain(ContributionKind kind, std::string_view id) const
{
    return whoProvides(kind, id).sentence;
}

std::string PluginManager::provider(ContributionKind kind, std::string_view id) const
{
    const Plugin* plugin = providerOf(kind, id);
    if (plugin) return plugin->manifest.id + " " + plugin->manifest.version.text();
    const auto recorded = recorded_.find(Key{kind, std::string(id)});
    return recorded == recorded_.end() ? std::string() : recorded->second.id + " " + recorded->second.version;
}

void PluginManager::recall(const PluginUse& use)
{
    for (const auto& [kind, id] : use.provides) recorded_.insert_or_assign(Key{kind, id}, use);
}

}  // namespace jet::host
