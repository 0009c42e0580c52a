// Scripts ask what is where, and both engines answer alike.
#include "live_scene.hpp"

namespace jet::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A wall of x 100 to 120 on layer 2, a box of x 200 to 220 behind it, and a sensor of x 50 to 60 before both.
class ScriptQueries : public LiveSceneOfEngine {
protected:
    void build()
    {
        setScene("gravity", Vec2(0, 0));
        name(box({{100, -50}, {120, 50}}, {{"fixed", true}, {"layer", std::int64_t{2}}}), "Wall");
        name(box({{200, -10}, {220, 10}}), "Box");
        name(box({{50, -10}, {60, 10}}, {{"sensor", true}, {"fixed", true}}), "Gate");
    }
    std::vector<std::string> run(const std::string& code)
    {
        build();
        script(R"(
            function at(x, y) { return new Vec2d(x, y); }
            function round(v) { return Math.round(v * 100) / 100; }
            function show(hit) {
                if (!hit) return print(hit);
                print(hit.item, hit.body === hit.item.body, Math.round(hit.point.x), Math.round(hit.point.y),
                      round(hit.normal.x), round(hit.normal.y), round(hit.fraction), Math.round(hit.distance));
            }
            function refused(query) {
                try { query(); print('accepted'); } catch (e) { print(e instanceof TypeError, e.message); }
            }
            var top = ItemUtils.getTopGroup(script);
            function find(name) { return ItemUtils.getItemByName(name, top); }
        )" + code);
        play(0);
        return printed();
    }
};

TEST_P(ScriptQueries, ARayMeetsTheFirstBodyThatIsSeen)
{
    EXPECT_THAT(run(R"(
        show(ctx.rayCast(at(0, 0), at(200, 0)));
        show(ctx.rayCast({ x: 0, y: 0 }, { x: 400, y: 0 }, { mask: 1 }));
        show(ctx.rayCast(at(0, 0), at(400, 0), { except: find('Wall') }));
        show(ctx.rayCast(at(0, 0), at(400, 0), { except: find('Wall').body }));
        show(ctx.rayCast(at(0, 0), at(200, 0), { sensors: true }));
        show(ctx.rayCast(at(0, 0), at(0, 100)));
        show(ctx.rayCast(at(0, 0), at(200, 0), { mask: ~2 }));
    )"),
                ElementsAre("Wall true 100 0 -1 0 0.5 100", "Box true 200 0 -1 0 0.5 200",
                            "Box true 200 0 -1 0 0.5 200", "Box true 200 0 -1 0 0.5 200", "Gate true 50 0 -1 0 0.25 50",
                            "null", "Box true 200 0 -1 0 1 200"));
}

TEST_P(ScriptQueries, ShapesStopWhereTheyTouch)
{
    EXPECT_THAT(run(R"(
        show(ctx.shapeCast({ center: at(0, 0), radius: 10 }, at(180, 0)));
        show(ctx.shapeCast({ from: at(0, 0), to: at(-20, 0), radius: 10 }, at(180, 0)));
        show(ctx.shapeCast({ points: [at(-20, 0), at(0, -10), at(10, 0), at(0, 10)] }, at(180, 0), { mask: 2 }));
        show(ctx.shapeCast({ center: at(0, 0), radius: 10 }, at(0, 180)));
    )"),
                ElementsAre("Wall true 100 0 -1 0 0.5 90", "Wall true 100 0 -1 0 0.5 90", "Wall true 100 0 -1 0 0.5 90",
                            "null"));
}

TEST_P(ScriptQueries, BoxesAndPointsFindWhatIsNearThem)
{
    EXPECT_THAT(run(R"(
        print(ctx.overlapping({ x: 55, y: -5, width: 160, height: 10 }).join());
        print(ctx.overlapping({ x: 55, y: -5, width: 160, height: 10 }, { sensors: true, except: find('Box') }).join());
        print(ctx.overlapping(find('Box').getBoundingArea())[0] === find('Box'));
        print(ctx.overlapping({ x: 1000, y: 0, width: 1, height: 1 }).length);
        show(ctx.nearest(at(80, 0), 40));
        show(ctx.nearest(at(80, 0), 200, { mask: 1 }));
        show(ctx.nearest(at(80, 0), 10));
    )"),
                ElementsAre("Wall,Box", "Wall,Gate", "true", "0", "Wall true 100 0 -1 0 0.5 20",
                            "Box true 200 0 -1 0 0.6 120", "null"));
}

TEST_P(ScriptQueries, WhatIsMissingOrNoNumberIsNamed)
{
    EXPECT_THAT(run(R"(
        refused(function () { ctx.rayCast(); });
        refused(function () { ctx.rayCast(at(0, 0)); });
        refused(function () { ctx.rayCast(at(0, 0), { x: 1, y: NaN }); });
        refused(function () { ctx.rayCast(at(0, 0), at(1, 1), 5); });
        refused(function () { ctx.rayCast(at(0, 0), at(1, 1), { layer: 2 }); });
        refused(function () { ctx.rayCast(at(0, 0), at(1, 1), { except: 'Box' }); });
        refused(function () { ctx.rayCast(at(0, 0), at(1, 1), { mask: 0.5 }); });
        refused(function () { ctx.rayCast(at(0, 0), at(1, 1), { sensors: 1 }); });
        refused(function () { ctx.shapeCast({ center: at(0, 0) }, at(1, 1)); });
        refused(function () { ctx.shapeCast({ center: at(0, 0), radius: 0 }, at(1, 1)); });
        refused(function () { ctx.shapeCast({ points: [at(0, 0), at(1, 0)] }, at(1, 1)); });
        refused(function () { ctx.shapeCast({}, at(1, 1)); });
        refused(function () { ctx.shapeCast({ center: at(0, 0), radius: 1 }); });
        refused(function () { ctx.overlapping(at(0, 0)); });
        refused(function () { ctx.nearest(at(0, 0), Infinity); });
        refused(function () { ctx.nearest(at(0, 0), -1); });
    )"),
                ElementsAre("true rayCast: 'from' must be a point { x, y }, got undefined",
                            "true rayCast: 'to' must be a point { x, y }, got undefined",
                            "true rayCast: 'to.y' must be a finite number, got NaN",
                            "true rayCast: 'options' must be an object, got 5",
                            "true rayCast: there is no option 'layer'; there are mask, except, sensors",
                            "true rayCast: 'options.except' must be a body or an item, got \"Box\"",
                            "true rayCast: 'options.mask' must be a whole number of 32 bits, got 0.5",
                            "true rayCast: 'options.sensors' must be true or false, got 1",
                            "true shapeCast: 'shape.radius' must be a finite number, got undefined",
                            "true shapeCast: 'shape.radius' must be above 0, got 0",
                            "true shapeCast: 'shape.points' must be 3 to 8 points of a convex polygon, got 2",
                            "true shapeCast: 'shape' must be { center, radius }, { from, to, radius } or { points }, "
                            "got an object",
                            "true shapeCast: 'way' must be a point { x, y }, got undefined",
                            "true overlapping: 'box.width' must be a finite number, got undefined",
                            "true nearest: 'reach' must be a finite number, got Infinity",
                            "true nearest: 'reach' must be 0 or more, got -1"));
}

TEST_P(ScriptQueries, ARaySeesABodyWhereItWasPutSinceTheLastStep)
{
    build();
    script(R"(
        var box = ItemUtils.getItemByName('Box', ItemUtils.getTopGroup(script));
        JetSystem.addEventListener('onStep', function (e) {
            if (e.step === 3) box.body.setPosition(300, 500);
            var hit = ctx.rayCast(new Vec2d(300, 400), new Vec2d(300, 600));
            if (hit) print(e.step, hit.item, Math.round(hit.point.y));
        });
    )");
    play(5.0 / 60);
    EXPECT_THAT(printed(), ElementsAre("3 Box 490", "4 Box 490"));
}

INSTANTIATE_TEST_SUITE_P(Engines, ScriptQueries, testing::Values("jet-physics", "physics-box2d"));

}  // namespace

}  // namespace jet::test
