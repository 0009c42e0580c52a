// PluginReloader: swaps rebuilt plugins in the running editor. Scenes, undo histories, selections and tool options
// stay; tools and panels of the plugin are made again, and what effects kept between paints is computed again.
#pragma once

#include "window/dock_area.hpp"
#include "window/documents.hpp"
#include "window/plugin_runtime.hpp"
#include "window/plugin_watcher.hpp"
#include "window/tool_controller.hpp"

#include <jet/events.hpp>
#include <jet/plugins.hpp>

#include <memory>
#include <set>

namespace jet::host {

class PluginReloader final : public QObject {
    Q_OBJECT

public:
    PluginReloader(Editor& editor, Documents& documents, ToolController& tools, DockArea& docks, PluginRuntime* plugins,
                   QObject* parent);

    /// Reloads plugins of these folders as they are rebuilt.
    void watch(const std::vector<std::filesystem::path>& folders);
    /// Now, or when the play stops; says so in the window.
    void reload(const std::string& plugin);
    /// The same for who asks through the PluginsCenter and tells the user itself. A plugin that asks for its own
    /// reloading is reloaded when its call has returned.
    Result<PluginChange> request(const std::string& plugin);
    /// All whose libraries are in use.
    void reloadAll();

    std::vector<ActionSpec> actions();

private:
    void folderChanged(const QString& folder);
    void reloadWaiting();
    Result<void> swap(const std::string& plugin);
    void swapAndTell(const std::string& plugin);

    Editor& editor_;
    Documents& documents_;
    ToolController& tools_;
    DockArea& docks_;
    PluginRuntime* plugins_;
    std::unique_ptr<PluginWatcher> watcher_;
    std::set<std::string> waiting_;
    Subscription playing_;
};

}  // namespace jet::host
