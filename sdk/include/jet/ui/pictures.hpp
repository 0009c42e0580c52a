// Pictures: files that image items show, as a user brings them: by a tool, a drop or the clipboard.
#pragma once

#include <jet/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace jet::ui {

/// Has the file the extension of a picture that can be shown? It may be damaged all the same. [any thread]
JET_API bool isPictureName(const std::filesystem::path& file);
/// Filter for file dialogs: "Pictures (*.png *.jpg …)". [GUI thread]
JET_API std::string pictureFilter();
/// In pixels; nothing when it cannot be read. [any thread]
JET_API std::optional<Vec2> pictureSize(const std::filesystem::path& file);

/// How a picture fills the frame it is given.
enum class PictureFit {
    Inside,   ///< as large as fits, its sides in proportion, in the middle
    Stretch,  ///< all of the frame
};

/// Adds an image item that shows the file. The file is copied into the project (jet/assets.hpp); a project that was
/// never saved has no folder, and the item refers to the file where it is. A frame that is a point only: its own size,
/// a pixel a scene unit, about that point. Throws Failure when the file is no picture. [GUI thread]
JET_API const Item& addPicture(Transaction& edit, const Item& parent, const Scene& scene,
                               const std::filesystem::path& file, const Box& frame,
                               PictureFit fit = PictureFit::Inside);

}  // namespace jet::ui
