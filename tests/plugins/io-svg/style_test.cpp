// How things look: the cascade, inheritance, colours and the effects made of them.
#include "svg_fixture.hpp"

namespace jet::test {

using SvgStyleTest = SvgTest;

TEST_F(SvgStyleTest, AShapeIsBlackAndUnstrokedUnlessToldOtherwise)
{
    draw("<rect width='5' height='5'/>");
    EXPECT_EQ(face(shape()), "#000000");
    EXPECT_EQ(strokeColor(shape()), "none");
    EXPECT_TRUE(shape().effect("polygon-face")->properties.find("curved")->as<bool>());
}

TEST_F(SvgStyleTest, TheCascadeGoesFromAttributeToImportant)
{
    // Each rectangle is won by the strongest of what names it.
    draw("<style>* { fill: #010101 } rect { fill: #020202 } .c { fill: #030303 } #id { fill: #040404 }"
         " .late { fill: #050505 } .late { fill: #060606 } .strong { fill: #070707 !important }</style>"
         "<path inkscape:label='universal' d='M0 0H9V9' fill='red'/>"
         "<rect inkscape:label='type' width='5' height='5' fill='red'/>"
         "<rect inkscape:label='class' class='x c y' width='5' height='5'/>"
         "<rect id='id' class='c' width='5' height='5'/>"
         "<rect inkscape:label='later' class='late' width='5' height='5'/>"
         "<rect inkscape:label='own' id='id' style='fill: #0a0a0a' width='5' height='5'/>"
         "<rect inkscape:label='important' class='strong' style='fill: red' width='5' height='5'/>");
    EXPECT_EQ(face(*named("universal")), "#010101");
    EXPECT_EQ(face(*named("type")), "#020202");
    EXPECT_EQ(face(*named("class")), "#030303");
    EXPECT_EQ(face(*named("id")), "#040404");
    EXPECT_EQ(face(*named("later")), "#060606");
    EXPECT_EQ(face(*named("own")), "#0a0a0a");
    EXPECT_EQ(face(*named("important")), "#070707");
}

TEST_F(SvgStyleTest, SelectorsLookAtAncestorsSiblingsAndAttributes)
{
    draw("<style>g.a rect { fill: #010101 } g.a > path { fill: #020202 } rect + circle { fill: #030303 }"
         " [role=goal] { fill: #040404 } @media print { rect { fill: red } } polygon:hover { fill: red }</style>"
         "<g class='a'><g><rect id='deep' width='5' height='5'/><path id='notChild' d='M0 0H9V9'/></g>"
         "<path id='child' d='M0 0H9V9'/></g>"
         "<rect id='first' width='5' height='5'/><circle id='next' r='3'/><circle id='other' r='3'/>"
         "<ellipse id='goal' role='goal' rx='3' ry='4'/>");
    EXPECT_EQ(face(*named("deep")), "#010101");
    EXPECT_EQ(face(*named("child")), "#020202");
    EXPECT_EQ(face(*named("notChild")), "#000000");
    EXPECT_EQ(face(*named("next")), "#030303");
    EXPECT_EQ(face(*named("other")), "#000000");
    EXPECT_EQ(face(*named("goal")), "#040404");
}

TEST_F(SvgStyleTest, FillAndStrokeAreInheritedAndOpacityMultiplies)
{
    draw("<g fill='#102030' stroke='blue' stroke-width='3' opacity='0.5'><g opacity='0.5'>"
         "<rect width='5' height='5' fill-opacity='0.5'/></g></g>");
    EXPECT_EQ(face(shape()), "#10203020");         // 255 / 8 = 31.9
    EXPECT_EQ(strokeColor(shape()), "#0000ff40");  // 255 / 4 = 63.8
    EXPECT_DOUBLE_EQ(strokeValue<double>(shape(), "width"), 3);
}

struct ColorCase {
    const char* text;
    const char* expected;
};

class SvgColorTest : public SvgTest, public testing::WithParamInterface<ColorCase> {};

TEST_P(SvgColorTest, IsReadAsCssDoes)
{
    draw("<g fill='#123456' color='#00ff7f'><rect width='5' height='5' fill='" + std::string(GetParam().text) +
         "'/></g>");
    EXPECT_EQ(face(shape()), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    All, SvgColorTest,
    testing::Values(ColorCase{"#f80", "#ff8800"}, ColorCase{"#ff8000", "#ff8000"}, ColorCase{"#ff800080", "#ff800080"},
                    ColorCase{"rgb(255, 128,0)", "#ff8000"}, ColorCase{"rgb(100%, 50%, 0%)", "#ff8000"},
                    ColorCase{"rgb(300, -5, 0)", "#ff0000"}, ColorCase{"rgb(50%, 128, 0)", "#123456"},
                    ColorCase{"rgba(255,128,0,0.5)", "#ff800080"}, ColorCase{"rgb(255 128 0 / 50%)", "#ff800080"},
                    ColorCase{"hsl(120, 100%, 25%)", "#008000"}, ColorCase{"hsl(-240, 100%, 25%)", "#008000"},
                    ColorCase{"LimeGreen", "#32cd32"}, ColorCase{"currentColor", "#00ff7f"}, ColorCase{"none", "none"},
                    ColorCase{"inherit", "#123456"}, ColorCase{"transparent", "#00000000"},
                    ColorCase{"#12345", "#123456"},  // what is no colour counts as not written
                    ColorCase{"url(#missing)", "none"}, ColorCase{"url(#missing) red", "#ff0000"}));

TEST_F(SvgStyleTest, StrokePropertiesKeepTheirMeaning)
{
    draw("<path d='M0 0H9' style='fill:none;stroke:#fff;stroke-linecap:round;stroke-linejoin:bevel;stroke-miterlimit:7;"
         "stroke-dasharray:none;stroke-dashoffset:2'/>");
    EXPECT_EQ(face(shape()), "none");
    EXPECT_EQ(strokeValue<std::string>(shape(), "cap"), "round");
    EXPECT_EQ(strokeValue<std::string>(shape(), "join"), "bevel");
    EXPECT_DOUBLE_EQ(strokeValue<double>(shape(), "miter-limit"), 7);
    EXPECT_EQ(strokeValue<std::string>(shape(), "dashes"), "");
    EXPECT_DOUBLE_EQ(strokeValue<double>(shape(), "dash-offset"), 2);
}

TEST_F(SvgStyleTest, PaintOrderIsTheOrderOfTheEffects)
{
    draw("<rect id='a' width='5' height='5' stroke='red'/>"
         "<rect id='b' width='5' height='5' stroke='red' paint-order='stroke'/>");
    EXPECT_EQ(named("a")->effects()[0].type, "polygon-face");
    EXPECT_EQ(named("b")->effects()[0].type, "stroke");
}

TEST_F(SvgStyleTest, FillRuleIsKept)
{
    draw("<path fill-rule='evenodd' d='M0 0H9V9Z'/>");
    EXPECT_EQ(shape().effect("polygon-face")->properties.find("fill-rule")->as<std::string>(), "evenodd");
}

TEST_F(SvgStyleTest, AGradientBecomesItsMeanColour)
{
    draw(
        "<linearGradient id='own'><stop offset='0' stop-color='black'/><stop offset='1' "
        "stop-color='white'/></linearGradient>"
        "<linearGradient id='half' xlink:href='#own'/>\n"
        "<radialGradient id='late'><stop offset='0.5' stop-color='#f00'/><stop offset='0.5' "
        "stop-color='#00f'/></radialGradient>"
        "<rect id='a' width='5' height='5' fill='url(#half)'/>\n<rect id='b' width='5' height='5' fill='url(#late)'/>");
    EXPECT_EQ(face(*named("a")), "#808080");
    EXPECT_EQ(face(*named("b")), "#800080");
    EXPECT_TRUE(noted("gradients are drawn as one colour, their mean (2 times", 3)) << allNotes();
}

TEST_F(SvgStyleTest, HiddenThingsAreKeptButNotShown)
{
    draw("<g id='g' display='none'><rect id='in' width='5' height='5'/></g>"
         "<g visibility='hidden'><rect id='a' width='5' height='5'/><rect id='b' visibility='visible' width='5' "
         "height='5'/></g>"
         "<rect id='c' style='display:none' width='5' height='5'/>");
    EXPECT_FALSE(named("g")->visible());
    EXPECT_FALSE(named("in")->shown());
    EXPECT_FALSE(named("a")->shown());
    EXPECT_TRUE(named("b")->shown());
    EXPECT_FALSE(named("c")->shown());
}

TEST_F(SvgStyleTest, AMissingEffectIsNotedOnce)
{
    TestCatalog bare{"org.jet.io-svg"};
    Scene scene("Scene", events_, bare);
    const std::string file =
        "<svg xmlns='http://www.w3.org/2000/svg'><rect width='5' height='5'/><circle r='4'/></svg>";
    auto edit = scene.items().begin("Import");
    ImportRequest request{"drawing.svg", std::as_bytes(std::span(file)), edit, scene.root(), notes_, {}};
    ASSERT_TRUE(bare.importer("svg")->read(request));
    EXPECT_EQ(scene.root().children().size(), 2u);
    ASSERT_EQ(notes_.size(), 1u) << allNotes();
    EXPECT_TRUE(noted("without the effect 'polygon-face'"));
}

}  // namespace jet::test
