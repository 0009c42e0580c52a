#include "window_fixture.hpp"

#include <jet/ui/property_editor.hpp>

#include <QApplication>
#include <QClipboard>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QMimeData>
#include <QStatusBar>
#include <QTemporaryDir>
#include <QTest>
#include <QToolBar>
#include <QToolButton>

#include <algorithm>

namespace jet::test {

class EditTest : public WindowFixture {
protected:
    EditTest()
    {
        draw("rectangle", {100, 100}, {150, 150});
        draw("rectangle", {200, 100}, {250, 150});
        before_ = scene().hash();
    }
    /// Every command is one step: undoing it once gives the scene back bit for bit.
    void expectOneStep()
    {
        EXPECT_NE(scene().hash(), before_);
        trigger("edit.undo");
        EXPECT_EQ(scene().hash(), before_);
    }

    std::uint64_t before_;
};

TEST_F(EditTest, DeleteTakesTheSelectionAwayInOneStep)
{
    trigger("edit.select-all");
    key(Qt::Key_Delete);
    EXPECT_TRUE(shapes().empty());
    expectOneStep();
}

TEST_F(EditTest, DuplicatePutsSelectedCopiesBesideTheirOriginals)
{
    trigger("edit.select-all");
    trigger("edit.duplicate");
    ASSERT_EQ(shapes().size(), 4u);
    EXPECT_EQ(scene().items().selection().size(), 2u);
    for (const ItemId id : scene().items().selection())
        EXPECT_NE(scene().items().find(id)->bounds().min, Vec2(100, 100));
    expectOneStep();
}

TEST_F(EditTest, WhatIsCopiedCanBePastedIntoAnotherProject)
{
    trigger("edit.select-all");
    trigger("edit.copy");
    EXPECT_EQ(scene().hash(), before_);
    window().projects().create();
    trigger("edit.paste");
    ASSERT_EQ(shapes().size(), 2u);
    EXPECT_EQ(shapes().front()->effects().size(), 1u);
}

TEST_F(EditTest, PastingInPlacePutsTheCopiesWhereTheirOriginalsWere)
{
    trigger("edit.select-all");
    trigger("edit.copy");
    trigger("edit.paste-in-place");
    ASSERT_EQ(shapes().size(), 4u);
    EXPECT_EQ(shapes()[0]->path(), shapes()[2]->path());
    EXPECT_EQ(shapes()[1]->path(), shapes()[3]->path());
    expectOneStep();
}

TEST_F(EditTest, ItemsThatCameAsPlainTextArePasted)
{
    trigger("edit.select-all");
    trigger("edit.copy");
    const QString text = QApplication::clipboard()->text();
    ASSERT_TRUE(text.contains("<scene"));
    QApplication::clipboard()->setText("  " + text + "\n");
    trigger("edit.paste");
    EXPECT_EQ(shapes().size(), 4u);
    QApplication::clipboard()->setText("a <scene of other words");
    trigger("edit.paste");
    EXPECT_EQ(shapes().size(), 4u);
}

TEST_F(EditTest, CutAndPasteKeepTheShape)
{
    const Path path = shapes().back()->path();
    trigger("edit.cut");
    ASSERT_EQ(shapes().size(), 1u);
    trigger("edit.paste");
    ASSERT_EQ(shapes().size(), 2u);
    EXPECT_EQ(shapes().back()->path(), path.transformed(Affine::translation({10, 10})));
}

TEST_F(EditTest, ItemsKeptByAnEditorThatHasQuitArePastedWhileTheClipboardIsEmpty)
{
    QTemporaryDir session;
    const QByteArray before = qgetenv("XDG_RUNTIME_DIR");
    qputenv("XDG_RUNTIME_DIR", session.path().toUtf8());
    trigger("edit.select-all");
    trigger("edit.copy");
    // As keepClipboard() does where a clipboard is its program's; that of this platform is nobody's.
    QDir(session.path()).mkdir("jet");
    QFile kept(session.path() + "/jet/clipboard.xml");
    ASSERT_TRUE(kept.open(QFile::WriteOnly));
    kept.write(QApplication::clipboard()->text().toUtf8());
    kept.close();
    QApplication::clipboard()->clear();  // as X11 does when the editor has gone
    trigger("edit.paste");
    EXPECT_EQ(shapes().size(), 4u);
    QApplication::clipboard()->setText("copied since, elsewhere");
    trigger("edit.paste");
    EXPECT_EQ(shapes().size(), 4u) << "what another program put there counts";
    before.isNull() ? qunsetenv("XDG_RUNTIME_DIR") : qputenv("XDG_RUNTIME_DIR", before);
}

TEST_F(EditTest, PasteOfAForeignClipboardDoesNothing)
{
    QApplication::clipboard()->setText("not a scene");
    trigger("edit.paste");
    EXPECT_EQ(scene().hash(), before_);
}

TEST_F(EditTest, GroupAndUngroupKeepTheOrderOfTheMembers)
{
    const std::vector<const Item*> members = shapes();
    trigger("edit.select-all");
    trigger("edit.group");
    EXPECT_TRUE(members.front()->parent()->is<GroupItem>());
    EXPECT_EQ(shapes(), members);
    trigger("edit.ungroup");
    EXPECT_TRUE(members.front()->parent()->is<LayerItem>());
    EXPECT_EQ(shapes(), members);
    trigger("edit.undo");
    expectOneStep();
}

TEST_F(EditTest, ArrowKeysNudgeAndManyNudgesAreOneStep)
{
    window().setActiveTool("rectangle");  // a tool that has no use for arrows
    const Vec2 corner = shapes().back()->bounds().min;
    key(Qt::Key_Right);
    key(Qt::Key_Right);
    key(Qt::Key_Down, Qt::ShiftModifier);
    EXPECT_EQ(shapes().back()->bounds().min, corner + Vec2(2, 10));
    expectOneStep();
}

TEST_F(EditTest, NewShapesGoIntoTheLayerOfTheSelection)
{
    auto edit = scene().items().begin("Add layer");
    const Item& upper = edit.add<LayerItem>(scene().root());
    edit.select(upper);
    edit.commit();
    draw("rectangle", {300, 300}, {340, 340});
    EXPECT_EQ(shapes().back()->parent(), &upper);
}

TEST_F(EditTest, WithoutAnyLayerDrawingMakesOneInTheSameStep)
{
    auto edit = scene().items().begin("Remove all");
    while (!scene().root().children().empty()) edit.remove(*scene().root().children().front());
    edit.commit();
    before_ = scene().hash();
    draw("rectangle", {300, 300}, {340, 340});
    ASSERT_EQ(shapes().size(), 1u);
    EXPECT_TRUE(shapes().front()->parent()->is<LayerItem>());
    expectOneStep();
}

TEST_F(EditTest, ApplyingAnEffectToTheSelectionIsOneStep)
{
    trigger("edit.select-all");
    window().edits().applyEffect("polygon-face");
    EXPECT_EQ(shapes().front()->effects().size(), 2u);
    expectOneStep();
}

class TextEditingTest : public WindowFixture {
protected:
    TextEditingTest() : WindowFixture({"org.jet.tool.selection", "org.jet.tool.rectangle", "org.jet.tool.text"}) {}
    ~TextEditingTest() override { QApplication::clipboard()->clear(); }

    void type(const QPoint& at, const char* text)
    {
        window().setActiveTool("text-tool");
        view().setFocus();
        QTest::mouseClick(&view(), Qt::LeftButton, {}, at);
        QTest::keyClicks(&view(), text);
    }
    std::vector<const Item*> texts()
    {
        std::vector<const Item*> found;
        scene().root().walk([&](const Item& item) {
            if (item.is<TextItem>()) found.push_back(&item);
        });
        return found;
    }
    std::string text() { return texts().at(0)->property("text")->as<std::string>(); }
    std::string status()
    {
        std::string all;
        for (const QLabel* label : window().statusBar()->findChildren<QLabel*>()) all += label->text().toStdString();
        return all;
    }
};

TEST_F(TextEditingTest, WhileTypingCtrlIsForLettersAndElsewhereForItems)
{
    type({200, 200}, "Hello");
    key(Qt::Key_A, Qt::ControlModifier);
    key(Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(QApplication::clipboard()->text(), "Hello");
    EXPECT_FALSE(QApplication::clipboard()->mimeData()->hasFormat("application/x-jet-scene+xml"));
    key(Qt::Key_End);
    key(Qt::Key_V, Qt::ControlModifier);
    EXPECT_EQ(text(), "HelloHello");
    EXPECT_EQ(texts().size(), 1u);
    key(Qt::Key_Escape);
    key(Qt::Key_C, Qt::ControlModifier);
    EXPECT_TRUE(QApplication::clipboard()->mimeData()->hasFormat("application/x-jet-scene+xml"));
    key(Qt::Key_V, Qt::ControlModifier);
    EXPECT_EQ(texts().size(), 2u);
}

TEST_F(TextEditingTest, CtrlZTakesBackAllThatWasTyped)
{
    type({200, 200}, "Hello");
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(texts().empty());
    key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(text(), "Hello");
}

TEST_F(TextEditingTest, ADoubleClickOnTextGoesOnInTheTextToolAtThatPlace)
{
    type({200, 200}, "Hello");
    key(Qt::Key_Escape);
    window().setActiveTool("selection");
    const Box box = texts().at(0)->bounds();
    QTest::mouseDClick(&view(), Qt::LeftButton, {}, QPoint(int(box.max.x()) - 1, int(box.center().y())));
    QApplication::processEvents();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window().activeTool() == "text-tool"; }, 10000));
    QTest::keyClicks(&view(), "!");
    EXPECT_EQ(text(), "Hello!");
}

TEST_F(TextEditingTest, ADoubleClickOnAShapeSaysThatNoToolEditsItsPoints)
{
    draw("rectangle", {100, 100}, {200, 200});
    window().setActiveTool("selection");
    QTest::mouseDClick(&view(), Qt::LeftButton, {}, QPoint(100, 150));
    QApplication::processEvents();
    EXPECT_EQ(window().activeTool(), "selection");
    EXPECT_NE(status().find("No tool that edits the points of a path"), std::string::npos) << status();
}

TEST_F(TextEditingTest, OptionsThatDoNotFitAreBelowTheOverflowButtonOfTheirBar)
{
    window().setActiveTool("text-tool");
    auto* bar = window().findChild<QToolBar*>("toolOptionsBar");
    auto* more = bar->findChild<QToolButton*>("qt_toolbar_ext_button");
    ASSERT_NE(more, nullptr);
    window().resize(1900, 700);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !more->isVisible(); }, 10000));
    const auto shown = [&] {
        const auto widgets = bar->findChildren<QWidget*>();
        return std::ranges::count_if(
            widgets, [](QWidget* one) { return dynamic_cast<ui::PropertyForm*>(one) && one->isVisible(); });
    };
    EXPECT_EQ(shown(), 4);
    window().resize(760, 700);
    ASSERT_TRUE(QTest::qWaitFor([&] { return more->isVisible(); }, 10000));
    EXPECT_LT(shown(), 4);
    EXPECT_GT(shown(), 0) << "what fits is there";
}

}  // namespace jet::test
