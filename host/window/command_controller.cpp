#include "window/command_controller.hpp"

#include <QCoreApplication>
#include <QIcon>
#include <QMenuBar>

namespace jet::host {

CommandController::CommandController(Editor& editor, Documents& documents, QObject* parent)
    : QObject(parent), editor_(editor), documents_(documents)
{
}

void CommandController::build(QMenuBar& bar)
{
    qDeleteAll(commands_.keys());  // of plugins as they were before
    commands_.clear();
    for (const Contribution& command : editor_.catalog().contributions(ContributionKind::Command)) {
        const QString path = command.menu.empty() ? tr("Tools") : QString::fromStdString(command.menu);
        QMenu* menu = Actions::menuAt(bar, path);
        QAction* action = menu->addAction(QCoreApplication::translate("Commands", command.label.c_str()));
        if (!command.icon.empty()) action->setIcon(QIcon(QString::fromStdString(command.icon)));
        action->setObjectName(QStringLiteral("command:") + QString::fromStdString(command.id));
        action->setShortcut(QKeySequence::fromString(QString::fromStdString(command.shortcut)));
        connect(action, &QAction::triggered, this, [this, id = command.id] { run(id); });
        connect(menu, &QMenu::aboutToShow, action, [this, menu] { refresh(*menu); });
        // A shortcut must find its entry enabled, whatever the menu showed when it was last open.
        connect(
            menu, &QMenu::aboutToHide, action, [action] { action->setEnabled(true); }, Qt::QueuedConnection);
        commands_.insert(action, command.id);
    }
    // A menu goes with its last command.
    for (QAction* menu : bar.actions())
        if (menu->menu()) menu->setVisible(!menu->menu()->isEmpty());
}

void CommandController::run(const std::string& id)
{
    Command* command = editor_.catalog().command(id);
    if (!command) return editor_.showMissing(ContributionKind::Command, id);
    documents_.commitScripts();
    if (SceneView* view = documents_.currentView()) view->endGesture();
    if (command->isEnabled(editor_)) command->run(editor_);
}

void CommandController::refresh(QMenu& menu)
{
    for (QAction* action : menu.actions()) {
        const auto found = commands_.constFind(action);
        if (found == commands_.constEnd()) continue;
        const Command* command = editor_.catalog().command(*found);
        action->setEnabled(command && command->isEnabled(editor_));
    }
}

}  // namespace jet::host
