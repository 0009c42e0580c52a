// LayerTree: the view of a LayerModel. It keeps its selection equal to the scene's, both ways, and remembers which
// branches are open while rows come and go.
#pragma once

#include "layer_model.hpp"

#include <QTreeView>

#include <unordered_set>

namespace jet::layers {

class LayerTree final : public QTreeView {
    Q_OBJECT

public:
    LayerTree(LayerModel& model, Editor& editor, QWidget* parent);

    void showScene(Scene* scene);
    /// The container new things go to: the current row's, else none.
    const Item* currentContainer() const;
    void renameCurrent();

protected:
    void selectionChanged(const QItemSelection& selected, const QItemSelection& deselected) override;
    void currentChanged(const QModelIndex& current, const QModelIndex& previous) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;

private:
    void showSelection();
    void showOpenBranches();
    void toggle(const QModelIndex& index);
    void remember(const QModelIndex& index, bool open);

    LayerModel& model_;
    Editor& editor_;
    std::unordered_set<std::uint64_t> open_;  // item ids
    bool following_ = false;                  // the scene's selection is being shown, not changed
    Subscription selected_;
};

}  // namespace jet::layers
