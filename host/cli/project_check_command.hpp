// jet project check: what is wrong with a project, and mending it.
#pragma once

#include "session.hpp"

#include <functional>

namespace CLI {
class App;
}

namespace jet::host {

/// Adds it below `jet project`; sets `run` when it is chosen.
void addProjectCheckCommand(CLI::App& project, std::function<int(Session&)>& run);

}  // namespace jet::host
