// What a command works on, in tree order, whatever order it was selected in.
#pragma once

#include <jet/scene.hpp>

namespace jet::host {

/// The selected items without those that lie in a selected group, bottom first.
std::vector<const Item*> topSelection(const Scene& scene);
/// What "Select all" selects: shown, unlocked items directly in layers or at the top; groups as a whole.
std::vector<ItemId> selectableItems(const Scene& scene);

}  // namespace jet::host
