#include "support/recording_painter.hpp"
#include "support/tool_fixture.hpp"

#include <jet/simulation.hpp>

namespace {

using jet::Box;
using jet::Item;
using jet::Path;
using jet::Vec2;

class ForceToolTest : public jet::test::ToolFixture {
protected:
    ForceToolTest()
        : ToolFixture{"org.jet.tool.force", "org.jet.items.physics", "org.jet.effect.in-path-rigid-body",
                      "org.jet.physics"}
    {
        auto edit = scene().items().begin("Body");
        const Item& item = edit.add("body", host().insertionPoint(edit), Path::rectangle({{0, 0}, {40, 40}}));
        edit.addEffect(item, "in-path-rigid-body");
        edit.set(item, "name", std::string("Crate"));
        edit.commit();
        body_ = item.id();
    }
    jet::test::ToolDriver& force() { return tool("force-tool"); }
    std::vector<const Item*> forces() { return itemsOf("force"); }
    Vec2 value() { return forces().at(0)->property("value")->as<Vec2>(); }
    Vec2 point() { return forces().at(0)->path().bounds().center(); }
    auto strokes()
    {
        jet::test::RecordingPainter painter;
        force()->paint(painter);
        return painter.strokes();
    }

    jet::ItemId body_;
};

TEST_F(ForceToolTest, ADragMakesOneForceAndOneUndoStep)
{
    const auto before = scene().hash();
    const auto steps = undoSteps();
    force().drag({10, 10}, {90, 70});
    ASSERT_EQ(forces().size(), 1u);
    EXPECT_EQ(point(), Vec2(10, 10));
    EXPECT_EQ(value(), Vec2(800, 600)) << "10 a unit of the arrow";
    EXPECT_EQ(selected(), std::vector<const Item*>{forces()[0]});
    EXPECT_EQ(host().status, "A force pushes Crate.");
    EXPECT_EQ(undoSteps(), steps + 1);
    undo();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(ForceToolTest, TwoClicksDoWhatADragDoes)
{
    force().click({10, 10});
    EXPECT_TRUE(forces().empty());
    force()->move({{10, 110}, {10, 110}, jet::PointerButton::None, {}});
    EXPECT_EQ(host().status, "Crate: force 1000 (0, 1000)");
    force().click({10, 110});
    ASSERT_EQ(forces().size(), 1u);
    EXPECT_EQ(value(), Vec2(0, 1000));
}

TEST_F(ForceToolTest, ThePointSnapsToMiddlesAndCornersAndLiesInTheBody)
{
    force().drag({23, 17}, {123, 20});
    EXPECT_EQ(point(), Vec2(20, 20)) << "the middle, 4 pixels away";
    EXPECT_EQ(value(), Vec2(1030, 0)) << "from the middle on";
    undo();
    force().drag({37, 38}, {137, 38});
    EXPECT_NEAR((point() - Vec2(40, 40)).norm(), 0, 0.5);
    EXPECT_TRUE(scene().items().find(body_)->path().contains(point())) << "so that it is known whom it pushes";
    undo();
    force().hold({.alt = true}).drag({23, 17}, {123, 17});
    EXPECT_EQ(point(), Vec2(23, 17)) << "Alt: freely";
    undo();
    host().values.set("snap", false);
    force().hold({}).drag({23, 17}, {123, 17});
    EXPECT_EQ(point(), Vec2(23, 17));
}

TEST_F(ForceToolTest, ShiftKeepsToEighthsOfATurnAlsoWhileThePointerRests)
{
    force().hold({.shift = true}).drag({10, 10}, {14, -90});
    EXPECT_EQ(value(), Vec2(0, -1000)) << "straight up, with nothing to the side";
    undo();
    force().drag({10, 10}, {110, 90});
    EXPECT_NEAR((value() - Vec2(900, 900)).norm(), 0, 1e-9);
    undo();
    force().hold({}).press({10, 10}).move({14, -90});
    EXPECT_TRUE(force()->keyPress({"Shift", "", {}}));
    EXPECT_EQ(host().status, "Crate: force 1000 (0, -1000)");
    EXPECT_TRUE(force()->keyRelease({"Shift", "", {}}));
    EXPECT_EQ(host().status, "Crate: force 1000.8 (40, -1000)");
    EXPECT_FALSE(force()->keyPress({"D", "", {}}));
    force()->cancel();
}

TEST_F(ForceToolTest, TheScaleIsAnOption)
{
    host().values.set("scale", 0.5);
    force().drag({10, 10}, {90, 10});
    EXPECT_EQ(value(), Vec2(40, 0));
}

TEST_F(ForceToolTest, WhatPushesNothingIsSaidAndLeavesNothing)
{
    const auto before = scene().hash();
    force().drag({100, 200}, {140, 200});
    EXPECT_EQ(host().status, "There is no body at the start: drag from the point of a body that is pushed.");
    force().click({10, 10}).click({10, 10});
    EXPECT_EQ(host().status, "The arrow has no length: drag it the way the body is to be pushed.");
    host().values.set("scale", 1e9);
    force().drag({10, 10}, {4000, 10});
    EXPECT_EQ(host().status.find("No force is as strong as this arrow is long: "), 0u) << host().status;
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(ForceToolTest, EscGivesUpTheDragAndTheFirstClick)
{
    const auto before = scene().hash();
    force().press({10, 10}).move({90, 30}).key("Escape");
    force().release();
    EXPECT_EQ(scene().hash(), before);
    force().click({10, 10}).key("Escape");
    EXPECT_TRUE(force().used());
    force().click({90, 30});
    EXPECT_EQ(scene().hash(), before) << "that was a first click again";
    force()->deactivate();
    EXPECT_FALSE(force()->cancel());
}

TEST_F(ForceToolTest, ThePreviewIsAnArrowFromThePoint)
{
    force()->activate();
    EXPECT_EQ(host().cursor, "cross");
    EXPECT_TRUE(strokes().empty());
    force()->move({{22, 18}, {22, 18}, jet::PointerButton::None, {}});
    EXPECT_EQ(strokes().size(), 2u) << "where a press would snap";
    force().press({10, 10}).move({90, 10});
    const auto drawn = strokes();
    ASSERT_EQ(drawn.size(), 4u) << "shaft, head, ring, dot";
    EXPECT_EQ(drawn[0].path, Path::line({10, 10}, {90, 10}));
    EXPECT_EQ(drawn[1].path.segment(1).point, Vec2(90, 10));
    force().release();
}

TEST_F(ForceToolTest, AtPlayTheDrawnForcePushes)
{
    host().values.set("scale", 1.0);
    force().drag({20, 20}, {20, 20 - 98.1});
    force().drag({20, 20}, {80, 20});
    auto simulation = jet::Simulation::start(scene(), {}).orThrow();
    while (simulation->time() < 1) simulation->step();
    EXPECT_TRUE(simulation->output().empty());
    const Vec2 at = simulation->world().bodies().position[simulation->bodyOf(body_)];
    EXPECT_NEAR(at.y(), 20, 0.1) << "its weight is borne";
    EXPECT_NEAR(at.x(), 20 + 0.5 * 60, 0.6) << "60 a second a second";
}

}  // namespace
