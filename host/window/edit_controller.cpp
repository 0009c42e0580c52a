#include "window/edit_controller.hpp"

#include "canvas/insertion_point.hpp"
#include "window/picture_import.hpp"
#include "window/scene_clipboard.hpp"

#include <jet/arrange.hpp>
#include <jet/effect.hpp>

#include <QCoreApplication>
#include <QMenu>

namespace jet::host {

namespace {

constexpr double kNudge = 1, kFarNudge = 10;  // scene units
const Vec2 kCopyOffset(10, 10);               // so that a copy does not hide what it was made from

void offset(Transaction& edit, const Item& item) { edit.transform(item, Affine::translation(kCopyOffset)); }

}  // namespace

EditController::EditController(Editor& editor, Documents& documents, QObject* parent)
    : QObject(parent), editor_(editor), documents_(documents), focus_([this] { emit historyChanged(); })
{
}

std::vector<ActionSpec> EditController::actions()
{
    const auto open = [this] { return scene() != nullptr; };
    const auto selected = [this] { return hasSelection(); };
    const auto undoable = [this] {
        const History on = history();
        return on.tree ? on.tree->canUndo() : on.scene && on.scene->canUndo();
    };
    const auto redoable = [this] {
        const History on = history();
        return on.tree ? on.tree->canRedo() : on.scene && on.scene->canRedo();
    };
    const auto labelled = [](const char* prefix, const std::string& what) {
        return what.empty() ? QString()
                            : QCoreApplication::translate("Actions", prefix).arg(QString::fromStdString(what));
    };
    const auto undoLabel = [this, labelled] {
        const History on = history();
        return labelled(QT_TRANSLATE_NOOP("Actions", "&Undo %1"),
                        on.tree ? on.tree->undoLabel() : (on.scene ? on.scene->undoLabel() : std::string()));
    };
    const auto redoLabel = [this, labelled] {
        const History on = history();
        return labelled(QT_TRANSLATE_NOOP("Actions", "&Redo %1"),
                        on.tree ? on.tree->redoLabel() : (on.scene ? on.scene->redoLabel() : std::string()));
    };
    return {
        {"edit.undo",
         QT_TRANSLATE_NOOP("Actions", "&Undo"),
         "undo",
         "Ctrl+Z",
         [this] { undo(); },
         undoable,
         {},
         undoLabel},
        {"edit.redo",
         QT_TRANSLATE_NOOP("Actions", "&Redo"),
         "redo",
         "Ctrl+Shift+Z;Ctrl+Y",
         [this] { redo(); },
         redoable,
         {},
         redoLabel},
        {"edit.cut", QT_TRANSLATE_NOOP("Actions", "Cu&t"), "cut", "Ctrl+X", [this] { cut(); }, selected},
        {"edit.copy", QT_TRANSLATE_NOOP("Actions", "&Copy"), "copy", "Ctrl+C", [this] { copy(); }, selected},
        {"edit.paste", QT_TRANSLATE_NOOP("Actions", "&Paste"), "paste", "Ctrl+V", [this] { paste(false); }, open},
        {"edit.paste-in-place", QT_TRANSLATE_NOOP("Actions", "Paste in p&lace"), "paste", "Ctrl+Shift+V",
         [this] { paste(true); }, open},
        {"edit.delete", QT_TRANSLATE_NOOP("Actions", "&Delete"), "trash", "Del", [this] { remove(); }, selected},
        {"edit.duplicate", QT_TRANSLATE_NOOP("Actions", "D&uplicate"), "duplicate", "Ctrl+D", [this] { duplicate(); },
         selected},
        {"edit.select-all", QT_TRANSLATE_NOOP("Actions", "Select &all"), "", "Ctrl+A", [this] { selectAll(); }, open},
        {"edit.group", QT_TRANSLATE_NOOP("Actions", "&Group"), "group", "Ctrl+G", [this] { group(); }, selected},
        {"edit.ungroup", QT_TRANSLATE_NOOP("Actions", "U&ngroup"), "ungroup", "Ctrl+Shift+G", [this] { ungroup(); },
         selected},
    };
}

Scene* EditController::scene() const
{
    Scene* front = documents_.currentScene();
    const bool playing = front && editor_.simulation().state() != SimulationCenter::State::Stopped &&
                         documents_.currentView() && editor_.simulation().scene() == front;
    return playing ? nullptr : front;
}

bool EditController::hasSelection() const { return scene() && !scene()->items().selection().empty(); }

Scene& EditController::readyScene() const
{
    documents_.commitScripts();
    if (SceneView* view = documents_.currentView()) view->endGesture();
    return *scene();
}

EditController::History EditController::history() const
{
    if (const auto focus = focus_.now()) {
        if (!focus->scene) return {&editor_.projectTree(), nullptr};
        const auto all = editor_.project().scenes();
        if (std::find(all.begin(), all.end(), focus->scene) != all.end()) return {nullptr, &focus->scene->undoRedo()};
    }
    Scene* front = scene();
    return {nullptr, front ? &front->undoRedo() : nullptr};
}

void EditController::undo()
{
    documents_.commitScripts();
    if (SceneView* view = documents_.currentView()) view->endGesture();
    const History on = history();
    if (on.tree) on.tree->undo();
    if (on.scene) on.scene->undo();
}

void EditController::redo()
{
    documents_.commitScripts();
    if (SceneView* view = documents_.currentView()) view->endGesture();
    const History on = history();
    if (on.tree) on.tree->redo();
    if (on.scene) on.scene->redo();
}

// --- clipboard

void EditController::copy() { copyToClipboard(topSelection(readyScene()), *scene()); }

void EditController::cut()
{
    copy();
    Scene& front = readyScene();
    auto edit = front.items().begin("Cut");
    for (const Item* item : topSelection(front)) edit.remove(*item);
    edit.commit();
}

void EditController::paste(bool inPlace)
{
    Scene& front = readyScene();
    EventsCenter quiet;  // the clipboard's scene is nobody's business
    const std::unique_ptr<Scene> clips = sceneOnClipboard(quiet, editor_.catalog());
    if (!clips) {
        const SceneView* view = documents_.viewOf(front);
        pastePicture(editor_, front, view ? view->sceneCentre() : QPointF());
        return;
    }
    auto edit = front.items().begin("Paste");
    const Item& place = insertionPoint(editor_, front, edit);
    std::vector<ItemId> pasted;
    for (const auto& clip : clips->root().children()) {
        // A layer goes beside layers, everything else into the place for new items.
        const Item& copy = edit.addCopy(*clip, clip->is<LayerItem>() ? front.root() : place);
        if (!inPlace) offset(edit, copy);
        pasted.push_back(copy.id());
    }
    edit.setSelection(std::move(pasted));
    edit.commit();
}

void EditController::remove()
{
    Scene& front = readyScene();
    auto edit = front.items().begin("Delete");
    for (const Item* item : topSelection(front)) edit.remove(*item);
    edit.commit();
}

void EditController::duplicate()
{
    Scene& front = readyScene();
    auto edit = front.items().begin("Duplicate");
    std::vector<ItemId> copies;
    for (const Item* item : topSelection(front)) {
        const Item& copy = edit.addCopy(*item, *item->parent(), item->index() + 1);
        offset(edit, copy);
        copies.push_back(copy.id());
    }
    edit.setSelection(std::move(copies));
    edit.commit();
}

// --- selection and groups

void EditController::selectAll()
{
    Scene& front = readyScene();
    front.items().setSelection(selectableItems(front));
}

void EditController::group()
{
    Scene& front = readyScene();
    auto edit = front.items().begin("Group");
    const Item* made = groupItems(edit, topSelection(front));
    if (!made) return editor_.showMessage(tr("Layers cannot be grouped. Select items inside of them.").toStdString());
    edit.select(*made);
    edit.commit();
}

void EditController::ungroup()
{
    Scene& front = readyScene();
    auto edit = front.items().begin("Ungroup");
    const ItemList freed = ungroupItems(edit, topSelection(front));
    if (freed.empty()) return;  // leaving without commit: nothing happened
    std::vector<ItemId> ids;
    for (const Item* item : freed) ids.push_back(item->id());
    edit.setSelection(std::move(ids));
    edit.commit();
}

bool EditController::nudge(int key, bool far)
{
    if (!hasSelection()) return false;
    const double by = far ? kFarNudge : kNudge;
    Vec2 move(0, 0);
    switch (key) {
    case Qt::Key_Left: move.x() = -by; break;
    case Qt::Key_Right: move.x() = by; break;
    case Qt::Key_Up: move.y() = -by; break;
    case Qt::Key_Down: move.y() = by; break;
    default: return false;
    }
    Scene& front = readyScene();
    auto edit = front.items().begin("Move");
    std::string key_ = "nudge";
    for (const Item* item : topSelection(front)) {
        edit.transform(*item, Affine::translation(move));
        key_ += ' ' + std::to_string(item->id().value);
    }
    edit.commit(key_);
    return true;
}

// --- effects

void EditController::fillEffectsMenu(QMenu& menu)
{
    for (const Contribution& effect : editor_.catalog().contributions(ContributionKind::Effect)) {
        QAction* action = menu.addAction(QCoreApplication::translate("Effects", effect.label.c_str()));
        action->setEnabled(hasSelection());
        connect(action, &QAction::triggered, this, [this, id = effect.id] { applyEffect(id); });
    }
    if (menu.isEmpty()) menu.addAction(tr("No effects are installed"))->setEnabled(false);
}

void EditController::applyEffect(const std::string& id)
{
    const Effect* effect = editor_.catalog().effect(id);
    if (!effect) return editor_.showMissing(ContributionKind::Effect, id);
    Scene& front = readyScene();
    try {
        auto edit = front.items().begin("Apply effect");
        std::string refused;
        for (const Item* item : topSelection(front)) {
            std::string why = effect->rejects(*item);
            if (why.empty())
                edit.addEffect(*item, id);
            else
                refused = item->name() + ": " + why;
        }
        if (!refused.empty()) editor_.showMessage(refused);
        edit.commit();
    } catch (const std::exception& problem) {
        editor_.showMessage(problem.what());
    }
}

}  // namespace jet::host
