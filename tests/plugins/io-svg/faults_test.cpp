// Broken and hostile drawings: what can be drawn is drawn, the rest is told with line and column, nothing takes for
// ever.
#include "svg_fixture.hpp"

#include <ctime>

namespace jet::test {

class SvgFaultsTest : public SvgTest {
protected:
    static std::string repeated(std::string_view text, int times)
    {
        std::string result;
        for (int i = 0; i < times; ++i) result += text;
        return result;
    }

    /// Seconds of processor time since the test began: other work on the machine does not count.
    double elapsed() const { return double(std::clock() - start_) / CLOCKS_PER_SEC; }

    static constexpr double kLimit = 2;  // seconds any file may take

private:
    std::clock_t start_ = std::clock();
};

TEST_F(SvgFaultsTest, AFaultyPathIsDrawnUpToTheFaultAndItsPlaceIsTold)
{
    draw("<rect width='5' height='5'/>\n  <path fill='red' d='M 10 10 L 20 10 L 20 oops'/>");
    ASSERT_EQ(shapes().size(), 2u);
    expectBox(shapes()[1]->bounds(), Box({10, 10}, {20, 10}));
    ASSERT_EQ(notes_.size(), 1u) << allNotes();
    EXPECT_EQ(notes_[0].where.file, "drawing.svg");
    EXPECT_EQ(notes_[0].where.line, 3);
    EXPECT_EQ(notes_[0].where.column, 44) << notes_[0].message;  // of "oops"
}

TEST_F(SvgFaultsTest, ATruncatedFileIsDrawnUpToItsEnd)
{
    ASSERT_TRUE(importText("<svg xmlns='http://www.w3.org/2000/svg'>\n<g><rect width='5' height='5'/>\n<circle r='4"));
    EXPECT_GE(shapes().size(), 1u);
    EXPECT_TRUE(noted("the file is broken here", 3)) << allNotes();
}

TEST_F(SvgFaultsTest, MismatchedTagsAreTold)
{
    ASSERT_TRUE(
        importText("<svg xmlns='http://www.w3.org/2000/svg'>\n<g><rect width='5' height='5'></g></rect></svg>"));
    EXPECT_EQ(shapes().size(), 1u);
    EXPECT_TRUE(noted("the file is broken here", 2)) << allNotes();
}

TEST_F(SvgFaultsTest, WhatIsNoDrawingIsAnError)
{
    for (const std::string_view file : {"", "hello", "<html/>", "\x89PNG", "<?xml version='1.0'?>"}) {
        const Result<void> result = importText(file);
        ASSERT_FALSE(result) << file;
        EXPECT_NE(result.error().message.find("no SVG drawing"), std::string::npos);
        EXPECT_EQ(result.error().where.file, "drawing.svg");
    }
}

TEST_F(SvgFaultsTest, BytesThatAreNoTextAreToldAndPassedOver)
{
    ASSERT_TRUE(importText(
        std::string_view("<svg xmlns='http://www.w3.org/2000/svg'>\n<g id='\xff\0'><rect width='5' height='5'/>"
                         "</g></svg>",
                         86)));
    EXPECT_EQ(shapes().size(), 1u);
    EXPECT_TRUE(noted("no text in this file's encoding", 2)) << allNotes();
}

TEST_F(SvgFaultsTest, OtherEncodingsAreRead)
{
    const std::string ascii = "<svg xmlns='http://www.w3.org/2000/svg'><rect id='r' width='5' height='5'/></svg>";
    std::string utf16 = "\xff\xfe";
    for (const char c : ascii) utf16 += {c, '\0'};
    ASSERT_TRUE(importText(utf16));
    EXPECT_TRUE(named("r"));
    ASSERT_TRUE(
        importText("<?xml version='1.0' encoding='ISO-8859-1'?><svg><rect id='H\xf6he' width='5' height='5'/></svg>"));
    EXPECT_TRUE(named("Höhe"));
    EXPECT_TRUE(notes_.empty()) << allNotes();
}

TEST_F(SvgFaultsTest, FiftyThousandNestedGroupsFitAnyStack)
{
    draw(repeated("<g>", 50'000) + "<rect width='5' height='5'/>" + repeated("</g>", 50'000));
    ASSERT_EQ(shapes().size(), 1u);
    int depth = 0;
    for (const Item* item = shapes()[0]; item->parent(); item = item->parent()) ++depth;
    EXPECT_LE(depth, 201);
    EXPECT_TRUE(noted("nested more than 200 deep")) << allNotes();
    EXPECT_LT(elapsed(), kLimit);
}

TEST_F(SvgFaultsTest, AUseBombIsDefused)
{
    std::string content = "<defs><rect id='u0' width='5' height='5'/>";
    for (int i = 1; i <= 9; ++i) {
        content += "<g id='u" + std::to_string(i) + "'>" +
                   repeated("<use xlink:href='#u" + std::to_string(i - 1) + "'/>", 10) + "</g>";
    }
    draw(content + "</defs><circle r='5'/><use xlink:href='#u9'/>");
    EXPECT_GE(shapes().size(), 2u);
    EXPECT_TRUE(noted("more than 50000 references")) << allNotes();
    EXPECT_LT(elapsed(), kLimit);
}

TEST_F(SvgFaultsTest, AnEntityBombIsDefused)
{
    std::string type = "<!DOCTYPE svg [\n<!ENTITY e0 'ha'>";
    for (int i = 1; i <= 9; ++i) {
        type += "<!ENTITY e" + std::to_string(i) + " '" + repeated("&e" + std::to_string(i - 1) + ";", 10) + "'>";
    }
    ASSERT_TRUE(importText(
        type + "<!ENTITY round '&round;'>]><svg><title>&e9;&round;</title><rect width='5' height='5'/></svg>"));
    EXPECT_EQ(shapes().size(), 1u);
    EXPECT_TRUE(noted("grows beyond measure", 2)) << allNotes();
    EXPECT_LT(elapsed(), kLimit);
}

TEST_F(SvgFaultsTest, WildNumbersLeaveOnlyTheirOwnShapeOut)
{
    draw("<path d='M 0 0 L 1e308 1e308 Z'/><rect x='1e999' width='NaN' height='-5'/><circle r='5'/>"
         "<rect width='9' height='9' transform='scale(1e200)'/><path d='M0 0H5' stroke='red' stroke-width='1e30'/>");
    ASSERT_EQ(shapes().size(), 2u) << allNotes();
    EXPECT_TRUE(noted("beyond all bounds")) << allNotes();
}

TEST_F(SvgFaultsTest, ReferencesToOtherFilesAreNotFollowed)
{
    draw("<use xlink:href='other.svg#x'/><use xlink:href='file:///etc/passwd#x'/><rect width='5' height='5'/>");
    EXPECT_EQ(shapes().size(), 1u);
    EXPECT_TRUE(noted("another file, which is not read")) << allNotes();
}

TEST_F(SvgFaultsTest, AZeroSizedDrawingShowsNothing)
{
    draw("<rect width='5' height='5'/>", "width='0' height='100'");
    EXPECT_TRUE(shapes().empty());
    EXPECT_EQ(notes_.size(), 1u);
}

TEST_F(SvgFaultsTest, ManyRulesAndDeepElementsDoNotMultiply)
{
    const std::string rules = "<style>" + repeated("g g g g g rect.none { fill: red }", 2000) + "</style>";
    draw(rules + repeated("<g>", 1000) + repeated("<rect class='none' width='1' height='1'/>", 100) +
         repeated("</g>", 1000));
    EXPECT_EQ(shapes().size(), 100u);
    EXPECT_LT(elapsed(), kLimit);
}

TEST_F(SvgFaultsTest, ACancelledImportIsAnError)
{
    const std::string file = "<svg><rect width='5' height='5'/></svg>";
    auto edit = scene_.items().begin("Import");
    ImportRequest request{"drawing.svg", std::as_bytes(std::span(file)), edit, scene_.root(),
                          notes_,        {[](double) { return false; }}};
    EXPECT_FALSE(catalog_.importer("svg")->read(request));
}

}  // namespace jet::test
