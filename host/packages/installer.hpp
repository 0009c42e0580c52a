// Installs and removes packages: checked first, then put in place in one step, so that no half of a plugin is ever
// there.
//
//   auto installer = Installer::open(options).orThrow();
//   installer->stage(bytes, "rope.jetplugin").orThrow();     // any number: those that belong together
//   const auto done = installer->commit().orThrow();         // all of them or none
//
// A plugin's settings are kept elsewhere (the user's configuration) and stay through updates and removal.
#pragma once

#include "package.hpp"

#include "host/plugins/plugin_manager.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace jet::host {

class FolderLock;

/// A plugin that is there already, wherever.
struct InstalledPlugin {
    std::string id;
    Version version;
    std::filesystem::path folder;
    std::vector<Dependency> needs;
    bool works = true;  ///< its manifest can be read
};
std::vector<InstalledPlugin> installedPlugins(const PluginManager& manager);

struct InstallOptions {
    std::filesystem::path folder;            ///< where plugins are put; userPluginFolder() for the user's own
    std::vector<InstalledPlugin> installed;  ///< for dependencies and versions
    bool force = false;                      ///< downgrade, and install although something it requires is missing
    std::filesystem::path program;           ///< bin/jet, for the trial; empty: this program
    ArchiveLimits limits;
};

/// One plugin that was put in place.
struct InstallOutcome {
    std::string id, name;
    Version version;
    std::filesystem::path folder;
    std::optional<Version> before;   ///< the version that was replaced
    std::vector<std::string> notes;  ///< what the user should know
};

class Installer {
public:
    /// Makes the folder if need be and locks it against other installers.
    static Result<std::unique_ptr<Installer>> open(InstallOptions options);
    /// Drops what was staged and not committed.
    ~Installer();

    /// Unpacks beside the target and checks: the manifest, the SDK and ABI it was built for, that the library loads and
    /// registers what is declared (in a child process), and that no newer version would be replaced. `package` is for
    /// messages.
    Result<void> stage(std::string_view bytes, const std::filesystem::path& package);
    /// Checks what the staged plugins require, and puts all in place. After an error nothing has changed.
    Result<std::vector<InstallOutcome>> commit();

private:
    struct Staged {
        Manifest manifest;
        std::filesystem::path folder;  // beside the target
        std::filesystem::path target;
        std::filesystem::path package;  // for messages
        std::optional<Version> before;
        bool replaces = false;
        bool inPlace = false;
    };
    explicit Installer(InstallOptions options, std::unique_ptr<FolderLock> lock);
    std::filesystem::path staging() const { return options_.folder / ".staging"; }
    void clean();
    Result<void> checkLibrary(const Staged& staged) const;
    Result<void> findTarget(Staged& staged) const;
    Result<void> checkDependencies(const Staged& staged) const;
    const InstalledPlugin* installed(const std::string& id) const;
    Result<void> putInPlace(Staged& staged);
    void takeBack();
    InstallOutcome outcomeOf(const Staged& staged) const;

    InstallOptions options_;
    std::unique_ptr<FolderLock> lock_;
    std::vector<Staged> staged_;
    int count_ = 0;
};

/// Installs one package file.
Result<InstallOutcome> installPackage(const std::filesystem::path& file, InstallOptions options);

struct RemoveOptions {
    std::filesystem::path folder;            ///< where plugins are removed from
    std::vector<InstalledPlugin> installed;  ///< to find it and those that require it
    bool force = false;                      ///< although others require it
};
/// Removes a plugin from the folder; the error names who requires it. Returns where it was.
Result<std::filesystem::path> removePlugin(const std::string& id, const RemoveOptions& options);

/// Loads the library in the folder and compares what it registers with its manifest. For the child process in which
/// installers try a library (`jet plugins try-load DIR`).
Result<void> tryLoad(const std::filesystem::path& folder);

}  // namespace jet::host
