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

/// The spring of the hand bears the weight: m g = k x, k = m w² of 5 Hz.
TEST_P(EitherEngine, AHandHoldsABodyThatHangsAsItsStiffnessSays)
{
    const Item& box = body(Path::rectangle({{-15, -15}, {15, 15}}), "in-path-rigid-body");
    const auto simulation = play(0);
    ASSERT_EQ(simulation->grab({0, 0}), box.id());
    for (int i = 0; i < 240; ++i) simulation->step();
    const double omega = 2 * 3.14159265358979 * 5;
    EXPECT_NEAR(simulation->world().bodies().position[simulation->bodyOf(box.id())].y(), 98.1 / (omega * omega), 0.01);
    simulation->letGo();
    EXPECT_FALSE(simulation->held());
}

TEST_P(EitherEngine, OneGoesBackPastADragAndPlaysTheSameAgain)
{
    body(Path::rectangle({{-300, 200}, {300, 260}}), "in-path-rigid-body", true);
    const Item& box = body(Path::rectangle({{-15, 160}, {15, 190}}), "in-path-rigid-body");
    body(Path::rectangle({{60, 160}, {90, 190}}), "in-path-rigid-body");
    const auto simulation = play(0);
    std::vector<std::vector<std::byte>> states;
    std::vector<std::uint64_t> hashes;
    const auto goOn = [&](std::uint64_t from) {
        for (std::uint64_t step = from; step < 90; ++step) {
            if (step == states.size()) states.push_back(simulation->save()), hashes.push_back(simulation->hash());
            ASSERT_EQ(simulation->hash(), hashes[step]) << "from " << from << ", step " << step;
            if (step == 20) {
                ASSERT_EQ(simulation->grab(simulation->world().bodies().position[simulation->bodyOf(box.id())]),
                          box.id());
            }
            if (step > 20 && step < 60) simulation->drag({3.0 * static_cast<double>(step - 20), 120});
            if (step == 60) simulation->letGo();
            simulation->step();
        }
    };
    goOn(0);
    for (const std::uint64_t from : {70U, 40U, 10U, 60U, 20U, 21U, 0U}) {
        simulation->restore(states[from]);
        EXPECT_EQ(simulation->held().has_value(), from > 20 && from <= 60);
        goOn(from);
    }
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
