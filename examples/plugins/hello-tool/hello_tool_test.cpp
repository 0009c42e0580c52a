#include <jet/testing/gtest.hpp>

namespace {

class HelloToolTest : public jet::test::PluginTest {
protected:
    HelloToolTest() : PluginTest{"org.example.hello"} {}
};

TEST_F(HelloToolTest, ADragMakesAStarAsOneUndoStep)
{
    tool("hello-star").option("points", 6).drag({50, 50}, {50, 20});
    ASSERT_EQ(scene().shapes().size(), 1u);
    EXPECT_EQ(scene().shapes()[0].path().segmentCount(), 12u);
    EXPECT_NEAR(scene().shapes()[0].bounds().height(), 60, 1e-9);
    EXPECT_EQ(undoSteps(), 1u);
    undo();
    EXPECT_EQ(scene().hash(), emptySceneHash());
}

TEST_F(HelloToolTest, AClickAndEscapeDrawNothing)
{
    tool("hello-star").click({10, 10}).press({0, 0}).move({30, 30}).key("Escape").release();
    EXPECT_EQ(scene().hash(), emptySceneHash());
}

}  // namespace
