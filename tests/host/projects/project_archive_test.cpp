// Projects in one file: what is unpacked is what was packed, and nothing is done by halves.
#include "host/projects/project_archive.hpp"

#include "host/archive/archive.hpp"
#include "project_files.hpp"

#include <jet/format.hpp>

namespace jet::host {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ProjectArchiveTest : public ProjectFilesTest {
protected:
    ProjectArchiveTest()
    {
        writeGame(
            "<!-- by hand -->\n<item type=\"acme-cloud\" id=\"1\" name=\"C\"><property id=\"x\">1</property></item>\n"
            "<item type=\"image\" id=\"2\" name=\"I\"><property id=\"file\">assets/Größe 1.png</property></item>\n");
        write("game/assets/Größe 1.png", std::string("\x89PNG\0\r\n", 7));
        write("game/plugins/org.acme.cloud/cloud.so", "code");
        fs::permissions(folder / "game/plugins/org.acme.cloud/cloud.so", fs::perms::owner_all);
    }
    std::string pack()
    {
        const std::string bytes = packProject(*load()).orThrow().bytes;
        write("game.jetz", bytes);
        return bytes;
    }
    std::string refusal(const std::string& to = "copy")
    {
        const auto made = unpackProject(folder / "game.jetz", folder / to);
        return made ? "it was unpacked" : made.error().text();
    }
};

TEST_F(ProjectArchiveTest, WhatIsUnpackedIsWhatWasPackedByteForByte)
{
    const auto packed = packProject(*load()).orThrow();
    EXPECT_EQ(packed.files, 4u);
    EXPECT_THAT(packed.outside, IsEmpty());
    EXPECT_THAT(packed.missing, IsEmpty());
    write("game.jetz", packed.bytes);
    const auto project = unpackProject(folder / "game.jetz", folder / "copy").orThrow();
    EXPECT_EQ(project, folder / "copy/project.jet");
    EXPECT_EQ(files("copy"), files("game"));
    EXPECT_EQ(load("copy")->hash(), load()->hash());
    const auto permissions = fs::status(folder / "copy/plugins/org.acme.cloud/cloud.so").permissions();
    EXPECT_NE(permissions & fs::perms::owner_exec, fs::perms::none);
    EXPECT_EQ(fs::status(folder / "copy").permissions(), fs::status(folder / "game").permissions());
}

TEST_F(ProjectArchiveTest, EqualProjectsGiveEqualBytesWhateverTheTimesOfTheirFiles)
{
    const std::string bytes = pack();
    for (const auto& entry : fs::recursive_directory_iterator(folder / "game"))
        fs::last_write_time(entry, fs::file_time_type::clock::now() - std::chrono::hours(1000));
    EXPECT_EQ(pack(), bytes);
    unpackProject(folder / "game.jetz", folder / "copy").orThrow();
    EXPECT_EQ(packProject(*load("copy")).orThrow().bytes, bytes);
}

TEST_F(ProjectArchiveTest, BackupsLocksOtherProjectsAndPackedOnesStayOut)
{
    const std::string bytes = pack();
    write("game/.jet-backups/project/2031/project.jet", "old");
    write("game/.project.jet.lock", "1");
    write("game/other.jet", "another one");
    write("game/game.jetz", bytes);
    EXPECT_EQ(packProject(*load()).orThrow().bytes, bytes);
}

TEST_F(ProjectArchiveTest, FilesElsewhereAndMissingOnesAreNamed)
{
    write("picture.png", "x");
    const std::string absolute = (folder / "game/assets/Größe 1.png").string();
    writeGame("<item type=\"image\" id=\"1\" name=\"A\"><property id=\"file\">../picture.png</property></item>"
              "<item type=\"sound\" id=\"2\" name=\"B\"><property id=\"file\">gone.wav</property></item>"
              "<item type=\"image\" id=\"3\" name=\"C\"><property id=\"file\">../picture.png</property></item>"
              "<item type=\"image\" id=\"4\" name=\"D\"><property id=\"file\">" +
              absolute + "</property></item>");
    const auto packed = packProject(*load()).orThrow();
    EXPECT_THAT(packed.outside, ElementsAre(folder / "picture.png", absolute))
        << "an absolute path leads elsewhere too";
    EXPECT_THAT(packed.missing, ElementsAre(folder / "game/gone.wav"));
}

TEST_F(ProjectArchiveTest, LinksAreNotPacked)
{
    fs::create_symlink("/etc/passwd", folder / "game/assets/secret");
    const auto packed = packProject(*load());
    ASSERT_FALSE(packed);
    EXPECT_THAT(packed.error().text(), HasSubstr("assets/secret: error: is a symbolic link"));
}

TEST_F(ProjectArchiveTest, AFolderWithSomethingInItStaysAsItIs)
{
    pack();
    EXPECT_THAT(refusal("game"), HasSubstr("is not an empty folder; name one that is empty or does not exist yet"));
    write("file", "x");
    EXPECT_THAT(refusal("file"), HasSubstr("is not an empty folder"));
    fs::create_directory(folder / "empty");
    EXPECT_EQ(refusal("empty"), "it was unpacked");
    EXPECT_EQ(files("empty"), files("game"));
    EXPECT_EQ(refusal("deep/er/"), "it was unpacked");
}

TEST_F(ProjectArchiveTest, WhatIsNoPackedProjectIsRefusedAndLeavesNothing)
{
    write("game.jetz", "this is no zip");
    EXPECT_THAT(refusal(), HasSubstr("game.jetz: error: this is no packed project, or it is damaged"));
    const std::string bytes = pack();
    write("game.jetz", bytes.substr(0, bytes.size() / 2));
    EXPECT_THAT(refusal(), HasSubstr("or it is damaged"));
    write("game.jetz", writeZip({{"readme.txt", "x", false}}).orThrow());
    EXPECT_THAT(refusal(), HasSubstr("this file holds no project: project.jet is missing in it"));
    write("game.jetz", writeZip({{"project.jet", std::string(200U << 20, ' '), false}}).orThrow());
    EXPECT_THAT(refusal(), HasSubstr("unpacks to more than 200 times its size")) << "a zip bomb";
    EXPECT_THAT(files(""), testing::Not(testing::Contains(testing::Key(testing::StartsWith("copy")))));
    for (const auto& entry : fs::directory_iterator(folder))
        EXPECT_THAT(entry.path().filename().string(), testing::AnyOf("game", "game.jetz"));
    fs::remove(folder / "game.jetz");
    EXPECT_THAT(refusal(), HasSubstr("game.jetz: error: cannot be opened"));
}

TEST_F(ProjectArchiveTest, TheCopyOfACommandThatReadsGoesWithIt)
{
    pack();
    fs::path where;
    {
        const auto copy = UnpackedProject::make(folder / "game.jetz").orThrow();
        where = copy.folder();
        EXPECT_EQ(Project::load(where, events, catalog).orThrow()->hash(), load()->hash());
    }
    EXPECT_FALSE(fs::exists(where));
}

TEST_F(ProjectArchiveTest, APackedProjectIsNeverReadOrWrittenAsIfItWereOne)
{
    pack();
    EXPECT_THAT(Project::load(folder / "game.jetz", events, catalog).error().text(),
                HasSubstr("unpack it with 'jet project unpack'"));
    EXPECT_THAT(load()->saveAs(folder / "new.jetz").error().text(), HasSubstr("a packed project is not worked on"));
    EXPECT_FALSE(fs::exists(folder / "new.jetz"));
}

}  // namespace
}  // namespace jet::host
