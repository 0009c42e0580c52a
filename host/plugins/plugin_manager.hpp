// PluginManager: finds plugins, decides which can run, loads them on first use. It is the Catalog the whole program
// uses.
#pragma once

#include "guarded.hpp"
#include "plugin.hpp"
#include "plugin_resolver.hpp"
#include "plugin_set.hpp"
#include "settings_store.hpp"

#include <jet/plugins.hpp>
#include <jet/project.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace jet::host {

struct PluginOptions {
    std::vector<std::filesystem::path> searchPath;  ///< earlier folders win where versions are equal
    std::set<std::string> without;                  ///< as if these were not installed
    std::set<std::string> disabled;                 ///< installed, switched off by the user
    std::optional<PluginSet> set;                   ///< use its plugins only; none: all
    std::optional<PluginSet> projectSet;            ///< of several copies, one that fits it is used
    bool copyLibraries = false;                     ///< load from fresh paths, for rebuilding while it runs
    bool strictUnload = false;                      ///< unload() really unloads: for tests
    bool safeMode = false;                          ///< only what ships with the program
    std::filesystem::path builtIn;                  ///< the folder of what ships
    std::filesystem::path settings;                 ///< the folder of plugins' settings; empty: kept in memory
};

/// The folder of the plugins that ship with this program: beside libjet-sdk.so, jet/plugins.
std::filesystem::path builtInPluginFolder();
/// $XDG_DATA_HOME/jet/plugins.
std::filesystem::path userPluginFolder();

class PluginManager final : public Catalog {
public:
    explicit PluginManager(PluginOptions options);
    ~PluginManager() override;

    /// Reads all manifests and resolves dependencies. Loads nothing. Never fails: what is wrong is in the plugins'
    /// reasons.
    void scan();

    /// Adds the plugins of a folder to those that are there, e.g. a project's; answers their ids.
    std::vector<std::string> addFolder(const std::filesystem::path& folder, PluginOrigin origin);
    /// Forgets the plugin of that folder; another copy of it takes its place. Answers as setEnabled() does.
    std::vector<std::string> removeFolder(const std::filesystem::path& folder);
    /// Switches plugins and, when on, lets them into the plugin set; takes effect at once. Answers the ids of all
    /// plugins that became usable or unusable by it. Storing the choice is the caller's business.
    std::vector<std::string> setEnabled(const std::set<std::string>& ids, bool enabled);
    /// Uses the plugins of this set only, or all; takes effect at once. Answers as setEnabled() does.
    std::vector<std::string> useSet(std::optional<PluginSet> set);
    /// The ids of the installed plugins that the set holds, with what they require.
    std::set<std::string> selectedBy(const PluginSet& set) const { return selectedPlugins(set, plugins_); }
    /// What the open project asks of versions: of several copies of a plugin that is not loaded, one that fits is used.
    std::vector<std::string> setProjectSet(std::optional<PluginSet> set);
    const PluginOptions& options() const { return options_; }

    /// By id; shadowed copies follow.
    std::vector<const Plugin*> plugins() const;
    const Plugin* plugin(std::string_view id) const;
    /// Loads the plugin and what it requires, in order. The error says what failed and what to do.
    Result<void> load(std::string_view id);
    /// Sentences about plugins that are faulted, for the user to see.
    std::vector<std::string> problems() const;
    /// Told of each failure inside a plugin. [thread of the failing call]
    void setProblemHandler(std::function<void(const PluginProblem&)> handler) { guard_.onProblem = std::move(handler); }

    /// The values of a settings page; loads its plugin. Null when there is none.
    std::shared_ptr<Settings> settings(std::string_view page);
    SettingsStore& settingsStore() { return settingsStore_; }
    /// Told of each call into a plugin that does not return for long, while it goes on. [a thread of its own]
    void setHangHandler(std::function<void(const PluginProblem&)> handler) { guard_.onHang = std::move(handler); }
    /// Is it in the middle of a call, on any thread?
    bool isInCall(std::string_view id) const;
    /// As if these were not installed, in safe mode if need be. Before anything was loaded.
    void leaveOut(const std::vector<std::string>& ids, bool safeMode = false);
    /// Takes the plugin as it is now in its folder. What runs goes on if that does not work; the error says why. Shared
    /// objects (effects, formats, engines) keep their addresses; tools and panels must be made again, and EffectStates
    /// dropped, by `beforeSwap`, which is called when the new library is known to work. Not while a simulation runs.
    Result<void> reload(std::string_view id, const std::function<void()>& beforeSwap = {});
    /// Takes in a plugin that came into a folder of the search path later; returns its id.
    Result<std::string> takeIn(const std::filesystem::path& folder);
    /// Delivers an event to a widget of the plugin as a call into it.
    void guardPanelEvent(std::string_view id, const std::function<void()>& deliver);
    /// Destroys all its objects and, with strictUnload, its library; the error names what it leaves behind.
    Result<void> unload(std::string_view id);

    std::vector<Contribution> contributions(ContributionKind kind) const override;
    const ItemType* itemType(std::string_view id) override;
    const Effect* effect(std::string_view id) override;
    Importer* importer(std::string_view extension) override;
    Exporter* exporter(std::string_view extension) override;
    PhysicsEngine* physicsEngine(std::string_view id) override;
    ScriptEngine* scriptEngine(std::string_view id) override;
    std::unique_ptr<Tool> createTool(std::string_view id, ToolHost& host) override;
    std::unique_ptr<Panel> createPanel(std::string_view id, Editor& editor) override;
    Command* command(std::string_view id) override;
    std::string explain(ContributionKind kind, std::string_view id) const override;
    std::string provider(ContributionKind kind, std::string_view id) const override;
    void recall(const PluginUse& use) override;
    /// Which known plugin provides it, usable or not, and how to get it. For formats `id` is an extension.
    Provider whoProvides(ContributionKind kind, std::string_view id) const;
    /// All ids that usable or unusable plugins declare of the kind; of formats the extensions.
    std::vector<std::string> knownIds(ContributionKind kind) const;

private:
    using Key = std::pair<ContributionKind, std::string>;
    /// A guarded object and the plugin it is from; both null where there is none.
    template <class T>
    struct Shared {
        std::shared_ptr<T> object;
        const Plugin* plugin = nullptr;
    };
    template <class T>
    using Table = std::map<std::string, Shared<T>, std::less<>>;

    std::vector<std::string> readFolder(const std::filesystem::path& folder, PluginOrigin origin);
    void adopt(std::unique_ptr<Plugin> plugin);
    /// Chooses between the copies of each plugin anew; a copy that is loaded stays. Then resolves; answers also the ids
    /// of plugins of which another copy is used.
    std::vector<std::string> chooseCopies();
    std::set<std::string> usableOnes() const;
    bool isWanted(const Plugin& plugin) const;
    PluginOrigin originOf(const std::filesystem::path& folder) const;
    /// Decides states and providers anew. Answers the ids of the plugins whose usability changed.
    std::vector<std::string> resolve() { return resolve(usableOnes()); }
    std::vector<std::string> resolve(const std::set<std::string>& usableBefore);
    void buildIndex();
    /// Objects of plugins that provide their contribution no more are kept, but not handed out again.
    template <class T>
    void retire(Table<T>& table, ContributionKind kind);
    /// Of the kind, the first that works; an engine that fails makes room for the next.
    template <class Get>
    auto firstWorking(ContributionKind kind, Get&& get) -> decltype(get(std::string()));
    Plugin* providerOf(ContributionKind kind, std::string_view id) const;
    std::string findFormat(ContributionKind kind, std::string_view extension) const;
    Plugin* ready(ContributionKind kind, std::string_view id);
    void loadOrFault(Plugin& plugin);
    void loadRequirementsFirst(Plugin& plugin);
    Result<void> swapIn(Plugin& plugin, Manifest manifest, const std::function<void()>& beforeSwap);
    void renewObjects(Plugin& plugin);
    template <class T, class Map>
    void renewTable(Table<T>& table, Plugin& plugin, Map Registrations::*factories);
    template <class T, class Map>
    T* shared(Table<T>& table, ContributionKind kind, std::string_view id, Map Registrations::*factories);

    PluginOptions options_;
    SettingsStore settingsStore_;
    Guard guard_;
    PluginTable plugins_;
    std::vector<std::unique_ptr<Plugin>> shadowed_;
    std::set<std::string> folders_;  // of all plugins: a folder that is added again changes nothing
    std::vector<std::unique_ptr<Plugin>> removed_;
    std::vector<std::shared_ptr<void>> retired_;
    std::map<Key, PluginUse> recorded_;  // what projects say of plugins
    std::map<Key, Plugin*> index_;
    std::map<Key, std::string> formats_;  // (kind, extension) -> contribution id
    Table<Effect> effects_;
    Table<ItemType> itemTypes_;
    Table<Importer> importers_;
    Table<Exporter> exporters_;
    Table<PhysicsEngine> physicsEngines_;
    Table<ScriptEngine> scriptEngines_;
    Table<Command> commands_;
};

}  // namespace jet::host
