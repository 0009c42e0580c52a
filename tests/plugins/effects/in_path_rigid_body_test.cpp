#include "support/recording_painter.hpp"
#include "support/test_catalog.hpp"

#include <jet/effect.hpp>
#include <jet/scene.hpp>
#include <jet/scene_painter.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace {

using jet::test::RecordingPainter;

class InPathRigidBodyTest : public testing::Test {
protected:
    InPathRigidBodyTest() : scene_("Scene", events_, catalog_) {}

    const jet::Item& body(jet::Path path, jet::Properties properties = {})
    {
        auto edit = scene_.items().begin("Make a rigid body");
        const jet::Item& item = edit.add<jet::ShapeItem>(scene_.root(), std::move(path));
        edit.addEffect(item, "in-path-rigid-body", std::move(properties));
        edit.commit();
        return item;
    }
    jet::RigidBodyDef built(const jet::Item& item, const jet::BodyCommon& common = {})
    {
        const jet::Effect& effect = *catalog_.effect("in-path-rigid-body");
        const auto& properties = item.effect("in-path-rigid-body")->properties;
        return std::get<jet::RigidBodyDef>(
            effect.buildBody({item, item.path(), properties, effect.properties()}, common).value());
    }

    jet::test::TestCatalog catalog_{"org.jet.effect.in-path-rigid-body"};
    jet::EventsCenter events_;
    jet::Scene scene_;
};

TEST_F(InPathRigidBodyTest, MakesABodyOfAShapeInOneUndoableStep)
{
    const auto before = scene_.hash();
    const jet::Item& item = body(jet::Path::rectangle({{0, 0}, {10, 10}}));
    EXPECT_TRUE(item.is<jet::BodyItem>());
    const auto after = scene_.hash();
    scene_.undoRedo().undo();
    EXPECT_EQ(scene_.hash(), before);
    scene_.undoRedo().redo();
    EXPECT_EQ(scene_.hash(), after);
}

TEST_F(InPathRigidBodyTest, ThePolygonGoesThroughSegmentsAndIntermediatePoints)
{
    jet::Path path = jet::Path::ellipse({{0, 0}, {100, 100}});
    path.setIntermediate(2);
    const auto rings = built(body(path)).borders;
    ASSERT_EQ(rings.size(), 1u);
    EXPECT_EQ(rings[0], path.polygonized()[0].points);
}

TEST_F(InPathRigidBodyTest, WithoutIntermediatePointsThePolygonFollowsTheCurves)
{
    for (const double radius : {0.01, 50.0, 1e5}) {
        const auto rings = built(body(jet::Path::ellipse({{-radius, -2 * radius}, {radius, 2 * radius}}))).borders;
        ASSERT_EQ(rings.size(), 1u);
        EXPECT_GT(rings[0].size(), 20u);
        EXPECT_LT(rings[0].size(), 80u);
        double area = 0;
        for (std::size_t i = 0; i < rings[0].size(); ++i)
            area += 0.5 * jet::cross(rings[0][i], rings[0][(i + 1) % rings[0].size()]);
        EXPECT_NEAR(area, 2 * std::numbers::pi * radius * radius, 0.02 * area) << radius;
    }
}

TEST_F(InPathRigidBodyTest, ACircleIsACircleHoweverItIsTurnedAndScaled)
{
    for (const double radius : {0.01, 50.0, 1e5}) {
        for (const double angle : {0.0, 0.3, 2.0}) {
            jet::Path path = jet::Path::ellipse({{-radius, -radius}, {radius, radius}});
            path.transform(jet::Affine::translation({7 * radius, 0}) * jet::Affine::rotation(angle));
            const auto def = built(body(path, {{"mass", 3.0}}));
            ASSERT_EQ(def.shapes.size(), 1u);
            EXPECT_TRUE(def.borders.empty());
            EXPECT_EQ(def.mass, 3);
            EXPECT_EQ(def.shapes[0].kind, jet::ShapeDef::Kind::Circle);
            EXPECT_NEAR(def.shapes[0].radius, radius, 1e-9 * radius);
            EXPECT_NEAR((def.shapes[0].points.at(0) - jet::Vec2(7 * radius, 0)).norm(), 0, 1e-9 * radius);
        }
    }
}

TEST_F(InPathRigidBodyTest, WhatIsNoCircleStaysAPolygon)
{
    const jet::Path round = jet::Path::ellipse({{-50, -50}, {50, 50}});
    jet::Path dented = round, inTheMiddle = round, hole = round;
    dented.segment(1).point += jet::Vec2(0, 0.1);
    inTheMiddle.setIntermediate(3);
    hole.contours().push_back(jet::Path::ellipse({{-20, -20}, {20, 20}}).contours().front());
    std::vector<jet::Vec2> corners;
    for (int i = 0; i < 200; ++i)
        corners.push_back(50 * jet::Vec2(std::cos(i * 0.01 * std::numbers::pi), std::sin(i * 0.01 * std::numbers::pi)));
    for (const jet::Path& path : {jet::Path::ellipse({{-50, -50.1}, {50, 50.1}}), dented, inTheMiddle, hole,
                                  jet::Path::polygon(corners), jet::Path::rectangle({{-50, -50}, {50, 50}})}) {
        const auto def = built(body(path));
        EXPECT_TRUE(def.shapes.empty());
        EXPECT_FALSE(def.borders.empty());
    }
}

TEST_F(InPathRigidBodyTest, ARectangleHasItsFourCornersAndItsMass)
{
    jet::BodyCommon common;
    common.material = 2;
    const auto def = built(body(jet::Path::rectangle({{0, 0}, {30, 10}}), {{"mass", 5.0}}), common);
    EXPECT_EQ(def.borders.at(0).size(), 4u);
    EXPECT_EQ(def.mass, 5);
    EXPECT_EQ(def.common.material, 2u);
}

TEST_F(InPathRigidBodyTest, OpenContoursCountAsClosedAndFlatOnesAreDropped)
{
    const auto path = jet::Path::parse("M 0 0 L 50 0 L 50 50 M 100 100 L 200 100 M 5 5 h 10 v 10 h -10 z").orThrow();
    const auto rings = built(body(path)).borders;
    ASSERT_EQ(rings.size(), 2u);
    EXPECT_EQ(rings[0].size(), 3u);
    EXPECT_EQ(rings[1].size(), 4u);
}

TEST_F(InPathRigidBodyTest, AHoleIsARingOfItsOwn)
{
    const auto path = jet::Path::parse("M 0 0 h 100 v 100 h -100 z M 30 30 h 40 v 40 h -40 z").orThrow();
    EXPECT_EQ(built(body(path)).borders.size(), 2u);
}

TEST_F(InPathRigidBodyTest, RefusesWhatEnclosesNoArea)
{
    EXPECT_THROW(body(jet::Path::line({0, 0}, {50, 50})), jet::Failure);
    EXPECT_THROW(body({}), jet::Failure);
    EXPECT_EQ(scene_.items().itemCount(), 0u) << "the transaction rolled back";
}

TEST_F(InPathRigidBodyTest, IndicesOfEdgesAndVerticesShowWhenThereIsRoomForThem)
{
    const jet::Item& item = body(jet::Path::parse("M 0 0 h 100 v 100 h -100 z M 30 30 h 40 v 40 h -40 z").orThrow());
    const auto texts = [&](jet::PaintPurpose purpose, double pixelsPerUnit) {
        RecordingPainter painter(pixelsPerUnit);
        jet::paintItem(scene_, item, item.path(), purpose, painter);
        return painter.texts();
    };
    const auto near = texts(jet::PaintPurpose::Edit, 4);
    ASSERT_EQ(near.size(), 16u) << "eight edges and eight vertices";
    EXPECT_EQ(near[14].text, "7") << "counted through both rings";
    EXPECT_GT(near[0].style.color.b, near[0].style.color.r) << "edges are blue";
    EXPECT_GT(near[1].style.color.r, near[1].style.color.b) << "vertices are red";
    EXPECT_EQ(near[0].at, jet::Vec2(50, 0));
    EXPECT_TRUE(texts(jet::PaintPurpose::Edit, 0.2).empty());
    EXPECT_TRUE(texts(jet::PaintPurpose::Play, 4).empty());
    EXPECT_TRUE(texts(jet::PaintPurpose::Export, 4).empty());
}

}  // namespace
