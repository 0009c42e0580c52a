#include "geometry_samples.hpp"
#include "scene_fakes.hpp"

#include <jet/format.hpp>
#include <jet/project_tree.hpp>
#include <jet/start_scene.hpp>

#include <gmock/gmock.h>

#include <deque>
#include <filesystem>

namespace jet {
namespace {

namespace fs = std::filesystem;

class ProjectTreeTest : public testing::Test {
protected:
    ProjectTreeTest() { test::registerFakes(catalog); }

    template <class Action>
    static std::string failure(Action&& action)
    {
        try {
            action();
        } catch (const Failure& f) {
            return f.what();
        }
        return "nothing";
    }
    Filter& root() { return project->root(); }
    Scene& first() { return *project->scenes().front(); }

    test::TestCatalog catalog;
    EventsCenter events;
    std::unique_ptr<Project> project = Project::create("Game", events, catalog);
    ProjectTree tree{*project, events};
};

TEST_F(ProjectTreeTest, ARemovedSceneComesBackWithItsOwnHistory)
{
    Scene& level = tree.addScene("Level", root());
    for (const char* name : {"a", "b"}) {
        auto edit = level.items().begin(name);
        edit.add<LayerItem>(level.root());
        edit.commit();
    }
    level.undoRedo().undo();
    const auto before = project->hash();
    tree.remove(level);
    EXPECT_EQ(project->scene("Level"), nullptr);
    tree.undo();
    EXPECT_EQ(project->scene("Level"), &level) << "the same object";
    EXPECT_EQ(project->hash(), before);
    EXPECT_EQ(level.undoRedo().labels(), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(level.undoRedo().position(), 1u);
    level.undoRedo().redo();
    EXPECT_EQ(level.items().itemCount(), 2u);
}

TEST_F(ProjectTreeTest, AFilterGoesAndComesWithAllThatIsInIt)
{
    Filter& outer = tree.addFilter("Outer", root());
    Filter& inner = tree.addFilter("Inner", outer);
    Scene& deep = tree.addScene("Deep", inner);
    const auto before = project->hash();
    tree.remove(outer);
    EXPECT_EQ(project->scenes().size(), 1u);
    tree.undo();
    EXPECT_EQ(project->hash(), before);
    EXPECT_EQ(project->scene("Deep"), &deep);
}

TEST_F(ProjectTreeTest, WhatCannotBeDoneIsRefusedWithAReason)
{
    Filter& outer = tree.addFilter("Outer", root());
    Filter& inner = tree.addFilter("Inner", outer);
    const auto before = project->hash();
    EXPECT_EQ(failure([&] { tree.remove(first()); }), "a project has at least one scene; add another one first");
    EXPECT_EQ(failure([&] { tree.remove(root()); }), "the outermost filter of a project cannot be removed");
    EXPECT_EQ(failure([&] { tree.move(root(), outer, 0); }), "the outermost filter of a project cannot be moved");
    EXPECT_EQ(failure([&] { tree.move(outer, inner, 0); }), "'Outer' cannot be moved into itself");
    EXPECT_EQ(failure([&] { tree.addScene("Scene 0", root()); }),
              "there is a scene called 'Scene 0' already; choose another name");
    EXPECT_EQ(failure([&] { tree.rename(first(), ""); }), "a scene needs a name");
    EXPECT_EQ(failure([&] { tree.rename(outer, "\xff"); }), "the name of a filter must be UTF-8 without a NUL");
    Filter stranger;
    EXPECT_EQ(failure([&] { tree.addScene("x", stranger); }), "this is not in the project, or not any more");
    EXPECT_EQ(project->hash(), before);
    EXPECT_EQ(tree.position(), 2u);
}

TEST_F(ProjectTreeTest, ASceneThatWasRemovedSavedAndBroughtBackIsSavedAgain)
{
    const fs::path folder = fs::path(testing::TempDir()) / ("jet-tree-" + std::to_string(::getpid()));
    Scene& level = tree.addScene("Level", root());
    project->saveAs(folder).orThrow();
    tree.remove(level);
    project->save().orThrow();
    EXPECT_FALSE(fs::exists(folder / "scenes/Level.scene"));
    tree.undo();
    EXPECT_TRUE(project->isModified());
    project->save().orThrow();
    const auto again = Project::load(folder, events, catalog).orThrow();
    EXPECT_EQ(again->hash(), project->hash());
    fs::remove_all(folder);
}

TEST_F(ProjectTreeTest, ADuplicateStandsAfterItsOriginalUnderTheNextFreeName)
{
    auto edit = first().items().begin("Add");
    edit.add<ShapeItem>(first().root(), Path::rectangle(Box({0, 0}, {1, 1})));
    edit.commit();
    Scene& level = tree.addScene("Level 9", root());
    tree.addScene("Level 10", root());
    EXPECT_EQ(tree.duplicate(level).name(), "Level 11");
    EXPECT_EQ(project->scenes()[2]->name(), "Level 11");
    tree.rename(level, "Menu");
    EXPECT_EQ(tree.duplicate(level).name(), "Menu 2");
    Scene& copy = tree.duplicate(first());
    EXPECT_EQ(copy.hash(), first().hash());
    EXPECT_FALSE(copy.undoRedo().canUndo());
}

TEST_F(ProjectTreeTest, AFileStepThatFailsLeavesHistoryAndFilesAsTheyWere)
{
    const fs::path folder = fs::path(testing::TempDir()) / ("jet-files-" + std::to_string(::getpid()));
    EXPECT_THAT(failure([&] { tree.addFile("/nowhere"); }), testing::HasSubstr("no folder yet"));
    project->saveAs(folder).orThrow();
    fs::create_directories(folder / "assets");
    writeFileAtomically(folder / "assets/a.txt", std::string_view("a")).orThrow();
    writeFileAtomically(folder / "assets/b.txt", std::string_view("b")).orThrow();
    EXPECT_THAT(failure([&] { tree.renameFile("assets/a.txt", "b.txt"); }), testing::HasSubstr("already"));
    EXPECT_THAT(failure([&] { tree.renameFile("assets/a.txt", "../x"); }), testing::HasSubstr("cannot be the name"));
    EXPECT_THAT(failure([&] { tree.removeFile("project.jet"); }), testing::HasSubstr("not a file of the project"));
    EXPECT_THAT(failure([&] { tree.addFile(folder / "none.png"); }), testing::HasSubstr("not there"));
    EXPECT_EQ(tree.position(), 0u);
    tree.removeFile("assets/a.txt");
    writeFileAtomically(folder / "assets/a.txt", std::string_view("another")).orThrow();
    EXPECT_THAT(failure([&] { tree.undo(); }), testing::HasSubstr("already"));
    EXPECT_EQ(tree.position(), 1u) << "it can be tried again";
    fs::remove(folder / "assets/a.txt");
    tree.undo();
    EXPECT_EQ(readFile(folder / "assets/a.txt").orThrow(), "a");
    fs::remove_all(folder);
}

TEST_F(ProjectTreeTest, TheStartSceneIsChosenAndFollowsNamesRemovalsAndUndo)
{
    Scene& level = tree.addScene("Level", tree.addFilter("Levels", root()));
    EXPECT_EQ(startScene(*project), &first()) << "none is chosen";
    tree.makeStart(level);
    tree.makeStart(level);
    EXPECT_EQ(startScene(*project), &level);
    EXPECT_EQ(project->scenes().back(), &level) << "it keeps its place";
    EXPECT_EQ(tree.position(), 3u) << "what is so already is no step";
    tree.rename(level, "Menu");
    EXPECT_EQ(startScene(*project), &level);
    tree.remove(*root().filters.front());
    EXPECT_EQ(startScene(*project), &first());
    tree.undo();
    EXPECT_EQ(startScene(*project), &level);
    tree.goTo(2);
    EXPECT_EQ(startScene(*project), &first());
    tree.goTo(5);
    tree.goTo(4);
    EXPECT_EQ(startScene(*project), &level);
}

TEST_F(ProjectTreeTest, TheStartSceneIsSavedAndWithoutOneTheFileIsAsBefore)
{
    const fs::path folder = fs::path(testing::TempDir()) / ("jet-start-" + std::to_string(::getpid()));
    Scene& level = tree.addScene("Level", root());
    project->saveAs(folder).orThrow();
    const std::string before = readFile(folder / "project.jet").orThrow();
    EXPECT_EQ(before.find("start"), std::string::npos);
    tree.makeStart(level);
    EXPECT_TRUE(project->isModified());
    project->save().orThrow();
    EXPECT_THAT(readFile(folder / "project.jet").orThrow(), testing::HasSubstr("name=\"Game\" start=\"Level\">"));
    const auto again = Project::load(folder, events, catalog).orThrow();
    EXPECT_EQ(again->hash(), project->hash());
    EXPECT_EQ(startScene(*again)->name(), "Level");
    tree.undo();
    project->save().orThrow();
    EXPECT_EQ(readFile(folder / "project.jet").orThrow(), before);
    fs::remove_all(folder);
}

TEST_F(ProjectTreeTest, ANameThatNoSceneHasIsKeptToldAndDoesNotStart)
{
    const fs::path folder = fs::path(testing::TempDir()) / ("jet-lost-start-" + std::to_string(::getpid()));
    Scene& level = tree.addScene("Level", root());
    tree.makeStart(level);
    project->saveAs(folder).orThrow();
    std::string text = readFile(folder / "project.jet").orThrow();
    text.replace(text.find("start=\"Level\""), 13, "start=\"Lost\"");
    writeFileAtomically(folder / "project.jet", text).orThrow();
    auto again = Project::load(folder, events, catalog).orThrow();
    ASSERT_EQ(again->notes().size(), 1u);
    EXPECT_THAT(again->notes().front().message, testing::HasSubstr("there is no scene 'Lost' to start with"));
    EXPECT_EQ(startScene(*again)->name(), "Scene 0");
    again->save(Overwrite::Allow).orThrow();
    EXPECT_EQ(readFile(folder / "project.jet").orThrow(), text);
    ProjectTree other(*again, events);
    other.addScene("Lost", again->root());
    EXPECT_EQ(startScene(*again)->name(), "Lost");
    fs::remove_all(folder);
}

TEST_F(ProjectTreeTest, EachStepIsTold)
{
    int told = 0;
    const auto subscription =
        events.subscribe<ProjectTreeChanged>(project.get(), [&](const ProjectTreeChanged&) { ++told; });
    tree.addScene("A", root());
    tree.undo();
    tree.redo();
    tree.undo();
    tree.undo();
    EXPECT_EQ(told, 4);
}

TEST_F(ProjectTreeTest, RemovedScenesAreForgottenWhenTheyTakeTooMuch)
{
    tree.setMemoryLimit(300'000);
    for (int i = 0; i < 20; ++i) {
        Scene& level = tree.addScene("Level " + std::to_string(i), root());
        auto edit = level.items().begin("Fill");
        for (int k = 0; k < 200; ++k) edit.add<ShapeItem>(level.root(), Path::ellipse(Box({0, 0}, {1, 1})));
        edit.commit();
        tree.remove(level);
        EXPECT_LE(tree.memory(), 300'000u);
    }
    EXPECT_LT(tree.labels().size(), 20u);
    EXPECT_GT(tree.labels().size(), 1u);
}

TEST_F(ProjectTreeTest, RandomChangesLeadBackToWhatWas)
{
    test::Random random(9);
    std::deque<std::uint64_t> log{project->hash()};
    const auto filters = [&] {
        std::vector<Filter*> all;
        const auto walk = [&](const auto& self, Filter& filter) -> void {
            all.push_back(&filter);
            for (auto& child : filter.filters) self(self, *child);
        };
        walk(walk, root());
        return all;
    };
    int names = 0;
    bool changed = false;
    const auto subscription =
        events.subscribe<ProjectTreeChanged>(project.get(), [&](const ProjectTreeChanged&) { changed = true; });
    for (int i = 0; i < 20000; ++i) {
        const auto all = filters();
        const auto scenes = project->scenes();
        Filter& filter = *all[random.index(all.size())];
        Filter& other = *all[random.index(all.size())];
        Scene& scene = *scenes[random.index(scenes.size())];
        const std::string name = "Name " + std::to_string(names++);
        try {
            switch (random.index(all.size() + scenes.size() > 30 ? 7 : 10)) {
            case 0: tree.remove(scene); break;
            case 1: tree.remove(filter); break;
            case 2: tree.rename(scene, name); break;
            case 3: tree.rename(filter, name); break;
            case 4: tree.move(scene, filter, random.index(4)); break;
            case 5: tree.move(filter, other, random.index(4)); break;
            case 6: tree.makeStart(scene); break;
            case 7: tree.addFilter(name, filter, random.index(4)); break;
            case 8: tree.renameProject(name); break;
            default: random.index(2) ? tree.addScene(name, filter, random.index(4)) : tree.duplicate(scene);
            }
            if (std::exchange(changed, false)) {  // not what was so already
                log.resize(tree.position());
                log.push_back(project->hash());
            }
        } catch (const Failure&) {
            ASSERT_EQ(project->hash(), log[tree.position()]);
        }
        for (std::size_t k = random.index(4); k > 0; --k) {
            random.index(2) ? tree.undo() : tree.redo();
            changed = false;
            ASSERT_EQ(project->hash(), log[tree.position()]) << i;
        }
    }
}

}  // namespace
}  // namespace jet
