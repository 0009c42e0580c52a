// Every shipped plugin is used, and then really unloaded: its library is gone, and nothing that is left refers to it.
// (Panels are made without their widgets: Qt's own libraries cannot be unloaded.)
#include "host/plugins/plugin_manager.hpp"
#include "support/recording_painter.hpp"

#include <jet/simulation.hpp>
#include <jet/testing/test_editor.hpp>
#include <jet/testing/tool_driver.hpp>

#include <test_paths.hpp>

#include <gtest/gtest.h>

namespace jet::host {
namespace {

class UnloadTest : public testing::Test {
protected:
    UnloadTest()
    {
        PluginOptions options;
        options.searchPath = {std::filesystem::path(JET_BINARY_DIR) / "lib/jet/plugins"};
        options.strictUnload = true;
        manager = std::make_unique<PluginManager>(options);
        manager->setProblemHandler([](const PluginProblem& problem) { ADD_FAILURE() << problem.message; });
        manager->scan();
    }

    /// Calls what the plugin offers at least once.
    void use(const Contribution& one)
    {
        Scene scene("Scene", events, *manager);
        auto edit = scene.items().begin("Use");
        const Item& box = edit.add<ShapeItem>(scene.root(), Path::rectangle(Box({0, 0}, {40, 40})));
        edit.commit();
        test::RecordingPainter painter;
        switch (one.kind) {
        case ContributionKind::Tool: return useTool(one.id, scene);
        case ContributionKind::Effect: return useEffect(one.id, scene, box);
        case ContributionKind::ItemType:
            manager->itemType(one.id)->paint(box, box.path(), PaintPurpose::Edit, painter);
            return;
        case ContributionKind::Importer: return read(one.extensions.front(), scene);
        case ContributionKind::Exporter: return write(one.extensions.front(), scene);
        case ContributionKind::Panel: {
            test::TestEditor editor(events, *manager);
            EXPECT_NE(manager->createPanel(one.id, editor), nullptr);
            return;
        }
        case ContributionKind::Command: EXPECT_NE(manager->command(one.id), nullptr); return;
        case ContributionKind::PhysicsEngine:
        case ContributionKind::ScriptEngine: return play(scene);
        default: return;
        }
    }

private:
    void useTool(const std::string& id, Scene& scene)
    {
        test::TestToolHost host(scene);
        auto tool = manager->createTool(id, host);
        ASSERT_NE(tool, nullptr);
        tool->activate();
        test::ToolDriver driver(host, std::move(tool));
        driver.drag({5, 5}, {60, 45}).click({20, 20}).key("Escape");
        driver.painted();
    }
    void useEffect(const std::string& id, Scene& scene, const Item& box)
    {
        const Effect* effect = manager->effect(id);
        ASSERT_NE(effect, nullptr);
        auto edit = scene.items().begin("Apply");
        edit.addEffect(box, id);
        edit.commit();
        const EffectInput input{box, box.path(), box.effects().back().properties, effect->properties()};
        test::RecordingPainter painter;
        effect->paint(input, effect->update(input).get(), PaintPurpose::Edit, painter);
        try {
            (void)effect->buildBody(input, {});
        } catch (const Failure&) {  // it may refuse this shape; it was called
        }
    }
    void read(const std::string& extension, Scene& scene)
    {
        const std::string text = "<svg xmlns='http://www.w3.org/2000/svg'><rect width='9' height='9'/></svg>";
        auto edit = scene.items().begin("Import");
        std::vector<FormatNote> notes;
        ImportRequest request{"file." + extension, std::as_bytes(std::span(text)), edit, scene.root(), notes, {}};
        (void)manager->importer(extension)->read(request);  // whether it likes the text does not matter here
    }
    void write(const std::string& extension, const Scene& scene)
    {
        std::vector<FormatNote> notes;
        ExportRequest request{scene, nullptr, {}, 32, 32, {}, "file." + extension, notes, {}};
        (void)manager->exporter(extension)->write(request);
    }
    void play(Scene& scene)
    {
        auto edit = scene.items().begin("Script");
        const Item& script = edit.add<ScriptItem>(scene.root());
        edit.set(script, "code", "JetSystem.addEventListener('onStep', function () {});");
        edit.commit();
        auto simulation = Simulation::start(scene, {});
        ASSERT_TRUE(simulation) << simulation.error().message;
        for (int i = 0; i < 3; ++i) (*simulation)->step();
    }

protected:
    EventsCenter events;
    std::unique_ptr<PluginManager> manager;
};

TEST_F(UnloadTest, EveryShippedPluginIsGoneAfterUse)
{
    int count = 0;
    for (const Plugin* plugin : manager->plugins()) {
        SCOPED_TRACE(plugin->manifest.id);
        const auto loaded = manager->load(plugin->manifest.id);
        ASSERT_TRUE(loaded) << loaded.error().message;
        const std::string id = plugin->manifest.id;
        for (const Contribution& one : std::vector(plugin->manifest.contributions)) use(one);
        const auto unloaded = manager->unload(id);
        EXPECT_TRUE(unloaded) << unloaded.error().message;
        ++count;
    }
    // Those that plugins used along the way.
    for (const Plugin* plugin : manager->plugins()) {
        const auto unloaded = manager->unload(plugin->manifest.id);
        EXPECT_TRUE(unloaded) << unloaded.error().message;
    }
    EXPECT_GT(count, 10);
    EXPECT_EQ(events.listenerCount(), 0u);
}

}  // namespace
}  // namespace jet::host
