#include "history/history_widget.hpp"
#include "scenes/scenes_widget.hpp"
#include "window_fixture.hpp"

#include <QAbstractButton>
#include <QApplication>
#include <QDockWidget>
#include <QTest>

namespace jet::test {

class HistoryPanelTest : public WindowFixture {
protected:
    HistoryPanelTest()
    {
        draw("rectangle", {100, 100}, {150, 150});
        draw("rectangle", {200, 100}, {250, 150});
        panel_ = std::make_unique<history::HistoryWidget>(window());
        panel_->resize(250, 300);
        panel_->show();
    }
    QAbstractItemModel& model() { return *panel_->list()->model(); }
    QString text(int row) { return model().index(row, 0).data().toString(); }
    bool is(int row, int role) { return model().index(row, 0).data(role).toBool(); }
    bool eventually(const std::function<bool()>& holds) { return QTest::qWaitFor(holds, 10000); }

    std::unique_ptr<history::HistoryWidget> panel_;
};

TEST_F(HistoryPanelTest, ListsTheStepsAndFollowsTheScene)
{
    ASSERT_EQ(model().rowCount(), 3);
    EXPECT_EQ(text(1).toStdString(), "Create rectangle");
    EXPECT_TRUE(is(2, history::HistoryModel::CurrentRole));
    draw("rectangle", {300, 100}, {350, 150});
    EXPECT_TRUE(eventually([&] { return model().rowCount() == 4; }));
    scene().undoRedo().undo();
    EXPECT_TRUE(eventually([&] { return is(2, history::HistoryModel::CurrentRole); }));
    EXPECT_TRUE(is(3, history::HistoryModel::UndoneRole));
}

TEST_F(HistoryPanelTest, AClickJumps)
{
    QListView* list = panel_->list();
    const QModelIndex first = model().index(0, 0);
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualRect(first).center());
    EXPECT_EQ(scene().undoRedo().position(), 0u);
    EXPECT_TRUE(shapes().empty());
}

TEST_F(HistoryPanelTest, TheKeyboardJumps)
{
    QListView* list = panel_->list();
    QTest::keyClick(list, Qt::Key_Up);
    EXPECT_EQ(scene().undoRedo().position(), 2u) << "looking is not jumping";
    QTest::keyClick(list, Qt::Key_Return);
    EXPECT_EQ(scene().undoRedo().position(), 1u);
    QTest::keyClick(list, Qt::Key_End);
    QTest::keyClick(list, Qt::Key_Return);
    EXPECT_EQ(scene().undoRedo().position(), 2u);
}

TEST_F(HistoryPanelTest, MarksTheSavedState)
{
    scene().undoRedo().goTo(1);
    scene().undoRedo().markClean();
    ASSERT_TRUE(eventually([&] { return is(1, history::HistoryModel::SavedRole); }));
    EXPECT_EQ(text(1).toStdString(), "Create rectangle   (saved)");
    EXPECT_FALSE(is(2, history::HistoryModel::SavedRole));
}

TEST_F(HistoryPanelTest, SaysThatTheOldestStepsWereForgotten)
{
    EXPECT_TRUE(text(0).startsWith("As opened")) << text(0).toStdString();
    scene().undoRedo().setMemoryLimit(1);
    ASSERT_TRUE(eventually([&] { return model().rowCount() == 2; }));
    EXPECT_TRUE(text(0).contains("forgotten")) << text(0).toStdString();
}

TEST_F(HistoryPanelTest, AJumpDuringADragIsRefusedWithAReason)
{
    auto edit = scene().items().begin("Drag");
    edit.transform(*shapes().front(), Affine::translation({1, 0}));
    QTest::keyClick(panel_->list(), Qt::Key_Home);
    QTest::keyClick(panel_->list(), Qt::Key_Return);
    EXPECT_EQ(scene().undoRedo().position(), 2u);
    EXPECT_TRUE(edit.isOpen());
}

/// Both panels docked in the window, as a user has them.
class HistoriesTest : public WindowFixture {
protected:
    HistoriesTest()
    {
        draw("rectangle", {100, 100}, {150, 150});
        tree().addFilter("Levels", window().project().root());
        tree().renameProject("Game");
        history_ = new history::HistoryWidget(window());
        scenes_ = new scenes::ScenesWidget(window());
        const std::pair<const char*, QWidget*> panels[] = {{"history-of-the-test", history_},
                                                           {"scenes-of-the-test", scenes_}};
        for (const auto& [name, panel] : panels) {
            auto* dock = new QDockWidget(&window());
            dock->setObjectName(name);
            dock->setWidget(panel);
            window().addDockWidget(Qt::RightDockWidgetArea, dock);
            dock->show();
        }
        window().activateWindow();
        view().setFocus();
        QTest::qWait(1);
    }
    ~HistoriesTest() override
    {
        delete history_;
        delete scenes_;
    }

    ProjectTree& tree() { return window().projectTree(); }
    std::string row(int index) { return history_->list()->model()->index(index, 0).data().toString().toStdString(); }
    int rows() { return QApplication::processEvents(), history_->list()->model()->rowCount(); }
    int tab() { return QApplication::processEvents(), history_->tabs()->currentIndex(); }
    std::string next() { return QApplication::processEvents(), history_->next()->text().toStdString(); }
    void clickTab(int tab)
    {
        QTabBar* tabs = history_->tabs();
        QTest::mouseClick(tabs, Qt::LeftButton, {}, tabs->tabRect(tab).center());
    }
    void clickRow(int index)
    {
        QListView* list = history_->list();
        QTest::mouseClick(list->viewport(), Qt::LeftButton, {},
                          list->visualRect(list->model()->index(index, 0)).center());
    }
    static void press(QKeySequence::StandardKey keys)
    {
        QTest::keySequence(QApplication::focusWidget(), QKeySequence(keys));
        QApplication::processEvents();
    }

    history::HistoryWidget* history_ = nullptr;
    scenes::ScenesWidget* scenes_ = nullptr;
};

TEST_F(HistoriesTest, TheTabsChooseTheSceneOrTheProjectAndTheirStepsAreJumpedIn)
{
    EXPECT_EQ(rows(), 2);
    EXPECT_EQ(next(), "Undo takes back: Create rectangle");
    clickTab(1);
    ASSERT_EQ(rows(), 3);
    EXPECT_EQ(row(1), "Add filter Levels");
    EXPECT_EQ(next(), "Undo takes back: Rename project");
    clickRow(0);
    EXPECT_TRUE(window().project().root().filters.empty());
    EXPECT_NE(window().project().name(), "Game");
    EXPECT_EQ(next(), "Nothing to undo here");
    clickRow(2);
    EXPECT_EQ(window().project().name(), "Game");
    EXPECT_EQ(shapes().size(), 1u) << "the scene has a history of its own";
    clickTab(0);
    EXPECT_EQ(rows(), 2);
    EXPECT_EQ(history_->tabs()->tabText(0).toStdString(), scene().name());
}

TEST_F(HistoriesTest, CtrlZWorksOnTheHistoryThatIsShown)
{
    clickTab(1);
    press(QKeySequence::Undo);
    EXPECT_NE(window().project().name(), "Game");
    EXPECT_EQ(shapes().size(), 1u);
    EXPECT_EQ(next(), "Undo takes back: Add filter Levels");
    clickTab(0);
    press(QKeySequence::Undo);
    EXPECT_TRUE(shapes().empty());
    EXPECT_EQ(window().project().root().filters.size(), 1u);
    press(QKeySequence::Redo);
    EXPECT_EQ(shapes().size(), 1u);
}

TEST_F(HistoriesTest, ThePanelFollowsTheFocusToTheScenesPanelAndBack)
{
    scenes_->rows().setFocus();
    EXPECT_EQ(tab(), 1);
    EXPECT_EQ(next(), "Undo takes back: Rename project");
    view().setFocus();
    EXPECT_EQ(tab(), 0);
    EXPECT_EQ(next(), "Undo takes back: Create rectangle");
}

TEST_F(HistoriesTest, AScriptAddedInTheScenesPanelIsAStepOfItsScene)
{
    scenes_->rows().setFocus();
    scenes_->rows().makeCurrent(
        {scenes::Row::Kind::Scene, &window().project().root(), window().project().scenes().front(), {}, {}});
    ASSERT_EQ(tab(), 1);
    auto* button = scenes_->findChild<QAbstractButton*>("New script");
    ASSERT_NE(button, nullptr);
    QTest::mouseClick(button, Qt::LeftButton);
    EXPECT_EQ(tab(), 0) << "the focus stayed, what Undo works on did not";
    EXPECT_EQ(next(), "Undo takes back: Add script");
}

TEST_F(HistoriesTest, ASceneThatIsUndoneAwayLeavesTheProjectsHistoryShown)
{
    window().openScene(tree().addScene("Level 2", window().project().root()));
    clickTab(1);
    ASSERT_EQ(rows(), 4);
    clickRow(2);  // the front scene goes
    EXPECT_EQ(window().project().scenes().size(), 1u);
    EXPECT_EQ(tab(), 1);
    EXPECT_EQ(rows(), 4);
    clickRow(3);
    EXPECT_NE(window().project().scene("Level 2"), nullptr);
}

TEST_F(HistoriesTest, AnotherProjectStartsWithItsOwn)
{
    clickTab(1);
    window().projects().create();
    QApplication::processEvents();
    EXPECT_EQ(rows(), 1);
    EXPECT_EQ(next(), "Nothing to undo here");
}

}  // namespace jet::test
