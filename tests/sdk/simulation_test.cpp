// Playing a copy of a scene without a window. Motion is compared with the formula of semi-implicit Euler.
#include "scene_fakes.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace jet {
namespace {

using test::Hooks;
using testing::HasSubstr;

class SimulationTest : public test::SceneFixture {
protected:
    const Item& addBody(const Box& box, const Item* parent = nullptr)
    {
        const Item& body = addBox(box, BodyItem::type, parent);
        auto edit = items().begin("Body");
        edit.addEffect(body, "box-body");
        edit.commit();
        return body;
    }
    std::unique_ptr<Simulation> start(SimulationOptions options = {})
    {
        auto simulation = Simulation::start(scene, std::move(options));
        EXPECT_TRUE(simulation) << simulation.error().text();
        return simulation ? std::move(*simulation) : nullptr;
    }
    std::string refusal(SimulationOptions options = {})
    {
        const auto simulation = Simulation::start(scene, std::move(options));
        return simulation ? "accepted" : simulation.error().text();
    }
    static std::vector<std::string> texts(const Simulation& simulation)
    {
        std::vector<std::string> all;
        for (const OutputLine& line : simulation.output()) all.push_back(line.text);
        return all;
    }
};

TEST_F(SimulationTest, TheEditedSceneIsNeverTouched)
{
    const Item& body = addBody(Box({0, 0}, {10, 10}));
    const auto before = scene.hash();
    const auto simulation = start();
    for (int i = 0; i < 100; ++i) simulation->step();
    simulation->setItemProperty(body.id(), "omega", 3.0);
    simulation->setItemProperty(body.id(), "name", "renamed");
    EXPECT_EQ(scene.hash(), before);
    EXPECT_EQ(simulation->scene().items().find(body.id())->name(), "renamed");
}

TEST_F(SimulationTest, ABodyFallsAndItsPathWithIt)
{
    const Item& body = addBody(Box({0, 0}, {10, 10}));
    auto edit = items().begin("Gravity");
    edit.setScene("gravity", Vec2(0, 60));
    edit.set(body, "velocity", Vec2(6, 0));
    edit.commit();
    const auto simulation = start();
    for (int i = 0; i < 60; ++i) simulation->step();
    // y after n steps of h: g h² n (n+1) / 2, here 60/3600 · 60·61/2
    const Path* pose = simulation->pose(*simulation->scene().items().find(body.id()));
    ASSERT_NE(pose, nullptr);
    EXPECT_NEAR(pose->bounds().min.y(), 30.5, 1e-9);
    EXPECT_NEAR(pose->bounds().min.x(), 6, 1e-9);
    EXPECT_DOUBLE_EQ(simulation->time(), 1);
}

TEST_F(SimulationTest, ATurningBodyTurnsItsPathAboutItsCentre)
{
    const Item& body = addBody(Box({0, 0}, {10, 10}));
    auto edit = items().begin("Spin");
    edit.setScene("gravity", Vec2(0, 0));
    edit.set(body, "omega", 3.0);
    edit.commit();
    const auto simulation = start();
    for (int i = 0; i < 30; ++i) simulation->step();
    const Affine turn = Affine::translation({5, 5}) * Affine::rotation(1.5) * Affine::translation({-5, -5});
    const Box expected = body.path().transformed(turn).bounds();
    const Box box = simulation->pose(*simulation->scene().items().find(body.id()))->bounds();
    EXPECT_LT((box.min - expected.min).norm() + (box.max - expected.max).norm(), 1e-9);
}

TEST_F(SimulationTest, OnlyWhatMovesHasAPose)
{
    const Item& fixed = addBody(Box({0, 0}, {10, 10}));
    const Item& shape = addBox(Box({0, 0}, {1, 1}));
    auto edit = items().begin("Fix");
    edit.set(fixed, "fixed", true);
    edit.commit();
    const auto simulation = start();
    simulation->step();
    for (const Item* item : {&fixed, &shape})
        EXPECT_EQ(simulation->pose(*simulation->scene().items().find(item->id())), nullptr);
    EXPECT_NE(simulation->bodyOf(fixed.id()), kNoHandle);
    EXPECT_EQ(simulation->bodyOf(shape.id()), kNoHandle);
    EXPECT_EQ(simulation->itemOf(simulation->bodyOf(fixed.id())), fixed.id());
}

TEST_F(SimulationTest, EqualRunsGiveEqualHashes)
{
    for (int i = 0; i < 5; ++i) addBody(Box({10.0 * i, 0}, {10.0 * i + 3, 7}));
    const auto run = [&](std::uint64_t seed, int steps) {
        SimulationOptions options;
        options.seed = seed;
        const auto simulation = start(options);
        for (int i = 0; i < steps; ++i) simulation->step(), (void)simulation->random();
        return simulation->hash();
    };
    EXPECT_EQ(run(1, 50), run(1, 50));
    EXPECT_NE(run(1, 50), run(2, 50));
    EXPECT_NE(run(1, 50), run(1, 51));
}

TEST_F(SimulationTest, RandomNumbersAreSpreadEvenly)
{
    const auto simulation = start();
    double sum = 0;
    for (int i = 0; i < 10'000; ++i) {
        const double r = simulation->random();
        ASSERT_GE(r, 0);
        ASSERT_LT(r, 1);
        sum += r;
    }
    EXPECT_NEAR(sum / 10'000, 0.5, 4 / std::sqrt(12.0 * 10'000));  // 4 standard deviations of the mean
}

// --- what cannot be built

TEST_F(SimulationTest, WithoutAPhysicsEngineNothingPlays)
{
    test::TestCatalog none;
    Scene bare("Bare", events, none);
    const auto refused = Simulation::start(bare, {});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("the scene cannot be played: "));
    SimulationOptions other;
    other.physics = "quantum";
    EXPECT_THAT(refusal(other), HasSubstr("quantum"));
}

TEST_F(SimulationTest, AnImpossibleTimeStepIsRefused)
{
    for (const double dt : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e300}) {
        SimulationOptions options;
        options.timeStep = dt;
        EXPECT_THAT(refusal(options), HasSubstr("time-step")) << dt;
    }
}

TEST_F(SimulationTest, ABodyThatCannotBeBuiltStaysAsDrawnWithAWarning)
{
    addBody(Box({0, 0}, {10, 0}));  // no inside
    addBox(Box({0, 0}, {1, 1}), BodyItem::type);
    const Item& fine = addBody(Box({0, 0}, {10, 10}));
    const auto simulation = start();
    EXPECT_EQ(simulation->world().bodyCount(), 1u);
    EXPECT_NE(simulation->bodyOf(fine.id()), kNoHandle);
    EXPECT_THAT(texts(*simulation),
                testing::ElementsAre(HasSubstr("its body cannot be built: its path has no inside; it stays as drawn"),
                                     HasSubstr("no effect builds its body")));
    EXPECT_EQ(simulation->output()[0].kind, OutputLine::Kind::Warning);
}

TEST_F(SimulationTest, AnUnknownMaterialIsTheFirstWithAWarning)
{
    const Item& body = addBody(Box({0, 0}, {10, 10}));
    auto edit = items().begin("Material");
    edit.set(body, "material", "glue");
    edit.commit();
    EXPECT_THAT(texts(*start()), testing::ElementsAre(HasSubstr("no material 'glue'; 'default' is used")));
}

TEST_F(SimulationTest, AnEngineThatThrowsWhileStartingIsAMessage)
{
    struct Broken final : PhysicsEngine {
        std::unique_ptr<PhysicsWorld> createWorld(const WorldSettings&) override
        {
            throw std::runtime_error("no licence");
        }
    };
    catalog.inCode().physicsEngine<Broken>("broken");
    SimulationOptions options;
    options.physics = "broken";
    EXPECT_THAT(refusal(options), HasSubstr("starting it failed: no licence"));
}

// --- anchors and actuators (SPEC PH7)

TEST_F(SimulationTest, ATorqueActsOnTheNearestBodyInTheTreeUnderItsCentre)
{
    const Item& far = addBody(Box({0, 0}, {10, 10}));
    const Item* group = nullptr;
    {
        auto edit = items().begin("Group");
        group = &edit.add<GroupItem>(layer());
        edit.commit();
    }
    const Item& near = addBody(Box({0, 0}, {10, 10}), group);
    const Item& torque = addBox(Box({4, 4}, {6, 6}), TorqueItem::type, group);
    addBody(Box({0, 0}, {10, 10}), group);  // as near, but after the torque
    auto edit = items().begin("Torque");
    edit.set(torque, "value", 60.0);
    edit.commit();
    const auto simulation = start();
    simulation->step();
    const auto omega = [&](const Item& item) {
        return simulation->world().bodies().omega[simulation->bodyOf(item.id())];
    };
    EXPECT_DOUBLE_EQ(omega(near), -1) << "60 to the left for 1/60 s";
    EXPECT_EQ(omega(far), 0);
    simulation->setTorque(torque.id(), 0);
    simulation->step();
    EXPECT_DOUBLE_EQ(omega(near), -1);
    EXPECT_EQ(simulation->torque(torque.id()), 0);
    EXPECT_EQ(torque.properties().find("value")->as<double>(), 60);
}

TEST_F(SimulationTest, ATorqueOverNoBodySaysSo)
{
    addBody(Box({0, 0}, {10, 10}));
    addBox(Box({40, 40}, {60, 60}), TorqueItem::type);
    EXPECT_THAT(texts(*start()), testing::ElementsAre(HasSubstr("no body lies under the torque's centre")));
}

TEST_F(SimulationTest, ASpringJoinsBodyAndBackground)
{
    const Item& body = addBody(Box({0, 0}, {10, 10}));
    auto edit = items().begin("Spring");
    const Item& spring = edit.add<SpringItem>(layer(), Path::line({5, 5}, {100, 5}));
    edit.set(spring, "ks", 3.0);
    const Item& loose = edit.add<SpringItem>(layer());
    edit.commit();
    const auto simulation = start();
    const auto& world = dynamic_cast<const test::FallingWorld&>(simulation->world());
    ASSERT_EQ(world.springs.size(), 1u);
    EXPECT_EQ(world.springs[0].a.body, simulation->bodyOf(body.id()));
    EXPECT_EQ(world.springs[0].b.body, kNoHandle);
    EXPECT_EQ(world.springs[0].b.point, Vec2(100, 5));
    EXPECT_EQ(world.springs[0].ks, 3);
    EXPECT_NE(simulation->actuatorOf(spring.id()), kNoHandle);
    EXPECT_EQ(simulation->actuatorOf(loose.id()), kNoHandle);
    EXPECT_THAT(texts(*simulation), testing::ElementsAre(HasSubstr("a spring needs a path with two ends")));
}

TEST_F(SimulationTest, ASpringTheEngineRefusesDoesNotKeepTheRestFromPlaying)
{
    addBody(Box({0, 0}, {10, 10}));
    auto edit = items().begin("Spring");
    edit.set(edit.add<SpringItem>(layer(), Path::line({5, 5}, {1e13, 5})), "name", std::string("Far"));
    edit.add<SpringItem>(layer(), Path::line({5, 5}, {100, 5}));
    edit.commit();
    const auto simulation = start();
    ASSERT_TRUE(simulation);
    EXPECT_EQ(dynamic_cast<const test::FallingWorld&>(simulation->world()).springs.size(), 1u);
    EXPECT_THAT(texts(*simulation), testing::ElementsAre(AllOf(HasSubstr("'Far'"), HasSubstr("10000000000000"))));
}

// --- scripts

class ScriptedSimulationTest : public SimulationTest {
protected:
    ScriptedSimulationTest()
    {
        auto edit = items().begin("Script");
        const Item& script = edit.add<ScriptItem>(layer());
        edit.set(script, "name", "Script");
        edit.commit();
        script_ = script.id();
    }
    ItemId script_;
};

TEST_F(ScriptedSimulationTest, ScriptErrorsArePrintedNotFatal)
{
    Hooks::now().scriptRun = [](Simulation&, const Item&) -> Result<void> {
        return Error("x is not defined", {"Script", 3, 0});
    };
    const auto simulation = start();
    ASSERT_EQ(simulation->output().size(), 1u);
    EXPECT_EQ(simulation->output()[0].kind, OutputLine::Kind::Error);
    EXPECT_EQ(simulation->output()[0].script, script_);
    EXPECT_EQ(simulation->output()[0].line, 3);
}

TEST_F(ScriptedSimulationTest, EventsComeInOrder)
{
    std::string heard;
    Hooks::now().scriptEvent = [&](Simulation& s, const ScriptEvent& e) {
        switch (e.kind) {
        case ScriptEventKind::Step: heard += 's'; break;
        case ScriptEventKind::KeyDown: heard += 'd'; break;
        case ScriptEventKind::KeyTyped: heard += 't'; break;
        case ScriptEventKind::KeyUp: heard += 'u'; break;
        case ScriptEventKind::PrePaint: heard += '('; break;
        case ScriptEventKind::PostPaint: heard += ')'; break;
        default: heard += '?'; break;
        }
        if (e.kind == ScriptEventKind::KeyDown) {
            EXPECT_TRUE(s.isPressed("D"));
        }
    };
    const auto simulation = start();
    simulation->key({"D", "D", {}, false}, true);
    simulation->step();
    simulation->key({"D", "", {}, false}, false);
    EXPECT_FALSE(simulation->isPressed("D"));
    EXPECT_EQ(heard, "dts()u");
}

TEST_F(ScriptedSimulationTest, OutputIsBounded)
{
    const auto simulation = start();
    for (int i = 0; i < 10'100; ++i) simulation->print(std::to_string(i));
    EXPECT_EQ(simulation->output().size(), 10'000u);
    EXPECT_EQ(simulation->output().back().text, "10099");
}

TEST_F(ScriptedSimulationTest, AnEngineWithoutQueriesSaysSoInsteadOfFindingNothing)
{
    addBody(Box({0, 0}, {10, 10}));
    const auto simulation = start();
    const PhysicsWorld& world = simulation->world();
    const auto refusal = HasSubstr("has no queries of what is where; choose another one");
    EXPECT_THAT(failure([&] { world.rayCast({-10, 5}, {20, 5}); }), refusal);
    EXPECT_THAT(failure([&] { world.shapeCast({ShapeDef::Kind::Circle, {{-10, 5}}, 2}, {20, 0}); }), refusal);
    EXPECT_THAT(failure([&] { world.overlapping(Box({0, 0}, {1, 1})); }), refusal);
    EXPECT_THAT(failure([&] { world.nearest({-10, 5}, 100); }), refusal);
}

TEST_F(ScriptedSimulationTest, LiveTuningIsChecked)
{
    const Item& body = addBody(Box({0, 0}, {10, 10}));
    const auto simulation = start();
    const auto id = body.id();
    EXPECT_THAT(failure([&] { simulation->setItemProperty(id, "omega", 1e9); }), HasSubstr("must be from"));
    EXPECT_THAT(failure([&] { simulation->setItemProperty(id, "speed", 1); }), HasSubstr("has no property 'speed'"));
    EXPECT_THAT(failure([&] { simulation->setItemProperty(ItemId{999}, "omega", 1); }),
                HasSubstr("not in the playing scene"));
    simulation->setItemProperty(id, "omega", 2);
    EXPECT_EQ(*simulation->scene().items().find(id)->properties().find("omega"), Value(2.0));
}

// --- the state file (DESIGN §5)

TEST_F(ScriptedSimulationTest, TheStateTellsItemsAndOutput)
{
    const Item& body = addBody(Box({0, 0}, {10, 10}));
    const auto simulation = start();
    simulation->print("Żółw");
    simulation->print(std::string("bad \xff"));
    for (int i = 0; i < 6; ++i) simulation->step();
    const auto state = nlohmann::json::parse(simulation->stateJson());
    EXPECT_EQ(state["step"], 6);
    EXPECT_DOUBLE_EQ(state["time"], 0.1);
    EXPECT_THAT(state["hash"].get<std::string>(), testing::MatchesRegex("[0-9a-f]{16}"));
    EXPECT_EQ(state["output"][0], "Żółw");
    const auto found = std::find_if(state["items"].begin(), state["items"].end(),
                                    [&](const auto& i) { return i["id"] == body.id().value; });
    ASSERT_NE(found, state["items"].end());
    EXPECT_EQ((*found)["type"], "body");
    EXPECT_EQ((*found)["name"], body.name());
    for (const char* pair : {"position", "velocity"}) EXPECT_EQ((*found)[pair].size(), 2u);
    EXPECT_EQ((*found)["bounds"].size(), 4u);
    EXPECT_TRUE((*found)["angle"].is_number() && (*found)["omega"].is_number());
    const double g = 98.1, h = 1.0 / 60;
    EXPECT_NEAR((*found)["position"][1].get<double>(), 5 + g * h * h * 21, 1e-9);
    EXPECT_NEAR((*found)["velocity"][1].get<double>(), g * 0.1, 1e-9);
}

}  // namespace
}  // namespace jet
