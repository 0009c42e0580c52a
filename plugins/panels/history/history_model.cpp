#include "history_model.hpp"

#include <QCoreApplication>
#include <QFont>
#include <QGuiApplication>
#include <QPalette>

namespace jet::history {

namespace {

QString translated(const char* text, int n = -1) { return QCoreApplication::translate("History", text, nullptr, n); }

}  // namespace

void HistoryModel::setScene(Scene* scene)
{
    scene_ = scene;
    refresh();
}

void HistoryModel::refresh()
{
    beginResetModel();
    rows_ = scene_ ? static_cast<int>(scene_->undoRedo().size()) + 1 : 0;
    endResetModel();
}

int HistoryModel::currentRow() const { return scene_ ? static_cast<int>(scene_->undoRedo().position()) : -1; }

int HistoryModel::rowCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : rows_; }

bool HistoryModel::isSaved(int row) const
{
    return scene_->undoRedo().cleanPosition() == std::optional(static_cast<std::size_t>(row));
}

QString HistoryModel::textOf(int row) const
{
    const UndoRedoCenter& history = scene_->undoRedo();
    if (row > 0) {
        const std::size_t step = static_cast<std::size_t>(row) - 1;
        return step < history.size() ? QString::fromStdString(history.label(step)) : QString();
    }
    if (history.forgotten() == 0) return translated("As opened");
    return translated("%n older step(s) forgotten to stay within the memory allowed",
                      static_cast<int>(history.forgotten()));
}

QVariant HistoryModel::data(const QModelIndex& index, int role) const
{
    if (!scene_ || !index.isValid() || index.row() >= rows_) return {};
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
