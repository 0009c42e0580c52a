// PluginTable: a row a plugin: what it is, its state, what it costs. The first column switches it.
#pragma once

#include <jet/plugins.hpp>

#include <QAbstractTableModel>

#include <functional>
#include <vector>

namespace jet::plugins {

QString translated(const char* text);
/// "1.5 MB".
QString sizeText(std::uint64_t bytes);
QString stateText(const PluginInfo& plugin);

class PluginTable final : public QAbstractTableModel {
public:
    enum Column { Name, Version, State, Load, Time, Memory, Columns };
    static constexpr int kSearchRole = Qt::UserRole;    ///< all words one may look for
    static constexpr int kSortRole = Qt::UserRole + 1;  ///< numbers as numbers

    explicit PluginTable(QObject* parent) : QAbstractTableModel(parent) {}

    /// Shows the plugins; keeps rows and selections where the list is the same.
    void show(std::vector<PluginInfo> plugins);
    const PluginInfo& at(int row) const { return plugins_[static_cast<std::size_t>(row)]; }
    /// Called when the user ticks a plugin on or off.
    std::function<void(const PluginInfo& plugin, bool on)> onSwitch;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : Columns; }
    QVariant data(const QModelIndex& index, int role) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;

private:
    std::vector<PluginInfo> plugins_;
};

/// Milliseconds in all callbacks.
double totalMs(const PluginInfo& plugin);

}  // namespace jet::plugins
