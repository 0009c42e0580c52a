#include <jet/testing/gtest.hpp>

namespace {

class MyPluginTest : public jet::test::PluginTest {
protected:
    MyPluginTest() : PluginTest{"org.example.my-plugin"} {}
    jet::test::Imported read(std::string_view text) { return importBytes(text, "drawing.my-plugin"); }
};

TEST_F(MyPluginTest, ReadsPolygonsAsOneUndoStep)
{
    const auto drawing = read("0 0\n10 0\n10 10\n\n20 0\r\n30 0\r\n30 5\r\n");
    ASSERT_TRUE(drawing) << drawing.error();
    ASSERT_EQ(drawing.items.size(), 2u);
    EXPECT_EQ(drawing.items[1].bounds(), jet::Box({20, 0}, {30, 5}));
    EXPECT_EQ(undoSteps(), 1u);
}

TEST_F(MyPluginTest, NamesTheLineOfAnErrorAndLeavesNothing)
{
    const auto broken = read("0 0\n10 zero\n");
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.result.error().where.line, 2);
    EXPECT_EQ(scene().hash(), emptySceneHash());
    EXPECT_FALSE(read("1 2 3\n"));
}

TEST_F(MyPluginTest, TellsWhatItLeftOut)
{
    const auto drawing = read("5 5\n");
    ASSERT_TRUE(drawing);
    EXPECT_EQ(drawing.notes.size(), 1u);
}

TEST_F(MyPluginTest, AnEmptyFileIsAnEmptyDrawing) { EXPECT_TRUE(read("")); }

}  // namespace
