// jet project save, recover, backups and restore: what keeps work from being lost.
#pragma once

#include "session.hpp"

#include <jet/project.hpp>

#include <functional>

namespace CLI {
class App;
}

namespace jet::host {

/// Adds them below `jet project`; the chosen one sets `run`.
void addRecoveryCommands(CLI::App& project, std::function<int(Session&)>& run);

/// Warns of changes that a crash left unsaved; returns how many.
std::size_t tellUnsavedChanges(Session& session, const std::filesystem::path& projectFile);

}  // namespace jet::host
