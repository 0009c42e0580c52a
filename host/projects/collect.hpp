// "Collect into project": the pictures and sounds a project uses come into its folder, so that it can be moved and
// sent.
#pragma once

#include <jet/assets.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace jet::host {

struct Collection {
    struct Copy {
        std::filesystem::path from;
        std::string to;  ///< relative to the project's folder, '/' between parts
    };
    std::vector<Copy> copies;             ///< files that were copied
    std::size_t references = 0;           ///< places that were rewritten
    std::vector<AssetReference> missing;  ///< whose file is nowhere; they stay as they are
    std::vector<AssetReference> kept;     ///< of plugins that are absent: their properties cannot be changed
};

/// Copies each file outside of the project's folder that a scene refers to into assets/ and rewrites the references as
/// relative ones, also those that name a file of the project by its absolute path. Files of equal content are one; a
/// name that is taken gets a number. Each scene gets one undo step, "Collect into project"; copies stay when it is
/// undone. On an Error no scene is changed. The project has been saved before: it needs a folder.
Result<Collection> collectAssets(Project& project);

/// Sentences for a person: what was done, and what could not be.
std::vector<std::string> describe(const Collection& collection);

}  // namespace jet::host
