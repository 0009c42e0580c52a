// The bodies the effects build, in a running simulation with the physics plugin.
#include "support/test_catalog.hpp"

#include <jet/effect.hpp>
#include <jet/simulation.hpp>

#include <gtest/gtest.h>

namespace {

using jet::Box;
using jet::Item;
using jet::Path;
using jet::Vec2;

class BodiesAtPlayTest : public testing::Test {
protected:
    BodiesAtPlayTest() : scene_("Scene", events_, catalog_) {}

    const Item& body(Path path, const char* effect, jet::Properties properties = {}, bool fixed = false)
    {
        auto edit = scene_.items().begin("Add a body");
        const Item& item = edit.add<jet::ShapeItem>(scene_.root(), std::move(path));
        edit.addEffect(item, effect, std::move(properties));
        edit.set(item, "fixed", fixed);
        edit.commit();
        return item;
    }
    const Item& ground()
    {
        const jet::Properties bare{{"border-springs", false}, {"axis-aligned", false}, {"cross", false}};
        return body(Path::rectangle({{-500, 200}, {500, 260}}), "in-path-body", bare, true);
    }
    std::unique_ptr<jet::Simulation> play(double seconds)
    {
        auto simulation = jet::Simulation::start(scene_, {}).orThrow();
        while (simulation->time() < seconds) simulation->step();
        return simulation;
    }

    jet::test::TestCatalog catalog_{"org.jet.physics", "org.jet.effect.in-path-body",
                                    "org.jet.effect.in-path-rigid-body"};
    jet::EventsCenter events_;
    jet::Scene scene_;
};

TEST_F(BodiesAtPlayTest, ASoftBallFallsOnSoftGroundAndKeepsItsShape)  // thesis §4.2
{
    const Item& ball = body(Path::ellipse({{-50, 0}, {50, 100}}), "in-path-body");
    ground();
    const auto simulation = play(6);
    const Path& pose = *simulation->pose(ball);
    EXPECT_GT(pose.bounds().min.y(), 90);
    EXPECT_LT(pose.bounds().max.y(), 201);
    EXPECT_NEAR(std::abs(pose.area()), std::abs(ball.path().area()), 0.25 * std::abs(ball.path().area()));
}

TEST_F(BodiesAtPlayTest, ASoftBallBouncesAndComesToRest)  // "falls, bounces, then stands still" (thesis, figure 4.2.6)
{
    const Item& ball = body(Path::ellipse({{-50, 0}, {50, 100}}), "in-path-body");
    ground();
    const auto simulation = play(0);
    const jet::BodyHandle handle = simulation->bodyOf(ball.id());
    double fastestUp = 0;
    while (simulation->time() < 12) {
        simulation->step();
        fastestUp = std::max(fastestUp, -simulation->world().bodies().velocity[handle].y());
    }
    EXPECT_GT(fastestUp, 30);
    EXPECT_LT(simulation->world().bodies().velocity[handle].norm(), 1);
}

TEST_F(BodiesAtPlayTest, ARigidBoxRestsOnFixedGround)
{
    const Item& box = body(Path::rectangle({{-30, 100}, {30, 140}}), "in-path-rigid-body");
    ground();
    const auto simulation = play(6);
    const Box at = simulation->pose(box)->bounds();
    EXPECT_NEAR(at.max.y(), 200, 1);
    EXPECT_NEAR(at.height(), 40, 0.5);
}

TEST_F(BodiesAtPlayTest, ABodyWithAHoleIsASoftRing)
{
    Path ring = Path::ellipse({{-60, 0}, {60, 120}});
    const Path hole = Path::ellipse({{-25, 35}, {25, 85}});
    ring.contours().push_back(hole.contours().front());
    const Item& item = body(ring, "in-path-body");
    ground();
    const auto simulation = play(4);
    const auto states = simulation->world().bodies();
    const jet::BodyHandle handle = simulation->bodyOf(item.id());
    Box box;
    for (auto i = states.firstPoint[handle]; i < states.firstPoint[handle + 1]; ++i) box.extend(states.points[i]);
    EXPECT_LT(box.max.y(), 201);
    EXPECT_GT(box.height(), 60) << "it has not collapsed into its hole";
}

TEST_F(BodiesAtPlayTest, ALatticeThatCannotBeBuiltIsToldWithItsReason)
{
    const Item& ball = body(Path::ellipse({{-50, 0}, {50, 100}}), "in-path-body", {{"cell-size", Vec2(0.01, 0.01)}});
    const auto simulation = play(0);
    EXPECT_EQ(simulation->bodyOf(ball.id()), jet::kNoHandle);
    ASSERT_EQ(simulation->output().size(), 1u);
    const std::string& text = simulation->output().front().text;
    EXPECT_NE(text.find(ball.name()), std::string::npos) << text;
    EXPECT_NE(text.find("cell-size"), std::string::npos) << text;
}

}  // namespace
