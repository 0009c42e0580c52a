// RecoveryDialog: after a crash: which changes were not saved, and what shall become of them.
#pragma once

#include <jet/journal.hpp>

#include <QDialog>

#include <vector>

class QTreeWidget;

namespace jet::host {

/// A row a journal: project, changes, time, file. The first is current.
void fillJournalList(QTreeWidget& list, const std::vector<JournalInfo>& journals);

/// What the user chose for one of the journals.
struct RecoveryChoice {
    enum class Kind { Recover, Discard, Later };
    Kind kind = Kind::Later;
    std::size_t index = 0;  ///< of the journal; without meaning for Later
};

class RecoveryDialog final : public QDialog {
    Q_OBJECT

public:
    RecoveryDialog(const std::vector<JournalInfo>& journals, QWidget* parent);
    RecoveryChoice choice() const { return choice_; }

private:
    void finish(RecoveryChoice::Kind kind);

    QTreeWidget* list_;
    RecoveryChoice choice_;
};

}  // namespace jet::host
