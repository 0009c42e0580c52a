#include "support/recording_painter.hpp"
#include "support/tool_fixture.hpp"

#include <chrono>
#include <numbers>
#include <random>

namespace {

using jet::Box;
using jet::Item;
using jet::Vec2;
using jet::test::RecordingPainter;
using Items = std::vector<const Item*>;

class SelectionToolTest : public jet::test::ToolFixture {
protected:
    SelectionToolTest() : ToolFixture{"org.jet.tool.selection"} {}

    jet::test::ToolDriver& select() { return tool("selection"); }
    /// Two squares apart, and one over the right half of the first.
    const Item& left = addRectangle(Box({0, 0}, {40, 40}));
    const Item& right = addRectangle(Box({200, 0}, {240, 40}));
    const Item& over = addRectangle(Box({20, 0}, {60, 40}));
};

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

TEST_F(SelectionToolTest, ThousandsOfItemsMoveFluently)
{
    std::vector<jet::ItemId> all;
    auto edit = items().begin("Many");
    for (int i = 0; i < 5000; ++i) {
        const Vec2 at(10.0 * (i % 100), 300 + 10.0 * (i / 100));
        all.push_back(edit.add<jet::ShapeItem>(scene().root(), jet::Path::rectangle(Box(at, at + Vec2(8, 8)))).id());
    }
    edit.setSelection(all);
    edit.commit();
    const auto begin = std::chrono::steady_clock::now();
    select().press({4, 304});
    for (int i = 1; i <= 10; ++i) select().move({4 + 2.0 * i, 304});
    select().release();
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
    std::cout << spent.count() / 10 << " ms a move\n";
    EXPECT_LT(spent.count(), 10 * 200);  // measured: about 20 ms a move
    EXPECT_EQ(items().find(all[0])->bounds(), Box({20, 300}, {28, 308}));
}

// --- Scaling and rotating ---

// Handles sit on a frame four pixels around the box; the knob 22 pixels above it.
constexpr double kMargin = 4, kKnob = 22;

TEST_F(SelectionToolTest, TheEightHandlesScaleAwayFromTheOppositeSide)
{
    struct Case {
        Vec2 handle;  // -1, 0, 1
        Box expected;
    };
    // each handle of [200, 240] x [0, 40] is dragged by (40, 40) along its own directions outwards
    const Case cases[] = {
        {{-1, -1}, Box({160, -40}, {240, 40})}, {{0, -1}, Box({200, -40}, {240, 40})},
        {{1, -1}, Box({200, -40}, {280, 40})},  {{1, 0}, Box({200, 0}, {280, 40})},
        {{1, 1}, Box({200, 0}, {280, 80})},     {{0, 1}, Box({200, 0}, {240, 80})},
        {{-1, 1}, Box({160, 0}, {240, 80})},    {{-1, 0}, Box({160, 0}, {240, 40})},
    };
    for (const Case& c : cases) {
        items().setSelection({right.id()});
        const auto before = scene().hash();
        const Vec2 from = Vec2(220, 20) + (20 + kMargin) * c.handle;
        select().drag(from, from + 40 * c.handle);
        EXPECT_EQ(right.bounds(), c.expected) << c.handle.transpose();
        EXPECT_EQ(scene().undoRedo().undoLabel(), "Scale");
        undo();
        EXPECT_EQ(scene().hash(), before) << "bit for bit";
    }
}

TEST_F(SelectionToolTest, SeveralItemsScaleAsOne)
{
    items().setSelection({left.id(), right.id()});  // [0, 240] x [0, 40]
    select().drag({240 + kMargin, 40 + kMargin}, {480 + kMargin, 80 + kMargin});
    EXPECT_EQ(left.bounds(), Box({0, 0}, {80, 80}));
    EXPECT_EQ(right.bounds(), Box({400, 0}, {480, 80}));
}

TEST_F(SelectionToolTest, ShiftKeepsTheRatioAndAltTheCentre)
{
    items().setSelection({right.id()});
    select().hold({.shift = true}).drag({244, 44}, {284, 54});
    EXPECT_EQ(right.bounds(), Box({200, 0}, {280, 80}));
    undo();
    items().setSelection({right.id()});
    select().hold({.alt = true}).drag({244, 44}, {254, 64});
    EXPECT_EQ(right.bounds(), Box({190, -20}, {250, 60}));
    undo();
    items().setSelection({right.id()});
    select().hold({.shift = true}).drag({244, 20}, {284, 20});
    EXPECT_EQ(right.bounds(), Box({200, -20}, {280, 60})) << "a side's handle takes the other axis along";
}

TEST_F(SelectionToolTest, DraggingAcrossTheOppositeSideMirrorsAndNeverCollapses)
{
    items().setSelection({right.id()});
    select().drag({244, 20}, {164, 20});
    EXPECT_EQ(right.bounds(), Box({160, 0}, {200, 40}));
    undo();
    items().setSelection({right.id()});
    select().drag({244, 20}, {204, 20});  // exactly onto the opposite side
    EXPECT_GT(right.bounds().width(), 0);
    EXPECT_LT(right.bounds().width(), 1);
}

TEST_F(SelectionToolTest, AStraightLineScalesAlongItselfOnly)
{
    const Item& line = add("shape", jet::Path::line({0, 200}, {100, 200}));
    items().setSelection({line.id()});
    select().drag({100 + kMargin, 200}, {200 + kMargin, 230});
    EXPECT_EQ(line.bounds(), Box({0, 200}, {200, 200}));
}

TEST_F(SelectionToolTest, TheKnobRotatesAboutTheCentre)
{
    items().setSelection({right.id()});
    const auto before = scene().hash();
    const Vec2 centre(220, 20), knob(220, -kMargin - kKnob);
    const double reach = centre.y() - knob.y();
    select().hold({.shift = true}).drag(knob, centre + Vec2(reach, 1));  // nearly a quarter turn clockwise
    const jet::Path expected = jet::Path::polygon(std::vector<Vec2>{{240, 0}, {240, 40}, {200, 40}, {200, 0}});
    EXPECT_EQ(right.path(), expected) << "Shift makes it exact: the top-left corner is now the top-right one";
    undo();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(SelectionToolTest, DraggingOutsideACornerRotatesToo)
{
    items().setSelection({right.id()});
    const Vec2 centre(220, 20), from = centre + Vec2(34, 34);
    const double angle = 0.4;
    const Vec2 to = jet::Affine::rotation(angle, centre) * from;
    select().drag(from, to);
    EXPECT_EQ(scene().undoRedo().undoLabel(), "Rotate");
    const Vec2 corner = jet::Affine::rotation(angle, centre) * Vec2(200, 0);
    EXPECT_LT((right.path().segment(0).point - corner).norm(), 1e-9);
}

TEST_F(SelectionToolTest, ShiftRotatesInStepsOfFifteenDegrees)
{
    items().setSelection({right.id()});
    const Vec2 centre(220, 20), knob(220, -kMargin - kKnob);
    select().hold({.shift = true}).drag(knob, jet::Affine::rotation(0.5, centre) * knob);  // 28.6°
    const Vec2 corner = jet::Affine::rotation(std::numbers::pi / 6, centre) * Vec2(200, 0);
    EXPECT_LT((right.path().segment(0).point - corner).norm(), 1e-9);
}

TEST_F(SelectionToolTest, HandlesKeepTheirSizeInPixels)
{
    items().setSelection({right.id()});
    host().scale = 0.1;  // 4 pixels wide: the frame is larger than the item
    select().drag({220 + 140, 20 + 140}, {220 + 180, 20 + 180});
    EXPECT_EQ(scene().undoRedo().undoLabel(), "Scale");
    EXPECT_EQ(right.bounds(), Box({200, 0}, {280, 80}));
    undo();
    select().drag({220, 20}, {320, 20});
    EXPECT_EQ(scene().undoRedo().undoLabel(), "Move") << "a small item can still be taken in its middle";
}

TEST_F(SelectionToolTest, CursorsTellWhatADragWouldDo)
{
    items().setSelection({right.id()});
    const std::pair<Vec2, const char*> cases[] = {
        {{196, -4}, "size-fdiag"}, {{244, -4}, "size-bdiag"}, {{220, -4}, "size-ver"}, {{244, 20}, "size-hor"},
        {{220, -26}, "rotate"},    {{254, 54}, "rotate"},     {{220, 20}, "move"},     {{120, 120}, "arrow"},
    };
    for (const auto& [at, cursor] : cases) {
        select().move(at);
        EXPECT_EQ(host().cursor, cursor) << at.transpose();
    }
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
