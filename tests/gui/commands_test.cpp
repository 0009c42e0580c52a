// The menu commands of plugins, as a user reaches them.
#include "window_fixture.hpp"

#include "fixtures/fakes.hpp"

#include <jet/arrange.hpp>

#include <QMenuBar>

namespace jet::test {

class CommandsTest : public WindowFixture {
protected:
    CommandsTest()
        : WindowFixture({"org.jet.tool.selection", "org.jet.tool.rectangle", "org.jet.effect.polygon-face",
                         "org.jet.command.arrange"})
    {
        draw("rectangle", {100, 100}, {150, 150});
        draw("rectangle", {220, 180}, {250, 190});
        before_ = scene().hash();
    }
    /// Opens the menu of a path like "Arrange/Align" as a user would, and returns its entry.
    QAction* entry(const QString& path, const QString& text)
    {
        QMenu* menu = host::Actions::menuAt(*window().menuBar(), path);
        emit menu->aboutToShow();
        for (QAction* action : menu->actions()) {
            if (action->text() == text) return action;
        }
        ADD_FAILURE() << "no entry " << text.toStdString();
        return nullptr;
    }

    std::uint64_t before_ = 0;
};

TEST_F(CommandsTest, AreInTheMenusTheirManifestsName)
{
    EXPECT_TRUE(entry("Arrange", "Bring to front"));
    EXPECT_EQ(entry("Arrange", "Bring forward")->shortcut(), QKeySequence("Ctrl+]"));
}

TEST_F(CommandsTest, AreEnabledWhereTheyMakeSense)
{
    scene().items().setSelection({shapes().front()->id()});
    EXPECT_FALSE(entry("Arrange/Align", "Align left")->isEnabled());
    EXPECT_TRUE(entry("Arrange", "Flip vertically")->isEnabled());
    trigger("edit.select-all");
    EXPECT_TRUE(entry("Arrange/Align", "Align left")->isEnabled());
    EXPECT_FALSE(entry("Arrange/Distribute", "Make vertical gaps equal")->isEnabled());
}

TEST_F(CommandsTest, RunAsOneUndoStep)
{
    trigger("edit.select-all");
    entry("Arrange/Align", "Align left")->trigger();
    EXPECT_EQ(shapes()[0]->bounds().min.x(), shapes()[1]->bounds().min.x());
    EXPECT_EQ(scene().undoRedo().undoLabel(), "Align left");
    trigger("edit.undo");
    EXPECT_EQ(scene().hash(), before_);
}

TEST_F(CommandsTest, AShortcutOfACommandThatMakesNoSenseDoesNothing)
{
    scene().items().setSelection({});
    window().findChild<host::CommandController*>()->run("bring-to-front");
    EXPECT_EQ(scene().hash(), before_);
}

TEST_F(CommandsTest, DoNotChangeASceneThatPlays)
{
    catalog().inCode().physicsEngine<FallingEngine>("falling");
    trigger("edit.select-all");
    trigger("play.play");
    ASSERT_NE(window().simulation().state(), SimulationCenter::State::Stopped);
    window().findChild<host::CommandController*>()->run("flip-horizontal");
    trigger("play.stop");
    EXPECT_EQ(scene().hash(), before_);
}

}  // namespace jet::test
