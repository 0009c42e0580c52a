// How the plugins that are here differ from what a project or a plugin set says, and what can be done: for the dialog
// of the window, the warnings of commands, and --frozen.
#pragma once

#include "plugin_manager.hpp"

#include <jet/plugins.hpp>
#include <jet/project.hpp>

#include <string>
#include <vector>

namespace jet::host {

/// Of the plugins that the project was saved with, or that its plugins.jetset names.
std::vector<PluginDifference> projectDifferences(const PluginManager& plugins, const Project& project);
/// Of the plugins a set names: not installed, another version, or cannot be used. Optional ones may be absent.
std::vector<PluginDifference> setDifferences(const PluginManager& plugins, const PluginSet& set);

/// "org.acme.rope: the project wants 1.2.0 (3 uses), it is not installed; get its .jetplugin file …"
std::string sentenceOf(const PluginDifference& difference);

/// What --frozen demands: the chosen set and the project, if given, name exact versions, and just those are here and
/// can be used. The error lists all differences, a line each.
Result<void> checkFrozen(const PluginManager& plugins, const Project* project);

/// The plugins of this run in their versions: all that can be used, or those the project uses, with what they require
/// and the engines it is played with.
std::vector<FrozenPlugin> pluginsInUse(PluginManager& plugins, const Project* project);

}  // namespace jet::host
