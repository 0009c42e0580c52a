// Projects of older and newer versions of the format: read, written as today's, the original kept. The fixtures in
// tests/fixtures/formats are one project, as each version had it.
#include "scene_fakes.hpp"

#include <jet/project.hpp>

#include <gmock/gmock.h>
#include <test_paths.hpp>

#include <fstream>
#include <sstream>
#include <unistd.h>

namespace jet {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::SizeIs;

class MigrationTest : public testing::Test {
protected:
    MigrationTest()
    {
        test::registerFakes(catalog);
        std::string name = (fs::temp_directory_path() / "jet-migration-XXXXXX").string();
        folder = ::mkdtemp(name.data());
    }
    ~MigrationTest() override { fs::remove_all(folder); }

    static fs::path fixture(const std::string& version)
    {
        return fs::path(JET_SOURCE_DIR) / "tests/fixtures/formats" / version;
    }
    std::unique_ptr<Project> open(const std::string& version)
    {
        fs::copy(fixture(version), folder, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
        return Project::load(folder, events, catalog).orThrow();
    }
    static std::string read(const fs::path& file)
    {
        std::ifstream in(file, std::ios::binary);
        std::stringstream all;
        all << in.rdbuf();
        return all.str();
    }
    void edit(const std::string& file, const std::string& from, const std::string& to) const
    {
        std::string text = read(folder / file);
        text.replace(text.find(from), from.size(), to);
        std::ofstream(folder / file, std::ios::binary) << text;
    }

    test::TestCatalog catalog;
    EventsCenter events;
    fs::path folder;
};

TEST_F(MigrationTest, AProjectOfVersion0IsWhatItIsInTodaysVersion)
{
    const auto today = Project::load(fixture("1"), events, catalog).orThrow();
    const auto old = open("0");
    EXPECT_EQ(old->hash(), today->hash());
    ASSERT_THAT(old->notes(), SizeIs(1));
    EXPECT_THAT(old->notes()[0].message, HasSubstr("of format version 0; saving writes it as version 1"));
    EXPECT_FALSE(old->isModified()) << "nothing the user did";
}

TEST_F(MigrationTest, SavingWritesAllFilesInTodaysVersionAndKeepsTheOriginal)
{
    {
        const auto old = open("0");
        old->save().orThrow();
        for (const char* file : {"project.jet", "scenes/One.scene", "scenes/Two.scene"})
            EXPECT_EQ(read(folder / file), read(fixture("1") / file)) << file;
        const auto kept = findBackups(folder);
        ASSERT_THAT(kept, testing::Contains(testing::Field(&Backup::name, testing::EndsWith("-version-0"))));
    }
    // It outlives the backups of the saves that follow.
    const auto project = Project::load(folder, events, catalog).orThrow();
    EXPECT_TRUE(project->notes().empty());
    for (int i = 0; i < 15; ++i) {
        auto change = project->scenes()[0]->items().begin("Draw");
        change.add<ShapeItem>(project->scenes()[0]->root(), Path::line({0, 0}, {1.0 * i, 5}));
        change.commit();
        project->save().orThrow();
    }
    const auto all = findBackups(folder);
    EXPECT_THAT(all, SizeIs(Project::kDefaultBackups + 1));
    ASSERT_THAT(all.back().name, testing::EndsWith("-version-0"));
    for (const char* file : {"project.jet", "scenes/One.scene", "scenes/Two.scene"})
        EXPECT_EQ(read(all.back().folder / file), read(fixture("0") / file)) << file;
    restoreBackup(folder / "project.jet", all.back().name).orThrow();
    EXPECT_EQ(read(folder / "scenes/One.scene"), read(fixture("0") / "scenes/One.scene"));
}

TEST_F(MigrationTest, OneSceneOfAnOldVersionIsEnough)
{
    open("1");
    fs::copy_file(fixture("0") / "scenes/Two.scene", folder / "scenes/Two.scene", fs::copy_options::overwrite_existing);
    const std::string untouched = "<!-- mine -->";
    std::ofstream(folder / "scenes/One.scene", std::ios::app) << untouched;
    const auto project = Project::load(folder, events, catalog).orThrow();
    ASSERT_THAT(project->notes(), SizeIs(1));
    project->save().orThrow();
    EXPECT_EQ(read(folder / "scenes/Two.scene"), read(fixture("1") / "scenes/Two.scene"));
    EXPECT_THAT(read(folder / "scenes/One.scene"), HasSubstr(untouched)) << "what is of today is not written";
}

TEST_F(MigrationTest, WhenTheOriginalCannotBeKeptNothingIsWritten)
{
    const auto project = open("0");
    std::ofstream(folder / ".jet-backups") << "a file where the folder should be";
    const auto saved = project->save();
    ASSERT_FALSE(saved);
    EXPECT_THAT(saved.error().text(), HasSubstr("the original of format version 0 cannot be kept"));
    EXPECT_EQ(read(folder / "project.jet"), read(fixture("0") / "project.jet"));
    fs::remove(folder / ".jet-backups");
    EXPECT_TRUE(project->save());
}

TEST_F(MigrationTest, SavedElsewhereTheOriginalStaysWhereItIs)
{
    const auto project = open("0");
    project->saveAs(folder / "new").orThrow();
    EXPECT_EQ(read(folder / "new/scenes/One.scene"), read(fixture("1") / "scenes/One.scene"));
    EXPECT_EQ(read(folder / "project.jet"), read(fixture("0") / "project.jet"));
}

TEST_F(MigrationTest, NewerVersionsAreRefusedWithAllVersionsAndWhatToDo)
{
    open("1");
    edit("project.jet", "version=\"1\"", "version=\"7\"");
    const auto refused = Project::load(folder, events, catalog);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().text(),
                HasSubstr("project.jet:2:2: error: this project has format version 7, written by a "
                          "newer JET; this JET ("));
    EXPECT_THAT(refused.error().text(), HasSubstr("reads versions 0 to 1: open it with a newer JET"));
    edit("project.jet", "version=\"7\"", "version=\"1\"");
    edit("scenes/Two.scene", "version=\"1\"", "version=\"2\"");
    EXPECT_THAT(Project::load(folder, events, catalog).error().text(),
                HasSubstr("Two.scene:2:2: error: this scene has format version 2"));
    for (const char* none : {"", "-1", "1.0", "x", "99999999999999999999"}) {
        std::ofstream(folder / "scenes/Two.scene") << "<scene version=\"" << none << "\"/>";
        EXPECT_THAT(Project::load(folder, events, catalog).error().text(), HasSubstr("which is none")) << none;
    }
}

}  // namespace
}  // namespace jet
