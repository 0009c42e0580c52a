// Bodies of simple shapes: circles, capsules, polygons, compounds; layers, groups, platforms, kinematic bodies;
// queries.
#include "scenes.hpp"

#include <jet/result.hpp>

namespace jet::physics::test {

namespace {

constexpr double kPi = 3.14159265358979323846;

RigidBodyDef shaped(ShapeDef shape, double mass = 1)
{
    RigidBodyDef def;
    def.shapes = {std::move(shape)};
    def.mass = mass;
    return def;
}
RigidBodyDef disc(const Vec2& centre, double radius, double mass = 1)
{
    return shaped({ShapeDef::Kind::Circle, {centre}, radius}, mass);
}

TEST(Shapes, MomentsOfInertiaAreExact)
{
    const auto inertiaOf = [](const RigidBodyDef& def) {
        auto world = makeWorld({0, 0});
        const BodyHandle body = world->addRigidBody(def);
        world->addTorque({{body, world->bodies().position[body]}, 100});
        world->step(kStep);
        return 100 * kStep / world->bodies().omega[body];
    };
    EXPECT_NEAR(inertiaOf(disc({30, 40}, 7, 3)), 3 * 49 / 2.0, 1e-9);
    // A capsule of length 2h between the centres: its box and its two half discs by Steiner's theorem.
    const double r = 2, h = 5, boxArea = 4 * h * r, discArea = kPi * r * r, off = 4 * r / (3 * kPi);
    const double second =
        boxArea * (4 * h * h + 4 * r * r) / 12 + discArea * (r * r / 2 - off * off + (h + off) * (h + off));
    EXPECT_NEAR(inertiaOf(shaped({ShapeDef::Kind::Capsule, {{-5, 3}, {5, 3}}, r}, 4)),
                4 * second / (boxArea + discArea), 1e-6);
}

TEST(Shapes, EveryShapeRestsOnTheGroundAtItsHeight)
{
    auto world = makeWorld({0, 300});
    world->addRigidBody(simple(ground(0)));
    world->addRigidBody(disc({0, -30}, 10));
    world->addRigidBody(shaped({ShapeDef::Kind::Capsule, {{90, -30}, {110, -30}}, 5}));
    world->addRigidBody(shaped({ShapeDef::Kind::Polygon, {{190, -20}, {210, -20}, {200, -40}}, 0}));
    RigidBodyDef dumbbell;
    dumbbell.shapes = {{ShapeDef::Kind::Circle, {{290, -30}}, 8}, {ShapeDef::Kind::Circle, {{310, -30}}, 8}};
    world->addRigidBody(dumbbell);
    run(*world, 4);
    EXPECT_NEAR(world->bodies().position[1].y(), -10, 0.1);
    EXPECT_NEAR(world->bodies().position[2].y(), -5, 0.1);
    EXPECT_NEAR(world->bodies().position[3].y(), -20 / 3.0, 0.1);
    EXPECT_NEAR(world->bodies().position[4].y(), -8, 0.1);
    for (BodyHandle body = 1; body <= 4; ++body) EXPECT_LT(world->bodies().velocity[body].norm(), 0.1) << body;
}

TEST(Shapes, ARollingDiscDoesNotSlow)
{
    auto world = makeWorld({0, 300}, 0.9);
    world->addRigidBody(simple(ground(0, 20000)));
    RigidBodyDef def = disc({0, -10}, 10);
    def.common.velocity = {50, 0};
    def.common.omega = 5;
    world->addRigidBody(def);
    run(*world, 4);
    EXPECT_NEAR(world->bodies().velocity[1].x(), 50, 0.5);
    EXPECT_NEAR(world->bodies().position[1].x(), 200, 2);
}

TEST(Shapes, LayersAndGroupsDecideWhoMeets)
{
    auto world = makeWorld({0, 300});
    RigidBodyDef floor = simple(ground(0));
    floor.common.layer = 2;
    world->addRigidBody(floor);
    RigidBodyDef through = disc({0, -30}, 10), stays = disc({50, -30}, 10);
    through.common.mask = ~2U;
    world->addRigidBody(through);
    world->addRigidBody(stays);
    RigidBodyDef first = disc({100, -12}, 10), second = disc({104, -12}, 10);
    first.common.group = second.common.group = 7;
    world->addRigidBody(first);
    world->addRigidBody(second);
    run(*world, 2);
    EXPECT_GT(world->bodies().position[1].y(), 200);
    EXPECT_NEAR(world->bodies().position[2].y(), -10, 0.2);
    EXPECT_NEAR(world->bodies().position[4].x() - world->bodies().position[3].x(), 4, 0.1) << "of one group";
}

TEST(Shapes, APlatformHoldsFromAboveAndLetsPassFromBelow)
{
    auto world = makeWorld({0, 300}, 0.3);
    RigidBodyDef platform = simple(fixed({boxRing({0, 0}, 200, 10)}));
    platform.common.oneSided = {0, -1};
    world->addRigidBody(platform);
    world->addRigidBody(disc({-50, -40}, 8));
    RigidBodyDef jumper = disc({50, 60}, 8);
    jumper.common.velocity = {0, -280};
    world->addRigidBody(jumper);
    double highest = 100;
    for (int i = 0; i < 300; ++i) {
        world->step(kStep);
        highest = std::min(highest, world->bodies().position[2].y());
    }
    EXPECT_NEAR(world->bodies().position[1].y(), -13, 0.2);
    EXPECT_LT(highest, -30) << "nothing stopped it on the way up";
    EXPECT_NEAR(world->bodies().position[2].y(), -13, 0.2) << "it came down on the platform";
}

TEST(Shapes, AKinematicBodyPushesAndIsNotPushed)
{
    auto world = makeWorld({0, 0}, 0);
    RigidBodyDef pusher = simple(box({0, 0}, 20, 20));
    pusher.common.kinematic = true;
    pusher.common.velocity = {30, 0};
    world->addRigidBody(pusher);
    world->addRigidBody(simple(box({30, 0}, 10, 10, 1000)));
    run(*world, 2);
    EXPECT_NEAR(world->bodies().position[0].x(), 60, 1e-9);
    EXPECT_NEAR(world->bodies().velocity[1].x(), 30, 0.5);
}

TEST(Shapes, EventsTellWhenATouchBeginsAndEnds)
{
    auto world = makeWorld({0, 300}, 0.3, 0.8);
    world->addRigidBody(simple(ground(0)));
    world->addRigidBody(disc({0, -40}, 10));
    int begins = 0, ends = 0;
    for (int i = 0; i < 60; ++i) {
        world->step(kStep);
        for (const ContactEvent& event : world->contactEvents()) {
            EXPECT_EQ(event.bodyA, 0u);
            EXPECT_EQ(event.bodyB, 1u);
            (event.begins ? begins : ends) += 1;
            if (event.begins) {
                EXPECT_GT(event.impulse, 0);
            }
        }
    }
    EXPECT_GE(begins, 1);
    EXPECT_NEAR(begins, ends, 1);
}

TEST(Shapes, ContactsTellAllThatTheyGaveInAStep)
{
    // Without friction m (v - v before - g dt) is the sum of impulses along normals: in hits, bounces and at rest.
    const double g = 300, masses[] = {1, 3, 0.5};
    for (const double restitution : {0.0, 0.8}) {
        auto world = makeWorld({0, g}, 0, restitution);
        world->addRigidBody(simple(ground(0)));
        world->addRigidBody(disc({0, -40}, 10, masses[0]));
        world->addRigidBody(simple(box({3, -90}, 20, 20, masses[1], 0.3)));
        world->addRigidBody(disc({-2, -130}, 8, masses[2]));
        int hits = 0;
        for (int i = 0; i < 180; ++i) {
            const auto speeds = world->bodies().velocity;
            std::vector<Vec2> given(4, Vec2(0, 0)), before(speeds.begin(), speeds.end());
            world->step(kStep);
            for (const Contact& c : world->contacts())
                given[c.bodyA] += c.impulse * c.normal, given[c.bodyB] -= c.impulse * c.normal;
            for (BodyHandle body = 1; body < 4; ++body) {
                const Vec2 change = world->bodies().velocity[body] - before[body] - Vec2(0, g * kStep);
                EXPECT_NEAR((masses[body - 1] * change - given[body]).norm(), 0, 1e-5 * (1 + given[body].norm()))
                    << "body " << body << ", step " << i;
                hits += given[body].norm() > 10 * masses[body - 1] * g * kStep;
            }
            for (const ContactEvent& event : world->contactEvents()) {
                if (!event.begins) continue;
                double sum = 0;
                for (const Contact& c : world->contacts())
                    if (std::minmax(c.bodyA, c.bodyB) == std::minmax(event.bodyA, event.bodyB)) sum += c.impulse;
                EXPECT_NEAR(event.impulse, sum, 1e-6 * (1 + sum));
            }
        }
        EXPECT_GT(hits, 2);
    }
}

TEST(Shapes, MomentumIsKeptToTheLastBits)
{
    auto world = makeWorld({0, 0}, 0.4, 0.6);
    Vec2 before(0, 0);
    for (int i = 0; i < 20; ++i) {
        RigidBodyDef def = i % 2 ? simple(box({30.0 * (i % 5), 30.0 * (i / 5)}, 12, 18, 1 + i, 0.4 * i))
                                 : disc({30.0 * (i % 5), 30.0 * (i / 5)}, 9, 1 + i);
        def.common.velocity = {60 * std::cos(2.1 * i), 60 * std::sin(1.3 * i)};
        before += def.mass * def.common.velocity;
        world->addRigidBody(def);
    }
    run(*world, 5);
    Vec2 after(0, 0);
    for (int i = 0; i < 20; ++i) after += (1.0 + i) * world->bodies().velocity[i];
    EXPECT_NEAR((after - before).norm(), 0, 1e-12 * 20 * 20 * 60);
}

TEST(Shapes, InstructionSetsGiveTheSameBits)
{
    for (const Precision precision : {Precision::Double, Precision::Single}) {
        std::uint64_t hashes[2];
        for (const Simd simd : {Simd::Sse2, Simd::Avx2}) {
            WorldSettings settings;
            settings.gravity = {0, 300};
            settings.simd = simd;
            settings.precision = precision;
            auto world = JetPhysics().createWorld(settings);
            world->addRigidBody(simple(ground(0)));
            for (int i = 0; i < 60; ++i)
                world->addRigidBody(i % 3
                                        ? simple(box({-60.0 + 15 * (i % 9), -20.0 - 15 * (i / 9)}, 12, 10, 1, 0.3 * i))
                                        : disc({-60.0 + 15 * (i % 9), -20.0 - 15 * (i / 9)}, 6));
            run(*world, 3);
            hashes[simd == Simd::Avx2] = world->hash();
        }
        EXPECT_EQ(hashes[0], hashes[1]);
    }
}

TEST(Shapes, ARayFindsTheFirstBodyInItsWay)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(simple(box({50, 0}, 20, 20)));
    world->addRigidBody(simple(box({100, 0}, 20, 20)));
    const auto hit = world->rayCast({0, 0}, {200, 0});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->body, 0u);
    EXPECT_NEAR((hit->point - Vec2(40, 0)).norm(), 0, 1e-9);
    EXPECT_NEAR((hit->normal - Vec2(-1, 0)).norm(), 0, 1e-9);
    EXPECT_NEAR(hit->fraction, 0.2, 1e-12);
    QueryFilter filter;
    filter.except = 0;
    EXPECT_EQ(world->rayCast({0, 0}, {200, 0}, filter)->body, 1u);
    EXPECT_FALSE(world->rayCast({0, 50}, {200, 50}));
    EXPECT_EQ(world->overlapping(Box({55, -5}, {95, 5})), (std::vector<BodyHandle>{0, 1}));
    EXPECT_EQ(world->overlapping(Box({45, -1}, {55, 1})), (std::vector<BodyHandle>{0})) << "wholly inside";
    const auto near = world->nearest({30, 0}, 50);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->body, 0u);
    EXPECT_NEAR(near->fraction, 0.2, 1e-12);
}

TEST(Shapes, ImpossibleShapesAreRefused)
{
    auto world = makeWorld({0, 0});
    EXPECT_THROW(world->addRigidBody(disc({0, 0}, -1)), Failure);
    EXPECT_THROW(world->addRigidBody(shaped({ShapeDef::Kind::Polygon, {{0, 0}, {1, 0}}, 0})), Failure);
    EXPECT_THROW(world->addRigidBody(shaped({ShapeDef::Kind::Capsule, {{0, 0}}, 1})), Failure);
    EXPECT_EQ(world->bodyCount(), 0u);
}

}  // namespace

}  // namespace jet::physics::test
