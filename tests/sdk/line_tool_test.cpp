#include "scene_fakes.hpp"

#include <jet/line_tool.hpp>
#include <jet/testing/tool_driver.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace jet {
namespace {

class Rod : public LineTool {
public:
    Rod(ToolHost& host, Second second, std::vector<Line>& made) : LineTool(host, "Drag a rod.", second), made_(made) {}
    void finish(const Line& line) override { made_.push_back(line); }
    std::string describe(const Line& line) const override { return line.from.name + " to " + line.to.name; }
    void paintLine(const Line& line, Painter& painter) const override
    {
        painter.stroke(Path::line(line.from.at, line.to.at), host().layerPen());
    }

private:
    std::vector<Line>& made_;
};

/// Has options of its own, and no "snap" among them.
class PlainRod final : public Rod {
public:
    using Rod::Rod;
    const PropertyTable& options() const override { return Tool::options(); }
};

/// Two bodies of 40 units, with their middles at (20, 20) and (120, 20).
class LineToolTest : public test::SceneFixture {
protected:
    LineToolTest()
    {
        named(addBox(Box({0, 0}, {40, 40}), BodyItem::type), "A");
        named(addBox(Box({100, 0}, {140, 40}), BodyItem::type), "B");
    }
    void named(const Item& item, const std::string& name)
    {
        auto edit = items().begin("Name");
        edit.set(item, "name", name);
        edit.commit();
    }
    template <class Tool = Rod>
    test::ToolDriver tool(LineTool::Second second = LineTool::Second::Snaps)
    {
        return {host_, std::make_unique<Tool>(host_, second, made_)};
    }

    std::vector<LineTool::Line> made_;
    test::TestToolHost host_{scene};
};

TEST_F(LineToolTest, ADragGoesFromOneBodyToTheOtherAndSnapsToBoth)
{
    auto rod = tool();
    rod->activate();
    EXPECT_EQ(host_.status, "Drag a rod.");
    rod.drag({23, 18}, {118, 22});
    ASSERT_EQ(made_.size(), 1u);
    EXPECT_EQ(made_[0].from.at, Vec2(20, 20));
    EXPECT_EQ(made_[0].to.at, Vec2(120, 20));
    EXPECT_EQ(made_[0].way, Vec2(100, 0));
    EXPECT_EQ(made_[0].from.name + made_[0].to.name, "AB");
    rod.hold({.alt = true}).drag({23, 18}, {118, 22});
    EXPECT_EQ(made_.at(1).way, Vec2(95, 4)) << "Alt: freely";
    rod.hold({.shift = true}).drag({20, 20}, {118, 22});
    EXPECT_EQ(made_.at(2).to.at, Vec2(120, 20)) << "what snaps is not turned";
}

TEST_F(LineToolTest, TwoClicksDoWhatADragDoesAndEscGivesUpTheFirst)
{
    auto rod = tool();
    rod.click({20, 20}).key("Escape");
    EXPECT_TRUE(rod.used());
    rod.click({120, 20});
    EXPECT_TRUE(made_.empty()) << "that was a first click again";
    rod.move({70, 200});
    EXPECT_EQ(host_.status, "B to ") << "the background has no name";
    rod.click({20, 20});
    ASSERT_EQ(made_.size(), 1u);
    EXPECT_EQ(made_[0].way, Vec2(-100, 0));
    rod.click({20, 20}).click({20, 20});
    ASSERT_EQ(made_.size(), 2u) << "the tool is asked about two clicks at one place";
    EXPECT_EQ(made_[1].way, Vec2(0, 0));
}

TEST_F(LineToolTest, AFreeSecondPointIsThePointersAndKeepsToEighthsOfATurnWithShift)
{
    auto arrow = tool(LineTool::Second::Free);
    arrow.drag({23, 18}, {118, 22});
    EXPECT_EQ(made_.at(0).from.at, Vec2(20, 20)) << "the first one snaps";
    EXPECT_EQ(made_.at(0).to.at, Vec2(118, 22));
    EXPECT_EQ(made_.at(0).to.name, "B") << "and is told where it is";
    arrow.press({20, 20}).move({110, 30});
    EXPECT_TRUE(arrow->keyPress({"Shift", "", {}})) << "also while the pointer rests";
    EXPECT_EQ(arrow.painted().strokes().at(0).path, Path::line({20, 20}, {110, 20}));
    EXPECT_TRUE(arrow->keyRelease({"Shift", "", {}}));
    EXPECT_EQ(arrow.painted().strokes().at(0).path, Path::line({20, 20}, {110, 30}));
    EXPECT_FALSE(arrow->keyPress({"D", "", {}}));
    arrow.release();
    EXPECT_FALSE(arrow->keyPress({"Shift", "", {}})) << "nothing is under way";
    EXPECT_FALSE(tool().press({20, 20})->keyPress({"Shift", "", {}})) << "no tool whose points snap";
}

TEST_F(LineToolTest, PointsSnapWhereTheOptionThatSaysSoIsThereAndOn)
{
    auto rod = tool();
    rod.option("snap", false).drag({23, 18}, {118, 22});
    EXPECT_EQ(made_.at(0).way, Vec2(95, 4));
    tool<PlainRod>().drag({23, 18}, {118, 22});
    EXPECT_EQ(made_.at(1).way, Vec2(95, 4));
}

TEST_F(LineToolTest, MarksShowWhereAPressWouldSnapAndLieOverTheLine)
{
    auto rod = tool();
    EXPECT_TRUE(rod.painted().strokes().empty());
    rod.move({22, 18});
    EXPECT_EQ(rod.painted().strokes().size(), 2u) << "ring and dot";
    rod.move({70, 200});
    EXPECT_TRUE(rod.painted().strokes().empty()) << "nothing to snap to";
    rod.press({20, 20}).move({120, 20});
    const auto drawn = rod.painted().strokes();
    ASSERT_EQ(drawn.size(), 5u) << "the line, then two marks";
    EXPECT_EQ(drawn[0].path, Path::line({20, 20}, {120, 20}));
    rod->deactivate();
    EXPECT_TRUE(rod.painted().strokes().empty());
}

}  // namespace
}  // namespace jet
