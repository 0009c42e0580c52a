// Plugins that come with a project: `plugins/` beside its project file. They are code of whoever made the project, so
// they are used only after the user trusted this project once. Trust is remembered by the project's real path and a
// fingerprint of the folder: when a file in it changes, the user is asked again.
#pragma once

#include <jet/result.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace jet::host {

struct ProjectPlugins {
    enum class Trust {
        Unknown,  ///< never asked
        Changed,  ///< trusted once, but the folder is another one now
        Trusted
    };
    std::filesystem::path project;   ///< the project's folder, without links
    std::filesystem::path folder;    ///< <project>/plugins
    std::vector<std::string> names;  ///< the folders of the plugins in it
    std::string fingerprint;         ///< empty when it cannot be made; then it is never trusted
    Trust trust = Trust::Unknown;

    bool isTrusted() const { return trust == Trust::Trusted; }
    /// A sentence: that they were left out, why, and how to trust them.
    std::string advice() const;
};

/// The plugins beside a project file (or in a project's folder); nothing where there are none.
std::optional<ProjectPlugins> findProjectPlugins(const std::filesystem::path& project);
/// Remembers that the user trusts (or no longer trusts) this project, in $XDG_CONFIG_HOME/jet/trusted-projects.json.
Result<void> trustProject(const ProjectPlugins& plugins, bool trusted = true);

}  // namespace jet::host
