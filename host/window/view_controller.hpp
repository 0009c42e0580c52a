// ViewController: zoom, grid and panels: the View menu.
#pragma once

#include "window/actions.hpp"
#include "window/dock_area.hpp"
#include "window/documents.hpp"

#include <jet/find.hpp>

namespace jet::host {

class ViewController final : public QObject {
    Q_OBJECT

public:
    ViewController(Documents& documents, DockArea& docks, QObject* parent);

    std::vector<ActionSpec> actions();
    /// Shows what panels ask to be shown (jet/find.hpp).
    void follow(Editor& editor);
    /// Gives a new view the present settings.
    void prepare(SceneView& view) const { view.setGridVisible(grid_); }
    void restore(QSettings& settings);
    void save(QSettings& settings) const;

private:
    void frameSelection();
    void setGrid(bool on);

    Documents& documents_;
    DockArea& docks_;
    bool grid_ = true;
    Subscription shown_;
};

}  // namespace jet::host
