#include "find_widget.hpp"
#include "window_fixture.hpp"

#include <QTest>

namespace jet::test {

class FindPanelTest : public WindowFixture {
protected:
    FindPanelTest()
    {
        draw("rectangle", {100, 100}, {150, 150});
        draw("rectangle", {200, 100}, {250, 150});
        auto edit = scene().items().begin("Name");
        edit.set(*shapes()[0], "name", "Ball");
        edit.set(*shapes()[1], "name", "Wall");
        edit.commit();
        scene().items().setSelection({});
        panel_ = std::make_unique<find::FindWidget>(window());
        panel_->resize(250, 300);
        panel_->show();
    }
    QLineEdit* line() { return panel_->findChild<QLineEdit*>("find-query"); }
    QAbstractItemModel& model() { return *panel_->findChild<QListView*>("find-results")->model(); }
    std::string note() { return panel_->findChild<QLabel*>("find-note")->text().toStdString(); }
    bool eventually(const std::function<bool()>& holds) { return QTest::qWaitFor(holds, 10000); }

    std::unique_ptr<find::FindWidget> panel_;
};

TEST_F(FindPanelTest, ResultsFollowTheQueryAndTheScene)
{
    QTest::keyClicks(line(), "type:shape");
    EXPECT_EQ(model().rowCount(), 2);
    EXPECT_EQ(note(), "2 found");
    QTest::keyClicks(line(), " ball");
    ASSERT_EQ(model().rowCount(), 1);
    EXPECT_EQ(model().index(0, 0).data().toString(), "Ball");
    auto edit = scene().items().begin("Rename");
    edit.set(*shapes()[1], "name", "Second ball");
    edit.commit();
    EXPECT_TRUE(eventually([&] { return model().rowCount() == 2; }));
}

TEST_F(FindPanelTest, EnterGoesFromOneToTheNextAndShowsIt)
{
    QTest::keyClicks(line(), "*all");
    QTest::keyClick(line(), Qt::Key_Return);
    EXPECT_TRUE(scene().items().isSelected(shapes()[0]->id()));
    const Vec2 centre = view().camera().toPixels(shapes()[0]->bounds().center());
    EXPECT_NEAR(centre.x(), 0.5 * view().width(), 1);
    EXPECT_NEAR(centre.y(), 0.5 * view().height(), 1);
    QTest::keyClick(line(), Qt::Key_Return);
    EXPECT_TRUE(scene().items().isSelected(shapes()[1]->id()));
    QTest::keyClick(line(), Qt::Key_Return, Qt::ShiftModifier);
    EXPECT_TRUE(scene().items().isSelected(shapes()[0]->id()));
    QTest::keyClick(line(), Qt::Key_Return, Qt::ControlModifier);
    EXPECT_EQ(scene().items().selection().size(), 2u);
}

TEST_F(FindPanelTest, AnErrorIsToldWithItsColumn)
{
    QTest::keyClicks(line(), "ball mass>heavy");
    EXPECT_EQ(model().rowCount(), 0);
    EXPECT_EQ(note(), "Column 11: \"heavy\" is not a number; compare text with \":\".");
}

}  // namespace jet::test
