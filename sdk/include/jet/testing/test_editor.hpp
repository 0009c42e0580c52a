// TestEditor: the running editor as panels and commands see it, without a window. What they ask of it can be read.
//
//   TestEditor editor(events, catalog);
//   editor.openScene(scene);
//   catalog.command("auto-layout")->run(editor);
//   EXPECT_EQ(editor.messages.size(), 1u);
#pragma once

#include <jet/editor.hpp>
#include <jet/project_tree.hpp>
#include <jet/unmanaged_plugins.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace jet::test {

class TestEditor final : public Editor {
public:
    /// The project has one empty scene, "Scene 0"; no scene is in front until openScene().
    TestEditor(EventsCenter& events, Catalog& catalog);
    ~TestEditor() override;

    EventsCenter& events() override { return events_; }
    Catalog& catalog() override { return catalog_; }
    Project& project() override { return *project_; }
    SimulationCenter& simulation() override { return simulation_; }
    Scene* activeScene() override { return activeScene_; }
    /// Makes it the front scene and sends ActiveSceneChanged.
    void openScene(Scene& scene) override;
    void openScript(Scene& scene, ItemId script, int line = 0) override;
    std::string activeTool() const override { return tool_; }
    /// Sends ActiveToolChanged; the tool itself is not made.
    void setActiveTool(std::string_view id) override;
    void setToolOption(std::string_view property, Value value) override;
    void print(OutputLine line) override { output.push_back(std::move(line)); }
    void showMessage(std::string text) override { messages.push_back(std::move(text)); }
    void showStatus(std::string text) override { status = std::move(text); }
    ItemId activeLayer() const override { return layer_; }
    void setActiveLayer(ItemId layer) override { layer_ = layer; }
    /// There are none to manage.
    PluginsCenter& plugins() override { return plugins_; }
    /// The catalog's explanation, as a message.
    void showMissing(ContributionKind kind, std::string_view id) override
    {
        messages.push_back(catalog_.explain(kind, id));
    }
    /// Notes what is reported in `progressed`, and cancels from `cancelAt` on.
    Progress progress(const std::string& label) override;
    ProjectTree& projectTree() override { return *tree_; }

    std::vector<OutputLine> output;
    std::vector<std::string> messages;
    std::string status;
    std::vector<std::pair<ItemId, int>> openedScripts;  ///< script and line
    Properties toolOptions;
    std::vector<double> progressed;  ///< 0..1, in the order reported
    double cancelAt = 2;             ///< above 1: never

private:
    EventsCenter& events_;
    Catalog& catalog_;
    std::unique_ptr<Project> project_;
    std::unique_ptr<ProjectTree> tree_;
    SimulationCenter simulation_;
    UnmanagedPlugins plugins_;
    Scene* activeScene_ = nullptr;
    std::string tool_;
    ItemId layer_;
};

}  // namespace jet::test
