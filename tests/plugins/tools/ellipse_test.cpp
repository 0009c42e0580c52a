#include "support/tool_fixture.hpp"

namespace {

using jet::Box;
using jet::Vec2;

class EllipseToolTest : public jet::test::ToolFixture {
protected:
    EllipseToolTest() : ToolFixture{"org.jet.tool.ellipse", "org.jet.effect.polygon-face"} {}
};

TEST_F(EllipseToolTest, ADragMakesAnEllipseOfFourSegmentsWithTheThesissKappa)
{
    tool("ellipse").drag({0, 0}, {200, 100});
    ASSERT_EQ(shapes().size(), 1u);
    const jet::Contour& contour = shapes()[0]->path().contours().at(0);
    ASSERT_EQ(contour.segments.size(), 4u);
    EXPECT_TRUE(contour.closed);
    for (const jet::Segment& s : contour.segments) {
        // Control points lie kappa radii away, along the axis the curve runs there.
        const bool onXAxis = s.point.y() == 50;
        const double expected = jet::kEllipseKappa * (onXAxis ? 50 : 100);
        EXPECT_NEAR((s.in - s.point).norm(), expected, 1e-12);
        EXPECT_NEAR((s.out - s.point).norm(), expected, 1e-12);
    }
    EXPECT_LT((shapes()[0]->bounds().max - Vec2(200, 100)).norm(), 1e-9);
}

TEST_F(EllipseToolTest, IsOneUndoStepAndGreenAndSelected)
{
    tool("ellipse").drag({10, 10}, {60, 40});
    EXPECT_EQ(undoSteps(), 1u);
    EXPECT_NE(shapes().at(0)->effect("polygon-face"), nullptr);
    EXPECT_EQ(selected(), shapes());
    const auto after = scene().hash();
    undo();
    EXPECT_EQ(scene().hash(), emptySceneHash());
    redo();
    EXPECT_EQ(scene().hash(), after);
}

TEST_F(EllipseToolTest, ShiftMakesACircleAltGrowsItFromItsCentreEscGivesUp)
{
    tool("ellipse").hold({.shift = true, .alt = true}).drag({100, 100}, {110, 130});
    EXPECT_EQ(shapes().at(0)->path(), jet::Path::ellipse(Box({70, 70}, {130, 130})));
    undo();
    tool("ellipse").press({0, 0}).move({10, 10}).key("Escape").release();
    EXPECT_EQ(scene().hash(), emptySceneHash());
}

TEST_F(EllipseToolTest, NewShapesGoIntoTheLayerOfTheSelection)
{
    const jet::Item& first = add("layer", {});
    const jet::Item& second = add("layer", {});
    tool("ellipse").drag({0, 0}, {10, 10});
    EXPECT_EQ(shapes().at(0)->parent(), &first);
    items().setSelection({second.id()});
    tool("ellipse").drag({0, 0}, {10, 10});
    EXPECT_EQ(second.children().size(), 1u);
}

}  // namespace
