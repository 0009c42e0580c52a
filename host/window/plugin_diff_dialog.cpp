#include "window/plugin_diff_dialog.hpp"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace jet::host {

namespace {

constexpr const char* kTellOfVersions = "plugins/tellOfVersions";

QSettings settings() { return QSettings(QSettings::IniFormat, QSettings::UserScope, "jet", "window"); }

QString textOf(const std::string& text) { return QString::fromStdString(text); }

QString sentence(const std::string& text)
{
    QString whole = textOf(text);
    if (!whole.isEmpty()) whole[0] = whole[0].toUpper();
    return whole + QLatin1Char('.');
}

}  // namespace

bool tellsOfVersions() { return settings().value(kTellOfVersions, true).toBool(); }

PluginDiffDialog::PluginDiffDialog(Editor& editor, const QString& project,
                                   std::function<std::vector<PluginDifference>()> differences, QWidget* parent)
    : QDialog(parent), editor_(editor), ask_(std::move(differences)), table_(new QTableWidget(0, Columns, this)),
      told_(new QLabel(this)), versionsToo_(new QCheckBox(tr("&Show this where only versions differ"), this))
{
    setWindowTitle(tr("Plugins of the project"));
    setObjectName("pluginDiffDialog");
    auto* heading = new QLabel(tr("“%1” was saved with other plugins than are here.").arg(project), this);
    QFont bold = heading->font();
    bold.setBold(true);
    heading->setFont(bold);
    auto* hint = new QLabel(tr("What plugins wrote that cannot be used now is kept, and comes back with them."), this);
    for (QLabel* label : {heading, hint, told_}) label->setWordWrap(true);
    table_->setObjectName("pluginDifferences");
    table_->setHorizontalHeaderLabels(
        {tr("Plugin"), tr("Project wants"), tr("Here is"), tr("Uses"), tr("What can be done"), QString()});
    table_->verticalHeader()->hide();
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setWordWrap(true);
    table_->setTabKeyNavigation(false);  // to the buttons
    table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    table_->horizontalHeader()->setSectionResizeMode(Remedy, QHeaderView::Stretch);
    told_->hide();
    versionsToo_->setChecked(true);
    auto* buttons = new QDialogButtonBox(this);
    enableAll_ = buttons->addButton(tr("&Enable all that can be enabled"), QDialogButtonBox::ActionRole);
    enableAll_->setObjectName("enableAll");
    auto* install = buttons->addButton(tr("&Install from file…"), QDialogButtonBox::ActionRole);
    goOn_ = buttons->addButton(tr("&Go on without"), QDialogButtonBox::AcceptRole);
    connect(enableAll_, &QPushButton::clicked, this, &PluginDiffDialog::enableAll);
    connect(install, &QPushButton::clicked, this, &PluginDiffDialog::askAndInstall);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(this, &QDialog::finished, this, [this] {
        if (!versionsToo_->isChecked()) settings().setValue(kTellOfVersions, false);
    });
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(heading);
    layout->addWidget(hint);
    layout->addWidget(table_, 1);
    for (QWidget* part : std::initializer_list<QWidget*>{told_, versionsToo_, buttons}) layout->addWidget(part);
    resize(860, 340);
    refresh();
}

void PluginDiffDialog::refresh()
{
    shown_ = ask_();
    table_->setRowCount(0);
    for (const PluginDifference& difference : shown_) addRow(difference);
    table_->resizeRowsToContents();
    const auto canEnable = [](const PluginDifference& difference) { return difference.canEnable(); };
    const auto isVersion = [](const PluginDifference& d) { return d.kind == PluginDifference::Kind::OtherVersion; };
    const bool any = std::any_of(shown_.begin(), shown_.end(), canEnable);
    const bool versionsOnly = std::all_of(shown_.begin(), shown_.end(), isVersion);
    enableAll_->setEnabled(any);
    versionsToo_->setVisible(versionsOnly);
    goOn_->setText(versionsOnly ? tr("&Go on") : tr("&Go on without"));
    (any ? enableAll_ : goOn_)->setDefault(true);
    if (shown_.empty()) accept();
}

void PluginDiffDialog::addRow(const PluginDifference& difference)
{
    const int row = table_->rowCount();
    table_->insertRow(row);
    const auto set = [&](Column column, const QString& text) {
        auto* item = new QTableWidgetItem(text);
        item->setToolTip(text);
        table_->setItem(row, column, item);
        return item;
    };
    set(Name, textOf(difference.name))->setToolTip(textOf(difference.id));
    set(Wanted, difference.wanted.empty() ? tr("any version") : textOf(difference.wanted));
    const bool faulted = difference.kind == PluginDifference::Kind::Faulted;
    QString here = difference.here.empty() ? tr("nothing") : textOf(difference.here);
    if (difference.canEnable()) here = tr("%1, switched off").arg(here);
    if (faulted) here = difference.here.empty() ? tr("faulted") : tr("%1, faulted").arg(here);
    set(Here, here);
    set(Uses, difference.uses > 0 ? QString::number(difference.uses) : QStringLiteral("–"))
        ->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    set(Remedy, faulted ? sentence(difference.reason + "; " + difference.remedy) : sentence(difference.remedy));
    QPushButton* button = nullptr;
    if (difference.canEnable()) {
        button = new QPushButton(tr("Enable"), table_);
        connect(
            button, &QPushButton::clicked, this, [this, id = difference.id] { enable(id); }, Qt::QueuedConnection);
    } else {
        button = new QPushButton(tr("Install…"), table_);
        connect(button, &QPushButton::clicked, this, &PluginDiffDialog::askAndInstall, Qt::QueuedConnection);
    }
    button->setObjectName(textOf(difference.id));
    button->setAutoDefault(false);
    auto* place = new QWidget(table_);  // keeps the button's height where the text needs two lines
    auto* layout = new QVBoxLayout(place);
    layout->setContentsMargins(2, 1, 2, 1);
    layout->addWidget(button, 0, Qt::AlignVCenter);
    table_->setCellWidget(row, Action, place);
}

void PluginDiffDialog::tell(const Result<PluginChange>& change)
{
    QString text = textOf(change ? change->message : change.error().text());
    if (change && change->afterRestart) text += QLatin1Char(' ') + tr("It takes effect after a restart.");
    told_->setText(text);
    told_->show();
    refresh();
}

void PluginDiffDialog::enable(const std::string& plugin) { tell(editor_.plugins().setEnabled(plugin, true)); }

void PluginDiffDialog::enableAll()
{
    PluginChange all;
    for (const PluginDifference& difference : std::vector(shown_)) {
        if (!difference.canEnable()) continue;
        const auto now = editor_.plugins().plugin(difference.id);
        if (now && now->isUsable()) continue;  // another one required it
        const auto change = editor_.plugins().setEnabled(difference.id, true);
        if (!change) return tell(change);
        all.afterRestart = all.afterRestart || change->afterRestart;
        all.message += (all.message.empty() ? "" : " ") + change->message;
    }
    tell(all);
}

void PluginDiffDialog::install(const QString& file) { tell(editor_.plugins().install(file.toStdString())); }

void PluginDiffDialog::askAndInstall()
{
    const QString file = QFileDialog::getOpenFileName(this, tr("Install a plugin"), {}, tr("Plugins (*.jetplugin)"),
                                                      nullptr, QFileDialog::DontUseNativeDialog);
    if (!file.isEmpty()) install(file);
}

}  // namespace jet::host
