#include <jet/ui/command_bar.hpp>
#include <jet/ui/icons.hpp>

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMenu>
#include <QToolButton>

#include <algorithm>

namespace jet::ui {

namespace {

QToolButton* makeButton(const PanelCommand& command, QWidget* parent)
{
    auto* button = new QToolButton(parent);
    button->setAutoRaise(true);
    button->setIcon(icon(command.icon));
    const QString key = QKeySequence(command.key).toString(QKeySequence::NativeText);
    button->setToolTip(key.isEmpty() ? command.text : QStringLiteral("%1 (%2)").arg(command.text, key));
    button->setObjectName(command.name);
    button->setFocusPolicy(Qt::NoFocus);
    return button;
}

}  // namespace

CommandBar::CommandBar(QAbstractItemView& view, std::vector<PanelCommand> commands, QWidget* parent)
    : QWidget(parent), view_(view), commands_(std::move(commands))
{
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(4, 3, 4, 3);
    layout->setSpacing(2);
    for (const PanelCommand& command : commands_) {
        if (!command.onBar) continue;
        QToolButton* button = makeButton(command, this);
        connect(button, &QToolButton::clicked, this, [this, &command] {
            if (focusing_) view_.setFocus();
            command.run();
        });
        layout->addWidget(button);
    }
    layout->addStretch(1);
    view.setContextMenuPolicy(Qt::CustomContextMenu);
    connect(&view, &QWidget::customContextMenuRequested, this, [this](const QPoint& at) { openMenu(at); });
    view.installEventFilter(this);
}

bool CommandBar::isTyping() const
{
    const auto lines = view_.findChildren<QLineEdit*>();
    return std::ranges::any_of(lines, [](const QLineEdit* line) { return line->isVisible(); });
}

void CommandBar::openMenu(const QPoint& at)
{
    QMenu menu(this);
    for (const PanelCommand& command : commands_) {
        QAction* action = menu.addAction(icon(command.icon), command.text, this, [&command] { command.run(); });
        action->setEnabled(!command.isEnabled || command.isEnabled());
        action->setShortcut(QKeySequence(command.key));
    }
    menu.exec(view_.viewport()->mapToGlobal(at));
}

// The keys of the view come before those of the window: Delete is for what has the focus.
bool CommandBar::eventFilter(QObject* watched, QEvent* event)
{
    const bool isKey = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
    if (!isKey || isTyping())  // the line being edited passes on what it did not use, Enter among it
        return QWidget::eventFilter(watched, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    const int code = key->key() == Qt::Key_Enter ? Qt::Key_Return : key->key();
    const QKeySequence keys(static_cast<int>(key->modifiers() & ~Qt::KeypadModifier) | code);
    const auto command = std::ranges::find_if(
        commands_, [&](const PanelCommand& one) { return *one.key != 0 && QKeySequence(one.key) == keys; });
    if (command == commands_.end()) return QWidget::eventFilter(watched, event);
    event->type() == QEvent::KeyPress ? command->run() : event->accept();
    return true;
}

}  // namespace jet::ui
