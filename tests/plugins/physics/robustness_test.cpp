// What people draw by accident: nothing may crash, explode or become NaN, and nonsense is refused with a sentence.
#include "scenes.hpp"

#include <jet/result.hpp>

#include <limits>

namespace jet::physics::test {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Robustness, DegenerateBordersAreSurvived)
{
    const std::vector<std::vector<std::vector<Vec2>>> drawings = {
        {},
        {{}},
        {{{0, 0}}},
        {{{0, 0}, {10, 0}}},
        {{{0, 0}, {10, 0}, {20, 0}}},                                                  // no area
        {{{0, 0}, {0, 0}, {0, 0}, {0, 0}}},                                            // one point
        {{{0, 0}, {20, 0}, {20, 0}, {20, 20}, {0, 20}, {0, 20}, {0, 0}}},              // points twice
        {{{0, 0}, {20, 20}, {20, 0}, {0, 20}}},                                        // crosses itself
        {{{0, 0}, {20, 0}, {20, 20}, {10, 0}, {0, 20}}},                               // touches itself
        {{{0, 0}, {0, 20}, {20, 20}, {20, 0}}, {{0, 0}, {0, 20}, {20, 20}, {20, 0}}},  // cancels itself
        {{{0, 0}, {1e-9, 0}, {1e-9, 1e-9}}},
        {{{0, 0}, {1e6, 0}, {1e6, 1e-6}}},
    };
    for (std::size_t i = 0; i < drawings.size(); ++i) {
        for (const bool still : {false, true}) {
            auto world = makeWorld({0, 300});
            RigidBodyDef def = rigid(drawings[i]);
            def.common.fixed = still;
            world->addRigidBody(def);
            SoftBodyDef soft;
            for (const auto& ring : drawings[i]) {
                auto& border = soft.borders.emplace_back();
                for (const Vec2& at : ring) {
                    border.push_back(static_cast<std::uint32_t>(soft.particles.size()));
                    soft.particles.push_back(at + Vec2(3, -30));
                    if (border.size() > 1) soft.springs.push_back({border.back() - 1, border.back(), 5, 100, 1, 0});
                }
            }
            soft.masses.assign(soft.particles.size(), 0.1);
            world->addSoftBody(soft);
            world->addRigidBody(box({8, -15}, 10, 10));
            world->addSoftBody(softBall({10, -80}, 20));
            world->addRigidBody(ground(60));
            world->addTorque({{0, {0, 0}}, 50});
            world->addTorque({{1, {0, 0}}, 50});
            run(*world, 2);
            EXPECT_TRUE(allFinite(*world)) << "drawing " << i << (still ? ", fixed" : "");
            EXPECT_LT(world->bodies().position[2].norm(), 5000) << "drawing " << i;
        }
    }
}

TEST(Robustness, ABoxLandsOnAnOutlineDrawnEitherWayRoundWithPointsTwice)
{
    for (const bool reversed : {false, true}) {
        std::vector<Vec2> outline;
        for (int i = 0; i <= 300; ++i) {
            outline.push_back({-300.0 + 2 * i, 5 * std::sin(i * 0.1)});
            if (i % 3 == 0) outline.push_back(outline.back());
        }
        outline.push_back({300, 100});
        outline.push_back({-300, 100});
        outline.push_back(outline.front());
        if (reversed) std::reverse(outline.begin(), outline.end());
        auto world = makeWorld({0, 400}, 0.9);
        world->addRigidBody(fixed({outline}));
        world->addRigidBody(box({0, -60}, 30, 30, 1, 0.4));
        const SoftBodyDef soft = softBall({100, -80}, 30, 300, 2);
        world->addSoftBody(soft);
        run(*world, 4);
        EXPECT_LT(world->bodies().bounds[1].max.y(), 6);
        EXPECT_LT(world->bodies().bounds[2].max.y(), 6);
        EXPECT_GT(areaRatio(*world, 2, soft), 0.7);
    }
}

TEST(Robustness, BodiesWithoutParticlesAreHarmless)
{
    auto world = makeWorld({0, 100});
    const BodyHandle empty = world->addSoftBody({});
    world->addRigidBody(box({0, 0}, 10, 10));
    SpringActuatorDef spring;
    spring.a = {empty, {5, 5}};
    spring.b = {1, {0, 0}};
    world->addSpring(spring);
    world->addTorque({{empty, {0, 0}}, 10});
    world->addForce({{empty, {0, 0}}, {1, 1}});
    world->setVelocity(empty, {1, 2});
    world->setOmega(empty, 1);
    world->applyForce(empty, {1, 1});
    run(*world, 1);
    EXPECT_TRUE(allFinite(*world));
    EXPECT_FALSE(world->contains(empty, {0, 0}));
    EXPECT_EQ(world->bodies().firstPoint[1], 0u);
}

TEST(Robustness, ManyBodiesAtOnePlacePartCalmly)
{
    auto world = makeWorld({0, 0}, 0.3);
    for (int i = 0; i < 20; ++i) world->addRigidBody(box({0, 0}, 20, 20));
    for (int i = 0; i < 3; ++i) world->addSoftBody(softBall({0, 0}, 20, 300, 1, 12, 2));
    run(*world, 3);
    ASSERT_TRUE(allFinite(*world));
    for (std::size_t body = 0; body < world->bodyCount(); ++body) {
        EXPECT_LT(world->bodies().position[body].norm(), 600);
        EXPECT_LT(world->bodies().velocity[body].norm(), 400);
    }
}

TEST(Robustness, StepsOfEverySizeAreSurvived)
{
    for (const double dt : {1e-9, 1e-4, 1.0 / 240, 1.0 / 30, 0.1, 1.0, 30.0}) {
        auto world = makeWorld({0, 500});
        const SoftBodyDef soft = softBall({0, -60}, 40, 500, 1);
        world->addSoftBody(soft);
        world->addRigidBody(box({0, -130}, 30, 30));
        world->addRigidBody(ground(0));
        for (int i = 0; i < (dt < 1 ? 20 : 3); ++i) world->step(dt);
        EXPECT_TRUE(allFinite(*world)) << dt;
        EXPECT_LT(world->bodies().bounds[0].max.y(), 20) << dt;
        EXPECT_LT(world->bodies().bounds[1].max.y(), 20) << dt;
    }
}

TEST(Robustness, AbsurdForcesDoNotMakeNan)
{
    auto world = makeWorld({0, 500});
    world->addSoftBody(softBall({0, -60}, 40, 1e12, 1e9));
    world->addRigidBody(box({0, -130}, 30, 30, 1e-12));
    world->addRigidBody(box({40, -130}, 30, 30, 1e15));
    world->addRigidBody(ground(0));
    world->addForce({{1, {3, -120}}, {1e20, -1e25}});
    world->addTorque({{0, {0, -60}}, 1e20});
    world->addTorque({{2, {0, -60}}, -1e29});
    SpringActuatorDef spring;
    spring.a = {0, {1, -61}};
    spring.b = {2, {40, -130}};
    spring.ks = spring.kd = 1e25;
    world->addSpring(spring);
    for (int i = 0; i < 60; ++i) {
        world->step(kStep);
        ASSERT_TRUE(allFinite(*world)) << i;
    }
}

TEST(Robustness, CoincidentParticlesDoNotMakeNan)
{
    auto world = makeWorld({0, 300});
    SoftBodyDef def = softBall({0, -50}, 30, 200, 1);
    for (Vec2& at : def.particles) at = {0, -50};
    def.angularSprings.push_back({0, 1, 2, 1, 100, 1});
    def.angularSprings.push_back({1, 1, 1, 1, 100, 1});
    def.springs.push_back({3, 3, 0, 10, 1, 0});
    world->addSoftBody(def);
    world->addRigidBody(ground(0));
    run(*world, 3);
    EXPECT_TRUE(allFinite(*world));
}

TEST(Robustness, NonsenseIsRefusedWithASentence)
{
    auto world = makeWorld({0, 100});
    world->addRigidBody(box({0, 0}, 10, 10));
    const auto refuses = [](auto&& act) {
        try {
            act();
        } catch (const Failure& failure) {
            return failure.error().message.size() > 20;
        }
        return false;
    };
    EXPECT_TRUE(refuses([&] { world->addRigidBody(rigid({{{0, 0}, {kNan, 0}, {1, 1}}})); }));
    EXPECT_TRUE(refuses([&] { world->addRigidBody(box({0, 0}, 1, 1, 0)); }));
    EXPECT_TRUE(refuses([&] { world->addRigidBody(box({0, 0}, 1, 1, -3)); }));
    EXPECT_TRUE(refuses([&] { world->addRigidBody(box({1e300, 0}, 1, 1)); }));
    EXPECT_TRUE(refuses([&] {
        SoftBodyDef def = softBall({0, 0}, 10);
        def.masses.pop_back();
        world->addSoftBody(def);
    }));
    EXPECT_TRUE(refuses([&] {
        SoftBodyDef def = softBall({0, 0}, 10);
        def.springs[0].b = 1000;
        world->addSoftBody(def);
    }));
    EXPECT_TRUE(refuses([&] {
        SoftBodyDef def = softBall({0, 0}, 10);
        def.springs[0].ks = kNan;
        world->addSoftBody(def);
    }));
    EXPECT_TRUE(refuses([&] {
        SoftBodyDef def = softBall({0, 0}, 10);
        def.common.material = 7;
        world->addSoftBody(def);
    }));
    EXPECT_TRUE(refuses([&] { world->addTorque({{9, {0, 0}}, 1}); }));
    EXPECT_TRUE(refuses([&] { world->setVelocity(0, {kNan, 0}); }));
    EXPECT_TRUE(refuses([&] { world->setTorque(0, 1); }));
    EXPECT_TRUE(refuses([&] { world->setGravity({0, kNan}); }));
    EXPECT_TRUE(refuses([&] { world->step(0); }));
    EXPECT_TRUE(refuses([&] { world->step(-1); }));
    EXPECT_TRUE(refuses([&] { world->step(kNan); }));
    EXPECT_TRUE(refuses([&] {
        SoftBodyDef def = softBall({0, 0}, 10);
        def.springs[0].restLength = -1;
        world->addSoftBody(def);
    }));
    for (const auto& [threads, substeps] : {std::pair(0, 0), {65, 0}, {1, -1}, {1, 5000}})
        EXPECT_TRUE(refuses([&] {
            WorldSettings settings;
            settings.threads = threads, settings.substeps = substeps;
            JetPhysics().createWorld(settings);
        })) << threads
            << " threads, " << substeps << " substeps";
    EXPECT_TRUE(refuses([&] {
        WorldSettings settings;
        settings.materialCount = 2;
        settings.materials.assign(4, MaterialPair());
        settings.materials[1].friction = 0.1;
        JetPhysics().createWorld(settings);
    })) << "a table that is not symmetric";
    EXPECT_TRUE(refuses([&] {
        WorldSettings settings;
        settings.materialCount = 3;
        JetPhysics().createWorld(settings);
    }));
    EXPECT_TRUE(refuses([&] {
        WorldSettings settings;
        settings.materials[0].restitution = 1.01;
        JetPhysics().createWorld(settings);
    }));
    EXPECT_TRUE(refuses([&] {
        RigidBodyDef def = box({0, 0}, 1, 1);
        def.common.oneSided = {0, kNan};
        world->addRigidBody(def);
    }));
    EXPECT_TRUE(refuses([&] {
        ForceFieldDef def;
        def.reach = -1;
        world->addForceField(def);
    }));
    EXPECT_TRUE(refuses([&] {
        JointDef def;
        def.b.body = 0, def.breakForce = -1;
        world->addJoint(def);
    }));
    EXPECT_TRUE(refuses([&] {
        JointDef def;
        def.kind = JointDef::Kind::Pulley;
        def.b.body = 0, def.ratio = 0;
        world->addJoint(def);
    }));
    EXPECT_TRUE(refuses([&] {
        SpringActuatorDef def;
        def.b.body = 0, def.tearRatio = -1;
        world->addSpring(def);
    }));
    EXPECT_EQ(world->bodyCount(), 1u) << "what was refused left nothing behind";
    world->step(kStep);
    EXPECT_TRUE(allFinite(*world));
}

}  // namespace

}  // namespace jet::physics::test
