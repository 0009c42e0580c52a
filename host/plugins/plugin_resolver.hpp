// Which of the found plugins can run: the user's choice, versions, dependencies and conflicts. Loads nothing; may be
// run again when a choice changes.
#pragma once

#include "plugin.hpp"
#include "plugin_set.hpp"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace jet::host {

using PluginTable = std::map<std::string, std::unique_ptr<Plugin>, std::less<>>;

struct PluginChoice {
    const std::set<std::string>& disabled;  ///< switched off by the user
    const std::optional<PluginSet>& set;    ///< none: all
};

/// The ids of the plugins in the table that the set holds, with what they require.
std::set<std::string> selectedPlugins(const PluginSet& set, const PluginTable& plugins);

/// Gives every plugin in the table a state from Resolved on, or Disabled or Faulted with its reason. A plugin that
/// failed while it ran stays Faulted.
void resolvePlugins(PluginTable& plugins, const PluginChoice& choice);

}  // namespace jet::host
