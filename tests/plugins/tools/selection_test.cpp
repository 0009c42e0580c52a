#include "selection_fixture.hpp"
#include "support/recording_painter.hpp"

#include <numbers>
#include <random>

namespace {

using jet::Box;
using jet::Item;
using jet::Vec2;
using jet::test::RecordingPainter;
using jet::test::SelectionToolTest;
using Items = std::vector<const Item*>;

const Item& groupOf(jet::ItemsCenter& items, const Items& members)
{
    auto edit = items.begin("Group");
    const Item& group = edit.add<jet::GroupItem>(*members.front()->parent());
    for (const Item* member : members) edit.move(*member, group, group.children().size());
    edit.commit();
    return group;
}

// --- Selecting ---

TEST_F(SelectionToolTest, AClickSelectsTheTopMostItemThere)
{
    select().click({30, 20});
    EXPECT_EQ(selected(), Items{&over});
    select().click({10, 20});
    EXPECT_EQ(selected(), Items{&left});
}

TEST_F(SelectionToolTest, AClickWithinFivePixelsOfAnOutlineCounts)
{
    host().scale = 10;  // five pixels are half a unit
    select().click({240.4, 20});
    EXPECT_EQ(selected(), Items{&right});
    select().click({241, 20});
    EXPECT_TRUE(selected().empty());
}

TEST_F(SelectionToolTest, AClickOnEmptyClears)
{
    select().click({10, 20}).click({120, 120});
    EXPECT_TRUE(selected().empty());
}

TEST_F(SelectionToolTest, ShiftClickTogglesAndShiftClickOnEmptyKeeps)
{
    select().click({10, 20}).hold({.shift = true}).click({220, 20});
    EXPECT_EQ(selected(), (Items{&left, &right}));
    select().click({220, 20});
    EXPECT_EQ(selected(), Items{&left});
    select().click({120, 120});
    EXPECT_EQ(selected(), Items{&left});
}

TEST_F(SelectionToolTest, AClickOnOneOfSeveralSelectsItAlone)
{
    items().setSelection({left.id(), right.id()});
    select().click({220, 20});
    EXPECT_EQ(selected(), Items{&right});
}

TEST_F(SelectionToolTest, ARubberBandSelectsWhatLiesWhollyInIt)
{
    select().drag({-20, 80}, {70, -10});  // upwards, around left and over
    EXPECT_EQ(selected(), (Items{&left, &over}));
    select().drag({-20, 80}, {50, -10});  // cuts through over
    EXPECT_EQ(selected(), Items{&left});
    select().hold({.shift = true}).drag({190, 80}, {250, -10});
    EXPECT_EQ(selected(), (Items{&left, &right}));
    EXPECT_EQ(undoSteps(), 3u) << "selecting is no undo step";
}

TEST_F(SelectionToolTest, EscBringsTheSelectionBeforeTheRubberBandBack)
{
    items().setSelection({right.id()});
    select().press({-20, 80}).move({70, -10});
    EXPECT_EQ(selected(), (Items{&left, &over})) << "shown while dragging";
    select().key("Escape").release();
    EXPECT_EQ(selected(), Items{&right});
}

TEST_F(SelectionToolTest, LockedAndHiddenItemsAreNotSelected)
{
    auto edit = items().begin("Lock");
    edit.set(over, "locked", true);
    edit.set(right, "visible", false);
    edit.commit();
    select().click({30, 20});
    EXPECT_EQ(selected(), Items{&left});
    select().drag({-20, 80}, {300, -10});
    EXPECT_EQ(selected(), Items{&left});
}

TEST_F(SelectionToolTest, EscClearsTheSelection)
{
    select().click({10, 20}).key("Escape");
    EXPECT_TRUE(select().used());
    EXPECT_TRUE(selected().empty());
    select().key("Escape");
    EXPECT_FALSE(select().used());
}

// --- Groups ---

TEST_F(SelectionToolTest, AClickOnAMemberSelectsTheOutermostGroupBelowTheLayer)
{
    const Item& layer = add("layer", {});
    const Item& inLayer = addRectangle(Box({0, 100}, {40, 140}), &layer);
    const Item& inner = groupOf(items(), {&inLayer});
    const Item& outer = groupOf(items(), {&inner});
    ASSERT_EQ(outer.parent(), &layer);
    select().click({20, 120});
    EXPECT_EQ(selected(), Items{&outer});
    select().hold({.control = true}).click({20, 120});
    EXPECT_EQ(selected(), Items{&inLayer}) << "Ctrl reaches through";
}

TEST_F(SelectionToolTest, ADoubleClickEntersAGroupAndEscLeavesIt)
{
    const Item& group = groupOf(items(), {&left, &over});
    select().doubleClick({10, 20});
    EXPECT_EQ(selected(), Items{&left});
    select().click({50, 20});
    EXPECT_EQ(selected(), Items{&over}) << "still inside";
    select().key("Escape");
    EXPECT_EQ(selected(), Items{&group});
    select().click({50, 20});
    EXPECT_EQ(selected(), Items{&group}) << "outside again";
}

TEST_F(SelectionToolTest, ADoubleClickOnASingleItemEditsItsNodes)
{
    select().doubleClick({220, 20});
    EXPECT_EQ(selected(), Items{&right});
    EXPECT_EQ(host().wantedTool, "direct-selection");
}

TEST_F(SelectionToolTest, AClickElsewhereLeavesTheGroup)
{
    const Item& group = groupOf(items(), {&left, &over});
    select().doubleClick({10, 20}).click({220, 20});
    EXPECT_EQ(selected(), Items{&right});
    select().click({10, 20});
    EXPECT_EQ(selected(), Items{&group});
}

TEST_F(SelectionToolTest, ARubberBandTakesAGroupWhenAllOfItLiesInside)
{
    const Item& group = groupOf(items(), {&left, &right});
    select().drag({-20, 80}, {100, -10});
    EXPECT_EQ(selected(), Items{&over});
    select().drag({-20, 80}, {300, -10});
    EXPECT_EQ(selected(), (Items{&over, &group}));
}

TEST_F(SelectionToolTest, ARubberBandInAnEnteredGroupSelectsItsMembers)
{
    groupOf(items(), {&left, &right});
    select().doubleClick({10, 20}).drag({-20, 80}, {300, -10});
    EXPECT_EQ(selected(), (Items{&left, &right}));
    select().click({120, 120}).drag({190, 80}, {300, -10});
    EXPECT_TRUE(selected().empty()) << "a click on empty ground left the group";
}

// --- Moving ---

TEST_F(SelectionToolTest, ADragOnAnItemSelectsAndMovesItInOneStep)
{
    const auto before = scene().hash();
    select().drag({220, 20}, {230, 25});
    EXPECT_EQ(selected(), Items{&right});
    EXPECT_EQ(right.bounds(), Box({210, 5}, {250, 45}));
    EXPECT_EQ(undoSteps(), 4u);
    undo();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(SelectionToolTest, ADragOnOneOfSeveralMovesThemAll)
{
    items().setSelection({left.id(), right.id()});
    select().drag({220, 20}, {220, 50});
    EXPECT_EQ(left.bounds(), Box({0, 30}, {40, 70}));
    EXPECT_EQ(right.bounds(), Box({200, 30}, {240, 70}));
    EXPECT_EQ(over.bounds(), Box({20, 0}, {60, 40}));
}

TEST_F(SelectionToolTest, AGroupAndItsMemberMoveOnce)  // both can be selected in the Layers panel
{
    const Item& group = groupOf(items(), {&right});
    items().setSelection({group.id(), right.id()});
    select().drag({220, 20}, {230, 20});
    EXPECT_EQ(right.bounds(), Box({210, 0}, {250, 40}));
}

TEST_F(SelectionToolTest, ALongDragEndsWhereAStraightOneWouldBitForBit)
{
    select().press({220, 20});
    for (int i = 0; i < 1000; ++i) select().move({220 + 30 * std::sin(0.1 * i), 20 + 0.1 * i});
    select().move({220.3, 20.7}).release();
    EXPECT_EQ(right.path(), jet::Path::rectangle(Box({200, 0}, {240, 40}))
                                .transformed(jet::Affine::translation(Vec2(220.3, 20.7) - Vec2(220, 20))));
    EXPECT_EQ(undoSteps(), 4u);
}

TEST_F(SelectionToolTest, AShakyClickMovesNothing)
{
    select().press({220, 20}).move({221, 21}).release();
    EXPECT_EQ(undoSteps(), 3u);
    EXPECT_EQ(selected(), Items{&right});
}

TEST_F(SelectionToolTest, ADragThereAndBackIsNoStep)
{
    select().press({220, 20}).move({250, 20}).move({220, 20}).release();
    EXPECT_EQ(undoSteps(), 3u);
}

TEST_F(SelectionToolTest, ShiftKeepsAMoveOnOneAxis)
{
    select().hold({.shift = true}).drag({220, 20}, {250, 30});
    EXPECT_EQ(right.bounds(), Box({230, 0}, {270, 40}));
    select().drag({250, 20}, {255, 60});
    EXPECT_EQ(right.bounds(), Box({230, 40}, {270, 80}));
}

TEST_F(SelectionToolTest, AltDragDuplicatesAndSelectsTheCopy)
{
    const auto before = scene().hash();
    select().hold({.alt = true}).drag({220, 20}, {220, 120});
    ASSERT_EQ(shapes().size(), 4u);
    EXPECT_EQ(right.bounds(), Box({200, 0}, {240, 40}));
    ASSERT_EQ(selected().size(), 1u);
    EXPECT_EQ(selected()[0]->bounds(), Box({200, 100}, {240, 140}));
    EXPECT_EQ(right.sibling(), selected()[0]) << "just above the original";
    EXPECT_EQ(undoSteps(), 4u);
    EXPECT_EQ(scene().undoRedo().undoLabel(), "Duplicate");
    undo();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(SelectionToolTest, AltMayChangeItsMindDuringTheDrag)
{
    select().press({220, 20}).move({220, 60}).hold({.alt = true}).move({220, 80});
    EXPECT_EQ(shapes().size(), 4u);
    select().hold({}).move({220, 120}).release();
    EXPECT_EQ(shapes().size(), 3u);
    EXPECT_EQ(right.bounds(), Box({200, 100}, {240, 140}));
    EXPECT_EQ(scene().undoRedo().undoLabel(), "Move");
}

TEST_F(SelectionToolTest, EscGivesAMoveUp)
{
    const auto before = scene().hash();
    select().press({220, 20}).move({260, 60}).key("Escape").release();
    EXPECT_EQ(scene().hash(), before);
    EXPECT_EQ(undoSteps(), 3u);
    EXPECT_FALSE(items().inTransaction());
    EXPECT_TRUE(selected().empty()) << "as before the press";
}

TEST_F(SelectionToolTest, EscGivesAMoveUpAlsoWhenItArrivesAsAKey)  // a view may offer keys to the tool first
{
    const auto before = scene().hash();
    select().press({220, 20}).move({260, 60});
    EXPECT_TRUE(select()->keyPress({"Escape", "", {}, false}));
    select().release();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(SelectionToolTest, LeavingTheToolGivesTheGestureUp)
{
    const auto before = scene().hash();
    select().press({220, 20}).move({260, 60});
    select()->deactivate();
    EXPECT_EQ(scene().hash(), before);
    EXPECT_FALSE(items().inTransaction());
}

TEST_F(SelectionToolTest, AnAbandonedTransactionEndsTheGestureQuietly)  // what the guard does after a plugin failed
{
    select().press({220, 20}).move({260, 60});
    items().abandon();
    EXPECT_NO_THROW(select().move({270, 60}).release());
    EXPECT_FALSE(items().inTransaction());
}

TEST_F(SelectionToolTest, ThousandsOfItemsMoveTogether)
{
    std::vector<jet::ItemId> all;
    auto edit = items().begin("Many");
    for (int i = 0; i < 5000; ++i) {
        const Vec2 at(10.0 * (i % 100), 300 + 10.0 * (i / 100));
        all.push_back(edit.add<jet::ShapeItem>(scene().root(), jet::Path::rectangle(Box(at, at + Vec2(8, 8)))).id());
    }
    edit.setSelection(all);
    edit.commit();
    select().press({4, 304});
    for (int i = 1; i <= 10; ++i) select().move({4 + 2.0 * i, 304});
    select().release();
    EXPECT_EQ(items().find(all[0])->bounds(), Box({20, 300}, {28, 308}));
}

// --- Keys ---

TEST_F(SelectionToolTest, ArrowsNudgeAndNudgesInARowAreOneStep)
{
    items().setSelection({right.id()});
    const auto before = scene().hash();
    select().key("Right").key("Right").key("Down").hold({.shift = true}).key("Left").key("Up");
    EXPECT_EQ(right.bounds(), Box({192, -9}, {232, 31}));
    EXPECT_EQ(undoSteps(), 4u);
    undo();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(SelectionToolTest, NudgesOfOtherItemsAreAnotherStep)
{
    items().setSelection({right.id()});
    select().key("Right");
    items().setSelection({left.id()});
    select().key("Right");
    EXPECT_EQ(undoSteps(), 5u);
}

TEST_F(SelectionToolTest, DeleteRemovesWhatIsSelectedAndUndoBringsItBackInPlace)
{
    items().setSelection({left.id(), right.id()});
    const auto before = scene().hash();
    select().key("Delete");
    EXPECT_EQ(shapes(), Items{&over});
    undo();
    EXPECT_EQ(scene().hash(), before);
    EXPECT_EQ(shapes().size(), 3u);
}

TEST_F(SelectionToolTest, LockedItemsAreNeitherMovedNorDeleted)
{
    auto edit = items().begin("Lock");
    edit.set(right, "locked", true);
    edit.commit();
    items().setSelection({right.id(), left.id()});  // as the Layers panel can
    select().key("Right");
    EXPECT_EQ(right.bounds(), Box({200, 0}, {240, 40}));
    EXPECT_EQ(left.bounds(), Box({1, 0}, {41, 40}));
    items().setSelection({right.id(), left.id()});
    select().key("Delete");
    EXPECT_EQ(shapes(), (Items{&right, &over}));
}

TEST_F(SelectionToolTest, CtrlDDuplicatesALittleAside)
{
    items().setSelection({left.id(), right.id()});
    select().hold({.control = true}).key("D");
    EXPECT_TRUE(select().used());
    ASSERT_EQ(shapes().size(), 5u);
    ASSERT_EQ(selected().size(), 2u);
    EXPECT_EQ(selected()[0]->bounds(), Box({10, 10}, {50, 50}));
    EXPECT_EQ(selected()[1]->bounds(), Box({210, 10}, {250, 50}));
    EXPECT_EQ(undoSteps(), 4u);
}

TEST_F(SelectionToolTest, KeysWithoutASelectionAreLeftToTheView)
{
    for (const char* key : {"Left", "Right", "Up", "Down", "Delete", "Escape", "F"}) {
        select().key(key);
        EXPECT_FALSE(select().used()) << key;
    }
}

TEST_F(SelectionToolTest, KeysDuringAGestureDoNothingElse)
{
    select().press({220, 20}).move({240, 20}).key("Delete").key("Left");
    EXPECT_EQ(shapes().size(), 3u);
    select().release();
    EXPECT_EQ(right.bounds(), Box({220, 0}, {260, 40}));
}

// --- Painting ---

TEST_F(SelectionToolTest, PaintsOutlinesFrameAndHandlesOfTheSelection)
{
    RecordingPainter nothing;
    select()->paint(nothing);
    EXPECT_TRUE(nothing.drawn().empty());

    items().setSelection({right.id()});
    RecordingPainter painter;
    select()->paint(painter);
    EXPECT_EQ(painter.strokes().at(0).path, right.path());
    EXPECT_EQ(painter.strokes().at(1).path, jet::Path::rectangle(Box({196, -4}, {244, 44})));
    EXPECT_EQ(painter.fills().at(0).path.contours().size(), 8u) << "eight handles";
    for (const auto& stroke : painter.strokes()) EXPECT_TRUE(stroke.pen.cosmetic);
}

TEST_F(SelectionToolTest, PaintsTheRubberBand)
{
    select().press({100, 100}).move({150, 130});
    RecordingPainter painter;
    select()->paint(painter);
    ASSERT_EQ(painter.fills().size(), 1u);
    EXPECT_EQ(painter.fills()[0].path.bounds(), Box({100, 100}, {150, 130}));
    EXPECT_LT(painter.fills()[0].color().a, 128) << "what is below shows through";
}

// --- Anything at all ---

TEST_F(SelectionToolTest, AnyGesturesUndoAndRedoToEqualHashes)
{
    groupOf(items(), {&left, &over});
    std::mt19937 random(11);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const auto anywhere = [&] { return Vec2(-40 + below(320), -40 + below(160)); };
    std::vector<std::uint64_t> hashes{scene().hash()};
    const std::size_t first = undoSteps();
    const char* keys[] = {"Left", "Right", "Up", "Down", "Delete", "D", "Escape"};
    for (int round = 0; round < 400; ++round) {
        if (shapes().size() < 3) {
            addRectangle(Box(anywhere(), anywhere()));
            hashes.resize(undoSteps() - first + 1, scene().hash());
        }
        select().hold({below(3) == 0, below(4) == 0, below(5) == 0});
        switch (below(5)) {
        case 0: select().click(anywhere()); break;
        case 1: select().doubleClick(anywhere()); break;
        case 2: select().key(keys[static_cast<std::size_t>(below(7))]); break;
        case 3: {
            const jet::Box box = selected().empty() ? Box({0, 0}, {1, 1}) : selected()[0]->bounds();
            const Vec2 corner = box.isNull() ? Vec2(0, 0) : Vec2(box.max + Vec2(4, 4));
            select().press(corner).move(anywhere()).move(anywhere());
            if (below(4) == 0) select().key("Escape");
            select().release();
            break;
        }
        default: select().drag(anywhere(), anywhere()); break;
        }
        ASSERT_FALSE(items().inTransaction()) << round;
        const std::size_t steps = undoSteps() - first;
        ASSERT_LE(steps, hashes.size());
        hashes.resize(steps + 1);  // a merged nudge replaces its step's hash
        hashes[steps] = scene().hash();
        if (shapes().size() > 12 || below(40) == 0) {
            for (int i = below(4); i > 0 && undoSteps() > first; --i) undo();
            ASSERT_EQ(scene().hash(), hashes[undoSteps() - first]) << round;
        }
    }
    ASSERT_GT(undoSteps() - first, 20u);
    while (undoSteps() > first) {
        ASSERT_EQ(scene().hash(), hashes[undoSteps() - first]);
        undo();
    }
    EXPECT_EQ(scene().hash(), hashes[0]);
    while (scene().undoRedo().canRedo()) {
        redo();
        ASSERT_EQ(scene().hash(), hashes[undoSteps() - first]);
    }
}

}  // namespace
