#include "set_chooser.hpp"

#include "plugin_table.hpp"

#include <QInputDialog>
#include <QSignalBlocker>
#include <QStandardItemModel>

#include <algorithm>

namespace jet::plugins {

namespace {

QString textOf(const PluginSetInfo& set)
{
    const QString title = QString::fromStdString(set.title);
    if (!set.problem.empty()) return translated("%1 (cannot be read)").arg(title);
    if (set.missing.empty()) return QStringLiteral("%1 (%2)").arg(title).arg(set.plugins);
    return translated("%1 (%2, misses %3)").arg(title).arg(set.plugins).arg(set.missing.size());
}

QString toolTipOf(const PluginSetInfo& set)
{
    QString text = QString::fromStdString(set.problem.empty() ? set.description : set.problem);
    if (!set.source.empty())
        text += (text.isEmpty() ? "" : "\n") + translated("From: %1").arg(QString::fromStdString(set.source));
    if (!set.file.empty()) text += QStringLiteral(", ") + QString::fromStdString(set.file.string());
    for (const std::string& missing : set.missing)
        text += QLatin1Char('\n') + translated("Missing: %1").arg(QString::fromStdString(missing));
    return text;
}

}  // namespace

SetChooser::SetChooser(Editor& editor, QWidget* parent)
    : QComboBox(parent), askName([this](const QString& proposed) {
          return QInputDialog::getText(this, translated("Save plugins as a set"),
                                       translated("Name of the set of all plugins that are in use now:"),
                                       QLineEdit::Normal, proposed);
      }),
      editor_(editor)
{
    setObjectName("pluginSet");
    setToolTip(translated("Which plugins are used: all, or those of a set"));
    setSizeAdjustPolicy(QComboBox::AdjustToContents);
    connect(this, &QComboBox::activated, this, &SetChooser::choose);
    refresh();
}

void SetChooser::addSet(const PluginSetInfo& set)
{
    addItem(textOf(set));
    setItemData(count() - 1, toolTipOf(set), Qt::ToolTipRole);
    if (set.problem.empty()) return;
    if (auto* items = qobject_cast<QStandardItemModel*>(model())) items->item(count() - 1)->setEnabled(false);
}

void SetChooser::refresh()
{
    const QSignalBlocker quiet(this);
    sets_ = editor_.plugins().sets();
    clear();
    setVisible(!sets_.empty());
    if (sets_.empty()) return;
    for (const PluginSetInfo& set : sets_) addSet(set);
    insertSeparator(count());
    addItem(translated("Save current as set…"));
    const auto used = std::find_if(sets_.begin(), sets_.end(), [](const auto& set) { return set.inUse; });
    // A set that was changed or removed on the disk meanwhile stays in use, and has no row.
    setCurrentIndex(used == sets_.end() ? -1 : static_cast<int>(used - sets_.begin()));
}

void SetChooser::choose(int row)
{
    const auto index = static_cast<std::size_t>(row);
    if (index < sets_.size()) return use(sets_[index].name);
    save();
    refresh();  // the row that was chosen is no set
}

void SetChooser::use(const std::string& name)
{
    const auto change = editor_.plugins().useSet(name);
    refresh();
    if (onChange) onChange(change);
}

void SetChooser::save()
{
    const QString name = askName(QString()).trimmed();
    if (name.isEmpty()) return;
    const auto exists = std::any_of(sets_.begin(), sets_.end(), [&](const PluginSetInfo& set) {
        return set.source == "user" && set.name == name.toStdString();
    });
    const auto saved = editor_.plugins().saveSet(name.toStdString());
    refresh();
    if (!onChange) return;
    if (!saved) return onChange(saved.error());
    PluginChange change;
    change.message = (exists ? translated("The plugin set “%1” is replaced: %2 plugins, in %3.")
                             : translated("The plugin set “%1” is saved: %2 plugins, in %3."))
                         .arg(name)
                         .arg(saved->plugins)
                         .arg(QString::fromStdString(saved->file.string()))
                         .toStdString();
    onChange(change);
}

}  // namespace jet::plugins
