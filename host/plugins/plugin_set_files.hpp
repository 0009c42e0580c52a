// PluginSetFiles: where plugin sets are found by name, and how their files are read. docs/plugin-sets.md.
//
//   PluginSetFiles files(projectFolder);
//   PluginSet set = files.choose("drawing,org.acme.rope >=1.2").orThrow();     // the value of --plugins
#pragma once

#include "plugin_set.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace jet::host {

class PluginSetFiles {
public:
    /// A set of the name "project" is that of this project: the file plugins.jetset beside it.
    explicit PluginSetFiles(const std::filesystem::path& project = {});

    /// A set by name, a .jetset file, or a list of these and of plugin ids with ranges, separated by commas.
    Result<PluginSet> choose(const std::string& text) const;
    /// By name or file. The error names file, line and column, or the sets there are.
    Result<PluginSet> read(const std::string& nameOrFile) const;
    /// The project's plugins.jetset, if there is one.
    std::optional<Result<PluginSet>> ofProject() const;

    struct Listed {
        std::string name;
        SetSource source = SetSource::User;
        std::filesystem::path file;
    };
    /// All that can be chosen by name: the project's, the user's, the shipped ones. Of equal names the first.
    std::vector<Listed> list() const;

    const std::filesystem::path& projectFile() const { return projectFile_; }
    /// $XDG_CONFIG_HOME/jet/sets.
    static std::filesystem::path userFolder();
    /// share/jet/sets of the installation, or of the build.
    static std::filesystem::path shippedFolder();

private:
    std::filesystem::path projectFile_;
};

/// The set the user chose for all runs, by name: the file plugin-set in $XDG_CONFIG_HOME/jet. Empty: none.
std::string readChosenSet();
Result<void> writeChosenSet(const std::string& name);

}  // namespace jet::host
