// Bodies of one shape have no points and walls as long as nothing goes by them; nobody who looks sees a difference.
#include "scenes.hpp"

#include <algorithm>

namespace jet::physics::test {

namespace {

RigidBodyDef of(ShapeDef::Kind kind, std::vector<Vec2> points, double radius = 0)
{
    RigidBodyDef def;
    def.shapes.push_back({kind, std::move(points), radius});
    return def;
}

std::vector<Vec2> reversed(std::vector<Vec2> ring)
{
    std::reverse(ring.begin(), ring.end());
    return ring;
}

/// All kinds of bodies: those of one shape, in either direction, and those that keep their points.
std::vector<RigidBodyDef> allKinds()
{
    using Kind = ShapeDef::Kind;
    RigidBodyDef compound = of(Kind::Polygon, boxRing({150, 0}, 20, 10));
    compound.shapes.push_back({Kind::Circle, {{150, -8}}, 5});
    RigidBodyDef lift = of(Kind::Polygon, boxRing({300, 0}, 40, 8));
    lift.common.kinematic = true;
    return {simple(ground(100)),
            of(Kind::Polygon, boxRing({0, 0}, 20, 10, 0.3)),
            of(Kind::Polygon, reversed(boxRing({50, 0}, 12, 30, 1))),
            of(Kind::Circle, {{100, 0}}, 7),
            compound,
            of(Kind::Capsule, {{200, 0}, {210, 15}}, 4),
            box({250, 0}, 20, 20),
            lift,
            of(Kind::Polygon, {{350, 0}, {370, 5}, {355, 20}})};
}

/// A soft body far away makes bodies have their points and walls from the start.
std::unique_ptr<PhysicsWorld> worldOf(const std::vector<RigidBodyDef>& defs, bool lean, const Vec2& gravity = {0, 98.1})
{
    WorldSettings settings;
    settings.gravity = gravity;
    settings.allowSleep = false;
    settings.substeps = 8;
    auto world = JetPhysics().createWorld(settings);
    if (!lean) world->addSoftBody(softBall({1e5, 0}, 10));
    for (const RigidBodyDef& def : defs) world->addRigidBody(def);
    return world;
}

void expectSameOutlines(const PhysicsWorld& a, const PhysicsWorld& b, BodyHandle offset, double within)
{
    for (BodyHandle body = 0; body < a.bodyCount(); ++body) {
        const auto own = pointsOf(a, body), other = pointsOf(b, body + offset);
        ASSERT_EQ(own.size(), other.size()) << body;
        for (std::size_t i = 0; i < own.size(); ++i) EXPECT_NEAR((own[i] - other[i]).norm(), 0, within) << body;
        EXPECT_NEAR((a.bodies().bounds[body].min - b.bodies().bounds[body + offset].min).norm(), 0, within) << body;
        EXPECT_NEAR((a.bodies().bounds[body].max - b.bodies().bounds[body + offset].max).norm(), 0, within) << body;
    }
}

TEST(Outlines, AreThoseOfTheDefinitionInItsOrder)
{
    const std::vector<RigidBodyDef> defs = allKinds();
    const auto world = worldOf(defs, true);
    for (BodyHandle body = 0; body < defs.size(); ++body) {
        if (defs[body].shapes.size() != 1 || defs[body].shapes[0].kind != ShapeDef::Kind::Polygon) continue;
        const auto points = pointsOf(*world, body);
        ASSERT_EQ(points.size(), defs[body].shapes[0].points.size()) << body;
        for (std::size_t i = 0; i < points.size(); ++i)
            EXPECT_NEAR((points[i] - defs[body].shapes[0].points[i]).norm(), 0, 3e-6) << body;
    }
}

TEST(Outlines, AreTheSameWhetherBodiesHavePointsOrNot)
{
    const auto lean = worldOf(allKinds(), true), full = worldOf(allKinds(), false);
    expectSameOutlines(*lean, *full, 1, 3e-6);
}

TEST(Outlines, FollowBodiesThatAreMovedOrAddedBetweenLooks)
{
    auto world = worldOf(allKinds(), true, {0, 0});
    const std::vector<Vec2> before(world->bodies().points.begin(), world->bodies().points.end());
    world->setPosition(1, world->bodies().position[1] + Vec2(3, 4));
    const auto moved = pointsOf(*world, 1);
    for (std::size_t i = 0; i < moved.size(); ++i)
        EXPECT_NEAR((moved[i] - before[world->bodies().firstPoint[1] + i] - Vec2(3, 4)).norm(), 0, 1e-9);
    const BodyHandle added = world->addRigidBody(of(ShapeDef::Kind::Polygon, boxRing({500, 0}, 10, 10)));
    EXPECT_EQ(pointsOf(*world, added).size(), 4U);
    world->setVelocity(added, {60, 0});
    world->step(kStep);
    EXPECT_NEAR(world->bodies().bounds[added].max.x(), 506, 1e-6);
}

/// The soft body comes when the others have turned and rest on each other.
TEST(Outlines, AreMadeForASoftBodyThatComesLater)
{
    auto world = worldOf(allKinds(), true), twin = worldOf(allKinds(), true);
    run(*world, 3), run(*twin, 3);
    const BodyHandle ball = world->addSoftBody(softBall({300, -40}, 15));
    expectSameOutlines(*twin, *world, 0, 1e-9);
    world->setVelocity(7, {0, 0});
    bool touched = false;
    for (int i = 0; i < 180; ++i) world->step(kStep), touched |= world->touching(ball, 7);
    EXPECT_TRUE(touched);
    EXPECT_LT(world->bodies().position[ball].y(), world->bodies().position[7].y()) << "it lies on the lift";
}

TEST(Outlines, ContactsNameTheSamePointsAndWalls)
{
    auto world = worldOf(allKinds(), true);
    run(*world, 3);
    const std::vector<Contact> before(world->contacts().begin(), world->contacts().end());
    ASSERT_GT(before.size(), 8U);
    world->addSoftBody(softBall({1e5, 0}, 10));
    ASSERT_EQ(world->contacts().size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        const Contact& now = world->contacts()[i];
        EXPECT_EQ(now.bodyA, before[i].bodyA);
        EXPECT_EQ(now.bodyB, before[i].bodyB);
        EXPECT_EQ(now.particle, before[i].particle);
        EXPECT_EQ(now.wall, before[i].wall);
        EXPECT_NEAR((now.point - before[i].point).norm(), 0, 3e-6);
        EXPECT_NEAR(now.penetration, before[i].penetration, 3e-6);
    }
}

TEST(Outlines, FieldsOfForceActOnThemAlike)
{
    auto lean = worldOf(allKinds(), true, {0, 0}), full = worldOf(allKinds(), false, {0, 0});
    ForceFieldDef field;
    field.region = {boxRing({100, -48.5}, 1000, 100)};
    field.vector = {20, -10};
    lean->addForceField(field), full->addForceField(field);
    run(*lean, 0.5), run(*full, 0.5);
    for (BodyHandle body = 0; body < lean->bodyCount(); ++body) {
        EXPECT_NEAR((lean->bodies().position[body] - full->bodies().position[body + 1]).norm(), 0, 0.02) << body;
        EXPECT_NEAR(lean->bodies().angle[body], full->bodies().angle[body + 1], 5e-3) << body;
    }
    EXPECT_GT(std::abs(lean->bodies().angle[1]), 0.01) << "half in the field it turns";
}

TEST(Outlines, AStateFromBeforeTheSoftBodyDoesNotFitAndIsRefused)
{
    auto world = worldOf(allKinds(), true);
    run(*world, 0.5);
    const auto before = world->save();
    run(*world, 0.5);
    world->restore(before);
    EXPECT_EQ(world->save(), before);
    world->addSoftBody(softBall({300, -40}, 15));
    const auto hash = world->hash();
    EXPECT_ANY_THROW(world->restore(before));
    EXPECT_EQ(world->hash(), hash);
}

}  // namespace

}  // namespace jet::physics::test
