// jet project pack, unpack and collect: projects on their way to somebody else.
#pragma once

#include "session.hpp"

#include <functional>

namespace CLI {
class App;
}

namespace jet::host {

/// Adds them below `jet project`; the chosen one sets `run`.
void addPackedCommands(CLI::App& project, std::function<int(Session&)>& run);

}  // namespace jet::host
