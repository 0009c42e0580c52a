// The plugins center of the host: settings that outlive their plugin, switching with what depends on it, and trust in a
// project's own plugins.
#include "plugin_folder.hpp"

#include "host/plugins/plugin_control.hpp"
#include "host/plugins/project_trust.hpp"
#include "host/plugins/user_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace jet::host {
namespace {

using test::PluginFolder;
using testing::ElementsAre;
using testing::HasSubstr;

class PluginControlTest : public testing::Test {
protected:
    PluginControlTest() { ::setenv("XDG_CONFIG_HOME", config.path().c_str(), 1); }
    ~PluginControlTest() override { ::unsetenv("XDG_CONFIG_HOME"); }

    PluginControl& start()
    {
        control.reset();
        PluginOptions options;
        options.searchPath = {folder.path()};
        options.disabled = readDisabledPlugins();
        options.settings = userConfigFolder() / "settings";
        manager = std::make_unique<PluginManager>(std::move(options));
        manager->scan();
        control = std::make_unique<PluginControl>(*manager, events);
        return *control;
    }

    PluginFolder config, folder;
    EventsCenter events;
    std::unique_ptr<PluginManager> manager;
    std::unique_ptr<PluginControl> control;
};

// --- settings

const PropertyTable kTable{real("slack", "Slack", 0.5).range(0, 1), flag("knots", "Knots", true),
                           text("name", "Name", "x")};

TEST_F(PluginControlTest, SettingsAreKeptBetweenRuns)
{
    {
        SettingsStore store(config.path());
        const auto page = store.page("org.acme.rope", "rope", kTable);
        EXPECT_EQ(page->get<double>("slack"), 0.5);
        ASSERT_TRUE(page->set("slack", 0.25));
        ASSERT_TRUE(page->set("name", "two words, \"quoted\""));
    }
    SettingsStore store(config.path());
    const auto page = store.page("org.acme.rope", "rope", kTable);
    EXPECT_EQ(page->get<double>("slack"), 0.25);
    EXPECT_EQ(page->get<std::string>("name"), "two words, \"quoted\"");
    EXPECT_TRUE(page->get<bool>("knots")) << "never set: the default";
    ASSERT_TRUE(page->reset("slack"));
    EXPECT_EQ(page->get<double>("slack"), 0.5);
}

TEST_F(PluginControlTest, SettingsOfAnotherVersionAreKeptAlthoughTheyMeanNothing)
{
    SettingsStore store(config.path());
    ASSERT_TRUE(store.page("org.acme.rope", "rope", kTable)->set("slack", 0.75));
    const PropertyTable narrower{real("slack", "Slack", 0.1).range(0, 0.5)};
    const auto updated = store.page("org.acme.rope", "rope", narrower);
    EXPECT_EQ(updated->get<double>("slack"), 0.1) << "out of the new range: the default";
    const auto back = store.page("org.acme.rope", "rope", kTable);
    EXPECT_EQ(back->get<double>("slack"), 0.75) << "nobody set another one";
}

TEST_F(PluginControlTest, WrongSettingsAreRefusedAndTold)
{
    SettingsStore store(config.path());
    const auto page = store.page("org.acme.rope", "rope", kTable);
    EXPECT_THAT(page->set("slack", 2.0).error().message, HasSubstr("\"slack\" must be"));
    EXPECT_THAT(page->set("slak", 1.0).error().message, HasSubstr("has no property \"slak\""));
    EXPECT_EQ(page->get<double>("slack"), 0.5);
    std::ofstream(config.path() / "org.acme.rope.json") << "[";
    EXPECT_THAT(page->set("slack", 1.0).error().text(),
                HasSubstr("org.acme.rope.json:1:1: error: these settings are not"));
    EXPECT_EQ(page->get<double>("slack"), 0.5) << "what could not be stored is not used";
}

TEST_F(PluginControlTest, TwoRunningEditorsDoNotOverwriteEachOthersSettings)
{
    SettingsStore one(config.path()), two(config.path());
    const auto first = one.page("org.acme.rope", "rope", kTable), second = two.page("org.acme.rope", "rope", kTable);
    ASSERT_TRUE(first->set("slack", 0.25));
    ASSERT_TRUE(second->set("knots", false));
    const auto later = SettingsStore(config.path()).page("org.acme.rope", "rope", kTable);
    EXPECT_EQ(later->get<double>("slack"), 0.25);
    EXPECT_FALSE(later->get<bool>("knots"));
}

TEST_F(PluginControlTest, APluginReadsItsSettingsAndTheyOutliveItsRemoval)
{
    folder.link("org.jet.test.good");
    start();
    const auto page = control->settings("good");
    ASSERT_NE(page, nullptr);
    std::vector<std::string> told;
    const auto subscription = events.subscribe<SettingsChanged>(
        nullptr, [&](const SettingsChanged& change) { told.push_back(change.page + "/" + change.property); });
    ASSERT_TRUE(page->set("greeting", "hello"));
    EXPECT_THAT(told, ElementsAre("good/greeting"));
    EXPECT_EQ(manager->command("greet") != nullptr, true);
    folder.remove("org.jet.test.good");
    start();
    EXPECT_EQ(control->settings("good"), nullptr);
    folder.link("org.jet.test.good");
    EXPECT_EQ(start().settings("good")->get<std::string>("greeting"), "hello");
}

// --- switching

TEST_F(PluginControlTest, SwitchingOffNamesWhatDependsOnItAndIsRemembered)
{
    folder.add("org.acme.base");
    folder.add("org.acme.mid", R"("requires": ["org.acme.base"])");
    folder.add("org.acme.top", R"("requires": ["org.acme.mid"])");
    start();
    EXPECT_THAT(control->dependents("org.acme.base"), ElementsAre("org.acme.mid", "org.acme.top"));
    std::vector<std::string> told;
    const auto subscription =
        events.subscribe<PluginsChanged>(nullptr, [&](const PluginsChanged& change) { told = change.plugins; });
    const auto change = control->setEnabled("org.acme.base", false);
    ASSERT_TRUE(change);
    EXPECT_FALSE(change->afterRestart);
    EXPECT_THAT(told, ElementsAre("org.acme.base", "org.acme.mid", "org.acme.top"));
    EXPECT_FALSE(start().plugin("org.acme.top")->isUsable()) << "in the next run, too";
    EXPECT_THAT(control->requirements("org.acme.top"), ElementsAre("org.acme.base", "org.acme.mid"));
    ASSERT_TRUE(control->setEnabled("org.acme.top", true));
    EXPECT_TRUE(control->plugin("org.acme.base")->isUsable());
    EXPECT_TRUE(start().plugin("org.acme.top")->isUsable());
}

TEST_F(PluginControlTest, WhatFailedInThisRunWaitsForTheNext)
{
    folder.link("org.jet.test.throws-on-load");
    start();
    EXPECT_FALSE(manager->load("org.jet.test.throws-on-load"));
    const auto change = control->setEnabled("org.jet.test.throws-on-load", true);
    ASSERT_TRUE(change);
    EXPECT_TRUE(change->afterRestart);
    EXPECT_THAT(change->message, HasSubstr("is used again after a restart: it fails while registering"));
}

TEST_F(PluginControlTest, ALoadedPluginTellsWhatItCosts)
{
    folder.link("org.jet.test.good");
    start();
    EXPECT_EQ(control->plugin("org.jet.test.good")->mappedBytes, 0u);
    ASSERT_NE(manager->effect("tint"), nullptr);
    const auto info = control->plugin("org.jet.test.good");
    EXPECT_GT(info->mappedBytes, 4096u);
    EXPECT_GT(info->loadMs, 0);
    EXPECT_GT(info->calls, 0u);
    EXPECT_EQ(info->origin, "path");
}

// --- a project's own plugins

class ProjectTrustTest : public PluginControlTest {
protected:
    ProjectTrustTest()
    {
        std::filesystem::create_directories(project / "plugins/rope");
        write("plugins/rope/plugin.json", "{}");
        write("plugins/rope/rope.so", "code");
        write("project.jet", "<jet-project/>");
    }
    void write(const std::string& name, const std::string& text) const { std::ofstream(project / name) << text; }
    ProjectPlugins found() const { return *findProjectPlugins(project / "project.jet"); }

    std::filesystem::path project = folder.path() / "game";
};

TEST_F(ProjectTrustTest, TrustIsAskedOnceAndAgainWhenAFileChanges)
{
    EXPECT_EQ(found().trust, ProjectPlugins::Trust::Unknown);
    EXPECT_THAT(found().advice(), HasSubstr("(rope), which were left out: this project is not trusted yet; if you know "
                                            "where it comes from, run 'jet plugins trust "));
    ASSERT_TRUE(trustProject(found()));
    EXPECT_TRUE(found().isTrusted());
    write("scene.scene", "other files of the project may change");
    EXPECT_TRUE(found().isTrusted());
    write("plugins/rope/rope.so", "c0de");
    EXPECT_EQ(found().trust, ProjectPlugins::Trust::Changed);
    EXPECT_THAT(found().advice(), HasSubstr("they changed since you trusted this project"));
    write("plugins/rope/rope.so", "code");
    EXPECT_TRUE(found().isTrusted());
    write("plugins/rope/more.so", "");
    EXPECT_FALSE(found().isTrusted()) << "a new file";
    std::filesystem::remove(project / "plugins/rope/more.so");
    ASSERT_TRUE(trustProject(found(), false));
    EXPECT_EQ(found().trust, ProjectPlugins::Trust::Unknown);
}

TEST_F(ProjectTrustTest, ACopyElsewhereIsNotTrusted)
{
    ASSERT_TRUE(trustProject(found()));
    std::filesystem::copy(project, folder.path() / "copy", std::filesystem::copy_options::recursive);
    EXPECT_FALSE(findProjectPlugins(folder.path() / "copy")->isTrusted());
    std::filesystem::create_directory_symlink(project, folder.path() / "link");
    EXPECT_TRUE(findProjectPlugins(folder.path() / "link")->isTrusted()) << "the same place by another name";
}

TEST_F(ProjectTrustTest, AFolderWithLinksIsNeverTrusted)
{
    std::filesystem::create_symlink("/tmp", project / "plugins/rope/elsewhere");
    EXPECT_FALSE(trustProject(found()));
    EXPECT_THAT(found().advice(), HasSubstr("holds links or files that cannot be read"));
}

TEST_F(ProjectTrustTest, AProjectWithoutPluginsHasNothingToTrust)
{
    std::filesystem::remove_all(project / "plugins");
    EXPECT_FALSE(findProjectPlugins(project));
    EXPECT_FALSE(findProjectPlugins(folder.path() / "nowhere"));
}

}  // namespace
}  // namespace jet::host
