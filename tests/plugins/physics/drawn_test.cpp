// Rigid bodies drawn as borders, and ground of chains: they meet as convex parts and walls without seams.
#include "scenes.hpp"

#include <jet/result.hpp>

#include <random>

namespace jet::physics::test {

namespace {

RigidBodyDef chain(std::vector<Vec2> line)
{
    RigidBodyDef def;
    def.common.fixed = true;
    def.shapes = {{ShapeDef::Kind::Chain, std::move(line), 0}};
    return def;
}

/// Ground of many segments from x = 0 on, as a chain or as the upper side of a closed border; `y` gives its height.
template <class Height>
RigidBodyDef drawnGround(bool open, int segments, double length, Height&& y)
{
    std::vector<Vec2> line;
    for (int i = 0; i <= segments; ++i) line.push_back({i * length, y(i * length)});
    if (open) return chain(line);
    line.push_back({segments * length, 200});
    line.push_back({0, 200});
    return fixed({line});
}

RigidBodyDef disc(const Vec2& centre, double radius)
{
    RigidBodyDef def;
    def.shapes = {{ShapeDef::Kind::Circle, {centre}, radius}};
    return def;
}

/// An L of two boxes with its hollow corner at (10, 10).
std::vector<Vec2> ell(const Vec2& at, double scale = 1)
{
    std::vector<Vec2> ring{{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 30}, {0, 30}};
    for (Vec2& p : ring) p = at + scale * p;
    return ring;
}

std::vector<Vec2> starRing(const Vec2& at, double inner, double outer, int tips)
{
    std::vector<Vec2> ring = circleRing({0, 0}, 1, 2 * tips);
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = at + (i % 2 ? inner : outer) * ring[i];
    return ring;
}

// The box around a slope holds much that the slope itself is far from: what comes down there meets it in time.
TEST(Ground, WhatSinksTowardsASlopeFromInsideItsBoxIsHeld)
{
    for (const bool open : {true, false}) {
        auto world = makeWorld({0, 40}, 0);
        world->addRigidBody(drawnGround(open, 10, 40, [](double x) { return std::fmod(x, 80) < 1 ? 0.0 : 16.0; }));
        std::vector<BodyHandle> balls;
        for (int valley = 0; valley < 5; ++valley) {
            RigidBodyDef ball = disc({80.0 * valley + 35, 2}, 5);
            ball.common.allowSleep = false;
            balls.push_back(world->addRigidBody(ball));
        }
        for (int i = 0; i < 240; ++i) {
            world->step(kStep);
            for (const BodyHandle ball : balls) {
                const Vec2 at = world->bodies().position[ball];
                const double aside = std::abs(std::fmod(at.x(), 80) - 40);
                ASSERT_GT((16 - 0.4 * aside - at.y()) / std::hypot(0.4, 1), 4.8) << "open " << open << ", step " << i;
            }
        }
    }
}

TEST(Ground, ABoxAndABallGlideOverAThousandSegmentsWithoutABump)
{
    for (const bool open : {true, false}) {
        for (const int kind : {0, 1, 2}) {
            auto world = makeWorld({0, 400}, 0);
            RigidBodyDef body = kind == 0   ? simple(box({40, -10.02}, 20, 20))
                                : kind == 1 ? disc({40, -10.02}, 10)
                                            : rigid({ell({25, -0.02}, -1)});
            body.common.velocity = {300, 0};
            const BodyHandle moving = world->addRigidBody(body);
            world->addRigidBody(drawnGround(open, 1000, 2, [](double) { return 0.0; }));
            run(*world, 0.2);
            const double start = world->bodies().position[moving].y();
            double up = 0, bump = 0;
            for (int i = 0; i < 300; ++i) {
                world->step(kStep);
                up = std::max(up, std::abs(world->bodies().velocity[moving].y()));
                bump = std::max(bump, std::abs(world->bodies().position[moving].y() - start));
            }
            EXPECT_NEAR(world->bodies().velocity[moving].x(), 300, 0.01) << open << kind;
            EXPECT_LT(up, 0.5) << open << kind;
            EXPECT_LT(bump, 0.05) << open << kind;
            EXPECT_NEAR(world->bodies().angle[moving], 0, 0.005) << open << kind;
        }
    }
}

TEST(Ground, OverBentGroundSpeedIsKept)
{
    // A wave of slight bends, frictionless: height and speed follow from each other.
    for (const bool open : {true, false}) {
        for (const bool round : {true, false}) {
            const double g = 200;
            auto world = makeWorld({0, g}, 0);
            const auto height = [](double x) { return 12 * std::sin(x / 120); };
            RigidBodyDef body =
                round ? disc({60, height(60) - 6.5}, 6) : simple(box({60, height(60) - 6.5}, 12, 12, 1, 0.09));
            body.common.velocity = {180, 16};
            const BodyHandle moving = world->addRigidBody(body);
            world->addRigidBody(drawnGround(open, 1000, 1.5, height));
            run(*world, 0.5);
            const auto energy = [&] {
                const BodyStates s = world->bodies();
                const double inertia = round ? 18 : 24;
                return 0.5 * s.velocity[moving].squaredNorm() + 0.5 * inertia * s.omega[moving] * s.omega[moving] -
                       g * s.position[moving].y();
            };
            const double before = energy();
            run(*world, 5);
            EXPECT_NEAR(energy(), before, 0.02 * 0.5 * 180 * 180) << open << round;
            EXPECT_GT(world->bodies().position[moving].x(), 700) << open << round;
            EXPECT_LT(std::abs(world->bodies().position[moving].y() - height(world->bodies().position[moving].x()) + 6),
                      1.5)
                << open << round;
        }
    }
}

TEST(Ground, NothingPassesAChainFromItsFrontAndEverythingFromBehind)
{
    for (int i = 0; i < 40; ++i) {
        const double speed = 50.0 * (i + 1) * (i + 1);  // up to 80,000 units / s
        for (const bool below : {false, true}) {
            auto world = makeWorld({0, 0}, 0.3);
            RigidBodyDef ball = i % 2 ? disc({500.3 + i, below ? 100.0 : -100.0}, 2)
                                      : simple(box({500.3 + i, below ? 100.0 : -100.0}, 4, 4, 1, 0.2 * i));
            ball.common.velocity = {0.1 * speed, below ? -speed : speed};
            world->addRigidBody(ball);
            world->addRigidBody(drawnGround(true, 500, 10, [](double x) { return 3 * std::sin(x / 40); }));
            run(*world, std::max(0.2, 300 / speed));
            EXPECT_LT(world->bodies().position[0].y(), 6) << speed << (below ? " from below" : " from above");
        }
    }
}

TEST(Ground, ThingsComeToRestInAValleyAndOnAHill)
{
    for (const bool open : {true, false}) {
        auto world = makeWorld({0, 300}, 0.8);
        // A V and a plateau; the deepest point is at x = 100.
        std::vector<Vec2> line{{0, 0}, {100, 60}, {200, 0}, {300, 0}, {400, 80}};
        if (!open) line.push_back({400, 300}), line.push_back({0, 300});
        world->addRigidBody(open ? chain(line) : fixed({line}));
        const BodyHandle low = world->addRigidBody(disc({110, 20}, 10)),
                         high = world->addRigidBody(simple(box({250, -30}, 20, 20)));
        const BodyHandle star = world->addRigidBody(rigid({starRing({220, -60}, 6, 12, 5)}));
        run(*world, 8);
        EXPECT_NEAR(world->bodies().position[low].x(), 100, 0.6);
        EXPECT_NEAR(world->bodies().position[low].y(), 60 - 10 * std::sqrt(1 + 0.36), 0.3);
        EXPECT_NEAR(world->bodies().position[high].y(), -10, 0.15);
        EXPECT_LT(world->bodies().velocity[star].norm(), 0.5);
        EXPECT_LT(world->bodies().position[star].y(), 0);
    }
}

TEST(Ground, SoftBodiesStayOnAChain)
{
    auto world = makeWorld({0, 200}, 0.4);
    world->addRigidBody(drawnGround(true, 100, 12, [](double x) { return 20 * std::cos(x / 190); }));
    const BodyHandle ball = world->addSoftBody(softBall({400, -60}, 25, 400, 2));
    run(*world, 5);
    EXPECT_TRUE(allFinite(*world));
    EXPECT_LT(world->bodies().bounds[ball].max.y(), 25);
    EXPECT_TRUE(world->touching(0, ball));
}

TEST(Ground, OnlyFixedBodiesMayBeChains)
{
    auto world = makeWorld({0, 0});
    RigidBodyDef moving = chain({{0, 0}, {10, 0}});
    moving.common.fixed = false;
    EXPECT_THROW(world->addRigidBody(moving), Failure);
    EXPECT_THROW(world->addRigidBody(chain({{0, 0}})), Failure);
    EXPECT_EQ(world->bodyCount(), 0u);
}

TEST(Drawn, AConcaveBodyHoldsWhatLiesInItsHollow)
{
    // A cup of one outline, moving, with a ball in it, on the ground.
    auto world = makeWorld({0, 300}, 0.6);
    world->addRigidBody(simple(test::ground(0)));
    const std::vector<Vec2> cup{{-30, -40}, {-24, -40}, {-24, -6}, {24, -6}, {24, -40}, {30, -40}, {30, 0}, {-30, 0}};
    const BodyHandle outer = world->addRigidBody(rigid({cup}, 5));
    const BodyHandle ball = world->addRigidBody(disc({5, -30}, 8));
    run(*world, 4);
    EXPECT_NEAR(world->bodies().angle[outer], 0, 0.01);
    EXPECT_NEAR(world->bodies().position[ball].y(), -6 - 8, 0.2);
    world->setVelocity(outer, {200, 0});
    run(*world, 2);
    EXPECT_LT(std::abs(world->bodies().position[ball].x() - world->bodies().position[outer].x()), 17)
        << "it goes along";
}

TEST(Drawn, ABodyGlidesOverTheSeamsOfAnother)
{
    // A plank with a notched underside is taken apart in many places; its top is one line.
    std::vector<Vec2> plank{{-300, 0}};
    for (int i = -30; i <= 30; ++i) plank.push_back({10.0 * i, i % 2 ? 20.0 : 12.0});
    plank.push_back({300, 0});
    plank.push_back({17, 0});
    std::reverse(plank.begin(), plank.end());
    RigidBodyDef def = rigid({plank}, 1000);
    def.common.kinematic = true;
    auto world = makeWorld({0, 300}, 0);
    world->addRigidBody(def);
    for (const double size : {6.0, 14.0}) {
        RigidBodyDef slider = simple(box({-280 + size, -size / 2}, size, size));
        slider.common.velocity = {150, 0};
        slider.common.group = 7;
        world->addRigidBody(slider);
    }
    double most = 0;
    for (int i = 0; i < 180; ++i) {
        world->step(kStep);
        for (BodyHandle b : {1u, 2u}) most = std::max(most, std::abs(world->bodies().omega[b]));
    }
    for (BodyHandle b : {1u, 2u}) EXPECT_NEAR(world->bodies().velocity[b].x(), 150, 0.05);
    EXPECT_LT(most, 0.05);
}

TEST(Drawn, MomentumIsKeptWhenStarsCollide)
{
    auto world = makeWorld({0, 0}, 0.4, 0.5);
    Vec2 before(0, 0);
    for (int i = 0; i < 12; ++i) {
        RigidBodyDef star = rigid({starRing({40.0 * (i % 4), 40.0 * (i / 4)}, 8, 18, 5 + i % 3)}, 1 + i % 3);
        star.common.velocity = Vec2(60 - 40.0 * (i % 4), 50 - 50.0 * (i / 4));
        star.common.omega = i - 6;
        before += star.mass * star.common.velocity;
        world->addRigidBody(star);
    }
    run(*world, 3);
    Vec2 after(0, 0);
    for (BodyHandle i = 0; i < 12; ++i) after += (1.0 + i % 3) * world->bodies().velocity[i];
    EXPECT_NEAR((after - before).norm(), 0, 1e-9);
    EXPECT_TRUE(allFinite(*world));
}

TEST(Drawn, APileOfConcaveBodiesComesToRest)
{
    auto world = makeWorld({0, 300}, 0.6);
    world->addRigidBody(
        fixed({{{-120, -200}, {-100, -200}, {-100, 0}, {100, 0}, {100, -200}, {120, -200}, {120, 20}, {-120, 20}}}));
    for (int i = 0; i < 30; ++i) {
        const Vec2 at(-80.0 + 40 * (i % 5), -30.0 - 36 * (i / 5));
        world->addRigidBody(rigid({i % 2 ? ell(at, 0.8) : starRing(at + Vec2(10, 10), 7, 14, 5)}));
    }
    run(*world, 10);
    double deepest = 0;
    for (const Contact& c : world->contacts()) deepest = std::max(deepest, c.penetration);
    EXPECT_LT(deepest, 0.5);
    for (BodyHandle i = 1; i <= 30; ++i) {
        EXPECT_LT(world->bodies().position[i].y(), 0) << i;
        EXPECT_LT(std::abs(world->bodies().position[i].x()), 100) << i;
        EXPECT_LT(world->bodies().velocity[i].norm(), 3) << i;
    }
}

TEST(Drawn, JointsHoldDrawnBodies)
{
    auto world = makeWorld({0, 200});
    const BodyHandle lever = world->addRigidBody(rigid({ell({0, 0})}));
    JointDef pin;
    pin.kind = JointDef::Kind::Revolute;
    pin.a.point = pin.b.point = {0, 0};
    pin.b.body = lever;
    const JointHandle hinge = world->addJoint(pin);
    run(*world, 5);
    EXPECT_EQ(world->jointCount(), 1u);
    EXPECT_NEAR(world->bodies().position[lever].norm(), Vec2(11, 11).norm(), 0.2)
        << "the centre of mass keeps its distance";
    EXPECT_FALSE(world->joint(hinge).broken);
}

TEST(Drawn, ASensorIsFeltInItsWholeInside)
{
    auto world = makeWorld({0, 0});
    RigidBodyDef region = fixed({ell({0, 0}, 10)});
    region.common.sensor = true;
    world->addRigidBody(region);
    const BodyHandle inside = world->addRigidBody(disc({50, 50}, 3)), hollow = world->addRigidBody(disc({200, 200}, 3));
    run(*world, 0.1);
    EXPECT_TRUE(world->touching(0, inside));
    EXPECT_FALSE(world->touching(0, hollow));
}

TEST(Drawn, APlatformHoldsFromAboveAndLetsPassFromBelow)
{
    auto world = makeWorld({0, 300});
    RigidBodyDef platform = fixed({{{-60, 0}, {0, 2}, {60, 0}, {60, 12}, {-60, 12}}});
    platform.common.oneSided = {0, -1};
    world->addRigidBody(platform);
    RigidBodyDef jumper = simple(box({-20, 60}, 10, 10));
    jumper.common.velocity = {0, -260};
    const BodyHandle up = world->addRigidBody(jumper), down = world->addRigidBody(simple(box({30, -60}, 10, 10)));
    double highest = 100;
    for (int i = 0; i < 300; ++i) {
        world->step(kStep);
        highest = std::min(highest, world->bodies().position[up].y());
    }
    EXPECT_LT(highest, -30) << "it came through";
    EXPECT_LT(world->bodies().position[up].y(), 0) << "and stands on it";
    EXPECT_LT(world->bodies().position[down].y(), 0);
}

TEST(Drawn, LayersAndKinematicBodiesWorkForDrawnOnes)
{
    auto world = makeWorld({0, 0}, 0.9);
    RigidBodyDef pusher = rigid({ell({-60, -15})});
    pusher.common.kinematic = true;
    pusher.common.velocity = {40, 0};
    world->addRigidBody(pusher);
    const BodyHandle pushed = world->addRigidBody(rigid({starRing({0, 0}, 5, 10, 5)}));
    RigidBodyDef ghost = rigid({starRing({60, 0}, 5, 10, 5)});
    ghost.common.layer = 2, ghost.common.mask = 2;
    const BodyHandle passed = world->addRigidBody(ghost);
    run(*world, 3);
    EXPECT_NEAR(world->bodies().position[0].x(), -60 + 11 + 120, 0.5) << "nothing slows it";
    EXPECT_GT(world->bodies().position[pushed].x(), 40);
    EXPECT_NEAR(world->bodies().position[passed].x(), 60, 1e-9);
}

}  // namespace

}  // namespace jet::physics::test
