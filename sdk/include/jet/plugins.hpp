// PluginsCenter: the installed plugins as a panel or a command sees them: state and reason, what they offer and cost,
// switching on and off, installing, removing, settings, and who provides what is missing. Reached by Editor::plugins().
#pragma once

#include <jet/catalog.hpp>
#include <jet/events.hpp>
#include <jet/result.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jet {

class Project;
class Settings;

/// Found -> Valid -> Resolved -> Loaded -> Active, or Disabled, Shadowed, Faulted; see docs/plugins.md.
enum class PluginState { Found, Valid, Resolved, Loaded, Active, Disabled, Shadowed, Faulted };
/// "found", "valid", ...
JET_API std::string_view stateName(PluginState state);

/// What the calls of one kind into a plugin cost.
struct CallbackCost {
    std::string callback;  ///< "Tool::press"
    std::uint64_t calls = 0;
    double totalMs = 0, longestMs = 0;
    std::uint64_t overruns = 0;  ///< calls that took longer than the host's budget for them
};

struct PluginInfo {
    std::string id, name, version, description, license;
    std::filesystem::path folder;
    std::string origin;  ///< where it was found: "path", "project", "user" or "built-in"
    PluginState state = PluginState::Found;
    std::string reason;  ///< why it is Disabled, Shadowed or Faulted: a sentence without its full stop
    std::vector<std::string> requires_, optional, conflicts;  ///< as written: "org.acme.rope >=1.2 <3"
    std::vector<std::string> warnings;                        ///< remarks about its manifest
    std::vector<Contribution> contributions;
    double loadMs = 0;                    ///< 0: not loaded
    std::vector<CallbackCost> callbacks;  /// by callback
    std::uint64_t calls = 0;
    std::uint64_t mappedBytes = 0;  ///< of its library in this process; 0: not loaded

    bool isUsable() const
    {
        return state != PluginState::Disabled && state != PluginState::Shadowed && state != PluginState::Faulted;
    }
};

/// Sent by the host after plugins were switched, installed, removed, reloaded or faulted: what a panel or a menu shows
/// of the catalog is to be made again.
struct PluginsChanged {
    static constexpr EventType type{"org.jet.plugins-changed"};
    std::vector<std::string> plugins;  ///< ids
};

/// What a request did.
struct PluginChange {
    std::vector<std::string> plugins;  ///< ids of all that changed
    bool afterRestart = false;         ///< stored, but this run of the editor goes on as before
    std::string message;               ///< a sentence for the user
};

/// Who provides a contribution.
enum class Availability { Usable, Disabled, LeftOut, Faulted, Shadowed, NotInstalled, Unknown };
struct Provider {
    Availability availability = Availability::Unknown;
    std::string plugin, name, version;  ///< empty if Unknown; the name also if NotInstalled
    std::string sentence;               ///< which plugin, its state, and how to get it
    bool canEnable() const { return availability == Availability::Disabled || availability == Availability::LeftOut; }
};

/// A named list of plugins, docs/plugin-sets.md.
struct PluginSetInfo {
    std::string name;         ///< chooses it: useSet(), --plugins; empty: all plugins, no set
    std::string title;        ///< for people
    std::string description;  ///< a sentence; may be empty
    std::string source;       ///< where it is from: "shipped", "user", "project", "command line", or "" for all plugins
    std::filesystem::path file;
    std::size_t plugins = 0;  ///< installed ones that it holds
    std::vector<std::string>
        missing;          ///< what it names and is not installed in a fitting version, each with the reason
    std::string problem;  ///< why its file cannot be read; empty: it can
    bool inUse = false;
};

/// What a project or its set says of a plugin and what is here, where the two differ.
struct PluginDifference {
    enum class Kind { Missing, Disabled, LeftOut, Faulted, OtherVersion };
    Kind kind = Kind::Missing;
    std::string id, name;
    std::string wanted;  ///< version, or a range of them; empty: any
    std::string here;    ///< version; empty: not installed
    int uses = 0;        ///< items, effects and engines of the project that come from it; 0: its set names it
    std::string reason;  ///< what the difference is: a sentence without its full stop
    std::string remedy;  ///< what can be done: a sentence without its full stop
    bool canEnable() const { return kind == Kind::Disabled || kind == Kind::LeftOut; }
};

/// [gui]
class JET_API PluginsCenter {
public:
    virtual ~PluginsCenter();

    /// By id; shadowed ones follow the one that is used.
    virtual std::vector<PluginInfo> plugins() const = 0;
    virtual std::optional<PluginInfo> plugin(std::string_view id) const = 0;

    /// Usable plugins that require this one, directly or through others: disabling it disables them.
    virtual std::vector<std::string> dependents(std::string_view id) const = 0;
    /// Disabled plugins this one requires, directly or through others: enabling it enables them.
    virtual std::vector<std::string> requirements(std::string_view id) const = 0;
    /// Switches for this and all later runs, together with dependents() or requirements().
    virtual Result<PluginChange> setEnabled(std::string_view id, bool enabled) = 0;

    /// A `.jetplugin` file or a folder with a plugin.json, into the user's plugins. The default refuses, as does the
    /// next.
    virtual Result<PluginChange> install(const std::filesystem::path& file);
    /// Removes a plugin of the user's; its settings stay.
    virtual Result<PluginChange> remove(std::string_view id);
    /// Loads its library anew from the disk. The default refuses.
    virtual Result<PluginChange> reload(std::string_view id);

    /// The settings page of that id; loads its plugin. Null when there is none; whoProvides() says why.
    virtual std::shared_ptr<Settings> settings(std::string_view page) = 0;
    /// For formats `id` is an extension.
    virtual Provider whoProvides(ContributionKind kind, std::string_view id) const = 0;

    /// All sets that can be chosen: "all plugins" first, then the project's, the user's, the shipped ones. The default
    /// knows none.
    virtual std::vector<PluginSetInfo> sets() const;
    /// Uses the plugins of that set only, from now on and in later runs; an empty name: all. The default refuses, as
    /// does the next.
    virtual Result<PluginChange> useSet(std::string_view name);
    /// Writes the plugins that can be used now as a set of the user's. Replaces one of that name.
    virtual Result<PluginSetInfo> saveSet(std::string_view name);
    /// Plugins the project was saved with, or its plugins.jetset names, that are not here as they were then. The
    /// default finds none.
    virtual std::vector<PluginDifference> differences(const Project& project) const;
};

}  // namespace jet
