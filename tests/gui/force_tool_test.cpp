// The Force tool in the window, by the events of a mouse and a keyboard.
#include "window_fixture.hpp"

#include <QAction>
#include <QApplication>
#include <QMouseEvent>
#include <QTest>
#include <QToolBar>

namespace jet::test {

namespace {

class ForceToolInTheWindow : public WindowFixture {
protected:
    ForceToolInTheWindow()
        : WindowFixture({"org.jet.tool.rectangle", "org.jet.tool.force", "org.jet.items.physics", "org.jet.physics",
                         "org.jet.effect.in-path-rigid-body"})
    {
        draw("rectangle", {100, 100}, {200, 200});
        auto edit = scene().items().begin("Body");
        edit.addEffect(*shapes().at(0), "in-path-rigid-body");
        edit.commit();
        window().setActiveTool("force-tool");
    }
    std::vector<const Item*> forces()
    {
        std::vector<const Item*> found;
        scene().root().walk([&](const Item& item) {
            if (item.type() == "force") found.push_back(&item);
        });
        return found;
    }
    void moveTo(const QPoint& at, Qt::KeyboardModifiers modifiers = {})
    {
        QMouseEvent move(QEvent::MouseMove, at, view().mapToGlobal(at), Qt::NoButton, Qt::LeftButton, modifiers);
        QApplication::sendEvent(&view(), &move);
    }
};

TEST_F(ForceToolInTheWindow, ADragMakesAForceThatCanBeUndone)
{
    const auto before = scene().hash();
    EXPECT_EQ(view().cursor().shape(), Qt::CrossCursor);
    drag({153, 148}, {250, 150});
    ASSERT_EQ(forces().size(), 1u);
    EXPECT_EQ(forces()[0]->path().bounds().center(), Vec2(150, 150)) << "snapped to the middle";
    EXPECT_EQ(forces()[0]->property("value")->as<Vec2>(), Vec2(1000, 0));
    trigger("edit.undo");
    EXPECT_EQ(scene().hash(), before);
    trigger("edit.redo");
    EXPECT_EQ(forces().size(), 1u);
}

TEST_F(ForceToolInTheWindow, ShiftKeepsToEighthsAndAltDoesNotSnap)
{
    QTest::mousePress(&view(), Qt::LeftButton, Qt::AltModifier | Qt::ShiftModifier, {153, 148});
    moveTo({158, 48}, Qt::AltModifier | Qt::ShiftModifier);
    QTest::mouseRelease(&view(), Qt::LeftButton, Qt::AltModifier | Qt::ShiftModifier, {158, 48});
    ASSERT_EQ(forces().size(), 1u);
    EXPECT_EQ(forces()[0]->path().bounds().center(), Vec2(153, 148));
    EXPECT_EQ(forces()[0]->property("value")->as<Vec2>(), Vec2(0, -1000));
}

TEST_F(ForceToolInTheWindow, EscapeInTheMiddleOfADragLeavesNothing)
{
    const auto before = scene().hash();
    QTest::mousePress(&view(), Qt::LeftButton, {}, {150, 150});
    moveTo({250, 150});
    key(Qt::Key_Escape);
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, {250, 150});
    EXPECT_EQ(scene().hash(), before);
    EXPECT_EQ(window().activeTool(), "force-tool");
}

TEST_F(ForceToolInTheWindow, ItStandsBesideItsSiblingsInTheBar)
{
    const auto* bar = window().findChild<QToolBar*>("toolsBar");
    ASSERT_NE(bar, nullptr);
    QStringList toolTips;
    for (const QAction* button : bar->actions()) toolTips << button->toolTip();
    EXPECT_TRUE(toolTips.contains("Force (Alt+J)")) << toolTips.join(", ").toStdString();
}

}  // namespace

}  // namespace jet::test
