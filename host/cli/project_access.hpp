// Opening projects and choosing scenes, for several commands.
#pragma once

#include "commands.hpp"

#include <jet/project.hpp>

namespace jet::host {

/// Prints the error, or the warnings, and returns null on an error.
std::unique_ptr<Project> openProject(Session& session, const std::filesystem::path& path);
/// By name or number; throws Failure when there is none. Empty: the start scene.
Scene& chooseScene(Project& project, const std::string& wanted);

}  // namespace jet::host
