// Symbols where nobody edits: at play, for scripts, in pictures. What is in an instance is real items, so all of it
// works.
#include "support/test_catalog.hpp"

#include <jet/symbols.hpp>
#include <jet/testing/gtest.hpp>

#include <gmock/gmock.h>

namespace jet {
namespace {

using testing::ElementsAre;

class SymbolsAtPlay : public test::PluginTest {
protected:
    SymbolsAtPlay()
        : PluginTest{"org.jet.physics", "org.jet.effect.in-path-rigid-body", "org.jet.effect.polygon-face",
                     "org.jet.script-duktape", "org.jet.io-png"}
    {
        auto edit = items().begin("Make");
        const Item& ball = edit.add<BodyItem>(scene().root(), Path::ellipse(Box({0, 0}, {10, 10})));
        edit.set(ball, "name", "Ball");
        edit.addEffect(ball, "in-path-rigid-body");
        edit.addEffect(ball, "polygon-face", {{"color", Color{255, 0, 0, 255}}});
        const Item& script = edit.add<ScriptItem>(scene().root());
        edit.set(script, "code",
                 "CC.GUIC.printlnToOutput(Math.round(ItemUtils.getClosestItemByName('Ball', script).body"
                 ".getBoundingArea().getCenter().x));");
        first_ = createSymbol(edit, scene(), std::vector<const Item*>{&ball, &script}, "Ball")->id();
        second_ = placeSymbol(edit, *findSymbol(scene(), "Ball"), scene().root(), Affine::translation({100, 0})).id();
        edit.commit();
    }
    ItemId first_, second_;
};

TEST_F(SymbolsAtPlay, EachInstanceHasABodyOfItsOwnThatFalls)
{
    const auto simulation = play(30);
    const auto fallen = [&](ItemId instance) {
        const Item& ball = *simulation->scene().items().find(instance)->children().front();
        const Path* pose = simulation->pose(ball);
        return pose ? pose->bounds().center() - ball.path().bounds().center() : Vec2(0, 0);
    };
    EXPECT_GT(fallen(first_).y(), 1);
    EXPECT_NEAR(fallen(first_).y(), fallen(second_).y(), 1e-9);
}

TEST_F(SymbolsAtPlay, AScriptInASymbolFindsTheItemsOfItsOwnInstance)
{
    const auto simulation = play(1);
    std::vector<std::string> printed;
    for (const OutputLine& line : simulation->output()) printed.push_back(line.text);
    EXPECT_THAT(printed, ElementsAre("5", "105"));
}

TEST_F(SymbolsAtPlay, PicturesShowAllInstancesAndNotTheSymbolItself)
{
    EXPECT_EQ(painted().fills().size(), 2u);
    EXPECT_TRUE(exportScene("png"));
}

}  // namespace
}  // namespace jet
