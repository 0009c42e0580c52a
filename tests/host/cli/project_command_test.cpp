// jet project: new, check, info, save.
#include "cli_fixture.hpp"
#include <test_paths.hpp>

namespace jet::test {
namespace {

class ProjectCommandTest : public CliTest {
protected:
    ProjectCommandTest() { plugins().link("org.jet.test.good"); }
};

TEST_F(ProjectCommandTest, ANewProjectIsFineAndNamedAfterItsFolder)
{
    EXPECT_EQ(jet("project new games/ball/").code, 0);
    const Outcome check = jet("project check games/ball");
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_THAT(check.out, HasSubstr("fine: 1 scenes, 1 items, 0 warnings"));
    EXPECT_EQ(json(jet("--json project info games/ball").out)["name"], "ball");
    const auto before = files();
    const Outcome again = jet("project new games/ball");
    EXPECT_EQ(again.code, 1);
    EXPECT_THAT(again.err, HasSubstr("there is a project here already; choose another folder"));
    EXPECT_EQ(files(), before);
}

TEST_F(ProjectCommandTest, AWordThatIsNoCommandIsAProjectThatMustExist)
{
    const Outcome slip = jet("plya");
    EXPECT_EQ(slip.code, 2);
    EXPECT_EQ(slip.err, "plya: error: there is no such project; did you mean the command 'play'?\n");
    const Outcome more = jet("convret a.svg b.png --width 40");
    EXPECT_EQ(more.code, 2);
    EXPECT_EQ(more.err, "convret: error: there is no such project; did you mean the command 'convert'?\n");
    const Outcome inner = jet("plugins lits");
    EXPECT_EQ(inner.code, 2);
    EXPECT_EQ(inner.err,
              "error: 'lits' is no command of 'jet plugins'; did you mean 'list'? 'jet plugins --help' lists them\n");
    // An option that may come several times takes one word each time, not the project behind it.
    EXPECT_THAT(jet("--watch x games/none").err, HasSubstr("games/none: error: there is no such project"));
    const Outcome missing = jet("games/none");
    EXPECT_EQ(missing.code, 1);
    EXPECT_THAT(missing.err, HasSubstr("games/none: error: there is no such project; 'jet project new DIR'"));
}

TEST_F(ProjectCommandTest, CheckNamesFileLineAndColumn)
{
    writeGame();
    write("game/two.scene", "<scene version=\"1\">\n  <item type=\"shape\" id=\"1\" name=\"S\"><path>M 0 0 L nan "
                            "0</path></item>\n</scene>\n");
    const Outcome run = jet("project check game");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, testing::MatchesRegex("game/two.scene:2:[0-9]+: error: the path of 'S': (.|\n)*"));
    EXPECT_EQ(lines(run.err), 1u);
    const auto told = json(jet("--json project check game").out);
    EXPECT_EQ(told["ok"], false);
    EXPECT_EQ(told["errors"][0]["line"], 2);
}

TEST_F(ProjectCommandTest, AMissingPluginIsAWarningThatNamesIt)
{
    writeGame();
    const Outcome run = jet("project check game --without org.jet.test.good");
    EXPECT_EQ(run.code, 0);
    EXPECT_THAT(run.err, HasSubstr("game/one.scene:2:"));
    EXPECT_THAT(run.err, HasSubstr("warning: No installed plugin provides the effect 'box-body'"));
    EXPECT_EQ(json(jet("--json project check game --without org.jet.test.good").out)["notes"].size(), 1u);
}

TEST_F(ProjectCommandTest, InfoTellsScenesTypesAndPlugins)
{
    writeGame();
    const auto info = json(jet("--json project info game").out);
    EXPECT_EQ(info["name"], "Game");
    EXPECT_EQ(info["scenes"].size(), 2u);
    EXPECT_EQ(info["scenes"][0]["types"]["body"], 1);
    EXPECT_EQ(info["scenes"][0]["bounds"], (std::vector<double>{0, 0, 10, 10}));
    EXPECT_EQ(info["plugins"][0]["id"], "org.jet.test.good");
    EXPECT_THAT(jet("project info game").out, HasSubstr("scene 'One': 2 items"));
}

TEST_F(ProjectCommandTest, SavingAnUnchangedProjectKeepsItsBytesWithAnyPlugins)
{
    writeGame();
    const auto before = files();
    for (const char* options : {"", "--without org.jet.test.good", "--safe-mode"}) {
        EXPECT_EQ(jet(std::string("project save game ") + options).code, 0);
        EXPECT_EQ(files(), before) << options;
    }
}

TEST_F(ProjectCommandTest, ABrokenProjectIsNotSaved)
{
    writeGame();
    write("game/two.scene", "<scene");
    const auto before = files();
    EXPECT_EQ(jet("project save game").code, 1);
    EXPECT_EQ(files(), before);
    EXPECT_EQ(jet("project info game").code, 1);
    EXPECT_EQ(jet("project check nowhere").code, 1);
}

TEST_F(ProjectCommandTest, ANewProjectWhereNoneCanBeSaysSo)
{
    write("file", "");
    const Outcome run = jet("project new file/game");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("choose another place"));
}

TEST_F(ProjectCommandTest, AFileSizeLimitIsAMessage)
{
    const Outcome run =
        plain("--version >/dev/null; ulimit -f 0; exec '" JET_BINARY_DIR "/bin/jet' project new limited");
    EXPECT_EQ(run.code, 1) << "the redirected output is limited, too, so the code has to tell";
    EXPECT_FALSE(exists("limited/project.jet"));
}

}  // namespace
}  // namespace jet::test
