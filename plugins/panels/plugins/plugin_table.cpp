#include "plugin_table.hpp"

#include <QApplication>
#include <QBrush>
#include <QColor>
#include <QCoreApplication>
#include <QPalette>

#include <algorithm>

namespace jet::plugins {

QString translated(const char* text) { return QCoreApplication::translate("PluginsPanel", text); }

QString sizeText(std::uint64_t bytes)
{
    if (bytes == 0) return {};
    if (bytes < 1024 * 1024) return QStringLiteral("%1 kB").arg(bytes / 1024);
    return QStringLiteral("%1 MB").arg(static_cast<double>(bytes) / (1024 * 1024), 0, 'f', 1);
}

QString stateText(const PluginInfo& plugin)
{
    switch (plugin.state) {
    case PluginState::Disabled: return translated("switched off");
    case PluginState::Shadowed: return translated("shadowed");
    case PluginState::Faulted: return translated("faulted");
    case PluginState::Active: return translated("in use");
    case PluginState::Loaded: return translated("loaded");
    default: return translated("ready");
    }
}

double totalMs(const PluginInfo& plugin)
{
    double sum = 0;
    for (const CallbackCost& cost : plugin.callbacks) sum += cost.totalMs;
    return sum;
}

namespace {

QString milliseconds(double ms)
{
    return ms > 0 ? QStringLiteral("%1 ms").arg(ms, 0, 'f', ms < 10 ? 2 : 0) : QString();
}

QString textOf(const PluginInfo& plugin, int column)
{
    switch (column) {
    case PluginTable::Name: return QString::fromStdString(plugin.name);
    case PluginTable::Version: return QString::fromStdString(plugin.version);
    case PluginTable::State: return stateText(plugin);
    case PluginTable::Load: return milliseconds(plugin.loadMs);
    case PluginTable::Time: return milliseconds(totalMs(plugin));
    case PluginTable::Memory: return sizeText(plugin.mappedBytes);
    default: return {};
    }
}

QVariant sortKey(const PluginInfo& plugin, int column)
{
    switch (column) {
    case PluginTable::Load: return plugin.loadMs;
    case PluginTable::Time: return totalMs(plugin);
    case PluginTable::Memory: return QVariant::fromValue(static_cast<qulonglong>(plugin.mappedBytes));
    default: return textOf(plugin, column).toLower();
    }
}

QString searchText(const PluginInfo& plugin)
{
    std::string all = plugin.name + ' ' + plugin.id + ' ' + plugin.description + ' ' + plugin.origin;
    for (const Contribution& one : plugin.contributions)
        all += ' ' + one.id + ' ' + one.label + ' ' + std::string(kindName(one.kind));
    return QString::fromStdString(all) + ' ' + stateText(plugin);
}

QVariant colorOf(const PluginInfo& plugin)
{
    if (plugin.state == PluginState::Faulted) return QBrush(QColor(255, 120, 110));
    if (plugin.isUsable()) return {};
    return QApplication::palette().brush(QPalette::Disabled, QPalette::Text);
}

}  // namespace

void PluginTable::show(std::vector<PluginInfo> plugins)
{
    const bool same =
        std::equal(plugins.begin(), plugins.end(), plugins_.begin(), plugins_.end(),
                   [](const PluginInfo& a, const PluginInfo& b) { return a.id == b.id && a.folder == b.folder; });
    if (!same) beginResetModel();
    plugins_ = std::move(plugins);
    if (!same) {
        endResetModel();
    } else if (!plugins_.empty()) {
        emit dataChanged(index(0, 0), index(rowCount() - 1, Columns - 1));
    }
}

int PluginTable::rowCount(const QModelIndex& parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(plugins_.size());
}

QVariant PluginTable::data(const QModelIndex& index, int role) const
{
    if (!index.isValid()) return {};
    const PluginInfo& plugin = at(index.row());
    switch (role) {
    case Qt::DisplayRole: return textOf(plugin, index.column());
    case Qt::CheckStateRole:
        if (index.column() != Name || plugin.state == PluginState::Shadowed) return {};
        return plugin.state == PluginState::Disabled ? Qt::Unchecked : Qt::Checked;
    case Qt::ToolTipRole: return QString::fromStdString(plugin.reason.empty() ? plugin.description : plugin.reason);
    case Qt::ForegroundRole: return colorOf(plugin);
    case Qt::TextAlignmentRole:
        return index.column() >= Load ? QVariant(Qt::AlignRight | Qt::AlignVCenter) : QVariant();
    case kSearchRole: return searchText(plugin);
    case kSortRole: return sortKey(plugin, index.column());
    default: return {};
    }
}

bool PluginTable::setData(const QModelIndex& index, const QVariant& value, int role)
{
    if (role != Qt::CheckStateRole || !index.isValid() || !onSwitch) return false;
    const PluginInfo plugin = at(index.row());  // the list may change meanwhile
    onSwitch(plugin, value.toInt() == Qt::Checked);
    return true;
}

QVariant PluginTable::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
    static constexpr const char* titles[] = {
        QT_TRANSLATE_NOOP("PluginsPanel", "Plugin"),     QT_TRANSLATE_NOOP("PluginsPanel", "Version"),
        QT_TRANSLATE_NOOP("PluginsPanel", "State"),      QT_TRANSLATE_NOOP("PluginsPanel", "Loaded in"),
        QT_TRANSLATE_NOOP("PluginsPanel", "Time in it"), QT_TRANSLATE_NOOP("PluginsPanel", "Memory")};
    return translated(titles[section]);
}

Qt::ItemFlags PluginTable::flags(const QModelIndex& index) const
{
    Qt::ItemFlags flags = Qt::ItemIsSelectable | Qt::ItemIsEnabled;
    if (index.isValid() && index.column() == Name && at(index.row()).state != PluginState::Shadowed)
        flags |= Qt::ItemIsUserCheckable;
    return flags;
}

}  // namespace jet::plugins
