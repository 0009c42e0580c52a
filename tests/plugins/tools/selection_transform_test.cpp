#include "selection_fixture.hpp"
#include "support/recording_painter.hpp"

#include <numbers>

namespace {

using jet::Box;
using jet::Item;
using jet::Vec2;
using jet::test::RecordingPainter;
using jet::test::SelectionToolTest;
using Items = std::vector<const Item*>;

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

}  // namespace
