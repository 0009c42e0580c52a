#include "window/crash_dialog.hpp"

#include <jet/ui/icons.hpp>

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
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

}  // namespace

CrashDialog::CrashDialog(const std::vector<CrashNote>& crashes, QWidget* parent) : QDialog(parent)
{
    setWindowTitle(tr("JET ended unexpectedly"));
    setObjectName("crashDialog");
    setMinimumWidth(560);
    auto* layout = new QVBoxLayout(this);
    for (const CrashNote& crash : crashes) {
        QString text = QString::fromStdString(crash.message);
        if (!text.isEmpty()) text[0] = text[0].toUpper();
        layout->addWidget(paragraph(text + QLatin1Char('.'), this));
        const auto known = std::find_if(choices_.begin(), choices_.end(),
                                        [&](const auto& choice) { return choice.first == crash.plugin; });
        if (known != choices_.end()) continue;
        auto* box =
            new QCheckBox(tr("Go on without %1, for this time").arg(QString::fromStdString(crash.plugin)), this);
        box->setChecked(true);
        choices_.emplace_back(crash.plugin, box);
        layout->addWidget(box);
    }
    layout->addWidget(paragraph(tr("What the plugin made in your projects is kept, and comes back with it. "
                                   "'jet plugins disable' switches a plugin off for all later starts, "
                                   "'jet --safe-mode' starts with the shipped plugins only."),
                                this));
    auto* buttons = new QDialogButtonBox(this);
    QPushButton* go = buttons->addButton(tr("&Go on"), QDialogButtonBox::AcceptRole);
    buttons->addButton(tr("&Quit"), QDialogButtonBox::RejectRole);
    go->setDefault(true);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    layout->addWidget(buttons);
}

std::vector<std::string> CrashDialog::leftOut() const
{
    std::vector<std::string> ids;
    for (const auto& [id, box] : choices_)
        if (box->isChecked()) ids.push_back(id);
    return ids;
}

}  // namespace jet::host
