// CommandController: the menu commands of plugins. Menus are filled from manifests; a library is loaded when one of its
// commands is first run, or its menu first opened.
#pragma once

#include "window/actions.hpp"
#include "window/documents.hpp"

class QMenuBar;

namespace jet::host {

class CommandController final : public QObject {
    Q_OBJECT

public:
    CommandController(Editor& editor, Documents& documents, QObject* parent);

    /// Adds every declared command to the menu its manifest names ("Tools" without one). Called again when plugins were
    /// switched.
    void build(QMenuBar& bar);
    /// Runs a command as its menu entry does: gestures are ended and typing is committed first.
    void run(const std::string& id);

private:
    void refresh(QMenu& menu);

    Editor& editor_;
    Documents& documents_;
    QHash<QAction*, std::string> commands_;  // by menu entry
};

}  // namespace jet::host
