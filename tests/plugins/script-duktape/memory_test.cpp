// Long games: the heap of the scripts does not grow by what JET itself does. Uses the plugin's objects to look at the
// heap.
#include "fake_physics.hpp"
#include "script_fixture.hpp"

#include <runtime.hpp>

namespace jet::test {

namespace {

duktape::Runtime* lastRuntime = nullptr;

class WatchedEngine final : public ScriptEngine {
public:
    std::unique_ptr<ScriptRuntime> createRuntime(Simulation& simulation) override
    {
        auto runtime = std::make_unique<duktape::Runtime>(simulation);
        lastRuntime = runtime.get();
        return runtime;
    }
};

}  // namespace

class ScriptMemoryTest : public ScriptTest {
protected:
    ScriptMemoryTest()
    {
        catalog.inCode().scriptEngine<WatchedEngine>("watched");
        catalog.inCode().physicsEngine<FakePhysics>("fake");
        catalog.inCode().effect<FakeBody>("fake-body");
        scene_ = std::make_unique<Scene>("Scene 0", events_, catalog);
    }
    ~ScriptMemoryTest() override { simulation_.reset(), scene_.reset(); }

    std::size_t used()
    {
        lastRuntime->collectGarbage();
        return lastRuntime->memoryUsed();
    }

    TestCatalog catalog;
};

TEST_F(ScriptMemoryTest, TenThousandStepsOfTheWholeApiLeakNothing)
{
    body("Ball", Box({0, 0}, {20, 20}));
    torque("Torque", {10, 10});
    script("Script", R"(
        var tg = ItemUtils.getTopGroup(script), ball = ItemUtils.getItemByName('Ball', tg), t = ItemUtils.getItemByName('Torque', tg);
        var key = Keyboard.getKey('A'), view = CC.getScene('Scene 0').GC.swingSimulationGP;
        function each(e) {
            var c = ball.body.getBoundingArea().getCenter().add(ball.body.position);
            t.torque.setValue(key.isPressed() ? 1 : 0);
            view.setViewAnchor(c.x, c.y);
            view.setViewScale(1 + Math.random());
            if (ctx.colTab[ball.body.cti][ctx.step % 3]) print('touch');
            ball.set('omega', ball.get('omega') + 1);
            tg.getChildList().forEach(function (i) { return i.name; });
            ball.body.velocity.x += 0.001;
            try { ball.get('nothing'); } catch (error) {}
            var once = function () { JetSystem.removeEventListener('onStep', once); };
            JetSystem.addEventListener('onStep', once);
        }
        JetSystem.addEventListener('onStep', each);
        JetSystem.addEventListener('onKeyDown', each);
    )");
    play();
    step(100);
    const std::size_t before = used();
    step(10'000);
    EXPECT_EQ(printed(), Lines{});
    EXPECT_LE(used(), before + 1000) << "before: " << before;
}

TEST_F(ScriptMemoryTest, FailingListenersLeaveNothingBehind)
{
    script("Script", R"(
        JetSystem.addEventListener('onKeyDown', function () {
            JetSystem.addEventListener('onStep', function () { var big = new Array(1000).join('x'); null.x; });
        });
    )");
    play();
    const auto fail = [&](int times) {
        for (int i = 0; i < times; ++i) simulation().key({"A", "", {}, false}, true), step();
    };
    fail(100);
    const std::size_t before = used();
    fail(1000);
    EXPECT_EQ(errors().size(), 1100u);
    EXPECT_LE(used(), before + 1000);
}

TEST_F(ScriptMemoryTest, AStoppedHoarderGivesItsMemoryBack)
{
    script("Script", "JetSystem.addEventListener('onStep', function () { var a = []; for (;;) a.push({ a: a }); });");
    play();
    const std::size_t before = used();
    step();
    EXPECT_EQ(errors().size(), 1u);
    EXPECT_LE(used(), before + 20'000);
}

}  // namespace jet::test
