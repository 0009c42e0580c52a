// The test kit is what its comments say: gestures reach the tool, what it did can be asked for.
#include <jet/testing/gtest.hpp>

#include <gmock/gmock.h>

namespace jet::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Renames the selected items, if there are any.
class RenameCommand final : public Command {
public:
    bool isEnabled(Editor& editor) const override { return !editor.activeScene()->items().selection().empty(); }
    void run(Editor& editor) override
    {
        ItemsCenter& items = editor.activeScene()->items();
        auto edit = items.begin("Rename");
        for (const ItemId id : items.selection()) edit.set(*items.find(id), "name", "Renamed");
        edit.commit();
        editor.showMessage("done");
    }
};

/// Notes the events it gets, as words.
class NotingTool final : public Tool {
public:
    using Tool::Tool;
    void activate() override { note("activate"); }
    void deactivate() override { note("deactivate"); }
    void press(const PointerEvent& e) override { note(e.modifiers.shift ? "press+shift" : "press"); }
    void drag(const PointerEvent&) override { note("drag"); }
    void release(const PointerEvent&) override { note("release"); }
    void move(const PointerEvent& e) override { note(e.button == PointerButton::None ? "move" : "move with a button"); }
    void doubleClick(const PointerEvent&) override { note("doubleClick"); }
    bool wheel(const WheelEvent& e) override { return note("wheel"), e.steps > 0; }
    bool keyPress(const KeyEvent& e) override { return note("key " + e.key), e.key == "R"; }
    bool cancel() override { return note("cancel"), false; }
    const PropertyTable& options() const override
    {
        static const PropertyTable table{integer("points", "Points", 5).range(3, 50)};
        return table;
    }

private:
    void note(const std::string& word) { host().showStatus(static_cast<TestToolHost&>(host()).status + word + " "); }
};

/// Strokes the springs of a running soft body.
class SpringsEffect final : public Effect {
public:
    const PropertyTable& properties() const override
    {
        static const PropertyTable none;
        return none;
    }
    bool wantsLiveBody() const override { return true; }
    void paint(const EffectInput& input, const EffectState*, PaintPurpose, Painter& painter) const override
    {
        if (!input.body) return;
        for (const LiveSpring& spring : input.body->springs)
            painter.stroke(Path::line(input.body->particles[spring.a], input.body->particles[spring.b]), Pen());
    }
};

class WorkbenchTest : public PluginTest {
protected:
    WorkbenchTest()
        : PluginTest{"org.jet.tool.rectangle",
                     "org.jet.effect.polygon-face",
                     "org.jet.effect.in-path-rigid-body",
                     "org.jet.effect.in-path-body",
                     "org.jet.io-svg",
                     "org.jet.physics"}
    {
        catalog().inCode().command<RenameCommand>("rename");
        catalog().inCode().effect<SpringsEffect>("springs");
        catalog().inCode().tool<NotingTool>("noting");
        catalog().inCode().tool<NotingTool>("other");
    }
    std::string& noted() { return host().status; }
};

TEST_F(WorkbenchTest, ADragMakesOneShapeAndOneUndoStep)
{
    tool("rectangle").drag({10, 10}, {60, 40});
    ASSERT_EQ(scene().shapes().size(), 1u);
    EXPECT_EQ(scene().shapes()[0].bounds(), Box({10, 10}, {60, 40}));
    EXPECT_EQ(scene().selected(), scene().shapes());
    EXPECT_EQ(undoSteps(), 1u);
    undo();
    EXPECT_EQ(scene().hash(), emptySceneHash());
    redo();
    EXPECT_EQ(scene().shapes().size(), 1u);
}

TEST_F(WorkbenchTest, AToolGetsTheEventsOfAGestureInOrder)
{
    tool("noting").move({1, 1}).hold({true, false, false}).drag({0, 0}, {4, 4}, 2).hold({}).press({1, 1}).release();
    EXPECT_EQ(noted(), "activate move press+shift drag drag release press release ");
    noted().clear();
    tool("noting").doubleClick({5, 5});
    EXPECT_EQ(noted(), "press release doubleClick release ");
    noted().clear();
    tool("other");
    EXPECT_EQ(noted(), "deactivate activate ") << "another tool took over";
}

TEST_F(WorkbenchTest, KeysAndWheelTellWhetherTheToolUsedThem)
{
    EXPECT_TRUE(tool("noting").key("R").used());
    EXPECT_FALSE(tool("noting").key("X").used());
    EXPECT_TRUE(tool("noting").wheel({0, 0}, 1).used());
    EXPECT_FALSE(tool("noting").wheel({0, 0}, -1).used());
    noted().clear();
    tool("noting").key("Escape");
    EXPECT_EQ(noted(), "cancel key Escape ") << "there was nothing to give up";
}

TEST_F(WorkbenchTest, OptionsAreCheckedAsTheEditorChecksThem)
{
    tool("noting").option("points", 7);
    EXPECT_EQ(*host().options().find("points"), Value(7));
    EXPECT_THROW(tool("noting").option("points", 2), Failure);
    EXPECT_THROW(tool("noting").option("corners", 2), Failure);
}

TEST_F(WorkbenchTest, WhatTheToolPaintsIsRecorded)
{
    EXPECT_TRUE(tool("rectangle").painted().isEmpty());
    tool("rectangle").press({0, 0}).move({30, 20});
    const RecordingPainter painted = tool("rectangle").painted();
    ASSERT_EQ(painted.strokes().size(), 1u);
    EXPECT_EQ(painted.bounds(), Box({0, 0}, {30, 20}));
    EXPECT_TRUE(painted.balanced());
}

TEST_F(WorkbenchTest, TheLogTellsWhatTheSceneSaid)
{
    EventLog log(scene());
    Recorded<SelectionChanged> selections(events(), &scene());
    tool("rectangle").drag({10, 10}, {60, 40});
    EXPECT_EQ(log.steps(), 1u);
    EXPECT_EQ(log.count("ItemAdded"), 2u) << "a layer and the shape";
    EXPECT_EQ(log.selectionChanges(), 1u);
    EXPECT_EQ(selections.size(), 1u);
    log.clear();
    undo();
    EXPECT_THAT(log.lines(), ::testing::Contains(::testing::StartsWith("Undo: ")));
}

TEST_F(WorkbenchTest, AnEffectIsAppliedAndPainted)
{
    const Item& square = addRectangle({{0, 0}, {40, 40}});
    apply("polygon-face", square, {{"color", Color{255, 0, 0, 255}}});
    ASSERT_EQ(painted(square).fills().size(), 1u);
    EXPECT_EQ(painted(square).fills()[0].color(), (Color{255, 0, 0, 255}));
    EXPECT_EQ(painted().fills().size(), 1u) << "the scene paints its items";
    EXPECT_THROW(apply("no-such-effect", square), Failure);
    EXPECT_EQ(undoSteps(), 2u);
}

TEST_F(WorkbenchTest, ImportsBytesAsOneStepAndLeavesNothingOfAFailure)
{
    const Imported drawing =
        importBytes(R"(<svg xmlns="http://www.w3.org/2000/svg"><rect width="9" height="5"/></svg>)", "a.svg");
    ASSERT_TRUE(drawing) << drawing.error();
    EXPECT_EQ(drawing.items.size(), 1u);
    EXPECT_EQ(undoSteps(), 1u);
    const auto before = scene().hash();
    const Imported broken = importBytes("no drawing", "broken.svg");
    EXPECT_FALSE(broken);
    EXPECT_THAT(broken.error(), HasSubstr("broken.svg"));
    EXPECT_EQ(scene().hash(), before);
    EXPECT_THROW(importBytes("", "a.unknown"), Failure);
}

TEST_F(WorkbenchTest, AMissingFileIsAnError) { EXPECT_FALSE(importFile("no/such/file.svg")); }

TEST_F(WorkbenchTest, CommandsRunOnTheSceneInFront)
{
    EXPECT_FALSE(run("rename")) << "nothing is selected";
    tool("rectangle").drag({10, 10}, {60, 40});
    EXPECT_TRUE(run("rename"));
    EXPECT_TRUE(scene().named("Renamed").is<ShapeItem>());
    EXPECT_THAT(editor().messages, ElementsAre("done"));
    EXPECT_THROW(scene().named("Nobody"), Failure);
}

TEST_F(WorkbenchTest, PlaysACopyOfTheScene)
{
    const Item& square = addRectangle({{0, 0}, {40, 40}});
    apply("in-path-rigid-body", square);
    const auto before = scene().hash();
    const auto simulation = play(60);
    EXPECT_EQ(simulation->stepCount(), 60u);
    EXPECT_GT(simulation->pose(square)->bounds().min.y(), 1.0) << "it fell";
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(WorkbenchTest, AnEffectThatAsksForItSeesTheRunningSoftBody)
{
    const Item& jelly = addRectangle({{0, 0}, {40, 40}});
    apply("in-path-body", jelly);
    apply("springs", jelly);
    EXPECT_TRUE(painted(PaintPurpose::Play).strokes().empty()) << "nothing runs";
    const auto simulation = play(60);
    const LiveBody* body = simulation->liveBody(jelly);
    ASSERT_NE(body, nullptr);
    EXPECT_EQ(painted(*simulation).strokes().size(), body->springs.size());
    EXPECT_GT(painted(*simulation).bounds().min.y(), 1.0) << "drawn where the body fell to";
    for (const LiveSpring& spring : body->springs) EXPECT_TRUE(spring.whole);
}

TEST_F(WorkbenchTest, ABodyThatNoEffectAsksForIsNotCopied)
{
    const Item& jelly = addRectangle({{0, 0}, {40, 40}});
    apply("in-path-body", jelly);
    EXPECT_EQ(play()->liveBody(jelly), nullptr);
}

TEST(LiveBody, StrainIsRelativeAndATornSpringHasNone)
{
    LiveBody body{{{0, 0}, {12, 0}, {0, 8}}, {{0, 1, 10, 50, true}, {0, 2, 10, 50, true}, {0, 1, 10, 50, false}}};
    EXPECT_DOUBLE_EQ(body.strain(body.springs[0]), 12.0 / 10 - 1);
    EXPECT_DOUBLE_EQ(body.strain(body.springs[1]), 8.0 / 10 - 1);
    EXPECT_DOUBLE_EQ(body.tension(body.springs[0]), 50 * 2.0);
    EXPECT_EQ(body.strain(body.springs[2]), 0);
    EXPECT_EQ(body.tension(body.springs[2]), 0);
}

TEST_F(WorkbenchTest, ProgressIsNotedAndCanBeCancelled)
{
    const Progress progress = editor().progress("Working");
    EXPECT_TRUE(progress(0.25));
    editor().cancelAt = 0.5;
    EXPECT_FALSE(progress(0.5));
    EXPECT_THAT(editor().progressed, ElementsAre(0.25, 0.5));
}

TEST_F(WorkbenchTest, ASavedSceneReadsBackEqual)
{
    tool("rectangle").drag({10, 10}, {60, 40});
    EXPECT_EQ(textAfterReload(), scene().text());
}

TEST(Workbench, NeedsNoTestFramework)
{
    Workbench bench{"org.jet.tool.rectangle", "org.jet.effect.polygon-face"};
    bench.tool("rectangle").drag({0, 0}, {10, 10});
    EXPECT_EQ(bench.scene().shapes().size(), 1u);
    EXPECT_THROW(bench.scene().shapes()[1], Failure) << "an item the list does not have";
}

}  // namespace
}  // namespace jet::test
