#include "support/recording_painter.hpp"
#include "support/tool_fixture.hpp"

namespace {

using jet::Box;
using jet::Modifiers;
using jet::Vec2;
using jet::test::RecordingPainter;

class RectangleToolTest : public jet::test::ToolFixture {
protected:
    RectangleToolTest() : ToolFixture{"org.jet.tool.rectangle", "org.jet.effect.polygon-face"} {}
};

TEST_F(RectangleToolTest, ADragMakesOneShapeAndOneUndoStep)
{
    tool("rectangle").drag({10, 10}, {60, 40});
    ASSERT_EQ(shapes().size(), 1u);
    EXPECT_EQ(shapes()[0]->path(), jet::Path::rectangle(Box({10, 10}, {60, 40})));
    EXPECT_EQ(undoSteps(), 1u);
    const auto after = scene().hash();
    undo();
    EXPECT_EQ(scene().hash(), emptySceneHash());
    redo();
    EXPECT_EQ(scene().hash(), after);
}

TEST_F(RectangleToolTest, TheNewShapeIsGreenSelectedAndInALayer)
{
    tool("rectangle").drag({10, 10}, {60, 40});
    const jet::Item& shape = *shapes().at(0);
    ASSERT_NE(shape.effect("polygon-face"), nullptr);
    const auto color = shape.effect("polygon-face")->properties.find("color")->as<jet::Color>();
    EXPECT_GT(color.g, color.r);
    EXPECT_GT(color.g, color.b);
    EXPECT_EQ(selected(), std::vector<const jet::Item*>{&shape});
    EXPECT_TRUE(shape.parent()->is<jet::LayerItem>());
}

TEST_F(RectangleToolTest, TheColourOfNewFacesIsAnOption)
{
    host().values.set("color", jet::Color{1, 2, 3, 255});
    tool("rectangle").drag({10, 10}, {60, 40});
    EXPECT_EQ(*shapes().at(0)->effect("polygon-face")->properties.find("color"),
              (jet::Value(jet::Color{1, 2, 3, 255})));
}

TEST_F(RectangleToolTest, WorksWithoutThePluginForFaces)
{
    jet::test::TestCatalog alone{"org.jet.tool.rectangle"};
    jet::EventsCenter events;
    jet::Scene bare("Bare", events, alone);
    jet::test::TestToolHost view(bare);
    jet::test::ToolDriver(view, alone.createTool("rectangle", view)).drag({0, 0}, {5, 5});
    EXPECT_EQ(bare.items().itemCount(), 2u) << "a layer and a shape";
}

TEST_F(RectangleToolTest, ShiftMakesASquareAndAltGrowsItFromItsCentre)
{
    tool("rectangle").hold({.shift = true}).drag({10, 10}, {60, 40});
    EXPECT_EQ(shapes().at(0)->bounds(), Box({10, 10}, {60, 60}));
    tool("rectangle").hold({.alt = true}).drag({100, 100}, {110, 120});
    EXPECT_EQ(shapes().at(1)->bounds(), Box({90, 80}, {110, 120}));
    tool("rectangle").hold({.shift = true, .alt = true}).drag({100, 100}, {90, 120});
    EXPECT_EQ(shapes().at(2)->bounds(), Box({80, 80}, {120, 120}));
}

TEST_F(RectangleToolTest, ShiftPressedWhileThePointerRestsCounts)
{
    auto& rectangle = tool("rectangle");
    rectangle.press({0, 0}).move({30, 10});
    rectangle->keyPress({"Shift", "", {}, false});
    EXPECT_EQ(host().status, "Rectangle 30 × 30");
    rectangle->keyRelease({"Shift", "", {}, false});
    EXPECT_EQ(host().status, "Rectangle 30 × 10");
    rectangle->keyPress({"Shift", "", {}, false});
    rectangle.release();
    EXPECT_EQ(shapes().at(0)->bounds(), Box({0, 0}, {30, 30}));
}

TEST_F(RectangleToolTest, EscGivesUpTheDragAndLeavesNothing)
{
    tool("rectangle").press({10, 10}).move({60, 40}).key("Escape");
    EXPECT_TRUE(tool("rectangle").used());
    tool("rectangle").release();
    EXPECT_EQ(scene().hash(), emptySceneHash());
    tool("rectangle").key("Escape");
    EXPECT_FALSE(tool("rectangle").used()) << "without a gesture the view decides what Esc means";
}

TEST_F(RectangleToolTest, AClickOrAFlatDragDrawsNothing)
{
    tool("rectangle").click({10, 10});
    tool("rectangle").drag({10, 10}, {60, 10});
    EXPECT_EQ(scene().hash(), emptySceneHash());
    EXPECT_EQ(undoSteps(), 0u);
}

TEST_F(RectangleToolTest, TheOutlineShowsOnlyWhileDragging)
{
    const auto strokes = [&] {
        RecordingPainter painter;
        tool("rectangle")->paint(painter);
        return painter.strokes();
    };
    EXPECT_TRUE(strokes().empty());
    tool("rectangle").press({10, 10}).move({60, 40});
    ASSERT_EQ(strokes().size(), 1u);
    EXPECT_EQ(strokes()[0].path.bounds(), Box({10, 10}, {60, 40}));
    EXPECT_TRUE(strokes()[0].pen.cosmetic);
    tool("rectangle").release();
    EXPECT_TRUE(strokes().empty());
}

TEST_F(RectangleToolTest, LeavingTheToolEndsTheGesture)
{
    tool("rectangle").press({10, 10}).move({60, 40});
    tool("rectangle")->deactivate();
    EXPECT_EQ(scene().hash(), emptySceneHash());
    EXPECT_FALSE(tool("rectangle")->cancel());
}

}  // namespace
