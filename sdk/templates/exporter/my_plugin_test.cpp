#include <jet/testing/gtest.hpp>

namespace {

class MyPluginTest : public jet::test::PluginTest {
protected:
    MyPluginTest() : PluginTest{"org.example.my-plugin"} {}
};

TEST_F(MyPluginTest, WritesTheCornersOfEachShape)
{
    addRectangle({{0, 0}, {2, 1}});
    addRectangle({{5, 5}, {6.5, 6}});
    EXPECT_EQ(exportScene("my-plugin").text(), "0 0\n2 0\n2 1\n0 1\n\n5 5\n6.5 5\n6.5 6\n5 6\n");
}

TEST_F(MyPluginTest, LeavesOutWhatIsHidden)
{
    const jet::Item& group = add("group", {});
    addRectangle({{0, 0}, {2, 1}}, &group);
    auto edit = items().begin("Hide");
    edit.set(group, "visible", false);
    edit.commit();
    EXPECT_EQ(exportScene("my-plugin").text(), "");
}

TEST_F(MyPluginTest, AnEmptySceneIsAnEmptyFile) { EXPECT_EQ(exportScene("my-plugin").text(), ""); }

}  // namespace
