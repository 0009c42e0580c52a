// Fields of force on rigid bodies against formulas: what counts is how much of a body's area is inside.
#include "formulas.hpp"
#include "scenes.hpp"

#include <numbers>

namespace jet::physics::test {

namespace {

RigidBodyDef disc(const Vec2& at, double radius)
{
    RigidBodyDef def;
    def.shapes = {{ShapeDef::Kind::Circle, {at}, radius}};
    return def;
}

std::unique_ptr<PhysicsWorld> worldWith(const ForceFieldDef& field, const Vec2& gravity = {0, 0})
{
    auto world = makeWorld(gravity);
    world->addForceField(field);
    return world;
}

/// A sea whose surface is y = 0.
ForceFieldDef sea(double strength, double drag = 2)
{
    ForceFieldDef field;
    field.kind = ForceFieldDef::Kind::Buoyancy;
    field.strength = strength, field.drag = drag;
    field.region = {boxRing({0, 500}, 4000, 1000)};
    return field;
}

TEST(ForceFields, ABoxFloatsAsDeepAsArchimedesSays)
{
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240})
        for (const double strength : {1.25, 2.0, 4.0})
            for (const bool drawn : {false, true}) {
                const auto world = worldWith(sea(strength), {0, 98.1});
                const BodyHandle body =
                    world->addRigidBody(drawn ? box({0, -5}, 20, 20) : simple(box({0, -5}, 20, 20)));
                for (int i = 0; i < static_cast<int>(20 / dt); ++i) world->step(dt);
                EXPECT_NEAR(world->bodies().position[body].y(), 20 / strength - 10, 0.01)
                    << "strength " << strength << ", drawn " << drawn << ", dt " << dt;
                EXPECT_NEAR(world->bodies().velocity[body].norm(), 0, 0.01);
            }
}

TEST(ForceFields, ATiltedPlankComesToLieFlat)
{
    const auto world = worldWith(sea(2), {0, 98.1});
    const BodyHandle plank = world->addRigidBody(simple(box({0, 0}, 60, 12, 1, 0.6)));
    run(*world, 30);
    EXPECT_NEAR(world->bodies().angle[plank], -0.6, 0.01);
    EXPECT_NEAR(world->bodies().position[plank].y(), 0, 0.05);
}

TEST(ForceFields, AJetNarrowerThanABodyPushesItByItsShare)
{
    ForceFieldDef jet;
    jet.vector = {0, -100};
    jet.region = {boxRing({0, 0}, 6, 1000)};
    for (const bool drawn : {false, true}) {
        const auto world = worldWith(jet);
        const BodyHandle body = world->addRigidBody(drawn ? box({0, 0}, 20, 20) : simple(box({0, 0}, 20, 20)));
        world->step(kStep);
        EXPECT_NEAR(world->bodies().velocity[body].y(), -100 * 0.3 * kStep, 1e-6);
        EXPECT_NEAR(world->bodies().omega[body], 0, 1e-6);
    }
}

TEST(ForceFields, WhatTurnsIsSlowedAsWhatMoves)
{
    for (const bool everywhere : {false, true}) {
        ForceFieldDef drag;
        drag.kind = ForceFieldDef::Kind::Drag;
        if (!everywhere) drag.region = {boxRing({0, 0}, 1000, 1000)};
        const auto world = worldWith(drag);
        const BodyHandle square = world->addRigidBody(simple(box({0, 0}, 20, 20)));
        const BodyHandle round = world->addRigidBody(disc({100, 0}, 10));
        for (const BodyHandle body : {square, round}) world->setOmega(body, 3), world->setVelocity(body, {0, 30});
        run(*world, 1);
        for (const BodyHandle body : {square, round}) {
            EXPECT_NEAR(world->bodies().omega[body], 3 * std::exp(-1), 1e-3);
            EXPECT_NEAR(world->bodies().velocity[body].y(), 30 * std::exp(-1), 1e-3);
        }
    }
}

/// s over r, integrated over the disc: torque 2/3 m s R, inertia m R² / 2.
TEST(ForceFields, AVortexTurnsADiscInItsMiddle)
{
    ForceFieldDef vortex;
    vortex.kind = ForceFieldDef::Kind::Vortex;
    vortex.strength = 10;
    const auto world = worldWith(vortex);
    const BodyHandle body = world->addRigidBody(disc({0, 0}, 10));
    world->step(kStep);
    EXPECT_NEAR(world->bodies().omega[body], 10 * 4.0 / 30 * kStep, 0.005 * 10 * 4.0 / 30 * kStep);
    EXPECT_NEAR(world->bodies().velocity[body].norm(), 0, 1e-6);
}

bool insideOddly(const std::vector<std::vector<Vec2>>& rings, const Vec2& p)
{
    bool inside = false;
    for (const auto& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
            if ((a.y() > p.y()) != (b.y() > p.y()) &&
                p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
                inside = !inside;
        }
    return inside;
}

TEST(ForceFields, RegionsOfAnyFormActOnWhatIsInsideThem)
{
    std::vector<Vec2> star;
    for (int i = 0; i < 5; ++i) star.push_back(Affine::rotation(2 * 2 * kPi * i / 5).linear() * Vec2(0, -40));
    const std::vector<std::vector<std::vector<Vec2>>> regions = {
        {{{-40, -40}, {40, -40}, {40, 40}, {20, 40}, {20, -10}, {-20, -10}, {-20, 40}, {-40, 40}}},  // concave
        {boxRing({0, 0}, 80, 80), boxRing({5, 0}, 30, 30)},                                          // with a hole
        {star},                                                                                      // crosses itself
        {boxRing({3, 2}, 0.5, 0.25)},                                                                // tiny
        {boxRing({-12, 0}, 20, 60), boxRing({18, 4}, 20, 10, 0.3)}};                                 // two
    for (std::size_t which = 0; which < regions.size(); ++which) {
        for (int pose = 0; pose < 6; ++pose) {
            const Vec2 at(-15.0 + 7 * pose, 8.0 - 5 * pose);
            const double width = 36, height = 22, angle = 0.4 * pose, tiny = which == 3 ? 0.3 : 1;
            ForceFieldDef field;
            field.vector = {0, 100};
            field.region = regions[which];
            const auto world = worldWith(field);
            const BodyHandle body = world->addRigidBody(simple(box(at, width, height, 1, angle)));
            world->step(kStep);
            // Brute force: a fine grid over the box.
            constexpr int n = 300;
            double mass = 0, torque = 0;
            for (int i = 0; i < n; ++i)
                for (int k = 0; k < n; ++k) {
                    const Vec2 lever = Affine::rotation(angle).linear() *
                                       Vec2(width * ((i + 0.5) / n - 0.5), height * ((k + 0.5) / n - 0.5));
                    if (!insideOddly(regions[which], at + lever)) continue;
                    mass += 1.0 / (n * n);
                    torque += lever.x() * 100 / (n * n);
                }
            const double inertia = (width * width + height * height) / 12;
            EXPECT_NEAR(world->bodies().velocity[body].y(), 100 * mass * kStep, 0.006 * tiny) << which << ", " << pose;
            EXPECT_NEAR(world->bodies().omega[body], torque / inertia * kStep, 0.0006 * tiny) << which << ", " << pose;
        }
    }
}

TEST(ForceFields, FallingThroughTheCentreOfAnAttractionGainsNothing)
{
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 1000}) {
        ForceFieldDef field;
        field.kind = ForceFieldDef::Kind::Radial;
        field.strength = -100;
        const auto world = worldWith(field);
        const BodyHandle exact = world->addRigidBody(disc({3, 0}, 1));
        double fastest = 0;
        for (int i = 0; i < static_cast<int>(20 / dt); ++i) {
            world->step(dt);
            fastest = std::max(fastest, world->bodies().velocity[exact].norm());
        }
        EXPECT_LT(fastest, std::sqrt(2 * 100 * 3) + 100 * dt) << "dt " << dt;
        EXPECT_GT(fastest, 20) << "dt " << dt;
    }
}

}  // namespace

}  // namespace jet::physics::test
