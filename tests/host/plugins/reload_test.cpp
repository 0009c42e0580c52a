// Plugins that are rebuilt, or removed, while the program runs.
#include "plugin_folder.hpp"

#include "host/plugins/plugin_manager.hpp"
#include "support/recording_painter.hpp"
#include <jet/testing/tool_driver.hpp>

#include <gmock/gmock.h>

#include <sstream>

namespace jet::host {
namespace {

using testing::HasSubstr;

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::stringstream all;
    all << in.rdbuf();
    return all.str();
}

double residentMegabytes()
{
    std::ifstream in("/proc/self/statm");
    double total = 0, resident = 0;
    in >> total >> resident;
    return resident * 4096 / 1e6;
}

class ReloadTest : public testing::Test {
protected:
    void copyFixture(const std::string& id)
    {
        std::filesystem::copy(test::fixtureFolder() / id, folder.path() / id,
                              std::filesystem::copy_options::recursive |
                                  std::filesystem::copy_options::overwrite_existing);
    }
    PluginManager& scan(bool strict = false)
    {
        PluginOptions options;
        options.searchPath = {folder.path()};
        options.copyLibraries = true;
        options.strictUnload = strict;
        manager = std::make_unique<PluginManager>(options);
        manager->setProblemHandler([this](const PluginProblem& p) { problems.push_back(p.message); });
        manager->scan();
        return *manager;
    }
    std::string errorOf(const Result<void>& result) const { return result ? "" : result.error().message; }
    /// The manifest of a fixture with some of its text replaced.
    void rewrite(const std::string& id, const std::string& from, const std::string& to)
    {
        const auto file = folder.path() / id / "plugin.json";
        std::string text = contentOf(file);
        const auto at = text.find(from);
        ASSERT_NE(at, std::string::npos);
        std::ofstream(file) << text.replace(at, from.size(), to);
    }

    test::PluginFolder folder;
    EventsCenter events;
    std::unique_ptr<PluginManager> manager;
    std::vector<std::string> problems;
};

constexpr const char* kGood = "org.jet.test.good";

TEST_F(ReloadTest, KeepsTheAddressesOfWhatIsSharedAndTheScenes)
{
    copyFixture(kGood);
    scan();
    Scene scene("Scene", events, *manager);
    const Effect* tint = manager->effect("tint");
    const PropertyTable* table = &tint->properties();
    auto edit = scene.items().begin("Draw");
    const Item& box = edit.add<ShapeItem>(scene.root(), Path::rectangle(Box({0, 0}, {9, 9})));
    edit.addEffect(box, "tint");
    edit.commit();
    const auto hash = scene.hash();
    bool dropped = false;
    ASSERT_EQ(errorOf(manager->reload(kGood, [&] { dropped = true; })), "");
    EXPECT_TRUE(dropped);
    EXPECT_EQ(manager->effect("tint"), tint);
    EXPECT_NE(table->find("color"), nullptr) << "an earlier table can still be read";
    EXPECT_EQ(scene.hash(), hash);
    test::RecordingPainter painter;
    const EffectInput input{box, box.path(), box.effects()[0].properties, tint->properties()};
    tint->paint(input, nullptr, PaintPurpose::Edit, painter);
    scene.undoRedo().undo();
    scene.undoRedo().redo();
    EXPECT_EQ(scene.hash(), hash);
    EXPECT_TRUE(problems.empty());
}

TEST_F(ReloadTest, TakesWhatTheNewManifestOffers)
{
    copyFixture(kGood);
    scan();
    EXPECT_NE(manager->effect("tint"), nullptr);
    rewrite(kGood, "1.2.3", "1.3.0");
    ASSERT_EQ(errorOf(manager->reload(kGood)), "");
    EXPECT_EQ(manager->provider(ContributionKind::Effect, "tint"), "org.jet.test.good 1.3.0");
}

TEST_F(ReloadTest, WhatDoesNotWorkLeavesTheOldOneRunning)
{
    copyFixture(kGood);
    scan();
    const Effect* tint = manager->effect("tint");
    bool dropped = false;
    const auto failure = [&] { return errorOf(manager->reload(kGood, [&] { dropped = true; })); };

    rewrite(kGood, "\"tint\"", "\"taint\"");
    EXPECT_THAT(failure(), HasSubstr("what was loaded before goes on: what it declares and what it registers differ: "
                                     "effect 'taint' is declared in plugin.json but not registered"));
    rewrite(kGood, "\"taint\"", "\"tint\"");
    rewrite(kGood, "\"contributes\"", "\"contributes");
    EXPECT_THAT(failure(), HasSubstr("plugin.json:"));
    copyFixture(kGood);
    const auto library = folder.path() / kGood / "fixture-good.so";
    std::filesystem::resize_file(library, 1000);
    EXPECT_THAT(failure(), HasSubstr("is cut short"));
    std::filesystem::remove(library);
    EXPECT_THAT(failure(), HasSubstr("is missing"));

    EXPECT_FALSE(dropped) << "nothing was taken from the editor";
    EXPECT_EQ(manager->effect("tint"), tint);
    EXPECT_EQ(manager->plugin(kGood)->state, PluginState::Active);
    copyFixture(kGood);
    EXPECT_EQ(failure(), "");
}

TEST_F(ReloadTest, APluginThatFailedComesBackWhenItIsRebuilt)
{
    copyFixture("org.jet.test.throws-inside");
    scan();
    ::setenv("JET_TEST_THROW", "ItemType::label", 1);
    const ItemType* type = manager->itemType("fragile");
    EXPECT_EQ(type->label(), "Item");
    EXPECT_EQ(manager->itemType("fragile"), nullptr);
    ::unsetenv("JET_TEST_THROW");
    ASSERT_EQ(errorOf(manager->reload("org.jet.test.throws-inside")), "");
    EXPECT_EQ(manager->itemType("fragile"), type);
    EXPECT_EQ(type->label(), "Fragile");
}

TEST_F(ReloadTest, APluginThatCameLaterIsTakenIn)
{
    scan();
    EXPECT_EQ(manager->effect("tint"), nullptr);
    copyFixture(kGood);
    const auto added = manager->takeIn(folder.path() / kGood);
    ASSERT_TRUE(added);
    EXPECT_EQ(*added, kGood);
    ASSERT_EQ(errorOf(manager->reload(kGood)), "");
    EXPECT_NE(manager->effect("tint"), nullptr);
}

TEST_F(ReloadTest, TwoHundredReloadsTakeLessThanTwentyMegabytes)
{
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer keeps what is freed";
#endif
    copyFixture(kGood);
    scan();
    Scene scene("Scene", events, *manager);
    test::RecordingPainter painter;
    const auto once = [&] {
        ASSERT_EQ(errorOf(manager->reload(kGood)), "");
        const Effect* tint = manager->effect("tint");
        ASSERT_NE(tint, nullptr);
        const EffectInput input{scene.root(), Path(), Properties(), tint->properties()};
        tint->paint(input, nullptr, PaintPurpose::Edit, painter);
        ASSERT_NE(manager->importer("boxes"), nullptr);
        ASSERT_NE(manager->physicsEngine("falling"), nullptr);
    };
    once();
    const double before = residentMegabytes();
    for (int i = 0; i < 200; ++i) once();
    EXPECT_LT(residentMegabytes() - before, 20);
    RecordProperty("megabytes", std::to_string(residentMegabytes() - before));
}

// --- unloading for real

TEST_F(ReloadTest, AWellBehavedPluginIsGoneWhenItIsUnloaded)
{
    copyFixture(kGood);
    scan(true);
    const Effect* tint = manager->effect("tint");
    ASSERT_NE(tint, nullptr);
    ASSERT_EQ(errorOf(manager->unload(kGood)), "");
    EXPECT_NE(tint->properties().find("color"), nullptr) << "what others hold needs no code of it";
    EXPECT_EQ(tint->rejects(Item(ItemId{1}, "shape")), "the plugin Good failed");
    EXPECT_NE(manager->effect("tint"), nullptr) << "loaded again when it is used again";
}

class LeftBehindTest : public ReloadTest, public testing::WithParamInterface<std::pair<const char*, const char*>> {};

TEST_P(LeftBehindTest, IsNamedAndStaysInMemory)
{
    ::setenv("JET_TEST_EVIL", GetParam().first, 1);
    copyFixture("org.jet.test.evil-unloads");
    scan(true);
    Scene scene("Scene", events, *manager);
    test::TestToolHost host(scene);
    manager->createTool("evil-unloads", host).reset();
    EXPECT_THAT(errorOf(manager->unload("org.jet.test.evil-unloads")), HasSubstr(GetParam().second));
    ::unsetenv("JET_TEST_EVIL");
}

INSTANTIATE_TEST_SUITE_P(Reload, LeftBehindTest,
                         testing::Values(std::pair("thread", "leaves 1 running thread(s) behind"),
                                         std::pair("listener", "leaves 1 event listener(s) behind"),
                                         std::pair("nodelete", "leaves its library")),
                         [](const auto& info) { return std::string(info.param.first); });

}  // namespace
}  // namespace jet::host
