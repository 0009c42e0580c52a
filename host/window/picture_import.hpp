// Pictures that come from outside: files dropped on a scene or imported into it, and what is on the clipboard.
#pragma once

#include <jet/editor.hpp>

#include <QPointF>
#include <QStringList>

namespace jet::host {

/// Adds an image item for each file, as one undo step, selected; the first one about `at`, the next a little aside. The
/// user is told about files that are no pictures. False when none was placed.
bool placePictures(Editor& editor, Scene& scene, const QStringList& files, const QPointF& at);
/// Pictures that an importer added to `parent`, from its child number `first` on: what lies in the drawing itself
/// ("data:") or elsewhere on the disk becomes files of the project, if it has a folder.
void adoptPictures(Transaction& edit, const Scene& scene, const Item& parent, std::size_t first);
/// As placePictures() with the clipboard's picture: files copied in a file manager, or pixels, which become a PNG file
/// of the project. False, and nothing said, when there is none.
bool pastePicture(Editor& editor, Scene& scene, const QPointF& at);

}  // namespace jet::host
