#include <jet/testing/gtest.hpp>

namespace {

class StressHeatmapTest : public jet::test::PluginTest {
protected:
    StressHeatmapTest() : PluginTest{"org.example.stress-heatmap", "org.jet.effect.in-path-body", "org.jet.physics"}
    {
        apply("in-path-body", block);
        apply("stress-heatmap", block, {{"limit", 0.02}});
    }
    /// Most springs at rest are grey: as much red as blue.
    static std::size_t coloured(const std::vector<jet::test::Drawn>& strokes)
    {
        std::size_t count = 0;
        for (const auto& stroke : strokes) count += stroke.color().r != stroke.color().b;
        return count;
    }

    const jet::Item& block = addRectangle({{0, 0}, {60, 60}});
};

TEST_F(StressHeatmapTest, WhileEditingThereIsNothingToShow)
{
    EXPECT_TRUE(painted(block, jet::PaintPurpose::Export).strokes().empty());
}

TEST_F(StressHeatmapTest, ABodyAtRestIsGrey)
{
    const auto simulation = play();
    const auto strokes = painted(*simulation).strokes();
    ASSERT_FALSE(strokes.empty());
    EXPECT_EQ(coloured(strokes), 0u);
}

TEST_F(StressHeatmapTest, ABodyThatFellOnTheGroundShowsItsStress)
{
    const jet::Item& ground = addRectangle({{-100, 70}, {200, 90}});
    auto edit = items().begin("Ground");
    edit.setType(ground, "body");
    edit.set(ground, "fixed", true);
    edit.addEffect(ground, "in-path-body");
    edit.commit();
    const auto simulation = play(45);
    const auto strokes = painted(*simulation).strokes();
    EXPECT_GT(coloured(strokes), 1u) << "some springs are pressed, some stretched";
    jet::Box drawn;
    for (const auto& stroke : strokes) drawn.extend(stroke.path.bounds());
    EXPECT_GT(drawn.max.y(), 61) << "drawn where the body is now";
}

}  // namespace
