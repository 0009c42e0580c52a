// Workbench: everything a test of a plugin needs, for any test framework: a catalog with the plugin, an empty scene, a
// scene view, an editor. jet/testing/gtest.hpp makes a GoogleTest fixture of it.
//
//   Workbench bench{"org.acme.rope"};
//   bench.tool("rope").drag({10, 10}, {60, 40});
//   assert(bench.scene().itemsOf("rope").size() == 1);
//   bench.undo();
//   assert(bench.scene().hash() == bench.emptySceneHash());
//
// All on one thread. Nothing is guarded: what a plugin throws arrives in the test.
#pragma once

#include <jet/effect.hpp>
#include <jet/simulation.hpp>
#include <jet/testing/catalog.hpp>
#include <jet/testing/event_log.hpp>
#include <jet/testing/recording_painter.hpp>
#include <jet/testing/test_editor.hpp>
#include <jet/testing/test_scene.hpp>
#include <jet/testing/tool_driver.hpp>

#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace jet::test {

/// What an importer made of a file.
struct Imported {
    Result<void> result;
    std::vector<FormatNote> notes;
    ItemList items;  ///< new children of the container it imported into; empty when it failed

    explicit operator bool() const { return static_cast<bool>(result); }
    /// `file:line:col: error: text`; empty when it did not fail.
    std::string error() const { return result ? std::string() : result.error().text(); }
};

/// What an exporter made of the scene.
struct Exported {
    Result<std::vector<std::byte>> result;
    std::vector<FormatNote> notes;

    explicit operator bool() const { return static_cast<bool>(result); }
    /// The bytes as text; throws Failure when the exporter failed.
    std::string text() const;
};

/// How large a picture shall be, and what of the scene it shows; see ExportRequest.
struct ExportOptions {
    int width = 0, height = 0;
    std::optional<Color> background;
    std::optional<View> view;
};

class Workbench {
public:
    /// Loads these plugins by id (see pluginPath()); throws Failure when one cannot be loaded.
    Workbench(std::initializer_list<std::string_view> plugins);
    virtual ~Workbench();
    Workbench(const Workbench&) = delete;
    Workbench& operator=(const Workbench&) = delete;

    TestCatalog& catalog() { return catalog_; }
    EventsCenter& events() { return events_; }
    TestScene& scene() { return scene_; }
    ItemsCenter& items() { return scene_.items(); }
    /// The scene view of the tools.
    TestToolHost& host() { return host_; }
    /// Made on first use, with scene() in front.
    TestEditor& editor();

    /// The tool of that id, made and activated on first use. Switching to another deactivates the one before.
    ToolDriver& tool(std::string_view id);

    // Undo.
    std::size_t undoSteps() const { return scene_.undoRedo().position(); }
    void undo() { scene_.undoRedo().undo(); }
    void redo() { scene_.undoRedo().redo(); }
    std::uint64_t emptySceneHash() const { return emptyHash_; }

    /// Adds an item as an own undo step; to the top group when no parent is given.
    const Item& add(std::string_view type, Path path, const Item* parent = nullptr);
    const Item& addRectangle(const Box& box, const Item* parent = nullptr);
    /// Applies an effect as an own undo step, as the editor's menu does. Throws Failure when the effect rejects the
    /// item, with its reason.
    const Item& apply(std::string_view effect, const Item& item, Properties properties = {});

    /// What is painted for one item, or for the whole scene.
    RecordingPainter painted(const Item& item, PaintPurpose purpose = PaintPurpose::Export);
    RecordingPainter painted(PaintPurpose purpose = PaintPurpose::Export);
    /// What a running game shows.
    RecordingPainter painted(const Simulation& simulation);

    /// Runs the importer of the extension of `file`, as one undo step; a failed import leaves nothing.
    Imported importFile(const std::filesystem::path& file);
    /// The same with bytes that need no file; `name` gives the extension and is named in messages.
    Imported importBytes(std::string_view bytes, const std::filesystem::path& name);
    /// Runs the exporter of that extension on the scene.
    Exported exportScene(std::string_view extension, const ExportOptions& options = {});

    /// Runs a menu command on editor(). Returns false, and does not run it, when it is not enabled.
    bool run(std::string_view command);

    /// Plays a copy of the scene for some steps. The catalog needs a physics engine: load "org.jet.physics".
    std::unique_ptr<Simulation> play(int steps = 0, SimulationOptions options = {});

    /// The scene written to text, read back, and written again: equal to scene().text() when nothing is lost.
    std::string textAfterReload();

private:
    TestCatalog catalog_;
    EventsCenter events_;
    TestScene scene_;
    TestToolHost host_;
    std::uint64_t emptyHash_;
    std::unique_ptr<TestEditor> editor_;
    std::map<std::string, std::unique_ptr<ToolDriver>, std::less<>> tools_;
    std::string active_;
};

}  // namespace jet::test
