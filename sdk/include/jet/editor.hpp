// Editor: what panels and commands see of the running editor.
#pragma once

#include <jet/catalog.hpp>
#include <jet/events.hpp>
#include <jet/project.hpp>
#include <jet/simulation.hpp>

#include <string>

namespace jet {

class PluginsCenter;
class ProjectTree;

/// Sent by the Editor.
struct ProjectChanged {  ///< another project was opened or its scenes changed
    static constexpr EventType type{"org.jet.project-changed"};
};
struct ActiveSceneChanged {
    static constexpr EventType type{"org.jet.active-scene-changed"};
    Scene* scene;  ///< null when no scene tab is in front
};
struct ActiveToolChanged {
    static constexpr EventType type{"org.jet.active-tool-changed"};
    std::string tool;
};

class JET_API Editor {
public:
    virtual ~Editor();

    virtual EventsCenter& events() = 0;
    virtual Catalog& catalog() = 0;
    virtual Project& project() = 0;
    virtual SimulationCenter& simulation() = 0;
    /// The scene of the front tab, or null.
    virtual Scene* activeScene() = 0;
    virtual void openScene(Scene& scene) = 0;
    /// Opens a script item's code in an editor tab, at a line if > 0.
    virtual void openScript(Scene& scene, ItemId script, int line = 0) = 0;

    virtual std::string activeTool() const = 0;
    virtual void setActiveTool(std::string_view id) = 0;
    /// Option values of the active tool.
    virtual void setToolOption(std::string_view property, Value value) = 0;

    /// A line in the Output panel.
    virtual void print(OutputLine line) = 0;
    /// A message the user must see; not modal.
    virtual void showMessage(std::string text) = 0;
    virtual void showStatus(std::string text) = 0;
    /// The layer new items go to: set by the Layers panel; an id not in the scene means none.
    virtual ItemId activeLayer() const = 0;
    virtual void setActiveLayer(ItemId layer) = 0;
    /// The installed plugins (jet/plugins.hpp).
    virtual PluginsCenter& plugins() = 0;
    /// Tells the user why the catalog has no such contribution, with a button that mends it where one can. For formats
    /// `id` is an extension.
    virtual void showMissing(ContributionKind kind, std::string_view id) = 0;
    /// For a command whose work takes longer than a moment: call it now and then with 0..1; false means that the user
    /// cancelled. The window shows a bar with a Cancel button after half a second; it is gone when the returned object
    /// is. Call it outside of transactions: compute first, then change the scene. The default never cancels.
    virtual Progress progress(const std::string& label);
    /// The way to change the project's tree of scenes so that it can be undone (jet/project_tree.hpp). Another one
    /// after each ProjectChanged of another project.
    virtual ProjectTree& projectTree() = 0;
};

/// A menu command. Stateless; declared in the manifest with menu, label and shortcut.
class JET_API Command {
public:
    virtual ~Command();
    virtual void run(Editor& editor) = 0;
    /// Shown enabled? Called when a menu opens.
    virtual bool isEnabled(Editor& editor) const;
};

}  // namespace jet
