// PluginDiffDialog: a project wants other plugins than are here: a row each, with what can be done about it. Does not
// stop the program: open() it.
#pragma once

#include <jet/editor.hpp>
#include <jet/plugins.hpp>

#include <QDialog>

#include <functional>
#include <vector>

class QCheckBox;
class QLabel;
class QPushButton;
class QTableWidget;

namespace jet::host {

class PluginDiffDialog final : public QDialog {
    Q_OBJECT

public:
    enum Column { Name, Wanted, Here, Uses, Remedy, Action, Columns };

    /// `differences` is asked again after each change; the dialog ends when there are none left.
    PluginDiffDialog(Editor& editor, const QString& project, std::function<std::vector<PluginDifference>()> differences,
                     QWidget* parent);

    /// Shows what differs now; ends when nothing does.
    void refresh();
    void enable(const std::string& plugin);
    void enableAll();
    void install(const QString& file);

private:
    void addRow(const PluginDifference& difference);
    void tell(const Result<PluginChange>& change);
    void askAndInstall();

    Editor& editor_;
    std::function<std::vector<PluginDifference>()> ask_;
    std::vector<PluginDifference> shown_;
    QTableWidget* table_;
    QLabel* told_;
    QCheckBox* versionsToo_;
    QPushButton* enableAll_ = nullptr;
    QPushButton* goOn_ = nullptr;
};

/// Does the user want to be told where all plugins can be used, and only versions differ?
bool tellsOfVersions();

}  // namespace jet::host
