// Arranging: order, groups, alignment and distribution of items, as commands, tools and scripts do it. Each function
// works inside a transaction of the caller's, so that whatever it does is part of one undo step.
//
//   auto edit = scene.items().begin("Align left");
//   alignItems(edit, topSelection(scene), Alignment::Left);
//   edit.commit();
//
// Items are given in tree order, none of them inside another, as topSelection() gives them. Items that are locked or
// hidden (or lie in something that is) are left alone. All on the thread that owns the scene.
#pragma once

#include <jet/scene.hpp>

#include <span>
#include <vector>

namespace jet {

using ItemList = std::vector<const Item*>;
class Editor;

/// The scene of the front tab if it may be edited now: not while it is played. Else null. For commands.
JET_API Scene* editableScene(Editor& editor);

/// The selected items without those that lie in a selected group, in tree order (bottom first), whatever order they
/// were selected in.
JET_API ItemList topSelection(const Scene& scene);
/// What "Select all" selects: shown, unlocked items directly in layers or at the top; groups as a whole.
JET_API std::vector<ItemId> selectableItems(const Scene& scene);
/// Exact bounds of all of them together.
JET_API Box boundsOf(std::span<const Item* const> items);

enum class Alignment { Left, CenterX, Right, Top, CenterY, Bottom };
/// Moves the bounds of each item to the same edge (or centre line) of `frame`; without a frame, of their common bounds.
JET_API void alignItems(Transaction& edit, std::span<const Item* const> items, Alignment alignment, Box frame = {});

enum class Distribution { CentersX, CentersY, GapsX, GapsY };
/// Spaces the items evenly between the first and the last one in that direction, which stay: their centres, or the
/// gaps between their bounds. Fewer than three stay as they are.
JET_API void distributeItems(Transaction& edit, std::span<const Item* const> items, Distribution distribution);

enum class FlipAxis { Horizontal, Vertical };
/// Mirrors the items about the centre of their common bounds: Horizontal exchanges left and right.
JET_API void flipItems(Transaction& edit, std::span<const Item* const> items, FlipAxis axis);

enum class StackOrder { ToFront, Forward, Backward, ToBack };
/// Changes the order among each item's siblings. Forward and Backward pass the next sibling that is not one of the
/// items themselves; items at the end already stay. The items keep their order among each other.
JET_API void reorderItems(Transaction& edit, std::span<const Item* const> items, StackOrder order);

/// Puts the items into a new group where the top-most one was. Layers are not grouped. Null when nothing was left to
/// group, and then nothing was changed.
JET_API const Item* groupItems(Transaction& edit, std::span<const Item* const> items);
/// Puts the members of the groups among them where the groups were, and removes the groups. Returns the freed members.
JET_API ItemList ungroupItems(Transaction& edit, std::span<const Item* const> items);

/// Moves items to the top of the next layer above (up) or below the one they are in. Layers themselves and what has no
/// such layer stay. Returns what moved.
JET_API ItemList moveToNextLayer(Transaction& edit, std::span<const Item* const> items, bool up);

}  // namespace jet
