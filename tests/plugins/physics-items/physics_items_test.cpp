// Joints, forces and force fields as items: what they lie over is what they hold or push, at play.
#include "support/recording_painter.hpp"
#include "support/test_catalog.hpp"

#include <jet/item_type.hpp>
#include <jet/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace jet::test {

namespace {

using testing::HasSubstr;

class PhysicsItemsTest : public testing::Test {
protected:
    PhysicsItemsTest() : scene_("Scene", events_, catalog_) {}

    ItemId body(const Box& box, Properties properties = {})
    {
        auto edit = scene_.items().begin("Body");
        const Item& item = edit.add<ShapeItem>(scene_.root(), Path::rectangle(box));
        edit.addEffect(item, "in-path-rigid-body");
        for (const auto& [id, value] : properties.entries()) edit.set(item, id, value);
        edit.commit();
        return item.id();
    }
    ItemId add(const char* type, Path path, Properties properties)
    {
        auto edit = scene_.items().begin("Add");
        const Item& item = edit.add(type, scene_.root(), std::move(path));
        for (const auto& [id, value] : properties.entries()) edit.set(item, id, value);
        edit.commit();
        return item.id();
    }
    void noGravity()
    {
        auto edit = scene_.items().begin("No gravity");
        edit.setScene("gravity", Vec2(0, 0));
        edit.commit();
    }
    static Path line(std::initializer_list<Vec2> points) { return Path::polygon(std::vector<Vec2>(points), false); }
    /// With Box2D where joints are tried: it holds bodies of any outline.
    std::unique_ptr<Simulation> play(double seconds, const char* engine = "jet-physics")
    {
        SimulationOptions options;
        options.physics = engine;
        auto simulation = Simulation::start(scene_, options).orThrow();
        while (simulation->time() < seconds) simulation->step();
        return simulation;
    }
    bool hasBox2d()
    {
        try {
            catalog_.load("org.jet.physics-box2d");
            return true;
        } catch (const Failure&) {
            return false;
        }
    }
    static Vec2 at(const Simulation& simulation, ItemId item)
    {
        return simulation.world().bodies().position[simulation.bodyOf(item)];
    }

    TestCatalog catalog_{"org.jet.physics", "org.jet.items.physics", "org.jet.effect.in-path-rigid-body"};
    EventsCenter events_;
    Scene scene_;
};

TEST_F(PhysicsItemsTest, AHingeHoldsABodyAtTheMiddleOfItsPath)
{
    if (!hasBox2d()) GTEST_SKIP() << "built without Box2D";
    const ItemId bob = body({{90, -10}, {110, 10}});
    add("joint", line({{0, 0}, {0, 0}, {100, 0}}), {{"kind", "revolute"}});
    const auto simulation = play(1.5, "physics-box2d");
    EXPECT_TRUE(simulation->output().empty());
    EXPECT_NEAR(at(*simulation, bob).norm(), 100, 1);
    EXPECT_GT(at(*simulation, bob).y(), 30) << "it swings";
}

TEST_F(PhysicsItemsTest, ARopeAndAPulleyGoFromBodyToBody)
{
    if (!hasBox2d()) GTEST_SKIP() << "built without Box2D";
    const ItemId light = body({{-30, 90}, {-10, 110}}), heavy = body({{10, 80}, {50, 120}});
    auto edit = scene_.items().begin("Mass");
    edit.setEffect(*scene_.items().find(heavy), 0, "mass", 3.0);
    edit.commit();
    add("joint", line({{-20, 100}, {-20, 0}, {30, 0}, {30, 100}}), {{"kind", "pulley"}});
    const auto simulation = play(0.5, "physics-box2d");
    ASSERT_EQ(simulation->world().jointCount(), 1u);
    EXPECT_LT(at(*simulation, light).y(), 96);
    EXPECT_NEAR(at(*simulation, light).y() + at(*simulation, heavy).y(), 200, 1);
}

TEST_F(PhysicsItemsTest, AJointThatCannotBeMadeSaysWhyAndTheGamePlays)
{
    body({{0, 0}, {50, 50}});
    add("joint", line({{10, 10}, {40, 40}}), {{"kind", "weld"}});
    add("joint", line({{500, 0}, {600, 0}}), {{"kind", "rope"}});
    add("joint", line({{10, 10}, {600, 0}}), {{"kind", "pulley"}});
    const auto simulation = play(0.1);
    ASSERT_EQ(simulation->output().size(), 3u);
    EXPECT_THAT(simulation->output()[0].text, HasSubstr("both ends lie in one body"));
    EXPECT_THAT(simulation->output()[1].text, HasSubstr("no body lies under either end"));
    EXPECT_THAT(simulation->output()[2].text, HasSubstr("four points"));
    EXPECT_EQ(simulation->world().jointCount(), 0u);
}

TEST_F(PhysicsItemsTest, AForcePushesTheBodyUnderItsCentreAlwaysTheSameWay)
{
    noGravity();
    for (const char* engine : {"jet-physics", "physics-box2d"}) {
        if (std::string_view(engine) == "physics-box2d" && !hasBox2d()) continue;
        const ItemId pushed = body({{-20, -20}, {20, 20}}, {{"omega", 2.0}}), other = body({{100, -20}, {140, 20}});
        add("force", line({{-5, 0}, {5, 0}}), {{"value", Vec2(30, -40)}});
        const auto simulation = play(1, engine);
        EXPECT_TRUE(simulation->output().empty());
        EXPECT_NEAR((simulation->world().bodies().velocity[simulation->bodyOf(pushed)] - Vec2(30, -40)).norm(), 0, 1);
        EXPECT_NEAR((at(*simulation, other) - Vec2(120, 0)).norm(), 0, 1e-9);
        auto edit = scene_.items().begin("Clear");
        while (!scene_.root().children().empty()) edit.remove(*scene_.root().children().back());
        edit.commit();
    }
}

TEST_F(PhysicsItemsTest, AForceOffTheCentreTurnsItsBody)
{
    noGravity();
    const ItemId pushed = body({{-20, -20}, {20, 20}});
    add("force", line({{10, 0}, {20, 0}}), {{"value", Vec2(0, 40)}});
    const auto simulation = play(0.2);
    EXPECT_GT(simulation->world().bodies().omega[simulation->bodyOf(pushed)], 0.1) << "clockwise";
}

TEST_F(PhysicsItemsTest, AForceOnNothingSaysSo)
{
    add("force", line({{10, 0}, {20, 0}}), {{"value", Vec2(0, 40)}});
    add("force", Path(), {});
    const auto simulation = play(0.1);
    ASSERT_EQ(simulation->output().size(), 2u);
    EXPECT_THAT(simulation->output()[0].text, HasSubstr("no body lies under the force's centre"));
    EXPECT_THAT(simulation->output()[1].text, HasSubstr("needs a path"));
}

TEST_F(PhysicsItemsTest, AMotorWithoutForceSaysThatItDoesNothing)
{
    body(Box({0, 0}, {10, 10}));
    const Path path = line({{-20, 5}, {5, 5}});
    const auto saying = [&](Properties properties) {
        const ItemId joint = add("joint", path, std::move(properties));
        const auto simulation = play(0);
        std::string text;
        for (const OutputLine& each : simulation->output()) text += each.text;
        auto edit = scene_.items().begin("Remove");
        edit.remove(*scene_.items().find(joint));
        edit.commit();
        return text;
    };
    EXPECT_THAT(saying({{"kind", "revolute"}, {"driven", true}, {"motor-speed", 1.0}}), HasSubstr("max-torque is 0"));
    EXPECT_THAT(saying({{"kind", "wheel"}, {"driven", true}}), HasSubstr("max-torque is 0"));
    EXPECT_THAT(saying({{"kind", "prismatic"}, {"driven", true}}), HasSubstr("max-force is 0"));
    EXPECT_THAT(saying({{"kind", "mouse"}}), HasSubstr("max-force is 0"));
    EXPECT_THAT(saying({{"kind", "motor"}}), HasSubstr("max-force and max-torque are 0"));
    EXPECT_EQ(saying({{"kind", "revolute"}, {"driven", true}, {"max-torque", 1.0}}), "");
    EXPECT_EQ(saying({{"kind", "motor"}, {"max-torque", 1.0}}), "");
    EXPECT_EQ(saying({{"kind", "prismatic"}}), "");
}

TEST_F(PhysicsItemsTest, ABodyThatIsRefusedIsCalledByItsNameAlone)
{
    body(Box({0, 0}, {10, 10}), {{"velocity", Vec2(1e300, 0)}});
    const auto simulation = play(0);
    ASSERT_EQ(simulation->output().size(), 1U);
    const std::string text = simulation->output()[0].text;
    EXPECT_THAT(text, HasSubstr("its body cannot be built: initial velocity's x"));
    EXPECT_THAT(text, testing::Not(HasSubstr(".;")));
}

TEST_F(PhysicsItemsTest, AFieldPushesWhatIsWithinItsPath)
{
    const Properties floating{{"gravity-scale", 0.0}};
    const ItemId in = body({{0, 0}, {10, 10}}, floating), out = body({{200, 0}, {210, 10}}, floating);
    add("force-field", Path::rectangle({{-20, -200}, {30, 40}}), {{"kind", "directional"}, {"vector", Vec2(0, -50)}});
    const auto simulation = play(1);
    EXPECT_TRUE(simulation->output().empty());
    EXPECT_NEAR(at(*simulation, in).y(), 5 - 25, 1);
    EXPECT_NEAR(at(*simulation, out).y(), 5, 1e-6);
}

TEST_F(PhysicsItemsTest, AnEngineWithoutFieldsSaysSoAndPlays)
{
    if (!hasBox2d()) GTEST_SKIP() << "built without Box2D";
    body({{0, 0}, {10, 10}});
    add("force-field", Path::rectangle({{-20, -20}, {30, 40}}), {{"kind", "vortex"}});
    const auto simulation = play(0.1, "physics-box2d");
    ASSERT_EQ(simulation->output().size(), 1u);
    EXPECT_THAT(simulation->output()[0].text, HasSubstr("no fields of force"));
}

TEST_F(PhysicsItemsTest, BodiesTakeTheirPropertiesToTheWorld)
{
    if (!hasBox2d()) GTEST_SKIP() << "built without Box2D";
    const ItemId lift = body({{0, 0}, {50, 10}}, {{"kinematic", true}, {"velocity", Vec2(0, -10)}});
    const ItemId ghost = body({{100, 0}, {110, 10}}, {{"mask", std::int64_t{2}}});
    body({{80, 40}, {140, 60}}, {{"fixed", true}});
    const auto simulation = play(2, "physics-box2d");
    EXPECT_NEAR(at(*simulation, lift).y(), 5 - 20, 0.5);
    EXPECT_GT(at(*simulation, ghost).y(), 100) << "it meets layer 2 only";
}

TEST_F(PhysicsItemsTest, NoneIsInAPictureAndJointsAloneAreSeenAtPlay)
{
    for (const std::string type : {"joint", "force", "force-field"}) {
        const Item& item = *scene_.items().find(add(type.c_str(), line({{0, 0}, {10, 0}, {10, 10}}), {}));
        for (const PaintPurpose purpose : {PaintPurpose::Edit, PaintPurpose::Play, PaintPurpose::Export}) {
            RecordingPainter painter;
            catalog_.itemType(type)->paint(item, item.path(), purpose, painter);
            const bool seen = purpose == PaintPurpose::Edit || (purpose == PaintPurpose::Play && type == "joint");
            EXPECT_EQ(!painter.strokes().empty(), seen) << type;
        }
    }
}

}  // namespace

}  // namespace jet::test
