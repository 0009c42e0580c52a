// jet play: without a window, the same every time, and with one message when something is wrong.
#include "cli_fixture.hpp"

#include <set>

namespace jet::test {
namespace {

class PlayCommandTest : public CliTest {
protected:
    PlayCommandTest() { plugins().link("org.jet.test.good"); }
};

TEST_F(PlayCommandTest, ThePlayedStateIsAsPromised)
{
    writeGame();
    const Outcome run = jet("play game --physics falling --steps 60 --state state.json");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("hello\n"));
    EXPECT_THAT(run.out, HasSubstr("played 'One': 60 steps, 1.00 s simulated"));
    EXPECT_EQ(run.err, "");
    const auto state = json(read("state.json"));
    EXPECT_EQ(state["step"], 60);
    EXPECT_EQ(state["output"][0], "hello");
    EXPECT_EQ(state["items"][0]["name"], "Box");
    EXPECT_NEAR(state["items"][0]["position"][1].get<double>(), 5 + 98.1 / 3600 * 60 * 61 / 2, 1e-9);
    EXPECT_EQ(json(jet("--json play game --physics falling --steps 60").out), state) << "--json prints the same";
}

TEST_F(PlayCommandTest, PlayingTwiceGivesTheSameHash)
{
    writeGame();
    write("keys.json",
          R"({ "events": [ { "step": 7, "key": "D", "down": true }, { "step": 3, "key": "A", "down": true } ] })");
    for (const char* name : {"a", "b"})
        ASSERT_EQ(
            jet("play game --physics falling --steps 150 --input keys.json --record " + std::string(name) + ".json")
                .code,
            0);
    EXPECT_EQ(read("a.json"), read("b.json"));
    const auto record = json(read("a.json"));
    EXPECT_EQ(record["hashes"].size(), 2u);
    EXPECT_EQ(record["events"][0]["key"], "A");
    // What was recorded plays again.
    EXPECT_EQ(jet("play game --physics falling --steps 150 --input a.json --record c.json").code, 0);
    EXPECT_EQ(json(read("c.json"))["hash"], record["hash"]);
}

TEST_F(PlayCommandTest, KeysReachTheScripts)
{
    writeGame();
    write("keys.json", R"({ "events": [ { "step": 2, "key": "D", "down": true } ] })");
    EXPECT_THAT(jet("play game --physics falling --input keys.json").out, HasSubstr("key D\n"));
}

TEST_F(PlayCommandTest, AnotherSceneByNameByNumberAndByScript)
{
    writeGame("go Two");
    EXPECT_THAT(jet("play game --physics falling --scene Two").out, HasSubstr("played 'Two'"));
    EXPECT_THAT(jet("play game --physics falling --scene 1").out, HasSubstr("played 'Two'"));
    EXPECT_THAT(jet("play game --physics falling --steps 20").out, HasSubstr("played 'Two'"));
    const Outcome run = jet("play game --physics falling --scene Three");
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(run.err, "game/project.jet: error: there is no scene 'Three'; the project has 'One', 'Two'\n");
    writeGame("go Nowhere");
    const Outcome lost = jet("play game --physics falling --steps 20");
    EXPECT_EQ(lost.code, 1);
    EXPECT_THAT(lost.err, HasSubstr("a script went to the scene 'Nowhere'"));
}

TEST_F(PlayCommandTest, AScriptErrorNamesScriptAndLineAndTheGameGoesOn)
{
    writeGame("print a\nfail x is not defined");
    const Outcome run = jet("play game --physics falling --steps 3");
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.err, "Script:2: error: x is not defined\n");
}

TEST_F(PlayCommandTest, APluginStandsForItsEngine)
{
    writeGame();
    const Outcome run = jet("play game --physics org.jet.test.good --steps 3");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(json(jet("--json play game --physics org.jet.test.good --steps 3").out),
              json(jet("--json play game --physics falling --steps 3").out));
}

TEST_F(PlayCommandTest, WithoutPhysicsItSaysWhatIsMissing)
{
    writeGame();
    const Outcome run = jet("play game --physics quantum");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("error: the scene cannot be played: No installed plugin provides the physics engine "
                                   "'quantum'; install one"));
    EXPECT_EQ(lines(run.err), 1u);
    plugins().link("org.jet.test.throws-on-load");
    const Outcome broken = jet("play game --physics licensed");
    EXPECT_EQ(broken.code, 1);
    EXPECT_THAT(broken.err, HasSubstr("no licence found"));
    EXPECT_EQ(lines(broken.err), 1u) << broken.err;
}

TEST_F(PlayCommandTest, AnEngineThatBreaksMidwayIsOneMessage)
{
    writeGame("step-throw 7");
    const Outcome run = jet("play game --physics falling --steps 20 --state state.json");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("error: the plugin Good (org.jet.test.good 1.2.3) was switched off: "
                                   "ScriptRuntime::dispatch failed: the script engine broke"));
    EXPECT_EQ(lines(run.err), 1u) << run.err;
    EXPECT_FALSE(exists("state.json"));
}

class BrokenCallbackTest : public PlayCommandTest, public testing::WithParamInterface<const char*> {};

TEST_P(BrokenCallbackTest, EndsThePlayWithAMessageNamingThePlugin)
{
    plugins().link("org.jet.test.throws-inside");
    writeGame();
    write("game/one.scene",
          "<scene version=\"1\"><item type=\"body\" id=\"1\" name=\"Box\"><path>M 0 0 L 10 0 L 10 10 Z</path>"
          "<effect type=\"fragile\"/></item><item type=\"fragile\" id=\"2\" name=\"F\"/>"
          "<item type=\"script\" id=\"3\" name=\"S\"/></scene>");
    const Outcome run = plain("--plugins test.jetset --plugin-path '" + plugins().path().string() +
                                  "' --without org.jet.test.good play game --steps 20",
                              std::string("JET_TEST_THROW='") + GetParam() + "'");
    EXPECT_EQ(run.code, 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr("Throws inside (org.jet.test.throws-inside 1.0.0)"));
    EXPECT_THAT(run.err, HasSubstr(std::string(GetParam()) + " failed: oops"));
}

INSTANTIATE_TEST_SUITE_P(Play, BrokenCallbackTest,
                         testing::Values("Effect::properties", "Effect::buildBody", "ItemType::properties",
                                         "ItemType::build", "PhysicsEngine::createWorld", "PhysicsWorld::step",
                                         "ScriptEngine::createRuntime", "ScriptRuntime::run", "ScriptRuntime::dispatch",
                                         "ScriptRuntime::listensTo"));

TEST_F(PlayCommandTest, WrongInputFilesAreToldBeforePlaying)
{
    writeGame();
    for (const auto& [content, message] : std::map<std::string, std::string>{
             {"{\n\"events\": [ }", "keys.json:2:13: error: the recorded input is not valid JSON"},
             {"[]", "keys.json: error: recorded input: it must be {"},
             {R"({"events": [{"key": "D", "down": true}]})", "event number 1 needs \"step\""},
             {R"({"events": [{"step": -1, "key": "D", "down": true}]})", "needs \"step\""},
             {R"({"events": [{"step": 1, "down": true}]})", "needs \"key\""},
             {R"({"events": [{"step": 1, "key": "D", "down": 1}]})", "needs \"down\""},
             {"{\"events\": [\n  7]}", "keys.json:2:3: error: recorded input: event number 1 must be an object"},
             {"{\"events\": [{\"step\": 1, \"letGo\": true},\n  {\"step\": 1, \"grab\": [1]}]}",
              "keys.json:2:15: error: recorded input: event number 2 needs \"grab\": [x, y]"},
             {R"({"events": [{"step": 1, "drag": "here"}]})", "needs \"drag\": [x, y]"},
             {R"({"events": [{"step": 1, "grab": [1, 2], "reach": -1}]})", "needs a \"reach\" from 0 on"},
             {R"({"events": [{"step": 1, "letGo": false}]})", "needs \"letGo\": true"},
             {R"({"events": [{"step": 1, "grab": [1, 2], "letGo": true}]})", "has more than one of"}}) {
        write("keys.json", content);
        const Outcome run = jet("play game --physics falling --input keys.json");
        EXPECT_EQ(run.code, 1) << content;
        EXPECT_THAT(run.err, HasSubstr(message));
        EXPECT_THAT(run.out, testing::Not(HasSubstr("played")));
    }
    EXPECT_EQ(jet("play game --physics falling --input nowhere.json").code, 1);
}

TEST_F(PlayCommandTest, AReadOnlyTargetIsLeftAlone)
{
    writeGame();
    write("state.json", "old");
    std::filesystem::permissions(home() / "state.json", std::filesystem::perms::owner_read);
    const Outcome run = jet("play game --physics falling --steps 1 --state state.json");
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(
        run.err,
        "state.json: error: cannot be written: Permission denied; check the permissions of the file and its folder\n");
    EXPECT_EQ(read("state.json"), "old");
    EXPECT_THAT(jet("play game --physics falling --steps 1 --state /dev/full").err,
                HasSubstr("No space left on device; free some space"));
}

TEST_F(PlayCommandTest, ASnapshotNobodyCanMakeIsToldBeforePlaying)
{
    writeGame();
    const Outcome run = jet("play game --physics falling --snapshot picture.xyz --state state.json");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("picture.xyz: error: No installed plugin provides the exporter for .xyz files"));
    EXPECT_FALSE(exists("state.json"));
    EXPECT_EQ(jet("play game --physics falling --snapshot picture.count").code, 0);
    EXPECT_EQ(read("picture.count"), "2\n");
}

TEST_F(PlayCommandTest, AnEngineWithoutJointsIsToldOnceThatNothingCanBeDragged)
{
    writeGame();
    write("hand.json", R"({ "events": [ { "step": 1, "grab": [5, 5], "reach": 100 }, { "step": 2, "drag": [9, 9] },
                                        { "step": 3, "letGo": true }, { "step": 4, "grab": [1e6, 0] } ] })");
    const Outcome run = jet("play game --physics falling --steps 10 --input hand.json --record record.json");
    EXPECT_EQ(run.code, 0);
    EXPECT_THAT(run.err, HasSubstr("warning: bodies cannot be dragged: "));
    EXPECT_THAT(run.err,
                HasSubstr("hand.json:1:15: warning: recorded input: nothing that can be dragged is here at step 1"));
    EXPECT_EQ(lines(run.err), 3u) << run.err;
    const auto events = json(read("record.json"))["events"];
    EXPECT_EQ(events, json(read("hand.json"))["events"]) << events;
}

/// With the plugins that are shipped.
class PlayPictureTest : public CliTest {
protected:
    /// A box that hangs on a rope; `settings` and `script` as in the scene's file.
    void writeScene(const std::string& settings, const std::string& script = "")
    {
        write("game/project.jet", "<jet-project version=\"1\" name=\"Game\">\n<filter name=\"F\"><scene name=\"One\" "
                                  "file=\"one.scene\"/></filter>\n</jet-project>\n");
        write(
            "game/one.scene",
            "<scene version=\"1\">\n<settings>" + settings +
                "</settings>\n<item type=\"body\" id=\"1\" name=\"Box\"><path>M 40 40 L 60 40 L 60 60 L 40 60 Z</path>"
                "<effect type=\"in-path-rigid-body\"/></item>\n<item type=\"joint\" id=\"2\" name=\"Rope\"><path>M 50 "
                "10 "
                "L 50 50</path><property id=\"kind\">rope</property></item>\n<item type=\"script\" id=\"3\" "
                "name=\"Script\"><property id=\"code\">" +
                script + "</property></item>\n</scene>\n");
    }
    static std::string page(int width, int height)
    {
        return "<property id=\"page-height\">" + std::to_string(height) + "</property><property id=\"page-width\">" +
               std::to_string(width) + "</property>";
    }
    std::string picture(const std::string& options)
    {
        const Outcome run = plain("play game --steps 20 --snapshot a.png " + options);
        EXPECT_EQ(run.code, 0) << run.err;
        return read("a.png");
    }
    /// Of the PNG, from its header.
    std::pair<int, int> size(const std::string& options)
    {
        const std::string png = picture(options);
        const auto number = [&](std::size_t at) {
            int value = 0;
            for (std::size_t i = 0; i < 4; ++i) value = value * 256 + static_cast<unsigned char>(png.at(at + i));
            return value;
        };
        return {number(16), number(20)};
    }
};

TEST_F(PlayPictureTest, ShowsThePageAtItsSizeUnlessAViewIsAskedFor)
{
    using Size = std::pair<int, int>;
    writeScene(page(320, 180));
    EXPECT_EQ(size(""), Size(320, 180));
    EXPECT_EQ(size("--width 640"), Size(640, 720));
    EXPECT_EQ(size("--width 100 --height 50"), Size(100, 50));
    EXPECT_EQ(json(plain("--json play game --steps 1").out)["view"]["size"], nlohmann::json::array({1280.0, 720.0}))
        << "scripts see what they saw";
    writeScene("");
    EXPECT_EQ(size(""), Size(1280, 720)) << "no page";
    writeScene(page(320, 180), "CC.getScene(\"One\").GC.swingSimulationGP.setViewScale(2);");
    EXPECT_EQ(size(""), Size(1280, 720)) << "the game moved its camera: what it shows is the view";
    writeScene(page(9000000, 9000000));
    EXPECT_EQ(size(""), Size(1280, 720)) << "no picture is as large";
}

TEST_F(PlayPictureTest, AHandDragsTheSameOnAnyThreads)
{
    writeScene("");
    write("hand.json", R"({ "events": [
        { "step": 10, "grab": [70, 50], "reach": 15 }, { "step": 11, "drag": [120, 40] }, { "step": 30, "drag": [130, 30] },
        { "step": 50, "letGo": true }, { "step": 55, "grab": [-900, 0] } ] })");
    std::set<std::string> hashes;
    for (const char* threads : {"1", "2", "4"}) {
        const Outcome run = plain("--json play game --steps 60 --input hand.json --threads " + std::string(threads));
        EXPECT_EQ(run.code, 0) << run.err;
        EXPECT_EQ(run.err, "hand.json:3:40: warning: recorded input: nothing that can be dragged is here at step 55\n");
        hashes.insert(json(run.out)["hash"]);
        EXPECT_GT(json(run.out)["items"][0]["position"][0].get<double>(), 55);
    }
    hashes.insert(json(plain("--json play game --steps 60").out)["hash"]);
    EXPECT_EQ(hashes.size(), 2u) << "one with, and one without the hand";
}

TEST_F(PlayPictureTest, ShowsWhatIsAskedForOfThePhysics)
{
    writeScene(page(320, 180));
    const std::string plainly = picture("");
    std::set<std::string> all{plainly};
    for (const char* marks : {"boxes", "centres", "joints", "boxes,centres", "all"})
        all.insert(picture("--debug " + std::string(marks)));
    EXPECT_EQ(all.size(), 6u) << "each another";
    EXPECT_EQ(picture("--debug stress"), plainly) << "there is no soft body";
    const Outcome odd = plain("play game --snapshot a.png --debug boxes,springs");
    EXPECT_EQ(odd.code, 2);
    EXPECT_THAT(odd.err,
                HasSubstr("'springs' is nothing that can be shown; there are contacts, islands, stress, boxes, "
                          "centres, joints, and all"));
    EXPECT_EQ(plain("play game --debug boxes").code, 2) << "of no use without a picture";
}

TEST_F(PlayCommandTest, ATimeOfAStepThatIsNoneIsRefusedInOneLine)
{
    writeGame();
    for (const char* odd : {"nan", "inf", "-inf", "-0", "1e400", "1e-320", "''", "501", "0.01s"}) {
        const Outcome run = jet("play game --physics falling --dt " + std::string(odd));
        EXPECT_EQ(run.code, 2) << odd;
        EXPECT_THAT(run.err, HasSubstr("is no time of a step; give seconds from 0.00001 to 1\n")) << odd;
        EXPECT_LT(run.err.size(), 200u) << run.err;
    }
    EXPECT_EQ(jet("play game --physics falling --steps 1 --dt 0.001").code, 0);
}

TEST_F(PlayCommandTest, ASeedIsAWholeNumber)
{
    writeGame();
    for (const char* odd : {"-1", "nan", "1.5", "''", "18446744073709551616", "99999999999999999999999"}) {
        const Outcome run = jet("play game --physics falling --steps 1 --seed " + std::string(odd));
        EXPECT_EQ(run.code, 2) << odd;
        EXPECT_THAT(run.err, HasSubstr("is no seed; give a whole number")) << odd;
    }
    EXPECT_EQ(jet("play game --physics falling --steps 1 --seed 18446744073709551615").code, 0);
}

/// As of a variable in a script that is not set.
TEST_F(PlayCommandTest, EmptyValuesAreRefused)
{
    writeGame();
    for (const char* option : {"--scene", "--physics", "--input", "--state", "--record", "--snapshot"}) {
        const Outcome run = jet("play game --physics falling --steps 1 " + std::string(option) + " ''");
        EXPECT_EQ(run.code, 2) << option;
        EXPECT_THAT(run.err, HasSubstr(std::string(option) + ": is empty; give it a value")) << option;
    }
    const auto before = files();
    for (const char* command : {"convert game ''", "project new ''", "plugins explain ''", "play ''"}) {
        const Outcome run = jet(command);
        EXPECT_EQ(run.code, 2) << command;
        EXPECT_THAT(run.err, HasSubstr("is empty")) << command;
    }
    EXPECT_EQ(files(), before);
}

/// Instead of after an hour of playing.
TEST_F(PlayCommandTest, AFileThatCannotBeWrittenIsToldBeforePlaying)
{
    writeGame();
    for (const char* option : {"--state", "--record", "--snapshot"}) {
        const std::string name = std::string(option) == "--snapshot" ? "picture.count" : "file.json";
        const Outcome run =
            jet("play game --physics falling --steps 1000000000 " + std::string(option) + " none/" + name);
        EXPECT_EQ(run.code, 1) << option;
        EXPECT_EQ(run.err, "none/" + name +
                               ": error: cannot be written: there is no folder 'none'; make it or choose another\n");
        EXPECT_EQ(run.out, "") << option;
    }
    EXPECT_EQ(jet("play game --physics falling --steps 1000000000 --state game").err,
              "game: error: is a folder; name a file to write\n");
    EXPECT_THAT(jet("play game --physics falling --steps 1000000000 --snapshot picture").err,
                HasSubstr("picture: error: the name of a picture tells its format"));
}

TEST_F(PlayCommandTest, AnEngineThatASceneNamesAndNobodyHasIsToldWithItsLine)
{
    writeGame();
    write("game/two.scene", "<scene version=\"1\">\n  <settings>\n    <property id=\"background\">#ffffff</property>\n"
                            "    <property id=\"physics\">unknown-engine</property>\n  </settings>\n</scene>\n");
    const Outcome run = jet("play game --scene Two --steps 1");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err,
                HasSubstr("game/two.scene:4:6: error: the scene cannot be played: No installed plugin provides "
                          "the physics engine 'unknown-engine'"));
    EXPECT_THAT(run.err, HasSubstr("Installed: falling"));
    EXPECT_EQ(jet("play game --scene Two --steps 1 --physics falling").code, 0);
    const Outcome other = jet("play game --scene Two --steps 1 --physics also-unknown");
    EXPECT_THAT(other.err, testing::StartsWith("error: the scene cannot be played")) << "the line is not to blame";
}

}  // namespace
}  // namespace jet::test
