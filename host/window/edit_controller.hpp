// EditController: undo, the clipboard, grouping and the other commands of the Edit and Effects menus.
#pragma once

#include "window/actions.hpp"
#include "window/documents.hpp"

#include <jet/project_tree.hpp>
#include <jet/ui/history_focus.hpp>

namespace jet::host {

class EditController final : public QObject {
    Q_OBJECT

public:
    EditController(Editor& editor, Documents& documents, QObject* parent);

    std::vector<ActionSpec> actions();
    /// "Apply effect": the declared effects; choosing one applies it to the selection.
    void fillEffectsMenu(QMenu& menu);
    /// Arrow keys move the selection by 1, with Shift by 10 scene units.
    bool nudge(int key, bool far);

    void applyEffect(const std::string& effect);

signals:
    /// Another history may be what Undo works on.
    void historyChanged();

private:
    /// The front scene, if it may be edited now.
    Scene* scene() const;
    bool hasSelection() const;
    /// The front scene with gestures ended and typing committed, ready for a transaction.
    Scene& readyScene() const;

    /// What Undo works on: the history of the panel that has the focus (jet/ui/history_focus.hpp), else that of the
    /// front scene. At most one of the two is set.
    struct History {
        ProjectTree* tree = nullptr;
        UndoRedoCenter* scene = nullptr;
    };
    History history() const;
    void undo();
    void redo();
    void copy();
    void cut();
    /// Into the place for new items, a little aside; in place: where the items were.
    void paste(bool inPlace);
    void remove();
    void duplicate();
    void selectAll();
    void group();
    void ungroup();

    Editor& editor_;
    Documents& documents_;
    ui::HistoryFocusWatch focus_;
};

}  // namespace jet::host
