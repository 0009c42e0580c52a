// jet plugins sets [show NAME | use NAME] and jet plugins freeze: plugin sets, docs/plugin-sets.md.
#pragma once

#include "session.hpp"

#include <functional>

namespace CLI {
class App;
}

namespace jet::host {

/// Adds the commands to `plugins`; the one that is given sets `run`.
void addSetCommands(CLI::App& plugins, std::function<int(Session&)>& run);

}  // namespace jet::host
