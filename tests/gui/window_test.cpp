#include "window_fixture.hpp"

#include <QApplication>
#include <QLabel>
#include <QTest>
#include <QToolBar>
#include <QWheelEvent>

namespace jet::test {

using WindowTest = WindowFixture;

TEST_F(WindowTest, StartsWithOneEmptySceneAndNothingToSave)
{
    EXPECT_EQ(window().documents().count(), 1);
    EXPECT_TRUE(shapes().empty());
    EXPECT_FALSE(isEnabled("edit.undo"));
    EXPECT_TRUE(window().messages().text().isEmpty());
}

TEST_F(WindowTest, TheToolBarIsMadeFromTheContributionsAndNamesTheKeys)
{
    const auto* bar = window().findChild<QToolBar*>("toolsBar");
    ASSERT_NE(bar, nullptr);
    QStringList toolTips;
    for (const QAction* button : bar->actions()) toolTips << button->toolTip();
    EXPECT_TRUE(toolTips.contains("Rectangle (M)")) << toolTips.join(", ").toStdString();
}

TEST_F(WindowTest, ADragWithTheRectangleToolMakesOneShapeWhereItWasDrawn)
{
    draw("rectangle", {100, 120}, {200, 180});
    ASSERT_EQ(shapes().size(), 1u);
    EXPECT_EQ(shapes().front()->bounds(), Box({100, 120}, {200, 180}));
    EXPECT_TRUE(window().isWindowModified());
}

TEST_F(WindowTest, UndoAndRedoThroughTheirActionsAreExact)
{
    const std::uint64_t empty = scene().hash();
    draw("ellipse", {100, 100}, {180, 180});
    const std::uint64_t drawn = scene().hash();
    trigger("edit.undo");
    EXPECT_EQ(scene().hash(), empty);
    trigger("edit.redo");
    EXPECT_EQ(scene().hash(), drawn);
}

TEST_F(WindowTest, ASingleKeyPicksATool)
{
    key(Qt::Key_M);
    EXPECT_EQ(window().activeTool(), "rectangle");
}

TEST_F(WindowTest, EscapeReturnsToTheFirstToolThenClearsTheSelection)
{
    const std::string first = window().activeTool();
    draw("rectangle", {10, 10}, {60, 60});
    ASSERT_FALSE(scene().items().selection().empty());
    key(Qt::Key_Escape);
    EXPECT_EQ(window().activeTool(), first);
    EXPECT_FALSE(scene().items().selection().empty());
    key(Qt::Key_Escape);
    EXPECT_TRUE(scene().items().selection().empty());
}

TEST_F(WindowTest, EscapeInTheMiddleOfADragLeavesNothing)
{
    const std::uint64_t empty = scene().hash();
    window().setActiveTool("rectangle");
    QTest::mousePress(&view(), Qt::LeftButton, {}, {50, 50});
    QMouseEvent move(QEvent::MouseMove, QPoint(90, 90), view().mapToGlobal(QPoint(90, 90)), Qt::NoButton,
                     Qt::LeftButton, {});
    QApplication::sendEvent(&view(), &move);
    key(Qt::Key_Escape);
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, {90, 90});
    EXPECT_EQ(scene().hash(), empty);
    EXPECT_EQ(window().activeTool(), "rectangle");
}

TEST_F(WindowTest, TheWheelZoomsAboutThePointer)
{
    const QPointF pointer(300, 200);
    const Vec2 under = view().camera().toScene({300, 200});
    QWheelEvent wheel(pointer, view().mapToGlobal(pointer), {}, {0, 360}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view(), &wheel);
    EXPECT_NEAR(view().camera().view().scale, 1.2 * 1.2 * 1.2, 1e-9);
    EXPECT_NEAR((view().camera().toScene({300, 200}) - under).norm(), 0, 1e-9);
}

TEST_F(WindowTest, RightAndMiddleDragsPanAndDrawNothing)
{
    window().setActiveTool("rectangle");
    drag({100, 100}, {140, 130}, Qt::RightButton);
    EXPECT_EQ(view().camera().view().anchor, Vec2(-40, -30));
    drag({140, 130}, {100, 100}, Qt::MiddleButton);
    EXPECT_EQ(view().camera().view().anchor, Vec2(0, 0));
    EXPECT_TRUE(shapes().empty());
}

TEST_F(WindowTest, SpaceHeldMakesALeftDragPan)
{
    window().setActiveTool("rectangle");
    QTest::keyPress(&view(), Qt::Key_Space);
    drag({100, 100}, {150, 100});
    QTest::keyRelease(&view(), Qt::Key_Space);
    EXPECT_EQ(view().camera().view().anchor, Vec2(-50, 0));
    EXPECT_TRUE(shapes().empty());
}

TEST_F(WindowTest, MessagesAreShownInWordsAndRepeatsAreCounted)
{
    window().showMessage("The disk is full.");
    window().showMessage("The disk is full.");
    EXPECT_TRUE(window().messages().isVisibleTo(&window()));
    bool counted = false;
    for (const QLabel* label : window().messages().findChildren<QLabel*>())
        counted = counted || label->text().contains("2 times");
    EXPECT_TRUE(counted);
}

/// Fails where a plugin would: half-way through its own transaction.
class ThrowingTool final : public Tool {
public:
    using Tool::Tool;
    void press(const PointerEvent&) override
    {
        auto edit = host().items().begin("Half done");
        edit.add<ShapeItem>(host().insertionPoint(edit), Path::rectangle(Box({0, 0}, {1, 1})));
        throw Failure(Error("out of ideas"));
    }
};

TEST_F(WindowTest, AToolThatThrowsLeavesTheSceneAsItWasAndIsNamed)
{
    catalog().inCode().tool<ThrowingTool>("throwing");
    start();
    const std::uint64_t before = scene().hash();
    draw("throwing", {10, 10}, {20, 20});
    EXPECT_EQ(scene().hash(), before);
    EXPECT_TRUE(window().messages().text().contains("throwing"));
    EXPECT_TRUE(window().messages().text().contains("out of ideas"));
    draw("rectangle", {10, 10}, {60, 60});
    EXPECT_EQ(shapes().size(), 1u);
}

}  // namespace jet::test
