// Dependencies, conflicts, switching at run time, and who provides what is missing.
#include "plugin_folder.hpp"

#include "host/plugins/plugin_manager.hpp"

#include <jet/effect.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace jet::host {
namespace {

using test::PluginFolder;
using testing::ElementsAre;
using testing::HasSubstr;

class PluginResolverTest : public testing::Test {
protected:
    PluginManager& scan(PluginOptions options = {})
    {
        options.searchPath = {folder.path()};
        manager = std::make_unique<PluginManager>(std::move(options));
        manager->scan();
        return *manager;
    }
    std::string state(std::string_view id) const
    {
        const Plugin* plugin = manager->plugin(id);
        if (!plugin) return "not found";
        return std::string(stateName(plugin->state)) + (plugin->reason.empty() ? "" : ": " + plugin->reason);
    }

    PluginFolder folder;
    std::unique_ptr<PluginManager> manager;
};

TEST_F(PluginResolverTest, ACycleBelowAPluginIsNamedWithTheWayToIt)
{
    folder.add("org.acme.a", R"("requires": ["org.acme.b"])");
    folder.add("org.acme.b", R"("requires": ["org.acme.c"])");
    folder.add("org.acme.c", R"("requires": ["org.acme.b"])");
    scan();
    EXPECT_THAT(state("org.acme.c"), HasSubstr("it depends on itself: org.acme.b → org.acme.c → org.acme.b (reached by "
                                               "org.acme.a → org.acme.b); remove one of these requirements"));
    EXPECT_THAT(state("org.acme.a"), HasSubstr("faulted: it requires org.acme.b"));
}

TEST_F(PluginResolverTest, AMisspeltRequirementIsAnsweredWithTheRightOne)
{
    folder.add("org.acme.rope");
    folder.add("org.acme.a", R"("requires": ["org.acme.roep ^1"])");
    scan();
    EXPECT_THAT(state("org.acme.a"),
                HasSubstr("it requires org.acme.roep ^1 (org.acme.a → org.acme.roep), which is not "
                          "installed; install it; did you mean 'org.acme.rope'?"));
}

TEST_F(PluginResolverTest, TheOneThatDeclaresAConflictGivesWay)
{
    folder.add("org.acme.a", R"("conflicts": ["org.acme.z <2"])");
    folder.add("org.acme.dependent", R"("requires": ["org.acme.a"])");
    folder.add("org.acme.user", R"("requires": ["org.acme.z"])");
    folder.add("org.acme.z", "", "1.5.0");
    scan();
    EXPECT_THAT(
        state("org.acme.a"),
        HasSubstr("faulted: it conflicts with org.acme.z (org.acme.z 1.5.0), which org.acme.user requires; keep one "
                  "of them: 'jet plugins disable org.acme.z' or 'jet plugins disable org.acme.a'"));
    EXPECT_THAT(state("org.acme.dependent"),
                HasSubstr("faulted: it requires org.acme.a, which is faulted (it conflicts"));
    EXPECT_EQ(state("org.acme.z"), "resolved");
    PluginOptions options;
    options.disabled = {"org.acme.z"};
    scan(options);
    EXPECT_EQ(state("org.acme.a"), "resolved") << "a plugin that is switched off is in nobody's way";
    EXPECT_EQ(state("org.acme.dependent"), "resolved");
}

TEST_F(PluginResolverTest, AConflictWithAnotherVersionIsNone)
{
    folder.add("org.acme.a", R"("conflicts": ["org.acme.z <2"])");
    folder.add("org.acme.z", "", "2.0.0");
    scan();
    EXPECT_EQ(state("org.acme.a"), "resolved");
}

TEST_F(PluginResolverTest, AnOptionalPluginMayBeAbsentOrOfAnotherVersion)
{
    folder.add("org.acme.a", R"("optional": ["org.acme.gone", "org.acme.z ^2"])");
    folder.add("org.acme.z", R"("optional": ["org.acme.a"])", "1.0.0");
    scan();
    EXPECT_EQ(state("org.acme.a"), "resolved");
    ASSERT_EQ(manager->plugin("org.acme.a")->remarks.size(), 1u);
    EXPECT_EQ(manager->plugin("org.acme.a")->remarks[0],
              "it can use org.acme.z, but wants version 2.0.0 or a later one before 3.0.0 and finds 1.0.0");
}

TEST_F(PluginResolverTest, PluginsThatWishForEachOtherLoad)
{
    folder.link("org.jet.test.good");
    folder.add("org.acme.a", R"("requires": ["org.jet.test.good"], "optional": ["org.acme.b"])");
    folder.add("org.acme.b", R"("optional": ["org.acme.a"])");
    scan();
    EXPECT_EQ(manager->effect("a"), nullptr) << "it has no library";
    EXPECT_EQ(state("org.jet.test.good"), "loaded") << "what is required is loaded first";
    EXPECT_THAT(state("org.acme.b"), HasSubstr("its library")) << "and so is what is wished for";
}

TEST_F(PluginResolverTest, SwitchingOffTakesEffectAtOnceAndOnAgain)
{
    folder.link("org.jet.test.good");
    folder.add("org.acme.a", R"("requires": ["org.jet.test.good"])");
    scan();
    const Effect* tint = manager->effect("tint");
    ASSERT_NE(tint, nullptr);
    EXPECT_THAT(manager->setEnabled({"org.jet.test.good"}, false), ElementsAre("org.acme.a", "org.jet.test.good"));
    EXPECT_EQ(manager->effect("tint"), nullptr);
    EXPECT_TRUE(manager->contributions(ContributionKind::Importer).empty());
    EXPECT_THAT(state("org.acme.a"), HasSubstr("disabled: it requires org.jet.test.good, which is disabled"));
    EXPECT_THAT(manager->setEnabled({"org.jet.test.good"}, true), ElementsAre("org.acme.a", "org.jet.test.good"));
    EXPECT_EQ(manager->effect("tint"), tint) << "the library was loaded before";
    EXPECT_EQ(state("org.acme.a"), "resolved");
}

TEST_F(PluginResolverTest, WhatFailedStaysFaultedWhenOthersAreSwitched)
{
    folder.link("org.jet.test.throws-on-load");
    folder.add("org.acme.a");
    scan();
    EXPECT_EQ(manager->effect("licensed"), nullptr);
    manager->setEnabled({"org.acme.a"}, false);
    EXPECT_THAT(state("org.jet.test.throws-on-load"), HasSubstr("faulted: it fails while registering"));
}

TEST_F(PluginResolverTest, AFolderAddedLaterBringsTheNewerCopyAndLeavesTheOlderShadowed)
{
    PluginFolder project;
    folder.add("org.acme.rope", "", "1.0.0");
    project.add("org.acme.rope", "", "1.1.0");
    scan();
    EXPECT_THAT(manager->addFolder(project.path(), PluginOrigin::Project), ElementsAre("org.acme.rope"));
    EXPECT_EQ(manager->plugin("org.acme.rope")->folder, project.path() / "org.acme.rope");
    ASSERT_EQ(manager->plugins().size(), 2u);
    EXPECT_THAT(manager->plugins()[1]->reason, HasSubstr("version 1.1.0 in"));
    manager->removeFolder(project.path() / "org.acme.rope");
    EXPECT_EQ(manager->plugin("org.acme.rope")->folder, folder.path() / "org.acme.rope");
    EXPECT_EQ(state("org.acme.rope"), "resolved");
}

// --- the reverse index

TEST_F(PluginResolverTest, EachWayOfBeingMissingHasItsAnswer)
{
    folder.add("org.acme.usable");
    folder.add("org.acme.off");
    folder.add("org.acme.left");
    folder.add("org.acme.broken", R"("requires": ["org.acme.gone"])");
    folder.write("old", R"({ "id": "org.acme.usable", "name": "Old", "version": "0.5", "jet": "1.0", "library": "x",
        "contributes": { "effects": [ { "id": "dropped", "label": "x" } ] } })");
    PluginOptions options;
    options.disabled = {"org.acme.off"};
    options.set = PluginSet::of({"org.acme.usable", "org.acme.off", "org.acme.broken"}, "small");
    scan(options);
    manager->recall(
        {"org.acme.hemp", "2.1.0", 3, {{ContributionKind::Effect, "hemp"}, {ContributionKind::ItemType, "knot"}}});
    const auto answer = [&](const char* effect) { return manager->whoProvides(ContributionKind::Effect, effect); };
    EXPECT_EQ(answer("usable").availability, Availability::Usable);
    EXPECT_EQ(answer("off").availability, Availability::Disabled);
    EXPECT_THAT(answer("off").sentence, HasSubstr("'jet plugins enable org.acme.off'"));
    EXPECT_EQ(answer("left").availability, Availability::LeftOut);
    EXPECT_THAT(answer("left").sentence, HasSubstr("not in the chosen plugin set 'small'; add it"));
    EXPECT_TRUE(answer("left").canEnable());
    EXPECT_EQ(answer("broken").availability, Availability::Faulted);
    EXPECT_FALSE(answer("broken").canEnable());
    EXPECT_EQ(answer("dropped").availability, Availability::Shadowed);
    EXPECT_EQ(answer("hemp").availability, Availability::NotInstalled);
    EXPECT_EQ(
        answer("hemp").sentence,
        "The effect 'hemp' needs the plugin org.acme.hemp 2.1.0, which the project was saved with and which is not "
        "installed; get its .jetplugin file and run 'jet plugins install FILE'.");
    EXPECT_EQ(manager->provider(ContributionKind::ItemType, "knot"), "org.acme.hemp 2.1.0");
    EXPECT_EQ(answer("usabel").availability, Availability::Unknown);
    EXPECT_EQ(answer("usabel").sentence, "No installed plugin provides the effect 'usabel'; did you mean 'usable'?");
}

}  // namespace
}  // namespace jet::host
