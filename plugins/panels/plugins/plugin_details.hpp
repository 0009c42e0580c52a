// Everything about one plugin as a rich text.
#pragma once

#include <jet/plugins.hpp>

#include <QString>

namespace jet::plugins {

QString detailsOf(const PluginInfo& plugin);

}  // namespace jet::plugins
