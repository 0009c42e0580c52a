#include "window/recovery_dialog.hpp"

#include <QDateTime>
#include <QDialogButtonBox>
#include <QDir>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace jet::host {

void fillJournalList(QTreeWidget& list, const std::vector<JournalInfo>& journals)
{
    list.setHeaderLabels({RecoveryDialog::tr("Project"), RecoveryDialog::tr("Changes"),
                          RecoveryDialog::tr("Last change"), RecoveryDialog::tr("File")});
    list.setRootIsDecorated(false);
    list.setAllColumnsShowFocus(true);
    for (const JournalInfo& info : journals) {
        const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(info.lastChange.time_since_epoch());
        const QDateTime time = QDateTime::fromMSecsSinceEpoch(ms.count());
        const QString file = info.project.empty()
                                 ? RecoveryDialog::tr("never saved")
                                 : QDir::toNativeSeparators(QString::fromStdString(info.project.string()));
        auto* row = new QTreeWidgetItem(&list, {QString::fromStdString(info.name), QString::number(info.changes),
                                                QLocale().toString(time, QLocale::ShortFormat), file});
        row->setToolTip(3, file);
    }
    for (int column = 0; column < 3; ++column) list.resizeColumnToContents(column);
    list.setCurrentItem(list.topLevelItem(0));
}

RecoveryDialog::RecoveryDialog(const std::vector<JournalInfo>& journals, QWidget* parent) : QDialog(parent)
{
    setWindowTitle(tr("Recover unsaved changes"));
    auto* heading = new QLabel(tr("JET was ended before these changes were saved."), this);
    QFont bold = heading->font();
    bold.setBold(true);
    heading->setFont(bold);
    auto* hint = new QLabel(tr("Recover opens the project with its changes; its files stay as they are until you save. "
                               "What you keep for later is in File › Recover unsaved changes."),
                            this);
    hint->setWordWrap(true);
    list_ = new QTreeWidget(this);
    fillJournalList(*list_, journals);
    auto* buttons = new QDialogButtonBox(this);
    const auto button = [&](const QString& text, QDialogButtonBox::ButtonRole role, RecoveryChoice::Kind kind) {
        QPushButton* made = buttons->addButton(text, role);
        connect(made, &QPushButton::clicked, this, [this, kind] { finish(kind); });
        return made;
    };
    button(tr("&Recover"), QDialogButtonBox::AcceptRole, RecoveryChoice::Kind::Recover)->setDefault(true);
    button(tr("&Discard"), QDialogButtonBox::DestructiveRole, RecoveryChoice::Kind::Discard);
    button(tr("&Keep for later"), QDialogButtonBox::RejectRole, RecoveryChoice::Kind::Later);
    auto* layout = new QVBoxLayout(this);
    for (QWidget* part : std::initializer_list<QWidget*>{heading, list_, hint, buttons}) layout->addWidget(part);
    resize(680, 300);
}

void RecoveryDialog::finish(RecoveryChoice::Kind kind)
{
    choice_ = {kind, static_cast<std::size_t>(std::max(0, list_->indexOfTopLevelItem(list_->currentItem())))};
    kind == RecoveryChoice::Kind::Later ? reject() : accept();
}

}  // namespace jet::host
