// One installed plugin: its manifest, its state with the reason for it, its library once loaded, and what calls into it
// cost.
#pragma once

#include "call_account.hpp"
#include "manifest.hpp"

#include <jet/plugin.hpp>
#include <jet/plugins.hpp>
#include <jet/settings.hpp>

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace jet::host {

/// The factories a loaded plugin registered.
struct Registrations {
    std::map<std::string, PluginRegistrar::ToolFactory, std::less<>> tools;
    std::map<std::string, PluginRegistrar::PanelFactory, std::less<>> panels;
    std::map<std::string, PluginRegistrar::Factory<Effect>, std::less<>> effects;
    std::map<std::string, PluginRegistrar::Factory<ItemType>, std::less<>> itemTypes;
    std::map<std::string, PluginRegistrar::Factory<Importer>, std::less<>> importers;
    std::map<std::string, PluginRegistrar::Factory<Exporter>, std::less<>> exporters;
    std::map<std::string, PluginRegistrar::Factory<PhysicsEngine>, std::less<>> physicsEngines;
    std::map<std::string, PluginRegistrar::Factory<ScriptEngine>, std::less<>> scriptEngines;
    std::map<std::string, PluginRegistrar::Factory<Command>, std::less<>> commands;
    std::map<std::string, std::shared_ptr<Settings>, std::less<>> settings;
    /// Opens a settings page that is being registered; empty: pages are kept in memory.
    std::function<std::shared_ptr<Settings>(std::string_view page, const PropertyTable& table)> openSettings;
};

class PluginLibrary;

/// Where a plugin was found. Of equal versions the one of the first kind is used.
enum class PluginOrigin { Path, Project, User, BuiltIn };
/// "path", "project", "user", "built-in".
std::string_view originName(PluginOrigin origin);

struct Plugin {
    std::filesystem::path folder;
    Manifest manifest;
    std::atomic<PluginState> state{PluginState::Found};
    std::string reason;                ///< why it is Disabled, Shadowed or Faulted
    std::vector<std::string> remarks;  ///< about what it can do without, e.g. an optional plugin of another version
    PluginOrigin origin = PluginOrigin::Path;
    bool broken = false;   ///< its manifest cannot be read: Faulted for good
    bool unmet = false;    ///< Disabled or Faulted by the resolver, which may decide otherwise another time
    bool leftOut = false;  ///< Disabled by the plugin set, not by the user
    bool loading = false;
    std::unique_ptr<PluginLibrary> library;
    Registrations registrations;
    std::filesystem::path mapped;  ///< the file its library was loaded from
    double loadMs = 0;
    std::unique_ptr<CallAccount> account;  ///< what calls into it cost; from its loading on

    bool usable() const
    {
        const PluginState now = state;
        return now != PluginState::Disabled && now != PluginState::Shadowed && now != PluginState::Faulted;
    }
    /// Empty where its manifest cannot be read.
    std::string versionText() const { return broken ? std::string() : manifest.version.text(); }
    /// "Rectangle (org.jet.tool.rectangle 1.0.0)".
    std::string title() const;
};

/// What the calls into it cost so far, by callback. [any thread]
std::vector<CallbackCost> callbackCosts(const Plugin& plugin);

}  // namespace jet::host
