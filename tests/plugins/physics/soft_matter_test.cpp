// What soft bodies are made of beyond springs, and fields of force, compared with formulas.
#include "lattices.hpp"

#include <jet/result.hpp>

#include <limits>

namespace jet::physics::test {

namespace {

double areaOf(const PhysicsWorld& world, BodyHandle body, const SoftBodyDef& def)
{
    return std::abs(signedArea(pointsOf(world, body), def.borders[0]));
}

/// A ring of particles of mass 1 each, joined to their neighbours only.
SoftBodyDef hoop(double radius, int count, double ks, double kd)
{
    SoftBodyDef def;
    def.particles = circleRing({0, 0}, radius, count);
    def.masses.assign(static_cast<std::size_t>(count), 1);
    auto& ring = def.borders.emplace_back();
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
        const std::uint32_t next = (i + 1) % static_cast<std::uint32_t>(count);
        def.springs.push_back({i, next, (def.particles[i] - def.particles[next]).norm(), ks, kd, 0});
        ring.push_back(i);
    }
    return def;
}

}  // namespace

TEST(SoftMatter, GasStretchesAHoopUntilItsTensionBalancesThePressure)
{
    // A regular polygon of side L with tension T in its sides bears the pressure p = 2 T tan(pi / n) / L.
    SoftBodyDef def = hoop(10, 32, 400, 20);
    def.matter.pressure = 30;
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    const double rest = areaOf(*world, 0, def);
    run(*world, 30);
    const auto points = pointsOf(*world, 0);
    const double side = (points[1] - points[0]).norm();
    const double tension = 400 * (side - def.springs[0].restLength);
    const double pressure = 30 * rest / areaOf(*world, 0, def);
    EXPECT_NEAR(2 * tension * std::tan(3.14159265358979 / 32) / side, pressure, 0.01 * pressure);
    EXPECT_GT(areaOf(*world, 0, def), 1.05 * rest);
    EXPECT_NEAR(world->springTension(0, 0), tension, 0.01 * tension);
}

TEST(SoftMatter, PressureMovesAndTurnsNothing)
{
    SoftBodyDef def = defaultBall({300, -40}, 30);
    def.matter.pressure = 50;
    def.matter.areaStiffness = 1e4;
    auto world = makeWorld({0, 0});
    world->addSoftBody(def);
    run(*world, 5);
    EXPECT_LT((world->bodies().position[0] - Vec2(300, -40)).norm(), 1e-6);
    EXPECT_NEAR(world->bodies().angle[0], 0, 1e-6);
}

TEST(SoftMatter, AreaStiffnessKeepsTheAreaUnderLoad)
{
    double kept[2];
    for (const int stiff : {0, 1}) {
        SoftBodyDef def = defaultBall({0, -30}, 30, 2);
        def.matter.areaStiffness = stiff * 1e4;
        auto world = makeWorld({0, 98});
        world->addSoftBody(def);
        world->addRigidBody(ground(0));
        run(*world, 8);
        kept[stiff] = areaOf(*world, 0, def) / std::abs(signedArea(def.particles, def.borders[0]));
    }
    EXPECT_LT(kept[0], 0.97);
    EXPECT_GT(kept[1], 0.99);
}

TEST(SoftMatter, NoPressureAndNoStiffnessExplodes)
{
    for (const double ks : {1e-3, 1.0, 1e3, 1e6, 1e9})
        for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 1000})
            for (const double pressure : {0.0, 1e3, 1e9}) {
                SoftBodyDef def = defaultBall({0, -40}, 30, ks);
                def.matter.pressure = pressure;
                def.matter.areaStiffness = pressure;
                for (std::size_t i = 0; i < def.masses.size(); i += 7) def.masses[i] *= 1e4;
                auto world = makeWorld({0, 98});
                world->addSoftBody(def);
                world->addRigidBody(ground(0));
                for (int i = 0; i < 120; ++i) world->step(step);
                ASSERT_TRUE(allFinite(*world)) << "ks " << ks << " step " << step << " pressure " << pressure;
                EXPECT_LT(world->bodies().bounds[0].size().norm(), 3e3)
                    << "ks " << ks << " step " << step << " pressure " << pressure;
            }
}

TEST(SoftMatter, ASpringBeyondItsYieldStaysChangedAndOneBelowDoesNot)
{
    for (const double strain : {0.05, 0.3}) {
        SoftBodyDef def;
        def.particles = {{0, 0}, {10 * (1 + strain), 0}};
        def.masses = {1, 1};
        def.movable = {0, 0};
        def.springs = {{0, 1, 10, 100, 0, 0}};
        def.matter.yield = 0.1;
        auto world = makeWorld({0, 0});
        world->addSoftBody(def);
        EXPECT_NEAR(world->springTension(0, 0), 1000 * strain, 1e-9);
        run(*world, 30);
        // What is left of the strain is the yield, of the new rest length.
        const double length = 10 * (1 + strain), rest = strain > 0.1 ? length / 1.1 : 10;
        EXPECT_NEAR(world->springTension(0, 0), 100 * (length - rest), 1e-3);
    }
}

TEST(SoftMatter, AFoldedBorderDoesNotPassThroughItself)
{
    // A banana bent until its tips meet: with self-collision they stop at each other, without they cross. Its yield is
    // out of reach, but takes away the memory of its shape, which would keep the tips apart.
    double apart[2];
    for (const bool collides : {false, true}) {
        SoftBodyDef def = banana({0, 0}, 50);
        def.matter.selfCollision = collides;
        def.matter.yield = 100;
        auto world = makeWorld({0, 0});
        world->addSoftBody(def);
        // The outer corners of the two tips; the left one is pushed right, the right one left.
        const auto left = def.borders[0][0], right = def.borders[0][16];
        world->addForce({{0, def.particles[left]}, {60, 0}});
        world->addForce({{0, def.particles[right]}, {-60, 0}});
        bool self = false;
        for (int i = 0; i < 300; ++i) {
            world->step(kStep);
            for (const Contact& contact : world->contacts()) self |= contact.bodyA == contact.bodyB;
        }
        ASSERT_TRUE(allFinite(*world));
        EXPECT_EQ(self, collides);
        EXPECT_FALSE(world->touching(0, 0));
        const auto points = pointsOf(*world, 0);
        apart[collides] = points[right].x() - points[left].x();
    }
    EXPECT_LT(apart[0], -50);
    EXPECT_GT(apart[1], -1);
}

TEST(SoftMatter, ThicknessKeepsABodyOffTheGround)
{
    SoftBodyDef def = defaultBall({0, -40}, 20);
    def.matter.thickness = 3;
    auto world = makeWorld({0, 98});
    world->addSoftBody(def);
    world->addRigidBody(ground(0));
    run(*world, 10);
    EXPECT_NEAR(world->bodies().bounds[0].max.y(), -3, 0.3);
}

TEST(SoftMatter, APinnedParticleHoldsTheBodyUntilItIsLetGo)
{
    const SoftBodyDef def = defaultBall({0, 0}, 20);
    auto world = makeWorld({0, 98});
    world->addSoftBody(def);
    world->setPinned(0, 5, true);
    run(*world, 3);
    EXPECT_EQ(pointsOf(*world, 0)[5], def.particles[5]);
    const auto pinned = world->save();
    world->setPinned(0, 5, false);
    run(*world, 1);
    EXPECT_GT(world->bodies().position[0].y(), 40);
    world->restore(pinned);
    run(*world, 1);
    EXPECT_EQ(pointsOf(*world, 0)[5], def.particles[5]);
}

TEST(SoftMatter, APinTakesNothingFromTheVelocityOfTheOtherParticles)
{
    // Loose particles, of different masses, so that each shows its own velocity.
    SoftBodyDef def;
    def.particles = {{0, 0}, {10, 0}, {10, 10}, {0, 30}};
    def.masses = {5, 1, 2, 3};
    def.movable = {0, 1, 1, 1};
    def.common.velocity = {6, -3};
    auto world = makeWorld({0, 0});
    const BodyHandle body = world->addSoftBody(def);
    const auto expectMoved = [&](const Vec2& way, const char* what) {
        const auto place = [&] { return std::vector(pointsOf(*world, body).begin(), pointsOf(*world, body).end()); };
        const std::vector<Vec2> before = place();
        world->step(kStep);
        const std::vector<Vec2> after = place();
        EXPECT_EQ(after[0], before[0]) << what;
        for (std::size_t i = 1; i < after.size(); ++i)
            EXPECT_NEAR((after[i] - before[i] - way).norm(), 0, 1e-12) << what << ", particle " << i;
    };
    expectMoved(Vec2(6, -3) * kStep, "as drawn");
    for (int i = 0; i < 2; ++i) world->setVelocity(body, {0, 7});
    expectMoved(Vec2(0, 7) * kStep, "set twice");
    world->setOmega(body, 0);
    expectMoved(Vec2(0, 7) * kStep, "with no turning");
}

TEST(SoftMatter, EveryParameterChangesWhileItRunsAndARewindBringsTheOldOnesBack)
{
    SoftBodyDef def = defaultBall({0, -60}, 30);
    def.matter.yield = 0.02;
    const auto make = [&] {
        auto world = makeWorld({0, 98});
        world->addSoftBody(def);
        world->addRigidBody(ground(0));
        return world;
    };
    auto world = make();
    run(*world, 2);
    const auto before = world->save();
    run(*world, 1);
    const auto expected = world->hash();
    world->setSprings(0, 50, 1, 1.5);
    world->setSoftMatter(0, {.thickness = 1, .pressure = 5, .areaStiffness = 100});
    run(*world, 1);
    EXPECT_NE(world->hash(), expected);
    world->restore(before);
    run(*world, 1);
    EXPECT_EQ(world->hash(), expected);
    auto other = make();
    other->restore(before);
    run(*other, 1);
    EXPECT_EQ(other->hash(), expected);
}

TEST(SoftMatter, WhatIsNotANumberIsRefusedByName)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    SoftBodyDef def = defaultBall({0, 0}, 20);
    auto world = makeWorld({0, 98});
    world->addSoftBody(def);
    EXPECT_THROW(world->setSoftMatter(0, {.pressure = nan}), Failure);
    EXPECT_THROW(world->setSoftMatter(0, {.areaStiffness = -1}), Failure);
    EXPECT_THROW(world->setSprings(0, -1, 0, 0), Failure);
    EXPECT_THROW(world->setPinned(0, 100000, true), Failure);
    def.matter.yield = nan;
    EXPECT_THROW(world->addSoftBody(def), Failure);
    ForceFieldDef field;
    field.centre = {nan, 0};
    EXPECT_THROW(world->addForceField(field), Failure);
}

TEST(ForceField, DirectionalActsLikeGravityOnlyInsideItsPath)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(box({0, 0}, 10, 10));
    world->addSoftBody(defaultBall({1000, 0}, 20));
    ForceFieldDef field;
    field.vector = {0, 30};
    field.region = {boxRing({0, 0}, 400, 4000)};
    world->addForceField(field);
    run(*world, 2);
    EXPECT_NEAR(world->bodies().velocity[0].y(), 60, 1e-9);
    EXPECT_NEAR(world->bodies().velocity[1].norm(), 0, 1e-9);
}

TEST(ForceField, ActsOnSimpleShapesOnlyInsideItsPath)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(simple(box({0, 0}, 10, 10)));
    world->addRigidBody(simple(box({1000, 0}, 10, 10)));
    ForceFieldDef field;
    field.vector = {0, 30};
    field.region = {boxRing({0, 0}, 400, 4000)};
    world->addForceField(field);
    run(*world, 2);
    EXPECT_NEAR(world->bodies().velocity[0].y(), 60, 1e-6);
    EXPECT_EQ(world->bodies().velocity[1], Vec2(0, 0));
}

TEST(ForceField, ARewindBringsTheOldRegionBack)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(box({0, 0}, 10, 10));
    world->addRigidBody(box({1000, 0}, 10, 10));
    ForceFieldDef field;
    field.vector = {0, 30};
    field.region = {boxRing({0, 0}, 400, 4000)};
    const ActuatorHandle handle = world->addForceField(field);
    const auto before = world->save();
    run(*world, 2);
    const auto expected = world->hash();
    world->restore(before);
    field.region = {boxRing({1000, 0}, 400, 4000)};
    world->setForceField(handle, field);
    run(*world, 2);
    EXPECT_NEAR(world->bodies().velocity[1].y(), 60, 1e-6);
    world->restore(before);
    run(*world, 2);
    EXPECT_EQ(world->hash(), expected);
}

TEST(ForceField, AnotherKindIsRefusedAndChangesNothing)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(box({0, 0}, 10, 10));
    ForceFieldDef wind;
    wind.vector = {100, 0};
    const auto handle = world->addForceField(wind);
    const auto before = world->hash();
    wind.kind = ForceFieldDef::Kind::Drag;
    try {
        world->setForceField(handle, wind);
        ADD_FAILURE() << "was taken";
    } catch (const Failure& failure) {
        EXPECT_NE(failure.error().message.find("force field 0: its kind"), std::string::npos);
    }
    EXPECT_EQ(world->hash(), before);
}

TEST(ForceField, DragBringsToTheSpeedOfTheWindExponentially)
{
    auto world = makeWorld({0, 0});
    world->addRigidBody(box({0, 0}, 10, 10));
    ForceFieldDef wind;
    wind.kind = ForceFieldDef::Kind::Drag;
    wind.vector = {100, 0};
    wind.strength = 0.7;
    const auto handle = world->addForceField(wind);
    run(*world, 2);
    EXPECT_NEAR(world->bodies().velocity[0].x(), 100 * (1 - std::exp(-1.4)), 1e-6);
    wind.strength = 1e9;  // no drag overshoots
    world->setForceField(handle, wind);
    run(*world, 0.1);
    EXPECT_NEAR(world->bodies().velocity[0].x(), 100, 1e-6);
}

TEST(ForceField, BuoyancyFloatsABodyOfHalfTheFluidsDensityHalfUnder)
{
    // strength = density of the fluid over that of the body; afloat when half the particles are under.
    auto world = makeWorld({0, 98});
    world->addSoftBody(square({0, -30}, 40));
    ForceFieldDef water;
    water.kind = ForceFieldDef::Kind::Buoyancy;
    water.strength = 2;
    water.drag = 2;
    water.region = {boxRing({0, 1000}, 4000, 2000)};
    world->addForceField(water);
    run(*world, 20);
    EXPECT_NEAR(world->bodies().position[0].y(), 0, 8);
    EXPECT_LT(world->bodies().velocity[0].norm(), 2);
}

TEST(ForceField, AVortexTurnsClockwiseAndARadialFieldPullsToItsCentre)
{
    for (const auto kind : {ForceFieldDef::Kind::Vortex, ForceFieldDef::Kind::Radial}) {
        auto world = makeWorld({0, 0});
        world->addRigidBody(box({100, 0}, 2, 2));
        ForceFieldDef field;
        field.kind = kind;
        field.strength = -10;
        field.reach = 100;
        world->addForceField(field);
        world->step(kStep);
        const Vec2 gained = world->bodies().velocity[0];
        const Vec2 along = kind == ForceFieldDef::Kind::Vortex ? Vec2(0, -1) : Vec2(-1, 0);
        EXPECT_NEAR(gained.dot(along), 5 * kStep, 0.02 * 5 * kStep);  // halved at its reach
    }
}

TEST(SoftMatter, PropertiesOfABodyChangeWhileItMoves)
{
    WorldSettings settings;
    settings.gravity = {0, 98};
    settings.materialCount = 2;
    settings.materials.assign(4, {0.5, 0, true});
    settings.materials[1].collides = settings.materials[2].collides = false;
    auto world = JetPhysics().createWorld(settings);
    const BodyHandle low = world->addSoftBody(defaultBall({0, -21}, 20, 40));
    const BodyHandle high = world->addSoftBody(defaultBall({1, -66}, 20, 40));
    world->addRigidBody(ground(0));
    world->addRigidBody(fixed({boxRing({-75, -100}, 100, 400), boxRing({75, -100}, 100, 400)}));
    run(*world, 6);
    ASSERT_TRUE(world->touching(low, high));
    const double resting = world->bodies().position[high].y();
    const auto saved = world->save();

    BodyCommon common;
    common.gravityScale = -1;
    world->setBody(high, common);
    run(*world, 1);
    EXPECT_LT(world->bodies().position[high].y(), resting - 30) << "it falls up";

    world->restore(saved);
    run(*world, 1);
    EXPECT_NEAR(world->bodies().position[high].y(), resting, 0.5) << "what was restored weighs again";

    common = BodyCommon();
    common.sensor = true;
    world->setBody(high, common);
    run(*world, 0.5);
    EXPECT_GT(world->bodies().position[high].y(), resting + 5) << "sensors are not held";
    EXPECT_TRUE(world->touching(low, high));

    world->restore(saved);
    common = BodyCommon();
    common.material = 1;
    world->setBody(high, common);
    run(*world, 0.5);
    EXPECT_GT(world->bodies().position[high].y(), resting + 5) << "materials that do not collide pass each other";
    EXPECT_FALSE(world->touching(low, high));

    common.fixed = true;
    EXPECT_THROW(world->setBody(high, common), Failure);
    common.fixed = false, common.material = 2;
    EXPECT_THROW(world->setBody(high, common), Failure);
}

}  // namespace jet::physics::test
