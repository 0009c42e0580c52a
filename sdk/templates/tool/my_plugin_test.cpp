#include <jet/testing/gtest.hpp>

namespace {

class MyPluginTest : public jet::test::PluginTest {
protected:
    MyPluginTest() : PluginTest{"org.example.my-plugin"} {}
};

TEST_F(MyPluginTest, ADragMakesOneShapeAndOneUndoStep)
{
    tool("my-plugin").option("corners", 4).drag({50, 50}, {50, 20});
    ASSERT_EQ(scene().shapes().size(), 1u);
    const jet::Box bounds = scene().shapes()[0].bounds();
    EXPECT_NEAR(bounds.width(), 60, 1e-9);
    EXPECT_NEAR(bounds.height(), 60, 1e-9);
    EXPECT_EQ(scene().shapes()[0].path().segmentCount(), 4u);
    EXPECT_EQ(undoSteps(), 1u);
    undo();
    EXPECT_EQ(scene().hash(), emptySceneHash());
}

TEST_F(MyPluginTest, EscapeGivesUp)
{
    tool("my-plugin").press({0, 0}).move({30, 30}).key("Escape").release();
    EXPECT_TRUE(scene().shapes().empty());
}

TEST_F(MyPluginTest, AClickDrawsNothing)
{
    tool("my-plugin").click({10, 10});
    EXPECT_EQ(scene().hash(), emptySceneHash());
}

TEST_F(MyPluginTest, TheOutlineIsShownWhileDragging)
{
    EXPECT_TRUE(tool("my-plugin").painted().isEmpty());
    EXPECT_EQ(tool("my-plugin").press({0, 0}).move({30, 30}).painted().strokes().size(), 1u);
}

}  // namespace
