#include "plugins_widget.hpp"

#include "plugin_details.hpp"

#include <jet/ui/icons.hpp>

#include <QDesktopServices>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QMessageBox>
#include <QScrollBar>
#include <QSplitter>
#include <QTextBrowser>
#include <QToolButton>
#include <QTreeView>
#include <QUrl>
#include <QVBoxLayout>

namespace jet::plugins {

namespace {

constexpr int kRefreshMs = 2000;  // costs and states while the panel is seen

QString joined(const std::vector<std::string>& ids)
{
    QStringList list;
    for (const std::string& id : ids) list << QString::fromStdString(id);
    return list.join(QStringLiteral(", "));
}

}  // namespace

PluginsWidget::PluginsWidget(Editor& editor)
    : editor_(editor), table_(this), sets_(new SetChooser(editor, this)), filter_(new QLineEdit(this)),
      view_(new QTreeView(this)), details_(new QTextBrowser(this)),
      ask_([this](const QString& question) { return askUser(question); })
{
    filter_->setObjectName("pluginFilter");
    filter_->setPlaceholderText(translated("Filter by name, state, or what it offers"));
    filter_->setClearButtonEnabled(true);
    filtered_.setSourceModel(&table_);
    filtered_.setFilterRole(PluginTable::kSearchRole);
    filtered_.setFilterCaseSensitivity(Qt::CaseInsensitive);
    filtered_.setSortRole(PluginTable::kSortRole);
    view_->setObjectName("pluginTable");
    view_->setModel(&filtered_);
    view_->setRootIsDecorated(false);
    view_->setUniformRowHeights(true);
    view_->setSortingEnabled(true);
    view_->sortByColumn(PluginTable::Name, Qt::AscendingOrder);
    view_->header()->setStretchLastSection(false);
    view_->header()->setSectionResizeMode(PluginTable::Name, QHeaderView::Stretch);
    details_->setObjectName("pluginDetails");
    details_->setOpenLinks(false);
    details_->setPlaceholderText(translated("Choose a plugin to see what it is and what it costs."));
    auto* split = new QSplitter(this);
    split->addWidget(view_);
    split->addWidget(details_);
    split->setStretchFactor(0, 3);
    split->setStretchFactor(1, 2);
    split->setSizes({620, 300});  // names stay readable in the place the panel has at first
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    layout->addLayout(createButtons());
    layout->addWidget(split, 1);

    sets_->onChange = [this](const Result<PluginChange>& change) { tell(change); };
    table_.onSwitch = [this](const PluginInfo& plugin, bool on) { switchPlugin(plugin, on); };
    connect(filter_, &QLineEdit::textChanged, &filtered_, &QSortFilterProxyModel::setFilterFixedString);
    connect(view_->selectionModel(), &QItemSelectionModel::currentChanged, this, [this] { showCurrent(); });
    connect(&table_, &QAbstractItemModel::dataChanged, this, [this] { showCurrent(); });
    connect(&table_, &QAbstractItemModel::modelReset, this, [this] { showCurrent(); });
    connect(&refresh_, &QTimer::timeout, this, [this] { refresh(); });
    changed_ = editor_.events().subscribe<PluginsChanged>(nullptr, [this](const PluginsChanged&) {
        refresh();
        sets_->refresh();
    });
    refresh();
    for (int column = PluginTable::Version; column < PluginTable::Columns; ++column)
        view_->resizeColumnToContents(column);
}

QToolButton* PluginsWidget::button(const char* icon, const char* name, const QString& toolTip,
                                   std::function<void()> run)
{
    auto* made = new QToolButton(this);
    made->setObjectName(QLatin1String(name));
    made->setIcon(ui::icon(icon));
    made->setToolTip(toolTip);
    made->setAutoRaise(true);
    connect(made, &QToolButton::clicked, this, [run = std::move(run)] { run(); });
    return made;
}

QHBoxLayout* PluginsWidget::createButtons()
{
    auto* bar = new QHBoxLayout;
    bar->setContentsMargins(4, 3, 4, 0);
    bar->addWidget(sets_);
    bar->addWidget(filter_, 1);
    bar->addWidget(button("import", "pluginInstall", translated("Install from a file…"), [this] {
        const QString file =
            QFileDialog::getOpenFileName(this, translated("Install a plugin"), {}, translated("Plugins (*.jetplugin)"),
                                         nullptr, QFileDialog::DontUseNativeDialog);
        if (!file.isEmpty()) install(file);
    }));
    reload_ = button("redo", "pluginReload", translated("Load its library again"), [this] {
        if (const PluginInfo* plugin = current()) tell(editor_.plugins().reload(plugin->id));
    });
    folder_ = button("open", "pluginFolder", translated("Open its folder"), [this] {
        if (const PluginInfo* plugin = current())
            QDesktopServices::openUrl(QUrl::fromLocalFile(QString::fromStdString(plugin->folder.string())));
    });
    remove_ = button("trash", "pluginRemove", translated("Remove"), [this] { removeCurrent(); });
    for (QToolButton* one : {reload_, folder_, remove_}) bar->addWidget(one);
    return bar;
}

void PluginsWidget::showEvent(QShowEvent* event)
{
    QWidget::showEvent(event);
    refresh();
    sets_->refresh();
    refresh_.start(kRefreshMs);
}

void PluginsWidget::hideEvent(QHideEvent* event)
{
    refresh_.stop();
    QWidget::hideEvent(event);
}

const PluginInfo* PluginsWidget::current() const
{
    const QModelIndex index = filtered_.mapToSource(view_->currentIndex());
    return index.isValid() ? &table_.at(index.row()) : nullptr;
}

void PluginsWidget::refresh() { table_.show(editor_.plugins().plugins()); }

void PluginsWidget::showCurrent()
{
    const PluginInfo* plugin = current();
    folder_->setEnabled(plugin != nullptr);
    reload_->setEnabled(plugin && plugin->loadMs > 0);
    remove_->setEnabled(plugin && plugin->origin == "user");
    const QString text = plugin ? detailsOf(*plugin) : QString();
    if (details_->property("shown").toString() == text) return;
    const int scrolled = details_->verticalScrollBar()->value();
    details_->setProperty("shown", text);
    details_->setHtml(text);
    details_->verticalScrollBar()->setValue(scrolled);
}

// --- changes

void PluginsWidget::switchPlugin(const PluginInfo& plugin, bool on)
{
    PluginsCenter& center = editor_.plugins();
    const QString name = QString::fromStdString(plugin.name);
    const auto others = on ? center.requirements(plugin.id) : center.dependents(plugin.id);
    if (!others.empty()) {
        const QString question = on ? translated("%1 requires plugins that are switched off: %2. Switch them on, too?")
                                          .arg(name, joined(others))
                                    : translated("These plugins require %1 and are switched off with it: %2. Go on?")
                                          .arg(name, joined(others));
        if (!ask_(question)) return refresh();
    }
    tell(center.setEnabled(plugin.id, on));
}

void PluginsWidget::install(const QString& file) { tell(editor_.plugins().install(file.toStdString())); }

void PluginsWidget::removeCurrent()
{
    const PluginInfo* plugin = current();
    if (!plugin) return;
    const std::string id = plugin->id;
    const QString question =
        translated("Remove %1 from %2? Its settings are kept.")
            .arg(QString::fromStdString(plugin->name), QString::fromStdString(plugin->folder.string()));
    if (ask_(question)) tell(editor_.plugins().remove(id));
}

void PluginsWidget::tell(const Result<PluginChange>& change)
{
    if (!change) {
        editor_.showMessage(change.error().text());
    } else if (change->afterRestart) {
        editor_.showMessage(change->message + ' ' + translated("It takes effect after a restart.").toStdString());
    } else {
        editor_.showStatus(change->message);
    }
    refresh();
}

bool PluginsWidget::askUser(const QString& question)
{
    return QMessageBox::question(this, translated("Plugins"), question) == QMessageBox::Yes;
}

}  // namespace jet::plugins
