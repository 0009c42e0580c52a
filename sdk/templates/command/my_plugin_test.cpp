#include <jet/testing/gtest.hpp>

namespace {

class MyPluginTest : public jet::test::PluginTest {
protected:
    MyPluginTest() : PluginTest{"org.example.my-plugin"} {}
    const jet::Item& left = addRectangle({{0, 0}, {10, 10}});
    const jet::Item& right = addRectangle({{30, 0}, {100, 10}});
};

TEST_F(MyPluginTest, MirrorsTheSelectedItemsAsOneUndoStep)
{
    items().setSelection({left.id(), right.id()});
    const auto before = scene().hash();
    const auto steps = undoSteps();
    ASSERT_TRUE(run("my-plugin"));
    EXPECT_EQ(left.bounds(), jet::Box({90, 0}, {100, 10}));
    EXPECT_EQ(right.bounds(), jet::Box({0, 0}, {70, 10}));
    EXPECT_EQ(undoSteps(), steps + 1);
    undo();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(MyPluginTest, AnItemInASelectedGroupIsMirroredOnce)
{
    const jet::Item& group = add("group", {});
    const jet::Item& first = addRectangle({{0, 0}, {10, 10}}, &group);
    addRectangle({{30, 0}, {100, 10}}, &group);
    items().setSelection({group.id(), first.id()});
    ASSERT_TRUE(run("my-plugin"));
    EXPECT_EQ(first.bounds(), jet::Box({90, 0}, {100, 10}));
}

TEST_F(MyPluginTest, WithoutASelectionItIsNotOffered)
{
    items().setSelection({});
    EXPECT_FALSE(run("my-plugin"));
}

}  // namespace
