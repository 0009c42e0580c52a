#include "support/recording_painter.hpp"
#include "support/test_catalog.hpp"

#include <jet/effect.hpp>
#include <jet/scene.hpp>
#include <jet/scene_painter.hpp>

#include <gtest/gtest.h>

#include <numeric>

namespace {

using jet::test::RecordingPainter;

class InPathBodyTest : public testing::Test {
protected:
    InPathBodyTest() : scene_("Scene", events_, catalog_) {}

    const jet::Item& add(std::string_view type, jet::Path path)
    {
        auto edit = scene_.items().begin("Add");
        const jet::Item& item = edit.add(type, scene_.root(), std::move(path));
        edit.commit();
        return item;
    }
    const jet::Item& ball() { return add("shape", jet::Path::ellipse({{0, 0}, {100, 100}})); }
    void apply(const jet::Item& item, jet::Properties properties = {})
    {
        auto edit = scene_.items().begin("Make a soft body");
        edit.addEffect(item, "in-path-body", std::move(properties));
        edit.commit();
    }
    jet::SoftBodyDef built(const jet::Item& item, const jet::BodyCommon& common = {})
    {
        const auto body = effect().buildBody(input(item), common);
        return std::get<jet::SoftBodyDef>(body.value());
    }
    const jet::Effect& effect() { return *catalog_.effect("in-path-body"); }
    jet::EffectInput input(const jet::Item& item)
    {
        return {item, item.path(), item.effect("in-path-body")->properties, effect().properties()};
    }
    RecordingPainter painted(const jet::Item& item, jet::PaintPurpose purpose, double pixelsPerUnit = 1)
    {
        RecordingPainter painter(pixelsPerUnit);
        jet::paintItem(scene_, item, item.path(), purpose, painter);
        return painter;
    }

    jet::test::TestCatalog catalog_{"org.jet.effect.in-path-body", "org.jet.effect.in-path-rigid-body"};
    jet::EventsCenter events_;
    jet::Scene scene_;
};

TEST_F(InPathBodyTest, MakesABodyOfAShapeInOneUndoableStep)
{
    const jet::Item& item = ball();
    const auto before = scene_.hash();
    apply(item);
    const auto after = scene_.hash();
    EXPECT_TRUE(item.is<jet::BodyItem>());
    scene_.undoRedo().undo();
    EXPECT_TRUE(item.is<jet::ShapeItem>());
    EXPECT_EQ(scene_.hash(), before);
    scene_.undoRedo().redo();
    EXPECT_EQ(scene_.hash(), after);
}

TEST_F(InPathBodyTest, ACircleWithoutIntermediatePointsGetsFourBetweenSegments)
{
    const jet::Item& item = ball();
    apply(item);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(item.path().segment(i).intermediate, 4);
    EXPECT_EQ(built(item).borders.at(0).size(), 20u);
}

TEST_F(InPathBodyTest, IntermediatePointsTheUserSetAreKept)
{
    jet::Path path = jet::Path::ellipse({{0, 0}, {100, 100}});
    path.segment(2).intermediate = 7;
    const jet::Item& curved = add("shape", path);
    apply(curved);
    EXPECT_EQ(curved.path(), path);

    const jet::Item& straight = add("shape", jet::Path::rectangle({{0, 0}, {50, 50}}));
    const jet::Path corners = straight.path();
    apply(straight);
    EXPECT_EQ(straight.path(), corners) << "a polygon is what it is";
}

TEST_F(InPathBodyTest, TheBodyHasTheGivenMassAndSpringConstants)
{
    const jet::Item& item = ball();
    apply(item, {{"mass", 7.0}, {"ks", 42.0}, {"kd", 0.5}, {"tear-ratio", 3.0}});
    const jet::SoftBodyDef body = built(item);
    ASSERT_EQ(body.masses.size(), body.particles.size());
    EXPECT_NEAR(std::accumulate(body.masses.begin(), body.masses.end(), 0.0), 7, 1e-12);
    EXPECT_FALSE(body.springs.empty());
    for (const jet::SpringDef& s : body.springs) {
        EXPECT_EQ(s.ks, 42);
        EXPECT_EQ(s.kd, 0.5);
        EXPECT_EQ(s.tearRatio, 3);
        EXPECT_DOUBLE_EQ(s.restLength, (body.particles[s.a] - body.particles[s.b]).norm()) << "at rest as drawn";
    }
}

TEST_F(InPathBodyTest, DefaultsAreTheThesiss)
{
    const jet::Item& item = ball();
    apply(item);
    const auto in = input(item);
    EXPECT_TRUE(in.get<bool>("border-on-segments"));
    EXPECT_EQ(in.get<int>("border-count"), 10);
    EXPECT_EQ(in.get<int>("border-to-inside"), 3);
    EXPECT_TRUE(in.get<bool>("border-springs"));
    EXPECT_EQ(in.get<int>("border-springs-from"), 1);
    EXPECT_EQ(in.get<int>("border-springs-to"), 2);
    EXPECT_EQ(in.get<int>("inside-springs-from"), 1);
    EXPECT_EQ(in.get<int>("inside-springs-to"), 2);
    EXPECT_TRUE(in.get<bool>("axis-aligned"));
    EXPECT_TRUE(in.get<bool>("cross"));
    EXPECT_EQ(in.get<double>("ks"), 10);
}

TEST_F(InPathBodyTest, TheBodysOwnPropertiesAreHandedOn)
{
    const jet::Item& item = ball();
    apply(item, {{"border-springs", false}, {"axis-aligned", false}, {"cross", false}});
    jet::BodyCommon common;
    common.fixed = true;
    common.material = 3;
    common.velocity = {1, 2};
    const jet::SoftBodyDef body = built(item, common);
    EXPECT_TRUE(body.common.fixed);
    EXPECT_EQ(body.common.material, 3u);
    EXPECT_EQ(body.common.velocity, jet::Vec2(1, 2));
    EXPECT_TRUE(body.springs.empty()) << "static ground: only a border";
    EXPECT_EQ(body.particles.size(), 20u);
}

TEST_F(InPathBodyTest, RefusesWhatCannotBeABodyInWords)
{
    const auto refusal = [&](const jet::Item& item) { return effect().rejects(item); };
    EXPECT_NE(refusal(add("shape", jet::Path::line({0, 0}, {9, 9}))).find("open"), std::string::npos);
    EXPECT_NE(refusal(add("shape", {})).find("outline"), std::string::npos);
    EXPECT_NE(refusal(add("spring", jet::Path::line({0, 0}, {9, 9}))).find("not a shape"), std::string::npos);
    const jet::Vec2 flat[] = {{0, 0}, {5, 0}, {9, 0}};
    EXPECT_NE(refusal(add("shape", jet::Path::polygon(flat))).find("flat"), std::string::npos);
    EXPECT_EQ(refusal(ball()), "");

    const jet::Item& item = ball();
    apply(item);
    EXPECT_NE(refusal(item).find("already"), std::string::npos);
    EXPECT_NE(catalog_.effect("in-path-rigid-body")->rejects(item).find("already"), std::string::npos);
}

TEST_F(InPathBodyTest, WhileEditingItShowsParticlesAndSpringsElsewhereNothing)
{
    const jet::Item& item = ball();
    apply(item);
    const jet::SoftBodyDef body = built(item);
    const RecordingPainter edit = painted(item, jet::PaintPurpose::Edit);
    std::size_t springs = 0, marks = 0;
    for (const auto& stroke : edit.strokes())
        if (stroke.pen.cosmetic) springs += stroke.path.contours().size();
    for (const auto& fill : edit.fills()) marks += fill.path.contours().size();
    EXPECT_GE(springs, body.springs.size());
    EXPECT_EQ(marks, body.particles.size());
    EXPECT_TRUE(edit.balanced());

    for (const auto purpose : {jet::PaintPurpose::Play, jet::PaintPurpose::Export})
        EXPECT_TRUE(painted(item, purpose).drawn().empty());
}

TEST_F(InPathBodyTest, FarAwayParticlesAreLeftOutOfTheDrawing)
{
    const jet::Item& item = ball();
    apply(item);
    EXPECT_TRUE(painted(item, jet::PaintPurpose::Edit, 0.1).fills().empty());
}

TEST_F(InPathBodyTest, ALatticeThatIsTooFineSaysSoAtItsPlaceAndDoesNotBuild)
{
    const jet::Item& item = ball();
    apply(item, {{"cell-size", jet::Vec2(0.01, 0.01)}});
    const RecordingPainter painter = painted(item, jet::PaintPurpose::Edit);
    ASSERT_EQ(painter.texts().size(), 1u);
    EXPECT_NE(painter.texts()[0].text.find("cell-size"), std::string::npos);
    EXPECT_TRUE(item.bounds().contains(painter.texts()[0].at));
    try {
        built(item);
        FAIL() << "built";
    } catch (const jet::Failure& failure) {
        EXPECT_NE(failure.error().message.find("cell-size"), std::string::npos);
    }
}

TEST_F(InPathBodyTest, AnEmptyPosedPathIsNoAccident)  // an item edited down to nothing after the effect was applied
{
    const jet::Item& item = ball();
    apply(item);
    auto edit = scene_.items().begin("Empty it");
    edit.setPath(item, {});
    edit.commit();
    EXPECT_NO_THROW(painted(item, jet::PaintPurpose::Edit));
    EXPECT_THROW(built(item), jet::Failure);
}

}  // namespace
