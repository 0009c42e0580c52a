// QtPainter: what arrives in the pixels. Shapes lie on whole pixels, so that a pixel is either in or out.
#include <jet/ui/qt_painter.hpp>

#include <gtest/gtest.h>

#include <QGuiApplication>
#include <QImage>
#include <QPainter>
#include <QPainterPath>

#include <cmath>
#include <numbers>

namespace jet::test {

using ui::QtPainter;

class QtPainterTest : public testing::Test {
protected:
    QtPainterTest() { image_.fill(Qt::white); }

    /// Draws 100 x 100 pixels with what `draw` does to the painter.
    template <class Draw>
    void paint(Draw draw)
    {
        QPainter target(&image_);
        QtPainter painter(target);
        draw(painter);
    }

    QColor at(int x, int y) const { return image_.pixelColor(x, y); }
    bool isWhite(int x, int y) const { return at(x, y) == QColor(Qt::white); }
    /// Ink in pixels: how much of white is gone.
    double ink() const
    {
        double sum = 0;
        for (int y = 0; y < image_.height(); ++y) {
            for (int x = 0; x < image_.width(); ++x) sum += 1 - qGray(image_.pixel(x, y)) / 255.0;
        }
        return sum;
    }

    QImage image_{100, 100, QImage::Format_ARGB32_Premultiplied};
    const Color black_{0, 0, 0, 255}, red_{255, 0, 0, 255};
};

TEST_F(QtPainterTest, APathKeepsItsCurvesAndLines)
{
    Path path;
    path.moveTo({0, 0});
    path.lineTo({10, 0});
    path.cubicTo({20, 0}, {20, 10}, {10, 10});
    path.close();
    const QPainterPath qt = ui::toQt(path);
    ASSERT_EQ(qt.elementCount(), 6);
    EXPECT_TRUE(qt.elementAt(1).isLineTo());
    EXPECT_TRUE(qt.elementAt(2).isCurveTo());
    EXPECT_EQ(QPointF(qt.elementAt(3)), QPointF(20, 10));
    EXPECT_EQ(QPointF(qt.elementAt(5)), QPointF(0, 0));  // closed
}

TEST_F(QtPainterTest, ATransformKeepsAllSixNumbers)
{
    const QTransform qt = ui::toQt(Affine::fromSvg(1, 2, 3, 4, 5, 6));
    EXPECT_EQ(qt.map(QPointF(10, 100)), QPointF(1 * 10 + 3 * 100 + 5, 2 * 10 + 4 * 100 + 6));
}

TEST_F(QtPainterTest, ADiscHasItsArea)
{
    paint([&](QtPainter& p) { p.fill(Path::ellipse(Box({10, 10}, {90, 90})), black_, FillRule::NonZero); });
    EXPECT_NEAR(ink(), std::numbers::pi * 40 * 40, 10);
}

TEST_F(QtPainterTest, TheFillRuleDecidesOnOverlaps)
{
    Path path = Path::rectangle(Box({10, 10}, {90, 90}));
    path.contours().push_back(Path::rectangle(Box({30, 30}, {70, 70})).contours().front());
    paint([&](QtPainter& p) { p.fill(path, black_, FillRule::EvenOdd); });
    EXPECT_TRUE(isWhite(50, 50));
    EXPECT_EQ(at(20, 20), QColor(Qt::black));
    paint([&](QtPainter& p) { p.fill(path, black_, FillRule::NonZero); });
    EXPECT_EQ(at(50, 50), QColor(Qt::black));
}

TEST_F(QtPainterTest, SaveAndRestoreCoverTransformClipAndOpacity)
{
    const Path square = Path::rectangle(Box({0, 0}, {10, 10}));
    paint([&](QtPainter& p) {
        p.save();
        p.transform(Affine::translation({20, 20}));
        p.clip(Path::rectangle(Box({0, 0}, {5, 10})), FillRule::NonZero);
        p.opacity(0.5);
        p.opacity(0.5);
        p.fill(square, black_, FillRule::NonZero);
        p.restore();
        p.fill(square, black_, FillRule::NonZero);
    });
    EXPECT_NEAR(at(22, 25).red(), 191, 1);  // a quarter of black
    EXPECT_TRUE(isWhite(27, 25));
    EXPECT_EQ(at(8, 8), QColor(Qt::black));
}

TEST_F(QtPainterTest, ALinearGradientRunsWithoutPremultiplying)
{
    const LinearGradient gradient{{0, 0}, {100, 0}, {{0, red_}, {1, Color{0, 0, 255, 0}}}};
    image_.fill(Qt::transparent);
    paint([&](QtPainter& p) { p.fill(Path::rectangle(Box({0, 0}, {100, 100})), gradient, FillRule::NonZero); });
    const QColor middle = at(50, 50);
    EXPECT_NEAR(middle.alpha(), 127, 2);
    EXPECT_NEAR(middle.red(), 127, 3);  // premultiplied interpolation would leave it red
    EXPECT_NEAR(middle.blue(), 127, 3);
}

TEST_F(QtPainterTest, AGradientFollowsItsTransformAndSpread)
{
    Brush brush(LinearGradient{{0, 0}, {1, 0}, {{0, black_}, {0.5, black_}, {0.5, red_}, {1, red_}}});
    brush.transform = Affine::scaling({20, 20});
    brush.spread = GradientSpread::Repeat;
    paint([&](QtPainter& p) { p.fill(Path::rectangle(Box({0, 0}, {100, 100})), brush, FillRule::NonZero); });
    for (int x = 5; x < 100; x += 20) EXPECT_EQ(at(x, 50), QColor(Qt::black)) << x;
    for (int x = 15; x < 100; x += 20) EXPECT_EQ(at(x, 50), QColor(Qt::red)) << x;
}

TEST_F(QtPainterTest, ARadialGradientWithoutARadiusIsItsLastColour)
{
    const RadialGradient gradient{{50, 50}, 0, {50, 50}, {{0, black_}, {1, red_}}};
    paint([&](QtPainter& p) { p.fill(Path::rectangle(Box({0, 0}, {100, 100})), gradient, FillRule::NonZero); });
    EXPECT_EQ(at(50, 50), QColor(Qt::red));
}

struct CapCase {
    LineCap cap;
    double ink;  // of a line of 40 x 20
};

class QtPainterCapTest : public QtPainterTest, public testing::WithParamInterface<CapCase> {};

TEST_P(QtPainterCapTest, AddsItsArea)
{
    Pen pen;
    pen.width = 20;
    pen.cap = GetParam().cap;
    paint([&](QtPainter& p) { p.stroke(Path::line({30, 50}, {70, 50}), pen); });
    EXPECT_NEAR(ink(), GetParam().ink, 2);
}

INSTANTIATE_TEST_SUITE_P(All, QtPainterCapTest,
                         testing::Values(CapCase{LineCap::Butt, 800}, CapCase{LineCap::Square, 1200},
                                         CapCase{LineCap::Round, 800 + std::numbers::pi * 100}));

TEST_F(QtPainterTest, APointWithRoundCapsIsADot)
{
    Pen pen;
    pen.width = 20;
    pen.cap = LineCap::Round;
    paint([&](QtPainter& p) { p.stroke(Path::line({50, 50}, {50, 50}), pen); });
    EXPECT_NEAR(ink(), std::numbers::pi * 100, 2);
}

TEST_F(QtPainterTest, DashesAreInSceneUnits)
{
    Pen pen;
    pen.width = 4;
    pen.dashes = {10};  // an odd list repeats: 10 on, 10 off
    pen.dashOffset = 5;
    paint([&](QtPainter& p) { p.stroke(Path::line({0, 50}, {100, 50}), pen); });
    EXPECT_EQ(at(2, 50), QColor(Qt::black));
    EXPECT_TRUE(isWhite(10, 50));
    EXPECT_EQ(at(20, 50), QColor(Qt::black));
}

TEST_F(QtPainterTest, DashesWithoutLengthAreDots)
{
    Pen pen;
    pen.width = 10;
    pen.cap = LineCap::Square;
    pen.dashes = {0, 20};
    paint([&](QtPainter& p) { p.stroke(Path::line({10, 50}, {95, 50}), pen); });
    EXPECT_NEAR(ink(), 5 * 100, 5);
}

TEST_F(QtPainterTest, HostileDashesEnd)
{
    Pen pen;
    pen.width = 1;
    pen.dashes = {1e-9, 1e-9};
    paint([&](QtPainter& p) { p.stroke(Path::line({0, 50}, {1e6, 50}), pen); });
    EXPECT_GT(ink(), 90);
}

TEST_F(QtPainterTest, ACosmeticPenKeepsItsPixelsAtAnyScale)
{
    Pen pen;
    pen.width = 2;
    pen.cosmetic = true;
    paint([&](QtPainter& p) {
        p.transform(Affine::scaling({10, 10}));
        p.stroke(Path::line({1, 5}, {9, 5}), pen);
    });
    EXPECT_NEAR(ink(), 80 * 2, 3);
}

TEST_F(QtPainterTest, AWidthOfZeroDrawsNothing)
{
    Pen pen;
    pen.width = 0;
    paint([&](QtPainter& p) { p.stroke(Path::line({1, 5}, {9, 5}), pen); });
    EXPECT_EQ(ink(), 0);
}

struct JoinCase {
    LineJoin join;
    double limit;
    bool cornerInked;
};

class QtPainterJoinTest : public QtPainterTest, public testing::WithParamInterface<JoinCase> {};

TEST_P(QtPainterJoinTest, FillsTheCornerOrNot)
{
    // A right angle: the miter is sqrt(2) line widths long.
    Pen pen;
    pen.width = 20;
    pen.join = GetParam().join;
    pen.miterLimit = GetParam().limit;
    const Vec2 points[] = {{30, 90}, {30, 30}, {90, 30}};
    paint([&](QtPainter& p) { p.stroke(Path::polygon(points, false), pen); });
    EXPECT_EQ(!isWhite(21, 21), GetParam().cornerInked);
}

INSTANTIATE_TEST_SUITE_P(All, QtPainterJoinTest,
                         testing::Values(JoinCase{LineJoin::Miter, 4, true}, JoinCase{LineJoin::Miter, 1.42, true},
                                         JoinCase{LineJoin::Miter, 1.4, false}, JoinCase{LineJoin::Bevel, 4, false},
                                         JoinCase{LineJoin::Round, 4, false}));

TEST_F(QtPainterTest, PixelsPerUnitIsTheScaleNow)
{
    paint([&](QtPainter& p) {
        p.transform(Affine::scaling({3, 3}));
        p.transform(Affine::rotation(1));
        EXPECT_NEAR(p.pixelsPerUnit(), 3, 1e-12);
    });
}

TEST_F(QtPainterTest, TextIsPaintedWithoutAnApplicationOfTheCaller)
{
    paint([&](QtPainter& p) { p.text({50, 50}, "XX", {.color = black_, .size = 40, .centered = true}); });
    EXPECT_TRUE(QGuiApplication::instance());
    EXPECT_GT(ink(), 50);
    double left = 0, right = 0;
    for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 50; ++x) left += isWhite(x, y) ? 0 : 1, right += isWhite(99 - x, y) ? 0 : 1;
    }
    EXPECT_NEAR(left, right, 0.2 * (left + right));  // centred
}

TEST_F(QtPainterTest, CosmeticTextKeepsItsSize)
{
    const auto inkAt = [&](double scale) {
        image_.fill(Qt::white);
        paint([&](QtPainter& p) {
            p.transform(Affine::scaling({scale, scale}));
            p.text(Vec2(10, 50) / scale, "XX", {.color = black_, .size = 20, .cosmetic = true});
        });
        return ink();
    };
    // Hinting differs a little between the two; without the compensation it would be 49 times as much.
    const double ink = inkAt(1);
    EXPECT_NEAR(inkAt(7), ink, 0.25 * ink);
}

TEST_F(QtPainterTest, AnImageFillsItsBox)
{
    const Image image{2, 1, {255, 0, 0, 255, 0, 0, 255, 255}};
    paint([&](QtPainter& p) { p.image(Box({0, 0}, {100, 100}), image); });
    EXPECT_EQ(at(5, 50), QColor(Qt::red));
    EXPECT_EQ(at(95, 50), QColor(Qt::blue));
}

TEST_F(QtPainterTest, AnImageWithTooFewPixelsIsNotRead)
{
    const Image image{1000, 1000, {1, 2, 3}};
    paint([&](QtPainter& p) { p.image(Box({0, 0}, {100, 100}), image); });
    EXPECT_EQ(ink(), 0);
}

}  // namespace jet::test
