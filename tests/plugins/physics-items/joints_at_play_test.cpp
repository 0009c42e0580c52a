// What is seen of joints and springs while a scene plays: they are where the bodies are that they hold.
#include "live_scene.hpp"

#include "support/recording_painter.hpp"

#include <jet/item_type.hpp>
#include <jet/scene_painter.hpp>

namespace jet::test {

namespace {

class JointsAtPlay : public LiveSceneOfEngine {
protected:
    const Item& item(ItemId id) { return *simulation_->scene().items().find(id); }
    Vec2 point(ItemId id, std::size_t segment) { return simulation_->pose(item(id))->segment(segment).point; }
    JointState joint(ItemId id) { return simulation_->world().joint(simulation_->jointOf(id)); }
    std::size_t strokes(PaintPurpose purpose)
    {
        RecordingPainter painter;
        paintScene(simulation_->scene(), simulation_.get(), purpose, Box({-1e4, -1e4}, {1e4, 1e4}), painter);
        return painter.strokes().size();
    }
};

TEST_P(JointsAtPlay, AHingeTurnsWithItsBodyAndItsOtherEndStays)
{
    const ItemId bob = box({{90, -10}, {110, 10}});
    const ItemId hinge = add("joint", line({{-30, 0}, {0, 0}, {100, 0}}), {{"kind", "revolute"}});
    play(0.7);
    EXPECT_GT(place(bob).y(), 20) << "it swings";
    EXPECT_EQ(point(hinge, 0), Vec2(-30, 0));
    EXPECT_NEAR(point(hinge, 1).norm(), 0, 0.1);
    EXPECT_NEAR((point(hinge, 2) - place(bob)).norm(), 0, 1e-4);
}

TEST_P(JointsAtPlay, APulleysWheelsStayAndItsEndsGoUpAndDown)
{
    const ItemId light = box({{-10, 90}, {10, 110}}, {}), heavy = box({{90, 80}, {130, 120}});
    const ItemId pulley = add("joint", line({{0, 100}, {0, 0}, {110, 0}, {110, 100}}), {{"kind", "pulley"}});
    simulation_ = Simulation::start(scene_, options_).orThrow();
    simulation_->world().setMass(simulation_->bodyOf(heavy), 2);
    play(0.5);
    EXPECT_LT(place(light).y(), 98);
    EXPECT_NEAR((point(pulley, 0) - place(light)).norm(), 0, 0.1);
    EXPECT_EQ(point(pulley, 1), Vec2(0, 0));
    EXPECT_EQ(point(pulley, 2), Vec2(110, 0));
    EXPECT_NEAR((point(pulley, 3) - place(heavy)).norm(), 0, 0.1);
}

TEST_P(JointsAtPlay, WhatBreaksIsNotSeenAnyMore)
{
    box({{-10, 50}, {10, 70}});
    const ItemId rope = add("joint", line({{0, 0}, {0, 60}}), {{"kind", "rope"}, {"break-force", 20.0}});
    play(0);
    EXPECT_FALSE(simulation_->pose(item(rope))->isEmpty());
    const std::size_t before = strokes(PaintPurpose::Play);
    play(1);
    ASSERT_TRUE(joint(rope).broken);
    EXPECT_TRUE(simulation_->pose(item(rope))->isEmpty());
    EXPECT_LT(strokes(PaintPurpose::Play), before);
}

TEST_P(JointsAtPlay, AMouseJointGoesToWhereItPullsNow)
{
    const ItemId ball = box({{-10, 50}, {10, 70}});
    const ItemId mouse = add("joint", line({{0, 60}, {0, 0}}), {{"kind", "mouse"}, {"hertz", 4.0}, {"max-force", 1e5}});
    play(0.1);
    simulation_->world().setJointTarget(simulation_->jointOf(mouse), {200, 30});
    play(2);
    EXPECT_NEAR((point(mouse, 1) - Vec2(200, 30)).norm(), 0, 1e-3);
    EXPECT_NEAR((point(mouse, 0) - place(ball)).norm(), 0, 0.1);
}

TEST_P(JointsAtPlay, ASpringOfManyTurnsStretchesBetweenItsEnds)
{
    const ItemId weight = box({{-10, 90}, {10, 110}});
    const ItemId spring = add("spring", line({{0, 0}, {5, 25}, {-5, 50}, {5, 75}, {0, 100}}), {{"ks", 3.0}});
    play(0.6);
    const double fallen = place(weight).y() - 100;
    EXPECT_GT(fallen, 10);
    EXPECT_EQ(point(spring, 0), Vec2(0, 0));
    EXPECT_NEAR(point(spring, 2).y(), 50 + 0.5 * fallen, 0.1);
    EXPECT_NEAR(point(spring, 4).y(), 100 + fallen, 0.1);
}

TEST_P(JointsAtPlay, ASpringThatToreIsNotSeen)
{
    box({{-10, 90}, {10, 110}});
    const ItemId spring = add("spring", line({{0, 0}, {0, 100}}), {{"ks", 0.5}, {"tear-ratio", 1.5}});
    play(0.5);
    EXPECT_FALSE(simulation_->pose(item(spring))->isEmpty());
    play(2);
    EXPECT_TRUE(simulation_->pose(item(spring))->isEmpty());
}

TEST_P(JointsAtPlay, AForceGoesWithItsBody)
{
    const ItemId pushed = box({{-10, 0}, {10, 20}});
    const ItemId force = add("force", Path::rectangle({{-2, 8}, {2, 12}}), {{"value", Vec2(300, 0)}});
    play(1);
    EXPECT_GT(place(pushed).x(), 50);
    EXPECT_NEAR((simulation_->pose(item(force))->bounds().center() - place(pushed)).norm(), 0, 1e-3);
}

TEST_P(JointsAtPlay, TheyAreSeenWithoutALookOfTheirOwnAndNotInPicturesOfTheDrawing)
{
    box({{-10, 50}, {10, 70}});
    const ItemId rope = add("joint", line({{0, 0}, {0, 60}}), {{"kind", "rope"}});
    play(0.1);
    EXPECT_EQ(strokes(PaintPurpose::Play), strokes(PaintPurpose::Export) + 1);
    auto edit = scene_.items().begin("Look");
    edit.addEffect(*scene_.items().find(rope), "stroke", {{"width", 3.0}});
    edit.commit();
    simulation_.reset();
    play(0.1);
    EXPECT_EQ(strokes(PaintPurpose::Play), strokes(PaintPurpose::Export)) << "the effect is what is seen";
}

INSTANTIATE_TEST_SUITE_P(Engines, JointsAtPlay, testing::Values("jet-physics", "physics-box2d"));

class SoftJointsAtPlay : public JointsAtPlay {
protected:
    /// How far a soft bar turns, in radians, that is welded to the background near its left end.
    double sags(double radius)
    {
        const ItemId bar = add("shape", Path::rectangle({{0, 0}, {200, 30}}), {}, "in-path-body");
        auto edit = scene_.items().begin("Stiff");
        edit.setEffect(*scene_.items().find(bar), 0, "ks", 400.0);
        edit.setEffect(*scene_.items().find(bar), 0, "kd", 6.0);
        edit.commit();
        const ItemId weld = add("joint", line({{-15, 15}, {10, 15}, {11, 15}}), {{"kind", "weld"}, {"radius", radius}});
        play(5);
        const double angle = simulation_->world().bodies().angle[simulation_->bodyOf(bar)];
        simulation_.reset();
        auto gone = scene_.items().begin("Remove");
        gone.remove(*scene_.items().find(bar));
        gone.remove(*scene_.items().find(weld));
        gone.commit();
        return angle;
    }
};

TEST_P(SoftJointsAtPlay, ABarSagsLessTheLargerTheRegionItIsHeldBy)
{
    const double nearest = sags(0), small = sags(24), large = sags(60);
    EXPECT_GT(nearest, 0.05);
    EXPECT_LT(small, 0.7 * nearest);
    EXPECT_LT(large, 0.8 * small);
    EXPECT_GT(large, 0.01) << "what is farther out sags all the same";
}

TEST_P(SoftJointsAtPlay, ARadiusWithoutAnythingInItIsSaid)
{
    add("shape", Path::rectangle({{0, 0}, {200, 30}}), {}, "in-path-body");
    add("joint", line({{-15, 15}, {10, 15}, {11, 15}}), {{"radius", 1e-3}});
    play(0);
    ASSERT_EQ(printed().size(), 1u);
    EXPECT_THAT(printed()[0], testing::HasSubstr("is within the radius of the joint's anchor"));
}

TEST_P(SoftJointsAtPlay, WhatIsHeldStaysAsItWasWhenPlayStarted)
{
    add("shape", Path::rectangle({{0, 0}, {160, 40}}), {}, "in-path-body");
    const ItemId hinge = add("joint", line({{80, -30}, {80, 20}, {81, 20}}), {{"radius", 20.0}});
    play(0);
    EXPECT_THAT(refusal(hinge, "radius", 30.0), testing::HasSubstr("goes on holding what it held"));
    EXPECT_EQ(refusal(hinge, "break-force", 1e6), "accepted");
}

INSTANTIATE_TEST_SUITE_P(Engines, SoftJointsAtPlay, testing::Values("jet-physics"));

}  // namespace

}  // namespace jet::test
