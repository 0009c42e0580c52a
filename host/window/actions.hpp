// Actions: everything a menu, a tool bar or a shortcut can do, as tables of data. Controllers hand in their rows; menus
// and tool bars name them by id.
#pragma once

#include <QAction>
#include <QHash>
#include <QKeySequence>
#include <QMenu>
#include <QObject>
#include <QString>

#include <functional>
#include <span>
#include <vector>

class QMenuBar;
class QToolBar;

namespace jet::host {

/// One row of an action table. Texts are marked with QT_TRANSLATE_NOOP("Actions", ...).
struct ActionSpec {
    const char* id;         ///< "edit.undo"
    const char* text;       ///< "&Undo"
    const char* icon;       ///< of jet::ui::icon(); empty: none
    const char* shortcuts;  ///< "Ctrl+Shift+Z;Ctrl+Y"; empty: none
    std::function<void()> run;
    std::function<bool()> enabled = {};   ///< empty: always
    std::function<bool()> checked = {};   ///< empty: not checkable
    std::function<QString()> label = {};  ///< replaces `text` while it gives something
};

/// A menu as data: ids separated by spaces; "|" is a separator, "@name" a submenu that is filled when it opens.
struct MenuSpec {
    const char* title;
    const char* entries;
};

class Actions final : public QObject {
    Q_OBJECT

public:
    /// Fills a submenu each time it opens.
    using Filler = std::function<void(QMenu& menu)>;
    struct Submenu {
        const char* title;
        const char* icon;
        Filler fill;
    };

    /// `owner` gets the actions, so that their shortcuts work in its window; failures go to `onError`.
    Actions(QWidget* owner, std::function<void(const std::exception&)> onError);

    void add(std::vector<ActionSpec> specs);
    void addSubmenu(const QString& name, Submenu submenu) { submenus_.insert(name, std::move(submenu)); }
    QAction* find(const QString& id) const;

    void buildMenuBar(QMenuBar& bar, std::span<const MenuSpec> menus);
    void buildToolBar(QToolBar& bar, const char* entries) const;
    void fillMenu(QMenu& menu, const char* entries);
    /// Finds the menu of a path like "Edit/Arrange" in the bar, or makes what is missing.
    static QMenu* menuAt(QMenuBar& bar, const QString& path);

    /// Brings enabled, checked and labels up to date at the next turn of the event loop.
    void refreshSoon();
    void refresh();
    /// Runs the enabled action with that shortcut.
    bool trigger(const QKeySequence& keys);

private:
    struct Entry {
        ActionSpec spec;
        QAction* action;
    };

    void run(const ActionSpec& spec);
    QMenu* createSubmenu(const QString& name, QMenu& parent);

    QWidget* owner_;
    std::function<void(const std::exception&)> onError_;
    std::vector<std::unique_ptr<Entry>> entries_;  // stable addresses: connections refer to them
    QHash<QString, Entry*> byId_;
    QHash<QString, Submenu> submenus_;
    bool refreshing_ = false;
};

}  // namespace jet::host
