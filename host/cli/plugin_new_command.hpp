// jet plugins new KIND NAME [DIR]: a plugin project that builds, from the templates in share/jet/templates.
#pragma once

#include "session.hpp"

#include <functional>

namespace CLI {
class App;
}

namespace jet::host {

/// Adds it below `jet plugins`; sets `run` when it is chosen.
void addNewPluginCommand(CLI::App& plugins, std::function<int(Session&)>& run);

}  // namespace jet::host
