// A plugin that throws in one of its callbacks: the host goes on, the plugin is switched off, its half-done edit is
// gone, and one message names plugin, callback and reason.
#include "plugin_folder.hpp"

#include "host/plugins/plugin_manager.hpp"
#include "support/recording_painter.hpp"
#include "support/tool_fixture.hpp"

#include <jet/simulation.hpp>

#include <gmock/gmock.h>

namespace jet::host {
namespace {

using testing::HasSubstr;

class GuardTest : public testing::TestWithParam<const char*> {
protected:
    GuardTest()
    {
        ::unsetenv("JET_TEST_THROW");
        folder.link("org.jet.test.throws-inside");
        PluginOptions options;
        options.searchPath = {folder.path()};
        manager = std::make_unique<PluginManager>(options);
        manager->setProblemHandler([this](const PluginProblem& p) { problems.push_back(p.message); });
        manager->scan();
        scene = std::make_unique<Scene>("Scene", events, *manager);
    }
    ~GuardTest() override { ::unsetenv("JET_TEST_THROW"); }
    void fail(const std::string& callback) { ::setenv("JET_TEST_THROW", callback.c_str(), 1); }
    const Item& addBox()
    {
        auto edit = scene->items().begin("Add");
        const Item& item = edit.add<ShapeItem>(scene->root(), Path::rectangle(Box({0, 0}, {9, 9})));
        edit.commit();
        return item;
    }
    void expectFault(const std::string& callback, const std::string& reason = "oops")
    {
        ASSERT_EQ(problems.size(), 1u) << callback;
        EXPECT_EQ(problems[0], "the plugin Throws inside (org.jet.test.throws-inside 1.0.0) was switched off: " +
                                   callback + " failed: " + reason);
        EXPECT_EQ(manager->plugin("org.jet.test.throws-inside")->state, PluginState::Faulted);
        EXPECT_EQ(manager->effect("fragile"), nullptr) << "a failed plugin offers nothing";
    }

    test::PluginFolder folder;
    EventsCenter events;
    std::unique_ptr<PluginManager> manager;
    std::unique_ptr<Scene> scene;
    std::vector<std::string> problems;
};

class ToolCallbackTest : public GuardTest {};

TEST_P(ToolCallbackTest, LeavesNoHalfDoneEdit)
{
    test::TestToolHost host(*scene);
    const std::string callback = GetParam();
    fail(callback);
    const auto before = scene->hash();
    auto tool = manager->createTool("fragile", host);
    if (callback == "factory") {
        EXPECT_EQ(tool, nullptr);
        return expectFault(callback);
    }
    ASSERT_NE(tool, nullptr);
    test::RecordingPainter painter;
    tool->activate();
    tool->press({}), tool->drag({}), tool->release({}), tool->move({}), tool->doubleClick({});
    tool->wheel({}), tool->keyPress({}), tool->keyRelease({}), tool->cancel(), tool->paint(painter), tool->deactivate();
    expectFault(callback);
    EXPECT_FALSE(scene->items().inTransaction());
    if (callback == "Tool::press") {
        EXPECT_EQ(scene->hash(), before);
    }
    tool->press({});
    EXPECT_EQ(problems.size(), 1u) << "not called any more";
}

INSTANTIATE_TEST_SUITE_P(Guard, ToolCallbackTest,
                         testing::Values("factory", "Tool::options", "Tool::activate", "Tool::press", "Tool::drag",
                                         "Tool::release", "Tool::move", "Tool::doubleClick", "Tool::wheel",
                                         "Tool::keyPress", "Tool::keyRelease", "Tool::cancel", "Tool::paint",
                                         "Tool::deactivate"));

TEST_F(GuardTest, EffectPropertiesThatThrowMakeNoEffect)
{
    fail("Effect::properties");
    EXPECT_EQ(manager->effect("fragile"), nullptr);
    expectFault("Effect::properties");
}

TEST_F(GuardTest, AnEffectThatThrowsWhenAppliedIsTakenBack)
{
    const Item& box = addBox();
    fail("Effect::applied");
    auto edit = scene->items().begin("Apply");
    const auto before = scene->hash();
    EXPECT_THROW(edit.addEffect(box, "fragile"), Failure);
    EXPECT_EQ(scene->hash(), before);
    EXPECT_TRUE(edit.isOpen());
    expectFault("Effect::applied");
}

TEST_F(GuardTest, AnEffectThatThrowsWhileItIsAskedIsRefused)
{
    const Item& box = addBox();
    fail("Effect::rejects");
    auto edit = scene->items().begin("Apply");
    EXPECT_THROW(edit.addEffect(box, "fragile"), Failure);
    EXPECT_TRUE(edit.isEmpty());
    expectFault("Effect::rejects");
}

TEST_F(GuardTest, PaintingGoesOnWithoutAnEffectThatThrows)
{
    for (const char* callback : {"Effect::update", "Effect::paint"}) {
        const Effect* effect = manager->effect("fragile");
        ASSERT_NE(effect, nullptr);
        fail(callback);
        const EffectInput input{addBox(), Path(), Properties(), effect->properties()};
        test::RecordingPainter painter;
        EXPECT_EQ(effect->update(input), nullptr);
        effect->paint(input, nullptr, PaintPurpose::Edit, painter);
        if (std::string(callback) == "Effect::paint") break;
        expectFault(callback);
        ::unsetenv("JET_TEST_THROW");
        problems.clear();
        PluginOptions options;
        options.searchPath = {folder.path()};
        scene.reset();
        manager = std::make_unique<PluginManager>(options);
        manager->setProblemHandler([this](const PluginProblem& p) { problems.push_back(p.message); });
        manager->scan();
        scene = std::make_unique<Scene>("Scene", events, *manager);
    }
    expectFault("Effect::paint");
}

TEST_F(GuardTest, ItemTypesAreGuardedInEachCall)
{
    const ItemType* type = manager->itemType("fragile");
    ASSERT_NE(type, nullptr);
    fail("ItemType::label int");
    EXPECT_EQ(type->label(), "Item");
    expectFault("ItemType::label", "an unknown exception");
    EXPECT_NE(type->properties().find("size"), nullptr) << "what was told before stays known";
}

TEST_F(GuardTest, FormatsGiveAnErrorInstead)
{
    Importer* importer = manager->importer("fragile");
    ASSERT_NE(importer, nullptr);
    fail("Importer::read");
    {
        auto edit = scene->items().begin("Import");
        std::vector<FormatNote> notes;
        ImportRequest request{"a.fragile", {}, edit, scene->root(), notes, {}};
        const auto read = importer->read(request);
        ASSERT_FALSE(read);
        EXPECT_THAT(read.error().message, HasSubstr("Throws inside"));
    }
    EXPECT_EQ(scene->items().itemCount(), 0u);
    expectFault("Importer::read");
}

class PlayCallbackTest : public GuardTest {};

TEST_P(PlayCallbackTest, EndsTheRunOrLeavesItOut)
{
    const Item& box = addBox();
    auto edit = scene->items().begin("Play");
    edit.addEffect(box, "fragile");
    edit.setType(box, "body");
    edit.add<ScriptItem>(scene->root());
    edit.add("fragile", scene->root());
    edit.commit();
    const auto before = scene->hash();
    fail(GetParam());
    EXPECT_NO_THROW({
        auto simulation = Simulation::start(*scene, {});
        try {
            for (int i = 0; simulation && i < 10; ++i) (*simulation)->step();
        } catch (const Failure& failure) {
            EXPECT_THAT(failure.what(), HasSubstr("oops"));
        }
    });
    expectFault(GetParam());
    EXPECT_EQ(scene->hash(), before);
}

INSTANTIATE_TEST_SUITE_P(Guard, PlayCallbackTest,
                         testing::Values("PhysicsEngine::createWorld", "PhysicsWorld::step", "Effect::buildBody",
                                         "ItemType::build", "ScriptEngine::createRuntime", "ScriptRuntime::run",
                                         "ScriptRuntime::dispatch", "ScriptRuntime::listensTo"));

TEST_F(GuardTest, AnEngineThatRefusesAWorldOrAStepIsNotAtFault)
{
    for (const char* callback : {"PhysicsEngine::createWorld", "PhysicsWorld::step"}) {
        fail(std::string(callback) + " refuses");
        std::string refused;
        auto simulation = Simulation::start(*scene, {});
        try {
            for (int i = 0; simulation && i < 10; ++i) (*simulation)->step();
        } catch (const Failure& failure) {
            refused = failure.what();
        }
        if (!simulation) refused = simulation.error().message;
        EXPECT_THAT(refused, HasSubstr("no such world")) << callback;
        EXPECT_TRUE(problems.empty()) << problems[0];
        ::unsetenv("JET_TEST_THROW");
        auto next = Simulation::start(*scene, {});
        ASSERT_TRUE(next) << next.error().message;
        for (int i = 0; i < 10; ++i) (*next)->step();
    }
    EXPECT_NE(manager->plugin("org.jet.test.throws-inside")->state, PluginState::Faulted);
}

/// Those that JET brings, as far as they were built.
class EngineRefusalTest : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(EngineRefusalTest, LeavesTheEngineToTheNextScene)
{
    const auto [plugin, id] = GetParam();
    const auto shipped = std::filesystem::path(JET_BINARY_DIR) / "lib/jet/plugins" / plugin;
    if (!std::filesystem::exists(shipped)) GTEST_SKIP() << "built without " << plugin;
    test::PluginFolder folder;
    std::filesystem::create_directory_symlink(shipped, folder.path() / plugin);
    PluginOptions options;
    options.searchPath = {folder.path()};
    PluginManager manager(options);
    std::vector<std::string> problems;
    manager.setProblemHandler([&](const PluginProblem& p) { problems.push_back(p.message); });
    manager.scan();
    PhysicsEngine* engine = manager.physicsEngine(id);
    ASSERT_NE(engine, nullptr);
    WorldSettings settings;
    settings.materials[0].restitution = 2;
    EXPECT_THROW((void)engine->createWorld(settings), Failure);
    settings.materials[0].restitution = 1;
    const auto world = engine->createWorld(settings);
    ASSERT_NE(world, nullptr);
    EXPECT_THROW(world->step(1000), Failure);
    EXPECT_NO_THROW(world->step(1.0 / 60));
    EXPECT_NE(engine->createWorld(settings), nullptr);
    EXPECT_TRUE(problems.empty()) << problems[0];
    EXPECT_NE(manager.plugin(plugin)->state, PluginState::Faulted);
}

INSTANTIATE_TEST_SUITE_P(Guard, EngineRefusalTest,
                         testing::Values(std::pair("org.jet.physics", "jet-physics"),
                                         std::pair("org.jet.physics-box2d", "physics-box2d")));

}  // namespace
}  // namespace jet::host
