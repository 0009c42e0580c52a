#include "support/recording_painter.hpp"
#include "support/tool_fixture.hpp"

#include <jet/simulation.hpp>

namespace {

using jet::Box;
using jet::Item;
using jet::Path;
using jet::Vec2;

class JointToolTest : public jet::test::ToolFixture {
protected:
    JointToolTest()
        : ToolFixture{"org.jet.tool.joint", "org.jet.items.physics", "org.jet.effect.in-path-rigid-body",
                      "org.jet.physics"}
    {
        first_ = body({{0, 0}, {40, 40}}, "First");
        second_ = body({{100, 0}, {140, 40}}, "Second");
    }

    jet::ItemId body(const Box& box, const char* name)
    {
        auto edit = scene().items().begin("Body");
        const Item& item = edit.add("body", host().insertionPoint(edit), Path::rectangle(box));
        edit.addEffect(item, "in-path-rigid-body");
        edit.set(item, "name", std::string(name));
        edit.commit();
        return item.id();
    }
    std::vector<const Item*> joints() { return itemsOf("joint"); }
    std::vector<Vec2> points(const Item& joint)
    {
        std::vector<Vec2> all;
        for (std::size_t i = 0; i < joint.path().segmentCount(); ++i) all.push_back(joint.path().segment(i).point);
        return all;
    }
    template <class T>
    T value(const Item& item, const char* id)
    {
        return item.property(id)->as<T>();
    }
    jet::test::ToolDriver& joint() { return tool("joint-tool"); }

    jet::ItemId first_, second_;
};

TEST_F(JointToolTest, ADragFromBodyToBodyMakesOneJointAndOneUndoStep)
{
    const auto before = scene().hash();
    const auto steps = undoSteps();
    joint().drag({12, 10}, {128, 30});
    ASSERT_EQ(joints().size(), 1u);
    EXPECT_EQ(points(*joints()[0]), (std::vector<Vec2>{{12, 10}, {12, 10}, {128, 30}})) << "it turns about its start";
    EXPECT_EQ(value<std::string>(*joints()[0], "kind"), "revolute");
    EXPECT_EQ(selected(), std::vector<const Item*>{joints()[0]});
    EXPECT_EQ(undoSteps(), steps + 1);
    undo();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(JointToolTest, TwoClicksDoWhatADragDoes)
{
    joint().click({12, 10});
    EXPECT_TRUE(joints().empty());
    joint()->move({{128, 30}, {128, 30}, jet::PointerButton::None, {}});
    EXPECT_EQ(host().status, "revolute: First – Second");
    joint().click({128, 30});
    ASSERT_EQ(joints().size(), 1u);
    EXPECT_EQ(points(*joints()[0]).back(), Vec2(128, 30));
    EXPECT_EQ(host().status, "Joined First and Second.");
}

TEST_F(JointToolTest, EndsSnapToMiddlesAndToPointsAndLieInTheBody)
{
    joint().drag({23, 17}, {136, 37});
    ASSERT_EQ(joints().size(), 1u);
    EXPECT_EQ(points(*joints()[0]).front(), Vec2(20, 20)) << "the middle, 4 pixels away";
    const Vec2 corner = points(*joints()[0]).back();
    EXPECT_NEAR((corner - Vec2(140, 40)).norm(), 0, 0.5);
    EXPECT_TRUE(scene().items().find(second_)->path().contains(corner)) << "a little inside, so that it is held";
    undo();
    joint().hold({.alt = true}).drag({23, 17}, {136, 37});
    EXPECT_EQ(points(*joints().at(0)).front(), Vec2(23, 17)) << "Alt: freely";
    undo();
    host().values.set("snap", false);
    joint().hold({}).drag({23, 17}, {136, 37});
    EXPECT_EQ(points(*joints().at(0)).back(), Vec2(136, 37));
}

TEST_F(JointToolTest, AHingeToTheBackgroundTurnsAboutThePointThere)
{
    joint().drag({12, 10}, {60, -80});
    EXPECT_EQ(points(*joints().at(0)), (std::vector<Vec2>{{12, 10}, {60, -80}, {60, -80}}));
    undo();
    joint().drag({60, -80}, {12, 10});
    EXPECT_EQ(points(*joints().at(0))[1], Vec2(60, -80));
    undo();
    host().values.set("pivot", std::string("middle"));
    joint().drag({12, 10}, {60, -80});
    EXPECT_EQ(points(*joints().at(0))[1], Vec2(36, -35));
}

TEST_F(JointToolTest, KindsGetThePathAndTheStrengthTheyNeed)
{
    for (const char* kind : {"weld", "prismatic", "wheel", "distance", "rope", "motor", "mouse", "pulley"}) {
        host().values.set("kind", std::string(kind));
        joint().drag({12, 10}, {112, 10});
        ASSERT_EQ(joints().size(), 1u) << kind;
        const Item& made = *joints()[0];
        EXPECT_EQ(value<std::string>(made, "kind"), kind);
        const std::string name = kind;
        const std::size_t count = name == "pulley"                                           ? 4
                                  : name == "weld" || name == "prismatic" || name == "wheel" ? 3
                                                                                             : 2;
        EXPECT_EQ(points(made).size(), count) << kind;
        if (name == "pulley") {
            EXPECT_EQ(points(made)[1], Vec2(12, -90)) << "a wheel above each";
            EXPECT_EQ(points(made)[2], Vec2(112, -90));
        }
        if (name == "prismatic") {
            EXPECT_EQ(value<Vec2>(made, "axis"), Vec2(1, 0)) << "along the drag";
        }
        if (name == "motor" || name == "mouse") {
            EXPECT_GT(value<double>(made, "max-force"), 0) << kind;
        }
        undo();
    }
}

TEST_F(JointToolTest, WhatCannotBeJoinedIsSaidAndLeavesNothing)
{
    const auto before = scene().hash();
    joint().drag({5, 5}, {30, 30});
    EXPECT_EQ(host().status, "Both ends lie in First: a joint holds two different bodies.");
    joint().drag({60, 200}, {90, 200});
    EXPECT_EQ(host().status, "There is no body at either end: drag from a body to another one, or to the background.");
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(JointToolTest, EscGivesUpTheDragAndTheFirstClick)
{
    const auto before = scene().hash();
    joint().press({12, 10}).move({128, 30}).key("Escape");
    joint().release();
    EXPECT_EQ(scene().hash(), before);
    joint().click({12, 10}).key("Escape");
    EXPECT_TRUE(joint().used());
    joint().click({128, 30});
    EXPECT_EQ(scene().hash(), before) << "that was a first click again";
    joint()->deactivate();
    EXPECT_FALSE(joint()->cancel());
}

TEST_F(JointToolTest, ThePreviewShowsTheJointAndTheEnds)
{
    const auto strokes = [&] {
        jet::test::RecordingPainter painter;
        joint()->paint(painter);
        return painter.strokes();
    };
    EXPECT_TRUE(strokes().empty());
    joint()->move({{22, 18}, {22, 18}, jet::PointerButton::None, {}});
    EXPECT_EQ(strokes().size(), 2u) << "where a press would snap";
    joint().press({12, 10}).move({128, 30});
    ASSERT_GE(strokes().size(), 3u);
    EXPECT_EQ(strokes()[0].path.segment(0).point, Vec2(12, 10));
    joint().release();
}

TEST_F(JointToolTest, AtPlayTheDrawnJointHolds)
{
    auto edit = scene().items().begin("Fix");
    edit.set(*scene().items().find(first_), "fixed", true);
    edit.commit();
    host().values.set("kind", std::string("rope"));
    joint().drag({20, 20}, {120, 20});
    auto simulation = jet::Simulation::start(scene(), {}).orThrow();
    while (simulation->time() < 3) simulation->step();
    EXPECT_TRUE(simulation->output().empty());
    const Vec2 at = simulation->world().bodies().position[simulation->bodyOf(second_)];
    EXPECT_NEAR((at - Vec2(20, 20)).norm(), 100, 3) << "it hangs on the rope";
    EXPECT_GT(at.y(), 30);
}

}  // namespace
