// After a crash: the window offers what was not saved; and what it does when other programs or editors touch the files.
#include "window_fixture.hpp"

#include <jet/project_lock.hpp>
#include <jet/start_scene.hpp>

#include <QApplication>
#include <QPushButton>
#include <QTest>
#include <QTreeWidget>

#include <fstream>

namespace jet::test {

namespace fs = std::filesystem;
using host::ProjectController;
using host::RecoveryChoice;

class RecoveryTest : public WindowFixture {
protected:
    /// Draws in a saved project, does more if wanted, and leaves the journal behind as a crash would. Returns the hash.
    std::uint64_t crash(const std::function<void()>& more = {})
    {
        draw("rectangle", {10, 10}, {60, 60});
        EXPECT_TRUE(window().projects().saveAs(folder("game")));
        draw("ellipse", {100, 10}, {160, 60});
        draw("ellipse", {200, 10}, {260, 60});
        if (more) more();
        const std::uint64_t hash = window().project().hash();
        const auto journals = findJournals();
        EXPECT_EQ(journals.size(), 1u);
        const fs::path kept = journals.front().file.string() + ".kept";
        fs::copy_file(journals.front().file, kept);
        start();
        fs::rename(kept, journals.front().file);
        return hash;
    }
    void answer(RecoveryChoice::Kind kind)
    {
        window().projects().setRecoveryQuestion([this, kind](const std::vector<JournalInfo>& journals) {
            offered_ = journals;
            return RecoveryChoice{kind, 0};
        });
    }
    ~RecoveryTest() override
    {
        for (const JournalInfo& info : findJournals())
            if (!info.inUse) (void)Journal::remove(info.file);
    }

    std::vector<JournalInfo> offered_;
};

TEST_F(RecoveryTest, OpeningAProjectOffersItsUnsavedChangesAndRecoverMakesThem)
{
    const std::uint64_t hash = crash();
    answer(RecoveryChoice::Kind::Recover);
    ASSERT_TRUE(window().projects().open(folder("game")));
    ASSERT_EQ(offered_.size(), 1u);
    EXPECT_EQ(offered_[0].changes, 2u);
    EXPECT_EQ(window().project().hash(), hash);
    EXPECT_TRUE(window().isWindowModified());
    ASSERT_EQ(findJournals().size(), 1u) << "what was recovered is journaled again until it is saved";
    EXPECT_TRUE(findJournals()[0].inUse);
    EXPECT_TRUE(window().projects().save());
    EXPECT_TRUE(findJournals().empty());
}

TEST_F(RecoveryTest, WhatWasDoneToTheProjectsTreeIsRecovered)
{
    const std::uint64_t hash = crash([this] {
        ProjectTree& tree = window().projectTree();
        Scene& first = *window().project().scenes().front();
        Scene& copy = tree.duplicate(first);
        tree.rename(copy, "Level 2");
        tree.makeStart(copy);
        tree.remove(first);
        tree.undo();
        window().openScene(first);
        draw("rectangle", {10, 100}, {60, 160});
    });
    answer(RecoveryChoice::Kind::Recover);
    ASSERT_TRUE(window().projects().open(folder("game")));
    EXPECT_EQ(window().project().hash(), hash);
    EXPECT_EQ(startScene(window().project())->name(), "Level 2");
}

TEST_F(RecoveryTest, KeepForLaterOpensTheSavedProjectAndOffersAgain)
{
    const std::uint64_t hash = crash();
    answer(RecoveryChoice::Kind::Later);
    ASSERT_TRUE(window().projects().open(folder("game")));
    EXPECT_NE(window().project().hash(), hash);
    answer(RecoveryChoice::Kind::Recover);
    trigger("file.recover");
    EXPECT_EQ(window().project().hash(), hash);
}

TEST_F(RecoveryTest, DiscardForgetsTheChanges)
{
    crash();
    answer(RecoveryChoice::Kind::Discard);
    EXPECT_FALSE(window().projects().offerRecovery());
    EXPECT_EQ(offered_.size(), 1u);
    EXPECT_TRUE(findJournals().empty());
}

TEST_F(RecoveryTest, ClosingWithoutSavingIsNoCrash)
{
    draw("rectangle", {10, 10}, {60, 60});
    EXPECT_EQ(findJournals().size(), 1u);
    start();
    EXPECT_TRUE(findJournals().empty());
}

TEST_F(RecoveryTest, TheDialogNamesProjectTimeAndCountAndTellsWhatWasChosen)
{
    JournalInfo info;
    info.name = "Ball", info.project = "/games/ball/project.jet", info.changes = 12;
    info.lastChange = std::chrono::system_clock::now();
    JournalInfo untitled;
    untitled.name = "Untitled", untitled.changes = 3;
    host::RecoveryDialog dialog({info, untitled}, &window());
    dialog.show();
    auto* list = dialog.findChild<QTreeWidget*>();
    ASSERT_EQ(list->topLevelItemCount(), 2);
    EXPECT_EQ(list->topLevelItem(0)->text(0), "Ball");
    EXPECT_EQ(list->topLevelItem(0)->text(1), "12");
    EXPECT_EQ(list->topLevelItem(1)->text(3), "never saved");
    list->setCurrentItem(list->topLevelItem(1));
    if (qEnvironmentVariableIsSet("JET_TEST_PICTURES"))
        dialog.grab().save(qEnvironmentVariable("JET_TEST_PICTURES") + "/recovery.png");
    for (QPushButton* button : dialog.findChildren<QPushButton*>())
        if (button->text() == "&Discard") button->click();
    EXPECT_EQ(dialog.choice().kind, RecoveryChoice::Kind::Discard);
    EXPECT_EQ(dialog.choice().index, 1u);
}

TEST_F(RecoveryTest, AFileThatAnotherProgramChangedIsAskedAbout)
{
    draw("rectangle", {10, 10}, {60, 60});
    ASSERT_TRUE(window().projects().saveAs(folder("game")));
    const fs::path file = fs::path(folder("game")) / "scenes/Scene 0.scene";
    std::ofstream(file, std::ios::app) << "<!-- theirs -->\n";
    draw("ellipse", {100, 10}, {160, 60});
    int asked = 0;
    const auto answerWith = [&](ProjectController::Conflict conflict) {
        window().projects().setConflictQuestion([&asked, conflict](const QStringList& files) {
            EXPECT_TRUE(files.join('\n').contains("Scene 0.scene"));
            ++asked;
            return conflict;
        });
    };
    answerWith(ProjectController::Conflict::Cancel);
    EXPECT_FALSE(window().projects().save());
    answerWith(ProjectController::Conflict::KeepMine);
    EXPECT_TRUE(window().projects().save());
    EXPECT_EQ(asked, 2);
    std::ofstream(file, std::ios::app) << "<!-- theirs -->\n";
    draw("ellipse", {200, 10}, {260, 60});
    answerWith(ProjectController::Conflict::Reload);
    EXPECT_TRUE(window().projects().save());
    EXPECT_EQ(shapes().size(), 2u) << "the last ellipse is gone, as the question said";
}

TEST_F(RecoveryTest, AProjectOfAnotherEditorIsOpenedForReading)
{
    draw("rectangle", {10, 10}, {60, 60});
    ASSERT_TRUE(window().projects().saveAs(folder("game")));
    start();
    auto lock = ProjectLock::take(fs::path(folder("game")) / "project.jet");
    ASSERT_TRUE(lock && lock->isHeld());
    ASSERT_TRUE(window().projects().open(folder("game")));
    EXPECT_TRUE(window().projects().isReadOnly());
    EXPECT_TRUE(window().messages().text().contains("open in another editor"));
    lock->release();
    draw("ellipse", {100, 10}, {160, 60});
    EXPECT_TRUE(window().projects().save()) << "the other editor has closed it meanwhile";
    EXPECT_FALSE(window().projects().isReadOnly());
}

}  // namespace jet::test
