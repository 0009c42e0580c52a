#include "support/recording_painter.hpp"
#include "support/test_catalog.hpp"

#include <jet/effect.hpp>
#include <jet/scene.hpp>
#include <jet/scene_painter.hpp>

#include <gtest/gtest.h>

namespace {

using jet::test::RecordingPainter;

class PolygonFaceTest : public testing::Test {
protected:
    PolygonFaceTest() : scene_("Scene", events_, catalog_) {}

    const jet::Item& face(jet::Path path, jet::Properties properties = {})
    {
        auto edit = scene_.items().begin("Add");
        const jet::Item& shape = edit.add<jet::ShapeItem>(scene_.root(), std::move(path));
        edit.addEffect(shape, "polygon-face", std::move(properties));
        edit.commit();
        return shape;
    }
    RecordingPainter painted(const jet::Item& item, jet::PaintPurpose purpose = jet::PaintPurpose::Export)
    {
        RecordingPainter painter;
        jet::paintItem(scene_, item, item.path(), purpose, painter);
        return painter;
    }

    jet::test::TestCatalog catalog_{"org.jet.effect.polygon-face"};
    jet::EventsCenter events_;
    jet::Scene scene_;
};

TEST_F(PolygonFaceTest, FillsTheExactCurveInGreenUnlessToldOtherwise)
{
    const jet::Item& shape = face(jet::Path::ellipse({{0, 0}, {10, 10}}));
    const auto fills = painted(shape).fills();
    ASSERT_EQ(fills.size(), 1u);
    EXPECT_EQ(fills[0].path, shape.path());
    EXPECT_EQ(fills[0].rule, jet::FillRule::NonZero);
    EXPECT_GT(fills[0].color().g, fills[0].color().r);
    EXPECT_GT(fills[0].color().g, fills[0].color().b);
}

TEST_F(PolygonFaceTest, WithoutCurvedFillsThePolygonThroughSegmentsAndIntermediatePoints)
{
    jet::Path path = jet::Path::ellipse({{0, 0}, {10, 10}});
    path.setIntermediate(2);
    const jet::Item& shape = face(path, {{"curved", false}, {"color", jet::Color{255, 0, 0, 255}}});
    for (const auto purpose : {jet::PaintPurpose::Edit, jet::PaintPurpose::Play}) {  // with and without update()
        const auto fills = painted(shape, purpose).fills();
        ASSERT_EQ(fills.size(), 1u);
        EXPECT_EQ(fills[0].color(), (jet::Color{255, 0, 0, 255}));
        const jet::Contour& polygon = fills[0].path.contours().at(0);
        const auto expected = path.polygonized().at(0).points;
        ASSERT_EQ(polygon.segments.size(), 4u * 3);
        for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(polygon.segments[i], jet::Segment(expected[i]));
    }
}

TEST_F(PolygonFaceTest, PaintsThePosedPathNotTheDrawnOne)
{
    const jet::Item& shape = face(jet::Path::rectangle({{0, 0}, {10, 10}}));
    const jet::Path pose = shape.path().transformed(jet::Affine::translation({100, 0}));
    RecordingPainter painter;
    jet::paintItem(scene_, shape, pose, jet::PaintPurpose::Play, painter);
    ASSERT_EQ(painter.fills().size(), 1u);
    EXPECT_EQ(painter.fills()[0].path, pose);
}

TEST_F(PolygonFaceTest, TheFillRuleIsHandedOn)
{
    const jet::Item& shape = face(jet::Path::rectangle({{0, 0}, {10, 10}}), {{"fill-rule", "evenodd"}});
    EXPECT_EQ(painted(shape).fills().at(0).rule, jet::FillRule::EvenOdd);
}

TEST_F(PolygonFaceTest, AnInvisibleFaceIsNotPainted)
{
    const jet::Item& shape = face(jet::Path::rectangle({{0, 0}, {10, 10}}));
    auto edit = scene_.items().begin("Hide");
    edit.setEffect(shape, 0, "visible", false);
    edit.commit();
    EXPECT_TRUE(painted(shape).fills().empty());
}

}  // namespace
