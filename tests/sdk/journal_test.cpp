// Journals: what was committed is on disk as data, and recovering gives it back, whatever became of the files since.
#include "scene_fakes.hpp"
#include "support/random_edits.hpp"

#include <jet/journal.hpp>
#include <jet/project_tree.hpp>
#include <jet/symbols.hpp>

#include <gmock/gmock.h>

#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace jet {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

class JournalTest : public testing::Test {
protected:
    JournalTest()
    {
        test::registerFakes(catalog);
        std::string name = (fs::temp_directory_path() / "jet-journal-XXXXXX").string();
        folder = ::mkdtemp(name.data());
        journals = folder / "state";
    }
    ~JournalTest() override { fs::remove_all(folder); }

    void draw(Scene& scene, double x = 0)
    {
        auto edit = scene.items().begin("Draw");
        const Item& shape = edit.add<ShapeItem>(scene.root(), Path::rectangle(Box({x, 0}, {x + 10, 10})));
        edit.addEffect(shape, "tint");
        edit.commit();
    }
    /// A saved project with two scenes.
    std::unique_ptr<Project> saved()
    {
        auto project = Project::create("Game", events, catalog);
        project->addScene("Level 1");
        for (Scene* scene : project->scenes()) draw(*scene);
        project->saveAs(folder / "game").orThrow();
        return project;
    }
    Recovery recover()
    {
        const auto found = findJournals(journals);
        EXPECT_EQ(found.size(), 1u);
        return recoverProject(found.front().file, events, catalog).orThrow();
    }

    test::TestCatalog catalog;
    EventsCenter events;
    fs::path folder, journals;
};

TEST_F(JournalTest, RandomEditsAreRecoveredBitForBit)
{
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        fs::remove_all(folder / "game");
        fs::remove_all(journals);
        auto project = seed % 3 == 0 ? Project::create("Untitled", events, catalog) : saved();
        std::uint64_t hash = 0;
        {
            Journal journal(*project, journals);
            if (seed % 4 == 0) journal.setCompactionSize(20'000);
            test::RandomEdits edits(*project, events, seed);
            for (std::size_t n = edits.below(150); n > 0; --n) edits.step();
            draw(project->addScene("Last"));
            hash = project->hash();
        }
        const Recovery recovery = recover();
        ASSERT_EQ(recovery.project->hash(), hash) << "seed " << seed;
        EXPECT_THAT(recovery.notes, IsEmpty()) << recovery.notes.front();
        EXPECT_TRUE(recovery.project->isModified());
        // What was recovered can be saved, and is what it was.
        recovery.project->saveAs(folder / "game").orThrow();
        ASSERT_EQ(Project::load(folder / "game", events, catalog).orThrow()->hash(), hash) << "seed " << seed;
    }
}

TEST_F(JournalTest, AnUnchangedProjectHasNoJournalAndSavingEndsIt)
{
    auto project = saved();
    Journal journal(*project, journals);
    EXPECT_TRUE(journal.file().empty());
    EXPECT_FALSE(fs::exists(journals));
    draw(*project->scenes()[0]);
    EXPECT_EQ(journal.changeCount(), 1u);
    EXPECT_TRUE(fs::exists(journal.file()));
    project->save().orThrow();
    EXPECT_THAT(findJournals(journals), IsEmpty());
    EXPECT_TRUE(fs::is_empty(journals));
    draw(*project->scenes()[0]);
    EXPECT_EQ(findJournals(journals).size(), 1u) << "the next change begins a new one";
}

TEST_F(JournalTest, AJournalTellsItsProjectItsChangesAndWhetherItsEditorLives)
{
    auto project = saved();
    {
        Journal journal(*project, journals);
        draw(*project->scenes()[0]);
        draw(*project->scenes()[1]);
        project->scenes()[1]->undoRedo().undo();
        const JournalInfo info = findJournals(journals).front();
        EXPECT_EQ(info.changes, 3u);
        EXPECT_EQ(info.name, "Game");
        EXPECT_EQ(info.project, folder / "game/project.jet");
        EXPECT_TRUE(info.inUse);
        EXPECT_THAT(findJournals(*project, journals), IsEmpty()) << "nobody may take what a living editor writes";
        EXPECT_THAT(Journal::remove(journal.file()).error().text(), HasSubstr("a running editor writes this journal"));
    }
    EXPECT_EQ(findJournals(*project, journals).size(), 1u);
    EXPECT_FALSE(findJournals(journals).front().inUse);
}

TEST_F(JournalTest, WhatWasRecoveredIsUnsavedAndFreeOfChangesInTheHistory)
{
    auto project = saved();
    {
        Journal journal(*project, journals);
        for (int i = 0; i < 5; ++i) draw(*project->scenes()[0], 20.0 * i);
    }
    const Recovery recovery = recover();
    EXPECT_EQ(recovery.changes, 5u);
    EXPECT_TRUE(recovery.project->isModified());
    EXPECT_FALSE(recovery.project->scenes()[0]->undoRedo().canUndo());
    const std::string untouched = readFile(folder / "game/scenes/Level 1.scene").orThrow();
    recovery.project->save().orThrow();
    EXPECT_FALSE(recovery.project->isModified());
    EXPECT_EQ(readFile(folder / "game/scenes/Level 1.scene").orThrow(), untouched);
    EXPECT_EQ(Project::load(folder / "game", events, catalog).orThrow()->hash(), project->hash());
}

TEST_F(JournalTest, ATornTailCostsOnlyTheChangeThatWasUnderWay)
{
    auto project = saved();
    std::vector<std::uint64_t> hashes{project->hash()};
    std::vector<std::uintmax_t> sizes{0};
    fs::path file;
    {
        Journal journal(*project, journals);
        for (int i = 0; i < 3; ++i) {
            draw(*project->scenes()[0], 20.0 * i);
            file = journal.file();
            hashes.push_back(project->hash());
            sizes.push_back(fs::file_size(file));
        }
    }
    const std::string whole = readFile(file).orThrow();
    for (std::size_t length = sizes[1]; length <= whole.size(); ++length) {
        std::ofstream(file, std::ios::trunc) << whole.substr(0, length);
        const std::size_t complete = length >= sizes[3] ? 3 : length >= sizes[2] ? 2 : 1;
        const Recovery recovery = recover();
        ASSERT_EQ(recovery.project->hash(), hashes[complete]) << "cut after " << length << " bytes";
        ASSERT_EQ(recovery.notes.empty(), length == sizes[complete]);
    }
    // A byte that changed is found, too.
    std::string bad = whole;
    bad[sizes[2] + 20] = static_cast<char>(bad[sizes[2] + 20] ^ 1);
    std::ofstream(file, std::ios::trunc) << bad;
    EXPECT_EQ(recover().project->hash(), hashes[2]);
}

TEST_F(JournalTest, ASceneThatAnotherProgramChangedComesFromTheJournalAndSavingAsks)
{
    auto project = saved();
    {
        Journal journal(*project, journals);
        draw(*project->scenes()[0], 50);
    }
    const fs::path file = folder / "game/scenes/Scene 0.scene";
    std::ofstream(file, std::ios::app) << "<!-- theirs -->\n";
    const Recovery recovery = recover();
    EXPECT_EQ(recovery.project->hash(), project->hash());
    ASSERT_EQ(recovery.notes.size(), 1u);
    EXPECT_THAT(recovery.notes[0], HasSubstr("'Scene 0' was changed by another program since"));
    EXPECT_THAT(recovery.project->save().error().text(), HasSubstr("another program changed this file"));
    EXPECT_THAT(readFile(file).orThrow(), HasSubstr("theirs"));
    recovery.project->save(Overwrite::Allow).orThrow();
    EXPECT_EQ(Project::load(folder / "game", events, catalog).orThrow()->hash(), project->hash());
}

TEST_F(JournalTest, AProjectWhoseFolderHasGoneIsRecoveredFromTheJournalAlone)
{
    auto project = saved();
    {
        Journal journal(*project, journals);
        for (Scene* scene : project->scenes()) draw(*scene, 50);
    }
    fs::remove_all(folder / "game");
    const Recovery recovery = recover();
    EXPECT_EQ(recovery.project->hash(), project->hash());
    EXPECT_TRUE(recovery.project->file().empty());
    ASSERT_EQ(recovery.notes.size(), 1u);
    EXPECT_THAT(recovery.notes[0], HasSubstr("save it in another place"));
}

TEST_F(JournalTest, WhatASaveWroteBeforeTheEndIsNotDoneTwice)
{
    auto project = saved();
    {
        Journal journal(*project, journals);
        draw(*project->scenes()[0], 50);
        draw(*project->scenes()[1], 50);
        const std::string copy = readFile(journal.file()).orThrow();
        // The second scene's file cannot be replaced: the save stops half-way.
        fs::remove(folder / "game/scenes/Level 1.scene");
        fs::create_directories(folder / "game/scenes/Level 1.scene/x");
        EXPECT_FALSE(project->save());
        fs::remove_all(folder / "game/scenes/Level 1.scene");
        draw(*project->scenes()[0], 90);
    }
    std::ofstream(folder / "game/scenes/Level 1.scene") << "<scene version=\"1\"/>";
    const Recovery recovery = recover();
    EXPECT_EQ(recovery.project->hash(), project->hash());
    EXPECT_EQ(recovery.project->scenes()[0]->items().itemCount(), 4u) << "layer and three shapes, none twice";
}

TEST_F(JournalTest, SymbolsAreRecoveredAfterEachStepDoneAndUndone)
{
    auto project = saved();
    const Journal journal(*project, journals);
    Scene& scene = *project->scenes()[0];
    const auto expectRecovered = [&](const std::string& what) {
        const auto recovery = recoverProject(findJournals(journals).front().file, events, catalog).orThrow();
        EXPECT_EQ(recovery.project->hash(), project->hash()) << what;
        EXPECT_THAT(recovery.notes, IsEmpty()) << what;
    };
    const auto step = [&](const char* label, auto change) {
        auto edit = scene.items().begin(label);
        change(edit);
        edit.commit();
        expectRecovered(label);
        scene.undoRedo().undo();
        expectRecovered(std::string(label) + ", undone");
        scene.undoRedo().redo();
        expectRecovered(std::string(label) + ", redone");
    };
    ItemId first, second;
    step("create", [&](Transaction& edit) {
        const Item& box = edit.add<ShapeItem>(scene.root(), Path::rectangle(Box({0, 0}, {9, 9})));
        first = createSymbol(edit, scene, std::vector<const Item*>{&box}, "Box")->id();
    });
    const auto symbol = [&](const char* name) -> const Item& { return *findSymbol(scene, name); };
    step("place", [&](Transaction& edit) {
        second = placeSymbol(edit, symbol("Box"), scene.root(), Affine::rotation(0.3)).id();
    });
    step("change in one", [&](Transaction& edit) {
        const Item& member = *scene.items().find(second)->children().front();
        edit.setPath(member, Path::ellipse(Box({0, 0}, {5, 5})));
        edit.addEffect(member, "tint");
    });
    step("add in one", [&](Transaction& edit) {
        edit.add<ShapeItem>(*scene.items().find(first), Path::rectangle(Box({20, 20}, {30, 30})));
    });
    step("nest", [&](Transaction& edit) {
        createSymbol(edit, scene, std::vector<const Item*>{scene.items().find(second)}, "Outer");
    });
    step("swap", [&](Transaction& edit) { swapSymbol(edit, *scene.items().find(first), symbol("Outer")); });
    step("detach", [&](Transaction& edit) { detachInstance(edit, *scene.items().find(first)); });
    step("rename", [&](Transaction& edit) { edit.set(symbol("Outer"), "name", "Other"); });
}

TEST_F(JournalTest, StepsOfTheProjectTreeAreRecoveredDoneAndUndone)
{
    for (const bool untitled : {false, true}) {
        fs::remove_all(journals), fs::remove_all(folder / "game");
        auto project = untitled ? Project::create("Untitled", events, catalog) : saved();
        const Journal journal(*project, journals);
        ProjectTree tree(*project, events);
        const auto expectRecovered = [&](const char* what) {
            const auto found = findJournals(journals);
            ASSERT_EQ(found.size(), 1u) << what;
            const auto recovery = recoverProject(found.front().file, events, catalog).orThrow();
            EXPECT_EQ(recovery.project->hash(), project->hash()) << what;
            EXPECT_THAT(recovery.notes, IsEmpty()) << what;
        };
        Filter& more = tree.addFilter("More", project->root());
        expectRecovered("add a filter");
        Scene& added = tree.addScene("Level 2", more);
        draw(added);
        expectRecovered("add a scene and draw in it");
        tree.rename(added, "Level two"), tree.rename(more, "Even more"), tree.renameProject("Renamed");
        expectRecovered("rename");
        tree.move(added, project->root(), 0);
        expectRecovered("move");
        draw(tree.duplicate(added));
        expectRecovered("duplicate, and draw in the copy");
        tree.undo();
        expectRecovered("and undo that");
        Scene& first = *project->scenes().back();
        draw(first, 30);
        tree.remove(first);
        expectRecovered("remove a changed scene");
        tree.undo();
        expectRecovered("and undo that");
        draw(first, 60);
        expectRecovered("and draw in what came back");
        tree.redo(), tree.undo(), tree.undo();
        expectRecovered("undo the move");
        tree.goTo(0);
        expectRecovered("undo all");
    }
}

TEST_F(JournalTest, ANewSceneThatTakesTheFileOfARemovedOneIsSavedAfterTheEndWithoutAQuestion)
{
    auto project = saved();
    std::uint64_t hash = 0;
    {
        Journal journal(*project, journals);
        project->removeScene(*project->scene("Level 1"));
        draw(project->addScene("Level 1"), 500);
        draw(*project->scene("Level 1"), 700);
        hash = project->hash();
        // The process ends where the file is about to be written: here, because it cannot be.
        const fs::path part = folder / "game/scenes" / (".Level 1.scene." + std::to_string(::getpid()) + ".part");
        fs::create_directory(part);
        EXPECT_FALSE(project->save());
        fs::remove(part);
    }
    Recovery recovery = recover();
    EXPECT_EQ(recovery.project->hash(), hash);
    EXPECT_THAT(recovery.notes, IsEmpty()) << recovery.notes.front();
    recovery.project->save().orThrow();
    EXPECT_EQ(Project::load(folder / "game", events, catalog).orThrow()->hash(), hash);
}

TEST_F(JournalTest, ItemsAndEffectsOfAbsentPluginsAreRecoveredAsTheyWere)
{
    auto project = saved();
    {
        auto edit = project->scenes()[0]->items().begin("Rope");
        edit.add("rope", project->scenes()[0]->root(), Path::line({0, 0}, {5, 5}));
        edit.commit();
    }
    project->save().orThrow();
    test::TestCatalog none;
    auto bare = Project::load(folder / "game", events, none).orThrow();
    {
        Journal journal(*bare, journals);
        Scene& scene = *bare->scenes()[0];
        auto edit = scene.items().begin("Copy and move");
        const Item& rope = *scene.root().children().back();
        edit.addCopy(rope, scene.root());
        edit.transform(rope, Affine::translation({3, 4}));
        edit.move(rope, scene.root(), 0);
        edit.commit();
    }
    const auto found = findJournals(journals);
    const Recovery without = recoverProject(found.front().file, events, none).orThrow();
    EXPECT_EQ(without.project->hash(), bare->hash());
    // With the plugin the same journal gives what it would have read from the saved file.
    const Recovery with = recoverProject(found.front().file, events, catalog).orThrow();
    EXPECT_EQ(writeSceneText(*with.project->scenes()[0]), writeSceneText(*bare->scenes()[0]));
}

TEST_F(JournalTest, ADamagedOrForeignJournalIsRefusedWithASentence)
{
    fs::create_directories(journals);
    std::ofstream(journals / "a.journal") << "hello";
    EXPECT_THAT(findJournals(journals), IsEmpty());
    EXPECT_THAT(recoverProject(journals / "a.journal", events, catalog).error().text(),
                HasSubstr("no journal of this version of JET"));
    EXPECT_THAT(recoverProject(journals / "none.journal", events, catalog).error().text(), HasSubstr("check the name"));
}

TEST_F(JournalTest, ChangesThatDoNotFitAreRefusedAndChangeNothing)
{
    auto project = saved();
    Scene& scene = *project->scenes()[0];
    std::string bytes;
    const auto subscription = events.subscribe<ItemsChanged>(
        &scene, [&](const ItemsChanged& e) { bytes = encodeChanges(scene, e.changes, e.cause); });
    draw(scene, 30);
    auto other = Project::create("Other", events, catalog);
    Scene& target = *other->scenes()[0];
    const std::uint64_t before = target.hash();
    for (std::size_t cut = 1; cut < bytes.size(); ++cut) {
        const std::string_view records[] = {std::string_view(bytes).substr(0, cut)};
        const ReplayedScene replayed = replayChanges(target, records);
        ASSERT_EQ(replayed.records, 0u);
        ASSERT_FALSE(replayed.problem.message.empty());
        ASSERT_EQ(replayed.scene->hash(), before);
    }
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        std::string bad = bytes;
        bad[at] = static_cast<char>(bad[at] ^ 0xff);
        const std::string_view records[] = {bad};
        const ReplayedScene replayed = replayChanges(target, records);
        ASSERT_TRUE(replayed.records == 1 || replayed.scene->hash() == before);
        ASSERT_EQ(target.hash(), before);
    }
}

TEST_F(JournalTest, AnItemMayBeAddedFilledEmptiedAndTurnedIntoAnotherKindInOneTransaction)
{
    auto project = saved();
    {
        Journal journal(*project, journals);
        Scene& scene = *project->scenes()[0];
        auto edit = scene.items().begin("All at once");
        const Item& group = edit.add<GroupItem>(scene.root());
        const Item& inner = edit.add<GroupItem>(group);
        const Item& shape = edit.add<ShapeItem>(inner, Path::line({0, 0}, {1, 1}));
        edit.addEffect(shape, "tint");
        edit.move(shape, scene.root(), 0);
        edit.remove(inner);
        edit.setType(group, "body");
        edit.setEffect(shape, 0, "note", "later");
        edit.commit();
        scene.undoRedo().undo();
        scene.undoRedo().redo();
    }
    const Recovery recovery = recover();
    EXPECT_EQ(recovery.project->hash(), project->hash());
    EXPECT_THAT(recovery.notes, IsEmpty());
}

TEST_F(JournalTest, AJournalThatCannotBeWrittenIsToldOnceAndBegunAnewWithEverything)
{
    auto project = saved();
    std::ofstream(folder / "blocked") << "a file where the folder should be";
    std::vector<std::string> told;
    Journal journal(*project, folder / "blocked");
    journal.setProblemHandler([&](const std::string& text) { told.push_back(text); });
    draw(*project->scenes()[0], 20);
    draw(*project->scenes()[0], 40);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_THAT(told[0], HasSubstr("changes can not be recorded for a recovery"));
    fs::remove(folder / "blocked");
    journal.recordEverything().orThrow();
    const auto found = findJournals(folder / "blocked");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(recoverProject(found.front().file, events, catalog).orThrow().project->hash(), project->hash());
}

}  // namespace
}  // namespace jet
