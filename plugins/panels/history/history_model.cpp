#include "history_model.hpp"

#include <QCoreApplication>
#include <QFont>
#include <QGuiApplication>
#include <QPalette>

namespace jet::history {

namespace {

QString translated(const char* text, int n = -1) { return QCoreApplication::translate("History", text, nullptr, n); }

}  // namespace

void HistoryModel::show(Scene* scene)
{
    scene_ = scene;
    tree_ = nullptr;
    refresh();
}

void HistoryModel::show(ProjectTree& tree)
{
    scene_ = nullptr;
    tree_ = &tree;
    refresh();
}

void HistoryModel::refresh()
{
    beginResetModel();
    treeLabels_ = tree_ ? tree_->labels() : std::vector<std::string>();
    rows_ = 0;
    if (tree_) rows_ = static_cast<int>(treeLabels_.size()) + 1;
    if (scene_) rows_ = static_cast<int>(scene_->undoRedo().size()) + 1;
    endResetModel();
}

int HistoryModel::currentRow() const
{
    if (tree_) return static_cast<int>(tree_->position());
    return scene_ ? static_cast<int>(scene_->undoRedo().position()) : -1;
}

void HistoryModel::goTo(int row)
{
    const auto position = static_cast<std::size_t>(row);
    if (tree_) tree_->goTo(position);
    if (scene_) scene_->undoRedo().goTo(position);
}

QString HistoryModel::undoLabel() const
{
    if (tree_) return QString::fromStdString(tree_->undoLabel());
    return scene_ ? QString::fromStdString(scene_->undoRedo().undoLabel()) : QString();
}

int HistoryModel::rowCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : rows_; }

bool HistoryModel::isSaved(int row) const
{
    return scene_ && scene_->undoRedo().cleanPosition() == std::optional(static_cast<std::size_t>(row));
}

QString HistoryModel::textOf(int row) const
{
    const std::size_t step = static_cast<std::size_t>(row) - 1;
    if (tree_) {
        if (row == 0) return translated("As opened");
        return step < treeLabels_.size() ? QString::fromStdString(treeLabels_[step]) : QString();
    }
    const UndoRedoCenter& history = scene_->undoRedo();
    if (row > 0) return step < history.size() ? QString::fromStdString(history.label(step)) : QString();
    if (history.forgotten() == 0) return translated("As opened");
    return translated("%n older step(s) forgotten to stay within the memory allowed",
                      static_cast<int>(history.forgotten()));
}

QVariant HistoryModel::data(const QModelIndex& index, int role) const
{
    if ((!scene_ && !tree_) || !index.isValid() || index.row() >= rows_) return {};
    const int row = index.row();
    switch (role) {
    case Qt::DisplayRole: return isSaved(row) ? translated("%1   (saved)").arg(textOf(row)) : textOf(row);
    case Qt::ToolTipRole: return row > currentRow() ? translated("Redo up to here") : translated("Go back to here");
    case Qt::FontRole: {
        QFont font = QGuiApplication::font();
        font.setBold(row == currentRow());
        return font;
    }
    case Qt::ForegroundRole:
        if (row <= currentRow()) return {};
        return QGuiApplication::palette().color(QPalette::Disabled, QPalette::Text);
    case SavedRole: return isSaved(row);
    case CurrentRole: return row == currentRow();
    case UndoneRole: return row > currentRow();
    default: return {};
    }
}

}  // namespace jet::history
