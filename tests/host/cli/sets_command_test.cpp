// Plugin sets and --frozen on the command line, and what the shipped sets can do.
#include "cli_fixture.hpp"

#include <set>
#include <vector>

namespace jet::test {
namespace {

class SetsCommandTest : public CliTest {
protected:
    const std::string game = JET_SOURCE_DIR "/examples/games/ball";
    /// The example game in the home folder, as others would have it.
    void copyGame() { std::filesystem::copy(game, home() / "ball", std::filesystem::copy_options::recursive); }
};

// --- the shipped sets

TEST_F(SetsCommandTest, EachShippedSetResolvesWithAllItNames)
{
    const Outcome run = plain("plugins sets --json");
    ASSERT_EQ(run.code, 0) << run.err;
    std::vector<std::string> shipped;
    for (const auto& set : json(run.out)) {
        if (set["source"] != "shipped") continue;
        shipped.push_back(set["name"]);
        EXPECT_TRUE(set["missing"].empty()) << set;
        EXPECT_GT(set["plugins"].get<int>(), 3) << set;
        EXPECT_FALSE(set["description"].get<std::string>().empty()) << set;
    }
    EXPECT_THAT(shipped, testing::ElementsAre("drawing", "everything", "minimal", "physics"));
    for (const std::string& name : shipped) {
        const Outcome list = plain("plugins list --json --plugins " + name);
        EXPECT_EQ(list.err, "") << name;
        const auto shown = json(plain("plugins sets show " + name + " --json").out);
        for (const auto& one : shown["plugins"]) EXPECT_TRUE(one["fits"]) << name << ": " << one;
        std::size_t usable = 0;
        for (const auto& plugin : json(list.out)) usable += plugin["state"] == "resolved";
        EXPECT_EQ(usable, shown["plugins"].size()) << name;
    }
}

TEST_F(SetsCommandTest, TheDrawingSetOpensAndConvertsADrawing)
{
    const std::string drawing = JET_SOURCE_DIR "/tests/fixtures/samples/drawing.svg";
    const Outcome run = plain("--plugins drawing convert " + drawing + " out.png");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_GT(std::filesystem::file_size(home() / "out.png"), 500u);
    EXPECT_EQ(plain("--plugins drawing convert " + drawing + " drawing.jet").code, 0);
    EXPECT_THAT(read("drawing.jet"), HasSubstr("org.jet.effect.polygon-face"));
    const Outcome play = plain("--plugins drawing play " + game);
    EXPECT_EQ(play.code, 1) << "nothing plays";
    EXPECT_THAT(play.err, HasSubstr("not in the chosen plugin set 'drawing'"));
}

TEST_F(SetsCommandTest, ThePhysicsSetPlaysTheExampleAsAllPluginsDo)
{
    const Outcome run = plain("--plugins physics play " + game + " --steps 120 --state set.json");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    ASSERT_EQ(plain("play " + game + " --steps 120 --state all.json").code, 0);
    EXPECT_EQ(json(read("set.json"))["hash"], json(read("all.json"))["hash"]);
}

// --- which sets there are

TEST_F(SetsCommandTest, SetsAreListedWithSourceCountAndWhatIsMissing)
{
    write("config/jet/sets/mine.jetset",
          R"({ "name": "Mine", "plugins": ["org.jet.tool.rectangle", "org.acme.rope >=1.2", "org.jet.io-svg >=7"] })");
    write("config/jet/sets/bad.jetset", "{\n  \"plugins\": 1 }");
    copyGame();
    write("ball/plugins.jetset", R"({ "plugins": ["org.jet.physics"] })");
    const Outcome run = plain("plugins sets --project ball");
    EXPECT_EQ(run.code, 1) << "one cannot be read";
    EXPECT_THAT(run.err, HasSubstr("bad.jetset:2:3: error: plugins must be a list of plugin ids"));
    EXPECT_THAT(run.out, testing::ContainsRegex("\\* \\(all\\) +[0-9]+ plugins"));
    EXPECT_THAT(run.out, testing::ContainsRegex("  project +project +1 plugin "));
    EXPECT_THAT(run.out, testing::ContainsRegex("  mine +user +2 plugins  Mine"));
    EXPECT_THAT(run.out, HasSubstr("missing  org.acme.rope >=1.2: it is not installed"));
    EXPECT_THAT(run.out, HasSubstr("missing  org.jet.io-svg >=7: version 1.0.0 is here"));
    EXPECT_THAT(run.out, testing::ContainsRegex("  drawing +shipped"));
    const Outcome show = plain("plugins sets show mine");
    EXPECT_EQ(show.code, 0) << show.err;
    EXPECT_THAT(show.out, testing::ContainsRegex("org.acme.rope +not installed +wants >=1.2"));
    EXPECT_THAT(plain("plugins sets show nothing").err, HasSubstr("there is no plugin set 'nothing'"));
}

TEST_F(SetsCommandTest, ASetThatMissesSomethingIsUsedWithAWarningAtItsLine)
{
    write("mine.jetset", "{ \"plugins\": [\"org.jet.io-svg\",\n  \"org.jet.io-png >=7\", \"org.acme.rope\"] }");
    const Outcome run = plain("--plugins mine.jetset plugins list");
    EXPECT_EQ(run.code, 0);
    EXPECT_THAT(run.err, HasSubstr("mine.jetset:2:25: warning: org.acme.rope: it is not installed"));
    EXPECT_THAT(run.err, HasSubstr("mine.jetset:2:3: warning: org.jet.io-png: the plugin set wants >=7"));
    EXPECT_EQ(lines(run.err), 2u) << run.err;
}

TEST_F(SetsCommandTest, PluginsAreNamedOnTheCommandLineToo)
{
    const auto usable = [&](const std::string& value) {
        std::set<std::string> ids;
        for (const auto& plugin : json(plain("--plugins '" + value + "' plugins list --json").out))
            if (plugin["state"] == "resolved") ids.insert(plugin["id"].get<std::string>());
        return ids;
    };
    EXPECT_THAT(usable("org.jet.io-svg, org.jet.io-png =1"),
                testing::UnorderedElementsAre("org.jet.io-svg", "org.jet.io-png"));
    EXPECT_TRUE(usable("minimal,org.jet.io-svg").contains("org.jet.tool.selection"));
    EXPECT_THAT(plain("--plugins drawin plugins list").err,
                HasSubstr("error: there is no plugin set 'drawin'; did you mean 'drawing'?"));
    EXPECT_EQ(plain("--plugins drawin plugins list").code, 1);
}

TEST_F(SetsCommandTest, AChosenSetHoldsForLaterRunsUntilAnotherIsChosen)
{
    EXPECT_EQ(plain("plugins sets use minimal").code, 0);
    EXPECT_EQ(read("config/jet/plugin-set"), "minimal\n");
    EXPECT_THAT(plain("plugins list").out, HasSubstr("not in the chosen plugin set 'minimal'"));
    EXPECT_THAT(plain("plugins sets").out, HasSubstr("* minimal"));
    EXPECT_THAT(plain("plugins list --safe-mode").out, testing::Not(HasSubstr("chosen plugin set")));
    EXPECT_THAT(plain("plugins list --plugins everything").out, testing::Not(HasSubstr("chosen plugin set")));
    EXPECT_EQ(plain("plugins sets use nothing").code, 1);
    write("config/jet/plugin-set", "gone\n");
    const Outcome gone = plain("plugins list");
    EXPECT_EQ(gone.code, 0);
    EXPECT_THAT(gone.err, HasSubstr("warning: the plugin set 'gone', which was chosen earlier, is not used"));
    EXPECT_EQ(plain("plugins sets use all").code, 0);
    EXPECT_FALSE(exists("config/jet/plugin-set"));
    EXPECT_EQ(plain("plugins list").err, "");
}

// --- exact versions

TEST_F(SetsCommandTest, AFrozenProjectPlaysWithItsVersionsAndFailsWithOthers)
{
    copyGame();
    ASSERT_EQ(plain("play ball --steps 2 --frozen").code, 0) << "its record names the versions that are here";
    const Outcome frozen = plain("plugins freeze ball -o ball/plugins.jetset");
    ASSERT_EQ(frozen.code, 0) << frozen.err;
    EXPECT_THAT(read("ball/plugins.jetset"), HasSubstr("\"org.jet.physics =1.0.0\"")) << "it is played with that";
    EXPECT_THAT(read("ball/plugins.jetset"), HasSubstr("\"org.jet.effect.in-path-body =1.0.0\""));
    EXPECT_THAT(read("ball/plugins.jetset"), testing::Not(HasSubstr("org.jet.panel")));
    const Outcome play = plain("play ball --steps 60 --frozen --plugins project --state state.json");
    EXPECT_EQ(play.code, 0) << play.err;
    std::string set = read("ball/plugins.jetset");
    set.replace(set.find("org.jet.physics =1.0.0"), 22, "org.jet.physics =0.9.0");
    write("ball/plugins.jetset", set);
    std::string project = read("ball/project.jet");
    project.replace(project.find("polygon-face\" version=\"1.0.0"), 28, "polygon-face\" version=\"1.4.0");
    write("ball/project.jet", project);
    for (const std::string& command :
         std::vector<std::string>{"play ball --steps 1", "convert ball out.png", "project check ball"}) {
        const Outcome run = plain(command + " --frozen");
        EXPECT_EQ(run.code, 1) << command;
        EXPECT_THAT(run.err, HasSubstr("project.jet: error: the plugins are not those that are recorded (--frozen):"));
        EXPECT_THAT(run.err, HasSubstr("\n  org.jet.effect.polygon-face: the project wants 1.4.0 (3 uses), version "
                                       "1.0.0 is here; install 1.4.0 or later"));
        EXPECT_THAT(run.err, HasSubstr("\n  org.jet.physics: the plugin set wants =0.9.0, version 1.0.0 is here"));
        const Outcome loose = plain(command);
        EXPECT_EQ(loose.code, 0) << command << ": goes on without --frozen; " << loose.err;
        EXPECT_THAT(loose.err, HasSubstr("ball/project.jet: warning: org.jet.effect.polygon-face: the project wants"));
    }
    EXPECT_FALSE(exists("out.png") && std::filesystem::file_size(home() / "out.png") == 0);
}

TEST_F(SetsCommandTest, FrozenRepairsNothingWithOtherPlugins)
{
    copyGame();
    std::string project = read("ball/project.jet");
    project.replace(project.find("polygon-face\" version=\"1.0.0"), 28, "polygon-face\" version=\"1.4.0");
    write("ball/project.jet", project);
    const auto scene = [&] { return read("ball/scenes/Scene 0.scene"); };
    std::string broken = scene();
    broken.replace(broken.find("id=\"4\""), 6, "id=\"3\"");
    write("ball/scenes/Scene 0.scene", broken);
    ASSERT_EQ(plain("project check ball").code, 1);
    const Outcome run = plain("project check ball --repair --frozen");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("cannot be read before it is repaired; repair it without --frozen")) << run.out;
    EXPECT_EQ(scene(), broken);
    EXPECT_EQ(plain("project check ball --repair").code, 0);
    EXPECT_NE(scene(), broken);
    const Outcome now = plain("project check ball --repair --frozen");
    EXPECT_EQ(now.code, 1);
    EXPECT_THAT(now.err, HasSubstr("org.jet.effect.polygon-face: the project wants 1.4.0")) << now.out;
}

TEST_F(SetsCommandTest, AFrozenSetFailsForEveryCommandAndListsEveryDifference)
{
    write("ci.jetset", R"({ "plugins": ["org.jet.io-svg =1.0.0", "org.jet.io-png =9.0.0", "org.acme.rope =1.0.0"] })");
    write("a.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><rect width='5' height='5'/></svg>");
    for (const std::string& command : std::vector<std::string>{"plugins list", "convert a.svg a.png", "play " + game}) {
        const Outcome run = plain("--plugins ci.jetset --frozen " + command);
        EXPECT_EQ(run.code, 1) << command;
        EXPECT_THAT(run.err, HasSubstr("ci.jetset: error: the plugins are not those that are recorded (--frozen):\n"
                                       "  org.acme.rope: the plugin set wants =1.0.0, it is not installed"));
        EXPECT_THAT(run.err, HasSubstr("\n  org.jet.io-png: the plugin set wants =9.0.0, it is left out"));
    }
    EXPECT_FALSE(exists("a.png"));
    write("ci.jetset", R"({ "plugins": ["org.jet.io-svg =1.0.0", "org.jet.io-png =1.0.0"] })");
    EXPECT_EQ(plain("--plugins ci.jetset --frozen convert a.svg a.png").code, 0);
    EXPECT_TRUE(exists("a.png"));
    const Outcome vague = plain("--plugins minimal --frozen plugins list");
    EXPECT_EQ(vague.code, 1);
    EXPECT_THAT(vague.err, HasSubstr("the plugin set 'minimal' gives no exact version of org.jet.tool.selection"));
    EXPECT_EQ(plain("--frozen plugins list").code, 1);
    EXPECT_THAT(plain("--frozen convert a.svg b.png").err, HasSubstr("name a set that has them (--plugins SET)"));
    EXPECT_FALSE(exists("b.png"));
}

TEST_F(SetsCommandTest, AFrozenEditorDoesNotStartWithOtherPlugins)
{
    copyGame();
    std::string project = read("ball/project.jet");
    project.replace(project.find("polygon-face\" version=\"1.0.0"), 28, "polygon-face\" version=\"1.4.0");
    write("ball/project.jet", project);
    const Outcome run = plain("--frozen ball", "QT_QPA_PLATFORM=offscreen");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("org.jet.effect.polygon-face: the project wants 1.4.0"));
}

TEST_F(SetsCommandTest, FreezingKeepsASetAndRefusesWhatCannotBeUsed)
{
    EXPECT_EQ(plain("--plugins minimal plugins freeze -o min.jetset").code, 0);
    const Outcome again = plain("--plugins min.jetset --frozen plugins list");
    EXPECT_EQ(again.code, 0) << again.err;
    const auto frozen = json(read("min.jetset"));
    EXPECT_EQ(frozen["name"], "Minimal");
    EXPECT_EQ(frozen["plugins"].size(), json(plain("plugins sets show minimal --json").out)["plugins"].size());
    const Outcome without = plain("--without org.jet.effect.polygon-face plugins freeze " + game);
    EXPECT_EQ(without.code, 1);
    EXPECT_THAT(without.err,
                HasSubstr("cannot be frozen while one of them cannot be used: org.jet.effect.polygon-face"));
}

}  // namespace
}  // namespace jet::test
