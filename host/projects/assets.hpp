// The files a project refers to besides its scenes: pictures, sounds.
#pragma once

#include <jet/project.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace jet::host {

/// A place in a scene that names a file. By convention it is a text property "file", or one that ends in "-file", of an
/// item or of one of its effects, whatever plugin they come from.
struct AssetReference {
    Scene* scene;
    ItemId item;
    int effect = -1;  ///< its index; -1: a property of the item itself
    std::string property;
    std::string text;            ///< as written; not empty
    std::filesystem::path file;  ///< the file meant, without "." and ".."
};

/// All of them, in the order of scenes and items. Addresses on the network ("https://...") are left out.
std::vector<AssetReference> findAssets(const Project& project);

/// Does the file lie in the folder? Decided by names, without following links.
bool liesIn(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace jet::host
