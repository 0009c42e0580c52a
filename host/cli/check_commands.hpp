// `jet plugins check DIR...` (docs/plugins-check.md).
#pragma once

#include "session.hpp"

#include <functional>

namespace CLI {
class App;
}

namespace jet::host {

/// Adds it below `jet plugins`; when chosen it sets `run`.
void addCheckCommands(CLI::App& plugins, std::function<int(Session&)>& run);

}  // namespace jet::host
