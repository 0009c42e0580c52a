// Assets: the files a project uses besides its scenes, such as pictures and sounds: who refers to them, which there
// are, and how a new one comes into the project's folder.
//
//   const std::string file = jet::storeAsset(scene.assetFolder(), "cat.png", bytes).orThrow();   // "assets/cat.png"
//   edit.set(item, "file", file);
#pragma once

#include <jet/project.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jet {

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

/// All of them, in the order of scenes and items. Addresses ("https://...", "data:...") are left out.
JET_API std::vector<AssetReference> findAssets(const Project& project);
/// Can a transaction change it? Not while the plugin that declares the property is absent.
JET_API bool isChangeable(const AssetReference& reference);
/// Lets it name another file.
JET_API void rewrite(Transaction& edit, const AssetReference& reference, const std::string& text);

/// Does the file lie in the folder? Decided by names, without following links.
JET_API bool liesIn(const std::filesystem::path& file, const std::filesystem::path& folder);

/// The files in the project's folder that are not its own: without project files, scenes, hidden files and plugins.
/// Relative to the folder, with '/', sorted. Empty for a project that was never saved.
JET_API std::vector<std::string> assetFiles(const Project& project);

/// Writes a file into the folder's assets/ and returns its path relative to the folder. A name that is taken gets a
/// number; a file of equal content that is there already is used instead. `folder` is that of a saved project: an Error
/// when it is empty.
JET_API Result<std::string> storeAsset(const std::filesystem::path& folder, const std::string& name,
                                       std::string_view content);

}  // namespace jet
