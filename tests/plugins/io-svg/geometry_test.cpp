// Where things are: units, viewBox, transforms and shapes against the formulas of SVG 2.
#include "svg_fixture.hpp"

#include <cmath>
#include <numbers>

namespace jet::test {

using SvgGeometryTest = SvgTest;

TEST_F(SvgGeometryTest, PhysicalUnitsCountNinetySixPixelsToTheInch)
{
    draw("<rect x='1in' y='2.54cm' width='10mm' height='72pt'/>");
    expectBox(bounds(), Box({96, 96}, {96 + 960 / 25.4, 192}));
}

TEST_F(SvgGeometryTest, ThePageIsTheSizeOfTheDrawing)
{
    draw("", "width='2in' height='150'");
    EXPECT_DOUBLE_EQ(scene_.setting("page-width").as<double>(), 192);
    EXPECT_DOUBLE_EQ(scene_.setting("page-height").as<double>(), 150);
}

TEST_F(SvgGeometryTest, AViewBoxAloneGivesThePage)
{
    draw("<rect x='-10' y='-10' width='1' height='1'/>", "viewBox='-10 -10 64 32'");
    EXPECT_DOUBLE_EQ(scene_.setting("page-width").as<double>(), 64);
    expectBox(bounds(), Box({0, 0}, {1, 1}));
}

TEST_F(SvgGeometryTest, ADrawingWithoutASizeEndsWithItsShapes)
{
    draw("<rect x='10' y='10' width='50' height='20' stroke='red' stroke-width='4'/>", "");
    EXPECT_DOUBLE_EQ(scene_.setting("page-width").as<double>(), 62);
    EXPECT_DOUBLE_EQ(scene_.setting("page-height").as<double>(), 32);
}

TEST_F(SvgGeometryTest, ADrawingPutIntoAnotherLeavesThePage)
{
    draw("<rect width='5' height='5'/>", "width='40' height='30'");
    draw("<rect width='5' height='5'/>", "width='400' height='300'");
    EXPECT_DOUBLE_EQ(scene_.setting("page-width").as<double>(), 40);
}

struct ViewBoxCase {
    const char* aspect;
    Box expected;  // of a viewBox 10 x 10 in a page of 200 x 100
};

class SvgViewBoxTest : public SvgTest, public testing::WithParamInterface<ViewBoxCase> {};

TEST_P(SvgViewBoxTest, IsPlacedAsPreserveAspectRatioSays)
{
    draw("<rect x='5' y='5' width='10' height='10'/>",
         "width='200' height='100' viewBox='5 5 10 10' preserveAspectRatio='" + std::string(GetParam().aspect) + "'");
    expectBox(bounds(), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(All, SvgViewBoxTest,
                         testing::Values(ViewBoxCase{"", Box({50, 0}, {150, 100})},
                                         ViewBoxCase{"xMinYMid meet", Box({0, 0}, {100, 100})},
                                         ViewBoxCase{"xMaxYMax", Box({100, 0}, {200, 100})},
                                         ViewBoxCase{"xMidYMin slice", Box({0, 0}, {200, 200})},
                                         ViewBoxCase{"xMidYMid slice", Box({0, -50}, {200, 150})},
                                         ViewBoxCase{"none", Box({0, 0}, {200, 100})}));

struct TransformCase {
    const char* text;
    Vec2 expected;  // of the point (2, 1)
};

class SvgTransformTest : public SvgTest, public testing::WithParamInterface<TransformCase> {};

TEST_P(SvgTransformTest, MovesAPointAsItsMatrixDoes)
{
    draw("<g transform='" + std::string(GetParam().text) + "'><path d='M 2 1 L 2 1'/></g>");
    EXPECT_NEAR((shape().path().segment(0).point - GetParam().expected).norm(), 0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    All, SvgTransformTest,
    testing::Values(TransformCase{"translate(3)", {5, 1}}, TransformCase{"translate(3,-4)", {5, -3}},
                    TransformCase{"scale(2)", {4, 2}}, TransformCase{"scale(2 3)", {4, 3}},
                    TransformCase{"rotate(90)", {-1, 2}}, TransformCase{"rotate(90, 2, 0)", {1, 0}},
                    TransformCase{"skewX(45)", {3, 1}}, TransformCase{"skewY(45)", {2, 3}},
                    TransformCase{"matrix(1 2 3 4 5 6)", {1 * 2 + 3 * 1 + 5, 2 * 2 + 4 * 1 + 6}},
                    TransformCase{"translate(10 0) scale(2)", {14, 2}},  // the last is applied first
                    TransformCase{" translate( 10,0 ),\n scale( 2 ) ", {14, 2}},
                    TransformCase{"nonsense(1)", {2, 1}},  // no transform at all
                    TransformCase{"", {2, 1}}));

TEST_F(SvgGeometryTest, NestedTransformsMultiply)
{
    draw("<g transform='translate(10 20)'><g transform='scale(2)'><rect transform='translate(1 1)' width='3' "
         "height='4'/>"
         "</g></g>");
    expectBox(bounds(), Box({12, 22}, {18, 30}));
}

TEST_F(SvgGeometryTest, AnArcStaysOnItsCircle)
{
    draw("<path d='M 90 50 A 40 40 0 1 1 50 10'/>");
    const Contour& contour = shape().path().contours().front();
    EXPECT_EQ(contour.curveCount(), 3u);  // three quarters of a turn
    for (std::size_t i = 0; i < contour.curveCount(); ++i) {
        for (double t = 0; t <= 1; t += 0.125) {
            // A quarter turn as a cubic strays by 2.73e-4 of the radius.
            EXPECT_NEAR((contour.curve(i).at(t) - Vec2(50, 50)).norm(), 40, 40 * 2.8e-4);
        }
    }
}

TEST_F(SvgGeometryTest, CurvesStayCurves)
{
    draw("<path d='m 10 10 c 0 20 30 20 30 0 q 10 -10 20 0 z'/>");
    const Contour& contour = shape().path().contours().front();
    ASSERT_EQ(contour.segments.size(), 3u);
    EXPECT_TRUE(contour.closed);
    EXPECT_EQ(contour.segments[0].out, Vec2(10, 30));
    EXPECT_EQ(contour.segments[1].in, Vec2(40, 30));
    // Degree elevation: the control points lie at two thirds of the way.
    EXPECT_NEAR((contour.segments[1].out - Vec2(40 + 20.0 / 3, 10 - 20.0 / 3)).norm(), 0, 1e-12);
}

TEST_F(SvgGeometryTest, ACircleIsAnEllipseOfFourSegments)
{
    draw("<circle cx='50' cy='40' r='30'/>");
    EXPECT_EQ(shape().path(), Path::ellipse(Box({20, 10}, {80, 70})));
}

struct RoundingCase {
    const char* attributes;
    double rx, ry;
};

class SvgRoundedRectTest : public SvgTest, public testing::WithParamInterface<RoundingCase> {};

TEST_P(SvgRoundedRectTest, LosesAtEachCornerWhatTheEllipseLeaves)
{
    draw("<rect width='40' height='20' " + std::string(GetParam().attributes) + "/>");
    const double lost = (4 - std::numbers::pi) * GetParam().rx * GetParam().ry;
    // A quarter ellipse as a cubic encloses up to 2.81e-4 more than it should.
    const double more = 2.81e-4 * std::numbers::pi * GetParam().rx * GetParam().ry;
    EXPECT_NEAR(shape().path().area(), 800 - lost, more + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, SvgRoundedRectTest,
                         testing::Values(RoundingCase{"rx='5' ry='4'", 5, 4}, RoundingCase{"rx='5'", 5, 5},
                                         RoundingCase{"ry='6'", 6, 6}, RoundingCase{"rx='5' ry='-1'", 5, 5},
                                         RoundingCase{"rx='100' ry='4'", 20, 4}, RoundingCase{"rx='100'", 20, 10},
                                         RoundingCase{"rx='0' ry='5'", 0, 0}, RoundingCase{"rx='10%'", 20, 10}));

TEST_F(SvgGeometryTest, PolygonsCloseAndPolylinesDoNot)
{
    draw("<polygon id='a' points='0,0 10,0 10,10'/><polyline id='b' points='0 0 10 0 10 10'/>");
    EXPECT_TRUE(named("a")->path().contours().front().closed);
    EXPECT_FALSE(named("b")->path().contours().front().closed);
}

TEST_F(SvgGeometryTest, WhatHasNoExtentIsNotDrawn)
{
    draw("<rect width='0' height='5'/><rect width='5' height='-5'/><circle r='0'/><ellipse rx='3' ry='0'/><path d=''/>"
         "<polyline points='1 1'/><rect width='5' height='5' transform='scale(0)'/>");
    EXPECT_TRUE(shapes().empty());
}

TEST_F(SvgGeometryTest, PercentagesReferToTheViewport)
{
    draw("<rect x='10%' y='10%' width='50%' height='50%'/>", "width='400' height='100' viewBox='0 0 200 50'");
    expectBox(bounds(), Box({40, 10}, {240, 60}));
}

TEST_F(SvgGeometryTest, ANestedDrawingHasItsOwnViewport)
{
    draw("<svg x='10' y='20' width='100' height='50' viewBox='0 0 10 10'><rect width='100%' height='100%'/></svg>");
    expectBox(bounds(), Box({35, 20}, {85, 70}));  // 10 x 10 in the middle of 100 x 50
}

TEST_F(SvgGeometryTest, AUseStandsWhereItSays)
{
    draw("<defs><rect id='r' x='1' y='2' width='3' height='4'/></defs>"
         "<use xlink:href='#r' x='10' y='20' transform='scale(2)'/>");
    expectBox(bounds(), Box({22, 44}, {28, 52}));
}

TEST_F(SvgGeometryTest, ASymbolFitsTheSizeOfItsUse)
{
    draw("<symbol id='s' viewBox='0 0 10 10'><rect width='10' height='10'/></symbol>"
         "<use href='#s' x='5' width='40' height='20'/>");
    expectBox(bounds(), Box({15, 0}, {35, 20}));
}

TEST_F(SvgGeometryTest, StrokeWidthsGrowWithTheTransform)
{
    draw("<g transform='scale(3)'><path d='M 0 0 H 9' stroke='red' stroke-width='2' stroke-dasharray='4,1'/></g>");
    EXPECT_DOUBLE_EQ(strokeValue<double>(shape(), "width"), 6);
    EXPECT_EQ(strokeValue<std::string>(shape(), "dashes"), "12 3");
}

TEST_F(SvgGeometryTest, AStrokeThatDoesNotScaleKeepsItsWidth)
{
    draw("<path transform='scale(3)' d='M 0 0 H 9' stroke='red' stroke-width='2' vector-effect='non-scaling-stroke'/>");
    EXPECT_DOUBLE_EQ(strokeValue<double>(shape(), "width"), 2);
}

}  // namespace jet::test
