// HistoryModel: the states of a scene, or of the project's tree, as rows. Row 0 is the oldest state that can be
// reached, row n the state after step n.
#pragma once

#include <jet/project_tree.hpp>

#include <QAbstractListModel>

namespace jet::history {

class HistoryModel final : public QAbstractListModel {
public:
    enum Role { SavedRole = Qt::UserRole, CurrentRole, UndoneRole };

    explicit HistoryModel(QObject* parent) : QAbstractListModel(parent) {}

    /// Shows a scene's history, or none.
    void show(Scene* scene);
    /// Shows the project's.
    void show(ProjectTree& tree);
    Scene* scene() const { return scene_; }
    /// The history has changed.
    void refresh();
    /// The row of the present state; -1 without a history.
    int currentRow() const;
    /// Throws Failure where that cannot be now.
    void goTo(int row);
    /// What the next Undo takes back; empty if there is nothing.
    QString undoLabel() const;

    int rowCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;

private:
    QString textOf(int row) const;
    bool isSaved(int row) const;

    Scene* scene_ = nullptr;
    ProjectTree* tree_ = nullptr;
    std::vector<std::string> treeLabels_;  // the tree gives them all at once only
    int rows_ = 0;
};

}  // namespace jet::history
