// Items on the system clipboard, as the text of a scene file: they can be pasted into another project, another running
// editor, or a text.
#pragma once

#include <jet/scene.hpp>

#include <memory>

namespace jet::host {

void copyToClipboard(const std::vector<const Item*>& items, const Scene& scene);
/// Null when the clipboard holds no items.
std::unique_ptr<Scene> sceneOnClipboard(EventsCenter& events, Catalog& catalog);
bool clipboardHasItems();

}  // namespace jet::host
