#include "window_fixture.hpp"

#include <QApplication>
#include <QClipboard>
#include <QMimeData>

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

}  // namespace jet::test
