#include <jet/testing/gtest.hpp>

namespace {

class MyPluginTest : public jet::test::PluginTest {
protected:
    MyPluginTest() : PluginTest{"org.example.my-plugin"} {}
    const jet::Item& square = addRectangle({{0, 0}, {40, 40}});
};

TEST_F(MyPluginTest, FillsTheShapeMovedByItsOffset)
{
    apply("my-plugin", square, {{"offset", jet::Vec2(3, 5)}, {"color", jet::Color{10, 20, 30, 255}}});
    const auto fills = painted(square).fills();
    ASSERT_EQ(fills.size(), 1u);
    EXPECT_EQ(fills[0].path.bounds(), jet::Box({3, 5}, {43, 45}));
    EXPECT_EQ(fills[0].color(), (jet::Color{10, 20, 30, 255}));
    EXPECT_TRUE(painted(square).balanced());
}

TEST_F(MyPluginTest, IsOneUndoStepAndSurvivesSaving)
{
    const auto before = scene().hash();
    apply("my-plugin", square);
    EXPECT_EQ(textAfterReload(), scene().text());
    undo();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(MyPluginTest, RefusesAnItemWithoutAPath)
{
    EXPECT_THROW(apply("my-plugin", add("shape", jet::Path())), jet::Failure);
}

}  // namespace
