// Checks a project on disk thoroughly, file by file, and mends what can be mended (docs/file-format.md, "Checking and
// repairing").
#pragma once

#include "findings.hpp"

#include <jet/project.hpp>

#include <filesystem>
#include <memory>

namespace jet::host {

struct CheckOptions {
    bool repair = false;
    std::filesystem::path schemas;  ///< folder of project.rng and scene.rng; empty: not checked against them
};

struct CheckReport {
    std::filesystem::path file;                  ///< the project's
    Findings findings;                           ///< in the order of files
    std::vector<std::filesystem::path> written;  ///< by the repair
    std::unique_ptr<Project> project;            ///< as it is now; null where it does not open
    Error problem;                               ///< why it does not
    bool isFine() const;                         ///< it opens, and no error is left
};

/// With `repair`: what was found is mended, the original becomes a backup first, and either all files are written or
/// none - none, if the project would not open afterwards. The Error is one of the disk, or that there is no project.
Result<CheckReport> checkProjectFiles(const std::filesystem::path& project, EventsCenter& events, Catalog& catalog,
                                      const CheckOptions& options);

}  // namespace jet::host
