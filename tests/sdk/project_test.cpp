// Projects in folders: what is saved opens again, what is unchanged is not touched, and a save that fails or dies
// leaves the old project or the new one.
#include "scene_fakes.hpp"

#include <jet/project.hpp>

#include <gmock/gmock.h>

#include <csignal>
#include <fstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace jet {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ProjectTest : public testing::Test {
protected:
    ProjectTest()
    {
        test::registerFakes(catalog);
        std::string name = (fs::temp_directory_path() / "jet-project-XXXXXX").string();
        folder = ::mkdtemp(name.data());
    }
    ~ProjectTest() override { fs::remove_all(folder); }

    std::unique_ptr<Project> make(int scenes = 1)
    {
        auto project = Project::create("Game", events, catalog);
        for (int i = 1; i < scenes; ++i) project->addScene("Level " + std::to_string(i));
        for (Scene* scene : project->scenes()) draw(*scene);
        return project;
    }
    static void draw(Scene& scene)
    {
        auto edit = scene.items().begin("Draw");
        const Item& shape = edit.add<ShapeItem>(scene.root(), Path::rectangle(Box({0, 0}, {10, 10})));
        edit.addEffect(shape, "tint");
        edit.commit();
    }
    std::unique_ptr<Project> load() { return Project::load(folder, events, catalog).orThrow(); }
    std::string refusal()
    {
        const auto project = Project::load(folder, events, catalog);
        return project ? "accepted" : project.error().text();
    }
    void write(const std::string& name, const std::string& content)
    {
        fs::create_directories((folder / name).parent_path());
        std::ofstream(folder / name) << content;
    }
    /// The project's files with their content, its backups left out.
    std::map<std::string, std::string> files() const
    {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file() && entry.path().string().find(".jet-backups") == std::string::npos)
                all[fs::relative(entry.path(), folder).string()] = readFile(entry.path()).orThrow();
        return all;
    }

    test::TestCatalog catalog;
    EventsCenter events;
    fs::path folder;
};

std::string project(const std::string& content)
{
    return "<?xml version=\"1.0\"?>\n<jet-project version=\"1\" name=\"G\">\n" + content + "\n</jet-project>\n";
}

TEST_F(ProjectTest, WhatIsSavedOpensAgainTheSame)
{
    auto project = make(3);
    project->saveAs(folder).orThrow();
    const auto again = load();
    EXPECT_EQ(again->hash(), project->hash());
    EXPECT_EQ(again->name(), "Game");
    EXPECT_EQ(again->scenes().size(), 3u);
    EXPECT_FALSE(again->isModified());
    EXPECT_EQ(files().size(), 4u);
}

TEST_F(ProjectTest, TheProjectIsFoundByItsFileItsFolderAndAnyOnlyName)
{
    auto project = make();
    project->saveAs(folder / "game.jet").orThrow();
    EXPECT_TRUE(Project::load(folder / "game.jet", events, catalog));
    EXPECT_TRUE(Project::load(folder, events, catalog));
    write("second.jet", "");
    EXPECT_THAT(refusal(), HasSubstr("several projects in this folder; name one"));
}

TEST_F(ProjectTest, AnUnchangedProjectKeepsItsBytesAndTimes)
{
    // Written by hand, in another style than JET's own.
    write("project.jet", project("<filter name='F'><scene name='S' file='levels/s.scene'/></filter>"));
    write("levels/s.scene", "<scene version='1'><item id='5' name='x' type='shape'><path>M0,0h5</path></item></scene>");
    const auto before = files();
    const auto time = fs::last_write_time(folder / "project.jet") - std::chrono::hours(1);
    for (const auto& [name, content] : before) fs::last_write_time(folder / name, time);
    auto opened = load();
    opened->save().orThrow();
    EXPECT_EQ(files(), before);
    for (const auto& [name, content] : before) EXPECT_EQ(fs::last_write_time(folder / name), time) << name;
}

TEST_F(ProjectTest, SavingWritesOnlyTheScenesThatChanged)
{
    make(3)->saveAs(folder).orThrow();
    auto opened = load();
    const auto before = files();
    draw(*opened->scenes()[1]);
    EXPECT_TRUE(opened->isModified());
    opened->save().orThrow();
    EXPECT_FALSE(opened->isModified());
    int changed = 0;
    for (const auto& [name, content] : files()) changed += before.at(name) != content;
    EXPECT_EQ(changed, 2) << "the scene and, since its count of uses grew, project.jet";
    EXPECT_EQ(load()->hash(), opened->hash());
}

TEST_F(ProjectTest, RenamingAndReorderingAreChanges)
{
    make(2)->saveAs(folder).orThrow();
    auto opened = load();
    opened->scenes()[0]->setName("Intro");
    EXPECT_TRUE(opened->isModified());
    opened->save().orThrow();
    EXPECT_NE(load()->scene("Intro"), nullptr);
    std::swap(opened->root().scenes[0], opened->root().scenes[1]);
    EXPECT_TRUE(opened->isModified());
    opened->save().orThrow();
    EXPECT_EQ(load()->scenes()[1]->name(), "Intro");
    opened->root().name = "All";
    EXPECT_TRUE(opened->isModified());
    opened->setName("Another game");
    opened->save().orThrow();
    EXPECT_EQ(load()->name(), "Another game");
}

TEST_F(ProjectTest, AFilterMayBeEmpty)
{
    write("project.jet", project("<plugins>\n</plugins>\n<filter name=\"F\">\n</filter>"));
    EXPECT_EQ(refusal(), "accepted");
}

TEST_F(ProjectTest, FiltersNest)
{
    auto project = make();
    auto inner = std::make_unique<Filter>();
    inner->name = "Bonus <1> & more";
    Filter& filter = *inner;
    project->root().filters.push_back(std::move(inner));
    project->addScene("Hidden", &filter);
    project->saveAs(folder).orThrow();
    const auto again = load();
    ASSERT_EQ(again->root().filters.size(), 1u);
    EXPECT_EQ(again->root().filters[0]->name, "Bonus <1> & more");
    EXPECT_EQ(again->root().filters[0]->scenes[0]->name(), "Hidden");
}

TEST_F(ProjectTest, ARemovedScenesFileGoesWithTheNextSave)
{
    auto project = make(2);
    project->saveAs(folder).orThrow();
    project->removeScene(*project->scene("Level 1"));
    EXPECT_TRUE(fs::exists(folder / "scenes/Level 1.scene"));
    project->save().orThrow();
    EXPECT_FALSE(fs::exists(folder / "scenes/Level 1.scene"));
    EXPECT_EQ(load()->scenes().size(), 1u);
}

TEST_F(ProjectTest, ASceneThatTakesTheNameOfARemovedOneIsNotRemovedWithIt)
{
    auto project = make(2);
    project->saveAs(folder).orThrow();
    project->removeScene(*project->scene("Level 1"));
    draw(project->addScene("Level 1"));
    project->save().orThrow();
    EXPECT_EQ(load()->hash(), project->hash());
}

TEST_F(ProjectTest, NamesThatNoFileCanHaveGetFilesOfTheirOwn)
{
    auto project = make();
    std::string umlauts(99, 'a');
    for (int i = 0; i < 10; ++i) umlauts += "ü";
    for (const std::string& name : {std::string("a/b"), std::string("a_b"), std::string("../../etc"), std::string(".."),
                                    std::string("a\\b"), std::string(300, 'x'), umlauts, std::string("CON:<>|?*\"")})
        draw(project->addScene(name));
    project->saveAs(folder).orThrow();
    EXPECT_EQ(load()->hash(), project->hash());
    project->saveAs(folder / "second.jet").orThrow();
    EXPECT_EQ(Project::load(folder / "second.jet", events, catalog).orThrow()->hash(), project->hash());
    EXPECT_EQ(Project::load(folder / "project.jet", events, catalog).orThrow()->hash(), project->hash())
        << "two projects in one folder do not share scene files";
}

TEST_F(ProjectTest, SavingUnderTheSameNameKeepsTheSceneFiles)
{
    write("project.jet", project("<filter name='F'><scene name='S' file='levels/s.scene'/></filter>"));
    write("levels/s.scene", "<scene version='1'/>");
    auto opened = load();
    opened->saveAs(folder).orThrow();
    EXPECT_EQ(files().size(), 2u);
    EXPECT_TRUE(files().contains("levels/s.scene"));
}

TEST_F(ProjectTest, PluginsUsedAreRecordedAndKeptWhileTheyAreMissing)
{
    make()->saveAs(folder).orThrow();
    EXPECT_THAT(files()["project.jet"], HasSubstr("<plugin id=\"test\" version=\"0\" uses=\"1\" provides=\""));
    test::TestCatalog none;
    auto bare = Project::load(folder, events, none).orThrow();
    EXPECT_FALSE(bare->notes().empty());
    const auto before = files();
    auto edit = bare->scenes()[0]->items().begin("Add");
    edit.add<ShapeItem>(bare->scenes()[0]->root());
    edit.commit();
    bare->save().orThrow();
    EXPECT_EQ(files()["project.jet"], before.at("project.jet"));

    auto full = load();
    auto remove = full->scenes()[0]->items().begin("Remove");
    full->scenes()[0]->root().walk([&](const Item& item) {
        if (!item.effects().empty()) remove.removeEffect(item, 0);
    });
    remove.commit();
    full->save().orThrow();
    EXPECT_THAT(files()["project.jet"], testing::Not(HasSubstr("<plugin ")))
        << "what is not used any more is not listed";
}

// --- wrong projects

struct Wrong {
    const char* name;
    std::string file;
    const char* message;
};

std::ostream& operator<<(std::ostream& out, const Wrong& wrong) { return out << wrong.name; }

const std::vector<Wrong>& wrongs()
{
    static const std::vector<Wrong> all{
        {"Truncated", "<jet-project version=\"1\"", ".jet:1:"},
        {"AnotherFile", "<svg/>", "a project file starts with <jet-project>, this one with <svg>"},
        {"NewerVersion", "<jet-project version=\"7\" name=\"x\"/>", "open it with a newer JET"},
        {"StrayText", project("hello"), "project.jet:3:1: error: stray text here; a project holds"},
        {"NoFilter", project(""), "the project has no <filter>; add"},
        {"TwoFilters", project("<filter name=\"a\"/><filter name=\"b\"/>"), "put this one inside it"},
        {"UnknownElement", project("<scenes/>"), "project.jet:3:2: error: <scenes> is not known here"},
        {"UnknownAttribute", project("<filter name=\"a\" color=\"b\"/>"), "has no attribute 'color'"},
        {"SceneWithoutFile", project("<filter name=\"F\"><scene name=\"S\"/></filter>"), "needs the attribute file"},
        {"MissingScene", project("<filter name=\"F\">\n<scene name=\"S\" file=\"s.scene\"/></filter>"),
         "project.jet:4:2: error: the scene file 's.scene' is missing; restore it, or remove this line"},
        {"SceneAbove", project("<filter name=\"F\"><scene name=\"S\" file=\"../s.scene\"/></filter>"), "lies outside"},
        {"SceneFarAbove", project("<filter name=\"F\"><scene name=\"S\" file=\"a/../../s.scene\"/></filter>"),
         "lies outside"},
        {"SceneSomewhere", project("<filter name=\"F\"><scene name=\"S\" file=\"/etc/passwd\"/></filter>"),
         "lies outside"},
        {"SceneNowhere", project("<filter name=\"F\"><scene name=\"S\" file=\"\"/></filter>"), "lies outside"},
        {"SceneIsAFolder", project("<filter name=\"F\"><scene name=\"S\" file=\"folder\"/></filter>"), "is a folder"},
        {"SameName",
         project("<filter name=\"F\"><scene name=\"S\" file=\"a\"/><scene name=\"S\" file=\"b\"/></filter>"),
         "two scenes called 'S'"},
        {"SameFile",
         project("<filter name=\"F\"><scene name=\"S\" file=\"a\"/><scene name=\"T\" file=\"./a\"/></filter>"),
         "share the file"},
        {"BrokenScene", project("<filter name=\"F\"><scene name=\"S\" file=\"broken\"/></filter>"), "broken:1:"},
        {"NotUtf8", project("<filter name=\"\xff\"/>"), "project.jet:3:15: error: this is not UTF-8"},
    };
    return all;
}

class WrongProjectTest : public ProjectTest, public testing::WithParamInterface<Wrong> {};

TEST_P(WrongProjectTest, IsRefusedWithPlaceAndReason)
{
    write("project.jet", GetParam().file);
    for (const char* fine : {"a", "b"}) write(fine, "<scene version=\"1\"/>");
    write("broken", "<scene");
    fs::create_directory(folder / "folder");
    EXPECT_THAT(refusal(), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(Project, WrongProjectTest, testing::ValuesIn(wrongs()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_F(ProjectTest, AFolderWithoutAProjectSaysSo)
{
    EXPECT_THAT(refusal(), HasSubstr("there is no project in this folder: project.jet is missing"));
    EXPECT_THAT(Project::load(folder / "nothing", events, catalog).error().text(), HasSubstr("check the name"));
}

TEST_F(ProjectTest, DeepFiltersAreRefusedOnBothWays)
{
    std::string open, close;
    for (int i = 0; i < 150; ++i) open += "<filter name=\"f\">", close += "</filter>";
    write("project.jet", project(open + close));
    EXPECT_THAT(refusal(), HasSubstr("nested more than 100 deep"));
    auto deep = make();
    Filter* at = &deep->root();
    for (int i = 0; i < 150; ++i) {
        at->filters.push_back(std::make_unique<Filter>());
        at = at->filters.back().get();
    }
    EXPECT_THAT(deep->saveAs(folder / "new").error().text(), HasSubstr("nested more than 100 deep"));
    EXPECT_FALSE(fs::exists(folder / "new"));
}

TEST_F(ProjectTest, ADamagedProjectNeverCrashes)
{
    make(2)->saveAs(folder).orThrow();
    const std::string text = files()["project.jet"];
    for (std::size_t at = 0; at < text.size(); ++at)
        for (const char with : {'<', '"', '\0', '/'}) {
            std::string damaged = text;
            damaged[at] = with;
            write("project.jet", damaged);
            (void)Project::load(folder, events, catalog);
        }
}

// --- saving that fails

TEST_F(ProjectTest, WhatCouldNotBeOpenedAgainIsNotSaved)
{
    auto project = make(2);
    project->saveAs(folder).orThrow();
    const auto before = files();
    project->scenes()[1]->setName(project->scenes()[0]->name());
    EXPECT_THAT(project->save().error().text(), HasSubstr("there are two scenes called 'Scene 0'; rename one"));
    project->scenes()[1]->setName("bad \xff");
    EXPECT_THAT(project->save().error().text(), HasSubstr("not UTF-8"));
    EXPECT_EQ(files(), before);
    project->scenes()[1]->setName("good");
    EXPECT_TRUE(project->save());
}

TEST_F(ProjectTest, AReadOnlySceneStopsTheSaveAndTheNextOneHeals)
{
    auto project = make();
    project->saveAs(folder).orThrow();
    const auto before = files();
    fs::permissions(folder / "scenes/Scene 0.scene", fs::perms::owner_read);
    draw(*project->scenes()[0]);
    project->addScene("New");  // empty, so that only its being new makes it be written
    const auto saved = project->save();
    ASSERT_FALSE(saved);
    EXPECT_THAT(saved.error().text(),
                HasSubstr("Scene 0.scene: error: cannot be written: Permission denied; check the permissions"));
    EXPECT_EQ(files(), before);
    EXPECT_TRUE(project->isModified());
    fs::permissions(folder / "scenes/Scene 0.scene", fs::perms::owner_write, fs::perm_options::add);
    project->save().orThrow();
    EXPECT_EQ(load()->hash(), project->hash());
}

TEST_F(ProjectTest, ASceneThatNeverReachedTheDiskIsWrittenByTheNextSave)
{
    auto project = make();
    project->saveAs(folder).orThrow();
    project->addScene("New");
    fs::create_directories(folder / "scenes/New.scene");  // in the way
    EXPECT_FALSE(project->save());
    fs::remove(folder / "scenes/New.scene");
    project->save().orThrow();
    EXPECT_EQ(load()->hash(), project->hash());
}

TEST_F(ProjectTest, AFolderThatIsGoneIsMadeAgain)
{
    auto project = make();
    project->saveAs(folder / "game").orThrow();
    fs::remove_all(folder / "game");
    draw(*project->scenes()[0]);
    project->setName("Found again");
    project->save().orThrow();
    EXPECT_EQ(Project::load(folder / "game", events, catalog).orThrow()->hash(), project->hash());
}

TEST_F(ProjectTest, AFolderThatCannotBeMadeSaysSoAndTheProjectStaysWhereItWas)
{
    auto project = make();
    project->saveAs(folder).orThrow();
    write("file", "");
    EXPECT_THAT(project->saveAs(folder / "file" / "game").error().text(), HasSubstr("choose another place"));
    EXPECT_EQ(project->file(), folder / "project.jet");
    draw(*project->scenes()[0]);
    project->save().orThrow();
    EXPECT_EQ(load()->hash(), project->hash());
}

TEST_F(ProjectTest, AProjectWithoutAFileAsksForOne)
{
    EXPECT_THAT(make()->save().error().message, HasSubstr("choose where to save it"));
}

// The disk is full: files may not grow beyond a few bytes.
TEST_F(ProjectTest, AFullDiskLeavesTheOldFilesAndNoOthers)
{
    auto project = make();
    project->saveAs(folder).orThrow();
    const auto before = files();
    draw(*project->scenes()[0]);
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    const auto oldSignal = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{16, old.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    const auto saved = project->save();
    ::setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, oldSignal);
    ASSERT_FALSE(saved);
    EXPECT_THAT(saved.error().text(), HasSubstr("free some space or choose another place"));
    EXPECT_EQ(files(), before);
}

// A child saves again and again until it is killed at some moment. Whatever the moment: the project opens, and each of
// its scenes is one of those the child wrote.
TEST_F(ProjectTest, KilledWhileSavingItIsTheOldOrTheNewOne)
{
    make(3)->saveAs(folder).orThrow();
    for (int round = 0; round < 12; ++round) {
        const pid_t child = ::fork();
        if (child == 0) {
            auto project = load();
            for (int i = 0;; ++i) {
                for (Scene* scene : project->scenes()) {
                    auto edit = scene->items().begin("Change");
                    edit.set(*scene->root().children().back(), "name", "saved");
                    edit.setPath(*scene->root().children().back(), Path::line({0, 0}, {1.0 * i, 1}));
                    edit.commit();
                }
                if (!project->save()) ::_exit(1);
            }
        }
        ::usleep(20'000 + 1'700 * static_cast<unsigned>(round));
        ::kill(child, SIGKILL);
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status)) << "the child could not save";
        const auto opened = Project::load(folder, events, catalog);
        ASSERT_TRUE(opened) << opened.error().text();
        EXPECT_EQ((*opened)->scenes().size(), 3u);
    }
}

}  // namespace
}  // namespace jet
