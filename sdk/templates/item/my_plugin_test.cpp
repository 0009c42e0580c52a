#include <jet/testing/gtest.hpp>

namespace {

class MyPluginTest : public jet::test::PluginTest {
protected:
    MyPluginTest() : PluginTest{"org.example.my-plugin", "org.jet.effect.in-path-rigid-body", "org.jet.physics"} {}
};

TEST_F(MyPluginTest, TheToolDrawsOne)
{
    tool("draw-my-plugin").drag({0, 0}, {30, 40});
    ASSERT_EQ(scene().itemsOf("my-plugin").size(), 1u);
    EXPECT_EQ(scene().itemsOf("my-plugin")[0].path(), jet::Path::line({0, 0}, {30, 40}));
    EXPECT_EQ(painted().strokes().size(), 1u);
    EXPECT_EQ(textAfterReload(), scene().text());
    undo();
    EXPECT_EQ(scene().hash(), emptySceneHash());
}

TEST_F(MyPluginTest, PullsABodyToWhereItHangs)
{
    const jet::Item& weight = addRectangle({{0, 0}, {10, 10}});
    apply("in-path-rigid-body", weight);
    const jet::Item& band = add("my-plugin", jet::Path::line({5, 5}, {105, 5}));
    auto edit = items().begin("Stiff");
    edit.set(band, "stiffness", 500.0);
    edit.commit();
    const auto simulation = play(30);
    EXPECT_GT(simulation->pose(weight)->bounds().center().x(), 10) << "from 5 towards 105";
    EXPECT_TRUE(simulation->output().empty()) << "no warning";
}

TEST_F(MyPluginTest, WarnsAboutABandWithoutEnds)
{
    add("my-plugin", {});
    EXPECT_EQ(play()->output().size(), 1u);
}

}  // namespace
