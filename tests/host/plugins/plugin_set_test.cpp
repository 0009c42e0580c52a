// Plugin sets: what their files say, where they are found, what they choose, and how the difference to what is here is
// told.
#include "plugin_folder.hpp"

#include "host/plugins/plugin_differences.hpp"
#include "host/plugins/plugin_set_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace jet::host {
namespace {

using test::PluginFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class PluginSetTest : public testing::Test {
protected:
    PluginSetTest() { ::setenv("XDG_CONFIG_HOME", config.path().c_str(), 1); }
    ~PluginSetTest() override { ::unsetenv("XDG_CONFIG_HOME"); }

    /// Writes a set of the user's.
    void write(const std::string& name, const std::string& content)
    {
        const auto file = PluginSetFiles::userFolder() / (name + ".jetset");
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << content;
    }
    PluginSet read(const std::string& name) { return PluginSetFiles().choose(name).orThrow(); }
    std::string errorOf(const std::string& name)
    {
        const auto set = PluginSetFiles().choose(name);
        return set ? "no error" : set.error().text();
    }
    PluginManager& scan(std::optional<PluginSet> set = {})
    {
        PluginOptions options;
        options.searchPath = {folder.path()};
        options.set = std::move(set);
        manager = std::make_unique<PluginManager>(std::move(options));
        manager->scan();
        return *manager;
    }
    std::vector<std::string> usable() const
    {
        std::vector<std::string> ids;
        for (const Plugin* plugin : manager->plugins())
            if (plugin->usable()) ids.push_back(plugin->manifest.id);
        return ids;
    }

    PluginFolder config, folder;
    std::unique_ptr<PluginManager> manager;
};

// --- what a file says

TEST_F(PluginSetTest, ASetIsTextWithCommentsRangesAndIncludes)
{
    write("base", R"({ "plugins": ["org.acme.base", "org.acme.old"] })");
    write("mine", R"({
  // for the workshop
  "name": "Mine", "description": "What I need.",
  "include": ["base"],
  "plugins": ["org.acme.rope >=1.2 <3", "org.acme.tool.*"],
  "optional": ["org.acme.glue"],
  "exclude": ["org.acme.old", "org.acme.tool.saw"]
})");
    const PluginSet set = read("mine");
    EXPECT_EQ(set.title, "Mine");
    EXPECT_EQ(set.description, "What I need.");
    EXPECT_EQ(set.source, SetSource::User);
    EXPECT_TRUE(set.holds("org.acme.base")) << "from the included set";
    EXPECT_TRUE(set.holds("org.acme.tool.hammer")) << "by the beginning of its id";
    EXPECT_TRUE(set.holds("org.acme.glue"));
    EXPECT_FALSE(set.holds("org.acme.old"));
    EXPECT_FALSE(set.holds("org.acme.tool.saw"));
    EXPECT_FALSE(set.holds("org.acme.toolbox"));
    EXPECT_TRUE(set.admits("org.acme.rope", {1, 2, 0}));
    EXPECT_FALSE(set.admits("org.acme.rope", {3, 0, 0}));
    EXPECT_EQ(set.wantedOf("org.acme.rope"), ">=1.2 <3");
}

TEST_F(PluginSetTest, AnExclusionOfAnIncludedSetDoesNotReachFurther)
{
    write("draw", R"({ "plugins": ["org.acme.*"], "exclude": ["org.acme.engine"] })");
    write("play", R"({ "include": ["draw"], "plugins": ["org.acme.engine"] })");
    EXPECT_FALSE(read("draw").holds("org.acme.engine"));
    EXPECT_TRUE(read("play").holds("org.acme.engine"));
    EXPECT_FALSE(read("play").excludes("org.acme.engine"));
}

TEST_F(PluginSetTest, MistakesAreToldWithTheirPlace)
{
    const std::string user = PluginSetFiles::userFolder().string() + "/";
    write("json", "{\n  \"plugins\": [,]\n}");
    EXPECT_EQ(errorOf("json"), user + "json.jetset:2:15: error: this plugin set is not valid JSON");
    write("list", "[]");
    EXPECT_THAT(errorOf("list"), HasSubstr("list.jetset:1:1: error: a plugin set is {"));
    write("kind", "{\n  \"plugins\": \"org.acme.rope\"\n}");
    EXPECT_THAT(errorOf("kind"), HasSubstr("kind.jetset:2:3: error: plugins must be a list of plugin ids"));
    write("id", "{ \"plugins\": [\"org.acme.rope\",\n \"Rope\"] }");
    EXPECT_THAT(errorOf("id"), HasSubstr("id.jetset:2:2: error: 'Rope' is not an id"));
    write("range", "{ \"plugins\": [\"org.acme.rope =>1\"] }");
    EXPECT_THAT(errorOf("range"), HasSubstr("range.jetset:1:15: error: '=>' is not a comparison of versions"));
    write("pattern", "{ \"plugins\": [\"org.acme.* >=1\"] }");
    EXPECT_THAT(errorOf("pattern"), HasSubstr("pattern.jetset:1:15: error: 'org.acme.*' is not an id"));
    write("nothing", "{ \"name\": \"Nothing\" }");
    EXPECT_THAT(errorOf("nothing"), HasSubstr("or it includes other sets"));
    write("gone", "{ \"include\": [\"json\",\n  \"jsom\"] }");
    write("json", "{ \"plugins\": [] }");
    EXPECT_THAT(errorOf("gone"),
                HasSubstr("gone.jetset:2:3: error: there is no plugin set 'jsom'; did you mean 'json'?"));
    write("slip", "{ \"plugins\": [],\n  \"exlude\": [] }");
    ASSERT_EQ(read("slip").warnings.size(), 1u);
    EXPECT_THAT(read("slip").warnings[0].text(),
                HasSubstr("slip.jetset:2:3: error: this JET knows no field 'exlude' of plugin sets; did you mean "
                          "'exclude'?"));
}

// The schema goes by the same table (tests/sdk/json_schema_test.py).
TEST_F(PluginSetTest, TheTableOfSetsIsJudgedAsTheSchemaDoes)
{
    std::ifstream in(JET_SOURCE_DIR "/tests/fixtures/sets.json");
    const auto table = nlohmann::json::parse(in);
    ASSERT_GT(table["cases"].size(), 20u);
    write("base", R"({ "plugins": [] })");
    for (const auto& entry : table["cases"]) {
        SCOPED_TRACE(entry["name"]);
        write("case", entry["set"].dump(1));
        const auto set = PluginSetFiles().choose("case");
        const std::string verdict = !set ? "refused" : set->warnings.empty() ? "good" : "warned";
        std::string said = set ? "" : set.error().text();
        if (verdict == "warned") said = set->warnings[0].text();
        EXPECT_EQ(verdict, entry["verdict"]) << said;
        EXPECT_THAT(said, HasSubstr(entry.value("says", "")));
    }
}

TEST_F(PluginSetTest, ACycleOfIncludesIsNamedWithItsWholeChain)
{
    write("a", R"({ "include": ["b"] })");
    write("b", R"({ "include": ["c"] })");
    write("c", R"({ "include": ["b"] })");
    EXPECT_THAT(errorOf("a"), HasSubstr("c.jetset:1:15: error: the set includes itself: b.jetset → c.jetset → "
                                        "b.jetset; remove one of these includes"));
}

TEST_F(PluginSetTest, FilesAreFoundBesideTheSetThatIncludesThem)
{
    folder.write("sets/more", "");
    std::ofstream(folder.path() / "sets/a.jetset") << R"({ "include": ["more/b.jetset"] })";
    std::ofstream(folder.path() / "sets/more/b.jetset") << R"({ "plugins": ["org.acme.rope"] })";
    const PluginSet set = read((folder.path() / "sets/a.jetset").string());
    EXPECT_TRUE(set.holds("org.acme.rope"));
    EXPECT_EQ(set.name, "a");
    EXPECT_THAT(errorOf("nowhere/x.jetset"), HasSubstr("nowhere/x.jetset: error: cannot be opened"));
}

TEST_F(PluginSetTest, TheCommandLineMixesSetsFilesAndPlugins)
{
    write("small", R"({ "plugins": ["org.acme.base"] })");
    const PluginSet set = read("small, org.acme.rope >=1.2,org.acme.glue");
    EXPECT_TRUE(set.holds("org.acme.base") && set.holds("org.acme.rope") && set.holds("org.acme.glue"));
    EXPECT_FALSE(set.admits("org.acme.rope", {1, 1, 0}));
    EXPECT_TRUE(read("org.acme.rope").holds("org.acme.rope")) << "one plugin alone is a set, too";
    EXPECT_THAT(errorOf("smal"), HasSubstr("there is no plugin set 'smal'; did you mean 'small'?"));
    EXPECT_THAT(errorOf("small,"), HasSubstr("there is no plugin set ''"));
    EXPECT_THAT(errorOf("project"), HasSubstr("'jet plugins freeze PROJECT -o plugins.jetset' writes one"));
}

TEST_F(PluginSetTest, TheUsersSetHidesAShippedOneOfItsName)
{
    ASSERT_FALSE(PluginSetFiles::shippedFolder().empty());
    EXPECT_EQ(read("minimal").source, SetSource::Shipped);
    write("minimal", R"({ "plugins": ["org.acme.rope"] })");
    EXPECT_EQ(read("minimal").source, SetSource::User);
    std::ofstream(folder.path() / "project.jet") << "<jet-project/>";
    std::ofstream(folder.path() / "plugins.jetset") << R"({ "plugins": ["org.acme.knot"] })";
    const PluginSetFiles files(folder.path() / "project.jet");
    EXPECT_EQ(files.list().front().name, "project");
    EXPECT_TRUE(files.choose("project").orThrow().holds("org.acme.knot"));
}

// --- what it chooses

TEST_F(PluginSetTest, WhatAPluginOfTheSetRequiresComesWithItUnlessExcluded)
{
    folder.add("org.acme.a", R"("requires": ["org.acme.b"])");
    folder.add("org.acme.b", R"("requires": ["org.acme.c"])");
    folder.add("org.acme.c");
    folder.add("org.acme.other");
    scan(PluginSet::of({"org.acme.a"}, "small"));
    EXPECT_THAT(usable(), ElementsAre("org.acme.a", "org.acme.b", "org.acme.c"));
    PluginSet without = PluginSet::of({"org.acme.a"}, "small");
    without.excluded.push_back({{"org.acme.c", {}}, false, {}});
    scan(without);
    EXPECT_THAT(usable(), IsEmpty());
    EXPECT_THAT(manager->plugin("org.acme.a")->reason, HasSubstr("it requires org.acme.b, which is disabled"));
}

TEST_F(PluginSetTest, AVersionTheSetDoesNotAdmitIsLeftOutAndAFittingCopyIsUsed)
{
    folder.add("org.acme.rope", "", "1.0.0", "old");
    folder.add("org.acme.rope", "", "2.0.0", "new");
    write("ancient", R"({ "plugins": ["org.acme.rope <1"] })");
    scan(read("ancient"));
    EXPECT_THAT(usable(), IsEmpty());
    EXPECT_EQ(
        manager->plugin("org.acme.rope")->reason,
        "the chosen plugin set 'ancient' wants org.acme.rope <1, and version 2.0.0 is installed; install one that "
        "fits, or choose another set");
    write("older", R"({ "plugins": ["org.acme.rope ^1"] })");
    EXPECT_THAT(manager->useSet(read("older")), ElementsAre("org.acme.rope"));
    EXPECT_EQ(manager->plugin("org.acme.rope")->manifest.version.text(), "1.0.0");
    EXPECT_THAT(manager->useSet(std::nullopt), ElementsAre("org.acme.rope")) << "another copy";
    EXPECT_EQ(manager->plugin("org.acme.rope")->manifest.version.text(), "2.0.0") << "the newer one again";
}

TEST_F(PluginSetTest, ASetIsChangedWhileTheProgramRuns)
{
    folder.add("org.acme.a");
    folder.add("org.acme.b");
    scan();
    EXPECT_THAT(manager->useSet(PluginSet::of({"org.acme.a"})), ElementsAre("org.acme.b"));
    EXPECT_EQ(manager->whoProvides(ContributionKind::Effect, "b").availability, Availability::LeftOut);
    EXPECT_THAT(manager->setEnabled({"org.acme.b"}, true), ElementsAre("org.acme.b")) << "let in for this run";
    EXPECT_THAT(manager->useSet(PluginSet::of({"org.acme.b"})), ElementsAre("org.acme.a"));
}

// --- differences

TEST_F(PluginSetTest, DifferencesToASetAreNamedWithTheRemedy)
{
    folder.add("org.acme.old", "", "1.0.0");
    folder.add("org.acme.off");
    write("all", R"({ "plugins": ["com.far.away ^1", "org.acme.old >=2", "org.acme.of", "org.nobody.*"],
                      "optional": ["org.acme.maybe"] })");
    scan();
    std::vector<std::string> told;
    for (const PluginDifference& one : setDifferences(*manager, read("all"))) told.push_back(sentenceOf(one));
    EXPECT_THAT(told,
                ElementsAre("com.far.away: the plugin set wants ^1, it is not installed; get its .jetplugin file and "
                            "run 'jet plugins install FILE'",
                            "org.acme.of: it is not installed; get its .jetplugin file and run 'jet plugins install "
                            "FILE'; did you mean 'org.acme.off'?",
                            "org.acme.old: the plugin set wants >=2, version 1.0.0 is here; install a version in that "
                            "range",
                            "org.nobody.*: no installed plugin is meant by it; mend the set, or install such plugins"));
}

TEST_F(PluginSetTest, FrozenDemandsExactVersionsOfAllThatIsUsed)
{
    folder.add("org.acme.a", R"("requires": ["org.acme.b"])");
    folder.add("org.acme.b", "", "1.2.0");
    const auto frozen = [&](const std::string& text) {
        write("ci", text);
        scan(read("ci"));
        const auto checked = checkFrozen(*manager, nullptr);
        return checked ? "fine" : checked.error().message;
    };
    EXPECT_EQ(frozen(R"({ "plugins": ["org.acme.a =1.0.0", "org.acme.b =1.2.0"] })"), "fine");
    EXPECT_THAT(frozen(R"({ "plugins": ["org.acme.a =1.0.0"] })"),
                HasSubstr("\n  org.acme.b: a plugin of the set 'ci' requires it, and the set gives no version of it"));
    EXPECT_THAT(frozen(R"({ "plugins": ["org.acme.a", "org.acme.b =1.2.0"] })"),
                HasSubstr("gives no exact version of org.acme.a; 'jet plugins freeze'"));
    EXPECT_THAT(frozen(R"({ "plugins": ["*"] })"), HasSubstr("gives no exact version of *"));
    const std::string both = frozen(R"({ "plugins": ["org.acme.a =1.0.1", "org.acme.b =1.2.1", "org.acme.c =1"] })");
    EXPECT_THAT(both, HasSubstr("\n  org.acme.a: the plugin set wants =1.0.1, it is left out"));
    EXPECT_THAT(both, HasSubstr("\n  org.acme.b: the plugin set wants =1.2.1, it is left out"));
    EXPECT_THAT(both, HasSubstr("\n  org.acme.c: the plugin set wants =1, it is not installed"));
    scan();
    EXPECT_THAT(checkFrozen(*manager, nullptr).error().message, HasSubstr("name a set that has them (--plugins SET)"));
}

TEST_F(PluginSetTest, WhatIsFrozenIsExactlyWhatIsInUse)
{
    folder.add("org.acme.a", R"("requires": ["org.acme.b"])");
    folder.add("org.acme.b", "", "1.2.0");
    folder.add("org.acme.other");
    scan(PluginSet::of({"org.acme.a"}));
    std::vector<std::string> entries;
    for (const FrozenPlugin& plugin : pluginsInUse(*manager, nullptr)) entries.push_back(plugin.text());
    EXPECT_THAT(entries, ElementsAre("org.acme.a =1.0.0", "org.acme.b =1.2.0"));
    write("frozen", setText("Frozen", {}, entries));
    scan(read("frozen"));
    EXPECT_TRUE(checkFrozen(*manager, nullptr));
    EXPECT_THAT(usable(), ElementsAre("org.acme.a", "org.acme.b"));
}

}  // namespace
}  // namespace jet::host
