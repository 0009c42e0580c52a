// LayerModel: a scene's tree as a Qt model, in tree order.
//
// Qt wants to be told before rows come and go; a scene tells afterwards. So the model keeps a mirror of the ids it has
// shown, and brings it in line, parent by parent, when a change was committed. The children of an item are mirrored
// when a view first asks for them: a folded layer of 100,000 items costs nothing, an open one a few milliseconds.
#pragma once

#include <jet/editor.hpp>

#include <QAbstractItemModel>

#include <memory>
#include <unordered_map>
#include <unordered_set>

namespace jet::layers {

enum Column { Name, Visible, Locked, ColumnCount };

class LayerModel final : public QAbstractItemModel {
    Q_OBJECT

public:
    LayerModel(Editor& editor, QObject* parent);
    ~LayerModel() override;

    void setScene(Scene* scene);
    Scene* scene() const { return scene_; }

    ItemId idOf(const QModelIndex& index) const;
    const Item* itemOf(const QModelIndex& index) const;
    /// Brings the rows in line with the scene now, instead of when the event loop turns.
    void flush();
    /// The row of the item, mirroring its ancestors' children if need be; invalid when it is not in the tree.
    QModelIndex indexOf(ItemId item);

    QModelIndex index(int row, int column, const QModelIndex& parent) const override;
    QModelIndex parent(const QModelIndex& index) const override;
    int rowCount(const QModelIndex& parent) const override;
    int columnCount(const QModelIndex&) const override { return ColumnCount; }
    bool hasChildren(const QModelIndex& parent) const override;
    bool canFetchMore(const QModelIndex& parent) const override;
    void fetchMore(const QModelIndex& parent) override;
    QVariant data(const QModelIndex& index, int role) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;

    Qt::DropActions supportedDropActions() const override { return Qt::MoveAction; }
    QStringList mimeTypes() const override;
    QMimeData* mimeData(const QModelIndexList& indexes) const override;
    bool canDropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                         const QModelIndex& parent) const override;
    bool dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                      const QModelIndex& parent) override;

signals:
    /// The rows follow the scene again: once for all that was committed since the event loop last turned.
    void updated();
    /// Rows were put in or taken out; selection and open branches may have to be shown again.
    void structureChanged();

private:
    struct Node;

    QString typeToolTip(const Item& item) const;
    Node* nodeOf(const QModelIndex& index) const;
    QModelIndex indexOf(const Node& node, int column = Name) const;
    void populate(Node& node);
    void sync(Node& node);
    void forget(const Node& node);
    void insertRows(Node& node, std::size_t first, std::span<const ItemId> ids);
    void removeRows(Node& node, std::size_t first, std::size_t count);
    void follow(const ItemsChanged& event);
    void rowChanged(ItemId item);
    std::vector<const Item*> draggedItems(const QMimeData& data) const;
    void edit(const Item& item, std::string_view label, std::string_view property, Value value);

    Editor& editor_;
    Scene* scene_ = nullptr;
    std::unique_ptr<Node> root_;
    std::unordered_map<std::uint64_t, Node*> nodes_;
    std::unordered_set<std::uint64_t> parents_, touched_;  // ids: whose children changed, and whose own row
    bool flushing_ = false;                                // at the next turn of the event loop
    Subscription changed_;
};

}  // namespace jet::layers
