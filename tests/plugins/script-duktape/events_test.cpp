#include "fake_physics.hpp"
#include "script_fixture.hpp"

namespace jet::test {

class ScriptEventsTest : public ScriptTest {
protected:
    void dispatchCollision() { step(); }
};

TEST_F(ScriptEventsTest, ListenersAreCalledInTheOrderOfAddingAndRemoved)
{
    script("Script", R"(
        function second() { print('second'); JetSystem.removeEventListener('onStep', second); }
        JetSystem.addEventListener(JetSystem.EVENT_TYPE_ONSTEP, function () { print('first'); });
        JetSystem.addEventListener('onStep', second);
        JetSystem.addEventListener('onStep', second);  // already listens
        JetSystem.addEventListener('onStep', function () { print('third'); });
    )");
    play();
    step(2);
    EXPECT_EQ(printed(), (Lines{"first", "second", "third", "first", "third"}));
}

TEST_F(ScriptEventsTest, AStepIsFollowedByItsCollisionsAndThenByPaintEvents)
{
    body("A", Box({0, 0}, {10, 10}));
    body("B", Box({5, 5}, {15, 15}));
    script("Script", R"(
        ['onPostPaint', 'onPrePaint', 'onBodyCollision', 'onStep'].forEach(function (type) {
            JetSystem.addEventListener(type, function (e) { print(e.type, ctx.step); });
        });
    )");
    play();
    step(2);
    EXPECT_EQ(printed(), (Lines{"onStep 0", "onBodyCollision 1", "onPrePaint 1", "onPostPaint 1", "onStep 1",
                                "onBodyCollision 2", "onPrePaint 2", "onPostPaint 2"}));
}

TEST_F(ScriptEventsTest, ListenersMayAddAndRemoveOthersWhileBeingCalled)
{
    script("Script", R"(
        function late() { print('late'); }
        function victim() { print('victim'); }
        JetSystem.addEventListener('onStep', function adder() {
            print('adder');
            JetSystem.removeEventListener('onStep', adder);
            JetSystem.removeEventListener('onStep', victim);
            JetSystem.addEventListener('onStep', late);
        });
        JetSystem.addEventListener('onStep', victim);
    )");
    play();
    step(2);
    EXPECT_EQ(printed(), (Lines{"adder", "late"}));
}

TEST_F(ScriptEventsTest, AListenerSeesTheItemOfTheScriptThatAddedIt)
{
    for (const char* name : {"One", "Two"})
        script(name, "JetSystem.addEventListener('onStep', function () { print(script.name); });");
    play();
    step(2);
    EXPECT_EQ(printed(), (Lines{"One", "Two", "One", "Two"}));
}

TEST_F(ScriptEventsTest, KeyEventsTellKeyTextAndModifiers)
{
    script("Script", R"(
        ['onKeyDown', 'onKeyUp', 'onKeyTyped'].forEach(function (type) {
            JetSystem.addEventListener(type, function (e) { print(e.type, e.key, e.text, e.shift, e.alt, e.control, e.repeat); });
        });
    )");
    play();
    KeyEvent key{"A", "ą", {true, false, false}, false};
    simulation().key(key, true);
    simulation().key(key, false);
    EXPECT_EQ(printed(), (Lines{"onKeyDown A ą true false false false", "onKeyTyped A ą true false false false",
                                "onKeyUp A ą true false false false"}));
}

TEST_F(ScriptEventsTest, PointerEventsTellWhereAndWithWhichButton)
{
    script("Script", R"(
        ['onPointerDown', 'onPointerMove', 'onPointerUp'].forEach(function (type) {
            JetSystem.addEventListener(type, function (e) { print(e.type, e.x, e.y, e.point, e.pixels, e.button, e.control); });
        });
    )");
    play();
    const PointerEvent pointer{{1, 2}, {10, 20}, PointerButton::Right, {false, false, true}};
    simulation().pointer(ScriptEventKind::PointerDown, pointer);
    simulation().pointer(ScriptEventKind::PointerMove, pointer);
    simulation().pointer(ScriptEventKind::PointerUp, pointer);
    EXPECT_EQ(printed(),
              (Lines{"onPointerDown 1 2 (1, 2) (10, 20) right true", "onPointerMove 1 2 (1, 2) (10, 20) right true",
                     "onPointerUp 1 2 (1, 2) (10, 20) right true"}));
}

TEST_F(ScriptEventsTest, WhoDragsIsToldWhetherAnyoneListensToThePointer)
{
    for (const char* type : {"onPointerDown", "onPointerMove", "onPointerUp"}) {
        script("Script", std::string("function hear() {} JetSystem.addEventListener('onStep', function (e) {"
                                     "    if (e.step === 1) JetSystem.addEventListener('") +
                             type + "', hear); if (e.step === 2) JetSystem.removeEventListener('" + type +
                             "', hear); });");
        play();
        EXPECT_FALSE(simulation().listensToPointer()) << type;
        bool heard = false;
        for (int i = 0; i < 4; ++i) step(), heard |= simulation().listensToPointer();
        EXPECT_TRUE(heard) << type;
        EXPECT_FALSE(simulation().listensToPointer()) << type;
    }
}

TEST_F(ScriptEventsTest, CollisionEventsNameBothItemsAndTheContact)
{
    body("A", Box({0, 0}, {10, 10}));
    body("B", Box({5, 5}, {15, 15}));
    script("Script", R"(
        JetSystem.addEventListener('onBodyCollision', function (e) {
            print(e.type, e.itemA, e.itemB, e.bodyA === e.itemA.body, e.bodyB === e.itemB.body, e.point, e.normal, e.penetration, e.impulse);
        });
    )");
    play();
    step();
    EXPECT_EQ(printed(), Lines{"onBodyCollision A B true true (5, 5) (0, -1) 0.5 2"});
}

TEST_F(ScriptEventsTest, ConstantsNameAllEvents)
{
    EXPECT_EQ(run(R"(
        var names = [];
        for (var k in JetSystem) if (typeof JetSystem[k] === 'string') names.push(k.replace('EVENT_TYPE_', '') + '=' + JetSystem[k]);
        print(names.join(' '));
    )"),
              Lines{"ONSTEP=onStep ONPREPAINT=onPrePaint ONPOSTPAINT=onPostPaint ONKEYUP=onKeyUp ONKEYDOWN=onKeyDown "
                    "ONKEYTYPED=onKeyTyped ONBODYCOLLISION=onBodyCollision ONPOINTERDOWN=onPointerDown "
                    "ONPOINTERUP=onPointerUp ONPOINTERMOVE=onPointerMove "
                    "ONCONTACTBEGIN=onContactBegin ONCONTACTEND=onContactEnd"});
}

TEST_F(ScriptEventsTest, TheEngineIsAskedForContactEventsWhileSomebodyListens)
{
    body("Ball", Box({0, 0}, {10, 10}));
    script("Script", R"(
        function listener() {}
        JetSystem.addEventListener('onStep', function (e) {
            if (e.step === 3) JetSystem.addEventListener('onContactEnd', listener);
            if (e.step === 5) JetSystem.removeEventListener('onContactEnd', listener);
        });
    )");
    play();
    const auto& world = dynamic_cast<const FakeWorld&>(simulation().world());
    step(3);
    EXPECT_EQ(world.eventsAsked, 0);
    step(2);
    EXPECT_EQ(world.eventsAsked, 2);
    step(3);
    EXPECT_EQ(world.eventsAsked, 2);
}

TEST_F(ScriptEventsTest, AnUnknownEventIsRefusedWithTheKnownOnes)
{
    script("Script", "\nJetSystem.addEventListener('onstep', function () {});");
    play();
    EXPECT_EQ(printed(),
              Lines{"Script:2: error: TypeError: addEventListener: no event is called \"onstep\"; there are onStep, "
                    "onPrePaint, onPostPaint, onKeyDown, onKeyUp, onKeyTyped, onBodyCollision, onPointerDown, "
                    "onPointerUp, onPointerMove, onContactBegin, onContactEnd"});
}

TEST_F(ScriptEventsTest, AFailingListenerIsRemovedWithScriptAndLineAndTheOthersGoOn)
{
    script("Bad", "JetSystem.addEventListener('onStep', function () {\n  null.x;\n});");
    const Item& good = script("Good", "JetSystem.addEventListener('onStep', function () { print('good'); });");
    play();
    step(2);
    EXPECT_EQ(printed(),
              (Lines{"Bad:2: error: TypeError: cannot read property 'x' of null; its onStep listener was removed",
                     "good", "good"}));
    EXPECT_EQ(errors().at(0).line, 2);
    EXPECT_EQ(errors().at(0).script, good.priorSibling()->id());
}

TEST_F(ScriptEventsTest, ErrorsOfScriptsNameScriptAndLineWhateverIsThrown)
{
    const struct {
        const char* code;
        const char* error;
        int line;
    } cases[] = {
        {"\n\nvar x = y;", "Case:3: error: ReferenceError: identifier 'y' undefined", 3},
        {"var a = 1;\nif (", "Case:2: error: SyntaxError: parse error", 2},
        {"\nthrow 'text';", "Case:2: error: uncaught \"text\"", 2},
        {"\nthrow 42;", "Case:2: error: uncaught 42", 2},
        {"\nthrow null;", "Case:2: error: uncaught null", 2},
        {"\nthrow { toString: function () { throw 1; } };", "Case:2: error: an error that cannot be shown as text", 2},
        {"\nthrow { toString: function () { for (;;); } };", "Case:2: error: an error that cannot be shown as text", 2},
        {"function f() {\n  throw new Error('deep');\n}\n[1].forEach(f);", "Case:2: error: Error: deep", 2},
        {"\n\n\n[3, 2].sort(1);", "Case:4: error: TypeError: ", 4},
        {"\nJSON.parse('{');", "Case:2: error: SyntaxError: ", 2},
        {"var e = new Error('x');\ne.stack = 'at f (Other:7)';\nthrow e;", "Case:1: error: Error: x", 1},
        {"\neval('1;\\n2;\\nnull.x');", "Case:2: error: TypeError: ", 2},
        {"\nnew Vec2d().add(undefined);", "Case:2: error: TypeError: cannot read property 'x' of undefined", 2},
    };
    for (const auto& one : cases) {
        SCOPED_TRACE(one.code);
        const Item& item = script("Case", one.code);
        play();
        ASSERT_EQ(errors().size(), 1u);
        EXPECT_EQ(errors()[0].text.substr(0, std::string(one.error).size()), one.error) << errors()[0].text;
        EXPECT_EQ(errors()[0].line, one.line);
        EXPECT_EQ(errors()[0].script, item.id());
        auto edit = scene_->items().begin("Remove");
        edit.remove(item);
        edit.commit();
    }
}

TEST_F(ScriptEventsTest, AnErrorInAFunctionOfAnotherScriptNamesThatScript)
{
    script("Library", "\nfunction half(v) {\n  return v.x / 2;\n}");
    script("User", "JetSystem.addEventListener('onStep', function () {\n half(); });");
    play();
    step();
    ASSERT_EQ(errors().size(), 1u);
    EXPECT_EQ(errors()[0].text.substr(0, 17), "Library:3: error:");
}

TEST_F(ScriptEventsTest, ScriptsOfTheSameNameAreToldApart)
{
    const Item& one = script("SI", "");
    const Item& two = script("SI", "\nnull.x");
    play();
    ASSERT_EQ(errors().size(), 1u);
    EXPECT_EQ(errors()[0].text.substr(0, 5), "SI:2:");
    EXPECT_EQ(errors()[0].script, two.id());
    EXPECT_NE(errors()[0].script, one.id());
}

TEST_F(ScriptEventsTest, NamesThatLookLikeTracebacksDoNotConfuse)
{
    const Item& odd = script("f (Other:7)\n at x", "\nnull.x");
    play();
    ASSERT_EQ(errors().size(), 1u);
    EXPECT_EQ(errors()[0].script, odd.id());
    EXPECT_EQ(errors()[0].line, 2);
}

}  // namespace jet::test
