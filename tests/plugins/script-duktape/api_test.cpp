// What is in the global scope besides items and events: bodies, vectors, keyboard, view, context, time, output.
#include "script_fixture.hpp"

namespace jet::test {

class ScriptApiTest : public ScriptTest {};

TEST_F(ScriptApiTest, Vec2dChangesInPlaceAndItsGettersDoNot)
{
    EXPECT_EQ(run(R"(
        var a = new Vec2d(3, 4), b = new Vec2d(a);
        print(a.getMagnitude(), a.dot(new Vec2d(1, 2)), a.cross(new Vec2d(1, 2)), a.getDistance(new Vec2d(0, 0)));
        print(a.add(new Vec2d(1, 1)), a.sub(new Vec2d(2, 1)), a.scale(2), a.become(b), a.set(0, 5), b);
        print(b.getScaled(2), b.getPerp(), b.getNormalized(), b.getAdded(a), b.getSubbed(a), b);
        print(a.normalize(), new Vec2d().normalize(), new Vec2d(1, 0).rotate(Math.PI / 2).y, b.clone().equals(b), new Vec2d(7));
    )"),
              (Lines{"5 11 2 5", "(0, 5) (0, 5) (0, 5) (0, 5) (0, 5) (3, 4)",
                     "(6, 8) (-4, 3) (0.6, 0.8) (3, 9) (3, -1) (3, 4)", "(0, 1) (0, 0) 1 true (7, 0)"}));
}

TEST_F(ScriptApiTest, ABodysVectorsAreLive)
{
    body("Ball", Box({0, 0}, {10, 20}));
    script("Script", R"(
        var b = ItemUtils.getClosestItemByName('Ball', script).body;
        var position = b.position, copy = new Vec2d(position);
        b.velocity.x = 60;
        b.velocity.add(new Vec2d(0, 30));
        b.omega = 6;
        JetSystem.addEventListener('onStep', function (event) {
            if (event.step === 1) print(position, copy, b.velocity, b.angle, b.omega, b.getPosition(), b.getVelocity());
            if (event.step === 1) b.position = { x: 50, y: 50 };
            if (event.step === 2) { print(position); b.setVelocity(1, 2); print(b.velocity); }
        });
    )");
    play();
    step(3);
    EXPECT_EQ(printed(), (Lines{"(6, 10.5) (5, 10) (60, 30) 0.1 6 (6, 10.5) (60, 30)", "(51, 50.5)", "(1, 2)"}));
}

TEST_F(ScriptApiTest, ForcesImpulsesAreasAndPlacesOfABody)
{
    body("Ball", Box({0, 0}, {10, 20}));
    body("Wall", Box({5, 0}, {30, 20}));
    body("Far", Box({500, 0}, {510, 20}));
    script("Script", R"(
        var tg = script.parent, b = ItemUtils.getItemByName('Ball', tg).body, area = b.getBoundingArea();
        print(area.x, area.y, area.width, area.height, area.getCenter(), area.contains(new Vec2d(1, 1)), area);
        print(b.contains(1, 1), b.contains(new Vec2d(-1, 1)), b);
        print(b.isTouching(ItemUtils.getItemByName('Wall', tg)), b.isTouching(ItemUtils.getItemByName('Far', tg).body));
        b.applyImpulse(3, 0);
        b.applyForce(new Vec2d(0, 60));
        print(b.velocity);
        JetSystem.addEventListener('onStep', function (event) { if (event.step === 1) print(b.velocity); });
    )");
    play();
    step(2);
    EXPECT_EQ(printed(), (Lines{"0 0 10 20 (5, 10) true (0, 0) 10 x 20", "true false body of Ball", "true false",
                                "(3, 0)", "(3, 1)"}));
}

TEST_F(ScriptApiTest, NumbersThatWouldRuinTheWorldAreRefused)
{
    body("Ball", Box({0, 0}, {10, 20}));
    EXPECT_EQ(run(R"(
        var b = script.getPriorSibling().body, view = CC.getScene('Scene 0').GC.swingSimulationGP;
        [function () { b.setVelocity(NaN, 0); }, function () { b.velocity.x = Infinity; }, function () { b.applyForce('x'); },
         function () { view.setViewScale(0); }, function () { view.setViewAnchor(1); }, function () { b.angle = 1; },
         function () { b.setVelocity.call({}, 1, 1); }]
        .forEach(function (f) { try { f(); } catch (e) { print(e); } });
        print(b.velocity, view.getViewScale());
    )"),
              (Lines{"TypeError: setVelocity: expected a finite number, got NaN",
                     "TypeError: x: expected a finite number, got Infinity",
                     "TypeError: applyForce: expected a finite number, got \"x\"",
                     "RangeError: setViewScale: the scale must be above 0, got 0",
                     "TypeError: setViewAnchor: expected a finite number, got undefined",
                     "TypeError: angle: a body turns by its omega; its angle cannot be set",
                     "TypeError: setVelocity: must be called on a body", "(0, 0) 1"}));
}

TEST_F(ScriptApiTest, TheCollisionTableIsTrueExactlyWhileTwoTouch)
{
    body("A", Box({0, 0}, {10, 10}));
    body("B", Box({5, 5}, {15, 15}));
    body("C", Box({50, 50}, {60, 60}));
    shape("Drawing");
    EXPECT_EQ(run(R"(
        var tg = script.parent;
        function cti(name) { return ItemUtils.getItemByName(name, tg).body.cti; }
        var t = ctx.colTab, a = cti('A'), b = cti('B'), c = cti('C');
        print(t[a][b], t[b][a], t[a][c], t[a][a], t[String(a)][String(b)]);
        print(t[undefined][a], t[a][undefined], t[99][98], t[-1][0], t.length, t[a]['x']);
        print(t[a] === t[a]);
        ItemUtils.getItemByName('B', tg).body.setPosition(200, 200);
        print(t[a][b], t[b][c]);
    )"),
              (Lines{"true true false false true", "false undefined false false [object Object] undefined", "true",
                     "false false"}));
}

TEST_F(ScriptApiTest, TheKeyboardTellsWhatIsPressed)
{
    script("Script", R"(
        var a = Keyboard.getKey('A'), left = Keyboard.getKey('Left');
        print(a === Keyboard.getKey('a'), a.name, Keyboard.getKey(' ').name, Keyboard.getKey('ż'));
        for (var i = 0; i < 2; i++) Keyboard.getKey('Banana');  // warned of once
        JetSystem.addEventListener('onStep', function () { print(a.isPressed(), left.isPressed()); });
    )");
    play();
    simulation().setKey("A", true);
    step();
    simulation().setKey("A", false), simulation().setKey("Left", true);
    step();
    EXPECT_EQ(printed(), (Lines{"true A Space ż",
                                "Script:4: warning: no key is called \"Banana\"; keys are \"A\" to \"Z\", \"0\" to "
                                "\"9\", \"Left\", \"Space\", "
                                "\"Enter\", \"F1\" and so on",
                                "true false", "false true"}));
    EXPECT_EQ(lines(OutputLine::Kind::Warning).at(0).line, 4);
}

TEST_F(ScriptApiTest, TheViewIsReadAndMoved)
{
    script("Script", R"(
        var view = CC.getScene('Scene 0').GC.swingSimulationGP;
        print(view.getWidth(), view.getHeight(), view.getViewScale(), view.getViewAnchor());
        view.setViewScale(2);
        view.setViewAnchor(3, 4);
        view.setViewAnchor(view.getViewAnchor().add(new Vec2d(1, 1)));
    )");
    SimulationOptions options;
    options.viewSize = {640, 480};
    play(options);
    EXPECT_EQ(printed(), Lines{"640 480 1 (0, 0)"});
    EXPECT_EQ(simulation().view().view.scale, 2);
    EXPECT_EQ(simulation().view().view.anchor, Vec2(4, 5));
}

TEST_F(ScriptApiTest, OtherScenesHaveAFacadeAndUnknownOnesGiveNull)
{
    Scene menu("Menu", events_, catalog_);
    script("Script", R"(
        var menu = CC.getScene('Menu');
        print(menu, menu === CC.getScene('Menu'), CC.getScene('Scene 0'), menu.getTopGroup());
        menu.GC.swingSimulationGP.setViewScale(5);
        print(CC.getScene('Nowhere'));
        JetSystem.playScene('Menu');
    )");
    SimulationOptions options;
    options.sceneByName = [&](std::string_view name) { return name == "Menu" ? &menu : nullptr; };
    play(options);
    EXPECT_EQ(printed(),
              (Lines{"Menu true Scene 0 null",
                     "Script:5: warning: there is no scene \"Nowhere\"; the running one is \"Scene 0\"", "null"}));
    EXPECT_EQ(simulation().view().view.scale, 1);
    EXPECT_EQ(simulation().requestedScene(), "Menu");
}

TEST_F(ScriptApiTest, TimeIsSimulatedTime)
{
    script("Script", R"(
        print(System.currentTimeMillis(), Date.now(), new Date().getTime(), new Date(0).getHours(), ctx.time, ctx.step, ctx.timeStep === 1 / 60);
        JetSystem.addEventListener('onStep', function () {
            if (ctx.step === 90) print(System.currentTimeMillis(), new Date().toISOString(), ctx.time);
        });
    )");
    play();
    step(91);
    EXPECT_EQ(printed(), (Lines{"0 0 0 0 0 0 true", "1500 1970-01-01T00:00:01.500Z 1.5"}));
}

TEST_F(ScriptApiTest, GravityIsLive)
{
    body("Ball", Box({0, 0}, {10, 20}));
    script("Script", R"(
        print(ctx.gravity, ctx.gravity === ctx.gravity);
        ctx.gravity.y = 60;
        JetSystem.addEventListener('onStep', function (e) {
            if (e.step === 1) { print(script.getPriorSibling().body.velocity); ctx.gravity = new Vec2d(-60, 0); print(ctx.gravity); }
            if (e.step === 2) print(script.getPriorSibling().body.velocity);
        });
    )");
    play();
    step(3);
    EXPECT_EQ(printed(), (Lines{"(0, 0) true", "(0, 1)", "(-60, 0)", "(-1, 1)"}));
}

TEST_F(ScriptApiTest, EverythingIsPrintedAsText)
{
    script("Script", R"(
        print('a', 1, null, undefined, [1, 2], {}, true);
        println('zażółć', '😀', '\uD83D\uDE00');
        CC.GUIC.printlnToOutput(script);
        console.log('log');
        print();
        print(Symbol('s'));
        console.warn('careful');
        console.error('bad');
    )");
    play();
    EXPECT_EQ(printed(), (Lines{"a 1 null undefined 1,2 [object Object] true", "zażółć 😀 😀", "Script", "log", "",
                                "Symbol()", "Script:8: warning: careful", "Script:9: error: bad"}));
    EXPECT_EQ(errors().at(0).script, scene_->root().children()[0]->id());
}

TEST_F(ScriptApiTest, EqualSeedsGiveEqualRandomNumbersAndOthersDoNot)
{
    script("Script", "print(Math.random(), Math.random(), [5, 3, 8, 1].sort().join());");
    const auto output = [&](std::uint64_t seed) {
        SimulationOptions options;
        options.seed = seed;
        play(options);
        return printed();
    };
    const Lines first = output(1);
    EXPECT_EQ(output(1), first);
    EXPECT_NE(output(2), first);
}

TEST_F(ScriptApiTest, EqualRunsGiveEqualHashes)
{
    body("Ball", Box({0, 0}, {10, 20}));
    script("Script", R"(
        var ball = script.getPriorSibling().body, counts = {};
        JetSystem.addEventListener('onStep', function () {
            ball.applyForce(Math.random() - 0.5, Math.sin(Date.now()));
            ball.omega += [3, 1, 2].sort(function () { return Math.random() - 0.5; })[0];
            var key = 'k' + Math.floor(Math.random() * 50);
            counts[key] = (counts[key] || 0) + 1;
            for (var k in counts) ball.omega += counts[k] * 1e-6;
            if (Math.random() < 0.01) print(ball.position);
        });
    )");
    play();
    step(500);
    const std::uint64_t hash = simulation().hash();
    const Lines output = printed();
    play();
    step(500);
    EXPECT_EQ(simulation().hash(), hash);
    EXPECT_EQ(printed(), output);
}

TEST_F(ScriptApiTest, NamesWithCharactersBeyondTheBasicPlaneAreFound)
{
    shape("Kot 😺");
    EXPECT_EQ(run(R"(
        var cat = ItemUtils.getItemByName('Kot 😺', script.parent);
        print(cat.name, cat.name === 'Kot \uD83D\uDE3A', cat.name.length);
    )"),
              Lines{"Kot 😺 true 6"});
}

}  // namespace jet::test
