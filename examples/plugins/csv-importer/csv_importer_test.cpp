#include <jet/testing/gtest.hpp>

namespace {

class CsvImporterTest : public jet::test::PluginTest {
protected:
    CsvImporterTest() : PluginTest{"org.example.csv"} {}
    jet::test::Imported read(std::string_view text) { return importBytes(text, "boxes.csv"); }
};

TEST_F(CsvImporterTest, EachRowIsARectangleAndTheWholeOneUndoStep)
{
    const auto boxes = read("name,x,y,width,height\nBase,0,10,40,5\n\"Tower, tall\",15,-20,10,30\r\n");
    ASSERT_TRUE(boxes) << boxes.error();
    ASSERT_EQ(boxes.items.size(), 2u);
    EXPECT_EQ(boxes.items[0].name(), "Base");
    EXPECT_EQ(boxes.items[0].bounds(), jet::Box({0, 10}, {40, 15}));
    EXPECT_EQ(boxes.items[1].name(), "Tower, tall");
    EXPECT_TRUE(boxes.notes.empty());
    EXPECT_EQ(undoSteps(), 1u);
}

TEST_F(CsvImporterTest, ReadsSemicolonsQuotesAndAByteOrderMark)
{
    const auto boxes = read("\xef\xbb\xbfx;y;width;height;name\n1;2;3;4;\"say \"\"hi\"\"\"\n\n");
    ASSERT_TRUE(boxes) << boxes.error();
    ASSERT_EQ(boxes.items.size(), 1u);
    EXPECT_EQ(boxes.items[0].name(), "say \"hi\"");
}

TEST_F(CsvImporterTest, ErrorsNameLineAndColumnAndLeaveNothing)
{
    struct Case {
        const char* text;
        int line, column;
    };
    for (const Case& wrong : {Case{"x,y,width,height\n1,2,three,4\n", 2, 5}, Case{"x,y,width,height\n1,2\n", 2, 0},
                              Case{"x,y\n1,2\n", 1, 0}, Case{"x,y,width,height\n\"1,2,3,4\n", 2, 1},
                              Case{"x,y,width,height\n\"1\"2,2,3,4\n", 2, 4}, Case{"", 1, 0}}) {
        const auto boxes = read(wrong.text);
        ASSERT_FALSE(boxes) << wrong.text;
        EXPECT_EQ(boxes.result.error().where.line, wrong.line) << wrong.text;
        EXPECT_EQ(boxes.result.error().where.column, wrong.column) << wrong.text;
        EXPECT_EQ(scene().hash(), emptySceneHash());
    }
}

TEST_F(CsvImporterTest, ColoursNeedTheFaceEffectAndAreLeftOutWithoutIt)
{
    constexpr const char* kTable = "x,y,width,height,color\n0,0,5,5,red\n9,0,5,5,#00ff00\n";
    const auto plain = read(kTable);
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain.notes.size(), 1u) << "one note, not one a row";
    catalog().load("org.jet.effect.polygon-face");
    const auto painted = read(kTable);
    ASSERT_TRUE(painted);
    ASSERT_EQ(painted.items[0].effects().size(), 1u);
    EXPECT_EQ(painted.items[0].effects()[0].properties.find("color")->as<jet::Color>(), (jet::Color{255, 0, 0, 255}));
}

TEST_F(CsvImporterTest, UnknownColumnsAreNoted)
{
    const auto boxes = read("x,y,width,height,weight\n0,0,5,5,80\n");
    ASSERT_TRUE(boxes);
    ASSERT_EQ(boxes.notes.size(), 1u);
    EXPECT_NE(boxes.notes[0].message.find("weight"), std::string::npos);
}

}  // namespace
