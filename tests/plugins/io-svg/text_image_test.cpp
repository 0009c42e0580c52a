#include "svg_fixture.hpp"

#include <filesystem>
#include <unistd.h>

namespace jet::test {

namespace fs = std::filesystem;

// A red picture of 2 x 1 pixels.
constexpr const char* kPicture =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR4nGP4z8AAQkAAAAz8Af/"
    "9D6yVAAAAAElFTkSuQmCC";

class SvgTextTest : public SvgTest {
protected:
    std::vector<const Item*> texts() const { return items(TextItem::type); }
    static std::string of(const Item& item, const char* property) { return item.property(property)->text(); }
    /// Where the baseline starts, has its middle or ends, by the item's alignment.
    static Vec2 anchorOf(const Item& item)
    {
        const Box frame = item.bounds();
        const std::string align = of(item, "align");
        const double x = align == "left" ? frame.min.x() : align == "right" ? frame.max.x() : frame.center().x();
        return {x, frame.min.y() + 0.93 * item.property("size")->as<double>()};
    }
};

TEST_F(SvgTextTest, ATextHasPlaceSizeFontAndColor)
{
    draw("<text id='hello' x='10' y='50' font-size='20' font-family='\"DejaVu Sans\", sans-serif' fill='#f00'"
         " fill-opacity='0.5'>Hello &amp; more</text>");
    ASSERT_EQ(texts().size(), 1u);
    const Item& text = *texts()[0];
    EXPECT_EQ(text.name(), "hello");
    EXPECT_EQ(of(text, "text"), "Hello & more");
    EXPECT_EQ(of(text, "font"), "DejaVu Sans");
    EXPECT_EQ(of(text, "color"), "#ff000080");
    EXPECT_DOUBLE_EQ(text.property("size")->as<double>(), 20);
    EXPECT_TRUE(anchorOf(text).isApprox(Vec2(10, 50)));
    EXPECT_EQ(allNotes(), "");
}

TEST_F(SvgTextTest, TextAnchorBecomesTheAlignment)
{
    draw(
        "<g text-anchor='middle'><text x='50' y='20'>a</text></g><text x='90' y='20' style='text-anchor:end'>b</text>");
    ASSERT_EQ(texts().size(), 2u);
    EXPECT_EQ(of(*texts()[0], "align"), "center");
    EXPECT_NEAR(anchorOf(*texts()[0]).x(), 50, 1e-9);
    EXPECT_EQ(of(*texts()[1], "align"), "right");
    EXPECT_NEAR(anchorOf(*texts()[1]).x(), 90, 1e-9);
}

TEST_F(SvgTextTest, LinesOfInkscapeAreItemsOfOneGroup)
{
    draw("<text id='poem' font-size='10'>\n  <tspan x='5' y='20'>first  line</tspan>\n  <tspan x='5' "
         "dy='12.5'>second</tspan>"
         "\n</text>");
    ASSERT_EQ(texts().size(), 2u);
    EXPECT_EQ(of(*texts()[0], "text"), "first line") << "spaces are one";
    EXPECT_TRUE(anchorOf(*texts()[0]).isApprox(Vec2(5, 20)));
    EXPECT_EQ(of(*texts()[1], "text"), "second");
    EXPECT_TRUE(anchorOf(*texts()[1]).isApprox(Vec2(5, 32.5)));
    EXPECT_EQ(texts()[0]->parent()->name(), "poem");
    EXPECT_EQ(allNotes(), "");
}

TEST_F(SvgTextTest, PiecesOfSeveralStylesInALineFollowEachOtherAndThatIsNoted)
{
    draw("<text x='5' y='20'>plain <tspan fill='red'>red</tspan> end</text>");
    ASSERT_EQ(texts().size(), 3u);
    EXPECT_EQ(of(*texts()[1], "color"), "#ff0000");
    EXPECT_EQ(of(*texts()[1], "text"), "red");
    EXPECT_LT(anchorOf(*texts()[0]).x(), anchorOf(*texts()[1]).x());
    EXPECT_LT(anchorOf(*texts()[1]).x(), anchorOf(*texts()[2]).x());
    EXPECT_TRUE(noted("guessed widths")) << allNotes();
}

TEST_F(SvgTextTest, SpaceBetweenSpansIsKeptAndOfSeveralSpacesOne)
{
    draw("<text x='5' y='20'><tspan fill='red'>one</tspan> <tspan fill='blue'>two</tspan>\n\t"
         "<tspan fill='red'>three</tspan> </text>");
    ASSERT_EQ(texts().size(), 3u);
    EXPECT_EQ(of(*texts()[0], "text"), "one ");
    EXPECT_EQ(of(*texts()[1], "text"), "two ");
    EXPECT_EQ(of(*texts()[2], "text"), "three") << "the end of a line has none";
}

TEST_F(SvgTextTest, SpansOfOneStyleAreOneTextWithTheirSpace)
{
    draw("<text x='5' y='20'><tspan>one</tspan> <tspan>two</tspan></text>");
    ASSERT_EQ(texts().size(), 1u);
    EXPECT_EQ(of(*texts()[0], "text"), "one two");
}

TEST_F(SvgTextTest, SpaceBeforeTheFirstSpanOfALineIsNone)
{
    draw("<text x='5' y='20'>\n  <tspan fill='red'>one</tspan>\n  <tspan x='5' y='40'> <tspan fill='blue'>two</tspan>"
         "</tspan></text>");
    ASSERT_EQ(texts().size(), 2u);
    EXPECT_EQ(of(*texts()[0], "text"), "one");
    EXPECT_TRUE(anchorOf(*texts()[0]).isApprox(Vec2(5, 20)));
    EXPECT_EQ(of(*texts()[1], "text"), "two");
    EXPECT_TRUE(anchorOf(*texts()[1]).isApprox(Vec2(5, 40))) << "a line of its own";
}

TEST_F(SvgTextTest, PreservedSpacesStay)
{
    draw("<text x='5' y='20' xml:space='preserve'><tspan fill='red'>a</tspan>   <tspan fill='blue'>b</tspan></text>"
         "<text x='5' y='40' style='white-space:pre'>c   d</text>"
         "<text x='5' y='60' xml:space='preserve' style='white-space:normal'>e   f</text>");
    ASSERT_EQ(texts().size(), 4u);
    EXPECT_EQ(of(*texts()[0], "text"), "a   ");
    EXPECT_EQ(of(*texts()[1], "text"), "b");
    EXPECT_EQ(of(*texts()[2], "text"), "c   d");
    EXPECT_EQ(of(*texts()[3], "text"), "e f") << "CSS has the last word";
}

TEST_F(SvgTextTest, TheFontShorthandIsReadAsWhatItStandsFor)
{
    struct Case {
        const char* font;
        double size;
        const char* family;
        bool bold;
    };
    const Case cases[] = {
        {"20px Georgia", 20, "Georgia", false},
        {"italic small-caps bold condensed 16px/2 'DejaVu Sans', serif", 16, "DejaVu Sans", true},
        {"normal 1.5em / 30px Arial", 15, "Arial", false},
        {"700 12px monospace", 12, "monospace", true},
        {"12 monospace", 12, "monospace", false},
        {"large serif", 14.4, "serif", false},
        {"bold", 10, "", false},
        {"bold 12px", 10, "", false},
        {"caption", 10, "", false},
    };
    for (const Case& one : cases) {
        scene_.undoRedo().undo();
        notes_.clear();
        draw("<g font-size='10'><text style=\"font: " + std::string(one.font) + "\">x</text></g>");
        ASSERT_EQ(texts().size(), 1u) << one.font;
        EXPECT_NEAR(texts()[0]->property("size")->as<double>(), one.size, 1e-9) << one.font;
        EXPECT_EQ(of(*texts()[0], "font"), one.family) << one.font;
        EXPECT_EQ(noted("bold and italic"), one.bold) << one.font;
    }
}

TEST_F(SvgTextTest, TheFontShorthandResetsWhatItDoesNotNameAndLaterOnesWin)
{
    draw("<style>text { font: 30px Arial; font-size: 18px } .plain { font: 20px Arial }</style>"
         "<g font-weight='bold'><text class='plain' font-size='5'>x</text></g><text font='9px Arial'>y</text>");
    ASSERT_EQ(texts().size(), 2u);
    EXPECT_DOUBLE_EQ(texts()[0]->property("size")->as<double>(), 20);
    EXPECT_DOUBLE_EQ(texts()[1]->property("size")->as<double>(), 18) << "a style sheet before an attribute";
    EXPECT_FALSE(noted("bold and italic")) << "the shorthand made it regular";
}

TEST_F(SvgTextTest, TransformsTurnAndScaleText)
{
    draw("<g transform='translate(10 20) rotate(90) scale(2)'><text font-size='10'>a</text></g>");
    ASSERT_EQ(texts().size(), 1u);
    EXPECT_NEAR(texts()[0]->property("size")->as<double>(), 20, 1e-9);
    const Affine frame = frameOf(texts()[0]->path());
    EXPECT_NEAR(frame.linear()(0, 0), 0, 1e-9) << "along y";
    EXPECT_GT(frame.linear()(1, 0), 0);
}

TEST_F(SvgTextTest, WhatIsLeftOutOfTextIsNoted)
{
    draw("<text x='1 2 3' font-weight='bold' stroke='red'>abc</text><text><textPath href='#p'>along</textPath></text>");
    EXPECT_EQ(texts().size(), 1u);
    EXPECT_TRUE(noted("placed one by one")) << allNotes();
    EXPECT_TRUE(noted("bold and italic"));
    EXPECT_TRUE(noted("the outline of text"));
    EXPECT_TRUE(noted("along a path"));
}

TEST_F(SvgTextTest, HiddenAndEmptyTextMakesNothingSeen)
{
    draw("<text> \n </text><text display='none'>x</text><text><tspan display='none'>y</tspan></text>"
         "<text><title>t</title></text>");
    for (const Item* text : texts()) EXPECT_FALSE(text->visible());
    EXPECT_LE(texts().size(), 1u);
}

class SvgImageTest : public SvgTest {
protected:
    SvgImageTest() { fs::create_directories(folder / "inside"); }
    ~SvgImageTest() override { fs::remove_all(folder); }
    const Item& image() const { return *items(ImageItem::type).at(0); }
    void importFrom(const std::string& content)
    {
        const std::string file = "<svg xmlns='http://www.w3.org/2000/svg'>" + content + "</svg>";
        auto edit = scene_.items().begin("Import");
        ImportRequest request{
            folder / "inside/drawing.svg", std::as_bytes(std::span(file)), edit, scene_.root(), notes_, {}};
        ASSERT_TRUE(catalog_.importer("svg")->read(request));
        edit.commit();
    }
    fs::path folder = fs::temp_directory_path() / ("jet-svg-" + std::to_string(::getpid()));
};

TEST_F(SvgImageTest, DataInTheDrawingIsKeptAndFittedIntoItsFrame)
{
    draw(std::string("<image id='red' x='10' y='20' width='40' height='40' opacity='0.5' href='") + kPicture + "'/>");
    EXPECT_EQ(image().name(), "red");
    EXPECT_EQ(image().property("file")->as<std::string>(), kPicture);
    EXPECT_EQ(image().bounds(), Box({10, 30}, {50, 50})) << "twice as wide as high, in the middle";
    EXPECT_DOUBLE_EQ(image().property("opacity")->as<double>(), 0.5);
    EXPECT_EQ(allNotes(), "");
}

TEST_F(SvgImageTest, AMissingSideFollowsFromThePicture)
{
    draw(std::string("<image width='40' preserveAspectRatio='none' xlink:href='") + kPicture + "'/>");
    EXPECT_EQ(image().bounds(), Box({0, 0}, {40, 20}));
}

TEST_F(SvgImageTest, AFileBesideTheDrawingIsReferredTo)
{
    writeFileAtomically(folder / "inside/a b.gif", std::string_view("GIF89a\x04\x00\x02\x00", 10)).orThrow();
    importFrom("<image width='8' height='8' href='a%20b.gif'/>");
    EXPECT_EQ(image().property("file")->as<std::string>(), (folder / "inside/a b.gif").string());
    EXPECT_EQ(image().bounds(), Box({0, 2}, {8, 6}));
}

TEST_F(SvgImageTest, FilesElsewhereAndOnTheNetworkAreLeftOutWithANote)
{
    writeFileAtomically(folder / "secret.png", std::string_view("x")).orThrow();
    importFrom(
        "<image width='8' height='8' href='../secret.png'/><image width='8' height='8' href='/etc/passwd'/>"
        "<image width='8' height='8' href='https://example.org/a.png'/><image width='8' height='8' href='none.png'/>"
        "<image width='8' height='8' href='data:image/png;base64,AAAA'/>");
    EXPECT_TRUE(items(ImageItem::type).empty());
    EXPECT_TRUE(noted("'../secret.png' lies outside")) << allNotes();
    EXPECT_TRUE(noted("'/etc/passwd' lies outside"));
    EXPECT_TRUE(noted("on the network"));
    EXPECT_TRUE(noted("'none.png' is left out"));
    EXPECT_TRUE(noted("no PNG, JPEG or GIF"));
}

}  // namespace jet::test
