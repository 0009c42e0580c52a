// Queries against marching by distance, which knows no tree, no edges and no formulas of theirs.
#include "lattices.hpp"

#include <jet/result.hpp>

#include <random>

namespace jet::physics::test {

namespace {

constexpr double kPi = 3.14159265358979323846;

double toSegment(const Vec2& p, const Vec2& a, const Vec2& b)
{
    const Vec2 edge = b - a;
    const double squared = edge.squaredNorm();
    const double t = squared > 0 ? std::clamp((p - a).dot(edge) / squared, 0.0, 1.0) : 0;
    return (p - (a + t * edge)).norm();
}

bool insideRing(const std::vector<Vec2>& ring, const Vec2& p)
{
    double turned = 0;  // by the angle the ring goes round the point
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i] - p, b = ring[(i + 1) % ring.size()] - p;
        turned += std::atan2(jet::cross(a, b), a.dot(b));
    }
    return std::abs(turned) > kPi;
}

bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) { return jet::cross(q - p, r - p) > 0; };
    return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

/// A body of the random world as it stands now: a ring, or a segment rounded by a radius.
struct Thing {
    std::vector<Vec2> points;
    double radius = 0;

    /// Below 0 inside.
    double distance(const Vec2& p) const
    {
        if (radius > 0) return toSegment(p, points.front(), points.back()) - radius;
        double least = 1e300;
        for (std::size_t i = 0; i < points.size(); ++i)
            least = std::min(least, toSegment(p, points[i], points[(i + 1) % points.size()]));
        return insideRing(points, p) ? -least : least;
    }
    double distance(const Thing& other) const
    {
        double least = 1e300;
        const auto corners = [&](const Thing& a, const Thing& b) {
            for (const Vec2& p : a.points) least = std::min(least, b.distance(p) - a.radius);
        };
        corners(*this, other), corners(other, *this);
        for (std::size_t i = 0; i < points.size() && radius == 0; ++i)
            for (std::size_t k = 0; k < other.points.size() && other.radius == 0; ++k)
                if (cross(points[i], points[(i + 1) % points.size()], other.points[k],
                          other.points[(k + 1) % other.points.size()]))
                    return -1;
        return least;
    }
};

struct RandomWorld {
    explicit RandomWorld(unsigned seed, int bodies = 120) : random(seed)
    {
        WorldSettings settings;
        settings.gravity = {0, 0};
        settings.findCollisions = false;
        world = JetPhysics().createWorld(settings);
        for (int i = 0; i < bodies; ++i) add(i);
        for (int i = 0; i < 20; ++i) world->step(kStep);
        for (int i = 0; i < bodies; ++i) things.push_back(now(static_cast<BodyHandle>(i)));
    }

    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }
    Vec2 place(double reach = 500) { return {number(-reach, reach), number(-reach, reach)}; }

    void add(int i)
    {
        const Vec2 at = place();
        Thing local;
        RigidBodyDef def;
        switch (i % 5) {
        case 0:
            local.points = {at}, local.radius = number(3, 25);
            def.shapes = {{ShapeDef::Kind::Circle, local.points, local.radius}};
            break;
        case 1:
            local.points = {at, at + place(30)}, local.radius = number(2, 12);
            def.shapes = {{ShapeDef::Kind::Capsule, local.points, local.radius}};
            break;
        case 2:
            local.points = boxRing(at, number(5, 50), number(5, 50), number(0, 6));
            def.shapes = {{ShapeDef::Kind::Polygon, local.points, 0}};
            break;
        case 3:
            local.points = circleRing({0, 0}, 1, 7 + i % 60);
            for (Vec2& p : local.points) p = at + number(10, 30) * p;
            def.borders = {local.points};
            break;
        default: {
            SoftBodyDef soft = softBall(at, number(10, 30), 200, 1, 12, 2);
            soft.common.velocity = place(40);
            world->addSoftBody(soft);
            locals.push_back({});
            return;
        }
        }
        def.common.velocity = place(60);
        def.common.omega = number(-3, 3);
        const BodyHandle body = world->addRigidBody(def);
        const Vec2 centre = world->bodies().position[body];
        for (Vec2& p : local.points) p -= centre;
        locals.push_back(local);
    }

    Thing now(BodyHandle body) const
    {
        const BodyStates states = world->bodies();
        Thing thing = locals[body];
        if (thing.radius == 0) {
            const auto points = pointsOf(*world, body);
            // Soft balls: the outer ring is the last.
            thing.points.assign(body % 5 == 4 ? points.end() - 12 : points.begin(), points.end());
            return thing;
        }
        for (Vec2& p : thing.points)
            p = states.position[body] + Vec2(Affine::rotation(states.angle[body]).linear() * p);
        return thing;
    }

    std::unique_ptr<PhysicsWorld> world;
    std::vector<Thing> locals, things;
    std::mt19937 random;
};

/// Marches on by the distance until it is gone; above 1: not on the way.
template <class Distance>
double march(const Vec2& way, Distance&& distance)
{
    const double length = way.norm();
    double t = 0;
    for (int i = 0; i < 100000; ++i) {
        const double d = distance(t);
        if (d < 1e-9 * length) return t;
        t += d / length;
        if (t > 1) return 2;
    }
    return t;
}

TEST(Queries, RaysMeetWhatMarchingMeets)
{
    int hits = 0;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        RandomWorld scene(seed);
        for (int trial = 0; trial < 500; ++trial) {
            const Vec2 from = scene.place(), to = scene.place();
            double first = 2;
            for (const Thing& thing : scene.things) {
                // From within, rays pass.
                if (thing.distance(from) < 0) continue;
                first =
                    std::min(first, march(to - from, [&](double t) { return thing.distance(from + t * (to - from)); }));
            }
            const auto hit = scene.world->rayCast(from, to);
            bool grazes = false;
            const double reached = hit ? hit->fraction : 1;
            for (const Thing& thing : scene.things)
                grazes |= thing.distance(from) > -1e-6 && thing.distance(from) < 1e-6;
            if (grazes) continue;
            // Re-entering a body it started in is a hit the march has left out.
            if (hit && scene.things[hit->body].distance(from) < 0) continue;
            ASSERT_NEAR(reached, std::min(first, 1.0), 1e-5) << seed << " " << trial;
            if (!hit) continue;
            ++hits;
            EXPECT_NEAR((hit->point - (from + hit->fraction * (to - from))).norm(), 0, 1e-9);
            EXPECT_NEAR(hit->normal.norm(), 1, 1e-9);
            EXPECT_LE(hit->normal.dot(to - from), 1e-9);
            EXPECT_NEAR(scene.things[hit->body].distance(hit->point), 0, 1e-6);
        }
    }
    EXPECT_GT(hits, 1000);
}

TEST(Queries, CastShapesStopWhereMarchingStops)
{
    int hits = 0;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        RandomWorld scene(seed);
        for (int trial = 0; trial < 250; ++trial) {
            const Vec2 at = scene.place(), way = scene.place(300);
            Thing moving;
            ShapeDef shape;
            if (trial % 3 == 0) {
                moving.points = {at}, moving.radius = scene.number(1, 20);
                shape = {ShapeDef::Kind::Circle, moving.points, moving.radius};
            } else if (trial % 3 == 1) {
                moving.points = {at, at + scene.place(20)}, moving.radius = scene.number(1, 10);
                shape = {ShapeDef::Kind::Capsule, moving.points, moving.radius};
            } else {
                moving.points = boxRing(at, scene.number(4, 40), scene.number(4, 40), scene.number(0, 6));
                shape = {ShapeDef::Kind::Polygon, moving.points, 0};
            }
            double first = 2;
            for (const Thing& thing : scene.things) {
                if (thing.points.empty()) continue;
                const auto distance = [&](double t) {
                    Thing there = moving;
                    for (Vec2& p : there.points) p += t * way;
                    double least = there.distance(thing);
                    // Axes that pass through without an end inside.
                    for (double s = 0; s <= 1; s += 1.0 / 64) {
                        const auto on = [s](const Thing& of) {
                            return of.points[0] + s * (of.points.back() - of.points[0]);
                        };
                        if (thing.radius > 0) least = std::min(least, there.distance(on(thing)) - thing.radius);
                        if (there.radius > 0) least = std::min(least, thing.distance(on(there)) - there.radius);
                    }
                    return least;
                };
                first = std::min(first, march(way, distance));
            }
            const auto hit = scene.world->shapeCast(shape, way);
            ASSERT_NEAR(hit ? hit->fraction : 1, std::min(first, 1.0), 1e-5) << seed << " " << trial;
            hits += hit && hit->fraction > 0;
        }
    }
    EXPECT_GT(hits, 300);
}

TEST(Queries, WhatIsRoundAndLeavesWhatItTouchesHitsNothing)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(box({0, 0}, 20, 20));
    world->addRigidBody(simple(box({50, 0}, 20, 20)));
    world->addSoftBody(square({100, 0}, 20));
    for (const double x : {0.0, 50.0, 100.0}) {
        const ShapeDef ball{ShapeDef::Kind::Circle, {{x, -11}}, 1},
            capsule{ShapeDef::Kind::Capsule, {{x - 3, -11}, {x + 3, -11}}, 1};
        EXPECT_FALSE(world->shapeCast(ball, {0, -20})) << x;
        EXPECT_FALSE(world->shapeCast(capsule, {0, -20})) << x;
        EXPECT_FALSE(world->rayCast({x, -10}, {x, -30})) << x;
    }
}

TEST(Queries, AnOverlapHasAUnitNormalEvenWithoutAWay)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(box({0, 0}, 20, 20));
    for (const Vec2& at : {Vec2(0, 0), Vec2(3, 4)}) {
        const auto hit = world->shapeCast({ShapeDef::Kind::Circle, {at}, 1}, {0, 0});
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->normal.norm(), 1, 1e-12);
        EXPECT_GE(hit->normal.dot(at), 0) << "out of the body";
    }
}

TEST(Queries, NearestPointsAndOverlapsAreThoseOfAllBodies)
{
    for (unsigned seed = 1; seed <= 5; ++seed) {
        RandomWorld scene(seed);
        for (int trial = 0; trial < 1500; ++trial) {
            const Vec2 at = scene.place();
            const double reach = scene.number(1, 200);
            double least = 1e300;
            for (const Thing& thing : scene.things) least = std::min(least, std::abs(thing.distance(at)));
            const auto near = scene.world->nearest(at, reach);
            ASSERT_EQ(static_cast<bool>(near), least <= reach) << seed << " " << trial;
            if (near) {
                // Bodies of one shape are as exact as parts are: to 10^-7 of their size, which is up to 40 here.
                EXPECT_NEAR(near->fraction * reach, least, 4e-6);
                EXPECT_NEAR((near->point - at).norm(), least, 4e-6);
            }
            if (trial % 3 != 0) continue;
            const Box box(at, at + scene.place(60));
            std::vector<BodyHandle> expected;
            Thing square;
            square.points = {box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}};
            bool close = false;
            for (BodyHandle body = 0; body < scene.things.size(); ++body) {
                const Thing& thing = scene.things[body];
                if (thing.distance(box.center()) > 0.5 * box.size().norm() + 0.5) continue;
                double least2 = std::min(thing.distance(square), thing.distance(box.center()));
                // Sides that cross without a corner inside.
                for (std::size_t i = 0; i < thing.points.size(); ++i) {
                    const Vec2 a = thing.points[i], b = thing.points[(i + 1) % thing.points.size()];
                    for (double t = 0; t <= 1; t += 1.0 / 256) {
                        const Vec2 p = a + t * (b - a);
                        least2 = std::min(least2, square.distance(p) - thing.radius);
                    }
                }
                close |= std::abs(least2) < 0.4;
                if (least2 <= 0) expected.push_back(body);
            }
            if (close) continue;
            EXPECT_EQ(scene.world->overlapping(box), expected) << seed << " " << trial;
        }
    }
}

RigidBodyDef boxes(const std::vector<std::pair<Vec2, Vec2>>& placesAndSizes)
{
    RigidBodyDef def;
    for (const auto& [at, size] : placesAndSizes)
        def.shapes.push_back({ShapeDef::Kind::Polygon, boxRing(at, size.x(), size.y()), 0});
    return def;
}

TEST(Queries, ShapesThatLieOverEachOtherAreSeenWhole)
{
    auto world = makeWorld({0, 0});
    // A bar whose long sides have their middles in a block.
    const BodyHandle body = world->addRigidBody(boxes({{{0, 0}, {60, 10}}, {{0, 0}, {30, 30}}}));
    const Vec2 shift = -world->bodies().position[body];
    world->setPosition(body, {0, 0});
    for (const double x : {-25.0, 25.0}) {
        const auto hit = world->rayCast(Vec2(x, -50) + shift, Vec2(x, 50) + shift);
        ASSERT_TRUE(hit) << x;
        EXPECT_NEAR(hit->point.y(), -5, 1e-9);
        EXPECT_NEAR(hit->normal.y(), -1, 1e-9);
        const auto near = world->nearest({x, -8}, 5);
        ASSERT_TRUE(near) << x;
        EXPECT_NEAR(near->point.y(), -5, 1e-9);
        EXPECT_EQ(world->overlapping(Box({x - 1, -6}, {x + 1, -4})), std::vector<BodyHandle>{body});
        EXPECT_NEAR(world->shapeCast({ShapeDef::Kind::Circle, {{x, -50}}, 2}, {0, 100})->fraction, 0.43, 1e-9);
    }
}

TEST(Queries, ARayFromWithinShapesSideBySideLeavesThemAllUnseen)
{
    auto world = makeWorld({0, 0});
    RigidBodyDef row = boxes({{{0, 0}, {10, 10}}, {{10, 0}, {10, 10}}, {{22, 0}, {20, 4}}, {{70, 0}, {10, 10}}});
    row.shapes.push_back({ShapeDef::Kind::Circle, {{0, 0}}, 8});
    world->addRigidBody(row);
    const auto hit = world->rayCast({0, 0}, {100, 0});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->point.x(), 65, 1e-6) << "what stands apart is met, the seams are not";
    EXPECT_FALSE(world->rayCast({0, 0}, {60, 0}));
    EXPECT_FALSE(world->rayCast({24, 0}, {-50, 0}));
    EXPECT_NEAR(world->rayCast({50, 0}, {0, 0})->point.x(), 32, 1e-6) << "from between them";
}

TEST(Queries, FromWithinShapesTheBorderTheyHaveTogetherIsNearest)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(boxes({{{0, 0}, {10, 10}}, {{10, 0}, {10, 10}}, {{20, 0}, {10, 10}}}));
    for (const double x : {5.0, 6.0, 10.0, 14.9}) {
        const auto near = world->nearest({x, 1}, 20);
        ASSERT_TRUE(near) << x;
        EXPECT_NEAR((near->point - Vec2(x, 5)).norm(), 0, 1e-9) << "not the seam beside " << x;
        EXPECT_NEAR((near->normal - Vec2(0, 1)).norm(), 0, 1e-9);
        EXPECT_NEAR(near->fraction, 0.2, 1e-9);
        EXPECT_FALSE(world->nearest({x, 1}, 3.9)) << "no border is so near";
    }
    EXPECT_NEAR(world->nearest({-4, 0}, 20)->point.x(), -5, 1e-9);
    EXPECT_NEAR((world->nearest({5, 8}, 20)->point - Vec2(5, 5)).norm(), 0, 1e-9) << "from without as ever";

    // Two discs that lie over each other: from their middle, nearest is where their rims cross.
    RigidBodyDef discs;
    discs.shapes = {{ShapeDef::Kind::Circle, {{-4, 100}}, 5}, {ShapeDef::Kind::Circle, {{4, 100}}, 5}};
    world->addRigidBody(discs);
    EXPECT_NEAR((world->nearest({0, 101}, 20)->point - Vec2(0, 103)).norm(), 0, 1e-9);
}

TEST(Queries, FromWithinAnyShapesTheNearestBorderIsThatOfAll)
{
    std::mt19937 random(7);
    const auto number = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    int within = 0;
    for (int trial = 0; trial < 200; ++trial) {
        RigidBodyDef def;
        def.common.fixed = trial % 2 == 0;
        std::vector<Thing> parts;
        for (int i = 0; i < 2 + trial % 5; ++i) {
            const Vec2 at(number(-15, 15), number(-15, 15));
            Thing part;
            if (i % 3 == 0) {
                part.points = boxRing(at, number(5, 30), number(5, 30), number(0, 3));
                def.shapes.push_back({ShapeDef::Kind::Polygon, part.points, 0});
            } else if (i % 3 == 1) {
                part.points = {at}, part.radius = number(3, 14);
                def.shapes.push_back({ShapeDef::Kind::Circle, part.points, part.radius});
            } else {
                part.points = {at, at + Vec2(number(-20, 20), number(-20, 20))}, part.radius = number(2, 8);
                def.shapes.push_back({ShapeDef::Kind::Capsule, part.points, part.radius});
            }
            parts.push_back(part);
        }
        const auto depth = [&](const Vec2& p) {
            double least = 1e300;
            for (const Thing& part : parts) least = std::min(least, part.distance(p));
            return least;
        };
        auto world = makeWorld({0, 0});
        world->addRigidBody(def);
        for (int k = 0; k < 20; ++k) {
            const Vec2 p(number(-20, 20), number(-20, 20));
            if (depth(p) > -0.1) continue;
            ++within;
            // The first point outside, in many directions; there may be a nearer one between two of them.
            double least = 1e300;
            for (int d = 0; d < 400; ++d) {
                const Vec2 way(std::cos(d * kPi / 200), std::sin(d * kPi / 200));
                double t = 0;
                while (t < least && depth(p + t * way) < -1e-7) t -= 0.999 * depth(p + t * way);
                least = std::min(least, t);
            }
            const auto near = world->nearest(p, 200);
            ASSERT_TRUE(near);
            EXPECT_LE((near->point - p).norm(), least + 1e-5) << trial;
            EXPECT_NEAR(near->fraction * 200, (near->point - p).norm(), 1e-9);
            EXPECT_NEAR(depth(near->point), 0, 1e-6) << trial;
        }
    }
    EXPECT_GT(within, 500);
}

TEST(Queries, AChainIsMetFromItsFrontOnlyByRaysAndByShapes)
{
    auto world = makeWorld({0, 0});
    RigidBodyDef ground;
    ground.shapes = {{ShapeDef::Kind::Chain, {{-50, 0}, {0, 0}, {50, 0}}, 0}};  // solid below: y is down
    ground.common.fixed = true;
    world->addRigidBody(ground);
    for (const double x : {-20.0, 0.0, 30.0}) {
        const std::vector<ShapeDef> shapes = {{ShapeDef::Kind::Circle, {{x, 0}}, 3},
                                              {ShapeDef::Kind::Capsule, {{x - 4, 0}, {x + 4, 1}}, 2},
                                              {ShapeDef::Kind::Polygon, boxRing({x, 0}, 6, 6, 0.3), 0}};
        EXPECT_TRUE(world->rayCast({x, -20}, {x, 20}));
        EXPECT_FALSE(world->rayCast({x, 20}, {x, -20}));
        for (ShapeDef shape : shapes) {
            const auto moved = [&](double y) {
                ShapeDef there = shape;
                for (Vec2& at : there.points) at.y() += y;
                return there;
            };
            const auto hit = world->shapeCast(moved(-20), {0, 40});
            ASSERT_TRUE(hit) << x;
            EXPECT_NEAR(hit->normal.y(), -1, 1e-9);
            EXPECT_NEAR(hit->point.y(), 0, 1e-9);
            EXPECT_FALSE(world->shapeCast(moved(20), {0, -40})) << "from behind, at " << x;
            EXPECT_FALSE(world->shapeCast(moved(1), {0, -40})) << "its middle is behind, at " << x;
            EXPECT_NEAR(world->shapeCast(moved(-1), {0, 40})->fraction, 0, 0) << "it lies on it, at " << x;
            EXPECT_FALSE(world->shapeCast(moved(-20), {0, -40})) << "away, at " << x;
        }
    }
    EXPECT_EQ(world->overlapping(Box({-1, -1}, {1, 1})), std::vector<BodyHandle>{0}) << "a box has no front";
}

TEST(Queries, ALineRoundABodyDoesNotLieOnIt)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(box({0, 0}, 4, 4));
    const ShapeDef hook{
        ShapeDef::Kind::Chain, {{-20, -10}, {0, 20}, {20, -10}}, 0};  // the mean of its points is (0, 0)
    EXPECT_FALSE(world->shapeCast(hook, {0, 0}));
    const auto hit = world->shapeCast(hook, {0, -40});
    ASSERT_TRUE(hit);
    EXPECT_GT(hit->fraction, 0.3);
    EXPECT_NEAR(world->shapeCast({ShapeDef::Kind::Chain, {{-1, 0}, {1, 0}, {0, 1}}, 0}, {0, 40})->fraction, 0, 0);
}

TEST(Queries, ShapesKeepTheirPlaceWhenASoftBodyJoinsTheWorld)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(simple(box({0, 0}, 10, 10)));  // has no walls of its own until the soft body comes
    const BodyHandle pair = world->addRigidBody(boxes({{{40, 0}, {10, 10}}, {{60, 0}, {10, 10}}}));
    RigidBodyDef block = simple(box({100, 0}, 10, 10));
    block.common.fixed = true;
    const BodyHandle ground = world->addRigidBody(block);
    world->addSoftBody(square({200, 0}, 20));
    EXPECT_EQ(world->rayCast({20, 0}, {80, 0})->body, pair);
    EXPECT_EQ(world->rayCast({80, 0}, {180, 0})->body, ground);
    EXPECT_EQ(world->nearest({100, 8}, 5)->body, ground);
    EXPECT_TRUE(world->contains(ground, {100, 0}));
    EXPECT_TRUE(world->contains(pair, {60, 0}));
    EXPECT_FALSE(world->contains(pair, {50, 0}));
}

TEST(Queries, ASoftBodyWithAHoleContainsItsFlesh)
{
    SoftBodyDef ring = softBall({0, 0}, 30, 200, 1, 24, 3);
    auto& hole = ring.borders.emplace_back();
    for (std::uint32_t i = 0; i < 24; ++i) hole.push_back(1 + i);
    auto world = makeWorld({0, 0});
    world->addSoftBody(ring);
    EXPECT_TRUE(world->contains(0, {20, 0}));
    EXPECT_FALSE(world->contains(0, {2, 0}));
    EXPECT_FALSE(world->contains(0, {40, 0}));
    EXPECT_EQ(world->overlapping(Box({18, -1}, {22, 1})), std::vector<BodyHandle>{0});
    EXPECT_TRUE(world->overlapping(Box({-1, -1}, {1, 1})).empty());
}

TEST(Queries, FiltersLookThroughBodies)
{
    auto world = makeWorld({0, 0});
    RigidBodyDef first = simple(box({20, 0}, 10, 10)), second = simple(box({40, 0}, 10, 10)),
                 third = simple(box({60, 0}, 10, 10));
    first.common.sensor = true;
    second.common.layer = 2;
    for (const RigidBodyDef& def : {first, second, third}) world->addRigidBody(def);
    EXPECT_EQ(world->rayCast({0, 0}, {100, 0})->body, 1u);
    QueryFilter filter;
    filter.sensors = true;
    EXPECT_EQ(world->rayCast({0, 0}, {100, 0}, filter)->body, 0u);
    filter.sensors = false, filter.mask = 1;
    EXPECT_EQ(world->rayCast({0, 0}, {100, 0}, filter)->body, 2u);
    EXPECT_EQ(world->shapeCast({ShapeDef::Kind::Circle, {{0, 0}}, 2}, {100, 0}, filter)->body, 2u);
    EXPECT_EQ(world->overlapping(Box({0, -5}, {100, 5}), filter), (std::vector<BodyHandle>{2}));
}

TEST(Queries, TheyFollowBodiesThatMove)
{
    auto world = makeWorld({0, 0});
    const BodyHandle body = world->addRigidBody(simple(box({0, 0}, 10, 10)));
    EXPECT_TRUE(world->nearest({0, 20}, 16));
    world->setPosition(body, {0, 500});
    EXPECT_FALSE(world->nearest({0, 20}, 16));
    EXPECT_TRUE(world->rayCast({-50, 500}, {50, 500}));
    world->setVelocity(body, {600, 0});
    run(*world, 1);
    EXPECT_NEAR(world->rayCast({0, 500}, {1000, 500})->point.x(), 595, 1e-6);
}

TEST(Queries, NonsenseIsRefused)
{
    auto world = makeWorld({0, 0});
    EXPECT_THROW(world->rayCast({0, std::numeric_limits<double>::quiet_NaN()}, {1, 1}), Failure);
    EXPECT_THROW(world->shapeCast({ShapeDef::Kind::Circle, {{0, 0}}, -1}, {1, 1}), Failure);
    EXPECT_FALSE(world->rayCast({0, 0}, {0, 0}));
    EXPECT_TRUE(world->overlapping(Box()).empty());
}

}  // namespace

}  // namespace jet::physics::test
