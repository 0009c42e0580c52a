// PluginSet: a named list of plugins (.jetset, docs/plugin-sets.md): which ones, in which versions, and which not.
// Where sets are found and how they are read is in plugin_set_files.hpp.
#pragma once

#include "versions.hpp"

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace jet::host {

/// Where a set is from. Of equal names the first kind is meant.
enum class SetSource { CommandLine, Project, User, Shipped };
/// "command line", "project", "user", "shipped".
std::string_view sourceName(SetSource source);

class PluginSet {
public:
    struct Entry {
        Dependency plugin;      ///< its id, or the beginning of ids with '*' at the end
        bool optional = false;  ///< may be absent
        Location where;
        bool isPattern() const { return plugin.id.ends_with('*'); }
        bool matches(std::string_view id) const;
        std::string text() const { return plugin.text(); }
    };

    std::string name;                ///< chooses it
    std::string title, description;  ///< for people
    SetSource source = SetSource::CommandLine;
    std::filesystem::path file;
    std::vector<PluginSet> includes;
    std::vector<Entry> plugins, excluded;
    std::vector<Error> warnings;  ///< with their places: fields that mean nothing to this JET

    /// Of these plugins in any version.
    static PluginSet of(const std::vector<std::string>& ids, std::string name = {});

    /// Is it named here or in an included set, and not excluded?
    bool holds(std::string_view id) const;
    /// Is it kept out, even if a plugin of the set requires it?
    bool excludes(std::string_view id) const;
    /// Will this version do? Where several entries name the plugin, all of them must admit it.
    bool admits(std::string_view id, const Version& version) const;
    /// What it asks of the plugin's version, as written; empty: nothing.
    std::string wantedOf(std::string_view id) const;
    /// Its own entries and those of included sets, without what is excluded. Pointers into the set.
    std::vector<const Entry*> entries() const;
    /// Lets a plugin in, as long as the set lives.
    void letIn(const std::string& id);
    /// Those of `all` that the set holds, and what they require; `requirementsOf` tells the ids a plugin requires.
    std::set<std::string>
    select(const std::set<std::string>& all,
           const std::function<std::vector<std::string>(const std::string&)>& requirementsOf) const;

private:
    std::set<std::string, std::less<>> letIn_;
};

/// A plugin in one version.
struct FrozenPlugin {
    std::string id;
    Version version;
    /// As a set names it: "org.acme.rope =1.2.0".
    std::string text() const { return id + " =" + version.text(); }
};

/// Text of a .jetset file with these entries.
std::string setText(const std::string& title, const std::string& description, const std::vector<std::string>& plugins);

}  // namespace jet::host
