// CommandBar: the commands of a panel with a list or a tree, from one table: buttons below it, its context menu, and
// keys while it has the focus.
#pragma once

#include <jet/version.hpp>

#include <QAbstractItemView>
#include <QWidget>

#include <functional>
#include <vector>

namespace jet::ui {

struct PanelCommand {
    const char* icon = "";  ///< jet/ui/icons.hpp; empty: none
    const char* name = "";  ///< of its button as an object, for tests
    QString text;           ///< tool tip and menu entry
    std::function<void()> run = {};
    std::function<bool()> isEnabled = {};  ///< asked when the menu opens; none: always
    const char* key = "";                  ///< as "Ctrl+D", before the window's; empty: none
    bool onBar = true;
};

/// Put it below `view` in the panel's layout. What the commands throw is theirs to catch. [GUI thread]
class JET_API CommandBar final : public QWidget {
public:
    CommandBar(QAbstractItemView& view, std::vector<PanelCommand> commands, QWidget* parent);
    /// A click on a button gives the view the focus, so that Undo works on its history (jet/ui/history_focus.hpp).
    void setFocusing(bool on) { focusing_ = on; }
    /// Is a name in the view being typed? Then the keys are the line's.
    bool isTyping() const;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void openMenu(const QPoint& at);

    QAbstractItemView& view_;
    std::vector<PanelCommand> commands_;
    bool focusing_ = false;
};

}  // namespace jet::ui
