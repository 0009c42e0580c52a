// The items that were found, as a list. It keeps ids: an item may be gone before the list is told.
#pragma once

#include <jet/scene.hpp>

#include <QAbstractListModel>

#include <vector>

namespace jet::find {

class FindModel final : public QAbstractListModel {
    Q_OBJECT

public:
    using QAbstractListModel::QAbstractListModel;

    void show(Scene* scene, std::vector<ItemId> found);
    const std::vector<ItemId>& found() const { return found_; }
    /// Null when it has gone meanwhile.
    const Item* itemAt(int row) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;

private:
    Scene* scene_ = nullptr;
    std::vector<ItemId> found_;
};

}  // namespace jet::find
