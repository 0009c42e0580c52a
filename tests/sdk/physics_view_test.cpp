// What is drawn of a running world: only what is asked for, where it is, in the colours that tell.
#include "support/recording_painter.hpp"
#include "support/test_catalog.hpp"

#include <jet/physics_view.hpp>
#include <jet/simulation.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace jet {

namespace {

using test::RecordingPainter;

PhysicsPicture picture()
{
    PhysicsPicture p;
    p.points = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    PhysicsPicture::Body body;
    body.bounds = Box({0, 0}, {10, 10}), body.centre = {5, 5}, body.moves = true, body.island = 3;
    body.firstPoint = 0, body.pointCount = 4;
    p.bodies.push_back(body);
    body.bounds = Box({20, 0}, {30, 10}), body.centre = {25, 5}, body.awake = false, body.pointCount = 0;
    p.bodies.push_back(body);
    Contact contact;
    contact.point = {5, 10}, contact.normal = {0, -1}, contact.impulse = 4;
    p.contacts.push_back(contact);
    p.springs = {{{0, 0}, {5, 0}, 0.2}, {{5, 0}, {9, 0}, -0.2}, {{0, 5}, {5, 5}, 0}};
    JointState joint;
    joint.pointA = {40, 0}, joint.pointB = {40, 8};
    p.joints = {joint};
    joint.broken = true;
    p.joints.push_back(joint);
    return p;
}

RecordingPainter painted(PhysicsMarks marks)
{
    RecordingPainter painter;
    paintPhysics(picture(), marks, painter);
    return painter;
}

TEST(PhysicsView, WithoutMarksNothingIsDrawn)
{
    RecordingPainter painter = painted({});
    EXPECT_TRUE(painter.fills().empty());
    EXPECT_TRUE(painter.strokes().empty());
    PhysicsMarks statistics;
    statistics.statistics = true;
    EXPECT_TRUE(statistics.any());
    EXPECT_TRUE(painted(statistics).strokes().empty());
}

TEST(PhysicsView, SleepingBodiesAreGreyAndIslandsHaveColours)
{
    PhysicsMarks marks;
    marks.islands = true;
    const auto fills = painted(marks).fills();
    ASSERT_EQ(fills.size(), 2u);
    const Color island = fills[0].color(), asleep = fills[1].color();
    EXPECT_FALSE(island.r == island.g && island.g == island.b);
    EXPECT_TRUE(asleep.r == asleep.g && asleep.g == asleep.b);
    EXPECT_EQ(fills[0].path.bounds(), Box({0, 0}, {10, 10}));
}

TEST(PhysicsView, StretchedSpringsAreRedAndPressedOnesBlue)
{
    PhysicsMarks marks;
    marks.stress = true;
    int red = 0, blue = 0, grey = 0;
    for (const auto& stroke : painted(marks).strokes()) {
        const Color c = stroke.color();
        red += c.r > c.b, blue += c.b > c.r, grey += c.r == c.b;
    }
    EXPECT_EQ(red, 1);
    EXPECT_EQ(blue, 1);
    EXPECT_EQ(grey, 1);
}

/// As a spring of next to no stiffness has.
TEST(PhysicsView, StressThatIsNoNumberIsDrawnAsNone)
{
    PhysicsPicture odd = picture();
    odd.springs = {{{0, 0}, {5, 0}, std::numeric_limits<double>::quiet_NaN()}};
    PhysicsMarks marks;
    marks.stress = true;
    RecordingPainter painter;
    paintPhysics(odd, marks, painter);
    ASSERT_EQ(painter.strokes().size(), 1U);
    const Color c = painter.strokes()[0].color();
    EXPECT_EQ(c.r, c.b);
}

TEST(PhysicsView, ContactsPointAlongTheirNormals)
{
    PhysicsMarks marks;
    marks.contacts = true;
    const RecordingPainter painter = painted(marks);
    Box drawn;
    for (const auto& stroke : painter.strokes()) drawn.extend(stroke.path.bounds());
    EXPECT_LT(drawn.min.y(), -2) << "away from the wall";
    EXPECT_LE(drawn.max.y(), 10);
    EXPECT_EQ(painter.fills().size(), 1u);
}

TEST(PhysicsView, JointsBoxesAndCentresAreDrawnWhereTheyAre)
{
    PhysicsMarks joints, boxes, centres;
    joints.joints = boxes.boxes = centres.centres = true;
    EXPECT_EQ(painted(joints).strokes().size(), 2u) << "whole and broken ones";
    EXPECT_EQ(painted(joints).strokes()[0].path.bounds().center().x(), 40);
    ASSERT_EQ(painted(boxes).strokes().size(), 1u);
    EXPECT_EQ(painted(boxes).strokes()[0].path.bounds(), Box({0, 0}, {30, 10}));
    EXPECT_TRUE(painted(centres).fills()[0].path.bounds().contains(Vec2(5, 5)));
}

}  // namespace

}  // namespace jet
