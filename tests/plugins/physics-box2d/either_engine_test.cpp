// One scene, either engine: what is drawn plays on both, and ends where it must.
#include "support/test_catalog.hpp"

#include <jet/simulation.hpp>

#include <gtest/gtest.h>

namespace jet::test {

namespace {

class OneEngine : public testing::Test {
protected:
    OneEngine() : scene_("Scene", events_, catalog_) {}

    const Item& body(Path path, const char* effect, bool fixed = false)
    {
        auto edit = scene_.items().begin("Add a body");
        const Item& item = edit.add<ShapeItem>(scene_.root(), std::move(path));
        edit.addEffect(item, effect);
        edit.set(item, "fixed", fixed);
        edit.commit();
        return item;
    }
    TestCatalog catalog_{"org.jet.physics", "org.jet.physics-box2d", "org.jet.effect.in-path-body",
                         "org.jet.effect.in-path-rigid-body"};
    EventsCenter events_;
    Scene scene_;
};

class EitherEngine : public OneEngine, public testing::WithParamInterface<const char*> {
protected:
    std::unique_ptr<Simulation> play(double seconds)
    {
        SimulationOptions options;
        options.physics = GetParam();
        auto simulation = Simulation::start(scene_, options).orThrow();
        while (simulation->time() < seconds) simulation->step();
        return simulation;
    }
};

TEST_P(EitherEngine, DrawnBodiesFallOnDrawnGroundAndRest)
{
    body(Path::polygon(std::vector<Vec2>{{-300, 180}, {0, 200}, {300, 180}, {300, 260}, {-300, 260}}),
         "in-path-rigid-body", true);
    const Item& box = body(Path::rectangle({{-30, 100}, {30, 140}}), "in-path-rigid-body");
    const Item& ring = body(Path::ellipse({{-15, 20}, {15, 50}}), "in-path-rigid-body");
    const auto simulation = play(8);
    for (const Item* item : {&box, &ring}) {
        const BodyHandle handle = simulation->bodyOf(item->id());
        ASSERT_NE(handle, kNoHandle);
        EXPECT_LT(simulation->world().bodies().velocity[handle].norm(), 15) << "it may roll in the valley";
        EXPECT_LT(simulation->pose(*item)->bounds().max.y(), 202);
        EXPECT_GT(simulation->pose(*item)->bounds().min.y(), 80);
    }
    EXPECT_TRUE(simulation->output().empty());
}

TEST_P(EitherEngine, RunsTwiceTheSame)
{
    body(Path::rectangle({{-300, 200}, {300, 260}}), "in-path-rigid-body", true);
    for (int i = 0; i < 5; ++i)
        body(Path::rectangle({{-10.0 + i, 20.0 + 30 * i}, {15.0 + i, 40.0 + 30 * i}}), "in-path-rigid-body");
    EXPECT_EQ(play(3)->hash(), play(3)->hash());
}

INSTANTIATE_TEST_SUITE_P(Engines, EitherEngine, testing::Values("jet-physics", "physics-box2d"));

TEST_F(OneEngine, WithBox2dASoftBodyStaysAsDrawnAndTheOutputSaysWhy)
{
    const Item& soft = body(Path::ellipse({{-30, 0}, {30, 60}}), "in-path-body");
    const Item& rigid = body(Path::rectangle({{100, 0}, {140, 40}}), "in-path-rigid-body");
    SimulationOptions options;
    options.physics = "physics-box2d";
    const auto simulation = Simulation::start(scene_, options).orThrow();
    for (int i = 0; i < 60; ++i) simulation->step();
    EXPECT_EQ(simulation->bodyOf(soft.id()), kNoHandle);
    EXPECT_GT(simulation->pose(rigid)->bounds().min.y(), 20);
    ASSERT_EQ(simulation->output().size(), 1u);
    EXPECT_NE(simulation->output()[0].text.find("soft bodies"), std::string::npos) << simulation->output()[0].text;
}

TEST_F(OneEngine, AnUnknownEngineIsRefusedWithAListOfThoseInstalled)
{
    SimulationOptions options;
    options.physics = "box3d";
    const auto started = Simulation::start(scene_, options);
    ASSERT_FALSE(started);
    const std::string message = started.error().message;
    EXPECT_NE(message.find("jet-physics (JET Physics)"), std::string::npos) << message;
    EXPECT_NE(message.find("physics-box2d (Box2D 2.4.1)"), std::string::npos) << message;
}

}  // namespace

}  // namespace jet::test
