// Joints in the hands of scripts: what they tell, and what moves them, alike with both engines.
#include "live_scene.hpp"

namespace jet::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ScriptJoints : public LiveSceneOfEngine {
protected:
    /// A script that has the item "Joint" as `item`, its joint as `joint`, and calls `each(step)` before each step.
    void control(const std::string& code)
    {
        script("var top = ItemUtils.getTopGroup(script);\n"
               "function find(name) { return ItemUtils.getItemByName(name, top); }\n"
               "var item = find('Joint'), joint = item.joint;\n"
               "function round(x) { return Math.round(x * 10) / 10; }\n"
               "function each() {}\n" +
               code + "\nJetSystem.addEventListener('onStep', function (e) { each(e.step); });");
    }
    ItemId joint(Path path, const Properties& properties)
    {
        const ItemId item = add("joint", std::move(path), properties);
        name(item, "Joint");
        return item;
    }
    double angle(ItemId item) { return simulation_->world().bodies().angle[simulation_->bodyOf(item)]; }
};

TEST_P(ScriptJoints, AMotorTurnsClockwiseAndTheAngleIsTold)
{
    setScene("gravity", Vec2(0, 0));
    const ItemId wheel = box({{-20, -20}, {20, 20}});
    joint(line({{100, 0}, {0, 0}, {0, 0}}), {{"kind", "revolute"}, {"max-torque", 1e6}});
    control(R"(
        print(joint.kind, joint.motor, joint.motorSpeed, joint.broken, joint.item === item, joint);
        each = function (step) {
            if (step === 0) joint.setMotor(true, 2);
            if (step === 60) print(joint.motor, joint.motorSpeed, item.get('driven'), round(joint.value));
            if (step === 60) joint.motorSpeed = -2;
            if (step === 120) joint.setMotor(false);
            if (step === 121) print(joint.motor, round(joint.value));
        };
    )");
    play(1);
    EXPECT_NEAR(omega(wheel), 2, 0.05);
    EXPECT_NEAR(angle(wheel), 2, 0.1) << "clockwise on screen";
    play(1.1);
    EXPECT_NEAR(omega(wheel), -2, 0.05);
    EXPECT_THAT(printed(), ElementsAre("revolute false 0 false true joint Joint", "true 2 true 2", "false 0"));
}

TEST_P(ScriptJoints, WhatAJointBearsActsOnB)
{
    const ItemId weight = box({{-10, -10}, {10, 10}});
    auto edit = scene_.items().begin("Mass");
    edit.setEffect(*scene_.items().find(weight), 0, "mass", 2.0);
    edit.commit();
    joint(line({{0, -100}, {0, 0}}), {{"kind", "distance"}});
    control(R"(
        each = function (step) {
            if (step < 60) return;
            print(Math.abs(joint.force.x) < 1, round(joint.force.y), Math.round(joint.value),
                  Math.round(joint.pointA.y), Math.abs(joint.pointB.y) < 1);
            each = function () {};
        };
    )");
    play(1.1);
    EXPECT_THAT(printed(), ElementsAre("true -196.2 100 -100 true"));
}

TEST_P(ScriptJoints, ASlideTellsItsTravel)
{
    setScene("gravity", Vec2(0, 0));
    box({{-10, -10}, {10, 10}});
    joint(line({{0, 100}, {0, 0}, {0, 0}}),
          {{"kind", "prismatic"}, {"axis", Vec2(1, 0)}, {"max-force", 1e6}, {"driven", true}, {"motor-speed", 30.0}});
    control("each = function (step) { if (step === 60) print(Math.round(joint.value)); };");
    play(1.1);
    EXPECT_THAT(printed(), ElementsAre("30"));
}

TEST_P(ScriptJoints, OneThatBreaksSaysSo)
{
    box({{-10, -10}, {10, 10}});
    joint(line({{0, -100}, {0, 0}}), {{"kind", "distance"}, {"break-force", 1000.0}});
    control(R"(
        each = function (step) {
            if (step === 30) print(joint.broken);
            if (step >= 30 && step < 40) find('Box').body.applyForce(0, 2000);
            if (step === 40) print(joint.broken);
        };
    )");
    for (const auto& child : scene_.root().children())
        if (child->is<BodyItem>() || child->type() == "shape") name(child->id(), "Box");
    play(1);
    EXPECT_THAT(printed(), ElementsAre("false", "true"));
}

TEST_P(ScriptJoints, AMouseJointDragsItsBodyWhileTheButtonIsDown)
{
    setScene("gravity", Vec2(0, 0));
    const ItemId dragged = box({{-10, -10}, {10, 10}});
    name(dragged, "Box");
    joint(line({{0, 0}, {0, 300}}), {{"kind", "mouse"}, {"hertz", 5.0}});
    control(R"(
        var body = find('Box').body;
        joint.maxForce = 0;
        JetSystem.addEventListener('onPointerDown', function (e) {
            if (!body.contains(e.point)) return print('missed');
            joint.setTarget(e.point);
            joint.maxForce = 1e6;
        });
        JetSystem.addEventListener('onPointerMove', function (e) { if (joint.maxForce > 0) joint.setTarget(e.x, e.y); });
        JetSystem.addEventListener('onPointerUp', function () { joint.maxForce = 0; });
    )");
    play(0.5);
    EXPECT_NEAR(place(dragged).norm(), 0, 1e-6) << "nothing pulls yet";
    const auto pointer = [&](ScriptEventKind kind, const Vec2& at) {
        simulation_->pointer(kind, {at, at, PointerButton::Left, {}});
    };
    pointer(ScriptEventKind::PointerDown, {100, 100});
    pointer(ScriptEventKind::PointerMove, {150, 100});
    play(0.5);
    EXPECT_NEAR(place(dragged).norm(), 0, 1e-6);
    pointer(ScriptEventKind::PointerDown, {3, 2});
    pointer(ScriptEventKind::PointerMove, {150, 80});
    play(2);
    EXPECT_NEAR((place(dragged) - Vec2(150, 80)).norm(), 0, 2);
    pointer(ScriptEventKind::PointerUp, {150, 80});
    pointer(ScriptEventKind::PointerMove, {0, 0});
    play(1);
    EXPECT_NEAR((place(dragged) - Vec2(150, 80)).norm(), 0, 4) << "let go";
    EXPECT_THAT(printed(), ElementsAre("missed"));
}

TEST_P(ScriptJoints, WhatAMouseJointLetsGoFallsAsWhatIsHeldByNothing)
{
    const ItemId dropped = box({{-10, -10}, {10, 10}});
    joint(line({{0, 0}, {100, 0}}), {{"kind", "mouse"}, {"hertz", 4.0}, {"max-force", 1e5}});
    control("each = function (step) { if (step === 60) joint.maxForce = 0; };");
    play(1);
    const double height = place(dropped).y();
    play(1);
    EXPECT_NEAR(velocity(dropped).y(), 98.1, 12);
    EXPECT_NEAR(place(dropped).y() - height, 49, 8);
}

TEST_P(ScriptJoints, OneThatIsRemovedHoldsNothing)
{
    const ItemId weight = box({{-10, -10}, {10, 10}});
    joint(line({{0, -100}, {0, 0}}), {{"kind", "distance"}});
    control(R"(
        function refused(act) { try { act(); print('accepted'); } catch (e) { print(e.message); } }
        each = function (step) {
            if (step === 60) { joint.remove(); refused(function () { joint.remove(); }); }
            if (step === 70) { refused(function () { joint.broken; }); refused(function () { joint.setMotor(true, 3); }); }
        };
    )");
    play(1);
    EXPECT_NEAR(place(weight).y(), 0, 1);
    play(1);
    EXPECT_GT(place(weight).y(), 40) << "it fell";
    EXPECT_THAT(printed(), testing::AllOf(testing::SizeIs(3), testing::Each(HasSubstr("was removed"))));
}

TEST_P(ScriptJoints, WhatIsNoNumberAndWhatIsMeasuredIsRefused)
{
    name(box({{-10, -10}, {10, 10}}), "Box");
    joint(line({{0, -100}, {0, 0}}), {{"kind", "distance"}});
    name(add("joint", line({{500, 500}, {600, 600}}), {}), "Nothing");
    control(R"(
        function refused(act) { try { act(); print('accepted'); } catch (e) { print(e instanceof TypeError, e.message); } }
        print(find('Box').joint, find('Nothing').joint);
        refused(function () { joint.setMotor(); });
        refused(function () { joint.setMotor(true, NaN); });
        refused(function () { joint.setTarget(1); });
        refused(function () { joint.value = 3; });
        refused(function () { joint.force = new Vec2d(); });
        print(joint.motor);
    )");
    play(0);
    const auto lines = printed();
    ASSERT_EQ(lines.size(), 8u);  // the first is the warning of the joint without a body
    EXPECT_EQ(lines[1], "null null");
    EXPECT_EQ(lines[2], "true setMotor: 'on' must be true or false");
    EXPECT_THAT(lines[3], HasSubstr("expected a finite number, got NaN"));
    EXPECT_THAT(lines[4], HasSubstr("true setTarget: expected a finite number, got undefined"));
    EXPECT_EQ(lines[5], "true value: this is measured, not set");
    EXPECT_EQ(lines[6], "true force: this is measured, not set");
    EXPECT_EQ(lines[7], "false");
}

INSTANTIATE_TEST_SUITE_P(Engines, ScriptJoints, testing::Values("jet-physics", "physics-box2d"));

}  // namespace

}  // namespace jet::test
