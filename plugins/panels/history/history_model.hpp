// HistoryModel: the states of a scene as rows. Row 0 is the oldest state that can be reached, row n the state after
// step n.
#pragma once

#include <jet/scene.hpp>

#include <QAbstractListModel>

namespace jet::history {

class HistoryModel final : public QAbstractListModel {
public:
    enum Role { SavedRole = Qt::UserRole, CurrentRole, UndoneRole };

    explicit HistoryModel(QObject* parent) : QAbstractListModel(parent) {}

    /// Shows another scene's history, or none.
    void setScene(Scene* scene);
    Scene* scene() const { return scene_; }
    /// The history has changed.
    void refresh();
    /// The row of the present state; -1 without a scene.
    int currentRow() const;

    int rowCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;

private:
    QString textOf(int row) const;
    bool isSaved(int row) const;

    Scene* scene_ = nullptr;
    int rows_ = 0;
};

}  // namespace jet::history
