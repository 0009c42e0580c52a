// Usage of the command line in general, and jet plugins.
#include "cli_fixture.hpp"

namespace jet::test {
namespace {

class PluginsCommandTest : public CliTest {};

TEST_F(PluginsCommandTest, WrongUsageExitsWithTwo)
{
    for (const char* arguments :
         {"play", "plugins", "plugins list too many", "plugins info", "plugins dance", "project", "project check",
          "convert", "convert one", "play a b", "play a --steps x", "play a --steps -1", "play a --dt 0",
          "play a --threads 0", "play a --nonsense", "--nonsense", "convert a b --width 0"}) {
        const Outcome run = plain(arguments);
        EXPECT_EQ(run.code, 2) << arguments;
        EXPECT_NE(run.err + run.out, "") << arguments;
    }
}

TEST_F(PluginsCommandTest, HelpAndVersionAreFine)
{
    EXPECT_EQ(plain("--version").out, "jet " JET_SDK_VERSION "\n");
    for (const char* arguments : {"--help", "play --help", "convert --help", "plugins --help", "project new --help"}) {
        const Outcome run = plain(arguments);
        EXPECT_EQ(run.code, 0) << arguments;
        EXPECT_THAT(run.out, HasSubstr("Usage: jet")) << arguments;
    }
}

TEST_F(PluginsCommandTest, WithoutADisplayTheEditorNamesPlay)
{
    const Outcome run = plain("");
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(run.err,
              "error: there is no display for the editor; 'jet play PROJECT' plays without one (see 'jet --help')\n");
}

TEST_F(PluginsCommandTest, TheListShowsAllWithStatesAndReasons)
{
    plugins().link("org.jet.test.good");
    plugins().write("org.acme.a", "{ broken");
    plugins().add("org.acme.b", R"("requires": ["org.acme.gone"])");
    const Outcome run = jet("plugins list");
    EXPECT_EQ(run.code, 0);
    EXPECT_THAT(run.out, HasSubstr("org.jet.test.good"));
    EXPECT_THAT(run.out, HasSubstr("resolved  Does what it says"));
    EXPECT_THAT(run.out, testing::ContainsRegex(
                             "org.acme.a .* faulted +/.*plugin.json:1:3: error: this manifest is not valid JSON"));
    EXPECT_THAT(run.out, HasSubstr("it requires org.acme.gone"));
    const auto list = json(jet("--json plugins list").out);
    const auto good =
        std::find_if(list.begin(), list.end(), [](const auto& p) { return p["id"] == "org.jet.test.good"; });
    ASSERT_NE(good, list.end());
    EXPECT_EQ((*good)["state"], "resolved");
    EXPECT_EQ((*good)["contributes"]["effects"].size(), 2u);
}

// The loader itself tells which files it opens.
TEST_F(PluginsCommandTest, TheListLoadsNoLibrary)
{
    plugins().link("org.jet.test.good");
    const std::string options =
        "--plugins '" + file("test.jetset") + "' --plugin-path '" + plugins().path().string() + "' ";
    const Outcome list = plain(options + "plugins list", "LD_DEBUG=files");
    EXPECT_EQ(list.code, 0);
    EXPECT_THAT(list.err, HasSubstr("libjet-sdk.so"));
    EXPECT_THAT(list.err, testing::Not(HasSubstr("fixture-good.so")));
    EXPECT_THAT(list.err, testing::Not(HasSubstr("/jet/plugins/")));
    EXPECT_THAT(plain(options + "plugins info org.jet.test.good", "LD_DEBUG=files").err, HasSubstr("fixture-good.so"));
}

TEST_F(PluginsCommandTest, NoHeadlessCommandLoadsQt)
{
    EXPECT_THAT(plain("plugins list", "LD_DEBUG=files").err, testing::Not(HasSubstr("libQt6")));
    EXPECT_THAT(plain("--version", "LD_DEBUG=files").err, testing::Not(HasSubstr("libQt6")));
}

TEST_F(PluginsCommandTest, InfoLoadsAndTells)
{
    plugins().link("org.jet.test.good");
    const Outcome run = jet("plugins info org.jet.test.good");
    EXPECT_EQ(run.code, 0);
    EXPECT_THAT(run.out, HasSubstr("Good (org.jet.test.good 1.2.3)"));
    EXPECT_THAT(run.out, HasSubstr("state    loaded"));
    EXPECT_THAT(run.out, HasSubstr("importer 'boxes': Boxes .boxes"));
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(json(jet("--json plugins info org.jet.test.good").out)["state"], "loaded");
}

TEST_F(PluginsCommandTest, InfoOnABrokenOneFailsWithOneMessage)
{
    plugins().link("org.jet.test.no-symbol");
    plugins().write("org.acme.a", "{ broken");
    const Outcome symbol = jet("plugins info org.jet.test.no-symbol");
    EXPECT_EQ(symbol.code, 1);
    EXPECT_EQ(lines(symbol.err), 1u) << symbol.err;
    EXPECT_THAT(
        symbol.err,
        HasSubstr(
            "error: the plugin No symbol (org.jet.test.no-symbol 1.0.0) cannot be used: its library has no symbol"));
    const Outcome manifest = jet("plugins info org.acme.a");
    EXPECT_EQ(manifest.code, 1);
    EXPECT_THAT(manifest.err, HasSubstr("plugin.json:1:3: error: this manifest is not valid JSON"));
    const Outcome nobody = jet("plugins info org.acme.nobody");
    EXPECT_EQ(nobody.code, 1);
    EXPECT_EQ(nobody.err, "error: there is no plugin 'org.acme.nobody'; 'jet plugins list' shows all\n");
}

TEST_F(PluginsCommandTest, ExplainTellsWhoProvidesWhat)
{
    plugins().link("org.jet.test.good");
    EXPECT_EQ(jet("plugins explain tint").out, "The effect 'tint' comes from Good (org.jet.test.good 1.2.3).\n");
    EXPECT_THAT(jet("plugins explain .boxes").out, HasSubstr("The importer for .boxes files comes from Good"));
    const Outcome run = jet("plugins explain sparkle");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("no installed plugin provides"));
}

TEST_F(PluginsCommandTest, ExplainMendsASlipAndKnowsWhatTheProjectRecorded)
{
    plugins().link("org.jet.test.good");
    EXPECT_THAT(jet("plugins explain tnit").err, HasSubstr("called 'tnit'; did you mean 'tint'?"));
    write("game/project.jet",
          "<jet-project version=\"1\" name=\"Game\"><plugins><plugin id=\"org.acme.gone\" version=\"2.0.0\" uses=\"1\" "
          "provides=\"effects/hemp itemTypes/knot\"/></plugins><filter name=\"F\"><scene name=\"One\" "
          "file=\"one.scene\"/></filter></jet-project>");
    write("game/one.scene",
          "<scene version=\"1\"><item type=\"shape\" id=\"1\" name=\"Box\"><path>M 0 0 L 10 0 L 10 10 "
          "Z</path><effect type=\"hemp\"/></item></scene>");
    EXPECT_EQ(jet("plugins explain hemp").code, 1);
    const Outcome run = jet("plugins explain hemp --project game");
    EXPECT_EQ(run.code, 0);
    EXPECT_THAT(run.out,
                HasSubstr("The effect 'hemp' needs the plugin org.acme.gone 2.0.0, which the project was saved "
                          "with and which is not installed"));
    const auto answers = json(jet("--json plugins explain knot --project game").out);
    EXPECT_EQ(answers[0]["availability"], "not installed");
    EXPECT_EQ(answers[0]["plugin"], "org.acme.gone");
    EXPECT_THAT(jet("project check game").err + jet("project check game").out, HasSubstr("org.acme.gone 2.0.0"));
}

// A project's own plugins are left out until they are trusted, and the project is read all the same.
TEST_F(PluginsCommandTest, APluginBesideTheProjectWaitsForTrust)
{
    writeGame();
    std::filesystem::create_directories(home() / "game/plugins");
    std::filesystem::copy(fixtureFolder() / "org.jet.test.good", home() / "game/plugins/good",
                          std::filesystem::copy_options::recursive);
    const auto info = [this](const char* options) { return jet(std::string(options) + " project info game"); };
    EXPECT_THAT(info("").err,
                HasSubstr("warning: the project brings plugins of its own (good), which were left out: this "
                          "project is not trusted yet; if you know where it comes from, run 'jet plugins "
                          "trust "));
    EXPECT_THAT(jet("plugins explain box-body --project game").err, HasSubstr("left out"));
    EXPECT_EQ(jet("plugins trust game").code, 0);
    EXPECT_EQ(info("").err, "");
    EXPECT_THAT(jet("plugins explain box-body --project game").out, HasSubstr("comes from Good"));
    write("game/plugins/good/plugin.json", read("game/plugins/good/plugin.json") + " ");
    EXPECT_THAT(info("").err, HasSubstr("they changed since you trusted this project"));
    EXPECT_EQ(info("--trust").err, "");
    EXPECT_EQ(info("").err, "") << "--trust is remembered";
    EXPECT_THAT(info("--safe-mode").err, HasSubstr("left out in safe mode"));
    EXPECT_EQ(jet("plugins trust --revoke game").code, 0);
    EXPECT_THAT(info("").err, HasSubstr("not trusted yet"));
    EXPECT_THAT(jet("plugins trust .").err, HasSubstr("there are no plugins beside this project"));
}

TEST_F(PluginsCommandTest, DisablingNamesWhatRequiresItAndEnablingBringsItBack)
{
    plugins().add("org.acme.a");
    plugins().add("org.acme.b", R"("requires": ["org.acme.a"])");
    EXPECT_THAT(jet("plugins disable org.acme.a").err,
                HasSubstr("org.acme.b requires org.acme.a and is switched off with it"));
    EXPECT_THAT(jet("plugins list").out, testing::ContainsRegex("org.acme.b +1.0.0 +disabled +it requires org.acme.a"));
    EXPECT_THAT(jet("plugins enable org.acme.b").out, HasSubstr("org.acme.a is usable again with it"));
    EXPECT_THAT(jet("plugins list").out, testing::ContainsRegex("org.acme.b +1.0.0 +resolved"));
}

TEST_F(PluginsCommandTest, InfoWarnsOfWhatTheManifestDoesNotMean)
{
    plugins().add("org.acme.a", R"("requierd": [])");
    EXPECT_THAT(
        jet("plugins info org.acme.a").err,
        HasSubstr("warning: \"requierd\": this field is not known here and means nothing; did you mean 'requires'?"));
}

TEST_F(PluginsCommandTest, SwitchingOffLastsUntilSwitchedOn)
{
    plugins().link("org.jet.test.good");
    EXPECT_EQ(jet("plugins disable org.jet.test.good").code, 0);
    EXPECT_THAT(jet("plugins list").out, HasSubstr("disabled  switched off; 'jet plugins enable org.jet.test.good'"));
    EXPECT_EQ(jet("plugins enable org.jet.test.good").code, 0);
    EXPECT_THAT(jet("plugins list").out, HasSubstr("resolved"));
}

TEST_F(PluginsCommandTest, WithoutTakesPluginsAway)
{
    plugins().link("org.jet.test.good");
    EXPECT_THAT(jet("plugins list --without org.jet.test.good").out, testing::Not(HasSubstr("org.jet.test.good")));
}

TEST_F(PluginsCommandTest, AFolderWhoseManifestCannotBeReadIsListedUnderTheNameItGives)
{
    plugins().write("rope-1.2", "{ \"id\": \"org.acme.rope\", \"name\": \"Rope\", \"version\": 12 }");
    plugins().write("torn", "{ \"id\": \"org.acme.torn\",\n  \"name\": \"Torn\",\n  \"contributes\": {");
    plugins().write("empty", "");
    const std::string options = "--plugin-path '" + plugins().path().string() + "' plugins ";
    std::map<std::string, nlohmann::json> found;
    for (const auto& one : json(plain(options + "list --json").out))
        if (one["state"] == "faulted") found[one["id"]] = one;
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found["org.acme.rope"]["name"], "Rope");
    EXPECT_EQ(found["org.acme.rope"]["version"], "") << "what it says there cannot be trusted";
    EXPECT_THAT(found["org.acme.rope"]["reason"].get<std::string>(), HasSubstr("rope-1.2/plugin.json:1:"));
    EXPECT_EQ(found["org.acme.torn"]["name"], "Torn") << "although the file ends in the middle";
    EXPECT_EQ(found["empty"]["name"], "empty") << "the folder's, where there is nothing else";
    EXPECT_THAT(plain(options + "list").out, testing::ContainsRegex("org.acme.torn +- +faulted +.*plugin.json:3:"));
    EXPECT_THAT(plain(options + "info org.acme.torn").err, HasSubstr("the plugin Torn (org.acme.torn) cannot be used"));
}

TEST_F(PluginsCommandTest, WrongSetsAndFoldersAreTold)
{
    EXPECT_THAT(plain("--plugin-path nowhere plugins list").err,
                HasSubstr("nowhere: error: there is no such folder of plugins; check --plugin-path"));
    EXPECT_EQ(plain("--plugin-path nowhere plugins list").code, 1);
    const Outcome none = plain("--plugins none.jetset plugins list");
    EXPECT_EQ(none.code, 1);
    EXPECT_THAT(none.err, HasSubstr("none.jetset: error: cannot be opened"));
    write("bad.jetset", "[1]");
    EXPECT_THAT(plain("--plugins bad.jetset plugins list").err, HasSubstr("bad.jetset:1:1: error: a plugin set is {"));
}

}  // namespace
}  // namespace jet::test
