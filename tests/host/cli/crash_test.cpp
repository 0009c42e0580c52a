// After a crash inside a plugin the command line says so once, and goes on without the plugin, or in safe mode, without
// losing what it made.
#include "cli_fixture.hpp"

#include <csignal>

namespace jet::test {
namespace {

class CrashOnTheCommandLine : public CliTest {
protected:
    CrashOnTheCommandLine()
    {
        plugins().link("org.jet.test.evil-crashes");
        plugins().link("org.jet.test.good");
    }
    Outcome run(const std::string& arguments, const std::string& environment = "")
    {
        return plain("--plugin-path '" + plugins().path().string() + "' " + arguments, environment);
    }
};

TEST_F(CrashOnTheCommandLine, IsToldOnceByTheNextCommand)
{
    const Outcome crashed = run("plugins info org.jet.test.evil-crashes", "JET_TEST_EVIL=load");
    EXPECT_NE(crashed.code, 0);
    const Outcome next = run("plugins list");
    EXPECT_EQ(next.code, 0);
    EXPECT_THAT(next.err, HasSubstr("warning: the run of JET that began at "));
    EXPECT_THAT(next.err,
                HasSubstr("crashed (segmentation fault) while the plugin org.jet.test.evil-crashes 1.0.0 was "
                          "in load; '--without org.jet.test.evil-crashes' goes on without it, '--safe-mode'"));
    EXPECT_EQ(lines(next.err), 1u);
    EXPECT_EQ(run("plugins list").err, "");
    EXPECT_EQ(run("plugins info org.jet.test.evil-crashes --without org.jet.test.evil-crashes").code, 1);
}

TEST_F(CrashOnTheCommandLine, ACommandThatEndsWellLeavesNothingBehind)
{
    EXPECT_EQ(run("plugins info org.jet.test.good").code, 0);
    EXPECT_TRUE(std::filesystem::is_empty(home() / "state/jet/ledger"));
}

TEST_F(CrashOnTheCommandLine, SafeModeKeepsWhatPluginsMade)
{
    writeGame();
    ASSERT_EQ(run("project save game").code, 0);
    const std::string project = read("game/project.jet"), scene = read("game/one.scene");
    EXPECT_THAT(scene, HasSubstr("box-body"));
    for (const char* mode : {"--safe-mode", "--without org.jet.test.good"}) {
        EXPECT_EQ(run(std::string(mode) + " project save game").code, 0) << mode;
        EXPECT_EQ(read("game/project.jet"), project) << mode;
        EXPECT_EQ(read("game/one.scene"), scene) << mode;
    }
}

}  // namespace
}  // namespace jet::test
