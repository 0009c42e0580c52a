#include "scenes_widget.hpp"

#include <jet/assets.hpp>
#include <jet/ui/history_focus.hpp>

#include <QDesktopServices>
#include <QFileDialog>
#include <QLocale>
#include <QMessageBox>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>

namespace jet::scenes {

using Kind = Row::Kind;

namespace {

constexpr int kWhileTypingMs = 200;

bool isScene(const Row& row) { return row.kind == Kind::Scene; }
bool isPlace(const Row& row) { return row.kind == Kind::Scene || row.kind == Kind::Filter; }
bool isNamed(const Row& row) { return row.kind != Kind::Scenes && row.kind != Kind::Files; }
bool opens(const Row& row) { return row.kind != Kind::Files && row.kind != Kind::Scenes && row.kind != Kind::Filter; }
bool isFiles(const Row& row) { return row.kind == Kind::Files || row.kind == Kind::File; }
bool takesScript(const Row& row) { return row.scene != nullptr; }
bool doubles(const Row& row) { return row.kind == Kind::Scene || row.kind == Kind::Script; }
bool always(const Row&) { return true; }

std::string freeFilterName(const Filter& parent)
{
    for (int i = 0;; ++i) {
        std::string name = "Filter" + std::to_string(i);
        if (std::ranges::none_of(parent.filters, [&](const auto& child) { return child->name == name; })) return name;
    }
}

/// The filter a filter is in; null for the root.
Filter* parentOf(Filter& root, const Filter& filter)
{
    for (const auto& child : root.filters) {
        if (child.get() == &filter) return &root;
        if (Filter* parent = parentOf(*child, filter)) return parent;
    }
    return nullptr;
}

template <class T>
int indexIn(const std::vector<std::unique_ptr<T>>& all, const T& one)
{
    const auto found = std::ranges::find_if(all, [&](const auto& other) { return other.get() == &one; });
    return static_cast<int>(found - all.begin());
}

}  // namespace

ScenesWidget::ScenesWidget(Editor& editor) : editor_(editor), rows_(new ProjectRows(editor, this))
{
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(rows_);
    layout->addWidget(makeBar());
    setFocusProxy(rows_);
    aim(nullptr);
    qRegisterMetaType<jet::scenes::Row>("jet::scenes::Row");
    soon_.setSingleShot(true);
    connect(&soon_, &QTimer::timeout, this, [this] {
        if (!rows_->isEditing()) return rows_->rebuild();
        soon_.start(kWhileTypingMs);  // a name being typed is not taken away
    });
    connect(rows_, &QTreeWidget::itemDoubleClicked, this,
            [this](QTreeWidgetItem* item, int) { attempt([&] { open(rows_->rowOf(*item)); }); });
    connect(rows_, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
        if (item && rows_->hasFocus() && rows_->rowOf(*item).kind != Kind::Script) aim(nullptr);
    });
    connect(rows_, &ProjectRows::filesDropped, this, &ScenesWidget::takeFiles);
    // Later: the view is in the middle of closing its line of text, and the rows are made anew.
    connect(
        rows_, &ProjectRows::renamed, this,
        [this](const Row& row, const QString& name) {
            attempt([&] { giveName(row, name.toStdString()); });
            rebuildSoon();  // a refused name is not shown
        },
        Qt::QueuedConnection);
    connect(rows_, &ProjectRows::moved, this, [this](const Row& row, Filter* filter, int index) {
        if (filter) attempt([&] { move(row, *filter, index); });
    });
    askFiles_ = [this] {
        return QFileDialog::getOpenFileNames(this, tr("Add files to the project"), {}, {}, nullptr,
                                             QFileDialog::DontUseNativeDialog);
    };
    askEmpty_ = [this](const QString& question) {
        return QMessageBox::question(this, tr("Empty removed files"), question,
                                     QMessageBox::Discard | QMessageBox::Cancel,
                                     QMessageBox::Cancel) == QMessageBox::Discard;
    };
    follow();
    rows_->rebuild();
}

void ScenesWidget::follow()
{
    EventsCenter& events = editor_.events();
    subscriptions_.push_back(events.subscribe<ProjectChanged>(nullptr, [this](const ProjectChanged&) {
        aim(nullptr);
        rows_->clear();  // it stands for what is gone
        rebuildSoon();
    }));
    subscriptions_.push_back(
        events.subscribe<ProjectTreeChanged>(nullptr, [this](const ProjectTreeChanged&) { rebuildSoon(); }));
    subscriptions_.push_back(events.subscribe<ItemsChanged>(nullptr, [this](const ItemsChanged& event) {
        if (soon_.isActive()) return;
        const bool matters = std::ranges::any_of(event.changes, [&](const Change& change) {
            const Item* item = event.scene->items().find(changedItem(change));
            const auto* property = std::get_if<PropertyChanged>(&change);
            return std::holds_alternative<ItemRemoved>(change) || std::holds_alternative<ItemAdded>(change) ||
                   (item && item->is<ScriptItem>() && !std::holds_alternative<PathChanged>(change)) ||
                   (property && property->property.ends_with("file"));
        });
        if (matters) rebuildSoon();
    }));
}

void ScenesWidget::showEvent(QShowEvent* event)
{
    QWidget::showEvent(event);
    rebuildSoon();  // files may have come and gone meanwhile
}

void ScenesWidget::aim(Scene* scene) { ui::setHistoryFocus(*this, {scene}); }

void ScenesWidget::rebuildNow()
{
    soon_.stop();
    rows_->rebuild();
}

Row ScenesWidget::currentRow() const { return rows_->current().value_or(Row{Kind::Scenes, &editor_.project().root()}); }

void ScenesWidget::attempt(const std::function<void()>& change)
{
    if (soon_.isActive()) rebuildNow();  // rows may stand for what has gone
    try {
        change();
    } catch (const std::exception& problem) {
        editor_.showMessage(problem.what());
    }
}

// --- buttons, menu and keys

std::span<const ScenesWidget::Command> ScenesWidget::commands()
{
    using W = ScenesWidget;
    static const Command all[] = {
        {"plus", QT_TR_NOOP("New scene"), &W::addScene, always, "Insert", true},
        {"group", QT_TR_NOOP("New filter"), &W::addFilter, always, "", true},
        {"script", QT_TR_NOOP("New script"), &W::addScript, takesScript, "", true},
        {"import", QT_TR_NOOP("Add files…"), &W::addFiles, always, "", true},
        {"open", QT_TR_NOOP("Open"), &W::open, opens, "Return", false},
        {"play", QT_TR_NOOP("Play first"), &W::makeStart, isScene, "", false},
        {"edit", QT_TR_NOOP("Rename"), &W::rename, isNamed, "F2", false},
        {"duplicate", QT_TR_NOOP("Duplicate"), &W::duplicate, doubles, "Ctrl+D", true},
        {"up", QT_TR_NOOP("Move up"), &W::up, isPlace, "Alt+Up", true},
        {"down", QT_TR_NOOP("Move down"), &W::down, isPlace, "Alt+Down", true},
        {"trash", QT_TR_NOOP("Delete"), &W::remove, isNamed, "Del", true},
        {"", QT_TR_NOOP("Empty removed files…"), &W::emptyRemoved, isFiles, "", false},
    };
    return all;
}

ui::CommandBar* ScenesWidget::makeBar()
{
    std::vector<ui::PanelCommand> all;
    for (const Command& command : commands())
        all.push_back({command.icon, command.text, tr(command.text), [this, &command] { run(command); },
                       [this, &command] { return command.fits(currentRow()); }, command.key, command.onBar});
    auto* bar = new ui::CommandBar(*rows_, std::move(all), this);
    bar->setFocusing(true);
    return bar;
}

void ScenesWidget::run(const Command& command)
{
    attempt([&] {
        const Row row = currentRow();
        if (command.fits(row)) (this->*command.run)(row);
    });
}

// --- commands

void ScenesWidget::open(const Row& row)
{
    if (row.kind == Kind::Scene) editor_.openScene(*row.scene);
    if (row.kind == Kind::Script) editor_.openScript(*row.scene, row.script);
    if (row.kind == Kind::File) {
        const auto file = std::filesystem::absolute(editor_.project().folder()) / row.file;
        if (!QDesktopServices::openUrl(QUrl::fromLocalFile(QString::fromStdString(file.string()))))
            editor_.showMessage(tr("No program opens %1.").arg(QString::fromStdString(row.file)).toStdString());
    }
    if (row.kind == Kind::Filter || row.kind == Kind::Scenes || row.kind == Kind::Files) {
        if (QTreeWidgetItem* item = rows_->currentItem()) item->setExpanded(!item->isExpanded());
    }
}

void ScenesWidget::addScene(const Row& row)
{
    aim(nullptr);
    Filter& filter = row.filter ? *row.filter : editor_.project().root();
    std::optional<std::size_t> index;
    if (row.scene) index = static_cast<std::size_t>(indexIn(filter.scenes, *row.scene)) + 1;
    Scene& scene = editor_.projectTree().addScene(editor_.project().freeSceneName(), filter, index);
    rebuildNow();
    rows_->makeCurrent({Kind::Scene, &filter, &scene});
    rows_->editCurrent();
}

void ScenesWidget::addFilter(const Row& row)
{
    aim(nullptr);
    Filter& parent = row.filter ? *row.filter : editor_.project().root();
    Filter& filter = editor_.projectTree().addFilter(freeFilterName(parent), parent);
    rebuildNow();
    rows_->makeCurrent({Kind::Filter, &filter});
    rows_->editCurrent();
}

void ScenesWidget::addScript(const Row& row)
{
    aim(row.scene);
    auto edit = row.scene->items().begin("Add script");
    const Item* present = row.kind == Kind::Script ? row.scene->items().find(row.script) : nullptr;
    const Item& script = edit.add<ScriptItem>(present ? *present->parent() : row.scene->root());
    edit.commit();
    rebuildNow();
    rows_->makeCurrent({Kind::Script, row.filter, row.scene, script.id()});
    aim(row.scene);  // the rows were made anew, and another one was the current one meanwhile
    rows_->editCurrent();
}

void ScenesWidget::addFiles(const Row&) { takeFiles(askFiles_()); }

void ScenesWidget::takeFiles(const QStringList& files)
{
    aim(nullptr);
    attempt([&] {
        std::string last;
        for (const QString& file : files) last = editor_.projectTree().addFile(file.toStdString());
        rebuildNow();
        rows_->makeCurrent({Kind::File, nullptr, nullptr, {}, last});
    });
}

void ScenesWidget::rename(const Row&) { rows_->editCurrent(); }

void ScenesWidget::giveName(const Row& row, const std::string& name)
{
    ProjectTree& tree = editor_.projectTree();
    aim(row.kind == Kind::Script ? row.scene : nullptr);
    switch (row.kind) {
    case Kind::Scene: return tree.rename(*row.scene, name);
    case Kind::Filter: return tree.rename(*row.filter, name);
    case Kind::File: {
        const std::filesystem::path old(row.file);  // shown with its folder, and may be typed without
        const std::filesystem::path now(name);
        return tree.renameFile(row.file, now.parent_path() == old.parent_path() ? now.filename().string() : name);
    }
    case Kind::Script: {
        const Item* script = row.scene->items().find(row.script);
        if (!script || name.empty() || name == script->name()) return;
        auto edit = row.scene->items().begin("Rename");
        edit.set(*script, "name", name);
        return edit.commit();
    }
    case Kind::Scenes:
    case Kind::Files: return;
    }
}

void ScenesWidget::duplicate(const Row& row)
{
    if (row.kind == Kind::Scene) {
        aim(nullptr);
        Scene& copy = editor_.projectTree().duplicate(*row.scene);
        rebuildNow();
        return rows_->makeCurrent({Kind::Scene, row.filter, &copy});
    }
    const Item* script = row.scene->items().find(row.script);
    if (!script) return;
    aim(row.scene);
    auto edit = row.scene->items().begin("Duplicate");
    const Item& copy = edit.addCopy(*script, *script->parent(), script->index() + 1);
    edit.commit();
    rebuildNow();
    rows_->makeCurrent({Kind::Script, row.filter, row.scene, copy.id()});
}

void ScenesWidget::remove(const Row& row)
{
    ProjectTree& tree = editor_.projectTree();
    aim(row.kind == Kind::Script ? row.scene : nullptr);
    if (row.kind == Kind::Scene) tree.remove(*row.scene);
    if (row.kind == Kind::Filter) tree.remove(*row.filter);
    if (row.kind == Kind::File) tree.removeFile(row.file);
    if (row.kind == Kind::Script) {
        const Item* script = row.scene->items().find(row.script);
        if (!script) return;
        auto edit = row.scene->items().begin("Delete");
        edit.remove(*script);
        edit.commit();
    }
}

// Nothing goes without asking, and nothing that Undo, or closing without saving, still needs.
void ScenesWidget::emptyRemoved(const Row&)
{
    ProjectTree& tree = editor_.projectTree();
    const RemovedFiles files = tree.disposableFiles();
    if (files.files.empty())
        return editor_.showMessage(tr("There are no removed files but those that Undo may bring back.").toStdString());
    QString question = tr("Delete %n removed file(s) for good, %1 in all? Nothing brings them back.", nullptr,
                          static_cast<int>(files.files.size()))
                           .arg(QLocale().formattedDataSize(static_cast<qint64>(files.bytes), 1));
    constexpr std::size_t kShown = 8;
    for (std::size_t i = 0; i < std::min(kShown, files.files.size()); ++i)
        question += '\n' + QString::fromStdString(files.files[i].filename().string());
    if (files.files.size() > kShown) question += QStringLiteral("\n…");
    if (!askEmpty_(question)) return;
    const std::size_t gone = tree.disposeFiles();
    editor_.showStatus(tr("%n file(s) deleted for good.", nullptr, static_cast<int>(gone)).toStdString());
}

void ScenesWidget::makeStart(const Row& row)
{
    aim(nullptr);
    editor_.projectTree().makeStart(*row.scene);
}

void ScenesWidget::shift(const Row& row, int by)
{
    Filter* parent = row.kind == Kind::Scene ? row.filter : parentOf(editor_.project().root(), *row.filter);
    if (!parent) return;
    const int index =
        row.kind == Kind::Scene ? indexIn(parent->scenes, *row.scene) : indexIn(parent->filters, *row.filter);
    if (index + by >= 0) move(row, *parent, by < 0 ? index - 1 : index + 2);
}

void ScenesWidget::move(const Row& row, Filter& filter, int index)
{
    aim(nullptr);
    ProjectTree& tree = editor_.projectTree();
    const auto place = [&](const auto& all, const auto& one, bool same) {
        if (index < 0) return all.size();
        const int own = same ? indexIn(all, one) : index;
        return static_cast<std::size_t>(index > own ? index - 1 : index);
    };
    if (row.kind == Kind::Scene) {
        tree.move(*row.scene, filter, place(filter.scenes, *row.scene, row.filter == &filter));
    } else if (row.kind == Kind::Filter) {
        const bool same = parentOf(editor_.project().root(), *row.filter) == &filter;
        tree.move(*row.filter, filter, place(filter.filters, *row.filter, same));
    }
}

}  // namespace jet::scenes
