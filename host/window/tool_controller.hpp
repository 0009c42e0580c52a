// ToolController: the active tool, its tool bar and its options.
#pragma once

#include "window/actions.hpp"
#include "window/documents.hpp"

#include <QActionGroup>

class QLabel;
class QSettings;
class QToolBar;

namespace jet::host {

class ToolController final : public QObject {
    Q_OBJECT

public:
    ToolController(Editor& editor, Documents& documents, ToolOptions& options, QObject* parent);

    /// Fills the bar with a button a tool, as the manifests declare them; nothing is loaded.
    void buildToolBar(QToolBar& bar);
    /// The same again after plugins were switched.
    void rebuild();
    /// Shows the active tool's options here.
    void setOptionsBar(QToolBar& bar);

    const std::string& active() const { return active_; }
    void activate(const std::string& id);
    void setOption(std::string_view property, Value value);
    /// Gives the front view the active tool.
    void applyToFront();
    /// Single keys: "M" picks the tool that declares it.
    bool trigger(const QKeySequence& keys);
    /// Esc: gives up the gesture, else returns to the first tool, else clears the selection.
    void escape();

    void restoreOptions(QSettings& settings);
    void saveOptions(QSettings& settings) const;

private:
    void showOptions();

    Editor& editor_;
    Documents& documents_;
    ToolOptions& options_;
    QActionGroup buttons_;
    QToolBar* bar_ = nullptr;
    QToolBar* optionsBar_ = nullptr;
    std::vector<Contribution> tools_;
    std::string active_;
};

}  // namespace jet::host
