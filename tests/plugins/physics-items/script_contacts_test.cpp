// Scripts hear when bodies begin and end to touch, by turns whatever lies between two steps.
#include "live_scene.hpp"

namespace jet::test {

namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using Lines = std::vector<std::string>;

constexpr const char* kListen = R"(
    var count = {};
    function key(e) { return e.itemA + '-' + e.itemB; }
    function listen() {
        JetSystem.addEventListener('onContactBegin', function (e) {
            count[key(e)] = (count[key(e)] || 0) + 1;
            print(ctx.step, 'begin', key(e), e.bodyA === e.itemA.body && e.bodyB.item === e.itemB, e.impulse >= 0);
            if (count[key(e)] !== 1) print('begins twice');
        });
        JetSystem.addEventListener('onContactEnd', function (e) {
            count[key(e)] -= 1;
            print(ctx.step, 'end', key(e));
            if (count[key(e)] !== 0) print('ends twice');
        });
    }
)";

class ScriptContacts : public LiveSceneOfEngine {
protected:
    void ground() { name(box({{-500, 100}, {500, 140}}, {{"fixed", true}}), "Ground"); }
    void ball(const Vec2& at, const Properties& properties = {})
    {
        name(box({at - Vec2(10, 10), at + Vec2(10, 10)}, properties), "Ball");
    }
    void listenFrom(int step)
    {
        script(kListen + std::string(step == 0 ? "listen();"
                                               : "JetSystem.addEventListener('onStep', function (e) { if (e.step === " +
                                                     std::to_string(step) + ") listen(); });"));
    }
    void move(const Vec2& to)
    {
        const Item* item = findByName(simulation_->scene().root(), "Ball");
        simulation_->world().setPosition(simulation_->bodyOf(item->id()), to);
        simulation_->world().setVelocity(simulation_->bodyOf(item->id()), {0, 0});
    }
    static Lines without(Lines lines, const std::string& text)
    {
        std::erase_if(lines, [&](const std::string& line) { return line.find(text) != std::string::npos; });
        return lines;
    }
};

TEST_P(ScriptContacts, WhatFallsBeginsToTouchOnceAndEndsWhenItIsTakenAway)
{
    ground(), ball({0, 90}), listenFrom(0);
    play(2);
    ASSERT_EQ(printed().size(), 1u);
    EXPECT_TRUE(printed()[0].ends_with("begin Ground-Ball true true")) << printed()[0];
    move({0, 0});
    play(0.05);
    ASSERT_EQ(printed().size(), 2u);
    EXPECT_EQ(printed()[1], "121 end Ground-Ball");
}

TEST_P(ScriptContacts, TheImpulseStopsWhatFell)
{
    ground(), ball({0, 50});
    script("JetSystem.addEventListener('onContactBegin', function (e) { print(e.impulse > 50, e.impulse < 150); });");
    play(2);
    ASSERT_FALSE(printed().empty());
    EXPECT_EQ(printed()[0], "true true") << "mass 1 at some 89 units/s";
}

// Of the ground, which is drawn first, to the ball, whichever of the two the engine calls A.
TEST_P(ScriptContacts, ABeginningTellsWhereAndWhichWay)
{
    ground(), ball({30, 50});
    script("JetSystem.addEventListener('onContactBegin', function (e) {"
           "    print(e.itemA.name, Math.abs(e.point.x - 30) < 11, Math.abs(e.point.y - 100) < 2,"
           "          Math.abs(e.normal.x) < 0.01, e.normal.y > 0.99);"
           "});");
    play(2);
    ASSERT_FALSE(printed().empty());
    EXPECT_EQ(printed()[0], "Ground true true true true");
}

TEST_P(ScriptContacts, WhoListensLaterHearsOfAllThatTouchAndOfNothingTwice)
{
    ground(), ball({0, 89}), listenFrom(300);
    play(5.5);
    EXPECT_THAT(printed(), ElementsAre("301 begin Ground-Ball true true")) << "though it sleeps";
    move({0, 0});
    play(0.05);
    EXPECT_THAT(printed(), Contains("331 end Ground-Ball"));
}

TEST_P(ScriptContacts, SensorsBeginAndEndToo)
{
    setScene("gravity", Vec2(0, 0));
    name(box({{100, -50}, {120, 50}}, {{"fixed", true}, {"sensor", true}}), "Gate");
    ball({0, 0}, {{"velocity", Vec2(120, 0)}});
    listenFrom(0);
    play(2);
    ASSERT_EQ(printed().size(), 2u);
    EXPECT_TRUE(printed()[0].ends_with("begin Gate-Ball true true")) << printed()[0];
    EXPECT_TRUE(printed()[1].ends_with("end Gate-Ball")) << printed()[1];
}

TEST_P(ScriptContacts, GoingBackTellsWhatDiffersSoThatTouchesStayCounted)
{
    ground(), ball({0, 40}), listenFrom(0);
    play(0.2);
    const auto inTheAir = simulation_->save();
    ASSERT_THAT(printed(), IsEmpty());
    play(2.8);
    const auto onTheGround = simulation_->save();
    const Lines first = without(printed(), "end");  // it may bounce
    ASSERT_FALSE(first.empty());
    const std::size_t before = printed().size();
    simulation_->restore(inTheAir);
    play(0.02);
    ASSERT_EQ(printed().size(), before + 1);
    EXPECT_TRUE(printed().back().ends_with("end Ground-Ball"));
    play(0.02);
    simulation_->restore(onTheGround);
    play(0.02);
    EXPECT_TRUE(printed().back().ends_with("begin Ground-Ball true true"));
    simulation_->restore(onTheGround);
    const std::size_t again = printed().size();
    play(0.5);
    EXPECT_EQ(printed().size(), again) << "nothing differs";
    EXPECT_EQ(without(without(printed(), "begin "), "end "), Lines{}) << "never twice";
}

TEST_P(ScriptContacts, EqualRunsHearTheSameInTheSameOrder)
{
    ground();
    for (int i = 0; i < 12; ++i) name(box({{-240.0 + 40 * i, 20.0 - 3 * i}, {-220.0 + 40 * i, 40.0 - 3 * i}}), "Ball");
    for (int i = 0; i < 12; ++i) name(box({{-236.0 + 40 * i, -20.0 - 3 * i}, {-216.0 + 40 * i, 0.0 - 3 * i}}), "Top");
    script("JetSystem.addEventListener('onContactBegin', function (e) { print(ctx.step, e.itemA.id, e.itemB.id, "
           "e.impulse); });\n"
           "JetSystem.addEventListener('onContactEnd', function (e) { print(ctx.step, e.itemA.id, e.itemB.id); });");
    play(3);
    const Lines first = printed();
    EXPECT_GT(first.size(), 24u);
    simulation_.reset();
    options_.threads = 2;
    play(3);
    EXPECT_EQ(printed(), first);
}

INSTANTIATE_TEST_SUITE_P(Engines, ScriptContacts, testing::Values("jet-physics", "physics-box2d"));

TEST_F(LiveScene, SoftBodiesBeginAndEndToTouch)
{
    name(box({{-500, 100}, {500, 140}}, {{"fixed", true}}), "Ground");
    const ItemId soft = add("shape", Path::ellipse(Box({-30, 20}, {30, 80})), {}, "in-path-body");
    name(soft, "Ball");
    script(kListen + std::string("listen();"));
    play(1);
    ASSERT_FALSE(printed().empty());
    EXPECT_TRUE(printed()[0].ends_with("begin Ground-Ball true true"));
    simulation_->world().setPosition(simulation_->bodyOf(soft), {0, -300});
    play(0.05);
    EXPECT_TRUE(printed().back().ends_with("end Ground-Ball"));
}

}  // namespace

}  // namespace jet::test
