#include "window/actions.hpp"

#include <jet/ui/icons.hpp>

#include <QCoreApplication>
#include <QMenuBar>
#include <QTimer>
#include <QToolBar>
#include <QWidget>

namespace jet::host {

namespace {

QList<QKeySequence> shortcutsOf(const char* text)
{
    QList<QKeySequence> keys;
    for (const QString& part : QString::fromLatin1(text).split(QLatin1Char(';'), Qt::SkipEmptyParts)) {
        keys << QKeySequence::fromString(part, QKeySequence::PortableText);
    }
    return keys;
}

QString plainText(const QString& text) { return QString(text).remove(QLatin1Char('&')).remove(QStringLiteral("…")); }

QString toolTipOf(const QAction& action)
{
    const QString text = plainText(action.text());
    return action.shortcut().isEmpty()
               ? text
               : QStringLiteral("%1 (%2)").arg(text, action.shortcut().toString(QKeySequence::NativeText));
}

}  // namespace

Actions::Actions(QWidget* owner, std::function<void(const std::exception&)> onError)
    : QObject(owner), owner_(owner), onError_(std::move(onError))
{
}

void Actions::add(std::vector<ActionSpec> specs)
{
    for (ActionSpec& spec : specs) {
        auto* action = new QAction(QCoreApplication::translate("Actions", spec.text), this);
        if (*spec.icon) action->setIcon(ui::icon(spec.icon));
        action->setShortcuts(shortcutsOf(spec.shortcuts));
        action->setCheckable(static_cast<bool>(spec.checked));
        action->setToolTip(toolTipOf(*action));
        owner_->addAction(action);
        entries_.push_back(std::make_unique<Entry>(Entry{std::move(spec), action}));
        Entry* entry = entries_.back().get();
        byId_.insert(QLatin1String(entry->spec.id), entry);
        connect(action, &QAction::triggered, this, [this, entry] { run(entry->spec); });
    }
}

void Actions::run(const ActionSpec& spec)
{
    // A shortcut may arrive before the refresh that would have disabled it.
    if (!spec.enabled || spec.enabled()) {
        try {
            spec.run();
        } catch (const std::exception& problem) {
            onError_(problem);
        }
    }
    refreshSoon();
}

QAction* Actions::find(const QString& id) const
{
    Entry* entry = byId_.value(id);
    return entry ? entry->action : nullptr;
}

void Actions::buildMenuBar(QMenuBar& bar, std::span<const MenuSpec> menus)
{
    for (const MenuSpec& spec : menus) {
        QMenu* menu = bar.addMenu(QCoreApplication::translate("Actions", spec.title));
        connect(menu, &QMenu::aboutToShow, this, &Actions::refresh);
        fillMenu(*menu, spec.entries);
    }
}

void Actions::fillMenu(QMenu& menu, const char* entries)
{
    for (const QString& entry : QString::fromLatin1(entries).split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
        if (entry == QLatin1String("|")) {
            menu.addSeparator();
        } else if (entry.startsWith(QLatin1Char('@'))) {
            if (QMenu* submenu = createSubmenu(entry.mid(1), menu)) menu.addMenu(submenu);
        } else if (QAction* action = find(entry)) {
            menu.addAction(action);
        }
    }
}

QMenu* Actions::createSubmenu(const QString& name, QMenu& parent)
{
    const auto found = submenus_.constFind(name);
    if (found == submenus_.constEnd()) return nullptr;
    auto* submenu = new QMenu(QCoreApplication::translate("Actions", found->title), &parent);
    if (*found->icon) submenu->setIcon(ui::icon(found->icon));
    connect(submenu, &QMenu::aboutToShow, this, [submenu, fill = found->fill] {
        submenu->clear();
        fill(*submenu);
    });
    return submenu;
}

void Actions::buildToolBar(QToolBar& bar, const char* entries) const
{
    for (const QString& entry : QString::fromLatin1(entries).split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
        if (entry == QLatin1String("|")) {
            bar.addSeparator();
        } else if (QAction* action = find(entry)) {
            bar.addAction(action);
        }
    }
}

QMenu* Actions::menuAt(QMenuBar& bar, const QString& path)
{
    QMenu* menu = nullptr;
    for (const QString& title : path.split(QLatin1Char('/'), Qt::SkipEmptyParts)) {
        const QList<QAction*> actions = menu ? menu->actions() : bar.actions();
        QMenu* next = nullptr;
        for (const QAction* action : actions) {
            if (action->menu() && plainText(action->text()) == title) next = action->menu();
        }
        if (!next) next = menu ? menu->addMenu(title) : bar.addMenu(title);
        menu = next;
    }
    return menu;
}

void Actions::refreshSoon()
{
    if (refreshing_) return;
    refreshing_ = true;
    QTimer::singleShot(0, this, [this] { refresh(); });
}

void Actions::refresh()
{
    refreshing_ = false;
    for (const auto& entry : entries_) {
        const ActionSpec& spec = entry->spec;
        if (spec.enabled) entry->action->setEnabled(spec.enabled());
        if (spec.checked) entry->action->setChecked(spec.checked());
        if (!spec.label) continue;
        const QString label = spec.label();
        entry->action->setText(label.isEmpty() ? QCoreApplication::translate("Actions", spec.text) : label);
        entry->action->setToolTip(toolTipOf(*entry->action));
    }
}

bool Actions::trigger(const QKeySequence& keys)
{
    for (const auto& entry : entries_) {
        if (!entry->action->shortcuts().contains(keys)) continue;
        run(entry->spec);
        return true;
    }
    return false;
}

}  // namespace jet::host
