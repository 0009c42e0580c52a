// What is changed while a scene plays counts for the world, with either engine, and for nothing but this run.
#include "live_scene.hpp"

namespace jet::test {

namespace {

using testing::HasSubstr;

class LiveChanges : public LiveSceneOfEngine {
protected:
    /// A disc about the origin that a motor of the background turns.
    ItemId motor(double speed)
    {
        return add("joint", line({{100, 0}, {0, 0}, {0, 0}}),
                   {{"kind", "revolute"}, {"driven", true}, {"motor-speed", speed}, {"max-torque", 1e6}});
    }
    /// Seconds from one turning point of the body's way along x to the next but one.
    double period(ItemId body)
    {
        std::vector<double> turns;
        double before = velocity(body).x();
        while (turns.size() < 5) {
            const double at = simulation_->time();
            simulation_->step();
            const double now = velocity(body).x();
            if (before * now < 0) turns.push_back(at + simulation_->timeStep() * before / (before - now));
            before = now;
        }
        return (turns[4] - turns[0]) / 2;
    }
};

TEST_P(LiveChanges, AScriptTurnsAMotorRoundAndTheWheelTurnsTheOtherWay)
{
    const ItemId wheel = box({{-20, -20}, {20, 20}});
    const ItemId axle = motor(4);
    auto edit = scene_.items().begin("Script");
    edit.set(*scene_.items().find(axle), "name", "Axle");
    edit.commit();
    add("script", {},
        {{"code", "var axle = ItemUtils.getItemByName('Axle', ItemUtils.getTopGroup(script));\n"
                  "JetSystem.addEventListener('onStep', function (e) {\n"
                  "    if (e.step === 60) axle.set('motor-speed', -2);\n"
                  "});"}});
    play(1);
    EXPECT_NEAR(omega(wheel), 4, 0.04);
    play(1);
    EXPECT_NEAR(omega(wheel), -2, 0.02);
    EXPECT_TRUE(simulation_->output().empty());
    set(axle, "driven", false);
    play(1);
    EXPECT_NEAR(omega(wheel), -2, 0.02) << "nothing drives or brakes it";
    set(axle, "driven", true);
    set(axle, "motor-speed", 0.0);
    play(1);
    EXPECT_NEAR(omega(wheel), 0, 0.02);
}

TEST_P(LiveChanges, WhatWeighsLessThanNothingRises)
{
    const ItemId body = box({{-10, -10}, {10, 10}});
    play(1);
    EXPECT_NEAR(velocity(body).y(), 98.1, 1e-3);
    set(body, "gravity-scale", -1.0);
    play(2);
    EXPECT_NEAR(velocity(body).y(), -98.1, 1e-3);
    set(body, "velocity", Vec2(3, 0));
    EXPECT_NEAR(velocity(body).x(), 3, 1e-5);
}

TEST_P(LiveChanges, ASpringOfFourTimesTheStiffnessSwingsTwiceAsFast)
{
    setScene("gravity", Vec2(0, 0));
    setScene("time-step", 1.0 / 240);  // Box2D's springs, forces of one step, are true for short ones
    const ItemId body = box({{50, -10}, {70, 10}});
    const ItemId spring = add("spring", line({{0, 0}, {60, 0}}), {{"ks", 100.0}, {"kd", 0.0}, {"rest-length", 50.0}});
    play(0.1);
    const double before = period(body);
    EXPECT_NEAR(before, 2 * 3.14159265 / 10, 0.02);  // of mass 1: 2 pi / sqrt(ks / m)
    set(spring, "ks", 400.0);
    EXPECT_NEAR(before / period(body), 2, 0.04);
}

TEST_P(LiveChanges, ARestLengthBelowNullIsThatOfTheDrawing)
{
    setScene("gravity", Vec2(0, 0));
    const ItemId body = box({{50, -10}, {70, 10}});
    const ItemId spring = add("spring", line({{0, 0}, {60, 0}}), {{"ks", 100.0}, {"kd", 10.0}});
    play(1);
    for (const auto& [length, wanted] : {std::pair(40.0, 40.0), std::pair(-1.0, 60.0)}) {
        set(spring, "rest-length", length);
        play(4);
        EXPECT_NEAR(place(body).x(), wanted, 0.1) << length;
    }
}

TEST_P(LiveChanges, AMaterialIsThatOfTheMoment)
{
    auto edit = scene_.items().begin("Ice");
    MaterialTable table;
    table.add("ice");
    table.setPair(0, 1, {0, 0, true});
    edit.setMaterials(table);
    edit.commit();
    box({{-500, 20}, {500, 60}}, {{"fixed", true}});
    const ItemId body = box({{-210, 0}, {-170, 20}}, {{"velocity", Vec2(60, 0)}});
    play(0.25);
    const double slowed = velocity(body).x();
    EXPECT_LT(slowed, 50);
    set(body, "material", "ice");
    play(0.5);
    EXPECT_NEAR(velocity(body).x(), slowed, 0.5);
    EXPECT_THAT(refusal(body, "material", "snow"), HasSubstr("'material' stays as it is while playing: the scene has"));
    EXPECT_EQ(*simulation_->scene().items().find(body)->properties().find("material"), Value("ice"));
}

TEST_P(LiveChanges, AMassIsThatOfTheMoment)
{
    setScene("gravity", Vec2(0, 0));
    const ItemId body = box({{-10, -10}, {10, 10}});
    play(0.1);
    set(body, "mass", 4.0);
    simulation_->world().applyImpulse(simulation_->bodyOf(body), Vec2(8, 0));
    play(0.1);
    EXPECT_NEAR(velocity(body).x(), 2, 1e-5);
}

TEST_P(LiveChanges, AnAngularSpringTakesAnotherAngleAndStrength)
{
    const ItemId wheel = box({{-20, -20}, {20, 20}});
    add("joint", line({{100, 0}, {0, 0}, {0, 0}}), {{"kind", "revolute"}});
    const ItemId spring =
        add("rspring", line({{100, 0}, {0, 0}, {15, 0}}), {{"ks", 1e5}, {"kd", 1e4}, {"rest-angle", 1.0}});
    const auto angle = [&] { return simulation_->world().bodies().angle[simulation_->bodyOf(wheel)]; };
    play(0.5);
    EXPECT_NEAR(angle(), 0, 0.01);
    set(spring, "rest-as-drawn", false);
    play(2);
    EXPECT_NEAR(angle(), 1, 0.01);
    set(spring, "rest-angle", -0.5);
    play(2);
    EXPECT_NEAR(angle(), -0.5, 0.01);
    set(spring, "rest-as-drawn", true);
    play(2);
    EXPECT_NEAR(angle(), 0, 0.01);
    set(spring, "ks", 0.0), set(spring, "kd", 0.0);
    simulation_->world().setOmega(simulation_->bodyOf(wheel), 2);
    play(1);
    EXPECT_NEAR(omega(wheel), 2, 0.05);
}

TEST_P(LiveChanges, WhatCannotChangeIsNamedAndLeftAlone)
{
    const ItemId wheel = box({{-20, -20}, {20, 20}});
    const ItemId axle = motor(4);
    play(0.5);
    const auto hash = simulation_->hash();
    EXPECT_THAT(refusal(axle, "kind", "weld"), HasSubstr("'kind' stays as it is while playing: a joint stays"));
    EXPECT_THAT(refusal(axle, "lower", 5.0), HasSubstr("'lower' stays as it is while playing: "));
    EXPECT_THAT(refusal(wheel, "fixed", true), HasSubstr("'fixed' stays as it is while playing: "));
    EXPECT_EQ(simulation_->hash(), hash);
    const auto stored = [&](ItemId item, const char* id) {
        const Value* value = simulation_->scene().items().find(item)->properties().find(id);
        return value ? *value : Value();
    };
    EXPECT_EQ(stored(axle, "kind"), Value("revolute"));
    EXPECT_EQ(stored(axle, "lower").as<double>(), 0);
    play(0.5);
    EXPECT_NEAR(omega(wheel), 4, 0.2);
}

TEST_P(LiveChanges, TheNextRunIsThatOfTheScene)
{
    const ItemId body = box({{-20, -20}, {20, 20}});
    const ItemId axle = motor(4);
    const auto asDrawn = play(1).hash();
    for (int run = 0; run < 2; ++run) {
        simulation_.reset();
        play(0.5);
        set(axle, "motor-speed", -2.0);
        set(body, "mass", 3.0);
        EXPECT_NE(play(0.5).hash(), asDrawn);
        simulation_.reset();
        EXPECT_EQ(play(1).hash(), asDrawn);
    }
}

TEST_P(LiveChanges, AForceIsThatOfTheMomentAndAScriptSetsIt)
{
    setScene("gravity", Vec2(0, 0));
    const ItemId pushed = box({{-20, -20}, {20, 20}});
    const ItemId force = add("force", line({{-5, 0}, {5, 0}}), {{"value", Vec2(60, 0)}});
    name(force, "Push");
    script(R"(
        var item = ItemUtils.getItemByName('Push', ItemUtils.getTopGroup(script)), push = item.force;
        JetSystem.addEventListener('onStep', function (e) {
            if (e.step === 60) push.setValue(-120, 0);
            if (e.step === 90) push.value = new Vec2d(0, 60);
            if (e.step === 150) print(push.value, item.get('value'), push.getValue().x, push.item === item, script.force);
            if (e.step === 150) push.setValue({ x: 0, y: 0 });
            if (e.step === 150) try { push.setValue(NaN, 0); } catch (problem) { print(problem instanceof TypeError); }
        });
    )");
    play(1);
    EXPECT_NEAR(velocity(pushed).x(), 60, 1);
    play(0.5);
    EXPECT_NEAR(velocity(pushed).x(), 0, 2);
    play(2);
    EXPECT_NEAR(velocity(pushed).y(), 60, 1) << "for a second, then nothing";
    EXPECT_THAT(printed(), testing::ElementsAre("(0, 60) (0, 60) 0 true null", "true"));
}

INSTANTIATE_TEST_SUITE_P(Engines, LiveChanges, testing::Values("jet-physics", "physics-box2d"));

TEST_F(LiveScene, FieldsPushAsTheyAreSet)
{
    const ItemId body = box({{90, -10}, {110, 10}}, {{"gravity-scale", 0.0}});
    const ItemId radial =
        add("force-field", Path::rectangle({{-500, -500}, {500, 500}}), {{"kind", "radial"}, {"strength", -50.0}});
    const ItemId wind = add("force-field", {}, {{"kind", "directional"}, {"vector", Vec2(0, 0)}});
    play(0.5);
    EXPECT_NEAR(velocity(body).x(), -25, 0.5);
    set(radial, "strength", 50.0);
    play(0.5);
    EXPECT_NEAR(velocity(body).x(), 0, 0.5);
    set(radial, "strength", 0.0);
    set(wind, "vector", Vec2(0, 30));
    play(0.5);
    EXPECT_NEAR(velocity(body).y(), 15, 0.5);
    EXPECT_THAT(refusal(wind, "kind", "drag"), HasSubstr("'kind' stays as it is while playing: a field stays"));
}

TEST_F(LiveScene, SoftBodiesSwellAndStiffen)
{
    setScene("gravity", Vec2(0, 0));
    const ItemId ball = add("shape", Path::ellipse({{-50, -50}, {50, 50}}), {}, "in-path-body");
    const auto area = [&] { return std::abs(simulation_->pose(*simulation_->scene().items().find(ball))->area()); };
    play(1);
    const double atRest = area();
    set(ball, "pressure", 3.0);
    set(ball, "kd", 3.0);
    play(3);
    const double swollen = area();
    EXPECT_GT(swollen, 1.05 * atRest);
    set(ball, "ks", 1000.0);
    play(3);
    EXPECT_NEAR(area(), atRest, 0.2 * (swollen - atRest)) << "a hundred times stiffer";
    set(ball, "mass", 5.0);
    simulation_->world().applyImpulse(simulation_->bodyOf(ball), Vec2(10, 0));
    play(0.1);
    EXPECT_NEAR(velocity(ball).x(), 2, 1e-6);
    const auto hash = simulation_->hash();
    EXPECT_THAT(refusal(ball, "cell-size", Vec2(5, 5)),
                HasSubstr("'cell-size' stays as it is while playing: it decides what the body is made of"));
    EXPECT_EQ(simulation_->hash(), hash);
}

TEST_F(LiveScene, ScriptsReadAndSetWhatTheEffectOfABodyHas)
{
    box({{-10, -10}, {10, 10}});
    add("script", {},
        {{"code", "var box = script.getPriorSibling();\n"
                  "print(box.has('mass'), box.get('mass'), box.has('ks'));\n"
                  "box.set('mass', 2);\n"
                  "print(box.get('mass'));\n"
                  "try { box.set('fixed', true); } catch (e) { print(e); }"}});
    play(0.1);
    ASSERT_EQ(simulation_->output().size(), 3u);
    EXPECT_EQ(simulation_->output()[0].text, "true 1 false");
    EXPECT_EQ(simulation_->output()[1].text, "2");
    EXPECT_THAT(simulation_->output()[2].text, HasSubstr("'fixed' stays as it is while playing"));
}

}  // namespace

}  // namespace jet::test
