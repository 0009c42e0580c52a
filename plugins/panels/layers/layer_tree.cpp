#include "layer_tree.hpp"

#include <QHeaderView>
#include <QMouseEvent>
#include <QScopedValueRollback>
#include <QScrollBar>

#include <algorithm>

namespace jet::layers {

namespace {

constexpr int kToggleWidth = 26;
constexpr std::size_t kRevealAtMost = 200;  // selecting more does not unfold their groups

}  // namespace

LayerTree::LayerTree(LayerModel& model, Editor& editor, QWidget* parent)
    : QTreeView(parent), model_(model), editor_(editor)
{
    setModel(&model);
    setHeaderHidden(true);
    setUniformRowHeights(true);  // without it, 100,000 rows are measured one by one
    setSelectionMode(ExtendedSelection);
    setEditTriggers(EditKeyPressed);  // F2; a double click goes through mouseDoubleClickEvent
    setDragEnabled(true);
    setAcceptDrops(true);
    setDropIndicatorShown(true);
    setDragDropMode(InternalMove);
    setAllColumnsShowFocus(true);
    setIndentation(14);
    setContextMenuPolicy(Qt::CustomContextMenu);
    header()->setStretchLastSection(false);
    header()->setMinimumSectionSize(kToggleWidth);
    header()->setSectionResizeMode(Name, QHeaderView::Stretch);
    for (const int column : {Visible, Locked}) {
        header()->setSectionResizeMode(column, QHeaderView::Fixed);
        header()->resizeSection(column, kToggleWidth);
    }
    connect(this, &QTreeView::clicked, this, &LayerTree::toggle);
    connect(this, &QTreeView::expanded, this, [this](const QModelIndex& index) { remember(index, true); });
    connect(this, &QTreeView::collapsed, this, [this](const QModelIndex& index) { remember(index, false); });
    connect(&model, &LayerModel::structureChanged, this, [this] {
        showOpenBranches();
        showSelection();
    });
}

void LayerTree::showScene(Scene* scene)
{
    const QScopedValueRollback following(following_, true);
    model_.setScene(scene);
    selected_.reset();
    if (!scene) return;
    selected_ = editor_.events().subscribeCoalesced<SelectionChanged>(
        scene, [this](const SelectionChanged&) { showSelection(); });
    // Layers start open; deeper groups as they were left.
    for (const auto& child : scene->root().children()) {
        if (child->is<LayerItem>()) open_.insert(child->id().value);
    }
    showOpenBranches();
    showSelection();
}

// --- branches

void LayerTree::remember(const QModelIndex& index, bool open)
{
    const std::uint64_t id = model_.idOf(index).value;
    open ? void(open_.insert(id)) : void(open_.erase(id));
}

void LayerTree::showOpenBranches()
{
    if (!model_.scene()) return;
    const int scroll = verticalScrollBar()->value();
    for (const std::uint64_t id : std::vector(open_.begin(), open_.end())) {
        const Item* item = model_.scene()->items().find(ItemId{id});
        if (!item || !item->isContainer()) continue;
        const QModelIndex index = model_.indexOf(ItemId{id});
        if (index.isValid() && !isExpanded(index)) expand(index);
    }
    verticalScrollBar()->setValue(scroll);
}

// --- selection

void LayerTree::selectionChanged(const QItemSelection& selected, const QItemSelection& deselected)
{
    QTreeView::selectionChanged(selected, deselected);
    if (following_ || !model_.scene() || model_.scene()->items().inTransaction()) return;
    const QScopedValueRollback following(following_, true);
    std::vector<ItemId> ids;
    for (const QModelIndex& index : selectionModel()->selectedRows()) ids.push_back(model_.idOf(index));
    model_.scene()->items().setSelection(std::move(ids));
}

void LayerTree::showSelection()
{
    if (following_ || !model_.scene()) return;
    const QScopedValueRollback following(following_, true);
    const std::vector<ItemId>& ids = model_.scene()->items().selection();
    // Ranges of rows, not single rows: a QItemSelection of 100,000 ranges takes minutes.
    QMap<QModelIndex, std::vector<int>> rowsByParent;
    QModelIndex last;
    for (const ItemId id : ids) {
        last = model_.indexOf(id);
        if (last.isValid()) rowsByParent[last.parent()].push_back(last.row());
    }
    QItemSelection selection;
    for (auto entry = rowsByParent.begin(); entry != rowsByParent.end(); ++entry) {
        std::vector<int>& rows = entry.value();
        std::sort(rows.begin(), rows.end());
        for (std::size_t first = 0; first < rows.size();) {
            std::size_t end = first + 1;
            while (end < rows.size() && rows[end] == rows[end - 1] + 1) ++end;
            selection.append(QItemSelectionRange(model_.index(rows[first], Name, entry.key()),
                                                 model_.index(rows[end - 1], ColumnCount - 1, entry.key())));
            first = end;
        }
    }
    selectionModel()->select(selection, QItemSelectionModel::ClearAndSelect);
    if (!last.isValid() || ids.size() > kRevealAtMost) return;
    selectionModel()->setCurrentIndex(last, QItemSelectionModel::NoUpdate);
    scrollTo(last);
}

void LayerTree::currentChanged(const QModelIndex& current, const QModelIndex& previous)
{
    QTreeView::currentChanged(current, previous);
    const Item* item = model_.itemOf(current);
    while (item && !item->is<LayerItem>()) item = item->parent();
    if (item) editor_.setActiveLayer(item->id());
}

const Item* LayerTree::currentContainer() const
{
    const Item* item = model_.itemOf(currentIndex());
    while (item && !item->isContainer()) item = item->parent();
    return item && item->parent() ? item : nullptr;
}

// --- clicks

void LayerTree::toggle(const QModelIndex& index)
{
    const Item* item = model_.itemOf(index);
    if (!item || index.column() == Name) return;
    model_.setData(index, index.column() == Visible ? !item->visible() : !item->locked(), Qt::EditRole);
}

void LayerTree::mouseDoubleClickEvent(QMouseEvent* event)
{
    const QModelIndex index = indexAt(event->pos());
    if (index.isValid() && index.column() == Name && event->button() == Qt::LeftButton) {
        edit(index);
    } else {
        mousePressEvent(event);  // two quick clicks on an eye toggle twice
    }
}

void LayerTree::renameCurrent()
{
    const QModelIndex index = currentIndex();
    if (index.isValid()) edit(index.siblingAtColumn(Name));
}

}  // namespace jet::layers
