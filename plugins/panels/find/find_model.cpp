#include "find_model.hpp"

#include <jet/symbols.hpp>
#include <jet/ui/icons.hpp>

namespace jet::find {

namespace {

/// "Layer 1 / Hero": where the item is.
QString placeOf(const Item& item)
{
    QString place;
    for (const Item* up = item.parent(); up && up->parent(); up = up->parent())
        place = QString::fromStdString(up->name()) + (place.isEmpty() ? "" : " / ") + place;
    return place;
}

}  // namespace

void FindModel::show(Scene* scene, std::vector<ItemId> found)
{
    beginResetModel();
    scene_ = scene;
    found_ = std::move(found);
    endResetModel();
}

const Item* FindModel::itemAt(int row) const
{
    if (!scene_ || row < 0 || static_cast<std::size_t>(row) >= found_.size()) return nullptr;
    return scene_->items().find(found_[static_cast<std::size_t>(row)]);
}

int FindModel::rowCount(const QModelIndex& parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(found_.size());
}

QVariant FindModel::data(const QModelIndex& index, int role) const
{
    const Item* item = itemAt(index.row());
    if (!item) return {};
    switch (role) {
    case Qt::DisplayRole: return QString::fromStdString(item->name());
    case Qt::ToolTipRole: return placeOf(*item);
    case Qt::DecorationRole: {
        const QIcon icon = ui::icon(isInstance(*item) ? "symbol" : item->type());
        return icon.isNull() ? ui::icon("unknown") : icon;
    }
    default: return {};
    }
}

}  // namespace jet::find
