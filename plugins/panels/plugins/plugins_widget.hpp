// PluginsWidget: a filter, the table of plugins, the details of the current one, and what can be done with it.
#pragma once

#include "plugin_table.hpp"
#include "set_chooser.hpp"

#include <jet/editor.hpp>

#include <QSortFilterProxyModel>
#include <QTimer>
#include <QWidget>

class QHBoxLayout;
class QLabel;
class QLineEdit;
class QTextBrowser;
class QToolButton;
class QTreeView;

namespace jet::plugins {

class PluginsWidget final : public QWidget {
public:
    explicit PluginsWidget(Editor& editor);

    /// Replaces the question box, for tests.
    void setQuestion(std::function<bool(const QString& question)> ask) { ask_ = std::move(ask); }
    void install(const QString& file);
    void refresh();
    void removeCurrent();
    /// Null when no row is chosen.
    const PluginInfo* current() const;

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    QHBoxLayout* createButtons();
    QToolButton* button(const char* icon, const char* name, const QString& toolTip, std::function<void()> run);
    void switchPlugin(const PluginInfo& plugin, bool on);
    void tell(const Result<PluginChange>& change);
    void showCurrent();
    bool askUser(const QString& question);

    Editor& editor_;
    PluginTable table_;
    QSortFilterProxyModel filtered_;
    SetChooser* sets_;
    QLineEdit* filter_;
    QTreeView* view_;
    QTextBrowser* details_;
    QToolButton* folder_ = nullptr;
    QToolButton* reload_ = nullptr;
    QToolButton* remove_ = nullptr;
    QTimer refresh_;
    std::function<bool(const QString&)> ask_;
    Subscription changed_;
};

}  // namespace jet::plugins
