// Asks which symbol is meant, where there are several.
#pragma once

#include <jet/scene.hpp>

#include <optional>
#include <string>

namespace jet::symbols {

/// The symbol a command works on: the only one there is, or the one the user picks. Null when there is none, or the
/// user gives up. `likely` is offered first.
const Item* chooseSymbol(const Scene& scene, const std::string& title, const Item* likely);
/// A new name; none when the user gives up.
std::optional<std::string> askName(const std::string& title, const std::string& present);

}  // namespace jet::symbols
