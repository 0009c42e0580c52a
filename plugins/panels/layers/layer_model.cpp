#include "layer_model.hpp"

#include <jet/item_type.hpp>
#include <jet/symbols.hpp>
#include <jet/ui/icons.hpp>

#include <QApplication>
#include <QMimeData>
#include <QPalette>

#include <algorithm>
#include <utility>

namespace jet::layers {

namespace {

const QString kMimeType = QStringLiteral("application/x-jet-items");

/// In tree order, as the thesis shows it (§4.4): the order in which items are painted, the last on top, and scripts
/// run.
std::vector<ItemId> childIds(const Item& item)
{
    std::vector<ItemId> ids;
    ids.reserve(item.children().size());
    for (const auto& child : item.children()) ids.push_back(child->id());
    return ids;
}

/// What a plugin's manifest says of its kind of items; null where no installed plugin has it.
const Contribution* declared(const std::vector<Contribution>& kinds, const std::string& type)
{
    const auto found = std::ranges::find(kinds, type, &Contribution::id);
    return found == kinds.end() ? nullptr : &*found;
}

QIcon iconOf(const Item& item, const Catalog& catalog)
{
    static std::unordered_map<std::string, QIcon> icons;  // that of a plugin which comes later is no unknown one
    const std::string name = isInstance(item) ? "symbol" : item.type();
    const auto found = icons.find(name);
    if (found != icons.end()) return found->second;
    QIcon icon = ui::icon(name);
    const auto kinds = icon.isNull() ? catalog.contributions(ContributionKind::ItemType) : std::vector<Contribution>();
    const Contribution* kind = declared(kinds, name);
    if (!icon.isNull() || !kind) return icon.isNull() ? ui::icon("unknown") : icons.emplace(name, icon).first->second;
    if (!kind->icon.empty()) icon = ui::iconFromFile(kind->icon);
    return icons.emplace(name, icon.isNull() ? ui::icon("item") : icon).first->second;
}

const QIcon& toggleIcon(int column, bool on)
{
    const auto faint = [](const char* name) { return QIcon(ui::icon(name).pixmap(32, QIcon::Disabled)); };
    static const QIcon icons[] = {ui::icon("eye"), faint("eye-off"), ui::icon("lock"), faint("unlock")};
    return icons[column == Visible ? (on ? 0 : 1) : (on ? 2 : 3)];
}

QString toolTipOf(int column)
{
    if (column == Visible) return LayerModel::tr("Shown or hidden");
    return column == Locked ? LayerModel::tr("Locked: cannot be picked in the scene") : QString();
}

}  // namespace

struct LayerModel::Node {
    ItemId id;
    Node* parent = nullptr;
    std::size_t row = 0;
    bool populated = false;
    std::vector<std::unique_ptr<Node>> children = {};
};

LayerModel::LayerModel(Editor& editor, QObject* parent) : QAbstractItemModel(parent), editor_(editor) {}
LayerModel::~LayerModel() = default;

void LayerModel::setScene(Scene* scene)
{
    beginResetModel();
    scene_ = scene;
    nodes_.clear();
    root_.reset();
    changed_.reset();
    parents_.clear();
    touched_.clear();
    if (scene) {
        root_ = std::make_unique<Node>(Node{scene->root().id()});
        nodes_.emplace(root_->id.value, root_.get());
        changed_ =
            editor_.events().subscribe<ItemsChanged>(scene, [this](const ItemsChanged& event) { follow(event); });
        populate(*root_);
    }
    endResetModel();
}

// --- nodes and indexes

LayerModel::Node* LayerModel::nodeOf(const QModelIndex& index) const
{
    return index.isValid() ? static_cast<Node*>(index.internalPointer()) : root_.get();
}

QModelIndex LayerModel::indexOf(const Node& node, int column) const
{
    return &node == root_.get() ? QModelIndex() : createIndex(static_cast<int>(node.row), column, &node);
}

ItemId LayerModel::idOf(const QModelIndex& index) const
{
    return index.isValid() ? static_cast<Node*>(index.internalPointer())->id : ItemId{};
}

const Item* LayerModel::itemOf(const QModelIndex& index) const
{
    return scene_ && index.isValid() ? scene_->items().find(idOf(index)) : nullptr;
}

QModelIndex LayerModel::indexOf(ItemId id)
{
    const Item* item = scene_ ? scene_->items().find(id) : nullptr;
    std::vector<const Item*> chain;
    for (; item && item->parent(); item = item->parent()) chain.push_back(item);
    for (auto ancestor = chain.rbegin(); ancestor != chain.rend(); ++ancestor) {
        const auto parent = nodes_.find((*ancestor)->parent()->id().value);
        if (parent == nodes_.end()) return {};
        if (!parent->second->populated) fetchMore(indexOf(*parent->second));
    }
    const auto found = nodes_.find(id.value);
    return found != nodes_.end() ? indexOf(*found->second) : QModelIndex();
}

QModelIndex LayerModel::index(int row, int column, const QModelIndex& parent) const
{
    const Node* node = nodeOf(parent);
    if (!node || row < 0 || column < 0 || column >= ColumnCount ||
        static_cast<std::size_t>(row) >= node->children.size())
        return {};
    return createIndex(row, column, node->children[static_cast<std::size_t>(row)].get());
}

QModelIndex LayerModel::parent(const QModelIndex& index) const
{
    const Node* node = nodeOf(index);
    return node && node->parent ? indexOf(*node->parent) : QModelIndex();
}

int LayerModel::rowCount(const QModelIndex& parent) const
{
    const Node* node = parent.column() > 0 ? nullptr : nodeOf(parent);
    return node ? static_cast<int>(node->children.size()) : 0;
}

bool LayerModel::hasChildren(const QModelIndex& parent) const
{
    const Node* node = nodeOf(parent);
    if (!node || parent.column() > 0) return false;
    if (node->populated) return !node->children.empty();
    const Item* item = itemOf(parent);
    return item && !item->children().empty();
}

bool LayerModel::canFetchMore(const QModelIndex& parent) const
{
    const Node* node = nodeOf(parent);
    return node && !node->populated && hasChildren(parent);
}

void LayerModel::fetchMore(const QModelIndex& parent)
{
    Node* node = nodeOf(parent);
    if (!node || node->populated) return;
    node->populated = true;
    sync(*node);
}

// --- the mirror

void LayerModel::populate(Node& node)
{
    const Item* item = scene_->items().find(node.id);
    if (!item) item = &scene_->root();
    for (const ItemId id : childIds(*item)) {
        node.children.push_back(std::make_unique<Node>(Node{id, &node, node.children.size()}));
        nodes_.emplace(id.value, node.children.back().get());
    }
    node.populated = true;
}

void LayerModel::forget(const Node& node)
{
    // An item that moved may already stand elsewhere, under a node of its own.
    if (const auto known = nodes_.find(node.id.value); known != nodes_.end() && known->second == &node)
        nodes_.erase(known);
    for (const auto& child : node.children) forget(*child);
}

void LayerModel::removeRows(Node& node, std::size_t first, std::size_t count)
{
    if (count == 0) return;
    beginRemoveRows(indexOf(node), static_cast<int>(first), static_cast<int>(first + count - 1));
    const auto begin = node.children.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    for (auto child = begin; child != end; ++child) forget(**child);
    node.children.erase(begin, end);
    for (std::size_t row = first; row < node.children.size(); ++row) node.children[row]->row = row;
    endRemoveRows();
}

void LayerModel::insertRows(Node& node, std::size_t first, std::span<const ItemId> ids)
{
    if (ids.empty()) return;
    beginInsertRows(indexOf(node), static_cast<int>(first), static_cast<int>(first + ids.size() - 1));
    std::vector<std::unique_ptr<Node>> made;
    made.reserve(ids.size());
    for (const ItemId id : ids) {
        made.push_back(std::make_unique<Node>(Node{id, &node}));
        nodes_[id.value] = made.back().get();
    }
    node.children.insert(node.children.begin() + static_cast<std::ptrdiff_t>(first),
                         std::make_move_iterator(made.begin()), std::make_move_iterator(made.end()));
    for (std::size_t row = first; row < node.children.size(); ++row) node.children[row]->row = row;
    endInsertRows();
}

void LayerModel::sync(Node& node)
{
    // What differs lies between the longest equal start and the longest equal end.
    const Item* item = &node == root_.get() ? &scene_->root() : scene_->items().find(node.id);
    const std::vector<ItemId> now = item ? childIds(*item) : std::vector<ItemId>();
    const auto& old = node.children;
    std::size_t head = 0, tail = 0;
    while (head < old.size() && head < now.size() && old[head]->id == now[head]) ++head;
    while (tail < old.size() - head && tail < now.size() - head &&
           old[old.size() - 1 - tail]->id == now[now.size() - 1 - tail]) {
        ++tail;
    }
    removeRows(node, head, old.size() - head - tail);
    insertRows(node, head, std::span(now).subspan(head, now.size() - head - tail));
}

// Only notes what changed: a script or a drag may commit a thousand times before the next frame.
void LayerModel::follow(const ItemsChanged& event)
{
    const auto note = [&](const auto& change) {
        using T = std::decay_t<decltype(change)>;
        if constexpr (std::is_same_v<T, ItemAdded> || std::is_same_v<T, ItemRemoved>) {
            parents_.insert(change.parent.value);
        } else if constexpr (std::is_same_v<T, ItemMoved>) {
            parents_.insert({change.oldParent.value, change.newParent.value});
        } else if constexpr (std::is_same_v<T, PropertyChanged> || std::is_same_v<T, TypeChanged>) {
            touched_.insert(change.item.value);
        }
    };
    for (const Change& change : event.changes) std::visit(note, change);
    if (flushing_ || (parents_.empty() && touched_.empty())) return;
    flushing_ = true;
    QMetaObject::invokeMethod(this, &LayerModel::flush, Qt::QueuedConnection);
}

void LayerModel::flush()
{
    flushing_ = false;
    const auto parents = std::exchange(parents_, {}), touched = std::exchange(touched_, {});
    if (!scene_ || (parents.empty() && touched.empty())) return;
    for (const std::uint64_t parent : parents) {
        const auto found = nodes_.find(parent);
        if (found == nodes_.end()) continue;
        if (found->second->populated) sync(*found->second);
        rowChanged(ItemId{parent});  // it may have got its first child, or lost its last
    }
    for (const std::uint64_t row : touched) rowChanged(ItemId{row});
    emit updated();
    if (!parents.empty()) emit structureChanged();
}

void LayerModel::rowChanged(ItemId item)
{
    const auto found = nodes_.find(item.value);
    if (found == nodes_.end() || found->second == root_.get()) return;
    emit dataChanged(indexOf(*found->second, Name), indexOf(*found->second, ColumnCount - 1));
}

// --- what is shown

// An item whose plugin is absent says who that is.
QString LayerModel::typeToolTip(const Item& item) const
{
    if (const Item* symbol = symbolOf(*scene_, item))
        return tr("Instance of the symbol %1: what is changed in it changes in all of them.")
            .arg(QString::fromStdString(symbol->name()));
    Catalog& catalog = scene_->catalog();
    if (const ItemType* builtIn = builtInItemType(item.type())) return QString::fromStdString(builtIn->label());
    const auto kinds = catalog.contributions(ContributionKind::ItemType);
    if (const Contribution* kind = declared(kinds, item.type()); kind && catalog.itemType(item.type()))
        return QString::fromStdString(kind->label);
    return QString::fromStdString(catalog.explain(ContributionKind::ItemType, item.type()));
}

QVariant LayerModel::data(const QModelIndex& index, int role) const
{
    const Item* item = itemOf(index);
    if (!item) return {};
    const int column = index.column();
    switch (role) {
    case Qt::DisplayRole: return column == Name ? QString::fromStdString(item->name()) : QVariant();
    case Qt::EditRole: return QString::fromStdString(item->name());
    case Qt::DecorationRole:
        if (column == Name) return iconOf(*item, scene_->catalog());
        return toggleIcon(column, column == Visible ? item->visible() : item->locked());
    case Qt::ToolTipRole: return column == Name ? typeToolTip(*item) : toolTipOf(column);
    case Qt::ForegroundRole:
        return item->shown() && item->editable() ? QVariant()
                                                 : QApplication::palette().brush(QPalette::Disabled, QPalette::Text);
    default: return {};
    }
}

Qt::ItemFlags LayerModel::flags(const QModelIndex& index) const
{
    const Item* item = itemOf(index);
    if (!item) return index.isValid() ? Qt::NoItemFlags : Qt::ItemIsDropEnabled;
    Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
    if (index.column() == Name) flags |= Qt::ItemIsEditable | Qt::ItemIsDragEnabled;
    if (item->isContainer()) {
        flags |= Qt::ItemIsDropEnabled;
    } else {
        flags |= Qt::ItemNeverHasChildren;
    }
    return flags;
}

bool LayerModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
    const Item* item = itemOf(index);
    if (!item || role != Qt::EditRole) return false;
    switch (index.column()) {
    case Name:
        if (value.toString().trimmed().isEmpty()) return false;
        edit(*item, "Rename", "name", value.toString().trimmed().toStdString());
        return true;
    case Visible: edit(*item, value.toBool() ? "Show" : "Hide", "visible", value.toBool()); return true;
    case Locked: edit(*item, value.toBool() ? "Lock" : "Unlock", "locked", value.toBool()); return true;
    default: return false;
    }
}

void LayerModel::edit(const Item& item, std::string_view label, std::string_view property, Value value)
{
    if (scene_->items().inTransaction()) return;
    auto change = scene_->items().begin(label);
    change.set(item, property, std::move(value));
    change.commit();
}

// --- drag and drop

QStringList LayerModel::mimeTypes() const { return {kMimeType}; }

QMimeData* LayerModel::mimeData(const QModelIndexList& indexes) const
{
    QByteArray ids;
    for (const QModelIndex& index : indexes) {
        if (index.column() == Name) ids += QByteArray::number(static_cast<qulonglong>(idOf(index).value)) + ' ';
    }
    auto* data = new QMimeData;
    data->setData(kMimeType, ids);
    return data;
}

std::vector<const Item*> LayerModel::draggedItems(const QMimeData& data) const
{
    std::unordered_set<std::uint64_t> dragged;
    for (const QByteArray& id : data.data(kMimeType).split(' ')) dragged.insert(id.toULongLong());
    std::vector<const Item*> items;  // in tree order, without what lies in a dragged group
    scene_->root().walk([&](const Item& item) {
        if (!dragged.contains(item.id().value)) return true;
        items.push_back(&item);
        return false;
    });
    return items;
}

bool LayerModel::canDropMimeData(const QMimeData* data, Qt::DropAction action, int, int,
                                 const QModelIndex& parent) const
{
    if (!scene_ || action != Qt::MoveAction || !data->hasFormat(kMimeType)) return false;
    const Item* target = parent.isValid() ? itemOf(parent) : &scene_->root();
    if (!target || !(target->isContainer() || target == &scene_->root())) return false;
    for (const Item* item : draggedItems(*data)) {
        if (item == target || item->isAncestorOf(*target)) return false;
    }
    return true;
}

bool LayerModel::dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                              const QModelIndex& parent)
{
    if (!canDropMimeData(data, action, row, column, parent) || scene_->items().inTransaction()) return false;
    const Item& target = parent.isValid() ? *itemOf(parent) : scene_->root();
    const std::vector<const Item*> items = draggedItems(*data);
    // Dropped between rows: the dragged ones go before the first row below that is not dragged itself.
    const std::size_t count = target.children().size();
    const Item* below = row >= 0 && static_cast<std::size_t>(row) < count
                            ? target.children()[static_cast<std::size_t>(row)].get()
                            : nullptr;
    const auto isDragged = [&](const Item* item) { return std::find(items.begin(), items.end(), item) != items.end(); };
    while (below && isDragged(below)) below = below->sibling();
    auto change = scene_->items().begin("Reorder");
    for (const Item* item : items) {
        // Counted without the item itself: it leaves a gap when it comes from before.
        std::size_t index = below ? below->index() : target.children().size();
        if (item->parent() == &target && item->index() < index) --index;
        change.move(*item, target, index);
    }
    change.commit();
    return true;
}

}  // namespace jet::layers
