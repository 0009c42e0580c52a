#include "support/recording_painter.hpp"
#include "support/test_catalog.hpp"

#include <jet/effect.hpp>

#include <gtest/gtest.h>

namespace {

class StrokeTest : public testing::Test {
protected:
    /// The pen of the stroke painted with these properties; none when nothing is painted.
    std::optional<jet::Pen> pen(jet::Properties properties)
    {
        const jet::Effect& stroke = *catalog_.effect("stroke");
        const jet::Item item({1}, "shape");
        const jet::Path path = jet::Path::line({0, 0}, {10, 0});
        jet::test::RecordingPainter painter;
        stroke.paint({item, path, properties, stroke.properties()}, nullptr, jet::PaintPurpose::Export, painter);
        if (painter.drawn().empty()) return {};
        EXPECT_EQ(painter.strokes().at(0).path, path);
        return painter.strokes().at(0).pen;
    }
    std::vector<double> dashes(const char* text) { return pen({{"dashes", text}}).value().dashes; }

    jet::test::TestCatalog catalog_{"org.jet.effect.stroke"};
};

TEST_F(StrokeTest, DefaultsAreThoseOfSvg)
{
    const jet::Pen plain = pen({}).value();
    EXPECT_EQ(plain.color, (jet::Color{0, 0, 0, 255}));
    EXPECT_EQ(plain.width, 1);
    EXPECT_FALSE(plain.cosmetic);
    EXPECT_EQ(plain.cap, jet::LineCap::Butt);
    EXPECT_EQ(plain.join, jet::LineJoin::Miter);
    EXPECT_EQ(plain.miterLimit, 4);
    EXPECT_TRUE(plain.dashes.empty());
}

TEST_F(StrokeTest, EveryPropertyReachesThePen)
{
    const jet::Pen p = pen({{"color", jet::Color{1, 2, 3, 4}},
                            {"width", 2.5},
                            {"cap", "square"},
                            {"join", "bevel"},
                            {"miter-limit", 7.0},
                            {"dashes", "6 3"},
                            {"dash-offset", 1.5}})
                           .value();
    EXPECT_EQ(p.color, (jet::Color{1, 2, 3, 4}));
    EXPECT_EQ(p.width, 2.5);
    EXPECT_EQ(p.cap, jet::LineCap::Square);
    EXPECT_EQ(p.join, jet::LineJoin::Bevel);
    EXPECT_EQ(p.miterLimit, 7);
    EXPECT_EQ(p.dashes, (std::vector<double>{6, 3}));
    EXPECT_EQ(p.dashOffset, 1.5);
}

TEST_F(StrokeTest, AnOddListOfDashesIsRepeated)
{
    EXPECT_EQ(dashes("1, 2,3"), (std::vector<double>{1, 2, 3, 1, 2, 3}));
    EXPECT_EQ(dashes(" 5 "), (std::vector<double>{5, 5}));
}

TEST_F(StrokeTest, DashesThatMeanNothingGiveASolidLine)
{
    for (const char* text : {"", "none", "0 0", "4 -1", "4 4x", ",,"}) EXPECT_TRUE(dashes(text).empty()) << text;
}

TEST_F(StrokeTest, AZeroWidthDrawsNothing) { EXPECT_FALSE(pen({{"width", 0.0}})); }

}  // namespace
