// The thesis's listings 3.4.5.1, 4.3.1, 4.4.1 and 4.5.1, as they stand there (SPEC SC4).
#include "script_fixture.hpp"

namespace jet::test {

class ListingsTest : public ScriptTest {
protected:
    // The tree of §4.4: the camera's script comes before the control's, whose `vs` it uses.
    void buildGame()
    {
        const Item& ground = group("Ground");
        set(body("BodyItem 15", Box({-1000, 100}, {1000, 120}), &ground), "fixed", true);
        body("Finish", Box({200, 0}, {220, 100}), &ground);
        const Item& interactive = group("Interactive");
        script("CameraScript", scriptFixture("listing-4.4.1.js"), &interactive);
        script("GameScript", scriptFixture("listing-4.5.1.js"), &interactive);
        const Item& hero = group("Hero", &interactive);
        script("ControlScript", scriptFixture("listing-4.3.1.js"), &hero);
        torque("BallTorque", {10, 10}, &hero);
        body("Ball", Box({0, 0}, {20, 20}), &hero);
    }
    ItemId idOf(std::string_view name) const { return findByName(scene_->root(), name)->id(); }
};

TEST_F(ListingsTest, Listing3451FindsTheNeighbourOfEachScript)
{
    for (const auto& [before, name] :
         {std::pair("Rect", "Script A"), {"Ellipse", "Script B"}, {"Polygon", "Script C"}}) {
        shape(before);
        script(name, std::string(name) == "Script C" ? scriptFixture("listing-3.4.5.1.js") : "");
    }
    play();
    EXPECT_EQ(printed(), (Lines{"rect: Rect", "ellipse: Ellipse", "polygon: Polygon"}));
}

// Figure 3.4.5.2: the same, as one script an item, each with the global `script` set to its own item.
TEST_F(ListingsTest, EachScriptOfFigure3452SeesItsOwnItem)
{
    shape("Rect");
    script("Script A",
           "var scriptA = script; var rect = scriptA.getPriorSibling(); CC.GUIC.printlnToOutput('rect: '+rect);");
    shape("Ellipse");
    script("Script B",
           "var scriptB = script; var e = scriptB.getPriorSibling(); CC.GUIC.printlnToOutput('ellipse: '+e);");
    play();
    EXPECT_EQ(printed(), (Lines{"rect: Rect", "ellipse: Ellipse"}));
}

TEST_F(ListingsTest, Listing431TurnsTheBallByAAndD)
{
    buildGame();
    play();
    const ItemId torque = idOf("BallTorque");
    step();
    EXPECT_EQ(simulation().torque(torque), 0);
    simulation().setKey("A", true);
    step();
    EXPECT_EQ(simulation().torque(torque), 1000);
    simulation().setKey("A", false);
    simulation().setKey("D", true);
    step();
    EXPECT_EQ(simulation().torque(torque), -1000);
    simulation().setKey("D", false);
    step();
    EXPECT_EQ(simulation().torque(torque), 0);
    EXPECT_EQ(printed(), Lines{});
}

TEST_F(ListingsTest, Listing441KeepsTheBallInTheMiddleOfTheView)
{
    buildGame();
    set(*scene_->items().find(idOf("Ball")), "velocity", Vec2(60, 0));
    SimulationOptions options;
    options.viewSize = {800, 600};
    play(options);
    step(30);
    // Scripts see the state before the step: the ball is where 29 steps took it, a unit each.
    EXPECT_EQ(simulation().view().view.scale, 0.8);  // vs starts at 1 and is limited by minS
    const Vec2 inPixels = simulation().view().view.toPixels() * Vec2(10 + 29, 10);
    EXPECT_NEAR(inPixels.x(), 400, 1e-9);
    EXPECT_NEAR(inPixels.y(), 300, 1e-9);
}

TEST_F(ListingsTest, Listing441ZoomsOutWhileAKeyIsHeld)
{
    buildGame();
    play();
    simulation().setKey("D", true);
    step(1000);
    EXPECT_EQ(simulation().view().view.scale, 0.3);  // .001 a step down to maxS
}

TEST_F(ListingsTest, Listing451PrintsTheTimeAtTheFinish)
{
    buildGame();
    const Item& ball = *scene_->items().find(idOf("Ball"));
    set(ball, "velocity", Vec2(60, 0));
    play();
    step(180);  // 180 units are between the ball's right side and the finish
    EXPECT_EQ(printed(), Lines{});
    step();
    EXPECT_EQ(printed(), (Lines{"Bohater zakończył scenę w czasie: ", "= 3 sekund(y)"}));
}

}  // namespace jet::test
