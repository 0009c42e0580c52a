#include "window/crash_dialog.hpp"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QGroupBox>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QStyle>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace jet::host {

namespace {

QLabel* paragraph(const QString& text, QWidget* parent)
{
    auto* label = new QLabel(text, parent);
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    return label;
}

QString sentence(const std::string& text)
{
    QString whole = QString::fromStdString(text);
    if (!whole.isEmpty()) whole[0] = whole[0].toUpper();
    return whole + QLatin1Char('.');
}

}  // namespace

CrashDialog::CrashDialog(const std::vector<CrashNote>& crashes, const std::vector<JournalInfo>& journals,
                         QWidget* parent)
    : QDialog(parent)
{
    setWindowTitle(tr("JET ended unexpectedly"));
    setObjectName("crashDialog");
    setMinimumWidth(640);
    auto* layout = new QVBoxLayout(this);
    for (const CrashNote& crash : crashes) layout->addWidget(paragraph(sentence(crash.message), this));
    layout->addWidget(createPlugins(crashes));
    if (!journals.empty()) layout->addWidget(createWork(journals), 1);
    auto* buttons = new QDialogButtonBox(this);
    QPushButton* go = buttons->addButton(tr("&Go on"), QDialogButtonBox::AcceptRole);
    buttons->addButton(tr("&Quit"), QDialogButtonBox::RejectRole);
    go->setDefault(true);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    layout->addWidget(buttons);
    go->setFocus();
}

QWidget* CrashDialog::createPlugins(const std::vector<CrashNote>& crashes)
{
    auto* group = new QGroupBox(tr("Plugins"), this);
    auto* layout = new QVBoxLayout(group);
    without_ = new QRadioButton(tr("Go on with&out, for this time:"), group);
    without_->setObjectName("withoutPlugins");
    without_->setChecked(true);
    layout->addWidget(without_);
    auto* plugins = new QWidget(group);
    auto* boxes = new QVBoxLayout(plugins);
    const int indent = style()->pixelMetric(QStyle::PM_ExclusiveIndicatorWidth) + 8;
    boxes->setContentsMargins(indent, 0, 0, 0);
    for (const CrashNote& crash : crashes) {
        const auto known = std::find_if(choices_.begin(), choices_.end(),
                                        [&](const auto& choice) { return choice.first == crash.plugin; });
        if (known != choices_.end()) continue;
        auto* box = new QCheckBox(QString::fromStdString(crash.plugin), plugins);
        box->setChecked(true);
        choices_.emplace_back(crash.plugin, box);
        boxes->addWidget(box);
    }
    layout->addWidget(plugins);
    connect(without_, &QRadioButton::toggled, plugins, &QWidget::setEnabled);
    auto* with = new QRadioButton(tr("Go on &with all plugins"), group);
    with->setObjectName("withAllPlugins");
    layout->addWidget(with);
    safeMode_ = new QRadioButton(tr("&Safe mode: only the plugins that ship with JET"), group);
    safeMode_->setObjectName("safeMode");
    layout->addWidget(safeMode_);
    layout->addWidget(paragraph(tr("What a plugin made in your projects is kept, and comes back with it. "
                                   "The Plugins panel switches a plugin off for all later starts."),
                                group));
    return group;
}

QWidget* CrashDialog::createWork(const std::vector<JournalInfo>& journals)
{
    auto* group = new QGroupBox(tr("Work that was not saved"), this);
    auto* layout = new QVBoxLayout(group);
    list_ = new QTreeWidget(group);
    list_->setObjectName("unsavedWork");
    fillJournalList(*list_, journals);
    list_->setMinimumHeight(90);
    layout->addWidget(list_, 1);
    const bool several = journals.size() > 1;
    recover_ =
        new QRadioButton(several ? tr("&Recover the selected one; the others stay in File › Recover unsaved changes")
                                 : tr("&Recover: open the project with these changes; its files stay as they "
                                      "are until you save"),
                         group);
    recover_->setChecked(true);
    auto* later = new QRadioButton(tr("&Keep for later, in File › Recover unsaved changes"), group);
    later->setObjectName("keepWork");
    discard_ = new QRadioButton(several ? tr("&Discard the selected one for ever") : tr("&Discard for ever"), group);
    discard_->setObjectName("discardWork");
    for (QRadioButton* button : {recover_, later, discard_}) layout->addWidget(button);
    return group;
}

std::vector<std::string> CrashDialog::leftOut() const
{
    std::vector<std::string> ids;
    if (!without_->isChecked()) return ids;
    for (const auto& [id, box] : choices_)
        if (box->isChecked()) ids.push_back(id);
    return ids;
}

bool CrashDialog::safeMode() const { return safeMode_->isChecked(); }

RecoveryChoice CrashDialog::recovery() const
{
    RecoveryChoice choice;
    if (!list_) return choice;
    if (recover_->isChecked()) choice.kind = RecoveryChoice::Kind::Recover;
    if (discard_->isChecked()) choice.kind = RecoveryChoice::Kind::Discard;
    choice.index = static_cast<std::size_t>(std::max(0, list_->indexOfTopLevelItem(list_->currentItem())));
    return choice;
}

}  // namespace jet::host
