// What the user chose for a plugin, kept in the configuration folder apart from the plugin itself: whether it is
// switched off, the options of its tools, and its settings pages. Stays through updates and removal, until it is
// dropped here.
#pragma once

#include "host/plugins/manifest.hpp"

#include <filesystem>

namespace jet::host {

/// $XDG_CONFIG_HOME/jet, else ~/.config/jet.
std::filesystem::path configurationFolder();
/// Drops the settings of the plugin: `jet plugins remove ID --purge`.
Result<void> dropSettings(const Manifest& manifest, const std::filesystem::path& configuration = configurationFolder());

}  // namespace jet::host
