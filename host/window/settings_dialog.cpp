#include "window/settings_dialog.hpp"

#include <jet/plugins.hpp>
#include <jet/settings.hpp>
#include <jet/ui/property_editor.hpp>

#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QScrollArea>
#include <QStackedWidget>
#include <QVBoxLayout>

namespace jet::host {

namespace {

QLabel* note(const QString& text)
{
    auto* label = new QLabel(text);
    label->setWordWrap(true);
    label->setMargin(12);
    label->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    return label;
}

}  // namespace

SettingsDialog::SettingsDialog(Editor& editor, QWidget* parent)
    : QDialog(parent), editor_(editor), list_(new QListWidget(this)), pages_(new QStackedWidget(this))
{
    setWindowTitle(tr("Settings"));
    resize(640, 420);
    list_->setObjectName("settingsPages");
    list_->setMaximumWidth(200);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close | QDialogButtonBox::RestoreDefaults, this);
    defaults_ = buttons->button(QDialogButtonBox::RestoreDefaults);
    // Return ends the editing of a field; it must not press a button as well.
    for (QAbstractButton* button : buttons->buttons())
        if (auto* push = qobject_cast<QPushButton*>(button)) push->setAutoDefault(false);
    connect(defaults_, &QPushButton::clicked, this, &SettingsDialog::restoreDefaults);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* middle = new QHBoxLayout;
    middle->addWidget(list_);
    middle->addWidget(pages_, 1);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(middle, 1);
    layout->addWidget(buttons);
    for (const Contribution& page : editor_.catalog().contributions(ContributionKind::SettingsPage)) {
        auto* row = new QListWidgetItem(QString::fromStdString(page.label), list_);
        row->setData(Qt::UserRole, QString::fromStdString(page.id));
        row->setToolTip(QString::fromStdString(page.plugin));
    }
    connect(list_, &QListWidget::currentRowChanged, this, &SettingsDialog::showRow);
    defaults_->setEnabled(false);
    if (list_->count() == 0) {
        list_->hide();
        pages_->addWidget(note(tr("None of the plugins in use has settings.")));
    } else {
        list_->setCurrentRow(0);
    }
}

void SettingsDialog::showPage(const QString& id)
{
    for (int row = 0; row < list_->count(); ++row)
        if (list_->item(row)->data(Qt::UserRole).toString() == id) list_->setCurrentRow(row);
}

void SettingsDialog::showRow(int row)
{
    if (row < 0) return;
    const QString id = list_->item(row)->data(Qt::UserRole).toString();
    QWidget*& page = made_[id];
    if (!page) {
        page = createPage(id);
        pages_->addWidget(page);
    }
    defaults_->setEnabled(forms_.contains(id));
    pages_->setCurrentWidget(page);
}

QWidget* SettingsDialog::createPage(const QString& id)
{
    const auto settings = editor_.plugins().settings(id.toStdString());
    if (!settings)
        return note(
            QString::fromStdString(editor_.catalog().explain(ContributionKind::SettingsPage, id.toStdString())));
    auto* area = new QScrollArea(this);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    auto* form = new ui::PropertyForm(settings->table(), ui::PropertyForm::Layout::Rows, area);
    auto* holder = new QWidget(area);
    auto* layout = new QVBoxLayout(holder);
    auto* problem = note({});
    problem->setObjectName("settingsProblem");
    problem->hide();
    layout->addWidget(form);
    layout->addWidget(problem);
    layout->addStretch(1);
    area->setWidget(holder);
    forms_.insert(id, form);
    showValues(id);
    form->setHandler([settings, problem](const PropertySpec& spec, const Value& value, ui::EditPhase) {
        const Result<void> stored = settings->set(spec.id, value);
        problem->setVisible(!stored);
        if (!stored) problem->setText(QString::fromStdString(stored.error().text()));
    });
    return area;
}

void SettingsDialog::showValues(const QString& id)
{
    const auto settings = editor_.plugins().settings(id.toStdString());
    if (settings) forms_[id]->show([&](const PropertySpec& spec) { return settings->value(spec.id); });
}

void SettingsDialog::restoreDefaults()
{
    const QString id = list_->currentItem()->data(Qt::UserRole).toString();
    const auto settings = editor_.plugins().settings(id.toStdString());
    if (!settings) return;
    for (const PropertySpec& spec : settings->table().specs()) {
        if (const Result<void> done = settings->reset(spec.id); !done) editor_.showMessage(done.error().text());
    }
    showValues(id);
}

}  // namespace jet::host
