// The commands of bin/jet (docs/command-line.md). Each returns an exit code and prints errors as file:line:col: error:
// text.
#pragma once

#include "session.hpp"

#include <optional>
#include <string>
#include <vector>

namespace jet::host {

struct PlayOptions {
    std::filesystem::path project, input, snapshot, state, record;
    std::string scene, physics;
    std::uint64_t steps = 600;
    std::optional<double> timeStep;
    std::uint64_t seed = 1;
    int threads = 1;
    int width = 0, height = 0;  ///< of the view; 0: as usual, and the picture shows the page
    std::string debug;          ///< what the picture shows of the physics (debug_marks.hpp)
};

struct ConvertOptions {
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path output;
    std::string scene, background;
    int width = 0, height = 0;
    std::vector<std::string> effects;     ///< "effect" or "effect:property=value,…", put on every shape
    std::vector<std::string> properties;  ///< "property=value", set on every item that has it
};

int play(Session& session, const PlayOptions& options);
int convert(Session& session, const ConvertOptions& options);

int listPlugins(Session& session);
int pluginInfo(Session& session, const std::string& id);
/// `project`, if given: what it says of plugins that are not installed counts, too.
int explainContribution(Session& session, const std::string& id, const std::filesystem::path& project);
int trustPlugins(Session& session, const std::filesystem::path& project, bool trusted);
int enablePlugin(Session& session, const std::string& id, bool enable);

int newProject(Session& session, const std::filesystem::path& folder);
int projectInfo(Session& session, const std::filesystem::path& project);

/// The command line without a window. Returns the exit code, or nothing when the editor is to be started with
/// `project`.
std::optional<int> runCommandLine(int argc, char** argv, GlobalOptions& global, std::filesystem::path& project);

}  // namespace jet::host
