#include "script_fixture.hpp"

namespace jet::test {

class ScriptItemsTest : public ScriptTest {};

TEST_F(ScriptItemsTest, TheSameItemIsTheSameObject)
{
    body("Ball", Box({0, 0}, {10, 10}));
    EXPECT_EQ(run(R"(
        var tg = ItemUtils.getTopGroup(script), ball = ItemUtils.getItemByName('Ball', tg);
        print(ball === script.getPriorSibling(), ball === tg.getChildList()[0], tg === ball.parent, tg === CC.getScene('Scene 0').getTopGroup());
        print(ball.body === ball.body, ball.body.item === ball, ball.body.velocity === ball.body.velocity);
        ball.score = 7;  // scripts may keep things of their own in items
        print(ItemUtils.getItemByName('Ball', tg).score);
    )"),
              (Lines{"true true true true", "true true true", "7"}));
}

TEST_F(ScriptItemsTest, NeighboursParentsAndChildrenFollowTheTree)
{
    const Item& layer = group("Layer");
    shape("First", &layer);
    script("Script", R"(
        print(script.getPriorSibling(), script.getSibling(), script.parent, script.getParent());
        print(script.parent.getChildList().join());
        print(script.getSibling().getSibling(), script.getPriorSibling().getPriorSibling(), script.parent.parent.parent);
    )",
           &layer);
    shape("Last", &layer);
    play();
    EXPECT_EQ(printed(), (Lines{"First Last Layer Layer", "First,Script,Last", "null null null"}));
}

TEST_F(ScriptItemsTest, ItemsTellTheirNameTypeIdAndFlags)
{
    const Item& ball = body("Ball", Box({0, 0}, {10, 10}));
    EXPECT_EQ(run(R"(
        var b = script.getPriorSibling();
        print(b.name, b.type, b.id, b.visible, b.locked, b.torque, b.spring, script.body);
        b.visible = false;
        print(b.visible);
    )"),
              (Lines{"Ball body " + std::to_string(ball.id().value) + " true false null null null", "false"}));
    EXPECT_FALSE(simulation().scene().items().find(ball.id())->visible());
    EXPECT_TRUE(ball.visible()) << "the edited scene was touched";
}

// Thesis figure 3.4.5.4: a copied group's script finds its own sibling.
TEST_F(ScriptItemsTest, TheNearestItemOfANameIsTheScriptsOwnSibling)
{
    const std::string code = "print(ItemUtils.getClosestItemByName('Body', script).parent.name);";
    for (const char* name : {"Enemy 1", "Enemy 2"}) {
        const Item& enemy = group(name);
        body("Body", Box({0, 0}, {10, 10}), &enemy);
        script("SI", code, &enemy);
    }
    play();
    EXPECT_EQ(printed(), (Lines{"Enemy 1", "Enemy 2"}));
}

TEST_F(ScriptItemsTest, TheNearestIsSoughtInSiblingsThenTheirChildrenThenUpwards)
{
    shape("Target");
    const Item& outer = group("Outer");
    const Item& inner = group("Inner", &outer);
    const Item& deep = group("Deep", &inner);
    shape("Target", &deep);
    script("Script", R"(
        var nearest = ItemUtils.getClosestItemByName('Target', script);
        print(nearest.parent.name, ItemUtils.getItemByName('Target', ItemUtils.getTopGroup(script)) === nearest);
        print(ItemUtils.getClosestItemByName('Nobody', script), ItemUtils.getItemByName('Nobody', script.parent));
    )",
           &inner);
    play();
    EXPECT_EQ(printed(), (Lines{"Deep false", "null null"}));
}

TEST_F(ScriptItemsTest, PropertiesAreReadAndSetByTheirIds)
{
    body("Ball", Box({0, 0}, {10, 10}));
    EXPECT_EQ(run(R"(
        var b = script.getPriorSibling();
        print(b.get('fixed'), b.get('gravity-scale'), b.get('velocity'), b.get('name'), b.has('fixed'), b.has('ks'));
        b.set('gravity-scale', 2.5);
        b.set('velocity', new Vec2d(1, 2));
        b.set('group', 7);
        print(b.get('gravity-scale'), b.get('velocity').y, b.body.velocity.y, b.get('group'));
    )"),
              (Lines{"false 1 (0, 0) Ball true false", "2.5 2 2 7"}));
}

TEST_F(ScriptItemsTest, WrongPropertiesAreRefusedWithTheReason)
{
    body("Ball", Box({0, 0}, {10, 10}));
    Lines lines = run(R"(
        var b = script.getPriorSibling();
        [function () { b.get('wings'); }, function () { b.set('omega', 'fast'); }, function () { b.set('omega', NaN); },
         function () { b.type = 'shape'; }, function () { ItemUtils.getTopGroup({}); }, function () { b.set('omega', 1e9); }]
        .forEach(function (f) { try { f(); } catch (e) { print(e); } });
    )");
    ASSERT_EQ(lines.size(), 6u);
    EXPECT_NE(lines[5].find("1000000"), std::string::npos) << lines[5];  // the range, as the SDK words it
    lines.pop_back();
    EXPECT_EQ(
        lines,
        (Lines{"TypeError: get: \"Ball\" has no property \"wings\"; it has name, visible, locked, fixed, material, "
               "velocity, omega, gravity-scale, sensor, kinematic, fixed-rotation, one-sided, group, layer, mask, "
               "allow-sleep",
               "TypeError: set: expected a finite number, got \"fast\"",
               "TypeError: set: expected a finite number, got NaN", "TypeError: type: this cannot change while playing",
               "TypeError: getTopGroup: expected an item, got an object"}));
}

TEST_F(ScriptItemsTest, ASpringTellsItsValuesAndTakesOthers)
{
    const Item& spring = add("spring", "Spring", Path::line({0, 0}, {10, 0}), nullptr);
    set(spring, "ks", 42.0);
    EXPECT_EQ(run(R"(
        var s = script.getPriorSibling().spring;
        print(s.ks, s.kd, s.restLength, s.tearRatio, s.restAngle, s.item);
        s.restLength = 7;
        try { s.ks = -1; } catch (e) { print(s.item.get('rest-length'), s.ks, /must be from/.test(e)); }
    )"),
              (Lines{"42 0.1 -1 0 undefined Spring", "7 42 true"}));
}

}  // namespace jet::test
