// Checking and repairing projects: each wrong thing is told with its place, and mended without touching the rest.
#include "host/projects/project_check.hpp"

#include "project_files.hpp"

#include <test_paths.hpp>

#include <sys/wait.h>

namespace jet::host {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A wrong scene, what is told of it, and the scene it becomes.
struct Wrong {
    const char* name;
    std::string items, told, repaired;
};
std::ostream& operator<<(std::ostream& out, const Wrong& wrong) { return out << wrong.name; }

class ProjectCheckTest : public ProjectFilesTest {
protected:
    CheckReport check(bool repair = false)
    {
        CheckOptions options;
        options.repair = repair;
        options.schemas = fs::path(JET_SOURCE_DIR) / "sdk/share";
        return checkProjectFiles(folder / "game", events, catalog, options).orThrow();
    }
    CheckReport repair() { return check(true); }
    std::vector<std::string> texts(const CheckReport& report) const
    {
        std::vector<std::string> all;
        for (const Finding& finding : report.findings) {
            std::string text = Error(finding.problem + "; " + finding.repair, finding.where).text();
            const std::string base = (folder / "game/").string();
            for (auto at = text.find(base); at != std::string::npos; at = text.find(base)) text.erase(at, base.size());
            all.push_back(text);
        }
        return all;
    }
    /// As JET writes it.
    std::string scene(const std::string& items)
    {
        std::vector<FormatNote> notes;
        return writeSceneText(
            *readSceneText("<scene version=\"1\">" + items + "</scene>", "wanted", events, catalog, notes).orThrow());
    }
};

class WrongSceneCheckTest : public ProjectCheckTest, public testing::WithParamInterface<Wrong> {};

TEST_P(WrongSceneCheckTest, IsToldWithItsPlaceAndMended)
{
    writeGame(GetParam().items);
    const auto before = files("game");
    const CheckReport found = check();
    EXPECT_FALSE(found.isFine());
    ASSERT_THAT(texts(found), SizeIs(1));
    EXPECT_THAT(texts(found)[0], HasSubstr(GetParam().told));
    EXPECT_THAT(texts(found)[0], testing::StartsWith("scenes/One.scene:")) << "with file and line";
    EXPECT_GT(found.findings[0].where.line, 0);
    EXPECT_EQ(files("game"), before) << "a check changes nothing";

    const CheckReport mended = repair();
    EXPECT_TRUE(mended.isFine()) << mended.problem.text();
    EXPECT_EQ(read("game/scenes/One.scene"), scene(GetParam().repaired));
    ASSERT_THAT(findBackups(folder / "game"), SizeIs(1));
    EXPECT_EQ(read(findBackups(folder / "game")[0].folder / "scenes/One.scene"), before.at("scenes/One.scene"));
    EXPECT_THAT(check().findings, IsEmpty()) << "and is fine now";
}

const std::string kShape = "<item type=\"shape\" id=\"1\" name=\"S\"><path>M 0 0 L 5 5</path></item>\n";

std::vector<Wrong> wrongScenes()
{
    const auto item = [](const std::string& attributes, const std::string& inside = "") {
        return "<item " + attributes + ">" + inside + "</item>\n";
    };
    const auto body = [&](const std::string& inside) { return item("type=\"body\" id=\"1\" name=\"B\"", inside); };
    const std::string rope = "type=\"rope\" id=\"9\" name=\"R\"";
    return {
        {"IdTwice", kShape + kShape, ":3:2: error: there is another item with the id 1; it gets the id 2",
         kShape + item("type=\"shape\" id=\"2\" name=\"S\"", "<path>M 0 0 L 5 5</path>")},
        {"NoId", kShape + item("type=\"group\" name=\"G\""), "an item has no id; it gets the id 2",
         kShape + item("type=\"group\" id=\"2\" name=\"G\"")},
        {"IdTooLarge", item("type=\"group\" id=\"9007199254740992\" name=\"G\""), "is none; it gets the id 1",
         item("type=\"group\" id=\"1\" name=\"G\"")},
        {"NoType", item("id=\"1\" name=\"S\"", "<path>M 0 0 L 5 5</path>"), "an item has no type; it becomes a shape",
         kShape},
        {"NoName", item("type=\"group\" id=\"1\""), "an item has no name", item("type=\"group\" id=\"1\" name=\"\"")},
        {"Flag", item("type=\"group\" id=\"1\" name=\"\" visible=\"yes\""), "visible='yes' is neither true nor false",
         item("type=\"group\" id=\"1\" name=\"\"")},
        {"Attribute", item("type=\"group\" id=\"1\" name=\"\" color=\"red\""), "<item> has no attribute 'color'",
         item("type=\"group\" id=\"1\" name=\"\"")},
        {"Element", kShape + "<circle r=\"1\"/>", "a scene holds no <circle>; it is left out", kShape},
        {"PathNotFinite", item("type=\"shape\" id=\"1\" name=\"S\"", "<path>M 0 0 L nan -inf</path>"),
         "the path of 'S': a coordinate is not finite; it becomes 0",
         item("type=\"shape\" id=\"1\" name=\"S\"", "<path>M 0 0 L 0 0</path>")},
        {"PathUnreadable", item("type=\"shape\" id=\"1\" name=\"S\"", "<path>a round one</path>"), "it is left out",
         item("type=\"shape\" id=\"1\" name=\"S\"")},
        {"PathTwice", item("type=\"shape\" id=\"1\" name=\"S\"", "<path>M 0 0 L 5 5</path><path>M 1 1 L 2 2</path>"),
         "<path> stands here twice; the first one stays", kShape},
        {"NotFinite", body("<property id=\"omega\">nan</property>"), "the property 'omega' is 'nan'", body("")},
        {"OutOfRange", item(rope, "<property id=\"length\">-5</property>"), "it becomes 0",
         item(rope, "<property id=\"length\">0</property>")},
        {"WrongKind", body("<property id=\"fixed\">maybe</property>"), "it gets its default", body("")},
        {"PropertyTwice", body("<property id=\"omega\">1</property><property id=\"omega\">2</property>"),
         "the property 'omega' stands here twice", body("<property id=\"omega\">1</property>")},
        {"Dangling", item(rope, "<property id=\"target\">77</property>"),
         "the property 'target' refers to the item 77, which is not there", item(rope)},
        {"EffectWithoutType", body("<effect/>"), "an effect has no type; it is left out", body("")},
        {"EffectValue", body("<effect type=\"tint\"><property id=\"width\">1e9</property></effect>"),
         "the property 'width' is '1e9'", body("<effect type=\"tint\"><property id=\"width\">100</property></effect>")},
        {"Setting", "<settings><property id=\"time-step\">0</property></settings>", "it becomes 0.00001",
         "<settings><property id=\"time-step\">1e-05</property></settings>"},
    };
}

INSTANTIATE_TEST_SUITE_P(Scenes, WrongSceneCheckTest, testing::ValuesIn(wrongScenes()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_F(ProjectCheckTest, AFineProjectKeepsItsBytesAndGetsNoBackup)
{
    writeGame("<!-- mine -->\n" + kShape);
    const auto before = files("game");
    const CheckReport report = repair();
    EXPECT_TRUE(report.isFine());
    EXPECT_THAT(report.findings, IsEmpty());
    EXPECT_THAT(report.written, IsEmpty());
    EXPECT_EQ(files("game"), before);
}

TEST_F(ProjectCheckTest, WhatAbsentPluginsWroteIsNeitherToldNorTouched)
{
    const std::string cloud = "<item type=\"acme-cloud\" id=\"2\" name=\"C\"><property id=\"rain\">nan</property>"
                              "<effect type=\"acme-glow\"><property id=\"x\">inf</property></effect></item>\n";
    writeGame(kShape + kShape + cloud);
    const CheckReport report = repair();
    ASSERT_THAT(texts(report), SizeIs(1));
    EXPECT_THAT(texts(report)[0], HasSubstr("it gets the id 3"));
    EXPECT_THAT(read("game/scenes/One.scene"), HasSubstr("<property id=\"rain\">nan</property>"));
    EXPECT_THAT(read("game/scenes/One.scene"), HasSubstr("<property id=\"x\">inf</property>"));
}

TEST_F(ProjectCheckTest, AMissingSceneComesFromTheNewestBackupElseItsEntryGoes)
{
    writeGame(kShape);
    backUpProject(folder / "game/project.jet").orThrow();
    const std::string text = read("game/scenes/One.scene");
    fs::remove(folder / "game/scenes/One.scene");
    EXPECT_THAT(texts(check()),
                ElementsAre(HasSubstr("project.jet:3:2: error: the scene file 'scenes/One.scene' is missing; "
                                      "the newest backup of it is put there")));
    EXPECT_TRUE(repair().isFine());
    EXPECT_EQ(read("game/scenes/One.scene"), text);
    fs::remove(folder / "game/scenes/One.scene");
    fs::remove_all(folder / "game/.jet-backups");
    EXPECT_THAT(texts(check()), ElementsAre(HasSubstr("the entry is left out")));
    const CheckReport report = repair();
    EXPECT_TRUE(report.isFine());
    EXPECT_THAT(report.project->scenes(), IsEmpty());
}

TEST_F(ProjectCheckTest, ScenesThatAreNotListedAreAdded)
{
    writeGame(kShape);
    write("game/scenes/Lost.scene", "<scene version=\"1\"/>\n");
    write("game/scenes/sub/One.scene", "<scene version=\"1\"/>\n");
    write("game/scenes/broken.scene", "<scene");
    const CheckReport found = check();
    EXPECT_TRUE(found.isFine()) << "it opens as it is";
    EXPECT_THAT(texts(found),
                ElementsAre(HasSubstr("scenes/Lost.scene: error: the project does not list this scene; it is "
                                      "added as 'Lost'"),
                            HasSubstr("scenes/broken.scene: error: the project does not list this scene; "),
                            HasSubstr("it is added as 'One 2'")));
    const CheckReport report = repair();
    ASSERT_TRUE(report.project);
    EXPECT_NE(report.project->scene("Lost"), nullptr);
    EXPECT_NE(report.project->scene("One 2"), nullptr);
    EXPECT_THAT(report.project->scenes(), SizeIs(3));
    write("game/other.jet", "<jet-project/>");
    write("game/scenes/Other.scene", "<scene version=\"1\"/>\n");
    EXPECT_THAT(check().findings, IsEmpty()) << "it may be the other project's";
}

TEST_F(ProjectCheckTest, AStartSceneThatIsMissingIsNamedAndLeftOut)
{
    const std::string rest =
        "<filter name=\"F\">\n    <scene name=\"A\" file=\"a.scene\"/>\n  </filter>\n</jet-project>\n";
    write("game/project.jet", "<jet-project version=\"1\" name=\"G\" start=\"A\">" + rest);
    write("game/a.scene", "<scene version=\"1\"/>\n");
    EXPECT_THAT(texts(check()), IsEmpty());
    write("game/project.jet", "<jet-project version=\"1\" name=\"G\" start=\"Lost\">" + rest);
    const CheckReport found = check();
    EXPECT_TRUE(found.isFine()) << "it plays all the same";
    EXPECT_THAT(texts(found), ElementsAre(HasSubstr("project.jet:1:2: error: there is no scene 'Lost' to start with")));
    EXPECT_TRUE(repair().isFine());
    EXPECT_THAT(texts(check()), IsEmpty());
}

TEST_F(ProjectCheckTest, EntriesThatMeetAreParted)
{
    write("game/project.jet", "<jet-project version=\"1\" name=\"G\"><filter name=\"F\">\n"
                              "<scene name=\"A\" file=\"a.scene\"/>\n<scene name=\"A\" file=\"b.scene\"/>\n"
                              "<scene name=\"B\" file=\"./a.scene\"/>\n</filter></jet-project>\n");
    write("game/a.scene", "<scene version=\"1\"/>\n"), write("game/b.scene", "<scene version=\"1\"/>\n");
    EXPECT_THAT(texts(check()),
                ElementsAre(HasSubstr("project.jet:3:2: error: there is another scene called 'A'; it is called 'A 2'"),
                            HasSubstr("project.jet:4:2: error: another scene has the file 'a.scene' already")));
    const CheckReport report = repair();
    ASSERT_TRUE(report.isFine());
    EXPECT_THAT(report.project->scenes(), SizeIs(2));
    EXPECT_NE(report.project->scene("A 2"), nullptr);
}

TEST_F(ProjectCheckTest, FilesThatAreNoXmlComeFromTheBackup)
{
    writeGame(kShape);
    const auto good = files("game");
    backUpProject(folder / "game/project.jet").orThrow();
    write("game/project.jet", "<jet-project version=\"1\" name=\"G\"><filter");
    write("game/scenes/One.scene", good.at("scenes/One.scene").substr(0, 40));
    EXPECT_FALSE(check().isFine());
    const CheckReport report = repair();
    EXPECT_TRUE(report.isFine());
    EXPECT_THAT(texts(report),
                ElementsAre(HasSubstr("this is not well-formed XML"), HasSubstr("this is not well-formed XML")));
    EXPECT_EQ(read("game/project.jet"), good.at("project.jet"));
    EXPECT_EQ(read("game/scenes/One.scene"), good.at("scenes/One.scene"));
    fs::remove(folder / "game/project.jet");
    EXPECT_THAT(texts(check()),
                Contains(HasSubstr("the project file is missing; the newest backup is put in its place")));
    EXPECT_TRUE(repair().isFine());
}

TEST_F(ProjectCheckTest, WhatCannotBeMendedIsToldAndNothingIsWritten)
{
    writeGame(kShape + kShape);
    write("game/scenes/One.scene", read("game/scenes/One.scene") + "<scene version=\"1\"/>");
    const auto before = files("game");
    const CheckReport report = repair();
    EXPECT_FALSE(report.isFine());
    EXPECT_THAT(report.written, IsEmpty());
    EXPECT_EQ(files("game"), before);
    EXPECT_THAT(texts(report), Contains(HasSubstr("scenes/One.scene:")));
    writeGame(kShape);
    write("game/project.jet", "<jet-project version=\"9\" name=\"G\"/>");
    EXPECT_THAT(texts(repair()), Contains(HasSubstr("has format version 9")));
}

TEST_F(ProjectCheckTest, MaterialsAndGravityNoEngineComputesWithAreTold)
{
    writeGame(
        "<materials><material name=\"ice\"/><pair a=\"ice\" b=\"ice\" friction=\"0\" restitution=\"2\"/></materials>");
    CheckReport found = check();
    EXPECT_FALSE(found.isFine());
    EXPECT_THAT(found.problem.text(), HasSubstr("One.scene:"));
    EXPECT_THAT(found.problem.text(),
                HasSubstr("the materials 'ice' and 'ice': restitution is 2; it must be from 0 to"));
    writeGame("<settings><property id=\"gravity\">0 1e40</property></settings>");
    found = repair();
    EXPECT_TRUE(found.isFine()) << found.problem.text();
    EXPECT_THAT(texts(found), ElementsAre(HasSubstr("the property 'gravity' is '0 1e40'")));
}

TEST_F(ProjectCheckTest, AnEngineThatNobodyHasIsAnErrorWithItsPlace)
{
    writeGame("<settings>\n<property id=\"physics\">quantum</property></settings>");
    const CheckReport found = check();
    EXPECT_FALSE(found.isFine());
    ASSERT_THAT(texts(found), SizeIs(1));
    EXPECT_THAT(texts(found)[0], HasSubstr("One.scene:"));
    EXPECT_THAT(texts(found)[0], HasSubstr("the scene cannot be played: "));
    EXPECT_THAT(texts(found)[0], HasSubstr("quantum"));
}

TEST_F(ProjectCheckTest, WhenAFileCannotBeWrittenTheOthersArePutBack)
{
    write("game/project.jet", "<jet-project version=\"1\" name=\"G\"><filter name=\"F\"><scene name=\"A\" "
                              "file=\"a.scene\"/><scene name=\"B\" file=\"b.scene\"/></filter></jet-project>\n");
    const std::string wrong = "<scene version=\"1\">" + kShape + kShape + "</scene>\n";
    write("game/a.scene", wrong), write("game/b.scene", wrong);
    // The name of the temporary file is taken by a folder.
    const fs::path obstacle = folder / "game" / (".b.scene." + std::to_string(::getpid()) + ".part");
    fs::create_directory(obstacle);
    CheckOptions options;
    options.repair = true;
    EXPECT_FALSE(checkProjectFiles(folder / "game", events, catalog, options));
    EXPECT_EQ(read("game/a.scene"), wrong);
    EXPECT_EQ(read("game/b.scene"), wrong);
    fs::remove(obstacle);
    EXPECT_TRUE(repair().isFine());
}

TEST_F(ProjectCheckTest, WhatAProcessThatEndedLeftIsRemoved)
{
    writeGame(kShape);
    const pid_t gone = ::fork();
    if (gone == 0) ::_exit(0);
    ::waitpid(gone, nullptr, 0);
    const std::string left = "game/scenes/.One.scene." + std::to_string(gone) + ".part";
    const std::string alive = "game/scenes/.One.scene." + std::to_string(::getppid()) + ".part";
    write(left, "half"), write(alive, "being written");
    const CheckReport found = check();
    EXPECT_TRUE(found.isFine());
    EXPECT_THAT(texts(found), ElementsAre(HasSubstr("a process that ended left this behind")));
    EXPECT_TRUE(repair().isFine());
    EXPECT_FALSE(fs::exists(folder / left));
    EXPECT_TRUE(fs::exists(folder / alive));
}

TEST_F(ProjectCheckTest, AnOlderVersionOfTheFormatIsNothingToMend)
{
    fs::copy(fs::path(JET_SOURCE_DIR) / "tests/fixtures/formats/0", folder / "game", fs::copy_options::recursive);
    const auto before = files("game");
    const CheckReport report = repair();
    EXPECT_TRUE(report.isFine());
    EXPECT_THAT(texts(report), IsEmpty());
    EXPECT_EQ(files("game"), before);
}

TEST_F(ProjectCheckTest, DeepAndHostileFilesAreRefusedWithASentence)
{
    std::string deep;
    for (int i = 0; i < 100'000; ++i) deep += "<x>";
    writeGame(deep);
    EXPECT_FALSE(repair().isFine());
    for (int i = 0; i < 100'000; ++i) deep += "</x>";
    writeGame(deep);
    EXPECT_THAT(texts(repair()), Contains(HasSubstr("nested more than 1100 deep")));
    std::string laughs = "<!DOCTYPE scene [<!ENTITY a0 \"ha\">";
    for (int i = 1; i < 40; ++i) {
        const std::string last = "&a" + std::to_string(i - 1) + ";";
        laughs += "<!ENTITY a" + std::to_string(i) + " \"" + last + last + "\">";
    }
    write("game/scenes/One.scene",
          laughs + "]><scene version=\"1\"><item type=\"group\" id=\"1\" name=\"&a39;\"/></scene>");
    EXPECT_TRUE(check().isFine()) << "entities are not expanded: it is a name";
}

}  // namespace
}  // namespace jet::host
