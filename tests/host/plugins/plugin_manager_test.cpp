// Finding, resolving and loading plugins. What is wrong with one is a reason in its state; nothing takes the host down.
#include "plugin_folder.hpp"

#include "host/plugins/plugin_manager.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace jet::host {
namespace {

using test::PluginFolder;
using testing::HasSubstr;

class PluginManagerTest : public testing::Test {
protected:
    PluginManager& scan(PluginOptions options = {})
    {
        if (options.searchPath.empty()) options.searchPath = {folder.path()};
        manager = std::make_unique<PluginManager>(std::move(options));
        manager->setProblemHandler([this](const PluginProblem& p) { problems.push_back(p.message); });
        manager->scan();
        return *manager;
    }
    /// "state: reason" of a plugin.
    std::string state(std::string_view id) const
    {
        const Plugin* plugin = manager->plugin(id);
        if (!plugin) return "not found";
        return std::string(stateName(plugin->state)) + (plugin->reason.empty() ? "" : ": " + plugin->reason);
    }
    static bool isMapped(const std::string& library)
    {
        std::ifstream maps("/proc/self/maps");
        std::stringstream all;
        all << maps.rdbuf();
        return all.str().find(library) != std::string::npos;
    }

    PluginFolder folder;
    std::unique_ptr<PluginManager> manager;
    std::vector<std::string> problems;
};

// First of all tests in this program that touch a fixture: nothing is mapped before.
TEST_F(PluginManagerTest, ALibraryIsLoadedOnFirstUseOnly)
{
    folder.link("org.jet.test.good");
    scan();
    EXPECT_EQ(state("org.jet.test.good"), "resolved");
    EXPECT_EQ(manager->contributions(ContributionKind::Effect).size(), 2u);
    EXPECT_EQ(manager->explain(ContributionKind::Effect, "tint"),
              "The effect 'tint' comes from Good (org.jet.test.good 1.2.3).");
    EXPECT_EQ(manager->provider(ContributionKind::ItemType, "rope"), "org.jet.test.good 1.2.3");
    EXPECT_FALSE(isMapped("fixture-good.so"));
    const Effect* tint = manager->effect("tint");
    ASSERT_NE(tint, nullptr);
    EXPECT_TRUE(isMapped("fixture-good.so"));
    EXPECT_EQ(state("org.jet.test.good"), "active");
    EXPECT_EQ(manager->effect("tint"), tint) << "the same object each time";
    EXPECT_NE(tint->properties().find("color"), nullptr);
    EXPECT_NE(manager->importer("boxes"), nullptr);
    EXPECT_NE(manager->physicsEngine(""), nullptr);
    EXPECT_TRUE(problems.empty());
}

TEST_F(PluginManagerTest, WhatNobodyProvidesSaysWhatToDo)
{
    scan();
    EXPECT_EQ(manager->effect("sparkle"), nullptr);
    EXPECT_THAT(manager->explain(ContributionKind::Effect, "sparkle"),
                HasSubstr("No installed plugin provides the effect 'sparkle'; install one"));
    EXPECT_THAT(manager->explain(ContributionKind::Importer, "xyz"), HasSubstr("importer for .xyz files"));
    EXPECT_THAT(manager->explain(ContributionKind::PhysicsEngine, ""), HasSubstr("provides a physics engine"));
    EXPECT_EQ(manager->provider(ContributionKind::Effect, "sparkle"), "");
}

TEST_F(PluginManagerTest, ABrokenManifestFaultsOnlyItsPlugin)
{
    folder.write("org.acme.broken", "{ \"id\": ");
    folder.add("org.acme.fine");
    scan();
    EXPECT_THAT(state("org.acme.broken"),
                HasSubstr("faulted: " + (folder.path() / "org.acme.broken/plugin.json").string() + ":1:"));
    EXPECT_EQ(state("org.acme.fine"), "resolved");
    EXPECT_EQ(manager->problems().size(), 1u);
}

TEST_F(PluginManagerTest, AFolderWithoutManifestIsNoPlugin)
{
    std::filesystem::create_directories(folder.path() / "empty");
    EXPECT_TRUE(scan().plugins().empty());
    PluginOptions nowhere;
    nowhere.searchPath = {folder.path() / "not there"};
    EXPECT_TRUE(scan(nowhere).plugins().empty());
}

TEST_F(PluginManagerTest, AFolderThatIsOnePluginCounts)
{
    folder.add("org.acme.one");
    PluginOptions one;
    one.searchPath = {folder.path() / "org.acme.one"};
    scan(one);
    EXPECT_EQ(state("org.acme.one"), "resolved");
}

// --- what it was built for

struct Build {
    const char* name;
    const char* manifest;  // what replaces "jet" and "builtFor"
    const char* reason;
};

class WrongBuildTest : public PluginManagerTest, public testing::WithParamInterface<Build> {};

TEST_P(WrongBuildTest, IsRefusedBeforeItsLibraryIsOpened)
{
    folder.write("p",
                 std::string("{ \"id\": \"org.acme.p\", \"name\": \"P\", \"version\": \"1\", \"library\": \"p\", ") +
                     GetParam().manifest + "}");
    scan();
    EXPECT_THAT(state("org.acme.p"), HasSubstr("faulted: "));
    EXPECT_THAT(state("org.acme.p"), HasSubstr(GetParam().reason));
}

INSTANTIATE_TEST_SUITE_P(
    PluginManager, WrongBuildTest,
    testing::Values(Build{"WrittenForALaterSdk", R"("jet": "9.0")",
                          "it was written for SDK 9.0.0, this JET has SDK " JET_SDK_VERSION "; use a newer JET"},
                    Build{"NotBuilt", R"("jet": "1.0")",
                          "does not say what it was built with; build it with jet_add_plugin()"},
                    Build{"BuiltForALaterSdk", R"("jet": "1.0", "builtFor": {"sdk": "1.99.0", "abi": "x"})",
                          "it was built for SDK 1.99.0"},
                    Build{"AnotherAbi", R"("jet": "1.0", "builtFor": {"sdk": "1.0.0", "abi": "msvc-19"})",
                          "it was built for the compiler ABI msvc-19, this JET for " JET_ABI_TAG "; rebuild it"}),
    [](const auto& info) { return std::string(info.param.name); });

// --- libraries that do not work

struct BadLibrary {
    const char* name;
    const char* id;
    const char* effect;
    const char* reason;
};

class BadLibraryTest : public PluginManagerTest, public testing::WithParamInterface<BadLibrary> {};

TEST_P(BadLibraryTest, FaultsWithAReasonOnFirstUse)
{
    folder.link(GetParam().id);
    scan();
    EXPECT_EQ(state(GetParam().id), "resolved");
    EXPECT_EQ(manager->effect(GetParam().effect), nullptr);
    EXPECT_THAT(state(GetParam().id), HasSubstr(std::string("faulted: ") + GetParam().reason));
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_THAT(problems[0], HasSubstr(GetParam().reason));
    EXPECT_THAT(manager->explain(ContributionKind::Effect, GetParam().effect), HasSubstr(GetParam().reason));
    EXPECT_EQ(manager->effect(GetParam().effect), nullptr);
    EXPECT_FALSE(manager->load(GetParam().id));
    EXPECT_EQ(problems.size(), 1u) << "told once";
    EXPECT_TRUE(manager->contributions(ContributionKind::Effect).empty()) << "not offered any more";
}

INSTANTIATE_TEST_SUITE_P(
    PluginManager, BadLibraryTest,
    testing::Values(
        BadLibrary{"ThrowsOnLoad", "org.jet.test.throws-on-load", "licensed",
                   "it fails while registering: no licence found"},
        BadLibrary{"NoSymbol", "org.jet.test.no-symbol", "silent",
                   "its library has no symbol jet_plugin_entry; write JET_PLUGIN"},
        BadLibrary{"WrongEntry", "org.jet.test.wrong-entry", "future", "its library was built for SDK 99.7"},
        BadLibrary{
            "Undeclared", "org.jet.test.undeclared", "promised",
            "what it declares and what it registers differ: effect 'promised' is declared in plugin.json but not "
            "registered; effect 'surprise' is registered but not declared in plugin.json; make"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST_F(PluginManagerTest, AMissingLibraryIsNamed)
{
    folder.add("org.acme.hollow");
    scan();
    EXPECT_EQ(manager->effect("hollow"), nullptr);
    EXPECT_THAT(
        state("org.acme.hollow"),
        HasSubstr("its library " + (folder.path() / "org.acme.hollow/none.so").string() + " is missing; install"));
}

TEST_F(PluginManagerTest, AFileThatIsNoLibraryDoesNotLoad)
{
    folder.add("org.acme.text");
    std::ofstream(folder.path() / "org.acme.text/none.so") << "not ELF";
    scan();
    EXPECT_EQ(manager->effect("text"), nullptr);
    EXPECT_THAT(state("org.acme.text"), HasSubstr("is no shared library"));
}

// --- dependencies

TEST_F(PluginManagerTest, ACycleIsNamedWithItsChain)
{
    folder.add("org.acme.a", R"("requires": ["org.acme.b"])");
    folder.add("org.acme.b", R"("requires": ["org.acme.c"])");
    folder.add("org.acme.c", R"("requires": ["org.acme.a"])");
    folder.add("org.acme.self", R"("requires": ["org.acme.self"])");
    scan();
    EXPECT_THAT(state("org.acme.c"),
                HasSubstr("it depends on itself: org.acme.a → org.acme.b → org.acme.c → org.acme.a; remove one"));
    EXPECT_THAT(state("org.acme.a"), HasSubstr("faulted: it requires org.acme.b"));
    EXPECT_THAT(state("org.acme.self"), HasSubstr("org.acme.self → org.acme.self"));
}

TEST_F(PluginManagerTest, AMissingDependencyIsNamedThroughTheChain)
{
    folder.add("org.acme.a", R"("requires": ["org.acme.b"])");
    folder.add("org.acme.b", R"("requires": ["org.acme.gone"])");
    scan();
    EXPECT_THAT(state("org.acme.a"), HasSubstr("it requires org.acme.b, which is faulted (it requires org.acme.gone"));
    EXPECT_THAT(state("org.acme.b"), HasSubstr("which is not installed; install it"));
}

TEST_F(PluginManagerTest, ATooOldDependencyIsNamedWithBothVersions)
{
    folder.add("org.acme.a", R"("requires": ["org.acme.b 1.4"])");
    folder.add("org.acme.b", "", "1.3.0");
    scan();
    EXPECT_THAT(state("org.acme.a"),
                HasSubstr("it requires org.acme.b 1.4 (org.acme.a → org.acme.b), but version 1.3.0 is installed in"));
    EXPECT_THAT(state("org.acme.a"), HasSubstr("; install version 1.4.0 or a later one before 2.0.0"));
    EXPECT_EQ(state("org.acme.b"), "resolved");
}

TEST_F(PluginManagerTest, ADependencyThatFailsToLoadFaultsWhatNeedsIt)
{
    folder.link("org.jet.test.no-symbol");
    folder.add("org.acme.a", R"("requires": ["org.jet.test.no-symbol"])");
    scan();
    EXPECT_EQ(state("org.acme.a"), "resolved");
    EXPECT_EQ(manager->effect("a"), nullptr);
    EXPECT_THAT(state("org.acme.a"),
                HasSubstr("it requires org.jet.test.no-symbol, which failed: its library has no symbol"));
}

// --- choosing

TEST_F(PluginManagerTest, TheNewerOfTwoVersionsIsUsed)
{
    folder.add("org.acme.rope", "", "1.9.0", "old");
    folder.add("org.acme.rope", "", "1.10.0", "new");
    scan();
    EXPECT_EQ(manager->plugin("org.acme.rope")->manifest.version.text(), "1.10.0");
    ASSERT_EQ(manager->plugins().size(), 2u);
    const Plugin* other = manager->plugins()[1];
    EXPECT_EQ(other->state, PluginState::Shadowed);
    EXPECT_THAT(other->reason, HasSubstr("version 1.10.0 in " + (folder.path() / "new").string() + " is used instead"));
}

TEST_F(PluginManagerTest, AWorkingCopyIsUsedAndABrokenOneStillTold)
{
    folder.add("org.acme.rope", "", "1.0.0", "fine");
    folder.write("org.acme.rope", "{");
    scan();
    EXPECT_EQ(state("org.acme.rope"), "resolved");
    ASSERT_EQ(manager->problems().size(), 1u);
    EXPECT_THAT(manager->problems()[0], HasSubstr("not valid JSON"));
}

TEST_F(PluginManagerTest, WithoutMeansNotInstalledDisabledMeansSwitchedOff)
{
    folder.add("org.acme.a");
    folder.add("org.acme.b");
    folder.add("org.acme.c");
    PluginOptions options;
    options.searchPath = {folder.path()};
    options.without = {"org.acme.a"};
    options.disabled = {"org.acme.b"};
    scan(options);
    EXPECT_EQ(state("org.acme.a"), "not found");
    EXPECT_THAT(state("org.acme.b"),
                HasSubstr("disabled: switched off; 'jet plugins enable org.acme.b' switches it on"));
    EXPECT_EQ(manager->effect("b"), nullptr);
    EXPECT_THAT(manager->explain(ContributionKind::Effect, "b"), HasSubstr("which is disabled: switched off"));
    options.without = options.disabled = {};
    options.set = PluginSet::of({"org.acme.c"});
    scan(options);
    EXPECT_EQ(state("org.acme.b"),
              "disabled: not in the chosen plugin set; add it to the set, or choose another one ('jet plugins sets')");
    EXPECT_EQ(state("org.acme.c"), "resolved");
}

TEST_F(PluginManagerTest, SafeModeTakesOnlyWhatShips)
{
    PluginFolder shipped;
    shipped.add("org.jet.shipped");
    folder.add("org.acme.foreign");
    PluginOptions options;
    options.searchPath = {folder.path(), shipped.path()};
    options.builtIn = shipped.path();
    options.safeMode = true;
    scan(options);
    EXPECT_EQ(state("org.acme.foreign"), "not found");
    EXPECT_EQ(state("org.jet.shipped"), "resolved");
}

TEST_F(PluginManagerTest, AnEngineThatFailsMakesRoomForTheNext)
{
    folder.link("org.jet.test.good");
    folder.link("org.jet.test.throws-on-load");
    scan();
    EXPECT_NE(manager->physicsEngine(""), nullptr);
    EXPECT_EQ(manager->physicsEngine("licensed"), nullptr);
    EXPECT_NE(manager->physicsEngine(""), nullptr);
}

TEST_F(PluginManagerTest, WhereNoEngineWorksTheReasonIsThatOfTheOneThatIsThere)
{
    folder.link("org.jet.test.throws-on-load");
    scan();
    EXPECT_EQ(manager->physicsEngine(""), nullptr);
    EXPECT_THAT(manager->explain(ContributionKind::PhysicsEngine, ""), HasSubstr("no licence found"));
}

TEST_F(PluginManagerTest, ContributionsComeByOrderThenId)
{
    const auto effects = [](const char* list) {
        return std::string("\"contributes\": { \"effects\": [") + list + "] }";
    };
    folder.write(
        "p",
        std::string(
            "{ \"id\": \"org.acme.p\", \"name\": \"P\", \"version\": \"1\", \"jet\": \"1.0\", \"library\": \"p\", "
            "\"builtFor\": { \"sdk\": \"" JET_SDK_VERSION "\", \"abi\": \"" JET_ABI_TAG "\" }, ") +
            effects(
                R"({"id": "b", "label": "B"}, {"id": "a", "label": "A"}, {"id": "z", "label": "Z", "order": 1, "icon": "z.svg"})") +
            "}");
    scan();
    const auto all = manager->contributions(ContributionKind::Effect);
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].id + all[1].id + all[2].id, "zab");
    EXPECT_EQ(all[0].icon, (folder.path() / "p/z.svg").string());
}

}  // namespace
}  // namespace jet::host
