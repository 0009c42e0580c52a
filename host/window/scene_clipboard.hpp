// Items on the system clipboard, as the text of a scene file: they can be pasted into another project, another running
// editor, or a text.
#pragma once

#include <jet/scene.hpp>

#include <memory>

namespace jet::host {

void copyToClipboard(const std::vector<const Item*>& items, const Scene& scene);
/// Null when the clipboard holds no items.
std::unique_ptr<Scene> sceneOnClipboard(EventsCenter& events, Catalog& catalog);

/// For the end of the program: where the windowing system forgets a clipboard with the program it came from (X11
/// without a clipboard manager, Wayland), keeps the items on it in a file, if they are this program's. Pasting takes
/// them from there while the clipboard holds nothing at all. The file lies in $XDG_RUNTIME_DIR, so that it goes with
/// the user's session, as a clipboard does; without that folder nothing is kept.
void keepClipboard();

}  // namespace jet::host
