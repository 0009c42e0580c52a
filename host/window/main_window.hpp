// MainWindow: the shell. It puts the parts together and is the Editor that panels and commands see.
#pragma once

#include "window/actions.hpp"
#include "window/command_controller.hpp"
#include "window/dock_area.hpp"
#include "window/documents.hpp"
#include "window/edit_controller.hpp"
#include "window/event_pump.hpp"
#include "window/format_controller.hpp"
#include "window/launch.hpp"
#include "window/message_bar.hpp"
#include "window/play_controller.hpp"
#include "window/plugin_controller.hpp"
#include "window/plugin_reloader.hpp"
#include "window/project_controller.hpp"
#include "window/sound_player.hpp"
#include "window/tool_controller.hpp"
#include "window/view_controller.hpp"

#include <jet/unmanaged_plugins.hpp>

#include <QMainWindow>

#include <set>

class QLabel;

namespace jet::host {

class MainWindow final : public QMainWindow, public Editor {
    Q_OBJECT

public:
    explicit MainWindow(const WindowLaunch& launch);
    ~MainWindow() override;

    // The parts, for the launcher and for tests.
    ProjectController& projects() { return projects_; }
    FormatController& formats() { return formats_; }
    PlayController& player() { return player_; }
    EditController& edits() { return edits_; }
    Documents& documents() { return *documents_; }
    Actions& actionTable() { return actions_; }
    MessageBar& messages() { return *messages_; }
    SoundPlayer& sounds() { return sounds_; }
    PluginController& pluginController() { return pluginController_; }
    /// The layout and choices of the last run.
    void restoreSettings();
    void saveSettings();

    // Editor.
    EventsCenter& events() override { return events_; }
    Catalog& catalog() override { return catalog_; }
    Project& project() override { return projects_.project(); }
    SimulationCenter& simulation() override { return simulation_; }
    Scene* activeScene() override { return documents_->currentScene(); }
    void openScene(Scene& scene) override;
    void openScript(Scene& scene, ItemId script, int line) override;
    std::string activeTool() const override { return tools_.active(); }
    void setActiveTool(std::string_view id) override { tools_.activate(std::string(id)); }
    void setToolOption(std::string_view property, Value value) override
    {
        tools_.setOption(property, std::move(value));
    }
    void print(OutputLine line) override;
    void showMessage(std::string text) override;
    void showStatus(std::string text) override;
    ItemId activeLayer() const override;
    void setActiveLayer(ItemId layer) override;
    PluginsCenter& plugins() override { return plugins_; }
    void showMissing(ContributionKind kind, std::string_view id) override { pluginController_.showMissing(kind, id); }
    Progress progress(const std::string& label) override;
    ProjectTree& projectTree() override { return projects_.tree(); }

protected:
    void closeEvent(QCloseEvent* event) override;

private:
    QWidget* createCentral();
    void createActions();
    void createMenus();
    /// Bars, menus, docks and views after plugins were switched.
    void followPlugins();
    void createToolBars();
    void createStatusBar();
    void connectDocuments();
    void followEvents();
    void showPluginProblems();

    void prepareView(SceneView& view);
    void frontChanged();
    /// Tabs of scenes that left the project close, and open again when these come back.
    void followTree();
    void useKey(QKeyEvent& event);
    void updateTitle();
    void updateZoom();
    void showPointer(const QPointF& scene);

    Catalog& catalog_;
    UnmanagedPlugins noPlugins_;
    PluginsCenter& plugins_;
    EventsCenter& events_;
    bool safeMode_;
    std::function<std::vector<std::string>()> pluginProblems_;
    PluginRuntime* runtime_;
    std::function<void(std::function<Result<PluginChange>(const std::string&)>)> setReloader_;
    std::set<std::string> shownProblems_;
    EventPump pump_;
    ToolOptions toolOptions_;
    SimulationCenter simulation_;
    MessageBar* messages_;
    Documents* documents_;
    Actions actions_;
    ProjectController projects_;
    PluginController pluginController_;
    FormatController formats_;
    EditController edits_;
    CommandController commands_;
    PlayController player_;
    SoundPlayer sounds_;
    ToolController tools_;
    DockArea docks_;
    PluginReloader reloader_;
    ViewController views_;
    QLabel* pointer_ = nullptr;
    QLabel* zoom_ = nullptr;
    QLabel* status_ = nullptr;
    std::map<const Scene*, ItemId> activeLayers_;
    Scene* frontScene_ = nullptr;
    std::vector<const Scene*> closedByTree_;
    std::vector<Subscription> subscriptions_;
};

}  // namespace jet::host
