#include "history/history_widget.hpp"
#include "window_fixture.hpp"

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

}  // namespace jet::test
