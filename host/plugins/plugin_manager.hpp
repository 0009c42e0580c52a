// PluginManager: finds plugins, decides which can run, loads them on first use. It is the Catalog the whole program
// uses.
#pragma once

#include "guarded.hpp"
#include "plugin.hpp"
#include "settings_store.hpp"

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
    std::optional<std::set<std::string>> only;      ///< a plugin set; none: all
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

    /// By id.
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

    void readFolder(const std::filesystem::path& folder);
    void adopt(std::unique_ptr<Plugin> plugin);
    void resolve();
    void resolve(Plugin& plugin, std::vector<const Plugin*>& chain);
    void buildIndex();
    /// Of the kind, the first that works; an engine that fails makes room for the next.
    template <class Get>
    auto firstWorking(ContributionKind kind, Get&& get) -> decltype(get(std::string()));
    Plugin* providerOf(ContributionKind kind, std::string_view id) const;
    std::string findFormat(ContributionKind kind, std::string_view extension) const;
    Plugin* ready(ContributionKind kind, std::string_view id);
    void loadOrFault(Plugin& plugin);
    template <class T, class Map>
    T* shared(Table<T>& table, ContributionKind kind, std::string_view id, Map Registrations::*factories);

    PluginOptions options_;
    SettingsStore settingsStore_;
    Guard guard_;
    std::map<std::string, std::unique_ptr<Plugin>, std::less<>> plugins_;
    std::vector<std::unique_ptr<Plugin>> shadowed_;
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
