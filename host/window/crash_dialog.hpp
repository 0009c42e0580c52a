// After a crash, before any plugin is loaded: what happened, in which plugin; whether to go on without it, with it, or
// with the shipped plugins only; and what shall become of the work that was not saved.
#pragma once

#include "window/plugin_runtime.hpp"
#include "window/recovery_dialog.hpp"

#include <QDialog>

class QCheckBox;
class QGroupBox;
class QRadioButton;
class QTreeWidget;

namespace jet::host {

class CrashDialog final : public QDialog {
    Q_OBJECT

public:
    explicit CrashDialog(const std::vector<CrashNote>& crashes, const std::vector<JournalInfo>& journals = {},
                         QWidget* parent = nullptr);

    // What was chosen, after the dialog was accepted.
    /// Each plugin once, in the order of the notes.
    std::vector<std::string> leftOut() const;
    bool safeMode() const;
    /// Later where there are no journals.
    RecoveryChoice recovery() const;

private:
    QWidget* createPlugins(const std::vector<CrashNote>& crashes);
    QWidget* createWork(const std::vector<JournalInfo>& journals);

    QRadioButton* without_ = nullptr;
    QRadioButton* safeMode_ = nullptr;
    QTreeWidget* list_ = nullptr;
    QRadioButton* recover_ = nullptr;
    QRadioButton* discard_ = nullptr;
    std::vector<std::pair<std::string, QCheckBox*>> choices_;
};

}  // namespace jet::host
