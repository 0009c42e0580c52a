#include "plugin_resolver.hpp"

#include "plugin_library.hpp"
#include "suggest.hpp"

#include <algorithm>
#include <vector>

namespace jet::host {

namespace {

class Resolver {
public:
    Resolver(PluginTable& plugins, const PluginChoice& choice) : plugins_(plugins), choice_(choice)
    {
        if (choice.set) selected_ = selectedPlugins(*choice.set, plugins);
    }

    void run()
    {
        for (auto& [id, plugin] : plugins_)
            if (!plugin->broken && (plugin->unmet || plugin->state != PluginState::Faulted)) choose(*plugin);
        for (auto& [id, plugin] : plugins_) {
            std::vector<const Plugin*> chain;
            visit(*plugin, chain);
        }
        for (auto& [id, plugin] : plugins_) findConflict(*plugin);
        while (passOn()) {
        }
        for (auto& [id, plugin] : plugins_)
            if (plugin->state == PluginState::Resolved && plugin->library) plugin->state = PluginState::Loaded;
    }

private:
    /// Why a plugin cannot run.
    struct Verdict {
        PluginState state = PluginState::Faulted;
        std::string reason;
    };

    static void refuse(Plugin& plugin, Verdict verdict)
    {
        plugin.unmet = true;
        plugin.reason = std::move(verdict.reason);
        plugin.state = verdict.state;
    }

    void choose(Plugin& plugin)
    {
        const std::string& id = plugin.manifest.id;
        plugin.reason.clear();
        plugin.remarks.clear();
        plugin.unmet = plugin.leftOut = false;
        plugin.state = PluginState::Valid;
        if (choice_.disabled.contains(id)) {
            plugin.state = PluginState::Disabled;
            plugin.reason = "switched off; 'jet plugins enable " + id + "' switches it on";
        } else if (choice_.set && !selected_.contains(id)) {
            leaveOut(plugin,
                     "not in " + setTitle() + "; add it to the set, or choose another one ('jet plugins sets')");
        } else if (choice_.set && !choice_.set->admits(id, plugin.manifest.version)) {
            leaveOut(plugin, setTitle() + " wants " + id + " " + choice_.set->wantedOf(id) + ", and version " +
                                 plugin.manifest.version.text() +
                                 " is installed; install one that fits, or choose "
                                 "another set");
        } else if (const auto built = checkBuild(plugin.manifest); !built) {
            refuse(plugin, {PluginState::Faulted, built.error().message});
        }
    }

    static void leaveOut(Plugin& plugin, std::string reason)
    {
        plugin.state = PluginState::Disabled;
        plugin.leftOut = true;
        plugin.reason = std::move(reason);
    }

    std::string setTitle() const
    {
        return "the chosen plugin set" + (choice_.set->name.empty() ? std::string() : " '" + choice_.set->name + "'");
    }

    static std::string path(const std::vector<const Plugin*>& chain, const std::string& last)
    {
        std::string text;
        for (const Plugin* link : chain) text += link->manifest.id + " → ";
        return text + last;
    }

    // Depth first: what is required is decided before what requires it.
    void visit(Plugin& plugin, std::vector<const Plugin*>& chain)
    {
        if (plugin.state != PluginState::Valid) return;
        chain.push_back(&plugin);
        for (const Dependency& need : plugin.manifest.requires_) {
            if (auto problem = unmet(need, chain)) {
                refuse(plugin, std::move(*problem));
                break;
            }
        }
        chain.pop_back();
        if (plugin.state == PluginState::Valid) plugin.state = PluginState::Resolved;
        for (const Dependency& wish : plugin.manifest.optional) {
            const auto found = plugins_.find(wish.id);
            if (found != plugins_.end() && !found->second->broken && !wish.admits(found->second->manifest.version))
                plugin.remarks.push_back("it can use " + wish.id + ", but wants " + wish.range.inWords() +
                                         " and finds " + found->second->manifest.version.text());
        }
    }

    std::optional<Verdict> unmet(const Dependency& need, std::vector<const Plugin*>& chain)
    {
        const auto inChain =
            std::find_if(chain.begin(), chain.end(), [&](const Plugin* p) { return p->manifest.id == need.id; });
        if (inChain != chain.end())
            return Verdict{
                PluginState::Faulted,
                "it depends on itself: " + path({inChain, chain.end()}, need.id) +
                    (inChain == chain.begin() ? "" : " (reached by " + path({chain.begin(), inChain}, need.id) + ")") +
                    "; remove one of these requirements"};
        const auto found = plugins_.find(need.id);
        if (found == plugins_.end()) return Verdict{PluginState::Faulted, missing(need, chain)};
        Plugin& other = *found->second;
        if (!other.broken && !need.admits(other.manifest.version))
            return Verdict{PluginState::Faulted, "it requires " + need.text() + " (" + path(chain, need.id) +
                                                     "), but version " + other.manifest.version.text() +
                                                     " is installed in " + other.folder.string() + "; install " +
                                                     need.range.inWords()};
        visit(other, chain);
        if (other.usable()) return std::nullopt;
        return unusable(need, other);
    }

    std::string missing(const Dependency& need, const std::vector<const Plugin*>& chain) const
    {
        std::vector<std::string> known;
        for (const auto& [id, plugin] : plugins_) known.push_back(id);
        return "it requires " + need.text() + " (" + path(chain, need.id) + "), which is not installed; install it" +
               didYouMean(need.id, known);
    }

    // What needs a plugin that is switched off is not at fault: it comes back with it.
    static Verdict unusable(const Dependency& need, const Plugin& other)
    {
        const bool off = other.state == PluginState::Disabled;
        return {off ? PluginState::Disabled : PluginState::Faulted, "it requires " + need.id + ", which is " +
                                                                        std::string(stateName(other.state)) + " (" +
                                                                        other.reason + ")"};
    }

    // After all requirements: a plugin that cannot run conflicts with nobody. The one that declares the conflict gives
    // way, in the order of ids, so that the outcome does not depend on folders.
    void findConflict(Plugin& plugin)
    {
        if (plugin.state != PluginState::Resolved) return;
        for (const Dependency& enemy : plugin.manifest.conflicts) {
            const auto found = plugins_.find(enemy.id);
            if (found == plugins_.end() || found->second->state != PluginState::Resolved ||
                !enemy.admits(found->second->manifest.version))
                continue;
            const std::string wantedBy = requiredBy(enemy.id);
            return refuse(plugin, {PluginState::Faulted, "it conflicts with " + found->second->title() +
                                                             (wantedBy.empty() ? "" : ", which " + wantedBy) +
                                                             "; keep one of them: 'jet plugins disable " + enemy.id +
                                                             "' or 'jet plugins disable " + plugin.manifest.id + "'"});
        }
    }

    // "org.acme.net → org.acme.mesh requires": who else suffers when the other one is switched off.
    std::string requiredBy(const std::string& id) const
    {
        std::string chain;
        std::string wanted = id;
        std::set<std::string> seen{id};
        for (bool grown = true; grown;) {
            grown = false;
            for (const auto& [other, plugin] : plugins_) {
                const auto& needs = plugin->manifest.requires_;
                const bool requires_ =
                    std::any_of(needs.begin(), needs.end(), [&](const Dependency& need) { return need.id == wanted; });
                if (!plugin->usable() || !requires_ || !seen.insert(other).second) continue;
                chain = other + (chain.empty() ? "" : " → " + chain);
                wanted = other;
                grown = true;
                break;
            }
        }
        return chain.empty() ? chain : chain + " requires";
    }

    // What a conflict or a failure took away is missing to others.
    bool passOn()
    {
        bool changed = false;
        for (auto& [id, plugin] : plugins_) {
            if (plugin->state != PluginState::Resolved) continue;
            for (const Dependency& need : plugin->manifest.requires_) {
                const Plugin& other = *plugins_.find(need.id)->second;
                if (other.usable()) continue;
                refuse(*plugin, unusable(need, other));
                changed = true;
                break;
            }
        }
        return changed;
    }

    PluginTable& plugins_;
    const PluginChoice& choice_;
    std::set<std::string> selected_;  // of the set, if there is one
};

}  // namespace

std::set<std::string> selectedPlugins(const PluginSet& set, const PluginTable& plugins)
{
    std::set<std::string> all;
    for (const auto& [id, plugin] : plugins) all.insert(id);
    return set.select(all, [&](const std::string& id) {
        std::vector<std::string> needs;
        for (const Dependency& need : plugins.find(id)->second->manifest.requires_) needs.push_back(need.id);
        return needs;
    });
}

void resolvePlugins(PluginTable& plugins, const PluginChoice& choice) { Resolver(plugins, choice).run(); }

}  // namespace jet::host
