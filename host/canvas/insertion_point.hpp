// Where new items go: one answer for tools, paste and import.
#pragma once

#include <jet/editor.hpp>

namespace jet::host {

/// The group or layer of the selection, else the active layer, else the first layer; a layer is made, within `edit`,
/// when the scene has none. Locked and hidden containers are passed over: what is drawn must be seen.
const Item& insertionPoint(Editor& editor, Scene& scene, Transaction& edit);

}  // namespace jet::host
