// Starts the window, which lives in libjet-window.so so that headless commands load no Qt.
#pragma once

#include "host/cli/session.hpp"

namespace jet::host {

/// Returns the exit code. Without a display it says so and names `jet play`.
int runEditor(int argc, char** argv, const GlobalOptions& global, const std::filesystem::path& project);

}  // namespace jet::host
