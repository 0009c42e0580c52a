// Selection tool (thesis §3.5.1.1): selects items by a click or a rubber band, moves, scales, rotates, duplicates and
// deletes what is selected. Each gesture runs in one open transaction that starts afresh with every move of the
// pointer, so nothing drifts, and Esc brings everything back.
#include "handles.hpp"

#include <jet/plugin.hpp>
#include <jet/tool_view.hpp>

#include <algorithm>
#include <numbers>
#include <optional>

namespace {

using jet::Item;
using jet::ItemId;
using jet::Vec2;
using jet::selection::Frame;
using jet::selection::Handle;

constexpr double kNear = 5;        // pixels: how near to an outline a click selects it (the thesis's minSelectionDist)
constexpr double kDragBegins = 3;  // pixels: less is a click with a shaky hand
constexpr double kNudge = 1, kLongNudge = 10, kDuplicateOffset = 10;  // scene units

std::string shortText(double value) { return jet::numberText(std::round(value * 100) / 100); }

class SelectionTool final : public jet::Tool {
public:
    using Tool::Tool;

    void activate() override { host().setCursor("arrow"); }
    void press(const jet::PointerEvent& e) override;
    void drag(const jet::PointerEvent& e) override;
    void release(const jet::PointerEvent& e) override;
    void move(const jet::PointerEvent& e) override;
    void doubleClick(const jet::PointerEvent& e) override;
    bool keyPress(const jet::KeyEvent& e) override;
    bool keyRelease(const jet::KeyEvent& e) override { return mode_ != Mode::None && holdModifier(e.key, false); }
    bool cancel() override;
    void paint(jet::Painter& painter) const override;

private:
    // The thesis's modes, with the press that may become a drag, and with rotation.
    enum class Mode { None, PressItem, SelectItemsInRect, Drag, Scale, Rotate };

    jet::ItemsCenter& items() const { return host().items(); }

    // What is under the pointer.
    const Item* itemAt(const jet::PointerEvent& e) const;
    const Item& targetOf(const Item& leaf) const;
    Handle handleAt(const Vec2& p) const;

    // What is selected.
    std::vector<const Item*> chosen() const;
    jet::Box chosenBounds() const;
    const Item* targetAt(const jet::PointerEvent& e);
    void pressItem(const Item& target, bool shift);
    void click();
    void editInside(const Item& item, const jet::PointerEvent& click);
    void toggle(ItemId id);

    // The gesture under way.
    void update();
    void updateBand();
    void updateDrag();
    void updateTransform(const char* label, const jet::Affine& matrix);
    void reopen(const char* label);
    void finish();
    bool holdModifier(const std::string& key, bool down);

    // Keys.
    bool nudge(const Vec2& by);
    bool removeChosen();
    bool duplicateChosen();
    bool leave();

    void paintOutlines(jet::Painter& painter, const jet::Pen& pen) const;

    Mode mode_ = Mode::None;
    jet::PointerEvent start_, last_;  // of the gesture
    bool moved_ = false;              // beyond kDragBegins
    std::vector<ItemId> before_;      // selection when the gesture began
    std::vector<ItemId> subjects_;    // what the gesture moves
    bool wasSelected_ = false;        // was the pressed item selected before?
    Handle handle_ = Handle::None;    // Mode::Scale
    jet::Box box_;                    // bounds of the subjects when the gesture began
    jet::Affine matrix_;              // what the gesture does to them now
    std::optional<jet::Transaction> edit_;
    std::string label_;  // of edit_
    ItemId entered_;     // the group whose members are selected singly
};

// --- Under the pointer ---

const Item* SelectionTool::itemAt(const jet::PointerEvent& e) const
{
    return items().itemAt(e.scene, kNear / host().pixelsPerUnit());
}

/// The outermost group below a layer, or below the entered group; the item itself when it is in none.
const Item& SelectionTool::targetOf(const Item& leaf) const
{
    const Item* target = &leaf;
    for (const Item* up = leaf.parent(); up && up->parent() && up->is<jet::GroupItem>() && up->id() != entered_;
         up = up->parent())
        target = up;
    return *target;
}

Handle SelectionTool::handleAt(const Vec2& p) const
{
    const jet::Box box = chosenBounds();
    return box.isNull() ? Handle::None : Frame(box, host().pixelsPerUnit()).handleAt(p);
}

// --- Selected ---

/// The selected items that may be changed, without those that go along with a selected ancestor.
std::vector<const Item*> SelectionTool::chosen() const
{
    std::vector<ItemId> sorted = items().selection();  // there may be thousands
    std::sort(sorted.begin(), sorted.end());
    const auto isSelected = [&](const Item& item) {
        return std::binary_search(sorted.begin(), sorted.end(), item.id());
    };
    std::vector<const Item*> found;
    for (const ItemId id : items().selection()) {
        const Item* item = items().find(id);
        if (!item || !item->editable()) continue;
        const Item* up = item->parent();
        while (up && !isSelected(*up)) up = up->parent();
        if (!up) found.push_back(item);
    }
    return found;
}

jet::Box SelectionTool::chosenBounds() const
{
    jet::Box box;
    for (const Item* item : chosen())
        if (item->shown()) box.extend(item->bounds());
    return box;
}

void SelectionTool::toggle(ItemId id)
{
    std::vector<ItemId> selection = items().selection();
    if (std::erase(selection, id) == 0) selection.push_back(id);
    items().setSelection(std::move(selection));
}

// --- Pointer ---

void SelectionTool::press(const jet::PointerEvent& e)
{
    if (e.button != jet::PointerButton::Left) return;
    cancel();
    start_ = last_ = e;
    moved_ = false;
    matrix_ = {};
    before_ = items().selection();
    handle_ = handleAt(e.scene);
    if (handle_ != Handle::None) {
        mode_ = handle_ == Handle::Rotate ? Mode::Rotate : Mode::Scale;
    } else if (const Item* target = targetAt(e)) {
        pressItem(*target, e.modifiers.shift);
    } else {
        mode_ = Mode::SelectItemsInRect;
    }
    subjects_.clear();
    for (const Item* item : chosen()) subjects_.push_back(item->id());
    box_ = chosenBounds();
    host().requestRepaint();
}

/// What a press there is about: the group of the item there, with Ctrl the item itself; null on empty ground. Leaves
/// the entered group when it is elsewhere.
const Item* SelectionTool::targetAt(const jet::PointerEvent& e)
{
    const Item* leaf = itemAt(e);
    const Item* entered = items().find(entered_);
    if (leaf && !(entered && entered->isAncestorOf(*leaf))) entered_ = {};
    if (!leaf || e.modifiers.control) return leaf;
    return &targetOf(*leaf);
}

/// Selects at once, so that a drag moves what was pressed. What a click means for a selected item shows on release.
void SelectionTool::pressItem(const Item& target, bool shift)
{
    mode_ = Mode::PressItem;
    wasSelected_ = items().isSelected(target.id());
    if (wasSelected_) return;
    if (shift) {
        toggle(target.id());
    } else {
        items().setSelection({target.id()});
    }
}

void SelectionTool::drag(const jet::PointerEvent& e)
{
    last_ = e;
    moved_ = moved_ || (e.pixels - start_.pixels).norm() >= kDragBegins;
    if (!moved_) return;
    if (mode_ == Mode::PressItem) {
        mode_ = Mode::Drag;
        host().setCursor("move");
    }
    update();
}

void SelectionTool::release(const jet::PointerEvent& e)
{
    if (mode_ == Mode::None) return;
    if (e.scene != last_.scene) drag(e);
    if (!moved_) {
        click();
    } else if (edit_ && edit_->isOpen()) {
        edit_->commit();
    }
    finish();
}

/// A press and release in one place, be it on a handle: selects what is there.
void SelectionTool::click()
{
    const bool shift = start_.modifiers.shift;
    const Item* target = targetAt(start_);
    if (mode_ == Mode::PressItem && !wasSelected_) return;  // the press did it
    if (target && shift) {
        toggle(target->id());
    } else if (target) {
        items().setSelection({target->id()});
    } else if (!shift) {
        items().setSelection({});
        entered_ = {};
    }
}

void SelectionTool::move(const jet::PointerEvent& e)
{
    const Handle handle = handleAt(e.scene);
    if (handle != Handle::None) {
        host().setCursor(jet::selection::cursorOf(handle));
    } else {
        host().setCursor(itemAt(e) ? "move" : "arrow");
    }
}

/// Goes on with the tool that edits what is in an item, where it was clicked.
void SelectionTool::editInside(const Item& item, const jet::PointerEvent& click)
{
    const bool isText = item.is<jet::TextItem>();
    const char* tool = isText ? "text-tool" : "direct-selection";
    jet::ToolView* view = jet::toolView(host());
    if (!view) return host().switchTool(tool);
    if (isText ? view->handOver(tool, click) : view->hasTool(tool)) {
        if (!isText) host().switchTool(tool);
        return;
    }
    host().showStatus(isText ? "No text tool is installed: the Inspector edits the text."
                             : "No tool that edits the points of a path is installed.");
}

/// Enters the group under the pointer and selects the member there; of a single item, goes on to edit its nodes.
void SelectionTool::doubleClick(const jet::PointerEvent& e)
{
    const Item* leaf = itemAt(e);
    if (!leaf) return;
    const Item& target = targetOf(*leaf);
    if (!target.is<jet::GroupItem>()) return editInside(target, e);
    entered_ = target.id();
    items().setSelection({targetOf(*leaf).id()});
    host().showStatus("In group " + target.name() + ". Esc leaves it.");
    host().requestRepaint();
}

// --- The gesture under way ---

void SelectionTool::update()
{
    switch (mode_) {
    case Mode::SelectItemsInRect: updateBand(); break;
    case Mode::Drag: updateDrag(); break;
    case Mode::Scale: {
        updateTransform("Scale", jet::selection::scaled(box_, handle_, last_.scene - start_.scene, last_.modifiers));
        const Vec2 size = chosenBounds().size();
        host().showStatus(shortText(size.x()) + " × " + shortText(size.y()));
        break;
    }
    case Mode::Rotate: {
        const double angle = jet::selection::dragAngle(box_.center(), start_.scene, last_.scene, last_.modifiers);
        updateTransform("Rotate", jet::selection::rotated(angle, box_.center()));
        host().showStatus(shortText(angle * 180 / std::numbers::pi) + "°");
        break;
    }
    default: break;
    }
    host().requestRepaint();
}

/// Selects what lies wholly in the rubber band; with Shift, in addition to what was selected.
void SelectionTool::updateBand()
{
    const jet::Box band(start_.scene, last_.scene);
    std::vector<ItemId> found;
    if (last_.modifiers.shift) found = before_;
    const Item* entered = items().find(entered_);
    for (const Item* leaf : items().itemsIn(band)) {
        if (entered && !entered->isAncestorOf(*leaf)) continue;
        const Item& target = targetOf(*leaf);
        if (band.contains(target.bounds())) found.push_back(target.id());
    }
    items().setSelection(std::move(found));
}

void SelectionTool::updateDrag()
{
    Vec2 by = last_.scene - start_.scene;
    if (last_.modifiers.shift) (std::abs(by.x()) < std::abs(by.y()) ? by.x() : by.y()) = 0;
    host().showStatus(shortText(by.x()) + ", " + shortText(by.y()));
    if (!last_.modifiers.alt) return updateTransform("Move", jet::Affine::translation(by));

    reopen("Duplicate");
    std::vector<ItemId> copies;
    for (const ItemId id : subjects_) {
        const Item* item = items().find(id);
        if (!item) continue;
        const Item& copy = edit_->addCopy(*item, *item->parent(), item->index() + 1);
        edit_->transform(copy, jet::Affine::translation(by));
        copies.push_back(copy.id());
    }
    edit_->setSelection(std::move(copies));
}

void SelectionTool::updateTransform(const char* label, const jet::Affine& matrix)
{
    reopen(label);
    matrix_ = matrix;
    for (const ItemId id : subjects_)
        if (const Item* item = items().find(id)) edit_->transform(*item, matrix);
}

/// A transaction of that label in which nothing has happened yet.
void SelectionTool::reopen(const char* label)
{
    if (edit_ && edit_->isOpen() && label_ == label) return edit_->restart();
    edit_.reset();
    label_ = label;
    edit_.emplace(items().begin(label));
}

void SelectionTool::finish()
{
    edit_.reset();
    mode_ = Mode::None;
    host().showStatus("");
    host().requestRepaint();
}

bool SelectionTool::cancel()
{
    if (mode_ == Mode::None) return false;
    finish();  // rolls back
    items().setSelection(before_);
    host().setCursor("arrow");
    return true;
}

/// Modifiers also count when they are pressed or let go while the pointer rests.
bool SelectionTool::holdModifier(const std::string& key, bool down)
{
    if (key == "Shift") {
        last_.modifiers.shift = down;
    } else if (key == "Alt") {
        last_.modifiers.alt = down;
    } else {
        return false;
    }
    if (moved_) update();
    return true;
}

// --- Keys ---

bool SelectionTool::keyPress(const jet::KeyEvent& e)
{
    if (mode_ != Mode::None) {  // only what concerns the gesture may happen now
        if (e.key == "Escape") return cancel();
        holdModifier(e.key, true);
        return true;
    }
    const double step = e.modifiers.shift ? kLongNudge : kNudge;
    if (e.modifiers.control) return e.key == "D" && duplicateChosen();
    if (e.key == "Left") return nudge({-step, 0});
    if (e.key == "Right") return nudge({step, 0});
    if (e.key == "Up") return nudge({0, -step});
    if (e.key == "Down") return nudge({0, step});
    if (e.key == "Delete" || e.key == "Backspace") return removeChosen();
    return e.key == "Escape" && leave();
}

/// Nudges of the same items in a row are one undo step.
bool SelectionTool::nudge(const Vec2& by)
{
    const auto subjects = chosen();
    if (subjects.empty()) return false;
    std::string mergeKey = "org.jet.tool.selection.nudge";
    auto edit = items().begin("Nudge");
    for (const Item* item : subjects) {
        edit.transform(*item, jet::Affine::translation(by));
        mergeKey += " " + std::to_string(item->id().value);
    }
    edit.commit(mergeKey);
    host().requestRepaint();
    return true;
}

bool SelectionTool::removeChosen()
{
    const auto subjects = chosen();
    if (subjects.empty()) return false;
    auto edit = items().begin("Delete");
    for (const Item* item : subjects) edit.remove(*item);
    edit.commit();
    host().requestRepaint();
    return true;
}

bool SelectionTool::duplicateChosen()
{
    const auto subjects = chosen();
    if (subjects.empty()) return false;
    auto edit = items().begin("Duplicate");
    std::vector<ItemId> copies;
    for (const Item* item : subjects) {
        const Item& copy = edit.addCopy(*item, *item->parent(), item->index() + 1);
        edit.transform(copy, jet::Affine::translation({kDuplicateOffset, kDuplicateOffset}));
        copies.push_back(copy.id());
    }
    edit.setSelection(std::move(copies));
    edit.commit();
    host().requestRepaint();
    return true;
}

/// Leaves the entered group, else clears the selection.
bool SelectionTool::leave()
{
    if (const Item* entered = items().find(entered_)) {
        items().setSelection({entered->id()});
    } else if (!items().selection().empty()) {
        items().setSelection({});
    } else {
        return false;
    }
    entered_ = {};
    host().showStatus("");
    host().requestRepaint();
    return true;
}

// --- Painting ---

void SelectionTool::paint(jet::Painter& painter) const
{
    const jet::Pen pen = host().layerPen();
    jet::Pen dashed = pen;
    dashed.dashes = {4, 3};
    paintOutlines(painter, pen);
    if (const Item* entered = items().find(entered_)) painter.stroke(jet::Path::rectangle(entered->bounds()), dashed);

    if (mode_ == Mode::SelectItemsInRect) {
        if (!moved_) return;
        const jet::Path band = jet::Path::rectangle(jet::Box(start_.scene, last_.scene));
        jet::Color veil = pen.color;
        veil.a = 32;
        painter.fill(band, veil);
        painter.stroke(band, pen);
    } else if (mode_ == Mode::Scale || mode_ == Mode::Rotate) {
        painter.stroke(jet::Path::rectangle(box_).transformed(matrix_), dashed);
    } else if (const jet::Box box = chosenBounds(); mode_ != Mode::Drag && !box.isNull()) {
        Frame(box, painter.pixelsPerUnit()).paint(painter, pen);
    }
}

void SelectionTool::paintOutlines(jet::Painter& painter, const jet::Pen& pen) const
{
    for (const ItemId id : items().selection()) {
        const Item* selected = items().find(id);
        if (!selected || !selected->shown()) continue;
        selected->walk([&](const Item& item) {
            if (!item.visible()) return false;
            if (!item.path().isEmpty()) painter.stroke(item.path(), pen);
            return true;
        });
    }
}

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<SelectionTool>("selection"); }
