// A package: the zip of a built plugin folder, named *.jetplugin, with plugin.json at its top (docs/packages.md).
#pragma once

#include "host/archive/archive.hpp"
#include "host/plugins/manifest.hpp"

#include <filesystem>
#include <string>

namespace jet::host {

inline constexpr std::string_view kPackageExtension = "jetplugin";

struct PackedPlugin {
    Manifest manifest;
    std::string bytes;
    std::size_t files = 0;
};

/// "org.acme.rope-1.2.0.jetplugin".
std::string packageFileName(const Manifest& manifest);

/// Packs a built plugin folder: all its files but hidden ones. Equal folders give equal bytes. Refuses a folder without
/// the built library, and one whose manifest names files that are not there.
Result<PackedPlugin> packFolder(const std::filesystem::path& folder);

/// The package's bytes; refuses files larger than a package may be without reading them.
Result<std::string> readPackage(const std::filesystem::path& file, const ArchiveLimits& limits = {});
/// The manifest of a package; nothing is unpacked.
Result<Manifest> manifestOf(std::string_view bytes, const std::filesystem::path& package,
                            const ArchiveLimits& limits = {});

/// Does the folder hold what the manifest names: the built library and the icons?
Result<void> checkContents(const Manifest& manifest, const std::filesystem::path& folder);

}  // namespace jet::host
