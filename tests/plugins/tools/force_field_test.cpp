#include "support/recording_painter.hpp"
#include "support/tool_fixture.hpp"

#include <jet/simulation.hpp>

namespace {

using jet::Box;
using jet::Item;
using jet::Path;
using jet::Vec2;

class ForceFieldToolTest : public jet::test::ToolFixture {
protected:
    ForceFieldToolTest()
        : ToolFixture{"org.jet.tool.force-field", "org.jet.items.physics", "org.jet.effect.in-path-rigid-body",
                      "org.jet.physics"}
    {
    }
    jet::test::ToolDriver& field() { return tool("force-field-tool"); }
    std::vector<const Item*> fields() { return itemsOf("force-field"); }
    template <class T>
    T value(const char* id)
    {
        return fields().at(0)->property(id)->template as<T>();
    }
};

TEST_F(ForceFieldToolTest, ADragMakesOneFieldAndOneUndoStep)
{
    field().drag({10, 10}, {60, 40});
    ASSERT_EQ(fields().size(), 1u);
    EXPECT_EQ(fields()[0]->path(), Path::rectangle(Box({10, 10}, {60, 40})));
    EXPECT_EQ(value<std::string>("kind"), "directional");
    EXPECT_NEAR((value<Vec2>("vector") - Vec2(0, -100)).norm(), 0, 1e-12) << "upwards";
    EXPECT_EQ(selected(), std::vector<const Item*>{fields()[0]});
    EXPECT_EQ(undoSteps(), 1u);
    undo();
    EXPECT_EQ(scene().hash(), emptySceneHash());
}

TEST_F(ForceFieldToolTest, KindStrengthAndDirectionAreOptions)
{
    host().values.set("strength", 60.0);
    host().values.set("direction", 0.0);
    host().values.set("rate", 2.0);
    const auto draw = [&](const char* kind) {
        if (!fields().empty()) undo();
        host().values.set("kind", std::string(kind));
        field().drag({10, 10}, {60, 40});
        EXPECT_EQ(value<std::string>("kind"), kind);
    };
    draw("directional");
    EXPECT_EQ(value<Vec2>("vector"), Vec2(60, 0));
    draw("radial");
    EXPECT_EQ(value<double>("strength"), 60);
    draw("vortex");
    EXPECT_EQ(value<double>("strength"), 60);
    draw("drag");
    EXPECT_EQ(value<Vec2>("vector"), Vec2(60, 0)) << "the wind";
    EXPECT_EQ(value<double>("strength"), 2);
    draw("buoyancy");
    EXPECT_EQ(value<double>("strength"), 2);
    EXPECT_GT(value<double>("drag"), 0);
}

TEST_F(ForceFieldToolTest, TheRegionIsARectangleAnEllipseOrDrawnFreely)
{
    field().hold({.shift = true}).drag({10, 10}, {60, 40});
    EXPECT_EQ(fields().at(0)->bounds(), Box({10, 10}, {60, 60}));
    undo();
    host().values.set("shape", std::string("ellipse"));
    field().hold({.alt = true}).drag({100, 100}, {110, 120});
    EXPECT_EQ(fields().at(0)->path(), Path::ellipse(Box({90, 80}, {110, 120})));
    undo();
    host().values.set("shape", std::string("free"));
    field().hold({}).press({0, 0}).move({50, 0}).move({50.5, 0}).move({50, 50}).move({0, 50}).release();
    ASSERT_EQ(fields().size(), 1u);
    EXPECT_NEAR(std::abs(fields()[0]->path().area()), 2500, 1e-9) << "what moves by less than 3 pixels is no point";
}

TEST_F(ForceFieldToolTest, WhatHasNoAreaAndWhatIsGivenUpLeavesNothing)
{
    field().click({10, 10});
    field().drag({10, 10}, {60, 10});
    host().values.set("shape", std::string("free"));
    field().press({0, 0}).move({50, 0}).release();
    host().values.set("shape", std::string("rectangle"));
    field().press({10, 10}).move({60, 40}).key("Escape");
    EXPECT_TRUE(field().used());
    field().release();
    field().press({10, 10}).move({60, 40});
    field()->deactivate();
    EXPECT_EQ(scene().hash(), emptySceneHash());
    EXPECT_EQ(undoSteps(), 0u);
}

TEST_F(ForceFieldToolTest, ThePreviewIsTheRegion)
{
    field().press({10, 10}).move({60, 40});
    jet::test::RecordingPainter painter;
    field()->paint(painter);
    ASSERT_EQ(painter.strokes().size(), 1u);
    EXPECT_EQ(painter.strokes()[0].path.bounds(), Box({10, 10}, {60, 40}));
    EXPECT_EQ(host().status, "directional 50 × 30");
    field().release();
}

TEST_F(ForceFieldToolTest, AtPlayTheFieldLiftsWhatIsInside)
{
    host().values.set("strength", 300.0);
    field().drag({-100, -1000}, {100, 100});
    auto edit = scene().items().begin("Body");
    const Item& item = edit.add("body", host().insertionPoint(edit), Path::rectangle(Box({-10, 0}, {10, 20})));
    edit.addEffect(item, "in-path-rigid-body");
    edit.commit();
    auto simulation = jet::Simulation::start(scene(), {}).orThrow();
    while (simulation->time() < 1) simulation->step();
    EXPECT_LT(simulation->world().bodies().position[simulation->bodyOf(item.id())].y(), -50);
}

}  // namespace
