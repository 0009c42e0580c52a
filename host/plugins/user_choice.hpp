// What the user chose about plugins, kept in $XDG_CONFIG_HOME/jet.
#pragma once

#include <jet/result.hpp>

#include <filesystem>
#include <set>
#include <string>

namespace jet::host {

/// $XDG_CONFIG_HOME/jet, else ~/.config/jet; empty without a home.
std::filesystem::path userConfigFolder();

/// The plugins the user switched off: the file disabled-plugins, one id a line.
std::set<std::string> readDisabledPlugins();
Result<void> writeDisabledPlugins(const std::set<std::string>& ids);

}  // namespace jet::host
