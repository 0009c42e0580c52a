// `jet plugins pack | install | remove | search | index` (docs/packages.md).
#pragma once

#include "session.hpp"

#include <functional>

namespace CLI {
class App;
}

namespace jet::host {

/// Adds them below `jet plugins`; the chosen one sets `run`.
void addPackageCommands(CLI::App& plugins, std::function<int(Session&)>& run);

}  // namespace jet::host
