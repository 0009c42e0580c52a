#include "project_rows.hpp"

#include <jet/assets.hpp>
#include <jet/start_scene.hpp>
#include <jet/ui/icons.hpp>

#include <QDragEnterEvent>
#include <QFileInfo>
#include <QHeaderView>
#include <QMimeData>
#include <QTreeWidgetItemIterator>
#include <QUrl>

#include <algorithm>
#include <map>

namespace jet::scenes {

namespace {

constexpr int kRowRole = Qt::UserRole;
constexpr int kName = 0, kMark = 1;

QString textOf(const std::string& text) { return QString::fromStdString(text); }

QString numbered(const void* address) { return QString::number(reinterpret_cast<quintptr>(address)); }

const char* iconOf(const std::string& file)
{
    const QString suffix = QFileInfo(textOf(file)).suffix().toLower();
    static const QStringList pictures{"png", "jpg", "jpeg", "gif", "bmp", "webp", "svg"};
    return pictures.contains(suffix) ? "scene" : "new";
}

/// The local files of a drag from a file manager.
QStringList localFiles(const QMimeData& data)
{
    QStringList files;
    for (const QUrl& url : data.urls())
        if (url.isLocalFile() && QFileInfo(url.toLocalFile()).isFile()) files << url.toLocalFile();
    return files;
}

}  // namespace

QString Row::key() const
{
    switch (kind) {
    case Kind::Scenes: return "scenes";
    case Kind::Filter: return "filter " + numbered(filter);
    case Kind::Scene: return "scene " + numbered(scene);
    case Kind::Script: return "script " + numbered(scene) + ' ' + QString::number(script.value);
    case Kind::Files: return "files";
    case Kind::File: return "file " + textOf(file);
    }
    return {};
}

ProjectRows::ProjectRows(Editor& editor, QWidget* parent) : QTreeWidget(parent), editor_(editor)
{
    setObjectName("scenes-tree");
    setAccessibleName(tr("Scenes"));
    setColumnCount(2);
    setHeaderHidden(true);
    header()->setStretchLastSection(false);
    header()->setSectionResizeMode(kName, QHeaderView::Stretch);
    header()->setSectionResizeMode(kMark, QHeaderView::ResizeToContents);
    setEditTriggers(EditKeyPressed);
    setExpandsOnDoubleClick(false);  // it opens
    setUniformRowHeights(true);
    setSelectionMode(SingleSelection);
    setDragDropMode(DragDrop);
    setDefaultDropAction(Qt::MoveAction);
    connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
        if (building_ || column != kName) return;
        emit renamed(rowOf(*item), item->text(kName).trimmed());
    });
    const auto note = [this](QTreeWidgetItem* item, bool open) {
        if (building_) return;
        open ? (void)closed_.erase(rowOf(*item).key()) : (void)closed_.insert(rowOf(*item).key());
    };
    connect(this, &QTreeWidget::itemExpanded, this, [note](QTreeWidgetItem* item) { note(item, true); });
    connect(this, &QTreeWidget::itemCollapsed, this, [note](QTreeWidgetItem* item) { note(item, false); });
}

// --- building

QTreeWidgetItem* ProjectRows::add(QTreeWidgetItem* parent, Row row, const QString& text, const char* icon)
{
    auto* item = parent ? new QTreeWidgetItem(parent) : new QTreeWidgetItem(this);
    item->setText(kName, text);
    item->setIcon(kName, ui::icon(icon));
    item->setData(kName, kRowRole, static_cast<int>(rows_.size()));
    const bool fixed = row.kind == Row::Kind::Scenes || row.kind == Row::Kind::Files;
    Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
    if (!fixed) flags |= Qt::ItemIsEditable;
    if (row.kind == Row::Kind::Scene || row.kind == Row::Kind::Filter) flags |= Qt::ItemIsDragEnabled;
    if (row.filter || row.kind == Row::Kind::Files) flags |= Qt::ItemIsDropEnabled;
    item->setFlags(flags);
    rows_.push_back(std::move(row));
    return item;
}

void ProjectRows::rebuild()
{
    const std::optional<Row> before = current();
    building_ = true;
    clear();
    rows_.clear();
    Filter& root = editor_.project().root();
    QTreeWidgetItem* scenes = add(nullptr, {Row::Kind::Scenes, &root}, textOf(editor_.project().name()), "group");
    scenes->setToolTip(kName, tr("The project's scenes. The one with the mark plays first."));
    addFilter(*scenes, root);
    QTreeWidgetItem* files = add(nullptr, {Row::Kind::Files}, tr("Files"), "open");
    files->setToolTip(kName, tr("Pictures, sounds and what else lies in the project's folder."));
    addFiles(*files);
    for (QTreeWidgetItemIterator it(this); *it; ++it) (*it)->setExpanded(!closed_.contains(rowOf(**it).key()));
    building_ = false;
    if (before) makeCurrent(*before);
}

void ProjectRows::addFilter(QTreeWidgetItem& parent, Filter& filter)
{
    for (const auto& scene : filter.scenes) addScene(parent, filter, *scene);
    for (const auto& child : filter.filters) {
        QTreeWidgetItem* item = add(&parent, {Row::Kind::Filter, child.get()}, textOf(child->name), "group");
        addFilter(*item, *child);
    }
}

void ProjectRows::addScene(QTreeWidgetItem& parent, Filter& filter, Scene& scene)
{
    QTreeWidgetItem* item = add(&parent, {Row::Kind::Scene, &filter, &scene}, textOf(scene.name()), "scene");
    if (startScene(editor_.project()) == &scene) {
        item->setIcon(kMark, ui::icon("play"));
        item->setToolTip(kMark, tr("This scene plays first."));
    }
    scene.root().walk([&](const Item& one) {
        if (one.is<ScriptItem>())
            add(item, {Row::Kind::Script, &filter, &scene, one.id()}, textOf(one.name()), "script");
    });
}

void ProjectRows::addFiles(QTreeWidgetItem& parent)
{
    std::map<std::filesystem::path, int> uses;
    for (const AssetReference& reference : findAssets(editor_.project())) ++uses[reference.file];
    std::error_code ignored;
    const auto folder = std::filesystem::absolute(editor_.project().folder(), ignored);
    const auto show = [&](const std::string& file, bool isThere) {
        const auto used = uses.find((folder / file).lexically_normal());
        const int count = used == uses.end() ? 0 : used->second;
        QTreeWidgetItem* item = add(&parent, {Row::Kind::File, nullptr, nullptr, {}, file}, textOf(file),
                                    isThere ? iconOf(file) : "warning");
        if (!isThere) item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
        const QString note = count == 0 ? tr("No scene uses it.") : tr("Used in %n place(s).", nullptr, count);
        item->setToolTip(kName, isThere ? note : tr("This file is missing. %1").arg(note));
        if (isThere && count == 0) item->setForeground(kName, palette().brush(QPalette::Disabled, QPalette::Text));
        if (used != uses.end()) uses.erase(used);
    };
    for (const std::string& file : assetFiles(editor_.project())) show(file, true);
    std::vector<std::filesystem::path> rest;  // what lies elsewhere, or nowhere
    rest.reserve(uses.size());
    for (const auto& [file, count] : uses) rest.push_back(file);
    for (const auto& file : rest) {
        const std::string shown =
            liesIn(file, folder) ? file.lexically_relative(folder).generic_string() : file.string();
        show(shown, std::filesystem::exists(file, ignored));
    }
}

// --- rows

Row ProjectRows::rowOf(const QTreeWidgetItem& item) const
{
    return rows_.at(static_cast<std::size_t>(item.data(kName, kRowRole).toInt()));
}

std::optional<Row> ProjectRows::current() const
{
    const QTreeWidgetItem* item = currentItem();
    return item ? std::optional(rowOf(*item)) : std::nullopt;
}

QTreeWidgetItem* ProjectRows::find(const QString& key) const
{
    for (QTreeWidgetItemIterator it(const_cast<ProjectRows*>(this)); *it; ++it)
        if (rowOf(**it).key() == key) return *it;
    return nullptr;
}

void ProjectRows::makeCurrent(const Row& row)
{
    if (QTreeWidgetItem* item = find(row.key())) setCurrentItem(item);
}

void ProjectRows::editCurrent()
{
    if (QTreeWidgetItem* item = currentItem(); item && (item->flags() & Qt::ItemIsEditable)) editItem(item, kName);
}

// --- drag and drop

QStringList ProjectRows::mimeTypes() const { return QTreeWidget::mimeTypes() << "text/uri-list"; }

void ProjectRows::dragEnterEvent(QDragEnterEvent* event)
{
    if (event->source() != this && !localFiles(*event->mimeData()).isEmpty()) return event->acceptProposedAction();
    if (event->source() == this) QTreeWidget::dragEnterEvent(event);
}

void ProjectRows::dragMoveEvent(QDragMoveEvent* event)
{
    QTreeWidget::dragMoveEvent(event);
    if (event->source() != this && !localFiles(*event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void ProjectRows::dropEvent(QDropEvent* event)
{
    if (event->source() != this) {
        const QStringList files = localFiles(*event->mimeData());
        event->acceptProposedAction();
        if (!files.isEmpty()) emit filesDropped(files);
        return;
    }
    event->setDropAction(Qt::IgnoreAction);  // the rows follow the project, not the drag
    event->accept();
    const auto dragged = current();
    QTreeWidgetItem* target = itemAt(event->position().toPoint());
    bool isAbove = dropIndicatorPosition() == AboveItem, isOn = dropIndicatorPosition() == OnItem;
    if (target && rowOf(*target).kind == Row::Kind::Script) target = target->parent(), isAbove = isOn = false;
    if (!dragged || !target || !rowOf(*target).filter) return;
    const Row at = rowOf(*target);
    QTreeWidgetItem* parent = target->parent();
    if (!parent || (isOn && at.kind == Row::Kind::Filter)) {
        emit moved(*dragged, at.filter, -1);  // into it
    } else if (at.kind == dragged->kind) {
        int index = isAbove ? 0 : 1;  // among those of its kind
        for (int i = 0; i < parent->indexOfChild(target); ++i)
            index += rowOf(*parent->child(i)).kind == at.kind ? 1 : 0;
        emit moved(*dragged, rowOf(*parent).filter, index);
    } else {
        emit moved(*dragged, rowOf(*parent).filter, at.kind == Row::Kind::Scene ? 0 : -1);
    }
}

}  // namespace jet::scenes
