// Where in a project's files a setting of a scene is given, for messages about its value.
#pragma once

#include <jet/result.hpp>

#include <filesystem>
#include <string_view>

namespace jet::host {

/// As exactly as can be found: the property, the scene's file, or the project's.
Location placeOfSetting(const std::filesystem::path& project, std::string_view scene, std::string_view setting);

}  // namespace jet::host
