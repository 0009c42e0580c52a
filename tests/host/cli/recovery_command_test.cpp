// jet project recover, backups, restore and save --force: after a crash, and beside other programs.
#include "cli_fixture.hpp"

#include "support/test_catalog.hpp"

#include <jet/journal.hpp>
#include <jet/project_lock.hpp>

namespace jet::test {
namespace {

class RecoveryCommandTest : public CliTest {
protected:
    RecoveryCommandTest() { jet("project new game"); }

    std::filesystem::path journals() const { return home() / "state/jet/journals"; }
    /// As if an editor had drawn two shapes and died; returns the hash of the project then.
    std::uint64_t crash(std::unique_ptr<Project> project)
    {
        const Journal journal(*project, journals());
        for (int i = 0; i < 2; ++i) {
            auto edit = project->scenes()[0]->items().begin("Draw");
            edit.add<ShapeItem>(project->scenes()[0]->root(), Path::line({0, 0}, {1.0 * i, 5}));
            edit.commit();
        }
        return project->hash();
    }
    std::uint64_t crash() { return crash(Project::load(file("game"), events_, catalog_).orThrow()); }
    std::uint64_t hashOf(const std::string& name)
    {
        return Project::load(file(name), events_, catalog_).orThrow()->hash();
    }

    TestCatalog catalog_;
    EventsCenter events_;
};

TEST_F(RecoveryCommandTest, CheckTellsOfUnsavedChangesAndRecoverSavesThem)
{
    const std::uint64_t hash = crash();
    const Outcome check = jet("project check game");
    EXPECT_EQ(check.code, 0);
    EXPECT_THAT(check.err, HasSubstr("2 changes, the last at 20"));
    EXPECT_THAT(check.err, HasSubstr("'jet project recover' makes them again"));
    EXPECT_EQ(json(jet("--json project check game").out)["unsavedChanges"], 2);
    EXPECT_THAT(jet("project recover").out, HasSubstr("game: 2 changes"));
    const Outcome recovered = jet("project recover game");
    EXPECT_EQ(recovered.code, 0) << recovered.err;
    EXPECT_THAT(recovered.out, HasSubstr("recovered 2 changes into"));
    EXPECT_EQ(hashOf("game"), hash);
    EXPECT_THAT(jet("project recover game").out, HasSubstr("there are no unsaved changes"));
}

TEST_F(RecoveryCommandTest, AProjectThatWasNeverSavedIsRecoveredIntoAFolder)
{
    const std::uint64_t hash = crash(Project::create("Sketch", events_, catalog_));
    const auto listed = json(jet("--json project recover").out);
    ASSERT_EQ(listed.size(), 1u);
    EXPECT_EQ(listed[0]["project"], "");
    const std::string journal = listed[0]["journal"];
    const Outcome nowhere = jet("project recover '" + journal + "'");
    EXPECT_EQ(nowhere.code, 1);
    EXPECT_THAT(nowhere.err, HasSubstr("name a folder with --to DIR"));
    EXPECT_EQ(jet("project recover '" + journal + "' --to sketch").code, 0);
    EXPECT_EQ(hashOf("sketch"), hash);
    EXPECT_FALSE(std::filesystem::exists(journal));
}

TEST_F(RecoveryCommandTest, DiscardForgetsTheChanges)
{
    const std::uint64_t before = hashOf("game");
    crash();
    EXPECT_EQ(jet("project recover game --discard").code, 0);
    EXPECT_THAT(jet("project recover").out, HasSubstr("there are no unsaved changes"));
    EXPECT_EQ(hashOf("game"), before);
}

TEST_F(RecoveryCommandTest, AFileThatAnotherProgramChangedIsReplacedByForceOnlyAndKept)
{
    const std::uint64_t hash = crash();
    const std::string theirs = read("game/scenes/Scene 0.scene") + "<!-- theirs -->\n";
    write("game/scenes/Scene 0.scene", theirs);
    const Outcome refused = jet("project recover game");
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, HasSubstr("Scene 0.scene: error: another program changed this file"));
    EXPECT_EQ(read("game/scenes/Scene 0.scene"), theirs);
    EXPECT_EQ(jet("project recover game --force").code, 0);
    EXPECT_EQ(hashOf("game"), hash);
    const auto backups = json(jet("--json project backups game").out);
    ASSERT_EQ(backups.size(), 1u);
    EXPECT_EQ(jet("project restore game").code, 0);
    EXPECT_EQ(read("game/scenes/Scene 0.scene"), theirs);
    EXPECT_EQ(json(jet("--json project backups game").out).size(), 2u) << "what the restoring replaced";
}

TEST_F(RecoveryCommandTest, AProjectThatAnotherEditorHasOpenIsNotWritten)
{
    const auto lock = ProjectLock::take(file("game/project.jet"));
    ASSERT_TRUE(lock && lock->isHeld());
    const Outcome refused = jet("project save game");
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, HasSubstr("open in another editor (process " + std::to_string(::getpid())));
    EXPECT_EQ(jet("project save game --force").code, 0);
}

TEST_F(RecoveryCommandTest, ALockThatACrashLeftBehindIsNoObstacle)
{
    write("game/.project.jet.lock", "process 1 on elsewhere since 2020-01-01 00:00:00 UTC\n");
    EXPECT_EQ(jet("project save game").code, 0);
    EXPECT_FALSE(exists("game/.project.jet.lock")) << "the lock goes with the command";
}

TEST_F(RecoveryCommandTest, RestoringWithoutABackupSaysSo)
{
    const Outcome run = jet("project restore game");
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr("there are no backups of this project"));
}

}  // namespace
}  // namespace jet::test
